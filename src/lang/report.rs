//! Findings and messages of a reading, passed to a listener as they occur.

use super::{ReadEvent, limits};
use crate::base::source::{Diagnostic, Severity, Sources, Span};

/// Findings and messages so far.
pub(super) struct Report<'a> {
    listener: &'a mut dyn FnMut(ReadEvent<'_>),
    pub(super) messages: String,
    pub(super) findings: Vec<Diagnostic>,
    /// Features that rendering does not support.
    pub(super) undrawn: Vec<Diagnostic>,
    /// Number of reported errors.
    pub(super) reported: usize,
    /// Number of errors, with consequences of earlier ones.
    pub(super) errors: usize,
}

impl<'a> Report<'a> {
    /// An empty report.
    pub(super) fn new(listener: &'a mut dyn FnMut(ReadEvent<'_>)) -> Report<'a> {
        Report {
            listener,
            messages: String::new(),
            findings: Vec::new(),
            undrawn: Vec::new(),
            reported: 0,
            errors: 0,
        }
    }

    /// Records a finding; consequences of earlier ones are dropped.
    pub(super) fn record(&mut self, mut finding: Diagnostic, sources: &Sources) {
        finding.message = with_short_names(&finding.message);
        for hint in &mut finding.hints {
            *hint = with_short_names(hint);
        }
        if finding.severity == Severity::Error {
            self.errors += 1;
        }
        if !finding.message.is_empty() && !self.has_error_at_start_of(&finding) {
            self.push(finding, sources);
        }
    }

    /// True if nothing more is read because of the number of errors.
    pub(super) fn is_full(&self) -> bool {
        self.reported >= limits::ERRORS || self.errors >= limits::ALL_ERRORS
    }

    /// Records a warning, once for each span.
    pub(super) fn warning(&mut self, warning: Diagnostic, sources: &Sources) {
        if self.findings.len() < limits::FINDINGS && !self.knows(&warning) {
            self.push(warning, sources);
        }
    }

    /// True if there is a finding with this message at the same span.
    pub(super) fn knows(&self, finding: &Diagnostic) -> bool {
        let is_same =
            |known: &Diagnostic| known.span == finding.span && known.message == finding.message;
        self.findings.iter().any(is_same)
    }

    /// True for a finding that is known, or whose text begins where that of an earlier error does: the same mistake in
    /// a later call, or a consequence.
    fn has_error_at_start_of(&self, finding: &Diagnostic) -> bool {
        let start = |span: Span| (span.file, span.start);
        let position = finding.span.map(start);
        self.findings.iter().any(|known| {
            let is_at_start = position.is_some() && known.span.map(start) == position;
            known == finding || known.severity == Severity::Error && is_at_start
        })
    }

    fn push(&mut self, finding: Diagnostic, sources: &Sources) {
        self.reported += usize::from(finding.severity == Severity::Error);
        (self.listener)(ReadEvent::Finding(&finding, sources));
        self.findings.push(finding);
    }

    /// Writes text of `#debug` and the like; returns the number of bytes written so far.
    pub(super) fn say(&mut self, text: &str) -> usize {
        (self.listener)(ReadEvent::SceneOutput(text));
        self.messages.push_str(text);
        self.messages.len()
    }
}

/// A sentence in which long names between backquotes are cut; what a scene says by `#error` stays whole.
fn with_short_names(text: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut short = String::with_capacity(text.len());
    let (mut len, mut is_quoted) = (0, false);
    for letter in text.chars() {
        is_quoted ^= letter == '`';
        len = if is_quoted && is_part(letter) {
            len + 1
        } else {
            0
        };
        match len {
            ..=limits::QUOTED => short.push(letter),
            _ if !short.ends_with("...") => short.push_str("..."),
            _ => {}
        }
    }
    short
}

#[cfg(test)]
mod tests {
    use super::with_short_names;

    #[test]
    fn long_names_are_cut() {
        let name = "n".repeat(300);
        let cut = with_short_names(&format!("`{name}` and `b`"));
        assert_eq!(cut, format!("`{}...` and `b`", &name[..60]));
        assert_eq!(with_short_names("a b..."), "a b...");
        assert_eq!(with_short_names(&name), name);
    }
}
