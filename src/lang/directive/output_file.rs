//! Output files of a scene, and the folders they may be in.

use crate::base::args::{Parse, Word};
use crate::base::options::Writes;
use crate::base::source::{
    Code, Diagnostic, HeldFile, Sources, Span, only_regular, open_regular, refusal,
};
use crate::lang::reader::Reader;
use crate::output::{Pending, try_to_append, try_to_write};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// An output file.
#[derive(Debug)]
pub(crate) struct Output {
    pub(crate) name: String,
    path: PathBuf,
    to: To,
}

/// The destination of the bytes: a file without its final name, one that has it, or memory.
#[derive(Debug)]
enum To {
    Pending(BufWriter<Pending>),
    Named(BufWriter<File>),
    Memory(HeldFile),
}

impl Output {
    fn new(name: String, mode: Word) -> io::Result<Self> {
        let path = PathBuf::from(&name);
        let to = if mode == Word::Append {
            let file = open_regular(&path, OpenOptions::new().append(true).create(true))?;
            To::Named(BufWriter::new(file))
        } else {
            only_regular(&path)?;
            To::Pending(BufWriter::new(Pending::new(&path)?))
        };
        Ok(Output { name, path, to })
    }

    /// The same without any change on disk.
    fn in_memory(name: String, mode: Word, sources: &mut Sources) -> io::Result<Self> {
        let path = PathBuf::from(&name);
        let held = if mode == Word::Append {
            try_to_append(&path)?;
            sources.held_to_append(&path)
        } else {
            try_to_write(&path)?;
            HeldFile::default()
        };
        let to = To::Memory(held);
        Ok(Output { name, path, to })
    }

    /// True if the output is held in memory.
    pub(crate) fn is_in_memory(&self) -> bool {
        matches!(self.to, To::Memory(_))
    }

    pub(crate) fn write(&mut self, text: &str) -> io::Result<()> {
        match &mut self.to {
            To::Pending(file) => file.write_all(text.as_bytes()),
            To::Named(file) => file.write_all(text.as_bytes()),
            To::Memory(held) => {
                held.write(text);
                Ok(())
            }
        }
    }

    /// Makes everything written so far visible under the file's name.
    pub(crate) fn publish(self, sources: &mut Sources) -> io::Result<Self> {
        let to = match self.to {
            To::Pending(file) => {
                let pending = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                To::Named(BufWriter::new(pending.take_name()?))
            }
            To::Named(mut file) => {
                file.flush()?;
                To::Named(file)
            }
            To::Memory(held) => {
                sources.hold(&self.path, &held);
                To::Memory(held)
            }
        };
        sources.wrote(&self.path);
        Ok(Output { to, ..self })
    }
}

impl Reader<'_> {
    pub(crate) fn open_output(&mut self, name: String, mode: Word, span: Span) -> Parse<Output> {
        self.check_writable(&name, span)?;
        let opened = match self.options.writes {
            Writes::ToDisk => Output::new(name.clone(), mode),
            Writes::InMemory => Output::in_memory(name.clone(), mode, self.sources),
        };
        opened.map_err(|error| self.not_written(&name, &error, span))
    }

    /// Rejects a file that the scene may not write.
    pub(crate) fn check_writable(&mut self, name: &str, span: Span) -> Parse<()> {
        if self.may_write(Path::new(name)) {
            return Ok(());
        }
        let allowed = &self.options.writable;
        let hint = match allowed.as_slice() {
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
        let mut allowed = self.options.writable.iter();
        allowed
            .any(|folder| fs::canonicalize(folder).is_ok_and(|folder| resolved.starts_with(folder)))
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
