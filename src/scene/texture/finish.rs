//! `finish`: how a surface answers to light.

use super::{Irid, Reflection, Subsurface};
use crate::base::args::{Args, Parse, Word, declared};
use crate::base::color::Rgb;
use crate::base::source::Diagnostic;

/// The answer of a surface to light, in single precision as POV-Ray keeps it.
#[derive(Clone, Debug, PartialEq)]
pub struct Finish {
    /// The share of `ambient_light` that the surface gives back.
    pub ambient: Rgb,
    /// The light that the surface gives of itself.
    pub emission: Rgb,
    /// Diffuse reflection on the lit side, the `albedo` factor included.
    pub diffuse: f32,
    /// Diffuse reflection of light from behind.
    pub diffuse_back: f32,
    /// Both as the scene gives them: the share of light from all around that is thrown back.
    pub diffuse_as_given: [f32; 2],
    /// The exponent of the diffuse cosine.
    pub brilliance: f32,
    /// The strength of Phong highlights, the `albedo` factor included.
    pub phong: f32,
    /// The exponent of Phong highlights.
    pub phong_size: f32,
    /// The strength of Blinn's highlights, the `albedo` factor included.
    pub specular: f32,
    /// The reciprocal of `roughness`, which is the exponent of Blinn's highlights; 0 for `roughness 0`.
    pub shininess: f32,
    /// How far highlights take the colour of the pigment.
    pub metallic: f32,
    /// By how much diffuse light is darkened at random.
    pub crand: f32,
    /// Colours of a thin film.
    pub irid: Irid,
    /// How light spreads below the surface; kept, and not drawn yet.
    pub subsurface: Option<Subsurface>,
    /// The mirror image.
    pub reflection: Reflection,
    /// Whether what the surface reflects is missing from what it lets through.
    pub conserve_energy: bool,
    /// `ior` in a finish, the syntax before version 3.1; it overrules that of the interior.
    pub ior: Option<f32>,
    /// `caustics` in a finish, the syntax before version 3.1; it overrules that of the interior.
    pub caustics: Option<f32>,
    /// `refraction` in a finish, a factor on all light that comes through the surface.
    pub refraction: Option<f32>,
}

impl Default for Finish {
    /// The finish that POV-Ray 3.7 gives in every language version.
    fn default() -> Self {
        Finish {
            ambient: Rgb::splat(0.1),
            emission: Rgb::BLACK,
            diffuse: 0.6,
            diffuse_back: 0.0,
            diffuse_as_given: [0.6, 0.0],
            brilliance: 1.0,
            phong: 0.0,
            phong_size: 40.0,
            specular: 0.0,
            shininess: 20.0,
            metallic: 0.0,
            crand: 0.0,
            irid: Irid::default(),
            subsurface: None,
            reflection: Reflection::default(),
            conserve_energy: false,
            ior: None,
            caustics: None,
            refraction: None,
        }
    }
}

/// Which values of a block are albedos, to be scaled when the block is complete.
#[derive(Default)]
struct Albedo {
    diffuse: bool,
    phong: bool,
    specular: bool,
}

impl Finish {
    /// Whether light from lamps can be seen on it.
    #[must_use]
    #[inline]
    pub fn takes_light(&self) -> bool {
        let shares = [self.diffuse, self.diffuse_back, self.phong, self.specular];
        shares.iter().any(|&share| share != 0.0)
    }

    /// The finish of a block; what the block does not say is as in `base`.
    ///
    /// # Errors
    /// A malformed value, or a word that is not built yet.
    pub fn read(args: &mut dyn Args, base: &Finish) -> Parse<Finish> {
        args.open()?;
        let mut finish = match declared::<Finish>(args)? {
            Some(known) => Finish::clone(&known),
            None => base.clone(),
        };
        let mut albedo = Albedo::default();
        while !args.accept_close()? {
            let word = args.word()?;
            let is_known = match word {
                Some(word) => {
                    finish.read_light(word, args, &mut albedo)?
                        || finish.read_mirror(word, args)?
                        || finish.read_old(word, args)?
                }
                None => false,
            };
            if !is_known {
                return Err(args.expected("a parameter of `finish` or `}`"));
            }
        }
        finish.scale_albedos(&albedo);
        finish.leave_out_negative_light();
        Ok(finish)
    }

