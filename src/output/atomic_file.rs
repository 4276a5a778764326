//! Writing of pictures: the bytes go to a temporary file in the same folder, which is then renamed.

use crate::base::file::{Folders, PendingFile};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

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
