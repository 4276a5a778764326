//! Random numbers, points and rays for tests.

use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Random number generator with a given seed (xorshift64*, Vigna 2016).
pub(crate) struct Random(u64);

impl Random {
    /// The generator for a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A uniform number in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        f64::from_bits(0x3ff0_0000_0000_0000 | (self.bits() >> 12)) - 1.0
    }

    /// A vector with each component between `-size` and `size`.
    pub(crate) fn vector(&mut self, size: f64) -> DVec3 {
        let mut component = || (2.0 * self.uniform() - 1.0) * size;
        DVec3::new(component(), component(), component())
    }

    /// A point in `bounds` enlarged by a factor of 1.2.
    pub(crate) fn point_near(&mut self, bounds: &Bounds) -> DVec3 {
        let half = 0.6 * (bounds.max - bounds.min);
        bounds.centre() + half * self.vector(1.0)
    }

    /// A ray towards `bounds` from up to a few of their diagonals away or from inside. One ray in four is parallel to
    /// an axis.
    pub(crate) fn ray_near(&mut self, bounds: &Bounds) -> Ray {
        let size = (bounds.max - bounds.min).length();
        let far = size * 3.0 * self.uniform();
        let origin = bounds.centre() + self.vector(far);
        let dir = (self.point_near(bounds) - origin) * (0.1 + self.uniform());
        let bits = self.bits();
        if bits & 3 != 0 {
            return Ray::new(origin, dir);
        }
        let axis = usize::try_from((bits >> 2) % 3).unwrap();
        let mut along = DVec3::ZERO;
        along[axis] = if bits & 64 == 0 { -size } else { size };
        let mut origin = self.point_near(bounds);
        origin[axis] -= along[axis];
        Ray::new(origin, along)
    }
}
