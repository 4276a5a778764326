//! The parts of combinations that were read last, by how they are written: programs that write scenes write the same part
//! again and again, and what is written alike is read once and shared.

use crate::scene::Object;
use std::sync::Arc;

/// So many parts are known.
const MOST: usize = 8;

/// Parts that were read a little while ago.
#[derive(Debug, Default)]
pub(crate) struct Parts<'a> {
    known: Vec<Part<'a>>,
    /// The oldest, which gives way next.
    oldest: usize,
}

/// A part of a combination.
#[derive(Clone, Debug)]
pub(crate) struct Part<'a> {
    /// How it is written.
    pub(crate) text: &'a str,
    pub(crate) object: Arc<Object>,
    /// How many objects there are in it, itself not counted.
    pub(crate) parts: u32,
}

impl<'a> Parts<'a> {
    /// The part that stands at the beginning of a text, if it is known.
    pub(crate) fn find(&self, text: &str) -> Option<Part<'a>> {
        let known = self.known.iter();
        known
            .rev()
            .find(|part| text.starts_with(part.text))
            .cloned()
    }

    /// Takes note of a part.
    pub(crate) fn note(&mut self, part: Part<'a>) {
        if self.known.len() < MOST {
            self.known.push(part);
        } else {
            self.known[self.oldest] = part;
            self.oldest = (self.oldest + 1) % MOST;
        }
    }
}
