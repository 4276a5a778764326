//! A few round things close together, tried against a ray all at once: what a copy of a small union holds. A tree over so
//! few would cost a ray more than they do.
//!
//! Balls stand in single precision about the middle of all, and the ray is brought near that first, so that nothing
//! large cancels; every doubt is in favour of being met.

use crate::base::math::rounding::{loose_above, loose_below, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// More than so many are better kept in a tree.
pub(super) const MOST: usize = 32;
/// How many are tried at once.
const LANES: usize = 8;
/// Above the error of distances here, in sizes of the whole.
const DOUBT: f32 = 4e-6;
/// From farther away, in sizes of the whole, double precision tells less than [`DOUBT`].
const FARTHEST: f64 = 1e6;

/// Up to [`MOST`] balls.
#[derive(Debug)]
pub(super) struct SphereSoa {
    middle: DVec3,
    /// Of a ball around all.
    radius: f64,
    balls: Vec<Spheres8>,
}

/// Eight balls in units of the radius of the whole. In unused places there is none: its radius is no number.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Spheres8 {
    centre: [[f32; LANES]; 3],
    radius: [f32; LANES],
}

/// Eight balls and the line through a point along a unit direction, from one place on it to another.
struct LineAndSpheres<'a> {
    balls: &'a Spheres8,
    point: [f32; 3],
    dir: [f32; 3],
    from: f32,
    to: f32,
}

impl SimdKernel for LineAndSpheres<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        // Spelt out: a closure would not take part in the wide lanes.
        let ([x, y, z], p) = (&self.balls.centre, &self.point);
        let [x, y, z] = [
            <F::F32>::from_array(x) - <F::F32>::splat(p[0]),
            <F::F32>::from_array(y) - <F::F32>::splat(p[1]),
            <F::F32>::from_array(z) - <F::F32>::splat(p[2]),
        ];
        let radius = <F::F32>::from_array(&self.balls.radius);
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
    /// So many balls, by centre and radius; `None` if there are none or too many, or if something is no ball.
    pub(super) fn new(count: usize, ball: impl Fn(usize) -> Option<(DVec3, f64)>) -> Option<Self> {
        if !(1..=MOST).contains(&count) {
            return None;
        }
        let balls: Vec<(DVec3, f64)> = (0..count).map(ball).collect::<Option<_>>()?;
        let whole = balls.iter().fold(Bounds::EMPTY, |whole, (centre, radius)| {
            whole.union(&Bounds::new(*centre - *radius, *centre + *radius))
        });
        let middle = 0.5 * whole.min + 0.5 * whole.max;
        let reach = |(centre, radius): &(DVec3, f64)| (*centre - middle).length() + radius;
        let radius = balls.iter().map(reach).fold(0.0, f64::max);
        let is_plain = radius.is_normal() && (1.0 / radius).is_normal();
        // Roundings of the middles must be as nothing.
        if !is_plain || middle.abs().max_element() > FARTHEST * radius {
            return None;
        }
        let mut eights = Vec::new();
        for balls in balls.chunks(LANES) {
            let mut eight = Spheres8 {
                centre: [[0.0; LANES]; 3],
                radius: [f32::NAN; LANES],
            };
            for (place, (centre, own)) in balls.iter().enumerate() {
                let centre = (*centre - middle) / radius;
                for axis in 0..3 {
                    eight.centre[axis][place] = nearest(centre[axis]);
                }
                eight.radius[place] = loose_above(own / radius) + DOUBT;
            }
            eights.push(eight);
        }
        Some(SphereSoa {
            middle,
            radius,
            balls: eights,
        })
    }

    /// Visits the places of what a ray may meet between its start and `far`, until `visit` says to stop. Says whether
    /// it can tell; otherwise nothing has been visited.
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
        let is_told = origin.dot(origin) < farthest * farthest
            && dir_sq.is_normal()
            && limit_sq.is_normal()
            && !off_sq.is_nan();
        if !is_told {
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
        for (number, balls) in (0u32..).zip(&self.balls) {
            let asked = LineAndSpheres {
                balls,
                point,
                dir,
                from,
                to,
            };
            let mut met = lanes.run(asked);
            while met != 0 {
                let place = met.trailing_zeros();
                met &= met - 1;
                if visit(8 * number + place) {
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
    use crate::base::math::roots::ray_sphere::ball_chord;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::with_widest;

    #[test]
    fn every_ball_that_a_ray_meets_is_visited_and_few_others() {
        let mut rng = Random::new(51);
        for (size, at) in [
            (1.0, DVec3::ZERO),
            (1e-20, DVec3::ZERO),
            (1e9, DVec3::splat(3e10)),
        ] {
            let balls: Vec<(DVec3, f64)> = (0..20)
                .map(|_| (at + rng.vector(size), size * (0.01 + 0.2 * rng.share())))
                .collect();
            let ball = |place: usize| Some(balls[place]);
            let cluster = SphereSoa::new(balls.len(), ball).unwrap();
            let (mut met, mut visits) = (0, 0);
            for round in 0..4000 {
                let origin = at + rng.vector(size * [2.0, 0.5, 1000.0][round % 3]);
                let aim = at + rng.vector(size);
                let ray = Ray::new(origin, (aim - origin) * [1.0, 1e-3, 20.0][round / 3 % 3]);
                let far = [f64::INFINITY, 0.5 / ray.dir.length() * size][round % 2];
                let mut visited = [false; 20];
                let is_told = with_widest(
                    #[inline(always)]
                    |lanes| {
                        cluster.each(lanes, &ray, far, |place| {
                            visited[place as usize] = true;
                            false
                        })
                    },
                );
                assert!(is_told);
                for (&(centre, radius), visited) in balls.iter().zip(visited) {
                    let chord = ball_chord(ray.origin - centre, ray.dir, radius);
                    let is_met = chord.is_some_and(|(enter, leave)| leave >= 0.0 && enter <= far);
                    assert!(visited || !is_met, "{ray:?} {centre} {radius}");
                    met += usize::from(is_met);
                    visits += usize::from(visited);
                }
            }
            assert!(met > 200 && visits < met + met / 2, "{met} {visits}");
        }
    }

    #[test]
    fn a_ray_without_direction_is_left_to_the_tree() {
        let ball = |_| Some((DVec3::ZERO, 1.0));
        let cluster = SphereSoa::new(1, ball).unwrap();
        let ray = Ray::new(DVec3::X, DVec3::ZERO);
        assert!(!cluster.each(SimdLevel::NARROW, &ray, 1.0, |_| false));
        assert!(SphereSoa::new(MOST + 1, ball).is_none());
        assert!(SphereSoa::new(0, ball).is_none());
        assert!(SphereSoa::new(2, |_| None).is_none());
    }
}
