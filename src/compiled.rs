//! A scene that stays compiled from one picture to the next, and the surfaces and objects that its pixels see.

pub(crate) mod edited;

use self::edited::{PictureCache, SceneVersion, picture_text};
use crate::base::color::Gamma;
use crate::base::encoding::{EncodeOptions, Rounding};
use crate::base::math::conditioning::Normalization;
#[cfg(feature = "cli")]
use crate::base::options::Plan;
use crate::base::options::{
    Event, EventHandler, Failure, Input, Picture, ReadOptions, RenderOptions, Sampling, Writes,
};
use crate::base::source::{Diagnostic, Message, Sources};
use crate::lang::{ObjectSpan, Texts};
use crate::render::cost::PixelCost;
use crate::render::statistics::StageTimer;
use crate::render::{Checkpoint, CheckpointStatus, Earlier};
use crate::scene::camera::Camera;
use crate::scene::{Object, pattern};
use crate::world::{self, World};
use crate::{
    OwnObjects, RenderSession, failure, lang, load, render, save_photons, scene, with_deep_stack,
};
use glam::DVec3;
use std::hash::{Hash, Hasher};
use std::ops::Range;
use std::sync::Arc;

/// Two points are one if they differ by less than this part of their distance from the camera.
const SAME_POINT: f64 = 1e-6;

/// A scene that is compiled for several pictures, which may have other sizes and cameras.
#[derive(Debug)]
pub struct CompiledScene {
    pub(super) world: World,
    pub(super) working: Option<Gamma>,
    pub(super) rounding: Rounding,
    /// The fingerprint of the scene's texts, if there are checkpoints.
    pub(super) print: u64,
    /// `None` in a scene that is drawn once.
    pub(super) camera: Option<SceneCamera>,
    /// For its next version; `None` if nothing of the scene can stay.
    pub(super) version: Option<Box<SceneVersion>>,
    pub(super) pictures: PictureCache,
}

/// A point of a surface that a camera sees, in the coordinates of the scene's text.
#[derive(Clone, Copy, Debug)]
pub struct SceneHit {
    /// The start of the ray.
    pub from: DVec3,
    /// The point.
    pub point: DVec3,
    /// The unit normal towards the camera, before any `normal` pattern.
    pub normal: DVec3,
}

/// The camera of a scene, as it was read.
#[derive(Debug)]
pub(super) struct SceneCamera {
    pub(super) camera: Camera,
    pub(super) settings: pattern::Settings,
    /// The bytes of its statement in the text of the scene.
    pub(super) statement: Option<Range<usize>>,
    /// The cameras for which the scene is compiled as it has been.
    pub(super) limit: scene::CameraLimit,
}

