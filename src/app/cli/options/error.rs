//! What is wrong with a command line or an ini file, and what to do about it.

use std::fmt;
use std::path::Path;

/// A refusal: what is wrong, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CliError {
    message: String,
    place: Option<String>,
    hint: Option<String>,
}

impl CliError {
    /// A refusal in lower case, without a full stop.
    #[must_use]
    pub fn new(message: impl Into<String>) -> Self {
        CliError {
            message: message.into(),
            place: None,
            hint: None,
        }
    }

    /// The same with something to do about it.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same in a line of an ini file, unless a file inside it has claimed it already.
    #[must_use]
    pub(crate) fn in_file(mut self, file: &Path, line: usize) -> Self {
        self.place
            .get_or_insert_with(|| format!("`{}` line {line}: ", file.display()));
        self
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.place.as_deref().unwrap_or_default();
        write!(f, "{place}{}", self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "\n  hint: {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for CliError {}
