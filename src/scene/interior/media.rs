//! `media`: participating media that emit, absorb and scatter light, as the scene describes them.

use crate::base::args::{Args, Parse, Word, declared, transform_step};
use crate::base::color::Rgb;
use crate::base::math::Step;
use crate::base::source::{Diagnostic, Span};
use crate::scene::pattern::{Blend, Keys, Map};
use crate::scene::texture::{Pigment, PigmentSyntax};

/// The first language version with the current sampling defaults.
const NEW_DEFAULTS_VERSION: f64 = 3.5;
/// Limit on samples and intervals.
const MAX_COUNT: f64 = 65536.0;

/// A participating medium.
#[derive(Clone, Debug)]
pub struct Media {
    /// Its location in the scene.
    pub at: Span,
    /// Absorption coefficient: the share absorbed per unit of length.
    pub absorption: Rgb,
    /// Emitted radiance per unit of length.
    pub emission: Rgb,
    /// Scattering.
    pub scattering: Scattering,
    /// Densities, which are multiplied; a medium without any is homogeneous.
    pub densities: Vec<Density>,
    /// Sampling along rays.
    pub sampling: Sampling,
    /// Photons are stored in the medium.
    pub collect: bool,
}

/// Scattering parameters of a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering {
    /// The phase function.
    pub phase: Phase,
    /// Scattering coefficient: the share scattered per unit of length.
    pub color: Rgb,
    /// The asymmetry of [`Phase::HenyeyGreenstein`], positive for forward scattering.
    pub eccentricity: f64,
    /// The factor on the scattering coefficient in the extinction coefficient.
    pub extinction: f64,
}

/// Phase functions, by their numbers in the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// 1: all directions alike.
    Isotropic,
    /// 2: Mie scattering in fine haze.
    MieHazy,
    /// 3: Mie scattering in murky air.
    MieMurky,
    /// 4: Rayleigh scattering in clear air.
    Rayleigh,
    /// 5: Henyey-Greenstein, with an eccentricity.
    HenyeyGreenstein,
}

/// Sampling parameters of rays through a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// The sampling method, 1, 2 or 3.
    pub method: u8,
    /// The number of intervals of a ray.
    pub intervals: u32,
    /// The minimum and maximum number of samples per interval.
    pub samples: [u32; 2],
    /// The required confidence that the samples suffice.
    pub confidence: f64,
    /// The variance at which the samples suffice.
    pub variance: f64,
    /// The share of samples for lit intervals.
    pub ratio: f64,
    /// The amplitude of random sample offsets.
    pub jitter: f64,
    /// The maximum subdivision depth of method 3.
    pub aa_level: u32,
    /// The difference above which method 3 subdivides.
    pub aa_threshold: f64,
}

/// A density: a pigment whose colours scale the coefficients of its medium.
#[derive(Clone, Debug, Default)]
pub struct Density(pub Pigment);

impl Density {
    /// Reads the block of a density; without content it is black.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read(args: &mut dyn Args) -> Parse<Density> {
        args.open()?;
        let base = Density::known(args)?;
        Ok(Density(
            base.0.read_to_block_end(args, PigmentSyntax::Density)?,
        ))
    }

    /// Reads `density_map { ... }` after the keyword.
    ///
    /// # Errors
    /// A malformed entry, or no entries.
    pub fn read_map(keys: Keys, args: &mut dyn Args) -> Parse<Map<Density>> {
        Map::read("density_map", keys, Blend::refuse, args, &mut |args| {
            let base = Density::known(args)?;
            base.0.read_entry(args, PigmentSyntax::Density).map(Density)
        })
    }

    fn known(args: &mut dyn Args) -> Parse<Density> {
        let known = declared::<Density>(args)?;
        Ok(known.map_or_else(Density::default, |known| Density::clone(&known)))
    }
}

