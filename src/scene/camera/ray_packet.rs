//! Ray packets of perspective cameras: directions of four rays at a time, bit for bit those of [`Camera::primary_ray`].

use super::perspective::NOISE;
use super::{Camera, Frame, Projection};
use crate::base::math::conditioning::Normalization;
use crate::base::math::simd::vec3::{Vec3Lanes, abs, add, dot, scale, splat, to_arrays};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, SimdLevel};

/// The directions of four rays, by axis and lane.
type DirPacket = [[f64; 4]; 3];

/// Kernel that computes the ray directions of pixel positions, four at a time.
struct DirKernel<'a, T> {
    frame: &'a Frame,
    normalization: Normalization,
    /// Column and row of each position.
    positions: &'a [(f64, f64)],
    width: f64,
    height: f64,
    take: T,
}

impl<T: FnMut(usize, DirPacket)> SimdKernel for DirKernel<'_, T> {
    type Output = bool;

    /// Passes the directions to `take`; false as soon as one lane needs the scalar path.
    #[inline(always)]
    fn run<F: F64x4>(mut self) -> bool {
        for (packet, positions) in self.positions.chunks(4).enumerate() {
            let (mut x, mut y) = ([0.0; 4], [0.0; 4]);
            for lane in 0..4 {
                (x[lane], y[lane]) = positions[lane.min(positions.len() - 1)];
            }
            let (dir, is_valid) = self.dirs(F::from_array(&x), F::from_array(&y));
            if F::bitmask(is_valid) != 0b1111 {
                return false;
            }
            (self.take)(packet, to_arrays(dir));
        }
        true
    }
}

impl<T> DirKernel<'_, T> {
    /// The unit directions, and the mask of the lanes whose length is normal.
    #[inline(always)]
    fn dirs<F: F64Lanes>(&self, x: F, y: F) -> (Vec3Lanes<F>, F::Mask) {
        let half = F::splat(0.5);
        let (width, height) = (F::splat(self.width), F::splat(self.height));
        let u = (x + half) / width - half;
        let v = match self.normalization {
            Normalization::Reciprocal => {
                let down = y - half;
                (F::splat(self.height - 1.0) - down) / height - half
            }
            Normalization::Quotient => half - (y + half) / height,
        };
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
        let dir = match self.normalization {
            Normalization::Reciprocal => scale(dir, F::splat(1.0) / length),
            Normalization::Quotient => dir.map(|component| component / length),
        };
        (dir, is_normal)
    }
}

impl Camera {
    /// Computes the unit directions of the rays through positions of an image of this width and height; all of these
    /// rays start at [`Camera::location`]. `take` receives them four at a time, with the index of the packet; the last
    /// packet is filled up with its last ray. False where the caller must use [`Camera::primary_ray`] instead.
    #[inline(always)]
    pub(crate) fn for_each_dir_packet(
        &self,
        lanes: SimdLevel,
        positions: &[(f64, f64)],
        (width, height): (u32, u32),
        take: impl FnMut(usize, DirPacket),
    ) -> bool {
        if self.projection != Projection::Perspective || self.bumps.is_some() {
            return false;
        }
        let kernel = DirKernel {
            frame: &self.frame,
            normalization: self.normalization,
            positions,
            width: f64::from(width),
            height: f64::from(height),
            take,
        };
        lanes.run(kernel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use glam::DVec3;

    /// The directions at four positions.
    fn dirs(
        camera: &Camera,
        lanes: SimdLevel,
        x: &[f64; 4],
        y: &[f64; 4],
        size: (u32, u32),
    ) -> Option<DirPacket> {
        let mut dirs = DirPacket::default();
        let positions = [0, 1, 2, 3].map(|lane| (x[lane], y[lane]));
        let are_valid =
            camera.for_each_dir_packet(lanes, &positions, size, |_, packet| dirs = packet);
        are_valid.then_some(dirs)
    }

    #[test]
    fn packets_have_the_directions_of_each_ray() {
        let mut rng = Random::new(8);
        let mut camera = Camera::default();
        for case in 0..1000 {
            let mut vector = || DVec3::from([0; 3].map(|_| rng.uniform() - 0.5));
            camera.frame.direction = vector();
            camera.frame.right = vector();
            camera.frame.up = vector();
            camera.normalization = Normalization::of_version(case % 2 == 1);
            let x = [0.0, 1.25, 2.0, 800.0];
            let y = [f64::from(case), 0.75, -0.5, 3.0];
            for lanes in [SimdLevel::widest(), SimdLevel::NARROW] {
                let packet = dirs(&camera, lanes, &x, &y, (801, 604)).unwrap();
                for lane in 0..4 {
                    let ray = camera.primary_ray(x[lane], y[lane], 801, 604).unwrap();
                    let dir = DVec3::new(packet[0][lane], packet[1][lane], packet[2][lane]);
                    assert_eq!(dir, ray.dir);
                }
            }
        }
    }

    #[test]
    fn rounding_errors_of_a_direction_are_set_to_zero() {
        let text = "{ location <0, 1, -5> look_at 0 }";
        let camera =
            Camera::read(&mut TextArgs::new(text), &Camera::default()).expect("it is a camera");
        // Corners of pixels on the horizon.
        let (x, y) = ([0.5, 1.5, 2.5, 20.0], [35.5; 4]);
        let ray = camera.primary_ray(x[0], y[0], 160, 120).expect("a ray");
        assert_eq!(ray.dir.y, 0.0);
        for lanes in [SimdLevel::widest(), SimdLevel::NARROW] {
            let packet = dirs(&camera, lanes, &x, &y, (160, 120)).unwrap();
            assert_eq!(packet[1], [0.0; 4]);
            assert_eq!(packet[0][0], ray.dir.x);
        }
    }

    #[test]
    fn other_cameras_need_the_scalar_path() {
        let camera = Camera {
            projection: Projection::Fisheye,
            ..Camera::default()
        };
        let at = [0.0; 4];
        assert_eq!(dirs(&camera, SimdLevel::widest(), &at, &at, (10, 10)), None);
        let mut camera = Camera::default();
        camera.frame.direction = DVec3::ZERO;
        camera.frame.right = DVec3::ZERO;
        camera.frame.up = DVec3::ZERO;
        assert_eq!(dirs(&camera, SimdLevel::widest(), &at, &at, (10, 10)), None);
    }
}
