//! What of a scene hangs on random numbers.
//!
//! POV-Ray's threads each take such numbers from one row as long as they draw, so that what a pixel gets hangs on all that
//! was drawn before. Its pictures by one thread are the same every time. Scenes in which that matters are drawn here in
//! that order too, by one thread, whatever their number.

use crate::scene::interior::{PreparedMedia, Sampling};
use crate::world::World;

impl World {
    /// Whether random numbers can be seen in the picture: in lamps, grain, rainbows or media.
    #[must_use]
    pub fn uses_random(&self) -> bool {
        let mut lights = self.lights.iter();
        lights.any(|light| light.area.as_ref().is_some_and(|area| area.has_jitter))
            || self.rainbows.iter().any(|rainbow| rainbow.jitter != 0.0)
            || self
                .media
                .iter()
                .chain(self.interiors.all_media())
                .any(takes_chances)
            || self.overview.is_grainy
    }
}

/// Whether samples of a medium lie at random places, or their number does.
fn takes_chances(media: &PreparedMedia) -> bool {
    let Sampling {
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
