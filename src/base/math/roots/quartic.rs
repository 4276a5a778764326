//! Where a quartic changes sign, by the quick way where there is one: most rays that meet a torus meet it where the
//! quartic bends only one way, and there Newton's iteration from either end runs straight into the root: on a convex
//! function it never passes it. Error bound: that of [`sign_changes`].

use super::polynomial::{self, Roots, bracketed, sign_changes_between};

/// A Newton step below this ends the iteration: the step after it would be below the last digit.
pub(crate) const LAST_STEP: f64 = 1e-9;
/// With more steps the roots are so close to each other that the careful way is as fast.
pub(crate) const MAX_STEPS: u32 = 24;

/// The same places in `-1 < x < 1` as [`polynomial::sign_changes`] finds, up to the last digits.
pub(crate) fn quartic_sign_changes(c: &[f64; 5]) -> Roots {
    if bends_up(c)
        && let Some(places) = from_both_ends(c)
    {
        return places;
    }
    polynomial::quartic(c)
}

/// The same as [`sign_changes_between`], up to the last digits. The coefficients in the Bernstein basis change sign at
/// least as often as the quartic: with none there is no root, and with one there is one.
pub(crate) fn quartic_changes_between(
    c: &[f64; 5],
    starts_negative: bool,
    ends_negative: bool,
) -> Roots {
    let form = bernstein_form(c);
    let is_negative = form.map(|c| c < 0.0);
    if is_negative[0] != starts_negative || is_negative[4] != ends_negative {
        return sign_changes_between(c, starts_negative, ends_negative);
    }
    let changes = is_negative.windows(2).filter(|pair| pair[0] != pair[1]);
    match changes.count() {
        0 => Roots::new(),
        1 => Roots::from_slice(&[bracketed(c, -1.0, 1.0, starts_negative)]),
        _ if !starts_negative && !ends_negative && bends_up(c) => {
            from_both_ends(c).unwrap_or_else(|| polynomial::quartic(c))
        }
        _ => sign_changes_between(c, starts_negative, ends_negative),
    }
}

/// The coefficients in the Bernstein basis of `-1 <= x <= 1`.
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

/// Whether the second derivative is positive for `-1 <= x <= 1` because all its Bernstein coefficients there are.
fn bends_up(c: &[f64; 5]) -> bool {
    let [_, _, c2, c3, c4] = *c;
    let (even, odd) = (2.0 * c2 + 12.0 * c4, 6.0 * c3);
    even > odd.abs() && 2.0 * c2 > 12.0 * c4
}

/// The two roots of a quartic that bends up and is positive at both ends, or none; `None` if it takes too long to say.
fn from_both_ends(c: &[f64; 5]) -> Option<Roots> {
    let mut places = Roots::new();
    for end in [-1.0, 1.0] {
        let mut x = end;
        let mut steps = 0;
        loop {
            let (value, slope) = value_and_slope(c, x);
            // Asked in the positive: NaN takes the careful way.
            if value <= 0.0 && steps > 0 {
                break;
            }
            let is_above = value > 0.0;
            if !is_above {
                return None;
            }
            // At the lowest point, or past it, without having met zero.
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
        places.push(x);
    }
    (places[0] < places[1]).then_some(places)
}

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
    fn the_quick_way_finds_what_the_careful_way_finds() {
        let mut rng = Random::new(11);
        let (mut quick, mut with_roots) = (0, 0);
        for _ in 0..200_000 {
            let part = |rng: &mut Random, size: f64| (rng.share() - 0.5) * size;
            let c = [
                part(&mut rng, 1.0),
                part(&mut rng, 1.0),
                rng.share(),
                part(&mut rng, 0.4),
                part(&mut rng, 0.2),
            ];
            let (fast, slow) = (quartic_sign_changes(&c), sign_changes(&c));
            assert_eq!(fast.len(), slow.len(), "{c:?}");
            for (a, b) in fast.iter().zip(&slow) {
                assert!((a - b).abs() < 1e-9, "{c:?}: {a} {b}");
            }
            quick += u32::from(bends_up(&c) && from_both_ends(&c).is_some());
            with_roots += u32::from(fast.len() == 2);
        }
        assert!(
            quick > 50_000 && with_roots > 10_000,
            "{quick} {with_roots}"
        );
    }

    #[test]
    fn a_double_root_is_left_to_the_careful_way() {
        let square = [0.09, -0.6, 1.0, 0.0, 0.0];
        assert!(bends_up(&square));
        let places = quartic_sign_changes(&square);
        assert!(places.len().is_multiple_of(2));
    }

    #[test]
    fn changes_between_known_signs_are_those_of_the_careful_way() {
        let mut rng = Random::new(12);
        let mut counts = [0; 5];
        for _ in 0..200_000 {
            let c = [(); 5].map(|()| rng.share() - 0.5);
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
