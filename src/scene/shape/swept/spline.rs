//! Plane curves of prisms and lathes: straight, quadratic, cubic (Catmull-Rom) and Bézier segments through or near a
//! list of points.
//!
//! A segment is a cubic in `-1 <= x <= 1`. Crossings of a line with a chain of segments follow from the side of the
//! line on which the joints lie, computed once for both segments of a joint, so that no line slips through.

mod chain;

use super::rounded::Edge;
pub(in crate::scene::shape) use chain::{Chain, Line, contains_as_povray};

use crate::base::args::{Args, Parse, Word, trailing_comma};
use crate::base::math::roots::polynomial::sign_changes;
use crate::base::source::Diagnostic;
use crate::scene::shape::read;
use glam::DVec2;

/// Points nearer than this coincide: POV-Ray's distance for closed outlines.
const SAME_POINT: f64 = 1e-10;

/// Upper bound of the error of a point of a segment, in roundings of the segment's size.
const ROUNDINGS: f64 = 16.0;

/// Upper bound of the error of the signed distance of a point of a segment from a line, in roundings of the segment's
/// size.
const HULL_ROUNDINGS: f64 = 64.0;

/// Interpolation of a curve between its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Straight from point to point.
    Linear,
    /// The first point only shapes the first segment.
    Quadratic,
    /// The first and the last point only shape their neighbours.
    Cubic,
    /// Four points per segment.
    Bezier,
}

/// A cubic curve from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::scene::shape) struct Segment {
    /// By rising power of `x`, with `-1 <= x <= 1`.
    c: [DVec2; 4],
    degree: usize,
    pub(crate) start: DVec2,
    pub(crate) end: DVec2,
    /// The corners of the bounding box.
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
}

impl Kind {
    /// Reads the keyword of a kind of curve, if one is next.
    pub(crate) fn accept(args: &mut dyn Args) -> Parse<Option<Kind>> {
        for (word, kind) in [
            (Word::LinearSpline, Kind::Linear),
            (Word::QuadraticSpline, Kind::Quadratic),
            (Word::CubicSpline, Kind::Cubic),
            (Word::BezierSpline, Kind::Bezier),
        ] {
            if args.accept(word)? {
                return Ok(Some(kind));
            }
        }
        Ok(None)
    }

    /// Name in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Kind::Linear => "linear",
            Kind::Quadratic => "quadratic",
            Kind::Cubic => "cubic",
            Kind::Bezier => "bezier",
        }
    }

    /// Numbers of control points before the first and after the last point on the curve.
    pub(crate) fn extra(self) -> (usize, usize) {
        match self {
            Kind::Linear | Kind::Bezier => (0, 0),
            Kind::Quadratic => (1, 0),
            Kind::Cubic => (1, 1),
        }
    }

    /// Segments of a curve along all points; an incomplete one at the end is dropped.
    pub(crate) fn segments(self, points: &[DVec2]) -> Vec<Segment> {
        match self {
            Kind::Linear => points
                .windows(2)
                .map(|p| Segment::line(p[0], p[1]))
                .collect(),
            Kind::Quadratic => points.windows(3).map(Segment::quadratic).collect(),
            Kind::Cubic => points.windows(4).map(Segment::cubic).collect(),
            Kind::Bezier => points.chunks_exact(4).map(Segment::bezier).collect(),
        }
    }
}

/// Reads the number of points and the points. `of` names the shape: "lathe".
pub(crate) fn read_points(args: &mut dyn Args, of: &str) -> Parse<Vec<DVec2>> {
    let count = read::number(args, &format!("the number of points of the {of}"))?;
    let mut points = Vec::new();
    let mut read = 1.0;
    while read <= count {
        args.comma()?;
        let at = args.span();
        let point = args.vector2()?;
        if !point.is_finite() {
            let message = format!(
                "a point of the {of} must be finite, found <{}, {}>",
                point.x, point.y
            );
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                message,
            )));
        }
        points.push(point);
        read += 1.0;
    }
    trailing_comma(args)?;
    Ok(points)
}

