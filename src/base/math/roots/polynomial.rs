//! Sign changes of a polynomial, up to degree four by the chain of its derivatives (Yuksel 2022, "High-performance
//! polynomial root finding for graphics"): the polynomial is monotone between the roots of its derivative, so a
//! bracketed Newton iteration cannot miss. Closed forms of the quartic lose one ray in four in the plane of a torus;
//! this loses none. Above degree four, bisection ([`bernstein`]) costs less than the chain.
//!
//! Error bound: the residual at a root is within a few epsilon of the sum of the coefficients, or the root is within
//! `bracket::LAST_STEP` squared of the exact one. Callers that need more digits refine it on the shape itself, as torus and
//! poly do. A pair of roots whose extremum in between is zero within that rounding may be lost or reported.
//!
//! Coefficients are by ascending power: `c[0] + c[1]·x + c[2]·x² + …`. Only `-1 <= x <= 1` is searched: the caller
//! centres and scales the polynomial, so that its coefficients are of similar size.

use super::bernstein;
use super::bracket::{ROUNDED_END, Roots, bracketed};
use std::ops::Deref;

/// The sign changes of a polynomial in `-1 <= x <= 1`, sorted. Where it only touches zero there is none. Zero counts as
/// positive: a zero at an end is a sign change only if the polynomial is negative next to it.
pub(crate) fn sign_changes(c: &[f64]) -> Roots {
    match *c {
        [c0, c1, c2] => Roots::from_slice(&quadratic(c0, c1, c2)),
        [c0, c1] => Roots::from_slice(&within([(-c0 / c1, SignChange::of_slope(c1))])),
        [] | [_] => Roots::new(),
        [c0, c1, c2, c3] => cubic(&[c0, c1, c2, c3]),
        [c0, c1, c2, c3, c4] => quartic(&[c0, c1, c2, c3, c4]),
        _ => bernstein::sign_changes(c),
    }
}

/// [`sign_changes`] of a cubic.
fn cubic(c: &[f64; 4]) -> Roots {
    between_extrema(c, &quadratic(c[1], 2.0 * c[2], 3.0 * c[3]))
}

/// [`sign_changes`] of a quartic.
pub(crate) fn quartic(c: &[f64; 5]) -> Roots {
    between_extrema(c, &cubic(&[c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4]]))
}

/// [`sign_changes`] with given signs at both ends, so that adjacent intervals agree about their common end. A sign
/// change that rounding creates or hides at an end is removed or added.
pub(crate) fn sign_changes_between(c: &[f64], starts_negative: bool, ends_negative: bool) -> Roots {
    let mut roots = sign_changes(c);
    if (value(c, -1.0) < 0.0) != starts_negative {
        match roots.first() {
            Some(first) if first + 1.0 < ROUNDED_END => {
                roots.remove(0);
            }
            _ => roots.insert(0, -1.0),
        }
    }
    let is_odd = roots.len() % 2 == 1;
    if is_odd != (starts_negative != ends_negative) {
        match roots.last() {
            Some(last) if 1.0 - last < ROUNDED_END => {
                roots.pop();
            }
            _ => roots.push(1.0),
        }
    }
    roots
}

/// True if all Bernstein coefficients of the quartic are positive, which implies that it is positive for
/// `-1 <= x <= 1`.
pub(crate) fn is_quartic_positive(c: &[f64; 5]) -> bool {
    let [c0, c1, c2, c3, c4] = *c;
    let (even, odd) = (c0 + c2 + c4, c1 + c3);
    let (inner_even, inner_odd) = (c0 - c4, 0.5 * (c1 - c3));
    let middle = c0 - c2 / 3.0 + c4;
    even > odd.abs() && inner_even > inner_odd.abs() && middle > 0.0
}

/// The sign changes of a polynomial whose derivative changes sign at `extrema`. `N` is a constant so that the
/// coefficients stay in registers.
fn between_extrema<const N: usize>(c: &[f64; N], extrema: &[f64]) -> Roots {
    let mut roots = Roots::new();
    let mut low = -1.0;
    let mut is_low_negative = value(c, low) < 0.0;
    for &high in extrema.iter().chain(&[1.0]) {
        let is_high_negative = value(c, high) < 0.0;
        if is_low_negative != is_high_negative {
            roots.push(bracketed(c, low, high, is_low_negative));
        }
        (low, is_low_negative) = (high, is_high_negative);
    }
    roots
}

/// The value at a finite `x`.
#[inline]
pub(crate) fn value(c: &[f64], x: f64) -> f64 {
    match c {
        [rest @ .., last] => rest.iter().rev().fold(*last, |sum, c| sum * x + c),
        [] => 0.0,
    }
}

#[inline]
fn quadratic(c0: f64, c1: f64, c2: f64) -> UpToTwoRoots {
    let discriminant = c1 * c1 - 4.0 * c0 * c2;
    if discriminant <= 0.0 {
        return UpToTwoRoots::default();
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let (x, other) = (q / c2, c0 / q);
    let (first, second) = if x < other { (x, other) } else { (other, x) };
    // If `c2` is zero, one root is infinite, on the side given by the sign of zero.
    let rest = SignChange::of_slope(c2);
    within([(first, rest.reversed()), (second, rest)])
}

/// At most two roots.
#[derive(Default)]
struct UpToTwoRoots {
    roots: [f64; 2],
    len: usize,
}

impl Deref for UpToTwoRoots {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.roots[..self.len]
    }
}

