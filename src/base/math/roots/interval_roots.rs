//! Sign changes of a smooth function that is not a polynomial, by interval arithmetic on its values and slopes (Moore
//! 1966, "Interval Analysis", and the mean value form of Caprani and Madsen 1980). An interval on which the value
//! bounds exclude zero has no sign change, a monotone one has one if the signs at its ends differ, and any other is
//! bisected.
//!
//! Error bound: a root is exact to its last digit, or to the rounding error of the function. The bounds of an interval
//! are widened by 8 epsilon, so a pair of roots is lost only if the function's own rounding hides it.

use super::bracket::Roots;

/// More bisections than an interval has binary digits.
const MAX_BISECTIONS: u32 = 52;
/// More iterations for a root than bisection of an interval down to its last digit takes.
const MAX_STEPS: u32 = 120;
/// A step this short, relative to the ends, is the last one where the iteration converges quadratically, as a residual
/// shows that has shrunk by this factor: the next step would be below the last digit.
const LAST_STEP: f64 = 1e-9;
const LAST_GAIN: f64 = 1e-6;
/// Factor that covers the rounding of the products that bound the function's change.
const ROUNDING: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Lower and upper bound of a quantity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// A function of one variable with bounds over intervals.
pub(crate) trait IntervalFunction {
    /// Everything at one `x` that values, slopes and bounds are computed from.
    type At: Copy;
    /// Evaluates at `x`.
    fn at(&self, x: f64) -> Self::At;
    /// The value.
    fn value(&self, at: Self::At) -> f64;
    /// The derivative; may be infinite or NaN.
    fn slope(&self, at: Self::At) -> f64;
    /// Bounds of the values between two `x`.
    fn values(&self, ends: [Self::At; 2]) -> Interval;
    /// Bounds of the derivative between two `x`; may be infinite.
    fn slopes(&self, ends: [Self::At; 2]) -> Interval;
}

/// An end of an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End<A> {
    pub(crate) x: f64,
    pub(crate) at: A,
    /// The sign that the function is taken to have there.
    pub(crate) is_negative: bool,
}

impl Interval {
    pub(crate) fn new(a: f64, b: f64) -> Self {
        Interval {
            low: a.min(b),
            high: a.max(b),
        }
    }

