//! The scenes and includes that come with POV-Ray, where they are installed.

use super::super::{Kind, Word};
use super::{by_hand, lex};
use std::fs;
use std::path::{Path, PathBuf};

const FOLDERS: [&str; 3] = [
    "/usr/share/povray-3.7",
    "/usr/share/doc/povray",
    "/usr/share/doc/povray-examples",
];

/// Asserts that both lexers make the same tokens, or both stop at the same position.
pub(super) fn assert_same_tokens(text: &str, name: &str) {
    let (expected, stop) = by_hand::tokens(text);
    let (tokens, names) = match lex(text) {
        Ok(lexed) => lexed,
        Err(faults) => {
            let is_number =
                |fault: &crate::base::source::Diagnostic| fault.message.contains("decimal");
            let open = faults.iter().find(|fault| !is_number(fault));
            // A string without an end is reported beside the string that is probably at fault.
            let last = open.and_then(|fault| fault.labels.last());
            let unended = last.filter(|label| label.text.contains("no end"));
            let open = unended
                .map(|label| label.span)
                .or(open.and_then(|fault| fault.span))
                .map(|span| span.start as usize);
            assert!(
                open == stop || faults.len() >= 20,
                "{name}: {faults:?}, by hand {stop:?}"
            );
            return;
        }
    };
    assert_eq!(stop, None, "{name}: by hand a token is not closed");
    assert_eq!(
        tokens.tokens.len(),
        expected.len() + 1,
        "{name}: number of tokens"
    );
    for (index, (token, plain)) in tokens.tokens.iter().zip(&expected).enumerate() {
        let span = tokens.span(index);
        let found = by_hand::Plain {
            kind: token.kind,
            start: span.start as usize,
            end: span.end as usize,
        };
        assert_eq!(&found, plain, "{name}: token {index}");
        let written = &text[plain.start..plain.end];
        match token.kind {
            Kind::Number => {
                let number = written.trim_end_matches(['+', '-', 'e', 'E']);
                let value: f64 = number.parse().unwrap();
                assert_eq!(
                    tokens.numbers[token.value as usize].to_bits(),
                    value.to_bits()
                );
            }
            Kind::Word => assert_eq!(token.word(), Word::from_spelling(written)),
            Kind::Name => assert_eq!(names.spelling(token.symbol().unwrap()), written),
            Kind::Mark => assert_eq!(char::from_u32(token.value), written.chars().next()),
            _ => {}
        }
    }
}

fn scenes(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        if path.is_dir() {
            scenes(&path, found);
        } else if path
            .extension()
            .is_some_and(|end| end == "pov" || end == "inc" || end == "map")
        {
            found.push(path);
        }
    }
}

#[test]
#[allow(clippy::print_stderr, reason = "tells why nothing was tested")]
fn the_scenes_of_povray_are_read_as_by_hand() {
    let mut found = Vec::new();
    for folder in FOLDERS {
        scenes(Path::new(folder), &mut found);
    }
    if found.is_empty() {
        eprintln!("skipped: none of {FOLDERS:?} holds a scene");
        return;
    }
    for path in found {
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        let name = path.display().to_string();
        assert!(lex(&text).is_ok(), "{name}");
        assert_same_tokens(&text, &name);
    }
}
