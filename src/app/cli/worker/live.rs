//! Pictures of a scene that stays compiled, and reports on their pixels.

use crate::app::worker::{CameraReport, Live, Picked, PickedSurface, Report};
use crate::base::options::{EventHandler, Failure, Input, ReadOptions, RenderOptions};
use crate::scene::camera::{Camera, View};
use crate::{CompiledScene, RenderSession, object_at};
use std::path::PathBuf;
use std::time::Instant;

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
            Some(text) => Input::Edited {
                path,
                text: text.clone().into_bytes(),
            },
        }
    }
}

impl LiveScene<'_> {
    /// The compiled scene with the camera of the next picture: that of the last picture, if it is of the same text.
    pub(super) fn compiled<'c>(
        self,
        live: &Live,
        compiled: &'c mut Option<(u64, CompiledScene)>,
        report: &dyn Fn(Report),
    ) -> Result<(&'c CompiledScene, Self), Failure> {
        let camera = live.camera.as_deref().map(camera_of).transpose()?;
        let mut known = compiled.take().filter(|(number, _)| *number == live.number);
        let is_same = known
            .as_mut()
            .is_some_and(|(_, scene)| scene.set_camera(camera.as_ref(), self.render));
        let scene = match known.filter(|_| is_same) {
            Some((_, scene)) => scene,
            None => self.compile(camera, report)?,
        };
        let (_, scene) = compiled.insert((live.number, scene));
        Ok((scene, self))
    }

    /// Compiles the scene for a camera or its own, and reports its own.
    fn compile(
        &self,
        camera: Option<Camera>,
        report: &dyn Fn(Report),
    ) -> Result<CompiledScene, Failure> {
        let options = (self.read, self.render);
        let other = camera.clone();
        let mut scene = self
            .session
            .compile(&self.input, options, other, self.listen)?;
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
    pub(super) fn picked(
        &self,
        scene: &CompiledScene,
        (column, row): (u32, u32),
    ) -> Result<Picked, Failure> {
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
