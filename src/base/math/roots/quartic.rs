//! Sign changes of a quartic with a fast path: for most rays that hit a torus the quartic is convex. Newton's iteration
//! on a convex function never passes the root, so it converges from both ends. Error bound: as for
//! [`polynomial::sign_changes`].

use super::bracket::{Roots, bracketed};
use super::polynomial;
use super::polynomial::sign_changes_between;

/// A Newton step below this ends the iteration: convergence is quadratic, the next step would not change a digit.
pub(crate) const LAST_STEP: f64 = 1e-9;
/// With more steps the roots are so close together that the general solver is as fast.
pub(crate) const MAX_STEPS: u32 = 24;

/// Above the error of a value, relative to the Bernstein coefficients.
const ROUNDING: f64 = 1e-12;

/// The sign changes in `-1 < x < 1`, equal to those of [`polynomial::sign_changes`] up to the last digits.
pub(crate) fn quartic_sign_changes(c: &[f64; 5]) -> Roots {
    if is_convex(c)
        && let Some(roots) = from_both_ends(c)
    {
        return roots;
    }
    polynomial::quartic(c)
}

/// The roots of [`sign_changes_between`], up to the last digits. The Bernstein coefficients change sign at least as
/// often as the quartic: no change means no root, one change means one root.
pub(crate) fn quartic_changes_between(
    c: &[f64; 5],
    starts_negative: bool,
    ends_negative: bool,
) -> Roots {
    let form = bernstein_form(c);
    if (form[0] < 0.0) != starts_negative || (form[4] < 0.0) != ends_negative {
        return sign_changes_between(c, starts_negative, ends_negative);
    }
    let changes = form
        .windows(2)
        .filter(|pair| (pair[0] < 0.0) != (pair[1] < 0.0));
    match changes.count() {
        0 => Roots::new(),
        1 => Roots::from_slice(&[bracketed(c, -1.0, 1.0, starts_negative)]),
        _ if !starts_negative && !ends_negative && is_convex(c) => {
            from_both_ends(c).unwrap_or_else(|| polynomial::quartic(c))
        }
        _ if !starts_negative && !ends_negative && is_positive_on_halves(&form) => Roots::new(),
        _ => sign_changes_between(c, starts_negative, ends_negative),
    }
}

/// True if the Bernstein coefficients of both halves (de Casteljau) are positive by more than what rounding does to any
/// value of the quartic.
fn is_positive_on_halves(form: &[f64; 5]) -> bool {
    let middle = |a: f64, b: f64| 0.5 * (a + b);
    let [a, b, c, d, e] = *form;
    let [ab, bc, cd, de] = [middle(a, b), middle(b, c), middle(c, d), middle(d, e)];
    let [abc, bcd, cde] = [middle(ab, bc), middle(bc, cd), middle(cd, de)];
    let [left, right] = [middle(abc, bcd), middle(bcd, cde)];
    let coefficients = [a, ab, abc, left, middle(left, right), right, cde, de, e];
    let least = coefficients.into_iter().fold(f64::INFINITY, f64::min);
    least > ROUNDING * form.iter().fold(0.0, |size: f64, c| size.max(c.abs()))
}

/// The Bernstein coefficients for `-1 <= x <= 1`.
fn bernstein_form(c: &[f64; 5]) -> [f64; 5] {
    let [c0, c1, c2, c3, c4] = *c;
    let (even, odd) = (c0 + c2 + c4, c1 + c3);
    let (inner_even, inner_odd) = (c0 - c4, 0.5 * (c1 - c3));
    [
        even - odd,
        inner_even - inner_odd,
        c0 - c2 / 3.0 + c4,
        inner_even + inner_odd,
        even + odd,
    ]
}

/// True if all Bernstein coefficients of the second derivative are positive, which implies that the quartic is convex
/// for `-1 <= x <= 1`.
fn is_convex(c: &[f64; 5]) -> bool {
    let [_, _, c2, c3, c4] = *c;
    let (even, odd) = (2.0 * c2 + 12.0 * c4, 6.0 * c3);
    even > odd.abs() && 2.0 * c2 > 12.0 * c4
}

