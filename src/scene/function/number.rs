//! The number types that programs run on: `f64`, or intervals that bound it.

use super::Function;
use super::operation::{Binary, Unary};
use std::ops::{Add, Div, Mul, Sub};

/// The parts of `select(test, negative, zero, positive)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// For a test below zero.
    Negative,
    /// For a test of zero.
    Zero,
    /// For every other test, including NaN.
    Positive,
}

/// The reduction over the values of a loop's iterations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// `sum`: adds them to 0.
    Sum,
    /// `prod`: multiplies 1 by them.
    Product,
}

/// Limit on the iterations of a loop. A longer loop called for each pixel of a picture would practically never end, and
/// one whose variable is too large for adding 1 to change it would run forever.
pub(super) const MAX_ITERATIONS: u32 = 100_000_000;

/// A number type that programs run on.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The constant of this value.
    fn constant(value: f64) -> Self;
    /// The square of the number.
    #[must_use]
    fn squared(self) -> Self {
        self * self
    }
    /// A function of one number.
    fn unary(self, f: Unary) -> Self;
    /// An operation of two numbers.
    fn binary(self, f: Binary, other: Self) -> Self;
    /// The value of the part of `select` that this number, as the test, selects; an interval joins all possible parts.
    fn select(self, value_of: impl FnMut(Part) -> Self) -> Self;
    /// The sum or product of the values at `from`, `from + 1`, ... up to `to`.
    fn repeat(fold: Fold, from: Self, to: Self, value_at: impl FnMut(Self) -> Self) -> Self;
    /// A component of the value of another function.
    fn call(function: &Function, arguments: &[Self], component: Component) -> Self;
}

/// A component of a function's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// The component of this index; 0 is the value itself if that is one number.
    At(u8),
    /// `.gray`: the luminance of a colour.
    Gray,
    /// `.hf`: a height with red as its high byte and green as its low byte.
    Height,
}

impl Component {
    /// This component of a vector or colour.
    #[must_use]
    pub fn of(self, v: &[f64; 5]) -> f64 {
        match self {
            Component::At(at) => v.get(usize::from(at)).copied().unwrap_or(0.0),
            Component::Gray => 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2],
            // POV-Ray's factor, measured; 255/256 up to rounding.
            Component::Height => (v[0] + v[1] / 255.0) * 0.996_093,
        }
    }
}

impl Number for f64 {
    #[inline]
    fn constant(value: f64) -> f64 {
        value
    }

    #[inline]
    fn unary(self, f: Unary) -> f64 {
        f.eval(self)
    }

    #[inline]
    fn binary(self, f: Binary, other: f64) -> f64 {
        f.eval(self, other)
    }

    #[inline]
    fn select(self, mut value_of: impl FnMut(Part) -> f64) -> f64 {
        value_of(if self < 0.0 {
            Part::Negative
        } else if self == 0.0 {
            Part::Zero
        } else {
            Part::Positive
        })
    }

    #[inline]
    fn repeat(fold: Fold, from: f64, to: f64, mut value_at: impl FnMut(f64) -> f64) -> f64 {
        let mut result = match fold {
            Fold::Sum => 0.0,
            Fold::Product => 1.0,
        };
        let mut at = from;
        for _ in 0..MAX_ITERATIONS {
            // This form ends the loop if a bound is NaN.
            let continues = at <= to;
            if !continues {
                break;
            }
            let value = value_at(at);
            match fold {
                Fold::Sum => result += value,
                Fold::Product => result *= value,
            }
            at += 1.0;
        }
        result
    }

    #[inline]
    fn call(function: &Function, arguments: &[f64], component: Component) -> f64 {
        if function.is_scalar() {
            function.eval(arguments)
        } else {
            component.of(&function.eval_vector(arguments))
        }
    }
}
