//! Writing of pictures: the bytes go to a temporary file in the same folder, which is then renamed.

use crate::base::file::{Folders, PendingFile, check_replaceable};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Checks that [`replace`] can write to `path`, as far as the system tells without opening anything.
pub(super) fn check(path: &Path) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if !metadata.is_file() => Ok(()),
        _ => check_replaceable(&fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())),
    }
}

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
    let mut file = PendingFile::new(path, &Folders::All)?;
    buffered(&mut file)?;
    file.persist()?;
    Ok(())
}
