//! POV-Ray's `povray.conf`, of the system and of the user: where scenes may write files.
//!
//! Measured with Debian's POV-Ray 3.7.0.10: it reads both files and says what it does not know in them, refuses
//! programs (`[Shellout Security]`), and then reads and writes files wherever the system lets it, whatever
//! `[File I/O Security]` and `[Permitted Paths]` say. Here no program is ever run, files are read anywhere (`--sandbox`
//! limits that), and written where both files permit it, subfolders included.

use super::values::unquoted;
use crate::base::file::{Folders, read_regular};
use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The folder that `%INSTALLDIR%` stands for.
const INSTALLED: &str = "/usr/share/povray-3.7";
/// The usual folder of temporary files; one that `TMPDIR` names counts as well.
const TEMPORARY: &str = "/tmp";
/// Larger files are ignored, with a warning.
const LARGEST: u64 = 1 << 20;

/// The content of the files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Conf {
    /// The folders that scenes may write to; `None` where no file limits them.
    pub(crate) writable: Option<Folders>,
    /// Warnings about settings without a meaning.
    pub(crate) doubts: Vec<String>,
}

impl Conf {
    /// The files of this machine and of this user.
    pub(crate) fn of_this_process() -> Self {
        let home = env::var_os("HOME").map(PathBuf::from);
        let system = Path::new("/etc/povray/3.7/povray.conf");
        let user = home
            .as_ref()
            .map(|home| home.join(".povray/3.7/povray.conf"));
        let read = |file: &Path| match read_regular(file, LARGEST) {
            Ok(text) => {
                let text = String::from_utf8_lossy(&text);
                Some(Conf::of_text(&text, file, home.as_deref()))
            }
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
                ) =>
            {
                None
            }
            Err(error) => Some(Conf {
                writable: None,
                doubts: vec![format!("{} is not read: {error}", file.display())],
            }),
        };
        match (read(system), user.and_then(|file| read(&file))) {
            (Some(system), Some(user)) => system.and(user),
            (one, other) => one.or(other).unwrap_or_default(),
        }
    }

    /// The folders that scenes may write to.
    pub(crate) fn writable(&self) -> Folders {
        self.writable
            .clone()
            .unwrap_or_else(|| Folders::Only(vec![PathBuf::from("."), env::temp_dir()]))
    }

    fn of_text(text: &str, file: &Path, home: Option<&Path>) -> Self {
        let mut conf = Conf::default();
        let (mut section, mut is_limited) = (String::new(), None);
        let mut folders = Vec::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split(';').next().unwrap_or_default().trim();
            if line.is_empty() {
                continue;
            }
            if let Some(heading) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
                section = heading.trim().to_ascii_lowercase();
                continue;
            }
            let is_known = match section.as_str() {
                "file i/o security" => {
                    is_limited = Some(line != "none");
                    matches!(line, "none" | "read-only" | "restricted")
                }
                "shellout security" => matches!(line, "allowed" | "forbidden"),
                "permitted paths" => match permitted(line, home) {
                    Some((Permission::Write, folder)) => {
                        if folder == Path::new(TEMPORARY) {
                            folders.push(env::temp_dir());
                        }
                        folders.push(folder);
                        true
                    }
                    Some((Permission::Read, _)) => true,
                    None => false,
                },
                _ => false,
            };
            if !is_known {
                let file = file.display();
                conf.doubts
                    .push(format!("{file}: {number}: unknown setting `{line}`"));
            }
        }
        folders.dedup();
        conf.writable = is_limited.map(|is_limited| match is_limited {
            true => Folders::Only(folders),
            false => Folders::All,
        });
        conf
    }

    /// Settings that permit what both permit.
    fn and(mut self, other: Conf) -> Conf {
        self.doubts.extend(other.doubts);
        self.writable = match (self.writable, other.writable) {
            (Some(Folders::Only(one)), Some(Folders::Only(other))) => {
                Some(Folders::Only(common(&one, &other)))
            }
            (Some(Folders::All) | None, folders) | (folders, _) => folders,
        };
        self
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Permission {
    Read,
    Write,
}

/// `read+write* = "a folder"`.
fn permitted(line: &str, home: Option<&Path>) -> Option<(Permission, PathBuf)> {
    let (key, folder) = line.split_once('=')?;
    let permission = match key.trim().trim_end_matches('*') {
        "read" => Permission::Read,
        "read+write" => Permission::Write,
        _ => return None,
    };
    let folder = unquoted(folder).replace("%INSTALLDIR%", INSTALLED);
    let folder = match folder.strip_prefix("%HOME%") {
        Some(below) => home?.join(below.trim_start_matches('/')),
        None => PathBuf::from(folder),
    };
    Some((permission, folder))
}

/// The folders of each list that lie in one of the other.
fn common(one: &[PathBuf], other: &[PathBuf]) -> Vec<PathBuf> {
    let resolved = |path: &PathBuf| fs::canonicalize(path).unwrap_or_else(|_| path.clone());
    let within = |path: &PathBuf, folders: &[PathBuf]| {
        folders
            .iter()
            .any(|folder| resolved(path).starts_with(resolved(folder)))
    };
    let first = one.iter().filter(|path| within(path, other));
    let second = other
        .iter()
        .filter(|path| within(path, one) && !one.contains(path));
    first.chain(second).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conf(text: &str) -> Conf {
        Conf::of_text(text, Path::new("conf"), Some(Path::new("/home/me")))
    }

    #[test]
    fn the_folders_of_read_and_write_are_writable() {
        let conf = conf(
            "; a comment\n[File I/O Security]\nrestricted ; always\n[Permitted Paths]\n\
             read* = /etc\nread+write = .\n read+write*=\"%HOME%/a b\"\nread+write = '%INSTALLDIR%/x'\n",
        );
        let folders = [".", "/home/me/a b", "/usr/share/povray-3.7/x"];
        let folders = folders.iter().map(PathBuf::from).collect();
        assert_eq!(conf.writable, Some(Folders::Only(folders)));
        assert!(conf.doubts.is_empty());
    }

    #[test]
    fn unknown_settings_are_named() {
        let text =
            "[Shellout Security]\nbar\n[Permitted Paths]\nwrite = /\n[File I/O Security]\nnone\n";
        let conf = conf(text);
        assert_eq!(conf.writable, Some(Folders::All));
        let doubts = [
            "conf: 2: unknown setting `bar`",
            "conf: 4: unknown setting `write = /`",
        ];
        assert_eq!(conf.doubts, doubts);
    }

    #[test]
    fn a_file_about_other_things_limits_no_files() {
        let conf = conf("[Shellout Security]\nforbidden\n");
        assert_eq!((conf.writable, conf.doubts.len()), (None, 0));
    }

    #[test]
    fn the_stricter_of_two_files_counts() {
        let limited = |folders: &[&str]| Conf {
            writable: Some(Folders::Only(folders.iter().map(PathBuf::from).collect())),
            doubts: Vec::new(),
        };
        let free = Conf {
            writable: Some(Folders::All),
            doubts: Vec::new(),
        };
        assert_eq!(free.clone().and(free.clone()), free);
        assert_eq!(free.clone().and(limited(&["/a"])), limited(&["/a"]));
        assert_eq!(limited(&["/a"]).and(free), limited(&["/a"]));
        let both = limited(&["/a", "/b/c", "/d"]).and(limited(&["/a/x", "/b", "/d"]));
        assert_eq!(both, limited(&["/b/c", "/d", "/a/x"]));
    }
}
