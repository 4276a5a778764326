//! Bytes to a file, whole or not at all: a temporary file in the same folder takes them, then takes the name.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Replaces the file at `path`. Where the name is that of a link, the file it points to is replaced; where it is
/// that of a device or a pipe, the bytes go into it.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let existing = fs::metadata(path).ok();
    if let Some(found) = &existing {
        if found.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        if !found.is_file() {
            return File::options().write(true).open(path)?.write_all(bytes);
        }
    }
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".povr-").suffix(".part");
    open_to_others(&mut builder);
    let mut file = builder.tempfile_in(folder_of(&place))?;
    file.write_all(bytes)?;
    if let Some(found) = existing {
        file.as_file().set_permissions(found.permissions())?;
    }
    file.persist(&place).map_err(|refused| refused.error)?;
    Ok(())
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
