//! What there is to see: the last good picture, and what is wrong since.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A picture as it is shown.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// A PNG file.
    pub(super) png: Arc<Vec<u8>>,
    /// Whether a better one is being drawn.
    pub(super) is_preview: bool,
    /// How long it took.
    pub(super) seconds: f64,
    /// The size of the whole picture.
    pub(super) size: (u32, u32),
}

/// What is shown, to any number of pages.
#[derive(Debug, Default)]
pub(super) struct Shown {
    state: Mutex<State>,
    changed: Condvar,
}

/// What is shown at a moment.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// Goes up with every change.
    pub(super) number: u64,
    pub(super) picture: Option<Picture>,
    /// What is wrong with the scene; empty if nothing.
    pub(super) errors: String,
}

impl Shown {
    /// Shows a picture: nothing is wrong.
    pub(super) fn put(&self, picture: Picture) {
        let mut state = self.lock();
        state.picture = Some(picture);
        state.errors.clear();
        state.number += 1;
        self.changed.notify_all();
    }

    /// Says what is wrong beside the last picture.
    pub(super) fn fail(&self, errors: String) {
        let mut state = self.lock();
        state.errors = errors;
        state.number += 1;
        self.changed.notify_all();
    }

    /// What is shown now.
    pub(super) fn now(&self) -> State {
        self.lock().clone()
    }

    /// What is shown as soon as it is other than at some number, or after some time.
    pub(super) fn after(&self, number: u64, patience: Duration) -> State {
        let same = |state: &mut State| state.number == number;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, same);
        waited.unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
