//! A ray relative to the axis of a surface of revolution, and its distance from points of a curve.

use crate::base::math::Ray;
use crate::base::math::roots::interval_roots::{Interval, IntervalFunction};
use crate::base::math::simd::{F64x4, SimdKernel};
use crate::scene::shape::swept::spline::Segment;
use glam::{DVec2, DVec3};

/// Bound, in roundings, of the error of the distance of a curve point from a line.
const ROUNDINGS: f64 = 16.0;

/// The signs of `h`.
pub(super) const SIDES: [f64; 2] = [1.0, -1.0];

/// A ray relative to the axis.
pub(super) struct AxisRay {
    /// The distance of the line from the axis, `a`.
    pub(super) axis_distance: f64,
    /// `h₀`: `h` at the origin of the ray.
    pub(super) origin_h: f64,
    /// `y₀`: the height of the origin.
    pub(super) origin_y: f64,
    pub(super) sine: f64,
    pub(super) cosine: f64,
}

/// Least and greatest radii and heights of four arcs.
#[derive(Debug, PartialEq)]
pub(super) struct ArcBounds4 {
    near: [f64; 4],
    far: [f64; 4],
    low: [f64; 4],
    high: [f64; 4],
}

/// Kernel that tests which of four arcs a line may hit.
pub(super) struct ArcTest4<'a> {
    pub(super) arc_bounds: &'a ArcBounds4,
    pub(super) axis_ray: &'a AxisRay,
}

/// Result of [`ArcTest4`].
pub(super) struct ArcHits4 {
    /// Bit masks of the arcs that may be hit, for positive and negative `h`. The points of all others lie above the
    /// line, below it or nearer to the axis, by more than any rounding.
    pub(super) hit_mask: [u32; 2],
    /// `|h|` of the line at their least and greatest radii.
    pub(super) near: [f64; 4],
    pub(super) far: [f64; 4],
}

/// `F` along an arc, for positive or negative `h`.
pub(super) struct Half<'a> {
    pub(super) axis_ray: &'a AxisRay,
    pub(super) segment: &'a Segment,
    pub(super) side: f64,
}

impl AxisRay {
    pub(super) fn new(ray: &Ray) -> Self {
        let (origin, dir) = (flat(ray.origin), flat(ray.dir));
        let speed = ray.dir.length();
        let along = if dir == DVec2::ZERO {
            origin.try_normalize().unwrap_or(DVec2::X)
        } else {
            dir / dir.length()
        };
        AxisRay {
            axis_distance: along.perp_dot(origin).abs(),
            origin_h: along.dot(origin),
            origin_y: ray.origin.y,
            sine: ray.dir.y / speed,
            cosine: dir.length() / speed,
        }
    }

    /// `|h|` at which the line is at distance `radius` from the axis; zero if it never is.
    #[inline]
    pub(super) fn half_chord(&self, radius: f64) -> f64 {
        let radius = radius.abs();
        let half_chord_sq = (radius - self.axis_distance) * (radius + self.axis_distance);
        if half_chord_sq > 0.0 {
            half_chord_sq.sqrt()
        } else {
            0.0
        }
    }

    /// Distances along the ray between which it comes to points within these bounds.
    #[inline]
    pub(super) fn distances(
        &self,
        [low, high]: [DVec2; 2],
        [near, far]: [f64; 2],
        side: f64,
    ) -> Interval {
        if self.is_steep() {
            Interval::new(
                (low.y - self.origin_y) / self.sine,
                (high.y - self.origin_y) / self.sine,
            )
        } else {
            Interval::new(
                (side * near - self.origin_h) / self.cosine,
                (side * far - self.origin_h) / self.cosine,
            )
        }
    }

    #[inline]
    pub(super) fn is_steep(&self) -> bool {
        self.sine.abs() > self.cosine
    }

    #[inline]
    pub(super) fn residual(&self, point: DVec2, side: f64) -> f64 {
        self.residual_at(point.y, side * self.half_chord(point.x))
    }

    /// `F` at a height and an `h`.
    #[inline]
    pub(super) fn residual_at(&self, y: f64, h: f64) -> f64 {
        self.cosine * (y - self.origin_y) - self.sine * (h - self.origin_h)
    }

    /// The distance along the ray to a point of it.
    pub(super) fn length(&self, point: DVec2, side: f64) -> f64 {
        if self.is_steep() {
            (point.y - self.origin_y) / self.sine
        } else {
            (side * self.half_chord(point.x) - self.origin_h) / self.cosine
        }
    }
}

impl ArcBounds4 {
    /// Bounds of four arcs, from the least and the greatest corner of each.
    pub(super) fn new(arc: impl Fn(usize) -> [DVec2; 2]) -> Self {
        ArcBounds4 {
            near: std::array::from_fn(|lane| arc(lane)[0].x),
            far: std::array::from_fn(|lane| arc(lane)[1].x),
            low: std::array::from_fn(|lane| arc(lane)[0].y),
            high: std::array::from_fn(|lane| arc(lane)[1].y),
        }
    }
}

