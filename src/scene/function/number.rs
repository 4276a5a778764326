//! What a function body can be computed with: plain numbers, or bounds of them.

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
    /// For every other test, also one that is no number.
    Positive,
}

/// What a loop does with the values of its rounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// `sum`: adds them to 0.
    Sum,
    /// `prod`: multiplies 1 by them.
    Product,
}

/// More rounds than this are not run: such a loop would not end in a lifetime if it is called for each point of a
/// picture, and one whose variable no longer grows by adding 1 would never end.
pub(super) const MOST_ROUNDS: u32 = 100_000_000;

/// A kind of number that programs compute with.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The number that has this value.
    fn constant(value: f64) -> Self;
    /// The number times itself.
    #[must_use]
    fn squared(self) -> Self {
        self * self
    }
    /// A function of one number.
    fn unary(self, f: Unary) -> Self;
    /// An operation of two numbers.
    fn binary(self, f: Binary, other: Self) -> Self;
    /// The value of the part that this number, as the test, selects; of several parts if it may select several.
    fn select(self, value_of: impl FnMut(Part) -> Self) -> Self;
    /// The sum or product of the values for all numbers from `from` on in steps of 1 that are not above `to`.
    fn repeat(fold: Fold, from: Self, to: Self, value_at: impl FnMut(Self) -> Self) -> Self;
    /// A component of what another function gives.
    fn call(function: &Function, arguments: &[Self], component: Component) -> Self;
}

/// A part of what a function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// The number at this place; 0 is the whole of a function that gives one number.
    At(u8),
    /// `.gray`: the brightness of a colour.
    Gray,
    /// `.hf`: red and green as the two bytes of a height.
    Height,
}

impl Component {
    /// This part of a vector or colour.
    #[must_use]
    pub fn of(self, v: &[f64; 5]) -> f64 {
        match self {
            Component::At(at) => v.get(usize::from(at)).copied().unwrap_or(0.0),
            Component::Gray => 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2],
            // The factor is POV-Ray's, measured; it is 255/256 but for rounding.
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
        f.of_f64(self)
    }

    #[inline]
    fn binary(self, f: Binary, other: f64) -> f64 {
        f.of_f64(self, other)
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
        for _ in 0..MOST_ROUNDS {
            // Written so that a bound that is no number ends the loop.
            let goes_on = at <= to;
            if !goes_on {
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
