//! Output files of a scene, and the folders they may be in.

use super::open_file::Output;
use crate::base::args::{Parse, Word};
use crate::base::file::Folders;
use crate::base::options::Writes;
use crate::base::source::{Code, Diagnostic, Span, refusal};
use crate::lang::reader::Reader;
use std::path::{Path, PathBuf};
use std::{fs, io};

impl Reader<'_> {
    pub(crate) fn open_output(&mut self, name: String, mode: Word, span: Span) -> Parse<Output> {
        self.check_writable(&name, span)?;
        let opened = match self.options.writes {
            Writes::ToDisk => Output::new(name.clone(), mode, &self.options.writable),
            Writes::InMemory => Output::in_memory(name.clone(), mode, self.sources),
        };
        opened.map_err(|error| self.not_written(&name, &error, span))
    }

    /// Rejects a file that the scene may not write.
    pub(crate) fn check_writable(&mut self, name: &str, span: Span) -> Parse<()> {
        if self.may_write(Path::new(name)) {
            return Ok(());
        }
        let allowed: &[PathBuf] = match &self.options.writable {
            Folders::All => &[],
            Folders::Only(folders) => folders,
        };
        let hint = match allowed {
            [] => "This run lets scenes write no files.".to_owned(),
            some => format!(
                "A scene may write into {} and folders in it.",
                folders(some)
            ),
        };
        let message = format!("this scene may not write to `{name}`");
        let mut error = Diagnostic::error(span, message);
        if allowed.is_empty() {
            // The user may run the scene again and allow it: the rest is of no use.
            error.code = Some(Code::WritesFiles);
            self.is_over = true;
        }
        Err(self.with_trace(error.with_hint(hint)))
    }

    /// True if a file lies in a writable folder, with links and `..` resolved.
    fn may_write(&self, path: &Path) -> bool {
        if self.options.writable == Folders::All {
            return true;
        }
        let resolved = fs::canonicalize(path).or_else(|_| -> io::Result<PathBuf> {
            let folder = match path.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            };
            // A dangling link can point anywhere.
            if fs::symlink_metadata(path).is_ok() {
                return Err(io::ErrorKind::InvalidInput.into());
            }
            match path.file_name() {
                Some(name) => Ok(fs::canonicalize(folder)?.join(name)),
                None => Err(io::ErrorKind::InvalidInput.into()),
            }
        });
        // In a missing folder, opening reports the error.
        let resolved = match resolved {
            Err(error) if error.kind() == io::ErrorKind::NotFound => path
                .ancestors()
                .find_map(|folder| fs::canonicalize(folder).ok())
                .or_else(|| fs::canonicalize(".").ok()),
            resolved => resolved.ok(),
        };
        let Some(resolved) = resolved else {
            return false;
        };
        self.options.writable.contain(&resolved)
    }

    pub(crate) fn not_written(&self, name: &str, error: &io::Error, span: Span) -> Box<Diagnostic> {
        let mut error = refusal("write", &name, error);
        error.span = Some(span);
        self.with_trace(error)
    }
}

/// `a`, `a` and `b`.
fn folders(some: &[PathBuf]) -> String {
    let named = |folder: &PathBuf| {
        if folder.as_os_str().is_empty() || folder == Path::new(".") {
            "the current folder".to_owned()
        } else {
            format!("`{}`", folder.display())
        }
    };
    let all: Vec<String> = some.iter().map(named).collect();
    all.join(" and ")
}
