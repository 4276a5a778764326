//! The texts of one run, and the search for include files.
//!
//! A file is read once, by whatever path it is named. Its bytes become a text by the rules of `text`: UTF-8 as it is,
//! other bytes as Latin-1. All offsets count bytes of that text.

use super::text::decode;
use super::{Diagnostic, FileId, Span};
use rustc_hash::FxHashMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Files of more bytes are refused. Twice as many still have 32-bit offsets, if all of them are Latin-1.
pub const MAX_FILE_BYTES: u64 = 1 << 31;

/// What comes out of a pipe or a device is refused if it has more bytes: `/dev/zero` has no end.
const MAX_STREAM_BYTES: u64 = 1 << 28;

/// Include files of more bytes hold data and are not searched for names.
const SMALL_FILE_BYTES: u64 = 1 << 20;

/// What POV-Ray appends to the name of an include file that it does not find.
const EXTENSIONS: [&str; 3] = ["", ".inc", ".INC"];

/// The texts of one run, by their [`FileId`].
#[derive(Debug, Default)]
pub struct Sources {
    library_paths: Vec<PathBuf>,
    texts: Vec<Source>,
    by_path: FxHashMap<PathBuf, FileId>,
    /// Files that are no text, by their canonical paths.
    pub(super) data: FxHashMap<PathBuf, Arc<[u8]>>,
}

#[derive(Debug)]
struct Source {
    name: String,
    path: Option<PathBuf>,
    text: Arc<str>,
    /// Where each line begins; made when first asked for.
    lines: OnceLock<Vec<u32>>,
}

impl Sources {
    /// No texts; include files are searched in `library_paths`, in this order, after the nearer places.
    #[must_use]
    pub fn new(library_paths: Vec<PathBuf>) -> Self {
        Sources {
            library_paths,
            ..Sources::default()
        }
    }

    /// The text of a file, read now unless it has been read before.
    ///
    /// # Errors
    /// When the file cannot be read or has more than [`MAX_FILE_BYTES`]; the finding has no place yet.
    pub fn load_file(&mut self, path: impl AsRef<Path>) -> Result<FileId, Box<Diagnostic>> {
        let path = path.as_ref();
        let name = path.display();
        let cannot_read = |error: io::Error| {
            Box::new(Diagnostic::error(
                None,
                format!("cannot read `{name}`: {error}"),
            ))
        };
        let canonical = fs::canonicalize(path).map_err(cannot_read)?;
        if let Some(&file) = self.by_path.get(&canonical) {
            return Ok(file);
        }
        let Some(bytes) = read_limited(path).map_err(cannot_read)? else {
            let (file, stream) = (MAX_FILE_BYTES >> 30, MAX_STREAM_BYTES >> 20);
            let message = format!(
                "`{name}` is too large: a scene file may have {file} GiB, a pipe or device {stream} MiB"
            );
            return Err(Box::new(Diagnostic::error(None, message)));
        };
        let id = self.push(name.to_string(), Some(path.to_owned()), &bytes);
        self.by_path.insert(canonical, id);
        Ok(id)
    }

    /// A text that comes from no file: standard input, a test, a string of a Rust program. Its include files are
    /// searched in the current folder and the library paths.
    pub fn add_text(&mut self, name: impl Into<String>, bytes: impl AsRef<[u8]>) -> FileId {
        self.push(name.into(), None, bytes.as_ref())
    }

    fn push(&mut self, name: String, path: Option<PathBuf>, bytes: &[u8]) -> FileId {
        let id = FileId(u32::try_from(self.texts.len()).expect("a run has under 2³² files"));
        self.texts.push(Source {
            name,
            path,
            text: decode(bytes).into(),
            lines: OnceLock::new(),
        });
        id
    }

    /// The file that `#include "name"` in `including_file` means: beside that file, else in the current folder, else
    /// in the first library path that has it; in each place by its name, else with `.inc` or `.INC` appended.
    ///
    /// # Errors
    /// When there is no such file or it cannot be read. The finding names the places searched and files whose names
    /// differ only in case; it has no place yet, give it that of the name.
    pub fn find_include(
        &mut self,
        name: &str,
        including_file: FileId,
    ) -> Result<FileId, Box<Diagnostic>> {
        let folders = self.folders(including_file);
        match first_file(name, &folders, &EXTENSIONS) {
            Some(path) => self.load_file(path),
            None => Err(Box::new(not_found(name, &folders))),
        }
    }

