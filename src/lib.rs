//! povr reads POV-Ray scene files and draws the picture POV-Ray 3.7 draws.
//!
//! ```text
//!  text ──syntax──▶ tokens ──lang──▶ scene ──compile──▶ world ──trace──▶ colour ──render──▶ film ──output──▶ files
//!  grammar/*.pest            what the file says      what the rays need
//! ```
//!
//! Two wings stand on one hall. The hall is [`scene`]: what a file says, as plain data, which a program can also build
//! without any file. The reading wing ([`source`], [`syntax`], [`lang`]) fills it; the drawing wing ([`accel`],
//! [`compile`], [`trace`], [`render`]) draws it. Neither knows the other; this file alone joins them.
//!
//! Elements ([`shape`], [`pattern`], [`texture`], [`light`], [`camera`], [`interior`], [`atmosphere`], [`function`]) live
//! below both wings: one file each, with its mathematics, what it reads through [`args::Args`], and what it answers to
//! rays.
//!
//! Decisions that the code rests on:
//! * Directives and macros act on tokens, so the grammar gives flat tokens and one cursor runs directives between any
//!   two of them; readers of elements never see a directive.
//! * An object keeps its transforms as the list of steps that the file writes. Compiling folds them: first into the
//!   numbers of the shape as far as it stays of its kind, the rest into one inverse matrix, kept as the product of the
//!   elementary inverses. The forward matrix is gone then.
//! * Shapes report spans on the whole line of a ray. CSG sorts and counts them; it tests no point for being inside.
//! * A ray that leaves a surface carries which root it left ([`compile::Departure`]), not a smallest distance.
//! * Ties at exactly equal distance are decided by POV-Ray's rule, not by the order in which a tree is walked.

pub mod accel;
pub mod args;
pub mod atmosphere;
pub mod bitmap;
pub mod camera;
pub mod cli;
pub mod color;
pub mod compare;
pub mod compile;
pub mod curve;
pub mod film;
pub mod function;
pub mod interior;
pub mod lang;
pub mod light;
pub mod math;
pub mod options;
pub mod output;
pub mod pattern;
pub mod render;
pub mod scene;
pub mod shape;
pub mod source;
pub mod statistics;
pub mod syntax;
pub mod texture;
pub mod trace;

use compile::World;
use glam::DVec3;
use lang::Heard;
use options::{Event, Failure, Input, Listen, Picture, ReadOptions, RenderOptions};
use scene::{Object, Scene};
use source::{Diagnostic, Message, Severity, Sources};
use statistics::Watch;
use std::sync::Arc;

/// The stack for reading and compiling, which recurse once for each block of the scene inside another. It is
/// reserved, not used, until a scene nests that deep.
const STACK_BYTES: usize = 1 << 30;

/// Worlds with fewer primitives are let go at once.
const LARGE_WORLD: usize = 10_000;

/// Below this quality there is neither radiosity nor photons (facts 4.11).
const QUALITY_OF_RADIOSITY: u8 = 9;

/// Reads, compiles and renders a scene. `listen` hears what the scene says and what is found in it, as soon as it is.
///
/// # Errors
/// When the scene cannot be read.
pub fn draw(
    input: &Input,
    read: &ReadOptions,
    render: &RenderOptions,
    listen: &Listen<'_>,
) -> Result<Picture, Failure> {
    let mut watch = Watch::start();
    let (world, working) = with_deep_stack(listen, || {
        let scene = read_scene(input, read, render.quality, listen)?;
        watch.lap("read");
        let prepared = prepared(scene, render);
        watch.lap("compile");
        Ok(prepared)
    })?;
    let progress = |pixels| listen(Event::Drawn(pixels));
    let drawn = match render.threads {
        None => render::render(&world, render, &progress),
        Some(threads) => match rayon::ThreadPoolBuilder::new()
            .num_threads(threads.max(1))
            .build()
        {
            Ok(pool) => pool.install(|| render::render(&world, render, &progress)),
            Err(error) => return Err(failure(format!("no threads to draw with: {error}"), listen)),
        },
    };
    watch.lap("trace");
    let pixels = render.columns.len() as u64 * render.rows.len() as u64;
    let plan = render.statistics.then(|| world.plan());
    let statistics = statistics::gather(watch, &drawn, plan.unwrap_or_default(), pixels);
    forget(world);
    Ok(Picture {
        film: drawn.film,
        working,
        statistics,
    })
}