impl CompiledScene {
    /// The camera of the scene, whatever camera draws.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        let own = self.camera.as_ref().map(|own| &own.camera);
        own.unwrap_or(&self.world.camera)
    }

    /// The bytes of the statement of its camera in the text of the scene; `None` without a camera, or if the camera is
    /// read from an included file.
    #[must_use]
    pub fn camera_statement(&self) -> Option<Range<usize>> {
        self.camera.as_ref()?.statement.clone()
    }

    /// Prepares pictures of this size from another camera, or from that of the scene. False, with no effect, if the scene
    /// has to be compiled anew for it: it would be drawn in other coordinates.
    pub fn set_camera(&mut self, camera: Option<&Camera>, render: &RenderOptions) -> bool {
        let Some(own) = &self.camera else {
            return false;
        };
        let camera = camera.unwrap_or(&own.camera);
        let is_allowed = own.limit.allows(camera);
        if is_allowed {
            self.world.set_camera(camera, &own.settings, render);
        }
        is_allowed
    }

    /// The nearest surface that the camera sees at a point of a picture, in the coordinates of the scene's text; integer
    /// coordinates are the centres of pixels.
    #[must_use]
    pub fn hit_at(&self, (x, y): (f64, f64), (width, height): (u32, u32)) -> Option<SceneHit> {
        let ray = self.world.camera.primary_ray(x, y, width, height)?;
        let query = world::Query {
            ray,
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: world::RayKind::Camera,
        };
        let scratch = &mut world::QueryScratch::default();
        let hit = self.world.nearest(&query, scratch)?;
        let world::Globals { origin, unit, .. } = self.world.globals;
        Some(SceneHit {
            from: (ray.origin - origin) / unit,
            point: (hit.point - origin) / unit,
            normal: match hit.shading_normal.dot(ray.dir) > 0.0 {
                true => -hit.shading_normal,
                false => hit.shading_normal,
            },
        })
    }

    /// The cost of each pixel of a picture without antialiasing, row by row; zeros after a cancellation. The camera must
    /// have been set for its size.
    #[must_use]
    pub fn costs(&self, render: &RenderOptions, session: &RenderSession) -> Vec<PixelCost> {
        match &session.pool {
            None => render::cost::costs(&self.world, render),
            Some(pool) => pool.install(|| render::cost::costs(&self.world, render)),
        }
    }

    /// Returns true if most of a larger picture from the current camera stays as it was in the last version of the scene, so
    /// that no picture in this size is needed before it.
    #[cfg(feature = "cli")]
    pub(crate) fn needs_no_preview(&self, render: &RenderOptions) -> bool {
        self.pictures.has_most_of_larger(&self.world.camera, render)
    }

    /// The options to encode its pictures, from those for any scene.
    pub(crate) fn encoding(&self, options: &EncodeOptions) -> EncodeOptions {
        options.for_scene(self.working, self.rounding)
    }

    /// The features that the scene needs, and those it does not.
    #[cfg(feature = "cli")]
    pub(crate) fn plan(&self) -> Plan {
        self.world.plan()
    }

    /// Draws a picture. The camera must have been set for its size.
    ///
    /// # Errors
    /// When the render is cancelled, or has not enough memory.
    pub fn draw(
        &self,
        read: &ReadOptions,
        render: &RenderOptions,
        listen: &EventHandler<'_>,
        session: &RenderSession,
    ) -> Result<Picture, Failure> {
        self.draw_timed((read, render), listen, session, StageTimer::start())
    }

    pub(super) fn draw_timed(
        &self,
        (read, render): (&ReadOptions, &RenderOptions),
        listen: &EventHandler<'_>,
        session: &RenderSession,
        mut watch: StageTimer,
    ) -> Result<Picture, Failure> {
        let (world, working, rounding) = (&self.world, self.working, self.rounding);
        let unfinished = unfinished(read, render, self.print, listen);
        let unfinished = unfinished.as_ref();
        let only_for = render.target_format.as_ref();
        let only_for = only_for.map(|options| self.encoding(options));
        let render = &RenderOptions {
            target_format: only_for,
            ..render.clone()
        };
        let tiles = self
            .version
            .is_some()
            .then(|| self.pictures.of(&world.camera, render));
        let tiles = tiles.flatten();
        let earlier = Earlier {
            checkpoint: unfinished,
            tiles: tiles.as_deref(),
        };
        let drawn = match &session.pool {
            None => render::render(world, render, earlier, listen),
            Some(pool) => pool.install(|| render::render(world, render, earlier, listen)),
        };
        if render.stop.is_cancelled() {
            if let Some(pixels) = unfinished.and_then(Checkpoint::resumable_pixels) {
                listen(Event::Checkpointed(pixels));
            }
            return Err(failure("the render was stopped".to_owned(), listen));
        }
        let photons = drawn.photons.as_ref();
        if photons.is_some_and(|photons| !photons.is_complete) {
            let message = "the photons of this scene need more memory than there is".to_owned();
            return Err(failure(message, listen));
        }
        if let Some(kind) = unfinished.and_then(Checkpoint::trouble) {
            listen(Event::CheckpointFailed(kind));
        }
        watch.lap("trace");
        save_photons(world, &drawn, &read.writable, listen);
        let pixels = render.columns.len() as u64 * render.rows.len() as u64;
        let plan = render.statistics.then(|| world.plan());
        let statistics =
            render::statistics::gather(watch, &drawn, plan.unwrap_or_default(), pixels);
        Ok(Picture {
            film: drawn.film,
            working,
            rounding,
            statistics,
        })
    }
}

