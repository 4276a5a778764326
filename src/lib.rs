//! povr reads POV-Ray scene files and draws the picture that POV-Ray draws: 3.8 for scenes with `#version 3.8`, 3.7 for
//! all others.
//!
//! ```text
//!  text ──lang──▶ Scene ──world──▶ World ──render──▶ Film ──output──▶ files
//! ```
//!
//! [`scene`] is the content of a file as plain data, which a program can also build without any file. [`lang`] reads a
//! file into it, [`world`] lowers it to a form for ray queries and answers them, [`render`] turns rays into pixels and
//! [`output`] encodes these. Neither the front end nor the back end uses the other; this file joins them, with
//! `compiled.rs` for scenes that stay compiled.
//! [`base`] lies below all, [`app`] (the programs) above.
//!
//! Elements (shapes, patterns, textures, lights, cameras, interiors, atmosphere, functions) are one file each in
//! [`scene`], with their mathematics, their parameters (read through [`base::args::Args`]) and their ray queries.
//!
//! Decisions that the code rests on:
//! * Directives and macros act on tokens, so the grammar gives flat tokens and one cursor runs directives between any
//!   two of them; readers of elements never see a directive. Long lists of plain numbers need no tokens: all threads
//!   read them from the text, and the results are taken in the order of the file.
//! * An object keeps its transforms as the list of steps that the file writes. Lowering folds them: first into the
//!   numbers of the shape as far as it stays of its kind, the rest into one inverse matrix, stored as the product of
//!   the elementary inverses. The forward matrix is not stored.
//! * Shapes report spans on the whole line of a ray. CSG sorts and counts them; it tests no point for being inside.
//! * A ray that leaves a surface carries which root it left ([`world::SpawnSurface`]), not a smallest distance.
//! * Camera rays of a block of pixels are traced, lit and shaded in packets: packets of 8 in single precision select
//!   the candidates, packets of 4 in double precision intersect them. Single rays give the same bits.
//! * Ties at exactly equal distance are decided by POV-Ray's rule, not by the order of traversal.

#[cfg(feature = "cli")]
pub mod app;
pub mod base;
mod compiled;
pub mod lang;
pub mod lint;
pub mod output;
pub mod render;
pub mod scene;
pub mod world;

pub use compiled::{CompiledScene, SceneHit, object_at};

use crate::base::math::conditioning::Normalization;
use base::file::Folders;
use base::options::{
    Event, EventHandler, Failure, Input, Picture, ReadOptions, RenderOptions, Writes,
};
use base::source::{Diagnostic, FileId, Message, Severity, Sources};
use base::sync::lock;
use base::version::Novelty;
use compiled::SceneCamera;
use compiled::edited::{self, Next, PictureCache, SceneVersion};
use glam::DVec3;
use lang::{LiteralCache, ReadEvent, Texts, TokenCache};
use render::statistics::StageTimer;
use scene::camera::Camera;
use scene::{Object, Scene};
use std::ops::Range;
use std::sync::{Arc, Mutex, mpsc};
use world::World;

/// The stack for reading and lowering, which recurse once for each level of nesting in the scene. It is reserved, not
/// committed, until a scene nests that deep.
const STACK_BYTES: usize = 1 << 30;

/// The stack of a render thread, which recurses once for each refraction and reflection outside of the wavefront. An
/// unoptimised build takes some megabytes for the CSG kernels.
const DRAWING_STACK_BYTES: usize = 1 << 24;

/// Up to this number of objects, the memory that lowering frees is too little to trim the heap.
const SMALL_SCENE: usize = 200;

/// Scenes with this many objects are lowered in a thread of their own.
const LARGE_SCENE: usize = 4096;
/// Objects are dropped in batches of this size.
const BATCH: usize = 256;
/// Batches that may wait to be dropped.
const QUEUED_BATCHES: usize = 2;
/// The heap is trimmed once in this many batches.
const TRIM_INTERVAL: usize = 8;

/// Worlds with fewer primitives are dropped at once.
const LARGE_WORLD: usize = 10_000;

