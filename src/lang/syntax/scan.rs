//! The ends of tokens, and the tokens of plain text, which holds no comment, string or directive.

use std::ops::Range;

/// True if a byte may begin a word.
pub(super) fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

/// True for characters that separate tokens and have no meaning.
pub(super) fn is_blank(letter: char) -> bool {
    matches!(letter, ' ' | '\t'..='\r' | '\0' | '\u{1a}' | '\u{feff}')
}

/// The end of the letters, digits and `_` that begin at `start`.
#[inline]
pub(crate) fn word_end(text: &[u8], start: usize) -> usize {
    end_of(text, start, |byte| {
        matches!(BEGINS[usize::from(byte)], Begins::Word | Begins::Number) && byte != b'.'
    })
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

/// The powers of ten that `f64` represents exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Bytes of a number whose digits fit into 64 bits, the point included.
const SHORT: usize = 19;

/// The value of the number that begins at `start`, and its end, which is `start` where none does. The value is the
/// nearest `f64`, infinite where it overflows, and `None` for a number with a second point. An exponent without digits
/// is ignored: `1e` and `1e+` are 1.
#[inline]
#[must_use]
pub fn number(text: &[u8], start: usize) -> (Option<f64>, usize) {
    let digits = |mut at: usize, mut sum: u64| {
        while let Some(digit) = text
            .get(at)
            .map(|byte| byte.wrapping_sub(b'0'))
            .filter(|digit| *digit < 10)
        {
            sum = sum.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        (at, sum)
    };
    let (mut end, mut sum) = digits(start, 0);
    let mut decimals = 0;
    let mut count = end - start;
    if text.get(end) == Some(&b'.') {
        let point = end;
        (end, sum) = digits(point + 1, sum);
        decimals = end - point - 1;
        count += decimals;
    }
    let is_simple = !matches!(text.get(end), Some(b'.' | b'e' | b'E'));
    if is_simple && count > 0 && end - start <= SHORT && sum <= 1 << 53 {
        // Both are exact, so the quotient is the nearest float.
        #[allow(clippy::cast_precision_loss, reason = "at most 2^53")]
        return (Some(sum as f64 / TENS[decimals]), end);
    }
    long_number(text, start)
}

#[cold]
fn long_number(text: &[u8], start: usize) -> (Option<f64>, usize) {
    let end = number_end(text, start);
    let number = text
        .get(start..end)
        .and_then(|number| std::str::from_utf8(number).ok());
    let number = number.unwrap_or_default().trim_end_matches(['+', '-']);
    let value = number.strip_suffix(['e', 'E']).unwrap_or(number).parse();
    (value.ok(), end)
}

/// A token of plain text.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Item {
    /// A reserved word or an identifier.
    Word,
    /// A number with its value, `None` if a second point stands in it.
    Number(Option<f64>),
    /// A mark of one byte.
    Byte(u8),
    /// A comparison, or a character that is not ASCII.
    Mark,
}

/// The kind of token that a byte of plain text begins.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Begins {
    Blank,
    Number,
    Word,
    /// A mark that `=` may follow.
    Comparison,
    Mark,
    /// A character of several bytes.
    Letter,
}

/// [`Begins`] for each byte.
const BEGINS: [Begins; 256] = begins();

const fn begins() -> [Begins; 256] {
    let mut table = [Begins::Mark; 256];
    let mut byte = 0_u8;
    loop {
        table[byte as usize] = match byte {
            b' ' | b'\t'..=b'\r' | 0 | 0x1a => Begins::Blank,
            b'0'..=b'9' | b'.' => Begins::Number,
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => Begins::Word,
            b'<' | b'>' | b'!' => Begins::Comparison,
            0x80.. => Begins::Letter,
            _ => Begins::Mark,
        };
        if byte == u8::MAX {
            return table;
        }
        byte += 1;
    }
}

/// Splits a range of the text in which no comment, string or directive begins, and passes each token with its range to
/// `take`. Ends at the end of the range, or before a token that reaches the end of the text and might go on after it
/// (`is_cut`). Returns where it ended.
pub(super) fn split_plain(
    text: &str,
    range: Range<usize>,
    is_cut: bool,
    mut take: impl FnMut(Range<usize>, Item),
) -> usize {
    let bytes = text.as_bytes();
    let range = range.start..range.end.min(bytes.len());
    let mut at = range.start;
    while at < range.end {
        let byte = bytes[at];
        let (item, end) = match BEGINS[usize::from(byte)] {
            Begins::Blank => {
                at += 1;
                continue;
            }
            Begins::Mark => (Item::Byte(byte), at + 1),
            Begins::Number => match number(bytes, at) {
                (_, end) if end == at => (Item::Byte(byte), at + 1),
                (value, end) => (Item::Number(value), end),
            },
            Begins::Comparison if bytes.get(at + 1) == Some(&b'=') => (Item::Mark, at + 2),
            Begins::Comparison => (Item::Byte(byte), at + 1),
            Begins::Word => (Item::Word, word_end(bytes, at)),
            Begins::Letter => {
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
            ("9007199254740993", Some(9_007_199_254_740_992.0)),
            ("9007199254740993.0", Some(9_007_199_254_740_992.0)),
            ("0.000000000000000001", Some(1e-18)),
            ("12345678901234567890123", Some(1.234_567_890_123_456_8e22)),
        ] {
            let found = number(text.as_bytes(), 0);
            assert_eq!(found, (value, text.len()), "{text}");
        }
        for none in ["", ".", "x", "-1"] {
            assert_eq!(number(none.as_bytes(), 0).1, 0, "{none}");
        }
    }

    #[test]
    fn short_numbers_are_rounded_as_by_the_standard_library() {
        let mut random = 88_172_645_463_325_252_u64;
        for _ in 0..20_000 {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            let digits = format!("{}", random >> (random % 50));
            let point = usize::try_from(random % 19).unwrap().min(digits.len());
            let text = format!("{}.{}", &digits[..point], &digits[point..]);
            let value: Result<f64, _> = text.parse();
            let found = number(text.as_bytes(), 0).0;
            assert_eq!(found, value.ok(), "{text}");
        }
    }
}
