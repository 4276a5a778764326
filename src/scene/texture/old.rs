//! Textures as scenes write them before version 3.0: the words of pigment, normal and finish stand in the texture itself,
//! in any order, and later ones change or replace what earlier ones have said (POV-Ray 2.2 documentation, "Textures").
//!
//! Only the words of that time are known here; `mandel` has the colours of today inside its set.

use super::{Layer, Normal};
use crate::base::args::{Args, Parse, Word, alike};
use crate::base::source::Diagnostic;
use crate::base::word::Class;
use crate::scene::pattern::Shape;

/// From this version on textures consist of blocks. POV-Ray rounds versions to hundredths before it compares them.
const FIRST_OF_BLOCKS: f64 = 2.995;

/// What changes the pigment, besides colours.
const OF_PIGMENT: [Word; 22] = [
    Word::Agate,
    Word::Bozo,
    Word::Checker,
    Word::Gradient,
    Word::Granite,
    Word::Hexagon,
    Word::Leopard,
    Word::Mandel,
    Word::Marble,
    Word::Onion,
    Word::Spotted,
    Word::Square,
    Word::Wood,
    Word::ImageMap,
    Word::ColorMap,
    Word::ColourMap,
    Word::QuickColor,
    Word::QuickColour,
    Word::Turbulence,
    Word::Octaves,
    Word::Omega,
    Word::Lambda,
];

/// What begins a normal.
const OF_NORMAL: [Word; 6] = [
    Word::BumpMap,
    Word::Bumps,
    Word::Dents,
    Word::Ripples,
    Word::Waves,
    Word::Wrinkles,
];

/// Tells whether a word that stands first in a texture of this version begins a part of it, and no choice of textures.
pub(super) fn begins_part(word: Word, version: f64) -> bool {
    version < FIRST_OF_BLOCKS && (OF_PIGMENT.contains(&word) || OF_NORMAL.contains(&word))
}

impl Layer {
    /// Reads what may stand in the texture itself before version 3.0, if that is next.
    pub(super) fn read_old(&mut self, args: &mut dyn Args) -> Parse<bool> {
        if args.version() >= FIRST_OF_BLOCKS {
            return Ok(false);
        }
        let Some(word) = args.word()? else {
            return Ok(self.pigment.read_own_color(args)? || self.read_grain(args)?);
        };
        match word {
            Word::Frequency | Word::Phase => match &mut self.normal {
                Some(normal) => Normal::read_modifier(normal, word, args),
                None => Err(args.expected("`waves` or another normal before its modifiers")),
            },
            _ if OF_NORMAL.contains(&word) => {
                self.normal = Some(Normal::read_bare(args, self.normal.as_ref())?);
                Ok(true)
            }
            _ if OF_PIGMENT.contains(&word) || word.class() == Class::Color => {
                let is_read = self.pigment.read_bare(args)?;
                if matches!(word, Word::Marble | Word::Wood) {
                    // Today they run up and down.
                    self.pigment.modifiers.get_mut().set_shape(Shape::Ramp);
                }
                Ok(is_read)
            }
            _ => {
                let mut finish = self.finish.as_ref().clone();
                if !finish.read_bare(word, args)? {
                    return self.read_grain(args);
                }
                self.finish = alike(args, finish);
                Ok(true)
            }
        }
    }

    /// A number alone, which is that of `crand`.
    fn read_grain(&mut self, args: &mut dyn Args) -> Parse<bool> {
        if !args.at_expression()? {
            return Ok(false);
        }
        let at = args.span();
        let mut finish = self.finish.as_ref().clone();
        finish.crand = args.single()?;
        self.finish = alike(args, finish);
        let warning = Diagnostic::warning(
            at.to(args.last_span()),
            "a number alone in a texture is taken for `crand`",
        );
        args.warn(warning.with_hint("Write `crand` before it."));
        Ok(true)
    }
}
