//! Opening of the files that a scene names: regular files only, and without blocking.
//!
//! A pipe without a writer and a terminal never end, and opening a device may trigger an action. So the file type is
//! checked before opening. Another program may replace the file in between, so the file is opened without blocking and
//! checked again. Reading does not block either, because some files in `/proc` look like regular files.

use super::Folders;
use std::error::Error;
use std::fmt;
use std::fs::{File, FileType, Metadata, OpenOptions};
use std::io;
use std::path::Path;

/// Opens a file with `options` if it is a regular one in the folders, or does not exist.
///
/// # Errors
/// An error of the system, a file of another type, or one outside of the folders.
pub(crate) fn open_regular(
    path: &Path,
    options: &OpenOptions,
    folders: &Folders,
) -> io::Result<File> {
    only_regular(path)?;
    let file = nonblocking(options).open(path)?;
    regular(&file.metadata()?)?;
    folders.check_opened(&file, path)?;
    Ok(file)
}

/// Opens a file to append to it, and creates it if it does not exist.
///
/// # Errors
/// As [`open_regular`].
pub(crate) fn open_appending(path: &Path, folders: &Folders) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.append(true);
    match open_regular(path, &options, folders) {
        // A new file is not created through a link, which could lead anywhere.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let created = open_regular(path, options.clone().create_new(true), folders);
            match created {
                // Another process has created it since.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    open_regular(path, &options, folders)
                }
                created => created,
            }
        }
        opened => opened,
    }
}

/// Rejects an existing file that is not a regular one.
///
/// # Errors
/// As [`open_regular`].
pub(crate) fn only_regular(path: &Path) -> io::Result<()> {
    match std::fs::metadata(path) {
        Ok(metadata) => regular(&metadata),
        // Opening the file reports the error.
        Err(_) => Ok(()),
    }
}

fn regular(metadata: &Metadata) -> io::Result<()> {
    if metadata.is_file() {
        return Ok(());
    }
    let kind = kind(metadata.file_type());
    Err(io::Error::new(io::ErrorKind::InvalidInput, Irregular(kind)))
}

/// The type of a file that is not regular, as an error.
#[derive(Debug)]
pub(crate) struct Irregular(&'static str);

impl fmt::Display for Irregular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not a regular file but {}", self.0)
    }
}

impl Error for Irregular {}

#[cfg(unix)]
fn nonblocking(options: &OpenOptions) -> OpenOptions {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt;
    // A terminal must not become the controlling terminal, which could end this process.
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    let mut options = options.clone();
    options.custom_flags(flags.bits().cast_signed());
    options
}

#[cfg(not(unix))]
fn nonblocking(options: &OpenOptions) -> OpenOptions {
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
