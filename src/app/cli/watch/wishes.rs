//! The wishes of the viewers of a page: the camera, the values of numbers, the clock and the cursor. All viewers share them.

use super::WatchEvent;
use super::scenes::{SceneFile, Scenes};
use super::source::{self, CURSOR, Edit, Edits, SceneText};
use crate::app::worker::{CameraReport, Splice};
use crate::base::file::{FileLimits, Named, read_limited};
use crate::base::options::ReadOptions;
use crate::base::sync::lock;
use crate::output::{self, Target};
use crate::scene::camera::{Movement, View};
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex};

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
    /// The view beside the picture.
    pub(super) overlay: Option<Overlay>,
}

/// A view beside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Overlay {
    /// Rays of each pixel.
    Rays,
    /// Time of each pixel.
    Time,
    /// Estimated error of each pixel.
    Error,
    /// POV-Ray's picture.
    PovRay,
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
    /// The scenes that can be opened.
    pub(super) scenes: Scenes,
    /// True if pages may write into files.
    may_write: bool,
    /// POV-Ray, if it is installed and may read the scene.
    pub(super) povray: Option<PathBuf>,
    state: Mutex<State>,
    /// Held while the file is written, and until its new text is known.
    writing: Mutex<()>,
    /// Wakes the drawing loop.
    sender: Sender<WatchEvent>,
}

#[derive(Debug, Default)]
struct State {
    /// Incremented by every change.
    number: u64,
    wish: Wish,
    /// The text of the scene as it was last read.
    source: Arc<SceneText>,
    /// The camera of the scene, and the number of the text that its statement is in.
    own: (CameraReport, u64),
    /// The scene that is open.
    scene: Option<SceneFile>,
    /// The scene to open.
    next: Option<SceneFile>,
}

/// All wishes at one moment, with the text that they refer to.
#[derive(Debug)]
pub(super) struct Wished {
    /// Incremented by every change of the wishes.
    pub(super) number: u64,
    pub(super) wish: Wish,
    /// The camera that counts; `None` if it cannot be moved.
    pub(super) view: Option<View>,
    pub(super) source: Arc<SceneText>,
}

