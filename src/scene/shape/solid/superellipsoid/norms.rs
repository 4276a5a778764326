//! Norms to ten digits, generic over the number of lanes.

use crate::base::math::powers::power;
use crate::base::math::simd::F64Lanes;

/// Keeps a quotient finite.
pub(super) const TINY: f64 = 1e-290;

/// `(part / whole)^(p − 1)` for the least part and the largest whole and the other way round, of two parts.
#[inline(always)]
pub(super) fn derivatives<F: F64Lanes>([a, b]: [[f64; 2]; 2], whole: [f64; 2], p: f64) -> [f64; 4] {
    let part = F::from_array(&[a[0], a[1], b[0], b[1]]);
    let whole = F::from_array(&[whole[1], whole[0], whole[1], whole[0]]);
    let ratio = part / whole.lane_max(F::splat(TINY));
    let ratio = F::select(F::splat(0.0).lt(whole), ratio, F::splat(1.0)).lane_min(F::splat(1.0));
    if p == 2.0 {
        return ratio.to_array();
    }
    power(ratio, p - 1.0).to_array()
}

/// `(a^p + b^p)^(1/p)` of numbers that are not negative.
#[inline(always)]
pub(super) fn norm<F: F64Lanes>(a: F, b: F, p: f64) -> F {
    if p == 1.0 {
        return a + b;
    }
    if p == 2.0 {
        return (a * a + b * b).sqrt();
    }
    let (small, large) = (a.lane_min(b), a.lane_max(b));
    let rest = power(small / large.lane_max(F::splat(TINY)), p);
    large * power(F::splat(1.0) + rest, 1.0 / p)
}

/// [`norm`] and its derivatives by both numbers.
#[inline(always)]
pub(super) fn norm_and_derivatives<F: F64Lanes>(a: F, b: F, p: f64) -> (F, [F; 2]) {
    let one = F::splat(1.0);
    if p == 1.0 {
        return (a + b, [one, one]);
    }
    let tiny = F::splat(TINY);
    if p == 2.0 {
        let norm = (a * a + b * b).sqrt();
        let over = one / norm.lane_max(tiny);
        return (norm, [a * over, b * over]);
    }
    let (small, large) = (a.lane_min(b), a.lane_max(b));
    let ratio = small / large.lane_max(tiny);
    let rest = power(ratio, p);
    let growth = power(one + rest, 1.0 / p);
    let of_large = growth / (one + rest);
    let of_nothing = F::splat(if p > 1.0 { 0.0 } else { f64::INFINITY });
    let of_small = rest / ratio * of_large;
    let of_small = F::select(tiny.lt(ratio), of_small, of_nothing);
    let is_first_small = a.lt(b);
    let derivatives = [
        F::select(is_first_small, of_small, of_large),
        F::select(is_first_small, of_large, of_small),
    ];
    (large * growth, derivatives)
}
