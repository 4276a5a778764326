//! The files of this program: the one that starts it, and the one with its code. Both are the executable of the process,
//! unless an interpreter runs a script that loads a library.

use std::io;
#[cfg(target_os = "linux")]
use std::path::Path;
use std::path::PathBuf;
use std::sync::OnceLock;

/// The files of a program that is not the executable of its process.
#[derive(Clone, Debug)]
pub struct Program {
    /// The file that starts it; `None` if it is not installed.
    pub start: Option<PathBuf>,
    /// The file with its code.
    pub code: PathBuf,
}

static PROGRAM: OnceLock<Program> = OnceLock::new();

/// Sets the files, before anything is run. Only the first call counts.
pub fn set(program: Program) {
    let _ = PROGRAM.set(program);
}

/// The file that starts this program: commands start it again, or link to it.
///
/// # Errors
/// There is none, or the system does not name it.
pub(crate) fn start() -> io::Result<PathBuf> {
    let Some(program) = PROGRAM.get() else {
        return std::env::current_exe();
    };
    let missing = "the program `povr` is not among the scripts of this Python: install the module with `pip install`";
    let start = program.start.clone();
    start.ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, missing))
}

/// The executable of a process on Linux, even where its file was replaced since.
#[cfg(target_os = "linux")]
const THIS_PROGRAM: &str = "/proc/self/exe";

/// The file to start another process of the same build with.
pub(crate) fn again() -> io::Result<PathBuf> {
    #[cfg(target_os = "linux")]
    if PROGRAM.get().is_none() && Path::new(THIS_PROGRAM).exists() {
        return Ok(THIS_PROGRAM.into());
    }
    start()
}

/// The file with the code of this program, which distinguishes builds.
pub(crate) fn code() -> io::Result<PathBuf> {
    match PROGRAM.get() {
        Some(program) => Ok(program.code.clone()),
        None => std::env::current_exe(),
    }
}
