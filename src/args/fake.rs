//! Parameters from a text, for tests of readers: numbers, `<vectors>`, `"strings"`, reserved words, marks.

use super::{Args, Parse};
use crate::color::Color;
use crate::source::{Diagnostic, FileId, Span};
use crate::syntax::Word;
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::sync::Arc;

/// A reader of a text without directives, identifiers or operators; `nan` and `inf` are numbers.
pub(crate) struct FakeArgs {
    tokens: Vec<(String, Span)>,
    next: usize,
    /// What was warned of.
    pub(crate) warnings: Vec<Diagnostic>,
}

impl FakeArgs {
    /// Parameters as a scene writes them.
    pub(crate) fn new(text: &str) -> Self {
        let mut tokens: Vec<(String, Span)> = Vec::new();
        let mut start = None;
        for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
            if c.is_alphanumeric() || "._-+".contains(c) {
                start.get_or_insert(at);
                continue;
            }
            if let Some(from) = start.take() {
                tokens.push((text[from..at].to_owned(), span(from, at)));
            }
            if !c.is_whitespace() {
                tokens.push((c.to_string(), span(at, at + 1)));
            }
        }
        FakeArgs {
            tokens,
            next: 0,
            warnings: Vec::new(),
        }
    }

    /// Whether all was read.
    pub(crate) fn is_done(&self) -> bool {
        self.next == self.tokens.len()
    }

    fn peek(&self) -> &str {
        self.tokens.get(self.next).map_or("", |token| &token.0)
    }

    fn number(&self) -> Option<f64> {
        self.peek().parse().ok()
    }

    fn numbers<const N: usize>(&mut self) -> Parse<[f64; N]> {
        if !self.accept_mark('<')? {
            return Ok([self.float()?; N]);
        }
        let mut all = [0.0; N];
        for (i, one) in all.iter_mut().enumerate() {
            if i > 0 {
                self.comma()?;
            }
            *one = self.float()?;
        }
        if !self.accept_mark('>')? {
            return Err(self.expected("`>`"));
        }
        Ok(all)
    }
}

fn span(start: usize, end: usize) -> Span {
    let at = |i: usize| u32::try_from(i).expect("test texts are short");
    Span::new(FileId(0), at(start), at(end))
}

impl Args for FakeArgs {
    fn float(&mut self) -> Parse<f64> {
        let value = self.number().ok_or_else(|| self.expected("a number"))?;
        self.next += 1;
        Ok(value)
    }

    fn float_or(&mut self, default: f64) -> Parse<f64> {
        if self.number().is_some() {
            self.float()
        } else {
            Ok(default)
        }
    }

    fn vector2(&mut self) -> Parse<DVec2> {
        Ok(DVec2::from_array(self.numbers()?))
    }

    fn vector(&mut self) -> Parse<DVec3> {
        Ok(DVec3::from_array(self.numbers()?))
    }

    fn vector4(&mut self) -> Parse<[f64; 4]> {
        self.numbers()
    }

    fn color(&mut self) -> Parse<Color> {
        Err(self.expected("no colour in a test without colours"))
    }

    fn color_if_any(&mut self) -> Parse<Option<Color>> {
        Ok(None)
    }

    fn string(&mut self) -> Parse<String> {
        if !self.accept_mark('"')? {
            return Err(self.expected("a string"));
        }
        let text = self.peek().to_owned();
        self.next += 2;
        Ok(text)
    }

    fn comma(&mut self) -> Parse<bool> {
        self.accept_mark(',')
    }

    fn word(&mut self) -> Parse<Option<Word>> {
        Ok(Word::from_spelling(self.peek()))
    }

    fn accept(&mut self, word: Word) -> Parse<bool> {
        let is_next = self.peek() == word.spelling();
        self.next += usize::from(is_next);
        Ok(is_next)
    }

    fn accept_mark(&mut self, mark: char) -> Parse<bool> {
        let is_next = self.peek() == mark.to_string();
        self.next += usize::from(is_next);
        Ok(is_next)
    }

    fn open(&mut self) -> Parse<()> {
        if self.accept_mark('{')? {
            Ok(())
        } else {
            Err(self.expected("`{`"))
        }
    }

    fn accept_close(&mut self) -> Parse<bool> {
        self.accept_mark('}')
    }

    fn close(&mut self) -> Parse<()> {
        if self.accept_close()? {
            Ok(())
        } else {
            Err(self.expected("`}`"))
        }
    }

    fn at_expression(&mut self) -> Parse<bool> {
        Ok(self.number().is_some() || self.peek() == "<")
    }

    fn declared_any(&mut self, _: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        Ok(None)
    }

    fn span(&mut self) -> Span {
        let end = self.tokens.last().map_or(span(0, 0), |token| token.1);
        self.tokens.get(self.next).map_or(end, |token| token.1)
    }

    fn last_span(&self) -> Span {
        match self.next {
            0 => span(0, 0),
            next => self.tokens[next - 1].1,
        }
    }

    fn expected(&mut self, what: &str) -> Box<Diagnostic> {
        let found = self.peek().to_owned();
        Box::new(Diagnostic::error(
            self.span(),
            format!("expected {what}, found `{found}`"),
        ))
    }

    fn warn(&mut self, warning: Diagnostic) {
        self.warnings.push(warning);
    }

    fn version(&self) -> f64 {
        3.7
    }
}
