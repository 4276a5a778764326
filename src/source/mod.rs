//! Scene texts, places in them, and what is said about them.

mod data;
mod dependency;
mod diagnostic;
mod files;
mod fingerprint;
mod message;
pub mod print;
mod search;
mod span;
#[cfg(test)]
mod tests;
mod text;

pub use dependency::Dependency;
pub use diagnostic::{Code, Diagnostic, Label, Severity};
pub use files::{Declared, MAX_FILE_BYTES, Sources};
pub use message::{Message, Note, Point, Stretch};
pub use span::{FileId, Span};
