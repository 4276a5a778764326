//! From text to flat tokens by the pest grammar of `grammar/`, and the table of reserved words made from the same
//! folder.
//!
//! Tokens are flat because directives and macros act on tokens: `#if (A) merge { #else union { #end` occurs in the
//! standard includes. [`tokenize`] links the directives of each group, so that a branch can be skipped in one step;
//! everything else is up to the language.

mod data_segment;
mod faults;
mod groups;
mod lexer;
mod names;
mod scan;
pub(crate) mod split_points;
mod token;
mod whole;

#[cfg(test)]
mod tests;

pub use crate::base::word::{Class, Word};
pub use data_segment::{after_more, more_from, tokenize_more};
pub use lexer::{tokenize, tokenize_around_data};
pub use names::{Names, Qualified, Symbol};
pub use scan::number;
pub(crate) use scan::word_end;
pub use token::{Directive, END_OF_FILE, Kind, Token, Tokens, span_at};
pub use whole::Whole;
