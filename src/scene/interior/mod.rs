//! `interior`: refraction, attenuation and media inside an object.

mod media;
mod medium;

pub use media::{Density, Media, Phase, Sampling, Scattering};
pub use medium::{MediumCoefficients, PreparedMedia};

use crate::base::args::{Args, Parse, Word, declared};
use crate::base::color::Rgb;
use crate::base::math::{Step, Transform};
use crate::base::source::Diagnostic;
use crate::scene::texture::Finish;
use std::sync::Arc;

/// The exponent of the cosine for `caustics 1`; old finishes give the exponent itself.
const CAUSTICS_POWER: f32 = 45.0;
/// From this `fade_power` on, attenuation is exponential.
const EXPONENTIAL_POWER: f64 = 1000.0;

/// The interior of an object. The default does not refract or attenuate light.
#[derive(Clone, Debug)]
pub struct Interior {
    /// The index of refraction.
    pub ior: f32,
    /// The scene states an index of refraction other than 0. Otherwise the index and the dispersion are those of the
    /// atmosphere (measured).
    pub has_ior: bool,
    /// The distance over which light fades to the mean of white and `fade_color`; 0 for no attenuation.
    pub fade_distance: f32,
    /// The exponent of the attenuation, which is exponential from 1000 on. With 0, light fades halfway to `fade_color`
    /// at any distance.
    pub fade_power: f32,
    /// The limit of the attenuation at great distances.
    pub fade_color: Rgb,
    /// The dispersion: the ratio of the indices of violet and red light.
    pub dispersion: f32,
    /// The number of spectral samples of white light.
    pub dispersion_samples: u32,
    /// The exponent of the cosine of the approximate caustics behind the surface; 0 for no caustics.
    pub caustics: f32,
    /// The media inside the object.
    pub media: Vec<Media>,
    /// `refraction` of an old finish: a factor on all light transmitted by the surface.
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
    /// The interior of an object to which these steps have been applied already: they do not move its media.
    #[must_use]
    pub fn after(mut self, steps: &[Step]) -> Self {
        if !(steps.is_empty() || self.media.is_empty()) {
            let back = Transform::from_steps(steps).inverse();
            self.transform(&Step::General(Arc::new(back)));
        }
        self
    }

    /// Transforms the media; `fade_distance` does not change.
    pub fn transform(&mut self, step: &Step) {
        for media in &mut self.media {
            media.transform(step);
        }
    }
}

impl Interior {
    /// Reads the block of an interior.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
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
                self.set_ior(ior);
            }
            Word::FadeDistance => self.fade_distance = number(word, args)?,
            Word::FadePower => self.fade_power = number(word, args)?,
            Word::FadeColor | Word::FadeColour => {
                args.accept(word)?;
                self.fade_color = args.color()?.rgb;
            }
            Word::Caustics => self.caustics = CAUSTICS_POWER * number(word, args)?,
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

    /// The transmittance over `distance` inside.
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
            let transmittance = if power < EXPONENTIAL_POWER {
                c + (1.0 - c) / (1.0 + depth.powf(power))
            } else {
                (-(1.0 - c) * depth).exp()
            };
            transmittance as f32
        })
    }

    /// The transmittance of shadow rays over `distance`; as in POV-Ray, powers of 0 and below do not attenuate them.
    #[must_use]
    pub fn shadow_ray_fade(&self, distance: f64) -> Rgb {
        if self.fade_power > 0.0 {
            self.fade(distance)
        } else {
            Rgb::WHITE
        }
    }

    /// Takes `ior`, `refraction` and `caustics` from the finishes of the object's texture, where old scenes write them.
    pub fn take_finish_settings<'a>(&mut self, finishes: impl IntoIterator<Item = &'a Finish>) {
        for finish in finishes {
            if let Some(ior) = finish.ior {
                self.set_ior(ior);
            }
            self.refraction = finish.refraction.unwrap_or(self.refraction);
            self.caustics = finish.caustics.unwrap_or(self.caustics);
        }
    }

    /// Sets the index of refraction; 0 counts as none.
    fn set_ior(&mut self, ior: f32) {
        self.has_ior = ior != 0.0;
        self.ior = if self.has_ior { ior } else { 1.0 };
    }

    /// The dispersion; 1 for an interior without `ior`, whose own value is ignored.
    #[must_use]
    pub fn effective_dispersion(&self) -> f32 {
        if self.has_ior { self.dispersion } else { 1.0 }
    }

    /// Returns true if the interior attenuates light.
    #[must_use]
    pub fn fades(&self) -> bool {
        self.fade_distance != 0.0
    }
}

/// Bounds of `dispersion_samples`; the upper one only limits the cost.
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
    fn an_ior_of_0_counts_as_none() {
        // POV-Ray 3.7 renders the same picture without it, also if a finish sets it.
        let mut args = TextArgs::new("{ I ior 0 }").with("I", read("{ ior 1.5 }").unwrap());
        let named = Interior::read(&mut args).unwrap();
        let mut finished = read("{ ior 1.5 }").unwrap();
        finished.take_finish_settings([&Finish {
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
        // POV-Ray 3.7 shows the background of a clear sphere with `fade_distance 1` at half its brightness.
        assert_eq!(
            read("{ fade_distance 1 }").unwrap().fade(2.0),
            Rgb::splat(0.5)
        );
    }

    #[test]
    fn power_0_does_not_attenuate_shadow_rays() {
        let interior = read("{ fade_distance 1 }").unwrap();
        assert_eq!(interior.shadow_ray_fade(2.0), Rgb::WHITE);
        let interior = read("{ fade_distance 2 fade_power 1 }").unwrap();
        assert_eq!(interior.shadow_ray_fade(2.0), interior.fade(2.0));
    }

    #[test]
    fn from_power_1000_on_light_fades_exponentially() {
        let interior = read("{ fade_distance 2 fade_power 1001 fade_color rgb 0.5 }").unwrap();
        assert_eq!(interior.fade(4.0), Rgb::splat((-1.0f32).exp()));
    }

    #[test]
    fn dispersion_samples_are_at_least_2() {
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