/// The checkpoint of this render, with the pixels of an earlier run.
fn unfinished(
    read: &ReadOptions,
    render: &RenderOptions,
    print: u64,
    listen: &EventHandler<'_>,
) -> Option<Checkpoint> {
    let keep = render.checkpoint.as_ref()?;
    if matches!(&render.sampling, Sampling::Adaptive(how) if how.time.is_some()) {
        return None;
    }
    let ReadOptions {
        declares,
        version,
        clock,
        clock_on,
        clock_delta,
        frame_number,
        ..
    } = read;
    let size = (render.width, render.height);
    // All options that affect the pixels; the number of threads does not.
    let all = format!(
        "{} {print} {} {declares:?} {version:?} {clock} {clock_on} {clock_delta} {frame_number}",
        keep.build,
        picture_text(render)
    );
    let mut hasher = rustc_hash::FxHasher::default();
    all.hash(&mut hasher);
    let (unfinished, status) = Checkpoint::open(keep, hasher.finish(), size);
    match status {
        CheckpointStatus::Nothing => {}
        CheckpointStatus::Other => listen(Event::CheckpointDiscarded),
        CheckpointStatus::Pixels(pixels) => listen(Event::Resumed(pixels)),
    }
    Some(unfinished)
}

/// Finds the object of a scene to which a point belongs that a camera sees: a message without text whose location is that
/// of the first token of the object's statement. The scene is read once more for it. `None` if no object as a whole has
/// the point, as with parts that are cut away by others.
#[must_use]
pub fn object_at(input: &Input, options: &ReadOptions, hit: &SceneHit) -> Option<Message> {
    let locate = || {
        let mut sources = Sources::new(options.library_paths.clone())
            .with_paths_of_3_8(options.library_paths_of_3_8.clone());
        sources.limit_reads(options.readable.clone());
        sources.limit_bytes(options.memory.unwrap_or(u64::MAX));
        let file = load(input, &mut sources).map_err(|_| Failure { errors: Vec::new() })?;
        let options = ReadOptions {
            writes: Writes::InMemory,
            notes_objects: true,
            ..options.clone()
        };
        let texts = Texts {
            scene: file,
            sources: &mut sources,
            token_cache: None,
            literals: None,
        };
        let mut probe = OwnObjects::default();
        let reading = lang::evaluate_with(texts, &options, &mut probe, &mut |_| {});
        let distance = hit.from.distance(hit.point);
        let mut model = world::ProbeModel::default();
        let mut has_point = |object: &Arc<Object>| {
            let seen = model.trace(
                object,
                hit.from,
                hit.point - hit.from,
                Normalization::default(),
            );
            seen.is_some_and(|(point, _)| point.distance(hit.point) <= SAME_POINT * distance)
        };
        let margin = DVec3::splat(SAME_POINT * (distance + hit.point.abs().max_element()));
        let is_boxed = |object: &Object| {
            let extent = object.extent();
            let is_above = hit.point.cmpge(extent.min - margin).all();
            is_above && hit.point.cmple(extent.max + margin).all()
        };
        // Compiling takes longest: objects whose boxes hold the point come first.
        let objects = |boxed: bool| {
            let objects = reading.scene.iter().flat_map(|scene| scene.objects.iter());
            objects
                .enumerate()
                .take_while(|_| !options.stop.is_cancelled())
                .filter(move |(_, object)| is_boxed(object) == boxed)
        };
        let mut objects = objects(true).chain(objects(false));
        let owner = objects.find(|(_, object)| has_point(object));
        let start = owner.and_then(|(index, _)| ObjectSpan::of(&reading.object_spans, index));
        Ok(start.map(|start| Message::new(&Diagnostic::warning(start.span, ""), &sources)))
    };
    with_deep_stack(&|_| {}, locate).ok().flatten()
}
