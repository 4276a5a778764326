//! Dependence of the image on random numbers.
//!
//! Each thread of POV-Ray takes its random numbers from one sequence for the whole picture, so that a pixel depends on
//! all earlier draws. With one thread its pictures are reproducible. Scenes in which that matters are rendered here in
//! the same order, by one thread, whatever the thread count.

use crate::base::options::{RenderOptions, Sampling};
use crate::scene::interior::{self, PreparedMedia};
use crate::world::compiled::World;

impl World {
    /// Returns true if pixels are rendered one after the other, because the picture depends on the sequence of random
    /// numbers.
    #[must_use]
    pub fn draws_in_order(&self, options: &RenderOptions) -> bool {
        options.uses_sequential_random()
            && !matches!(options.sampling, Sampling::Adaptive(_))
            && self.uses_random()
    }

    /// Returns true if random numbers affect the picture: in lights, grain, rainbows, media or subsurface light.
    #[must_use]
    pub fn uses_random(&self) -> bool {
        let mut lights = self.lights.iter();
        lights.any(|light| light.area.as_ref().is_some_and(|area| area.has_jitter))
            || self.rainbows.iter().any(|rainbow| rainbow.jitter != 0.0)
            || self
                .media
                .iter()
                .chain(self.interiors.all_media())
                .any(is_sampled_randomly)
            || self.summary.is_grainy
            || self.subsurface.is_some()
    }
}

/// Returns true if the positions or the number of a medium's samples are random.
fn is_sampled_randomly(media: &PreparedMedia) -> bool {
    let interior::Sampling {
        method,
        jitter,
        samples: [least, most],
        ..
    } = media.sampling;
    match method {
        1 => true,
        2 => jitter != 0.0 || most > least,
        _ => jitter != 0.0,
    }
}
