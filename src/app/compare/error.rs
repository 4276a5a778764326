//! Errors of comparisons.

use super::renderer::tail;
use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The error message for a keyword that this program does not render yet.
pub(crate) const MISSING: &str = " is not supported yet";

/// Errors that prevent a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CheckError {
    /// The program did not start: its name, and the reason.
    NotStarted(String, String),
    /// The program ran for longer than this.
    OutOfTime(String, Duration),
    /// The program ended with an error.
    Refused {
        /// The program.
        program: String,
        /// Its exit status.
        status: String,
        /// Its complete output.
        stderr: String,
    },
    /// The program ended without a picture: its name, and its last output.
    NoPicture(String, String),
    /// A file cannot be read or written: its path, and the reason.
    File(PathBuf, String),
}

impl CheckError {
    pub(crate) fn file(path: &Path, error: &dyn fmt::Display) -> CheckError {
        CheckError::File(path.to_owned(), error.to_string())
    }

    /// The keywords that this program cannot render yet, if they were the only errors.
    #[must_use]
    pub fn missing(&self) -> Vec<String> {
        let CheckError::Refused { stderr, .. } = self else {
            return Vec::new();
        };
        let errors = stderr.lines().filter_map(|line| {
            let (_, message) = line.split_once("Parse Error: ")?;
            Some(message.trim_end_matches('.'))
        });
        let mut words = Vec::new();
        for message in errors {
            match message.strip_suffix(MISSING) {
                Some(word) => words.push(word.replace('`', "")),
                None => return Vec::new(),
            }
        }
        words.sort();
        words.dedup();
        words
    }

    /// The error in one line.
    #[must_use]
    pub fn line(&self) -> String {
        match self {
            CheckError::Refused {
                program, stderr, ..
            } => {
                let error = stderr.lines().find(|line| line.contains("Error: "));
                let line = error.or_else(|| stderr.lines().rfind(|line| !line.trim().is_empty()));
                format!(
                    "{program}: {}",
                    line.unwrap_or("an error without words").trim()
                )
            }
            other => other
                .to_string()
                .lines()
                .next()
                .unwrap_or_default()
                .to_owned(),
        }
    }
}

impl fmt::Display for CheckError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CheckError::NotStarted(program, why) => write!(f, "{program} does not start: {why}"),
            CheckError::OutOfTime(program, limit) => {
                write!(f, "{program} ran for more than {limit:?}")
            }
            CheckError::Refused {
                program,
                status,
                stderr,
            } => write!(f, "{program} ended with {status}:\n{}", tail(stderr)),
            CheckError::NoPicture(program, stderr) => {
                write!(f, "{program} drew no picture:\n{stderr}")
            }
            CheckError::File(path, why) => write!(f, "`{}`: {why}", path.display()),
        }
    }
}

impl std::error::Error for CheckError {}
