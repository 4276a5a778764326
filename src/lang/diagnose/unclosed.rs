//! Messages about a `{`, `(` or `<` that is missing, or open where it should not be.

use crate::base::args::Word;
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::hints::opens_group;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::frame::Start;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Token, Tokens};

impl Reader<'_> {
    /// Adds the enclosing block to an error: at a token that begins something new, the block that is still open; for
    /// other errors, the block they stand in.
    pub(crate) fn with_block(&self, error: Diagnostic, found: Token, open: Span) -> Diagnostic {
        let (element, name) = self.element_of(open);
        if !begins_new(found) {
            return error.with_label(element, format!("in this `{name}`"));
        }
        let error = error.with_label(open, "this `{` is still open");
        if let Some((start, end)) = self.swallowed_end(open) {
            return error
                .with_label(start, "the `}` of this `{` may be the one that is missing")
                .with_label(end, "it ends here");
        }
        if !error.hints.is_empty() {
            return error;
        }
        let error = match self.declaration_within(open) {
            Some(directive) => error.with_label(directive, "the `}` may be missing before this"),
            None => error,
        };
        let close = match name {
            "{" => "Write the `}`".to_owned(),
            name => format!("Write the `}}` of `{name}`"),
        };
        let is_read_again =
            (open.file, open.start) >= (self.here.tokens.file, self.here_span().start);
        error.with_hint(match found.kind {
            Kind::End => format!("{close}."),
            _ if is_read_again => format!("{close} before the `#end` of this macro or loop."),
            _ => format!("{close} before `{}`.", self.source_text(self.here_span())),
        })
    }

    /// The word of a block, with its span; the `{` itself where there is none.
    pub(super) fn element_of(&self, open: Span) -> (Span, &str) {
        if let Some(tokens) = self.tokens_read(open.file) {
            let at = tokens
                .tokens
                .partition_point(|token| token.start < open.start);
            if let Some(before) = at.checked_sub(1)
                && tokens.tokens[before].kind == Kind::Word
            {
                let word = tokens.span(before);
                return (word.to(open), self.source_text(word));
            }
        }
        // Literal objects have no tokens.
        let (before, word) = self.word_before(open);
        let line = before.rsplit('\n').next();
        let is_comment = line.is_some_and(|line| line.contains("//"));
        match u32::try_from(before.len()).map(|start| Span::new(open.file, start, open.end)) {
            Ok(both) if !word.is_empty() && !is_comment => (both, word),
            _ => (open, self.source_text(open)),
        }
    }

    /// The word that a text ends with before a span, and the text before that; empty if it ends with no word.
    pub(crate) fn word_before(&self, span: Span) -> (&str, &str) {
        let text = self.sources.text(span.file);
        let before = text.get(..span.start as usize).unwrap_or_default();
        let before = before.trim_end();
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        before.split_at(before.trim_end_matches(is_part).len())
    }

    /// The `{` after a word is missing.
    pub(crate) fn no_block(&mut self, element: Span) -> Box<Diagnostic> {
        let after = self.source_text(element).to_owned();
        let name = self.raw().symbol().and_then(|name| self.scopes.get(name));
        let is_value = matches!(name, Some(Value::Element(element)) if element.name == after);
        let error = self.expected_after(element, &format!("`{{` after `{after}`"));
        if is_value {
            let block = format!("{{ {} }}", self.source_text(self.here_span()));
            let hint = format!("Write `{after} {block}`.");
            return Box::new(Remedy::fix(hint, self.here_span(), block).added_to(*error));
        }
        if error.hints.is_empty() {
            let hint = format!("Write `{after} {{`.");
            let here = self.here_span();
            let is_same_line = error.span == Some(here);
            // The `}` is there.
            let is_bracket = self.raw().is_mark('(') || self.raw().is_mark('[');
            return Box::new(match is_same_line && self.has_more_closing_braces() {
                true if is_bracket => Remedy::fix(hint, here, "{").added_to(*error),
                true => Remedy::fix(hint, Span::new(here.file, here.start, here.start), "{ ")
                    .added_to(*error),
                false => error.with_hint(hint),
            });
        }
        error
    }

    /// True if the text has more `}` than `{`.
    pub(super) fn has_more_closing_braces(&self) -> bool {
        self.count_of('}') > self.count_of('{')
    }

    /// True if the text has more `{` than `}`.
    pub(super) fn lacks_closing_brace(&self) -> bool {
        self.count_of('{') > self.count_of('}')
    }

    fn count_of(&self, mark: char) -> usize {
        let tokens = self.here.tokens.tokens.iter();
        tokens.filter(|token| token.is_mark(mark)).count()
    }

    /// "expected WHAT, found ...". Where the unexpected token stands in a later line, the error points to the text
    /// after which something is missing.
    pub(crate) fn expected_after(&mut self, behind: Span, what: &str) -> Box<Diagnostic> {
        let mut error = self.expected_here(what);
        let line = |span: Span| self.sources.line_column(span).0;
        match error.span {
            Some(found) if found.file == behind.file && line(found) > line(behind) => {
                error.span = Some(behind);
                Box::new(error.with_label(found, "found here"))
            }
            _ => error,
        }
    }

    /// The error for a token other than the `mark` that closes what was opened at `open`.
    pub(crate) fn with_opened(
        &self,
        error: Box<Diagnostic>,
        mark: char,
        open: Start,
    ) -> Box<Diagnostic> {
        if error.message.is_empty() {
            return error;
        }
        let open = self.span_of(open);
        let opened = self.source_text(open).to_owned();
        let mut error = error.with_label(open, format!("this `{opened}` is still open"));
        if error.hints.is_empty() {
            let before = (open.start as usize).checked_sub(1);
            let text = self.sources.text(open.file).as_bytes();
            if before.and_then(|at| text.get(at)) == Some(&b'<') {
                error.hints.push("One `<` compares two values.".to_owned());
                return Box::new(error);
            }
            if mark == ')'
                && self.raw().is_mark(',')
                && let Some(remedy) = self.vector_in_parentheses(open)
            {
                return Box::new(remedy.added_to(error));
            }
            if mark == '>'
                && let Some(remedy) = self.decimal_commas(open)
            {
                return Box::new(remedy.added_to(error));
            }
            if mark == '>' && self.raw().is_mark(';') {
                let hint = "Components are separated by `,`.";
                let remedy = Remedy::fix(hint, self.here_span(), ",");
                return Box::new(remedy.added_to(error));
            }
            return Box::new(self.closing(mark, open).added_to(error));
        }
        Box::new(error)
    }

    /// The mark that closes what was opened at `open`, at the next token or instead of it.
    fn closing(&self, mark: char, open: Span) -> Remedy {
        let found = self.source_text(self.here_span());
        let found = found.lines().next().unwrap_or_default();
        if self.raw().is_mark(',') {
            return "Remove this comma, or write what is missing before it.".into();
        }
        let other = ['>', ')', ']']
            .into_iter()
            .find(|&other| self.raw().is_mark(other));
        if let Some(other) = other
            && !self.is_in_bracket(other, open)
        {
            let hint = format!("`{mark}` closes this, not `{other}`.");
            return Remedy::fix(hint, self.here_span(), mark);
        }
        if mark == '>'
            && let Some(comma) = self.comma_behind_point(open)
        {
            let hint = "A point has three components: write the `>` behind the third.";
            return Remedy::fix(hint, Span::new(comma.file, comma.start, comma.start), mark);
        }
        let hint = match found {
            "" => format!("Write the `{mark}`."),
            found => format!("Write the `{mark}` before `{found}`."),
        };
        let (last, here) = (open.end, self.here_span());
        // A vector has two components at least.
        let is_cut = mark == '>'
            && here.file == open.file
            && last <= here.start
            && !self
                .source_text(Span::new(open.file, last, here.start))
                .contains(',');
        if is_cut {
            return hint.into();
        }
        let before = self
            .here
            .at
            .checked_sub(1)
            .map(|at| self.here.tokens.span(at));
        match before.filter(|_| self.raw().kind != Kind::End) {
            Some(last) if last.file == open.file => {
                Remedy::fix(hint, Span::new(last.file, last.end, last.end), mark)
            }
            _ => hint.into(),
        }
    }

    /// The third comma behind a `<` that begins a parameter of a shape.
    fn comma_behind_point(&self, open: Span) -> Option<Span> {
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < open.start);
        let before = self.token(at.checked_sub(1)?)?;
        let is_in_shape = self
            .words_of_blocks()
            .next()
            .is_some_and(|word| word.class() == Class::Shape);
        let is_parameter =
            tokens.file == open.file && is_in_shape && (before.is_mark('{') || before.is_mark(','));
        let commas = || (at..self.here.at).filter(|&at| tokens.tokens[at].is_mark(','));
        is_parameter
            .then(|| commas().nth(2).map(|at| tokens.span(at)))
            .flatten()
    }

    /// True if a bracket that `close` closes is open in the line before what was opened at `open`.
    fn is_in_bracket(&self, close: char, open: Span) -> bool {
        let opening = match close {
            '>' => '<',
            ')' => '(',
            _ => '[',
        };
        let text = self.sources.text(open.file);
        let before = text.get(..open.start as usize).unwrap_or_default();
        let line = before.lines().next_back().unwrap_or_default();
        line.matches(opening).count() > line.matches(close).count()
    }

    /// Names the directive that an `#end` may be missing for, where the indentation shows it: one whose `#end` begins a
    /// line with less indentation than the line of the directive.
    pub(crate) fn with_swallowed_directive(
        &self,
        tokens: &Tokens,
        error: Diagnostic,
    ) -> Diagnostic {
        let text = self.sources.text(tokens.file);
        let mut open: Vec<usize> = Vec::new();
        for (at, token) in tokens.tokens.iter().enumerate() {
            if token.kind != Kind::Directive {
                continue;
            }
            match tokens.directives[token.value as usize].word {
                Some(Word::End) => {
                    let Some(start) = open.pop() else {
                        return error;
                    };
                    let (start, end) = (tokens.span(start), tokens.span(at));
                    let (opened, _) = indentation(text, start.start as usize);
                    let (closed, is_first) = indentation(text, end.start as usize);
                    if is_first && closed < opened {
                        return error
                            .with_label(start, "the `#end` of this may be the one that is missing")
                            .with_label(end, "it ends here");
                    }
                }
                Some(word) if opens_group(word) => open.push(at),
                _ => {}
            }
        }
        error
    }

    /// A declaration in an open block that begins a line with no more indentation than the line of the block.
    fn declaration_within(&self, open: Span) -> Option<Span> {
        let tokens = &self.here.tokens;
        if open.file != tokens.file || open.start > self.here_span().start {
            return None;
        }
        let text = self.sources.text(open.file);
        let (opened, _) = indentation(text, open.start as usize);
        let first = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        let mut depth = 0;
        (first..self.here.at).find_map(|at| {
            let token = tokens.tokens[at];
            depth += i32::from(token.is_mark('{')) - i32::from(token.is_mark('}'));
            let declares = token.kind == Kind::Directive
                && matches!(
                    tokens.directives[token.value as usize].word,
                    Some(Word::Declare | Word::Macro)
                );
            let is_outside = || {
                let (indent, is_first) = indentation(text, token.start as usize);
                is_first && indent <= opened
            };
            (depth == 0 && declares && is_outside()).then(|| tokens.span(at))
        })
    }

    /// The opened `{` that the missing `}` belongs to, as far as the indentation shows: a block whose `}` begins a line
    /// with less indentation than the line of its `{` has taken the `}` of the block around it.
    pub(crate) fn swallowed_end(&self, open: Span) -> Option<(Span, Span)> {
        let tokens = &self.here.tokens;
        if open.file != tokens.file || open.start > self.here_span().start {
            return None;
        }
        let text = self.sources.text(open.file);
        let mut inner: Vec<usize> = Vec::new();
        let first = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        for at in first..self.here.at {
            let token = tokens.tokens[at];
            if token.is_mark('{') {
                inner.push(at);
            } else if token.is_mark('}') {
                let (start, end) = (tokens.span(inner.pop()?), tokens.span(at));
                let (opened, _) = indentation(text, start.start as usize);
                let (closed, is_first) = indentation(text, end.start as usize);
                if is_first && closed < opened {
                    return Some((start, end));
                }
            }
        }
        None
    }
}

/// True if a token begins an object or a statement, or ends the file: a `}` is missing before it.
pub(crate) fn begins_new(token: Token) -> bool {
    match token.kind {
        Kind::End => true,
        Kind::Word => token.word().is_some_and(|word| {
            matches!(word.class(), Class::Shape | Class::Csg | Class::Statement)
        }),
        _ => false,
    }
}

/// Length up to which a line is searched for its indentation. Files of one line have none.
const LONGEST_LINE: usize = 1000;

/// Indentation of the line of a byte, and whether the byte is its first.
fn indentation(text: &str, at: usize) -> (usize, bool) {
    let near = &text.as_bytes()[at.saturating_sub(LONGEST_LINE)..at];
    let is_end = |&byte: &u8| matches!(byte, b'\n' | b'\r');
    let line = match near.iter().rposition(is_end) {
        Some(end) => &near[end + 1..],
        None if near.len() < LONGEST_LINE => near,
        None => return (0, false),
    };
    let indent = line.len() - line.trim_ascii_start().len();
    (indent, indent == line.len())
}
