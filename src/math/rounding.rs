//! Single precision bounds of double precision numbers.

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
}