/// Below this quality there is neither radiosity nor photons (docs/povray-facts.md, section 4.11).
const QUALITY_OF_RADIOSITY: u8 = 9;

/// Reads, lowers and renders a scene. `listen` receives the messages of the scene and its findings as they occur.
///
/// # Errors
/// When the scene cannot be read.
pub fn draw(
    input: &Input,
    read: &ReadOptions,
    render: &RenderOptions,
    listen: &EventHandler<'_>,
) -> Result<Picture, Failure> {
    let pool = match render.threads {
        None => None,
        Some(threads) => Some(Arc::new(pool(threads, listen)?)),
    };
    draw_with(input, read, render, listen, &RenderSession::of_one(pool))
}

/// Renders one scene several times, in sequence or in parallel, with other options each time: the frames of an
/// animation. Its files are read and tokenized once.
#[derive(Debug, Default)]
pub struct RenderSession {
    pool: Option<Arc<rayon::ThreadPool>>,
    /// The cache of the scene; `None` for a scene that is rendered once.
    cache: Option<Mutex<Option<Arc<SceneCache>>>>,
    /// The objects beside those of the text.
    more: Option<MoreObjects>,
}

/// Adds objects to a scene that has been read.
struct MoreObjects(Box<AddObjects>);

type AddObjects = dyn Fn(&mut scene::Objects) -> Result<(), String> + Send + Sync;

impl std::fmt::Debug for MoreObjects {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("MoreObjects")
    }
}

impl RenderSession {
    /// A session that renders with the threads of `pool`, or with one for each core. It ignores
    /// `RenderOptions::threads`.
    #[must_use]
    pub fn new(pool: Option<Arc<rayon::ThreadPool>>) -> Self {
        RenderSession {
            pool,
            cache: Some(Mutex::default()),
            more: None,
        }
    }

    /// A session for a single image, without a cache.
    #[must_use]
    pub fn of_one(pool: Option<Arc<rayon::ThreadPool>>) -> Self {
        RenderSession {
            pool,
            cache: None,
            more: None,
        }
    }

    /// The session with objects that no text describes: `add` appends them to those of the scene each time that it has
    /// been read. Its error is the reason for which the scene cannot be drawn.
    #[must_use]
    pub fn with_objects(
        self,
        add: impl Fn(&mut scene::Objects) -> Result<(), String> + Send + Sync + 'static,
    ) -> Self {
        RenderSession {
            more: Some(MoreObjects(Box::new(add))),
            ..self
        }
    }

    /// As [`draw`]. The input is the same for the whole session.
    ///
    /// # Errors
    /// When the scene cannot be read.
    pub fn draw(
        &self,
        input: &Input,
        read: &ReadOptions,
        render: &RenderOptions,
        listen: &EventHandler<'_>,
    ) -> Result<Picture, Failure> {
        draw_with(input, read, render, listen, self)
    }

    /// Reads and compiles a scene for several pictures; `render` gives the size of the first, which is drawn with the
    /// scene's own camera or this one.
    ///
    /// # Errors
    /// When the scene cannot be read.
    pub fn compile(
        &self,
        input: &Input,
        options: (&ReadOptions, &RenderOptions),
        camera: Option<Camera>,
        listen: &EventHandler<'_>,
    ) -> Result<CompiledScene, Failure> {
        self.compile_after(None, input, options, camera, listen)
    }

    /// As [`RenderSession::compile`], for the next version of a scene: its text or its files have changed. The `last` version,
    /// if there is one, is taken, and what has not changed is used again; it may stay if the new one has errors.
    ///
    /// # Errors
    /// When the scene cannot be read.
    pub fn compile_next(
        &self,
        last: &mut Option<CompiledScene>,
        input: &Input,
        options: (&ReadOptions, &RenderOptions),
        camera: Option<Camera>,
        listen: &EventHandler<'_>,
    ) -> Result<CompiledScene, Failure> {
        self.compile_after(Some(last), input, options, camera, listen)
    }

