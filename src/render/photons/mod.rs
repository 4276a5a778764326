//! Photon mapping (Jensen 1996), with the numbers of POV-Ray 3.7: photons are traced from lights to targets that
//! refract or reflect them, stored at their hits, and used for radiance estimates there.
//!
//! This module holds the stored [`Photon`], its lookup in a [`Map`], and the [`radius`] of an estimate. Emission, and
//! the radiance of surfaces and media, are in [`crate::render::shade`]. A map is built before the picture on one
//! thread, since it depends on random numbers and on the order of photons; during rendering it is read-only.

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

use crate::world::PhotonMapping;
use radius::{CRand, Space};

/// All stored photons.
#[derive(Clone, Debug, Default)]
pub struct PhotonMaps {
    /// The number of emitted photons.
    pub emitted: u64,
    /// On surfaces.
    pub surface: Map,
    /// In media.
    pub media: Map,
    /// The search on surfaces.
    pub on_surfaces: Search,
    /// The search in media.
    pub in_media: Search,
}

/// The factor on the search radius in media.
const IN_MEDIA: f64 = 2.0;

impl PhotonMaps {
    /// The photons of two maps, with their search parameters.
    #[must_use]
    pub fn new(photons: &PhotonMapping, emitted: u64, [surface, media]: [Map; 2]) -> PhotonMaps {
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
            min_expanded: settings.expand_thresholds.1,
            is_flat: !media,
        };
        let on_surfaces = search(radius(&surface, 0, Space::Surface), false);
        let in_media = search(IN_MEDIA * radius(&media, 1, Space::Media), true);
        PhotonMaps {
            emitted,
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
