//! The values of the built-in functions of numbers and vectors, shared by all evaluators.

use super::value::Number;
use crate::base::args::Word;
use crate::base::math::conditioning::Normalization;
use crate::base::math::roots::hyperbolic;
use crate::base::math::{axis_rotation, rotation};
use crate::lang::limits::EQUAL;
use glam::DVec3;

/// A function of one vector.
pub(crate) fn vector(word: Word, v: DVec3, normalization: Normalization) -> Number {
    match word {
        Word::Vlength => Number::float(v.length()),
        _ => Number::vector(normalization.unit_or_zero(v)),
    }
}

/// A function of two vectors, and of degrees for a turn about an axis.
pub(crate) fn vectors(word: Word, a: DVec3, b: DVec3, degrees: f64) -> Number {
    match word {
        Word::Vdot => Number::float(a.dot(b)),
        Word::Vcross => Number::vector(a.cross(b)),
        Word::Vrotate => Number::vector(rotation(b) * a),
        _ if b == DVec3::ZERO => Number::vector(DVec3::splat(-f64::NAN)),
        _ => Number::vector(axis_rotation(b, degrees) * a),
    }
}

/// True if a number is outside the domain of a function; it is clamped with a warning.
pub(crate) fn is_outside(word: Word, a: f64) -> bool {
    matches!(word, Word::Acos | Word::Asin) && a.abs() > 1.0
}

pub(crate) fn is_of_two(word: Word) -> bool {
    use Word::{Atan2, BitwiseAnd, BitwiseOr, BitwiseXor, Div, Mod, Pow};
    matches!(
        word,
        Atan2 | BitwiseAnd | BitwiseOr | BitwiseXor | Div | Mod | Pow
    )
}

pub(crate) fn is_of_one(word: Word) -> bool {
    use Word::{
        Abs, Acos, Acosh, Asin, Asinh, Atan, Atanh, Ceil, Cos, Cosh, Degrees, Exp, Floor, Int, Ln,
        Log, Radians, Sin, Sinh, Sqrt, Tan, Tanh,
    };
    matches!(
        word,
        Abs | Acos
            | Acosh
            | Asin
            | Asinh
            | Atan
            | Atanh
            | Ceil
            | Cos
            | Cosh
            | Degrees
            | Exp
            | Floor
            | Int
            | Ln
            | Log
            | Radians
            | Sin
            | Sinh
            | Sqrt
            | Tan
            | Tanh
    )
}

/// A function of one argument, or the fault of the argument.
pub(crate) fn one(word: Word, a: f64) -> Result<f64, String> {
    Ok(match word {
        Word::Abs => a.abs(),
        Word::Acos => a.clamp(-1.0, 1.0).acos(),
        Word::Acosh => hyperbolic::acosh(a),
        Word::Asin => a.clamp(-1.0, 1.0).asin(),
        Word::Asinh => hyperbolic::asinh(a),
        Word::Atan => a.atan(),
        Word::Atanh => hyperbolic::atanh(a),
        Word::Ceil => a.ceil(),
        Word::Cos => a.cos(),
        Word::Cosh => a.cosh(),
        Word::Degrees => a.to_degrees(),
        Word::Exp => a.exp(),
        Word::Floor => a.floor(),
        Word::Int => f64::from(whole(a)),
        Word::Ln | Word::Log if a <= 0.0 => {
            return Err(format!("the logarithm of {a} does not exist"));
        }
        Word::Ln => a.ln(),
        Word::Log => a.log10(),
        Word::Radians => a.to_radians(),
        Word::Sin => a.sin(),
        Word::Sinh => a.sinh(),
        Word::Sqrt if a < 0.0 => return Err(format!("the square root of {a} does not exist")),
        Word::Sqrt => a.sqrt(),
        Word::Tan => a.tan(),
        _ => a.tanh(),
    })
}

/// A function of two arguments, or the fault of the arguments.
pub(crate) fn two(word: Word, a: f64, b: f64) -> Result<f64, String> {
    Ok(match word {
        Word::Atan2 if a == 0.0 && b == 0.0 => {
            return Err("`atan2(0, 0)` does not exist".to_owned());
        }
        Word::Atan2 => a.atan2(b),
        Word::BitwiseAnd | Word::BitwiseOr | Word::BitwiseXor => bits(word, a, b),
        Word::Div => f64::from(whole(a / b)),
        Word::Mod if b == 0.0 => -f64::NAN,
        Word::Mod => a % b,
        _ if a == 0.0 && b == 0.0 => return Err("`pow(0, 0)` does not exist".to_owned()),
        _ => a.powf(b),
    })
}

