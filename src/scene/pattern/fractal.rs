//! Parts shared by the escape-time fractals: powers, iteration, and the `exterior` and `interior` values.

pub(super) mod julia;
pub(super) mod magnet;
pub(super) mod mandel;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::Complex;
use crate::base::source::Diagnostic;

/// Largest number of iterations, to bound the time per point.
const MAX_ITERATIONS: f64 = 1e9;
/// The exponents that POV-Ray accepts.
const EXPONENTS: std::ops::RangeInclusive<f64> = 2.0..=33.0;

/// The value of a point: `exterior` for points that escape and `interior` for others, each a type and a factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coloring {
    exterior: (u8, f64),
    interior: (u8, f64),
    iterations: u32,
}

/// Outcome of the iteration of a point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Outcome {
    /// Escaped in this iteration, counted from 0, with this last value.
    Escaped(u32, Complex),
    /// Did not escape: the last value, and the smallest `|z|²` of the orbit.
    Bounded(Complex, f64),
}

impl Coloring {
    /// POV-Ray's defaults.
    pub(super) fn new(iterations: u32) -> Self {
        Coloring {
            exterior: (1, 1.0),
            interior: (0, 1.0),
            iterations,
        }
    }

    /// Reads `exterior` or `interior` with its numbers. Returns whether `word` was one of them.
    pub(super) fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let (slot, max) = match word {
            Word::Exterior => (&mut self.exterior, 8),
            Word::Interior => (&mut self.interior, 6),
            _ => return Ok(false),
        };
        args.accept(word)?;
        let start = args.span();
        let number = args.float()?.trunc();
        let Some(kind) = (0..=max).find(|&kind| f64::from(kind) == number) else {
            let span = start.to(args.last_span());
            let message = format!("the types of `{word}` run from 0 to {max}, found {number}");
            return Err(Box::new(Diagnostic::error(span, message)));
        };
        args.comma()?;
        *slot = (kind, args.float()?);
        Ok(true)
    }

    /// The value for an outcome.
    pub(super) fn value(&self, outcome: Outcome) -> f64 {
        match outcome {
            Outcome::Escaped(number, z) => {
                let (kind, factor) = self.exterior;
                let number = f64::from(number);
                match kind {
                    0 => factor,
                    1 => number / f64::from(self.iterations),
                    7 => (number % factor) / factor,
                    8 => (number % (factor + 1.0)) / factor,
                    6 => z.norm_sq().sqrt() * factor,
                    _ => part(kind, z) * factor,
                }
            }
            Outcome::Bounded(z, least_sq) => {
                let (kind, factor) = self.interior;
                match kind {
                    0 => factor,
                    1 => least_sq.sqrt() * factor,
                    // As in POV-Ray, the factor applies to the second square alone.
                    6 => z.re * z.re + z.im * z.im * factor,
                    _ => part(kind, z) * factor,
                }
            }
        }
    }
}

/// The part of a complex number for the types 2 to 5.
fn part(kind: u8, z: Complex) -> f64 {
    match kind {
        2 => z.re,
        3 => z.im,
        4 => z.re * z.re,
        _ => z.im * z.im,
    }
}

/// Reads the number of iterations after the keyword of a fractal.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is cut to 1..=1e9"
)]
pub(super) fn read_iterations(args: &mut dyn Args) -> Parse<u32> {
    let number = args.float()?.abs();
    Ok(number.clamp(1.0, MAX_ITERATIONS) as u32)
}

/// Reads `exponent` and its number.
#[allow(
    clippy::cast_possible_truncation,
    reason = "the number is one of a small range"
)]
pub(super) fn read_exponent(args: &mut dyn Args) -> Parse<i32> {
    args.accept(Word::Exponent)?;
    let start = args.span();
    let number = args.float()?.trunc();
    if EXPONENTS.contains(&number) {
        return Ok(number as i32);
    }
    let span = start.to(args.last_span());
    let message = format!("`exponent` runs from 2 to 33, found {number}");
    Err(Box::new(Diagnostic::error(span, message)))
}

/// Iterates `z → z^exponent + c` until `|z|² > 4`, or until a value repeats exactly: whole periods of the cycle are
/// then skipped (Brent 1980, "An Improved Monte Carlo Factorization Algorithm", section 3). Points well inside a set
/// reach a cycle after some hundreds of iterations.
pub(super) fn iterate_power(z: Complex, c: Complex, exponent: i32, iterations: u32) -> Outcome {
    if exponent == 2 {
        return iterate(z, iterations, |z| z.square() + c);
    }
    iterate(z, iterations, |z| z.integer_power(exponent) + c)
}