    fn is_off_zero(self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    fn is_one_sided(self) -> bool {
        self.low >= 0.0 || self.high <= 0.0
    }
}

/// Appends the sign changes between two ends, sorted.
pub(crate) fn sign_changes<F: IntervalFunction>(
    function: &F,
    ends: [End<F::At>; 2],
    roots: &mut Roots,
) {
    search(function, ends, MAX_BISECTIONS, roots);
}

fn search<F: IntervalFunction>(function: &F, ends: [End<F::At>; 2], depth: u32, roots: &mut Roots) {
    let [from, to] = ends.map(|end| end.x);
    let starts_negative = ends[0].is_negative;
    let is_change = starts_negative != ends[1].is_negative;
    let around = ends.map(|end| end.at);
    if !is_change && function.values(around).is_off_zero() {
        return;
    }
    let slopes = function.slopes(around);
    if slopes.is_one_sided() {
        if is_change {
            let guess = chord_root(function, ends);
            roots.push(bracketed(function, [from, to], guess, starts_negative));
        }
        return;
    }
    let middle = 0.5 * (from + to);
    let at = function.at(middle);
    let value = function.value(at);
    let change = 0.5 * (to - from) * slopes.high.max(-slopes.low) * ROUNDING;
    if value.abs() > change || depth == 0 || middle <= from || middle >= to {
        if is_change {
            roots.push(middle);
        }
        return;
    }
    let half = End {
        x: middle,
        at,
        is_negative: value < 0.0,
    };
    search(function, [ends[0], half], depth - 1, roots);
    search(function, [half, ends[1]], depth - 1, roots);
}

/// The sign change of a function that is monotone between `from` and `to`.
pub(crate) fn monotone_root(
    function: &impl IntervalFunction,
    [from, to]: [f64; 2],
    is_rising: bool,
) -> f64 {
    bracketed(function, [from, to], 0.5 * (from + to), is_rising)
}

/// Where the chord between two ends of different signs crosses zero; the middle if their values have other signs.
fn chord_root<F: IntervalFunction>(function: &F, ends: [End<F::At>; 2]) -> f64 {
    let [from, to] = ends.map(|end| end.x);
    let [first, last] = ends.map(|end| function.value(end.at));
    let along = first / (first - last);
    if 0.0 < along && along < 1.0 {
        from + along * (to - from)
    } else {
        0.5 * (from + to)
    }
}

/// The root on a monotone interval by Newton's iteration from `x`, with a bisection step where Newton's leaves the bracket
/// or does not halve the residual.
fn bracketed(
    function: &impl IntervalFunction,
    [mut low, mut high]: [f64; 2],
    mut x: f64,
    is_rising: bool,
) -> f64 {
    let mut last = f64::INFINITY;
    let size = low.abs().max(high.abs());
    // Shorter steps only reflect the rounding of the function.
    let min_step = 2.0 * f64::EPSILON * size;
    for _ in 0..MAX_STEPS {
        let at = function.at(x);
        let value = function.value(at);
        if value == 0.0 {
            break;
        }
        if (value < 0.0) == is_rising {
            low = x;
        } else {
            high = x;
        }
        let slope = function.slope(at);
        let newton = x - value / slope;
        let step = (newton - x).abs();
        let has_converged = last.is_finite() && value.abs() < LAST_GAIN * last;
        let is_last = step <= LAST_STEP * size && has_converged;
        if slope.is_finite() && (step <= min_step || is_last) {
            return newton.max(low).min(high);
        }
        let gains = value.abs() < 0.5 * last;
        last = value.abs();
        let next = if gains && low < newton && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if next == x || next <= low || next >= high {
            break;
        }
        x = next;
    }
    x
}

/// The first root between `from` and `to` of a convex function that is positive at `from`, by Newton's iteration, which
/// never passes the root. `None` if the function does not decrease or reaches its minimum before zero.
pub(crate) fn first_below_zero(
    value_and_slope: impl Fn(f64) -> (f64, f64),
    from: f64,
    to: f64,
) -> Option<f64> {
    let dir = (to - from).signum();
    let mut x = from;
    for _ in 0..MAX_STEPS {
        let (value, slope) = value_and_slope(x);
        if value <= 0.0 {
            return Some(x);
        }
        let next = x - value / slope;
        // Tests for true, so that NaN is a miss.
        let is_falling = slope * dir < 0.0 && (to - next) * dir >= 0.0;
        if !is_falling {
            return None;
        }
        if next == x {
            return Some(x);
        }
        x = next;
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sin(x) − level`.
    struct Sine(f64);

    impl IntervalFunction for Sine {
        type At = f64;
        fn at(&self, x: f64) -> f64 {
            x
        }
        fn value(&self, x: f64) -> f64 {
            x.sin() - self.0
        }
        fn slope(&self, x: f64) -> f64 {
            x.cos()
        }
        fn values(&self, [from, to]: [f64; 2]) -> Interval {
            let (middle, reach) = (self.value(0.5 * (from + to)), 0.5 * (to - from));
            Interval::new(middle - reach, middle + reach)
        }
        fn slopes(&self, [from, to]: [f64; 2]) -> Interval {
            let (middle, reach) = (self.slope(0.5 * (from + to)), 0.5 * (to - from));
            Interval::new(middle - reach, middle + reach)
        }
    }

    fn sine_roots(level: f64, to: f64) -> Vec<f64> {
        let sine = Sine(level);
        let mut roots = Roots::new();
        let end = |x: f64| End {
            x,
            at: x,
            is_negative: sine.value(x) < 0.0,
        };
        sign_changes(&sine, [end(1.0), end(to)], &mut roots);
        roots.to_vec()
    }

    #[test]
    fn all_roots_are_returned_in_order() {
        let roots = sine_roots(0.0, 10.0);
        assert_eq!(roots.len(), 3);
        for (i, x) in (1..).zip(&roots) {
            assert!((x - std::f64::consts::PI * f64::from(i)).abs() < 2e-15);
        }
    }

    #[test]
    fn a_double_root_gives_a_pair_or_nothing_and_takes_no_time() {
        for level in [-1.0, -1.0 + 1e-15, -1.0 - 1e-15, -1.0 + 1e-12] {
            assert_eq!(sine_roots(level, 10.0).len() % 2, 0);
        }
        assert_eq!(sine_roots(-1.0 + 1e-12, 10.0).len(), 2);
        assert!(sine_roots(-1.0 - 1e-12, 10.0).is_empty());
    }

    #[test]
    fn a_convex_function_has_a_root_from_both_sides_or_none() {
        let parabola = |level: f64| move |x: f64| (x * x - level, 2.0 * x);
        assert!(
            (first_below_zero(parabola(2.0), -9.0, 9.0).unwrap() + 2.0_f64.sqrt()).abs() < 1e-15
        );
        assert!(
            (first_below_zero(parabola(2.0), 9.0, -9.0).unwrap() - 2.0_f64.sqrt()).abs() < 1e-15
        );
        assert_eq!(first_below_zero(parabola(-1e-9), -9.0, 9.0), None);
        assert_eq!(first_below_zero(parabola(2.0), -9.0, -5.0), None);
    }
}
