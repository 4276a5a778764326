//! A renderer with POV-Ray's command line, run as a process of its own: POV-Ray, or this program.

use super::process::{Ended, run, run_until};
use crate::base::options::CancelToken;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The folder of the standard include files of POV-Ray 3.7, as Debian installs it.
const STANDARD_INCLUDES: &str = "/usr/share/povray-3.7/include";
/// Those of POV-Ray 3.8: installed, built, or unpacked by `tools/povray38`; relative to the folder of the program.
const STANDARD_INCLUDES_38: [&str; 3] = [
    "../share/povray-3.8/include",
    "root/usr/share/povray-3.8/include",
    "/usr/share/povray-3.8/include",
];

/// POV-Ray's message when its threads do not start within its own time limit.
const THREADS_LATE: &str = "Timed out waiting for worker thread startup";
/// Number of times POV-Ray is started before that is an error.
const STARTS: usize = 10;

/// A renderer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renderer {
    /// The program.
    pub program: OsString,
    /// Its output for `--version`: other versions render other pictures.
    pub version: String,
    /// Switches that precede all others.
    pub switches: Vec<String>,
    /// The folder of the standard include files that belong to it.
    pub includes: PathBuf,
}

/// A picture to render.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// The scene, as a path from the root.
    pub scene: &'a Path,
    /// The file of the picture, as a path from the root. POV-Ray writes only into the folder it runs in: this one's.
    pub file: &'a Path,
    /// Switches for size, antialiasing and so on.
    pub switches: &'a [String],
    /// A folder that contains the scene and all files it reads: POV-Ray may read below it, as below `$HOME`.
    pub root: &'a Path,
    /// Time limit.
    pub limit: Duration,
    /// Ends the process when it is cancelled.
    pub stop: Option<&'a CancelToken>,
}

impl Renderer {
    /// POV-Ray, 3.7 or 3.8, with one thread, so that its pictures are the same every time. `povray` is the one that
    /// Debian installs.
    ///
    /// # Errors
    /// When it does not run, or is POV-Ray 3.8 without its include files.
    pub fn povray(program: impl Into<OsString>) -> io::Result<Renderer> {
        let mut povray = Renderer::new(program)?;
        povray.switches = vec!["+WT1".to_owned()];
        Ok(povray)
    }

    /// A renderer by the name of its program.
    ///
    /// # Errors
    /// When it does not run, or is POV-Ray 3.8 without its include files.
    pub fn new(program: impl Into<OsString>) -> io::Result<Renderer> {
        const PATIENCE: Duration = Duration::from_secs(60);
        let program = program.into();
        let ended = run(Command::new(&program).arg("--version"), PATIENCE)?;
        if !ended.status.is_some_and(|status| status.success()) {
            return Err(io::Error::other("it does not tell its version"));
        }
        Ok(Renderer {
            includes: standard_includes(Path::new(&program), &ended.stderr)?,
            program,
            version: ended.stderr,
            switches: Vec::new(),
        })
    }

    /// True if it draws the words of POV-Ray 3.8.
    #[must_use]
    pub fn is_3_8(&self) -> bool {
        says_3_8(&self.version)
    }

    /// Renders. A started process need not have made a picture: see [`Ended`] and check the file. POV-Ray gives up on a
    /// busy machine when its threads do not start in time, and is then started again.
    ///
    /// # Errors
    /// When the program does not start.
    pub fn draw(&self, picture: &Picture<'_>) -> io::Result<Ended> {
        let mut ended = self.draw_once(picture)?;
        for _ in 1..STARTS {
            if !ended.stderr.contains(THREADS_LATE) {
                break;
            }
            ended = self.draw_once(picture)?;
        }
        Ok(ended)
    }

