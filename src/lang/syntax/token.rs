//! The tokens of one text.

use super::names::Symbol;
use super::scan;
use crate::base::source::{FileId, Span};
use crate::base::word::Word;
use std::borrow::Cow;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

/// In [`Directive::next`] and [`Directive::end`]: nothing of the kind in this file.
pub const END_OF_FILE: u32 = u32::MAX;

/// Kinds of tokens.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A number without a sign.
    Number,
    /// A reserved word.
    Word,
    /// An identifier.
    Name,
    /// A string.
    String,
    /// `#` with a word: a directive.
    Directive,
    /// A character that stands for itself; any character that can begin no other token is one of these.
    Mark,
    /// `<=`
    LessEqual,
    /// `>=`
    GreaterEqual,
    /// `!=`
    NotEqual,
    /// A long data segment, which is tokenized when reading gets there.
    DataSegment,
    /// The end of the text, always the last token and only that.
    End,
}

/// A token; its text is scanned again from its start.
#[derive(Clone, Copy, Debug)]
pub struct Token {
    /// Its kind.
    pub kind: Kind,
    /// `Number`: index into [`Tokens::numbers`]. `Word`: the word's number, see [`Word::from_index`]. `Name`: the
    /// number of its [`Symbol`]. `String`: for [`Tokens::string`]. `Directive`: index into [`Tokens::directives`].
    /// `Mark`: the code of the character. `DataSegment`: for [`Tokens::data_segment`]. Otherwise 0.
    pub value: u32,
    /// Its first byte.
    pub start: u32,
}

impl Token {
    /// The reserved word, if it is one.
    #[must_use]
    pub fn word(self) -> Option<Word> {
        match self.kind {
            Kind::Word => Word::from_index(self.value),
            _ => None,
        }
    }

    /// The symbol of the identifier, if it is one.
    #[must_use]
    pub fn symbol(self) -> Option<Symbol> {
        (self.kind == Kind::Name).then_some(Symbol(self.value))
    }

    /// True if it is this mark.
    #[must_use]
    pub fn is_mark(self, mark: char) -> bool {
        self.kind == Kind::Mark && self.value == u32::from(mark)
    }
}

/// A directive and its links to the others of its group: `#if` `#elseif` `#else` `#end`; `#switch` `#case` `#range`
/// `#else` `#end`; `#while`, `#for`, `#macro` and their `#end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Directive {
    /// The word after `#`; `None` for a `#` before anything but a directive, which is the next token. The reader skips
    /// it or reports an error.
    pub word: Option<Word>,
    /// Token index of the following part of the group; [`END_OF_FILE`] for the last part, for a directive that belongs
    /// to no group (`#break` among them), and where the group is not closed in this file.
    pub next: u32,
    /// Token index of the group's `#end`, for each part and for the `#end` itself; [`END_OF_FILE`] without one.
    pub end: u32,
    /// The byte after the word, or after the `#` alone.
    pub stop: u32,
}

/// The tokens of one text.
#[derive(Clone, Debug)]
pub struct Tokens {
    /// The file of the text.
    pub file: FileId,
    /// The tokens; the last is [`Kind::End`].
    pub tokens: Vec<Token>,
    /// The values of the numbers; infinite where a number is too large.
    pub numbers: Vec<f64>,
    /// The directives.
    pub directives: Vec<Directive>,
    pub(super) text: Arc<String>,
    /// The bytes between the quotes of each string.
    pub(super) strings: Vec<Range<u32>>,
    /// The data segments, which are not tokenized yet.
    pub(super) segments: Vec<Range<u32>>,
    /// The whole that they are a part of, for the tokens of a data segment.
    pub(super) part: Option<Part>,
}

/// The tokens that a piece of a data segment belongs to.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) whole: Rc<Tokens>,
    /// The index of [`Kind::DataSegment`] there.
    pub(super) at: usize,
}

impl Tokens {
    /// The span of a token; the end of the text for an index past the last.
    #[must_use]
    pub fn span(&self, index: usize) -> Span {
        let Some(token) = self.tokens.get(index).or(self.tokens.last()) else {
            return Span::new(self.file, 0, 0);
        };
        let start = token.start as usize;
        let text = self.text.as_bytes();
        let len = match token.kind {
            Kind::Number => scan::number_end(text, start) - start,
            Kind::Word | Kind::Name => scan::word_end(text, start) - start,
            Kind::String => self.strings[token.value as usize].len() + 2,
            Kind::Directive => self.directives[token.value as usize].stop as usize - start,
            Kind::Mark => char::from_u32(token.value).map_or(1, char::len_utf8),
            Kind::LessEqual | Kind::GreaterEqual | Kind::NotEqual => 2,
            Kind::DataSegment | Kind::End => 0,
        };
        let end = u32::try_from(start + len).unwrap_or(u32::MAX);
        Span::new(self.file, token.start, end)
    }

    /// The number after the first `#version`, if one stands there.
    #[must_use]
    pub fn first_version(&self) -> Option<f64> {
        let is_version = |token: &Token| {
            token.kind == Kind::Directive
                && self.directives[token.value as usize].word == Some(Word::Version)
        };
        let at = self.tokens.iter().position(is_version)?;
        let number = self.tokens.get(at + 1)?;
        (number.kind == Kind::Number).then(|| self.numbers[number.value as usize])
    }

    /// True if a token of this text is an `#end`.
    #[must_use]
    pub fn is_end(&self, token: Token) -> bool {
        token.kind == Kind::Directive
            && self.directives[token.value as usize].word == Some(Word::End)
    }

