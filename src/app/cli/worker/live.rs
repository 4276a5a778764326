//! Pictures of a scene that stays compiled, and reports on their pixels.

use super::Replies;
use super::mosaic::{Mosaic, Part, enlarged};
use crate::app::worker::{
    CameraReport, Live, LiveTask, LiveText, Patch, Picked, PickedSurface, PictureKey, Reply,
    Report, Splice,
};
use crate::base::encoding::EncodeOptions;
use crate::base::film::Film;
use crate::base::options::{
    Event, EventHandler, Failure, Input, Picture, ReadOptions, RenderOptions,
};
use crate::base::source::TextChange;
use crate::scene::camera::{Camera, View};
use crate::{CompiledScene, RenderSession, object_at, output};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// The state of live scenes between their pictures.
#[derive(Debug, Default)]
pub(super) struct LiveScenes {
    /// The last scene with its number.
    compiled: Option<(u64, CompiledScene)>,
    /// The last text that was sent.
    text: Option<SentText>,
    /// The file of the scene that the pictures are of.
    path: PathBuf,
    /// The last coarse picture.
    coarse: Option<LiveFilm>,
    /// The last whole picture.
    whole: Option<LiveFilm>,
    /// The last whole picture that the command has.
    delivered: Option<Delivered>,
}

/// A picture that the command has.
#[derive(Debug)]
struct Delivered {
    of: PictureKey,
    /// The encoding of its file.
    encode: EncodeOptions,
    /// The part in which [`LiveScenes::whole`] differs from it.
    changed: Option<Part>,
}

/// A picture.
#[derive(Debug)]
struct LiveFilm {
    /// `None` for the last picture with some tiles of later ones.
    of: Option<PictureKey>,
    film: Film,
}

/// A text that was sent.
#[derive(Debug, Default)]
struct SentText {
    text: Arc<String>,
    /// Its change since the last compiled version.
    change: TextChange,
    /// The text before the last change, and that change. The next text is made in its memory, as the compiled scene still
    /// uses `text`.
    before: Option<(Arc<String>, Splice)>,
}

impl SentText {
    /// The text with another part; `None` if it has no such part.
    fn changed(self, splice: Splice) -> Option<SentText> {
        let unshared = self.before.and_then(|(mut before, last)| {
            let is_same = last.apply(Arc::get_mut(&mut before)?);
            is_same.then_some(before)
        });
        let mut text = unshared.unwrap_or_else(|| Arc::clone(&self.text));
        splice.apply(Arc::make_mut(&mut text)).then(|| SentText {
            text,
            change: self.change.then(&splice.change()),
            before: Some((self.text, splice)),
        })
    }
}

/// The most bytes of a patch, in base64. Pages receive it with an event.
const LONGEST_PATCH: usize = 1 << 17;
/// A patch has this part of the pixels of its picture at most.
const SHARE_OF_PATCH: u64 = 4;

/// The product of a task.
pub(super) enum LiveProduct {
    /// Files that are complete; an empty one for a preview that is not needed.
    Files(Vec<Vec<u8>>),
    /// A picture to encode.
    Picture(Box<Picture>),
}

/// The picture, if it is that of the scene.
fn film_of<'a>(film: Option<&'a LiveFilm>, live: &Live) -> Option<&'a Film> {
    let LiveFilm { of, film } = film?;
    (of.as_ref() == Some(&live.picture())).then_some(film)
}

