//! The log of a run, stored beside the pictures, and temporary files of pictures in progress.
//!
//! `.povr-batch/` has a folder for each part of a run (`all`, or `2-of-8`), which one process locks at a time. A log is
//! append-only, one record a line; a line that was cut off when the process was killed does not count. At the end of a
//! run the log is compacted. Nothing is forced to the disk: the fingerprint reveals data lost in a power failure, and
//! the picture is rendered again.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use super::fingerprint::Record;
use super::{BatchError, Shard};

const FOLDER: &str = ".povr-batch";
const LOG: &str = "log";
const PART: &str = "part";

/// The folder of a run.
#[derive(Debug)]
pub(super) struct Journal {
    out: PathBuf,
    own: PathBuf,
    log: Mutex<File>,
    parts: AtomicU64,
    /// As long as it is open, no other process has this part of the run.
    _held: File,
}

impl Journal {
    /// Locks a part of the run that writes to `out`, and removes the remains of killed runs there.
    ///
    /// # Errors
    /// When the folder cannot be written to, or another process is at work on the same part.
    pub(super) fn open(out: &Path, shard: Option<Shard>) -> Result<Self, BatchError> {
        let all = out.join(FOLDER);
        let own = all.join(Shard::name(shard));
        fs::create_dir_all(&own).map_err(|error| BatchError::of_file("make", &own, &error))?;
        let held = hold(&own)
            .map_err(|error| BatchError::of_file("take hold of", &own, &error))?
            .ok_or_else(|| {
                BatchError::new(format!(
                    "another `povr batch` is at work in `{}`",
                    out.display()
                ))
                .with_hint("Wait for it, or give each a part: `--shard 1/2` and `--shard 2/2`.")
            })?;
        clean(&own);
        for other in folders(&all).filter(|other| *other != own) {
            if let Ok(Some(_held)) = hold(&other) {
                clean(&other);
            }
        }
        let path = own.join(LOG);
        let log = File::options().append(true).create(true).open(&path);
        Ok(Journal {
            out: out.to_owned(),
            log: Mutex::new(log.map_err(|error| BatchError::of_file("write", &path, &error))?),
            own,
            parts: AtomicU64::new(0),
            _held: held,
        })
    }

    /// The records of all parts of all runs, by picture.
    pub(super) fn records(&self) -> BTreeMap<PathBuf, Vec<Record>> {
        let mut records: BTreeMap<PathBuf, Vec<Record>> = BTreeMap::new();
        for folder in folders(&self.out.join(FOLDER)) {
            for record in read(&folder.join(LOG)) {
                records
                    .entry(record.output.clone())
                    .or_default()
                    .push(record);
            }
        }
        records
    }

    /// The path of a picture.
    pub(super) fn path(&self, output: &Path) -> PathBuf {
        self.out.join(output)
    }

    /// Writes a file atomically.
    pub(super) fn put(&self, output: &Path, bytes: &[u8]) -> Result<(), BatchError> {
        let path = self.path(output);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)
                .map_err(|error| BatchError::of_file("make", folder, &error))?;
        }
        let number = self.parts.fetch_add(1, Ordering::Relaxed);
        let part = self.own.join(format!("{number}.{PART}"));
        let written = fs::write(&part, bytes).and_then(|()| fs::rename(&part, &path));
        written.map_err(|error| {
            let _ = fs::remove_file(&part);
            BatchError::of_file("write", &path, &error)
        })
    }

    /// Appends the record of a picture.
    pub(super) fn note(&self, record: &Record) -> io::Result<()> {
        let line = serde_json::to_string(record)?;
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        // In one write, and never on a line that was cut off.
        log.write_all(format!("\n{line}\n").as_bytes())
    }

    /// Compacts the log: the last record of each picture, sorted by name.
    pub(super) fn close(self) -> Result<(), BatchError> {
        let path = self.own.join(LOG);
        let records: BTreeMap<PathBuf, Record> = read(&path)
            .into_iter()
            .map(|record| (record.output.clone(), record))
            .collect();
        let mut text = String::new();
        for record in records.values() {
            if let Ok(line) = serde_json::to_string(record) {
                text.push_str(&line);
                text.push('\n');
            }
        }
        let part = self.own.join(format!("{LOG}.{PART}"));
        fs::write(&part, text)
            .and_then(|()| fs::rename(&part, &path))
            .map_err(|error| {
                let _ = fs::remove_file(&part);
                BatchError::of_file("write", &path, &error)
            })
    }
}

fn read(log: &Path) -> Vec<Record> {
    let text = fs::read(log).unwrap_or_default();
    text.split(|&byte| byte == b'\n')
        .filter_map(|line| serde_json::from_slice(line).ok())
        .collect()
}

fn folders(all: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let entries = fs::read_dir(all).into_iter().flatten().flatten();
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    folders.sort();
    folders.into_iter().filter(|path| path.is_dir())
}

/// Removes temporary files that a killed run has left.
fn clean(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.extension() == Some(OsStr::new(PART)) {
            // Files that cannot be removed do no harm.
            let _ = fs::remove_file(path);
        }
    }
}

/// Locks a folder, unless another process has locked it.
#[cfg(unix)]
fn hold(folder: &Path) -> io::Result<Option<File>> {
    use rustix::fs::{FlockOperation, flock};
    let file = File::open(folder)?;
    match flock(&file, FlockOperation::NonBlockingLockExclusive) {
        Ok(()) => Ok(Some(file)),
        Err(rustix::io::Errno::WOULDBLOCK) => Ok(None),
        // A file system without locks: two runs at once render everything twice, and nothing worse.
        Err(rustix::io::Errno::NOTSUP | rustix::io::Errno::NOLCK | rustix::io::Errno::NOSYS) => {
            Ok(Some(file))
        }
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(unix))]
fn hold(folder: &Path) -> io::Result<Option<File>> {
    File::open(folder.join(LOG))
        .or_else(|_| File::create(folder.join(LOG)))
        .map(Some)
}
