//! Closed chains of segments, and their crossings with lines.

use super::Segment;
use crate::base::math::roots::polynomial::sign_changes_between;
use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel, with_widest};
use glam::DVec2;
use smallvec::SmallVec;
use std::ops::Deref;

/// Share of the size of a cubic below which the sign of a Bernstein coefficient is uncertain from rounding.
const BERNSTEIN_SLACK: f64 = 1e-14;

/// Consecutive segments that return to their start.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::scene::shape) struct Chain {
    segments: Vec<Segment>,
    hulls: Vec<Hulls>,
    x_range: [f64; 2],
}

/// Hulls of four segments, of four points each; the last segment of a chain pads the lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hulls {
    /// Coordinates of the points along both axes.
    points: [[[f64; 4]; 2]; 4],
    /// Error bound of the sum of products with the coordinates, per unit factor.
    slack: [[f64; 4]; 2],
}

/// A line `normal · (p − from) + offset = 0`.
#[derive(Clone, Copy)]
pub(in crate::scene::shape) struct Line {
    pub(in crate::scene::shape) normal: DVec2,
    pub(in crate::scene::shape) from: DVec2,
    pub(in crate::scene::shape) offset: f64,
}

impl Line {
    /// The line through a point.
    #[inline(always)]
    pub(in crate::scene::shape) fn through(point: DVec2, normal: DVec2) -> Self {
        Line {
            normal,
            from: point,
            offset: 0.0,
        }
    }
}

/// Kernel that tests which of four segments a line may hit.
struct HullsKernel<'a> {
    hulls: &'a Hulls,
    line: &'a Line,
}

impl Hulls {
    fn new(segments: &[Segment]) -> Self {
        let lane = |of: &dyn Fn(&Segment) -> f64| {
            std::array::from_fn(|lane| of(&segments[lane.min(segments.len() - 1)]))
        };
        let coordinate = |axis: usize, point: usize| lane(&|segment| segment.hull()[point][axis]);
        Hulls {
            points: [0, 1, 2, 3].map(|point| [0, 1].map(|axis| coordinate(axis, point))),
            slack: [0, 1].map(|axis| lane(&|segment| segment.hull_slack()[axis])),
        }
    }
}

impl SimdKernel for HullsKernel<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let Line {
            normal,
            from,
            offset,
        } = *self.line;
        let rest = offset - normal.dot(from);
        let size = offset.abs() + normal.abs().dot(from.abs());
        let (x, y, rest) = (F::splat(normal.x), F::splat(normal.y), F::splat(rest));
        let [a, b, c, d] = &self.hulls.points;
        // Written out: `map` is not always inlined.
        let a = x * F::from_array(&a[0]) + y * F::from_array(&a[1]) + rest;
        let b = x * F::from_array(&b[0]) + y * F::from_array(&b[1]) + rest;
        let c = x * F::from_array(&c[0]) + y * F::from_array(&c[1]) + rest;
        let d = x * F::from_array(&d[0]) + y * F::from_array(&d[1]) + rest;
        let least = a.lane_min(b).lane_min(c.lane_min(d));
        let most = a.lane_max(b).lane_max(c.lane_max(d));
        let [slack_x, slack_y] = &self.hulls.slack;
        let tolerance = x.abs() * F::from_array(slack_x);
        let tolerance = tolerance + y.abs() * F::from_array(slack_y);
        let tolerance = tolerance + F::splat(BERNSTEIN_SLACK * size);
        // NaN counts as a hit.
        let misses = tolerance.lt(least) | most.lt(-tolerance);
        F::bitmask(misses) ^ 0b1111
    }
}

