//! Scene texts, places in them, and what is said about them.

mod diagnostic;
mod files;
mod message;
pub mod print;
mod span;
mod text;

pub use diagnostic::{Code, Diagnostic, Label, Severity};
pub use files::{Declared, MAX_FILE_BYTES, Sources};
pub use message::{Message, Note, Point, Stretch};
pub use span::{FileId, Span};
