//! Photon targets: objects that say `target`, or the parts of such a union, each with its bounding box.

use super::inherited::{CsgRole, Inherited};
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

    /// The photon settings of an object, and the factor on spacings if its parts are targets of their own: those of a
    /// union that is split up, but of no other target.
    pub(crate) fn role(&mut self, object: &Object, above: &Inherited) -> (PhotonRole, Option<f64>) {
        let own = object.photons();
        let above_role = above.flags.photons;
        let mut role = own.map_or(above_role, |own| above_role.with(own));
        let density = above.split_target.or(own.and_then(|own| own.target));
        let is_lit = above.global_lights != Some(false);
        let is_whole = above.role != CsgRole::Alone || object.flags.keeps_union;
        let density = density.filter(|_| role.target.is_none() && is_lit);
        if object.plain_union().is_some() && !is_whole {
            return (role, density);
        }
        if let Some(density) = density {
            let mut transformed = object.clone();
            transformed.steps.extend_from_slice(&above.steps);
            role.target = u32::try_from(self.0.len()).ok();
            self.0.push(PhotonTarget {
                bounds: transformed.extent_box(),
                density: f64::from(single(density)),
                role,
            });
        }
        (role, None)
    }
}

/// POV-Ray stores the factor on spacings in single precision.
#[allow(clippy::cast_possible_truncation, reason = "it is asked for")]
fn single(density: f64) -> f32 {
    density as f32
}
