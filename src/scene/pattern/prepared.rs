//! A pattern ready for drawing: the way to it, its value, and its wave.

use super::{PatternEval, PreparedWarpChain, SurfacePoint, Turns, Wave};
use glam::DVec3;

/// A pattern ready for drawing.
#[derive(Debug)]
pub struct PreparedPattern {
    chain: PreparedWarpChain,
    value: Box<dyn PatternEval>,
    wave: Wave,
}

impl PreparedPattern {
    pub(super) fn new(chain: PreparedWarpChain, value: Box<dyn PatternEval>, wave: Wave) -> Self {
        PreparedPattern { chain, value, wave }
    }

    /// The point of pattern space for a point outside.
    #[must_use]
    #[inline]
    pub fn moved(&self, point: DVec3) -> DVec3 {
        self.chain.moved(point)
    }

    /// The value at a point of pattern space, waves included: the position in a map.
    #[must_use]
    #[inline]
    pub fn value(&self, moved: DVec3, spot: &SurfacePoint) -> f64 {
        self.wave.of(self.value.value(moved, spot))
    }

    /// How a `normal` of height 1 tilts a surface at a point of pattern space; `None` where the values are the heights.
    #[must_use]
    pub fn tilt(&self, moved: DVec3) -> Option<DVec3> {
        self.value.tilt(moved)
    }

    /// Whether the value hangs on the normal of the surface.
    #[must_use]
    pub fn minds_normal(&self) -> bool {
        self.value.minds_normal()
    }

    /// How normals turn on their way to the pattern and back, made one long after each transform if `is_unit`.
    #[must_use]
    pub fn turns(&self, is_unit: bool) -> Turns {
        self.chain.turns(is_unit)
    }
}
