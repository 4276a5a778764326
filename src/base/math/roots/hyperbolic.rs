//! The inverse hyperbolic functions, equal to the last bit to those of Debian's C library.
//!
//! Rust's own compute the logarithm differently. The formulas are those of Sun's fdlibm (1993), which has one without
//! cancellation for each range of the argument.

use std::f64::consts::LN_2;

/// Above this x² + 1 rounds to x².
const LARGE: f64 = 268_435_456.0;

/// The inverse of `sinh`.
pub(crate) fn asinh(x: f64) -> f64 {
    let a = x.abs();
    let value = if !x.is_finite() || a < 1.0 / LARGE {
        return x;
    } else if a > LARGE {
        a.ln() + LN_2
    } else if a > 2.0 {
        (2.0 * a + 1.0 / ((a * a + 1.0).sqrt() + a)).ln()
    } else {
        let t = a * a;
        (a + t / (1.0 + (1.0 + t).sqrt())).ln_1p()
    };
    value.copysign(x)
}

/// The inverse of `cosh`; NaN below 1.
pub(crate) fn acosh(x: f64) -> f64 {
    if x < 1.0 {
        f64::NAN
    } else if x >= LARGE {
        x.ln() + LN_2
    } else if x > 2.0 {
        (2.0 * x - 1.0 / (x + (x * x - 1.0).sqrt())).ln()
    } else {
        let t = x - 1.0;
        (t + (2.0 * t + t * t).sqrt()).ln_1p()
    }
}

/// The inverse of `tanh`; infinite at ±1, NaN beyond.
pub(crate) fn atanh(x: f64) -> f64 {
    let a = x.abs();
    let value = if a < 1.0 / LARGE {
        return x;
    } else if a < 0.5 {
        let t = a + a;
        0.5 * (t + t * a / (1.0 - a)).ln_1p()
    } else if a < 1.0 {
        0.5 * ((a + a) / (1.0 - a)).ln_1p()
    } else if a > 1.0 {
        return f64::NAN;
    } else {
        return x / 0.0;
    };
    value.copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_the_c_library() {
        let known = [
            (asinh(2.7), 1.719_051_851_208_927_2),
            (asinh(9.9), 2.988_222_993_214_151_7),
            (asinh(-0.3), -0.295_673_047_563_422_44),
            (acosh(1.3), 0.756_432_910_856_959_6),
            (acosh(5.5), 2.389_526_434_574_218_4),
            (atanh(0.1), 0.100_335_347_731_075_58),
            (atanh(-0.3), -0.309_519_604_203_111_75),
        ];
        for (value, expected) in known {
            assert_eq!(
                value.to_bits(),
                f64::to_bits(expected),
                "{value} {expected}"
            );
        }
        assert!(acosh(0.5).is_nan() && atanh(1.5).is_nan() && asinh(f64::NAN).is_nan());
        assert!(atanh(1.0).is_infinite() && acosh(1.0) == 0.0);
    }
}
