//! Points at which a long text may be tokenized in pieces.

use super::token::{Kind, Token};
use std::ops::Range;

/// Shorter segments are tokenized at once.
pub(crate) const MIN_SEGMENT: usize = 1 << 15;

/// Tokens before a segment that are searched for open parentheses.
pub(crate) const MAX_LOOKBACK: usize = 1 << 16;

/// True if a segment or a piece may end here: after a `}`, and after the comma that follows a vector. No construct of
/// the language peeks further than this without asking for the next token.
pub(crate) fn is_split_point(text: &[u8], at: usize) -> bool {
    matches!(text.get(..at), Some([.., b'}'] | [.., b'>', b',']))
}

/// The part of a range of plain text between its first and its last split point; `None` if that is short.
pub(crate) fn between_split_points(text: &[u8], range: Range<usize>) -> Option<Range<usize>> {
    let start = first_split_point(text, range.clone())?;
    let end = last_split_point(text, start..range.end)?;
    (end - start >= MIN_SEGMENT).then_some(start..end)
}

/// True if parentheses are open after these tokens, counted from the last directive: the head of a directive and the
/// arguments of a macro are read in one go.
pub(crate) fn is_in_parentheses(tokens: &[Token]) -> bool {
    let mut depth = 0_i64;
    for token in tokens.iter().rev().take(MAX_LOOKBACK) {
        if token.kind == Kind::Directive || depth > 0 {
            break;
        }
        depth += i64::from(token.is_mark('(')) - i64::from(token.is_mark(')'));
    }
    depth > 0
}

pub(crate) fn first_split_point(text: &[u8], range: Range<usize>) -> Option<usize> {
    if is_split_point(text, range.start) {
        return Some(range.start);
    }
    memchr::memchr2_iter(b'}', b',', &text[range.clone()])
        .map(|at| range.start + at + 1)
        .find(|&at| is_split_point(text, at))
}

pub(crate) fn last_split_point(text: &[u8], range: Range<usize>) -> Option<usize> {
    memchr::memrchr2_iter(b'}', b',', &text[range.clone()])
        .map(|at| range.start + at + 1)
        .find(|&at| is_split_point(text, at))
}
