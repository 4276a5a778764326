//! Folders to which a scene is limited.

use serde::{Deserialize, Serialize};
use std::error::Error;
use std::fmt;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Maximum length of the path of a file in bytes, as on Linux.
const LONGEST_PATH: usize = 4095;

/// Folders, with their subfolders, that hold all files a scene may access. An entry may also be a single file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Folders {
    /// No limit but the permissions of the system.
    #[default]
    All,
    /// These, with links and `..` resolved.
    Only(Vec<PathBuf>),
}

impl Folders {
    /// True if the path, which has no links and no `..`, lies in one of the folders.
    pub(crate) fn contain(&self, resolved: &Path) -> bool {
        match self {
            Folders::All => true,
            Folders::Only(folders) => folders.iter().any(|folder| {
                let folder = if folder.as_os_str().is_empty() {
                    Path::new(".")
                } else {
                    folder
                };
                fs::canonicalize(folder).is_ok_and(|folder| resolved.starts_with(folder))
            }),
        }
    }

    /// True if the file at `path` exists and lies in one of the folders, wherever links lead; always without a limit.
    pub(crate) fn hold(&self, path: &Path) -> bool {
        *self == Folders::All || fs::canonicalize(path).is_ok_and(|path| self.contain(&path))
    }

    /// True if the file at `path` lies in one of the folders, or would if it existed. Only of such files may anyone learn
    /// if they exist, and only such files may be written.
    pub(crate) fn reach(&self, path: &Path) -> bool {
        if *self == Folders::All {
            return true;
        }
        // No file has such a path, whose folders would take time in proportion to the square of their number.
        if path.as_os_str().len() > LONGEST_PATH {
            return false;
        }
        let mut path = path;
        loop {
            if self.hold(path) {
                return true;
            }
            // A file that lies elsewhere, or a link to one that is missing.
            if path.symlink_metadata().is_ok() {
                return false;
            }
            path = match (path.parent(), path.file_name()) {
                (Some(folder), Some(_)) if folder.as_os_str().is_empty() => Path::new("."),
                (Some(folder), Some(_)) => folder,
                // A `..` behind a missing folder.
                _ => return false,
            };
        }
    }

    /// Checks that `opened`, a file or folder opened by this path, lies in one of the folders. Another process may have
    /// changed a link on the path before it was opened, or since: then it is not the file at the resolved path.
    ///
    /// # Errors
    /// [`Outside`], or an error of the system.
    pub(crate) fn check_opened(&self, opened: &File, path: &Path) -> io::Result<()> {
        if *self == Folders::All {
            return Ok(());
        }
        let resolved = fs::canonicalize(path)?;
        if self.contain(&resolved) && is_same(&opened.metadata()?, &fs::metadata(&resolved)?) {
            return Ok(());
        }
        Err(Outside.into())
    }
}

/// A file that does not lie in the folders.
#[derive(Debug)]
pub(crate) struct Outside;

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("it lies outside of the folders that a scene may use")
    }
}

impl Error for Outside {}

impl From<Outside> for io::Error {
    fn from(outside: Outside) -> Self {
        io::Error::new(io::ErrorKind::PermissionDenied, outside)
    }
}

#[cfg(unix)]
fn is_same(one: &fs::Metadata, other: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Without numbers of files, the path decides alone.
#[cfg(not(unix))]
fn is_same(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    true
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn folders_reach_missing_files_in_them_alone() {
        let all = tempfile::tempdir().unwrap();
        let path = |name: &str| all.path().join(name);
        fs::create_dir(path("in")).unwrap();
        fs::create_dir(path("out")).unwrap();
        symlink(path("out/none"), path("in/link")).unwrap();
        symlink(path("out"), path("in/folder")).unwrap();
        let folders = Folders::Only(vec![path("in")]);
        for (name, is_reached) in [
            ("in/none", true),
            ("in/none/none", true),
            ("in", true),
            ("out/../in/none", true),
            ("out/none", false),
            ("out", false),
            ("none", false),
            ("in/../none", false),
            ("in/none/../../out/none", false),
            ("in/link", false),
            ("in/folder/none", false),
        ] {
            assert_eq!(folders.reach(&path(name)), is_reached, "{name}");
            assert!(Folders::All.reach(&path(name)), "{name}");
        }
        assert!(Folders::Only(vec![PathBuf::new()]).reach(Path::new("none")));
        let long = path("in").join("a/".repeat(LONGEST_PATH));
        assert!(!folders.reach(&long) && Folders::All.reach(&long));
    }

    #[test]
    fn a_link_that_changes_after_opening_is_noticed() {
        let all = tempfile::tempdir().unwrap();
        let path = |name: &str| all.path().join(name);
        for folder in ["in", "out"] {
            fs::create_dir(path(folder)).unwrap();
            fs::write(path(folder).join("a"), folder).unwrap();
        }
        let folders = Folders::Only(vec![path("in")]);
        assert!(folders.hold(&path("in/a")) && !folders.hold(&path("out/a")));
        assert!(!folders.hold(&path("in/../out/a")) && !folders.hold(&path("in/none")));

        symlink(path("out/a"), path("in/link")).unwrap();
        assert!(!folders.reach(&path("in/link")));
        assert!(!folders.hold(&path("in/link")));
        let opened = File::open(path("in/link")).unwrap();
        assert!(folders.check_opened(&opened, &path("in/link")).is_err());
        fs::remove_file(path("in/link")).unwrap();
        symlink(path("in/a"), path("in/link")).unwrap();
        assert!(folders.hold(&path("in/link")));
        assert!(folders.check_opened(&opened, &path("in/link")).is_err());
        let opened = File::open(path("in/link")).unwrap();
        assert!(folders.check_opened(&opened, &path("in/link")).is_ok());
        assert!(Folders::All.check_opened(&opened, &path("none")).is_ok());
    }
}
