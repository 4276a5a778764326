//! A ray about the axis of a surface of revolution, and how far it is from the points of a curve.

use crate::base::math::Ray;
use crate::base::math::roots::interval_roots::{Interval, IntervalFunction};
use crate::base::math::simd::{F64x4, SimdKernel};
use crate::scene::shape::swept::spline::Segment;
use glam::{DVec2, DVec3};

/// More roundings than it takes to find how far a point of the curve lies from a line.
const ROUNDINGS: f64 = 16.0;

/// The signs of `h`.
pub(super) const SIDES: [f64; 2] = [1.0, -1.0];

/// A ray about the axis.
pub(super) struct Climb {
    /// The distance of the line from the axis.
    pub(super) aside: f64,
    /// `h` at the origin of the ray.
    pub(super) ahead: f64,
    /// The height of that origin.
    pub(super) height: f64,
    pub(super) sine: f64,
    pub(super) cosine: f64,
}

/// The least radii and heights of the points of four arcs, and the most.
#[derive(Debug, PartialEq)]
pub(super) struct FourReaches {
    near: [f64; 4],
    far: [f64; 4],
    low: [f64; 4],
    high: [f64; 4],
}

/// Asks which of four arcs a line may meet.
pub(super) struct FourAndClimb<'a> {
    pub(super) reaches: &'a FourReaches,
    pub(super) climb: &'a Climb,
}

/// The answer.
pub(super) struct FourPasses {
    /// For `h` positive and for `h` negative those that may be met, one bit each. By more than any rounding the points of
    /// all others lie above the line, below it or nearer to the axis.
    pub(super) met: [u32; 2],
    /// How far from the place nearest to the axis the line reaches their radii.
    pub(super) near: [f64; 4],
    pub(super) far: [f64; 4],
}

/// `F` along an arc, for `h` positive or negative.
pub(super) struct Half<'a> {
    pub(super) climb: &'a Climb,
    pub(super) segment: &'a Segment,
    pub(super) side: f64,
}

impl Climb {
    pub(super) fn new(ray: &Ray) -> Self {
        let (origin, dir) = (flat(ray.origin), flat(ray.dir));
        let speed = ray.dir.length();
        let along = if dir == DVec2::ZERO {
            origin.try_normalize().unwrap_or(DVec2::X)
        } else {
            dir / dir.length()
        };
        Climb {
            aside: along.perp_dot(origin).abs(),
            ahead: along.dot(origin),
            height: ray.origin.y,
            sine: ray.dir.y / speed,
            cosine: dir.length() / speed,
        }
    }

    /// How far from the place nearest to the axis the line has the distance `radius` from it; zero if it never has.
    #[inline]
    pub(super) fn reach(&self, radius: f64) -> f64 {
        let radius = radius.abs();
        let reach_sq = (radius - self.aside) * (radius + self.aside);
        if reach_sq > 0.0 { reach_sq.sqrt() } else { 0.0 }
    }

    /// The lengths along the ray between which it comes to such points.
    #[inline]
    pub(super) fn lengths(
        &self,
        [low, high]: [DVec2; 2],
        [near, far]: [f64; 2],
        side: f64,
    ) -> Interval {
        if self.is_steep() {
            Interval::new(
                (low.y - self.height) / self.sine,
                (high.y - self.height) / self.sine,
            )
        } else {
            Interval::new(
                (side * near - self.ahead) / self.cosine,
                (side * far - self.ahead) / self.cosine,
            )
        }
    }

    #[inline]
    pub(super) fn is_steep(&self) -> bool {
        self.sine.abs() > self.cosine
    }

    #[inline]
    pub(super) fn excess(&self, point: DVec2, side: f64) -> f64 {
        self.cosine * (point.y - self.height)
            - self.sine * (side * self.reach(point.x) - self.ahead)
    }

    /// The length along the ray to a point of it.
    pub(super) fn length(&self, point: DVec2, side: f64) -> f64 {
        if self.is_steep() {
            (point.y - self.height) / self.sine
        } else {
            (side * self.reach(point.x) - self.ahead) / self.cosine
        }
    }
}

impl FourReaches {
    /// Those of four arcs, from the least radius and height and the most of each.
    pub(super) fn new(arc: impl Fn(usize) -> [DVec2; 2]) -> Self {
        FourReaches {
            near: std::array::from_fn(|lane| arc(lane)[0].x),
            far: std::array::from_fn(|lane| arc(lane)[1].x),
            low: std::array::from_fn(|lane| arc(lane)[0].y),
            high: std::array::from_fn(|lane| arc(lane)[1].y),
        }
    }
}

