//! Links the directives of each group: `#if` with its `#else` and `#end`, a loop or a macro with its `#end`.
//!
//! Groups need not balance within a file: an `#end` without an opener stays alone, and the end of a group that the file
//! does not close is [`END_OF_FILE`]. The cursor decides what that means when it gets there.

use super::token::{Directive, END_OF_FILE, Kind, Tokens};
use crate::base::word::Word;

/// A group that is still open.
struct Open {
    opener: Word,
    /// Index of its first directive.
    first: usize,
    /// Index of its latest part.
    last: usize,
}

/// Fills `next` and `end` of all directives, in one pass.
pub(super) fn link(tokens: &mut Tokens) {
    let mut open: Vec<Open> = Vec::new();
    let directives = &mut tokens.directives;
    let indices = (0_u32..).zip(&tokens.tokens);
    for (index, token) in indices.filter(|(_, token)| token.kind == Kind::Directive) {
        let at = token.value as usize;
        let Some(word) = directives[at].word else {
            continue;
        };
        match word {
            Word::If
            | Word::Ifdef
            | Word::Ifndef
            | Word::Switch
            | Word::While
            | Word::For
            | Word::Macro => {
                open.push(Open {
                    opener: word,
                    first: at,
                    last: at,
                });
            }
            Word::End => {
                directives[at].end = END_OF_FILE;
                if let Some(group) = open.pop() {
                    directives[group.last].next = index;
                    directives[at].end = index;
                    close(directives, &tokens.tokens, &group, index);
                }
            }
            _ => {
                if let Some(group) = open.last_mut().filter(|group| is_part(word, group.opener)) {
                    directives[group.last].next = index;
                    group.last = at;
                }
            }
        }
    }
}

/// True if a directive is a part of the group that `opener` begins.
fn is_part(word: Word, opener: Word) -> bool {
    match opener {
        Word::If | Word::Ifdef | Word::Ifndef => matches!(word, Word::Else | Word::Elseif),
        Word::Switch => matches!(word, Word::Case | Word::Range | Word::Else),
        _ => false,
    }
}

/// Sets the `end` of every part of a group.
fn close(directives: &mut [Directive], tokens: &[super::Token], group: &Open, end: u32) {
    let mut at = group.first;
    loop {
        directives[at].end = end;
        if at == group.last {
            return;
        }
        at = tokens[directives[at].next as usize].value as usize;
    }
}
