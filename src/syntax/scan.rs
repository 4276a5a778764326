//! Where a token ends, and the tokens of plain text: of what pest has found to hold no comment, string or directive.

use std::ops::Range;

/// Whether a byte may begin a word.
pub(super) fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

/// Whether this character may stand between tokens and means nothing.
pub(super) fn is_blank(letter: char) -> bool {
    matches!(letter, ' ' | '\t'..='\r' | '\0' | '\u{1a}' | '\u{feff}')
}

/// The end of the letters, digits and `_` that begin at `start`.
pub(super) fn word_end(text: &[u8], start: usize) -> usize {
    end_of(text, start, |byte| is_letter(byte) || byte.is_ascii_digit())
}

/// The end of the number that begins at `start`; `start` itself where none does.
pub(super) fn number_end(text: &[u8], start: usize) -> usize {
    let is_part = |byte: u8| byte.is_ascii_digit() || byte == b'.';
    let first = start + usize::from(text.get(start) == Some(&b'.'));
    if !text.get(first).is_some_and(u8::is_ascii_digit) {
        return start;
    }
    let end = end_of(text, first, is_part);
    if !matches!(text.get(end), Some(b'e' | b'E')) {
        return end;
    }
    let sign = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
    end_of(text, end + 1 + sign, is_part)
}

/// The end of the string whose first quote stands at `start`.
pub(super) fn string_end(text: &[u8], start: usize) -> usize {
    let mut at = start + 1;
    loop {
        match text.get(at) {
            None => return text.len(),
            Some(b'"') => return at + 1,
            Some(b'\\') => at += 2,
            Some(_) => at += 1,
        }
    }
}

fn end_of(text: &[u8], start: usize, is_part: impl Fn(u8) -> bool) -> usize {
    let tail = text.get(start..).unwrap_or_default();
    start + tail.iter().take_while(|&&byte| is_part(byte)).count()
}

/// The value of a number, infinite where it is too large for an `f64`; `None` if a second point stands in it.
/// An exponent without digits counts as none: `1e` and `1e+` are 1.
pub(super) fn number_value(number: &str) -> Option<f64> {
    let digits = number.as_bytes();
    if digits.len() <= 9 && digits.iter().all(u8::is_ascii_digit) {
        let whole = digits
            .iter()
            .fold(0, |sum: u32, &digit| sum * 10 + u32::from(digit - b'0'));
        return Some(f64::from(whole));
    }
    let number = number.trim_end_matches(['+', '-']);
    number
        .strip_suffix(['e', 'E'])
        .unwrap_or(number)
        .parse()
        .ok()
}

/// A token of plain text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Item {
    /// A reserved word or an identifier.
    Word,
    /// A number.
    Number,
    /// A mark, a comparison, or any other character.
    Mark,
}

/// Splits a range of the text in which no comment, string or directive begins, and gives each token with its place to
/// `take`. Ends at the end of the range, or before a token that reaches the end of the text and might go on behind it
/// (`is_cut`). Gives where it ended.
pub(super) fn split_plain(
    text: &str,
    range: Range<usize>,
    is_cut: bool,
    mut take: impl FnMut(Range<usize>, Item),
) -> usize {
    let bytes = text.as_bytes();
    let mut at = range.start;
    while at < range.end {
        let (item, end) = match bytes[at] {
            b' ' | b'\t'..=b'\r' | 0 | 0x1a => {
                at += 1;
                continue;
            }
            b'0'..=b'9' => (Item::Number, number_end(bytes, at)),
            b'.' => match number_end(bytes, at) {
                end if end == at => (Item::Mark, at + 1),
                end => (Item::Number, end),
            },
            b'<' | b'>' | b'!' => (
                Item::Mark,
                at + 1 + usize::from(bytes.get(at + 1) == Some(&b'=')),
            ),
            byte if is_letter(byte) => (Item::Word, word_end(bytes, at)),
            byte if byte.is_ascii() => (Item::Mark, at + 1),
            _ => {
                let letter = text[at..].chars().next().unwrap_or_default();
                if is_blank(letter) {
                    at += letter.len_utf8();
                    continue;
                }
                (Item::Mark, at + letter.len_utf8())
            }
        };
        if is_cut && end == text.len() {
            break;
        }
        take(at..end, item);
        at = end;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_the_language_ends_them() {
        for (text, end) in [
            ("5.", 2),
            (".5e2", 4),
            ("1e", 2),
            ("1e+", 3),
            ("2pi", 1),
            ("1.5.2,", 5),
            (".", 0),
            ("..5", 0),
            ("x", 0),
            ("", 0),
        ] {
            assert_eq!(number_end(text.as_bytes(), 0), end, "{text}");
        }
    }

    #[test]
    fn numbers_have_the_nearest_value() {
        for (text, value) in [
            ("5.", Some(5.0)),
            (".5e2", Some(50.0)),
            ("1e", Some(1.0)),
            ("1e+", Some(1.0)),
            ("1E-2", Some(0.01)),
            ("0.1", Some(0.1)),
            ("4294967296", Some(4_294_967_296.0)),
            ("999999999", Some(999_999_999.0)),
            ("1e999", Some(f64::INFINITY)),
            ("1.5.2", None),
            ("1..2", None),
            ("1e2.5", None),
        ] {
            assert_eq!(number_value(text), value, "{text}");
        }
    }
}
