//! Photon mapping as a scene asks for it: settings and targets.

use crate::scene::light::PhotonRole;
use crate::scene::{self, ExtentBox, PhotonDensity, Scene};
use glam::DVec3;

/// An object that receives photons.
#[derive(Clone, Debug)]
pub struct PhotonTarget {
    /// Its bounding box, as given by the scene.
    pub bounds: ExtentBox,
    /// The factor on the spacing of its photons.
    pub density: f64,
    /// Its refraction and reflection of photons.
    pub role: PhotonRole,
}

/// The photon settings of a scene. Photons are stored and looked up in the scene's own coordinates and lengths.
#[derive(Clone, Debug)]
pub struct PhotonMapping {
    /// The settings as given.
    pub settings: scene::Photons,
    /// The targets, in the order of the scene.
    pub targets: Vec<PhotonTarget>,
    /// The largest number of refractions and reflections of a photon.
    pub max_trace_level: u32,
    /// The weight below which a photon ends.
    pub adc_bailout: f64,
    /// The length of the scene's unit.
    pub unit: f64,
    /// The origin of the scene's own coordinates.
    pub origin: DVec3,
    /// True if the light of a photon is rounded to the steps of its bytes, as in version 3.8; else it is truncated.
    pub rounds_light: bool,
}

impl PhotonMapping {
    /// The photon settings of a scene; `None` if nothing is gathered.
    #[must_use]
    pub fn new(scene: &Scene, targets: Vec<PhotonTarget>) -> Option<PhotonMapping> {
        let globals = &scene.globals;
        let settings = globals.photons.as_ref()?;
        (settings.gather[1] > 0).then(|| PhotonMapping {
            settings: settings.clone(),
            targets,
            max_trace_level: settings.max_trace_level.unwrap_or(globals.max_trace_level),
            adc_bailout: settings.adc_bailout.unwrap_or(globals.adc_bailout),
            unit: globals.unit,
            origin: globals.origin,
            rounds_light: scene.globals.is_for_3_8,
        })
    }

    /// The spacing of photons on targets; `expected` gives the number of photons for a spacing.
    #[must_use]
    pub fn spacing(&self, expected: impl FnOnce(f64) -> f64) -> f64 {
        match self.settings.density {
            PhotonDensity::Spacing(spacing) => spacing * self.unit,
            PhotonDensity::Count(count) => self.unit * (expected(self.unit) / count).sqrt(),
        }
    }

    /// A point of the world in the scene's own coordinates.
    #[must_use]
    pub fn scene_point(&self, point: DVec3) -> DVec3 {
        (point - self.origin) / self.unit
    }

    /// Returns true if photons are deposited in media.
    #[must_use]
    pub fn fills_media(&self) -> bool {
        self.settings.media.0 > 0
    }
}
