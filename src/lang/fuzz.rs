//! Soup of tokens from good scenes: reading it ends, with findings or without, and never in a panic.

use super::evaluate;
use crate::options::ReadOptions;
use crate::source::Sources;
use std::fs;
use std::path::{Path, PathBuf};

/// How many soups are read, in about half a minute of an unoptimised build.
const SOUPS: u64 = 20_000;
/// Tokens of one soup at most. Longer ones find nothing new: reading gives up after some errors.
const TOKENS: usize = 120;

/// A generator of Marsaglia's (Xorshift RNGs, 2003), so that a failure can be had again by its number.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).expect("31 bits fit") % end
    }
}

fn scenes(folder: &Path, to: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the project's scenes are there")
        .map(|entry| entry.expect("a folder can be read").path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            scenes(&path, to);
        } else if path.extension().is_some_and(|ending| ending == "pov") {
            to.push(path);
        }
    }
}

/// The words, numbers, strings and marks of all scenes, in order.
fn tokens(texts: &[String]) -> Vec<&str> {
    let class = |c: char| match c {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '_' | '.' | '#' => 1,
        c if c.is_whitespace() => 2,
        _ => 0,
    };
    let mut tokens = Vec::new();
    for line in texts.iter().flat_map(|text| text.lines()) {
        let mut rest = line.split("//").next().unwrap_or_default();
        while let Some(first) = rest.chars().next() {
            let end = match class(first) {
                0 => first.len_utf8(),
                kind => rest.find(|c| class(c) != kind).unwrap_or(rest.len()),
            };
            if class(first) != 2 {
                tokens.push(&rest[..end]);
            }
            rest = &rest[end..];
        }
    }
    tokens
}

/// A stretch of a scene with some tokens taken out, doubled, or put in from elsewhere.
fn soup(random: &mut Random, tokens: &[&str]) -> String {
    let start = random.below(tokens.len());
    let end = (start + 1 + random.below(TOKENS)).min(tokens.len());
    let mut soup = tokens[start..end].to_vec();
    for _ in 0..random.below(8) {
        let at = random.below(soup.len());
        let other = tokens[random.below(tokens.len())];
        match random.below(4) {
            0 => soup[at] = other,
            1 => soup.insert(at, other),
            2 => soup.insert(at, soup[at]),
            _ if soup.len() > 1 => drop(soup.remove(at)),
            _ => {}
        }
    }
    soup.join(" ")
}

#[test]
fn soup_of_tokens_is_read_to_an_end() {
    let mut paths = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    scenes(&root.join("pov_scenes"), &mut paths);
    let texts: Vec<String> = paths
        .iter()
        .map(|path| {
            let bytes = fs::read(path).expect("a scene can be read");
            String::from_utf8_lossy(&bytes).into_owned()
        })
        .collect();
    let tokens = tokens(&texts);
    assert!(tokens.len() > 1_000);
    let mut read = 0;
    for number in 1..=SOUPS {
        let mut random = Random(number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let text = soup(&mut random, &tokens);
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("soup", &text);
        let reading = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            evaluate(file, &mut sources, &ReadOptions::default())
        }));
        let Ok(reading) = reading else {
            panic!("soup {number} ends in a panic:\n{text}");
        };
        let has_error = reading
            .findings
            .iter()
            .any(|finding| finding.severity == crate::source::Severity::Error);
        assert_ne!(reading.scene.is_some(), has_error, "soup {number}:\n{text}");
        read += usize::from(reading.scene.is_some());
    }
    assert!(read > 0, "some soups are scenes");
}
