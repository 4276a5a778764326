//! Errors and warnings about a scene, with spans, related spans and hints.

use super::Span;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The scene is rendered, on an assumption.
    Warning,
    /// The scene is not rendered.
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

/// Categories of diagnostics that programs distinguish.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Code {
    /// The scene uses a feature that is not supported yet; the scene is not at fault.
    NotBuilt,
    /// An undeclared name.
    Undeclared,
    /// A missing include file or other file.
    MissingFile,
    /// The scene's own `#error` or `#warning`.
    Author,
    /// The scene writes files, which this run does not allow.
    WritesFiles,
    /// The scene needs more memory than is available.
    Memory,
    /// The scene exceeds a limit on time, memory or depth.
    Limit,
    /// Lint: the scene has no objects.
    NoObjects,
    /// Lint: the scene has no camera.
    NoCamera,
    /// Lint: the scene has no light, and nothing glows.
    NoLight,
    /// Lint: an object without a pigment is black.
    NoPigment,
    /// Lint: a colour counts from 0 to 255.
    ByteColor,
    /// Lint: a declared texture, or a part of one, is not used.
    UnusedTexture,
    /// Lint: a macro is not used.
    UnusedMacro,
    /// Lint: the camera sees no object.
    NothingInView,
    /// Lint: the camera is inside an object and sees nothing else.
    CameraInside,
    /// Lint: one object hides all others.
    HidesEverything,
    /// Lint: surfaces of two objects coincide where both are seen.
    CoincidentSurfaces,
    /// Lint: a light is inside an opaque object.
    LightInside,
    /// Lint: the whole picture has one colour.
    OneColor,
    /// Lint: POV-Ray 3.7 refuses what povr reads.
    RefusedByPovray,
}

impl Code {
    /// The lints, with the names that switch them off.
    pub const LINTS: [(Code, &'static str); 14] = [
        (Code::NoObjects, "no-objects"),
        (Code::NoCamera, "no-camera"),
        (Code::NoLight, "no-light"),
        (Code::NoPigment, "no-pigment"),
        (Code::ByteColor, "byte-color"),
        (Code::UnusedTexture, "unused-texture"),
        (Code::UnusedMacro, "unused-macro"),
        (Code::NothingInView, "nothing-in-view"),
        (Code::CameraInside, "camera-inside"),
        (Code::HidesEverything, "hides-everything"),
        (Code::CoincidentSurfaces, "coincident-surfaces"),
        (Code::LightInside, "light-inside"),
        (Code::OneColor, "one-color"),
        (Code::RefusedByPovray, "refused-by-povray"),
    ];

    /// The name of a lint; `None` for other codes.
    #[must_use]
    pub fn lint_name(self) -> Option<&'static str> {
        let lint = Code::LINTS.iter().find(|(code, _)| *code == self);
        lint.map(|(_, name)| *name)
    }
}

/// A note on a related span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The related span.
    pub span: Span,
    /// Its relation to the diagnostic: "this `{` is still open".
    pub text: String,
}

/// A change to a text that certainly mends it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The text to replace; empty to insert before its start.
    pub span: Span,
    /// The replacement.
    pub text: String,
}

/// An error or warning about a scene. Messages start in lower case and end without a full stop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity of the diagnostic.
    pub severity: Severity,
    /// Category for programs, where there is one.
    pub code: Option<Code>,
    /// The message, in the terms of the scene's author.
    pub message: String,
    /// The span; `None` if there is none in a text (a missing file named on the command line).
    pub span: Option<Span>,
    /// Notes on related spans.
    pub labels: Vec<Label>,
    /// Remedies, without the word "hint". They are shown as sentences, with a capital and a full stop.
    pub hints: Vec<String>,
    /// The change that the last hint describes, where it is certain.
    pub fix: Option<Box<Fix>>,
    /// The calls and includes that led here, innermost first: "in the macro `Leg`, called here".
    pub trace: Vec<Label>,
}

impl Diagnostic {
    /// An error at a span.
    #[must_use]
    pub fn error(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Diagnostic::new(Severity::Error, span.into(), message.into())
    }

    /// A warning at a span.
    #[must_use]
    pub fn warning(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Diagnostic::new(Severity::Warning, span.into(), message.into())
    }

    /// A warning of text that povr reads and POV-Ray 3.7 refuses; `reason` is its objection. The remedy is a text that both
    /// read. [`Args::refused_by_povray`] records it.
    ///
    /// [`Args::refused_by_povray`]: crate::base::args::Args::refused_by_povray
    #[must_use]
    pub(crate) fn refused_by_povray(span: Span, reason: &str, remedy: impl Into<String>) -> Self {
        Diagnostic::warning(span, format!("POV-Ray 3.7 refuses this: {reason}"))
            .with_code(Code::RefusedByPovray)
            .with_hint(remedy)
    }

    fn new(severity: Severity, span: Option<Span>, message: String) -> Self {
        Diagnostic {
            severity,
            code: None,
            message,
            span,
            labels: Vec::new(),
            hints: Vec::new(),
            fix: None,
            trace: Vec::new(),
        }
    }

    /// Sets the category.
    #[must_use]
    pub fn with_code(mut self, code: Code) -> Self {
        self.code = Some(code);
        self
    }

    /// Adds a note on a related span.
    #[must_use]
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label {
            span,
            text: text.into(),
        });
        self
    }

    /// Adds a remedy.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// Adds a remedy and the change that it describes.
    #[must_use]
    pub fn with_fix(mut self, hint: impl Into<String>, fix: Fix) -> Self {
        self.fix = Some(Box::new(fix));
        self.with_hint(hint)
    }
}

/// ` [name]` for a lint, the name that switches it off; nothing for other codes.
pub(super) fn lint_suffix(code: Option<Code>) -> String {
    let name = code.and_then(Code::lint_name);
    name.map_or_else(String::new, |name| format!(" [{name}]"))
}

/// Formats a hint as a sentence, with a capital and a full stop.
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
    fn lints_have_their_serial_names() {
        for (code, name) in super::Code::LINTS {
            assert_eq!(serde_json::to_string(&code).unwrap(), format!("\"{name}\""));
        }
    }

    #[test]
    fn a_hint_becomes_a_sentence() {
        assert_eq!(sentence("remove the triangle"), "Remove the triangle.");
        assert_eq!(sentence("did you mean `box`?"), "Did you mean `box`?");
        assert_eq!(sentence("`a` is a word"), "`a` is a word.");
    }
}
