//! Messages about text that cannot be tokenized.

use super::token::Tokens;
use crate::base::source::{Diagnostic, FileId, Fix, Span};

/// The error for the text at `at`, which cannot be tokenized: a string or a comment that is not closed. `before` holds
/// the tokens before it.
pub(super) fn unclosed(before: &Tokens, at: usize) -> Diagnostic {
    match &before.text.as_bytes()[at..] {
        [b'/', b'*', ..] => unclosed_comment(&before.text, before.file, at),
        [b'"', ..] => unclosed_string(before, at),
        // pest gives up where the stack is all but used up, whatever the text is.
        _ => {
            let span = Span::new(before.file, offset(at), offset(line_end(&before.text, at)));
            Diagnostic::error(span, "too deep within macros and includes to read on here")
        }
    }
}

/// A number with two points.
pub(super) fn bad_number(text: &str, span: Span) -> Diagnostic {
    let number = &text[span.start as usize..span.end as usize];
    let error = Diagnostic::error(span, format!("`{number}` has two decimal points"));
    let before = text[..span.start as usize].trim_end();
    if before.ends_with(" in") {
        return error.with_hint("A loop over numbers is `#for (I, first, last)`.");
    }
    if number.contains(['e', 'E']) {
        return error.with_hint("An exponent is a whole number; `pow(10, x)` takes others.");
    }
    match number.split_once("..") {
        Some((before, after)) if !before.contains('.') && !after.contains('.') => {
            error.with_hint(format!("Write `{before}.{after}`."))
        }
        _ => error.with_hint("Write a comma or a space between two numbers."),
    }
}

/// A missing quote turns all later strings inside out, and the last quote of the text is the unmatched one. So the
/// first string that spans lines is the likely fault.
fn unclosed_string(before: &Tokens, at: usize) -> Diagnostic {
    let (text, file) = (&before.text, before.file);
    let span = Span::new(file, offset(at), offset(line_end(text, at)));
    let mut error = Diagnostic::error(span, "no closing quote for this string");
    let spans_lines = |range: &&std::ops::Range<u32>| {
        text[range.start as usize..range.end as usize].contains(['\n', '\r'])
    };
    if let Some(range) = before.strings.iter().find(spans_lines) {
        let start = range.start as usize - 1;
        let first_line = Span::new(file, offset(start), offset(line_end(text, start)));
        error = Diagnostic::error(first_line, "this string is not closed in its line")
            .with_label(
                Span::new(file, range.end, range.end + 1),
                "it ends only here",
            )
            .with_label(span, "so that this one has no end")
            .with_hint("Write `\"` at the end of the string.");
    } else {
        let word = text[..at].rsplit(char::is_whitespace).next();
        let word = word.unwrap_or_default();
        let start = at - word.len();
        let is_end = text[at + 1..line_end(text, at)].trim().is_empty();
        error = match is_end && word.contains('.') {
            true => {
                let name = Span::new(file, offset(start), offset(at + 1));
                let string = format!("\"{word}\"");
                let fix = Fix {
                    span: name,
                    text: string.clone(),
                };
                error.with_fix(format!("A string begins with `\"`, too: `{string}`."), fix)
            }
            false => error.with_hint("Write `\"` at the end of the string."),
        };
    }
    error
}

/// Comments nest, so the outermost one stays open, mostly because of an inner `/*` without its `*/`.
fn unclosed_comment(text: &str, file: FileId, at: usize) -> Diagnostic {
    let mark = |start: usize| Span::new(file, offset(start), offset(start + 2));
    let mut error = Diagnostic::error(mark(at), "no `*/` for this comment");
    if let Some(&innermost) = open_comments(text.as_bytes(), at)
        .last()
        .filter(|&&last| last > at)
    {
        error = error
            .with_label(
                mark(innermost),
                "comments nest, and this one is open as well",
            )
            .with_hint("Each `/*` needs a `*/` of its own.");
    } else if let Some(inner) = text[at + 2..line_end(text, at)].find("/*") {
        error = error
            .with_label(
                mark(at + 2 + inner),
                "comments nest: this opens another one",
            )
            .with_hint("Each `/*` needs a `*/` of its own.");
    } else {
        error = error.with_hint("Write `*/` at the end of the comment.");
    }
    error
}

/// The starts of the comments that are open at the end of the text, outermost first.
fn open_comments(text: &[u8], start: usize) -> Vec<usize> {
    let mut open = Vec::new();
    let mut at = start;
    while at + 1 < text.len() {
        match &text[at..at + 2] {
            b"/*" => open.push(at),
            b"*/" => drop(open.pop()),
            _ => {
                at += 1;
                continue;
            }
        }
        at += 2;
    }
    open
}

fn line_end(text: &str, start: usize) -> usize {
    text[start..]
        .find(['\n', '\r'])
        .map_or(text.len(), |length| start + length)
}

fn offset(at: usize) -> u32 {
    u32::try_from(at).expect("texts are shorter than 4 GiB")
}
