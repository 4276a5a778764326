//! `interior`: what fills an object: how it bends light and how light fades in it.
//!

mod media;
mod medium;

pub use media::{Density, Media, Phase, Sampling, Scattering};
pub use medium::{Effect, PreparedMedia};

use crate::base::args::{Args, Parse, Word, declared};
use crate::base::color::Rgb;
use crate::base::math::{Step, Transform};
use crate::base::source::Diagnostic;
use crate::scene::texture::Finish;
use std::sync::Arc;

/// The power of the cosine for `caustics 1`; old finishes give the power itself.
const CAUSTICS: f32 = 45.0;
/// From this `fade_power` on, light fades exponentially.
const EXPONENTIAL_POWER: f64 = 1000.0;

/// What fills an object. The default is the atmosphere: light goes straight and does not fade.
#[derive(Clone, Debug)]
pub struct Interior {
    /// The index of refraction.
    pub ior: f32,
    /// Whether the scene says so, and not that it is 0. Otherwise it is that of the atmosphere, and so is the dispersion (measured).
    pub has_ior: bool,
    /// The distance over which light fades to the mean of full light and `fade_color`; 0 for no fading.
    pub fade_distance: f32,
    /// How fast light fades; from 1000 on exponentially. With 0 all light is halved towards `fade_color`.
    pub fade_power: f32,
    /// The colour to which light fades.
    pub fade_color: Rgb,
    /// How much more light bends that is bluer: the ratio of the indices of violet and red light.
    pub dispersion: f32,
    /// Into how many colours white light is split.
    pub dispersion_samples: u32,
    /// The power of the cosine by which light gathers behind the surface; 0 for no gathering.
    pub caustics: f32,
    /// What fills the object and glows, swallows light or scatters it.
    pub media: Vec<Media>,
    /// `refraction` of an old finish: a factor on all light that comes through the surface.
    pub refraction: f32,
}

impl Default for Interior {
    fn default() -> Self {
        Interior {
            ior: 1.0,
            has_ior: false,
            fade_distance: 0.0,
            fade_power: 0.0,
            fade_color: Rgb::BLACK,
            dispersion: 1.0,
            dispersion_samples: 7,
            caustics: 0.0,
            media: Vec::new(),
            refraction: 1.0,
        }
    }
}

impl Interior {
    /// The interior of an object that has been moved by these steps already: they do not move its media.
    #[must_use]
    pub fn after(mut self, steps: &[Step]) -> Self {
        if !(steps.is_empty() || self.media.is_empty()) {
            let back = Transform::from_steps(steps).inverse();
            self.transform(&Step::General(Arc::new(back)));
        }
        self
    }

