//! The waveforms, which turn the value of a pattern into a position in a map.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::noise::smooth;
use crate::base::math::powers::exact_power;
use crate::base::math::rounding::floor;
use std::f64::consts::TAU;

/// Values wrap here rather than at 1, so that 1 itself does not become 0.
const WRAP: f64 = 1.00001;

/// Repeats and shapes the value of a pattern. The numbers are single precision, as in POV-Ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// `frequency`: periods per unit of the value; 0 leaves a value of 0 or more unchanged.
    pub frequency: f32,
    /// `phase`: the position in the period at the value 0.
    pub phase: f32,
    /// The waveform of one period.
    pub shape: Shape,
}

/// The waveform of one period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shape {
    /// `ramp_wave`: rises linearly, then drops.
    #[default]
    Ramp,
    /// `sine_wave`: a sine about 0.5, starting there.
    Sine,
    /// `triangle_wave`: rises and falls linearly.
    Triangle,
    /// `scallop_wave`: half a sine period.
    Scallop,
    /// `cubic_wave`: rises smoothly, flat at both ends.
    Cubic,
    /// `poly_wave`: the power with this exponent.
    Poly(f32),
    /// No wave by default: as [`Shape::Ramp`], but without a frequency negative values stay too.
    Unchanged,
}

impl Default for Wave {
    fn default() -> Self {
        Wave {
            frequency: 1.0,
            phase: 0.0,
            shape: Shape::Ramp,
        }
    }
}

impl Wave {
    /// A triangle wave of frequency 1.
    pub const TRIANGLE: Wave = Wave {
        frequency: 1.0,
        phase: 0.0,
        shape: Shape::Triangle,
    };
    /// The unchanged value, for indices into a list.
    pub const NONE: Wave = Wave {
        frequency: 0.0,
        phase: 0.0,
        shape: Shape::Unchanged,
    };

    /// The position in a map of a pattern value.
    #[must_use]
    pub fn of(&self, value: f64) -> f64 {
        let mut value = value;
        if self.frequency != 0.0 {
            value = wrapped(value * f64::from(self.frequency) + f64::from(self.phase));
        }
        let stays = self.frequency == 0.0 && self.shape == Shape::Unchanged;
        if value < 0.0 && !stays {
            value -= value.floor();
        }
        match self.shape {
            Shape::Ramp | Shape::Unchanged => value,
            Shape::Sine => 0.5 * (1.0 + cycloidal(value)),
            Shape::Triangle => triangle(value),
            Shape::Scallop => cycloidal(0.5 * value).abs(),
            Shape::Cubic => smooth(value),
            Shape::Poly(exponent) => exact_power(value, f64::from(exponent)),
        }
    }

    /// Reads `word`, the next token, with its value if it is a wave modifier. Returns whether it was.
    ///
    /// # Errors
    /// A malformed number.
    pub fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let shape = match word {
            Word::Frequency | Word::Phase => {
                args.accept(word)?;
                let number = args.single()?;
                if word == Word::Phase {
                    self.phase = number;
                } else {
                    self.frequency = number;
                }
                return Ok(true);
            }
            Word::RampWave => Shape::Ramp,
            Word::SineWave => Shape::Sine,
            Word::TriangleWave => Shape::Triangle,
            Word::ScallopWave => Shape::Scallop,
            Word::CubicWave => Shape::Cubic,
            Word::PolyWave => Shape::Poly(1.0),
            _ => return Ok(false),
        };
        args.accept(word)?;
        self.shape = match shape {
            Shape::Poly(_) if args.at_expression()? => Shape::Poly(args.single()?),
            other => other,
        };
        Ok(true)
    }
}

