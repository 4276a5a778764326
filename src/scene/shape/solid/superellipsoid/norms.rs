//! Norms to ten digits in lanes, as many as lanes there are: what the size of a superellipsoid is made of.

use crate::base::math::powers::power;
use crate::base::math::simd::F64Lanes;

/// Keeps a quotient finite.
pub(super) const TINY: f64 = 1e-290;

/// `(part / whole)^(p − 1)` for the least part and the most whole and the other way round, of two parts.
#[inline(always)]
pub(super) fn shares<F: F64Lanes>([a, b]: [[f64; 2]; 2], whole: [f64; 2], p: f64) -> [f64; 4] {
    let part = F::load(&[a[0], a[1], b[0], b[1]]);
    let whole = F::load(&[whole[1], whole[0], whole[1], whole[0]]);
    let ratio = part.over(whole.larger(F::all(TINY)));
    let ratio = F::pick(F::all(0.0).below(whole), ratio, F::all(1.0)).smaller(F::all(1.0));
    if p == 2.0 {
        return ratio.store();
    }
    power(ratio, p - 1.0).store()
}

/// `(a^p + b^p)^(1/p)` of numbers that are not negative.
#[inline(always)]
pub(super) fn norm<F: F64Lanes>(a: F, b: F, p: f64) -> F {
    if p == 1.0 {
        return a.plus(b);
    }
    if p == 2.0 {
        return a.times(a).plus(b.times(b)).root();
    }
    let (small, large) = (a.smaller(b), a.larger(b));
    let rest = power(small.over(large.larger(F::all(TINY))), p);
    large.times(power(F::all(1.0).plus(rest), 1.0 / p))
}

/// The same and its derivatives by both numbers.
#[inline(always)]
pub(super) fn norm_and_shares<F: F64Lanes>(a: F, b: F, p: f64) -> (F, [F; 2]) {
    let one = F::all(1.0);
    if p == 1.0 {
        return (a.plus(b), [one, one]);
    }
    let tiny = F::all(TINY);
    if p == 2.0 {
        let norm = a.times(a).plus(b.times(b)).root();
        let over = one.over(norm.larger(tiny));
        return (norm, [a.times(over), b.times(over)]);
    }
    let (small, large) = (a.smaller(b), a.larger(b));
    let ratio = small.over(large.larger(tiny));
    let rest = power(ratio, p);
    let growth = power(one.plus(rest), 1.0 / p);
    let of_large = growth.over(one.plus(rest));
    let of_nothing = F::all(if p > 1.0 { 0.0 } else { f64::INFINITY });
    let of_small = rest.over(ratio).times(of_large);
    let of_small = F::pick(tiny.below(ratio), of_small, of_nothing);
    let is_first_small = a.below(b);
    let shares = [
        F::pick(is_first_small, of_small, of_large),
        F::pick(is_first_small, of_large, of_small),
    ];
    (large.times(growth), shares)
}
