//! What the escape-time fractals share: complex numbers, and the values of points that escape and that stay.

pub(super) mod julia;
pub(super) mod magnet;
pub(super) mod mandel;

use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use std::ops::{Add, Div, Mul, Sub};

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

/// Most iterations: each costs time at each point.
const MOST_ITERATIONS: f64 = 1e9;
/// The exponents that POV-Ray knows.
const EXPONENTS: std::ops::RangeInclusive<f64> = 2.0..=33.0;

/// What is told of a point: `exterior` and `interior`, each a type and a factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Telling {
    exterior: (u8, f64),
    interior: (u8, f64),
    iterations: u32,
}

/// How the iteration of a point ended.
#[derive(Clone, Copy, Debug)]
pub(super) enum Fate {
    /// It escaped in the iteration of this number, from 0, to this place.
    Escaped(u32, Complex),
    /// It did not escape: where it is, and the least square of its distance from the origin.
    Stayed(Complex, f64),
}

impl Telling {
    /// What POV-Ray tells where the scene says nothing.
    pub(super) fn new(iterations: u32) -> Self {
        Telling {
            exterior: (1, 1.0),
            interior: (0, 1.0),
            iterations,
        }
    }

    /// Reads `exterior` or `interior` with its numbers, and says whether it was one of them.
    pub(super) fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let (slot, most) = match word {
            Word::Exterior => (&mut self.exterior, 8),
            Word::Interior => (&mut self.interior, 6),
            _ => return Ok(false),
        };
        args.accept(word)?;
        let start = args.span();
        let number = args.float()?.trunc();
        let Some(kind) = (0..=most).find(|&kind| f64::from(kind) == number) else {
            let place = start.to(args.last_span());
            let message = format!("the types of `{word}` run from 0 to {most}, found {number}");
            return Err(Box::new(Diagnostic::error(place, message)));
        };
        args.comma()?;
        *slot = (kind, args.float()?);
        Ok(true)
    }

    /// The value of a point.
    pub(super) fn value(&self, fate: Fate) -> f64 {
        match fate {
            Fate::Escaped(number, z) => {
                let (kind, factor) = self.exterior;
                let number = f64::from(number);
                match kind {
                    0 => factor,
                    1 => number / f64::from(self.iterations),
                    7 => (number % factor) / factor,
                    8 => (number % (factor + 1.0)) / factor,
                    6 => z.length_sq().sqrt() * factor,
                    _ => part(kind, z) * factor,
                }
            }
            Fate::Stayed(z, least_sq) => {
                let (kind, factor) = self.interior;
                match kind {
                    0 => factor,
                    1 => least_sq.sqrt() * factor,
                    // The factor on the second square alone is POV-Ray's.
                    6 => z.re * z.re + z.im * z.im * factor,
                    _ => part(kind, z) * factor,
                }
            }
        }
    }
}

/// The part of a number that the types 2 to 5 tell.
fn part(kind: u8, z: Complex) -> f64 {
    match kind {
        2 => z.re,
        3 => z.im,
        4 => z.re * z.re,
        _ => z.im * z.im,
    }
}

/// The number of iterations behind the word of a fractal.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is cut to 1..=1e9"
)]
pub(super) fn read_iterations(args: &mut dyn Args) -> Parse<u32> {
    let number = args.float()?.abs();
    Ok(number.clamp(1.0, MOST_ITERATIONS) as u32)
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
    let place = start.to(args.last_span());
    let message = format!("`exponent` runs from 2 to 33, found {number}");
    Err(Box::new(Diagnostic::error(place, message)))
}

/// Iterates `z → z^exponent + c` until `|z|² > 4`, or until a number comes again that was there before: what follows is
/// known then (Brent 1980, "An improved Monte Carlo factorization algorithm", section 3). Points well within a set come to
/// that after some hundreds of iterations.
pub(super) fn iterate_power(z: Complex, c: Complex, exponent: i32, iterations: u32) -> Fate {
    if exponent == 2 {
        return iterate(z, iterations, |z| z.square() + c);
    }
    iterate(z, iterations, |z| z.power(exponent) + c)
}

#[inline]
fn iterate(start: Complex, iterations: u32, next: impl Fn(Complex) -> Complex) -> Fate {
    let mut z = start;
    let mut least_sq = z.length_sq();
    let (mut earlier, mut earlier_number) = (z, 0);
    let mut number = 0;
    while number < iterations {
        z = next(z);
        let size_sq = z.length_sq();
        least_sq = least_sq.min(size_sq);
        if size_sq > 4.0 {
            return Fate::Escaped(number, z);
        }
        number += 1;
        if z == earlier {
            let period = number - earlier_number;
            number = iterations - (iterations - number) % period;
        } else if number.is_power_of_two() {
            (earlier, earlier_number) = (z, number);
        }
    }
    Fate::Stayed(z, least_sq)
}

impl Complex {
    pub(super) const ZERO: Complex = Complex::new(0.0, 0.0);
    pub(super) const ONE: Complex = Complex::new(1.0, 0.0);

    pub(super) const fn new(re: f64, im: f64) -> Self {
        Complex { re, im }
    }

    pub(super) fn length_sq(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    pub(super) fn square(self) -> Self {
        Complex::new(
            self.re * self.re - self.im * self.im,
            2.0 * self.re * self.im,
        )
    }

    fn power(self, exponent: i32) -> Self {
        if exponent == 2 {
            return self.square();
        }
        (1..exponent).fold(self, |power, _| power * self)
    }
}

impl Add for Complex {
    type Output = Complex;
    fn add(self, other: Complex) -> Complex {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Complex;
    fn sub(self, other: Complex) -> Complex {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Complex;
    fn mul(self, other: Complex) -> Complex {
        Complex::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl Mul<f64> for Complex {
    type Output = Complex;
    fn mul(self, factor: f64) -> Complex {
        Complex::new(self.re * factor, self.im * factor)
    }
}

impl Div for Complex {
    type Output = Complex;
    fn div(self, other: Complex) -> Complex {
        let size_sq = other.length_sq();
        Complex::new(
            (self.re * other.re + self.im * other.im) / size_sq,
            (self.im * other.re - self.re * other.im) / size_sq,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_gone_through_in_part_as_often_as_asked() {
        for re in [0.0, -0.5, -1.1, -1.3, 0.25, -1.75, 0.3] {
            let c = Complex::new(re, 0.1 * re);
            for iterations in [0, 1, 2, 3, 700, 5000, 5001, 5002] {
                let mut z = c;
                let mut least_sq = c.length_sq();
                let escaped = (0..iterations).find(|_| {
                    z = z.square() + c;
                    least_sq = least_sq.min(z.length_sq());
                    z.length_sq() > 4.0
                });
                match iterate_power(c, c, 2, iterations) {
                    Fate::Escaped(number, at) => assert_eq!((escaped, at), (Some(number), z)),
                    Fate::Stayed(at, least) => {
                        assert_eq!((escaped, at, least), (None, z, least_sq));
                    }
                }
            }
        }
    }

    #[test]
    fn powers_and_quotients() {
        let z = Complex::new(1.0, 2.0);
        assert_eq!(z.power(2), z * z);
        assert_eq!(z.power(3), Complex::new(-11.0, -2.0));
        assert_eq!((z * Complex::new(0.5, -1.0)) / Complex::new(0.5, -1.0), z);
    }
}