    /// Whether there is a file that `#include "name"` would mean.
    #[must_use]
    pub fn has_include(&self, name: &str, including_file: FileId) -> bool {
        first_file(name, &self.folders(including_file), &EXTENSIONS).is_some()
    }

    /// The name of an include file of the library that declares a name, if one of the first `most` files does.
    #[must_use]
    pub fn library_file_that_declares(&self, name: &str, most: usize) -> Option<String> {
        let entries = self
            .library_paths
            .iter()
            .filter_map(|folder| fs::read_dir(folder).ok());
        let mut files: Vec<PathBuf> = entries
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|ending| ending == "inc"))
            .filter(|path| fs::metadata(path).is_ok_and(|about| about.len() < SMALL_FILE_BYTES))
            .collect();
        files.sort();
        files.truncate(most);
        let declares = |path: &PathBuf| {
            let bytes = read_limited(path).ok().flatten().unwrap_or_default();
            declares(&String::from_utf8_lossy(&bytes), name)
        };
        let found = files.into_iter().find(declares)?;
        Some(found.file_name()?.to_string_lossy().into_owned())
    }

    /// Where include files are searched; an empty path is the current folder.
    pub(super) fn folders(&self, including_file: FileId) -> Vec<PathBuf> {
        let including = self.path(including_file).and_then(Path::parent);
        let near = including.into_iter().chain([Path::new("")]);
        let mut folders: Vec<PathBuf> = Vec::new();
        for folder in near.chain(self.library_paths.iter().map(PathBuf::as_path)) {
            if !folders.iter().any(|known| known == folder) {
                folders.push(folder.to_owned());
            }
        }
        folders
    }

    /// A text.
    ///
    /// # Panics
    /// When `file` is of other `Sources`, as for all methods that take one.
    #[must_use]
    pub fn text(&self, file: FileId) -> &Arc<str> {
        &self.source(file).text
    }

    /// The name of a text: the path by which the file was found, or what [`Sources::add_text`] was given.
    #[must_use]
    pub fn name(&self, file: FileId) -> &str {
        &self.source(file).name
    }

    /// The path by which a file was found; `None` for a text that comes from no file.
    #[must_use]
    pub fn path(&self, file: FileId) -> Option<&Path> {
        self.source(file).path.as_deref()
    }

    /// The files that were read, in the order of reading: what the picture depends on.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.texts
            .iter()
            .filter_map(|source| source.path.as_deref())
    }

    /// Line and column of the start of a place, from 1; columns are counted in characters.
    #[must_use]
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let (line, start) = self.line_of(span.file, span.start as usize);
        let text = self.text(span.file);
        let end = char_start(text, span.start as usize);
        (line, text[start..end].chars().count() + 1)
    }

    /// The number of the line, from 1, that holds a byte, and where that line begins.
    pub(super) fn line_of(&self, file: FileId, at: usize) -> (usize, usize) {
        let lines = self.lines(file);
        let line = lines.partition_point(|&start| start as usize <= at).max(1);
        (line, lines[line - 1] as usize)
    }

    /// Where a line begins, counted from 1; the end of the text for a line behind the last.
    pub(super) fn line_start(&self, file: FileId, line: usize) -> usize {
        let lines = self.lines(file);
        let start = line.checked_sub(1).and_then(|index| lines.get(index));
        start.map_or(self.text(file).len(), |&start| start as usize)
    }

    fn lines(&self, file: FileId) -> &[u32] {
        let source = self.source(file);
        source.lines.get_or_init(|| line_starts(&source.text))
    }

    fn source(&self, file: FileId) -> &Source {
        &self.texts[file.0 as usize]
    }
}

/// Whether a text has a line `#declare name` or `#macro name`.
fn declares(text: &str, name: &str) -> bool {
    text.lines().any(|line| {
        let Some(line) = line.trim_start().strip_prefix('#') else {
            return false;
        };
        let (word, rest) = line.split_once([' ', '\t']).unwrap_or((line, ""));
        let is_whole = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        matches!(word, "declare" | "macro")
            && rest.trim_start().strip_prefix(name).is_some_and(is_whole)
    })
}

