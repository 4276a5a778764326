//! Errors that end a batch or prevent a picture of it from being stored.

use std::fmt;
use std::io;
use std::path::Path;

/// An error message, and a hint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BatchError {
    message: String,
    hint: Option<String>,
}

impl BatchError {
    pub(super) fn new(message: impl Into<String>) -> Self {
        BatchError {
            message: message.into(),
            hint: None,
        }
    }

    pub(super) fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// An I/O error on a file or folder.
    pub(super) fn of_file(doing: &str, path: &Path, error: &io::Error) -> Self {
        let refused = BatchError::new(format!("cannot {doing} `{}`: {error}", path.display()));
        match error.kind() {
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => refused
                .with_hint("It is not open to you for writing: name another folder with `-o`."),
            io::ErrorKind::StorageFull
            | io::ErrorKind::QuotaExceeded
            | io::ErrorKind::FileTooLarge => {
                refused.with_hint("Make room and run it again: what is there is not drawn again.")
            }
            io::ErrorKind::CrossesDevices => {
                refused.with_hint("All folders below that of `-o` must be on one disk.")
            }
            _ => refused,
        }
    }

    /// The message without the hint.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "\n  hint: {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for BatchError {}
