//! Contents of a file that a scene writes, held in memory.

use crate::base::file::{FileLimits, Named, read_limited};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::{fs, io};

/// A file held in memory; clones share its content.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldFile(Arc<Mutex<Content>>);

#[derive(Debug, Default)]
pub(crate) struct Content {
    /// The file on disk to which the text is appended.
    pub(crate) appended_to: Option<PathBuf>,
    pub(crate) text: Vec<u8>,
}

impl HeldFile {
    /// A file in memory that begins with the content of the file at `path`, and to which text is appended.
    pub(crate) fn appended_to(path: &Path) -> Self {
        HeldFile(Arc::new(Mutex::new(Content {
            appended_to: Some(path.to_owned()),
            text: Vec::new(),
        })))
    }

    /// Appends text.
    pub(crate) fn write(&self, text: &str) {
        self.lock().text.extend_from_slice(text.as_bytes());
    }

    /// The whole content; `None` above the size limit.
    pub(crate) fn bytes(&self, limits: &FileLimits) -> io::Result<Option<Vec<u8>>> {
        let content = self.lock();
        let Some(path) = &content.appended_to else {
            return Ok(Some(content.text.clone()));
        };
        let bytes = read_limited(path, Named::ByScene, limits)?;
        Ok(bytes.map(|bytes| [bytes, content.text.clone()].concat()))
    }

    fn lock(&self) -> MutexGuard<'_, Content> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The canonical path of a file; for a missing file, the one it would have. A pipe has none: `/dev/stdin` stays as it
/// is.
pub(crate) fn canonical_path(path: &Path) -> io::Result<PathBuf> {
    fs::canonicalize(path).or_else(|error| {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let name = path.file_name().ok_or(error)?;
        Ok(fs::canonicalize(folder)?.join(name))
    })
}