/// The two roots, or none, of a convex quartic that is positive at both ends. `None` if that takes too many steps or
/// the premise does not hold.
fn from_both_ends(c: &[f64; 5]) -> Option<Roots> {
    let mut roots = Roots::new();
    for end in [-1.0, 1.0] {
        let mut x = end;
        let mut steps = 0;
        loop {
            let (value, slope) = value_and_slope(c, x);
            // Tests for true, so that NaN is left to the general solver.
            if value <= 0.0 && steps > 0 {
                break;
            }
            let is_above = value > 0.0;
            if !is_above {
                return None;
            }
            // At or past the minimum without a root.
            if slope * end <= 0.0 {
                return Some(Roots::new());
            }
            let next = x - value / slope;
            if next.abs() > 1.0 {
                return Some(Roots::new());
            }
            steps += 1;
            if steps == MAX_STEPS {
                return None;
            }
            let step = (next - x).abs();
            x = next;
            if step < LAST_STEP {
                break;
            }
        }
        roots.push(x);
    }
    (roots[0] < roots[1]).then_some(roots)
}

/// The value and the derivative at `x`.
fn value_and_slope(c: &[f64; 5], x: f64) -> (f64, f64) {
    let [c0, c1, c2, c3, c4] = *c;
    let (a, da) = (c4 * x + c3, c4);
    let (b, db) = (a * x + c2, da * x + a);
    let (c, dc) = (b * x + c1, db * x + b);
    (c * x + c0, dc * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::roots::polynomial::sign_changes;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn the_fast_path_matches_the_general_solver() {
        let mut rng = Random::new(11);
        let (mut quick, mut with_roots) = (0, 0);
        for _ in 0..200_000 {
            let part = |rng: &mut Random, size: f64| (rng.uniform() - 0.5) * size;
            let c = [
                part(&mut rng, 1.0),
                part(&mut rng, 1.0),
                rng.uniform(),
                part(&mut rng, 0.4),
                part(&mut rng, 0.2),
            ];
            let (fast, slow) = (quartic_sign_changes(&c), sign_changes(&c));
            assert_eq!(fast.len(), slow.len(), "{c:?}");
            for (a, b) in fast.iter().zip(&slow) {
                assert!((a - b).abs() < 1e-9, "{c:?}: {a} {b}");
            }
            quick += u32::from(is_convex(&c) && from_both_ends(&c).is_some());
            with_roots += u32::from(fast.len() == 2);
        }
        assert!(
            quick > 50_000 && with_roots > 10_000,
            "{quick} {with_roots}"
        );
    }

    #[test]
    fn a_double_root_is_left_to_the_general_solver() {
        let square = [0.09, -0.6, 1.0, 0.0, 0.0];
        assert!(is_convex(&square));
        let roots = quartic_sign_changes(&square);
        assert!(roots.len().is_multiple_of(2));
    }

    #[test]
    fn changes_between_known_signs_match_the_general_solver() {
        let mut rng = Random::new(12);
        let mut counts = [0; 5];
        for _ in 0..200_000 {
            let c = [(); 5].map(|()| rng.uniform() - 0.5);
            let is_negative = |x: f64| polynomial::value(&c, x) < 0.0;
            let signs = (is_negative(-1.0), is_negative(1.0));
            let fast = quartic_changes_between(&c, signs.0, signs.1);
            let slow = sign_changes_between(&c, signs.0, signs.1);
            assert_eq!(fast.len(), slow.len(), "{c:?}");
            for (a, b) in fast.iter().zip(&slow) {
                assert!((a - b).abs() < 1e-9, "{c:?}: {a} {b}");
            }
            counts[fast.len()] += 1;
        }
        assert!(counts[..3].iter().all(|&count| count > 1000), "{counts:?}");
    }
}
