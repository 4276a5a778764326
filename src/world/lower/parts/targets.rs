//! Photon targets: objects that say `target`, each with its bounding box.

use super::inherited::Inherited;
use crate::scene::Object;
use crate::scene::light::PhotonRole;
use crate::world::photons::PhotonTarget;

/// The targets of a scene, in file order.
#[derive(Debug, Default)]
pub(crate) struct Targets(Vec<PhotonTarget>);

impl Targets {
    /// Number of targets.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Removes all but the first `len` targets.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.0.truncate(len);
    }

    /// All targets.
    pub(crate) fn into_list(self) -> Vec<PhotonTarget> {
        self.0
    }

    /// The photon settings of an object. A part of a target is not a target of its own.
    pub(crate) fn role(&mut self, object: &Object, above: &Inherited) -> PhotonRole {
        let Some(own) = object.photons() else {
            return above.flags.photons;
        };
        let mut role = above.flags.photons.with(own);
        let density = own.target.filter(|_| role.target.is_none());
        let is_lit = above.global_lights != Some(false);
        if let Some(density) = density.filter(|_| is_lit) {
            let mut transformed = object.clone();
            transformed.steps.extend_from_slice(&above.steps);
            role.target = u32::try_from(self.0.len()).ok();
            self.0.push(PhotonTarget {
                bounds: transformed.extent_box(),
                density: f64::from(single(density)),
                role,
            });
        }
        role
    }
}

/// POV-Ray stores the factor on spacings in single precision.
#[allow(clippy::cast_possible_truncation, reason = "it is asked for")]
fn single(density: f64) -> f32 {
    density as f32
}