/// True if two points count as one.
pub(crate) fn is_same(a: DVec2, b: DVec2) -> bool {
    (a - b).abs().max_element() < SAME_POINT
}

impl Segment {
    /// A straight segment.
    pub(crate) fn line(start: DVec2, end: DVec2) -> Self {
        Segment::new(
            [start, end - start, DVec2::ZERO, DVec2::ZERO],
            1,
            [start, end],
        )
    }

    /// Start and direction of a straight segment.
    pub(super) fn edge(&self) -> Option<Edge> {
        let dir = self.end - self.start;
        (self.degree == 1 && dir != DVec2::ZERO).then_some([self.start, dir])
    }

    /// The same of a segment all along which the second coordinate is the same.
    pub(super) fn level_edge(&self) -> Option<Edge> {
        let is_level = self.c[1..].iter().all(|c| c.y == 0.0);
        let width = self.end.x - self.start.x;
        (is_level && width != 0.0).then(|| [self.start, DVec2::new(width, 0.0)])
    }

    fn quadratic(p: &[DVec2]) -> Self {
        let (before, start, end) = (p[0], p[1], p[2]);
        let square = 0.5 * before - start + 0.5 * end;
        let linear = 0.5 * (end - before);
        Segment::new([start, linear, square, DVec2::ZERO], 2, [start, end])
    }

    fn cubic(p: &[DVec2]) -> Self {
        let (before, start, end, after) = (p[0], p[1], p[2], p[3]);
        let cube = 0.5 * (after - before) + 1.5 * (start - end);
        let square = before - 2.5 * start + 2.0 * end - 0.5 * after;
        let linear = 0.5 * (end - before);
        Segment::new([start, linear, square, cube], 3, [start, end])
    }

    fn bezier(p: &[DVec2]) -> Self {
        let linear = 3.0 * (p[1] - p[0]);
        let square = 3.0 * (p[0] - 2.0 * p[1] + p[2]);
        let cube = p[3] - p[0] + 3.0 * (p[1] - p[2]);
        Segment::new([p[0], linear, square, cube], 3, [p[0], p[3]])
    }

    /// Converts from powers of a parameter between 0 and 1.
    fn new(a: [DVec2; 4], degree: usize, [start, end]: [DVec2; 2]) -> Self {
        let c = [
            0.5 * (start + end) - 0.25 * a[2] - 0.375 * a[3],
            0.5 * (end - start) - 0.125 * a[3],
            0.25 * a[2] + 0.375 * a[3],
            0.125 * a[3],
        ];
        let mut segment = Segment {
            c,
            degree,
            start,
            end,
            low: start.min(end),
            high: start.max(end),
        };
        for axis in 0..2 {
            for x in segment.turns(axis) {
                let point = segment.at(x);
                segment.low = segment.low.min(point);
                segment.high = segment.high.max(point);
            }
        }
        segment
    }

    /// The segment with its last point moved by a rounding to where the next begins.
    pub(crate) fn ending_at(self, end: DVec2) -> Self {
        Segment {
            end,
            low: self.low.min(end),
            high: self.high.max(end),
            ..self
        }
    }

    /// Parameters at which one coordinate has zero slope.
    pub(crate) fn turns(&self, axis: usize) -> crate::base::math::roots::bracket::Roots {
        sign_changes(&[
            self.c[1][axis],
            2.0 * self.c[2][axis],
            3.0 * self.c[3][axis],
        ])
    }

    /// Inflection of one coordinate.
    pub(crate) fn bend(&self, axis: usize) -> Option<f64> {
        let x = -self.c[2][axis] / (3.0 * self.c[3][axis]);
        (-1.0 < x && x < 1.0).then_some(x)
    }

    /// Zeros of one coordinate.
    pub(crate) fn zeros(&self, axis: usize) -> crate::base::math::roots::bracket::Roots {
        sign_changes(&self.c.map(|c| c[axis])[..=self.degree])
    }

