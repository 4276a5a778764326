//! `irid` and `subsurface`: thin-film interference and subsurface scattering.

use super::numbers::{number, single};
use crate::base::args::{Args, Parse, Word};
use crate::base::color::Rgb;
use crate::base::source::Span;

/// `irid`: thin-film interference. All light from the surface is multiplied by its colours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irid {
    /// The strength of the effect; none for 0 or less.
    pub amount: f32,
    /// The thickness of the film, in the units of `irid_wavelength`.
    pub thickness: f32,
    /// The variation of the thickness.
    pub turbulence: f32,
}

/// `subsurface`: light that scatters below the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Subsurface {
    /// The distance that light travels in each colour channel.
    pub translucency: Rgb,
    /// The location in the scene file, for messages.
    pub at: Span,
}

impl Irid {
    /// Reads `irid { AMOUNT ... }`.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Irid> {
        args.accept(Word::Irid)?;
        args.open()?;
        let mut irid = Irid {
            amount: single(args.float()?),
            ..Irid::default()
        };
        while !args.accept_close()? {
            match args.word()? {
                Some(word @ Word::Thickness) => irid.thickness = number(word, args)?,
                Some(word @ Word::Turbulence) => irid.turbulence = number(word, args)?,
                _ => return Err(args.expected("`thickness`, `turbulence` or `}` in `irid`")),
            }
        }
        Ok(irid)
    }
}

impl Subsurface {
    /// Reads `subsurface { translucency COLOUR }`.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Subsurface> {
        let at = args.span();
        args.accept(Word::Subsurface)?;
        args.open()?;
        let mut subsurface = Subsurface {
            translucency: Rgb::BLACK,
            at,
        };
        while !args.accept_close()? {
            if !args.accept(Word::Translucency)? {
                return Err(args.expected("`translucency` or `}` in `subsurface`"));
            }
            subsurface.translucency = args.color()?.rgb;
        }
        Ok(subsurface)
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
    fn a_thin_film_has_an_amount_first() {
        let irid = read("{ irid { 0.25 thickness 0.5 turbulence 2 } }").irid;
        assert_eq!(
            (irid.amount, irid.thickness, irid.turbulence),
            (0.25, 0.5, 2.0)
        );
        assert_eq!(read("{ irid { 0.25 } }").irid.thickness, 0.0);
    }

    #[test]
    fn subsurface_is_stored_in_the_finish() {
        let finish = read("{ subsurface { translucency 0.5 } crand 0.1 }");
        let translucency = finish.subsurface.map(|subsurface| subsurface.translucency);
        assert_eq!((translucency, finish.crand), (Some(Rgb::splat(0.5)), 0.1));
    }
}
