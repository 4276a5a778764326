//! The tokens of whole texts, cached beyond the reading that made them.

use super::token::{Directive, Token, Tokens};
use crate::base::source::FileId;
use std::ops::Range;
use std::sync::Arc;

/// The tokens of a whole text in a form that threads can share. Their symbols are of the [`super::Names`] they were
/// made with.
#[derive(Clone, Debug)]
pub struct Whole {
    file: FileId,
    tokens: Vec<Token>,
    numbers: Vec<f64>,
    directives: Vec<Directive>,
    text: Arc<String>,
    strings: Vec<Range<u32>>,
    segments: Vec<Range<u32>>,
}

impl Whole {
    /// A copy of tokens; `None` for those of a piece of a data segment.
    #[must_use]
    pub fn of(tokens: &Tokens) -> Option<Self> {
        (!tokens.is_part()).then(|| Whole {
            file: tokens.file,
            tokens: tokens.tokens.clone(),
            numbers: tokens.numbers.clone(),
            directives: tokens.directives.clone(),
            text: Arc::clone(&tokens.text),
            strings: tokens.strings.clone(),
            segments: tokens.segments.clone(),
        })
    }

    /// The tokens for another reading.
    #[must_use]
    pub fn tokens(&self) -> Tokens {
        Tokens {
            file: self.file,
            tokens: self.tokens.clone(),
            numbers: self.numbers.clone(),
            directives: self.directives.clone(),
            text: Arc::clone(&self.text),
            strings: self.strings.clone(),
            segments: self.segments.clone(),
            part: None,
        }
    }
}
