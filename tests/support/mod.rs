//! Common code of tests that start renderers: the scenes of `pov_scenes/`, and processes with a time limit.

#![allow(dead_code, unused_imports, reason = "each test uses a part of this")]

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

pub(crate) mod browser;
pub(crate) mod running;

pub(crate) use povr::app::compare::run;

/// The number of runs of POV-Ray side by side. It spends most of its wall time asleep, so there are more than processors.
const AT_ONCE: usize = 6;

/// Calls `check` with each row, on several threads.
pub(crate) fn for_each_row(rows: &[&str], check: impl Fn(&str) + Sync) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|threads| {
        for _ in 0..AT_ONCE {
            threads.spawn(|| {
                while let Some(row) = rows.get(next.fetch_add(1, Ordering::Relaxed)) {
                    check(row);
                }
            });
        }
    });
}

/// The folder of the project's own scenes.
pub(crate) const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/pov_scenes");

/// The renderer under test: cargo's `povr`, or the program in the environment variable `POVR_BIN`.
///
/// `POVR_BIN=povray` tests the tests: then every picture must be equal.
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
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() && !path.ends_with("include") {
            paths.append(&mut scenes(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "pov") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// The processes that another has started.
#[cfg(target_os = "linux")]
pub(crate) fn children(process: u32) -> Vec<String> {
    let threads = fs::read_dir(format!("/proc/{process}/task"));
    let threads = threads.into_iter().flatten().flatten();
    let children = threads.map(|thread| fs::read_to_string(thread.path().join("children")));
    let children = children.map(Result::unwrap_or_default).collect::<String>();
    children.split_whitespace().map(str::to_owned).collect()
}
