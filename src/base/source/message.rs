//! Diagnostics resolved to files, lines and columns, and formatted for output. They need no source texts.

use super::diagnostic::{lint_suffix, sentence};
use super::print::{Styling, annotated, pov_line};
use super::{Code, Diagnostic, Label, Severity, Sources, Span};
use serde::{Deserialize, Serialize};

/// A diagnostic with file, line and column instead of spans, so that it outlives the texts of its run.
///
/// Its serialised form is the object of `--message-format json`; fields may be added there, never renamed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Message {
    /// Severity of the diagnostic.
    pub severity: Severity,
    /// Category for programs, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<Code>,
    /// The message, in one line.
    pub message: String,
    /// The location; `None` if there is none in a text.
    #[serde(flatten)]
    pub location: Option<Location>,
    /// Notes on related locations.
    pub labels: Vec<Note>,
    /// The calls, loops and includes that led here, innermost first.
    pub trace: Vec<Note>,
    /// Remedies, as sentences.
    pub hints: Vec<String>,
    /// The change that the last hint describes, where it is certain: the text to write instead of what is there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fix: Option<Note>,
    /// The diagnostic as one line in POV-Ray's form.
    #[serde(skip)]
    pub pov_line: String,
    /// Source excerpt with annotations, as plain text.
    #[serde(skip)]
    pub excerpt: String,
    /// Source excerpt with annotations, with ANSI colour codes.
    #[serde(skip)]
    pub colored: String,
}

/// A range of a text as an editor shows it. Lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Location {
    /// The name of the text: the path of the file, or "standard input".
    pub file: String,
    /// The line of the first character.
    pub line: usize,
    /// The column of the first character.
    pub column: usize,
    /// The position after the last character.
    pub end: Position,
}

/// A position between two characters of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column of the character after the position, from 1.
    pub column: usize,
}

/// A note on a related location.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// The note.
    pub text: String,
    /// The related location.
    #[serde(flatten)]
    pub location: Location,
}

impl Message {
    /// Resolves and formats a diagnostic about texts of `sources`.
    #[must_use]
    pub fn new(diagnostic: &Diagnostic, sources: &Sources) -> Self {
        let note = |label: &Label| Note {
            text: label.text.clone(),
            location: location(label.span, sources),
        };
        Message {
            severity: diagnostic.severity,
            code: diagnostic.code,
            message: diagnostic.message.clone(),
            location: diagnostic.span.map(|span| location(span, sources)),
            labels: diagnostic.labels.iter().map(note).collect(),
            trace: diagnostic.trace.iter().map(note).collect(),
            hints: diagnostic.hints.iter().map(|hint| sentence(hint)).collect(),
            fix: diagnostic.fix.as_ref().map(|fix| Note {
                text: fix.text.clone(),
                location: location(fix.span, sources),
            }),
            pov_line: pov_line(diagnostic, sources),
            excerpt: annotated(diagnostic, sources, Styling::Plain),
            colored: annotated(diagnostic, sources, Styling::Colored),
        }
    }

    /// One line in the form that editors parse: `x.pov:5:3: error: message (hint)`.
    #[must_use]
    pub fn short(&self) -> String {
        let prefix = self.location.as_ref().map_or(String::new(), |start| {
            format!("{}:{}:{}: ", start.file, start.line, start.column)
        });
        let remedies = self.remedies();
        let lint = lint_suffix(self.code);
        let line = format!(
            "{prefix}{}: {}{lint}{remedies}",
            self.severity, self.message
        );
        line.replace(char::is_control, " ")
    }

    /// One line in POV-Ray's form: `File 'x.pov' line 5: Parse Error: message (hint)`.
    #[must_use]
    pub fn povray(&self) -> String {
        let remedies = self.remedies().replace(char::is_control, " ");
        format!("{}{remedies}", self.pov_line)
    }

    /// The hints, each in parentheses after a space.
    fn remedies(&self) -> String {
        let hints = self.hints.iter().map(|hint| format!(" ({hint})"));
        hints.collect()
    }
}

fn location(span: Span, sources: &Sources) -> Location {
    let (line, column) = sources.line_column(span);
    let end = Span {
        start: span.end.max(span.start),
        ..span
    };
    let (end_line, end_column) = sources.line_column(end);
    Location {
        file: sources.name(span.file).to_owned(),
        line,
        column,
        end: Position {
            line: end_line,
            column: end_column,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "sphere {\n  0, 1\n  grün { Red }\n}\n";

    fn message_of_scene() -> Message {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("x.pov", SCENE);
        let diagnostic = Diagnostic::error(Span::new(file, 18, 23), "unknown word `grün`")
            .with_code(Code::Undeclared)
            .with_label(Span::new(file, 7, 8), "this `{` is still open")
            .with_hint("Remove it.");
        Message::new(&diagnostic, &sources)
    }

    #[test]
    fn locations_are_lines_and_columns_in_characters() {
        let message = message_of_scene();
        let location = message.location.as_ref().unwrap();
        assert_eq!((location.line, location.column), (3, 3));
        assert_eq!((location.end.line, location.end.column), (3, 7));
        assert_eq!(
            message.short(),
            "x.pov:3:3: error: unknown word `grün` (Remove it.)"
        );
    }

    #[test]
    fn the_serial_form_is_the_documented_object() {
        assert_eq!(
            serde_json::to_string(&message_of_scene()).unwrap(),
            r#"{"severity":"error","code":"undeclared","message":"unknown word `grün`","file":"x.pov","line":3,"column":3,"end":{"line":3,"column":7},"labels":[{"text":"this `{` is still open","file":"x.pov","line":1,"column":8,"end":{"line":1,"column":9}}],"trace":[],"hints":["Remove it."]}"#
        );
        let nowhere = Message::new(
            &Diagnostic::warning(None, "no objects"),
            &Sources::default(),
        );
        assert_eq!(
            serde_json::to_string(&nowhere).unwrap(),
            r#"{"severity":"warning","message":"no objects","labels":[],"trace":[],"hints":[]}"#
        );
        assert_eq!(nowhere.short(), "warning: no objects");
    }
}
