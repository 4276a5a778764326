//! A pattern prepared for evaluation: its warp chain, its value, and its wave.

use super::{NormalTransforms, PatternEval, PreparedWarpChain, SurfacePoint, Wave};
use glam::DVec3;

/// A pattern prepared for evaluation.
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

    /// The point in pattern space for a shading point.
    #[must_use]
    #[inline]
    pub fn to_pattern_space(&self, point: DVec3) -> DVec3 {
        self.chain.to_pattern_space(point)
    }

    /// The value at a point of pattern space, with the wave applied: the position in a map.
    #[must_use]
    #[inline]
    pub fn value(&self, point: DVec3, spot: &SurfacePoint) -> f64 {
        self.wave.of(self.value.value(point, spot))
    }

    /// The values at four points of pattern space, with the wave applied.
    #[must_use]
    pub fn values_x4(&self, points: &[DVec3; 4], spots: [&SurfacePoint; 4]) -> [f64; 4] {
        let values = self.value.values_x4(points, spots);
        values.map(|value| self.wave.of(value))
    }

    /// Four points in pattern space.
    #[must_use]
    pub fn to_pattern_space_x4(&self, points: &[DVec3; 4]) -> [DVec3; 4] {
        self.chain.to_pattern_space_x4(points)
    }

    /// Vector that a `normal` of height 1 adds to the unit normal at a point of pattern space; `None` for patterns
    /// whose values serve as a height field for bump mapping.
    #[must_use]
    pub fn tilt(&self, point: DVec3) -> Option<DVec3> {
        self.value.tilt(point)
    }

    /// True if the value depends on the surface normal.
    #[must_use]
    pub fn needs_normal(&self) -> bool {
        self.value.needs_normal()
    }

    /// True if rounding decides about the value where surfaces may lie; turbulence moves what jumps away from there.
    #[must_use]
    pub fn jumps(&self) -> bool {
        !self.chain.is_turbulent() && self.value.jumps()
    }

    /// The transforms of normals to and from pattern space, with normalization after each if `is_unit`.
    #[must_use]
    pub fn normal_transforms(&self, is_unit: bool) -> NormalTransforms {
        self.chain.normal_transforms(is_unit)
    }
}
