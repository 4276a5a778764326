//! One word of a command line or an ini file: a switch, `Key=Value`, a scene, or an ini file.

use std::ops::Range;

use super::error::CliError;
use super::ini::Reader;
use super::values::unquoted;
use super::{keys, switches};

/// Takes in a word.
pub(super) fn read(reader: &mut Reader<'_>, word: &str) -> Result<(), CliError> {
    if word == "-" {
        reader.typed.scene = Some("-".to_owned());
        return Ok(());
    }
    if let Some((key, value)) = assignment(word) {
        return set(reader, key, unquoted(value), word);
    }
    if let Some(done) = switches::set(reader.typed, word) {
        return done;
    }
    let name = unquoted(word);
    if has_ending(name, ".pov") {
        reader.typed.scene = Some(name.to_owned());
        Ok(())
    } else if name.starts_with(['+', '-']) && !has_ending(name, ".ini") {
        Err(CliError::new(format!("unknown switch `{word}`"))
            .with_hint("`povr --help` tells which switches there are"))
    } else {
        reader.read_named(name)
    }
}

/// Sets an option; `Include_Ini` is no option but a file to read on the spot.
pub(super) fn set(
    reader: &mut Reader<'_>,
    key: &str,
    value: &str,
    said: &str,
) -> Result<(), CliError> {
    if key.eq_ignore_ascii_case("Include_Ini") {
        reader.read_named(value)
    } else {
        keys::set(reader.typed, key, value, said.trim())
    }
}

/// `Key=Value`, with or without spaces around the sign.
pub(super) fn assignment(text: &str) -> Option<(&str, &str)> {
    let (key, value) = text.split_once('=')?;
    let key = key.trim();
    let is_key = key.starts_with(|c: char| c.is_ascii_alphabetic())
        && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    is_key.then_some((key, value.trim()))
}

/// The words of an argument. An argument may hold several switches (`"+W320 +H240"`), but a space in a file name
/// belongs to the name: a new word begins with a sign and a letter, or is an assignment.
pub(super) fn of_argument(argument: &str) -> Vec<String> {
    if assignment(argument).is_some() {
        return vec![argument.trim().to_owned()];
    }
    let mut words: Vec<Range<usize>> = Vec::new();
    for piece in pieces(argument) {
        let text = &argument[piece.clone()];
        let begins = assignment(text).is_some()
            || text
                .strip_prefix(['+', '-'])
                .is_some_and(|t| t.starts_with(|c: char| c.is_ascii_alphabetic()));
        match words.last_mut() {
            Some(word) if !begins => word.end = piece.end,
            _ => words.push(piece),
        }
    }
    words.into_iter().map(|w| argument[w].to_owned()).collect()
}

/// The words of a line of an ini file, where only quotes keep a space.
pub(super) fn of_line(line: &str) -> Vec<String> {
    pieces(line)
        .into_iter()
        .map(|piece| line[piece].to_owned())
        .collect()
}

pub(super) fn has_ending(name: &str, ending: &str) -> bool {
    name.len()
        .checked_sub(ending.len())
        .and_then(|at| name.get(at..))
        .is_some_and(|end| end.eq_ignore_ascii_case(ending))
}

/// What stands between white space that is not in quotes.
fn pieces(text: &str) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let mut start = None;
    let mut is_quoted = false;
    for (at, c) in text.char_indices() {
        is_quoted ^= c == '"';
        if is_quoted || !c.is_whitespace() {
            start.get_or_insert(at);
        } else if let Some(start) = start.take() {
            pieces.push(start..at);
        }
    }
    pieces.extend(start.map(|start| start..text.len()));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_argument_may_hold_several_switches_and_names_with_spaces() {
        for (argument, expected) in [
            ("+W9 +H8", vec!["+W9", "+H8"]),
            ("+Ia  b.pov", vec!["+Ia  b.pov"]),
            ("+I\"a +b.pov\" +W9", vec!["+I\"a +b.pov\"", "+W9"]),
            ("my scene - copy.pov", vec!["my scene - copy.pov"]),
            ("+A Width=3", vec!["+A", "Width=3"]),
            ("Input_File_Name=a b.pov", vec!["Input_File_Name=a b.pov"]),
            ("+A ", vec!["+A"]),
            ("", vec![]),
        ] {
            assert_eq!(of_argument(argument), expected, "{argument}");
        }
    }
}
