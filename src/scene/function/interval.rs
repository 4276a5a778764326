//! Interval arithmetic: programs run on intervals to bound the values of a function over a box.
//!
//! The intervals bound the floating-point values that the program computes, not the exact ones. Rounding to nearest is
//! monotonic, so sums, products, quotients and roots of bounds are bounds without outward rounding (Moore, "Interval
//! Analysis", 1966, rounds outwards to bound the exact values). Only results of library functions are widened, by
//! [`SLACK`].
//!
//! The whole line stands for any value, including NaN; every other interval excludes NaN. Functions without a formula
//! return the whole line, except those with known bounds.

use super::number::{Component, Fold, Number, Part};
use super::operation::{Binary, Unary};
use super::{Function, Kind};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{Add, Div, Mul, Sub};

/// Bound of the relative error of C library functions; glibc documents less than half of this.
const SLACK: f64 = 4.0 * f64::EPSILON;
/// Limit on the iterations of a loop on intervals.
const MAX_ITERATIONS: u32 = 10_000;

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower bound.
    pub low: f64,
    /// The upper bound, not below the lower.
    pub high: f64,
}

impl Interval {
    /// Any value, including NaN.
    pub const WHOLE: Interval = Interval {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// The interval between two numbers in any order; the whole line if either is NaN.
    #[must_use]
    pub fn new(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            return Interval::WHOLE;
        }
        Interval {
            low: a.min(b),
            high: a.max(b),
        }
    }