/// The first file of this name, with one of these endings, in the first folder that has one.
pub(super) fn first_file(name: &str, folders: &[PathBuf], endings: &[&str]) -> Option<PathBuf> {
    let mut paths = folders.iter().flat_map(|folder| {
        endings
            .iter()
            .map(|ending| folder.join(format!("{name}{ending}")))
    });
    // A folder may have the name of a file; a pipe is a file here.
    paths.find(|path| fs::metadata(path).is_ok_and(|found| !found.is_dir()))
}

/// The bytes of a file; `None` for more than [`MAX_FILE_BYTES`], or more than [`MAX_STREAM_BYTES`] of what is no file.
pub(super) fn read_limited(path: &Path) -> io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let about = file.metadata()?;
    if about.len() > MAX_FILE_BYTES {
        return Ok(None);
    }
    let most = if about.is_file() {
        MAX_FILE_BYTES
    } else {
        MAX_STREAM_BYTES
    };
    // A pipe does not tell its length beforehand.
    let mut bytes = Vec::new();
    let mut limited = file.take(most + 1);
    limited.read_to_end(&mut bytes)?;
    Ok((limited.limit() > 0).then_some(bytes))
}

/// A line ends with a line feed, a carriage return, or both.
fn line_starts(text: &str) -> Vec<u32> {
    let bytes = text.as_bytes();
    let ends = memchr::memchr2_iter(b'\n', b'\r', bytes)
        .filter(|&at| bytes[at] == b'\n' || bytes.get(at + 1) != Some(&b'\n'));
    // The lexer refuses texts with longer offsets, so no span lies behind the last line listed here.
    let starts = ends.map_while(|at| u32::try_from(at + 1).ok());
    std::iter::once(0).chain(starts).collect()
}

