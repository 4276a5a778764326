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
//! Elements ([`shape`], [`pattern`], [`texture`], [`light`], [`camera`], [`interior`]) live below both wings: one file
//! each, with its mathematics, what it reads through [`args::Args`], and what it answers to rays.
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
pub mod camera;
pub mod cli;
pub mod color;
pub mod compare;
pub mod compile;
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
pub mod syntax;
pub mod texture;
pub mod trace;

use compile::World;
use options::{Failure, Input, Picture, ReadOptions, RenderOptions};
use scene::Scene;
use source::print::{Styling, annotated, pov_line};
use source::{Diagnostic, Severity, Sources};

/// The stack for reading and compiling, which recurse once for each block of the scene inside another. It is
/// reserved, not used, until a scene nests that deep.
const STACK_BYTES: usize = 256 << 20;

/// Reads, compiles and renders a scene. `progress` is told the number of pixels finished since it was last told.
///
/// # Errors
/// When the scene cannot be read: all findings of the run, ready to print.
pub fn draw(
    input: &Input,
    read: &ReadOptions,
    render: &RenderOptions,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Picture, Failure> {
    let prepared = std::thread::scope(|scope| {
        let reader = std::thread::Builder::new()
            .name("reader".to_owned())
            .stack_size(STACK_BYTES);
        match reader.spawn_scoped(scope, || prepare(input, read, render)) {
            Ok(reader) => reader
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(error) => Err(failure(format!(
                "no memory for the stack of the reader: {error}"
            ))),
        }
    })?;
    let Prepared {
        world,
        working,
        warnings,
        said,
    } = prepared;
    let film = match render.threads {
        None => render::render(&world, render, progress),
        Some(threads) => match rayon::ThreadPoolBuilder::new()
            .num_threads(threads.max(1))
            .build()
        {
            Ok(pool) => pool.install(|| render::render(&world, render, progress)),
            Err(error) => return Err(failure(format!("no threads to draw with: {error}"))),
        },
    };
    Ok(Picture {
        film,
        working,
        warnings,
        said,
        statistics: String::new(),
    })
}

/// An error in POV-Ray's one line, for programs that look for it, and then with the lines of the scene, for people.
fn in_full(error: &Diagnostic, sources: &Sources) -> String {
    format!(
        "{}\n{}",
        pov_line(error, sources),
        annotated(error, sources, Styling::Plain)
    )
}

fn failure(error: String) -> Failure {
    Failure {
        warnings: Vec::new(),
        errors: vec![error],
        said: String::new(),
    }
}

/// A scene read and compiled.
struct Prepared {
    world: World,
    working: Option<color::Gamma>,
    warnings: Vec<String>,
    said: String,
}

fn prepare(
    input: &Input,
    options: &ReadOptions,
    render: &RenderOptions,
) -> Result<Prepared, Failure> {
    let mut sources = Sources::new(options.library_paths.clone());
    let file = match input {
        Input::File(path) => match sources.load_file(path) {
            Ok(file) => file,
            Err(error) => return Err(failure(in_full(&error, &sources))),
        },
        Input::Text { name, text } => sources.add_text(name.clone(), text),
    };
    let reading = lang::evaluate(file, &mut sources, options);
    let of = |severity: Severity| {
        reading
            .findings
            .iter()
            .filter(move |finding| finding.severity == severity)
    };
    let warnings = of(Severity::Warning)
        .map(|warning| pov_line(warning, &sources))
        .collect();
    let Some(scene) = reading.scene else {
        let errors = of(Severity::Error)
            .map(|error| in_full(error, &sources))
            .collect();
        return Err(Failure {
            warnings,
            errors,
            said: reading.messages,
        });
    };
    let working = Scene::working_gamma(&scene);
    Ok(Prepared {
        world: compile::compile(&scene, render),
        working,
        warnings,
        said: reading.messages,
    })
}
