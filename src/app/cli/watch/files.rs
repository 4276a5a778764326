//! The files that a picture depends on, and detection of changes in them.
//!
//! Notifications of the system (`notify`) only trigger a check: a file has changed if its length, time or presence
//! differs from when the scene was read. So nothing is missed where the system sends no notifications (network file
//! systems), and nothing is rendered again for a file that was only read.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use notify::event::{AccessKind, AccessMode, ModifyKind, RenameMode};
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};

/// The state of a file: its length and modification time; `None` if it does not exist.
type Stamp = Option<(u64, Option<SystemTime>)>;

/// Files in their states when a scene was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Known {
    files: Vec<(PathBuf, Stamp)>,
    /// A file that was written while the scene was being read, so that perhaps its old contents were read.
    doubtful: Option<PathBuf>,
}

impl Known {
    /// Files in their current states, for a reading that began at some time.
    pub(super) fn of(paths: impl IntoIterator<Item = PathBuf>, began: SystemTime) -> Known {
        let now = SystemTime::now();
        let mut doubtful = None;
        let stamped = |path: PathBuf| {
            let stamp = stamp(&path);
            let written = stamp.and_then(|(_, written)| written);
            if written.is_some_and(|written| (began..=now).contains(&written)) {
                doubtful.get_or_insert_with(|| path.clone());
            }
            (path, stamp)
        };
        Known {
            files: paths.into_iter().map(stamped).collect(),
            doubtful,
        }
    }

    /// The same files in their current states.
    pub(super) fn again(&self) -> Known {
        let files = self
            .files
            .iter()
            .map(|(path, _)| (path.clone(), stamp(path)));
        Known {
            files: files.collect(),
            doubtful: None,
        }
    }

    /// A file whose state differs.
    pub(super) fn changed(&self) -> Option<PathBuf> {
        let mut files = self.files.iter();
        let changed = files.find(|(path, before)| stamp(path) != *before);
        changed
            .map(|(path, _)| path.clone())
            .or_else(|| self.doubtful.clone())
    }
}

fn stamp(path: &Path) -> Stamp {
    let about = fs::metadata(path).ok()?;
    Some((about.len(), about.modified().ok()))
}

/// The watched folders.
pub(super) struct Watched {
    /// `None` where the system sends no notifications.
    watcher: Option<RecommendedWatcher>,
    folders: BTreeSet<PathBuf>,
}

impl Watched {
    /// Calls `notify_change` for every event in a watched folder, with the name of a file that has been written completely.
    pub(super) fn new(notify_change: impl Fn(Option<OsString>) + Send + 'static) -> Watched {
        let handler = move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else {
                return;
            };
            let is_written = matches!(
                event.kind,
                EventKind::Access(AccessKind::Close(AccessMode::Write))
                    | EventKind::Modify(ModifyKind::Name(RenameMode::To | RenameMode::Both))
            );
            let path = event.paths.last().filter(|_| is_written);
            let name = path.and_then(|path| path.file_name()).map(OsStr::to_owned);
            // Reading a file changes nothing.
            if is_written || !event.kind.is_access() {
                notify_change(name);
            }
        };
        Watched {
            watcher: notify::recommended_watcher(handler).ok(),
            folders: BTreeSet::new(),
        }
    }

    /// Watches the folders of these files and no others. Folders, not files, because editors replace files.
    pub(super) fn watch(&mut self, known: &Known) {
        let Some(watcher) = &mut self.watcher else {
            return;
        };
        let folders = known.files.iter().filter_map(|(path, _)| nearest(path));
        let folders: BTreeSet<PathBuf> = folders.collect();
        // A folder that has gone, or that sends no notifications, is still polled.
        for gone in self.folders.difference(&folders) {
            let _ = watcher.unwatch(gone);
        }
        for new in folders.difference(&self.folders) {
            let _ = watcher.watch(new, RecursiveMode::NonRecursive);
        }
        self.folders = folders;
    }
}

/// The folder of a file, or the nearest existing folder above.
fn nearest(path: &Path) -> Option<PathBuf> {
    let path = std::path::absolute(path).ok()?;
    path.ancestors()
        .skip(1)
        .find(|folder| folder.is_dir())
        .map(Path::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_new_and_removed_files_are_detected() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a"), "1").unwrap();
        fs::write(path("b"), "1").unwrap();
        let later = SystemTime::now() + std::time::Duration::from_secs(1);
        let known = || Known::of(["a", "b", "c"].map(path), later);
        let before = known();
        assert_eq!(before.changed(), None);
        fs::write(path("c"), "").unwrap();
        assert_eq!(before.changed(), Some(path("c")));
        let before = known();
        fs::write(path("b"), "22").unwrap();
        assert_eq!(before.changed(), Some(path("b")));
        let before = known();
        fs::remove_file(path("a")).unwrap();
        assert_eq!(before.changed(), Some(path("a")));
        assert_eq!(before.again().changed(), None);
    }

    #[test]
    fn files_written_during_reading_are_doubtful() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let began = SystemTime::now() - std::time::Duration::from_secs(5);
        fs::write(&path, "1").unwrap();
        assert_eq!(Known::of([path.clone()], began).changed(), Some(path));
    }
}