impl SimdKernel for FourAndClimb<'_> {
    type Output = FourPasses;

    // Spelt out: closures are not always inlined.
    #[inline(always)]
    fn run<F: F64x4>(self) -> FourPasses {
        let (of, climb) = (self.reaches, self.climb);
        let (aside, height) = (F::splat(climb.aside), F::splat(climb.height));
        let (sine, cosine) = (F::splat(climb.sine), F::splat(climb.cosine));
        let (ahead, zero) = (F::splat(climb.ahead), F::splat(0.0));
        let (least, most) = (F::from_array(&of.near), F::from_array(&of.far));
        let near_sq = (least - aside) * (least + aside);
        let far_sq = (most - aside) * (most + aside);
        let near = near_sq.lane_max(zero).sqrt();
        let far = far_sq.lane_max(zero).sqrt();
        let (low, high) = (F::from_array(&of.low), F::from_array(&of.high));
        let lowest = cosine * (low - height);
        let highest = cosine * (high - height);
        let tall = low.abs().lane_max(high.abs()) + height.abs();
        let size = cosine * tall;
        let size = size + sine.abs() * (far + ahead.abs());
        let care = F::splat(ROUNDINGS * f64::EPSILON) * size;
        let first = sine * (near - ahead);
        let last = sine * (far - ahead);
        let above = care.lt(lowest - first.lane_max(last));
        let below = (highest - first.lane_min(last)).lt(-care);
        let passed = F::bitmask(above | below);
        let first = sine * (-near - ahead);
        let last = sine * (-far - ahead);
        let above = care.lt(lowest - first.lane_max(last));
        let below = (highest - first.lane_min(last)).lt(-care);
        let passed_back = F::bitmask(above | below);
        let within = F::bitmask(most.lt(aside));
        FourPasses {
            met: [
                0b1111 & !(passed | within),
                0b1111 & !(passed_back | within),
            ],
            near: near.to_array(),
            far: far.to_array(),
        }
    }
}

impl IntervalFunction for Half<'_> {
    fn value(&self, x: f64) -> f64 {
        self.climb.excess(self.segment.at(x), self.side)
    }

    fn slope(&self, x: f64) -> f64 {
        let (point, slope) = (self.segment.at(x), self.segment.slope(x));
        let outward = slope.x * point.x / self.climb.reach(point.x);
        self.climb.cosine * slope.y - self.climb.sine * self.side * outward
    }

    fn values(&self, from: f64, to: f64) -> Interval {
        let (a, b) = (self.segment.at(from), self.segment.at(to));
        let climb = self.climb;
        let factor = climb.sine * self.side;
        let rise = Interval::new(climb.cosine * a.y, climb.cosine * b.y);
        let way = Interval::new(factor * climb.reach(a.x), factor * climb.reach(b.x));
        let rest = climb.sine * climb.ahead - climb.cosine * climb.height;
        Interval {
            low: rise.low - way.high + rest,
            high: rise.high - way.low + rest,
        }
    }

    fn slopes(&self, from: f64, to: f64) -> Interval {
        let climb = self.climb;
        let (a, b) = (self.segment.slope(from), self.segment.slope(to));
        let rise = Interval::new(climb.cosine * a.y, climb.cosine * b.y);
        let factor = climb.sine * self.side;
        let narrowing = |x: f64| {
            let radius = self.segment.at(x).x;
            radius / climb.reach(radius)
        };
        let (near, far) = (narrowing(from), narrowing(to));
        let mut way = Interval::new(0.0, 0.0);
        if factor != 0.0 {
            let products = [a.x * near, a.x * far, b.x * near, b.x * far].map(|p| factor * p);
            if products.iter().any(|p| p.is_nan()) {
                return Interval::new(f64::NEG_INFINITY, f64::INFINITY);
            }
            way.low = products.iter().copied().fold(f64::INFINITY, f64::min);
            way.high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        }
        Interval {
            low: rise.low - way.high,
            high: rise.high - way.low,
        }
    }
}

/// Where a monotone radius reaches `level`, from a place below it to one that is not; on the far side of it.
pub(super) fn bisect(
    radius: &impl Fn(f64) -> f64,
    level: f64,
    mut below: f64,
    mut above: f64,
) -> f64 {
    let excess = |x: f64| radius(x) - level;
    let mut ends = [excess(below), excess(above)];
    let mut is_slow = false;
    loop {
        let middle = 0.5 * (below + above);
        if middle == below || middle == above {
            return above;
        }
        // Where the chord is at the level, and a little farther from the end that is nearer to it, so that both ends close
        // in; the middle after a step that gained too little.
        let along = ends[0] / (ends[0] - ends[1]);
        let beside = 4.0 * f64::EPSILON * below.abs().max(above.abs());
        let place = below + along * (above - below);
        let nudge = beside.copysign(above - below);
        let place = if along < 0.5 {
            place + nudge
        } else {
            place - nudge
        };
        let is_between = (below - place) * (place - above) > 0.0;
        let x = if is_between && !is_slow {
            place
        } else {
            middle
        };
        let width = (above - below).abs();
        let value = excess(x);
        if value < 0.0 {
            (below, ends[0]) = (x, value);
        } else {
            (above, ends[1]) = (x, value);
        }
        is_slow = !is_slow && (above - below).abs() > 0.25 * width;
    }
}

/// The part of a point or direction across the axis.
pub(super) fn flat(v: DVec3) -> DVec2 {
    DVec2::new(v.x, v.z)
}
