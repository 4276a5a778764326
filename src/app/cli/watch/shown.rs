//! The current display: the last good picture, errors since, and the pictures before.

use super::source::Control;
use super::wishes::{Overlay, Wished, Wishes};
use crate::app::worker::{MapReport, Patch, Picked};
use crate::base::sync::lock;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use hyper::body::Bytes;
use serde::Serialize;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// The number of finished pictures that stay, and their size in bytes.
const HISTORY: (usize, usize) = (24, 64 << 20);
/// The most bytes of the statistics of a picture: they are a part of each event.
const LONGEST_STATISTICS: usize = 1 << 14;
/// The most bytes of a preview that is a part of its event.
const LONGEST_PREVIEW: usize = 1 << 16;

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
    /// The warnings of the scene; empty if none.
    pub(super) warnings: String,
}

/// A view beside the picture.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Overlaid {
    pub(super) kind: Overlay,
    /// A PNG file; `None` if there is none, for the reason in the note.
    #[serde(skip)]
    pub(super) png: Option<Bytes>,
    pub(super) note: String,
    /// The scale of a map.
    pub(super) scale: Option<MapReport>,
    /// The time to draw it in seconds.
    pub(super) seconds: f64,
}

/// The display for any number of pages.
#[derive(Debug)]
pub(super) struct Shown {
    state: Mutex<State>,
    events: watch::Sender<String>,
    wishes: Arc<Wishes>,
    /// True while a picture is in progress.
    is_drawing: AtomicBool,
}

/// The display at one moment.
#[derive(Debug, Default)]
struct State {
    /// Incremented by every change.
    number: u64,
    picture: Option<Picture>,
    /// The picture as a PNG file in base64, if it is a small preview.
    preview: Option<String>,
    /// The number of the picture.
    pictures: u64,
    /// The last number of a picture; larger than the other one while a patch is there.
    last_number: u64,
    /// The next whole picture as a patch of the current one, until its file is there.
    patch: Option<PatchOf>,
    /// The errors of the scene; empty if none.
    errors: String,
    /// The clock of the command line.
    clock: f64,
    /// The first clock and the last one.
    clocks: [f64; 2],
    picked: Option<Picked>,
    /// The plan and the counts of the last whole picture.
    statistics: Option<serde_json::Value>,
    /// The last view beside a picture, with its number.
    overlaid: Option<(u64, Overlaid)>,
    /// True if it is of the current picture.
    is_overlaid: bool,
    /// The scene that is open.
    scene: Option<String>,
    /// The number of the last thumbnail.
    thumbnails: u64,
    /// Finished pictures with their numbers, the latest last.
    history: VecDeque<(u64, Bytes)>,
}

/// A picture as a patch of another one. A page that shows that one draws the patch over it.
#[derive(Clone, Debug, Serialize)]
struct PatchOf {
    /// The number of the new picture, and that of the other one.
    number: u64,
    over: u64,
    column: u32,
    row: u32,
    /// A PNG file in base64.
    png: String,
}

/// The display as the page receives it.
#[derive(Serialize)]
struct Event<'a> {
    number: u64,
    /// The name of the scene that is open.
    scene: Option<&'a str>,
    /// The number of the last thumbnail.
    thumbnails: u64,
    /// The number of the picture.
    picture: u64,
    /// The picture as a PNG file in base64, if it is a small preview: those of a camera in motion come with their events.
    preview: Option<&'a str>,
    patch: Option<&'a PatchOf>,
    errors: &'a str,
    /// The warnings of the scene that the picture shows.
    warnings: &'a str,
    is_preview: bool,
    seconds: Option<f64>,
    width: Option<u32>,
    height: Option<u32>,
    /// The number of the text, and its length in bytes.
    text: u64,
    text_bytes: usize,
    /// The statement of the camera; `None` if it cannot be moved.
    camera: Option<String>,
    is_moved: bool,
    /// True if the scene may answer to the cursor.
    has_cursor: bool,
    controls: &'a [Control],
    /// The values in place of numbers: first byte and text.
    values: Vec<(usize, String)>,
    clock: Option<f64>,
    /// The clock of the command line.
    own_clock: f64,
    /// The ends of its scrubber.
    clocks: [f64; 2],
    /// The last pixel that was reported on.
    picked: Option<&'a Picked>,
    statistics: Option<&'a serde_json::Value>,
    has_povray: bool,
    /// The view that is asked for.
    overlay: Option<Overlay>,
    /// The view that is there, with its number.
    overlaid: Option<&'a (u64, Overlaid)>,
    history: Vec<u64>,
}