/// A change that a page asks for.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Change {
    /// Moves the camera.
    Move(Movement),
    /// Sets a number of the text; without a value it is again what is written.
    Value {
        /// The number of the text.
        text: u64,
        start: usize,
        end: usize,
        value: Option<String>,
    },
    Clock(Option<f64>),
    Cursor([f64; 3]),
    /// Reports on a pixel.
    Pick([f64; 2]),
    /// Shows a view beside the picture.
    Overlay(Option<Overlay>),
    /// Opens a scene of the list.
    Open(String),
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
    /// No wishes yet; pages open these scenes, and write into them if they may.
    pub(super) fn new(
        scenes: Scenes,
        may_write: bool,
        povray: Option<PathBuf>,
        sender: Sender<WatchEvent>,
    ) -> Self {
        Wishes {
            scenes,
            may_write,
            povray,
            state: Mutex::default(),
            writing: Mutex::default(),
            sender,
        }
    }

    /// The current wishes.
    pub(super) fn current(&self) -> Wished {
        let state = lock(&self.state);
        let moved = state.wish.view.clone();
        Wished {
            number: state.number,
            wish: state.wish.clone(),
            view: moved.or_else(|| state.own.0.view.clone()),
            source: Arc::clone(&state.source),
        }
    }

    /// The scene to open, once.
    pub(super) fn take_next(&self) -> Option<SceneFile> {
        lock(&self.state).next.take()
    }

    /// Takes a scene that has been opened, without the wishes for another one.
    pub(super) fn open(&self, scene: SceneFile) {
        let _written = lock(&self.writing);
        let mut state = lock(&self.state);
        *state = State {
            number: state.number,
            wish: Wish {
                overlay: state.wish.overlay,
                ..Wish::default()
            },
            source: Arc::new(SceneText::new(state.source.number + 1, None)),
            scene: Some(scene),
            next: state.next.take(),
            ..State::default()
        };
    }

    /// The number of the current wishes.
    pub(super) fn number(&self) -> u64 {
        lock(&self.state).number
    }

    /// Takes the contents of the scene's file, before it is read. The places of values are none of a new text.
    pub(super) fn take_file(&self, bytes: Option<Vec<u8>>) {
        let _written = lock(&self.writing);
        let mut state = lock(&self.state);
        let new = SceneText::new(state.source.number + 1, bytes);
        if new.text != state.source.text {
            state.wish.scene.edits.clear();
            state.source = Arc::new(new);
        }
    }

    /// Takes a change of the scene's file since the text of a number; false if that is not the current text any more.
    pub(super) fn take_change(&self, number: u64, change: &Splice) -> bool {
        let _written = lock(&self.writing);
        let mut state = lock(&self.state);
        if state.source.number != number {
            return false;
        }
        if !change.is_empty() {
            let source = std::mem::take(&mut state.source);
            let source = Arc::try_unwrap(source).unwrap_or_else(|shared| (*shared).clone());
            state.wish.scene.edits.clear();
            state.source = Arc::new(source.changed(change));
        }
        true
    }

    /// Takes the camera of the scene that has been read, with these edits of a text of this number. A new camera replaces
    /// one that has been moved.
    pub(super) fn take_camera(&self, mut own: CameraReport, (number, edits): (u64, &Edits)) {
        let mut state = lock(&self.state);
        if state.source.number != number {
            // The file has changed meanwhile, and is read again.
            return;
        }
        own.statement = own
            .statement
            .and_then(|range| source::unedited(&range, edits));
        if state.own.0.aimless != own.aimless && state.wish.view.take().is_some() {
            self.changed(&mut state);
        }
        state.own = (own, number);
    }

    /// The bytes of the camera's statement in the text with its edits, if it stands there.
    pub(super) fn camera_statement(&self, wished: &Wished) -> Option<Range<usize>> {
        let state = lock(&self.state);
        let (own, number) = &state.own;
        let is_current = *number == wished.source.number;
        let moved = |position| source::moved(position, &wished.wish.scene.edits);
        let statement = own.statement.clone().filter(|_| is_current)?;
        Some(moved(statement.start)..moved(statement.end))
    }

    fn changed(&self, state: &mut State) {
        state.number += 1;
        // The loop runs as long as the process.
        let _ = self.sender.send(WatchEvent::Wish);
    }

    /// Changes the wishes, or writes them into the file, which may take time.
    ///
    /// # Errors
    /// The reason that it is not done.
    pub(super) fn apply(&self, change: Change) -> Result<(), String> {
        let mut state = lock(&self.state);
        let before = state.wish.clone();
        let State {
            number,
            wish,
            source,
            own: (own, _),
            ..
        } = &mut *state;
        match change {
            Change::Move(movement) => {
                let view = wish.view.take().or_else(|| own.view.clone());
                let mut view = view.ok_or("this camera cannot be moved: its vectors are skewed, or it has a normal, meshes, functions or a bokeh")?;
                view.apply(movement);
                wish.view = Some(view);
            }
            Change::Value {
                text,
                start,
                end,
                value,
            } => {
                if text != source.number {
                    return Err("the scene has changed meanwhile: try it again".to_owned());
                }
                let range = start..end;
                set_value(source, &mut wish.scene.edits, range, value)?;
            }
            Change::Clock(clock) => {
                wish.scene.clock = clock.filter(|clock| clock.is_finite());
            }
            Change::Cursor(cursor) => {
                let is_valid = cursor.iter().all(|number| number.abs() <= 1.0);
                if source.has_cursor && is_valid {
                    wish.scene.cursor = Some(cursor);
                }
            }
            Change::Open(name) => {
                let scene = self.scenes.named(&name);
                let next = scene.ok_or("there is no such scene in the folder")?;
                state.next = Some(next);
                self.changed(&mut state);
                return Ok(());
            }
            Change::Pick(position) => {
                if position.iter().all(|part| (0.0..1.0).contains(part)) {
                    let number = *number + 1;
                    wish.pick = Some(Pick { number, position });
                }
            }
            Change::Overlay(Some(Overlay::PovRay)) if self.povray.is_none() => {
                return Err(
                    "POV-Ray is not installed, or `--sandbox` or `--no-write` forbids it"
                        .to_owned(),
                );
            }
            Change::Overlay(overlay) => wish.overlay = overlay,
            Change::ResetCamera => wish.view = None,
            Change::ResetValues => {
                wish.scene.edits.clear();
                wish.scene.clock = None;
            }
            Change::WriteCamera => {
                drop(state);
                return self.write(State::camera_edits);
            }
            Change::WriteValues => {
                drop(state);
                return self.write(|state, _| Ok(state.value_edits()));
            }
        }
        if state.wish != before {
            self.changed(&mut state);
        }
        Ok(())
    }

    /// Writes edits into the file of the scene, if that still holds the text. Other values stay, at their numbers in the
    /// new text.
    fn write(
        &self,
        edits_of: impl FnOnce(&State, &str) -> Result<Written, String>,
    ) -> Result<(), String> {
        if !self.may_write {
            return Err("no file is written with `--sandbox` or `--no-write`".to_owned());
        }
        let Ok(_writing) = self.writing.try_lock() else {
            return Err("the file is being read or written: try it again".to_owned());
        };
        let (path, source, (edits, statement)) = {
            let state = lock(&self.state);
            let path = match &state.scene {
                Some(SceneFile {
                    path,
                    built_in: None,
                }) => path.clone(),
                _ => return Err("this scene has no file: copy its source into one".to_owned()),
            };
            let text = state.source.text.as_deref();
            let text = text.ok_or("the scene is not a text in UTF-8")?;
            (path, Arc::clone(&state.source), edits_of(&state, text)?)
        };
        let text = source.text.as_deref().unwrap_or_default();
        let new = source::edited(text, &edits).ok_or("the numbers are no longer there")?;
        let new = source.file(&new);
        replace_file(path, &source.file(text), &new)?;
        let mut state = lock(&self.state);
        let number = source.number + 1;
        state.source = Arc::new(SceneText::new(number, Some(new)));
        state.wish.scene.edits = source::rebased(&state.wish.scene.edits, &edits);
        if state.own.1 == source.number {
            state.own.0.statement = statement;
            state.own.1 = number;
        }
        self.changed(&mut state);
        Ok(())
    }
}

