//! Ini files: lines of `Key=Value`, of switches, of nested files; sections; comments.
//!
//! Lines before the first `[section]` always count, lines in a section only if the file was named with it,
//! `file.ini[section]`. `;` begins a comment, and so does `#` at the start of a word.

use super::arg_words::{assignment, has_ending};
use super::error::CliError;
use super::raw_args::RawArgs;
use super::values::unquoted;
use super::{arg_words, keys, switches};
use crate::app::cli::COMMANDS;
use crate::app::cli::options::ini;
use crate::base::file::{FileLimits, Named, read_limited, read_regular};
use crate::base::nearest::nearest;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Folders with more entries are not fully searched for a file with a similar name.
const MAX_NEIGHBOURS: usize = 10_000;

/// Maximum size of a file in bytes.
const LARGEST: u64 = 1 << 24;

/// Maximum depth of nested files.
const DEEPEST: usize = 16;

/// Reads words and files, one after the other.
pub(crate) struct Reader<'a> {
    /// The options so far.
    pub(crate) raw_args: &'a mut RawArgs,
    /// Folders searched for ini files after the current one and those of `Library_Path`.
    standard_folders: &'a [PathBuf],
    depth: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(raw_args: &'a mut RawArgs, standard_folders: &'a [PathBuf]) -> Self {
        Reader {
            raw_args,
            standard_folders,
            depth: 0,
        }
    }

    /// Reads the file that a word names: `name`, `name.ini`, either with `[section]`.
    pub(crate) fn read_named(&mut self, word: &str) -> Result<(), CliError> {
        let (name, section) = match word.strip_suffix(']').and_then(|w| w.rsplit_once('[')) {
            Some((name, section)) => (name, Some(section)),
            None => (word, None),
        };
        match self.find(name) {
            Some(file) if self.depth == 0 => self.read_file_of_user(&file, section),
            Some(file) => self.read_file(&file, section),
            None if self.depth > 0 => Err(missing(name, "no scene or ini file", &[])),
            None => {
                let commands = COMMANDS.iter().map(|command| command.name);
                let commands: Vec<&str> = commands.collect();
                Err(missing(name, "no scene, ini file or command", &commands))
            }
        }
    }

    /// Reads a file that the command line names. It may be a pipe.
    fn read_file_of_user(&mut self, file: &Path, section: Option<&str>) -> Result<(), CliError> {
        let limits = FileLimits {
            bytes: LARGEST,
            ..FileLimits::default()
        };
        let read = read_limited(file, Named::ByUser, &limits)
            .and_then(|bytes| bytes.ok_or_else(|| ErrorKind::FileTooLarge.into()));
        self.read_bytes(read, file, section)
    }

    /// Reads an existing file, which must be a regular one.
    pub(crate) fn read_file(&mut self, file: &Path, section: Option<&str>) -> Result<(), CliError> {
        if self.depth == DEEPEST {
            return Err(CliError::new(format!(
                "ini files name each other more than {DEEPEST} deep, the last is `{}`",
                file.display()
            )));
        }
        self.read_bytes(read_regular(file, LARGEST), file, section)
    }

    fn read_bytes(
        &mut self,
        read: io::Result<Vec<u8>>,
        file: &Path,
        section: Option<&str>,
    ) -> Result<(), CliError> {
        let bytes = read
            .map_err(|error| CliError::new(format!("cannot read `{}`: {error}", file.display())))?;
        let is_command_line = std::mem::take(&mut self.raw_args.is_command_line);
        self.depth += 1;
        let read = self.read_text(&String::from_utf8_lossy(&bytes), file, section);
        self.depth -= 1;
        self.raw_args.is_command_line = is_command_line;
        read
    }

    fn read_text(
        &mut self,
        text: &str,
        file: &Path,
        section: Option<&str>,
    ) -> Result<(), CliError> {
        let mut counts = true;
        for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line = without_comment(line).trim();
            if let Some(heading) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
                counts = section.is_some_and(|s| s.trim().eq_ignore_ascii_case(heading.trim()));
            } else if counts {
                self.read_line(line)
                    .map_err(|refusal| refusal.in_file(file, number + 1))?;
            }
        }
        Ok(())
    }

    fn read_line(&mut self, line: &str) -> Result<(), CliError> {
        arg_words::of_argument(line)
            .iter()
            .try_for_each(|word| ini::read(self, word))
    }

    fn find(&self, name: &str) -> Option<PathBuf> {
        let folders = [PathBuf::new()];
        folders
            .iter()
            .chain(&self.raw_args.library_paths)
            .chain(self.standard_folders)
            .flat_map(|folder| [folder.join(name), folder.join(format!("{name}.ini"))])
            .find(|file| file.is_file() || (self.depth == 0 && is_pipe(file)))
    }
}

