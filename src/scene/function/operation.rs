//! The unary and binary operations of function bodies.
//!
//! None of them fails: where a float expression of a scene stops with an error, a function returns infinity or NaN.

use crate::base::args::Word;
use crate::base::math::roots::hyperbolic::{acosh, asinh, atanh};

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// `-a`.
    Negative,
    /// `abs`.
    Abs,
    /// `acos`.
    Acos,
    /// `acosh`.
    Acosh,
    /// `asin`.
    Asin,
    /// `asinh`.
    Asinh,
    /// `atan`.
    Atan,
    /// `atanh`.
    Atanh,
    /// `ceil`.
    Ceil,
    /// `cos`.
    Cos,
    /// `cosh`.
    Cosh,
    /// `degrees`.
    Degrees,
    /// `exp`.
    Exp,
    /// `floor`.
    Floor,
    /// `int`: truncation to 32 bits.
    Int,
    /// `ln`.
    Ln,
    /// `log`, to the base 10.
    Log,
    /// `radians`.
    Radians,
    /// `sin`.
    Sin,
    /// `sinh`.
    Sinh,
    /// `sqrt`.
    Sqrt,
    /// `tan`.
    Tan,
    /// `tanh`.
    Tanh,
}

/// An operation of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// `a + b`.
    Add,
    /// `a - b`.
    Sub,
    /// `a * b`.
    Mul,
    /// `a / b`.
    Div,
    /// `a & b`.
    And,
    /// `a | b`.
    Or,
    /// `a < b`.
    Less,
    /// `a <= b`.
    LessEqual,
    /// `a > b`.
    Greater,
    /// `a >= b`.
    GreaterEqual,
    /// `a = b`.
    Equal,
    /// `a != b`.
    NotEqual,
    /// `atan2`.
    Atan2,
    /// `div`: the quotient truncated to 32 bits.
    WholeDiv,
    /// `mod`: the remainder with the sign of `a`.
    Mod,
    /// `pow`.
    Pow,
    /// `min`.
    Min,
    /// `max`.
    Max,
}

impl Unary {
    /// The function of this word.
    #[must_use]
    pub fn of(word: Word) -> Option<Self> {
        Some(match word {
            Word::Abs => Unary::Abs,
            Word::Acos => Unary::Acos,
            Word::Acosh => Unary::Acosh,
            Word::Asin => Unary::Asin,
            Word::Asinh => Unary::Asinh,
            Word::Atan => Unary::Atan,
            Word::Atanh => Unary::Atanh,
            Word::Ceil => Unary::Ceil,
            Word::Cos => Unary::Cos,
            Word::Cosh => Unary::Cosh,
            Word::Degrees => Unary::Degrees,
            Word::Exp => Unary::Exp,
            Word::Floor => Unary::Floor,
            Word::Int => Unary::Int,
            Word::Ln => Unary::Ln,
            Word::Log => Unary::Log,
            Word::Radians => Unary::Radians,
            Word::Sin => Unary::Sin,
            Word::Sinh => Unary::Sinh,
            Word::Sqrt => Unary::Sqrt,
            Word::Tan => Unary::Tan,
            Word::Tanh => Unary::Tanh,
            _ => return None,
        })
    }

    /// The value at `a`.
    #[inline]
    #[must_use]
    pub fn eval(self, a: f64) -> f64 {
        match self {
            Unary::Negative => -a,
            Unary::Abs => a.abs(),
            Unary::Acos => a.acos(),
            Unary::Acosh => acosh(a),
            Unary::Asin => a.asin(),
            Unary::Asinh => asinh(a),
            Unary::Atan => a.atan(),
            Unary::Atanh => atanh(a),
            Unary::Ceil => a.ceil(),
            Unary::Cos => a.cos(),
            Unary::Cosh => a.cosh(),
            Unary::Degrees => a.to_degrees(),
            Unary::Exp => a.exp(),
            Unary::Floor => a.floor(),
            Unary::Int => truncate_to_i32(a),
            Unary::Ln => a.ln(),
            Unary::Log => a.log10(),
            Unary::Radians => a.to_radians(),
            Unary::Sin => a.sin(),
            Unary::Sinh => a.sinh(),
            Unary::Sqrt => a.sqrt(),
            Unary::Tan => a.tan(),
            Unary::Tanh => a.tanh(),
        }
    }
}

