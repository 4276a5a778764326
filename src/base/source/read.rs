//! The bytes of files, up to a limit.

use super::regular::open_regular;
use rayon::prelude::*;
use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

/// Files of more bytes are refused. Twice as many still have 32-bit offsets, if all of them are Latin-1.
pub const MAX_FILE_BYTES: u64 = 1 << 31;

/// What does not tell its length is refused if it has more bytes: `/dev/zero` has no end.
pub(super) const MAX_STREAM_BYTES: u64 = 1 << 28;

/// Each thread copies so many bytes of a large file at a time.
const PART: usize = 1 << 20;

/// The origin of the name of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// Whoever starts the program, who may wait for a pipe.
    ByUser,
    /// A scene, which may come from anybody: regular files only.
    ByScene,
}

/// The bytes of a file; `None` for more than [`MAX_FILE_BYTES`], or more than [`MAX_STREAM_BYTES`] of what does not tell
/// its length.
pub(super) fn read_limited(path: &Path, named: Named) -> io::Result<Option<Vec<u8>>> {
    let file = match named {
        Named::ByUser => File::open(path)?,
        Named::ByScene => open_regular(path, OpenOptions::new().read(true))?,
    };
    let about = file.metadata()?;
    if about.len() > MAX_FILE_BYTES {
        return Ok(None);
    }
    let tells_length = about.is_file() && about.len() > 0;
    let most = if tells_length {
        MAX_FILE_BYTES
    } else {
        MAX_STREAM_BYTES
    };
    if tells_length && let Some(bytes) = read_by_all(&file, about.len()) {
        return Ok(Some(bytes));
    }
    let mut bytes = Vec::new();
    let mut limited = file.take(most + 1);
    limited.read_to_end(&mut bytes)?;
    Ok((limited.limit() > 0).then_some(bytes))
}

/// The bytes of a regular file of any length.
#[cfg(feature = "cli")]
pub(crate) fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path, OpenOptions::new().read(true))?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The bytes of a large file, copied by several threads; `None` if that does not work, or is not worth while.
#[cfg(unix)]
fn read_by_all(file: &File, len: u64) -> Option<Vec<u8>> {
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

/// Elsewhere by one thread.
#[cfg(not(unix))]
fn read_by_all(_: &File, _: u64) -> Option<Vec<u8>> {
    None
}