    fn draw_once(&self, picture: &Picture<'_>) -> io::Result<Ended> {
        // An older picture must not be mistaken for this one; usually there is none.
        let _ = fs::remove_file(picture.file);
        let mut command = Command::new(&self.program);
        let name = picture.file.file_name().unwrap_or_default();
        command
            .current_dir(picture.file.parent().unwrap_or(Path::new(".")))
            .env("HOME", picture.root)
            .arg(format!("+I{}", picture.scene.display()))
            .arg(format!("+O{}", name.display()))
            .args(&self.switches)
            .args(picture.switches);
        match picture.stop {
            Some(stop) => run_until(&mut command, picture.limit, stop),
            None => run(&mut command, picture.limit),
        }
    }
}

/// True if this output for `--version` is that of POV-Ray 3.8.
fn says_3_8(version: &str) -> bool {
    version.contains("POV-Ray 3.8")
}

/// The folder of the standard include files for a program that says this of its version.
///
/// # Errors
/// When POV-Ray 3.8 lacks them: those of 3.7 draw other pictures.
fn standard_includes(program: &Path, version: &str) -> io::Result<PathBuf> {
    if !says_3_8(version) {
        return Ok(STANDARD_INCLUDES.into());
    }
    let program = which::which(program).map_err(io::Error::other)?;
    // A link may stand for it in another folder.
    let program = fs::canonicalize(program)?;
    let folder = program.parent().unwrap_or(Path::new(""));
    let mut folders = STANDARD_INCLUDES_38.iter().map(|name| folder.join(name));
    folders.find(|folder| folder.is_dir()).ok_or_else(|| {
        let looked = STANDARD_INCLUDES_38.join("`, `");
        let folder = folder.display();
        io::Error::other(format!(
            "its include files are in none of `{looked}` as seen from {folder}; `tools/povray38` unpacks both"
        ))
    })
}

/// Switches with the include folders for both renderers: beside the scene, and the standard library.
pub(super) fn library(scene: &Path, includes: &Path) -> Vec<String> {
    let folders = scene.parent().into_iter().chain([includes]);
    folders
        .map(|folder| format!("+L{}", folder.display()))
        .collect()
}

/// The last lines of a renderer's output.
#[must_use]
pub fn tail(stderr: &str) -> String {
    let lines: Vec<_> = stderr
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    lines[lines.len().saturating_sub(12)..].join("\n")
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    #[test]
    fn povray_is_started_again_when_its_threads_were_late() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let program = folder.path().join("povray");
        let late = format!("echo {THREADS_LATE} >&2; exit 1");
        let script =
            format!("#!/bin/sh\necho >>starts\n[ $(wc -l <starts) = 3 ] || {{ {late}; }}\n");
        fs::write(&program, script)?;
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755))?;
        let renderer = Renderer {
            program: program.into(),
            version: String::new(),
            switches: Vec::new(),
            includes: PathBuf::new(),
        };
        let ended = renderer.draw(&Picture {
            scene: Path::new("a.pov"),
            file: &folder.path().join("a.png"),
            switches: &[],
            root: folder.path(),
            limit: Duration::from_secs(60),
            stop: None,
        })?;
        assert!(ended.status.is_some_and(|status| status.success()));
        assert_eq!(fs::read_to_string(folder.path().join("starts"))?, "\n\n\n");
        Ok(())
    }

    #[test]
    fn a_link_to_povray_3_8_has_the_include_files_of_its_target() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let root = fs::canonicalize(folder.path())?;
        let includes = root.join("unpacked/root/usr/share/povray-3.8/include");
        fs::create_dir_all(&includes)?;
        let program = root.join("unpacked/povray");
        fs::write(&program, "")?;
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755))?;
        let link = root.join("povray38");
        symlink(&program, &link)?;
        assert_eq!(standard_includes(&link, "POV-Ray 3.8.0")?, includes);
        let of_37 = standard_includes(&link, "POV-Ray 3.7.0.10")?;
        assert_eq!(of_37, Path::new(STANDARD_INCLUDES));
        Ok(())
    }
}
