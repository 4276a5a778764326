//! Packet test for points that lie clearly outside a solid: if a lane passes, CSG knows without the solid's span that
//! the point is outside of it.

use super::packet::{across, add, dot, scale, splat, sub};
use super::ray_packet::RayPacket;
use super::{Cuboid, Shape};
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::Vec3Lanes;
use glam::DVec3;

/// A point outside a solid by this share of its size is outside whatever the roundings, if neither the point nor the
/// start of its ray is farther away than [`NEAR_ENOUGH`]: rounding errors are proportional to distance.
const CLEARLY: f64 = 1e-6;
/// Distance limit, in sizes of the solid.
const NEAR_ENOUGH: f64 = 1e6;

impl Shape {
    /// Mask of the lanes whose point at `t` lies clearly outside; the others may lie anywhere.
    #[inline(always)]
    pub(crate) fn clearly_outside_packet<F: F64Lanes>(&self, rays: &RayPacket<F>, t: F) -> F::Mask {
        match self {
            Shape::Sphere(sphere) => {
                let (p, point) = relative_to(rays, t, sphere.centre);
                let size = sphere.radius;
                F::splat(size * size * (1.0 + CLEARLY)).lt(dot(point, point))
                    & are_near(p, point, size)
            }
            Shape::Cylinder(cylinder) => {
                let (base, unit, size) = cylinder.axis_and_radius();
                let (p, point) = relative_to(rays, t, base);
                let aside = across(splat(unit), point);
                let is_beside = F::splat(size * size * (1.0 + CLEARLY)).lt(dot(aside, aside));
                is_beside & are_near(p, point, size)
            }
            Shape::Cuboid(Cuboid { min, max }) => {
                let (p, point) = relative_to(rays, t, *min);
                let size = (*max - *min).max_element();
                let (below, above) = (-CLEARLY * size, *max - *min + CLEARLY * size);
                let is_beside = |axis: usize| {
                    let point = point[axis];
                    let is_above = F::splat(above[axis]).lt(point);
                    point.lt(F::splat(below)) | is_above
                };
                let is_beside = (is_beside(0) | is_beside(1)) | is_beside(2);
                is_beside & are_near(p, point, size)
            }
            _ => F::mask_from_bits(0),
        }
    }
}

/// Origins of a ray packet and its points at `t`, both relative to `from`.
#[inline(always)]
fn relative_to<F: F64Lanes>(
    rays: &RayPacket<F>,
    t: F,
    from: DVec3,
) -> (Vec3Lanes<F>, Vec3Lanes<F>) {
    let p = sub(rays.origin, splat(from));
    (p, add(p, scale(rays.dir, t)))
}

/// Mask of the lanes whose origin and point are near enough to a solid of this size for [`CLEARLY`] to hold.
#[inline(always)]
fn are_near<F: F64Lanes>(start: Vec3Lanes<F>, point: Vec3Lanes<F>, size: f64) -> F::Mask {
    let limit = F::splat(NEAR_ENOUGH * size);
    let farther = dot(start, start).lane_max(dot(point, point));
    // NaN counts as far: `lane_max` returns it if it is the second operand, and the start is a number.
    farther.lt(limit * limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Ray;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{SimdKernel, SimdLevel};
    use crate::scene::shape::{Cylinder, Geometry, Sphere};

    /// Tests which points of a ray packet lie clearly outside.
    #[derive(Clone, Copy)]
    struct OutsideKernel<'a> {
        shape: &'a Shape,
        rays: [Ray; 4],
        t: [f64; 4],
    }

    impl SimdKernel for OutsideKernel<'_> {
        type Output = u32;

        fn run<F: F64Lanes>(self) -> u32 {
            F::bitmask(self.shape.clearly_outside_packet(
                &RayPacket::<F>::of_each(&self.rays),
                F::from_array(&self.t),
            ))
        }
    }

    #[test]
    fn points_clearly_outside_are_outside() {
        let read = |text: &str| TextArgs::new(text);
        let shapes = [
            Shape::Sphere(Sphere::read(&mut read("<1, 2, 3>, 1.5")).unwrap()),
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(2.0, 0.5, 3.0))),
            Shape::Cylinder(Cylinder::read(&mut read("<-1, 0.5, 0>, <1, 1, 2>, 0.7")).unwrap()),
        ];
        let mut rng = Random::new(52);
        for shape in &shapes {
            let bounds = shape.bounds();
            let (mut clear, mut inside) = (0, 0);
            for _ in 0..10_000 {
                let rays = [(); 4].map(|()| rng.ray_near(&bounds));
                let mut roots = Vec::new();
                // At the surface, or anywhere.
                let t = rays.map(|ray| {
                    roots.clear();
                    shape.roots(&ray, &mut roots);
                    let root = roots.first().filter(|_| rng.bits() & 1 == 0);
                    root.map_or_else(|| 2.0 * rng.uniform(), |root| root.t)
                });
                let kernel = OutsideKernel { shape, rays, t };
                let outside = SimdLevel::widest().run(kernel);
                assert_eq!(outside, SimdLevel::NARROW.run(kernel));
                for lane in 0..4 {
                    let ray = &rays[lane];
                    let is_inside = shape.contains(ray.at(t[lane]));
                    roots.clear();
                    shape.roots(ray, &mut roots);
                    let is_at_root = roots.iter().any(|root| root.t == t[lane]);
                    if outside >> lane & 1 == 1 {
                        assert!(!is_inside && !is_at_root, "{shape:?} {ray:?} {}", t[lane]);
                        clear += 1;
                    }
                    inside += u32::from(is_inside);
                }
            }
            assert!(
                clear > 10_000 && inside > 1_000,
                "{shape:?} {clear} {inside}"
            );
        }
    }
}