impl Chain {
    pub(crate) fn new(segments: Vec<Segment>) -> Self {
        let ends = segments.iter().map(|one| [one.low.x, one.high.x]);
        let x_range = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |range, one| {
            [range[0].min(one[0]), range[1].max(one[1])]
        });
        Chain {
            hulls: segments.chunks(4).map(Hulls::new).collect(),
            segments,
            x_range,
        }
    }

    /// The least and the largest x.
    pub(crate) fn x_range(&self) -> [f64; 2] {
        self.x_range
    }

    /// Visits the crossings of a line with the chain, by index of the segment and parameter on it.
    #[inline(always)]
    pub(crate) fn line_crossings(
        &self,
        lanes: SimdLevel,
        line: Line,
        mut visit: impl FnMut(usize, f64),
    ) {
        for (hulls, first) in self.hulls.iter().zip((0..).step_by(4)) {
            let mut hits = lanes.run(HullsKernel { hulls, line: &line });
            let here = self.segments.len() - first;
            if here < 4 {
                hits &= (1 << here) - 1;
            }
            while hits != 0 {
                let number = first + hits.trailing_zeros() as usize;
                hits &= hits - 1;
                crossings_of(&self.segments[number], line, |x| visit(number, x));
            }
        }
    }

    /// True if the chain winds around a point an odd number of times.
    pub(crate) fn contains(&self, point: DVec2) -> bool {
        let mut is_inside = false;
        with_widest(
            #[inline(always)]
            |lanes| {
                let line = Line::through(point, DVec2::Y);
                self.line_crossings(lanes, line, |number, x| {
                    is_inside ^= self.segments[number].at(x).x > point.x;
                });
            },
        );
        is_inside
    }

    /// Orients a normal at a point of the chain outward.
    pub(crate) fn outward(&self, point: DVec2, normal: DVec2) -> DVec2 {
        let mut ahead: SmallVec<[f64; 8]> = SmallVec::new();
        with_widest(
            #[inline(always)]
            |lanes| {
                let line = Line::through(point, normal.perp());
                self.line_crossings(lanes, line, |number, x| {
                    ahead.push((self.segments[number].at(x) - point).dot(normal));
                });
            },
        );
        let own = ahead.iter().copied();
        let own = own
            .min_by(|a, b| a.abs().total_cmp(&b.abs()))
            .unwrap_or(0.0);
        let beyond = ahead.iter().filter(|distance| **distance > own).count();
        if beyond % 2 == 0 { normal } else { -normal }
    }
}

impl Deref for Chain {
    type Target = [Segment];

    fn deref(&self) -> &[Segment] {
        &self.segments
    }
}

/// Visits the crossings of a line with a segment of a chain.
#[inline(always)]
fn crossings_of(segment: &Segment, line: Line, mut visit: impl FnMut(f64)) {
    let Line {
        normal,
        from,
        offset,
    } = line;
    let side = |point: DVec2| normal.dot(point - from) + offset;
    let (starts_negative, ends_negative) = (side(segment.start) < 0.0, side(segment.end) < 0.0);
    let [c0, c1, c2, c3] = segment.c;
    let constant = side(c0);
    let linear = normal.dot(c1);
    if segment.degree == 1 {
        if starts_negative != ends_negative {
            let x = -constant / linear;
            visit(if x.abs() <= 1.0 { x } else { x.signum() });
        }
        return;
    }
    let c = [constant, linear, normal.dot(c2), normal.dot(c3)];
    if starts_negative == ends_negative && has_one_sign(&c) {
        return;
    }
    for x in sign_changes_between(&c[..=segment.degree], starts_negative, ends_negative) {
        visit(x);
    }
}

/// POV-Ray's inside test: true if an odd number of crossings lie at the point's own y and not before it in x. Lines that
/// are not level include both of their ends, so that a joint counts twice.
pub(in crate::scene::shape) fn contains_as_povray(segments: &[Segment], point: DVec2) -> bool {
    let mut is_inside = false;
    for segment in segments {
        if segment.degree > 1 {
            let line = Line::through(point, DVec2::Y);
            crossings_of(segment, line, |x| is_inside ^= segment.at(x).x >= point.x);
            continue;
        }
        let (start, along) = (segment.start, segment.end - segment.start);
        let share = (point.y - start.y) / along.y;
        is_inside ^= (0.0..=1.0).contains(&share) && start.x + share * along.x >= point.x;
    }
    is_inside
}

/// True if a cubic with these coefficients keeps its sign between -1 and 1 by more than its rounding, because its
/// Bernstein coefficients do.
fn has_one_sign(&[c0, c1, c2, c3]: &[f64; 4]) -> bool {
    let slack = BERNSTEIN_SLACK * (c0.abs() + c1.abs() + c2.abs() + c3.abs());
    let (even, odd) = (c0 + c2, c1 + c3);
    let (even_inner, odd_inner) = (c0 - c2 / 3.0, c1 / 3.0 - c3);
    let least = (even - odd.abs()).min(even_inner - odd_inner.abs());
    let most = (even + odd.abs()).max(even_inner + odd_inner.abs());
    least > slack || most < -slack
}
