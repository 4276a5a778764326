//! The files that a picture depends on, and how one learns that they have changed.
//!
//! The system's word (`notify`) only says when to look: what counts is whether a file's length, time or presence is
//! other than when the scene was read. So nothing is missed where the system says nothing (network file systems), and
//! nothing is drawn again for a file that was only read.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use notify::{RecommendedWatcher, RecursiveMode, Watcher};

/// What a file was like: its length and when it was written; nothing if it was not there.
type Stamp = Option<(u64, Option<SystemTime>)>;

/// Files as they were when a scene was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Known {
    files: Vec<(PathBuf, Stamp)>,
    /// A file that was written while the scene was being read, and so perhaps read as it was before.
    doubtful: Option<PathBuf>,
}

impl Known {
    /// Files as they are now, of a reading that began at some time.
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

    /// The same files as they are now.
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

    /// A file that is not as it was.
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

/// The folders in which something may happen.
pub(super) struct Watched {
    /// `None` where the system tells of no changes.
    watcher: Option<RecommendedWatcher>,
    folders: BTreeSet<PathBuf>,
}

impl Watched {
    /// Calls `tell` whenever something happens in a watched folder.
    pub(super) fn new(tell: impl Fn() + Send + 'static) -> Watched {
        let heard = move |event: notify::Result<notify::Event>| {
            // To read a file changes nothing.
            if event.is_ok_and(|event| !event.kind.is_access()) {
                tell();
            }
        };
        Watched {
            watcher: notify::recommended_watcher(heard).ok(),
            folders: BTreeSet::new(),
        }
    }

    /// Watches the folders of these files and no others. A folder, not a file: editors put new files in place of old.
    pub(super) fn watch(&mut self, known: &Known) {
        let Some(watcher) = &mut self.watcher else {
            return;
        };
        let folders = known.files.iter().filter_map(|(path, _)| nearest(path));
        let folders: BTreeSet<PathBuf> = folders.collect();
        // A folder that has gone, or of which the system does not tell, is looked at all the same.
        for gone in self.folders.difference(&folders) {
            let _ = watcher.unwatch(gone);
        }
        for new in folders.difference(&self.folders) {
            let _ = watcher.watch(new, RecursiveMode::NonRecursive);
        }
        self.folders = folders;
    }
}

/// The folder of a file, or the nearest one above that is there.
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
    fn what_changes_appears_or_goes_is_seen() {
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
    fn what_was_written_while_it_was_read_is_doubtful() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let began = SystemTime::now() - std::time::Duration::from_secs(5);
        fs::write(&path, "1").unwrap();
        assert_eq!(Known::of([path.clone()], began).changed(), Some(path));
    }
}
