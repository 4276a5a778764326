//! `finish`: the reflection properties of a surface.

use super::numbers::{number, single};
use super::{Irid, Reflection, Subsurface};
use crate::base::args::{Args, Parse, Word, declared, since_3_8};
use crate::base::color::Rgb;
use crate::base::source::Diagnostic;

/// The reflection properties of a surface, in single precision as in POV-Ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Finish {
    /// The share of `ambient_light` that the surface reflects.
    pub ambient: Rgb,
    /// The light that the surface emits.
    pub emission: Rgb,
    /// Diffuse reflection on the lit side, the `albedo` factor included.
    pub diffuse: f32,
    /// Diffuse transmission of light from behind the surface.
    pub diffuse_back: f32,
    /// `diffuse` and `diffuse_back` without the `albedo` factor: the shares of indirect light that are reflected.
    pub diffuse_without_albedo: [f32; 2],
    /// The exponent of the diffuse cosine.
    pub brilliance: f32,
    /// The strength of Phong highlights, the `albedo` factor included.
    pub phong: f32,
    /// The exponent of Phong highlights.
    pub phong_size: f32,
    /// The strength of Blinn's highlights, the `albedo` factor included.
    pub specular: f32,
    /// The exponent of Blinn's highlights, the reciprocal of `roughness`; 0 for `roughness 0`.
    pub shininess: f32,
    /// The share of the pigment's colour in highlights.
    pub metallic: f32,
    /// True if that of `specular` follows the angle to the half vector, not to the normal; since version 3.8.
    pub tints_by_half_vector: bool,
    /// The largest amount by which diffuse light is darkened at random.
    pub crand: f32,
    /// Thin-film interference.
    pub irid: Irid,
    /// Subsurface scattering, drawn if the scene enables it.
    pub subsurface: Option<Subsurface>,
    /// Specular reflection.
    pub reflection: Reflection,
    /// The share of Fresnel's law in the surface's light and highlights; since version 3.8.
    pub fresnel: f32,
    /// True if transparency takes from highlights and reflection as well; since version 3.8.
    pub use_alpha: bool,
    /// True if transmitted light is reduced by the light that is reflected.
    pub conserve_energy: bool,
    /// `ior` in a finish, the syntax before version 3.1; overrides the interior's.
    pub ior: Option<f32>,
    /// `caustics` in a finish, the syntax before version 3.1; overrides the interior's.
    pub caustics: Option<f32>,
    /// `refraction` in a finish, a factor on all transmitted light.
    pub refraction: Option<f32>,
}

impl Default for Finish {
    /// The default finish of POV-Ray 3.7 in every language version.
    fn default() -> Self {
        Finish {
            ambient: Rgb::splat(0.1),
            emission: Rgb::BLACK,
            diffuse: 0.6,
            diffuse_back: 0.0,
            diffuse_without_albedo: [0.6, 0.0],
            brilliance: 1.0,
            phong: 0.0,
            phong_size: 40.0,
            specular: 0.0,
            shininess: 20.0,
            metallic: 0.0,
            tints_by_half_vector: false,
            crand: 0.0,
            irid: Irid::default(),
            subsurface: None,
            reflection: Reflection::default(),
            fresnel: 0.0,
            use_alpha: false,
            conserve_energy: false,
            ior: None,
            caustics: None,
            refraction: None,
        }
    }
}

/// The values of a block that are written as `albedo`. They are scaled at the end of the block.
#[derive(Default)]
struct Albedo {
    diffuse: bool,
    phong: bool,
    specular: bool,
}

impl Finish {
    /// True if direct light contributes to the surface's colour.
    #[must_use]
    #[inline]
    pub fn takes_light(&self) -> bool {
        let shares = [self.diffuse, self.diffuse_back, self.phong, self.specular];
        shares.iter().any(|&share| share != 0.0)
    }

    /// Reads a finish block. Values that the block does not set are those of `base`.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read(args: &mut dyn Args, base: &Finish) -> Parse<Finish> {
        args.open()?;
        let mut finish = match declared::<Finish>(args)? {
            Some(known) => Finish::clone(&known),
            None => base.clone(),
        };
        let mut albedo = Albedo::default();
        let mut has_reflection = false;
        while !args.accept_close()? {
            let word = args.word()?;
            has_reflection |= word == Some(Word::Reflection);
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
        if finish.fresnel != 0.0 {
            finish.reflection.end_fresnel();
        } else if has_reflection {
            finish.reflection.end_without_fresnel();
        }
        finish.scale_albedos(&albedo);
        finish.clamp_negative_strengths();
        Ok(finish)
    }