/// The remainder of `value` by [`WRAP`], with the sign of `value`; the same bits as `%`.
fn wrapped(value: f64) -> f64 {
    /// Values are seldom larger. For those that are, `%` is used, which is slow: it loops over bits.
    const LIMIT: f64 = 1024.0 * WRAP;
    let mut rest = value.abs();
    if rest < WRAP {
        return value;
    }
    if rest.is_nan() || rest >= LIMIT {
        return value % WRAP;
    }
    // Each subtraction is exact: the number is less than twice the multiple.
    if rest >= 16.0 * WRAP {
        for multiple in [512.0, 256.0, 128.0, 64.0, 32.0, 16.0] {
            rest = reduced(rest, multiple * WRAP);
        }
    }
    for multiple in [8.0, 4.0, 2.0, 1.0] {
        rest = reduced(rest, multiple * WRAP);
    }
    rest.copysign(value)
}

/// `rest` less `multiple` if that is not negative, otherwise `rest`.
fn reduced(rest: f64, multiple: f64) -> f64 {
    if rest >= multiple {
        rest - multiple
    } else {
        rest
    }
}

/// A turn in the steps by which POV-Ray multiplies and divides it, which rounds.
pub(super) const STEPS: f64 = 50_000.0;

/// The sine of an angle in turns; exactly odd.
#[must_use]
pub(super) fn cycloidal(turns: f64) -> f64 {
    let angle = |turns: f64| (turns - floor(turns)) * STEPS / STEPS * TAU;
    if turns >= 0.0 {
        angle(turns).sin()
    } else {
        -angle(-turns).sin()
    }
}

/// Triangle wave of period 1: 0 at integers, 1 halfway between them.
#[must_use]
pub(super) fn triangle(value: f64) -> f64 {
    let above = if value >= 0.0 {
        value - floor(value)
    } else {
        value + 1.0 + floor(value.abs())
    };
    if above >= 0.5 {
        2.0 * (1.0 - above)
    } else {
        2.0 * above
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn wave(text: &str) -> Wave {
        let mut args = TextArgs::new(text);
        let mut wave = Wave::default();
        while let Some(word) = args.word().unwrap() {
            assert!(wave.read(word, &mut args).unwrap(), "{word}");
        }
        wave
    }

    #[test]
    fn wrapping_equals_the_remainder_operator() {
        for number in -40_000..40_000 {
            let value = f64::from(number) * 0.031_234_5;
            for value in [value, value.next_up(), f64::from(number) * WRAP] {
                assert_eq!(wrapped(value), value % WRAP, "{value}");
            }
        }
        assert!(wrapped(f64::NAN).is_nan() && wrapped(f64::INFINITY).is_nan());
    }

    #[test]
    fn one_stays_one_and_more_wraps() {
        // POV-Ray takes the remainder of 1.00001.
        let ramp = wave("");
        assert_eq!((ramp.of(1.0), ramp.of(0.25)), (1.0, 0.25));
        assert!((ramp.of(1.5) - 0.49999).abs() < 1e-12);
        assert!((ramp.of(-0.25) - 0.75).abs() < 1e-12);
    }

    #[test]
    fn frequency_acts_before_phase() {
        assert_eq!(wave("frequency 2 phase 0.25").of(0.25), 0.75);
    }

    #[test]
    fn without_a_frequency_a_positive_value_stays() {
        assert_eq!(wave("frequency 0").of(3.0), 3.0);
        assert_eq!(wave("frequency 0 phase 0.5").of(-0.25), 0.75);
        assert_eq!(Wave::NONE.of(-0.25), -0.25);
    }

    #[test]
    fn the_shapes() {
        for (text, at, expected) in [
            ("triangle_wave", 0.75, 0.5),
            ("triangle_wave", 0.25, 0.5),
            ("sine_wave", 0.25, 1.0),
            ("sine_wave", 0.75, 0.0),
            ("scallop_wave", 0.5, 1.0),
            ("cubic_wave", 0.25, 0.15625),
            ("poly_wave 2", 0.5, 0.25),
            ("poly_wave", 0.5, 0.5),
        ] {
            assert!((wave(text).of(at) - expected).abs() < 1e-12, "{text} {at}");
        }
    }

    #[test]
    fn sine_and_triangle_below_zero() {
        assert_eq!(cycloidal(-0.25), -1.0);
        assert_eq!(triangle(-0.25), 0.5);
        assert_eq!(triangle(-1.25), 0.5);
    }
}
