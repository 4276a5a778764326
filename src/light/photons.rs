//! `photons` in lights and objects, kept as data: without `photons` in `global_settings` they change no picture, and
//! with them a scene in which some would be shot is refused.

use crate::args::{Args, Parse, Word};

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
    /// Whether photons that only cross it count as never having met anything.
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

impl ObjectPhotons {
    /// Whether a light sends photons to the object, if that is a target: one of the two asks for it and neither forbids it.
    #[must_use]
    pub fn is_sent_to(&self, light: &Photons) -> bool {
        let asks = |one: Option<bool>, other: Option<bool>| {
            [one, other].contains(&Some(true)) && ![one, other].contains(&Some(false))
        };
        asks(self.refraction, light.refraction) || asks(self.reflection, light.reflection)
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
    use crate::args::text::TextArgs;

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