    /// Reads `word`, the next token, with its value if scenes before version 3.0 may have it directly in a texture.
    /// `diffuse` has one number there and `metallic` none.
    pub(super) fn read_bare(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Diffuse => {
                self.diffuse = number(word, args)?;
                self.diffuse_back = 0.0;
                self.diffuse_without_albedo = [self.diffuse, 0.0];
            }
            Word::Metallic => {
                args.accept(word)?;
                self.metallic = 1.0;
                self.tints_by_half_vector = args.is_for_3_8();
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
        self.clamp_negative_strengths();
        Ok(true)
    }

    /// True if the surface has specular reflection.
    #[must_use]
    pub fn has_reflection(&self) -> bool {
        self.reflection.min != Rgb::BLACK || self.reflection.max != Rgb::BLACK
    }

    /// True if it has values that belong in the interior since version 3.1.
    pub(crate) fn has_interior(&self) -> bool {
        self.ior.is_some() || self.refraction.is_some() || self.caustics.is_some()
    }

    /// Reads a parameter of diffuse light or highlights; false for another word.
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
                self.diffuse_without_albedo = [self.diffuse, self.diffuse_back];
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
                self.tints_by_half_vector = args.is_for_3_8();
            }
            Word::Crand => self.crand = number(word, args)?,
            Word::Irid => self.irid = Irid::read(args)?,
            Word::Subsurface => self.subsurface = Some(Subsurface::read(args)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Reads a parameter of specular reflection; false for another word.
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
            Word::Fresnel => {
                args.accept(word)?;
                since_3_8(args, word, Word::Finish)?;
                self.fresnel = single(args.float_or(1.0)?);
                self.reflection.is_fresnel = self.fresnel != 0.0;
            }
            Word::UseAlpha => {
                args.accept(word)?;
                since_3_8(args, word, Word::Finish)?;
                self.use_alpha = args.float_or(1.0)? != 0.0;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Reads a parameter that version 3.1 moved to the interior; false for another word.
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
                    .with_hint("Write `interior { ior ... }` in the object."),
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

    /// Clamps negative strengths to 0. POV-Ray skips diffuse light and highlights of 0 or less; molecule viewers rely
    /// on this when they write `phong -1`. Ambient light, reflection and exponents stay as given.
    fn clamp_negative_strengths(&mut self) {
        let [front, back] = &mut self.diffuse_without_albedo;
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

    /// Converts albedos to strengths with the exponents at the end of the block.
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

/// Reads `word` and the colour after it; a number is a grey.
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
    fn negative_strengths_are_clamped() {
        let finish = read("{ diffuse albedo -0.5, -1 phong -1 specular albedo -0.25 metallic -1 }");
        assert_eq!((finish.diffuse, finish.diffuse_back), (0.0, 0.0));
        assert_eq!(finish.diffuse_without_albedo, [0.0, 0.0]);
        assert_eq!(
            (finish.phong, finish.specular, finish.metallic),
            (0.0, 0.0, 0.0)
        );
        assert!(!finish.takes_light());
        assert_eq!(read("{ ambient -0.5 }").ambient, Rgb::splat(-0.5));
    }

    #[test]
    fn roughness_0_gives_a_warning() {
        let mut args = TextArgs::new("{ roughness 0 }");
        let finish = Finish::read(&mut args, &Finish::default()).unwrap();
        assert_eq!(finish.shininess, 0.0);
        assert_eq!(args.warnings().len(), 1);
    }

    #[test]
    fn refraction_words_of_old_scenes_are_stored() {
        let mut args = TextArgs::new("{ ior 1.5 refraction 0.5 caustics 0.25 }");
        let finish = Finish::read(&mut args, &Finish::default()).unwrap();
        assert_eq!((finish.ior, finish.refraction), (Some(1.5), Some(0.5)));
        assert_eq!((finish.caustics, args.warnings().len()), (Some(0.25), 3));
    }

    #[test]
    fn interior_words_are_refused() {
        assert_eq!(
            error("{ fade_power 1 }"),
            "expected a parameter of `finish` or `}`, found `fade_power`"
        );
    }
}