    /// Reads `word`, the next token, with its value if it may stand in the texture itself before version 3.0. `diffuse` has
    /// one number there and `metallic` none.
    pub(super) fn read_bare(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Diffuse => {
                self.diffuse = number(word, args)?;
                self.diffuse_back = 0.0;
                self.diffuse_as_given = [self.diffuse, 0.0];
            }
            Word::Metallic => {
                args.accept(word)?;
                self.metallic = 1.0;
            }
            Word::Ambient
            | Word::Brilliance
            | Word::Crand
            | Word::Phong
            | Word::PhongSize
            | Word::Roughness
            | Word::Specular => {
                self.read_light(word, args, &mut Albedo::default())?;
            }
            Word::Reflection => return self.read_mirror(word, args),
            Word::Ior | Word::Refraction => return self.read_old(word, args),
            _ => return Ok(false),
        }
        self.leave_out_negative_light();
        Ok(true)
    }

    /// Whether the surface has a mirror image.
    #[must_use]
    pub fn has_reflection(&self) -> bool {
        self.reflection.min != Rgb::BLACK || self.reflection.max != Rgb::BLACK
    }

    /// Whether it says, as old scenes do, what belongs to the interior.
    pub(crate) fn has_interior(&self) -> bool {
        self.ior.is_some() || self.refraction.is_some() || self.caustics.is_some()
    }

    /// What concerns light and highlights.
    fn read_light(&mut self, word: Word, args: &mut dyn Args, albedo: &mut Albedo) -> Parse<bool> {
        match word {
            Word::Ambient => self.ambient = rgb(word, args)?,
            Word::Emission => self.emission = rgb(word, args)?,
            Word::Diffuse => {
                args.accept(word)?;
                albedo.diffuse = args.accept(Word::Albedo)?;
                self.diffuse = single(args.float()?);
                args.comma()?;
                self.diffuse_back = single(args.float_or(0.0)?);
                self.diffuse_as_given = [self.diffuse, self.diffuse_back];
            }
            Word::Brilliance => self.brilliance = number(word, args)?,
            Word::Phong => {
                args.accept(word)?;
                albedo.phong = args.accept(Word::Albedo)?;
                self.phong = single(args.float()?);
            }
            Word::PhongSize => self.phong_size = number(word, args)?,
            Word::Specular => {
                args.accept(word)?;
                albedo.specular = args.accept(Word::Albedo)?;
                self.specular = single(args.float()?);
            }
            Word::Roughness => self.shininess = shininess(args)?,
            Word::Metallic => {
                args.accept(word)?;
                self.metallic = single(args.float_or(1.0)?);
            }
            Word::Crand => self.crand = number(word, args)?,
            Word::Irid => self.irid = Irid::read(args)?,
            Word::Subsurface => self.subsurface = Some(Subsurface::read(args)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What concerns the mirror image.
    fn read_mirror(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Reflection => {
                args.accept(word)?;
                self.reflection.read(args)?;
            }
            Word::ReflectionExponent => self.reflection.exponent = number(word, args)?,
            Word::ConserveEnergy => {
                args.accept(word)?;
                self.conserve_energy = true;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What version 3.1 moved to the interior.
    fn read_old(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Ior => {
                let at = args.span();
                self.ior = Some(number(word, args)?);
                args.warn(
                    Diagnostic::warning(
                        at,
                        "`ior` belongs in `interior`; it is taken from `finish` all the same",
                    )
                    .with_hint("write `interior { ior ... }` in the object"),
                );
            }
            Word::Refraction => {
                let at = args.span();
                self.refraction = Some(number(word, args)?);
                args.warn(Diagnostic::warning(
                    at,
                    "`refraction` in `finish` is not needed; it scales the light that comes through the surface",
                ));
            }
            Word::Caustics => {
                let at = args.span();
                self.caustics = Some(number(word, args)?);
                args.warn(
                    Diagnostic::warning(
                        at,
                        "`caustics` belongs in `interior`; it is taken from `finish` all the same",
                    )
                    .with_hint("Write `interior { caustics ... }` in the object."),
                );
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Sets to 0 what does not count below it: POV-Ray skips diffuse light and highlights that are not above 0, which
    /// molecule viewers rely on when they write `phong -1`. Ambient light, mirror images and exponents count as given.
    fn leave_out_negative_light(&mut self) {
        let [front, back] = &mut self.diffuse_as_given;
        let shares = [
            &mut self.diffuse,
            &mut self.diffuse_back,
            front,
            back,
            &mut self.phong,
            &mut self.specular,
            &mut self.metallic,
        ];
        for share in shares {
            *share = share.max(0.0);
        }
    }

    /// Turns albedos into strengths, with the exponents that the block has in the end.
    fn scale_albedos(&mut self, albedo: &Albedo) {
        if albedo.diffuse {
            let scale = 0.5 * (self.brilliance + 1.0);
            self.diffuse *= scale;
            self.diffuse_back *= scale;
        }
        if albedo.phong {
            self.phong *= 0.5 * (self.phong_size + 1.0);
        }
        if albedo.specular {
            let r = f64::from(self.shininess);
            let scale = (r + 2.0) / (4.0 * (2.0 - (-0.5 * r).exp2()));
            self.specular = single(f64::from(self.specular) * scale);
        }
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "finish values are single precision, as in POV-Ray"
)]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}

/// The number after `word`.
pub(super) fn number(word: Word, args: &mut dyn Args) -> Parse<f32> {
    args.accept(word)?;
    Ok(single(args.float()?))
}

/// The colour after `word`; a number is a grey.
fn rgb(word: Word, args: &mut dyn Args) -> Parse<Rgb> {
    args.accept(word)?;
    Ok(args.color()?.rgb)
}

fn shininess(args: &mut dyn Args) -> Parse<f32> {
    let at = args.span();
    args.accept(Word::Roughness)?;
    let roughness = args.float()?;
    if roughness == 0.0 {
        args.warn(Diagnostic::warning(
            at.to(args.last_span()),
            "`roughness 0` has no highlight to it; the highlight is spread over the whole lit side",
        ));
        return Ok(0.0);
    }
    Ok(single(1.0 / roughness))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Finish {
        Finish::read(&mut TextArgs::new(text), &Finish::default()).unwrap()
    }

    fn error(text: &str) -> String {
        let read = Finish::read(&mut TextArgs::new(text), &Finish::default());
        read.expect_err("the text is faulty").message
    }

    #[test]
    fn ambient_is_a_number_or_a_colour() {
        assert_eq!(read("{ ambient 0.5 }").ambient, Rgb::splat(0.5));
        assert_eq!(
            read("{ ambient rgb <1, 0, 0.5> }").ambient,
            Rgb::new(1.0, 0.0, 0.5)
        );
        assert_eq!(
            read("{ ambient <1, 0, 0.5> }").ambient,
            Rgb::new(1.0, 0.0, 0.5)
        );
    }

    #[test]
    fn diffuse_from_behind_is_the_second_number() {
        // POV-Ray 3.7 takes it with or without a comma, and a later `diffuse` without it sets it to 0.
        for text in ["{ diffuse 0.5, 0.25 }", "{ diffuse 0.5 0.25 }"] {
            assert_eq!((read(text).diffuse, read(text).diffuse_back), (0.5, 0.25));
        }
        assert_eq!(read("{ diffuse 0.5, 0.25 diffuse 0.75 }").diffuse_back, 0.0);
    }

    #[test]
    fn an_albedo_is_scaled_once_by_the_exponent_of_its_block() {
        // POV-Ray 3.7: `finish { F brilliance 5 }` does not scale the albedo of F again.
        let known = read("{ diffuse albedo 0.25 brilliance 3 }");
        assert_eq!(known.diffuse, 0.5);
        let mut args = TextArgs::new("{ F brilliance 5 }").with("F", known);
        let finish = Finish::read(&mut args, &Finish::default()).unwrap();
        assert_eq!((finish.diffuse, finish.brilliance), (0.5, 5.0));
        assert_eq!(read("{ phong_size 3 phong albedo 0.25 }").phong, 0.5);
        assert_eq!(read("{ phong albedo 0.25 phong_size 3 }").phong, 0.5);
    }

    #[test]
    fn light_below_0_is_left_out() {
        let finish = read("{ diffuse albedo -0.5, -1 phong -1 specular albedo -0.25 metallic -1 }");
        assert_eq!((finish.diffuse, finish.diffuse_back), (0.0, 0.0));
        assert_eq!(finish.diffuse_as_given, [0.0, 0.0]);
        assert_eq!(
            (finish.phong, finish.specular, finish.metallic),
            (0.0, 0.0, 0.0)
        );
        assert!(!finish.takes_light());
        assert_eq!(read("{ ambient -0.5 }").ambient, Rgb::splat(-0.5));
    }

    #[test]
    fn roughness_0_is_doubtful() {
        let mut args = TextArgs::new("{ roughness 0 }");
        let finish = Finish::read(&mut args, &Finish::default()).unwrap();
        assert_eq!(finish.shininess, 0.0);
        assert_eq!(args.warnings().len(), 1);
    }

    #[test]
    fn refraction_words_of_old_scenes_are_kept() {
        let mut args = TextArgs::new("{ ior 1.5 refraction 0.5 caustics 0.25 }");
        let finish = Finish::read(&mut args, &Finish::default()).unwrap();
        assert_eq!((finish.ior, finish.refraction), (Some(1.5), Some(0.5)));
        assert_eq!((finish.caustics, args.warnings().len()), (Some(0.25), 3));
    }

    #[test]
    fn words_of_interiors_are_not_expected() {
        assert_eq!(
            error("{ fade_power 1 }"),
            "expected a parameter of `finish` or `}`, found `fade_power`"
        );
    }
}
