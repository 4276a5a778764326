//! Contents as short numbers (BLAKE3, O'Connor and others 2020): whether a picture is what would be drawn now.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

use super::Picture;
use crate::base::source::{Dependency, read_regular};

/// What a picture was made of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Record {
    /// The picture, below the folder of all.
    pub(super) output: PathBuf,
    /// Of the options and of the program.
    key: String,
    /// Of the picture itself.
    made: String,
    /// The files that were read, with theirs.
    files: Vec<(PathBuf, String)>,
    /// Where files were looked for and were not.
    missing: Vec<PathBuf>,
}

/// Computes fingerprints, those of files once for each state that they are seen in.
#[derive(Debug)]
pub(super) struct Fingerprints {
    program: String,
    folder: PathBuf,
    files: Mutex<Files>,
}

/// Files by their paths.
type Files = FxHashMap<PathBuf, Known>;

/// A file in a state in which it was seen.
#[derive(Clone, Debug)]
struct Known {
    state: (u64, Option<SystemTime>),
    fingerprint: String,
}

impl Fingerprints {
    /// Of this program, run in the current folder.
    pub(super) fn new() -> Self {
        // Two builds may have the same version and draw differently.
        let program = std::env::current_exe().and_then(fs::read);
        Fingerprints {
            program: program.map_or_else(
                |_| env!("CARGO_PKG_VERSION").to_owned(),
                |bytes| of_bytes(&bytes),
            ),
            folder: std::env::current_dir().unwrap_or_default(),
            files: Mutex::default(),
        }
    }

    /// The record of a picture whose drawing began at `since`; `None` if something that it depends on has changed
    /// meanwhile, so that nobody can tell what it shows.
    pub(super) fn record(
        &self,
        picture: &Picture,
        bytes: &[u8],
        dependencies: &[Dependency],
        since: SystemTime,
    ) -> Option<Record> {
        let mut record = Record {
            output: picture.output.clone(),
            key: self.key(picture),
            made: of_bytes(bytes),
            files: Vec::new(),
            missing: Vec::new(),
        };
        for Dependency { path, is_there } in dependencies {
            let path = std::path::absolute(path).ok()?;
            if *is_there {
                let changed = fs::metadata(&path).and_then(|about| about.modified());
                if changed.is_ok_and(|changed| changed >= since) {
                    return None;
                }
                let fingerprint = self.of_file(&path).ok()?;
                record.files.push((path, fingerprint));
            } else {
                record.missing.push(path);
            }
        }
        Some(record)
    }

    /// Whether a picture, which lies at `place`, is as this record says and would be the same again.
    pub(super) fn holds(&self, record: &Record, picture: &Picture, place: &Path) -> bool {
        record.key == self.key(picture)
            && record.missing.iter().all(|path| !path.is_file())
            && record.files.iter().all(|(path, fingerprint)| {
                self.of_file(path).is_ok_and(|found| found == *fingerprint)
            })
            && read_regular(place).is_ok_and(|bytes| of_bytes(&bytes) == record.made)
    }

    /// Of all that a picture depends on beside files.
    fn key(&self, picture: &Picture) -> String {
        let Picture {
            scene,
            read,
            render,
            encode,
            ..
        } = picture;
        let mut render = render.clone();
        let mut read = read.clone();
        // They make no difference to the picture.
        (render.threads, render.statistics, read.memory) = (None, false, None);
        let options = format!(
            "{}\n{}\n{scene:?}\n{read:?}\n{render:?}\n{encode:?}",
            self.program,
            self.folder.display()
        );
        of_bytes(options.as_bytes())
    }

    fn of_file(&self, path: &Path) -> io::Result<String> {
        let about = fs::metadata(path)?;
        let state = (about.len(), about.modified().ok());
        let known = self.lock().get(path).cloned();
        if let Some(known) = known.filter(|known| known.state == state) {
            return Ok(known.fingerprint);
        }
        let known = Known {
            state,
            fingerprint: of_bytes(&read_regular(path)?),
        };
        let fingerprint = known.fingerprint.clone();
        self.lock().insert(path.to_owned(), known);
        Ok(fingerprint)
    }

    fn lock(&self) -> MutexGuard<'_, Files> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn of_bytes(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

/// Now, by the clock that files get their times from, which is behind others by up to a few milliseconds.
pub(super) fn now() -> SystemTime {
    #[cfg(target_os = "linux")]
    {
        let now = rustix::time::clock_gettime(rustix::time::ClockId::RealtimeCoarse);
        let since = Duration::try_from(now).unwrap_or_default();
        SystemTime::UNIX_EPOCH + since
    }
    #[cfg(not(target_os = "linux"))]
    {
        SystemTime::now() - Duration::from_millis(20)
    }
}
