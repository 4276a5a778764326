//! Shadowed light at a hit, traced once for all its layers and textures.
//!
//! POV-Ray does the same, which shows in the random numbers of lights with `jitter`: a surface of several layers or
//! blended textures draws as many as one layer. Lights with `area_illumination` are traced again for each layer.

use crate::base::color::Rgb;
use smallvec::SmallVec;
use std::cell::RefCell;

/// The light of each light source after shadows, at one hit.
#[derive(Debug, Default)]
pub(in crate::render::shade) struct ShadowCache(RefCell<SmallVec<[(u32, Rgb); 4]>>);

impl ShadowCache {
    /// The cached light of a light source.
    pub(in crate::render::shade) fn of(&self, light: u32) -> Option<Rgb> {
        let lights = self.0.borrow();
        let mut known = lights.iter().filter(|known| known.0 == light);
        known.next().map(|known| known.1)
    }

    /// Stores the light of a light source.
    pub(in crate::render::shade) fn keep(&self, light: u32, left: Rgb) {
        self.0.borrow_mut().push((light, left));
    }
}