    fn compile_after(
        &self,
        last: Option<&mut Option<CompiledScene>>,
        input: &Input,
        (read, render): (&ReadOptions, &RenderOptions),
        camera: Option<Camera>,
        listen: &EventHandler<'_>,
    ) -> Result<CompiledScene, Failure> {
        let several = Several {
            camera: camera.map(Box::new),
            last,
        };
        let watch = &mut StageTimer::start();
        let usage = Use::Several(several);
        compile_with(input, read, render, listen, (self, usage), watch)
    }
}

/// The sources and tokens of a scene, cached for its next reading.
#[derive(Debug)]
struct SceneCache {
    scene: FileId,
    sources: Sources,
    token_cache: TokenCache,
}

/// Threads that may always be started, so that few cores do not hide faults of many threads.
const LEAST_LIMIT: usize = 16;

/// The number of threads to start for a wanted one. More than two for each core only take time and memory: on two cores
/// 999 drew half as fast as two, and the picture is the same for any number.
pub(crate) fn useful_threads(wanted: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    wanted.clamp(1, LEAST_LIMIT.max(2 * cores))
}

/// A pool of render threads, as many as are of use.
///
/// # Errors
/// When the system gives none.
pub fn pool(threads: usize, listen: &EventHandler<'_>) -> Result<rayon::ThreadPool, Failure> {
    pool_builder(threads)
        .build()
        .map_err(|error| failure(format!("no threads to draw with: {error}"), listen))
}

pub(crate) fn pool_builder(threads: usize) -> rayon::ThreadPoolBuilder {
    rayon::ThreadPoolBuilder::new()
        .num_threads(useful_threads(threads))
        .stack_size(DRAWING_STACK_BYTES)
}

fn draw_with(
    input: &Input,
    read: &ReadOptions,
    render: &RenderOptions,
    listen: &EventHandler<'_>,
    session: &RenderSession,
) -> Result<Picture, Failure> {
    let mut watch = StageTimer::start();
    let compiled = compile_with(
        input,
        read,
        render,
        listen,
        (session, Use::OnePicture),
        &mut watch,
    )?;
    let picture = compiled.draw_timed((read, render), listen, session, watch)?;
    drop_in_background(compiled.world);
    Ok(picture)
}

/// The pictures that a scene is compiled for.
enum Use<'a> {
    OnePicture,
    Several(Several<'a>),
}

/// Several pictures of a scene and its next versions.
struct Several<'a> {
    /// The camera of the first, if it is not that of the scene.
    camera: Option<Box<Camera>>,
    /// The last version, if there was one; `None` if there will be no next one.
    last: Option<&'a mut Option<CompiledScene>>,
}

