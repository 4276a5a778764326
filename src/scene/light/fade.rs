//! `fade_distance` and `fade_power`: attenuation with distance `d` by `2 / (1 + (d / fade_distance)^fade_power)`; from
//! version 3.8 on by `d^-fade_power` where `fade_distance` is 0.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::powers::exact_power;
use crate::base::version::has_defaults_of_3_8;

/// Attenuation with distance; the default has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fade {
    /// The distance of factor 1. Nearer points get up to twice the light.
    pub distance: f64,
    /// The exponent of the distance.
    pub power: f64,
    /// True if a `distance` of 0 means the inverse power law, not that there is no attenuation.
    pub is_inverse_at_0: bool,
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
        self.is_inverse_at_0 = has_defaults_of_3_8(args.version());
        Ok(true)
    }

    /// True if the light is attenuated.
    #[must_use]
    #[inline]
    pub fn fades(&self) -> bool {
        self.power > 0.0 && (self.distance != 0.0 || self.is_inverse_at_0)
    }

    /// The attenuation factor at `distance`. Behind a parallel light distances are negative, and a fractional power of
    /// them is NaN: no light arrives there (measured with POV-Ray).
    #[must_use]
    #[inline]
    pub fn attenuation(&self, distance: f64) -> f64 {
        if self.fades() {
            let share = match self.distance == 0.0 {
                true => 1.0 / exact_power(distance, self.power),
                false => 2.0 / (1.0 + exact_power(distance / self.distance, self.power)),
            };
            if share.is_nan() { 0.0 } else { share }
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fade(distance: f64, power: f64) -> Fade {
        Fade {
            distance,
            power,
            is_inverse_at_0: false,
        }
    }

    #[test]
    fn factor_is_1_at_the_fade_distance() {
        let fade = fade(4.0, 2.0);
        assert_eq!((fade.attenuation(4.0), fade.attenuation(12.0)), (1.0, 0.2));
    }

    #[test]
    fn fractional_power_of_a_negative_distance_gives_no_light() {
        let behind = |power| fade(4.0, power).attenuation(-2.0);
        assert_eq!((behind(2.0), behind(1.5)), (1.6, 0.0));
    }

    #[test]
    fn light_without_distance_or_power_does_not_fade() {
        let far = |distance, power| fade(distance, power).attenuation(12.0);
        assert_eq!((far(0.0, 2.0), far(4.0, 0.0)), (1.0, 1.0));
    }

    /// Measured with POV-Ray 3.8 at a distance of 3.
    #[test]
    fn version_3_8_fades_by_the_inverse_power_at_a_distance_of_0() {
        let fade = Fade {
            is_inverse_at_0: true,
            ..fade(0.0, 2.0)
        };
        assert_eq!(fade.attenuation(3.0), 1.0 / 9.0);
    }
}
