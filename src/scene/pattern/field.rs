//! `pattern { ... }` in functions: a pattern with its modifiers as a scalar field.

use super::{Modifiers, Pattern, PreparedPattern, Settings, SurfacePoint};
use crate::base::args::{Args, Parse, Word};
use crate::scene::function::Field;
use glam::DVec3;

/// Reads the pattern of a keyword; `None` if the keyword names no implemented pattern.
pub type ReadPattern = fn(Word, &mut dyn Args) -> Parse<Option<Box<dyn Pattern>>>;

/// Reads the block after the keyword `pattern`; `named` reads the pattern itself.
///
/// # Errors
/// A malformed value, or a block that names no pattern.
pub fn read_field(
    args: &mut dyn Args,
    settings: &Settings,
    named: ReadPattern,
) -> Parse<PreparedPattern> {
    const EXPECTED: &str = "a pattern in `pattern`";
    args.open()?;
    let Some(word) = args.word()? else {
        return Err(args.expected(EXPECTED));
    };
    let Some(mut pattern) = named(word, args)? else {
        return Err(if super::is_pattern(word) {
            crate::base::args::not_built(args, word)
        } else {
            args.expected(EXPECTED)
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
    pattern.check(args)?;
    Ok(modifiers.prepare(&*pattern, &[], settings))
}

impl Field for PreparedPattern {
    fn value(&self, point: DVec3) -> f64 {
        PreparedPattern::value(self, self.to_pattern_space(point), &SurfacePoint::at(point))
    }
}
