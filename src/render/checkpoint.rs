//! An unfinished picture on disk: what has been drawn so far, so that a later run can go on with it.
//!
//! The file begins with a magic word and a key; then comes a record for every tile or band that was finished, appended in
//! one write each: the key, the rectangle, its pixels, and a checksum over all of it. A run that is killed leaves whole
//! records and perhaps a torn one at the end, which is cut off. The key stands for the scene, all it read, the options
//! and the program: what has another one is not gone on with. Numbers are little-endian.

use crate::base::film::Pixel;
use crate::base::options::CheckpointOptions;
use crate::base::source::open_regular;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

const MAGIC: &[u8; 16] = b"povr unfinished\n";
/// Key, rectangle, number of samples, whether errors follow.
const HEAD: usize = 8 + 4 * 4 + 8 + 1;
/// Red, green, blue, transmit in single precision.
const PIXEL: usize = 16;
/// The estimated error of a pixel in double precision.
const ERROR: usize = 8;
const CHECKSUM: usize = 4;
/// A picture that takes less time is drawn again as quickly as it is gone on with.
const WORTH_KEEPING: Duration = Duration::from_secs(2);

/// A rectangle of finished pixels, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CheckpointTile {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
    pub(super) pixels: Vec<Pixel>,
    /// Of a picture that is sampled until its error is small: the estimated errors, and how many samples it took.
    pub(super) errors: Vec<f64>,
    pub(super) samples: u64,
}

/// What was there when an unfinished picture was opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointStatus {
    /// Nothing to go on with.
    Nothing,
    /// What another scene, other options or another program left.
    Other,
    /// So many pixels of this picture.
    Pixels(u64),
}

/// An unfinished picture that grows while it is drawn.
#[derive(Debug)]
pub struct Checkpoint {
    key: u64,
    found: Vec<CheckpointTile>,
    growing: Mutex<Growing>,
    /// The number of pixels in the file.
    pixels: AtomicU64,
}

#[derive(Debug)]
enum Growing {
    /// Nothing is written before this moment. Until then pieces wait here that tell of those before them; others are
    /// drawn again in as little time.
    Waiting(CheckpointOptions, Instant, Vec<u8>),
    File(File),
    /// It could not be written: the drawing goes on without.
    Given(io::ErrorKind),
}

impl Checkpoint {
    /// Opens what is kept of a picture of `size`, if this run is to go on with it, and keeps what will be drawn.
    #[must_use]
    pub fn open(
        keep: &CheckpointOptions,
        key: u64,
        size: (u32, u32),
    ) -> (Checkpoint, CheckpointStatus) {
        let (mut found, mut pieces, mut file) = (CheckpointStatus::Nothing, Vec::new(), None);
        if keep.continues {
            match go_on(keep, key, size) {
                Ok(Some((opened, there))) => {
                    found = CheckpointStatus::Pixels(
                        there.iter().map(|piece| piece.pixels.len() as u64).sum(),
                    );
                    (pieces, file) = (there, Some(Growing::File(opened)));
                }
                Ok(None) => found = CheckpointStatus::Other,
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => file = Some(Growing::Given(error.kind())),
            }
        }
        let growing = file.unwrap_or_else(|| {
            if keep.continues {
                begin(keep, key, &[])
            } else {
                let now = Instant::now();
                let then = now.checked_add(WORTH_KEEPING).unwrap_or(now);
                Growing::Waiting(keep.clone(), then, Vec::new())
            }
        });
        let pixels = pieces.iter().map(|piece| piece.pixels.len() as u64).sum();
        let unfinished = Checkpoint {
            key,
            found: pieces,
            growing: Mutex::new(growing),
            pixels: AtomicU64::new(pixels),
        };
        (unfinished, found)
    }

    /// The pieces that were there.
    pub(super) fn pieces(&self) -> &[CheckpointTile] {
        &self.found
    }

    /// The piece of just this rectangle, if it was there.
    pub(super) fn piece(&self, columns: &Range<u32>, rows: &Range<u32>) -> Option<&CheckpointTile> {
        let mut pieces = self.found.iter();
        pieces.find(|piece| piece.columns == *columns && piece.rows == *rows)
    }

