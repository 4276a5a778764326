//! Where a polynomial changes sign, up to degree four by the chain of its derivatives (Yuksel 2022, "High-performance
//! polynomial root finding for graphics"): between the zeros of its derivative it is monotone, so a bracketed Newton
//! iteration cannot miss. Closed forms for degree four lose one ray in four in the plane of a torus; this loses none.
//! Chains of higher degree cost more than halving ([`bernstein`]).
//!
//! Error bound: the value at a place that is found is within a few roundings of the sum of the coefficients, or the place
//! within [`LAST_STEP`] squared of the zero; who wants more digits refines it on the shape itself, as torus and poly do. A
//! pair of changes whose extreme between them is within that rounding of zero may be lost or found.
//!
//! Coefficients stand by rising power: `c[0] + c[1]·x + c[2]·x² + …`. Only `-1 <= x <= 1` is searched; whoever asks has
//! centred and scaled the polynomial so that its coefficients are of one size there.

use super::bernstein;
use smallvec::SmallVec;
use std::ops::Deref;

/// Places on a line, in order.
pub(crate) type Roots = SmallVec<[f64; 8]>;

/// A Newton step below this ends the iteration: the step after it would be below the last digit.
const LAST_STEP: f64 = 1e-9;

/// How near to an end a change may come from rounding.
const ROUNDED_END: f64 = 1e-7;

/// More halvings than a double has digits.
const MAX_STEPS: u32 = 80;

/// The places in `-1 <= x <= 1` where a polynomial changes sign, in order. Where it only touches zero there is none. Zero
/// counts as positive: at an end where it is zero it changes only if it is negative just beside.
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

fn cubic(c: &[f64; 4]) -> Roots {
    between_turns(c, &quadratic(c[1], 2.0 * c[2], 3.0 * c[3]))
}

/// The same as [`sign_changes`] for a quartic.
pub(crate) fn quartic(c: &[f64; 5]) -> Roots {
    between_turns(c, &cubic(&[c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4]]))
}

/// The same where the signs at both ends are known from elsewhere, so that neighbouring stretches agree about the end
/// they share: a change that only rounding makes or hides at an end is taken away or put there.
pub(crate) fn sign_changes_between(c: &[f64], starts_negative: bool, ends_negative: bool) -> Roots {
    let mut places = sign_changes(c);
    if (value(c, -1.0) < 0.0) != starts_negative {
        match places.first() {
            Some(first) if first + 1.0 < ROUNDED_END => {
                places.remove(0);
            }
            _ => places.insert(0, -1.0),
        }
    }
    let is_odd = places.len() % 2 == 1;
    if is_odd != (starts_negative != ends_negative) {
        match places.last() {
            Some(last) if 1.0 - last < ROUNDED_END => {
                places.pop();
            }
            _ => places.push(1.0),
        }
    }
    places
}

/// Whether the quartic is positive for `-1 <= x <= 1` because all its Bernstein coefficients there are.
pub(crate) fn is_quartic_positive(c: &[f64; 5]) -> bool {
    let [c0, c1, c2, c3, c4] = *c;
    let (even, odd) = (c0 + c2 + c4, c1 + c3);
    let (inner_even, inner_odd) = (c0 - c4, 0.5 * (c1 - c3));
    let middle = c0 - c2 / 3.0 + c4;
    even > odd.abs() && inner_even > inner_odd.abs() && middle > 0.0
}

/// The changes of a polynomial whose derivative changes its sign at `stops`. The number of coefficients is known, so that
/// they stay in registers.
fn between_turns<const N: usize>(c: &[f64; N], stops: &[f64]) -> Roots {
    let mut places = Roots::new();
    let mut low = -1.0;
    let mut is_low_negative = value(c, low) < 0.0;
    for &high in stops.iter().chain(&[1.0]) {
        let is_high_negative = value(c, high) < 0.0;
        if is_low_negative != is_high_negative {
            places.push(bracketed(c, low, high, is_low_negative));
        }
        (low, is_low_negative) = (high, is_high_negative);
    }
    places
}

