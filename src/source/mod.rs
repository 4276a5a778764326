//! Scene texts, places in them, and what is said about them.

mod diagnostic;
mod span;

pub use diagnostic::{Diagnostic, Label, Severity};
pub use span::{FileId, Span};
