//! The atmosphere of a scene: fog, rainbows, media, and the sky sphere behind all objects.

mod fog;
mod rainbow;
mod sky_sphere;

pub use fog::{Fog, combined_tint};
pub use rainbow::{Rainbow, mean_tint};
pub use sky_sphere::{PreparedSky, SkyRadiance, SkySphere};

use crate::base::color::Rgb;
use crate::scene::interior::Media;
use std::sync::Arc;

/// The length of a ray that hits nothing, as in POV-Ray.
pub const MISS_DISTANCE: f64 = 2e10;

/// The distance at which a ray that stays in the cone of a spotlight leaves it, as measured with POV-Ray.
pub const CONE_DISTANCE: f64 = 1e7;

/// The atmosphere of a scene.
#[derive(Clone, Debug, Default)]
pub struct Atmosphere {
    /// The fogs.
    pub fogs: Vec<Fog>,
    /// The rainbows.
    pub rainbows: Vec<Rainbow>,
    /// The media that fill all space.
    pub media: Vec<Media>,
    /// The sky in front of the background, for rays that hit nothing.
    pub sky_sphere: Option<Arc<SkySphere>>,
}

/// The effect of a segment of the atmosphere on light that passes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The transmittance.
    pub factor: Rgb,
    /// The light that the segment adds.
    pub added: Rgb,
}

impl Tint {
    /// No effect on light.
    pub const NONE: Tint = Tint {
        factor: Rgb::WHITE,
        added: Rgb::BLACK,
    };

    /// Applies the effect to light from behind.
    #[must_use]
    pub fn apply(&self, light: Rgb) -> Rgb {
        light * self.factor + self.added
    }
}