/// True for what exists and is neither a regular file nor a folder.
fn is_pipe(path: &Path) -> bool {
    path.metadata()
        .is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// An error for an unknown name, with a suggestion.
fn missing(name: &str, kinds: &str, commands: &[&str]) -> CliError {
    let kinds = match arg_words::has_ending(name, ".ini") {
        true => "no ini file",
        false => kinds,
    };
    let scene = format!("{name}.pov");
    let command = || nearest(name, commands.iter().copied());
    let meant = if Path::new(&scene).is_file() {
        Some(scene)
    } else {
        let command = command().map(|command| format!("povr {command}"));
        command.or_else(|| neighbour(Path::new(name)))
    };
    let refusal = match meant {
        Some(meant) => format!("{kinds} named `{name}`; did you mean `{meant}`?"),
        None => format!("{kinds} named `{name}`"),
    };
    let refusal = CliError::new(refusal);
    if Path::new(name).is_file() {
        refusal.with_hint(format!("Name a scene with another ending by `+I{name}`."))
    } else {
        refusal
    }
}

/// The scene or ini file beside `missing` whose name, with or without its ending, is nearest to that of `missing`.
pub(crate) fn neighbour(missing: &Path) -> Option<String> {
    let folder = match missing.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let files = fs::read_dir(folder).ok()?.take(MAX_NEIGHBOURS).flatten();
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    let names = names.filter(|name| {
        [".pov", ".ini"]
            .iter()
            .any(|end| arg_words::has_ending(name, end))
    });
    let names: Vec<String> = names.collect();
    let name = missing.file_name()?.to_string_lossy();
    let stems = names.iter().filter_map(|name| name.rsplit_once('.'));
    let suggestion = match name.contains('.') {
        true => nearest(&name, names.iter().map(String::as_str))?,
        false => {
            let stem = nearest(&name, stems.map(|(stem, _)| stem))?;
            let mut names = names.iter().map(String::as_str);
            names.find(|name| name.starts_with(&format!("{stem}.")))?
        }
    };
    Some(missing.with_file_name(suggestion).display().to_string())
}

/// The line up to its comment.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    let mut before = ' ';
    for (at, c) in line.char_indices() {
        let begins_word = before.is_whitespace();
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None if c == ';' || (c == '#' && begins_word) => return &line[..at],
            None if c == '"' || (c == '\'' && (begins_word || before == '=')) => quote = Some(c),
            None => {}
        }
        before = c;
    }
    line
}

/// Reads a word.
pub(crate) fn read(reader: &mut Reader<'_>, word: &str) -> Result<(), CliError> {
    if word == "-" {
        reader.raw_args.scene = Some("-".to_owned());
        return Ok(());
    }
    if let Some((key, value)) = assignment(word) {
        return set(reader, key, unquoted(value), word);
    }
    if let Some(done) = switches::set(reader.raw_args, word) {
        return done;
    }
    let name = unquoted(word);
    if has_ending(name, ".pov") {
        reader.raw_args.scene = Some(name.to_owned());
        let given = ("Input_File_Name", name.to_owned());
        reader.raw_args.given.push(given);
        Ok(())
    } else if name.starts_with(['+', '-']) && !has_ending(name, ".ini") {
        Err(CliError::new(format!("unknown switch `{word}`"))
            .with_hint("`povr --help` tells which switches there are."))
    } else {
        reader.read_named(name)
    }
}

/// Sets an option; `Include_Ini` is not an option but a file to read at once.
pub(crate) fn set(
    reader: &mut Reader<'_>,
    key: &str,
    value: &str,
    written: &str,
) -> Result<(), CliError> {
    if key.eq_ignore_ascii_case("Include_Ini") {
        reader.read_named(value)
    } else {
        keys::set(reader.raw_args, key, value, written.trim())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_end_a_line_unless_quoted() {
        for (line, expected) in [
            ("Width=9 ; wide", "Width=9 "),
            ("; all", ""),
            ("# all", ""),
            (
                "Input_File_Name=\"a;b.pov\" ; c",
                "Input_File_Name=\"a;b.pov\" ",
            ),
            ("Input_File_Name=a#1.pov", "Input_File_Name=a#1.pov"),
            (
                "Input_File_Name='a;b.pov' ; c",
                "Input_File_Name='a;b.pov' ",
            ),
            ("Input_File_Name=it's.pov ; c", "Input_File_Name=it's.pov "),
        ] {
            assert_eq!(without_comment(line), expected);
        }
    }
}
