//! Arguments of functions, parameters of macros and factors, as other languages write them.

use crate::base::args::Word;
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::frame::Start;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Token};

/// Suffixes of numbers in C-like languages.
const SUFFIXES: &[&str] = &["f", "F", "d", "D", "L", "u", "U"];

impl Reader<'_> {
    /// `vlength <1, 2, 3>` and `vlength(1, 2, 3)`: the components from a token on, where the function takes a vector.
    pub(crate) fn vector_argument(&self, word: Word, open: Start) -> Option<Remedy> {
        if !matches!(word, Word::Vlength | Word::Vnormalize) {
            return None;
        }
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < open.start);
        let remedy = self
            .vector_in_brackets(at)
            .filter(|_| tokens.file == open.file)?;
        Some(remedy.around("(", ")", &format!("`{word}` takes a vector")))
    }

    /// `pi()` for `pi`, at its `(`.
    pub(super) fn constant_with_parentheses(&self) -> Option<Remedy> {
        let at = self.here.at;
        let constant = self.token(at.checked_sub(1)?)?.word()?;
        let is_empty = self.raw().is_mark('(') && self.raw_ahead(1).is_mark(')');
        (is_empty && constant.class() == Class::Value).then(|| {
            let hint = format!("`{constant}` takes no arguments: remove `()`.");
            Remedy::fix(hint, self.tokens_span(at..at + 2), "")
        })
    }

    /// `1.5f` and `1.O`, at the letter.
    pub(super) fn suffix_of_number(&self, token: Token) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        let (last, here) = (self.here.tokens.span(before), self.here_span());
        let is_number =
            self.token(before)?.kind == Kind::Number || self.token(before)?.is_mark('.');
        let is_free = token
            .symbol()
            .is_some_and(|name| self.scopes.get(name).is_none());
        let name = self.source_text(here);
        if !is_number || !is_free || last.end != here.start {
            return None;
        }
        match name {
            "O" | "o" => Some(Remedy::fix(
                format!("`{name}` is a letter: write `0`."),
                here,
                "0",
            )),
            _ if SUFFIXES.contains(&name) => {
                let hint = format!("Numbers have no suffix: remove `{name}`.");
                Some(Remedy::fix(hint, here, ""))
            }
            _ => None,
        }
    }

    /// A number that touches the vector of a span: `2x`, `2R*y`.
    pub(crate) fn factor_before(&self, span: Span) -> Option<Remedy> {
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < span.start);
        let before = at.checked_sub(1).filter(|_| tokens.file == span.file)?;
        let last = tokens.span(before);
        if self.token(before)?.is_mark('<') && self.token(at)?.is_mark('<') {
            return Some(Remedy::fix("One `<` is enough: remove this one.", last, ""));
        }
        let touches = self.token(before)?.kind == Kind::Number && last.end == span.start;
        let factor = tokens.span(at);
        touches.then(|| {
            let product = format!("{}*{}", self.source_text(last), self.source_text(factor));
            let hint = format!("Write `*` between factors: `{product}`.");
            Remedy::fix(hint, last.to(factor), product)
        })
    }

    /// The head of a macro with types, default values or other signs between its parameters, at the next token.
    pub(crate) fn parameter_of_other_languages(&self) -> Option<Remedy> {
        let token = self.raw();
        if token.is_mark(';') {
            let hint = "Parameters are separated by `,`.";
            return Some(Remedy::fix(hint, self.here_span(), ","));
        }
        if !token.is_mark('=') && !token.is_mark(':') {
            return None;
        }
        let value = self.until_mark(self.here.at, &[',', ')'])?;
        let last = self.here.tokens.span(self.here.at.checked_sub(1)?);
        let span = Span::new(last.file, last.end, value.end);
        let hint = "Parameters have neither default values nor types: remove it.";
        Some(Remedy::fix(hint, span, ""))
    }

    /// A value that an operator lacks: `1 + ;`.
    pub(super) fn value_after_operator(&self, token: Token) -> Option<Remedy> {
        let last = self.token(self.here.at.checked_sub(1)?)?;
        let at = self.here.at;
        let operator = ['+', '-', '*', '/']
            .into_iter()
            .find(|&mark| last.is_mark(mark))?;
        let is_doubled = at >= 2 && self.token(at - 2)?.is_mark(operator);
        if is_doubled && matches!(operator, '+' | '-') {
            let hint = format!("`{operator}{operator}` is not an operator: write `{operator} 1`.");
            let span = self.tokens_span(at - 2..at);
            return Some(Remedy::fix(hint, span, format!(" {operator} 1")));
        }
        let ends = token.kind == Kind::End
            || [';', ',', ')', '}', ']', '>']
                .into_iter()
                .any(|mark| token.is_mark(mark));
        ends.then(|| format!("Write a value after `{operator}`.").into())
    }

    /// `rotate x=90`, at the sign.
    pub(super) fn angle_with_sign(&self) -> Option<Remedy> {
        let at = self.here.at;
        let axis = self.token(at.checked_sub(1)?)?.word()?;
        let transform = self.token(at.checked_sub(2)?)?.word()?;
        let is_axis = matches!(axis, Word::X | Word::Y | Word::Z);
        let is_linear = matches!(transform, Word::Rotate | Word::Translate);
        let sign = usize::from(self.raw_ahead(1).is_mark('-'));
        let is_number = self.raw_ahead(1 + sign).kind == Kind::Number;
        (is_axis && is_linear && is_number).then(|| {
            let number = self.source_text(self.tokens_span(at + 1..at + 2 + sign));
            let vector = format!("{number}*{axis}");
            let hint = format!("Write `{transform} {vector}`.");
            Remedy::fix(hint, self.tokens_span(at - 1..at + 2 + sign), vector)
        })
    }

    /// `#declare R 1;` and `#declare R := 1;`, behind the name.
    pub(crate) fn missing_equals(&self, hint: String) -> Remedy {
        let (token, here) = (self.raw(), self.here_span());
        if token.is_mark(':') && self.raw_ahead(1).is_mark('=') {
            let at = self.here.at;
            return Remedy::fix(hint, self.tokens_span(at..at + 2), "=");
        }
        let is_value = matches!(token.kind, Kind::Number | Kind::String) || token.is_mark('<');
        match is_value {
            true => Remedy::fix(hint, Span::new(here.file, here.start, here.start), "= "),
            false => hint.into(),
        }
    }

    /// A macro's name behind an `#end`, where other languages repeat it.
    pub(crate) fn name_behind_end(&self, error: Diagnostic, call: Start) -> Diagnostic {
        let remedy = || {
            let tokens = self.tokens_read(call.file)?;
            let at = tokens
                .tokens
                .partition_point(|token| token.start < call.start);
            let before = at.checked_sub(1)?;
            let token = tokens.tokens[before];
            let is_end = token.kind == Kind::Directive
                && tokens.directives[token.value as usize].word == Some(Word::End);
            let (end, name) = (tokens.span(before), tokens.span(at));
            let line = |span: Span| self.sources.line_column(span).0;
            (is_end && line(end) == line(name)).then(|| {
                let hint = format!("`#end` takes no name: remove `{}`.", self.source_text(name));
                Remedy::fix(hint, name, "")
            })
        };
        match remedy() {
            Some(remedy) => {
                let error = Diagnostic {
                    hints: Vec::new(),
                    ..error
                };
                remedy.added_to(error)
            }
            None => error,
        }
    }
}