/// Newton's iteration for the one root between `low` and `high`, halving where a step would leave the bracket.
#[inline]
pub(crate) fn bracketed<C>(c: &C, mut low: f64, mut high: f64, is_rising: bool) -> f64
where
    C: AsRef<[f64]> + ?Sized,
{
    let c = c.as_ref();
    let mut x = 0.5 * (low + high);
    for _ in 0..MAX_STEPS {
        let (value, slope) = value_and_slope(c, x);
        if value == 0.0 {
            break;
        }
        if (value < 0.0) == is_rising {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let is_inside = low < newton && newton < high;
        let next = if is_inside {
            newton
        } else {
            0.5 * (low + high)
        };
        let step = (next - x).abs();
        x = next;
        if step < LAST_STEP && is_inside || step == 0.0 {
            break;
        }
    }
    x
}

/// The value at a place.
#[inline]
pub(crate) fn value(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[inline]
fn value_and_slope(c: &[f64], x: f64) -> (f64, f64) {
    let both = |(value, slope): (f64, f64), c: &f64| (value * x + c, slope * x + value);
    c.iter().rev().fold((0.0, 0.0), both)
}

#[inline]
fn quadratic(c0: f64, c1: f64, c2: f64) -> FewRoots {
    let discriminant = c1 * c1 - 4.0 * c0 * c2;
    if discriminant <= 0.0 {
        return FewRoots::default();
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let (x, other) = (q / c2, c0 / q);
    let (first, second) = if x < other { (x, other) } else { (other, x) };
    // Infinitely far from the other one if `c2` is zero, on the side that its sign tells.
    let rest = SignChange::of_slope(c2);
    within([(first, rest.back()), (second, rest)])
}

/// Two places at the most.
#[derive(Default)]
struct FewRoots {
    places: [f64; 2],
    len: usize,
}

impl Deref for FewRoots {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.places[..self.len]
    }
}

/// The sense in which a polynomial changes sign.
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

    fn back(self) -> SignChange {
        match self {
            SignChange::Down => SignChange::Up,
            SignChange::Up => SignChange::Down,
        }
    }
}

/// Those that lie in the searched range; not NaN. Since zero counts as positive, a way down begins on a zero, and a way
/// up ends on one.
#[inline]
fn within<const N: usize>(all: [(f64, SignChange); N]) -> FewRoots {
    let mut few = FewRoots::default();
    for (x, way) in all {
        let is_at_end = match way {
            SignChange::Down => x == -1.0,
            SignChange::Up => x == 1.0,
        };
        if -1.0 < x && x < 1.0 || is_at_end {
            few.places[few.len] = x;
            few.len += 1;
        }
    }
    few
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
    fn simple_roots_are_found_in_order() {
        for roots in [
            &[-0.9, -0.2, 0.3, 0.8][..],
            &[0.1, 0.100_1],
            &[-0.5, 0.0, 0.25, 0.5, 0.75],
            &[0.7],
        ] {
            let found = sign_changes(&product(roots));
            assert_eq!(found.len(), roots.len(), "{roots:?}: {found:?}");
            for (a, b) in found.iter().zip(roots) {
                assert!((a - b).abs() < 1e-11, "{roots:?}: {found:?}");
            }
        }
    }

    #[test]
    fn roots_outside_are_left_out_and_double_ones_come_in_pairs_or_not_at_all() {
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
    fn roots_at_the_ends_are_found_where_it_is_negative_within() {
        // By the degree of what is multiplied with the roots: the closed forms, the chain and the halving.
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
                let found = sign_changes(&times(c));
                assert_eq!(found.len(), expected.len(), "{c:?} {factor:?}: {found:?}");
                for (a, b) in found.iter().zip(expected) {
                    assert!((a - b).abs() < 1e-9, "{c:?} {factor:?}: {found:?}");
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
    fn a_quartic_called_positive_is() {
        assert!(is_quartic_positive(&[1.0, 0.5, 0.1, -0.2, 0.1]));
        assert!(!is_quartic_positive(&[-0.1, 0.0, 1.0, 0.0, 0.0]));
        assert!(!is_quartic_positive(&[1.0, 0.0, 0.0, 2.0, 0.0]));
    }
}