/// The direction of a sign change.
#[derive(Clone, Copy, PartialEq)]
enum SignChange {
    Down,
    Up,
}

impl SignChange {
    fn of_slope(slope: f64) -> SignChange {
        if slope.is_sign_negative() {
            SignChange::Down
        } else {
            SignChange::Up
        }
    }

    fn reversed(self) -> SignChange {
        match self {
            SignChange::Down => SignChange::Up,
            SignChange::Up => SignChange::Down,
        }
    }
}

/// The roots within the searched interval; NaN is dropped. Since zero counts as positive, a falling sign change may lie
/// on the lower end and a rising one on the upper.
#[inline]
fn within<const N: usize>(all: [(f64, SignChange); N]) -> UpToTwoRoots {
    let mut inside = UpToTwoRoots::default();
    for (x, direction) in all {
        let is_at_end = match direction {
            SignChange::Down => x == -1.0,
            SignChange::Up => x == 1.0,
        };
        if -1.0 < x && x < 1.0 || is_at_end {
            inside.roots[inside.len] = x;
            inside.len += 1;
        }
    }
    inside
}

#[cfg(test)]
mod exact;

#[cfg(test)]
mod tests {
    use super::*;

    fn product(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |c, root| {
            let mut next = vec![0.0; c.len() + 1];
            for (i, c) in c.iter().enumerate() {
                next[i + 1] += c;
                next[i] -= root * c;
            }
            next
        })
    }

    #[test]
    fn simple_roots_are_returned_in_order() {
        for roots in [
            &[-0.9, -0.2, 0.3, 0.8][..],
            &[0.1, 0.100_1],
            &[-0.5, 0.0, 0.25, 0.5, 0.75],
            &[0.7],
        ] {
            let result = sign_changes(&product(roots));
            assert_eq!(result.len(), roots.len(), "{roots:?}: {result:?}");
            for (a, b) in result.iter().zip(roots) {
                assert!((a - b).abs() < 1e-11, "{roots:?}: {result:?}");
            }
        }
    }

    #[test]
    fn roots_outside_are_dropped_and_double_ones_give_pairs_or_nothing() {
        assert_eq!(sign_changes(&product(&[-3.0, 0.5, 1.5, 7.0])).len(), 1);
        let double = sign_changes(&product(&[0.3, 0.3, 2.0, 3.0]));
        assert!(double.len().is_multiple_of(2));
        assert!(sign_changes(&[1.0, 0.0, 2.0, 0.0, 1.0]).is_empty());
    }

    #[test]
    fn missing_high_powers_are_no_special_case() {
        assert_eq!(sign_changes(&[-0.5, 1.0, 0.0, 0.0, 0.0])[..], [0.5]);
        assert_eq!(sign_changes(&[-0.25, 0.0, 1.0, 0.0, 0.0])[..], [-0.5, 0.5]);
        assert!(sign_changes(&[0.0; 5]).is_empty());
    }

    #[test]
    fn roots_at_the_ends_count_where_the_polynomial_is_negative_within() {
        // Factors of increasing degree exercise the closed forms, the derivative chain and bisection.
        for factor in [
            &[1.0][..],
            &[3.0, 1.0],
            &[2.0, 1.0, 1.0],
            &[4.0, 0.0, 0.0, 0.0, 1.0],
        ] {
            let times = |c: &[f64]| {
                let mut product = vec![0.0; c.len() + factor.len() - 1];
                for (i, a) in c.iter().enumerate() {
                    for (j, b) in factor.iter().enumerate() {
                        product[i + j] += a * b;
                    }
                }
                product
            };
            let near = |c: &[f64], expected: &[f64]| {
                let result = sign_changes(&times(c));
                assert_eq!(result.len(), expected.len(), "{c:?} {factor:?}: {result:?}");
                for (a, b) in result.iter().zip(expected) {
                    assert!((a - b).abs() < 1e-9, "{c:?} {factor:?}: {result:?}");
                }
            };
            near(&[-1.0, 0.0, 1.0], &[-1.0, 1.0]);
            near(&[1.0, 0.0, -1.0], &[]);
            near(&[1.0, 1.0], &[]);
            near(&[-1.0, -1.0], &[-1.0]);
            near(&[-1.0, 1.0], &[1.0]);
            near(&[1.0, -1.0], &[]);
            near(&[0.0, -1.0, 1.0], &[0.0, 1.0]);
            near(&[0.0, 1.0, -1.0], &[0.0]);
        }
    }

    #[test]
    fn a_quartic_reported_positive_is_positive() {
        assert!(is_quartic_positive(&[1.0, 0.5, 0.1, -0.2, 0.1]));
        assert!(!is_quartic_positive(&[-0.1, 0.0, 1.0, 0.0, 0.0]));
        assert!(!is_quartic_positive(&[1.0, 0.0, 0.0, 2.0, 0.0]));
    }
}
