//! That a ray does not meet a superellipsoid with hollow sides, by lower bounds of the size.

use super::Superellipsoid;
use super::norms::{norm, norm_and_shares};
use super::rough::{Rough, SLACK};
use crate::base::math::Ray;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use smallvec::SmallVec;

/// The least power for which a rounding of a coordinate, of zero too, moves the size by less than 1e-7.
const LEAST_POWER: f64 = 0.5;
/// A size that is by this much above 1 by its lower bounds is found above 1 in any way.
const MARGIN: f64 = 10.0 * SLACK;

/// Lower bounds of the size at both ends of up to four pieces of a ray on which no coordinate changes sign, such that it
/// is nowhere on a piece below the lower one.
///
/// A norm of numbers that are not negative is concave where its power is at most 1 (Minkowski's inequality reversed), and
/// otherwise convex: then it is nowhere below its tangent at a place of the piece, by which it is replaced. All that is
/// left is concave and grows with each coordinate, so that along a piece it is concave, too.
struct Floors<'s> {
    rough: &'s Rough<'s>,
    /// Of each piece where it begins, where the tangent touches, and where it ends.
    places: [[f64; 4]; 3],
}

impl SimdKernel for Floors<'_> {
    type Output = [[f64; 4]; 2];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [[f64; 4]; 2] {
        let Superellipsoid { across, along } = *self.rough.shape;
        let [from, touch, to] = &self.places;
        let [from, to] = [self.points::<F>(from), self.points::<F>(to)];
        let (mut of_plane, mut of_size) = ([F::splat(1.0); 2], [F::splat(1.0); 2]);
        if across > 1.0 || along > 1.0 {
            let touch = self.points::<F>(touch);
            let ring;
            (ring, of_plane) = norm_and_shares(touch[0], touch[1], across);
            if along > 1.0 {
                (_, of_size) = norm_and_shares(ring, touch[2], along);
            }
        }
        let floors = (of_plane, of_size);
        [self.floor(from, floors), self.floor(to, floors)]
    }
}

impl Floors<'_> {
    #[inline(always)]
    fn points<F: F64Lanes>(&self, t: &[f64; 4]) -> [F; 3] {
        let Ray { origin, dir } = self.rough.ray;
        let t = F::from_array(t);
        [
            (F::splat(origin.x) + t * F::splat(dir.x)).abs(),
            (F::splat(origin.y) + t * F::splat(dir.y)).abs(),
            (F::splat(origin.z) + t * F::splat(dir.z)).abs(),
        ]
    }

    #[inline(always)]
    fn floor<F: F64Lanes>(
        &self,
        [x, y, z]: [F; 3],
        (of_plane, of_size): ([F; 2], [F; 2]),
    ) -> [f64; 4] {
        let Superellipsoid { across, along } = *self.rough.shape;
        let ring = floor_of_norm(x, y, across, of_plane);
        floor_of_norm(ring, z, along, of_size).to_array()
    }
}

/// A norm that is concave, or the tangent with these slopes to one that is convex.
#[inline(always)]
fn floor_of_norm<F: F64Lanes>(a: F, b: F, p: f64, slopes: [F; 2]) -> F {
    if p > 1.0 {
        a * slopes[0] + b * slopes[1]
    } else {
        norm(a, b, p)
    }
}

impl Rough<'_> {
    /// On which of up to four pieces in a row the size is surely above 1, one bit each. What is not known is not set.
    pub(super) fn is_above(&self, stops: &[f64]) -> u32 {
        let count = stops.len() - 1;
        if !self.has_floors() {
            return 0;
        }
        let end = |i: usize| stops[i.min(count)];
        let piece = |i: usize| [end(i), 0.5 * (end(i) + end(i + 1)), end(i + 1)];
        let pieces: [[f64; 3]; 4] = std::array::from_fn(|i| piece(i.min(count - 1)));
        let places = [0, 1, 2].map(|place| pieces.map(|piece| piece[place]));
        let floors = with_widest(|lanes| {
            lanes.run(Floors {
                rough: self,
                places,
            })
        });
        (0..count).fold(0, |bits, i| {
            let is_above = floors.iter().all(|floor| floor[i] > 1.0 + MARGIN);
            bits | u32::from(is_above) << i
        })
    }

    /// Whether a size that is not convex along the ray keeps above 1 behind its start on the surface, growing by a slope
    /// of `least_slope` at least on the first piece.
    pub(super) fn is_leaving(&self, least_slope: f64) -> bool {
        if !self.has_floors() {
            return false;
        }
        let Ray { origin, dir } = self.ray;
        let mut stops: SmallVec<[f64; 5]> = SmallVec::new();
        let mut to = f64::INFINITY;
        for axis in 0..3 {
            let (p, d) = (origin[axis], dir[axis]);
            if p * d < 0.0 {
                stops.push(-p / d);
            }
            if d != 0.0 {
                to = to.min((d.signum() - p) / d);
            }
        }
        if !(0.0 < to && to.is_finite()) {
            return false;
        }
        stops.push(0.0);
        stops.retain(|t| *t < to);
        stops.push(to);
        stops.sort_unstable_by(f64::total_cmp);
        let count = stops.len() - 1;
        let piece = |i: usize| {
            let [from, to] = [stops[i], stops[i + 1]];
            [from, if i == 0 { from } else { 0.5 * (from + to) }, to]
        };
        let pieces: [[f64; 3]; 4] = std::array::from_fn(|i| piece(i.min(count - 1)));
        let places = [0, 1, 2].map(|place| pieces.map(|piece| piece[place]));
        let [from, to] = with_widest(|lanes| {
            lanes.run(Floors {
                rough: self,
                places,
            })
        });
        // Where the tangent touches the floor is the size.
        let is_on_surface = (from[0] - 1.0).abs() <= MARGIN;
        let is_growing = to[0] - 1.0 > MARGIN + least_slope * stops[1];
        let is_above = |i: usize| from[i] > 1.0 + MARGIN && to[i] > 1.0 + MARGIN;
        is_on_surface && is_growing && (1..count).all(is_above)
    }

    /// Whether the powers are such that roundings of places move the size by much less than [`MARGIN`].
    fn has_floors(&self) -> bool {
        let Superellipsoid { across, along } = *self.shape;
        across >= LEAST_POWER && along >= LEAST_POWER
    }
}
