//! Checkpoint of an unfinished picture on disk, from which a later run continues.
//!
//! The file begins with a magic word and a key. Then comes a record for every finished tile or band, appended in one
//! write each: the key, the rectangle, its pixels, and a checksum over all of it. A run that is killed leaves whole
//! records and perhaps a torn one at the end, which is cut off. The key identifies the scene, all files it reads, the
//! options and the program: a checkpoint with another key is not used. Numbers are little-endian.

use crate::base::file::{Folders, open_regular};
use crate::base::film::Pixel;
use crate::base::options::CheckpointOptions;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

const MAGIC: &[u8; 16] = b"povr unfinished\n";
/// Key, rectangle, number of samples, and a flag for errors.
const HEAD: usize = 8 + 4 * 4 + 8 + 1;
/// Red, green, blue, transmit in single precision.
const PIXEL: usize = 16;
/// The estimated error of a pixel in double precision.
const ERROR: usize = 8;
const CHECKSUM: usize = 4;
/// A picture that takes less time is rendered again as quickly as it is continued.
const WORTH_KEEPING: Duration = Duration::from_secs(2);

/// A rectangle of finished pixels, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CheckpointTile {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
    pub(super) pixels: Vec<Pixel>,
    /// With adaptive sampling: the estimated errors, and the number of samples.
    pub(super) errors: Vec<f64>,
    pub(super) samples: u64,
}

/// State of the file when a checkpoint was opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointStatus {
    /// No checkpoint.
    Nothing,
    /// A checkpoint of another scene, other options or another program.
    Other,
    /// This many pixels of the picture.
    Pixels(u64),
}

/// A checkpoint that grows while the picture is rendered.
#[derive(Debug)]
pub struct Checkpoint {
    key: u64,
    previous: Vec<CheckpointTile>,
    state: Mutex<FileState>,
    /// The number of pixels in the file.
    pixels: AtomicU64,
}

#[derive(Debug)]
enum FileState {
    /// Nothing is written before this moment. Until then tiles that carry a running sample count are buffered; others
    /// are rendered again in as little time.
    Waiting(CheckpointOptions, Instant, Vec<u8>),
    File(File),
    /// Writing failed: rendering goes on without.
    Failed(io::ErrorKind),
}

impl Checkpoint {
    /// Opens the checkpoint of a picture of `size`, if this run is to continue it, and stores the tiles to come.
    #[must_use]
    pub fn open(
        keep: &CheckpointOptions,
        key: u64,
        size: (u32, u32),
    ) -> (Checkpoint, CheckpointStatus) {
        let (mut status, mut tiles, mut file) = (CheckpointStatus::Nothing, Vec::new(), None);
        if keep.resume {
            match read_tiles(keep, key, size) {
                Ok(Some((opened, there))) => {
                    status = CheckpointStatus::Pixels(
                        there.iter().map(|tile| tile.pixels.len() as u64).sum(),
                    );
                    (tiles, file) = (there, Some(FileState::File(opened)));
                }
                Ok(None) => status = CheckpointStatus::Other,
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => file = Some(FileState::Failed(error.kind())),
            }
        }
        let state = file.unwrap_or_else(|| {
            if keep.resume {
                begin(keep, key, &[])
            } else {
                let now = Instant::now();
                let then = now.checked_add(WORTH_KEEPING).unwrap_or(now);
                FileState::Waiting(keep.clone(), then, Vec::new())
            }
        });
        let pixels = tiles.iter().map(|tile| tile.pixels.len() as u64).sum();
        let unfinished = Checkpoint {
            key,
            previous: tiles,
            state: Mutex::new(state),
            pixels: AtomicU64::new(pixels),
        };
        (unfinished, status)
    }

    /// The tiles read from the file.
    pub(super) fn tiles(&self) -> &[CheckpointTile] {
        &self.previous
    }

    /// The tile with exactly this rectangle, if the file had it.
    pub(super) fn tile(&self, columns: &Range<u32>, rows: &Range<u32>) -> Option<&CheckpointTile> {
        let mut tiles = self.previous.iter();
        tiles.find(|tile| tile.columns == *columns && tile.rows == *rows)
    }

    /// Stores a finished tile.
    pub(super) fn keep(&self, tile: &CheckpointTile) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        match &mut *state {
            FileState::Waiting(keep, then, waiting) => {
                let is_time = Instant::now() >= *then;
                if is_time || !tile.errors.is_empty() {
                    waiting.extend_from_slice(&record(self.key, tile));
                    self.count(tile);
                }
                if is_time {
                    *state = begin(keep, self.key, waiting);
                    if let FileState::Failed(_) = *state {
                        self.pixels.store(0, Ordering::Relaxed);
                    }
                }
            }
            FileState::File(file) => match file.write_all(&record(self.key, tile)) {
                Ok(()) => self.count(tile),
                Err(error) => *state = FileState::Failed(error.kind()),
            },
            FileState::Failed(_) => {}
        }
    }

    fn count(&self, tile: &CheckpointTile) {
        let pixels = tile.pixels.len() as u64;
        self.pixels.fetch_add(pixels, Ordering::Relaxed);
    }

    /// The number of pixels that a later run can reuse; `None` if nothing is stored.
    #[must_use]
    pub fn resumable_pixels(&self) -> Option<u64> {
        match &*self.state.lock().unwrap_or_else(PoisonError::into_inner) {
            FileState::Waiting(..) => None,
            // Whole records stay on a full disk.
            FileState::File(_) | FileState::Failed(_) => {
                Some(self.pixels.load(Ordering::Relaxed)).filter(|&pixels| pixels > 0)
            }
        }
    }

    /// The error because of which nothing is stored.
    #[must_use]
    pub fn trouble(&self) -> Option<io::ErrorKind> {
        match &*self.state.lock().unwrap_or_else(PoisonError::into_inner) {
            FileState::Failed(kind) => Some(*kind),
            _ => None,
        }
    }
}

