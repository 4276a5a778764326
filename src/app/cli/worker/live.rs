//! Pictures of a scene that stays compiled, and reports on their pixels.

use super::Replies;
use super::mosaic::{Mosaic, enlarged};
use crate::app::worker::{CameraReport, Live, LiveTask, Picked, PickedSurface, Reply, Report};
use crate::base::encoding::EncodeOptions;
use crate::base::film::Film;
use crate::base::options::{
    Event, EventHandler, Failure, Input, Picture, ReadOptions, RenderOptions,
};
use crate::scene::camera::{Camera, View};
use crate::{CompiledScene, RenderSession, object_at};
use std::path::PathBuf;
use std::time::Instant;

/// The state of live scenes between their pictures.
#[derive(Debug, Default)]
pub(super) struct LiveScenes {
    /// The last scene with its number.
    compiled: Option<(u64, CompiledScene)>,
    /// The last coarse picture.
    coarse: Option<LiveFilm>,
    /// The last whole picture.
    whole: Option<LiveFilm>,
}

/// A picture, with the number and the camera of its scene.
type LiveFilm = (u64, Option<String>, Film);

/// The product of a task.
pub(super) enum LiveProduct {
    /// Files that are complete; an empty one for a preview that is not needed.
    Files(Vec<Vec<u8>>),
    /// A picture to encode.
    Picture(Box<Picture>),
}

/// The picture, if it is that of the scene.
fn film_of<'a>(film: Option<&'a LiveFilm>, live: &Live) -> Option<&'a Film> {
    let (number, camera, film) = film?;
    ((*number, camera) == (live.number, &live.camera)).then_some(film)
}

impl LiveScenes {
    /// Carries a task out. The picture in progress is encoded by `encode`.
    pub(super) fn draw(
        &mut self,
        painter: &LiveScene<'_>,
        live: &Live,
        encode: Option<&EncodeOptions>,
        replies: &Replies,
    ) -> Result<LiveProduct, Failure> {
        let report = |report| {
            replies.send(&Reply::Report(report));
        };
        let scene = painter.compiled(live, &mut self.compiled, &report)?;
        let start = Instant::now();
        match live.task {
            LiveTask::Pixel(column, row) => {
                let picked = painter.picked(scene, (column, row))?;
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
                let last = self.whole.take_if(|(.., film)| film.levels.is_none());
                self.coarse = last.map(|(.., film)| (live.number, live.camera.clone(), film));
                return Ok(LiveProduct::Files(vec![Vec::new()]));
            }
            LiveTask::Coarse | LiveTask::Whole => {}
        }
        let picture = match (live.task, encode) {
            (LiveTask::Whole, Some(encode)) => {
                let last = self.coarse.take_if(|(.., film)| {
                    let render = painter.render;
                    [film.width, film.height] == [render.width, render.height]
                });
                let last = last.filter(|last| film_of(Some(last), live).is_some());
                let under = match last {
                    Some((.., film)) => film,
                    None => enlarged(film_of(self.coarse.as_ref(), live), painter.render),
                };
                let send = |file: &[u8]| replies.partial(file);
                let encode = scene.encoding(encode);
                let mosaic = Mosaic::over(under, encode, &send);
                painter.draw(scene, &|event| match event {
                    Event::Tile { .. } if painter.render.stop.is_cancelled() => {}
                    Event::Tile {
                        columns,
                        rows,
                        pixels,
                    } => mosaic.add(columns, rows, pixels),
                    event => (painter.listen)(event),
                })?
            }
            _ => painter.draw(scene, painter.listen)?,
        };
        report(Report::Traced(start.elapsed()));
        if painter.render.statistics
            && let Ok(json) = serde_json::to_string(&picture.statistics)
        {
            report(Report::Statistics(json));
        }
        Ok(LiveProduct::Picture(Box::new(picture)))
    }

    /// Stores a picture that has been drawn.
    pub(super) fn store(&mut self, live: &Live, film: Film) {
        let film = Some((live.number, live.camera.clone(), film));
        match live.task {
            LiveTask::Coarse => self.coarse = film,
            _ => self.whole = film,
        }
    }
}

/// A live scene, with the options of its next picture.
pub(super) struct LiveScene<'a> {
    pub(super) input: Input,
    pub(super) session: &'a RenderSession,
    pub(super) read: &'a ReadOptions,
    pub(super) render: &'a RenderOptions,
    pub(super) listen: &'a EventHandler<'a>,
}

impl Live {
    /// The text of the scene in a file.
    pub(super) fn input(&self, path: PathBuf) -> Input {
        match &self.text {
            None => Input::File(path),
            Some(text) if self.is_built_in => Input::Text {
                name: path.display().to_string(),
                text: text.clone().into_bytes(),
            },
            Some(text) => Input::Edited {
                path,
                text: text.clone().into_bytes(),
            },
        }
    }
}

impl LiveScene<'_> {
    /// The compiled scene with the camera of the next picture: that of the last picture, if it is of the same text.
    fn compiled<'c>(
        &self,
        live: &Live,
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
            None => self.compile(camera, &mut last, report),
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
        camera: Option<Camera>,
        last: &mut Option<CompiledScene>,
        report: &dyn Fn(Report),
    ) -> Result<CompiledScene, Failure> {
        let options = (self.read, self.render);
        let other = camera.clone();
        let mut scene =
            self.session
                .compile_next(last, &self.input, options, other, self.listen)?;
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
    fn picked(&self, scene: &CompiledScene, (column, row): (u32, u32)) -> Result<Picked, Failure> {
        let size = (self.render.width, self.render.height);
        let hit = scene.hit_at((f64::from(column), f64::from(row)), size);
        let surface = hit.map(|hit| PickedSurface {
            point: hit.point.into(),
            normal: hit.normal.into(),
            distance: hit.from.distance(hit.point),
            object: object_at(&self.input, self.read, &hit).and_then(|message| message.location),
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