impl LiveScenes {
    /// Carries a task out on the input of [`LiveScenes::input`]. The picture in progress is encoded by `encode`.
    pub(super) fn draw(
        &mut self,
        painter: &LiveScene<'_>,
        (live, input): (&mut Live, &Input),
        encode: Option<&EncodeOptions>,
        replies: &Replies,
    ) -> Result<LiveProduct, Failure> {
        let report = |report| {
            replies.send(&Reply::Report(report));
        };
        if self.path != painter.path {
            painter.path.clone_into(&mut self.path);
            (self.coarse, self.whole, self.delivered) = (None, None, None);
        }
        let scene = painter.compiled((live, input), &mut self.compiled, &report)?;
        if let Some(SentText { change, .. }) = &mut self.text {
            *change = TextChange::default();
        }
        let start = Instant::now();
        match live.task {
            LiveTask::Pixel(column, row) => {
                let picked = painter.picked(scene, input, (column, row))?;
                report(Report::Picked(Box::new(picked)));
                return Ok(LiveProduct::Files(Vec::new()));
            }
            LiveTask::Map(kind) => {
                let known = film_of(self.whole.as_ref(), live);
                let (png, scale) = painter.map(scene, kind, known)?;
                report(Report::Map(scale));
                return Ok(LiveProduct::Files(vec![png]));
            }
            LiveTask::Coarse if scene.needs_no_preview(painter.render) => {
                // The picture in progress appears over the last one.
                return Ok(LiveProduct::Files(vec![Vec::new()]));
            }
            LiveTask::Coarse | LiveTask::Whole => {}
        }
        let mut picture = match (live.task, encode) {
            (LiveTask::Whole, Some(encode)) => {
                let render = painter.render;
                let last = self.whole.take_if(|LiveFilm { film, .. }| {
                    [film.width, film.height] == [render.width, render.height]
                });
                let (under, mut delivered) = match (film_of(self.coarse.as_ref(), live), last) {
                    (None, Some(last)) => (last.film, self.delivered.take()),
                    (coarse, _) => (enlarged(coarse, render), None),
                };
                let send = |file: &[u8]| replies.partial(file);
                let encode = scene.encoding(encode);
                let mosaic = Mosaic::over(under, encode.clone(), &send);
                let drawn = painter.draw(scene, &|event| match event {
                    Event::Tile { .. } if render.stop.is_cancelled() => {}
                    Event::Tile {
                        columns,
                        rows,
                        pixels,
                    } => mosaic.add(columns, rows, pixels),
                    event => (painter.listen)(event),
                });
                let (film, changed) = mosaic.end();
                if let Some(Delivered { changed: part, .. }) = &mut delivered {
                    *part = Part::around(part.take(), changed);
                }
                let picture = match drawn {
                    Ok(picture) => picture,
                    Err(failure) => {
                        // The next picture appears over this one.
                        self.whole = Some(LiveFilm { of: None, film });
                        self.delivered = delivered;
                        return Err(failure);
                    }
                };
                // The same pixels in another gamma are another picture.
                if let Some(over) = delivered.filter(|over| over.encode == encode)
                    && let Some(patch) = patch(&picture.film, over, &encode)
                {
                    report(Report::Patch(Box::new(patch)));
                }
                picture
            }
            _ => painter.draw(scene, painter.listen)?,
        };
        report(Report::Traced(start.elapsed()));
        if live.task == LiveTask::Whole {
            picture.statistics.plan = scene.plan();
        }
        if live.task == LiveTask::Whole
            && let Ok(json) = serde_json::to_string(&picture.statistics)
        {
            report(Report::Statistics(json));
        }
        Ok(LiveProduct::Picture(Box::new(picture)))
    }

    /// The scene in a file, with the text of a request, which is taken.
    pub(super) fn input(&mut self, path: &Path, live: &mut Live) -> Input {
        let path = path.to_owned();
        self.text = match (
            std::mem::replace(&mut live.text, LiveText::Sent),
            self.text.take(),
        ) {
            (LiveText::File, _) => None,
            (LiveText::Sent, last) => last,
            (LiveText::Changed(splice), last) => last.and_then(|last| last.changed(splice)),
            (LiveText::Whole(text), last) => {
                let SentText {
                    text: old, change, ..
                } = last.unwrap_or_default();
                let between = TextChange::between(old.as_bytes(), text.as_bytes());
                Some(SentText {
                    text: Arc::new(text),
                    change: change.then(&between),
                    before: None,
                })
            }
        };
        match &self.text {
            None => Input::File(path),
            Some(SentText { text, .. }) if live.is_built_in => Input::Text {
                name: path.display().to_string(),
                text: text.as_bytes().to_vec(),
            },
            Some(SentText { text, change, .. }) => Input::Edited {
                path,
                text: Arc::clone(text),
                change: Some(change.clone()),
            },
        }
    }

    /// Stores a picture that has been drawn, with the encoding of its file.
    pub(super) fn store(&mut self, live: &Live, film: Film, encode: Option<EncodeOptions>) {
        // Some have levels instead of pixels.
        let film = Some(film).filter(|film| film.levels.is_none());
        let of = live.picture();
        let film = film.map(|film| LiveFilm {
            of: Some(of.clone()),
            film,
        });
        match live.task {
            LiveTask::Coarse => self.coarse = film,
            _ => {
                self.delivered = encode.filter(|_| film.is_some()).map(|encode| Delivered {
                    of,
                    encode,
                    changed: None,
                });
                self.whole = film;
            }
        }
    }
}

/// The part of a picture in which it differs from an earlier one, if it is small.
fn patch(
    film: &Film,
    Delivered {
        of: over, changed, ..
    }: Delivered,
    encode: &EncodeOptions,
) -> Option<Patch> {
    // Dithering makes pixels depend on others.
    let is_apart = film.levels.is_none() && encode.dither.is_none();
    // A picture that is the same is a patch as well.
    let part = changed.unwrap_or(Part {
        columns: 0..1,
        rows: 0..1,
    });
    let pixels = part.columns.len() as u64 * part.rows.len() as u64;
    let all = u64::from(film.width) * u64::from(film.height);
    if !is_apart || SHARE_OF_PATCH * pixels > all {
        return None;
    }
    let png = output::encode(&part.of(film), encode).ok()?;
    let png = STANDARD.encode(png);
    (png.len() <= LONGEST_PATCH).then_some(Patch {
        over,
        column: part.columns.start,
        row: part.rows.start,
        png,
    })
}

/// A live scene, with the options of its next picture.
pub(super) struct LiveScene<'a> {
    /// The file.
    pub(super) path: &'a Path,
    pub(super) session: &'a RenderSession,
    pub(super) read: &'a ReadOptions,
    pub(super) render: &'a RenderOptions,
    pub(super) listen: &'a EventHandler<'a>,
}