    /// Returns true if the number lies in the interval.
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn union(self, other: Interval) -> Self {
        Interval {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Returns true for the whole line, which may stand for NaN.
    fn is_whole(self) -> bool {
        self.low == f64::NEG_INFINITY && self.high == f64::INFINITY
    }

    fn is_within(self, low: f64, high: f64) -> bool {
        low <= self.low && self.high <= high
    }

    fn is_point(self) -> bool {
        self.low.to_bits() == self.high.to_bits()
    }

    /// The interval widened by the error of a library function.
    fn widened(low: f64, high: f64) -> Self {
        Interval::new(low - low.abs() * SLACK, high + high.abs() * SLACK)
    }

    /// The values of an increasing function.
    fn increasing(self, f: Unary) -> Self {
        Interval::widened(f.eval(self.low), f.eval(self.high))
    }

    /// The range of the values at the corners.
    fn corners(self, other: Interval, f: impl Fn(f64, f64) -> f64) -> Self {
        let values = [
            f(self.low, other.low),
            f(self.low, other.high),
            f(self.high, other.low),
            f(self.high, other.high),
        ];
        if values.iter().any(|value| value.is_nan()) {
            return Interval::WHOLE;
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Interval { low, high }
    }

    /// The range at the corners, widened for a library function.
    fn widened_corners(self, other: Interval, f: impl Fn(f64, f64) -> f64) -> Self {
        let corners = self.corners(other, f);
        Interval::widened(corners.low, corners.high)
    }

    fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            Interval::new(-self.low, -self.high)
        } else {
            Interval::new(0.0, self.high.max(-self.low))
        }
    }

    /// The sine of the interval shifted by `phase`.
    fn sine(self, phase: f64) -> Self {
        let (from, to) = (self.low + phase, self.high + phase);
        // Beyond this the error of the phase may be too large to locate the peaks.
        const FAR: f64 = 1e9;
        if !from.is_finite() || !to.is_finite() {
            return Interval::WHOLE;
        }
        if to - from >= TAU || from.abs() > FAR || to.abs() > FAR {
            return Interval::new(-1.0, 1.0);
        }
        // Widens the interval by the rounding error of the phase.
        let slack = SLACK * (from.abs() + to.abs() + 1.0);
        let contains_peak = |peak: f64| {
            let turns = ((from - slack - peak) / TAU).ceil();
            peak + turns * TAU <= to + slack
        };
        let (a, b) = (from.sin(), to.sin());
        let mut sine = Interval::widened(a.min(b) - slack, a.max(b) + slack);
        if contains_peak(FRAC_PI_2) {
            sine.high = 1.0;
        }
        if contains_peak(-FRAC_PI_2) {
            sine.low = -1.0;
        }
        Interval::new(sine.low.max(-1.0), sine.high.min(1.0))
    }

    fn tangent(self) -> Self {
        let pole = ((self.low - FRAC_PI_2) / PI).ceil() * PI + FRAC_PI_2;
        let slack = SLACK * (self.low.abs() + self.high.abs() + 1.0);
        let is_short = self.high - self.low < PI;
        if !is_short || pole <= self.high + slack || pole - PI >= self.low - slack {
            return Interval::WHOLE;
        }
        self.increasing(Unary::Tan)
    }

    fn truncated(self) -> Self {
        if self.low < f64::from(i32::MIN) || self.high > f64::from(i32::MAX) {
            return Interval::new(f64::from(i32::MIN), f64::from(i32::MAX));
        }
        Interval::new(self.low.trunc(), self.high.trunc())
    }

    /// Returns if the value can be true, and if it can be false.
    fn truth(self) -> (bool, bool) {
        let can_be_false = self.contains(0.0);
        (self.low != 0.0 || self.high != 0.0, can_be_false)
    }

    fn from_truth(can_be_true: bool, can_be_false: bool) -> Self {
        let of = |is: bool| f64::from(u8::from(is));
        Interval::new(of(!can_be_false), of(can_be_true))
    }

    fn angle(self, x: Interval) -> Self {
        // The extremes lie at corners unless the box touches the negative x axis, where the angle jumps.
        if x.low > 0.0 || self.low > 0.0 || self.high < 0.0 {
            self.widened_corners(x, f64::atan2)
        } else {
            Interval::new(-PI, PI)
        }
    }

    fn remainder(self, by: Interval) -> Self {
        if by.contains(0.0) || !self.low.is_finite() || !self.high.is_finite() {
            return Interval::WHOLE;
        }
        let limit = by.abs().high.min(self.abs().high);
        Interval::new(
            if self.low < 0.0 { -limit } else { 0.0 },
            if self.high > 0.0 { limit } else { 0.0 },
        )
    }

    fn power(self, exponent: Interval) -> Self {
        if self.low >= 0.0 {
            return self.widened_corners(exponent, f64::powf);
        }
        if !exponent.is_point() || exponent.low.fract() != 0.0 || exponent.low < 0.0 {
            return Interval::WHOLE;
        }
        if exponent.low % 2.0 == 0.0 {
            self.abs().widened_corners(exponent, f64::powf)
        } else {
            self.widened_corners(exponent, f64::powf)
        }
    }

    fn compare(self, f: Binary, other: Interval) -> Self {
        let (below, above) = (self.high < other.low, self.low > other.high);
        let touches = !below && !above;
        let are_same_point = self.low == self.high && other.low == other.high && touches;
        // True if some pair of values is less, or greater; `touches` if some pair is equal.
        let (less, greater) = (self.low < other.high, self.high > other.low);
        let (can_be_true, can_be_false) = match f {
            Binary::Less => (less, !below),
            Binary::LessEqual => (less || touches, greater),
            Binary::Greater => (greater, !above),
            Binary::GreaterEqual => (greater || touches, less),
            Binary::Equal => (touches, !are_same_point),
            _ => (!are_same_point, touches),
        };
        Interval::from_truth(can_be_true, can_be_false)
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Interval::new(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Interval::new(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.corners(other, |a, b| a * b)
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            Interval::WHOLE
        } else {
            self.corners(other, |a, b| a / b)
        }
    }
}

impl Number for Interval {
    fn constant(value: f64) -> Self {
        Interval::new(value, value)
    }

    fn squared(self) -> Self {
        let size = self.abs();
        Interval::new(size.low * size.low, size.high * size.high)
    }

    fn unary(self, f: Unary) -> Self {
        let is_in_domain = match f {
            Unary::Acos | Unary::Asin | Unary::Atanh => self.is_within(-1.0, 1.0),
            Unary::Acosh => self.low >= 1.0,
            Unary::Sqrt | Unary::Ln | Unary::Log => self.low >= 0.0,
            _ => true,
        };
        // NaN stays NaN, except for `int`.
        if !is_in_domain || self.is_whole() && f != Unary::Int {
            return Interval::WHOLE;
        }
        match f {
            Unary::Negative => Interval::new(-self.low, -self.high),
            Unary::Abs => self.abs(),
            Unary::Acos => Interval::widened(self.high.acos(), self.low.acos()),
            Unary::Sqrt => Interval::new(self.low.sqrt(), self.high.sqrt()),
            Unary::Ceil => Interval::new(self.low.ceil(), self.high.ceil()),
            Unary::Floor => Interval::new(self.low.floor(), self.high.floor()),
            Unary::Int => self.truncated(),
            Unary::Sin => self.sine(0.0),
            Unary::Cos => self.sine(FRAC_PI_2),
            Unary::Tan => self.tangent(),
            Unary::Cosh => {
                let size = self.abs();
                Interval::widened(size.low.cosh(), size.high.cosh())
            }
            Unary::Acosh
            | Unary::Asin
            | Unary::Asinh
            | Unary::Atan
            | Unary::Atanh
            | Unary::Degrees
            | Unary::Exp
            | Unary::Ln
            | Unary::Log
            | Unary::Radians
            | Unary::Sinh
            | Unary::Tanh => self.increasing(f),
        }
    }

    fn binary(self, f: Binary, other: Self) -> Self {
        match f {
            Binary::Add => self + other,
            Binary::Sub => self - other,
            Binary::Mul => self * other,
            Binary::Div => self / other,
            Binary::And => {
                let ((a, not_a), (b, not_b)) = (self.truth(), other.truth());
                Interval::from_truth(a && b, not_a || not_b)
            }
            Binary::Or => {
                let ((a, not_a), (b, not_b)) = (self.truth(), other.truth());
                Interval::from_truth(a || b, not_a && not_b)
            }
            Binary::WholeDiv => (self / other).truncated(),
            _ if f.is_comparison() => self.compare(f, other),
            // An operand that may be NaN leaves no bounds.
            _ if self.is_whole() || other.is_whole() => Interval::WHOLE,
            Binary::Atan2 => self.angle(other),
            Binary::Mod => self.remainder(other),
            Binary::Pow => self.power(other),
            Binary::Min => Interval::new(self.low.min(other.low), self.high.min(other.high)),
            _ => Interval::new(self.low.max(other.low), self.high.max(other.high)),
        }
    }

    fn select(self, mut value_of: impl FnMut(Part) -> Self) -> Self {
        let possible = [
            (Part::Negative, self.low < 0.0),
            (Part::Zero, self.contains(0.0)),
            (Part::Positive, self.high > 0.0),
        ];
        possible
            .into_iter()
            .filter(|(_, is_possible)| *is_possible)
            .map(|(part, _)| value_of(part))
            .reduce(Interval::union)
            .unwrap_or(Interval::WHOLE)
    }

    fn repeat(fold: Fold, from: Self, to: Self, mut value_at: impl FnMut(Self) -> Self) -> Self {
        let mut result = match fold {
            Fold::Sum => Interval::constant(0.0),
            Fold::Product => Interval::constant(1.0),
        };
        if !from.is_point() || !to.is_point() {
            return Interval::WHOLE;
        }
        let mut at = from.low;
        for _ in 0..MAX_ITERATIONS {
            let is_within = at <= to.low;
            if !is_within {
                return result;
            }
            let value = value_at(Interval::constant(at));
            result = match fold {
                Fold::Sum => result + value,
                Fold::Product => result * value,
            };
            at += 1.0;
        }
        Interval::WHOLE
    }

    fn call(function: &Function, arguments: &[Self], _: Component) -> Self {
        match function.kind() {
            Kind::Program(program) => program.run(arguments),
            Kind::Noise(_) => Interval::new(0.0, 1.0),
            Kind::Internal(internal) => match internal.bound() {
                Some(bound) => Interval::new(-bound, bound),
                None => Interval::WHOLE,
            },
            Kind::Ridged(_)
            | Kind::Field(_)
            | Kind::Color(_)
            | Kind::Transform(_)
            | Kind::Spline(_) => Interval::WHOLE,
        }
    }
}
