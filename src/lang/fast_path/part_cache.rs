//! A cache of the last parts of CSG objects by their text: generated scenes repeat the same part, which is then parsed
//! once and shared.

use crate::scene::Object;
use std::sync::Arc;

/// Capacity of the cache.
const CAPACITY: usize = 8;

/// The cache.
#[derive(Debug, Default)]
pub(crate) struct Parts<'a> {
    known: Vec<Part<'a>>,
    /// The oldest entry, which is replaced next.
    oldest: usize,
}

/// A part of a CSG object.
#[derive(Clone, Debug)]
pub(crate) struct Part<'a> {
    /// Its text.
    pub(crate) text: &'a str,
    pub(crate) object: Arc<Object>,
    /// Number of objects in it, itself not counted.
    pub(crate) parts: u32,
}

impl<'a> Parts<'a> {
    /// The part at the beginning of a text, if it is cached.
    pub(crate) fn find(&self, text: &str) -> Option<Part<'a>> {
        let known = self.known.iter();
        known
            .rev()
            .find(|part| text.starts_with(part.text))
            .cloned()
    }

    /// Adds a part.
    pub(crate) fn note(&mut self, part: Part<'a>) {
        if self.known.len() < CAPACITY {
            self.known.push(part);
        } else {
            self.known[self.oldest] = part;
            self.oldest = (self.oldest + 1) % CAPACITY;
        }
    }
}
