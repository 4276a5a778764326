//! What is wrong or doubtful in a scene, with its place, related places and remedies.

use super::Span;
use serde::Serialize;
use std::fmt;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The scene is drawn; something was assumed.
    Warning,
    /// The scene is not drawn.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        })
    }
}

/// Kinds of findings that programs tell apart: who is at fault, and what to fetch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Code {
    /// The scene asks for what this program cannot do yet; the scene is not at fault.
    NotBuilt,
    /// A name that nothing declares.
    Undeclared,
    /// An include file or another file that is not found.
    MissingFile,
    /// The scene itself says so, by `#error` or `#warning`.
    Author,
    /// The scene writes files, and this run lets scenes write none.
    WritesFiles,
    /// The scene needs more memory than there is.
    Memory,
    /// The scene needs more time, memory or depth than it may take.
    Limit,
}

/// A note on a related place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What it has to do with the matter: "this `{` is still open".
    pub text: String,
}

/// One finding about a scene. Messages start in lower case and end without a full stop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// What kind of finding it is, where programs may want to know.
    pub code: Option<Code>,
    /// What is wrong, in the words of the scene's author.
    pub message: String,
    /// Where; `None` for what has no place in a text (a missing file named on the command line).
    pub span: Option<Span>,
    /// Related places.
    pub labels: Vec<Label>,
    /// Things to do about it, without the word "hint". They are shown as sentences, with capital and full stop.
    pub hints: Vec<String>,
    /// Calls and includes on the way here, innermost first: "in the macro `Leg`, called here".
    pub trace: Vec<Label>,
}

impl Diagnostic {
    /// An error at a place.
    #[must_use]
    pub fn error(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Diagnostic::new(Severity::Error, span.into(), message.into())
    }

    /// A warning at a place.
    #[must_use]
    pub fn warning(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Diagnostic::new(Severity::Warning, span.into(), message.into())
    }

    fn new(severity: Severity, span: Option<Span>, message: String) -> Self {
        Diagnostic {
            severity,
            code: None,
            message,
            span,
            labels: Vec::new(),
            hints: Vec::new(),
            trace: Vec::new(),
        }
    }

    /// The same, told to be of a kind.
    #[must_use]
    pub fn with_code(mut self, code: Code) -> Self {
        self.code = Some(code);
        self
    }

    /// The same with a note on a related place.
    #[must_use]
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label {
            span,
            text: text.into(),
        });
        self
    }

    /// The same with something to do about it.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }
}

/// A hint as a sentence: with a capital and a full stop.
pub(super) fn sentence(hint: &str) -> String {
    let mut letters = hint.chars();
    let mut text: String = letters
        .next()
        .into_iter()
        .flat_map(char::to_uppercase)
        .collect();
    text.push_str(letters.as_str());
    if !text.ends_with(['.', '?', '!', ':']) {
        text.push('.');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::sentence;

    #[test]
    fn a_hint_becomes_a_sentence() {
        assert_eq!(sentence("remove the triangle"), "Remove the triangle.");
        assert_eq!(sentence("did you mean `box`?"), "Did you mean `box`?");
        assert_eq!(sentence("`a` is a word"), "`a` is a word.");
    }
}
