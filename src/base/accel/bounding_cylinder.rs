//! Rods around long things, whose boxes are mostly empty.

use super::node::Frame;
use super::packet::{DOUBT, RayPacket8, all, cross, dot, length_sq, load};
use crate::base::math::rounding::{f32_above, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};
use glam::DVec3;

/// A round rod without ends that holds an item: a point of its axis, the direction of that, and its radius.
pub type BoundingCylinder = (DVec3, DVec3, f64);

/// The same as seen from a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewedCylinder {
    from: [f32; 3],
    way: [f32; 3],
    /// The square of the radius, and of what rounding may add to a distance from it, with room for the sum of both.
    radius_sq: f32,
    slack_sq: f32,
}

impl ViewedCylinder {
    pub(super) fn new(
        (from, way, radius): BoundingCylinder,
        frame: &Frame,
        origin: DVec3,
    ) -> Option<Self> {
        let from = frame.place(from) - origin;
        let way = way.try_normalize()?;
        // The point of the axis that is nearest tells it best.
        let from = from - from.dot(way) * way;
        let radius = f64::from(f32_above(radius * frame.scale() * (1.0 + 1e-6)));
        let slack = 16.0 * f64::from(DOUBT) * (from.length() + radius);
        // (a + b)² is at most 1.01 a² + 101 b².
        let rod = ViewedCylinder {
            from: [from.x, from.y, from.z].map(nearest),
            way: [way.x, way.y, way.z].map(nearest),
            radius_sq: f32_above(1.01 * radius * radius),
            slack_sq: f32_above(101.0 * slack * slack),
        };
        (rod.radius_sq.is_finite() && rod.slack_sq.is_finite()).then_some(rod)
    }
}

/// Which rays of a group may come as near to the axis of a rod as its radius, one bit each.
pub(super) struct PacketAndCylinder<'a> {
    pub(super) group: &'a RayPacket8,
    pub(super) rod: &'a ViewedCylinder,
}

impl SimdKernel for PacketAndCylinder<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let across: [F::F32; 3] = cross(load(&self.group.dir), all(self.rod.way));
        let off = dot(across, all(self.rod.from));
        let limit = length_sq(across) * <F::F32>::splat(self.rod.radius_sq);
        (off * off).le(limit + <F::F32>::splat(self.rod.slack_sq))
    }
}