impl Media {
    fn new(at: Span, version: f64) -> Self {
        let is_old = version < NEW_DEFAULTS_VERSION;
        Media {
            at,
            absorption: Rgb::BLACK,
            emission: Rgb::BLACK,
            scattering: Scattering {
                phase: Phase::Isotropic,
                color: Rgb::BLACK,
                eccentricity: 0.0,
                extinction: 1.0,
            },
            densities: Vec::new(),
            sampling: Sampling {
                method: if is_old { 1 } else { 3 },
                intervals: if is_old { 10 } else { 1 },
                samples: if is_old { [1, 1] } else { [10, 10] },
                confidence: 0.9,
                variance: 1.0 / 128.0,
                ratio: 0.9,
                jitter: 0.0,
                aa_level: 3,
                aa_threshold: 0.1,
            },
            collect: true,
        }
    }

    /// Reads the block of a medium.
    ///
    /// # Errors
    /// A malformed value, or one out of bounds.
    pub fn read(args: &mut dyn Args) -> Parse<Media> {
        let at = args.last_span();
        args.open()?;
        let mut media = match declared::<Media>(args)? {
            Some(known) => Media {
                at,
                ..Media::clone(&known)
            },
            None => Media::new(at, args.version()),
        };
        while !args.accept_close()? {
            media.read_item(args)?;
        }
        Ok(media)
    }

    fn read_item(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(step) = transform_step(args)? {
            // A transform affects only the densities before it.
            self.transform(&step);
            return Ok(());
        }
        match args.word()? {
            Some(word @ (Word::Absorption | Word::Emission)) => {
                args.accept(word)?;
                let color = args.color()?.rgb;
                if word == Word::Absorption {
                    self.absorption = color;
                } else {
                    self.emission = color;
                }
            }
            Some(Word::Scattering) => self.scattering.read(args)?,
            Some(Word::Density) => {
                args.accept(Word::Density)?;
                self.densities.push(Density::read(args)?);
            }
            Some(Word::Collect) => {
                args.accept(Word::Collect)?;
                self.collect = args.float_or(1.0)? != 0.0;
            }
            Some(word) if self.sampling.read_item(word, args)? => {}
            _ => return Err(args.expected("a parameter of `media` or `}`")),
        }
        Ok(())
    }
}

impl Media {
    /// Converts the coefficients to a smaller unit of length, in which all lengths are larger by `factor`.
    pub(crate) fn scale_scene_lengths(&mut self, factor: f64) {
        for color in [
            &mut self.absorption,
            &mut self.emission,
            &mut self.scattering.color,
        ] {
            *color = *color * (1.0 / factor);
        }
    }

    /// Transforms the densities.
    pub fn transform(&mut self, step: &Step) {
        for density in &mut self.densities {
            density.0.transform(step);
        }
    }
}

impl Scattering {
    fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.accept(Word::Scattering)?;
        args.open()?;
        let at = args.span();
        let number = args.float()?.trunc();
        self.phase = match number {
            2.0 => Phase::MieHazy,
            3.0 => Phase::MieMurky,
            4.0 => Phase::Rayleigh,
            5.0 => Phase::HenyeyGreenstein,
            _ => Phase::Isotropic,
        };
        if !(1.0..=5.0).contains(&number) {
            args.warn(Diagnostic::warning(
                at,
                format!("`scattering` has the types 1 to 5; {number} is taken for 1"),
            ));
        }
        args.comma()?;
        self.color = args.color()?.rgb;
        while !args.accept_close()? {
            let at = args.span();
            if args.accept(Word::Extinction)? {
                self.extinction = args.float()?;
            } else if args.accept(Word::Eccentricity)? {
                if self.phase != Phase::HenyeyGreenstein {
                    let error =
                        Diagnostic::error(at, "only `scattering` of type 5 has an `eccentricity`");
                    return Err(Box::new(error));
                }
                self.eccentricity = args.float()?;
            } else {
                return Err(args.expected("`eccentricity`, `extinction` or `}` in `scattering`"));
            }
        }
        Ok(())
    }
}

