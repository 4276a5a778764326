//! Scene texts, places in them, and what is said about them.

mod diagnostic;
mod files;
pub mod print;
mod search;
mod span;
#[cfg(test)]
mod tests;
mod text;

pub use diagnostic::{Diagnostic, Label, Severity};
pub use files::{Dependency, MAX_FILE_BYTES, Sources};
pub use span::{FileId, Span};