    /// Keeps a finished piece.
    pub(super) fn keep(&self, piece: &CheckpointTile) {
        let mut growing = self.growing.lock().unwrap_or_else(PoisonError::into_inner);
        match &mut *growing {
            Growing::Waiting(keep, then, waiting) => {
                let is_time = Instant::now() >= *then;
                if is_time || !piece.errors.is_empty() {
                    waiting.extend_from_slice(&record(self.key, piece));
                    self.count(piece);
                }
                if is_time {
                    *growing = begin(keep, self.key, waiting);
                    if let Growing::Given(_) = *growing {
                        self.pixels.store(0, Ordering::Relaxed);
                    }
                }
            }
            Growing::File(file) => match file.write_all(&record(self.key, piece)) {
                Ok(()) => self.count(piece),
                Err(error) => *growing = Growing::Given(error.kind()),
            },
            Growing::Given(_) => {}
        }
    }

    fn count(&self, piece: &CheckpointTile) {
        let pixels = piece.pixels.len() as u64;
        self.pixels.fetch_add(pixels, Ordering::Relaxed);
    }

    /// The number of pixels that a later run can go on with; `None` if nothing is kept.
    #[must_use]
    pub fn kept(&self) -> Option<u64> {
        match &*self.growing.lock().unwrap_or_else(PoisonError::into_inner) {
            Growing::Waiting(..) => None,
            // Whole records stay where the disk is full.
            Growing::File(_) | Growing::Given(_) => {
                Some(self.pixels.load(Ordering::Relaxed)).filter(|&kept| kept > 0)
            }
        }
    }

    /// Why nothing is kept, if it could not be.
    #[must_use]
    pub fn trouble(&self) -> Option<io::ErrorKind> {
        match &*self.growing.lock().unwrap_or_else(PoisonError::into_inner) {
            Growing::Given(kind) => Some(*kind),
            _ => None,
        }
    }
}

/// A new file with the pieces that have waited for it.
fn begin(keep: &CheckpointOptions, key: u64, waiting: &[u8]) -> Growing {
    let made = || -> io::Result<File> {
        // Another process may still write to a file of this name: to one that is gone it does no harm.
        match std::fs::remove_file(&keep.file) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut options = OpenOptions::new();
        let mut file = options.append(true).create_new(true).open(&keep.file)?;
        let written = file.write_all(&[MAGIC.as_slice(), &key.to_le_bytes(), waiting].concat());
        written.inspect_err(|_| {
            // A torn beginning is of no use, and takes the room of the picture.
            let _ = std::fs::remove_file(&keep.file);
        })?;
        Ok(file)
    };
    made().map_or_else(|error| Growing::Given(error.kind()), Growing::File)
}

/// Opens a file of this key at the end of its last whole record; `None` if it is of another.
fn go_on(
    keep: &CheckpointOptions,
    key: u64,
    size: (u32, u32),
) -> io::Result<Option<(File, Vec<CheckpointTile>)>> {
    let mut file = open_regular(&keep.file, OpenOptions::new().read(true).append(true))?;
    let mut bytes = Vec::new();
    // A record for every pixel is the longest that this picture can have.
    let most = u64::from(size.0) * u64::from(size.1) * (HEAD + PIXEL + ERROR + CHECKSUM) as u64;
    Read::by_ref(&mut file)
        .take(most.saturating_add(1 << 20))
        .read_to_end(&mut bytes)?;
    let head = [MAGIC.as_slice(), &key.to_le_bytes()].concat();
    if !bytes.starts_with(&head) {
        return Ok(None);
    }
    let (mut pieces, mut at) = (Vec::new(), head.len());
    while let Some((piece, length)) = read_record(&bytes[at..], key, size) {
        pieces.push(piece);
        at += length;
    }
    file.set_len(at as u64)?;
    file.seek(SeekFrom::End(0))?;
    Ok(Some((file, pieces)))
}

