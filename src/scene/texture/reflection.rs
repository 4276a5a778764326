//! `reflection`: the specular reflection of a finish.

use super::numbers::{number, single};
use crate::base::args::{Args, Parse, Word};
use crate::base::color::Rgb;

/// The specular reflection of a finish.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflection {
    /// Reflectivity at normal incidence.
    pub min: Rgb,
    /// Reflectivity at grazing incidence.
    pub max: Rgb,
    /// True if it is written with one colour for all angles.
    pub has_one_color: bool,
    /// True if reflectivity follows Fresnel's law with the `ior` of the interior, rather than `falloff`.
    pub is_fresnel: bool,
    /// The exponent of the transition from `min` to `max`.
    pub falloff: f32,
    /// The reciprocal of the power to which the reflected colour is raised; 0 makes it black, as in POV-Ray.
    pub exponent: f32,
    /// The share of the pigment's colour in the reflection.
    pub metallic: f32,
}

impl Default for Reflection {
    fn default() -> Self {
        Reflection {
            min: Rgb::BLACK,
            max: Rgb::BLACK,
            has_one_color: false,
            is_fresnel: false,
            falloff: 1.0,
            exponent: 1.0,
            metallic: 0.0,
        }
    }
}

impl Reflection {
    /// Reads `reflection COLOUR` or `reflection { ... }`, after the word.
    pub(super) fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        if !args.accept_mark('{')? {
            self.min = args.color()?.rgb;
            self.max = self.min;
            self.has_one_color = true;
            return Ok(());
        }
        self.min = args.color()?.rgb;
        self.max = self.min;
        args.comma()?;
        self.has_one_color = false;
        if args.at_expression()? {
            self.max = args.color()?.rgb;
        } else if let Some(max) = args.color_if_any()? {
            self.max = max.rgb;
        } else {
            self.has_one_color = true;
        }
        while !args.accept_close()? {
            match args.word()? {
                Some(word @ Word::Fresnel) => {
                    args.accept(word)?;
                    self.is_fresnel = args.float_or(1.0)? != 0.0;
                }
                Some(word @ Word::Falloff) => self.falloff = number(word, args)?,
                Some(word @ Word::Exponent) => self.exponent = number(word, args)?,
                Some(word @ Word::Metallic) => {
                    args.accept(word)?;
                    self.metallic = single(args.float_or(1.0)?);
                }
                _ => {
                    return Err(args.expected(
                        "`fresnel`, `falloff`, `exponent`, `metallic` or `}` in `reflection`",
                    ));
                }
            }
        }
        self.end_fresnel();
        Ok(())
    }

    /// Makes Fresnel reflection of one colour 0 at normal incidence, as POV-Ray does at the end of a block that may
    /// have `fresnel`: a later `reflection` without braces keeps the law but not this.
    pub(super) fn end_fresnel(&mut self) {
        if self.is_fresnel && self.has_one_color {
            self.min = Rgb::BLACK;
        }
    }

    /// Undoes [`Reflection::end_fresnel`] where `fresnel 0` follows in the same finish (measured with POV-Ray 3.8).
    pub(super) fn end_without_fresnel(&mut self) {
        if !self.is_fresnel && self.has_one_color {
            self.min = self.max;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Finish;
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Finish {
        Finish::read(&mut TextArgs::new(text), &Finish::default()).unwrap()
    }

    #[test]
    fn one_colour_is_reflected_equally_at_all_angles() {
        for text in [
            "{ reflection 0.5 }",
            "{ reflection { 0.5 } }",
            "{ reflection rgb 0.5 }",
        ] {
            let reflection = read(text).reflection;
            assert_eq!(
                (reflection.min, reflection.max),
                (Rgb::splat(0.5), Rgb::splat(0.5))
            );
        }
    }

    #[test]
    fn two_colours_are_for_normal_and_grazing_incidence() {
        for text in [
            "{ reflection { 0.25, 1 falloff 2 } }",
            "{ reflection { rgb 0.25 rgb 1 falloff 2 } }",
        ] {
            let reflection = read(text).reflection;
            assert_eq!(
                (reflection.min, reflection.max),
                (Rgb::splat(0.25), Rgb::WHITE)
            );
            assert_eq!(reflection.falloff, 2.0);
        }
    }

    #[test]
    fn fresnel_with_one_colour_reflects_nothing_at_normal_incidence() {
        let reflection = read("{ reflection { 1 fresnel } }").reflection;
        assert_eq!((reflection.min, reflection.is_fresnel), (Rgb::BLACK, true));
        assert_eq!(
            read("{ reflection { 0.5, 1 fresnel on } }").reflection.min,
            Rgb::splat(0.5)
        );
        assert!(
            !read("{ reflection { 1 fresnel off } }")
                .reflection
                .is_fresnel
        );
    }

    #[test]
    fn a_second_reflection_keeps_values_that_it_does_not_set() {
        let reflection =
            read("{ reflection { 0.5, 1 exponent 2 metallic } reflection 0.25 }").reflection;
        assert_eq!(reflection.min, Rgb::splat(0.25));
        assert_eq!((reflection.exponent, reflection.metallic), (2.0, 1.0));
    }
}
