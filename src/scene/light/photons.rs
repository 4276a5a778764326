//! `photons` blocks in lights and objects. They have no effect without `photons` in `global_settings`.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;

/// The `photons` settings of a light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhotonSettings {
    /// Emission of photons for refraction; `None` leaves it to the objects.
    pub refraction: Option<bool>,
    /// Emission of photons for reflection; `None` leaves it to the objects.
    pub reflection: Option<bool>,
    /// `area_light`: true if photons start at all lights of an area light's grid.
    pub from_area: bool,
}

/// The `photons` settings of an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectPhotons {
    /// The factor on the photon spacing of a target; `None` if the object is no target.
    pub target: Option<f64>,
    /// Refraction of photons; `None` leaves it to the light.
    pub refraction: Option<bool>,
    /// Reflection of photons; `None` leaves it to the light.
    pub reflection: Option<bool>,
    /// True if surfaces of the object store photons.
    pub collect: bool,
    /// True if the object does not block photons that have not hit their target yet.
    pub pass_through: bool,
}

impl Default for ObjectPhotons {
    fn default() -> Self {
        ObjectPhotons {
            target: None,
            refraction: None,
            reflection: None,
            collect: true,
            pass_through: false,
        }
    }
}

impl PhotonSettings {
    /// Parses the block after `photons` in a light.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.open()?;
        while !args.accept_close()? {
            if args.accept(Word::Refraction)? {
                self.refraction = Some(is_on_or_off(args)?);
            } else if args.accept(Word::Reflection)? {
                self.reflection = Some(is_on_or_off(args)?);
            } else if args.accept(Word::AreaLight)? {
                self.from_area = true;
            } else {
                return Err(args.expected(
                    "`refraction`, `reflection`, `area_light` or `}` in the `photons` of a light",
                ));
            }
        }
        Ok(())
    }
}

/// The photon settings of a surface: those of its object, combined with those of the enclosing objects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhotonRole {
    /// Refraction of photons; `None` leaves it to the light.
    pub refraction: Option<bool>,
    /// Reflection of photons; `None` leaves it to the light.
    pub reflection: Option<bool>,
    /// True if the surface stores no photons.
    pub collects_none: bool,
    /// True if the surface does not block photons that have not hit their target yet.
    pub passes_through: bool,
    /// The index of the target that the surface belongs to.
    pub target: Option<u32>,
}

impl PhotonRole {
    /// The role of an object with settings `own` inside an object of this role. The enclosing object overrides its
    /// parts, as in POV-Ray, which passes the settings down when the whole is complete.
    #[must_use]
    pub fn with(self, own: &ObjectPhotons) -> PhotonRole {
        PhotonRole {
            refraction: self.refraction.or(own.refraction),
            reflection: self.reflection.or(own.reflection),
            collects_none: self.collects_none || !own.collect,
            passes_through: self.passes_through || own.pass_through,
            target: self.target,
        }
    }

    /// True if the surface refracts photons of `light`: one of the two requests it and neither forbids it.
    #[must_use]
    pub fn refracts(&self, light: &PhotonSettings) -> bool {
        agree(self.refraction, light.refraction)
    }

    /// True if the surface reflects photons of `light`, by the same rule.
    #[must_use]
    pub fn reflects(&self, light: &PhotonSettings) -> bool {
        agree(self.reflection, light.reflection)
    }
}

fn agree(one: Option<bool>, other: Option<bool>) -> bool {
    [one, other].contains(&Some(true)) && ![one, other].contains(&Some(false))
}

impl ObjectPhotons {
    /// Parses the block after `photons` in an object.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.open()?;
        while !args.accept_close()? {
            if args.accept(Word::Target)? {
                let spacing = args.float_or(1.0)?;
                self.target = (spacing != 0.0).then_some(spacing);
                self.decide_passing(self.refraction == Some(true), args);
            } else if args.accept(Word::Refraction)? {
                self.refraction = Some(is_on_or_off(args)?);
                self.decide_passing(self.refraction == Some(true), args);
            } else if args.accept(Word::Reflection)? {
                self.reflection = Some(is_on_or_off(args)?);
            } else if args.accept(Word::Collect)? {
                self.collect = is_on(args)?;
            } else if args.accept(Word::PassThrough)? {
                self.pass_through = is_on(args)?;
                self.decide_passing(false, args);
            } else {
                return Err(args.expected(
                    "`target`, `refraction`, `reflection`, `collect`, `pass_through` or `}` in `photons`",
                ));
            }
        }
        Ok(())
    }

    /// Makes a target either refract photons or let them pass, in favour of the item that was just read
    /// (docs/povray-facts.md, 12.1).
    fn decide_passing(&mut self, refracts: bool, args: &mut dyn Args) {
        if self.target.is_none() || !self.pass_through || self.refraction == Some(false) {
            return;
        }
        let off = if refracts {
            self.pass_through = false;
            "pass_through"
        } else {
            self.refraction = Some(false);
            "refraction"
        };
        args.warn(Diagnostic::warning(
            args.last_span(),
            format!("a target either refracts photons or lets them pass: `{off}` is turned off"),
        ));
    }
}

/// Reads the value after `reflection` or `refraction`, which POV-Ray demands.
fn is_on_or_off(args: &mut dyn Args) -> Parse<bool> {
    let word = args.last_span();
    if !args.at_expression()? {
        args.refused_by_povray(word, "`on` or `off` must follow", "Write `on` after it.");
    }
    is_on(args)
}

fn is_on(args: &mut dyn Args) -> Parse<bool> {
    Ok(args.float_or(1.0)? != 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    #[test]
    fn object_photons_are_parsed() {
        let mut photons = ObjectPhotons::default();
        let text = "{ target 0.5 refraction on reflection off collect off pass_through }";
        photons.read(&mut TextArgs::new(text)).unwrap();
        assert_eq!(photons.target, Some(0.5));
        assert_eq!(
            (photons.refraction, photons.reflection),
            (Some(false), Some(false))
        );
        assert!(!photons.collect && photons.pass_through);
    }

    #[test]
    fn last_of_passing_and_refraction_counts_for_a_target() {
        let refracts = (false, Some(true));
        let passes = (true, Some(false));
        for (text, expected) in [
            ("{ target refraction on pass_through }", passes),
            ("{ target pass_through }", passes),
            ("{ target refraction on pass_through off }", refracts),
            ("{ target pass_through refraction on }", refracts),
            ("{ refraction on pass_through target }", refracts),
            ("{ pass_through target }", passes),
            ("{ refraction on pass_through }", (true, Some(true))),
        ] {
            let mut photons = ObjectPhotons::default();
            photons.read(&mut TextArgs::new(text)).unwrap();
            let result = (photons.pass_through, photons.refraction);
            assert_eq!(result, expected, "{text}");
        }
    }

    #[test]
    fn light_photons_are_parsed() {
        let mut photons = PhotonSettings::default();
        let text = "{ refraction on area_light }";
        photons.read(&mut TextArgs::new(text)).unwrap();
        assert_eq!((photons.refraction, photons.reflection), (Some(true), None));
        assert!(photons.from_area);
    }
}
