//! Controls workers: kills those that exceed their time limit and do not end by themselves, and shares threads among them.

use crate::app::worker::Control;
use crate::base::sync::lock;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time after the limit in which a worker cancels its picture and ends by itself.
const GRACE: Duration = Duration::from_secs(3);

/// Watches workers.
#[derive(Debug)]
pub(super) struct Watchdog {
    limit: Option<Duration>,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Number, deadline and worker of each picture in progress.
    watched: Vec<(u64, Option<Instant>, Control)>,
    /// The number of the next entry.
    next: u64,
    is_over: bool,
}

/// A watch over one picture, until this is dropped.
#[derive(Debug)]
pub(super) struct Watched<'a> {
    watchdog: &'a Watchdog,
    number: u64,
}

impl Watchdog {
    pub(super) fn new(limit: Option<Duration>) -> Self {
        Watchdog {
            limit: limit.map(|limit| limit.saturating_add(GRACE)),
            state: Mutex::default(),
            changed: Condvar::new(),
        }
    }

    /// Watches a worker from now on.
    pub(super) fn watch(&self, control: Control) -> Watched<'_> {
        let mut state = self.lock();
        let number = state.next;
        state.next += 1;
        let deadline = self
            .limit
            .and_then(|limit| Instant::now().checked_add(limit));
        state.watched.push((number, deadline, control));
        self.changed.notify_all();
        Watched {
            watchdog: self,
            number,
        }
    }

    /// Shares threads among the workers, which may have begun with fewer. It does not wait for them.
    pub(super) fn share(&self, threads: usize) {
        let state = self.lock();
        for (.., control) in &state.watched {
            control.use_threads(threads.div_ceil(state.watched.len()));
        }
    }

    /// Ends [`Watchdog::run`].
    pub(super) fn end(&self) {
        self.lock().is_over = true;
        self.changed.notify_all();
    }

    /// Watches until it is ended.
    pub(super) fn run(&self) {
        let mut state = self.lock();
        while !state.is_over {
            let now = Instant::now();
            state.watched.retain(|(_, deadline, control)| {
                let is_over = deadline.is_some_and(|deadline| deadline <= now);
                if is_over {
                    control.kill();
                }
                !is_over
            });
            let next = state.watched.iter().filter_map(|one| one.1).min();
            state = match next {
                Some(next) => {
                    let waited = self.changed.wait_timeout(state, next - now);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
                None => {
                    let waited = self.changed.wait(state);
                    waited.unwrap_or_else(PoisonError::into_inner)
                }
            };
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }
}

impl Drop for Watched<'_> {
    fn drop(&mut self) {
        let mut state = self.watchdog.lock();
        state.watched.retain(|(number, ..)| *number != self.number);
    }
}
