//! The source texts of a run, and the search for include files.
//!
//! Each file is read once, whatever path names it. The module `text` decodes it: UTF-8 as it is, other bytes as
//! Latin-1. All offsets count bytes of the decoded text.

use super::dependency::Dependencies;
use super::held_file::{HeldFile, canonical_path};
use super::refusal::refusal;
use super::search::INCLUDES;
use super::text::decode;
use super::{Diagnostic, FileId, Span};
use crate::base::file::{
    FileLimits, Folders, MAX_FILE_BYTES, MAX_STREAM_BYTES, Named, read_limited,
};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Larger include files hold data and are not searched for declarations.
const SMALL_FILE_BYTES: u64 = 1 << 20;

/// The source texts of a run, by [`FileId`].
#[derive(Clone, Debug, Default)]
pub struct Sources {
    library_paths: Vec<PathBuf>,
    /// Those for scenes of version 3.8; empty if they are the same.
    library_paths_of_3_8: Vec<PathBuf>,
    /// True while the language is that of 3.8.
    is_of_3_8: bool,
    texts: Vec<Source>,
    pub(super) by_path: FxHashMap<PathBuf, FileId>,
    /// Canonical paths of files that the scene wrote itself.
    pub(super) written: FxHashSet<PathBuf>,
    /// Those of them that are held in memory, by canonical path.
    pub(super) held: FxHashMap<PathBuf, HeldFile>,
    pub(super) dependencies: Dependencies,
    /// Files that an earlier run has read and this one has not requested.
    pub(super) of_earlier_run: FxHashSet<FileId>,
    /// Binary files, by canonical path.
    pub(super) data: FxHashMap<PathBuf, Arc<[u8]>>,
    pub(super) limits: FileLimits,
}

#[derive(Clone, Debug)]
struct Source {
    name: String,
    path: Option<PathBuf>,
    text: Arc<String>,
    /// True if some of its bytes were decoded as Latin-1, one byte per letter.
    is_latin1: bool,
    /// Offset of the start of each line, computed on first use.
    lines: OnceLock<Vec<u32>>,
}

impl Sources {
    /// An empty set of texts. Include files are searched in `library_paths`, in this order, after the including file's
    /// folder and the current folder.
    #[must_use]
    pub fn new(library_paths: Vec<PathBuf>) -> Self {
        Sources {
            library_paths,
            ..Sources::default()
        }
    }

    /// Searches other folders for scenes of 3.8; none for the same ones.
    #[must_use]
    pub fn with_paths_of_3_8(mut self, library_paths: Vec<PathBuf>) -> Self {
        self.library_paths_of_3_8 = library_paths;
        self
    }

    /// Searches the folders for scenes of 3.8, or those for older ones, from now on.
    pub(crate) fn search_paths_of_3_8(&mut self, is_for_3_8: bool) {
        self.is_of_3_8 = is_for_3_8;
    }

    /// The folders for the scene's version.
    fn library_paths(&self) -> &[PathBuf] {
        match self.is_of_3_8 && !self.library_paths_of_3_8.is_empty() {
            true => &self.library_paths_of_3_8,
            false => &self.library_paths,
        }
    }

    /// Limits the folders in which files that the scene names are read.
    pub fn limit_reads(&mut self, folders: Folders) {
        self.limits.folders = folders;
    }

    /// Limits the bytes of all files that are read from now on.
    pub(crate) fn limit_bytes(&mut self, bytes: u64) {
        self.limits.bytes = bytes;
    }

    /// Loads the text of a file that the user names, unless it has been read before. It may be a pipe.
    ///
    /// # Errors
    /// The file cannot be read or is larger than [`MAX_FILE_BYTES`]; the diagnostic has no span yet.
    pub fn load_file(&mut self, path: impl AsRef<Path>) -> Result<FileId, Box<Diagnostic>> {
        self.load(path.as_ref(), Named::ByUser)
    }

    /// Loads the text of a file that a scene, or a file of settings beside it, may name: regular files only.
    ///
    /// # Errors
    /// As [`Sources::load_file`], and if the file is not a regular one.
    pub(crate) fn load_regular(&mut self, path: &Path) -> Result<FileId, Box<Diagnostic>> {
        self.load(path, Named::ByScene)
    }

