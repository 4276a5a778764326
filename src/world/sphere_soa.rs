//! Structure of arrays for up to 32 spheres close together, the content of a small shared union. Testing all of them
//! costs a ray less than a BVH over so few would.
//!
//! The spheres are stored in single precision relative to their common centre, and the ray is first advanced to near
//! that point, so that nothing large cancels; tests are conservative.

use crate::base::math::rounding::{loose_above, loose_below, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Larger sets are better stored in a BVH.
pub(super) const MAX_SPHERES: usize = 32;
/// SIMD width.
const LANES: usize = 8;
/// Upper bound on the error of distances here, relative to the radius of the whole.
const DOUBT: f32 = 4e-6;
/// Distance, in radii of the whole, beyond which double precision is less exact than [`DOUBT`].
const FARTHEST: f64 = 1e6;

/// Up to [`MOST`] spheres.
#[derive(Debug)]
pub(super) struct SphereSoa {
    middle: DVec3,
    /// Radius of a bounding sphere.
    radius: f64,
    spheres: Vec<Spheres8>,
}

/// Eight spheres in units of the radius of the whole. Unused lanes have the radius NaN.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Spheres8 {
    centre: [[f32; LANES]; 3],
    radius: [f32; LANES],
}

/// Eight spheres, and a segment of the line through `point` along the unit direction `dir`.
struct LineAndSpheres<'a> {
    spheres: &'a Spheres8,
    point: [f32; 3],
    dir: [f32; 3],
    from: f32,
    to: f32,
}

impl SimdKernel for LineAndSpheres<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        // Spelt out: a closure would not be compiled for the wide lanes.
        let ([x, y, z], p) = (&self.spheres.centre, &self.point);
        let [x, y, z] = [
            <F::F32>::from_array(x) - <F::F32>::splat(p[0]),
            <F::F32>::from_array(y) - <F::F32>::splat(p[1]),
            <F::F32>::from_array(z) - <F::F32>::splat(p[2]),
        ];
        let radius = <F::F32>::from_array(&self.spheres.radius);
        let [a, b, c] = [
            <F::F32>::splat(self.dir[0]),
            <F::F32>::splat(self.dir[1]),
            <F::F32>::splat(self.dir[2]),
        ];
        let [u, v, w] = [b * z - c * y, c * x - a * z, a * y - b * x];
        let off_sq = u * u + v * v + w * w;
        let along = a * x + b * y + c * z;
        off_sq.le(radius * radius)
            & <F::F32>::splat(self.from).le(along + radius)
            & (along - radius).le(<F::F32>::splat(self.to))
    }
}

impl SphereSoa {
    /// Spheres by centre and radius; `None` if there are none or too many, or if some item is not a sphere.
    pub(super) fn new(
        count: usize,
        sphere: impl Fn(usize) -> Option<(DVec3, f64)>,
    ) -> Option<Self> {
        if !(1..=MAX_SPHERES).contains(&count) {
            return None;
        }
        let spheres: Vec<(DVec3, f64)> = (0..count).map(sphere).collect::<Option<_>>()?;
        let whole = spheres
            .iter()
            .fold(Bounds::EMPTY, |whole, (centre, radius)| {
                whole.union(&Bounds::new(*centre - *radius, *centre + *radius))
            });
        let middle = 0.5 * whole.min + 0.5 * whole.max;
        let extent = |(centre, radius): &(DVec3, f64)| (*centre - middle).length() + radius;
        let radius = spheres.iter().map(extent).fold(0.0, f64::max);
        let is_plain = radius.is_normal() && (1.0 / radius).is_normal();
        // The rounding of the centres must be negligible.
        if !is_plain || middle.abs().max_element() > FARTHEST * radius {
            return None;
        }
        let mut packets = Vec::new();
        for spheres in spheres.chunks(LANES) {
            let mut packet = Spheres8 {
                centre: [[0.0; LANES]; 3],
                radius: [f32::NAN; LANES],
            };
            for (lane, (centre, own)) in spheres.iter().enumerate() {
                let centre = (*centre - middle) / radius;
                for axis in 0..3 {
                    packet.centre[axis][lane] = nearest(centre[axis]);
                }
                packet.radius[lane] = loose_above(own / radius) + DOUBT;
            }
            packets.push(packet);
        }
        Some(SphereSoa {
            middle,
            radius,
            spheres: packets,
        })
    }