impl SimdKernel for ArcTest4<'_> {
    type Output = ArcHits4;

    // Written out: closures are not always inlined.
    #[inline(always)]
    fn run<F: F64x4>(self) -> ArcHits4 {
        let (bounds, axis_ray) = (self.arc_bounds, self.axis_ray);
        let (axis_distance, origin_y) = (
            F::splat(axis_ray.axis_distance),
            F::splat(axis_ray.origin_y),
        );
        let (sine, cosine) = (F::splat(axis_ray.sine), F::splat(axis_ray.cosine));
        let (origin_h, zero) = (F::splat(axis_ray.origin_h), F::splat(0.0));
        let (least, most) = (F::from_array(&bounds.near), F::from_array(&bounds.far));
        let near_sq = (least - axis_distance) * (least + axis_distance);
        let far_sq = (most - axis_distance) * (most + axis_distance);
        let near = near_sq.lane_max(zero).sqrt();
        let far = far_sq.lane_max(zero).sqrt();
        let (low, high) = (F::from_array(&bounds.low), F::from_array(&bounds.high));
        let lowest = cosine * (low - origin_y);
        let highest = cosine * (high - origin_y);
        let tall = low.abs().lane_max(high.abs()) + origin_y.abs();
        let size = cosine * tall;
        let size = size + sine.abs() * (far + origin_h.abs());
        let margin = F::splat(ROUNDINGS * f64::EPSILON) * size;
        let first = sine * (near - origin_h);
        let last = sine * (far - origin_h);
        let above = margin.lt(lowest - first.lane_max(last));
        let below = (highest - first.lane_min(last)).lt(-margin);
        let excluded = F::bitmask(above | below);
        let first = sine * (-near - origin_h);
        let last = sine * (-far - origin_h);
        let above = margin.lt(lowest - first.lane_max(last));
        let below = (highest - first.lane_min(last)).lt(-margin);
        let excluded_back = F::bitmask(above | below);
        let is_nearer = F::bitmask(most.lt(axis_distance));
        ArcHits4 {
            hit_mask: [
                0b1111 & !(excluded | is_nearer),
                0b1111 & !(excluded_back | is_nearer),
            ],
            near: near.to_array(),
            far: far.to_array(),
        }
    }
}

/// A point of an arc.
#[derive(Clone, Copy)]
pub(super) struct ArcPoint {
    pub(super) point: DVec2,
    slope: DVec2,
    half_chord: f64,
}

impl IntervalFunction for Half<'_> {
    type At = ArcPoint;

    fn at(&self, x: f64) -> ArcPoint {
        let point = self.segment.at(x);
        ArcPoint {
            point,
            slope: self.segment.slope(x),
            half_chord: self.axis_ray.half_chord(point.x),
        }
    }

    fn value(&self, at: ArcPoint) -> f64 {
        self.axis_ray
            .residual_at(at.point.y, self.side * at.half_chord)
    }

    fn slope(&self, at: ArcPoint) -> f64 {
        let outward = at.slope.x * at.point.x / at.half_chord;
        self.axis_ray.cosine * at.slope.y - self.axis_ray.sine * self.side * outward
    }

    fn values(&self, [a, b]: [ArcPoint; 2]) -> Interval {
        let axis_ray = self.axis_ray;
        let factor = axis_ray.sine * self.side;
        let rise = Interval::new(axis_ray.cosine * a.point.y, axis_ray.cosine * b.point.y);
        let run = Interval::new(factor * a.half_chord, factor * b.half_chord);
        let offset = axis_ray.sine * axis_ray.origin_h - axis_ray.cosine * axis_ray.origin_y;
        Interval {
            low: rise.low - run.high + offset,
            high: rise.high - run.low + offset,
        }
    }

    fn slopes(&self, [a, b]: [ArcPoint; 2]) -> Interval {
        let axis_ray = self.axis_ray;
        let rise = Interval::new(axis_ray.cosine * a.slope.y, axis_ray.cosine * b.slope.y);
        let factor = axis_ray.sine * self.side;
        let [near, far] = [a, b].map(|at| at.point.x / at.half_chord);
        let mut run = Interval::new(0.0, 0.0);
        if factor != 0.0 {
            let [a, b] = [a.slope.x, b.slope.x];
            let products = [a * near, a * far, b * near, b * far].map(|p| factor * p);
            if products.iter().any(|p| p.is_nan()) {
                return Interval::new(f64::NEG_INFINITY, f64::INFINITY);
            }
            run.low = products.iter().copied().fold(f64::INFINITY, f64::min);
            run.high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        }
        Interval {
            low: rise.low - run.high,
            high: rise.high - run.low,
        }
    }
}

/// The parameter where a monotone radius reaches `level`, from one below to one above; rounded to the far side.
pub(super) fn bisect(
    radius: &impl Fn(f64) -> f64,
    level: f64,
    mut below: f64,
    mut above: f64,
) -> f64 {
    let residual = |x: f64| radius(x) - level;
    let mut ends = [residual(below), residual(above)];
    let mut is_slow = false;
    loop {
        let middle = 0.5 * (below + above);
        if middle == below || middle == above {
            return above;
        }
        // Regula falsi: where the chord reaches the level, moved slightly away from the nearer end, so that both ends
        // close in; bisection after a step that gained too little.
        let along = ends[0] / (ends[0] - ends[1]);
        let nudge_size = 4.0 * f64::EPSILON * below.abs().max(above.abs());
        let guess = below + along * (above - below);
        let nudge = nudge_size.copysign(above - below);
        let guess = if along < 0.5 {
            guess + nudge
        } else {
            guess - nudge
        };
        let is_between = (below - guess) * (guess - above) > 0.0;
        let x = if is_between && !is_slow {
            guess
        } else {
            middle
        };
        let width = (above - below).abs();
        let value = residual(x);
        if value < 0.0 {
            (below, ends[0]) = (x, value);
        } else {
            (above, ends[1]) = (x, value);
        }
        is_slow = !is_slow && (above - below).abs() > 0.25 * width;
    }
}

/// The component of a point or direction perpendicular to the axis.
pub(super) fn flat(v: DVec3) -> DVec2 {
    DVec2::new(v.x, v.z)
}
