//! Opening of the files that a scene names: regular files only, and without waiting.
//!
//! A pipe that nobody writes to and a terminal never end, and a device may be set to work by being opened. So the kind
//! of a file is looked at before it is opened. It is opened without waiting and looked at again, since another program
//! may have put something else in its place meanwhile; and reading does not wait either, for some files of `/proc` are
//! regular to all appearances.

use super::Diagnostic;
use std::error::Error;
use std::fmt;
use std::fs::{File, FileType, Metadata, OpenOptions};
use std::io;
use std::path::Path;

/// Opens a file for what `options` say, if it is a regular one, or a new one.
///
/// # Errors
/// When the system refuses, or the file is of another kind, as [`refusal`] puts into words.
pub(crate) fn open_regular(path: &Path, options: &OpenOptions) -> io::Result<File> {
    only_regular(path)?;
    let file = without_waiting(options).open(path)?;
    regular(&file.metadata()?)?;
    Ok(file)
}

/// Refuses a file that is there and not a regular one.
///
/// # Errors
/// As [`open_regular`].
pub(crate) fn only_regular(path: &Path) -> io::Result<()> {
    match std::fs::metadata(path) {
        Ok(about) => regular(&about),
        // Opening tells what is wrong.
        Err(_) => Ok(()),
    }
}

/// An error about a file as a finding without a place; `verb` is what was to be done with it.
pub(crate) fn refusal(verb: &str, name: &dyn fmt::Display, error: &io::Error) -> Diagnostic {
    let inner = error.get_ref();
    match inner.and_then(|inner| inner.downcast_ref::<Irregular>()) {
        Some(irregular) => Diagnostic::error(None, format!("`{name}` is {irregular}"))
            .with_hint(format!("A scene can {verb} regular files only.")),
        None => Diagnostic::error(None, format!("cannot {verb} `{name}`: {error}")),
    }
}

fn regular(about: &Metadata) -> io::Result<()> {
    if about.is_file() {
        return Ok(());
    }
    let kind = kind(about.file_type());
    Err(io::Error::new(io::ErrorKind::InvalidInput, Irregular(kind)))
}

/// A file of another kind, named here.
#[derive(Debug)]
struct Irregular(&'static str);

impl fmt::Display for Irregular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not a regular file but {}", self.0)
    }
}

impl Error for Irregular {}

#[cfg(unix)]
fn without_waiting(options: &OpenOptions) -> OpenOptions {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt;
    // A terminal that is opened must not become the one that ends this process.
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    let mut options = options.clone();
    options.custom_flags(flags.bits().cast_signed());
    options
}

#[cfg(not(unix))]
fn without_waiting(options: &OpenOptions) -> OpenOptions {
    options.clone()
}

#[cfg(unix)]
fn kind(of: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match of {
        of if of.is_dir() => "a folder",
        of if of.is_fifo() => "a pipe",
        of if of.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
fn kind(of: FileType) -> &'static str {
    if of.is_dir() { "a folder" } else { "a device" }
}
