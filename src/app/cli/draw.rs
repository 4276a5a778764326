//! The default command: renders a scene as POV-Ray would, by POV-Ray's switches and ini files.

pub(super) mod animate;
pub(super) mod benchmark;
pub(super) mod console;
pub(super) mod done;
pub(super) mod frames;
pub(super) mod interrupt;
pub(super) mod limits;
pub(super) mod progress;
pub(super) mod report;
pub(super) mod streams;
pub(super) mod unfinished;

use super::options::created_ini;
use super::options::output_kinds;
use crate::app::cli::options::command_line;
use crate::app::cli::options::ini;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use clap::error::ErrorKind::DisplayVersion;

use super::draw::console::Console;
use super::draw::limits::{Limits, Watch};
use super::kernel;
use super::options::arg_words;

use super::options::environment::Environment;
use super::options::error::{CliError, Stage};
use super::options::ini::Reader;

use super::draw::progress::{Progress, ProgressKind};
use super::draw::report::{Line, Reporter, Stream, say};
use super::draw::streams::Files;
use super::options::long_options;
use super::options::long_options::LongOptions;
use super::options::output_kinds::MessageFormat;
use super::options::settings;
use super::options::settings::{Scene, Settings, Verbosity};

use crate::base::file::MAX_FILE_BYTES;
use crate::base::options::{
    AdaptiveOutcome, Event, EventHandler, Failure, Input, Picture, ReadOptions, RenderOptions,
    Statistics,
};
use crate::output::{self, OutputError};

/// Renders a scene with all stages.
pub(super) type Draw<'a> = dyn Fn(&Input, &ReadOptions, &RenderOptions, &EventHandler<'_>) -> Result<Picture, Failure>
    + Sync
    + 'a;

/// The name of the program, which draws without a command.
const PROGRAM: &str = "povr";

/// A request on the command line.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Render a scene.
    Draw(Box<Settings>),
    /// Print a text: help, or the version.
    Print(String),
}

/// Executes the command line. Every message goes to standard error; standard output receives the picture, if requested,
/// and nothing else.
pub(super) fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    match request(arguments, environment)? {
        Request::Print(text) => {
            say(text.trim_end());
            Ok(ExitCode::SUCCESS)
        }
        Request::Draw(mut settings) => {
            settings.read.stop = settings.render.stop.clone();
            if let Some((path, text)) = &settings.created_ini {
                create_ini(path, text)?;
            }
            if settings.is_sandboxed {
                kernel::enter_to_draw(&settings, None);
            }
            let watch = Watch::over_command(
                Limits::new(settings.timeout, settings.max_memory),
                Some(settings.render.stop.clone()),
                (settings.verbosity.format, Stream::Err),
            );
            let done = match &settings.frames {
                Some(frames) => animate::run(&settings, frames),
                None if unfinished::is_done(&settings) => Ok(ExitCode::SUCCESS),
                None => {
                    unfinished::keep(&mut settings);
                    carry_out(&settings, &|input, read, render, listen| {
                        interrupt::cancel_on_signals(&render.stop);
                        crate::draw(input, read, render, listen)
                    })
                }
            }?;
            Ok(match watch.is_over() {
                true => ExitCode::FAILURE,
                false => done,
            })
        }
    }
}

fn create_ini(path: &Path, text: &str) -> Result<(), CliError> {
    fs::write(path, text).map_err(|error| {
        CliError::new(format!("cannot write `{}`: {error}", path.display()))
            .at_stage(Stage::Output)
            .with_hint("Name a file in a folder that exists and may be written.")
    })
}

/// Parses the arguments, without the program's own name.
///
/// # Errors
/// When an option is unknown, malformed, or requests a feature that is not built; when a named file is missing.
pub fn request(arguments: &[String], environment: &Environment) -> Result<Request, CliError> {
    request_of(PROGRAM, arguments, environment)
}

