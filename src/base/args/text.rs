//! Parameters read from a literal text, for unit tests of elements. No expressions, no directives.

use super::{Args, Parse, Word};
use crate::base::color::Color;
use crate::base::source::{Diagnostic, FileId, Severity, Span};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::sync::Arc;

type Value = Arc<dyn Any + Send + Sync>;

/// A text as [`Args`], with identifiers bound to values.
pub(crate) struct TextArgs {
    tokens: Vec<(String, Span)>,
    next: usize,
    names: Vec<(String, Value)>,
    version: f64,
    warnings: Vec<Diagnostic>,
}

impl TextArgs {
    /// Tokenises a text, in language version 3.7.
    pub(crate) fn new(text: &str) -> Self {
        TextArgs {
            tokens: tokens(text),
            next: 0,
            names: Vec::new(),
            version: 3.7,
            warnings: Vec::new(),
        }
    }

    /// Sets the language version.
    pub(crate) fn at_version(mut self, version: f64) -> Self {
        self.version = version;
        self
    }

    /// Declares an identifier.
    pub(crate) fn with<T: Any + Send + Sync>(mut self, name: &str, value: T) -> Self {
        self.names.push((name.to_owned(), Arc::new(value)));
        self
    }

    /// The messages of all warnings so far.
    pub(crate) fn warnings(&self) -> Vec<&str> {
        let all = self.warnings.iter();
        all.filter(|w| w.severity == Severity::Warning)
            .map(|w| w.message.as_str())
            .collect()
    }

    /// Returns true if all of the text was read.
    pub(crate) fn is_done(&self) -> bool {
        self.next == self.tokens.len()
    }

    fn peek(&self) -> &str {
        self.tokens.get(self.next).map_or("", |token| &token.0)
    }

    fn take(&mut self, text: &str) -> bool {
        let is_next = self.peek() == text;
        self.next += usize::from(is_next);
        is_next
    }

    /// Reads a list in angle brackets, or a single number.
    fn numbers(&mut self) -> Parse<Vec<f64>> {
        if !self.take("<") {
            return Ok(vec![self.float()?]);
        }
        let mut list = vec![self.float()?];
        while !self.take(">") {
            self.comma()?;
            list.push(self.float()?);
        }
        Ok(list)
    }

    fn padded<const N: usize>(&mut self) -> Parse<[f64; N]> {
        let list = self.numbers()?;
        let alone = if list.len() == 1 { list[0] } else { 0.0 };
        Ok(std::array::from_fn(|i| {
            list.get(i).copied().unwrap_or(alone)
        }))
    }

    /// The channels that a colour word sets, as indices into red, green, blue, filter, transmit.
    fn channels(&self) -> Option<&'static [usize]> {
        Some(match self.peek() {
            "rgb" => &[0, 1, 2],
            "rgbf" => &[0, 1, 2, 3],
            "rgbt" => &[0, 1, 2, 4],
            "rgbft" => &[0, 1, 2, 3, 4],
            "red" => &[0],
            "green" => &[1],
            "blue" => &[2],
            "filter" => &[3],
            "transmit" => &[4],
            _ => return None,
        })
    }
}

impl Args for TextArgs {
    fn float(&mut self) -> Parse<f64> {
        for (word, value) in [("on", 1.0), ("off", 0.0), ("yes", 1.0), ("no", 0.0)] {
            if self.take(word) {
                return Ok(value);
            }
        }
        let sign = if self.take("-") { -1.0 } else { 1.0 };
        let value = self.peek().parse::<f64>();
        let value = value.map_err(|_| self.expected("a number"))?;
        self.next += 1;
        Ok(sign * value)
    }

    fn float_or(&mut self, default: f64) -> Parse<f64> {
        if self.at_expression()? {
            self.float()
        } else {
            Ok(default)
        }
    }

    fn vector2(&mut self) -> Parse<DVec2> {
        Ok(DVec2::from_array(self.padded()?))
    }

    fn vector(&mut self) -> Parse<DVec3> {
        Ok(DVec3::from_array(self.padded()?))
    }

    fn vector4(&mut self) -> Parse<[f64; 4]> {
        self.padded()
    }

