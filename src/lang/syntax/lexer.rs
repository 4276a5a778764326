//! Runs the grammar over a text, one slice after the other, and makes tokens of its pairs.
//!
//! Text before the next `#`, `"` or `/` is split by hand, ten times as fast as by pest; the rest of that line goes to
//! pest. A slice may end within a token: what touches
//! its end is read again at the start of the next slice, and a slice that holds not even one whole token grows. Both
//! bound the time to linear in the length of the text.

use super::faults;
use super::groups;
use super::names::{Names, Symbol};
use super::scan::{self, Item};
use super::split_points;
use super::token::{Directive, END_OF_FILE, Kind, Token, Tokens};
use crate::base::source::{Diagnostic, FileId, Span};
use crate::base::word::{Class, Word};
use grammar::{Grammar, Rule};
use pest::{Parser, Token as Edge};
use std::ops::Range;
use std::sync::Arc;

#[allow(
    missing_docs,
    unreachable_pub,
    reason = "pest_derive makes a public enum of the rules, without docs"
)]
mod grammar {
    /// The rules of `grammar/pov.pest`.
    #[derive(pest_derive::Parser)]
    #[grammar = "grammar/pov.pest"]
    pub(super) struct Grammar;
}

/// Bytes of a slice: pest's pairs for one fit into the cache of a core.
const SLICE: usize = 1 << 15;

/// Bytes of plain text that are split at once.
const PLAIN_SLICE: usize = 1 << 20;

/// Shorter segments of plain text are tokenized at once: those are the scenes that people write.
const PLAIN_MIN: usize = 1 << 16;

/// Faults reported of one text; a file that is no scene has thousands.
const MAX_FAULTS: usize = 20;

/// Tokenizes a text and links its groups of directives; identifiers go to `names`.
///
/// # Errors
/// The first string or comment that is not closed and all numbers with two points before it, skipped regions included,
/// up to 20 of them; a text of 4 GiB or more.
pub fn tokenize(
    file: FileId,
    text: &Arc<String>,
    names: &mut Names,
) -> Result<Tokens, Vec<Diagnostic>> {
    tokenize_by(file, text, names, Data::Tokens)
}

/// The same, but long data segments become a [`Kind::DataSegment`] each, and their tokens are made when reading gets there, by
/// [`super::tokenize_more`]. They hold no strings, comments and directives.
///
/// # Errors
/// As [`tokenize`], without numbers in those segments.
pub fn tokenize_around_data(
    file: FileId,
    text: &Arc<String>,
    names: &mut Names,
) -> Result<Tokens, Vec<Diagnostic>> {
    tokenize_by(file, text, names, Data::Deferred)
}

/// Treatment of long data segments.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Data {
    /// They are tokenized at once.
    Tokens,
    /// They become one [`Kind::DataSegment`].
    Deferred,
}

fn tokenize_by(
    file: FileId,
    text: &Arc<String>,
    names: &mut Names,
    data: Data,
) -> Result<Tokens, Vec<Diagnostic>> {
    if u32::try_from(text.len()).is_err() {
        let error = Diagnostic::error(None, "a text of 4 GiB or more is too long for a scene");
        return Err(vec![error]);
    }
    let mut lexer = Lexer::new(file, text, names);
    lexer.data = data;
    if data == Data::Tokens {
        // A token takes five to six bytes of ordinary text.
        lexer.out.tokens.reserve(text.len() / 5 + 1);
    }
    lexer.run();
    lexer.push(Kind::End, 0, text.len());
    if !lexer.faults.is_empty() {
        return Err(lexer.faults);
    }
    let mut tokens = lexer.out;
    tokens.tokens.shrink_to_fit();
    groups::link(&mut tokens);
    Ok(tokens)
}

/// Tokenizes a range of a text that holds no string, comment or directive; also returns the faults there.
pub(super) fn tokenize_data(
    file: FileId,
    text: &Arc<String>,
    range: Range<usize>,
    names: &mut Names,
) -> (Tokens, Vec<Diagnostic>) {
    let mut lexer = Lexer::new(file, text, names);
    let slice = Slice {
        text: &text[..range.end],
        base: 0,
        is_cut: false,
    };
    lexer.push_plain(slice, range);
    (lexer.out, lexer.faults)
}

struct Lexer<'a> {
    text: &'a str,
    names: &'a mut Names,
    out: Tokens,
    faults: Vec<Diagnostic>,
    data: Data,
}

