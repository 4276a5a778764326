//! Packets of eight rays from one point: conservative single-precision tests of a packet against a sphere or a box, and
//! of eight packets against a sphere.

use super::node::{Aabb32, max_f32, min_f32};
use crate::base::math::rounding::{loose_above, loose_below, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};
use glam::{DVec3, Vec3};

/// Number of rays in a packet.
pub(super) const LANES: usize = 8;

/// Above the relative error of the single-precision arithmetic here, some ten roundings.
pub(super) const REL_ERROR: f32 = 1.0e-6;

/// Eight rays: unit directions, and where each ends in the frame. A ray that is done ends before it begins.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct RayPacket8 {
    pub(super) dir: [[f32; LANES]; 3],
    pub(super) end: [f32; LANES],
}

/// A box as seen from the common origin, rounded outward.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewBox {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl ViewBox {
    /// The empty box.
    pub(super) const EMPTY: ViewBox = ViewBox {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    // Not written with `map`, which is not always inlined.
    #[inline(always)]
    pub(super) fn new(aabb: &Aabb32, origin: DVec3) -> Self {
        let below = |axis: usize| loose_below(f64::from(aabb.low[axis]) - origin[axis]);
        let above = |axis: usize| loose_above(f64::from(aabb.high[axis]) - origin[axis]);
        ViewBox {
            low: [below(0), below(1), below(2)],
            high: [above(0), above(1), above(2)],
        }
    }

    /// True if a ray from the origin in this direction may hit the box before `end`: [`PacketAndBox`] for a single ray.
    #[inline(always)]
    pub(super) fn is_hit(&self, dir: Vec3, end: f32) -> bool {
        let (mut enter, mut leave) = (0.0, end);
        for axis in 0..3 {
            let inverse = 1.0 / dir[axis];
            let (low, high) = (self.low[axis] * inverse, self.high[axis] * inverse);
            enter = max_f32(min_f32(low, high), enter);
            leave = min_f32(max_f32(high, low), leave);
        }
        let slack = 4.0 * REL_ERROR * (enter.abs() + leave.abs());
        enter - slack <= leave + f32::MIN_POSITIVE
    }
}

impl RayPacket8 {
    pub(super) const EMPTY: RayPacket8 = RayPacket8 {
        dir: [[0.0; LANES]; 3],
        end: [f32::NEG_INFINITY; LANES],
    };

    /// Loads the first or the second half of the rays: unit directions, and where each ends, in a frame of this scale.
    #[inline(always)]
    pub(super) fn load_half(
        &mut self,
        half: usize,
        dir: &[[f64; 4]; 3],
        end: &[f64; 4],
        scale: f64,
    ) {
        let first = 4 * half;
        // Not written with `map`, which is not always inlined.
        for (to, from) in self.dir.iter_mut().zip(dir) {
            for (to, from) in to[first..first + 4].iter_mut().zip(from) {
                *to = nearest(*from);
            }
        }
        for (to, from) in self.end[first..first + 4].iter_mut().zip(end) {
            *to = frame_end(*from, scale);
        }
    }

    /// The farthest end; negative when all rays are done.
    #[inline(always)]
    pub(super) fn farthest(&self) -> f32 {
        let mut farthest = f32::NEG_INFINITY;
        for end in self.end {
            farthest = max_f32(end, farthest);
        }
        farthest
    }

    #[inline(always)]
    pub(super) fn dot(&self, with: Vec3) -> [f32; LANES] {
        let [x, y, z] = &self.dir;
        let mut dot = [0.0; LANES];
        for i in 0..LANES {
            dot[i] = x[i] * with.x + y[i] * with.y + z[i] * with.z;
        }
        dot
    }

    /// The mean direction, and a bound on the distance of the other directions from it.
    #[inline(always)]
    pub(super) fn cone(&self) -> (Vec3, f32) {
        #[allow(clippy::cast_precision_loss, reason = "8 is exact")]
        let middle = Vec3::from_array(
            self.dir
                .map(|lanes| lanes.iter().sum::<f32>() / LANES as f32),
        );
        let mut off = [0.0; LANES];
        for (i, off) in off.iter_mut().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|axis| self.dir[axis][i] - middle[axis]);
            *off = x * x + y * y + z * z;
        }
        let farthest = off.into_iter().fold(0.0, max_f32);
        (middle, farthest.sqrt() + 4.0 * REL_ERROR)
    }
}

/// Mask of the rays of a packet that may hit a sphere: its centre is near the line, neither behind the origin nor
/// beyond the end.
pub(super) struct PacketAndSphere<'a> {
    pub(super) packet: &'a RayPacket8,
    pub(super) centre: Vec3,
    pub(super) radius: f32,
}