    /// True if a token of this text is a `#` before anything but a directive.
    #[must_use]
    pub fn is_hash(&self, token: Token) -> bool {
        token.kind == Kind::Directive && self.directives[token.value as usize].word.is_none()
    }

    /// The text of the tokens.
    #[must_use]
    pub fn text(&self) -> &Arc<String> {
        &self.text
    }

    /// A string as it is written, except for `\"`, which stands for a quote: the form in which POV-Ray takes file
    /// names. `value` is the value of a string token.
    ///
    /// # Panics
    /// If `value` is that of another kind of token.
    #[must_use]
    pub fn string_raw(&self, value: u32) -> Cow<'_, str> {
        let written = self.written(value);
        if written.contains("\\\"") {
            Cow::Owned(written.replace("\\\"", "\""))
        } else {
            Cow::Borrowed(written)
        }
    }

    /// A string with its escapes replaced: `\a \b \f \n \r \t \v \0 \\ \' \"` and `\u` with four hexadecimal digits.
    /// Any other escape stays as it is written; see [`Tokens::bad_escape`]. Half a surrogate pair becomes U+FFFD.
    ///
    /// # Panics
    /// If `value` is not the value of a string token.
    #[must_use]
    pub fn string(&self, value: u32) -> String {
        unescaped(self.written(value))
    }

    /// As [`Tokens::string`], with as many blanks for each letter beyond ASCII as it has bytes in the file: one in
    /// Latin-1. Those from escapes stay.
    ///
    /// # Panics
    /// If `value` is not the value of a string token.
    #[must_use]
    pub fn string_in_ascii(&self, value: u32, is_latin1: bool) -> String {
        let written = self.written(value).chars();
        let blank = |c: char| {
            if c.is_ascii() {
                (c, 1)
            } else {
                (' ', if is_latin1 { 1 } else { c.len_utf8() })
            }
        };
        let plain = written
            .map(blank)
            .flat_map(|(c, count)| std::iter::repeat_n(c, count));
        unescaped(&plain.collect::<String>())
    }

    /// The span of the first invalid escape of a string; POV-Ray stops there when the string is used.
    ///
    /// # Panics
    /// If `value` is not the value of a string token.
    #[must_use]
    pub fn bad_escape(&self, value: u32) -> Option<Span> {
        let range = &self.strings[value as usize];
        let written = self.written(value);
        let mut at = 0;
        while let Some(next) = written[at..].find('\\') {
            at += next;
            let escape = escape(&written[at..]);
            if escape.value.is_none() {
                let start = range.start + u32::try_from(at).ok()?;
                let end = start + u32::try_from(escape.len).ok()?;
                return Some(Span::new(self.file, start, end));
            }
            at += escape.len;
        }
        None
    }

    fn written(&self, value: u32) -> &str {
        let range = &self.strings[value as usize];
        &self.text[range.start as usize..range.end as usize]
    }
}

/// The span of the token of a text that begins at a byte; only the `#` of a directive.
#[must_use]
pub fn span_at(file: FileId, text: &str, start: u32) -> Span {
    let at = start as usize;
    let bytes = text.as_bytes();
    let end = match bytes.get(at) {
        Some(&byte) if scan::is_letter(byte) => scan::word_end(bytes, at),
        Some(b'"') => scan::string_end(bytes, at),
        Some(b'<' | b'>' | b'!') if bytes.get(at + 1) == Some(&b'=') => at + 2,
        _ => match scan::number_end(bytes, at) {
            end if end > at => end,
            _ => {
                let letter = text.get(at..).and_then(|rest| rest.chars().next());
                at + letter.map_or(0, char::len_utf8)
            }
        },
    };
    Span::new(file, start, u32::try_from(end).unwrap_or(u32::MAX))
}

fn unescaped(mut rest: &str) -> String {
    let mut out = String::with_capacity(rest.len());
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        let escape = escape(&rest[at..]);
        match escape.value {
            Some(value) => out.push(value),
            None => out.push_str(&rest[at..at + escape.len]),
        }
        rest = &rest[at + escape.len..];
    }
    out.push_str(rest);
    out
}

struct Escape {
    /// Its character, if it is valid.
    value: Option<char>,
    /// Its bytes, the backslash included.
    len: usize,
}

/// The escape at the start of `text`, which is a backslash.
fn escape(text: &str) -> Escape {
    let Some(letter) = text[1..].chars().next() else {
        return Escape {
            value: None,
            len: 1,
        };
    };
    let value = match letter {
        'a' => '\x07',
        'b' => '\x08',
        'f' => '\x0c',
        'n' => '\n',
        'r' => '\r',
        't' => '\t',
        'v' => '\x0b',
        '0' => '\0',
        '\\' | '\'' | '"' => letter,
        'u' => return code_escape(text),
        _ => {
            return Escape {
                value: None,
                len: 1 + letter.len_utf8(),
            };
        }
    };
    Escape {
        value: Some(value),
        len: 2,
    }
}

/// The escape `\uXXXX` at the start of `text`.
fn code_escape(text: &str) -> Escape {
    let digits = text.get(2..6).unwrap_or_default();
    if digits.len() < 4 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return Escape {
            value: None,
            len: 2,
        };
    }
    let code = u32::from_str_radix(digits, 16).ok();
    Escape {
        value: code.map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)),
        len: 6,
    }
}
