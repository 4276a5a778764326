//! Limits of this process: those of the system, and those of `--timeout` and `--max-memory`.
//!
//! A thread watches the time and the memory of the process. At a limit it cancels the rendering, which then removes its
//! temporary files. A rendering that does not end soon after, in a system call for example, is ended with the process.

use super::report::say;
use crate::app::cli::options::settings::Settings;
use crate::base::memory::Taken;
use crate::base::options::CancelToken;
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
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

/// A watch over the limits of the process.
#[derive(Debug)]
pub(crate) struct Watch {
    is_over: Arc<AtomicBool>,
}

impl Watch {
    /// Watches a rendering that `stop` cancels, from now on.
    pub(crate) fn start(settings: &Settings, stop: CancelToken) -> Self {
        Watch::of(settings.timeout, settings.max_memory, Some(stop))
    }

    /// Watches a process that holds nothing to remove: it ends at the limit.
    pub(crate) fn ending_at_once(timeout: Option<Duration>, max_memory: Option<u64>) {
        Watch::of(timeout, max_memory, None);
    }

    fn of(timeout: Option<Duration>, max_memory: Option<u64>, stop: Option<CancelToken>) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let watch = Watch {
            is_over: Arc::clone(&is_over),
        };
        let started = Instant::now();
        if timeout.is_none() && max_memory.is_none() {
            return watch;
        }
        let work = move || {
            let limits = Limits {
                deadline: timeout.and_then(|timeout| started.checked_add(timeout)),
                max_memory,
            };
            limits.wait();
            is_over.store(true, Ordering::Relaxed);
            match (timeout, max_memory) {
                (Some(timeout), _) if started.elapsed() >= timeout => say(format_args!(
                    "povr: stopped: this took longer than {timeout:?}, which `--timeout` allows"
                )),
                _ => say(format_args!(
                    "povr: stopped: this took more memory than the {} MB that `--max-memory` allows",
                    max_memory.unwrap_or_default() >> 20
                )),
            }
            if let Some(stop) = stop {
                stop.cancel();
                let grace = Limits {
                    deadline: Instant::now().checked_add(GRACE),
                    // The last reads may take more, but not for long.
                    max_memory: max_memory.map(|most| most.saturating_add(most / 4)),
                };
                grace.wait();
            }
            process::exit(FAILED);
        };
        if max_memory.is_some() && Taken::now().is_none() {
            say(
                "povr: warning: this system does not tell the memory of a process; `--max-memory` is ignored",
            );
        }
        if let Err(error) = thread::Builder::new().name("limits".to_owned()).spawn(work) {
            say(format_args!("povr: the limits cannot be watched: {error}"));
            process::exit(FAILED);
        }
        watch
    }

    /// True if a limit was reached.
    pub(crate) fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }
}

#[derive(Clone, Copy, Debug)]
struct Limits {
    deadline: Option<Instant>,
    max_memory: Option<u64>,
}

impl Limits {
    /// Waits for the first of the limits.
    fn wait(self) {
        loop {
            let left = self.deadline.map_or(Duration::MAX, |deadline| {
                deadline.saturating_duration_since(Instant::now())
            });
            let is_full = self
                .max_memory
                .is_some_and(|most| Taken::now().is_some_and(|taken| taken.resident > most));
            if left.is_zero() || is_full {
                return;
            }
            thread::sleep(match self.max_memory {
                Some(_) => left.min(LOOK),
                None => left,
            });
        }
    }
}
