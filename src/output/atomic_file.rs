//! Atomic file replacement: the bytes go to a temporary file in the same folder, which is then renamed.

use crate::base::source::only_regular;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Replaces the file at `path`. If `path` is a symbolic link, its target is replaced. If it is a device or a pipe, the
/// bytes are written to it.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace_by(path, |file| file.write_all(bytes))
}

/// As [`replace`], with the bytes that `write` produces.
pub(super) fn replace_by<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut dyn Write>) -> Result<(), E>,
) -> Result<(), E> {
    let buffered = |file: &mut dyn Write| {
        let mut file = BufWriter::new(file);
        write(&mut file)?;
        Ok(file.flush()?)
    };
    if let Ok(metadata) = fs::metadata(path) {
        if metadata.is_dir() {
            return Err(io::Error::from(io::ErrorKind::IsADirectory).into());
        }
        if !metadata.is_file() {
            return buffered(&mut File::options().write(true).open(path)?);
        }
    }
    let mut file = PendingFile::new(path)?;
    buffered(&mut file)?;
    file.persist()?;
    Ok(())
}

/// Replaces a file that a scene names. Devices and pipes are an error.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> io::Result<()> {
    only_regular(path)?;
    let mut file = PendingFile::new(path)?;
    file.write_all(bytes)?;
    file.persist().map(drop)
}

/// Checks that a file can be created or replaced.
///
/// # Errors
/// The reason why it cannot.
pub(crate) fn check_replaceable(path: &Path) -> io::Result<()> {
    only_regular(path)?;
    check_writable(&folder_of(path).join("."))
}

/// Checks that a file can be appended to.
///
/// # Errors
/// The reason why it cannot.
pub(crate) fn check_appendable(path: &Path) -> io::Result<()> {
    if !path.exists() {
        return check_replaceable(path);
    }
    only_regular(path)?;
    check_writable(path)
}

#[cfg(unix)]
fn check_writable(path: &Path) -> io::Result<()> {
    Ok(rustix::fs::access(path, rustix::fs::Access::WRITE_OK)?)
}

#[cfg(not(unix))]
fn check_writable(path: &Path) -> io::Result<()> {
    fs::metadata(path).map(drop)
}

/// A temporary file that replaces its destination in [`PendingFile::persist`]. Dropping it deletes the temporary file.
#[derive(Debug)]
pub(crate) struct PendingFile {
    file: tempfile::NamedTempFile,
    destination: PathBuf,
}

impl PendingFile {
    /// Creates an empty temporary file that will replace the file at `path`, or the target of a link there, with the
    /// same mode.
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        let destination = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let mut builder = tempfile::Builder::new();
        builder.prefix(".povr-").suffix(".part");
        set_default_mode(&mut builder);
        let folder = folder_of(&destination);
        // Errors of the folder are reported without the name of the temporary file, which means nothing to the user.
        let folder_error = |error| check_writable(&folder.join(".")).err().unwrap_or(error);
        let file = builder.tempfile_in(&folder).map_err(folder_error)?;
        if let Ok(metadata) = fs::metadata(&destination) {
            file.as_file().set_permissions(metadata.permissions())?;
        }
        Ok(PendingFile { file, destination })
    }

    /// Renames the temporary file to its destination and returns it for further writing.
    pub(crate) fn persist(self) -> io::Result<File> {
        self.file
            .persist(&self.destination)
            .map_err(|persist_error| persist_error.error)
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The folder that contains `path`.
pub(super) fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Gives the temporary file the mode of any other new file. By default only its owner may read it.
#[cfg(unix)]
fn set_default_mode(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn set_default_mode(_: &mut tempfile::Builder<'_, '_>) {}
