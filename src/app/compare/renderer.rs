//! A renderer with POV-Ray's command line, run as a process of its own: POV-Ray, or this program.

use super::process::{Ended, run};
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// Debian's folder of the standard include files.
const STANDARD_INCLUDES: &str = "/usr/share/povray-3.7/include";

/// A renderer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renderer {
    /// The program.
    pub program: OsString,
    /// Its output for `--version`: other versions render other pictures.
    pub version: String,
    /// Switches that precede all others.
    pub switches: Vec<String>,
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
}

impl Renderer {
    /// POV-Ray as Debian installs it, with one thread, so that its pictures are the same every time.
    ///
    /// # Errors
    /// When it does not run.
    pub fn povray() -> io::Result<Renderer> {
        let mut povray = Renderer::new("povray")?;
        povray.switches = vec!["+WT1".to_owned()];
        Ok(povray)
    }

    /// A renderer by the name of its program.
    ///
    /// # Errors
    /// When it does not run.
    pub fn new(program: impl Into<OsString>) -> io::Result<Renderer> {
        const PATIENCE: Duration = Duration::from_secs(60);
        let program = program.into();
        let ended = run(Command::new(&program).arg("--version"), PATIENCE)?;
        if !ended.status.is_some_and(|status| status.success()) {
            return Err(io::Error::other("it does not tell its version"));
        }
        Ok(Renderer {
            program,
            version: ended.stderr,
            switches: Vec::new(),
        })
    }

    /// Renders. A started process need not have made a picture: see [`Ended`] and check the file.
    ///
    /// # Errors
    /// When the program does not start.
    pub fn draw(&self, picture: &Picture<'_>) -> io::Result<Ended> {
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
        run(&mut command, picture.limit)
    }
}

/// Switches with the include folders for both renderers: beside the scene, and the standard library.
pub(super) fn library(scene: &Path) -> Vec<String> {
    let beside = scene.parent().map(Path::to_owned);
    let folders = beside.into_iter().chain([PathBuf::from(STANDARD_INCLUDES)]);
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