impl Sampling {
    fn read_item(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Method => {
                args.accept(word)?;
                self.method = match args.float()?.trunc() {
                    1.0 => 1,
                    2.0 => 2,
                    3.0 => 3,
                    _ => return Err(out_of_bounds(word, "is 1, 2 or 3", args)),
                };
            }
            Word::Intervals => self.intervals = count(word, args)?,
            Word::AaLevel => self.aa_level = count(word, args)?,
            Word::Samples => {
                let min = count(word, args)?;
                let has_max = args.has_next_value()?;
                self.samples = [
                    min,
                    if has_max {
                        count_value(word, args)?
                    } else {
                        min
                    },
                ];
            }
            Word::Confidence => {
                args.accept(word)?;
                self.confidence = args.float()?;
                if !(0.0..1.0).contains(&self.confidence) {
                    return Err(out_of_bounds(word, "lies between 0 and 1", args));
                }
            }
            Word::AaThreshold => {
                args.accept(word)?;
                self.aa_threshold = args.float()?;
                if self.aa_threshold <= 0.0 {
                    return Err(out_of_bounds(word, "is more than 0", args));
                }
            }
            Word::Variance | Word::Ratio | Word::Jitter => {
                args.accept(word)?;
                let value = args.float()?;
                match word {
                    Word::Variance => self.variance = value,
                    Word::Ratio => self.ratio = value,
                    _ => self.jitter = value,
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// Reads `word` and the number after it, truncated and at least 1.
fn count(word: Word, args: &mut dyn Args) -> Parse<u32> {
    args.accept(word)?;
    count_value(word, args)
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is checked"
)]
fn count_value(word: Word, args: &mut dyn Args) -> Parse<u32> {
    let number = args.float()?.trunc();
    if (1.0..=MAX_COUNT).contains(&number) {
        return Ok(number as u32);
    }
    Err(out_of_bounds(
        word,
        "is 1 at least, and not very many",
        args,
    ))
}

fn out_of_bounds(word: Word, bounds: &str, args: &dyn Args) -> Box<Diagnostic> {
    let message = format!("`{word}` of a medium {bounds}");
    Box::new(Diagnostic::error(args.last_span(), message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Parse<Media> {
        Media::read(&mut TextArgs::new(text))
    }

    #[test]
    fn all_parameters_of_media_are_read() {
        let media = read(
            "{ method 2 intervals 3 samples 2, 5 confidence 0.8 variance 0.01 ratio 0.7 jitter 0.3 aa_level 4 \
             aa_threshold 0.2 absorption rgb 0.1 emission 0.2 scattering { 5, rgb 0.3 eccentricity 0.2 \
             extinction 0.5 } density { rgb 1 } density { spherical density_map { [0 rgb 0] [1 rgb 1] } } \
             translate 1 collect off }",
        )
        .unwrap();
        assert_eq!((media.sampling.method, media.sampling.intervals), (2, 3));
        assert_eq!(
            (media.sampling.samples, media.sampling.aa_level),
            ([2, 5], 4)
        );
        assert_eq!(media.scattering.phase, Phase::HenyeyGreenstein);
        assert_eq!(
            (media.scattering.eccentricity, media.scattering.extinction),
            (0.2, 0.5)
        );
        assert_eq!((media.densities.len(), media.collect), (2, false));
    }

    #[test]
    fn defaults_depend_on_the_version() {
        let old = Media::read(&mut TextArgs::new("{ }").at_version(3.1)).unwrap();
        assert_eq!((old.sampling.method, old.sampling.samples), (1, [1, 1]));
        let new = read("{ samples 4 }").unwrap();
        assert_eq!((new.sampling.method, new.sampling.samples), (3, [4, 4]));
    }

    #[test]
    fn values_out_of_bounds_are_reported() {
        for (text, message) in [
            ("{ method 4 }", "`method` of a medium is 1, 2 or 3"),
            (
                "{ samples 0 }",
                "`samples` of a medium is 1 at least, and not very many",
            ),
            (
                "{ aa_threshold 0 }",
                "`aa_threshold` of a medium is more than 0",
            ),
            (
                "{ confidence 1 }",
                "`confidence` of a medium lies between 0 and 1",
            ),
            (
                "{ scattering { 2, rgb 1 eccentricity 0.3 } }",
                "only `scattering` of type 5 has an `eccentricity`",
            ),
        ] {
            assert_eq!(read(text).expect_err("it is faulty").message, message);
        }
    }
}
