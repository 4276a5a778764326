//! Single precision bounds of double precision numbers, and parts of them.

use super::simd::F64Lanes;

/// The largest single precision number that is not above `x`; NaN for NaN.
#[inline]
pub(crate) fn f32_below(x: f64) -> f32 {
    let near = nearest(x);
    if f64::from(near) > x {
        near.next_down()
    } else {
        near
    }
}

/// The smallest single precision number that is not below `x`; NaN for NaN.
#[inline]
pub(crate) fn f32_above(x: f64) -> f32 {
    let near = nearest(x);
    if f64::from(near) < x {
        near.next_up()
    } else {
        near
    }
}

/// What loose bounds are at least away from their number: small against anything near one, and large enough for a
/// millionth of it to be a normal number, since arithmetic with others takes a hundred times as long.
const LOOSE: f32 = 1e-30;

/// A single precision number a little below `x`, without the care of [`f32_below`]; NaN for infinity too.
#[inline(always)]
pub(crate) fn loose_below(x: f64) -> f32 {
    let near = nearest(x);
    near - near.abs() * f32::EPSILON - LOOSE
}

/// A single precision number a little above `x`, without the care of [`f32_above`].
#[inline(always)]
pub(crate) fn loose_above(x: f64) -> f32 {
    let near = nearest(x);
    near + near.abs() * f32::EPSILON + LOOSE
}

/// The nearest single precision number.
#[inline]
#[allow(
    clippy::cast_possible_truncation,
    reason = "rounding to single precision is what this is for"
)]
pub(crate) fn nearest(x: f64) -> f32 {
    x as f32
}

/// Numbers from here on have no parts.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// The largest whole number that is not above `x`: `x.floor()`, but for the sign of nothing, in a few instructions on any
/// machine.
#[inline]
pub(crate) fn floor(x: f64) -> f64 {
    if x.abs() < WHOLE {
        // Adding as much leaves no room for parts: what is left is the nearest whole number.
        let near = (x + WHOLE.copysign(x)) - WHOLE.copysign(x);
        if near > x { near - 1.0 } else { near }
    } else {
        x
    }
}

/// [`floor`] of four numbers.
#[inline(always)]
pub(crate) fn floor_of<F: F64Lanes>(x: F) -> F {
    let whole = F::splat(WHOLE);
    let away = F::select(x.lt(F::splat(0.0)), -whole, whole);
    let near = x + away - away;
    let below = F::select(x.lt(near), near - F::splat(1.0), near);
    F::select(x.abs().lt(whole), below, x)
}

/// What is left of `x` after whole multiples of a whole number `m` up to 1,024: `x.rem_euclid(m)`, but for the sign of
/// nothing, without a loop over bits.
#[inline]
pub(crate) fn remainder(x: f64, m: f64) -> f64 {
    /// Multiples of `m` up to here are exact.
    const MOST: f64 = 1e12;
    if x.abs() >= MOST || x.is_nan() {
        return x.rem_euclid(m);
    }
    let size = x.abs();
    let left = size - floor(size / m) * m;
    // Rounding may have made one multiple too many of it, never one too few.
    let left = if left < 0.0 { left + m } else { left };
    if x < 0.0 && left > 0.0 {
        m - left
    } else {
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loose_bounds_are_strict_and_close() {
        for x in [0.0, 0.1, -0.1, 1e-50, -1e-50, 1e-40, -7.9, 16_777_217.0] {
            let (low, high) = (f64::from(loose_below(x)), f64::from(loose_above(x)));
            assert!(low < x && x < high);
            assert!(high - low <= 5e-7 * x.abs() + 3e-30);
        }
        assert_eq!(loose_above(f64::INFINITY), f32::INFINITY);
        assert_eq!(loose_below(f64::NEG_INFINITY), f32::NEG_INFINITY);
    }

    #[test]
    fn the_bounds_hold_the_number_and_are_next_to_each_other() {
        for x in [0.1, -0.1, 1e-50, -1e-50, 3.5, 16_777_217.0] {
            let (low, high) = (f32_below(x), f32_above(x));
            assert!(f64::from(low) <= x && x <= f64::from(high));
            assert!(low == high || low.next_up() == high);
        }
        assert_eq!(f32_below(1e300), f32::MAX);
        assert_eq!(f32_above(1e300), f32::INFINITY);
        assert_eq!(f32_below(f64::NEG_INFINITY), f32::NEG_INFINITY);
    }

    /// Numbers of all sizes and signs, whole ones and their neighbours among them.
    fn numbers() -> impl Iterator<Item = f64> {
        let near = |x: f64| [x, x.next_up(), x.next_down(), x + 0.5, x * 1.3, x * 0.7];
        let sizes = (-60..60)
            .map(|e| 2f64.powi(e))
            .chain((0..200).map(f64::from));
        let all = sizes
            .flat_map(near)
            .chain([1e300, f64::INFINITY, f64::MIN_POSITIVE]);
        all.flat_map(|x| [x, -x]).chain([f64::NAN])
    }

    fn is_same(a: f64, b: f64) -> bool {
        a == b || a.is_nan() && b.is_nan()
    }

    #[test]
    fn floors_are_those_of_the_standard_library() {
        for x in numbers() {
            assert!(is_same(floor(x), x.floor()), "{x}: {}", floor(x));
        }
    }

    #[test]
    fn remainders_are_those_of_the_standard_library() {
        for x in numbers() {
            for m in [1.0, 2.0, 3.0, 6.0, 1000.0] {
                let (own, known) = (remainder(x, m), x.rem_euclid(m));
                assert!(is_same(own, known), "{x} by {m}: {own}, not {known}");
            }
        }
    }
}
