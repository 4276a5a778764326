//! Long data segments of a text: they are tokenized piece by piece when reading gets there, and their tokens dropped
//! after it.
//!
//! Generated scenes and meshes are megabytes of numbers, read once from front to back. Their tokens would take several
//! times the memory of the text, and most of the time.

use super::lexer::tokenize_data;
use super::names::Names;
use super::split_points::{first_split_point, last_split_point};
use super::token::{Kind, Part, Token, Tokens};
use crate::base::source::Diagnostic;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

impl Tokens {
    /// True if these are the tokens of a piece of a segment.
    #[must_use]
    #[inline]
    pub fn is_part(&self) -> bool {
        self.part.is_some()
    }

    /// The range of the text that the [`Kind::DataSegment`] at an index stands for.
    #[must_use]
    pub fn data_segment(&self, at: usize) -> Option<Range<u32>> {
        let token = self
            .tokens
            .get(at)
            .filter(|token| token.kind == Kind::DataSegment)?;
        self.segments.get(token.value as usize).cloned()
    }
}

/// The tokens of a whole text, and the index of its [`Kind::DataSegment`] that the one at `at` belongs to.
fn home(tokens: &Rc<Tokens>, at: usize) -> (Rc<Tokens>, usize) {
    match &tokens.part {
        Some(part) => (Rc::clone(&part.whole), part.at),
        None => (Rc::clone(tokens), at),
    }
}

/// Tokenizes about `size` bytes of the [`Kind::DataSegment`] at `at`; returns the tokens, the index among them where reading
/// goes on, and the numbers with two points.
#[must_use]
pub fn tokenize_more(
    tokens: &Rc<Tokens>,
    at: usize,
    size: usize,
    names: &mut Names,
) -> (Rc<Tokens>, usize, Vec<Diagnostic>) {
    let (whole, index) = home(tokens, at);
    let rest = tokens.data_segment(at).unwrap_or_default();
    if rest.is_empty() {
        return (whole, index + 1, Vec::new());
    }
    let text = Arc::clone(&whole.text);
    let range = rest.start as usize..rest.end as usize;
    let near = range.end.min(range.start + size);
    let end = last_split_point(text.as_bytes(), range.start..near)
        .or_else(|| first_split_point(text.as_bytes(), near..range.end))
        .unwrap_or(range.end);
    let (mut piece, faults) = tokenize_data(whole.file, &text, range.start..end, names);
    end_piece(&mut piece, whole, index, end, rest.end);
    (Rc::new(piece), 0, faults)
}

/// The tokens after the segment of the [`Kind::DataSegment`] at `at`, and the index among them where reading goes on.
#[must_use]
pub fn after_more(tokens: &Rc<Tokens>, at: usize) -> (Rc<Tokens>, usize) {
    let (whole, index) = home(tokens, at);
    (whole, index + 1)
}

/// The tokens to go on with after the text of the [`Kind::DataSegment`] at `at` was parsed up to `from` without tokens: the
/// first token is the byte before `from`, and the second another [`Kind::DataSegment`].
#[must_use]
pub fn more_from(tokens: &Rc<Tokens>, at: usize, from: usize) -> Rc<Tokens> {
    let (whole, index) = home(tokens, at);
    let end = tokens.data_segment(at).unwrap_or_default().end;
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
        segments: Vec::new(),
        part: None,
    };
    end_piece(&mut piece, whole, index, from, end);
    Rc::new(piece)
}

/// Ends the tokens of a piece with the rest of its segment.
fn end_piece(piece: &mut Tokens, whole: Rc<Tokens>, at: usize, start: usize, end: u32) {
    let start = offset(start);
    piece.tokens.push(Token {
        kind: Kind::DataSegment,
        value: 0,
        start,
    });
    piece.segments.push(start..end);
    piece.part = Some(Part { whole, at });
}

fn offset(at: usize) -> u32 {
    u32::try_from(at).expect("texts are shorter than 4 GiB")
}