/// The start of the character that holds the byte `at`; the end of the text for a byte behind it.
pub(super) fn char_start(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn not_found(name: &str, folders: &[PathBuf]) -> Diagnostic {
    let places = if Path::new(name).is_absolute() {
        String::new()
    } else {
        let places: Vec<String> = folders.iter().map(|folder| place(folder)).collect();
        format!(" in {}", one_of(&places))
    };
    let mut error = Diagnostic::error(
        None,
        format!("cannot find the include file `{name}`{places}"),
    );
    for (found, written) in other_cases(name, folders) {
        error = error.with_hint(format!(
            "`{}` differs only in case: write `{written}`",
            found.display()
        ));
    }
    if name.contains('\\') {
        error = error.with_hint("write `/` between folders, not `\\`");
    }
    if error.hints.is_empty() && !Path::new(name).is_absolute() {
        error =
            error.with_hint("put the file into one of these folders, or name its folder with `+L`");
    }
    error
}

pub(super) fn place(folder: &Path) -> String {
    if folder.as_os_str().is_empty() {
        "the current folder".to_owned()
    } else {
        format!("`{}`", folder.display())
    }
}

/// `a`, `a or b`, `a, b or c`.
pub(super) fn one_of(places: &[String]) -> String {
    match places {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// Files in the folders searched whose names differ from `name` only in case, each with how to write it.
fn other_cases(name: &str, folders: &[PathBuf]) -> Vec<(PathBuf, String)> {
    let (inner, last) = match name.rfind('/') {
        Some(slash) => name.split_at(slash + 1),
        None => ("", name),
    };
    let wanted = EXTENSIONS.map(|extension| format!("{last}{extension}").to_lowercase());
    let mut found = Vec::new();
    for folder in folders {
        let folder = folder.join(inner);
        let listed = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            &folder
        };
        let entries = fs::read_dir(listed).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut names: Vec<String> = names
            .filter(|name| wanted.contains(&name.to_lowercase()))
            .collect();
        names.sort();
        found.extend(
            names
                .into_iter()
                .map(|name| (folder.join(&name), format!("{inner}{name}"))),
        );
    }
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    #[test]
    fn lines_and_columns_count_from_one_in_characters() {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("x", "ab\n\u{e9}c\r\nd\re");
        let place = |at| sources.line_column(Span::new(file, at, at));
        let places: Vec<_> = (0..=10).map(place).collect();
        let line_2 = [(2, 1), (2, 1), (2, 2), (2, 3), (2, 4)];
        assert_eq!(places[..3], [(1, 1), (1, 2), (1, 3)]);
        assert_eq!(places[3..8], line_2);
        assert_eq!(places[8..], [(3, 1), (3, 2), (4, 1)]);
        assert_eq!(sources.line_column(Span::new(file, 99, 99)), (4, 2));
    }

    #[test]
    fn a_file_is_read_once() {
        let folder = folder_with(&[("a.pov", "x"), ("sub/b.inc", "y")]);
        let mut sources = Sources::new(Vec::new());
        let first = sources.load_file(folder.path().join("a.pov")).unwrap();
        let again = sources
            .load_file(folder.path().join("sub/../a.pov"))
            .unwrap();
        assert_eq!(first, again);
        sources.find_include("sub/b", first).unwrap();
        sources.find_include("sub/b.inc", first).unwrap();
        let files: Vec<&Path> = sources.files().collect();
        assert_eq!(
            files,
            [folder.path().join("a.pov"), folder.path().join("sub/b.inc")]
        );
    }

    #[test]
    fn include_files_are_searched_near_first_then_in_the_library_in_order() {
        let scenes = folder_with(&[("a.pov", ""), ("near.inc", "scene"), ("dir.inc/x", "")]);
        let first = folder_with(&[("near.inc", "1"), ("lib.INC", "1"), ("dir.inc", "1")]);
        let second = folder_with(&[("lib.inc", "2"), ("far", "2"), ("far.inc", "wrong")]);
        let library = vec![first.path().to_owned(), second.path().to_owned()];
        let mut sources = Sources::new(library);
        let scene = sources.load_file(scenes.path().join("a.pov")).unwrap();
        let stdin = sources.add_text("stdin", "");
        let mut find = |name: &str, from: FileId| {
            let file = sources.find_include(name, from).unwrap();
            sources.text(file).to_string()
        };
        assert_eq!(find("near.inc", scene), "scene");
        assert_eq!(find("near", stdin), "1");
        assert_eq!(find("lib", scene), "1");
        assert_eq!(find("lib.inc", scene), "2");
        assert_eq!(find("far", scene), "2");
        assert_eq!(find("dir.inc", scene), "1", "a folder is no file");
        let absolute = second.path().join("lib").display().to_string();
        assert_eq!(find(&absolute, stdin), "2");
    }

    #[test]
    fn a_missing_include_file_is_told_with_places_and_other_cases() {
        let scenes = folder_with(&[("a.pov", "")]);
        let library = folder_with(&[("Colors.inc", ""), ("sub/colors.INC", "")]);
        let mut sources = Sources::new(vec![library.path().to_owned()]);
        let scene = sources.load_file(scenes.path().join("a.pov")).unwrap();
        let error = sources.find_include("colors", scene).unwrap_err();
        let (near, far) = (scenes.path().display(), library.path().display());
        assert_eq!(
            error.message,
            format!(
                "cannot find the include file `colors` in `{near}`, the current folder or `{far}`"
            )
        );
        assert_eq!(
            error.hints,
            [format!(
                "`{far}/Colors.inc` differs only in case: write `Colors.inc`"
            )]
        );
        let error = sources.find_include("sub/Colors", scene).unwrap_err();
        assert_eq!(
            error.hints,
            [format!(
                "`{far}/sub/colors.INC` differs only in case: write `sub/colors.INC`"
            )]
        );
        let error = sources.find_include("sub\\colors", scene).unwrap_err();
        assert_eq!(error.hints, ["write `/` between folders, not `\\`"]);
        let error = sources
            .find_include("/nowhere/colors.inc", scene)
            .unwrap_err();
        assert_eq!(
            error.message,
            "cannot find the include file `/nowhere/colors.inc`"
        );
    }

    #[test]
    fn a_file_that_cannot_be_read_is_told() {
        let folder = folder_with(&[]);
        let mut sources = Sources::new(Vec::new());
        let error = sources
            .load_file(folder.path().join("none.pov"))
            .unwrap_err();
        assert!(
            error.message.starts_with("cannot read `"),
            "{}",
            error.message
        );
        assert!(sources.load_file(folder.path()).is_err());
    }

    #[test]
    fn a_file_over_the_limit_is_refused() {
        let folder = folder_with(&[]);
        let path = folder.path().join("huge.pov");
        File::create(&path)
            .unwrap()
            .set_len(MAX_FILE_BYTES + 1)
            .unwrap();
        let error = Sources::new(Vec::new()).load_file(&path).unwrap_err();
        assert!(
            error
                .message
                .contains("is too large: a scene file may have 2 GiB")
        );
    }
}
