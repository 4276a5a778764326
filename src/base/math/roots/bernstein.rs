//! Sign changes of a polynomial of any degree, by halving its Bernstein form (Lane and Riesenfeld 1981, "Bounds on a
//! polynomial"; Rouillier and Zimmermann 2004, "Efficient isolation of polynomial's real roots").
//!
//! The coefficients in the Bernstein basis of an interval change sign at least as often as the polynomial has roots
//! there: no change means no root, one change one root. Everything else is halved. The value at a halving point is
//! shared by both halves, so that the number of changes found is always right for the signs at the ends.
//!
//! The form on -1..1 costs no digits, and halving takes means only. A stretch where all coefficients are within the
//! rounding of the polynomial is not halved again: a touching or multiple root may come as none or as pairs, and a
//! change is never missed that a polynomial farther than that rounding from this one must have. Error bound: that rounding
//! is 4 roundings of the sum of the coefficients for each degree, and a place is off by as much over the slope there.

use super::polynomial::{Roots, bracketed};
use smallvec::SmallVec;

/// The coefficients of one stretch, up to `N` of them without the heap.
type Form<const N: usize> = SmallVec<[f64; N]>;

/// Enough for most, and less to be copied.
const FEW: usize = 12;
/// Enough for all polynomials that scenes can write.
const ALL: usize = 36;

/// By how many roundings, for each degree, a value may be off.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// More halvings than the interval has digits.
const MAX_HALVINGS: u32 = 60;

/// Halving of one polynomial, given by rising power.
struct Halving<'c> {
    powers: &'c [f64],
    /// What may be taken for zero.
    noise: f64,
    places: Roots,
}

/// The places in `-1 <= x <= 1` where a polynomial, by rising power, changes sign; in order.
pub(crate) fn sign_changes(powers: &[f64]) -> Roots {
    let size: f64 = powers.iter().map(|c| c.abs()).sum();
    let degree = f64::from(u32::try_from(powers.len()).unwrap_or(u32::MAX));
    let mut halving = Halving {
        powers,
        noise: ROUNDINGS * degree * size,
        places: Roots::new(),
    };
    if powers.len() <= FEW {
        halving.search(bernstein_form::<FEW>(powers), -1.0, 1.0, MAX_HALVINGS);
    } else {
        halving.search(bernstein_form::<ALL>(powers), -1.0, 1.0, MAX_HALVINGS);
    }
    halving.places
}

impl Halving<'_> {
    fn search<const N: usize>(&mut self, mut form: Form<N>, low: f64, high: f64, depth: u32) {
        let changes = form
            .windows(2)
            .filter(|pair| is_negative(pair[0]) != is_negative(pair[1]))
            .count();
        if changes == 0 {
            return;
        }
        let is_change = match (form.first(), form.last()) {
            (Some(first), Some(last)) => is_negative(*first) != is_negative(*last),
            _ => return,
        };
        let is_noise = depth == 0 || form.iter().all(|c| c.abs() <= self.noise);
        if changes == 1 || is_noise {
            if is_change {
                let is_rising = is_negative(form[0]);
                self.places
                    .push(bracketed(self.powers, low, high, is_rising));
            }
            return;
        }
        let middle = 0.5 * (low + high);
        let left = halve(&mut form);
        self.search(left, low, middle, depth - 1);
        self.search(form, middle, high, depth - 1);
    }
}

/// Zero counts as positive.
fn is_negative(x: f64) -> bool {
    x < 0.0
}

/// De Casteljau's scheme: gives the form of the first half and leaves that of the second.
fn halve<const N: usize>(form: &mut Form<N>) -> Form<N> {
    let mut left = Form::with_capacity(form.len());
    for last in (0..form.len()).rev() {
        left.push(form[0]);
        for i in 0..last {
            form[i] = 0.5 * (form[i] + form[i + 1]);
        }
    }
    left
}

/// The Bernstein coefficients on -1..1. By Horner's rule: `f·x + c` in a form of one degree more, where a product with
/// `x` mixes neighbours with weights between -1 and 1.
fn bernstein_form<const N: usize>(powers: &[f64]) -> Form<N> {
    let mut form = Form::<N>::new();
    for c in powers.iter().rev() {
        let len = form.len();
        let degree = to_f64(len);
        form.push(0.0);
        // From the end, so that each finds its neighbours as they were.
        for j in (0..=len).rev() {
            let share = if degree > 0.0 {
                to_f64(j) / degree
            } else {
                0.0
            };
            // x has the coefficients -1 and 1.
            let before = if j > 0 { share * form[j - 1] } else { 0.0 };
            let after = if j < len {
                (1.0 - share) * form[j]
            } else {
                0.0
            };
            form[j] = before - after + c;
        }
    }
    form
}

fn to_f64(n: usize) -> f64 {
    f64::from(u32::try_from(n).unwrap_or(u32::MAX))
}
