//! Cancels renders that exceed a time limit.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::base::options::CancelToken;

/// Watches renders in progress, if there is a limit.
#[derive(Debug)]
pub(super) struct Watchdog {
    limit: Option<Duration>,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    watched: Vec<(Instant, CancelToken)>,
    is_over: bool,
}

impl Watchdog {
    pub(super) fn new(limit: Option<Duration>) -> Self {
        Watchdog {
            limit,
            state: Mutex::default(),
            changed: Condvar::new(),
        }
    }

    /// Watches `stop` from now on; cancels it at the time limit unless it is dropped before.
    pub(super) fn watch(&self, stop: &CancelToken) {
        let deadline = self
            .limit
            .and_then(|limit| Instant::now().checked_add(limit));
        if let Some(deadline) = deadline {
            self.lock().watched.push((deadline, stop.clone()));
            self.changed.notify_all();
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
            state.watched.retain(|(deadline, stop)| {
                if *deadline <= now {
                    stop.cancel();
                }
                *deadline > now
            });
            let next = state.watched.iter().map(|(deadline, _)| *deadline).min();
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
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_slow_tasks_are_stopped() {
        const LIMIT: Duration = Duration::from_millis(40);
        let watchdog = Watchdog::new(Some(LIMIT));
        // On a busy machine anything may take longer than the limit, and a panic before `end` would wait for ever.
        let (mut stopped_after, mut second) = (Duration::ZERO, (true, LIMIT));
        std::thread::scope(|scope| {
            scope.spawn(|| watchdog.run());
            let (begin, stop) = (Instant::now(), CancelToken::default());
            watchdog.watch(&stop);
            while !stop.is_cancelled() {
                std::thread::yield_now();
            }
            stopped_after = begin.elapsed();
            let (begin, stop) = (Instant::now(), CancelToken::default());
            watchdog.watch(&stop);
            watchdog.end();
            second = (stop.is_cancelled(), begin.elapsed());
        });
        assert!(stopped_after >= LIMIT);
        assert!(!second.0 || second.1 >= LIMIT);
    }
}