#[inline]
fn iterate(start: Complex, iterations: u32, next: impl Fn(Complex) -> Complex) -> Outcome {
    let mut z = start;
    let mut least_sq = z.norm_sq();
    let (mut saved, mut saved_number) = (z, 0);
    let mut number = 0;
    while number < iterations {
        z = next(z);
        let size_sq = z.norm_sq();
        least_sq = least_sq.min(size_sq);
        if size_sq > 4.0 {
            return Outcome::Escaped(number, z);
        }
        number += 1;
        if z == saved {
            let period = number - saved_number;
            number = iterations - (iterations - number) % period;
        } else if number.is_power_of_two() {
            (saved, saved_number) = (z, number);
        }
    }
    Outcome::Bounded(z, least_sq)
}

impl Complex {
    pub(super) fn square(self) -> Self {
        Complex::new(
            self.re * self.re - self.im * self.im,
            2.0 * self.re * self.im,
        )
    }

    /// An integer power, rounded as POV-Ray rounds it (measured): near the border of a set the last digit decides.
    fn integer_power(self, exponent: i32) -> Self {
        let (a, b) = (self.re, self.im);
        let (a_sq, b_sq) = (a * a, b * b);
        match exponent {
            2 => self.square(),
            3 => Complex::new(a_sq * a - 3.0 * a * b_sq, 3.0 * a_sq * b - b_sq * b),
            4 => Complex::new(
                a_sq * a_sq - 6.0 * a_sq * b_sq + b_sq * b_sq,
                4.0 * (a_sq * a * b - a * b_sq * b),
            ),
            _ => self.binomial_power(exponent),
        }
    }

    fn binomial_power(self, exponent: i32) -> Self {
        let mut power = Complex::ZERO;
        let mut coefficient = 1.0;
        for k in 0..=exponent {
            let left = f64::from(exponent - k);
            let k_float = f64::from(k);
            let term = coefficient * self.re.powf(left) * self.im.powf(k_float);
            match k % 4 {
                0 => power.re += term,
                1 => power.im += term,
                2 => power.re -= term,
                _ => power.im -= term,
            }
            coefficient = (coefficient * left / (k_float + 1.0)).round();
        }
        power
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skipping_whole_cycles_equals_plain_iteration() {
        for re in [0.0, -0.5, -1.1, -1.3, 0.25, -1.75, 0.3] {
            let c = Complex::new(re, 0.1 * re);
            for iterations in [0, 1, 2, 3, 700, 5000, 5001, 5002] {
                let mut z = c;
                let mut least_sq = c.norm_sq();
                let escaped = (0..iterations).find(|_| {
                    z = z.square() + c;
                    least_sq = least_sq.min(z.norm_sq());
                    z.norm_sq() > 4.0
                });
                match iterate_power(c, c, 2, iterations) {
                    Outcome::Escaped(number, at) => assert_eq!((escaped, at), (Some(number), z)),
                    Outcome::Bounded(at, least) => {
                        assert_eq!((escaped, at, least), (None, z, least_sq));
                    }
                }
            }
        }
    }

    /// Powers that POV-Ray 3.7 printed; other orders of the operations differ in the last digit.
    #[test]
    fn powers_are_rounded_as_in_povray() {
        let printed = [
            (
                3,
                [-0.116_397_428_957_229_38, -0.932_034_645_699_551],
                [0.301_762_357_661_945_2, 0.771_765_226_773_028_8],
            ),
            (
                4,
                [-0.781_380_738_787_889, -0.053_211_737_962_982_4],
                [0.362_413_780_826_920_44, 0.101_073_379_873_989_39],
            ),
            (
                5,
                [-0.531_409_427_904_544_3, -0.653_358_851_854_961_6],
                [0.114_048_430_243_596_23, 0.408_038_036_617_912_9],
            ),
            (
                12,
                [0.395_674_611_704_977, 0.917_752_287_923_027_8],
                [0.170_218_787_441_819_95, 0.978_288_221_329_093_1],
            ),
        ];
        for (exponent, [a, b], [re, im]) in printed {
            assert_eq!(
                Complex::new(a, b).integer_power(exponent),
                Complex::new(re, im)
            );
        }
    }

    #[test]
    fn powers_and_quotients() {
        let z = Complex::new(1.0, 2.0);
        assert_eq!(z.integer_power(2), z * z);
        assert_eq!(z.integer_power(3), Complex::new(-11.0, -2.0));
        assert_eq!((z * Complex::new(0.5, -1.0)) / Complex::new(0.5, -1.0), z);
    }
}