    fn load(&mut self, path: &Path, named: Named) -> Result<FileId, Box<Diagnostic>> {
        let name = path.display();
        let cannot_read = |error| Box::new(refusal("read", &name, &error));
        let key = canonical_path(path).map_err(cannot_read)?;
        if let Some(&file) = self.by_path.get(&key) {
            if self.of_earlier_run.remove(&file) {
                self.note(path, true);
            }
            return Ok(file);
        }
        let Some(bytes) = self.bytes_of(path, named).map_err(cannot_read)? else {
            let (file, stream) = (MAX_FILE_BYTES >> 30, MAX_STREAM_BYTES >> 20);
            let message = match named {
                Named::ByUser => format!(
                    "`{name}` is too large: a scene file may have {file} GiB, a pipe or device {stream} MiB"
                ),
                Named::ByScene => format!("cannot read `{name}`: it is too large"),
            };
            return Err(Box::new(Diagnostic::error(None, message)));
        };
        self.note(path, true);
        let id = self.push(name.to_string(), Some(path.to_owned()), bytes);
        self.by_path.insert(key, id);
        Ok(id)
    }

    /// Adds a text in place of the contents of a file that the user names.
    ///
    /// # Errors
    /// The file does not exist; the diagnostic has no span yet.
    pub fn load_edited(
        &mut self,
        path: impl AsRef<Path>,
        text: Arc<String>,
    ) -> Result<FileId, Box<Diagnostic>> {
        let path = path.as_ref();
        let name = path.display();
        let key = canonical_path(path).map_err(|error| Box::new(refusal("read", &name, &error)))?;
        if let Some(&file) = self.by_path.get(&key) {
            self.of_earlier_run.remove(&file);
            return Ok(file);
        }
        self.note(path, true);
        let id = self.push_decoded(name.to_string(), Some(path.to_owned()), (text, false));
        self.by_path.insert(key, id);
        Ok(id)
    }

    /// Adds a text that comes from no file: standard input, a test, a string in a Rust program. Its include files are
    /// searched in the current folder and the library paths.
    pub fn add_text(&mut self, name: impl Into<String>, bytes: impl AsRef<[u8]>) -> FileId {
        self.push(name.into(), None, bytes.as_ref().to_vec())
    }

    fn push(&mut self, name: String, path: Option<PathBuf>, bytes: Vec<u8>) -> FileId {
        let (text, is_latin1) = decode(bytes);
        self.push_decoded(name, path, (text.into(), is_latin1))
    }

    fn push_decoded(
        &mut self,
        name: String,
        path: Option<PathBuf>,
        (text, is_latin1): (Arc<String>, bool),
    ) -> FileId {
        let id = FileId(u32::try_from(self.texts.len()).expect("a run has under 2³² files"));
        self.texts.push(Source {
            name,
            path,
            text,
            is_latin1,
            lines: OnceLock::new(),
        });
        id
    }

    /// Puts another text in the place of one.
    pub(crate) fn replace_text(&mut self, file: FileId, text: String) {
        let source = &mut self.texts[file.0 as usize];
        source.text = text.into();
        source.lines = OnceLock::new();
    }

    /// Loads the file that `#include "name"` in `including_file` names. The search goes through that file's folder, the
    /// current folder and the library paths; in each it tries the name, then the name with `.inc` or `.INC` appended.
    ///
    /// # Errors
    /// No such file, or it cannot be read. The diagnostic lists the folders searched and files whose names differ only
    /// in case. It has no span yet; the caller sets that of the name.
    pub fn find_include(
        &mut self,
        name: &str,
        including_file: FileId,
    ) -> Result<FileId, Box<Diagnostic>> {
        self.find("the include file", name, including_file, &INCLUDES)
    }

    /// Loads the file that `#fopen F "name" read` names: searched like an include file, but by its name alone.
    ///
    /// # Errors
    /// As [`Sources::find_include`].
    pub fn find_data(
        &mut self,
        name: &str,
        reading_file: FileId,
    ) -> Result<FileId, Box<Diagnostic>> {
        self.find("the file", name, reading_file, &[""])
    }

    fn find(
        &mut self,
        what: &str,
        name: &str,
        from: FileId,
        endings: &[&str],
    ) -> Result<FileId, Box<Diagnostic>> {
        let folders = self.folders(from);
        match self.search(name, &folders, endings) {
            Some(path) => self.load_regular(&path),
            None => Err(Box::new(self.not_found(what, name, &folders))),
        }
    }

    /// Returns true if there is a file for `#fopen F "name" read`.
    #[must_use]
    pub fn has_data(&mut self, name: &str, reading_file: FileId) -> bool {
        let folders = self.folders(reading_file);
        let found = self.search(name, &folders, &[""]);
        if let Some(path) = &found {
            self.note(path, true);
        }
        found.is_some()
    }

