//! Errors in a command line or an ini file, with hints.

use std::fmt;
use std::path::Path;

use crate::app::batch::BatchError;
use crate::output::OutputError;

/// An error: message, position, and hint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CliError {
    message: String,
    position: Option<String>,
    hint: Option<String>,
    /// Where POV-Ray would have stopped.
    pub(crate) stage: Stage,
}

/// The stages at which POV-Ray stops, each with its own messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Before it begins.
    Options,
    /// Before it begins, for want of a scene's name.
    NoScene,
    /// It finds no scene.
    Scene,
    /// It cannot write.
    Output,
}

impl CliError {
    /// An error in lower case, without a full stop.
    #[must_use]
    pub fn new(message: impl Into<String>) -> Self {
        CliError {
            message: message.into(),
            position: None,
            hint: None,
            stage: Stage::Options,
        }
    }

    /// The error with a hint.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The error at another stage.
    #[must_use]
    pub(crate) fn at_stage(mut self, stage: Stage) -> Self {
        self.stage = stage;
        self
    }

    /// The error with a position in an ini file, unless a nested file has set one already.
    #[must_use]
    pub(crate) fn in_file(mut self, file: &Path, line: usize) -> Self {
        self.position
            .get_or_insert_with(|| format!("`{}` line {line}: ", file.display()));
        self
    }
}

impl From<OutputError> for CliError {
    fn from(error: OutputError) -> Self {
        CliError {
            message: error.to_string(),
            position: None,
            hint: error.hint(),
            stage: Stage::Output,
        }
    }
}

impl From<BatchError> for CliError {
    fn from(error: BatchError) -> Self {
        CliError::new(error.to_string())
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let position = self.position.as_deref().unwrap_or_default();
        write!(f, "{position}{}", self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "\n  hint: {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for CliError {}
