//! Powers to ten digits in lanes, for estimates that something exact follows: four at once cost less than one of the
//! library, which rounds to the last digit.
//!
//! The logarithm to base 2 is the series of the inverse hyperbolic tangent about the mantissa nearest to 1, the power of
//! 2 that of the exponential about the nearest whole exponent.

use super::simd::F64Lanes;
use std::f64::consts::{LN_2, SQRT_2};

/// Above the relative error of [`power`] for exponents up to 256 in size, where the power is above `1e-100`; below, it is
/// so small.
pub(crate) const POWER_ERROR: f64 = 1e-9;

/// Below this a number counts as zero.
const LEAST: f64 = 1e-290;
/// Powers of 2 with a smaller exponent are this one.
const LEAST_EXPONENT: f64 = -1000.0;
/// And the largest.
const MOST_EXPONENT: f64 = 1000.0;
/// A number to which this is added is rounded to a whole one.
const ROUNDER: f64 = 1.5 / f64::EPSILON;

/// `x^p` as the library has it, without the cost of its call for the exponents 0, 1 and 2. One square of a thousand differs
/// from the library's in the last digit.
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

/// `x^p`, for `0 <= x` and a finite `p`; of zero it is zero, one or infinity as the exponent is above, at or below zero.
#[inline(always)]
pub(crate) fn power<F: F64Lanes>(x: F, p: f64) -> F {
    let of_zero = if p > 0.0 {
        0.0
    } else if p == 0.0 {
        1.0
    } else {
        f64::INFINITY
    };
    let is_zero = x.lt(F::splat(LEAST));
    let power = two_to(log2(x.lane_max(F::splat(LEAST))) * F::splat(p));
    F::select(is_zero, F::splat(of_zero), power)
}

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
        .lane_max(F::splat(LEAST_EXPONENT))
        .lane_min(F::splat(MOST_EXPONENT));
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
    fn powers_are_right_to_the_error_that_is_said() {
        let mut rng = Random::new(3);
        for _ in 0..100_000 {
            let p =
                2.0_f64.powf(16.0 * rng.share() - 8.0) * if rng.share() < 0.5 { 1.0 } else { -1.0 };
            let x = rng.share() * 2.0_f64.powf(40.0 * rng.share() - 20.0);
            let (found, exact) = (power(x, p), x.powf(p));
            if exact > 1e-100 && exact < 1e100 {
                assert!(
                    (found / exact - 1.0).abs() < POWER_ERROR,
                    "{x}^{p}: {found} {exact}"
                );
            } else if exact < 1.0 {
                assert!(found < 1e-99, "{x}^{p}: {found} {exact}");
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
            let x = [(); 4].map(|()| rng.share() * 10.0_f64.powf(20.0 * rng.share() - 10.0));
            let p = 8.0 * rng.share() - 4.0;
            let wide = with_widest(|lanes| lanes.run(Powers(x, p)));
            assert_eq!(wide, x.map(|x| power(x, p)));
            assert_eq!(wide, SimdLevel::NARROW.run(Powers(x, p)));
        }
    }
}
