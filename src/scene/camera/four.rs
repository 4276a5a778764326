//! The rays of four points of a picture at once: of flat pictures, to the bit those of [`Camera::primary_ray`].

use super::perspective::NOISE;
use super::{Camera, Frame, Projection};
use crate::base::math::simd::vec3::{Vec3Lanes, abs, add, dot, scale, splat, to_arrays};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, SimdLevel};

/// The directions of four rays.
type FourDirs = [[f64; 4]; 3];

/// Points of a picture, four by four: columns and rows.
struct Points<'a, T> {
    frame: &'a Frame,
    places: &'a [(f64, f64)],
    width: f64,
    height: f64,
    take: T,
}

impl<T: FnMut(usize, FourDirs)> SimdKernel for Points<'_, T> {
    type Output = bool;

    /// Hands the directions to `take`; false as soon as one needs care.
    #[inline(always)]
    fn run<F: F64x4>(mut self) -> bool {
        for (number, places) in self.places.chunks(4).enumerate() {
            let (mut x, mut y) = ([0.0; 4], [0.0; 4]);
            for lane in 0..4 {
                (x[lane], y[lane]) = places[lane.min(places.len() - 1)];
            }
            let (dir, is_sure) = self.dirs(F::from_array(&x), F::from_array(&y));
            if F::bitmask(is_sure) != 0b1111 {
                return false;
            }
            (self.take)(number, to_arrays(dir));
        }
        true
    }
}

impl<T> Points<'_, T> {
    /// The directions, and which of them need no care.
    #[inline(always)]
    fn dirs<F: F64Lanes>(&self, x: F, y: F) -> (Vec3Lanes<F>, F::Mask) {
        let half = F::splat(0.5);
        let (width, height) = (F::splat(self.width), F::splat(self.height));
        let u = (x + half) / width - half;
        let down = y - half;
        let v = (F::splat(self.height - 1.0) - down) / height - half;
        let right = scale(splat(self.frame.right), u);
        let up = scale(splat(self.frame.up), v);
        let dir = add(add(splat(self.frame.direction), right), up);
        let terms = add(add(abs(splat(self.frame.direction)), abs(right)), abs(up));
        let noise = scale(terms, F::splat(NOISE));
        let dir = [
            F::select(dir[0].abs().lt(noise[0]), F::splat(0.0), dir[0]),
            F::select(dir[1].abs().lt(noise[1]), F::splat(0.0), dir[1]),
            F::select(dir[2].abs().lt(noise[2]), F::splat(0.0), dir[2]),
        ];
        let length = dot(dir, dir).sqrt();
        let is_normal = F::splat(f64::MIN_POSITIVE).le(length) & length.lt(F::splat(f64::INFINITY));
        (scale(dir, F::splat(1.0) / length), is_normal)
    }
}

impl Camera {
    /// Hands the unit directions of the rays through points of a picture of this width and height, which start at
    /// [`Camera::location`], to `take`, four by four with their number; where there are fewer the last stands again. False
    /// where they must be asked for singly.
    #[inline(always)]
    pub(crate) fn aim_all(
        &self,
        lanes: SimdLevel,
        places: &[(f64, f64)],
        (width, height): (u32, u32),
        take: impl FnMut(usize, FourDirs),
    ) -> bool {
        if self.projection != Projection::Perspective || self.bumps.is_some() {
            return false;
        }
        let points = Points {
            frame: &self.frame,
            places,
            width: f64::from(width),
            height: f64::from(height),
            take,
        };
        lanes.run(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use glam::DVec3;

    /// The directions at four points.
    fn dirs(
        camera: &Camera,
        lanes: SimdLevel,
        (x, y): (&[f64; 4], &[f64; 4]),
        size: (u32, u32),
    ) -> Option<FourDirs> {
        let mut dirs = FourDirs::default();
        let places = [0, 1, 2, 3].map(|lane| (x[lane], y[lane]));
        let are_sure = camera.aim_all(lanes, &places, size, |_, four| dirs = four);
        are_sure.then_some(dirs)
    }

    #[test]
    fn four_rays_are_those_of_each() {
        let mut rng = Random::new(8);
        let mut camera = Camera::default();
        for case in 0..1000 {
            let mut vector = || DVec3::from([0; 3].map(|_| rng.share() - 0.5));
            camera.frame.direction = vector();
            camera.frame.right = vector();
            camera.frame.up = vector();
            let x = [0.0, 1.25, 2.0, 800.0];
            let y = [f64::from(case), 0.75, -0.5, 3.0];
            for lanes in [SimdLevel::widest(), SimdLevel::NARROW] {
                let found = dirs(&camera, lanes, (&x, &y), (801, 604)).unwrap();
                for lane in 0..4 {
                    let ray = camera.primary_ray(x[lane], y[lane], 801, 604).unwrap();
                    let dir = DVec3::new(found[0][lane], found[1][lane], found[2][lane]);
                    assert_eq!(dir, ray.dir);
                }
            }
        }
    }

    #[test]
    fn what_rounding_leaves_of_a_direction_is_nothing() {
        let text = "{ location <0, 1, -5> look_at 0 }";
        let camera =
            Camera::read(&mut TextArgs::new(text), &Camera::default()).expect("it is a camera");
        // Corners of pixels on the horizon.
        let (x, y) = ([0.5, 1.5, 2.5, 20.0], [35.5; 4]);
        let ray = camera.primary_ray(x[0], y[0], 160, 120).expect("a ray");
        assert_eq!(ray.dir.y, 0.0);
        for lanes in [SimdLevel::widest(), SimdLevel::NARROW] {
            let found = dirs(&camera, lanes, (&x, &y), (160, 120)).unwrap();
            assert_eq!(found[1], [0.0; 4]);
            assert_eq!(found[0][0], ray.dir.x);
        }
    }

    #[test]
    fn other_cameras_are_asked_singly() {
        let camera = Camera {
            projection: Projection::Fisheye,
            ..Camera::default()
        };
        let at = [0.0; 4];
        assert_eq!(
            dirs(&camera, SimdLevel::widest(), (&at, &at), (10, 10)),
            None
        );
        let mut camera = Camera::default();
        camera.frame.direction = DVec3::ZERO;
        camera.frame.right = DVec3::ZERO;
        camera.frame.up = DVec3::ZERO;
        assert_eq!(
            dirs(&camera, SimdLevel::widest(), (&at, &at), (10, 10)),
            None
        );
    }
}
