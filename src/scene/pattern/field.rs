//! `pattern { ... }`: a pattern with all that is written beside it, as a number for each point.

use super::{Modifiers, Pattern, PreparedPattern, Settings, SurfacePoint};
use crate::base::args::{Args, Parse, Word};
use crate::scene::function::Field;
use glam::DVec3;

/// Reads the pattern of a word, if it is that of one.
pub type ReadPattern = fn(Word, &mut dyn Args) -> Parse<Option<Box<dyn Pattern>>>;

/// Reads the block behind the word `pattern`, in which `named` reads the pattern.
///
/// # Errors
/// A malformed value, or a block that names no pattern.
pub fn read_field(
    args: &mut dyn Args,
    settings: &Settings,
    named: ReadPattern,
) -> Parse<PreparedPattern> {
    const WHAT: &str = "a pattern in `pattern`";
    args.open()?;
    let Some(word) = args.word()? else {
        return Err(args.expected(WHAT));
    };
    let Some(mut pattern) = named(word, args)? else {
        return Err(if super::is_pattern(word) {
            crate::base::args::not_built(args, word)
        } else {
            args.expected(WHAT)
        });
    };
    if pattern.has_open_block() {
        args.close()?;
    }
    let mut modifiers = Modifiers::default();
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Err(args.expected("a modifier of the pattern or `}`"));
        };
        if !pattern.read_modifier(word, args)? && !modifiers.read(word, args)? {
            return Err(args.expected("a modifier of the pattern or `}`"));
        }
    }
    Ok(modifiers.prepare(&*pattern, &[], settings))
}

impl Field for PreparedPattern {
    fn value(&self, point: DVec3) -> f64 {
        PreparedPattern::value(self, self.moved(point), &SurfacePoint::at(point))
    }
}