impl SimdKernel for PacketAndSphere<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let dir: [F::F32; 3] = load3(&self.packet.dir);
        let centre = splat3(self.centre.to_array());
        let radius = <F::F32>::splat(self.radius);
        let limit = <F::F32>::splat(self.radius * self.radius * (1.0 + 4.0 * REL_ERROR));
        let along = dot(dir, centre);
        let is_near = length_sq(cross(dir, centre)).le(limit);
        let is_ahead = <F::F32>::splat(0.0).le(along + radius);
        let is_before = (along - radius).le(<F::F32>::from_array(&self.packet.end));
        is_near & is_ahead & is_before
    }
}

/// Mask of the rays of a packet that may hit a box.
pub(super) struct PacketAndBox<'a> {
    pub(super) packet: &'a RayPacket8,
    pub(super) view_box: &'a ViewBox,
}

impl SimdKernel for PacketAndBox<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let dir: [F::F32; 3] = load3(&self.packet.dir);
        let one = <F::F32>::splat(1.0);
        let inverse = [one / dir[0], one / dir[1], one / dir[2]];
        intersect_box(
            inverse,
            <F::F32>::from_array(&self.packet.end),
            self.view_box,
        )
    }
}

/// Mask of eight rays, given by their inverse directions, that may hit a box before their ends.
#[inline(always)]
pub(super) fn intersect_box<E: F32x8>(inverse: [E; 3], end: E, view_box: &ViewBox) -> u32 {
    // A ray that is done ends at minus infinity: the slack would be infinite, and it would hit every box.
    let end = end.lane_max(E::splat(f32::MIN));
    let (mut enter, mut leave) = (E::splat(0.0), end);
    for (axis, inverse) in inverse.into_iter().enumerate() {
        let low = E::splat(view_box.low[axis]) * inverse;
        let high = E::splat(view_box.high[axis]) * inverse;
        // Keeps the running bound where a plane yields NaN (zero times infinity).
        enter = low.lane_min(high).lane_max(enter);
        leave = high.lane_max(low).lane_min(leave);
    }
    let slack = E::splat(4.0 * REL_ERROR) * (enter.abs() + leave.abs());
    (enter - slack).le(leave + E::splat(f32::MIN_POSITIVE))
}

/// The mean directions of eight packets, and how far the directions of each packet can be from its mean.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct PacketCones {
    pub(super) middle: [[f32; LANES]; 3],
    pub(super) spread: [f32; LANES],
}

/// Mask of the packets, of eight, that may contain a ray that hits a sphere. Moving a direction by a length moves its
/// distance from the centre by at most that length times the distance of the centre.
pub(super) struct ConesAndSphere<'a> {
    pub(super) cones: &'a PacketCones,
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    pub(super) distance: f32,
}

impl SimdKernel for ConesAndSphere<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let middle: [F::F32; 3] = load3(&self.cones.middle);
        let centre = splat3(self.centre.to_array());
        let reach = <F::F32>::splat(self.distance) * <F::F32>::from_array(&self.cones.spread);
        let limit = <F::F32>::splat(self.radius) + reach;
        let limit_sq = limit * limit * <F::F32>::splat(1.0 + 4.0 * REL_ERROR);
        let is_near = length_sq(cross(middle, centre)).le(limit_sq);
        is_near & <F::F32>::splat(0.0).le(limit)
    }
}

#[inline(always)]
pub(super) fn dot<E: F32x8>(a: [E; 3], b: [E; 3]) -> E {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross<E: F32x8>(a: [E; 3], b: [E; 3]) -> [E; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

// Not written with closures, which would not be compiled for the SIMD level of the caller.

#[inline(always)]
pub(super) fn load3<E: F32x8>(from: &[[f32; LANES]; 3]) -> [E; 3] {
    [
        E::from_array(&from[0]),
        E::from_array(&from[1]),
        E::from_array(&from[2]),
    ]
}

#[inline(always)]
pub(super) fn splat3<E: F32x8>(of: [f32; 3]) -> [E; 3] {
    [E::splat(of[0]), E::splat(of[1]), E::splat(of[2])]
}

#[inline(always)]
pub(super) fn length_sq<E: F32x8>(a: [E; 3]) -> E {
    dot(a, a)
}

/// Converts the end of a ray to the frame, rounded up.
#[inline(always)]
pub(super) fn frame_end(end: f64, scale: f64) -> f32 {
    let end = nearest(end * scale);
    if end.is_nan() {
        f32::INFINITY
    } else {
        end * (1.0 + 4.0 * REL_ERROR)
    }
}
