//! What is between and behind the objects: fog, rainbows and the sphere of the sky.

mod fog;
mod rainbow;
mod sky_sphere;

pub use fog::{Fog, sum_of};
pub use rainbow::{Rainbow, mean_of};
pub use sky_sphere::{PreparedSky, Seen, SkySphere};

use crate::base::color::Rgb;
use crate::scene::interior::Media;
use std::sync::Arc;

/// How long POV-Ray takes the way of a ray that meets nothing.
pub const WAY_TO_NOTHING: f64 = 2e10;

/// The atmosphere of a scene.
#[derive(Clone, Debug, Default)]
pub struct Atmosphere {
    /// All fogs, which add up.
    pub fogs: Vec<Fog>,
    /// All rainbows.
    pub rainbows: Vec<Rainbow>,
    /// What fills all space.
    pub media: Vec<Media>,
    /// What rays see that meet nothing, in front of the background.
    pub sky_sphere: Option<Arc<SkySphere>>,
}

/// What a stretch of air does to light that comes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The factor on light.
    pub factor: Rgb,
    /// Light of its own.
    pub added: Rgb,
}

impl Tint {
    /// Clear air.
    pub const NONE: Tint = Tint {
        factor: Rgb::WHITE,
        added: Rgb::BLACK,
    };

    /// Light behind the air.
    #[must_use]
    pub fn of(&self, light: Rgb) -> Rgb {
        light * self.factor + self.added
    }
}
