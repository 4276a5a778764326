//! The patterns: one file each, with its mathematics and what it reads.
//!
//! A pattern gives a value at a point of pattern space; what the value selects (an entry of a colour list) is the
//! business of its owner. Built are the patterns with a list of entries. Continuous patterns and their maps,
//! waves and warps are missing.

mod brick;
mod checker;
mod hexagon;

use crate::args::{Args, Parse, Word};
use crate::color::Color;
use crate::syntax::Class;
use glam::DVec3;
use std::fmt::Debug;

/// What POV-Ray adds to coordinates, so that a face that lies in a cell boundary does not show rounding noise.
const NUDGE: f64 = 1e-10;

/// Makes a pattern with its default parameters.
type New = fn() -> Box<dyn Pattern>;

/// The patterns by their words.
static PATTERNS: &[(Word, New)] = &[
    (Word::Brick, brick::new),
    (Word::Checker, checker::new),
    (Word::Hexagon, hexagon::new),
];

/// What every pattern can do.
pub trait Pattern: Debug + Send + Sync {
    /// The value at a point of pattern space: for a pattern with a list, the index of an entry.
    fn value(&self, point: DVec3) -> f64;

    /// The colours of the entries that the scene does not give; their number is the length of the list.
    fn default_colors(&self) -> &'static [Color];

    /// Takes and reads `word` and its value if the pattern has such a parameter, and says whether it has.
    ///
    /// # Errors
    /// A malformed value.
    fn read_modifier(&mut self, _word: Word, _args: &mut dyn Args) -> Parse<bool> {
        Ok(false)
    }

    /// A copy that can be modified by itself.
    fn boxed_clone(&self) -> Box<dyn Pattern>;
}

impl Clone for Box<dyn Pattern> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

/// The pattern of this word with its default parameters, if it is built.
#[must_use]
pub fn named(word: Word) -> Option<Box<dyn Pattern>> {
    let entry = PATTERNS.iter().find(|entry| entry.0 == word);
    entry.map(|entry| entry.1())
}

/// Whether the language has a pattern of this word, built or not.
#[must_use]
pub fn is_pattern(word: Word) -> bool {
    // These words have a second meaning, under which the grammar lists them.
    const ELSEWHERE: [Word; 4] = [Word::Cubic, Word::Function, Word::Object, Word::Spherical];
    let is_parameter = matches!(word, Word::BumpMap | Word::Pattern | Word::Solid);
    ELSEWHERE.contains(&word) || (word.class() == Class::Pattern && !is_parameter)
}

/// The part of `x` above the next lower integer, in `[0, 1)`.
fn fraction(x: f64) -> f64 {
    x - x.floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_the_list_are_patterns() {
        for (word, _) in PATTERNS {
            assert!(is_pattern(*word), "{word}");
        }
        assert!(is_pattern(Word::Bozo) && is_pattern(Word::Spherical));
        assert!(!is_pattern(Word::Solid) && !is_pattern(Word::Phong));
    }
}
