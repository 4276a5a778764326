//! `fade_distance` and `fade_power`: attenuation with distance `d` by `2 / (1 + (d / fade_distance)^fade_power)`.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::powers::exact_power;

/// Attenuation with distance; the default has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fade {
    /// The distance of factor 1. Nearer points get up to twice the light.
    pub distance: f64,
    /// The exponent of the distance.
    pub power: f64,
}

impl Fade {
    /// Parses `word` and its value if it is a fade parameter. Returns false otherwise.
    ///
    /// # Errors
    /// A malformed value.
    pub(super) fn read_item(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let slot = match word {
            Word::FadeDistance => &mut self.distance,
            Word::FadePower => &mut self.power,
            _ => return Ok(false),
        };
        args.accept(word)?;
        *slot = args.float()?;
        Ok(true)
    }

    /// True if the light is attenuated.
    #[must_use]
    #[inline]
    pub fn fades(&self) -> bool {
        self.power > 0.0 && self.distance != 0.0
    }

    /// The attenuation factor at `distance`. Behind a parallel light distances are negative, and a fractional power of
    /// them is NaN: no light arrives there (measured with POV-Ray).
    #[must_use]
    #[inline]
    pub fn attenuation(&self, distance: f64) -> f64 {
        if self.fades() {
            let share = 2.0 / (1.0 + exact_power(distance / self.distance, self.power));
            if share.is_nan() { 0.0 } else { share }
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factor_is_1_at_the_fade_distance() {
        let fade = Fade {
            distance: 4.0,
            power: 2.0,
        };
        assert_eq!((fade.attenuation(4.0), fade.attenuation(12.0)), (1.0, 0.2));
    }

    #[test]
    fn fractional_power_of_a_negative_distance_gives_no_light() {
        let fade = |power| {
            let distance = 4.0;
            Fade { distance, power }.attenuation(-2.0)
        };
        assert_eq!((fade(2.0), fade(1.5)), (1.6, 0.0));
    }

    #[test]
    fn light_without_distance_or_power_does_not_fade() {
        let fade = |distance, power| Fade { distance, power }.attenuation(12.0);
        assert_eq!((fade(0.0, 2.0), fade(4.0, 0.0)), (1.0, 1.0));
    }
}