/// Truncates to 32 bits as POV-Ray does; values out of range give `i32::MIN`.
pub(crate) fn whole(value: f64) -> i32 {
    let value = value.trunc();
    if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value) {
        #[allow(clippy::cast_possible_truncation, reason = "checked just above")]
        let whole = value as i32;
        whole
    } else {
        i32::MIN
    }
}

pub(crate) fn bits(word: Word, a: f64, b: f64) -> f64 {
    let (a, b) = (whole(a), whole(b));
    f64::from(match word {
        Word::BitwiseAnd => a & b,
        Word::BitwiseOr => a | b,
        _ => a ^ b,
    })
}

/// As C's `strcmp`: the difference of the first letters that differ; the end of a string counts as zero.
pub(crate) fn difference(left: &str, right: &str) -> i32 {
    let codes =
        |text: &str| -> Vec<i64> { text.chars().map(|c| i64::from(u32::from(c))).collect() };
    let (left, right) = (codes(left), codes(right));
    let code = |text: &[i64], at: usize| text.get(at).copied().unwrap_or(0);
    let differences = (0..left.len().max(right.len())).map(|at| code(&left, at) - code(&right, at));
    let first = differences.into_iter().find(|&difference| difference != 0);
    i32::try_from(first.unwrap_or(0)).unwrap_or(0)
}

/// The number at the start of a string by the rules of C's `atof`; 0 if there is none.
pub(crate) fn leading_number(text: &str) -> f64 {
    let text = text.trim_start();
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    let start = |word: &str| {
        unsigned
            .get(..word.len())
            .is_some_and(|s| s.eq_ignore_ascii_case(word))
    };
    if start("inf") {
        return sign * f64::INFINITY;
    }
    if start("nan") {
        return sign * f64::NAN;
    }
    if start("0x") {
        let digits = unsigned[2..].chars().map_while(|c| c.to_digit(16));
        return sign * digits.fold(0.0, |sum, digit| 16.0 * sum + f64::from(digit));
    }
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    (0..=end)
        .rev()
        .filter(|&at| text.is_char_boundary(at))
        .find_map(|at| text[..at].parse().ok())
        .unwrap_or(0.0)
}

/// The index of an item, without its decimals; `None` if the array has no such item.
pub(crate) fn whole_index(index: f64, size: usize) -> Option<usize> {
    let whole = (index + EQUAL.copysign(index)).trunc();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 <= whole < size"
    )]
    (whole >= 0.0 && whole < size as f64).then_some(whole as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with POV-Ray.
    #[test]
    fn numbers_at_the_start_of_texts_are_those_of_atof() {
        let texts = [
            "12",
            "  -1.5e-2 z",
            "abc",
            "",
            ".5",
            "0x10",
            "1e",
            "+3",
            "1,2",
            "1.2.3",
        ];
        let expected = [12.0, -0.015, 0.0, 0.0, 0.5, 16.0, 1.0, 3.0, 1.0, 1.2];
        assert_eq!(texts.map(leading_number), expected);
        assert_eq!(leading_number("inf"), f64::INFINITY);
        assert_eq!(leading_number("\u{e4}"), 0.0);
    }

    #[test]
    fn texts_are_compared_by_their_first_difference() {
        assert_eq!(difference("a", "b"), -1);
        assert_eq!(difference("abcd", "abc"), 100);
        assert_eq!(difference("", "z"), -122);
        assert_eq!(difference("abc", "abc"), 0);
    }

    #[test]
    fn whole_numbers_have_32_bits() {
        assert_eq!(whole(-3.9), -3);
        assert_eq!(whole(1e12), i32::MIN);
        assert_eq!(whole(f64::NAN), i32::MIN);
        assert_eq!(
            bits(Word::BitwiseOr, 4_294_967_296.0, 1.0),
            -2_147_483_647.0
        );
    }
}