impl Binary {
    /// The function of this word; `min` and `max` of more arguments are reduced pairwise.
    #[must_use]
    pub fn of(word: Word) -> Option<Self> {
        Some(match word {
            Word::Atan2 => Binary::Atan2,
            Word::Div => Binary::WholeDiv,
            Word::Mod => Binary::Mod,
            Word::Pow => Binary::Pow,
            Word::Min => Binary::Min,
            Word::Max => Binary::Max,
            _ => return None,
        })
    }

    /// The value at `a` and `b`. Comparisons are exact; NaN counts as true in `&` and `|`.
    #[inline]
    #[must_use]
    pub fn eval(self, a: f64, b: f64) -> f64 {
        match self {
            Binary::Add => a + b,
            Binary::Sub => a - b,
            Binary::Mul => a * b,
            Binary::Div => a / b,
            Binary::And => bool_to_f64(a != 0.0 && b != 0.0),
            Binary::Or => bool_to_f64(a != 0.0 || b != 0.0),
            Binary::Less => bool_to_f64(a < b),
            Binary::LessEqual => bool_to_f64(a <= b),
            Binary::Greater => bool_to_f64(a > b),
            Binary::GreaterEqual => bool_to_f64(a >= b),
            #[allow(clippy::float_cmp, reason = "POV-Ray compares exactly here")]
            Binary::Equal => bool_to_f64(a == b),
            #[allow(clippy::float_cmp, reason = "as above")]
            Binary::NotEqual => bool_to_f64(a != b),
            Binary::Atan2 => a.atan2(b),
            Binary::WholeDiv => truncate_to_i32(a / b),
            Binary::Mod => a % b,
            Binary::Pow => a.powf(b),
            // If either operand is NaN, `min` returns the second and `max` the first.
            Binary::Min => {
                if a < b {
                    a
                } else {
                    b
                }
            }
            Binary::Max => {
                if a < b {
                    b
                } else {
                    a
                }
            }
        }
    }

    /// Returns true for the six comparisons.
    pub(super) fn is_comparison(self) -> bool {
        use Binary::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        matches!(
            self,
            Less | LessEqual | Greater | GreaterEqual | Equal | NotEqual
        )
    }
}

#[inline]
fn bool_to_f64(is: bool) -> f64 {
    f64::from(u8::from(is))
}

/// Truncates to a 32-bit integer; values out of range give the least one, as the x86 conversion does.
#[inline]
fn truncate_to_i32(a: f64) -> f64 {
    let truncated = a.trunc();
    if truncated >= f64::from(i32::MIN) && truncated <= f64::from(i32::MAX) {
        // Turns -0 into +0: an integer has only one zero.
        truncated + 0.0
    } else {
        f64::from(i32::MIN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed by POV-Ray 3.7.
    #[test]
    fn whole_numbers_have_32_bits() {
        assert_eq!(Unary::Int.eval(2e9), 2e9);
        assert_eq!(Unary::Int.eval(2e10), -2_147_483_648.0);
        assert_eq!(Unary::Int.eval(-1.7), -1.0);
        assert_eq!(Binary::WholeDiv.eval(7.0, 0.0), -2_147_483_648.0);
        assert_eq!(Binary::WholeDiv.eval(-7.9, 2.1), -3.0);
    }

    /// Printed by POV-Ray 3.7.
    #[test]
    fn min_max_and_logic_of_nan() {
        let nan = f64::NAN;
        assert!(Binary::Max.eval(nan, 3.0).is_nan() && Binary::Min.eval(3.0, nan).is_nan());
        assert_eq!(Binary::Max.eval(3.0, nan), 3.0);
        assert_eq!(Binary::Min.eval(nan, 3.0), 3.0);
        assert_eq!(Binary::And.eval(nan, 1.0), 1.0);
        assert_eq!(Binary::Equal.eval(2.0, 2.0 + 1e-15), 0.0);
    }
}
