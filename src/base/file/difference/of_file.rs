//! Comparison of a file with bytes, without a copy of all of it.

use super::{common_end, common_start};
use crate::base::file::{FileLimits, MAX_FILE_BYTES, Named, open_regular};
use std::fs::{File, OpenOptions};
use std::io;
use std::ops::Range;
use std::path::Path;

/// Bytes that are compared at a time: they stay in the cache of a core.
const COMPARED: usize = 1 << 17;

/// Reads the part of a file in which it differs from these bytes: their range, and those that the file has instead.
/// `None` as for [`read_limited`], and where there are no positioned reads.
///
/// # Errors
/// As [`read_limited`].
pub(crate) fn difference(
    path: &Path,
    named: Named,
    limits: &FileLimits,
    old: &[u8],
) -> io::Result<Option<(Range<usize>, Vec<u8>)>> {
    let file = match named {
        Named::ByUser => File::open(path)?,
        Named::ByScene => open_regular(path, OpenOptions::new().read(true), &limits.folders)?,
    };
    let about = file.metadata()?;
    let is_readable =
        about.is_file() && (1..=MAX_FILE_BYTES.min(limits.bytes)).contains(&about.len());
    let Some(len) = usize::try_from(about.len()).ok().filter(|_| is_readable) else {
        return Ok(None);
    };
    difference_of(&file, len, old)
}

#[cfg(unix)]
fn difference_of(
    file: &File,
    len: usize,
    old: &[u8],
) -> io::Result<Option<(Range<usize>, Vec<u8>)>> {
    use std::os::unix::fs::FileExt;
    let common = len.min(old.len());
    let same = |count: &mut dyn FnMut(usize, &mut [u8]) -> io::Result<usize>| {
        let mut block = vec![0; COMPARED.min(common)];
        let mut done = 0;
        while done < common {
            let block = &mut block[..COMPARED.min(common - done)];
            let equal = count(done, block)?;
            done += equal;
            if equal < block.len() {
                break;
            }
        }
        io::Result::Ok(done)
    };
    let from_start = || {
        same(&mut |done, block| {
            file.read_exact_at(block, done as u64)?;
            Ok(common_start(block, &old[done..done + block.len()]))
        })
    };
    let from_end = || {
        same(&mut |done, block| {
            file.read_exact_at(block, (len - done - block.len()) as u64)?;
            let end = old.len() - done;
            Ok(common_end(block, &old[end - block.len()..end]))
        })
    };
    let (start, end) = rayon::join(from_start, from_end);
    let start = start?;
    let end = end?.min(common - start);
    let mut new = vec![0; len - end - start];
    file.read_exact_at(&mut new, start as u64)?;
    Ok(Some((start..old.len() - end, new)))
}

#[cfg(not(unix))]
fn difference_of(_: &File, _: usize, _: &[u8]) -> io::Result<Option<(Range<usize>, Vec<u8>)>> {
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_part_between_the_common_ends_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let long = |middle: &str| {
            [
                "a".repeat(COMPARED + 3).as_str(),
                middle,
                &"b".repeat(2 * COMPARED + 9),
            ]
            .concat()
        };
        for (old, new) in [
            ("abc".to_owned(), "abc".to_owned()),
            ("abc".to_owned(), "abbc".to_owned()),
            ("abbc".to_owned(), "abc".to_owned()),
            ("aaa".to_owned(), "aaaa".to_owned()),
            ("abc".to_owned(), "x".to_owned()),
            (String::new(), "x".to_owned()),
            (long("1"), long("2")),
            (long(""), long("xyz")),
            (long("xyzx"), long("x")),
            (long("x"), long("x")),
        ] {
            fs::write(&path, &new).unwrap();
            let limits = FileLimits::default();
            let result = difference(&path, Named::ByScene, &limits, old.as_bytes()).unwrap();
            if result.is_none() && cfg!(not(unix)) {
                continue;
            }
            let (range, with) = result.unwrap();
            assert!(with.len() < 10 && range.len() < 10);
            let changed = [
                &old.as_bytes()[..range.start],
                &with,
                &old.as_bytes()[range.end..],
            ];
            assert!(changed.concat() == new.as_bytes());
            assert_eq!(range.is_empty() && with.is_empty(), old == new);
        }
        fs::write(&path, "").unwrap();
        let result = difference(&path, Named::ByScene, &FileLimits::default(), b"a").unwrap();
        assert_eq!(result, None);
    }
}