/// Creates the file with the buffered tiles.
fn begin(keep: &CheckpointOptions, key: u64, waiting: &[u8]) -> FileState {
    let made = || -> io::Result<File> {
        // Another process may still write to a file of this name: writing to a removed file does no harm.
        match std::fs::remove_file(&keep.file) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut options = OpenOptions::new();
        let mut file = options.append(true).create_new(true).open(&keep.file)?;
        let written = file.write_all(&[MAGIC.as_slice(), &key.to_le_bytes(), waiting].concat());
        written.inspect_err(|_| {
            // A torn beginning is of no use, and takes the disk space of the picture.
            let _ = std::fs::remove_file(&keep.file);
        })?;
        Ok(file)
    };
    made().map_or_else(|error| FileState::Failed(error.kind()), FileState::File)
}

/// Opens a file with this key at the end of its last whole record; `None` if it has another key.
fn read_tiles(
    keep: &CheckpointOptions,
    key: u64,
    size: (u32, u32),
) -> io::Result<Option<(File, Vec<CheckpointTile>)>> {
    let mut file = open_regular(
        &keep.file,
        OpenOptions::new().read(true).append(true),
        &Folders::All,
    )?;
    let mut bytes = Vec::new();
    // A record for every pixel is the longest possible file of this picture.
    let most = u64::from(size.0) * u64::from(size.1) * (HEAD + PIXEL + ERROR + CHECKSUM) as u64;
    Read::by_ref(&mut file)
        .take(most.saturating_add(1 << 20))
        .read_to_end(&mut bytes)?;
    let head = [MAGIC.as_slice(), &key.to_le_bytes()].concat();
    if !bytes.starts_with(&head) {
        return Ok(None);
    }
    let (mut tiles, mut at) = (Vec::new(), head.len());
    while let Some((tile, length)) = read_record(&bytes[at..], key, size) {
        tiles.push(tile);
        at += length;
    }
    file.set_len(at as u64)?;
    file.seek(SeekFrom::End(0))?;
    Ok(Some((file, tiles)))
}

