//! Files that the scene itself writes.
//!
//! If reading must not change the disk, these files are held in memory, and the scene reads them from there.

use super::Sources;
use super::held_file::{HeldFile, canonical_path};
use crate::base::file::{Named, read_limited};
use std::path::{Path, PathBuf};
use std::{fs, io};

impl Sources {
    /// Records that the scene has written this file: it is read again, takes precedence over others of its name, and
    /// its former content is not a dependency of the picture.
    pub fn record_write(&mut self, path: &Path) {
        if let Ok(key) = canonical_path(path) {
            self.by_path.remove(&key);
            self.data.remove(&key);
            self.written.insert(key);
        }
    }

    /// Replaces the file at this path by the one in memory.
    pub(crate) fn hold_in_memory(&mut self, path: &Path, file: &HeldFile) {
        if let Ok(key) = canonical_path(path) {
            self.held.insert(key, file.clone());
        }
    }

    /// The file in memory that receives text appended to this path.
    pub(crate) fn held_to_append(&mut self, path: &Path) -> HeldFile {
        let held = match self.held(path) {
            Some(held) => held.clone(),
            None if path.exists() => HeldFile::appended_to(path),
            None => HeldFile::default(),
        };
        self.hold_in_memory(path, &held);
        held
    }

    /// The bytes of a file in memory or on disk; `None` above the size limit.
    pub(super) fn bytes_of(&mut self, path: &Path, named: Named) -> io::Result<Option<Vec<u8>>> {
        let bytes = match self.held(path) {
            Some(held) => held.bytes(&self.limits),
            None => read_limited(path, named, &self.limits),
        }?;
        if let Some(bytes) = &bytes {
            self.limits.bytes = self.limits.bytes.saturating_sub(bytes.len() as u64);
        }
        Ok(bytes)
    }

    /// Returns true if a scene can read a file at this path. A folder does not count, even if it has the name of a
    /// file; a pipe does. A file that the scene may not read counts as missing, so that the scene learns nothing of it.
    pub(super) fn is_file(&self, path: &Path) -> bool {
        let is_there = fs::metadata(path).is_ok_and(|metadata| !metadata.is_dir());
        is_there && self.limits.folders.hold(path) || self.held(path).is_some()
    }

    /// The path of this name, relative to the current folder, if the scene wrote that file itself.
    pub(super) fn own_file(&self, name: &str) -> Option<PathBuf> {
        let path = Path::new(name);
        self.has_written(path).then(|| path.to_owned())
    }

    /// Returns true if the scene wrote this file itself.
    pub(super) fn has_written(&self, path: &Path) -> bool {
        !self.written.is_empty()
            && canonical_path(path).is_ok_and(|key| self.written.contains(&key))
    }

    fn held(&self, path: &Path) -> Option<&HeldFile> {
        if self.held.is_empty() {
            return None;
        }
        self.held.get(&canonical_path(path).ok()?)
    }
}