    /// The point at `x`; the end points are exact.
    #[inline]
    pub(crate) fn at(&self, x: f64) -> DVec2 {
        if x == -1.0 {
            return self.start;
        }
        if x == 1.0 {
            return self.end;
        }
        self.on_polynomial(x)
    }

    #[inline]
    fn on_polynomial(&self, x: f64) -> DVec2 {
        self.c[0] + x * (self.c[1] + x * (self.c[2] + x * self.c[3]))
    }

    /// Bounding box of all points as [`Segment::at`] computes them, roundings included, on an interval on which both
    /// coordinates are monotone.
    pub(crate) fn box_of_part(&self, from: f64, to: f64) -> [DVec2; 2] {
        let [a, b] = [from, to].map(|x| [self.at(x), self.on_polynomial(x)]);
        let size: DVec2 = self.c.iter().map(|c| c.abs()).sum();
        let slack = ROUNDINGS * f64::EPSILON * size;
        [
            a[0].min(a[1]).min(b[0]).min(b[1]) - slack,
            a[0].max(a[1]).max(b[0]).max(b[1]) + slack,
        ]
    }

    /// Four points whose hull contains the segment: the Bernstein coefficients, except for the ends.
    fn hull(&self) -> [DVec2; 4] {
        let [c0, c1, c2, c3] = self.c;
        let (even, odd) = (c0 - c2 / 3.0, c1 / 3.0 - c3);
        [self.start, even - odd, even + odd, self.end]
    }

    /// Bound of how far the rounded segment may leave that hull, and of the error of a product with one of its
    /// coordinates.
    fn hull_slack(&self) -> DVec2 {
        let size: DVec2 = self.c.iter().map(|c| c.abs()).sum();
        let gap = |end: DVec2, x: f64| (end - self.on_polynomial(x)).abs();
        HULL_ROUNDINGS * f64::EPSILON * size + gap(self.start, -1.0) + gap(self.end, 1.0)
    }

    /// Derivative by `x`.
    #[inline]
    pub(crate) fn slope(&self, x: f64) -> DVec2 {
        self.c[1] + x * (2.0 * self.c[2] + x * (3.0 * self.c[3]))
    }

    /// Tangent at `x`; where the derivative vanishes, its value nearby.
    pub(crate) fn tangent(&self, x: f64) -> DVec2 {
        let slope = self.slope(x);
        if slope == DVec2::ZERO {
            self.slope(0.999 * x + 0.0005)
        } else {
            slope
        }
    }

    /// Squared distance of a point from the bounding box.
    fn box_distance_sq(&self, point: DVec2) -> f64 {
        let outside = (self.low - point).max(point - self.high);
        outside.max(DVec2::ZERO).length_squared()
    }

    /// Parameter of the point nearest to a given one, and its squared distance.
    fn nearest(&self, point: DVec2) -> (f64, f64) {
        let away = |x: f64| (x, (self.at(x) - point).length_squared());
        let [c0, c1, c2, c3] = self.c;
        let from = c0 - point;
        let turns = if self.degree == 1 {
            sign_changes(&[from.dot(c1), c1.dot(c1)])
        } else {
            sign_changes(&[
                from.dot(c1),
                c1.dot(c1) + 2.0 * from.dot(c2),
                3.0 * (from.dot(c3) + c1.dot(c2)),
                4.0 * c1.dot(c3) + 2.0 * c2.dot(c2),
                5.0 * c2.dot(c3),
                3.0 * c3.dot(c3),
            ])
        };
        let all = turns.iter().copied().chain([-1.0, 1.0]).map(away);
        all.min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0.0, f64::INFINITY))
    }
}

