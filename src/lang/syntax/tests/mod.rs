//! Tests of the lexer: single facts here, whole files in `corpus`, hostile texts in `hostile`.

mod by_hand;
mod corpus;
mod facts;
mod hostile;

use super::{Names, Tokens, tokenize};
use crate::base::source::{Diagnostic, FileId};
use std::sync::Arc;

/// The tokens of a text, and the names in it.
fn lex(text: &str) -> Result<(Tokens, Names), Vec<Diagnostic>> {
    let mut names = Names::new();
    let tokens = tokenize(FileId(0), &Arc::from(text.to_owned()), &mut names)?;
    Ok((tokens, names))
}

/// Each token as the text it stands for, without the end.
fn spellings(text: &str) -> Vec<String> {
    let (tokens, _) = lex(text).unwrap();
    let indices = 0..tokens.tokens.len() - 1;
    indices
        .map(|index| {
            let span = tokens.span(index);
            text[span.start as usize..span.end as usize].to_owned()
        })
        .collect()
}
