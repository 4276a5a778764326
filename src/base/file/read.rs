//! Reading of files, up to a size limit.

use super::{Folders, open_regular};
use rayon::prelude::*;
use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

/// Larger files are rejected. Decoding doubles the size if all bytes are Latin-1 letters, and offsets in the text must
/// still fit in 32 bits.
pub const MAX_FILE_BYTES: u64 = 1 << 31;

/// Size limit of files without a known length that the user names: `/dev/zero` has no end.
pub(crate) const MAX_STREAM_BYTES: u64 = 1 << 28;

/// The same for files that a scene names: regular files without a length, which are those in `/proc`.
const MAX_LENGTHLESS_BYTES: u64 = 1 << 24;

/// Bytes of a large file that a thread copies at a time.
const PART: usize = 1 << 20;

/// Origin of a file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Named {
    /// The user who starts the program, and may wait for a pipe.
    ByUser,
    /// A scene, which is untrusted: regular files only.
    ByScene,
}

/// Limits on the files that a scene reads.
#[derive(Clone, Debug)]
pub(crate) struct FileLimits {
    /// Where they may lie.
    pub(crate) folders: Folders,
    /// Bytes that may still be read in this run.
    pub(crate) bytes: u64,
}

impl Default for FileLimits {
    fn default() -> Self {
        FileLimits {
            folders: Folders::All,
            bytes: u64::MAX,
        }
    }
}

/// Reads a file; `None` for more than [`MAX_FILE_BYTES`] or `limits`, or more than [`MAX_STREAM_BYTES`] if the length is
/// unknown.
pub(crate) fn read_limited(
    path: &Path,
    named: Named,
    limits: &FileLimits,
) -> io::Result<Option<Vec<u8>>> {
    let file = match named {
        Named::ByUser => File::open(path)?,
        Named::ByScene => open_regular(path, OpenOptions::new().read(true), &limits.folders)?,
    };
    let about = file.metadata()?;
    let has_length = about.is_file() && about.len() > 0;
    let limit = match (has_length, named) {
        (true, _) => MAX_FILE_BYTES,
        (false, Named::ByUser) => MAX_STREAM_BYTES,
        (false, Named::ByScene) => MAX_LENGTHLESS_BYTES,
    };
    let limit = limit.min(limits.bytes);
    if about.len() > limit {
        return Ok(None);
    }
    if has_length && let Some(bytes) = read_in_parallel(&file, about.len()) {
        return Ok(Some(bytes));
    }
    let mut bytes = Vec::new();
    let mut reader = file.take(limit + 1);
    reader.read_to_end(&mut bytes)?;
    Ok((reader.limit() > 0).then_some(bytes))
}

/// Reads a regular file of up to `limit` bytes.
///
/// # Errors
/// An error of the system, a file of another type, or a larger one.
#[cfg(feature = "cli")]
pub(crate) fn read_regular(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = open_regular(path, OpenOptions::new().read(true), &Folders::All)?;
    let mut reader = file.take(limit.saturating_add(1));
    reader.read_to_end(&mut bytes)?;
    match reader.limit() {
        0 => Err(io::ErrorKind::FileTooLarge.into()),
        _ => Ok(bytes),
    }
}

/// Reads a large file on several threads; `None` if that fails or the file is too small to be worth it.
#[cfg(unix)]
fn read_in_parallel(file: &File, len: u64) -> Option<Vec<u8>> {
    use std::os::unix::fs::FileExt;
    let len = usize::try_from(len).ok().filter(|len| *len >= 2 * PART)?;
    // A vector of zeros comes without writing them, but aborts where there is no memory.
    Vec::<u8>::new().try_reserve_exact(len).ok()?;
    let mut bytes = vec![0; len];
    let parts = bytes.par_chunks_mut(PART).enumerate();
    parts
        .map(|(number, part)| file.read_exact_at(part, (number * PART) as u64))
        .collect::<io::Result<()>>()
        .ok()?;
    Some(bytes)
}

/// Without positioned reads, a single thread reads the file.
#[cfg(not(unix))]
fn read_in_parallel(_: &File, _: u64) -> Option<Vec<u8>> {
    None
}
