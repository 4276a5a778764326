//! Findings and messages of a reading, passed to a listener as they occur.

use super::{ReadEvent, limits};
use crate::base::source::{Diagnostic, Severity, Sources};

/// Findings and messages so far.
pub(super) struct Report<'a> {
    listener: &'a mut dyn FnMut(ReadEvent<'_>),
    pub(super) messages: String,
    pub(super) findings: Vec<Diagnostic>,
    /// Features that rendering does not support.
    pub(super) undrawn: Vec<Diagnostic>,
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
            errors: 0,
        }
    }

    /// Records a finding; consequences of earlier ones are dropped.
    pub(super) fn record(&mut self, finding: Diagnostic, sources: &Sources) {
        if finding.severity == Severity::Error {
            self.errors += 1;
        }
        if !finding.message.is_empty() && !self.findings.contains(&finding) {
            self.push(finding, sources);
        }
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

    fn push(&mut self, finding: Diagnostic, sources: &Sources) {
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
