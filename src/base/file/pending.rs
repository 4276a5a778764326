//! Atomic file replacement: the bytes go to a temporary file in the same folder, which is then renamed.

use super::folders::Outside;
use super::{Folders, only_regular};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Replaces a file that a scene names. Devices and pipes are an error.
pub(crate) fn save(path: &Path, bytes: &[u8], folders: &Folders) -> io::Result<()> {
    only_regular(path)?;
    let mut file = PendingFile::new(path, folders)?;
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
    /// The open folder through which both are named; dropped after the temporary file.
    _folder: Option<File>,
}

impl PendingFile {
    /// Creates an empty temporary file that will replace the file at `path`, or the target of a link there, with the
    /// same mode.
    ///
    /// # Errors
    /// An error of the system, or a file outside of the folders.
    pub(crate) fn new(path: &Path, folders: &Folders) -> io::Result<Self> {
        let mut destination = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let mut folder = folder_of(&destination);
        // Errors of the folder are reported without the name of the temporary file, which means nothing to the user.
        let named = folder.join(".");
        let folder_error = |error| {
            check_writable(&named)
                .err()
                .unwrap_or_else(|| of_system(error))
        };
        let mut opened = None;
        if *folders != Folders::All {
            opened = held_folder(&folder).map_err(folder_error)?;
            match (&opened, destination.file_name()) {
                (Some(file), Some(name)) => {
                    folders.check_opened(file, &folder)?;
                    if let Some(fixed) = fixed_path(file) {
                        destination = fixed.join(name);
                        folder = fixed;
                    }
                }
                _ if folders.hold(&folder) => {}
                _ => return Err(Outside.into()),
            }
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".povr-").suffix(".part");
        set_default_mode(&mut builder);
        let file = builder.tempfile_in(&folder).map_err(folder_error)?;
        if let Ok(metadata) = fs::metadata(&destination) {
            file.as_file().set_permissions(metadata.permissions())?;
        }
        Ok(PendingFile {
            file,
            destination,
            _folder: opened,
        })
    }

    /// Renames the temporary file to its destination and returns it for further writing.
    pub(crate) fn persist(self) -> io::Result<File> {
        self.file
            .persist(&self.destination)
            .map_err(|persist_error| persist_error.error)
    }
}

/// The error of the system for one of `tempfile`, which names the temporary file and drops the number of the error.
#[cfg(unix)]
fn of_system(error: io::Error) -> io::Error {
    use rustix::io::Errno;
    match error.kind() {
        _ if error.raw_os_error().is_some() => error,
        io::ErrorKind::StorageFull => Errno::NOSPC.into(),
        io::ErrorKind::QuotaExceeded => Errno::DQUOT.into(),
        io::ErrorKind::ReadOnlyFilesystem => Errno::ROFS.into(),
        kind => kind.into(),
    }
}

#[cfg(not(unix))]
fn of_system(error: io::Error) -> io::Error {
    error.kind().into()
}

/// The folder, opened only to name it: it need not be readable.
#[cfg(target_os = "linux")]
fn held_folder(path: &Path) -> io::Result<Option<File>> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::PATH | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let folder = rustix::fs::open(path, flags, Mode::empty())?;
    Ok(Some(folder.into()))
}

/// Other systems cannot name an open folder.
#[cfg(not(target_os = "linux"))]
fn held_folder(_: &Path) -> io::Result<Option<File>> {
    Ok(None)
}

/// A path that names this open folder even if another process moves it, or puts a link in its position.
#[cfg(target_os = "linux")]
fn fixed_path(folder: &File) -> Option<PathBuf> {
    use std::os::fd::AsRawFd;
    let path = PathBuf::from(format!("/proc/self/fd/{}", folder.as_raw_fd()));
    path.is_dir().then_some(path)
}

#[cfg(not(target_os = "linux"))]
fn fixed_path(_: &File) -> Option<PathBuf> {
    None
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Its own `write` adds the name of the temporary file to errors.
        self.file.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_file_mut().flush()
    }
}

/// The folder that contains `path`.
pub(crate) fn folder_of(path: &Path) -> PathBuf {
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
