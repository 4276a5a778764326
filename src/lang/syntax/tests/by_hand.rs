//! A second lexer, written by hand from the same description, for comparison.

use super::super::{Kind, Word};

/// A token of the second lexer.
#[derive(Debug, PartialEq)]
pub(super) struct Plain {
    pub(super) kind: Kind,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// The tokens of a text, and the position of the first text that cannot be tokenized.
pub(super) fn tokens(text: &str) -> (Vec<Plain>, Option<usize>) {
    let bytes = text.as_bytes();
    let mut out = Vec::new();
    let mut at = 0;
    loop {
        match skip_trivia(text, at) {
            Ok(next) => at = next,
            Err(open) => return (out, Some(open)),
        }
        let Some(letter) = text[at..].chars().next() else {
            return (out, None);
        };
        let next = bytes.get(at + 1).copied().unwrap_or(0);
        let (kind, end) = match letter {
            'a'..='z' | 'A'..='Z' | '_' => word(text, at),
            '0'..='9' => (Kind::Number, number(bytes, at)),
            '.' if next.is_ascii_digit() => (Kind::Number, number(bytes, at)),
            '<' if next == b'=' => (Kind::LessEqual, at + 2),
            '>' if next == b'=' => (Kind::GreaterEqual, at + 2),
            '!' if next == b'=' => (Kind::NotEqual, at + 2),
            '"' => match string(bytes, at) {
                Some(end) => (Kind::String, end),
                None => return (out, Some(at)),
            },
            '#' => match skip_trivia(text, at + 1) {
                Ok(head) => match directive(text, head) {
                    Some(end) => (Kind::Directive, end),
                    None => {
                        if is_judged_later(text, head) {
                            out.push(Plain {
                                kind: Kind::Directive,
                                start: at,
                                end: at + 1,
                            });
                        }
                        at = head;
                        continue;
                    }
                },
                Err(open) => return (out, Some(open)),
            },
            _ => (Kind::Mark, at + letter.len_utf8()),
        };
        out.push(Plain {
            kind,
            start: at,
            end,
        });
        at = end;
    }
}

fn word(text: &str, start: usize) -> (Kind, usize) {
    let rest = &text[start..];
    let is_end = |letter: char| !letter.is_ascii_alphanumeric() && letter != '_';
    let length = rest.find(is_end).unwrap_or(rest.len());
    let is_reserved = Word::from_spelling(&rest[..length]).is_some();
    let kind = if is_reserved { Kind::Word } else { Kind::Name };
    (kind, start + length)
}

/// The end of the directive whose word begins at `head`, if it is a directive.
fn directive(text: &str, head: usize) -> Option<usize> {
    let first = text[head..].chars().next()?;
    if !first.is_ascii_alphabetic() && first != '_' {
        return None;
    }
    let (_, end) = word(text, head);
    let is_directive = [
        "break",
        "case",
        "debug",
        "declare",
        "default",
        "else",
        "elseif",
        "end",
        "error",
        "fclose",
        "fopen",
        "for",
        "if",
        "ifdef",
        "ifndef",
        "include",
        "local",
        "macro",
        "range",
        "read",
        "render",
        "statistics",
        "switch",
        "undef",
        "version",
        "warning",
        "while",
        "write",
    ]
    .contains(&&text[head..end]);
    is_directive.then_some(end)
}

/// True if the reader has to decide about a `#` before this text: a name, a float or `;`.
fn is_judged_later(text: &str, at: usize) -> bool {
    let mut letters = text[at..].chars();
    match letters.next() {
        Some('a'..='z' | 'A'..='Z' | '_') => {
            let (_, end) = word(text, at);
            Word::from_spelling(&text[at..end]).is_none_or(Word::gives_float)
        }
        Some('0'..='9' | ';') => true,
        Some('.') => letters.next().is_some_and(|letter| letter.is_ascii_digit()),
        _ => false,
    }
}

fn number(bytes: &[u8], start: usize) -> usize {
    let mut at = start;
    let mut has_exponent = false;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'0'..=b'9' | b'.' => {}
            b'e' | b'E' if !has_exponent => {
                has_exponent = true;
                if matches!(bytes.get(at + 1), Some(b'+' | b'-')) {
                    at += 1;
                }
            }
            _ => break,
        }
        at += 1;
    }
    at
}

fn string(bytes: &[u8], start: usize) -> Option<usize> {
    let mut at = start + 1;
    loop {
        match bytes.get(at)? {
            b'"' => return Some(at + 1),
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
}

/// The start of the next token, or of a comment that is not closed.
fn skip_trivia(text: &str, start: usize) -> Result<usize, usize> {
    let bytes = text.as_bytes();
    let mut at = start;
    while let Some(letter) = text[at..].chars().next() {
        match letter {
            ' ' | '\t'..='\r' | '\0' | '\x1a' | '\u{feff}' => at += letter.len_utf8(),
            '/' if bytes[at..].starts_with(b"//") => {
                let rest = &text[at..];
                at += rest.find(['\n', '\r']).unwrap_or(rest.len());
            }
            '/' if bytes[at..].starts_with(b"/*") => {
                let open = at;
                let mut depth = 0_usize;
                loop {
                    match bytes.get(at..at + 2) {
                        None => return Err(open),
                        Some(b"/*") => depth += 1,
                        Some(b"*/") => depth -= 1,
                        Some(_) => {
                            at += 1;
                            continue;
                        }
                    }
                    at += 2;
                    if depth == 0 {
                        break;
                    }
                }
            }
            _ => break,
        }
    }
    Ok(at)
}
