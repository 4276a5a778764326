//! Reading of files, up to a size limit.

use super::regular::open_regular;
use rayon::prelude::*;
use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

/// Larger files are rejected. Decoding doubles the size if all bytes are Latin-1 letters, and offsets in the text must
/// still fit in 32 bits.
pub const MAX_FILE_BYTES: u64 = 1 << 31;

/// Size limit of files without a known length: `/dev/zero` has no end.
pub(super) const MAX_STREAM_BYTES: u64 = 1 << 28;

/// Bytes of a large file that a thread copies at a time.
const PART: usize = 1 << 20;

/// Origin of a file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// The user who starts the program, and may wait for a pipe.
    ByUser,
    /// A scene, which is untrusted: regular files only.
    ByScene,
}

/// Reads a file; `None` for more than [`MAX_FILE_BYTES`], or more than [`MAX_STREAM_BYTES`] if the length is unknown.
pub(super) fn read_limited(path: &Path, named: Named) -> io::Result<Option<Vec<u8>>> {
    let file = match named {
        Named::ByUser => File::open(path)?,
        Named::ByScene => open_regular(path, OpenOptions::new().read(true))?,
    };
    let about = file.metadata()?;
    if about.len() > MAX_FILE_BYTES {
        return Ok(None);
    }
    let has_length = about.is_file() && about.len() > 0;
    let limit = if has_length {
        MAX_FILE_BYTES
    } else {
        MAX_STREAM_BYTES
    };
    if has_length && let Some(bytes) = read_in_parallel(&file, about.len()) {
        return Ok(Some(bytes));
    }
    let mut bytes = Vec::new();
    let mut reader = file.take(limit + 1);
    reader.read_to_end(&mut bytes)?;
    Ok((reader.limit() > 0).then_some(bytes))
}

/// Reads a regular file of any length.
#[cfg(feature = "cli")]
pub(crate) fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path, OpenOptions::new().read(true))?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a large file on several threads; `None` if that fails or the file is too small to be worth it.
#[cfg(unix)]
fn read_in_parallel(file: &File, len: u64) -> Option<Vec<u8>> {
    use std::os::unix::fs::FileExt;
    let len = usize::try_from(len).ok().filter(|len| *len >= 2 * PART)?;
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
