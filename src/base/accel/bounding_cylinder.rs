//! Infinite bounding cylinders of long thin items, whose boxes are mostly empty.

use super::node::Frame;
use super::packet::{REL_ERROR, RayPacket8, cross, dot, length_sq, load3, splat3};
use crate::base::math::rounding::{f32_above, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};
use glam::DVec3;

/// An infinite circular cylinder that contains an item: a point on its axis, the direction of the axis, and the radius.
pub type BoundingCylinder = (DVec3, DVec3, f64);

/// A [`BoundingCylinder`] in the frame of the tree, relative to the common origin of some rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewedCylinder {
    point: [f32; 3],
    dir: [f32; 3],
    /// The squares of the radius and of the rounding error of a distance from the axis, enlarged so that their sum
    /// bounds the square of the sum.
    radius_sq: f32,
    slack_sq: f32,
}

impl ViewedCylinder {
    pub(super) fn new(
        (point, dir, radius): BoundingCylinder,
        frame: &Frame,
        origin: DVec3,
    ) -> Option<Self> {
        let point = frame.in_frame(point) - origin;
        let dir = dir.try_normalize()?;
        // The point of the axis nearest to the origin rounds best.
        let point = point - point.dot(dir) * dir;
        let radius = f64::from(f32_above(radius * frame.scale() * (1.0 + 1e-6)));
        let slack = 16.0 * f64::from(REL_ERROR) * (point.length() + radius);
        // (a + b)² is at most 1.01 a² + 101 b².
        let cylinder = ViewedCylinder {
            point: [point.x, point.y, point.z].map(nearest),
            dir: [dir.x, dir.y, dir.z].map(nearest),
            radius_sq: f32_above(1.01 * radius * radius),
            slack_sq: f32_above(101.0 * slack * slack),
        };
        (cylinder.radius_sq.is_finite() && cylinder.slack_sq.is_finite()).then_some(cylinder)
    }
}

/// Mask of the rays of a packet whose lines may hit a cylinder.
pub(super) struct PacketAndCylinder<'a> {
    pub(super) packet: &'a RayPacket8,
    pub(super) cylinder: &'a ViewedCylinder,
}

impl SimdKernel for PacketAndCylinder<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let across: [F::F32; 3] = cross(load3(&self.packet.dir), splat3(self.cylinder.dir));
        let off = dot(across, splat3(self.cylinder.point));
        let limit = length_sq(across) * <F::F32>::splat(self.cylinder.radius_sq);
        (off * off).le(limit + <F::F32>::splat(self.cylinder.slack_sq))
    }
}
