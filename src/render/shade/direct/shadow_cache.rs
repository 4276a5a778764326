//! What shadows leave of lights at a hit, found out once for all its layers and textures.
//!
//! So does POV-Ray, which shows in the random numbers that lights with `jitter` take: as many for a surface of several
//! layers or blended textures as for one layer. Lights with `area_illumination` are asked anew for each layer.

use crate::base::color::Rgb;
use smallvec::SmallVec;
use std::cell::RefCell;

/// What shadows leave of lights at a hit.
#[derive(Debug, Default)]
pub(in crate::render::shade) struct ShadowCache(RefCell<SmallVec<[(u32, Rgb); 4]>>);

impl ShadowCache {
    /// What is left of the light of this number.
    pub(in crate::render::shade) fn of(&self, light: u32) -> Option<Rgb> {
        let lights = self.0.borrow();
        let mut known = lights.iter().filter(|known| known.0 == light);
        known.next().map(|known| known.1)
    }

    /// Keeps what is left of the light of this number.
    pub(in crate::render::shade) fn keep(&self, light: u32, left: Rgb) {
        self.0.borrow_mut().push((light, left));
    }
}
