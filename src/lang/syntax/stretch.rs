//! Long stretches of data in a text: their tokens are made piece by piece when reading gets there, and dropped behind it.
//!
//! Generated scenes and meshes are megabytes of numbers, read once from front to back. Their tokens would take several
//! times the memory of the text, and most of the time.

use super::lexer::tokenize_data;
use super::names::Names;
use super::token::{Kind, Part, Token, Tokens};
use crate::base::source::Diagnostic;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

/// Shorter stretches get their tokens at once.
const SHORTEST: usize = 1 << 15;

/// So many tokens before a stretch are looked at for parentheses.
const FARTHEST: usize = 1 << 16;

/// Whether a stretch or a piece may end here: behind a `}`, and behind the comma that follows a vector. No construct of
/// the language looks further than this without asking for the next token.
fn is_seam(text: &[u8], at: usize) -> bool {
    matches!(text.get(..at), Some([.., b'}'] | [.., b'>', b',']))
}

/// What of a range of plain text lies between its first and its last seam; `None` if that is not long.
pub(super) fn between_seams(text: &[u8], range: Range<usize>) -> Option<Range<usize>> {
    let start = first_seam(text, range.clone())?;
    let end = last_seam(text, start..range.end)?;
    (end - start >= SHORTEST).then_some(start..end)
}

/// Whether parentheses are open behind these tokens, as far as their last directive tells: the head of a directive and
/// the arguments of a macro are read as one.
pub(super) fn is_in_parentheses(tokens: &[Token]) -> bool {
    let mut depth = 0_i64;
    for token in tokens.iter().rev().take(FARTHEST) {
        if token.kind == Kind::Directive || depth > 0 {
            break;
        }
        depth += i64::from(token.is_mark('(')) - i64::from(token.is_mark(')'));
    }
    depth > 0
}

fn first_seam(text: &[u8], range: Range<usize>) -> Option<usize> {
    if is_seam(text, range.start) {
        return Some(range.start);
    }
    memchr::memchr2_iter(b'}', b',', &text[range.clone()])
        .map(|at| range.start + at + 1)
        .find(|&at| is_seam(text, at))
}

fn last_seam(text: &[u8], range: Range<usize>) -> Option<usize> {
    memchr::memrchr2_iter(b'}', b',', &text[range.clone()])
        .map(|at| range.start + at + 1)
        .find(|&at| is_seam(text, at))
}

impl Tokens {
    /// Whether these are the tokens of a piece of a stretch.
    #[must_use]
    #[inline]
    pub fn is_part(&self) -> bool {
        self.part.is_some()
    }

    /// The text that stands for the [`Kind::More`] at an index.
    #[must_use]
    pub fn more(&self, at: usize) -> Option<Range<u32>> {
        let token = self
            .tokens
            .get(at)
            .filter(|token| token.kind == Kind::More)?;
        self.stretches.get(token.value as usize).cloned()
    }
}

/// The tokens of a whole text, and the index of its [`Kind::More`] that the one at `at` belongs to.
fn home(tokens: &Rc<Tokens>, at: usize) -> (Rc<Tokens>, usize) {
    match &tokens.part {
        Some(part) => (Rc::clone(&part.whole), part.at),
        None => (Rc::clone(tokens), at),
    }
}

/// What reading goes on with at the [`Kind::More`] at `at`: the tokens of about `size` bytes, and an index among them.
/// With the numbers that have two points.
#[must_use]
pub fn tokenize_more(
    tokens: &Rc<Tokens>,
    at: usize,
    size: usize,
    names: &mut Names,
) -> (Rc<Tokens>, usize, Vec<Diagnostic>) {
    let (whole, index) = home(tokens, at);
    let rest = tokens.more(at).unwrap_or_default();
    if rest.is_empty() {
        return (whole, index + 1, Vec::new());
    }
    let text = Arc::clone(&whole.text);
    let range = rest.start as usize..rest.end as usize;
    let near = range.end.min(range.start + size);
    let end = last_seam(text.as_bytes(), range.start..near)
        .or_else(|| first_seam(text.as_bytes(), near..range.end))
        .unwrap_or(range.end);
    let (mut piece, faults) = tokenize_data(whole.file, &text, range.start..end, names);
    end_piece(&mut piece, whole, index, end, rest.end);
    (Rc::new(piece), 0, faults)
}

/// What reading goes on with behind the stretch of the [`Kind::More`] at `at`: tokens, and an index among them.
#[must_use]
pub fn behind_more(tokens: &Rc<Tokens>, at: usize) -> (Rc<Tokens>, usize) {
    let (whole, index) = home(tokens, at);
    (whole, index + 1)
}

/// What reading goes on with behind the byte before `from`, to which it has come within the [`Kind::More`] at `at`
/// without tokens: tokens of which the first is that byte, and the second a further [`Kind::More`].
#[must_use]
pub fn more_from(tokens: &Rc<Tokens>, at: usize, from: usize) -> Rc<Tokens> {
    let (whole, index) = home(tokens, at);
    let end = tokens.more(at).unwrap_or_default().end;
    let last = whole.text.as_bytes().get(from - 1).copied();
    let mut piece = Tokens {
        file: whole.file,
        tokens: vec![Token {
            kind: Kind::Mark,
            value: last.map_or(0, u32::from),
            start: offset(from - 1),
        }],
        numbers: Vec::new(),
        directives: Vec::new(),
        text: Arc::clone(&whole.text),
        strings: Vec::new(),
        stretches: Vec::new(),
        part: None,
    };
    end_piece(&mut piece, whole, index, from, end);
    Rc::new(piece)
}

/// Ends the tokens of a piece with what is left of its stretch.
fn end_piece(piece: &mut Tokens, whole: Rc<Tokens>, at: usize, start: usize, end: u32) {
    let start = offset(start);
    piece.tokens.push(Token {
        kind: Kind::More,
        value: 0,
        start,
    });
    piece.stretches.push(start..end);
    piece.part = Some(Part { whole, at });
}

fn offset(at: usize) -> u32 {
    u32::try_from(at).expect("texts are shorter than 4 GiB")
}
