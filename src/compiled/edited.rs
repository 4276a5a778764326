//! The next version of a compiled scene, whose text or files have changed.
//!
//! The new text is read, with literals of the last reading where these stay ([`LiteralCache`]). If its scene differs from
//! the last one in nothing but the textures of shapes and the camera, the world stays as it is, and only these shapes get
//! new surfaces. Of pictures drawn before, the tiles stay that depend on none of them. In all other cases the scene is read
//! and compiled as if it were new.

use super::{CompiledScene, SceneCamera};
use crate::base::options::{
    Event, EventHandler, Failure, Input, ReadOptions, RenderOptions, Sampling, Writes,
};
use crate::base::source::{Dependency, Message};
use crate::base::sync::lock;
use crate::lang::LiteralCache;
use crate::render::TileCache;
use crate::scene::camera::Camera;
use crate::scene::likeness::text_of;
use crate::scene::pattern::Settings;
use crate::scene::restyled::restyled;
use crate::scene::{Objects, Scene};
use crate::{ReadingCaches, RenderSession, SceneReading, read_scene, world};
use std::ops::RangeInclusive;
use std::sync::{Arc, Mutex};

/// The most pictures whose tiles are cached: two previews, and the whole one.
const MOST_PICTURES: usize = 3;
/// Smaller pictures are drawn in no time, and the pixels of larger ones would take more than 200 MB.
const PIXELS: RangeInclusive<u64> = 1 << 10..=12 << 20;

/// A part of a compiled scene that its next version is compared with.
#[derive(Debug)]
pub(crate) struct SceneVersion {
    literals: LiteralCache,
    pub(crate) objects: Objects,
    /// The scene without its objects and its camera, as a text.
    frame: String,
    /// The options that the scene is compiled by.
    options: String,
    /// The index of the first item of each object in the world.
    pub(crate) first_items: Vec<u32>,
    settings: Settings,
}

/// The tiles of the last pictures.
#[derive(Debug, Default)]
pub(crate) struct PictureCache(Mutex<Vec<CachedPicture>>);

/// The tiles of a picture, with the options and the camera that it was drawn with.
#[derive(Debug)]
struct CachedPicture {
    options: String,
    camera: String,
    tiles: Arc<TileCache>,
}

impl PictureCache {
    /// Those of a picture; `None` if it is not to be cached.
    pub(super) fn of(&self, camera: &Camera, render: &RenderOptions) -> Option<Arc<TileCache>> {
        let pixels = render.columns.len() as u64 * render.rows.len() as u64;
        if !PIXELS.contains(&pixels) || matches!(render.sampling, Sampling::Adaptive(_)) {
            return None;
        }
        let (options, camera) = (picture_text(render), text_of(camera)?);
        let mut pictures = lock(&self.0);
        let is_it =
            |picture: &CachedPicture| (&picture.options, &picture.camera) == (&options, &camera);
        let picture = match pictures.iter().position(is_it) {
            Some(at) => pictures.remove(at),
            None => CachedPicture {
                options,
                camera,
                tiles: Arc::new(TileCache::new(render)),
            },
        };
        let tiles = Arc::clone(&picture.tiles);
        pictures.push(picture);
        if pictures.len() > MOST_PICTURES {
            pictures.remove(0);
        }
        Some(tiles)
    }

    /// True if most tiles of a picture that is larger than this one are there.
    #[cfg(feature = "cli")]
    pub(super) fn has_most_of_larger(&self, camera: &Camera, render: &RenderOptions) -> bool {
        let camera = text_of(camera);
        lock(&self.0).iter().any(|picture| {
            let tiles = &picture.tiles;
            camera.as_ref() == Some(&picture.camera)
                && tiles.width() > render.width
                && tiles.are_most()
        })
    }

    fn forget(&self, textures: &world::NewTextures) {
        for picture in &*lock(&self.0) {
            match textures.are_opaque {
                true => picture.tiles.forget(&textures.leaves),
                false => picture.tiles.forget_all(),
            }
        }
    }
}

/// The options that pixels depend on beside the scene, as a text.
pub(crate) fn picture_text(render: &RenderOptions) -> String {
    let RenderOptions {
        width,
        height,
        columns,
        rows,
        quality,
        alpha,
        t_min_rule,
        has_clean_cuts,
        random_order,
        sampling,
        ..
    } = render;
    let size = (width, height);
    format!(
        "{size:?} {columns:?} {rows:?} {quality} {alpha} {t_min_rule:?} {has_clean_cuts} {random_order:?} {sampling:?}"
    )
}

/// The options that compiling depends on; pictures of one scene may have different sizes and sampling, except where this
/// decides on the order of random numbers.
fn compiling_text(render: &RenderOptions) -> String {
    let RenderOptions {
        quality,
        alpha,
        t_min_rule,
        has_clean_cuts,
        random_order,
        ..
    } = render;
    format!("{quality} {alpha} {t_min_rule:?} {has_clean_cuts} {random_order:?}")
}

/// The scene without its objects and its camera, as a text; `None` if it is too long to be compared.
fn frame(scene: &Scene) -> Option<String> {
    text_of(&Scene {
        objects: Objects::default(),
        camera: Camera::default(),
        background: scene.background,
        atmosphere: scene.atmosphere.clone(),
        globals: scene.globals.clone(),
        version: scene.version,
        novelties: scene.novelties.clone(),
    })
}

