//! Fingerprints of contents (BLAKE3, O'Connor and others 2020), which show if a picture is up to date.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

use super::Picture;
use crate::app::program;
use crate::base::file::read_regular;
use crate::base::source::Dependency;

/// The inputs of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Record {
    /// The picture, relative to the output folder.
    pub(super) output: PathBuf,
    /// Fingerprint of the options and of the program.
    key: String,
    /// Fingerprint of the picture itself.
    made: String,
    /// The files that were read, with their fingerprints.
    files: Vec<(PathBuf, String)>,
    /// Paths where files were looked for in vain.
    missing: Vec<PathBuf>,
}

/// Computes fingerprints; a file is read once for each state it is seen in.
#[derive(Debug)]
pub(super) struct Fingerprints {
    program: String,
    folder: PathBuf,
    files: Mutex<Files>,
}

/// Files by their paths.
type Files = FxHashMap<PathBuf, Known>;

/// The fingerprint of a file in one state.
#[derive(Clone, Debug)]
struct Known {
    state: (u64, Option<SystemTime>),
    fingerprint: String,
}

impl Fingerprints {
    /// For this program, run in the current folder.
    pub(super) fn new() -> Self {
        // Two builds may have the same version and render differently.
        let program = program::code().and_then(fs::read);
        Fingerprints {
            program: program.map_or_else(
                |_| env!("CARGO_PKG_VERSION").to_owned(),
                |bytes| of_bytes(&bytes),
            ),
            folder: std::env::current_dir().unwrap_or_default(),
            files: Mutex::default(),
        }
    }

    /// The record of a picture whose rendering began at `since`; `None` if an input has changed meanwhile, so that the
    /// picture cannot be attributed to either version.
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

    /// True if the picture at `picture_path` matches this record and would be the same again.
    pub(super) fn holds(&self, record: &Record, picture: &Picture, picture_path: &Path) -> bool {
        record.key == self.key(picture)
            && record.missing.iter().all(|path| !path.is_file())
            && record.files.iter().all(|(path, fingerprint)| {
                self.of_file(path)
                    .is_ok_and(|current| current == *fingerprint)
            })
            && read_regular(picture_path, u64::MAX)
                .is_ok_and(|bytes| of_bytes(&bytes) == record.made)
    }

    /// The fingerprint of all inputs other than files.
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
        // These do not affect the picture.
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
            fingerprint: of_bytes(&read_regular(path, u64::MAX)?),
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

/// The current time of the clock that sets file times, which is behind others by up to a few milliseconds.
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
