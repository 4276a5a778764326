//! One word of a command line or an ini file: a switch, `Key=Value`, a scene, or an ini file.

use super::switches;
use super::values::unquoted;
use std::ops::Range;

/// `Key=Value`, with or without spaces around the sign.
pub(crate) fn assignment(text: &str) -> Option<(&str, &str)> {
    let (key, value) = text.split_once('=')?;
    let key = key.trim();
    let is_key = key.starts_with(|c: char| c.is_ascii_alphabetic())
        && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    is_key.then_some((key, value.trim()))
}

/// The words of an argument, or of a line of an ini file. Either may contain several (`"+W320 +H240"`), separated by
/// white space outside quotes. In POV-Ray every space in an argument ends a word; here a space in a file name belongs
/// to the name (`+Ia b.pov`): a name extends to the next switch or assignment.
pub(crate) fn of_argument(argument: &str) -> Vec<String> {
    let mut words: Vec<Range<usize>> = Vec::new();
    for piece in pieces(argument) {
        let text = &argument[piece.clone()];
        match words.last_mut() {
            Some(word) if belongs_to(&argument[word.clone()], text) => word.end = piece.end,
            _ => words.push(piece),
        }
    }
    words.into_iter().map(|w| argument[w].to_owned()).collect()
}

/// True if a piece after white space continues the word before it.
fn belongs_to(word: &str, piece: &str) -> bool {
    let begins = assignment(piece).is_some()
        || piece
            .strip_prefix(['+', '-'])
            .is_some_and(|t| t.starts_with(|c: char| c.is_ascii_alphabetic()));
    match value_of(word) {
        Value::Command => true,
        _ if piece.starts_with('=') => true,
        _ if begins => false,
        // After `Key =`.
        _ if word.ends_with('=') => true,
        _ if word.ends_with(['"', '\'']) => false,
        Value::Name => !(is_file(word) && is_file(piece)),
        Value::Other => !is_file(piece),
    }
}

/// The kind of value that follows a switch or a key.
enum Value {
    /// A command for a shell, to the end of the line.
    Command,
    /// A file or a folder.
    Name,
    /// A number, a letter, or nothing.
    Other,
}

fn value_of(word: &str) -> Value {
    let key = match assignment(word) {
        Some((key, _)) => key,
        None => match switches::key_of(word) {
            Some(key) => key,
            None => return Value::Name,
        },
    };
    let key = key.to_ascii_lowercase();
    let is_name = key.ends_with("_file")
        || key.contains("file_name")
        || key.starts_with("include_")
        || key == "library_path";
    if key.ends_with("_command") {
        Value::Command
    } else if is_name {
        Value::Name
    } else {
        Value::Other
    }
}

/// True if a piece, quoted or not, can only be a scene or an ini file.
fn is_file(piece: &str) -> bool {
    let name = unquoted(piece);
    [".pov", ".ini", "]"]
        .iter()
        .any(|end| has_ending(name, end))
}

pub(crate) fn has_ending(name: &str, ending: &str) -> bool {
    name.len()
        .checked_sub(ending.len())
        .and_then(|at| name.get(at..))
        .is_some_and(|end| end.eq_ignore_ascii_case(ending))
}

/// The pieces between white space outside quotes.
fn pieces(text: &str) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let mut start = None;
    let mut quote = None;
    for (at, c) in text.char_indices() {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None => {
                let before = &text[start.unwrap_or(at)..at];
                quote = Some(c).filter(|_| opens_quotes(c, before, &text[at + c.len_utf8()..]));
            }
        }
        if quote.is_some() || !c.is_whitespace() {
            start.get_or_insert(at);
        } else if let Some(start) = start.take() {
            pieces.push(start..at);
        }
    }
    pieces.extend(start.map(|start| start..text.len()));
    pieces
}

/// True if a character begins a quoted span. An apostrophe does so only at the start of a value (`'a b.pov'`, `+I'a
/// b.pov'`, `Key='a b'`) and if another one follows: names contain apostrophes too.
fn opens_quotes(c: char, before: &str, behind: &str) -> bool {
    let is_switch = |text: &str| {
        text.strip_prefix(['+', '-'])
            .is_some_and(|t| !t.is_empty() && t.chars().all(|c| c.is_ascii_alphabetic()))
    };
    let begins_value = before.is_empty() || before.ends_with('=') || is_switch(before);
    c == '"' || (c == '\'' && begins_value && behind.contains('\''))
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
            ("Width=9 Height=8", vec!["Width=9", "Height=8"]),
            ("Width = 9", vec!["Width = 9"]),
            ("+W9 s.pov +H8", vec!["+W9", "s.pov", "+H8"]),
            ("+W9 p.ini[big]", vec!["+W9", "p.ini[big]"]),
            ("s.pov p.ini", vec!["s.pov", "p.ini"]),
            ("+W 9", vec!["+W 9"]),
            ("+I'a b.pov' +W9", vec!["+I'a b.pov'", "+W9"]),
            ("'a b.pov' p.ini", vec!["'a b.pov'", "p.ini"]),
            ("it's a b.pov", vec!["it's a b.pov"]),
            (
                "Input_File_Name=\"a b.pov\" Width=9",
                vec!["Input_File_Name=\"a b.pov\"", "Width=9"],
            ),
            (
                "Declare=A=3 Declare=B=4",
                vec!["Declare=A=3", "Declare=B=4"],
            ),
            (
                "Post_Frame_Command=mv -f a b.pov",
                vec!["Post_Frame_Command=mv -f a b.pov"],
            ),
            ("", vec![]),
        ] {
            assert_eq!(of_argument(argument), expected, "{argument}");
        }
    }
}