fn compile_with(
    input: &Input,
    read: &ReadOptions,
    render: &RenderOptions,
    listen: &EventHandler<'_>,
    (session, usage): (&RenderSession, Use<'_>),
    watch: &mut StageTimer,
) -> Result<CompiledScene, Failure> {
    with_deep_stack(listen, || {
        let none = LiteralCache::default();
        let mut caches = ReadingCaches {
            scene: session.cache.as_ref(),
            literals: None,
        };
        let mut next = Next::Unread;
        let several = match usage {
            Use::OnePicture => None,
            Use::Several(Several { camera, last }) => {
                if let Some(last) = last {
                    let last = (last, camera.as_deref());
                    next = edited::next(last, input, (read, render), listen, session)?;
                    caches.literals = Some(&none);
                }
                Some(camera)
            }
        };
        let mut reading = match next {
            Next::Compiled(scene) => return Ok(*scene),
            Next::Read(reading) => *reading,
            Next::Unread => read_scene(input, read, render, listen, caches)?,
        };
        if let Some(MoreObjects(add)) = &session.more {
            add(&mut reading.scene.objects).map_err(|reason| failure(reason, listen))?;
        }
        watch.lap("read");
        let mut scene = reading.scene;
        let mut version = None;
        let camera = match several {
            None => None,
            Some(other) => {
                version = SceneVersion::of(&scene, reading.literals, render).map(Box::new);
                if let Some(version) = &mut version {
                    version.objects = scene.objects.clone();
                }
                let other = other.map_or_else(|| scene.camera.clone(), |other| *other);
                let own = std::mem::replace(&mut scene.camera, other);
                let limit = scene.camera_limit();
                version = version.filter(|_| limit.allows(&scene.camera));
                Some(SceneCamera {
                    camera: own,
                    settings: scene.pattern_settings(),
                    statement: reading.camera,
                    limit,
                })
            }
        };
        let first_items = version.as_mut().map(|version| &mut version.first_items);
        let (world, working, rounding) = prepared(scene, render, first_items);
        watch.lap("compile");
        Ok(CompiledScene {
            world,
            working,
            rounding,
            print: reading.print,
            camera,
            version,
            pictures: PictureCache::default(),
        })
    })
}

/// Drops a world in a background thread: freeing a large one takes longer than writing its image, and a program that
/// then ends need not wait.
fn drop_in_background(world: World) {
    if (world.primitive_count() as usize) < LARGE_WORLD {
        return;
    }
    // Without a thread it is dropped here.
    let _ = std::thread::Builder::new()
        .name("forgetter".to_owned())
        .spawn(move || drop(world));
}

/// Reads a scene without rendering it and without changing any file. All faults of a scene are detected by reading:
/// lowering cannot fail.
///
/// # Errors
/// When the scene could not be drawn.
pub fn read(
    input: &Input,
    read: &ReadOptions,
    listen: &EventHandler<'_>,
) -> Result<Scene, Failure> {
    with_deep_stack(listen, || {
        let read = ReadOptions {
            writes: Writes::InMemory,
            ..read.clone()
        };
        let render = RenderOptions::default();
        read_scene(input, &read, &render, listen, ReadingCaches::default())
            .map(|reading| reading.scene)
    })
}

/// The text of a scene.
fn load(input: &Input, sources: &mut Sources) -> Result<FileId, Box<Diagnostic>> {
    match input {
        Input::File(path) => sources.load_file(path),
        Input::Edited { path, text, .. } => sources.load_edited(path, Arc::clone(text)),
        Input::Text { name, text } => Ok(sources.add_text(name.clone(), text)),
    }
}

/// As [`read()`], for the findings alone. Returns the novelties of version 3.8 in the scene.
///
/// # Errors
/// When the scene could not be drawn.
pub fn check(
    input: &Input,
    options: &ReadOptions,
    listen: &EventHandler<'_>,
) -> Result<Vec<Novelty>, Failure> {
    read(input, options, listen).map(|scene| scene.novelties)
}

/// Runs `work` on a stack that is deep enough for deeply nested scenes.
fn with_deep_stack<T: Send>(
    listen: &EventHandler<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    std::thread::scope(|scope| match deep("reader").spawn_scoped(scope, work) {
        Ok(reader) => reader
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        Err(error) => {
            let message = format!("no memory for the stack of the reader: {error}");
            Err(failure(message, listen))
        }
    })
}

/// A thread with such a stack.
fn deep(name: &str) -> std::thread::Builder {
    let thread = std::thread::Builder::new();
    thread.name(name.to_owned()).stack_size(STACK_BYTES)
}

/// A failure that is not caused by the scene.
fn failure(message: String, listen: &EventHandler<'_>) -> Failure {
    let error = Message::new(&Diagnostic::error(None, message), &Sources::default());
    listen(Event::Finding(&error));
    Failure {
        errors: vec![error],
    }
}

/// True if rendering a scene writes a file beside the image.
fn saves(scene: &Scene) -> bool {
    let photons = scene.globals.photons.as_ref();
    photons.is_some_and(|photons| photons.save_file.is_some())
}

/// Writes the photon map to the file that the scene names for it.
fn save_photons(
    world: &World,
    drawn: &render::Drawn,
    writable: &Folders,
    listen: &EventHandler<'_>,
) {
    let settings = world.photons.as_ref().map(|photons| &photons.settings);
    let path = settings.and_then(|settings| settings.save_file.as_ref());
    let bytes = drawn.photons.as_ref().and_then(|shot| shot.file.as_ref());
    if let (Some(path), Some(bytes)) = (path, bytes)
        && let Err(error) = base::file::save(path.as_ref(), bytes, writable)
    {
        let mut warning = base::source::refusal("write", path, &error);
        warning.severity = Severity::Warning;
        let warning = Message::new(&warning, &Sources::default());
        listen(Event::Finding(&warning));
    }
}

/// Answers `trace` and `inside` for the reader.
#[derive(Default)]
struct OwnObjects(world::ProbeModel);

impl lang::Probe for OwnObjects {
    fn trace(
        &mut self,
        object: &Arc<Object>,
        from: DVec3,
        dir: DVec3,
        normalization: Normalization,
    ) -> Option<(DVec3, DVec3)> {
        self.0.trace(object, from, dir, normalization)
    }

    fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool {
        self.0.is_inside(object, point)
    }

    fn solid_of(&self) -> Option<scene::pattern::SolidOf> {
        Some(world::solid_of)
    }
}

fn prepared(
    scene: Scene,
    render: &RenderOptions,
    first_items: Option<&mut Vec<u32>>,
) -> (World, Option<base::color::Gamma>, base::encoding::Rounding) {
    let (working, rounding) = (scene.working_gamma(), scene.rounding());
    let count = scene.objects.len();
    let world = if count < LARGE_SCENE {
        let world = world::compile_noting(scene, render, &mut drop, first_items);
        if count > SMALL_SCENE {
            base::memory::trim_heap();
        }
        world
    } else {
        compiled_in_a_thread(scene, render, first_items)
    };
    (world, working, rounding)
}

/// Lowers a scene in a thread of its own, and drops its objects in this one. glibc's allocator has an arena for each
/// thread: the world goes into the other thread's arena, so it does not fragment the one whose objects are dropped.
fn compiled_in_a_thread(
    scene: Scene,
    render: &RenderOptions,
    first_items: Option<&mut Vec<u32>>,
) -> World {
    let (sender, objects) = mpsc::sync_channel(QUEUED_BATCHES);
    let work = Mutex::new(Some((scene, sender, first_items)));
    let compile = || {
        let (scene, sender, first_items) = lock(&work).take()?;
        let mut batch = Vec::with_capacity(BATCH);
        let drop_object = &mut |object| {
            batch.push(object);
            if batch.len() == BATCH {
                // Sending fails only where there is no second thread.
                let _ = sender.send(std::mem::replace(&mut batch, Vec::with_capacity(BATCH)));
            }
        };
        let world = world::compile_noting(scene, render, drop_object, first_items);
        Some(world)
    };
    let world = std::thread::scope(|scope| {
        let compiler = deep("compiler").spawn_scoped(scope, compile).ok()?;
        for (batches, objects) in (1..).zip(objects) {
            drop::<Vec<Arc<Object>>>(objects);
            if batches % TRIM_INTERVAL == 0 {
                base::memory::trim_heap();
            }
        }
        base::memory::trim_heap();
        let world = compiler.join();
        world.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    world
        .or_else(compile)
        .expect("the scene is compiled here if it was not there")
}

/// A scene that has been read.
struct SceneReading {
    scene: Scene,
    /// The fingerprint of its texts, if there will be a checkpoint.
    print: u64,
    /// The bytes of the statement of its camera, if that is in the scene's own text.
    camera: Option<Range<usize>>,
    /// Literals for the next reading, if those of the last one were given.
    literals: Option<LiteralCache>,
    /// True if it wrote files.
    wrote_files: bool,
}

/// Results of earlier readings.
#[derive(Clone, Copy, Default)]
struct ReadingCaches<'a> {
    /// The sources and tokens of the scene.
    scene: Option<&'a Mutex<Option<Arc<SceneCache>>>>,
    /// Objects of its last version, if those of this one are to be cached.
    literals: Option<&'a LiteralCache>,
}

/// Reads a scene; an unsupported feature is an error if it has an effect at the requested quality.
fn read_scene(
    input: &Input,
    options: &ReadOptions,
    render: &RenderOptions,
    listen: &EventHandler<'_>,
    ReadingCaches {
        scene: cache,
        literals: last_literals,
    }: ReadingCaches<'_>,
) -> Result<SceneReading, Failure> {
    let reported = match input {
        Input::Edited { change, .. } => change.as_ref(),
        Input::File(_) | Input::Text { .. } => None,
    };
    let earlier = cache.and_then(|cache| lock(cache).clone());
    let mut token_cache = cache.map(|_| TokenCache::default());
    let mut sources = Sources::new(options.library_paths.clone())
        .with_paths_of_3_8(options.library_paths_of_3_8.clone());
    if let Some(earlier) = &earlier {
        sources = earlier.sources.clone();
        token_cache = Some(earlier.token_cache.clone());
    }
    sources.limit_reads(options.readable.clone());
    sources.limit_bytes(options.memory.unwrap_or(u64::MAX));
    let (mut print, mut camera, mut wrote_files) = (0, None, false);
    let mut literals = None;
    let mut errors = Vec::new();
    let mut report = |finding: &Diagnostic, sources: &Sources| {
        let message = Message::new(finding, sources);
        listen(Event::Finding(&message));
        if message.severity == Severity::Error {
            errors.push(message);
        }
    };
    let file = match (input, &earlier) {
        (Input::Text { .. }, Some(earlier)) => Ok(earlier.scene),
        _ => load(input, &mut sources),
    };
    let scene = match file {
        Ok(file) => {
            let mut forward = |event: ReadEvent<'_>| match event {
                ReadEvent::SceneOutput(text) => listen(Event::SceneOutput(text)),
                ReadEvent::Finding(finding, sources) => report(finding, sources),
            };
            let mut probe = OwnObjects::default();
            let texts = Texts {
                scene: file,
                sources: &mut sources,
                token_cache: token_cache.as_mut(),
                literals: last_literals.map(|last| (last, reported)),
            };
            let reading = lang::evaluate_with(texts, options, &mut probe, &mut forward);
            if render.quality >= QUALITY_OF_RADIOSITY {
                for undrawn in &reading.undrawn {
                    report(undrawn, &sources);
                }
            }
            if let (true, Some(scene)) = (options.lints, &reading.scene) {
                for doubt in lint::doubts(scene, &reading.object_spans, &options.stop) {
                    if !sources.allows(file, &doubt, &options.allowed_lints) {
                        report(&doubt, &sources);
                    }
                }
            }
            wrote_files = sources.wrote_files() || reading.scene.as_ref().is_some_and(saves);
            listen(Event::Read {
                dependencies: &reading.dependencies,
                wrote_files,
            });
            literals = reading.literals;
            if render.checkpoint.is_some() {
                print = sources.fingerprint();
            }
            if let (Some(cache), Some(token_cache), true) =
                (cache, token_cache, reading.has_new_tokens)
            {
                update_cache(cache, earlier.as_ref(), file, sources, token_cache);
            }
            let own = reading.camera.filter(|span| span.file == file);
            camera = own.map(|span| span.start as usize..span.end as usize);
            reading.scene
        }
        Err(error) => {
            report(&error, &sources);
            None
        }
    };
    match scene {
        Some(scene) if errors.is_empty() => Ok(SceneReading {
            scene,
            print,
            camera,
            literals,
            wrote_files,
        }),
        None if errors.is_empty() => Err(failure("the scene cannot be read".to_owned(), listen)),
        _ => Err(Failure { errors }),
    }
}

/// Stores the tokens of a reading, unless another has done so since it began.
fn update_cache(
    cache: &Mutex<Option<Arc<SceneCache>>>,
    earlier: Option<&Arc<SceneCache>>,
    scene: FileId,
    sources: Sources,
    token_cache: TokenCache,
) {
    let mut cache = lock(cache);
    if cache.as_ref().map(Arc::as_ptr) == earlier.map(Arc::as_ptr) {
        *cache = Some(Arc::new(SceneCache {
            scene,
            sources: sources.for_another_run(),
            token_cache,
        }));
    }
}