impl Shown {
    /// An empty display.
    pub(super) fn new(wishes: Arc<Wishes>) -> Self {
        let state = State::default();
        Shown {
            events: watch::Sender::new(state.json(&wishes)),
            state: Mutex::new(state),
            wishes,
            is_drawing: AtomicBool::new(false),
        }
    }

    /// Shows a scene that has been opened, without the pictures of another one; `clock` is that of the command line.
    pub(super) fn open(&self, scene: String, clock: f64, clocks: [f64; 2]) {
        self.change(|state| {
            *state = State {
                number: state.number,
                pictures: state.last_number + 1,
                last_number: state.last_number + 1,
                thumbnails: state.thumbnails,
                scene: Some(scene),
                clock,
                clocks,
                ..State::default()
            }
        });
    }

    /// Shows that there are thumbnails up to this number.
    pub(super) fn thumbnails(&self, number: u64) {
        self.change(|state| state.thumbnails = number);
    }

    /// Notes that a picture is begun, or ended.
    pub(super) fn set_drawing(&self, is_drawing: bool) {
        self.is_drawing.store(is_drawing, Ordering::Relaxed);
    }

    /// True while a picture is in progress.
    pub(super) fn is_drawing(&self) -> bool {
        self.is_drawing.load(Ordering::Relaxed)
    }

    /// Shows a picture and clears the errors. Returns the number of the picture: this one, if it has been shown as a patch.
    pub(super) fn put(&self, picture: Picture, number: Option<u64>) -> u64 {
        self.change(|state| {
            if !picture.is_preview {
                state.remember(picture.png.clone());
            }
            let number = number.unwrap_or(state.last_number + 1);
            let is_sent = picture.is_preview && picture.png.len() <= LONGEST_PREVIEW;
            state.preview = is_sent.then(|| STANDARD.encode(&picture.png));
            state.picture = Some(picture);
            state.patch = None;
            state.is_overlaid = false;
            state.pictures = number;
            state.last_number = number.max(state.last_number);
            state.errors.clear();
            number
        })
    }

    /// Shows the next whole picture as a patch of another one, if that is the current picture. Returns its number.
    pub(super) fn patch(&self, over: u64, patch: Patch) -> Option<u64> {
        if lock(&self.state).pictures != over {
            return None;
        }
        let Patch {
            column, row, png, ..
        } = patch;
        let number = self.change(|state| {
            state.last_number += 1;
            state.patch = Some(PatchOf {
                number: state.last_number,
                over,
                column,
                row,
                png,
            });
            state.last_number
        });
        Some(number)
    }

    /// Shows errors beside the last picture.
    pub(super) fn fail(&self, errors: String) {
        self.change(|state| {
            state.errors = errors;
            state.patch = None;
        });
    }

    /// Shows the report on a pixel.
    pub(super) fn pick(&self, picked: Picked) {
        self.change(|state| state.picked = Some(picked));
    }

    /// Shows the statistics of a picture, which are JSON.
    pub(super) fn plan(&self, statistics: &str) {
        let read = Some(statistics).filter(|json| json.len() <= LONGEST_STATISTICS);
        let statistics = read.and_then(|json| serde_json::from_str(json).ok());
        // The picture follows.
        lock(&self.state).statistics = statistics;
    }

    /// Shows a view beside the picture.
    pub(super) fn overlay(&self, overlaid: Overlaid) {
        self.change(|state| {
            state.overlaid = Some((state.number, overlaid));
            state.is_overlaid = true;
        });
    }