    /// Visits the indices of the spheres that a ray may hit between its origin and `far`, until `visit` returns true.
    /// Returns false, before any visit, if precision does not suffice.
    #[inline(always)]
    pub(super) fn each(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        far: f64,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let origin = ray.origin - self.middle;
        let dir_sq = ray.dir.dot(ray.dir);
        let nearest_at = -origin.dot(ray.dir) / dir_sq;
        let point = origin + nearest_at * ray.dir;
        let off_sq = point.dot(point);
        let limit = self.radius * (1.0 + f64::from(DOUBT));
        let limit_sq = limit * limit;
        let farthest = FARTHEST * self.radius;
        let is_decided = origin.dot(origin) < farthest * farthest
            && dir_sq.is_normal()
            && limit_sq.is_normal()
            && !off_sq.is_nan();
        if !is_decided {
            return false;
        }
        if off_sq > limit_sq {
            return true;
        }
        let length = dir_sq.sqrt() / self.radius;
        let (point, dir) = (point / self.radius, ray.dir / dir_sq.sqrt());
        let point = [nearest(point.x), nearest(point.y), nearest(point.z)];
        let dir = [nearest(dir.x), nearest(dir.y), nearest(dir.z)];
        let from = loose_below(-nearest_at * length) - DOUBT;
        let to = loose_above((far - nearest_at) * length) + DOUBT;
        for (number, spheres) in (0u32..).zip(&self.spheres) {
            let test = LineAndSpheres {
                spheres,
                point,
                dir,
                from,
                to,
            };
            let mut hits = lanes.run(test);
            while hits != 0 {
                let lane = hits.trailing_zeros();
                hits &= hits - 1;
                if visit(8 * number + lane) {
                    return true;
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::roots::ray_sphere::sphere_span;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::with_widest;

    #[test]
    fn every_sphere_hit_is_visited_and_not_many_others() {
        let mut rng = Random::new(51);
        for (size, at) in [
            (1.0, DVec3::ZERO),
            (1e-20, DVec3::ZERO),
            (1e9, DVec3::splat(3e10)),
        ] {
            let spheres: Vec<(DVec3, f64)> = (0..20)
                .map(|_| (at + rng.vector(size), size * (0.01 + 0.2 * rng.uniform())))
                .collect();
            let sphere = |index: usize| Some(spheres[index]);
            let cluster = SphereSoa::new(spheres.len(), sphere).unwrap();
            let (mut hits, mut visits) = (0, 0);
            for round in 0..4000 {
                let origin = at + rng.vector(size * [2.0, 0.5, 1000.0][round % 3]);
                let aim = at + rng.vector(size);
                let ray = Ray::new(origin, (aim - origin) * [1.0, 1e-3, 20.0][round / 3 % 3]);
                let far = [f64::INFINITY, 0.5 / ray.dir.length() * size][round % 2];
                let mut visited = [false; 20];
                let is_decided = with_widest(
                    #[inline(always)]
                    |lanes| {
                        cluster.each(lanes, &ray, far, |index| {
                            visited[index as usize] = true;
                            false
                        })
                    },
                );
                assert!(is_decided);
                for (&(centre, radius), visited) in spheres.iter().zip(visited) {
                    let chord = sphere_span(ray.origin - centre, ray.dir, radius);
                    let is_hit = chord.is_some_and(|(enter, leave)| leave >= 0.0 && enter <= far);
                    assert!(visited || !is_hit, "{ray:?} {centre} {radius}");
                    hits += usize::from(is_hit);
                    visits += usize::from(visited);
                }
            }
            assert!(hits > 200 && visits < hits + hits / 2, "{hits} {visits}");
        }
    }

    #[test]
    fn a_ray_without_direction_is_left_to_the_tree() {
        let sphere = |_| Some((DVec3::ZERO, 1.0));
        let cluster = SphereSoa::new(1, sphere).unwrap();
        let ray = Ray::new(DVec3::X, DVec3::ZERO);
        assert!(!cluster.each(SimdLevel::NARROW, &ray, 1.0, |_| false));
        assert!(SphereSoa::new(MAX_SPHERES + 1, sphere).is_none());
        assert!(SphereSoa::new(0, sphere).is_none());
        assert!(SphereSoa::new(2, |_| None).is_none());
    }
}