/// Lets go of a world beside what follows: taking a large one apart takes longer than writing its picture, and a program
/// that ends then need not wait.
fn forget(world: World) {
    if (world.shown() as usize) < LARGE_WORLD {
        return;
    }
    // Without a thread it goes here and now.
    let _ = std::thread::Builder::new()
        .name("forgetter".to_owned())
        .spawn(move || drop(world));
}

/// Reads a scene and draws nothing. All that can be wrong in a scene is found by reading: compiling cannot fail.
///
/// # Errors
/// When the scene could not be drawn.
pub fn check(input: &Input, read: &ReadOptions, listen: &Listen<'_>) -> Result<(), Failure> {
    let quality = RenderOptions::default().quality;
    with_deep_stack(listen, || {
        read_scene(input, read, quality, listen).map(drop)
    })
}

/// Does something on a stack that is deep enough for scenes that nest deep.
fn with_deep_stack<T: Send>(
    listen: &Listen<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    std::thread::scope(|scope| {
        let reader = std::thread::Builder::new()
            .name("reader".to_owned())
            .stack_size(STACK_BYTES);
        match reader.spawn_scoped(scope, work) {
            Ok(reader) => reader
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(error) => {
                let message = format!("no memory for the stack of the reader: {error}");
                Err(failure(message, listen))
            }
        }
    })
}

/// A failure that has nothing to do with the scene.
fn failure(message: String, listen: &Listen<'_>) -> Failure {
    let error = Message::new(&Diagnostic::error(None, message), &Sources::default());
    listen(Event::Found(&error));
    Failure {
        errors: vec![error],
    }
}

/// The drawing wing as the reading wing sees it.
#[derive(Default)]
struct OwnObjects(compile::Probed);

impl lang::Probe for OwnObjects {
    fn trace(&mut self, object: &Arc<Object>, from: DVec3, dir: DVec3) -> Option<(DVec3, DVec3)> {
        self.0.trace(object, from, dir)
    }

    fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool {
        self.0.is_inside(object, point)
    }
}

fn prepared(scene: Scene, render: &RenderOptions) -> (World, Option<color::Gamma>) {
    let working = scene.working_gamma();
    (compile::compile(scene, render), working)
}

/// Reads a scene; what drawing cannot do yet is an error if it would be seen at this quality.
fn read_scene(
    input: &Input,
    options: &ReadOptions,
    quality: u8,
    listen: &Listen<'_>,
) -> Result<Scene, Failure> {
    let mut sources = Sources::new(options.library_paths.clone());
    let mut errors = Vec::new();
    let mut found = |finding: &Diagnostic, sources: &Sources| {
        let message = Message::new(finding, sources);
        listen(Event::Found(&message));
        if message.severity == Severity::Error {
            errors.push(message);
        }
    };
    let file = match input {
        Input::File(path) => sources.load_file(path),
        Input::Text { name, text } => Ok(sources.add_text(name.clone(), text)),
    };
    let scene = match file {
        Ok(file) => {
            let mut hear = |heard: Heard<'_>| match heard {
                Heard::Said(text) => listen(Event::Said(text)),
                Heard::Found(finding, sources) => found(finding, sources),
            };
            let mut probe = OwnObjects::default();
            let reading = lang::evaluate_with(file, &mut sources, options, &mut probe, &mut hear);
            if quality >= QUALITY_OF_RADIOSITY {
                for undrawn in &reading.undrawn {
                    found(undrawn, &sources);
                }
            }
            reading.scene
        }
        Err(error) => {
            found(&error, &sources);
            None
        }
    };
    match scene {
        Some(scene) if errors.is_empty() => Ok(scene),
        None if errors.is_empty() => Err(failure("the scene cannot be read".to_owned(), listen)),
        _ => Err(Failure { errors }),
    }
}
