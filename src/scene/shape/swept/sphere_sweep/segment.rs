//! One polynomial segment of the curve of a sweep.

use super::Spans;
use super::path::{ChordEnds, Poly, derivative, product};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::roots::polynomial::{sign_changes, value};
use crate::base::math::{Bounds, Ray};
use crate::scene::shape::{INSIDE_TOLERANCE, SpanEnd};
use glam::{DVec3, DVec4};

/// One polynomial segment of the curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// Centre and radius by rising power of `-1 <= x <= 1`, relative to `centre` and in units of `size`.
    curve: [DVec4; 4],
    /// Number of coefficients.
    len: usize,
    pub(super) centre: DVec3,
    /// A power of two.
    pub(super) size: f64,
    /// Squared radius of a bounding sphere, in units of `size`.
    reach_sq: f64,
}

/// Rows are the powers of `0 <= t <= 1`, columns four consecutive spheres.
pub(super) type Basis = [[f64; 4]; 4];

pub(super) const B_SPLINE: Basis = [
    [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0],
    [-0.5, 0.0, 0.5, 0.0],
    [0.5, -1.0, 0.5, 0.0],
    [-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0],
];
pub(super) const CATMULL_ROM: Basis = [
    [0.0, 1.0, 0.0, 0.0],
    [-0.5, 0.0, 0.5, 0.0],
    [1.0, -2.5, 2.0, -0.5],
    [-0.5, 1.5, -1.5, 0.5],
];

impl Part {
    pub(super) fn of(basis: &Basis, spheres: &[DVec4]) -> Self {
        let power = |row: &[f64; 4]| (0..4).fold(DVec4::ZERO, |sum, i| sum + row[i] * spheres[i]);
        Part::new(&basis.each_ref().map(power))
    }

    /// A segment by rising power of `0 <= t <= 1`.
    pub(super) fn new(powers: &[DVec4]) -> Self {
        let mut c = [DVec4::ZERO; 4];
        c[..powers.len()].copy_from_slice(powers);
        // With t = (1 + x) / 2.
        let curve = [
            c[0] + 0.5 * c[1] + 0.25 * c[2] + 0.125 * c[3],
            0.5 * c[1] + 0.5 * c[2] + 0.375 * c[3],
            0.25 * c[2] + 0.375 * c[3],
            0.125 * c[3],
        ];
        let mut part = Part {
            curve,
            len: powers.len(),
            centre: DVec3::ZERO,
            size: 1.0,
            reach_sq: 0.0,
        };
        let bounds = part.bounds();
        part.centre = bounds.centre();
        part.size = power_of_two((bounds.max - bounds.min).max_element());
        part.curve[0] -= part.centre.extend(0.0);
        part.curve = part.curve.map(|c| c / part.size);
        let reach = part.hull().iter().fold(0.0_f64, |reach, control| {
            reach.max(control.truncate().length() + control.w.abs())
        });
        part.reach_sq = reach * reach;
        part
    }

    /// Bézier control spheres; their hull contains all spheres of the segment.
    fn hull(&self) -> [DVec4; 4] {
        let [a, b, c, d] = self.curve;
        // With x = 2 t - 1, then from powers of t to Bézier points.
        let t = [
            a - b + c - d,
            2.0 * b - 4.0 * c + 6.0 * d,
            4.0 * c - 12.0 * d,
            8.0 * d,
        ];
        [
            t[0],
            t[0] + t[1] / 3.0,
            t[0] + 2.0 / 3.0 * t[1] + t[2] / 3.0,
            t[0] + t[1] + t[2] + t[3],
        ]
    }

    pub(super) fn bounds(&self) -> Bounds {
        let hull = self.hull();
        hull.iter().fold(Bounds::EMPTY, |bounds, control| {
            let at = self.centre + self.size * control.truncate();
            let radius = DVec3::splat(self.size * control.w.abs());
            bounds.with_point(at - radius).with_point(at + radius)
        })
    }

    pub(super) fn at(&self, x: f64) -> DVec4 {
        let curve = self.curve[..self.len].iter().rev();
        curve.fold(DVec4::ZERO, |sum, c| sum * x + *c)
    }

    /// Appends the spans of a ray inside this segment.
    pub(super) fn spans(&self, ray: &Ray, number: u32, spans: &mut Spans) {
        let length = ray.dir.length();
        let dir = ray.dir / length;
        let origin = (ray.origin - self.centre) / self.size;
        // Relative to the point nearest to the centre of the segment.
        let start = -origin.dot(dir);
        let origin = origin + start * dir;
        let is_near = origin.length_squared() <= self.reach_sq;
        if !is_near {
            return;
        }
        let chord_ends = ChordEnds::new(&self.curve[..self.len], origin, dir);
        let to_ray = |s: f64| (start + s) * self.size / length;
        chord_ends.spans(|low, high| {
            let (enter, leave) = (to_ray(low), to_ray(high));
            if enter < leave {
                spans.push([SpanEnd::new(enter, number), SpanEnd::new(leave, number)]);
            }
        });
    }

    /// POV-Ray's inside test: true if some sphere of the segment has the point on its surface, so that a point that lies
    /// in all of them is outside. Between the ends of a straight segment there is a tolerance, as far as a quadratic counts
    /// as touching zero.
    pub(super) fn contains(&self, point: DVec3) -> bool {
        let depth = self.depth(point);
        let tolerance = match depth[..] {
            [_, _, square] => INSIDE_TOLERANCE * square.max(0.0),
            _ => 0.0,
        };
        let ends = [-1.0, 1.0].map(|x| value(&depth, x));
        let turns = sign_changes(&derivative(&depth));
        let turns = turns.iter().map(|x| value(&depth, *x));
        let (mut is_in, mut is_out) = (ends[0].min(ends[1]) <= 0.0, ends[0].max(ends[1]) >= 0.0);
        for turn in turns {
            is_in |= turn <= tolerance;
            is_out |= turn >= 0.0;
        }
        is_in && is_out
    }

    /// True if a point may lie in all spheres of the segment: those at its ends overlap.
    pub(super) fn may_miss_points(&self) -> bool {
        let [start, end] = [-1.0, 1.0].map(|x| self.at(x));
        let reach = start.w.abs() + end.w.abs();
        (end - start).truncate().length_squared() < reach * reach
    }

    /// The squared distance of a point from the centre of the sphere at `x`, less its squared radius, as a polynomial.
    fn depth(&self, point: DVec3) -> Poly {
        let local = ((point - self.centre) / self.size).extend(0.0);
        let mut about = self.curve;
        about[0] -= local;
        product(&about[..self.len], |a, b| {
            a.truncate().dot(b.truncate()) - a.w * b.w
        })
    }

    /// Parameter of the sphere in which a point lies deepest.
    pub(super) fn deepest(&self, point: DVec3) -> f64 {
        let depth = self.depth(point);
        let turns = sign_changes(&derivative(&depth));
        let all = turns.into_iter().chain([-1.0, 1.0]);
        all.map(|x| (x, value(&depth, x)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0.0, |(x, _)| x)
    }
}
