//! Loops and conditions of C-like languages, and conditions without parentheses that call macros.

use crate::base::args::Word;
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::frame::Entered;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Tokens};

/// Most tokens of a condition.
const CONDITION: usize = 64;

impl Reader<'_> {
    /// `for (int i = 0; i < 10; i++)`, from the `(` at a token on; `start` is the token that the change begins with.
    pub(super) fn loop_of_c(&self, start: usize, open: usize) -> Option<Remedy> {
        let line = self.rest_of_line(open);
        let end = line.find(')')?;
        let head = line.get(1..end)?;
        let parts: Vec<&str> = head.split(';').map(str::trim).collect();
        let [begin, condition, step] = parts.as_slice() else {
            return None;
        };
        let (declared, first) = begin.split_once('=')?;
        let name = declared.split_whitespace().next_back()?;
        let bound = condition.strip_prefix(name)?.trim_start();
        let (bound, is_below) = match bound.strip_prefix("<=") {
            Some(bound) => (bound.trim(), false),
            None => (bound.strip_prefix('<')?.trim(), true),
        };
        let is_by_one = step.strip_prefix(name).map(str::trim) == Some("++")
            || step.strip_prefix("++") == Some(name);
        let last = match (is_below, bound.parse::<i64>()) {
            (true, Ok(bound)) => bound.checked_sub(1)?.to_string(),
            (true, Err(_)) => format!("{bound} - 1"),
            _ => bound.to_owned(),
        };
        let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !is_by_one || !is_name || Word::from_spelling(name).is_some() {
            return None;
        }
        let text = format!("#for ({name}, {}, {last})", first.trim());
        let hint = format!("A loop over numbers is `{text}`.");
        let span = self.here.tokens.span(start);
        let close = self.bytes_from(open, end + 1);
        Some(Remedy::fix(hint, span.to(close), text))
    }

    /// The error for a condition that does not begin with `(`.
    pub(crate) fn no_condition(&mut self) -> Box<Diagnostic> {
        let mut error = self.expected_here("`(` and a condition or number");
        if let Some((condition, remedy)) = self.condition_with_macro()
            && !error.message.is_empty()
        {
            error.hints.clear();
            error.fix = None;
            error.span = Some(condition);
            error.message = "a condition stands in parentheses".to_owned();
            return Box::new(remedy.added_to(*error));
        }
        error
    }

    /// The condition of `#if F(1) > 0`, where the next token is the first of the macro's body.
    fn condition_with_macro(&self) -> Option<(Span, Remedy)> {
        let Entered::Macro { back, .. } = &self.frames.last()?.kind else {
            return None;
        };
        let tokens = &back.tokens;
        let line = |at: usize| self.sources.line_column(tokens.span(at)).0;
        let here = back.at.checked_sub(1)?;
        let directive = (here.saturating_sub(CONDITION)..=here)
            .rev()
            .take_while(|&at| line(at) == line(here))
            .find(|&at| tokens.tokens[at].kind == Kind::Directive)?;
        let word = tokens.directives[tokens.tokens[directive].value as usize].word?;
        let has_condition = matches!(
            word,
            Word::If | Word::Elseif | Word::While | Word::Switch | Word::Case
        );
        let end = (back.at..back.at + CONDITION)
            .find(|&at| line(at) != line(here) || !self.is_in_condition(tokens, at))?;
        let span = tokens.span(directive + 1).to(tokens.span(end - 1));
        let text = format!("({})", self.source_text(span));
        let hint = format!("Write `{text}`.");
        has_condition.then(|| (span, Remedy::fix(hint, span, text)))
    }

    fn is_in_condition(&self, tokens: &Tokens, at: usize) -> bool {
        let token = tokens.tokens[at];
        match token.kind {
            Kind::Number | Kind::LessEqual | Kind::GreaterEqual | Kind::NotEqual => true,
            Kind::Name => !matches!(
                token.symbol().and_then(|name| self.scopes.get(name)),
                Some(Value::Object(_) | Value::Element(_))
            ),
            Kind::Mark => {
                char::from_u32(token.value).is_some_and(|mark| "<>=!&|+-*/(),.".contains(mark))
            }
            _ => token
                .word()
                .is_some_and(|word| matches!(word.class(), Class::Value | Class::Function)),
        }
    }

    /// The span from the start of a token to the end of its line or to the first of some marks.
    pub(super) fn until_mark(&self, at: usize, marks: &[char]) -> Option<Span> {
        let line = self.rest_of_line(at);
        let end = line.find(marks)?;
        let text = line.get(..end)?.trim_end();
        (!text.is_empty() && !text.contains("//")).then(|| self.bytes_from(at, text.len()))
    }
}
