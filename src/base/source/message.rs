//! Findings told for good: without the texts they are about, in forms that are ready to print.

use super::diagnostic::sentence;
use super::print::{Styling, annotated, pov_line};
use super::{Code, Diagnostic, Label, Severity, Sources, Span};
use serde::Serialize;

/// A finding whose places are told by file, line and column, so that it outlives the texts of its run.
///
/// Its serial form is the object of `--message-format json`; fields are added there, never renamed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Message {
    /// How bad it is.
    pub severity: Severity,
    /// What kind of finding it is, where programs may want to know.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<Code>,
    /// What is wrong, in one line.
    pub message: String,
    /// Where; `None` for what has no place in a text.
    #[serde(flatten)]
    pub place: Option<Stretch>,
    /// Related places.
    pub labels: Vec<Note>,
    /// Calls, loops and includes on the way there, innermost first.
    pub trace: Vec<Note>,
    /// Things to do about it.
    pub hints: Vec<String>,
    /// POV-Ray's one line for it.
    #[serde(skip)]
    pub pov_line: String,
    /// The lines of the scene with what is wrong beside them, as plain text.
    #[serde(skip)]
    pub excerpt: String,
    /// The same with the codes of a colour terminal.
    #[serde(skip)]
    pub colored: String,
}

/// A stretch of a text as an editor shows it. Lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Stretch {
    /// The name of the text: the path by which the file was found, or "standard input".
    pub file: String,
    /// The line of the first character.
    pub line: usize,
    /// The column of the first character.
    pub column: usize,
    /// The place behind the last character.
    pub end: Point,
}

/// A place between two characters of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Point {
    /// The line, from 1.
    pub line: usize,
    /// The column of the character behind the place, from 1.
    pub column: usize,
}

/// What a related place has to do with a finding.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// The words.
    pub text: String,
    /// The place.
    #[serde(flatten)]
    pub place: Stretch,
}

impl Message {
    /// Tells a finding about texts of `sources`.
    #[must_use]
    pub fn new(finding: &Diagnostic, sources: &Sources) -> Self {
        let note = |label: &Label| Note {
            text: label.text.clone(),
            place: stretch(label.span, sources),
        };
        Message {
            severity: finding.severity,
            code: finding.code,
            message: finding.message.clone(),
            place: finding.span.map(|span| stretch(span, sources)),
            labels: finding.labels.iter().map(note).collect(),
            trace: finding.trace.iter().map(note).collect(),
            hints: finding.hints.iter().map(|hint| sentence(hint)).collect(),
            pov_line: pov_line(finding, sources),
            excerpt: annotated(finding, sources, Styling::Plain),
            colored: annotated(finding, sources, Styling::Colored),
        }
    }

    /// One line in the form that editors know: `x.pov:5:3: error: message (what to do about it)`.
    #[must_use]
    pub fn short(&self) -> String {
        let place = self.place.as_ref().map_or(String::new(), |place| {
            format!("{}:{}:{}: ", place.file, place.line, place.column)
        });
        let remedies = self.remedies();
        let line = format!("{place}{}: {}{remedies}", self.severity, self.message);
        line.replace(char::is_control, " ")
    }

    /// One line in POV-Ray's form: `File 'x.pov' line 5: Parse Error: message (what to do about it)`.
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

fn stretch(span: Span, sources: &Sources) -> Stretch {
    let (line, column) = sources.line_column(span);
    let behind = Span {
        start: span.end.max(span.start),
        ..span
    };
    let (end_line, end_column) = sources.line_column(behind);
    Stretch {
        file: sources.name(span.file).to_owned(),
        line,
        column,
        end: Point {
            line: end_line,
            column: end_column,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "sphere {\n  0, 1\n  grün { Red }\n}\n";

    fn told() -> Message {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("x.pov", SCENE);
        let finding = Diagnostic::error(Span::new(file, 18, 23), "unknown word `grün`")
            .with_code(Code::Undeclared)
            .with_label(Span::new(file, 7, 8), "this `{` is still open")
            .with_hint("Remove it.");
        Message::new(&finding, &sources)
    }

    #[test]
    fn places_are_lines_and_columns_in_characters() {
        let message = told();
        let place = message.place.as_ref().unwrap();
        assert_eq!((place.line, place.column), (3, 3));
        assert_eq!((place.end.line, place.end.column), (3, 7));
        assert_eq!(
            message.short(),
            "x.pov:3:3: error: unknown word `grün` (Remove it.)"
        );
    }

    #[test]
    fn the_serial_form_is_the_documented_object() {
        assert_eq!(
            serde_json::to_string(&told()).unwrap(),
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