/// Index of the segment nearest to a point and the parameter on it, the first of equally near ones; `None` for an empty
/// chain.
pub(crate) fn nearest(segments: &[Segment], point: DVec2) -> Option<(usize, f64)> {
    // The distance of the segment with the nearest box bounds which others need to be solved.
    let boxes = segments
        .iter()
        .map(|segment| segment.box_distance_sq(point))
        .enumerate();
    let (likely, _) = boxes.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (x, mut least) = segments[likely].nearest(point);
    let mut best = (likely, x);
    for (number, segment) in segments.iter().enumerate() {
        if number == likely || segment.box_distance_sq(point) > least {
            continue;
        }
        let (x, distance_sq) = segment.nearest(point);
        if distance_sq < least || distance_sq == least && number < best.0 {
            (best, least) = ((number, x), distance_sq);
        }
    }
    Some(best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::simd::SimdLevel;

    const POINTS: [DVec2; 4] = [
        DVec2::new(-1.0, 0.0),
        DVec2::new(0.0, 1.0),
        DVec2::new(2.0, 1.5),
        DVec2::new(3.0, -1.0),
    ];

    #[test]
    fn curves_begin_and_end_at_their_points() {
        for (segment, start, end) in [
            (Segment::line(POINTS[0], POINTS[1]), POINTS[0], POINTS[1]),
            (Segment::quadratic(&POINTS[..3]), POINTS[1], POINTS[2]),
            (Segment::cubic(&POINTS), POINTS[1], POINTS[2]),
            (Segment::bezier(&POINTS), POINTS[0], POINTS[3]),
        ] {
            for (x, point) in [(-1.0, start), (1.0, end)] {
                let c = segment.c;
                let sum = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
                assert!((sum - point).length() < 1e-15);
                assert_eq!(segment.at(x), point);
            }
        }
    }

    #[test]
    fn a_cubic_leaves_along_its_neighbours() {
        let cubic = Segment::cubic(&POINTS);
        let half = 0.25 * (POINTS[2] - POINTS[0]);
        assert!((cubic.slope(-1.0) - half).length() < 1e-15);
        let bezier = Segment::bezier(&POINTS);
        assert!(
            (bezier.at(0.0) - (POINTS[0] + 3.0 * (POINTS[1] + POINTS[2]) + POINTS[3]) / 8.0)
                .length()
                < 1e-15
        );
    }

    #[test]
    fn the_box_contains_the_curve_and_the_nearest_point_is_exact() {
        let bezier = Segment::bezier(&POINTS);
        for i in 0..=20 {
            let x = f64::from(i) / 10.0 - 1.0;
            let point = bezier.at(x);
            assert!(point.cmpge(bezier.low).all() && point.cmple(bezier.high).all());
            let (number, near) = nearest(&[bezier], point).unwrap();
            assert_eq!(number, 0);
            assert!((near - x).abs() < 1e-8);
        }
    }

    #[test]
    fn a_line_through_a_joint_crosses_once() {
        let corners = [
            DVec2::new(-1.0, -1.0),
            DVec2::new(1.0, -1.0),
            DVec2::new(1.0, 1.0),
            DVec2::new(-1.0, 1.0),
            DVec2::new(-1.0, -1.0),
        ];
        let square = Chain::new(Kind::Linear.segments(&corners));
        for angle in 0..100 {
            let (sin, cos) = f64::from(angle).sin_cos();
            let mut count = 0;
            let line = Line::through(corners[2], DVec2::new(sin, cos));
            square.line_crossings(SimdLevel::widest(), line, |_, _| count += 1);
            assert_eq!(count % 2, 0);
        }
        assert!(square.contains(DVec2::new(0.5, -1.0 + 1e-15)));
        assert!(!square.contains(DVec2::new(0.5, 1.0 + 1e-15)));
        let out = square.outward(DVec2::new(1.0, 0.3), DVec2::NEG_X);
        assert_eq!(out, DVec2::X);
    }

    #[test]
    fn points_are_counted_and_finite() {
        let mut args = TextArgs::new("2.7, <1,2>, <3,4>, <5,6>");
        assert_eq!(read_points(&mut args, "lathe").unwrap().len(), 2);
        let error = read_points(&mut TextArgs::new("1 <1,nan>"), "prism").unwrap_err();
        assert_eq!(
            error.message,
            "a point of the prism must be finite, found <1, NaN>"
        );
    }
}