/// The same for another command that renders; hints name it.
pub(super) fn request_of(
    command: &str,
    arguments: &[String],
    environment: &Environment,
) -> Result<Request, CliError> {
    let standard_folders: Vec<PathBuf> = environment.standard_folders()?;
    let mut raw_args = environment.raw_args(&standard_folders)?;
    raw_args.is_command_line = true;
    let mut reader = Reader::new(&mut raw_args, &standard_folders);
    let benchmark = match environment.is_povray {
        true => benchmark::arguments(arguments)?,
        false => None,
    };
    let mut rest = benchmark.as_deref().unwrap_or(arguments);
    while let Some((first, others)) = rest.split_first() {
        if first == "--" {
            if let Some(scene) = others.last() {
                reader.raw_args.scene = Some(scene.clone());
            }
            break;
        }
        let modern = long_options::length::<LongOptions>(rest);
        if modern > 0 {
            let (option, others) = rest.split_at(modern);
            match command_line::parse::<LongOptions>(option) {
                Ok(given) => given.set(reader.raw_args),
                Err(error) if error.kind() == DisplayVersion && environment.is_povray => {
                    return Ok(Request::Print(console::version()));
                }
                Err(error) => {
                    return command_line::printed::<LongOptions>(&error).map(Request::Print);
                }
            }
            rest = others;
        } else {
            for word in arg_words::of_argument(first) {
                ini::read(&mut reader, &word)?;
            }
            rest = others;
        }
    }
    let created_ini = match &raw_args.create_ini {
        Some(path) => {
            let system = environment.system_args()?;
            Some((path.clone(), created_ini::text(&system, &raw_args)))
        }
        None => None,
    };
    let settings = settings::settle(raw_args, &standard_folders, environment, command)?;
    Ok(Request::Draw(Box::new(Settings {
        created_ini,
        ..settings
    })))
}

/// Renders and writes.
///
/// # Errors
/// When the scene cannot be read, or the picture cannot be written. Errors in the scene have already been reported.
pub(super) fn carry_out(settings: &Settings, draw: &Draw<'_>) -> Result<ExitCode, CliError> {
    let verbosity = settings.verbosity;
    let started = Instant::now();
    let input = settings.scene.input()?;
    let render = RenderOptions {
        target_format: settings.output.as_ref().map(|(_, options)| options.clone()),
        ..settings.render.clone()
    };
    let mut reporter = reporter(settings);
    reporter.files = Files::create(&settings.streams)?;
    let target = settings.output.as_ref().map(|(target, _)| target);
    reporter.files.begin(settings, target);
    let console = Console::new(verbosity);
    console.begin(settings);
    if let Some((target, options)) = &settings.output {
        output::check(target, (render.width, render.height), options.format)?;
    }
    console.parsing();
    let progress = Progress::new(
        progress_kind(verbosity),
        &settings.scene.name(),
        pixels(&settings.render),
    );
    let resumable = AtomicU64::new(0);
    let drawn = draw(&input, &settings.read, &render, &|event| match event {
        Event::Checkpointed(pixels) => resumable.store(pixels, Ordering::Relaxed),
        // Consequences of a cancellation: skipped tiles count as rendered, and the end is a failure.
        _ if render.stop.is_cancelled() => {}
        Event::Drawn(pixels) => progress.advance(pixels),
        event => {
            reporter.report(event);
            if matches!(event, Event::Read { .. }) && reporter.counts().errors == 0 {
                console.rendering(settings, Some(started.elapsed()));
            }
        }
    });
    progress.finish();
    let counts = reporter.take_counts();
    let Ok(picture) = drawn else {
        if render.stop.is_cancelled() {
            interrupt::report_cancelled(settings, resumable.into_inner(), pixels(&settings.render));
            console.cancelled();
            return Ok(ExitCode::from(interrupt::INTERRUPTED));
        }
        reporter.total(settings, counts);
        console.failed();
        return Ok(ExitCode::FAILURE);
    };
    if let Some(reached) = picture.statistics.reached.filter(|_| !verbosity.quiet) {
        say(error_reached(&reached, pixels(&settings.render)));
    }
    if let Some((target, options)) = &settings.output {
        let options = options.for_scene(picture.working, picture.rounding);
        let write = || output::write(&picture.film, target, &options);
        let mut written = write();
        if written.as_ref().is_err_and(OutputError::is_out_of_space) {
            // The checkpoint takes the disk space that its picture needs.
            unfinished::forget(settings);
            written = write();
        }
        written?;
        unfinished::forget(settings);
    }
    if let Some(doubt) = done::flat(settings, &picture.film) {
        reporter.report(Event::Finding(&doubt));
    }
    done::report(settings, started.elapsed());
    report_statistics(&picture.statistics, verbosity, &reporter);
    console.drawn(settings, &picture.statistics);
    console.finished();
    Ok(ExitCode::SUCCESS)
}