impl LiveScene<'_> {
    /// The compiled scene with the camera of the next picture: that of the last picture, if it is of the same text.
    fn compiled<'c>(
        &self,
        (live, input): (&Live, &Input),
        compiled: &'c mut Option<(u64, CompiledScene)>,
        report: &dyn Fn(Report),
    ) -> Result<&'c CompiledScene, Failure> {
        let camera = live.camera.as_deref().map(camera_of).transpose()?;
        let (number, mut last) = compiled.take().unzip();
        let is_same = number == Some(live.number)
            && last
                .as_mut()
                .is_some_and(|scene| scene.set_camera(camera.as_ref(), self.render));
        let scene = match last.take_if(|_| is_same) {
            Some(scene) => Ok(scene),
            None => self.compile((input, camera), &mut last, report),
        };
        // With errors the last scene that could be read stays, for the next one.
        *compiled = number.zip(last);
        let (_, scene) = compiled.insert((live.number, scene?));
        Ok(scene)
    }

    fn draw(&self, scene: &CompiledScene, listen: &EventHandler<'_>) -> Result<Picture, Failure> {
        scene.draw(self.read, self.render, listen, self.session)
    }

    /// Compiles the scene for a camera or its own, and reports its own.
    fn compile(
        &self,
        (input, camera): (&Input, Option<Camera>),
        last: &mut Option<CompiledScene>,
        report: &dyn Fn(Report),
    ) -> Result<CompiledScene, Failure> {
        let options = (self.read, self.render);
        let other = camera.clone();
        let mut scene = self
            .session
            .compile_next(last, input, options, other, self.listen)?;
        let is_own = camera.is_none() || scene.set_camera(None, self.render);
        let (width, height) = (self.render.width, self.render.height);
        let centre = (f64::from(width - 1) / 2.0, f64::from(height - 1) / 2.0);
        let hit = is_own
            .then(|| scene.hit_at(centre, (width, height)))
            .flatten();
        report(Report::Camera(Box::new(CameraReport {
            view: View::of(scene.camera(), hit.map(|hit| hit.point)),
            aimless: View::of(scene.camera(), None),
            statement: scene.camera_statement(),
        })));
        if camera.is_some() && is_own {
            scene.set_camera(camera.as_ref(), self.render);
        }
        Ok(scene)
    }

    /// The report on a pixel of the picture: the surface that is seen in its centre, and its cost.
    ///
    /// # Errors
    /// When the work is cancelled, or has not enough memory.
    fn picked(
        &self,
        scene: &CompiledScene,
        input: &Input,
        (column, row): (u32, u32),
    ) -> Result<Picked, Failure> {
        let size = (self.render.width, self.render.height);
        let hit = scene.hit_at((f64::from(column), f64::from(row)), size);
        let surface = hit.map(|hit| PickedSurface {
            point: hit.point.into(),
            normal: hit.normal.into(),
            distance: hit.from.distance(hit.point),
            object: object_at(input, self.read, &hit).and_then(|message| message.location),
        });
        let pixel = RenderOptions {
            columns: column..column + 1,
            rows: row..row + 1,
            ..self.render.clone()
        };
        let start = Instant::now();
        let drawn = scene.draw(self.read, &pixel, &|_| {}, self.session)?;
        let named = |(kind, count): (&str, u64)| (kind.to_owned(), count);
        let rays = drawn.statistics.rays;
        Ok(Picked {
            column,
            row,
            surface,
            rays: rays.into_iter().map(named).collect(),
            seconds: start.elapsed().as_secs_f64(),
        })
    }
}

/// The camera of a statement.
fn camera_of(statement: &str) -> Result<Camera, Failure> {
    let input = Input::Text {
        name: "the camera".to_owned(),
        text: format!("#version 3.7;\n{statement}\n").into_bytes(),
    };
    crate::read(&input, &ReadOptions::default(), &|_| {}).map(|scene| scene.camera)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_memory_of_the_last_text_is_used_again() {
        let replace = |range, with: &str| Splice {
            range,
            with: with.to_owned(),
        };
        let mut sent = SentText {
            text: Arc::new("sphere { 0, 1 }".to_owned()),
            ..SentText::default()
        };
        let mut addresses = Vec::new();
        let changes = [
            (replace(9..10, "y"), "sphere { y, 1 }"),
            (replace(12..13, "25"), "sphere { y, 25 }"),
            (replace(0..6, "box"), "box { y, 25 }"),
            (replace(9..11, "z"), "box { y, z }"),
        ];
        for (splice, text) in changes {
            let compiled = Arc::clone(&sent.text);
            sent = sent.changed(splice).expect("the range is there");
            assert_eq!(*sent.text, text);
            assert_ne!(*compiled, text);
            addresses.push(Arc::as_ptr(&sent.text));
        }
        assert_eq!(sent.change.old, 0..13);
        assert_eq!(addresses[0], addresses[2]);
        assert_eq!(addresses[1], addresses[3]);
        assert!(sent.changed(replace(40..41, "x")).is_none());
    }
}
