//! A pattern ready for drawing: the way to it, its value, and its wave.

use super::{PreparedChain, Spot, Value, Wave};
use glam::DVec3;

/// A pattern ready for drawing.
#[derive(Debug)]
pub struct PreparedPattern {
    chain: PreparedChain,
    value: Box<dyn Value>,
    wave: Wave,
}

impl PreparedPattern {
    pub(super) fn new(chain: PreparedChain, value: Box<dyn Value>, wave: Wave) -> Self {
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
    pub fn value(&self, moved: DVec3, spot: &Spot) -> f64 {
        self.wave.of(self.value.value(moved, spot))
    }
}
