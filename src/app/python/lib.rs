//! The Python module `povr._povr`, on which the Python sources in `povr/` build.
//!
//! Options arrive as POV-Ray's switches, so that they mean what they mean on the command line; scenes arrive as text,
//! and objects beside it as arrays. Results are bytes and JSON, from which the Python sources make arrays and objects.
//! Allocator, signals and files of the process stay as they are, except where [`run`] makes it a program of povr.

mod arrays;
mod compare;
mod session;
mod watch;

use povr::app::cli::{self, Environment};
use povr::app::program::{self, Program};
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use std::fmt;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use watch::{CancelToken, Stop};

pyo3::create_exception!(
    _povr,
    Refused,
    PyException,
    "A scene that cannot be drawn. The argument is its findings, as JSON."
);
pyo3::create_exception!(
    _povr,
    Cancelled,
    PyException,
    "A render that was cancelled."
);

/// The environment of this process without the user's ini file, which is for a program.
fn environment() -> Environment {
    Environment {
        user_ini: None,
        warning: None,
        ..Environment::of_this_process()
    }
}

/// Options that are wrong.
fn value_error(error: &impl fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Runs the command line as the program of this process and returns the exit code. `start` is the file that starts it,
/// if it is installed; `code` is that of this module.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<String>, start: Option<PathBuf>, code: PathBuf) -> u8 {
    povr::base::memory::claim_heap();
    program::set(Program { start, code });
    let code = py.detach(|| {
        let code = cli::run(arguments);
        // The interpreter knows nothing of what is left there.
        let _ = std::io::stdout().flush();
        code
    });
    (0..=u8::MAX)
        .find(|&number| ExitCode::from(number) == code)
        .unwrap_or(1)
}

/// Measures as `povr curve` with these arguments. Returns the report as JSON.
#[pyfunction]
fn curve(
    py: Python<'_>,
    arguments: Vec<String>,
    token: Option<Py<CancelToken>>,
) -> PyResult<String> {
    let stop = Stop::new(token.as_ref().map(Py::get));
    let measured = watch::watched(py, &stop, &mut |_| Ok(()), || {
        cli::curve_report(&arguments, &environment(), stop.token())
    })?;
    let report = measured.map_err(|error| value_error(&error))?;
    serde_json::to_string(&report).map_err(|error| value_error(&error))
}

/// The module.
#[pymodule]
mod _povr {
    #[pymodule_export]
    use super::compare::compare;
    #[pymodule_export]
    use super::session::{Drawn, Session};
    #[pymodule_export]
    use super::watch::CancelToken;
    #[pymodule_export]
    use super::{Cancelled, Refused, curve, run};
}
