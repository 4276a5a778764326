//! The wishes of the viewers of a page: the camera, the values of numbers, the clock and the cursor. All viewers share them.

use super::WatchEvent;
use super::source::{self, Edit, Edits};
use crate::app::worker::CameraReport;
use crate::base::file::{FileLimits, Named, read_limited};
use crate::base::options::ReadOptions;
use crate::base::sync::lock;
use crate::output::{self, Target};
use crate::scene::camera::{Movement, View};
use serde::Deserialize;
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex};

/// The prefix of the numbers that a scene may use to answer to the cursor.
pub(super) const CURSOR: &str = "live_cursor";
/// The most numbers with values of their own.
const MOST_EDITS: usize = 1000;

/// The wishes at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Wish {
    /// The camera, if it has been moved.
    pub(super) view: Option<View>,
    pub(super) scene: SceneWish,
    /// The last pixel to report on.
    pub(super) pick: Option<Pick>,
}

/// A pixel to report on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pick {
    /// Different for each.
    pub(super) number: u64,
    /// Its position from the upper left corner, in parts of the picture.
    pub(super) position: [f64; 2],
}

/// The wishes for which the scene has to be read again.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SceneWish {
    /// Values in place of numbers of the text.
    pub(super) edits: Edits,
    pub(super) clock: Option<f64>,
    /// Position of the cursor, -1 to 1 to the right and upwards, and its button, 0 or 1.
    pub(super) cursor: Option<[f64; 3]>,
}

impl SceneWish {
    /// Sets the clock and declares the cursor.
    pub(super) fn declare(&self, read: &mut ReadOptions) {
        if let Some(clock) = self.clock {
            read.clock = clock;
            read.clock_on = true;
        }
        let names = ["x", "y", "button"].map(|name| format!("{CURSOR}_{name}"));
        let values = self.cursor.into_iter().flatten();
        read.declares.extend(names.into_iter().zip(values));
    }
}

/// The wishes, which the server changes and the drawing loop reads.
#[derive(Debug)]
pub(super) struct Wishes {
    /// The file of the scene.
    path: PathBuf,
    state: Mutex<State>,
    /// Wakes the drawing loop.
    sender: Sender<WatchEvent>,
}

#[derive(Debug, Default)]
struct State {
    /// Incremented by every change.
    number: u64,
    wish: Wish,
    /// The text of the scene as it was last read; `None` if it is not UTF-8.
    text: Option<Arc<str>>,
    /// The camera of that scene.
    own: CameraReport,
}

/// A change that a page asks for.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Change {
    /// Moves the camera.
    Move(Movement),
    /// Sets a number of the text; without a value it is again what is written.
    Value {
        start: usize,
        end: usize,
        value: Option<String>,
    },
    Clock(Option<f64>),
    Cursor([f64; 3]),
    /// Reports on a pixel.
    Pick([f64; 2]),
    /// Takes the camera of the scene.
    ResetCamera,
    /// Takes the numbers of the text, and the clock of the command line.
    ResetValues,
    /// Writes the camera into the file.
    WriteCamera,
    /// Writes the values of numbers into the file.
    WriteValues,
}

impl Wishes {
    pub(super) fn new(path: PathBuf, sender: Sender<WatchEvent>) -> Self {
        Wishes {
            path,
            state: Mutex::default(),
            sender,
        }
    }

    /// The current wishes, and their number.
    pub(super) fn current(&self) -> (u64, Wish) {
        let state = lock(&self.state);
        (state.number, state.wish.clone())
    }

    /// The number of the current wishes.
    pub(super) fn number(&self) -> u64 {
        lock(&self.state).number
    }

    /// The text of the scene.
    pub(super) fn text(&self) -> Option<Arc<str>> {
        lock(&self.state).text.clone()
    }

    /// The camera that counts, and true if it has been moved.
    pub(super) fn view(&self) -> (Option<View>, bool) {
        let state = lock(&self.state);
        let moved = state.wish.view.clone();
        let is_moved = moved.is_some();
        (moved.or_else(|| state.own.view.clone()), is_moved)
    }

    /// Takes the text of the scene, before it is read. The places of values are none of a new one.
    pub(super) fn take_text(&self, text: Option<Arc<str>>) {
        let mut state = lock(&self.state);
        if state.text != text {
            state.text = text;
            state.wish.scene.edits.clear();
        }
    }

