//! Decoding of files to text.

/// Decodes the bytes of a file; the flag is true if some of them were Latin-1.
///
/// UTF-8 stays as it is, without a byte-order mark at the start. A text that begins with a UTF-16 byte-order mark is
/// decoded as UTF-16. A byte that is not valid UTF-8 becomes the character with the same code, as in Latin-1, the
/// encoding of old scenes. So lines and columns (in characters) match those in an editor, and `°` and `ü` print as
/// intended; only byte offsets differ from those in the file. All spans count bytes of the decoded text.
pub(super) fn decode(bytes: Vec<u8>) -> (String, bool) {
    match bytes.as_slice() {
        [0xef, 0xbb, 0xbf, rest @ ..] => from_utf8_or_latin1(rest.to_vec()),
        [0xff, 0xfe, rest @ ..] => (from_utf16(rest, u16::from_le_bytes), false),
        [0xfe, 0xff, rest @ ..] => (from_utf16(rest, u16::from_be_bytes), false),
        _ => from_utf8_or_latin1(bytes),
    }
}

fn from_utf8_or_latin1(bytes: Vec<u8>) -> (String, bool) {
    let bytes = match String::from_utf8(bytes) {
        Ok(text) => return (text, false),
        Err(error) => error.into_bytes(),
    };
    let mut out = String::with_capacity(bytes.len() + bytes.len() / 8);
    for chunk in bytes.utf8_chunks() {
        out.push_str(chunk.valid());
        out.extend(chunk.invalid().iter().copied().map(char::from));
    }
    (out, true)
}

fn from_utf16(bytes: &[u8], unit: impl Fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units)
        .map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_decode_to_the_intended_characters() {
        for (bytes, text) in [
            (&b"plain"[..], "plain"),
            (b"\xef\xbb\xbfmarked", "marked"),
            ("grün".as_bytes(), "grün"),
            (b"gr\xfcn 45\xb0", "grün 45°"),
            (b"\xff\xfeg\0\xfc\0", "gü"),
            (b"\xfe\xff\0g\0\xfc\xd8\x00", "gü\u{fffd}"),
            (b"", ""),
        ] {
            let is_latin1 = bytes.contains(&0xb0);
            assert_eq!(decode(bytes.to_vec()), (text.to_owned(), is_latin1));
        }
    }
}
