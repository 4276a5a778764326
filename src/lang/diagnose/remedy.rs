//! Hints with the change of the text that they propose, and the tokens around an error.

use crate::base::source::{Diagnostic, Fix, Span};
use crate::lang::reader::Reader;
use crate::lang::syntax::Token;
use std::ops::Range;

/// A hint for the author, with the change of the text where that is certain.
pub(crate) struct Remedy {
    hint: String,
    fix: Option<Fix>,
}

impl Remedy {
    /// A hint that writes `text` in place of `span`.
    pub(crate) fn fix(hint: impl Into<String>, span: Span, text: impl Into<String>) -> Self {
        Remedy {
            hint: hint.into(),
            fix: Some(Fix {
                span,
                text: text.into(),
            }),
        }
    }

    /// The same with other brackets around the text that is written, by a rule.
    pub(super) fn around(self, opening: &str, closing: &str, rule: &str) -> Self {
        let fix = self.fix.map(|fix| Fix {
            text: format!("{opening}{}{closing}", fix.text),
            ..fix
        });
        let hint = match &fix {
            Some(fix) => format!("{rule}: `{}`.", fix.text),
            None => self.hint,
        };
        Remedy { hint, fix }
    }

    /// The same without the change.
    pub(super) fn uncertain(self) -> Self {
        Remedy { fix: None, ..self }
    }

    /// Adds it to an error.
    pub(crate) fn added_to(self, error: Diagnostic) -> Diagnostic {
        match self.fix {
            Some(fix) => error.with_fix(self.hint, fix),
            None => error.with_hint(self.hint),
        }
    }
}

impl<T: Into<String>> From<T> for Remedy {
    fn from(hint: T) -> Self {
        Remedy {
            hint: hint.into(),
            fix: None,
        }
    }
}

impl Reader<'_> {
    /// A token of the current text.
    pub(super) fn token(&self, at: usize) -> Option<Token> {
        self.here.tokens.tokens.get(at).copied()
    }

    /// The tokens of a range as a span.
    pub(super) fn tokens_span(&self, range: Range<usize>) -> Span {
        let tokens = &self.here.tokens;
        tokens.span(range.start).to(tokens.span(range.end - 1))
    }

    /// The text from a token to the end of its line.
    pub(super) fn rest_of_line(&self, at: usize) -> &str {
        let start = self.here.tokens.span(at).start as usize;
        let text = self.sources.text(self.here.tokens.file);
        let rest = text.get(start..).unwrap_or_default();
        rest.lines().next().unwrap_or_default()
    }

    /// A span with the blanks behind it.
    pub(super) fn with_blanks(&self, span: Span) -> Span {
        let text = self.sources.text(span.file);
        let behind = text.get(span.end as usize..).unwrap_or_default();
        let blanks = behind.bytes().take_while(|byte| b" \t".contains(byte));
        let blanks = u32::try_from(blanks.count()).unwrap_or(0);
        Span::new(span.file, span.start, span.end + blanks)
    }

    /// The removal of the first bytes of the next token and what follows it.
    pub(super) fn removed_bytes(&self, hint: impl Into<String>, len: usize) -> Remedy {
        Remedy::fix(hint, self.bytes_from(self.here.at, len), "")
    }

    /// The span of the first bytes of a token and what follows it.
    pub(super) fn bytes_from(&self, at: usize, len: usize) -> Span {
        let span = self.here.tokens.span(at);
        Span::new(
            span.file,
            span.start,
            span.start + u32::try_from(len).unwrap_or(0),
        )
    }
}