    /// Shows the last view again.
    pub(super) fn overlay_again(&self) {
        self.change(|state| state.is_overlaid = true);
    }

    /// The view beside the picture, as a PNG file.
    pub(super) fn overlay_png(&self) -> Option<Bytes> {
        let state = lock(&self.state);
        state.overlaid.as_ref()?.1.png.clone()
    }

    /// Shows the current wishes and text.
    pub(super) fn refresh(&self) {
        self.change(|_| {});
    }

    /// The picture, as a PNG file.
    pub(super) fn png(&self) -> Option<Bytes> {
        self.numbered_png().map(|(_, png)| png)
    }

    /// The same with its number.
    pub(super) fn numbered_png(&self) -> Option<(u64, Bytes)> {
        let state = lock(&self.state);
        let picture = state.picture.as_ref()?;
        Some((state.pictures, picture.png.clone()))
    }

    /// A finished picture by its number, as a PNG file.
    pub(super) fn earlier(&self, number: u64) -> Option<Bytes> {
        let state = lock(&self.state);
        let mut history = state.history.iter();
        let (_, png) = history.find(|(known, _)| *known == number)?;
        Some(png.clone())
    }

    /// The descriptions of the display, current and to come, for the page.
    pub(super) fn events(&self) -> watch::Receiver<String> {
        self.events.subscribe()
    }

    fn change<T>(&self, change: impl FnOnce(&mut State) -> T) -> T {
        let mut state = lock(&self.state);
        let result = change(&mut state);
        state.number += 1;
        self.events.send_replace(state.json(&self.wishes));
        result
    }
}

impl State {
    /// Adds a finished picture, unless it is the last one again.
    fn remember(&mut self, png: Bytes) {
        if self.history.back().is_some_and(|(_, last)| *last == png) {
            return;
        }
        self.history.push_back((self.number, png));
        let (most, most_bytes) = HISTORY;
        let bytes = |history: &VecDeque<(u64, Bytes)>| -> usize {
            history.iter().map(|(_, png)| png.len()).sum()
        };
        while self.history.len() > most
            || self.history.len() > 1 && bytes(&self.history) > most_bytes
        {
            self.history.pop_front();
        }
    }

    fn json(&self, wishes: &Wishes) -> String {
        let picture = self.picture.as_ref();
        let Wished {
            wish, view, source, ..
        } = wishes.current();
        let values = wish.scene.edits.into_iter();
        let event = Event {
            number: self.number,
            scene: self.scene.as_deref(),
            thumbnails: self.thumbnails,
            picture: self.pictures,
            preview: self.preview.as_deref(),
            patch: self.patch.as_ref(),
            errors: &self.errors,
            warnings: picture.map_or("", |picture| &picture.warnings),
            is_preview: picture.is_some_and(|picture| picture.is_preview),
            seconds: picture.map(|picture| picture.seconds),
            width: picture.map(|picture| picture.size.0),
            height: picture.map(|picture| picture.size.1),
            text: source.number,
            text_bytes: source.text.as_ref().map_or(0, String::len),
            camera: view.map(|view| view.to_string()),
            is_moved: wish.view.is_some(),
            has_cursor: source.has_cursor,
            controls: &source.controls,
            values: values.map(|(start, edit)| (start, edit.text)).collect(),
            clock: wish.scene.clock,
            own_clock: self.clock,
            clocks: self.clocks,
            picked: self.picked.as_ref(),
            statistics: self.statistics.as_ref(),
            has_povray: wishes.povray.is_some(),
            overlay: wish.overlay,
            overlaid: self
                .overlaid
                .as_ref()
                .filter(|(_, one)| self.is_overlaid && Some(one.kind) == wish.overlay),
            history: self.history.iter().map(|(number, _)| *number).collect(),
        };
        // Its maps have texts for keys.
        serde_json::to_string(&event).unwrap_or_default()
    }
}
