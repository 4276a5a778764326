//! The folder that an untrusted scene is drawn in, and runs of the program there.

use crate::support;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// A run that opens a pipe would wait for ever; all others here end at once.
pub(crate) const LIMIT: Duration = Duration::from_secs(5);

pub(crate) const REST: &str =
    "camera { location -5*z look_at 0 } light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }\n";

/// The user's `povray.conf`.
const CONF: &str = "[File I/O Security]\nrestricted\n[Permitted Paths]
read+write = .\nread+write* = %HOME%/../tmp\n";

/// A folder for the untrusted scene `s.pov`, one for temporary files, and one that must not be touched.
pub(crate) struct Sandbox {
    pub(crate) all: tempfile::TempDir,
}

/// The end of a run: its exit code, if it ended by itself, and its standard error.
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) said: String,
}

impl Sandbox {
    pub(crate) fn new() -> Self {
        let all = tempfile::tempdir().expect("temporary folders can be made");
        for folder in ["here", "tmp", "other", "home/.povray/3.7"] {
            fs::create_dir_all(all.path().join(folder)).expect("folders can be made");
        }
        let sandbox = Sandbox { all };
        // All of the folder lies in `/tmp`, where the `povray.conf` of a system may let scenes write.
        sandbox.write("home/.povray/3.7/povray.conf", CONF);
        sandbox
    }

    pub(crate) fn with(scene: &str) -> Self {
        let sandbox = Sandbox::new();
        sandbox.write("here/s.pov", &format!("{REST}{scene}\n"));
        sandbox
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.all.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("files can be written");
    }

    pub(crate) fn pipe(&self, name: &str) {
        let made = Command::new("mkfifo").arg(self.path(name)).status();
        assert!(made.expect("mkfifo is there").success());
    }

    /// Runs a shell command in the folder of the scene; `$POVR` is the program.
    pub(crate) fn shell(&self, command: &str) -> Ended {
        let mut shell = Command::new("sh");
        // Children of the shell would outlive it without a time limit of their own.
        let command = command.replace("$POVR", "timeout -s KILL 5 \"$POVR\"");
        shell
            .args(["-c", &command])
            .current_dir(self.path("here"))
            .env("HOME", self.path("home"))
            .env("TMPDIR", self.path("tmp"))
            .env("POVR", support::renderer());
        let ended = support::run(&mut shell, 2 * LIMIT).expect("the shell starts");
        Ended {
            code: ended.status.and_then(|status| status.code()),
            said: ended.stderr,
        }
    }

    /// [`Self::shell`], which must end with this exit code.
    pub(crate) fn ends(&self, command: &str, code: i32) -> Ended {
        let ended = self.shell(command);
        assert_eq!(ended.code, Some(code), "{command}: {}", ended.said);
        ended
    }

    pub(crate) fn draw(&self) -> Ended {
        self.shell("$POVR s.pov +W16 +H12 -D -A +WT2 -o s.png")
    }

    /// All files below, with their contents; for pictures and for anything but regular files only their names.
    pub(crate) fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut contents = BTreeMap::new();
        collect(self.all.path(), &mut contents);
        contents
    }
}

fn collect(folder: &Path, contents: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("the folder is readable") {
        let path = entry.expect("the folder is readable").path();
        let about = fs::symlink_metadata(&path).expect("it is there");
        if about.is_dir() {
            collect(&path, contents);
        }
        let is_picture = path.extension().is_some_and(|ending| ending == "png");
        let bytes = match about.is_file() && !is_picture {
            true => fs::read(&path).expect("it is readable"),
            false => Vec::new(),
        };
        contents.insert(path, bytes);
    }
}
