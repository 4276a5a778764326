//! Photons: light that lamps send to some objects, which bend and mirror it, is kept where it comes to rest, and spread
//! around there (Jensen 1996), in the numbers of POV-Ray 3.7.
//!
//! The stored [`Photon`], its lookup in a [`Map`], and the [`radius`] of an estimate. Emission, and the radiance that
//! photons give to surfaces and media, are in [`crate::render::shade`]. A map is built before the picture, on one thread,
//! since it depends on random numbers and on the order of photons; while the picture is rendered it is only read.

mod columns;
mod file;
mod map;
mod near;
mod order;
mod photon;
pub mod radius;

pub use file::{read, write};
pub use map::{Map, Search};
pub use near::Near;
pub use photon::Photon;

use crate::scene::light::PhotonRole;
use crate::scene::{self, Globals, PhotonDensity, Stored};
use glam::DVec3;
use radius::{CRand, Space};

/// An object to which photons are sent.
#[derive(Clone, Debug)]
pub struct PhotonTarget {
    /// The box around it, as the language tells it.
    pub around: Stored,
    /// The factor on the spacing of its photons.
    pub density: f64,
    /// What it does with them.
    pub role: PhotonRole,
}

/// The settings of a scene, worked out. Photons are kept, and looked up, where they lie by the scene's own numbers, and
/// with its own lengths.
#[derive(Clone, Debug)]
pub struct Photons {
    /// As the scene gives them.
    pub settings: scene::Photons,
    /// What photons are sent to, in the order of the scene.
    pub targets: Vec<PhotonTarget>,
    /// How many generations of photons there are.
    pub max_trace_level: u32,
    /// Below this weight a photon ends.
    pub adc_bailout: f64,
    /// The length in which the scene counts.
    pub unit: f64,
    /// Where the origin of the scene's own coordinates lies.
    pub origin: DVec3,
}

impl Photons {
    /// What a scene asks for; `None` if nothing is gathered.
    #[must_use]
    pub fn new(
        settings: &scene::Photons,
        targets: Vec<PhotonTarget>,
        globals: &Globals,
    ) -> Option<Photons> {
        (settings.gather[1] > 0).then(|| Photons {
            settings: settings.clone(),
            targets,
            max_trace_level: settings.max_trace_level.unwrap_or(globals.max_trace_level),
            adc_bailout: settings.adc_bailout.unwrap_or(globals.adc_bailout),
            unit: globals.unit,
            origin: globals.origin,
        })
    }

    /// The spacing of photons on targets, where `expected` tells how many there would be with one spacing.
    #[must_use]
    pub fn spacing(&self, expected: impl FnOnce(f64) -> f64) -> f64 {
        match self.settings.density {
            PhotonDensity::Spacing(spacing) => spacing * self.unit,
            PhotonDensity::Count(count) => self.unit * (expected(self.unit) / count).sqrt(),
        }
    }

    /// A point of the world by the numbers of the scene.
    #[must_use]
    pub fn own(&self, point: DVec3) -> DVec3 {
        (point - self.origin) / self.unit
    }

    /// Whether photons are left in media.
    #[must_use]
    pub fn fills_media(&self) -> bool {
        self.settings.media.0 > 0
    }
}

/// All photons that were kept.
#[derive(Clone, Debug, Default)]
pub struct PhotonMaps {
    /// How many were shot.
    pub shot: u64,
    /// On surfaces.
    pub surface: Map,
    /// In media.
    pub media: Map,
    /// How they are looked up on surfaces.
    pub on_surfaces: Search,
    /// And in media.
    pub in_media: Search,
}

/// Media are searched so many times as far.
const IN_MEDIA: f64 = 2.0;

impl PhotonMaps {
    /// The photons of two maps, ready to be looked up.
    #[must_use]
    pub fn new(photons: &Photons, shot: u64, [surface, media]: [Map; 2]) -> PhotonMaps {
        let settings = &photons.settings;
        let most = settings.gather[1] as usize;
        let mut random = CRand::new();
        let mut radius = |map: &Map, number: usize, space: Space| {
            let (given, factor) = settings.radius[number];
            let given = given.filter(|&given| given > 0.0);
            let radius = given.unwrap_or_else(|| radius::automatic(map, most, space, &mut random));
            radius * factor
        };
        let search = |radius: f64, media: bool| Search {
            radius,
            gather: settings.gather,
            tolerance: settings.expand_thresholds.0,
            few: settings.expand_thresholds.1,
            is_flat: !media,
        };
        let on_surfaces = search(radius(&surface, 0, Space::Surface), false);
        let in_media = search(IN_MEDIA * radius(&media, 1, Space::Media), true);
        PhotonMaps {
            shot,
            surface,
            media,
            on_surfaces,
            in_media,
        }
    }

    /// The memory of the maps in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.surface.bytes() + self.media.bytes()
    }
}
