//! Conservative rounding of doubles to single precision, and a fast `floor` and remainder.

use super::simd::F64Lanes;

/// The largest `f32` that is not above `x`; NaN for NaN.
#[inline]
pub(crate) fn f32_below(x: f64) -> f32 {
    let near = nearest(x);
    if f64::from(near) > x {
        near.next_down()
    } else {
        near
    }
}

/// The smallest `f32` that is not below `x`; NaN for NaN.
#[inline]
pub(crate) fn f32_above(x: f64) -> f32 {
    let near = nearest(x);
    if f64::from(near) < x {
        near.next_up()
    } else {
        near
    }
}

/// Minimum distance of a loose bound from its number. It is negligible next to 1, and a millionth of it is still a
/// normal number: arithmetic with subnormals takes a hundred times as long.
const LOOSE: f32 = 1e-30;

/// An `f32` slightly below `x`, cheaper than [`f32_below`]; NaN for positive infinity too.
#[inline(always)]
pub(crate) fn loose_below(x: f64) -> f32 {
    let near = nearest(x);
    near - near.abs() * f32::EPSILON - LOOSE
}

/// An `f32` slightly above `x`, cheaper than [`f32_above`]; NaN for negative infinity too.
#[inline(always)]
pub(crate) fn loose_above(x: f64) -> f32 {
    let near = nearest(x);
    near + near.abs() * f32::EPSILON + LOOSE
}

/// The nearest `f32`.
#[inline]
#[allow(
    clippy::cast_possible_truncation,
    reason = "rounding to single precision is what this is for"
)]
pub(crate) fn nearest(x: f64) -> f32 {
    x as f32
}

/// 2^52: doubles from here on are integers.
const TWO_POW_52: f64 = 4_503_599_627_370_496.0;

/// The largest integer not above `x`: `x.floor()` up to the sign of zero, in a few instructions on any machine.
#[inline]
pub(crate) fn floor(x: f64) -> f64 {
    if x.abs() < TWO_POW_52 {
        // The sum has no fraction bits left, so it is rounded to the nearest integer.
        let near = (x + TWO_POW_52.copysign(x)) - TWO_POW_52.copysign(x);
        if near > x { near - 1.0 } else { near }
    } else {
        x
    }
}

/// [`floor`] in lanes.
#[inline(always)]
pub(crate) fn floor_lanes<F: F64Lanes>(x: F) -> F {
    let limit = F::splat(TWO_POW_52);
    let away = F::select(x.lt(F::splat(0.0)), -limit, limit);
    let near = x + away - away;
    let below = F::select(x.lt(near), near - F::splat(1.0), near);
    F::select(x.abs().lt(limit), below, x)
}

/// `x.rem_euclid(m)` up to the sign of zero, for an integer `m` up to 1,024, without the bitwise loop of `fmod`.
#[inline]
pub(crate) fn remainder(x: f64, m: f64) -> f64 {
    /// Below this the multiples of `m` are exact.
    const MAX_EXACT: f64 = 1e12;
    if x.abs() >= MAX_EXACT || x.is_nan() {
        return x.rem_euclid(m);
    }
    let size = x.abs();
    let left = size - floor(size / m) * m;
    // Rounding may subtract one multiple too many, never one too few.
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

    /// Numbers of all magnitudes and signs, integers and their neighbours among them.
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
                let (fast, exact) = (remainder(x, m), x.rem_euclid(m));
                assert!(is_same(fast, exact), "{x} by {m}: {fast}, not {exact}");
            }
        }
    }
}