    /// The include file of the library that declares a name, among the first `limit` files.
    #[must_use]
    pub fn library_file_that_declares(&self, name: &str, limit: usize) -> Option<Declared> {
        let entries = self
            .library_paths()
            .iter()
            .filter_map(|folder| fs::read_dir(folder).ok());
        let mut files: Vec<PathBuf> = entries
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|ending| ending == "inc"))
            .filter(|path| {
                fs::metadata(path).is_ok_and(|metadata| metadata.len() < SMALL_FILE_BYTES)
            })
            .collect();
        files.sort();
        files.truncate(limit);
        files.iter().find_map(|path| {
            let bytes = read_limited(path, Named::ByScene, &self.limits)
                .ok()
                .flatten()
                .unwrap_or_default();
            Some(Declared {
                kind: declares(&String::from_utf8_lossy(&bytes), name)?,
                file: path.file_name()?.to_string_lossy().into_owned(),
            })
        })
    }

    /// Folders in which include files are searched, in order; an empty path is the current folder.
    pub(super) fn folders(&self, including_file: FileId) -> Vec<PathBuf> {
        let including = self.path(including_file).and_then(Path::parent);
        let near = including.into_iter().chain([Path::new("")]);
        let mut folders: Vec<PathBuf> = Vec::new();
        for folder in near.chain(self.library_paths().iter().map(PathBuf::as_path)) {
            if !folders.iter().any(|known| known == folder) {
                folders.push(folder.to_owned());
            }
        }
        folders
    }

    /// Returns true if non-ASCII letters of a file are one byte long.
    pub(crate) fn is_latin1(&self, file: FileId) -> bool {
        self.texts[file.0 as usize].is_latin1
    }

    /// The text of a file.
    ///
    /// # Panics
    /// If `file` belongs to other `Sources`, as for all methods that take one.
    #[must_use]
    pub fn text(&self, file: FileId) -> &Arc<String> {
        &self.source(file).text
    }

    /// The name of a text: the path of the file, or the name given to [`Sources::add_text`].
    #[must_use]
    pub fn name(&self, file: FileId) -> &str {
        &self.source(file).name
    }

    /// The path of a file; `None` for a text that comes from no file.
    #[must_use]
    pub fn path(&self, file: FileId) -> Option<&Path> {
        self.source(file).path.as_deref()
    }

    /// Line and column of the start of a span, from 1; columns count characters.
    #[must_use]
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let (line, start) = self.line_of(span.file, span.start as usize);
        let text = self.text(span.file);
        let end = char_start(text, span.start as usize);
        (line, text[start..end].chars().count() + 1)
    }

    /// The line that contains a byte, counted from 1, and the offset of its start.
    pub(super) fn line_of(&self, file: FileId, at: usize) -> (usize, usize) {
        let lines = self.lines(file);
        let line = lines.partition_point(|&start| start as usize <= at).max(1);
        (line, lines[line - 1] as usize)
    }

    /// Offset of the start of a line, counted from 1; the end of the text for a line beyond the last.
    pub(super) fn line_start(&self, file: FileId, line: usize) -> usize {
        let lines = self.lines(file);
        let start = line.checked_sub(1).and_then(|index| lines.get(index));
        start.map_or(self.text(file).len(), |&start| start as usize)
    }

    fn lines(&self, file: FileId) -> &[u32] {
        let source = self.source(file);
        source.lines.get_or_init(|| line_starts(&source.text))
    }

    /// All texts, in reading order.
    pub(super) fn all_texts(&self) -> impl Iterator<Item = &str> {
        self.texts.iter().map(|source| source.text.as_str())
    }

    fn source(&self, file: FileId) -> &Source {
        &self.texts[file.0 as usize]
    }
}

/// A declaration in an include file of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declared {
    /// The file, as `#include` names it.
    pub file: String,
    /// The word that the value begins with: `texture`, `rgb`; may be empty.
    pub kind: String,
}

/// The word after the `=` of a line `#declare name = ...`; empty for `#macro name` and values that begin with no word.
fn declares(text: &str, name: &str) -> Option<String> {
    text.lines().find_map(|line| {
        let line = line.trim_start().strip_prefix('#')?;
        let (word, rest) = line.split_once([' ', '\t']).unwrap_or((line, ""));
        let rest = rest.trim_start().strip_prefix(name)?;
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        if !matches!(word, "declare" | "macro") || rest.starts_with(is_part) {
            return None;
        }
        let value = rest.trim_start().strip_prefix('=').unwrap_or_default();
        Some(
            value
                .trim_start()
                .chars()
                .take_while(|&c| is_part(c))
                .collect(),
        )
    })
}

/// A line ends with a line feed, a carriage return, or both.
fn line_starts(text: &str) -> Vec<u32> {
    let bytes = text.as_bytes();
    let ends = memchr::memchr2_iter(b'\n', b'\r', bytes)
        .filter(|&at| bytes[at] == b'\n' || bytes.get(at + 1) != Some(&b'\n'));
    // The lexer rejects texts with longer offsets, so no span begins after the last line listed here.
    let starts = ends.map_while(|at| u32::try_from(at + 1).ok());
    std::iter::once(0).chain(starts).collect()
}

/// Offset of the character that contains the byte `at`; the end of the text for a byte beyond it.
pub(super) fn char_start(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}