fn record(key: u64, piece: &CheckpointTile) -> Vec<u8> {
    let has_errors = !piece.errors.is_empty();
    let of_pixel = PIXEL + if has_errors { ERROR } else { 0 };
    let mut bytes = Vec::with_capacity(HEAD + piece.pixels.len() * of_pixel + CHECKSUM);
    bytes.extend_from_slice(&key.to_le_bytes());
    for edge in [
        piece.columns.start,
        piece.columns.end,
        piece.rows.start,
        piece.rows.end,
    ] {
        bytes.extend_from_slice(&edge.to_le_bytes());
    }
    bytes.extend_from_slice(&piece.samples.to_le_bytes());
    bytes.push(u8::from(has_errors));
    for pixel in &piece.pixels {
        for value in [pixel.rgb.r, pixel.rgb.g, pixel.rgb.b, pixel.transmit] {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
    }
    for error in &piece.errors {
        bytes.extend_from_slice(&error.to_le_bytes());
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend_from_slice(&sum.to_le_bytes());
    bytes
}

/// The record at the beginning of some bytes, and its length; `None` if there is no whole one of this picture.
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
    let piece = CheckpointTile {
        columns,
        rows,
        pixels: pixels.collect(),
        errors: errors
            .filter_map(|error| Some(f64::from_le_bytes(error.try_into().ok()?)))
            .collect(),
        samples,
    };
    Some((piece, length + CHECKSUM))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use std::fs;

    const SIZE: (u32, u32) = (10, 6);

    fn piece(column: u32, errors: usize) -> CheckpointTile {
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

    fn kept(folder: &tempfile::TempDir) -> CheckpointOptions {
        CheckpointOptions {
            file: folder.path().join("a.povr-state"),
            continues: true,
            build: String::new(),
        }
    }

    #[test]
    fn what_was_kept_is_there_bit_for_bit_whatever_is_torn_off() {
        let folder = tempfile::tempdir().unwrap();
        let keep = kept(&folder);
        let (first, found) = Checkpoint::open(&keep, 7, SIZE);
        assert_eq!(found, CheckpointStatus::Nothing);
        let pieces = [piece(0, 0), piece(2, 2), piece(4, 0)];
        pieces.iter().for_each(|piece| first.keep(piece));
        let whole = fs::read(&keep.file).unwrap();
        let ends: Vec<usize> = (0..=3)
            .map(|n| {
                24 + pieces[..n]
                    .iter()
                    .map(|p| record(7, p).len())
                    .sum::<usize>()
            })
            .collect();
        assert_eq!(whole.len(), ends[3]);
        for length in 0..=whole.len() {
            fs::write(&keep.file, &whole[..length]).unwrap();
            let (again, found) = Checkpoint::open(&keep, 7, SIZE);
            let there = ends.iter().filter(|&&end| end <= length).count();
            match there.checked_sub(1) {
                None => assert_eq!(found, CheckpointStatus::Other),
                Some(there) => {
                    assert_eq!(again.pieces(), &pieces[..there], "{length}");
                    // It goes on behind the last whole record.
                    again.keep(&piece(6, 0));
                    let (last, _) = Checkpoint::open(&keep, 7, SIZE);
                    assert_eq!(last.pieces().len(), there + 1);
                    assert!(last.piece(&(6..8), &(1..2)).is_some());
                }
            }
        }
    }

    #[test]
    fn a_changed_byte_ends_what_is_taken() {
        let folder = tempfile::tempdir().unwrap();
        let keep = kept(&folder);
        let (first, _) = Checkpoint::open(&keep, 7, SIZE);
        first.keep(&piece(0, 2));
        first.keep(&piece(2, 2));
        let whole = fs::read(&keep.file).unwrap();
        let second = 24 + record(7, &piece(0, 2)).len();
        for at in second..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 0x10;
            fs::write(&keep.file, &changed).unwrap();
            let (again, _) = Checkpoint::open(&keep, 7, SIZE);
            assert_eq!(again.pieces().len(), 1, "byte {at}");
        }
    }

    #[test]
    fn another_key_or_another_run_is_not_mixed_in() {
        let folder = tempfile::tempdir().unwrap();
        let keep = kept(&folder);
        let (first, _) = Checkpoint::open(&keep, 7, SIZE);
        first.keep(&piece(0, 0));
        let (other, found) = Checkpoint::open(&keep, 8, SIZE);
        assert_eq!(found, CheckpointStatus::Other);
        // The first run still draws: what it appends now goes nowhere.
        first.keep(&piece(2, 0));
        other.keep(&piece(4, 0));
        let (again, found) = Checkpoint::open(&keep, 8, SIZE);
        assert_eq!(
            (found, again.pieces()),
            (CheckpointStatus::Pixels(2), [piece(4, 0)].as_slice())
        );
    }

    #[test]
    fn a_short_drawing_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let keep = CheckpointOptions {
            continues: false,
            ..kept(&folder)
        };
        let (quick, found) = Checkpoint::open(&keep, 7, SIZE);
        quick.keep(&piece(0, 0));
        assert!(found == CheckpointStatus::Nothing && !keep.file.exists());
        let unwritable = CheckpointOptions {
            file: folder.path().join("no/such/folder"),
            continues: true,
            build: String::new(),
        };
        let (none, _) = Checkpoint::open(&unwritable, 7, SIZE);
        none.keep(&piece(0, 0));
        assert_eq!(none.trouble(), Some(io::ErrorKind::NotFound));
    }
}