fn record(key: u64, tile: &CheckpointTile) -> Vec<u8> {
    let has_errors = !tile.errors.is_empty();
    let of_pixel = PIXEL + if has_errors { ERROR } else { 0 };
    let mut bytes = Vec::with_capacity(HEAD + tile.pixels.len() * of_pixel + CHECKSUM);
    bytes.extend_from_slice(&key.to_le_bytes());
    for edge in [
        tile.columns.start,
        tile.columns.end,
        tile.rows.start,
        tile.rows.end,
    ] {
        bytes.extend_from_slice(&edge.to_le_bytes());
    }
    bytes.extend_from_slice(&tile.samples.to_le_bytes());
    bytes.push(u8::from(has_errors));
    for pixel in &tile.pixels {
        for value in [pixel.rgb.r, pixel.rgb.g, pixel.rgb.b, pixel.transmit] {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
    }
    for error in &tile.errors {
        bytes.extend_from_slice(&error.to_le_bytes());
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend_from_slice(&sum.to_le_bytes());
    bytes
}

/// The record at the start of some bytes, and its length; `None` if it is incomplete or of another picture.
fn read_record(bytes: &[u8], key: u64, size: (u32, u32)) -> Option<(CheckpointTile, usize)> {
    let mut rest = bytes;
    let mut part = |length: usize| -> Option<&[u8]> {
        let (part, behind) = rest.split_at_checked(length)?;
        rest = behind;
        Some(part)
    };
    if part(8)? != key.to_le_bytes() {
        return None;
    }
    let mut edge = || Some(u32::from_le_bytes(part(4)?.try_into().ok()?));
    let (columns, rows) = (edge()?..edge()?, edge()?..edge()?);
    let is_within = |range: &Range<u32>, side: u32| range.start < range.end && range.end <= side;
    if !is_within(&columns, size.0) || !is_within(&rows, size.1) {
        return None;
    }
    let samples = u64::from_le_bytes(part(8)?.try_into().ok()?);
    let has_errors = part(1)?[0] == 1;
    let count = columns.len().checked_mul(rows.len())?;
    let stored = part(count.checked_mul(PIXEL)?)?;
    let errors = part(if has_errors {
        count.checked_mul(ERROR)?
    } else {
        0
    })?;
    let length = HEAD + stored.len() + errors.len();
    let sum = part(CHECKSUM)?;
    if crc32fast::hash(&bytes[..length]).to_le_bytes() != sum {
        return None;
    }
    let single = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let pixels = stored.chunks_exact(PIXEL).map(|pixel| Pixel {
        rgb: crate::base::color::Rgb::new(single(pixel), single(&pixel[4..]), single(&pixel[8..])),
        transmit: single(&pixel[12..]),
    });
    let errors = errors.chunks_exact(ERROR);
    let tile = CheckpointTile {
        columns,
        rows,
        pixels: pixels.collect(),
        errors: errors
            .filter_map(|error| Some(f64::from_le_bytes(error.try_into().ok()?)))
            .collect(),
        samples,
    };
    Some((tile, length + CHECKSUM))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use std::fs;

    const SIZE: (u32, u32) = (10, 6);

    fn tile(column: u32, errors: usize) -> CheckpointTile {
        let pixel = |value: f32| Pixel {
            rgb: Rgb::new(value, -0.0, f32::MIN_POSITIVE),
            transmit: 0.25,
        };
        CheckpointTile {
            columns: column..column + 2,
            rows: 1..2,
            pixels: vec![pixel(0.1), pixel(7.5)],
            errors: vec![0.125; errors],
            samples: 33,
        }
    }

    fn checkpoint_options(folder: &tempfile::TempDir) -> CheckpointOptions {
        CheckpointOptions {
            file: folder.path().join("a.povr-state"),
            resume: true,
            build: String::new(),
        }
    }

    #[test]
    fn stored_tiles_are_read_back_bit_for_bit_after_truncation() {
        let folder = tempfile::tempdir().unwrap();
        let keep = checkpoint_options(&folder);
        let (first, status) = Checkpoint::open(&keep, 7, SIZE);
        assert_eq!(status, CheckpointStatus::Nothing);
        let tiles = [tile(0, 0), tile(2, 2), tile(4, 0)];
        tiles.iter().for_each(|tile| first.keep(tile));
        let whole = fs::read(&keep.file).unwrap();
        let ends: Vec<usize> = (0..=3)
            .map(|n| 24 + tiles[..n].iter().map(|p| record(7, p).len()).sum::<usize>())
            .collect();
        assert_eq!(whole.len(), ends[3]);
        for length in 0..=whole.len() {
            fs::write(&keep.file, &whole[..length]).unwrap();
            let (again, status) = Checkpoint::open(&keep, 7, SIZE);
            let there = ends.iter().filter(|&&end| end <= length).count();
            match there.checked_sub(1) {
                None => assert_eq!(status, CheckpointStatus::Other),
                Some(there) => {
                    assert_eq!(again.tiles(), &tiles[..there], "{length}");
                    // It continues behind the last whole record.
                    again.keep(&tile(6, 0));
                    let (last, _) = Checkpoint::open(&keep, 7, SIZE);
                    assert_eq!(last.tiles().len(), there + 1);
                    assert!(last.tile(&(6..8), &(1..2)).is_some());
                }
            }
        }
    }

    #[test]
    fn reading_ends_at_a_changed_byte() {
        let folder = tempfile::tempdir().unwrap();
        let keep = checkpoint_options(&folder);
        let (first, _) = Checkpoint::open(&keep, 7, SIZE);
        first.keep(&tile(0, 2));
        first.keep(&tile(2, 2));
        let whole = fs::read(&keep.file).unwrap();
        let second = 24 + record(7, &tile(0, 2)).len();
        for at in second..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 0x10;
            fs::write(&keep.file, &changed).unwrap();
            let (again, _) = Checkpoint::open(&keep, 7, SIZE);
            assert_eq!(again.tiles().len(), 1, "byte {at}");
        }
    }

    #[test]
    fn tiles_of_another_key_or_run_are_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let keep = checkpoint_options(&folder);
        let (first, _) = Checkpoint::open(&keep, 7, SIZE);
        first.keep(&tile(0, 0));
        let (other, status) = Checkpoint::open(&keep, 8, SIZE);
        assert_eq!(status, CheckpointStatus::Other);
        // The first run is still rendering: what it appends now goes nowhere.
        first.keep(&tile(2, 0));
        other.keep(&tile(4, 0));
        let (again, status) = Checkpoint::open(&keep, 8, SIZE);
        assert_eq!(
            (status, again.tiles()),
            (CheckpointStatus::Pixels(2), [tile(4, 0)].as_slice())
        );
    }

    #[test]
    fn a_short_render_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let keep = CheckpointOptions {
            resume: false,
            ..checkpoint_options(&folder)
        };
        let (quick, status) = Checkpoint::open(&keep, 7, SIZE);
        quick.keep(&tile(0, 0));
        assert!(status == CheckpointStatus::Nothing && !keep.file.exists());
        let unwritable = CheckpointOptions {
            file: folder.path().join("no/such/folder"),
            resume: true,
            build: String::new(),
        };
        let (none, _) = Checkpoint::open(&unwritable, 7, SIZE);
        none.keep(&tile(0, 0));
        assert_eq!(none.trouble(), Some(io::ErrorKind::NotFound));
    }
}