/// Replaces the contents of a file.
fn replace_file(file: PathBuf, old: &[u8], new: &[u8]) -> Result<(), String> {
    let path = file.display();
    let now = read_limited(&file, Named::ByScene, &FileLimits::default())
        .map_err(|error| format!("cannot read `{path}`: {error}"))?;
    if now.as_deref() != Some(old) {
        return Err(format!("`{path}` has changed meanwhile: try it again"));
    }
    output::put(new, &Target::File(file)).map_err(|error| error.to_string())
}

/// Edits to write, and the range of the camera's statement in the new text.
type Written = (Edits, Option<Range<usize>>);

impl State {
    /// The edits that write the values of numbers.
    fn value_edits(&self) -> Written {
        let edits = self.wish.scene.edits.clone();
        let moved = |position| source::moved(position, &edits);
        let statement = self.own.0.statement.clone();
        let statement = statement.map(|Range { start, end }| moved(start)..moved(end));
        (edits, statement)
    }

    /// The edit that writes the camera.
    fn camera_edits(&self, text: &str) -> Result<Written, String> {
        let view = self.wish.view.as_ref();
        let statement = view.ok_or("the camera has not been moved")?.to_string();
        let (own, number) = &self.own;
        if *number != self.source.number {
            return Err("the scene has not been read yet: try it again".to_owned());
        }
        let edit = source::camera_edit(text, own.statement.clone(), &statement);
        let (start, edit) =
            edit.ok_or("the camera is not in this file as a statement: copy its text by hand")?;
        let at = start + edit.text.find(&statement).unwrap_or_default();
        let range = at..at + statement.len();
        Ok((Edits::from([(start, edit)]), Some(range)))
    }
}

/// Sets the number in a range of the text; `None` sets what is written.
fn set_value(
    source: &SceneText,
    edits: &mut Edits,
    Range { start, end }: Range<usize>,
    value: Option<String>,
) -> Result<(), String> {
    let Some(value) = value else {
        edits.remove(&start);
        return Ok(());
    };
    let text = source.text.as_deref();
    let is_number = text.is_some_and(|text| source::holds_number(text, &(start..end)));
    let is_apart = edits
        .iter()
        .all(|(&from, edit)| from == start || edit.end <= start || end <= from);
    if !is_number || !source::is_number(&value) || !is_apart {
        return Err("there is no such number in the scene".to_owned());
    }
    if edits.len() >= MOST_EDITS && !edits.contains_key(&start) {
        return Err("too many numbers are changed: write or reset them".to_owned());
    }
    edits.insert(start, Edit { end, text: value });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_numbers_change_again_at_their_limit() {
        let source = SceneText::new(1, Some("0 ".repeat(MOST_EDITS + 1).into_bytes()));
        let mut edits = Edits::new();
        let mut set = |index: usize, value: &str| {
            let range = 2 * index..2 * index + 1;
            set_value(&source, &mut edits, range, Some(value.to_owned()))
        };
        for index in 0..MOST_EDITS {
            set(index, "1").expect("a number");
        }
        set(MOST_EDITS, "1").expect_err("one too many");
        set(7, "2").expect("one of them");
        assert_eq!(edits[&14].text, "2");
        set_value(&source, &mut edits, 14..15, None).expect("it is reset");
        assert_eq!(edits.len(), MOST_EDITS - 1);
    }
}
