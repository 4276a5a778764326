//! Leaves of balls: up to eight side by side, and a ray made ready for them.
//!
//! Where all that a node would hold are balls, their centres and radii take half the memory of their boxes and say more:
//! of two rays that meet the box of a ball one misses the ball. As with boxes every doubt is in favour of being met.

use super::bounding_sphere::BoundingSphere;
use super::node::{Aabb32, FrameRay, WIDTH, larger};
use super::packet::DOUBT;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};

/// Eight balls in the frame of the tree. The radius of an unused place is that of nothing, which no ray meets.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct SphereLeaf {
    pub(super) centre: [[f32; WIDTH]; 3],
    pub(super) radius: [f32; WIDTH],
}

/// What halving and rounding the ends of a box may lose of its middle and its radius, relative to where it lies.
const LOST: f32 = 2.0 * f32::EPSILON;

impl SphereLeaf {
    pub(super) const EMPTY: SphereLeaf = SphereLeaf {
        centre: [[0.0; WIDTH]; 3],
        radius: [f32::NEG_INFINITY; WIDTH],
    };

    /// Puts in the ball that touches all sides of a box, which is as wide as it is high and deep.
    pub(super) fn set(&mut self, place: usize, cell: &Aabb32) {
        let mut radius = 0.0;
        for (axis, centre) in self.centre.iter_mut().enumerate() {
            let (low, high) = (cell.low[axis], cell.high[axis]);
            centre[place] = 0.5 * low + 0.5 * high;
            let lost = LOST * larger(low.abs(), high.abs()) + f32::MIN_POSITIVE;
            radius = larger(0.5 * high - 0.5 * low + lost, radius);
        }
        self.radius[place] = radius;
    }

    /// How many balls it has: those in its first places.
    pub(super) fn count(&self) -> usize {
        self.radius.iter().filter(|&&radius| radius >= 0.0).count()
    }

    /// One of the balls.
    #[inline(always)]
    pub(super) fn ball(&self, place: usize) -> BoundingSphere {
        let [x, y, z] = &self.centre;
        BoundingSphere::filled([x[place], y[place], z[place]], self.radius[place])
    }

    /// Where the ray enters each ball at the earliest, and which balls it may meet between `from` and `to`, one bit each.
    #[inline(always)]
    pub(super) fn meet(
        &self,
        lanes: SimdLevel,
        ray: &FrameRay,
        (from, to): (f32, f32),
    ) -> ([f32; WIDTH], u32) {
        let block = self;
        lanes.run(RayAndSphereLeaf {
            ray,
            block,
            from,
            to,
        })
    }

    /// Which balls may share a point with a box, one bit each.
    pub(super) fn overlap(&self, cell: &Aabb32) -> u32 {
        let mut shared = 0;
        for place in 0..self.count() {
            let ball = self.ball(place).cell();
            let is_shared = |axis: usize| {
                ball.low[axis] <= cell.high[axis] && cell.low[axis] <= ball.high[axis]
            };
            shared |= u32::from((0..3).all(is_shared)) << place;
        }
        shared
    }
}

/// A ray against the balls of a block, between two of its parameters.
struct RayAndSphereLeaf<'a> {
    ray: &'a FrameRay,
    block: &'a SphereLeaf,
    from: f32,
    to: f32,
}

impl SimdKernel for RayAndSphereLeaf<'_> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; WIDTH], u32) {
        let (ray, block) = (self.ray, self.block);
        let [x, y, z] = &block.centre;
        let x = <F::F32>::from_array(x) - <F::F32>::splat(ray.middle[0]);
        let y = <F::F32>::from_array(y) - <F::F32>::splat(ray.middle[1]);
        let z = <F::F32>::from_array(z) - <F::F32>::splat(ray.middle[2]);
        let [u, v, w] = [
            <F::F32>::splat(ray.dir[0]),
            <F::F32>::splat(ray.dir[1]),
            <F::F32>::splat(ray.dir[2]),
        ];
        let doubt = (x.abs() + y.abs() + z.abs()) * <F::F32>::splat(2.0 * DOUBT);
        let doubt = doubt + <F::F32>::splat(ray.slack);
        let radius = <F::F32>::from_array(&block.radius) + doubt;
        // Balls are tried at the size of the direction: that saves a division.
        let along = x * u + y * v + z * w;
        let a = y * w - z * v;
        let b = z * u - x * w;
        let c = x * v - y * u;
        let off = a * a + b * b + c * c;
        let reach = radius * radius * <F::F32>::splat(ray.speed_sq);
        // Where both are without end, their difference is not a number and counts as nothing: such a ball is out of reach.
        let half = (reach - off).lane_max(<F::F32>::splat(0.0)).sqrt();
        let per_speed_sq = <F::F32>::splat(1.0 / ray.speed_sq);
        let enter = (along - half) * per_speed_sq - doubt;
        let leave = (along + half) * per_speed_sq + doubt;
        let met = <F::F32>::splat(0.0).le(radius)
            & off.le(reach)
            & enter.le(<F::F32>::splat(self.to))
            & <F::F32>::splat(self.from).le(leave);
        (enter.to_array(), met)
    }
}
