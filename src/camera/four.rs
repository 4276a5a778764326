//! The rays of four points of a picture at once: of flat pictures, to the bit those of [`Camera::primary_ray`].

use super::perspective::NOISE;
use super::{Camera, Frame, Projection};
use crate::math::lanes::three::{dot, plus, same, scaled, sizes, store};
use crate::math::lanes::{Four, FourKernel, Lanes, four};

/// Four points of a picture: columns and rows.
struct FourPoints<'a> {
    frame: &'a Frame,
    x: &'a [f64; 4],
    y: &'a [f64; 4],
    width: f64,
    height: f64,
}

impl FourKernel for FourPoints<'_> {
    type Answer = ([[f64; 4]; 3], u32);

    /// The directions, and which of them need no care, one bit each.
    #[inline(always)]
    fn run<F: Four>(&self) -> ([[f64; 4]; 3], u32) {
        let half = F::all(0.5);
        let (width, height) = (F::all(self.width), F::all(self.height));
        let u = F::load(self.x).plus(half).over(width).minus(half);
        let down = F::load(self.y).minus(half);
        let v = F::all(self.height - 1.0)
            .minus(down)
            .over(height)
            .minus(half);
        let right = scaled(same(self.frame.right), u);
        let up = scaled(same(self.frame.up), v);
        let dir = plus(plus(same(self.frame.direction), right), up);
        let terms = plus(
            plus(sizes(same(self.frame.direction)), sizes(right)),
            sizes(up),
        );
        let noise = scaled(terms, F::all(NOISE));
        let dir = [
            F::pick(dir[0].size().below(noise[0]), F::all(0.0), dir[0]),
            F::pick(dir[1].size().below(noise[1]), F::all(0.0), dir[1]),
            F::pick(dir[2].size().below(noise[2]), F::all(0.0), dir[2]),
        ];
        let length = dot(dir, dir).root();
        let is_normal = F::both(
            F::all(f64::MIN_POSITIVE).not_above(length),
            length.below(F::all(f64::INFINITY)),
        );
        (
            store(scaled(dir, F::all(1.0).over(length))),
            F::bits(is_normal),
        )
    }
}

impl Camera {
    /// The unit directions of the rays through four points of a picture of this width and height, which start at
    /// [`Camera::location`]; `None` where they must be asked for singly.
    #[inline(always)]
    pub(crate) fn four_dirs(
        &self,
        lanes: Lanes,
        (x, y): (&[f64; 4], &[f64; 4]),
        (width, height): (u32, u32),
    ) -> Option<[[f64; 4]; 3]> {
        if self.projection != Projection::Perspective || self.bumps.is_some() {
            return None;
        }
        let points = FourPoints {
            frame: &self.frame,
            x,
            y,
            width: f64::from(width),
            height: f64::from(height),
        };
        let (dirs, sure) = four(lanes, &points);
        (sure == 0b1111).then_some(dirs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::math::random::Random;
    use glam::DVec3;

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
            for lanes in [Lanes::widest(), Lanes::NARROW] {
                let dirs = camera.four_dirs(lanes, (&x, &y), (801, 604)).unwrap();
                for lane in 0..4 {
                    let ray = camera.primary_ray(x[lane], y[lane], 801, 604).unwrap();
                    let dir = DVec3::new(dirs[0][lane], dirs[1][lane], dirs[2][lane]);
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
        for lanes in [Lanes::widest(), Lanes::NARROW] {
            let dirs = camera.four_dirs(lanes, (&x, &y), (160, 120)).unwrap();
            assert_eq!(dirs[1], [0.0; 4]);
            assert_eq!(dirs[0][0], ray.dir.x);
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
            camera.four_dirs(Lanes::widest(), (&at, &at), (10, 10)),
            None
        );
        let mut camera = Camera::default();
        camera.frame.direction = DVec3::ZERO;
        camera.frame.right = DVec3::ZERO;
        camera.frame.up = DVec3::ZERO;
        assert_eq!(
            camera.four_dirs(Lanes::widest(), (&at, &at), (10, 10)),
            None
        );
    }
}
