//! Proof that a ray misses a superellipsoid with hollow sides, by lower bounds of the norm.

use super::Superellipsoid;
use super::norms::{norm, norm_and_derivatives};
use super::rough::{Rough, SLACK};
use crate::base::math::Ray;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use smallvec::SmallVec;

/// The least power for which a rounding of a coordinate, zero included, changes the norm by less than 1e-7.
const MIN_POWER: f64 = 0.5;
/// A lower bound above 1 by this margin proves that the norm is above 1, whatever the roundings.
const MARGIN: f64 = 10.0 * SLACK;

/// Lower bounds of the norm at both ends of up to four pieces of a ray on which no coordinate changes sign; the lower
/// of the two bounds the norm on all of the piece.
///
/// A norm of numbers that are not negative is concave if its power is at most 1 (reverse Minkowski inequality), and
/// otherwise convex: then it is nowhere below its tangent at a point of the piece, which replaces it. The result is
/// concave and grows with each coordinate, so it is concave along the piece, too.
struct LowerBounds<'s> {
    rough: &'s Rough<'s>,
    /// Parameters at which each piece begins, the tangent touches, and the piece ends.
    params: [[f64; 4]; 3],
}

impl SimdKernel for LowerBounds<'_> {
    type Output = [[f64; 4]; 2];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [[f64; 4]; 2] {
        let Superellipsoid { across, along } = *self.rough.shape;
        let [from, touch, to] = &self.params;
        let [from, to] = [self.points::<F>(from), self.points::<F>(to)];
        let (mut of_plane, mut of_size) = ([F::splat(1.0); 2], [F::splat(1.0); 2]);
        if across > 1.0 || along > 1.0 {
            let touch = self.points::<F>(touch);
            let ring;
            (ring, of_plane) = norm_and_derivatives(touch[0], touch[1], across);
            if along > 1.0 {
                (_, of_size) = norm_and_derivatives(ring, touch[2], along);
            }
        }
        [
            self.lower_bound(from, of_plane, of_size),
            self.lower_bound(to, of_plane, of_size),
        ]
    }
}

impl LowerBounds<'_> {
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
    fn lower_bound<F: F64Lanes>(
        &self,
        [x, y, z]: [F; 3],
        of_plane: [F; 2],
        of_size: [F; 2],
    ) -> [f64; 4] {
        let Superellipsoid { across, along } = *self.rough.shape;
        let ring = lower_bound_of_norm(x, y, across, of_plane);
        lower_bound_of_norm(ring, z, along, of_size).to_array()
    }
}

/// A concave norm, or the tangent with these slopes of a convex one.
#[inline(always)]
fn lower_bound_of_norm<F: F64Lanes>(a: F, b: F, p: f64, slopes: [F; 2]) -> F {
    if p > 1.0 {
        a * slopes[0] + b * slopes[1]
    } else {
        norm(a, b, p)
    }
}

impl Rough<'_> {
    /// Bit mask of those of up to four consecutive pieces on which the norm is certainly above 1.
    pub(super) fn is_above(&self, stops: &[f64]) -> u32 {
        let count = stops.len() - 1;
        if !self.has_lower_bounds() {
            return 0;
        }
        let end = |i: usize| stops[i.min(count)];
        let piece = |i: usize| [end(i), 0.5 * (end(i) + end(i + 1)), end(i + 1)];
        let pieces: [[f64; 3]; 4] = std::array::from_fn(|i| piece(i.min(count - 1)));
        let params = [0, 1, 2].map(|param| pieces.map(|piece| piece[param]));
        let bounds = with_widest(|lanes| {
            lanes.run(LowerBounds {
                rough: self,
                params,
            })
        });
        (0..count).fold(0, |bits, i| {
            let is_above = bounds
                .iter()
                .all(|lower_bound| lower_bound[i] > 1.0 + MARGIN);
            bits | u32::from(is_above) << i
        })
    }

    /// True if a norm that is not convex along the ray certainly stays above 1 beyond its start on the surface, and
    /// grows by a slope of at least `least_slope` on the first piece.
    pub(super) fn is_leaving(&self, least_slope: f64) -> bool {
        if !self.has_lower_bounds() {
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
        let params = [0, 1, 2].map(|param| pieces.map(|piece| piece[param]));
        let [from, to] = with_widest(|lanes| {
            lanes.run(LowerBounds {
                rough: self,
                params,
            })
        });
        // Where the tangent touches, the lower bound is the norm itself.
        let is_on_surface = (from[0] - 1.0).abs() <= MARGIN;
        let is_growing = to[0] - 1.0 > MARGIN + least_slope * stops[1];
        let is_above = |i: usize| from[i] > 1.0 + MARGIN && to[i] > 1.0 + MARGIN;
        is_on_surface && is_growing && (1..count).all(is_above)
    }

    /// True if the powers are such that rounding of points changes the norm by much less than [`MARGIN`].
    fn has_lower_bounds(&self) -> bool {
        let Superellipsoid { across, along } = *self.shape;
        across >= MIN_POWER && along >= MIN_POWER
    }
}
