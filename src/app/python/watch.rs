//! Long work in a thread of its own, which signals, exceptions of callbacks and tokens cancel.

use povr::base::options;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::OnceLock;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;
use std::{process, thread};

/// The time between two looks at signals and progress.
const TICK: Duration = Duration::from_millis(50);

/// A flag that cancels renders, from any thread.
#[pyclass(frozen, module = "povr")]
#[derive(Default)]
pub(crate) struct CancelToken(options::CancelToken);

#[pymethods]
impl CancelToken {
    #[new]
    fn new() -> Self {
        CancelToken::default()
    }

    /// Cancels the renders that were given this token.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// True after `cancel()`.
    #[getter]
    fn cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// Cancels the work of one call, by itself or because the caller's token is cancelled. The caller's token is never
/// changed: it may serve further calls.
pub(crate) struct Stop {
    own: options::CancelToken,
    of_caller: Option<options::CancelToken>,
}

impl Stop {
    /// With the token of the caller, if there is one.
    pub(crate) fn new(of_caller: Option<&CancelToken>) -> Self {
        Stop {
            own: options::CancelToken::default(),
            of_caller: of_caller.map(|token| token.0.clone()),
        }
    }

    /// The token for the renderer. It follows the caller's within 50 ms, while [`watched`] runs.
    pub(crate) fn token(&self) -> &options::CancelToken {
        &self.own
    }

    fn follow(&self) {
        if self
            .of_caller
            .as_ref()
            .is_some_and(options::CancelToken::is_cancelled)
        {
            self.own.cancel();
        }
    }
}

/// The process that has started the threads.
static PROCESS: OnceLock<u32> = OnceLock::new();

/// Refuses to work in the child of a process that has worked: it has none of its threads, and would wait for them.
///
/// # Errors
/// `RuntimeError` in such a child.
pub(crate) fn same_process() -> PyResult<()> {
    match *PROCESS.get_or_init(process::id) == process::id() {
        true => Ok(()),
        false => Err(PyRuntimeError::new_err(
            "povr has started threads, and then this process was forked without them. Start processes with \
             multiprocessing.get_context(\"spawn\"), or draw in the children alone.",
        )),
    }
}

/// Runs `work` without the interpreter's lock. Meanwhile signal handlers of Python run, and `tick` is called every
/// 50 ms; an exception of either cancels the work, whose end it waits for, as does the caller's token.
///
/// # Errors
/// That exception; `RuntimeError` in a forked child ([`same_process`]) and where the system starts no thread.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    stop: &Stop,
    tick: &mut (dyn FnMut(Python<'_>) -> PyResult<()> + Send),
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    same_process()?;
    stop.follow();
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::sync_channel(1);
            let worker = thread::Builder::new().spawn_scoped(scope, move || {
                let done = work();
                // The receiver waits for it below.
                let _ = sender.send(());
                done
            });
            let worker = worker.map_err(|error| {
                PyRuntimeError::new_err(format!("cannot start a thread to draw in: {error}"))
            })?;
            let mut raised = Ok(());
            while receiver.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                stop.follow();
                if raised.is_ok() {
                    raised = Python::attach(|py| {
                        py.check_signals()?;
                        tick(py)
                    });
                    if raised.is_err() {
                        stop.own.cancel();
                    }
                }
            }
            let done = worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            raised.map(|()| done)
        })
    })
}
