//! Sign changes of a smooth function that is no polynomial, from enclosures of its values and of its slopes on whole
//! stretches (Moore 1966, "Interval Analysis", and the mean value form of Caprani and Madsen 1980): a stretch whose
//! values keep away from zero has none, a monotone one has one if its ends differ, every other is halved.
//!
//! Error bound: the last digit of a place, or as far as the rounding of the function reaches; the bounds of a stretch are
//! widened by 8 roundings, so that a pair of changes is lost only if the function's own rounding hides it.

use super::polynomial::Roots;

/// More halvings than a stretch has digits.
const MAX_HALVINGS: u32 = 52;
/// More steps towards one root than it takes to halve a stretch to its last digit.
const MAX_STEPS: u32 = 120;
/// Above the rounding of the products that bound a change of the function.
const ROUNDING: f64 = 1.0 + 8.0 * f64::EPSILON;

/// The least and the most that a quantity can be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// A function of one variable that can bound itself.
pub(crate) trait IntervalFunction {
    /// Its value at a place.
    fn value(&self, x: f64) -> f64;
    /// Its slope there; need not be finite.
    fn slope(&self, x: f64) -> f64;
    /// What holds all values between two places.
    fn values(&self, from: f64, to: f64) -> Interval;
    /// What holds all slopes between two places; may be infinite.
    fn slopes(&self, from: f64, to: f64) -> Interval;
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

/// Appends, in order, the places between `from` and `to` where the function changes sign, for known signs at both.
pub(crate) fn sign_changes(
    function: &impl IntervalFunction,
    (from, starts_negative): (f64, bool),
    (to, ends_negative): (f64, bool),
    places: &mut Roots,
) {
    let ends = [(from, starts_negative), (to, ends_negative)];
    search(function, ends, MAX_HALVINGS, places);
}

fn search(
    function: &impl IntervalFunction,
    ends: [(f64, bool); 2],
    depth: u32,
    places: &mut Roots,
) {
    let [(from, starts_negative), (to, ends_negative)] = ends;
    let is_change = starts_negative != ends_negative;
    if !is_change && function.values(from, to).is_off_zero() {
        return;
    }
    let middle = 0.5 * (from + to);
    let slopes = function.slopes(from, to);
    if slopes.is_one_sided() {
        if is_change {
            places.push(bracketed(function, from, to, starts_negative));
        }
        return;
    }
    let value = function.value(middle);
    let change = 0.5 * (to - from) * slopes.high.max(-slopes.low) * ROUNDING;
    if value.abs() > change || depth == 0 || middle <= from || middle >= to {
        if is_change {
            places.push(middle);
        }
        return;
    }
    let half = (middle, value < 0.0);
    search(function, [ends[0], half], depth - 1, places);
    search(function, [half, ends[1]], depth - 1, places);
}

/// The one place on a stretch that is monotone where the function changes sign.
pub(crate) fn exact_change(
    function: &impl IntervalFunction,
    [from, to]: [f64; 2],
    is_rising: bool,
) -> f64 {
    bracketed(function, from, to, is_rising)
}

/// Newton's iteration for the root of a monotone stretch, halving where a step leaves the stretch or gains too little.
fn bracketed(
    function: &impl IntervalFunction,
    mut low: f64,
    mut high: f64,
    is_rising: bool,
) -> f64 {
    let mut x = 0.5 * (low + high);
    let mut last = f64::INFINITY;
    // A step that is no longer says nothing but how the function is rounded.
    let least = 2.0 * f64::EPSILON * low.abs().max(high.abs());
    for _ in 0..MAX_STEPS {
        let value = function.value(x);
        if value == 0.0 {
            break;
        }
        if (value < 0.0) == is_rising {
            low = x;
        } else {
            high = x;
        }
        let slope = function.slope(x);
        let newton = x - value / slope;
        if slope.is_finite() && (newton - x).abs() <= least {
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

/// The place where a convex function, which is positive at `from`, becomes negative on the way to `to`: Newton's
/// iteration, which stays on the near side. `None` if it turns up again before, or never falls.
pub(crate) fn first_below_zero(
    value_and_slope: impl Fn(f64) -> (f64, f64),
    from: f64,
    to: f64,
) -> Option<f64> {
    let ahead = (to - from).signum();
    let mut x = from;
    for _ in 0..MAX_STEPS {
        let (value, slope) = value_and_slope(x);
        if value <= 0.0 {
            return Some(x);
        }
        let next = x - value / slope;
        // Asked in the positive: NaN is a miss.
        let is_falling = slope * ahead < 0.0 && (to - next) * ahead >= 0.0;
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
        fn value(&self, x: f64) -> f64 {
            x.sin() - self.0
        }
        fn slope(&self, x: f64) -> f64 {
            x.cos()
        }
        fn values(&self, from: f64, to: f64) -> Interval {
            let (middle, reach) = (self.value(0.5 * (from + to)), 0.5 * (to - from));
            Interval::new(middle - reach, middle + reach)
        }
        fn slopes(&self, from: f64, to: f64) -> Interval {
            let (middle, reach) = (self.slope(0.5 * (from + to)), 0.5 * (to - from));
            Interval::new(middle - reach, middle + reach)
        }
    }

    fn places(level: f64, to: f64) -> Vec<f64> {
        let sine = Sine(level);
        let mut places = Roots::new();
        let end = |x: f64| (x, sine.value(x) < 0.0);
        sign_changes(&sine, end(1.0), end(to), &mut places);
        places.to_vec()
    }

    #[test]
    fn all_roots_are_found_in_order() {
        let found = places(0.0, 10.0);
        assert_eq!(found.len(), 3);
        for (i, x) in (1..).zip(&found) {
            assert!((x - std::f64::consts::PI * f64::from(i)).abs() < 2e-15);
        }
    }

    #[test]
    fn a_touch_is_a_pair_or_nothing_and_takes_no_time() {
        for level in [-1.0, -1.0 + 1e-15, -1.0 - 1e-15, -1.0 + 1e-12] {
            assert_eq!(places(level, 10.0).len() % 2, 0);
        }
        assert_eq!(places(-1.0 + 1e-12, 10.0).len(), 2);
        assert!(places(-1.0 - 1e-12, 10.0).is_empty());
    }

    #[test]
    fn a_convex_function_is_met_from_both_sides_or_missed() {
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
