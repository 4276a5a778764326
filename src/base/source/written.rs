//! The files that a scene writes itself.
//!
//! Where reading is to change nothing on disk, what a scene writes is held in memory, and is found there when the scene
//! looks for it.

use super::Sources;
use super::read::{Named, read_limited};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A file that is written in memory; copies are one file.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldFile(Arc<Mutex<Content>>);

#[derive(Debug, Default)]
struct Content {
    /// The file on disk to which the text is appended.
    behind: Option<PathBuf>,
    text: Vec<u8>,
}

impl HeldFile {
    /// A file that holds what the one at `path` holds, and then what is written.
    fn behind(path: &Path) -> Self {
        HeldFile(Arc::new(Mutex::new(Content {
            behind: Some(path.to_owned()),
            text: Vec::new(),
        })))
    }

    /// Writes at the end.
    pub(crate) fn write(&self, text: &str) {
        self.lock().text.extend_from_slice(text.as_bytes());
    }

    /// All bytes; `None` for too many.
    fn bytes(&self) -> io::Result<Option<Vec<u8>>> {
        let content = self.lock();
        let Some(path) = &content.behind else {
            return Ok(Some(content.text.clone()));
        };
        let bytes = read_limited(path, Named::ByScene)?;
        Ok(bytes.map(|bytes| [bytes, content.text.clone()].concat()))
    }

    fn lock(&self) -> MutexGuard<'_, Content> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Sources {
    /// Says that the scene itself has written this file: it is read anew, comes before others of its name, and the
    /// picture does not depend on what it held before.
    pub fn wrote(&mut self, path: &Path) {
        if let Ok(place) = place_of(path) {
            self.by_path.remove(&place);
            self.data.remove(&place);
            self.written.insert(place);
        }
    }

    /// From now on the file of this path is the one in memory.
    pub(crate) fn hold(&mut self, path: &Path, file: &HeldFile) {
        if let Ok(place) = place_of(path) {
            self.held.insert(place, file.clone());
        }
    }

    /// The file of this path to append to in memory.
    pub(crate) fn held_to_append(&mut self, path: &Path) -> HeldFile {
        let held = match self.held(path) {
            Some(held) => held.clone(),
            None if path.exists() => HeldFile::behind(path),
            None => HeldFile::default(),
        };
        self.hold(path, &held);
        held
    }

    /// The bytes of a file, in memory or on disk; `None` for too many.
    pub(super) fn bytes_of(&self, path: &Path, named: Named) -> io::Result<Option<Vec<u8>>> {
        match self.held(path) {
            Some(held) => held.bytes(),
            None => read_limited(path, named),
        }
    }

    /// True if a scene finds a file at this path. A folder may have the name of a file; a pipe is a file here.
    pub(super) fn is_file(&self, path: &Path) -> bool {
        fs::metadata(path).is_ok_and(|found| !found.is_dir()) || self.held(path).is_some()
    }

    /// The file of this name, seen from the current folder, if the scene wrote it itself.
    pub(super) fn own_file(&self, name: &str) -> Option<PathBuf> {
        let path = Path::new(name);
        self.has_written(path).then(|| path.to_owned())
    }

    /// True if the scene wrote a file itself.
    pub(super) fn has_written(&self, path: &Path) -> bool {
        !self.written.is_empty() && place_of(path).is_ok_and(|place| self.written.contains(&place))
    }

    fn held(&self, path: &Path) -> Option<&HeldFile> {
        if self.held.is_empty() {
            return None;
        }
        self.held.get(&place_of(path).ok()?)
    }
}

/// The one path of a file, by whatever path it is named; of a file that is not there, the one it would have. A pipe has
/// no path of its own: `/dev/stdin` stays what it is.
pub(super) fn place_of(path: &Path) -> io::Result<PathBuf> {
    fs::canonicalize(path).or_else(|error| {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let name = path.file_name().ok_or(error)?;
        Ok(fs::canonicalize(folder)?.join(name))
    })
}
