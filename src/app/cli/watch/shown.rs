//! The current display: the last good picture, and errors since.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A picture on display.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// A PNG file.
    pub(super) png: Arc<Vec<u8>>,
    /// True if a better one is in progress.
    pub(super) is_preview: bool,
    /// The render time in seconds.
    pub(super) seconds: f64,
    /// The size of the whole picture.
    pub(super) size: (u32, u32),
}

/// The display for any number of pages.
#[derive(Debug, Default)]
pub(super) struct Shown {
    state: Mutex<State>,
    changed: Condvar,
}

/// The display at one moment.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// Incremented by every change.
    pub(super) number: u64,
    pub(super) picture: Option<Picture>,
    /// The errors of the scene; empty if none.
    pub(super) errors: String,
}

impl Shown {
    /// Shows a picture and clears the errors.
    pub(super) fn put(&self, picture: Picture) {
        let mut state = self.lock();
        state.picture = Some(picture);
        state.errors.clear();
        state.number += 1;
        self.changed.notify_all();
    }

    /// Shows errors beside the last picture.
    pub(super) fn fail(&self, errors: String) {
        let mut state = self.lock();
        state.errors = errors;
        state.number += 1;
        self.changed.notify_all();
    }

    /// The current state.
    pub(super) fn now(&self) -> State {
        self.lock().clone()
    }

    /// The first state whose number differs, or the current one after some time.
    pub(super) fn after(&self, number: u64, patience: Duration) -> State {
        let same = |state: &mut State| state.number == number;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, same);
        waited.unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
