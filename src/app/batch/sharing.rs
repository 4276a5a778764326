//! Shares threads among the workers of pictures in progress.

use crate::app::worker::Control;
use crate::base::sync::lock;
use std::sync::Mutex;

/// The workers of the pictures in progress.
#[derive(Debug, Default)]
pub(super) struct Sharing {
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Number and worker of each picture.
    drawing: Vec<(u64, Control)>,
    /// The number of the next entry.
    next: u64,
}

/// A worker among which threads are shared, until this is dropped.
#[derive(Debug)]
pub(super) struct Shared<'a> {
    sharing: &'a Sharing,
    number: u64,
}

impl Sharing {
    /// Adds the worker of a picture.
    pub(super) fn add(&self, control: Control) -> Shared<'_> {
        let mut state = lock(&self.state);
        let number = state.next;
        state.next += 1;
        state.drawing.push((number, control));
        Shared {
            sharing: self,
            number,
        }
    }

    /// Shares threads among the workers, which may have begun with fewer. It does not wait for them.
    pub(super) fn share(&self, threads: usize) {
        let state = lock(&self.state);
        for (_, control) in &state.drawing {
            control.use_threads(threads.div_ceil(state.drawing.len()));
        }
    }
}

impl Drop for Shared<'_> {
    fn drop(&mut self) {
        let mut state = lock(&self.sharing.state);
        state.drawing.retain(|(number, _)| *number != self.number);
    }
}
