//! Limits of this process: those of the system, and those of `--timeout` and `--max-memory`.
//!
//! A thread watches the time and the memory of the process. At a limit it cancels the rendering, which then removes its
//! temporary files. A rendering that does not end soon after, in a system call for example, is ended with the process.

use super::report::{Reporter, Stream, say};
use crate::app::cli::options::output_kinds::MessageFormat;
use crate::app::watchdog::Watchdog;
use crate::app::worker::Limit;
use crate::base::memory::Taken;
use crate::base::options::{CancelToken, Event};
use crate::base::source::{Code, Diagnostic, Message, Sources};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// Interval of looking at the memory. In that time a process may take some hundred megabytes more.
const LOOK: Duration = Duration::from_millis(20);
/// Time for a cancelled rendering to end by itself.
const GRACE: Duration = Duration::from_secs(1);
/// The exit code of a process that reached a limit.
const FAILED: i32 = 1;

/// Makes writes beyond `ulimit -f` fail like those to a full disk. By default the process would be killed by the signal
/// `SIGXFSZ`: without a message, and leaving a part of a picture behind.
pub(crate) fn outlive_file_limit() {
    #[cfg(unix)]
    {
        use signal_hook::{consts::SIGXFSZ, flag};
        // A handled signal does not kill, whatever the handler does. If no handler can be installed, the default
        // remains.
        let _ = flag::register(SIGXFSZ, std::sync::Arc::default());
    }
}

/// Limits of a process.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    timeout: Option<Duration>,
    max_memory: Option<u64>,
}

/// A watch over the limits of the process. It ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Watch {
    is_over: Arc<AtomicBool>,
    _running: Sender<()>,
}

impl Limits {
    pub(crate) fn new(timeout: Option<Duration>, max_memory: Option<u64>) -> Self {
        Limits {
            timeout,
            max_memory,
        }
    }

    /// Waits for the first of the limits; `None` if the watch is over before.
    fn wait(self, watch: &Receiver<()>) -> Option<Limit> {
        let started = Instant::now();
        loop {
            let left = self
                .timeout
                .map(|timeout| timeout.saturating_sub(started.elapsed()));
            if left.is_some_and(|left| left.is_zero()) {
                return Some(Limit::Time);
            }
            let is_full = self
                .max_memory
                .is_some_and(|most| Taken::now().is_some_and(|taken| taken.resident > most));
            if is_full {
                return Some(Limit::Memory);
            }
            let look = self.max_memory.map(|_| LOOK);
            let pause = left.into_iter().chain(look).min().unwrap_or(Duration::MAX);
            if watch.recv_timeout(pause) == Err(RecvTimeoutError::Disconnected) {
                return None;
            }
        }
    }
}

impl Watch {
    /// Watches a command, from now on. At a limit `stop` cancels its rendering; without `stop` it holds nothing to
    /// remove, and ends at once.
    pub(crate) fn over_command(
        limits: Limits,
        stop: Option<CancelToken>,
        (format, stream): (MessageFormat, Stream),
    ) -> Self {
        Watch::start(limits, stop, move |limit| {
            let message = format!(
                "stopped: this {}",
                limit.excess(limits.timeout, limits.max_memory)
            );
            if format != MessageFormat::Json {
                return say(format_args!("povr: {message}"));
            }
            let error = Diagnostic::error(None, message).with_code(Code::Limit);
            let error = Message::new(&error, &Sources::default());
            Reporter::new(format, stream).report(Event::Finding(&error));
        })
    }

    /// Watches a rendering from now on, and calls `tell` at a limit.
    pub(crate) fn start(
        limits: Limits,
        stop: Option<CancelToken>,
        tell: impl FnOnce(Limit) + Send + 'static,
    ) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let (running, ended) = mpsc::channel();
        let watch = Watch {
            is_over: Arc::clone(&is_over),
            _running: running,
        };
        let Limits {
            timeout,
            max_memory,
        } = limits;
        if timeout.is_none() && max_memory.is_none() {
            return watch;
        }
        // Even a message may wait in a system call for a reader of its pipe.
        let last =
            Watchdog::start(|| process::exit(FAILED)).unwrap_or_else(|error| unwatched(&error));
        let work = move || {
            let Some(limit) = limits.wait(&ended) else {
                return;
            };
            is_over.store(true, Ordering::Relaxed);
            last.set(Some(Instant::now() + GRACE));
            tell(limit);
            if let Some(stop) = stop {
                stop.cancel();
                // The last reads may take more memory, but not for long.
                let max_memory = max_memory.map(|most| most.saturating_add(most / 4));
                if Limits::new(Some(GRACE), max_memory).wait(&ended).is_none() {
                    return;
                }
            }
            process::exit(FAILED);
        };
        if max_memory.is_some() && Taken::now().is_none() {
            say(
                "povr: warning: this system does not tell the memory of a process; `--max-memory` is ignored",
            );
        }
        if let Err(error) = thread::Builder::new().name("limits".to_owned()).spawn(work) {
            unwatched(&error);
        }
        watch
    }

    /// True if a limit was reached.
    pub(crate) fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }
}

/// Ends the process, which has no thread to watch its limits.
fn unwatched(error: &std::io::Error) -> ! {
    say(format_args!("povr: the limits cannot be watched: {error}"));
    process::exit(FAILED);
}
