//! Ends what does not end in time by itself: this process, or a worker. A thread of its own keeps the time, so that it
//! holds even where all others wait in system calls.

use std::io;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Instant;

/// A watch over something with a deadline, until this is dropped.
#[derive(Debug)]
pub(crate) struct Watchdog {
    deadlines: Sender<Option<Instant>>,
}

impl Watchdog {
    /// Starts a watch without a deadline. At each deadline it calls `end` once.
    ///
    /// # Errors
    /// When the system starts no more threads.
    pub(crate) fn start(end: impl FnMut() + Send + 'static) -> io::Result<Self> {
        let (deadlines, changes) = mpsc::channel();
        thread::Builder::new()
            .name("watchdog".to_owned())
            .spawn(move || watch(&changes, end))?;
        Ok(Watchdog { deadlines })
    }

    /// Replaces the deadline.
    pub(crate) fn set(&self, deadline: Option<Instant>) {
        // The thread runs as long as this is there.
        let _ = self.deadlines.send(deadline);
    }
}

fn watch(changes: &Receiver<Option<Instant>>, mut end: impl FnMut()) {
    let mut deadline: Option<Instant> = None;
    loop {
        let change = match deadline {
            None => changes.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(deadline) => {
                changes.recv_timeout(deadline.saturating_duration_since(Instant::now()))
            }
        };
        match change {
            Ok(new) => deadline = new,
            Err(RecvTimeoutError::Timeout) => {
                deadline = None;
                end();
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    const SHORT: Duration = Duration::from_millis(20);
    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn each_deadline_ends_once_and_a_later_one_replaces_it() {
        let (ended, ends) = mpsc::channel();
        let watchdog = Watchdog::start(move || {
            let _ = ended.send(Instant::now());
        })
        .unwrap();
        let soon = || Some(Instant::now() + SHORT);
        watchdog.set(soon());
        watchdog.set(Some(Instant::now() + LONG));
        assert!(ends.recv_timeout(4 * SHORT).is_err());
        watchdog.set(None);
        assert!(ends.recv_timeout(4 * SHORT).is_err());
        for _ in 0..2 {
            let deadline = soon();
            watchdog.set(deadline);
            assert!(Some(ends.recv_timeout(LONG).unwrap()) >= deadline);
            assert!(ends.recv_timeout(4 * SHORT).is_err());
        }
    }

    #[test]
    fn a_dropped_watch_ends_nothing() {
        let count = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&count);
        let watchdog = Watchdog::start(move || {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        watchdog.unwrap().set(Some(Instant::now() + SHORT));
        thread::sleep(4 * SHORT);
        assert_eq!(count.load(Ordering::Relaxed), 0);
    }
}
