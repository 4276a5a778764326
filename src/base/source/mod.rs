//! Scene texts, spans in them, and diagnostics.

mod change;
mod data;
mod dependency;
mod diagnostic;
mod files;
mod fingerprint;
mod held_file;
mod message;
pub mod print;
mod record;
mod refusal;
mod search;
mod span;
#[cfg(test)]
mod tests;
mod text;
mod written_files;

pub use change::TextChange;
pub use dependency::Dependency;
pub use diagnostic::{Code, Diagnostic, Fix, Label, Severity};
pub use files::{Declared, Sources};
pub(crate) use held_file::HeldFile;
pub use message::{Location, Message, Note, Position};
pub(crate) use refusal::refusal;
#[cfg(feature = "cli")]
pub(crate) use search::allows_lint;
pub use span::{FileId, Span};
