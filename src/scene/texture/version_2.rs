//! Textures of scenes before version 3.0: the words of pigment, normal and finish stand directly in the texture, in any
//! order, and later ones change or replace earlier ones (POV-Ray 2.2 documentation, "Textures").
//!
//! Only the words of that version are supported. The colours inside the set of `mandel` are those of version 3.7.

use super::{Layer, Normal};
use crate::base::args::{Args, Parse, Word, interned};
use crate::base::source::Diagnostic;
use crate::base::word::Class;
use crate::scene::pattern::Shape;

/// The first version whose textures consist of blocks. POV-Ray rounds versions to hundredths before it compares them.
pub(super) const FIRST_WITH_BLOCKS: f64 = 2.995;

/// The words that change the pigment, besides colours.
const PIGMENT_WORDS: [Word; 22] = [
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

/// The words that begin a normal.
const NORMAL_WORDS: [Word; 6] = [
    Word::BumpMap,
    Word::Bumps,
    Word::Dents,
    Word::Ripples,
    Word::Waves,
    Word::Wrinkles,
];

/// True if the first word of a texture in this version begins a pigment or normal rather than a patterned texture.
pub(super) fn begins_part(word: Word, version: f64) -> bool {
    version < FIRST_WITH_BLOCKS && (PIGMENT_WORDS.contains(&word) || NORMAL_WORDS.contains(&word))
}

impl Layer {
    /// Reads a value that scenes before version 3.0 have directly in the texture; false if none is next.
    pub(super) fn read_old(&mut self, args: &mut dyn Args) -> Parse<bool> {
        if args.version() >= FIRST_WITH_BLOCKS {
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
            _ if NORMAL_WORDS.contains(&word) => {
                self.normal = Some(Normal::read_bare(args, self.normal.as_ref())?);
                Ok(true)
            }
            _ if PIGMENT_WORDS.contains(&word) || word.class() == Class::Color => {
                let is_read =
                    self.pigment.read_idle_colors(word, args)? || self.pigment.read_bare(args)?;
                if matches!(word, Word::Marble | Word::Wood) {
                    // Since version 3.0 their default is a triangle wave.
                    self.pigment.modifiers.get_mut().set_shape(Shape::Ramp);
                }
                Ok(is_read)
            }
            _ => {
                let mut finish = self.finish.as_ref().clone();
                if !finish.read_bare(word, args)? {
                    return self.read_grain(args);
                }
                self.finish = interned(args, finish);
                Ok(true)
            }
        }
    }

    /// Reads a number alone as `crand`.
    fn read_grain(&mut self, args: &mut dyn Args) -> Parse<bool> {
        if !args.at_expression()? {
            return Ok(false);
        }
        let at = args.span();
        let mut finish = self.finish.as_ref().clone();
        finish.crand = args.single()?;
        self.finish = interned(args, finish);
        let warning = Diagnostic::warning(
            at.to(args.last_span()),
            "a number alone in a texture is taken for `crand`",
        );
        args.warn(warning.with_hint("Write `crand` before it."));
        Ok(true)
    }
}
