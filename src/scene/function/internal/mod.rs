//! `internal(n)`: the functions behind the names of functions.inc.
//!
//! Each is a formula of a point and of the extra parameters that functions.inc describes. The formulas were found from
//! the shapes' mathematics and by fitting, and compared with the values that POV-Ray 3.7 prints at many points.
//! Most of the algebraic surfaces are cut off at `LIMIT`: they grow fast away from the surface.

mod algebraic;
mod curves;
mod falloffs;
mod noises;
mod solids;

use std::fmt;

/// Where POV-Ray cuts off the values of most algebraic surfaces.
const LIMIT: f64 = 10.0;

/// A built-in function.
pub struct Internal {
    /// As `internal(n)` writes it.
    pub number: u16,
    /// Its name in functions.inc.
    pub name: &'static str,
    /// How many parameters it takes beside the point.
    extra: usize,
    formula: fn(&[f64]) -> f64,
}

impl fmt::Debug for Internal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)
    }
}

impl Internal {
    /// A row of the lists: `N` is three for the point and one for each further parameter.
    const fn new(
        number: u16,
        name: &'static str,
        extra: usize,
        formula: fn(&[f64]) -> f64,
    ) -> Self {
        Internal {
            number,
            name,
            extra,
            formula,
        }
    }

    /// How many arguments it takes.
    #[must_use]
    pub fn parameters(&self) -> usize {
        3 + self.extra
    }

    /// What no value of it exceeds, in either direction, if such a number is known.
    #[must_use]
    pub fn bound(&self) -> Option<f64> {
        let is_limited = |list: &[Internal]| list.iter().any(|known| known.number == self.number);
        is_limited(algebraic::LIST).then_some(LIMIT)
    }

    /// The value for these arguments; zero if they are too few.
    #[must_use]
    pub fn value(&self, arguments: &[f64]) -> f64 {
        match arguments.get(..self.parameters()) {
            Some(arguments) => (self.formula)(arguments),
            None => 0.0,
        }
    }
}

/// The number of `f_noise3d`, whose noise is that of the scene.
pub const NOISE_3D: u16 = 76;

/// All of them.
static LISTS: [&[Internal]; 5] = [
    algebraic::LIST,
    curves::LIST,
    falloffs::LIST,
    noises::LIST,
    solids::LIST,
];

/// The function of this number, if there is one.
#[must_use]
pub fn of_number(number: f64) -> Option<&'static Internal> {
    let mut all = LISTS.into_iter().flatten();
    all.find(|internal| f64::from(internal.number) == number.trunc())
}

/// A value within the limit.
fn limited(value: f64) -> f64 {
    value.clamp(-LIMIT, LIMIT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(number: u16, arguments: &[f64]) -> f64 {
        let internal = of_number(f64::from(number)).expect("a function of this number");
        assert_eq!(internal.parameters(), arguments.len(), "{internal:?}");
        internal.value(arguments)
    }

    #[test]
    fn every_number_of_functions_inc_is_there_once() {
        let mut numbers: Vec<u16> = LISTS.into_iter().flatten().map(|i| i.number).collect();
        numbers.sort_unstable();
        // 77 calls a pattern inside POV-Ray; no name stands for it.
        let expected: Vec<u16> = (0..=78).filter(|n| *n != 77).collect();
        assert_eq!(numbers, expected);
        assert!(of_number(77.0).is_none() && of_number(-1.0).is_none());
    }

    /// Printed by POV-Ray 3.7.
    #[test]
    fn values_are_those_of_pov_ray() {
        let known = [
            (value(61, &[1.0, 2.0, 3.0, 1.0]), 2.741_657_386_774),
            (
                value(27, &[-0.8794, 0.9635, -0.5519, 1.0]),
                0.471_309_927_238,
            ),
            (value(28, &[0.1972, 0.742, -1.3218, 1.0]), 0.200_219_790_374),
            (
                value(53, &[0.5104, -0.2544, 1.2333, 1.0]),
                0.486_517_621_494,
            ),
            (
                value(43, &[1.3413, 0.0032, -0.4423, 1.0]),
                -1.688_290_509_747,
            ),
            (
                value(78, &[-1.3825, -1.1099, -1.4974, 1.0]),
                0.913_278_597_911,
            ),
        ];
        for (found, expected) in known {
            assert!((found - expected).abs() < 1e-11, "{found}, not {expected}");
        }
    }

    #[test]
    fn nothing_fails_at_any_arguments() {
        let odd = [0.0, -0.0, 1.0, -3.0, 1e300, f64::INFINITY, f64::NAN];
        for internal in LISTS.into_iter().flatten() {
            for (i, start) in odd.iter().enumerate() {
                let rest = (1..internal.parameters()).map(|k| odd[(i + k * k) % odd.len()]);
                let arguments: Vec<f64> = std::iter::once(*start).chain(rest).collect();
                let _ = internal.value(&arguments);
            }
        }
    }
}
