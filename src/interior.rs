//! `interior`: what fills an object: how it bends light and how light fades in it.
//!
//! Missing: `media`, `caustics` and `dispersion`.

use crate::args::{Args, Parse, Word, declared, not_built};
use crate::color::Rgb;
use crate::source::Diagnostic;
use crate::texture::Finish;

/// From this `fade_power` on, light fades exponentially.
const EXPONENTIAL_POWER: f64 = 1000.0;

/// What fills an object. The default is the atmosphere: light goes straight and does not fade.
#[derive(Clone, Debug, PartialEq)]
pub struct Interior {
    /// The index of refraction.
    pub ior: f32,
    /// The distance over which light fades to the mean of full light and `fade_color`; 0 for no fading.
    pub fade_distance: f32,
    /// How fast light fades; from 1000 on exponentially. With 0 all light is halved towards `fade_color`.
    pub fade_power: f32,
    /// The colour to which light fades.
    pub fade_color: Rgb,
    /// `refraction` of an old finish: a factor on all light that comes through the surface.
    pub refraction: f32,
}

impl Default for Interior {
    fn default() -> Self {
        Interior {
            ior: 1.0,
            fade_distance: 0.0,
            fade_power: 0.0,
            fade_color: Rgb::BLACK,
            refraction: 1.0,
        }
    }
}

impl Interior {
    /// The interior of a block.
    ///
    /// # Errors
    /// A malformed value, or a word that is not built yet.
    pub fn read(args: &mut dyn Args) -> Parse<Interior> {
        args.open()?;
        let mut interior = match declared::<Interior>(args)? {
            Some(known) => Interior::clone(&known),
            None => Interior::default(),
        };
        while !args.accept_close()? {
            interior.read_item(args)?;
        }
        Ok(interior)
    }

    fn read_item(&mut self, args: &mut dyn Args) -> Parse<()> {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of `interior` or `}`"));
        };
        let missing = not_built(args, word);
        match word {
            Word::Ior => self.ior = number(word, args)?,
            Word::FadeDistance => self.fade_distance = number(word, args)?,
            Word::FadePower => self.fade_power = number(word, args)?,
            Word::FadeColor | Word::FadeColour => {
                args.accept(word)?;
                self.fade_color = args.color()?.rgb;
            }
            Word::Caustics if number(word, args)? == 0.0 => {}
            Word::Dispersion if number(word, args)? == 1.0 => {}
            Word::DispersionSamples => {
                let at = args.span();
                if number(word, args)? < 2.0 {
                    let message = "`dispersion_samples` must be at least 2";
                    return Err(Box::new(Diagnostic::error(
                        at.to(args.last_span()),
                        message,
                    )));
                }
            }
            Word::Refraction => {
                let at = args.span();
                number(word, args)?;
                args.warn(Diagnostic::warning(
                    at,
                    "`refraction` in `interior` does nothing",
                ));
            }
            Word::Caustics | Word::Dispersion | Word::Media => return Err(missing),
            _ => return Err(args.expected("a parameter of `interior` or `}`")),
        }
        Ok(())
    }

    /// The factor on light that has gone `distance` inside.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        reason = "colours are single precision, as in POV-Ray"
    )]
    pub fn fade(&self, distance: f64) -> Rgb {
        if !self.fades() {
            return Rgb::WHITE;
        }
        let depth = distance / f64::from(self.fade_distance);
        let power = f64::from(self.fade_power);
        self.fade_color.map(|c| {
            let c = f64::from(c);
            let kept = if power < EXPONENTIAL_POWER {
                c + (1.0 - c) / (1.0 + depth.powf(power))
            } else {
                (-(1.0 - c) * depth).exp()
            };
            kept as f32
        })
    }

    /// Takes over `ior` and `refraction` from the finishes of the object's texture, where old scenes have them.
    pub fn take_from_finishes<'a>(&mut self, finishes: impl IntoIterator<Item = &'a Finish>) {
        for finish in finishes {
            self.ior = finish.ior.unwrap_or(self.ior);
            self.refraction = finish.refraction.unwrap_or(self.refraction);
        }
    }

    /// Whether light fades at all.
    #[must_use]
    pub fn fades(&self) -> bool {
        self.fade_distance != 0.0
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "interior values are single precision, as in POV-Ray"
)]
fn number(word: Word, args: &mut dyn Args) -> Parse<f32> {
    args.accept(word)?;
    Ok(args.float()? as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;

    fn read(text: &str) -> Parse<Interior> {
        Interior::read(&mut TextArgs::new(text))
    }

    #[test]
    fn a_named_interior_can_be_changed() {
        let known = read("{ ior 1.5 fade_distance 2 }").unwrap();
        let mut args = TextArgs::new("{ I fade_power 1 }").with("I", known);
        let interior = Interior::read(&mut args).unwrap();
        assert_eq!(
            (interior.ior, interior.fade_distance, interior.fade_power),
            (1.5, 2.0, 1.0)
        );
    }

    #[test]
    fn light_fades_to_the_mean_over_the_fade_distance() {
        let interior = read("{ fade_distance 2 fade_power 3 fade_color rgb 0.5 }").unwrap();
        assert_eq!(interior.fade(2.0), Rgb::splat(0.75));
        assert_eq!(interior.fade(0.0), Rgb::WHITE);
        assert_eq!(read("{ fade_power 3 }").unwrap().fade(2.0), Rgb::WHITE);
    }

    #[test]
    fn fade_power_0_halves_light() {
        // POV-Ray 3.7 shows half of what is behind a clear sphere with `fade_distance 1`.
        assert_eq!(
            read("{ fade_distance 1 }").unwrap().fade(2.0),
            Rgb::splat(0.5)
        );
    }

    #[test]
    fn from_power_1000_on_light_fades_exponentially() {
        let interior = read("{ fade_distance 2 fade_power 1001 fade_color rgb 0.5 }").unwrap();
        assert_eq!(interior.fade(4.0), Rgb::splat((-1.0f32).exp()));
    }

    #[test]
    fn what_matters_and_is_missing_is_named() {
        for (text, word) in [
            ("{ media { } }", "media"),
            ("{ caustics 1 }", "caustics"),
            ("{ dispersion 1.1 }", "dispersion"),
        ] {
            let error = read(text).expect_err("it is missing");
            assert_eq!(error.message, format!("`{word}` is not built yet"));
        }
        assert!(read("{ caustics 0 dispersion 1 dispersion_samples 9 }").is_ok());
    }
}