/// The part of the text that pest reads at once.
#[derive(Clone, Copy)]
struct Slice<'a> {
    text: &'a str,
    /// Its start in the whole text.
    base: usize,
    /// True if more text follows.
    is_cut: bool,
}

impl<'a> Slice<'a> {
    /// About `size` bytes of `text` from `base` on.
    fn new(text: &'a str, base: usize, size: usize) -> Self {
        let mut end = base.saturating_add(size).min(text.len());
        while !text.is_char_boundary(end) {
            end += 1;
        }
        Slice {
            text: &text[base..end],
            base,
            is_cut: end < text.len(),
        }
    }

    /// True if a token that ends here might go on after the slice.
    fn cuts(&self, end: usize) -> bool {
        self.is_cut && end == self.text.len()
    }
}

impl<'a> Lexer<'a> {
    fn new(file: FileId, text: &'a Arc<String>, names: &'a mut Names) -> Self {
        Lexer {
            text,
            names,
            out: Tokens {
                file,
                tokens: Vec::new(),
                numbers: Vec::new(),
                directives: Vec::new(),
                text: Arc::clone(text),
                strings: Vec::new(),
                segments: Vec::new(),
                part: None,
            },
            faults: Vec::new(),
            data: Data::Tokens,
        }
    }

    fn run(&mut self) {
        let mut at = 0;
        // Of the slice for pest; the rest of the line if it is zero.
        let mut size = 0;
        while at < self.text.len() && self.faults.len() < MAX_FAULTS {
            at = self.read_plain(at);
            if at == self.text.len() {
                return;
            }
            if self.text[at..].starts_with("//") {
                at = self.line_end(at);
                continue;
            }
            if size == 0 {
                size = (self.line_end(at) + 1 - at).min(SLICE);
            }
            let slice = Slice::new(self.text, at, size);
            at = self.read_rule(slice, Rule::piece);
            if at == slice.base {
                at = self.read_nested(at);
            }
            if at > slice.base {
                size = 0;
            } else if slice.is_cut && !self.text[at..].starts_with("/*") {
                size = size.saturating_mul(2).max(SLICE);
            } else {
                self.faults.push(faults::unclosed(&self.out, at));
                return;
            }
        }
    }