    /// Takes the camera of the scene that has been read. A new camera replaces one that has been moved.
    pub(super) fn take_camera(&self, own: CameraReport) {
        let mut state = lock(&self.state);
        if state.own.view != own.view && state.wish.view.take().is_some() {
            self.changed(&mut state);
        }
        state.own = own;
    }

    fn changed(&self, state: &mut State) {
        state.number += 1;
        // The loop runs as long as the process.
        let _ = self.sender.send(WatchEvent::Wish);
    }

    /// Changes the wishes, or writes them into the file.
    ///
    /// # Errors
    /// The reason that it is not done.
    pub(super) fn apply(&self, change: Change) -> Result<(), String> {
        let mut state = lock(&self.state);
        let before = state.wish.clone();
        let State {
            number,
            wish,
            text,
            own,
        } = &mut *state;
        match change {
            Change::Move(movement) => {
                let view = wish.view.take().or_else(|| own.view.clone());
                let mut view = view.ok_or("this camera cannot be moved: its vectors are skewed, or it has a normal, meshes, functions or a bokeh")?;
                view.apply(movement);
                wish.view = Some(view);
            }
            Change::Value { start, end, value } => {
                let edits = &mut wish.scene.edits;
                let Some(value) = value else {
                    edits.remove(&start);
                    self.note(&mut state, &before);
                    return Ok(());
                };
                let is_number = text
                    .as_deref()
                    .is_some_and(|text| source::holds_number(text, &(start..end)));
                let is_apart = edits
                    .iter()
                    .all(|(&from, edit)| from == start || edit.end <= start || end <= from);
                if !is_number || !source::is_number(&value) || !is_apart {
                    return Err("there is no such number in the scene".to_owned());
                }
                if edits.len() >= MOST_EDITS {
                    return Err("too many numbers are changed: write or reset them".to_owned());
                }
                edits.insert(start, Edit { end, text: value });
            }
            Change::Clock(clock) => {
                wish.scene.clock = clock.filter(|clock| clock.is_finite());
            }
            Change::Cursor(cursor) => {
                let is_used = text.as_deref().is_some_and(|text| text.contains(CURSOR));
                let is_valid = cursor.iter().all(|number| number.abs() <= 1.0);
                if is_used && is_valid {
                    wish.scene.cursor = Some(cursor);
                }
            }
            Change::Pick(position) => {
                if position.iter().all(|part| (0.0..1.0).contains(part)) {
                    let number = *number + 1;
                    wish.pick = Some(Pick { number, position });
                }
            }
            Change::ResetCamera => wish.view = None,
            Change::ResetValues => {
                wish.scene.edits.clear();
                wish.scene.clock = None;
            }
            Change::WriteCamera => {
                let view = wish.view.as_ref().ok_or("the camera has not been moved")?;
                let edit = |text: &str| {
                    source::camera_edit(text, own.statement.clone(), &view.to_string())
                };
                let edit = text.as_deref().and_then(edit);
                let edit = edit.ok_or(
                    "the camera is not in this file as a statement: copy its text by hand",
                )?;
                return self.write(text.as_deref(), &Edits::from([edit]));
            }
            Change::WriteValues => return self.write(text.as_deref(), &wish.scene.edits),
        }
        self.note(&mut state, &before);
        Ok(())
    }

    fn note(&self, state: &mut State, before: &Wish) {
        if state.wish != *before {
            self.changed(state);
        }
    }

    /// Writes the text with edits into the file of the scene, if that still holds the text.
    fn write(&self, text: Option<&str>, edits: &Edits) -> Result<(), String> {
        let text = text.ok_or("the scene is not a text in UTF-8")?;
        let path = self.path.display();
        let now = read_limited(&self.path, Named::ByScene, &FileLimits::default())
            .map_err(|error| format!("cannot read `{path}`: {error}"))?;
        if now.as_deref() != Some(text.as_bytes()) {
            return Err(format!("`{path}` has changed meanwhile: try it again"));
        }
        let new = source::edited(text, edits).ok_or("the numbers are no longer there")?;
        output::put(new.as_bytes(), &Target::File(self.path.clone()))
            .map_err(|error| error.to_string())
    }
}
