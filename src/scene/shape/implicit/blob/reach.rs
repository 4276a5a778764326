//! The balls around the components of a blob: which of them a line may meet, eight at a time in single precision.
//!
//! The line is moved in doubles to where it is nearest to the middle of all, and lengths are counted in units of their
//! size, so that what is worked out is of size 1 and its error far below [`SLACK`].

use super::component::Component;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Components of which one number can tell.
pub(super) const MOST: usize = 64;
const LANES: usize = 8;
/// Above the error of a squared distance from the line, less the square of a radius.
const SLACK: f32 = 1e-4;
/// A line that starts farther away, in units of the size of all, is not known well enough where it is nearest.
const FAR: f64 = 1e6;

/// Eight balls in units of the size of all. The radius of an unused place is no number.
#[derive(Clone, Copy, Debug)]
struct Balls {
    centre: [[f32; LANES]; 3],
    radius_sq: [f32; LANES],
}

/// The balls around up to [`MOST`] components.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    middle: DVec3,
    size: f64,
    balls: Vec<Balls>,
}

/// A line in units of the size of all, from where it is nearest to their middle.
struct Line<'b> {
    balls: &'b [Balls],
    origin: [f32; 3],
    dir: [f32; 3],
}

impl Reach {
    /// `None` where there are too many, or some reach beyond all numbers.
    pub(super) fn new<'c>(
        components: impl ExactSizeIterator<Item = &'c Component>,
    ) -> Option<Self> {
        if components.len() > MOST {
            return None;
        }
        let balls: Vec<_> = components.map(Component::ball).collect();
        let around = balls
            .iter()
            .fold(Bounds::EMPTY, |around, (centre, radius)| {
                around.union(&Bounds::new(centre - *radius, centre + *radius))
            });
        let middle = around.centre();
        let size = (around.max - around.min).max_element();
        let is_sound = middle.is_finite() && size.is_normal() && (1.0 / size).is_normal();
        is_sound.then(|| Reach {
            middle,
            size,
            balls: balls
                .chunks(LANES)
                .map(|balls| Balls::new(balls, middle, size))
                .collect(),
        })
    }

    /// Which components a line may come near, one bit each.
    pub(super) fn met(&self, lanes: SimdLevel, ray: &Ray) -> u64 {
        let origin = (ray.origin - self.middle) / self.size;
        let dir = ray.dir / ray.dir.length();
        let nearest = origin - origin.dot(dir) * dir;
        // Asked in the positive: what is no number is not known.
        let is_known = dir.is_finite() && origin.abs().max_element() < FAR;
        if !is_known {
            return u64::MAX;
        }
        let single = |v: DVec3| v.as_vec3().to_array();
        let line = Line {
            balls: &self.balls,
            origin: single(nearest),
            dir: single(dir),
        };
        !lanes.run(line)
    }
}

impl Balls {
    fn new(balls: &[(DVec3, f64)], middle: DVec3, size: f64) -> Self {
        let mut these = Balls {
            centre: [[0.0; LANES]; 3],
            radius_sq: [f32::NAN; LANES],
        };
        for (place, (centre, radius)) in balls.iter().enumerate() {
            let centre = ((centre - middle) / size).as_vec3();
            for axis in 0..3 {
                these.centre[axis][place] = centre[axis];
            }
            let radius = DVec3::splat(radius / size).as_vec3().x;
            these.radius_sq[place] = radius * radius;
        }
        these
    }
}

impl SimdKernel for Line<'_> {
    type Output = u64;

    /// Which balls are missed.
    #[inline(always)]
    fn run<F: F64x4>(self) -> u64 {
        let [dx, dy, dz] = [
            <F::F32>::splat(self.dir[0]),
            <F::F32>::splat(self.dir[1]),
            <F::F32>::splat(self.dir[2]),
        ];
        let slack = <F::F32>::splat(SLACK);
        let mut missed = 0;
        for (balls, first) in self.balls.iter().zip((0_u32..).step_by(LANES)) {
            let x = <F::F32>::from_array(&balls.centre[0]) - <F::F32>::splat(self.origin[0]);
            let y = <F::F32>::from_array(&balls.centre[1]) - <F::F32>::splat(self.origin[1]);
            let z = <F::F32>::from_array(&balls.centre[2]) - <F::F32>::splat(self.origin[2]);
            let along = x * dx + y * dy + z * dz;
            let away_sq = x * x + y * y + z * z;
            let from_line_sq = away_sq - along * along;
            let reached = <F::F32>::from_array(&balls.radius_sq) + slack;
            missed |= u64::from(reached.le(from_line_sq)) << first;
        }
        missed
    }
}
