//! `photons` in lights and objects. Without `photons` in `global_settings` they change no picture.

use crate::base::args::{Args, Parse, Word};

/// What a light does with photons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Photons {
    /// Whether it sends photons to be refracted; `None` leaves it to the objects.
    pub refraction: Option<bool>,
    /// Whether it sends photons to be reflected; `None` leaves it to the objects.
    pub reflection: Option<bool>,
    /// Whether photons come from all lamps of an area light.
    pub from_area: bool,
}

/// What an object does with photons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectPhotons {
    /// The factor on the spacing of photons that are sent to it; `None` where none are.
    pub target: Option<f64>,
    /// Whether it refracts them.
    pub refraction: Option<bool>,
    /// Whether it reflects them.
    pub reflection: Option<bool>,
    /// Whether photons come to rest on it.
    pub collect: bool,
    /// Whether photons pass it that are on their way to a target.
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

impl Photons {
    /// The block behind `photons` in a light.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.open()?;
        while !args.accept_close()? {
            if args.accept(Word::Refraction)? {
                self.refraction = Some(is_on(args)?);
            } else if args.accept(Word::Reflection)? {
                self.reflection = Some(is_on(args)?);
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

/// What a surface does with photons: what its object says, and what that inherits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhotonRole {
    /// Whether it refracts them.
    pub refraction: Option<bool>,
    /// Whether it reflects them.
    pub reflection: Option<bool>,
    /// Whether none come to rest on it.
    pub keeps_none: bool,
    /// Whether photons pass it that are on their way to a target.
    pub is_passed: bool,
    /// The number of the target that it is part of.
    pub target: Option<u32>,
}

impl PhotonRole {
    /// That of an object in what has this one. What holds an object overrules it, as in POV-Ray, which tells the parts when
    /// the whole is complete.
    #[must_use]
    pub fn with(self, own: &ObjectPhotons) -> PhotonRole {
        PhotonRole {
            refraction: self.refraction.or(own.refraction),
            reflection: self.reflection.or(own.reflection),
            keeps_none: self.keeps_none || !own.collect,
            is_passed: self.is_passed || own.is_passed(),
            target: self.target,
        }
    }

    /// Whether it refracts the photons of a light: one of the two asks for it and neither forbids it.
    #[must_use]
    pub fn refracts(&self, light: &Photons) -> bool {
        agree(self.refraction, light.refraction)
    }

    /// Whether it reflects them.
    #[must_use]
    pub fn reflects(&self, light: &Photons) -> bool {
        agree(self.reflection, light.reflection)
    }
}

fn agree(one: Option<bool>, other: Option<bool>) -> bool {
    [one, other].contains(&Some(true)) && ![one, other].contains(&Some(false))
}

impl ObjectPhotons {
    /// Whether photons pass it. A target that refracts them takes them in spite of `pass_through`.
    fn is_passed(&self) -> bool {
        self.pass_through && !(self.target.is_some() && self.refraction == Some(true))
    }

    /// The block behind `photons` in an object.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.open()?;
        while !args.accept_close()? {
            if args.accept(Word::Target)? {
                let spacing = args.float_or(1.0)?;
                self.target = (spacing != 0.0).then_some(spacing);
            } else if args.accept(Word::Refraction)? {
                self.refraction = Some(is_on(args)?);
            } else if args.accept(Word::Reflection)? {
                self.reflection = Some(is_on(args)?);
            } else if args.accept(Word::Collect)? {
                self.collect = is_on(args)?;
            } else if args.accept(Word::PassThrough)? {
                self.pass_through = is_on(args)?;
            } else {
                return Err(args.expected(
                    "`target`, `refraction`, `reflection`, `collect`, `pass_through` or `}` in `photons`",
                ));
            }
        }
        Ok(())
    }
}

fn is_on(args: &mut dyn Args) -> Parse<bool> {
    Ok(args.float_or(1.0)? != 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    #[test]
    fn an_object_says_what_it_does_with_photons() {
        let mut photons = ObjectPhotons::default();
        let text = "{ target 0.5 refraction on reflection off collect off pass_through }";
        photons.read(&mut TextArgs::new(text)).unwrap();
        assert_eq!(photons.target, Some(0.5));
        assert_eq!(
            (photons.refraction, photons.reflection),
            (Some(true), Some(false))
        );
        assert!(!photons.collect && photons.pass_through);
    }

    #[test]
    fn a_light_says_which_photons_it_sends() {
        let mut photons = Photons::default();
        let text = "{ refraction on area_light }";
        photons.read(&mut TextArgs::new(text)).unwrap();
        assert_eq!((photons.refraction, photons.reflection), (Some(true), None));
        assert!(photons.from_area);
    }
}
