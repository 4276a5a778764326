//! A root between two points where a polynomial has opposite signs.

use smallvec::SmallVec;

/// Roots in ascending order.
pub(crate) type Roots = SmallVec<[f64; 8]>;

/// A Newton step below this ends the iteration: convergence is quadratic, the next step would not change a digit.
pub(crate) const LAST_STEP: f64 = 1e-9;

/// Sign changes this close to an end of the interval may be due to rounding.
pub(crate) const ROUNDED_END: f64 = 1e-7;

/// More bisections than a double has binary digits.
pub(crate) const MAX_STEPS: u32 = 80;

/// The only root between `low` and `high` by Newton's iteration, with a bisection step where Newton's would leave the
/// bracket.
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

/// Value and derivative at a finite `x`.
#[inline]
pub(crate) fn value_and_slope(c: &[f64], x: f64) -> (f64, f64) {
    let [rest @ .., below, last] = c else {
        return (c.first().map_or(0.0, |c| *c), 0.0);
    };
    let both = |(value, slope): (f64, f64), c: &f64| (value * x + c, slope * x + value);
    rest.iter().rev().fold((last * x + below, *last), both)
}
