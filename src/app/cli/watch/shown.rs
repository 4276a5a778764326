//! The current display: the last good picture, and errors since.

use hyper::body::Bytes;
use std::sync::{Mutex, MutexGuard, PoisonError};
use tokio::sync::watch;

/// A picture on display.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// A PNG file.
    pub(super) png: Bytes,
    /// True if a better one is in progress.
    pub(super) is_preview: bool,
    /// The render time in seconds.
    pub(super) seconds: f64,
    /// The size of the whole picture.
    pub(super) size: (u32, u32),
}

/// The display for any number of pages.
#[derive(Debug)]
pub(super) struct Shown {
    state: Mutex<State>,
    events: watch::Sender<String>,
}

/// The display at one moment.
#[derive(Debug, Default)]
struct State {
    /// Incremented by every change.
    number: u64,
    picture: Option<Picture>,
    /// The errors of the scene; empty if none.
    errors: String,
}

impl Default for Shown {
    fn default() -> Self {
        let state = State::default();
        Shown {
            events: watch::Sender::new(state.json()),
            state: Mutex::new(state),
        }
    }
}

impl Shown {
    /// Shows a picture and clears the errors.
    pub(super) fn put(&self, picture: Picture) {
        let mut state = self.lock();
        state.picture = Some(picture);
        state.errors.clear();
        self.changed(&mut state);
    }

    /// Shows errors beside the last picture.
    pub(super) fn fail(&self, errors: String) {
        let mut state = self.lock();
        state.errors = errors;
        self.changed(&mut state);
    }

    /// The picture, as a PNG file.
    pub(super) fn png(&self) -> Option<Bytes> {
        let state = self.lock();
        state.picture.as_ref().map(|picture| picture.png.clone())
    }

    /// The descriptions of the display, current and to come, for the page.
    pub(super) fn events(&self) -> watch::Receiver<String> {
        self.events.subscribe()
    }

    fn changed(&self, state: &mut State) {
        state.number += 1;
        self.events.send_replace(state.json());
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn json(&self) -> String {
        let picture = self.picture.as_ref();
        serde_json::json!({
            "number": self.number,
            "errors": self.errors,
            "is_preview": picture.is_some_and(|picture| picture.is_preview),
            "seconds": picture.map(|picture| picture.seconds),
            "width": picture.map(|picture| picture.size.0),
            "height": picture.map(|picture| picture.size.1),
        })
        .to_string()
    }
}
