//! Long work in a thread of its own, which signals, exceptions of callbacks and tokens cancel.

use povr::base::options;
use pyo3::prelude::*;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

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

impl CancelToken {
    /// The token for the renderer.
    pub(crate) fn inner(&self) -> &options::CancelToken {
        &self.0
    }
}

/// Runs `work` without the interpreter's lock. Meanwhile signal handlers of Python run, and `tick` is called every
/// 50 ms; an exception of either cancels the work, whose end it waits for.
///
/// # Errors
/// That exception.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    token: &CancelToken,
    tick: &mut (dyn FnMut(Python<'_>) -> PyResult<()> + Send),
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::sync_channel(1);
            let worker = scope.spawn(move || {
                let done = work();
                // The receiver waits for it below.
                let _ = sender.send(());
                done
            });
            let mut raised = Ok(());
            while receiver.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                if raised.is_ok() {
                    raised = Python::attach(|py| {
                        py.check_signals()?;
                        tick(py)
                    });
                    if raised.is_err() {
                        token.0.cancel();
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
