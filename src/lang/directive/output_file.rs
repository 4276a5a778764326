//! Output files of a scene, and the folders they may be in.

use super::open_file::Output;
use crate::base::args::{Parse, Word};
use crate::base::file::Folders;
use crate::base::options::Writes;
use crate::base::source::{Code, Diagnostic, Span, refusal};
use crate::lang::reader::Reader;
use std::io;
use std::path::{Path, PathBuf};

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
        // In a missing folder, opening reports the error.
        if self.options.writable.reach(Path::new(name)) {
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
