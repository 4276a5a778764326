//! Powers in SIMD lanes with a relative error of 1e-9, for estimates that precede an exact test: four together cost
//! less than one call of `powf`, which is accurate to the last digit.
//!
//! `log2` uses the atanh series for the mantissa reduced to 1/√2..√2, `2^y` the exponential series around the nearest
//! integer.

use super::simd::F64Lanes;
use std::f64::consts::{LN_2, SQRT_2};

/// Upper bound of the relative error of [`power`] for exponents from -256 to 256, if the result is above `1e-100`.
/// Smaller powers give a result below `1e-99`.
pub(crate) const POWER_ERROR: f64 = 1e-9;

/// Numbers below this count as zero.
const LEAST: f64 = 1e-290;
/// Exponents of 2 are clamped to this from below
const MIN_EXPONENT: f64 = -1000.0;
/// and to this from above.
const MAX_EXPONENT: f64 = 1000.0;
/// Adding this rounds a number to an integer.
const ROUNDER: f64 = 1.5 / f64::EPSILON;

/// `x.powf(p)` without the cost of the call for the exponents 0, 1 and 2. One square in a thousand differs from `powf`
/// in the last digit.
#[inline]
pub(crate) fn exact_power(x: f64, p: f64) -> f64 {
    if p == 1.0 {
        x
    } else if p == 2.0 {
        x * x
    } else if p == 0.0 {
        1.0
    } else {
        x.powf(p)
    }
}

/// `x^p` for `x >= 0` and a finite `p`. For `x = 0` it is 0, 1 or infinity for a positive, zero or negative `p`.
#[inline(always)]
pub(crate) fn power<F: F64Lanes>(x: F, p: f64) -> F {
    let power_of_zero = if p > 0.0 {
        0.0
    } else if p == 0.0 {
        1.0
    } else {
        f64::INFINITY
    };
    let is_zero = x.lt(F::splat(LEAST));
    let power = two_to(log2(x.lane_max(F::splat(LEAST))) * F::splat(p));
    F::select(is_zero, F::splat(power_of_zero), power)
}

/// The logarithm to base 2 of positive normal numbers.
#[inline(always)]
fn log2<F: F64Lanes>(x: F) -> F {
    let [exponent, mantissa] = x.exponent_and_mantissa();
    let is_large = F::splat(SQRT_2).lt(mantissa);
    let mantissa = F::select(is_large, mantissa * F::splat(0.5), mantissa);
    let exponent = F::select(is_large, exponent + F::splat(1.0), exponent);
    let one = F::splat(1.0);
    let s = (mantissa - one) / (mantissa + one);
    let square = s * s;
    let mut sum = F::splat(1.0 / 13.0);
    for odd in [11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        sum = sum * square + F::splat(1.0 / odd);
    }
    exponent + s * sum * F::splat(2.0 / LN_2)
}

/// `2^y`.
#[inline(always)]
fn two_to<F: F64Lanes>(y: F) -> F {
    let y = y
        .lane_max(F::splat(MIN_EXPONENT))
        .lane_min(F::splat(MAX_EXPONENT));
    let whole = y + F::splat(ROUNDER) - F::splat(ROUNDER);
    let x = (y - whole) * F::splat(LN_2);
    let mut sum = F::splat(1.0 / 362_880.0);
    for factorial in [40_320.0, 5_040.0, 720.0, 120.0, 24.0, 6.0, 2.0, 1.0, 1.0] {
        sum = sum * x + F::splat(1.0 / factorial);
    }
    sum * whole.exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel, with_widest};

    struct Powers([f64; 4], f64);

    impl SimdKernel for Powers {
        type Output = [f64; 4];
        #[inline(always)]
        fn run<F: F64x4>(self) -> [f64; 4] {
            power(F::from_array(&self.0), self.1).to_array()
        }
    }

    #[test]
    fn powers_are_within_the_stated_error() {
        let mut rng = Random::new(3);
        for _ in 0..100_000 {
            let p = 2.0_f64.powf(16.0 * rng.uniform() - 8.0)
                * if rng.uniform() < 0.5 { 1.0 } else { -1.0 };
            let x = rng.uniform() * 2.0_f64.powf(40.0 * rng.uniform() - 20.0);
            let (approx, exact) = (power(x, p), x.powf(p));
            if exact > 1e-100 && exact < 1e100 {
                assert!(
                    (approx / exact - 1.0).abs() < POWER_ERROR,
                    "{x}^{p}: {approx} {exact}"
                );
            } else if exact < 1.0 {
                assert!(approx < 1e-99, "{x}^{p}: {approx} {exact}");
            }
        }
    }

    #[test]
    fn zero_has_powers_too() {
        assert_eq!(power(0.0, 0.3), 0.0);
        assert_eq!(power(0.0, 0.0), 1.0);
        assert_eq!(power(0.0, -0.3), f64::INFINITY);
        assert_eq!(power(1.0, 7.0), 1.0);
    }

    #[test]
    fn lanes_give_the_bits_of_single_numbers() {
        let mut rng = Random::new(4);
        for _ in 0..10_000 {
            let x = [(); 4].map(|()| rng.uniform() * 10.0_f64.powf(20.0 * rng.uniform() - 10.0));
            let p = 8.0 * rng.uniform() - 4.0;
            let wide = with_widest(|lanes| lanes.run(Powers(x, p)));
            assert_eq!(wide, x.map(|x| power(x, p)));
            assert_eq!(wide, SimdLevel::NARROW.run(Powers(x, p)));
        }
    }
}
