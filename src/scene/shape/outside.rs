//! Which places on four rays lie clearly outside of a solid: where one does, no end of the solid's span is needed to know
//! that the solid does not take it away.

use super::packet::{RayPacket, across, add, dot, scale, splat, sub};
use super::{Cuboid, Shape};
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::Vec3Lanes;
use glam::DVec3;

/// Outside of a solid by this share of its size a point is outside by any rounding, if neither the point nor the start of
/// its ray is farther away than [`NEAR_ENOUGH`]: roundings are shares of the way.
const CLEARLY: f64 = 1e-6;
/// In sizes of a solid.
const NEAR_ENOUGH: f64 = 1e6;

impl Shape {
    /// Which places at `t` on four rays lie clearly outside; nothing is known of those that are not.
    #[inline(always)]
    pub(crate) fn four_clear<F: F64Lanes>(&self, rays: &RayPacket<F>, t: F) -> F::Mask {
        match self {
            Shape::Sphere(sphere) => {
                let (p, place) = seen_from(rays, t, sphere.centre);
                let size = sphere.radius;
                F::splat(size * size * (1.0 + CLEARLY)).lt(dot(place, place))
                    & are_near(p, place, size)
            }
            Shape::Cylinder(cylinder) => {
                let (base, unit, size) = cylinder.rod();
                let (p, place) = seen_from(rays, t, base);
                let aside = across(splat(unit), place);
                let is_beside = F::splat(size * size * (1.0 + CLEARLY)).lt(dot(aside, aside));
                is_beside & are_near(p, place, size)
            }
            Shape::Cuboid(Cuboid { min, max }) => {
                let (p, place) = seen_from(rays, t, *min);
                let size = (*max - *min).max_element();
                let (below, above) = (-CLEARLY * size, *max - *min + CLEARLY * size);
                let is_beside = |axis: usize| {
                    let place = place[axis];
                    let is_above = F::splat(above[axis]).lt(place);
                    place.lt(F::splat(below)) | is_above
                };
                let is_beside = (is_beside(0) | is_beside(1)) | is_beside(2);
                is_beside & are_near(p, place, size)
            }
            _ => F::mask_from_bits(0),
        }
    }
}

/// Where four rays start, and where they are at `t`, both from a point.
#[inline(always)]
fn seen_from<F: F64Lanes>(rays: &RayPacket<F>, t: F, from: DVec3) -> (Vec3Lanes<F>, Vec3Lanes<F>) {
    let p = sub(rays.origin, splat(from));
    (p, add(p, scale(rays.dir, t)))
}

/// Whether four rays start, and places on them lie, near enough to a solid of this size for [`CLEARLY`] to hold.
#[inline(always)]
fn are_near<F: F64Lanes>(start: Vec3Lanes<F>, place: Vec3Lanes<F>, size: f64) -> F::Mask {
    let limit = F::splat(NEAR_ENOUGH * size);
    let farther = dot(start, start).lane_max(dot(place, place));
    // Not a number is not near: it comes out of `larger` if it is the second, and the start is a number.
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

    /// Asks which places on four rays lie clearly outside.
    #[derive(Clone, Copy)]
    struct Clear<'a> {
        shape: &'a Shape,
        rays: [Ray; 4],
        t: [f64; 4],
    }

    impl SimdKernel for Clear<'_> {
        type Output = u32;

        fn run<F: F64Lanes>(self) -> u32 {
            F::bitmask(
                self.shape
                    .four_clear(&RayPacket::<F>::of_each(&self.rays), F::from_array(&self.t)),
            )
        }
    }

    #[test]
    fn what_lies_clearly_outside_lies_outside() {
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
                    root.map_or_else(|| 2.0 * rng.share(), |root| root.t)
                });
                let asked = Clear { shape, rays, t };
                let found = SimdLevel::widest().run(asked);
                assert_eq!(found, SimdLevel::NARROW.run(asked));
                for lane in 0..4 {
                    let ray = &rays[lane];
                    let is_inside = shape.contains(ray.at(t[lane]));
                    roots.clear();
                    shape.roots(ray, &mut roots);
                    let is_at_root = roots.iter().any(|root| root.t == t[lane]);
                    if found >> lane & 1 == 1 {
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