    /// Moves its media; distances of fading stay as they are.
    pub fn transform(&mut self, step: &Step) {
        for media in &mut self.media {
            media.transform(step);
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
        match word {
            Word::Ior => {
                let ior = number(word, args)?;
                self.say_ior(ior);
            }
            Word::FadeDistance => self.fade_distance = number(word, args)?,
            Word::FadePower => self.fade_power = number(word, args)?,
            Word::FadeColor | Word::FadeColour => {
                args.accept(word)?;
                self.fade_color = args.color()?.rgb;
            }
            Word::Caustics => self.caustics = CAUSTICS * number(word, args)?,
            Word::Dispersion => self.dispersion = number(word, args)?,
            Word::DispersionSamples => self.dispersion_samples = dispersion_samples(args)?,
            Word::Media => {
                args.accept(word)?;
                self.media.push(Media::read(args)?);
            }
            Word::Refraction => {
                let at = args.span();
                number(word, args)?;
                args.warn(Diagnostic::warning(
                    at,
                    "`refraction` in `interior` does nothing",
                ));
            }
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

    /// The factor on light on its way from a source: as in POV-Ray it does not fade by powers that are not positive.
    #[must_use]
    pub fn fade_on_light(&self, distance: f64) -> Rgb {
        if self.fade_power > 0.0 {
            self.fade(distance)
        } else {
            Rgb::WHITE
        }
    }

    /// Takes over `ior`, `refraction` and `caustics` from the finishes of the object's texture, where old scenes have them.
    pub fn take_from_finishes<'a>(&mut self, finishes: impl IntoIterator<Item = &'a Finish>) {
        for finish in finishes {
            if let Some(ior) = finish.ior {
                self.say_ior(ior);
            }
            self.refraction = finish.refraction.unwrap_or(self.refraction);
            self.caustics = finish.caustics.unwrap_or(self.caustics);
        }
    }

    /// Takes an index of refraction; 0 is as if the scene said none.
    fn say_ior(&mut self, ior: f32) {
        self.has_ior = ior != 0.0;
        self.ior = if self.has_ior { ior } else { 1.0 };
    }

    /// How much more bluer light bends, without regard to what an interior without `ior` says.
    #[must_use]
    pub fn effective_dispersion(&self) -> f32 {
        if self.has_ior { self.dispersion } else { 1.0 }
    }

    /// Whether light fades at all.
    #[must_use]
    pub fn fades(&self) -> bool {
        self.fade_distance != 0.0
    }
}

/// Bounds of `dispersion_samples`; the upper one is more than any picture is worth.
const DISPERSION_SAMPLES: std::ops::RangeInclusive<f64> = 2.0..=4096.0;

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is checked"
)]
fn dispersion_samples(args: &mut dyn Args) -> Parse<u32> {
    let at = args.span();
    args.accept(Word::DispersionSamples)?;
    let count = args.float()?.trunc();
    if DISPERSION_SAMPLES.contains(&count) {
        return Ok(count as u32);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("`dispersion_samples` runs from 2 to 4096, not {count}"),
    )))
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
    use crate::base::args::text::TextArgs;

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
    fn an_ior_of_0_is_as_none() {
        // POV-Ray 3.7 draws the same picture without it, also where a finish says so.
        let mut args = TextArgs::new("{ I ior 0 }").with("I", read("{ ior 1.5 }").unwrap());
        let named = Interior::read(&mut args).unwrap();
        let mut finished = read("{ ior 1.5 }").unwrap();
        finished.take_from_finishes([&Finish {
            ior: Some(0.0),
            ..Finish::default()
        }]);
        for interior in [read("{ ior 0 }").unwrap(), named, finished] {
            assert_eq!((interior.ior, interior.has_ior), (1.0, false));
        }
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
    fn light_of_a_source_does_not_fade_by_power_0() {
        let interior = read("{ fade_distance 1 }").unwrap();
        assert_eq!(interior.fade_on_light(2.0), Rgb::WHITE);
        let interior = read("{ fade_distance 2 fade_power 1 }").unwrap();
        assert_eq!(interior.fade_on_light(2.0), interior.fade(2.0));
    }

    #[test]
    fn from_power_1000_on_light_fades_exponentially() {
        let interior = read("{ fade_distance 2 fade_power 1001 fade_color rgb 0.5 }").unwrap();
        assert_eq!(interior.fade(4.0), Rgb::splat((-1.0f32).exp()));
    }

    #[test]
    fn light_can_be_split_in_two_colours_at_least() {
        let interior = read("{ dispersion 1.1 dispersion_samples 9.5 caustics 0.5 }").unwrap();
        assert_eq!((interior.dispersion, interior.dispersion_samples), (1.1, 9));
        assert_eq!(interior.effective_dispersion(), 1.0);
        let glass = read("{ ior 1 dispersion 1.1 }").unwrap();
        assert_eq!(glass.effective_dispersion(), 1.1);
        let error = read("{ dispersion_samples 1 }").expect_err("one is white");
        assert_eq!(
            error.message,
            "`dispersion_samples` runs from 2 to 4096, not 1"
        );
    }

    #[test]
    fn several_media_add_up() {
        let interior = read("{ media { emission 1 } media { absorption rgb 0.5 } }").unwrap();
        assert_eq!(interior.media.len(), 2);
    }
}
