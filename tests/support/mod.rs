//! What the tests that start renderers share: the scenes of `pov_scenes/`, and processes with a time limit.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The folder of the project's own scenes.
pub(crate) const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/pov_scenes");

/// The renderer under test: `povr` as cargo built it, or what the environment names in `POVR_BIN`.
///
/// `POVR_BIN=povray` tests the tests: then every picture is to be equal.
pub(crate) fn renderer() -> OsString {
    std::env::var_os("POVR_BIN").unwrap_or_else(|| env!("CARGO_BIN_EXE_povr").into())
}

/// A folder under `target/`, made if it is missing.
pub(crate) fn scratch(name: &str) -> io::Result<PathBuf> {
    let tmp = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let folder = tmp.parent().unwrap_or(tmp).join(name);
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// All scenes under a folder, sorted. Files in folders called `include` are parts of scenes, not scenes.
pub(crate) fn scenes(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() && !path.ends_with("include") {
            found.append(&mut scenes(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "pov") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// How a process ended.
pub(crate) struct Ended {
    /// The exit status, or `None` if it ran past the limit and was killed.
    pub(crate) status: Option<ExitStatus>,
    /// All it wrote on standard error.
    pub(crate) stderr: String,
}

/// Runs a command to its end, but no longer than `limit`. Its standard output is thrown away.
pub(crate) fn run(command: &mut Command, limit: Duration) -> io::Result<Ended> {
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let pipe = child.stderr.take();
    let reader = thread::spawn(move || {
        let mut bytes = Vec::new();
        // What was read before a failing pipe is still worth showing.
        let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
        String::from_utf8_lossy(&bytes).into_owned()
    });
    let status = wait(&mut child, limit)?;
    let stderr = reader.join().unwrap_or_default();
    Ok(Ended { status, stderr })
}

fn wait(child: &mut Child, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
}
