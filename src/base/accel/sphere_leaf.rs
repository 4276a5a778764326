//! Sphere leaves: up to eight spheres side by side, and their intersection test.
//!
//! Where a node would hold nothing but spheres, their centres and radii take half the memory of their boxes and cull
//! more: of two rays that hit the box of a sphere one misses the sphere. As with boxes, the tests are conservative.

use super::bounding_sphere::BoundingSphere;
use super::node::{Aabb32, FrameRay, WIDTH, max_f32};
use super::packet::REL_ERROR;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};

/// Eight spheres in the frame of the tree. The radius of an unused slot is negative, so that no ray hits it.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct SphereLeaf {
    pub(super) centre: [[f32; WIDTH]; 3],
    pub(super) radius: [f32; WIDTH],
}

/// Relative bound on the error of the centre and the radius that come from halving and rounding the ends of a box.
const BOX_ERROR: f32 = 2.0 * f32::EPSILON;

impl SphereLeaf {
    pub(super) const EMPTY: SphereLeaf = SphereLeaf {
        centre: [[0.0; WIDTH]; 3],
        radius: [f32::NEG_INFINITY; WIDTH],
    };

    /// Sets a slot to the sphere that touches all sides of a box, which is a cube.
    pub(super) fn set(&mut self, slot: usize, aabb: &Aabb32) {
        let mut radius = 0.0;
        for (axis, centre) in self.centre.iter_mut().enumerate() {
            let (low, high) = (aabb.low[axis], aabb.high[axis]);
            centre[slot] = 0.5 * low + 0.5 * high;
            let error = BOX_ERROR * max_f32(low.abs(), high.abs()) + f32::MIN_POSITIVE;
            radius = max_f32(0.5 * high - 0.5 * low + error, radius);
        }
        self.radius[slot] = radius;
    }

    /// Number of its spheres, which are in its first slots.
    pub(super) fn count(&self) -> usize {
        self.radius.iter().filter(|&&radius| radius >= 0.0).count()
    }

    /// One of the spheres.
    #[inline(always)]
    pub(super) fn sphere(&self, slot: usize) -> BoundingSphere {
        let [x, y, z] = &self.centre;
        BoundingSphere::filled([x[slot], y[slot], z[slot]], self.radius[slot])
    }

    /// Where the ray enters each sphere at the earliest, and a mask of the spheres that it may hit between `from` and
    /// `to`.
    #[inline(always)]
    pub(super) fn intersect(
        &self,
        lanes: SimdLevel,
        ray: &FrameRay,
        from: f32,
        to: f32,
    ) -> ([f32; WIDTH], u32) {
        let leaf = self;
        lanes.run(RayAndSphereLeaf {
            ray,
            leaf,
            from,
            to,
        })
    }

    /// Mask of the spheres that may overlap a box.
    pub(super) fn overlap(&self, aabb: &Aabb32) -> u32 {
        let mut shared = 0;
        for slot in 0..self.count() {
            let sphere = self.sphere(slot).aabb();
            let is_shared = |axis: usize| {
                sphere.low[axis] <= aabb.high[axis] && aabb.low[axis] <= sphere.high[axis]
            };
            shared |= u32::from((0..3).all(is_shared)) << slot;
        }
        shared
    }
}

/// Intersection test of a ray, between two of its parameters, with the spheres of a leaf.
struct RayAndSphereLeaf<'a> {
    ray: &'a FrameRay,
    leaf: &'a SphereLeaf,
    from: f32,
    to: f32,
}

impl SimdKernel for RayAndSphereLeaf<'_> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; WIDTH], u32) {
        let (ray, leaf) = (self.ray, self.leaf);
        let [x, y, z] = &leaf.centre;
        let x = <F::F32>::from_array(x) - <F::F32>::splat(ray.middle[0]);
        let y = <F::F32>::from_array(y) - <F::F32>::splat(ray.middle[1]);
        let z = <F::F32>::from_array(z) - <F::F32>::splat(ray.middle[2]);
        let [u, v, w] = [
            <F::F32>::splat(ray.dir[0]),
            <F::F32>::splat(ray.dir[1]),
            <F::F32>::splat(ray.dir[2]),
        ];
        let error = (x.abs() + y.abs() + z.abs()) * <F::F32>::splat(2.0 * REL_ERROR);
        let error = error + <F::F32>::splat(ray.slack);
        let radius = <F::F32>::from_array(&leaf.radius) + error;
        // The spheres are tested without normalizing the direction, which saves a division.
        let along = x * u + y * v + z * w;
        let a = y * w - z * v;
        let b = z * u - x * w;
        let c = x * v - y * u;
        let off = a * a + b * b + c * c;
        let reach = radius * radius * <F::F32>::splat(ray.speed_sq);
        // If both are infinite their difference is NaN and counts as zero: the sphere is missed.
        let half = (reach - off).lane_max(<F::F32>::splat(0.0)).sqrt();
        let per_speed_sq = <F::F32>::splat(1.0 / ray.speed_sq);
        let enter = (along - half) * per_speed_sq - error;
        let leave = (along + half) * per_speed_sq + error;
        let hits = <F::F32>::splat(0.0).le(radius)
            & off.le(reach)
            & enter.le(<F::F32>::splat(self.to))
            & <F::F32>::splat(self.from).le(leave);
        (enter.to_array(), hits)
    }
}
