//! `internal(n)`: the built-in functions that functions.inc names.
//!
//! Each is a formula of a point and of the extra parameters that functions.inc describes. The formulas come from the
//! mathematics of the shapes and from fitting, and agree with values that POV-Ray 3.7 prints at many points. Most of
//! the algebraic surfaces are clamped to `LIMIT`, because they grow fast away from the surface.

mod algebraic;
mod curves;
mod falloffs;
mod noises;
mod solids;

pub(super) use noises::ridged_mf;
use std::fmt;

/// POV-Ray clamps the values of most algebraic surfaces to this magnitude.
const LIMIT: f64 = 10.0;

/// A built-in function.
pub struct Internal {
    /// The `n` of `internal(n)`.
    pub number: u16,
    /// Its name in functions.inc.
    pub name: &'static str,
    /// The number of parameters after the point.
    extra: usize,
    formula: fn(&[f64]) -> f64,
}

impl fmt::Debug for Internal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)
    }
}

impl Internal {
    /// A function of a point and `extra` further parameters.
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

    /// The number of parameters, including the point.
    #[must_use]
    pub fn parameters(&self) -> usize {
        3 + self.extra
    }

    /// Bound of the magnitude of all values, if known.
    #[must_use]
    pub fn bound(&self) -> Option<f64> {
        let is_limited = |list: &[Internal]| list.iter().any(|known| known.number == self.number);
        is_limited(algebraic::LIST).then_some(LIMIT)
    }

    /// The value for these arguments; zero if there are too few.
    #[must_use]
    pub fn value(&self, arguments: &[f64]) -> f64 {
        match arguments.get(..self.parameters()) {
            Some(arguments) => (self.formula)(arguments),
            None => 0.0,
        }
    }
}

/// The number of `f_noise3d`, which uses the noise generator of the scene.
pub const NOISE_3D: u16 = 76;

/// The number of `f_ridged_mf`, whose octave weights are those of its first call in POV-Ray.
pub const RIDGED_MF: u16 = 59;

/// All built-in functions, by group.
static LISTS: [&[Internal]; 5] = [
    algebraic::LIST,
    curves::LIST,
    falloffs::LIST,
    noises::LIST,
    solids::LIST,
];

/// The function of this number, if there is one; some are corrected in scenes for POV-Ray 3.8.
#[must_use]
pub fn of_number(number: f64, is_for_3_8: bool) -> Option<&'static Internal> {
    let corrected = &algebraic::ENNEPER_OF_3_8;
    if is_for_3_8 && f64::from(corrected.number) == number.trunc() {
        return Some(corrected);
    }
    let mut all = LISTS.into_iter().flatten();
    all.find(|internal| f64::from(internal.number) == number.trunc())
}

/// The value clamped to the limit.
fn limited(value: f64) -> f64 {
    value.clamp(-LIMIT, LIMIT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(number: u16, arguments: &[f64]) -> f64 {
        let internal = of_number(f64::from(number), false).expect("a function of this number");
        assert_eq!(internal.parameters(), arguments.len(), "{internal:?}");
        internal.value(arguments)
    }

    #[test]
    fn every_number_of_functions_inc_exists_once() {
        let mut numbers: Vec<u16> = LISTS.into_iter().flatten().map(|i| i.number).collect();
        numbers.sort_unstable();
        // 77 calls a pattern inside POV-Ray and has no name.
        let expected: Vec<u16> = (0..=78).filter(|n| *n != 77).collect();
        assert_eq!(numbers, expected);
        assert!(of_number(77.0, false).is_none() && of_number(-1.0, false).is_none());
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
        for (actual, expected) in known {
            assert!(
                (actual - expected).abs() < 1e-11,
                "{actual}, not {expected}"
            );
        }
    }

    #[test]
    fn extreme_arguments_do_not_panic() {
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