impl SceneVersion {
    /// The parts, beside the objects, of a scene that is about to be compiled; `None` if it will be drawn in other
    /// coordinates than its own, or has calls that remember the first of them.
    pub(crate) fn of(
        scene: &Scene,
        literals: Option<LiteralCache>,
        render: &RenderOptions,
    ) -> Option<Self> {
        let is_in_own_coordinates = scene.camera_limit().allows(&scene.camera);
        let remembers = Arc::strong_count(&scene.globals.ridged_calls) > 1;
        if !is_in_own_coordinates || remembers {
            return None;
        }
        Some(SceneVersion {
            literals: literals?,
            objects: Objects::default(),
            frame: frame(scene)?,
            options: compiling_text(render),
            first_items: Vec::new(),
            settings: Settings {
                solid_of: Some(world::solid_of),
                ..scene.pattern_settings()
            },
        })
    }
}

/// The outcome of reading the next version of a scene.
pub(crate) enum Next {
    /// It is compiled.
    Compiled(Box<CompiledScene>),
    /// It has been read as if it were new, and has to be compiled.
    Read(Box<SceneReading>),
    /// It has to be read again.
    Unread,
}

/// Reads the next version of a scene, and compiles it if it differs little from `last`, which stays if the new version
/// has errors. The first picture is drawn with this camera or that of the scene.
///
/// # Errors
/// When the scene cannot be read.
pub(crate) fn next(
    (last, camera): (&mut Option<CompiledScene>, Option<&Camera>),
    input: &Input,
    (read, render): (&ReadOptions, &RenderOptions),
    listen: &EventHandler<'_>,
    session: &RenderSession,
) -> Result<Next, Failure> {
    // One that cannot be compared is dropped before the next is read.
    last.take_if(|last| last.version.is_none() || session.more.is_some());
    let Some(version) = last.as_ref().and_then(|last| last.version.as_deref()) else {
        return Ok(Next::Unread);
    };
    let log = EventLog::default();
    let read = ReadOptions {
        // It may be read once more.
        writes: Writes::InMemory,
        ..read.clone()
    };
    let caches = ReadingCaches {
        scene: session.cache.as_ref(),
        literals: Some(&version.literals),
    };
    let reading = read_scene(input, &read, render, &|event| log.note(event), caches);
    let mut reading = match reading {
        Ok(reading) => reading,
        Err(failure) => {
            log.replay(listen);
            return Err(failure);
        }
    };
    let last = last.take().filter(|_| !reading.wrote_files);
    let taken_over = last.and_then(|last| last.taken_over(&mut reading, camera, render));
    if let Some(scene) = taken_over {
        log.replay(listen);
        return Ok(Next::Compiled(Box::new(scene)));
    }
    let has_taken = reading
        .literals
        .as_ref()
        .is_none_or(LiteralCache::has_taken);
    // Objects that are shared are lowered otherwise, and those of two readings are not shared.
    if has_taken || reading.wrote_files {
        return Ok(Next::Unread);
    }
    log.replay(listen);
    Ok(Next::Read(Box::new(reading)))
}

impl CompiledScene {
    /// The same as the scene of a reading, if that differs in little.
    fn taken_over(
        mut self,
        reading: &mut SceneReading,
        camera: Option<&Camera>,
        render: &RenderOptions,
    ) -> Option<Self> {
        let scene = &mut reading.scene;
        let limit = scene.camera_limit();
        let literals = reading.literals.take();
        let mut next = SceneVersion::of(scene, literals, render)?;
        next.objects = std::mem::take(&mut scene.objects);
        let textures = self.restyle(&mut next);
        let is_allowed = camera.is_none_or(|camera| limit.allows(camera));
        let Some(textures) = textures.filter(|_| is_allowed) else {
            scene.objects = next.objects;
            reading.literals = Some(next.literals);
            return None;
        };
        self.pictures.forget(&textures);
        self.camera = Some(SceneCamera {
            camera: scene.camera.clone(),
            settings: scene.pattern_settings(),
            statement: reading.camera.clone(),
            limit,
        });
        self.print = reading.print;
        self.version = Some(Box::new(next));
        self.set_camera(camera, render).then_some(self)
    }

    /// Gives the shapes of the world the textures that they have in the next version of the scene.
    fn restyle(&mut self, next: &mut SceneVersion) -> Option<world::NewTextures> {
        let last = self.version.take()?;
        if next.frame != last.frame || next.options != last.options {
            return None;
        }
        let restyled = restyled(&last.objects, &next.objects)?;
        next.first_items = last.first_items;
        self.world
            .restyle(&restyled, &next.first_items, &next.settings)
    }
}

/// The events of a reading, until it is known that it counts.
#[derive(Default)]
struct EventLog(Mutex<Vec<LoggedEvent>>);

enum LoggedEvent {
    SceneOutput(String),
    Finding(Box<Message>),
    Read(Vec<Dependency>, bool),
}

impl EventLog {
    fn note(&self, event: Event<'_>) {
        let logged = match event {
            Event::SceneOutput(text) => LoggedEvent::SceneOutput(text.to_owned()),
            Event::Finding(message) => LoggedEvent::Finding(Box::new(message.clone())),
            Event::Read {
                dependencies,
                wrote_files,
            } => LoggedEvent::Read(dependencies.to_vec(), wrote_files),
            _ => return,
        };
        lock(&self.0).push(logged);
    }

    fn replay(self, listen: &EventHandler<'_>) {
        let events = self.0.into_inner().unwrap_or_default();
        for event in &events {
            listen(match event {
                LoggedEvent::SceneOutput(text) => Event::SceneOutput(text),
                LoggedEvent::Finding(message) => Event::Finding(message),
                LoggedEvent::Read(dependencies, wrote_files) => Event::Read {
                    dependencies,
                    wrote_files: *wrote_files,
                },
            });
        }
    }
}

#[cfg(test)]
mod tests;
