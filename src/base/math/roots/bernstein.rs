//! Sign changes of a polynomial of any degree by subdivision of its Bernstein form (Lane and Riesenfeld 1981, "Bounds
//! on a polynomial"; Rouillier and Zimmermann 2004, "Efficient isolation of polynomial's real roots").
//!
//! The Bernstein coefficients of an interval change sign at least as often as the polynomial has roots there: no change
//! means no root, one change means one root. With more changes the interval is bisected. Both halves share the value
//! at the midpoint, so the number of sign changes is always consistent with the signs at the ends.
//!
//! Conversion to the Bernstein form on -1..1 loses no digits, and bisection only takes means. An interval whose
//! coefficients are all within the polynomial's rounding error is not bisected: a double or multiple root may give no
//! sign change or a pair of them. A sign change that rounding cannot hide is never missed.
//!
//! Error bound: the rounding error is 4 epsilon times the number of coefficients times the sum of their absolute
//! values. The error of a root is that divided by the slope there.

use super::bracket::{Roots, bracketed};

/// Capacity that suffices for most polynomials and is cheap to copy.
const SMALL: usize = 12;
/// Capacity for every polynomial a scene can contain.
const LARGE: usize = 36;

/// Rounding error of a value per coefficient, relative to the sum of the absolute coefficients.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// More bisections than the interval has binary digits.
const MAX_BISECTIONS: u32 = 60;

/// Bisection of a polynomial.
struct Bisection<'c> {
    /// Coefficients by ascending power.
    powers: &'c [f64],
    /// Values up to this size may be zero but for rounding.
    noise: f64,
    roots: Roots,
}

/// The sign changes in `-1 <= x <= 1`, sorted, of a polynomial with coefficients by ascending power.
pub(crate) fn sign_changes(powers: &[f64]) -> Roots {
    let size: f64 = powers.iter().map(|c| c.abs()).sum();
    let degree = f64::from(u32::try_from(powers.len()).unwrap_or(u32::MAX));
    let mut bisection = Bisection {
        powers,
        noise: ROUNDINGS * degree * size,
        roots: Roots::new(),
    };
    if powers.len() <= SMALL {
        bisection.search_all::<SMALL>();
    } else {
        bisection.search_all::<LARGE>();
    }
    bisection.roots
}

impl Bisection<'_> {
    /// Searches with a capacity of `N` coefficients.
    fn search_all<const N: usize>(&mut self) {
        let form = &mut [0.0; N][..self.powers.len()];
        to_bernstein_form(self.powers, form);
        self.search::<N>(form, -1.0, 1.0, MAX_BISECTIONS);
    }

    fn search<const N: usize>(&mut self, form: &mut [f64], low: f64, high: f64, depth: u32) {
        let changes = form
            .windows(2)
            .filter(|pair| is_negative(pair[0]) != is_negative(pair[1]))
            .count();
        if changes == 0 {
            return;
        }
        if changes == 1 || depth == 0 || form.iter().all(|c| c.abs() <= self.noise) {
            let is_rising = is_negative(form[0]);
            if changes % 2 == 1 {
                self.roots
                    .push(bracketed(self.powers, low, high, is_rising));
            }
            return;
        }
        let middle = 0.5 * (low + high);
        let left = &mut [0.0; N][..form.len()];
        halve(form, left);
        self.search::<N>(left, low, middle, depth - 1);
        self.search::<N>(form, middle, high, depth - 1);
    }
}

/// True below zero; zero counts as positive.
fn is_negative(x: f64) -> bool {
    x < 0.0
}

/// De Casteljau's algorithm: writes the form of the left half and leaves that of the right half in `form`.
fn halve(form: &mut [f64], left: &mut [f64]) {
    for (left, last) in left.iter_mut().zip((0..form.len()).rev()) {
        *left = form[0];
        for i in 0..last {
            form[i] = 0.5 * (form[i] + form[i + 1]);
        }
    }
}

/// Writes the Bernstein coefficients on -1..1, by Horner's rule: each step `f·x + c` raises the degree by one, and the
/// product with `x` blends neighbouring coefficients with weights between -1 and 1.
fn to_bernstein_form(powers: &[f64], form: &mut [f64]) {
    for (len, (c, weights)) in powers.iter().rev().zip(&WEIGHTS).enumerate() {
        // From the end, since each coefficient needs the old values of its neighbours.
        for j in (0..=len).rev() {
            let [weight, rest] = weights[j];
            // The Bernstein coefficients of x are -1 and 1.
            let before = if j > 0 { weight * form[j - 1] } else { 0.0 };
            let after = if j < len { rest * form[j] } else { 0.0 };
            form[j] = before - after + c;
        }
    }
}

/// `[j / degree, 1 - j / degree]` by degree and `j`, without divisions at run time.
static WEIGHTS: [[[f64; 2]; LARGE]; LARGE] = {
    let mut weights = [[[0.0, 1.0]; LARGE]; LARGE];
    let mut degree = 1;
    while degree < LARGE {
        let mut j = 0;
        while j <= degree {
            let weight = j as f64 / degree as f64;
            weights[degree][j] = [weight, 1.0 - weight];
            j += 1;
        }
        degree += 1;
    }
    weights
};
