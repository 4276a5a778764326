//! Scene texts, places in them, and what is said about them.

mod data;
mod diagnostic;
mod files;
pub mod print;
mod span;
mod text;

pub use diagnostic::{Diagnostic, Label, Severity};
pub use files::{MAX_FILE_BYTES, Sources};
pub use span::{FileId, Span};