    /// The end of the line of a byte.
    fn line_end(&self, at: usize) -> usize {
        let rest = &self.text.as_bytes()[at..];
        at + memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len())
    }

    /// Reads a comment within which another begins, or a directive with a comment before its word.
    fn read_nested(&mut self, at: usize) -> usize {
        let rest = Slice::new(self.text, at, usize::MAX);
        match rest.text.as_bytes() {
            [b'/', b'*', ..] => self.read_rule(rest, Rule::nested),
            [b'#', ..] => self.read_rule(rest, Rule::nested_directive),
            _ => at,
        }
    }

    /// Reads plain text; returns where to go on.
    fn read_plain(&mut self, start: usize) -> usize {
        let mut at = start;
        while at < self.text.len() {
            let slice = Slice::new(self.text, at, PLAIN_SLICE);
            let bytes = slice.text.as_bytes();
            let plain = memchr::memchr3(b'#', b'"', b'/', bytes).unwrap_or(bytes.len());
            let reached = match self.data_segment(at..at + plain) {
                Some(segment) => {
                    self.push_plain(slice, 0..segment.start - at);
                    if split_points::is_in_parentheses(&self.out.tokens) {
                        slice.base + self.push_plain(slice, segment.start - at..plain)
                    } else {
                        self.push_segment(segment.clone());
                        segment.end
                    }
                }
                None => slice.base + self.push_plain(slice, 0..plain),
            };
            if reached == at {
                break;
            }
            at = reached;
        }
        at
    }

    /// The part of a range of plain text to tokenize later.
    fn data_segment(&self, plain: Range<usize>) -> Option<Range<usize>> {
        match self.data {
            Data::Deferred if plain.len() >= PLAIN_MIN => {
                split_points::between_split_points(self.text.as_bytes(), plain)
            }
            Data::Tokens | Data::Deferred => None,
        }
    }

    fn push_segment(&mut self, segment: Range<usize>) {
        let (start, end) = (offset(segment.start), offset(segment.end));
        if let (Some(Kind::DataSegment), Some(last)) = (
            self.out.tokens.last().map(|token| token.kind),
            self.out.segments.last_mut(),
        ) && last.end == start
        {
            last.end = end;
            return;
        }
        let index = offset(self.out.segments.len());
        self.push(Kind::DataSegment, index, segment.start);
        self.out.segments.push(start..end);
    }

    /// Makes tokens of pest's pairs in a slice; returns where to go on, which is the start of the slice if it begins
    /// with a token that is cut off.
    fn read_rule(&mut self, slice: Slice<'a>, rule: Rule) -> usize {
        let Ok(pairs) = Grammar::parse(rule, slice.text) else {
            return slice.base;
        };
        let mut start = 0;
        let mut directive = None;
        let mut head = None;
        let mut done = 0;
        for edge in pairs.tokens() {
            let (rule, end) = match edge {
                Edge::Start { rule, pos } => {
                    start = pos.pos();
                    if matches!(rule, Rule::directive | Rule::nested_directive) {
                        directive = Some(start);
                    }
                    continue;
                }
                Edge::End { rule, pos } => (rule, pos.pos()),
            };
            match (rule, directive) {
                (Rule::directive, Some(start))
                    if slice.cuts(end) || head.is_none() && self.has_comment(slice.base + end) =>
                {
                    return slice.base + start;
                }
                (Rule::directive | Rule::nested_directive, Some(start)) => {
                    self.push_directive(slice, start..end, head.take());
                    directive = None;
                }
                (Rule::head, _) => head = Some((start, end)),
                (_, Some(_)) | (Rule::piece, _) => continue,
                (Rule::numbers, None) => {
                    let reached = self.push_plain(slice, start..end);
                    if reached < end {
                        return slice.base + reached;
                    }
                }
                _ if slice.cuts(end) => return slice.base + start,
                (Rule::word, None) => self.push_word(slice, start, end),
                (Rule::string, None) => self.push_string(slice.base + start, slice.base + end),
                (Rule::mark | Rule::other | Rule::comparison, None) => {
                    self.push_mark(slice, start, end);
                }
                _ => {}
            }
            done = end;
        }
        slice.base + skip_blanks(slice.text, done)
    }

    /// True if a comment begins at a byte of the text, in the slice or after it.
    fn has_comment(&self, at: usize) -> bool {
        matches!(self.text.as_bytes().get(at..at + 2), Some(b"/*" | b"//"))
    }

    fn push(&mut self, kind: Kind, value: u32, start: usize) {
        let start = offset(start);
        self.out.tokens.push(Token { kind, value, start });
    }

    fn push_word(&mut self, slice: Slice, start: usize, end: usize) {
        let spelling = &slice.text[start..end];
        let start = slice.base + start;
        if let Some(word) = Word::from_spelling(spelling) {
            self.push(Kind::Word, word as u32, start);
        } else {
            let symbol = self.names.intern(spelling);
            match self.out.tokens.last() {
                Some(last) if last.is_mark('.') => self.push_behind_point(symbol, start),
                _ => self.push(Kind::Name, symbol.0, start),
            }
        }
    }

    /// A name behind a point: `local.Name` and `global.Name` are one token, which no version before 3.8 allows.
    fn push_behind_point(&mut self, name: Symbol, start: usize) {
        let scope = match self.out.tokens.as_slice() {
            [.., scope, _point] => *scope,
            _ => return self.push(Kind::Name, name.0, start),
        };
        let is_local = match scope.word() {
            Some(Word::Local) => true,
            Some(Word::Global) => false,
            _ => return self.push(Kind::Name, name.0, start),
        };
        self.replace_by_qualified(is_local, name, 2);
    }

    /// `local["Name"]` and `global["Name"]`, whose `]` follows, become the token of `local.Name` and `global.Name`. Returns
    /// true if they did.
    fn push_key(&mut self) -> bool {
        let [.., scope, open, key] = self.out.tokens.as_slice() else {
            return false;
        };
        let (scope, key) = match (open.is_mark('['), key.kind) {
            (true, Kind::String) => (*scope, key.value as usize),
            _ => return false,
        };
        let is_local = match scope.word() {
            Some(Word::Local) => true,
            Some(Word::Global) => false,
            _ => return false,
        };
        let span = &self.out.strings[key];
        let name = &self.text[span.start as usize..span.end as usize];
        if name.contains('\\') {
            return false;
        }
        let name = self.names.intern(name);
        self.out.strings.truncate(key);
        self.replace_by_qualified(is_local, name, 3);
        true
    }

    /// Replaces the last `count` tokens, which name a scope first, by `local.Name` or `global.Name`.
    fn replace_by_qualified(&mut self, is_local: bool, name: Symbol, count: usize) {
        let symbol = self.names.intern_qualified(is_local, name);
        let first = self.out.tokens.len() - count;
        let start = self.out.tokens[first].start;
        self.out.tokens.truncate(first);
        self.out.tokens.push(Token {
            kind: Kind::Name,
            value: symbol.0,
            start,
        });
    }

    fn push_mark(&mut self, slice: Slice, start: usize, end: usize) {
        let text = &slice.text[start..end];
        let start = slice.base + start;
        match text.as_bytes() {
            b"<=" => self.push(Kind::LessEqual, 0, start),
            b">=" => self.push(Kind::GreaterEqual, 0, start),
            b"!=" => self.push(Kind::NotEqual, 0, start),
            b"]" if self.push_key() => {}
            &[mark] => self.push(Kind::Mark, u32::from(mark), start),
            _ => {
                let code = text.chars().next().map_or(0, u32::from);
                self.push(Kind::Mark, code, start);
            }
        }
    }

    fn push_string(&mut self, start: usize, end: usize) {
        let index = offset(self.out.strings.len());
        self.out.strings.push(offset(start + 1)..offset(end - 1));
        self.push(Kind::String, index, start);
    }

    /// `#` with its word, if it has one. A word that is no directive becomes a token of its own, and the `#` is
    /// skipped, except where the reader has to decide.
    fn push_directive(&mut self, slice: Slice, span: Range<usize>, head: Option<(usize, usize)>) {
        let (start, end) = (slice.base + span.start, slice.base + span.end);
        let Some((head_start, head_end)) = head else {
            if begins_number_or_semicolon(&self.text.as_bytes()[end..]) {
                self.push_hash(None, start, start + 1);
            }
            return;
        };
        let word = Word::from_spelling(&slice.text[head_start..head_end]);
        if word.is_some_and(is_directive) {
            self.push_hash(word, start, slice.base + head_end);
            return;
        }
        if word.is_none_or(Word::gives_float) {
            self.push_hash(None, start, start + 1);
        }
        self.push_word(slice, head_start, head_end);
    }

    fn push_hash(&mut self, word: Option<Word>, start: usize, stop: usize) {
        let index = offset(self.out.directives.len());
        self.out.directives.push(Directive {
            word,
            next: END_OF_FILE,
            end: END_OF_FILE,
            stop: offset(stop),
        });
        self.push(Kind::Directive, index, start);
    }

    /// Makes tokens of a range without comments, strings and directives; returns where in the slice it ended, before
    /// the end of the range if the slice cuts the last token.
    fn push_plain(&mut self, slice: Slice, range: Range<usize>) -> usize {
        scan::split_plain(slice.text, range, slice.is_cut, |token, item| match item {
            Item::Word => self.push_word(slice, token.start, token.end),
            Item::Number(value) => self.push_number(slice, token, value),
            Item::Byte(mark) => {
                self.push(Kind::Mark, u32::from(mark), slice.base + token.start);
            }
            Item::Mark => self.push_mark(slice, token.start, token.end),
        })
    }

    fn push_number(&mut self, slice: Slice, span: Range<usize>, value: Option<f64>) {
        let Range { start, end } = span;
        let index = offset(self.out.numbers.len());
        self.push(Kind::Number, index, slice.base + start);
        self.out.numbers.push(value.unwrap_or(0.0));
        if value.is_none() && self.faults.len() < MAX_FAULTS {
            let (start, end) = (offset(slice.base + start), offset(slice.base + end));
            let span = Span::new(self.out.file, start, end);
            self.faults.push(faults::bad_number(self.text, span));
        }
    }
}

/// A byte of the text, or a count of tokens in it. [`tokenize`] rejects texts that are longer.
fn offset(at: usize) -> u32 {
    u32::try_from(at).expect("texts are shorter than 4 GiB")
}

/// Skips blanks, for which pest gives no pair.
fn skip_blanks(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    start + rest.len() - rest.trim_start_matches(scan::is_blank).len()
}

/// True if a text begins with a number or `;`.
fn begins_number_or_semicolon(text: &[u8]) -> bool {
    match text {
        [b'.', digit, ..] | [digit, ..] if digit.is_ascii_digit() => true,
        _ => text.starts_with(b";"),
    }
}

/// True if `#` with this word is a directive. `#deprecated`, `#once` and `#append` are words that stand elsewhere.
fn is_directive(word: Word) -> bool {
    let is_of_class = word.class() == Class::Directive || word == Word::Default;
    is_of_class && !matches!(word, Word::Deprecated | Word::Once | Word::Append)
}
