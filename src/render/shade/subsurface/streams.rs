//! Random streams of subsurface light: directions over the sphere and numbers, for each nesting depth.
//!
//! In POV-Ray they run on from sample to sample. Pictures rendered in its order do the same here; otherwise each sample
//! starts them elsewhere.

use super::MAX_DEPTH;
use crate::base::math::halton;
use crate::base::math::sampling::mersenne;
use glam::DVec3;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// The number of directions and numbers after which a stream begins again.
const PERIOD: u32 = (1 << 15) - 1;

static DIRECTIONS: LazyLock<Vec<DVec3>> = LazyLock::new(|| {
    (1..=PERIOD)
        .map(|number| on_sphere(halton(number)))
        .collect()
});

/// The streams of all depths.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::render::shade) struct SubsurfaceStreams([DepthStreams; MAX_DEPTH]);

/// The streams of one depth.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DepthStreams {
    /// The directions used.
    directions: u32,
    /// The numbers used.
    numbers: u32,
}

impl SubsurfaceStreams {
    /// The streams of a sample with this seed.
    pub(in crate::render::shade) fn of_seed(seed: u32) -> Self {
        let begun = seed % PERIOD;
        SubsurfaceStreams(
            [DepthStreams {
                directions: begun,
                numbers: begun,
            }; MAX_DEPTH],
        )
    }

    /// The streams of a depth below [`MAX_DEPTH`].
    pub(super) fn at(&mut self, depth: u8) -> &mut DepthStreams {
        &mut self.0[usize::from(depth).min(MAX_DEPTH - 1)]
    }
}

impl DepthStreams {
    /// The next unit direction.
    pub(super) fn direction(&mut self) -> DVec3 {
        let direction = DIRECTIONS[self.directions as usize];
        self.directions = (self.directions + 1) % PERIOD;
        direction
    }

    /// The next number from 0 to 1.
    pub(super) fn number(&mut self) -> f64 {
        self.numbers = (self.numbers + 1) % PERIOD;
        mersenne::random(self.numbers)
    }
}

/// The unit vector for a point of the unit square, which is mapped by its area.
fn on_sphere(square: glam::DVec2) -> DVec3 {
    let x = -1.0 + 2.0 * square.x;
    let radius = (1.0 - x * x).sqrt();
    let angle = TAU * square.y;
    DVec3::new(x, radius * angle.cos(), radius * angle.sin())
}