/// A reporter for the scene, after it has reported the warnings about the command line.
pub(super) fn reporter(settings: &Settings) -> Reporter {
    let verbosity = settings.verbosity;
    let mut reporter = Reporter::new(verbosity.format, Stream::Err);
    reporter.shows_errors = verbosity.errors;
    reporter.warns = verbosity.warnings && !verbosity.quiet;
    reporter.debugs = verbosity.debugs && !verbosity.quiet;
    if reporter.warns {
        settings.warnings.iter().for_each(say);
    }
    if verbosity.verbose && !verbosity.quiet && !verbosity.is_povray {
        settings.notes.iter().for_each(say);
    }
    reporter
}

/// Prints statistics for `--stats` and `--json`.
pub(super) fn report_statistics(
    statistics: &Statistics,
    verbosity: Verbosity,
    reporter: &Reporter,
) {
    reporter
        .files
        .write(output_kinds::Stream::Statistics, &statistics.to_string());
    if verbosity.stats {
        say(statistics.to_string().trim_end());
    }
    if verbosity.json {
        reporter.json(&Line::Statistics(statistics));
    }
}

impl Scene {
    /// The input for reading; standard input is read to its end.
    pub(super) fn input(&self) -> Result<Input, CliError> {
        let Scene::File(path) = self else {
            let mut text = Vec::new();
            io::stdin()
                .lock()
                .take(MAX_FILE_BYTES + 1)
                .read_to_end(&mut text)
                .map_err(|error| CliError::new(format!("cannot read standard input: {error}")))?;
            if text.len() as u64 > MAX_FILE_BYTES {
                return Err(CliError::new("standard input is too large for a scene"));
            }
            return Ok(Input::Text {
                name: "standard input".to_owned(),
                text,
            });
        };
        Ok(Input::File(path.clone()))
    }
}

/// The message about the error reached with adaptive sampling.
pub(super) fn error_reached(reached: &AdaptiveOutcome, pixels: u64) -> String {
    #[allow(clippy::cast_precision_loss, reason = "rounded to one place")]
    let samples = reached.samples as f64 / pixels.max(1) as f64;
    let AdaptiveOutcome {
        target,
        largest,
        rms,
        ..
    } = reached;
    let aim = if *target > 0.0 && largest <= target {
        format!("reached --error {target}")
    } else if *target > 0.0 {
        format!("missed --error {target}")
    } else {
        "stopped".to_owned()
    };
    format!(
        "povr: {aim}: estimated error at most {largest:.3}, RMS {rms:.3} (in 1/255 steps), \
         {samples:.1} samples per pixel"
    )
}

pub(super) fn progress_kind(verbosity: Verbosity) -> ProgressKind {
    if verbosity.is_povray {
        match verbosity.verbose && !verbosity.is_silent {
            true => ProgressKind::Lines,
            false => ProgressKind::Nothing,
        }
    } else if verbosity.quiet || verbosity.format == MessageFormat::Json {
        ProgressKind::Nothing
    } else if verbosity.is_terminal {
        ProgressKind::Bar
    } else if verbosity.verbose {
        ProgressKind::Lines
    } else {
        ProgressKind::Nothing
    }
}

pub(super) fn pixels(render: &RenderOptions) -> u64 {
    u64::from(render.columns.end - render.columns.start)
        * u64::from(render.rows.end - render.rows.start)
}
