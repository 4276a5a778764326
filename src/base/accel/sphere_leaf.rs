//! Leaves of balls: up to eight side by side, and a ray made ready for them.
//!
//! Where all that a node would hold are balls, their centres and radii take half the memory of their boxes and say more:
//! of two rays that meet the box of a ball one misses the ball. As with boxes every doubt is in favour of being met.

use super::bounding_sphere::BoundingSphere;
use super::node::{Aabb32, FrameRay, WIDTH, larger};
use super::packet::DOUBT;
use crate::base::math::simd::{Eight, Kernel, SimdLevel, eight};

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
        eight(
            lanes,
            &RayAndSphereLeaf {
                ray,
                block,
                from,
                to,
            },
        )
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

impl Kernel for RayAndSphereLeaf<'_> {
    type Answer = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<E: Eight>(&self) -> ([f32; WIDTH], u32) {
        let (ray, block) = (self.ray, self.block);
        let [x, y, z] = &block.centre;
        let x = E::load(x).minus(E::all(ray.middle[0]));
        let y = E::load(y).minus(E::all(ray.middle[1]));
        let z = E::load(z).minus(E::all(ray.middle[2]));
        let [u, v, w] = [E::all(ray.dir[0]), E::all(ray.dir[1]), E::all(ray.dir[2])];
        let doubt = x
            .size()
            .plus(y.size())
            .plus(z.size())
            .times(E::all(2.0 * DOUBT));
        let doubt = doubt.plus(E::all(ray.slack));
        let radius = E::load(&block.radius).plus(doubt);
        // Balls are tried at the size of the direction: that saves a division.
        let along = x.times(u).plus(y.times(v)).plus(z.times(w));
        let a = y.times(w).minus(z.times(v));
        let b = z.times(u).minus(x.times(w));
        let c = x.times(v).minus(y.times(u));
        let off = a.times(a).plus(b.times(b)).plus(c.times(c));
        let reach = radius.times(radius).times(E::all(ray.speed_sq));
        // Where both are without end, their difference is not a number and counts as nothing: such a ball is out of reach.
        let half = reach.minus(off).larger(E::all(0.0)).root();
        let per_speed_sq = E::all(1.0 / ray.speed_sq);
        let enter = along.minus(half).times(per_speed_sq).minus(doubt);
        let leave = along.plus(half).times(per_speed_sq).plus(doubt);
        let met = E::all(0.0).not_above(radius)
            & off.not_above(reach)
            & enter.not_above(E::all(self.to))
            & E::all(self.from).not_above(leave);
        (enter.store(), met)
    }
}
