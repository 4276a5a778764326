//! Bytes to a file, whole or not at all: a temporary file in the same folder takes them, then takes the name.

use crate::base::source::only_regular;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Replaces the file at `path`. Where the name is that of a link, the file it points to is replaced; where it is
/// that of a device or a pipe, the bytes go into it.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace_by(path, |file| file.write_all(bytes))
}

/// The same with what `write` writes.
pub(super) fn replace_by<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut dyn Write>) -> Result<(), E>,
) -> Result<(), E> {
    let buffered = |file: &mut dyn Write| {
        let mut file = BufWriter::new(file);
        write(&mut file)?;
        Ok(file.flush()?)
    };
    if let Ok(found) = fs::metadata(path) {
        if found.is_dir() {
            return Err(io::Error::from(io::ErrorKind::IsADirectory).into());
        }
        if !found.is_file() {
            return buffered(&mut File::options().write(true).open(path)?);
        }
    }
    let mut file = Pending::new(path)?;
    buffered(&mut file)?;
    file.take_name()?;
    Ok(())
}

/// Replaces the file that a scene names, unless it is a device or a pipe.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> io::Result<()> {
    only_regular(path)?;
    let mut file = Pending::new(path)?;
    file.write_all(bytes)?;
    file.take_name().map(drop)
}

/// Refuses a file that could not be written anew.
///
/// # Errors
/// What stands in the way.
pub(crate) fn try_to_write(path: &Path) -> io::Result<()> {
    only_regular(path)?;
    may_be_written(&folder_of(path).join("."))
}

/// Refuses a file that could not be appended to.
///
/// # Errors
/// What stands in the way.
pub(crate) fn try_to_append(path: &Path) -> io::Result<()> {
    if !path.exists() {
        return try_to_write(path);
    }
    only_regular(path)?;
    may_be_written(path)
}

#[cfg(unix)]
fn may_be_written(path: &Path) -> io::Result<()> {
    Ok(rustix::fs::access(path, rustix::fs::Access::WRITE_OK)?)
}

#[cfg(not(unix))]
fn may_be_written(path: &Path) -> io::Result<()> {
    fs::metadata(path).map(drop)
}

/// A file that is being written and has not its name yet; dropped, it leaves nothing.
#[derive(Debug)]
pub(crate) struct Pending {
    file: tempfile::NamedTempFile,
    place: PathBuf,
}

impl Pending {
    /// An empty file that will take the place of the one at `path`, with its mode, or of the one a link points to.
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let mut builder = tempfile::Builder::new();
        builder.prefix(".povr-").suffix(".part");
        open_to_others(&mut builder);
        let folder = folder_of(&place);
        // What the folder refuses is said without the name of the temporary file, which means nothing to anybody.
        let refused = |error| may_be_written(&folder.join(".")).err().unwrap_or(error);
        let file = builder.tempfile_in(&folder).map_err(refused)?;
        if let Ok(found) = fs::metadata(&place) {
            file.as_file().set_permissions(found.permissions())?;
        }
        Ok(Pending { file, place })
    }

    /// Gives the file its name; it may be written further.
    pub(crate) fn take_name(self) -> io::Result<File> {
        self.file
            .persist(&self.place)
            .map_err(|refused| refused.error)
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The folder in which `path` lies.
pub(super) fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Temporary files are their owner's alone by default; a picture has the mode of any other new file.
#[cfg(unix)]
fn open_to_others(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn open_to_others(_: &mut tempfile::Builder<'_, '_>) {}