    fn color(&mut self) -> Parse<Color> {
        match self.color_if_any()? {
            Some(color) => Ok(color),
            None => Ok(Color::from_components(self.padded()?)),
        }
    }

    fn color_if_any(&mut self) -> Parse<Option<Color>> {
        if let Some(known) = super::declared::<Color>(self)? {
            return Ok(Some(*known));
        }
        if self.take("color") {
            return self.color().map(Some);
        }
        let mut sum = None;
        while let Some(channels) = self.channels() {
            if sum.is_some() && channels.len() > 1 {
                break;
            }
            self.next += 1;
            let values: [f64; 5] = self.padded()?;
            let sum = sum.get_or_insert([0.0; 5]);
            for (&channel, value) in channels.iter().zip(values) {
                sum[channel] = value;
            }
        }
        Ok(sum.map(Color::from_components))
    }

    fn string(&mut self) -> Parse<String> {
        Err(self.expected("a string"))
    }

    fn comma(&mut self) -> Parse<bool> {
        Ok(self.take(","))
    }

    fn word(&mut self) -> Parse<Option<Word>> {
        Ok(Word::from_spelling(self.peek()))
    }

    fn accept(&mut self, word: Word) -> Parse<bool> {
        Ok(self.take(word.spelling()))
    }

    fn accept_mark(&mut self, mark: char) -> Parse<bool> {
        Ok(self.take(mark.encode_utf8(&mut [0; 4])))
    }

    fn at_mark(&mut self, mark: char) -> Parse<bool> {
        Ok(self.peek() == mark.to_string())
    }

    fn open(&mut self) -> Parse<()> {
        if self.take("{") {
            Ok(())
        } else {
            Err(self.expected("`{`"))
        }
    }

    fn accept_close(&mut self) -> Parse<bool> {
        Ok(self.take("}"))
    }

    fn close(&mut self) -> Parse<()> {
        if self.take("}") {
            Ok(())
        } else {
            Err(self.expected("`}`"))
        }
    }

    fn at_expression(&mut self) -> Parse<bool> {
        let next = self.peek();
        Ok(matches!(next, "<" | "-" | "on" | "off" | "yes" | "no") || next.parse::<f64>().is_ok())
    }

    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Value>> {
        let next = self.peek();
        let named = self.names.iter().find(|(name, _)| name == next);
        let value = named.map(|(_, value)| value.clone());
        let value = value.filter(|value| (**value).type_id() == kind);
        self.next += usize::from(value.is_some());
        Ok(value)
    }

    fn span(&mut self) -> Span {
        let end = self.tokens.last().map_or(0, |token| token.1.end);
        let token = self.tokens.get(self.next);
        token.map_or(Span::new(FileId(0), end, end), |token| token.1)
    }

    fn last_span(&self) -> Span {
        let token = self.tokens.get(self.next.saturating_sub(1));
        token.map_or(Span::new(FileId(0), 0, 0), |token| token.1)
    }

    fn expected(&mut self, what: &str) -> Box<Diagnostic> {
        let message = match self.peek() {
            "" => format!("expected {what}, found the end of the text"),
            found => format!("expected {what}, found `{found}`"),
        };
        Box::new(Diagnostic::error(self.span(), message))
    }

    fn warn(&mut self, warning: Diagnostic) {
        self.warnings.push(warning);
    }

    fn version(&self) -> f64 {
        self.version
    }
}

/// Splits a text into words, numbers and single marks.
fn tokens(text: &str) -> Vec<(String, Span)> {
    let mut list: Vec<(String, Span)> = Vec::new();
    let mut is_open = false;
    for (at, letter) in text.char_indices() {
        let at = u32::try_from(at).expect("test texts are short");
        let is_part = letter.is_alphanumeric() || letter == '_' || letter == '.';
        if let (true, true, Some(last)) = (is_part, is_open, list.last_mut()) {
            last.0.push(letter);
            last.1.end = at + 1;
        } else if !letter.is_whitespace() {
            list.push((letter.to_string(), Span::new(FileId(0), at, at + 1)));
        }
        is_open = is_part;
    }
    list
}
