//! Renders an animation: its frames one after the other, or in parallel.
//!
//! Messages about the frames and the order of their files are as if rendered one after the other. The first frame that
//! fails ends the animation, as in POV-Ray: the frames before it are there, later ones are not.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Once};
use std::thread;
use std::time::{Duration, Instant};

use super::console::Console;
use super::done;
use super::frames::Frames;
use super::interrupt;
use super::progress::{Progress, ProgressKind};
use super::report::{Reporter, say};
use super::streams::Files;
use super::{Draw, error_reached, pixels, progress_kind, report_statistics, reporter};
use crate::RenderSession;
use crate::app::batch::{MessageBuffer, in_order};
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::settings::{Settings, Verbosity};
use crate::base::file::Folders;
use crate::base::options::{
    Event, EventHandler, Failure, Input, Picture, RenderOptions, Sampling, Statistics,
};
use crate::base::source::Code;
use crate::output::{self, OutputError, Target};

/// Frames are rendered in parallel only up to this total number of pixels: 2 GiB of films.
const MAX_PIXELS: u64 = 1 << 27;

/// Renders the frames.
pub(crate) fn run(settings: &Settings, frames: &Frames) -> Result<ExitCode, CliError> {
    let pool = match settings.render.threads {
        None => None,
        Some(threads) => match crate::pool(threads, &|event| reporter(settings).report(event)) {
            Ok(pool) => Some(Arc::new(pool)),
            Err(_) => return Ok(ExitCode::FAILURE),
        },
    };
    let series = RenderSession::new(pool);
    let cancel_on_signals = Once::new();
    carry_out(settings, frames, &|input, read, render, listen| {
        cancel_on_signals.call_once(|| interrupt::cancel_on_signals(&render.stop));
        series.draw(input, read, render, listen)
    })
}

/// A run over frames.
struct Run<'a> {
    settings: &'a Settings,
    frames: &'a Frames,
    input: Input,
    draw: &'a Draw<'a>,
    reporter: Reporter,
    progress: Progress,
    console: Console,
}

/// A frame whose file is ready to be written.
struct Drawn {
    bytes: Option<Result<Vec<u8>, OutputError>>,
    statistics: Statistics,
}

/// Permission of a scene to write files.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Writing {
    Allowed,
    /// It would interleave with frames that are read at the same time.
    Refused,
}

/// The end of a run over frames.
enum Done {
    All,
    /// The first frame that is not there, counted from 0.
    Until(usize),
}

/// The reason why parallel rendering ends.
enum End {
    /// This frame, counted from the first, writes files.
    WritesFiles(usize),
    /// This frame failed.
    Failed(usize),
    CannotWrite(CliError),
}

/// Renders the frames and writes them.
///
/// # Errors
/// When the scene cannot be read, or a picture cannot be written. Errors in the scene have already been reported.
fn carry_out(settings: &Settings, frames: &Frames, draw: &Draw<'_>) -> Result<ExitCode, CliError> {
    let numbers = frames.numbers();
    let total = pixels(&settings.render) * numbers.len() as u64;
    let started = Instant::now();
    let mut reporter = reporter(settings);
    reporter.files = Files::create(&settings.streams)?;
    let run = Run {
        settings,
        frames,
        input: settings.scene.input()?,
        draw,
        reporter,
        progress: Progress::new(
            progress_of_frames(settings.verbosity),
            &settings.scene.name(),
            total,
        ),
        console: Console::new(settings.verbosity),
    };
    run.console.begin(settings);
    run.check(&numbers)?;
    let done = run.all(&numbers);
    run.progress.finish();
    let counts = run.reporter.take_counts();
    match done? {
        Done::All => {
            let name = |number: Option<&u32>| run.name(*number.unwrap_or(&0));
            let names = (name(numbers.first()), name(numbers.last()));
            done::report_frames(settings, &names.0, &names.1, started.elapsed());
            run.console.finished();
            Ok(ExitCode::SUCCESS)
        }
        Done::Until(at) if settings.render.stop.is_cancelled() => {
            if !settings.verbosity.quiet {
                let (next, of) = (numbers[at], numbers.len());
                match at {
                    0 => say("povr: interrupted; no frame is saved"),
                    _ => say(format_args!(
                        "povr: interrupted; {at} of {of} frames are saved: the same command with `+SF{next}` resumes"
                    )),
                }
            }
            run.console.cancelled();
            Ok(ExitCode::from(interrupt::INTERRUPTED))
        }
        Done::Until(_) => {
            run.reporter.total(settings, counts);
            run.console.failed();
            Ok(ExitCode::FAILURE)
        }
    }
}

impl Run<'_> {
    fn all(&self, numbers: &[u32]) -> Result<Done, CliError> {
        let workers = self.workers();
        let mut at = 0;
        // A scene that writes files may read in a frame the files it has written in an earlier one.
        let mut is_alone = true;
        while at < numbers.len() {
            if at == 0 || is_alone {
                let writes = AtomicBool::new(false);
                self.begin(at, numbers);
                let done = self.draw(numbers[at], Writing::Allowed, &|event| {
                    if let Event::Read { wrote_files, .. } = event {
                        writes.fetch_or(wrote_files, Ordering::Relaxed);
                    }
                    if !self.settings.render.stop.is_cancelled() {
                        self.reporter.report(event);
                    }
                });
                let Ok(drawn) = done else {
                    return Ok(Done::Until(at));
                };
                self.finish(at, numbers, drawn)?;
                is_alone = writes.into_inner() || at > 0;
                at += 1;
                continue;
            }
            let rest = &numbers[at..];
            let work = |number: usize| {
                let messages = MessageBuffer::default();
                let done = self.draw(rest[number], Writing::Refused, &|event| {
                    messages.push(event)
                });
                (messages, done)
            };
            let end = in_order(rest.len(), workers, work, |number, (messages, done)| {
                if done.as_ref().is_err_and(writes_files) {
                    return ControlFlow::Break(End::WritesFiles(at + number));
                }
                if done.is_err() && self.settings.render.stop.is_cancelled() {
                    return ControlFlow::Break(End::Failed(at + number));
                }
                self.begin(at + number, numbers);
                messages.replay(|event| self.reporter.report(event));
                let Ok(drawn) = done else {
                    return ControlFlow::Break(End::Failed(at + number));
                };
                match self.finish(at + number, numbers, drawn) {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(refusal) => ControlFlow::Break(End::CannotWrite(refusal)),
                }
            });
            match end {
                None => break,
                Some(End::WritesFiles(here)) => (at, is_alone) = (here, true),
                Some(End::Failed(here)) => return Ok(Done::Until(here)),
                Some(End::CannotWrite(refusal)) => return Err(refusal),
            }
        }
        Ok(Done::All)
    }

    /// Checks that the files of all frames can be written.
    fn check(&self, numbers: &[u32]) -> Result<(), CliError> {
        let render = &self.settings.render;
        if let Some((_, options)) = &self.settings.output {
            for target in numbers.iter().filter_map(|&number| self.output(number)) {
                output::check(&target, (render.width, render.height), options.format)?;
            }
        }
        Ok(())
    }

    /// The file of a frame.
    fn output(&self, number: u32) -> Option<Target> {
        let (target, _) = self.settings.output.as_ref()?;
        Some(match target {
            Target::File(path) => Target::File(self.frames.path(number, path)),
            Target::Stdout => Target::Stdout,
        })
    }

    /// The file of a frame for messages.
    fn name(&self, number: u32) -> String {
        match self.output(number) {
            Some(Target::File(path)) => path.display().to_string(),
            Some(Target::Stdout) => "standard output".to_owned(),
            None => format!("frame {number} (not written)"),
        }
    }

    /// Announces a frame, counted from 0, to the message files and to POV-Ray's console.
    fn begin(&self, at: usize, numbers: &[u32]) {
        let picture = self.output(numbers[at]);
        let picture = picture.as_ref();
        let (position, of) = self.frames.position(numbers[at]);
        self.console.frame(position, of, self.settings, picture);
        self.console.parsing();
        if at > 0 {
            self.reporter.files.next_frame();
        }
        self.reporter.files.begin(self.settings, picture);
    }

    /// Number of frames rendered in parallel. One, where times are measured.
    fn workers(&self) -> usize {
        let (render, verbosity) = (&self.settings.render, self.settings.verbosity);
        let is_timed = verbosity.stats
            || verbosity.json
            || matches!(&render.sampling, Sampling::Adaptive(how) if how.time.is_some());
        if is_timed {
            return 1;
        }
        let threads = match render.threads {
            Some(threads) => threads,
            None => thread::available_parallelism().map_or(1, usize::from),
        };
        let limit = MAX_PIXELS / pixels(render).max(1);
        threads
            .min(usize::try_from(limit).unwrap_or(usize::MAX))
            .max(1)
    }

    /// Renders a frame and encodes its file.
    fn draw(
        &self,
        number: u32,
        writing: Writing,
        listen: &EventHandler<'_>,
    ) -> Result<Drawn, Failure> {
        let mut read = self.frames.read_options_for(number, &self.settings.read);
        if writing == Writing::Refused {
            read.writable = Folders::Only(Vec::new());
        }
        let output = self.settings.output.as_ref();
        let render = RenderOptions {
            target_format: output.map(|(_, options)| options.clone()),
            ..self.settings.render.clone()
        };
        let Picture {
            film,
            working,
            rounding,
            statistics,
            ..
        } = (self.draw)(&self.input, &read, &render, &|event| match event {
            Event::Drawn(_) if render.stop.is_cancelled() => {}
            Event::Drawn(pixels) => self.progress.advance(pixels),
            event => listen(event),
        })?;
        let bytes = output.map(|(_, options)| {
            let options = options.for_scene(working, rounding);
            output::encode(&film, &options)
        });
        Ok(Drawn { bytes, statistics })
    }

    /// Writes a frame and reports on it.
    fn finish(&self, at: usize, numbers: &[u32], drawn: Drawn) -> Result<(), CliError> {
        let (settings, verbosity, number) = (self.settings, self.settings.verbosity, numbers[at]);
        let mut stages = drawn.statistics.stages.iter();
        let reading = stages.find(|stage| stage.name == "read");
        let reading = reading.and_then(|stage| Duration::try_from_secs_f64(stage.wall).ok());
        self.console.rendering(settings, reading);
        self.console.rendered(pixels(&settings.render));
        if verbosity.verbose && !verbosity.quiet && !verbosity.is_povray {
            let (frame, count) = (at + 1, numbers.len());
            say(format_args!(
                "Rendered frame {frame} of {count} (#{number})"
            ));
        }
        if let Some(reached) = drawn.statistics.reached.filter(|_| !verbosity.quiet) {
            say(error_reached(&reached, pixels(&settings.render)));
        }
        if let (Some(bytes), Some(target)) = (drawn.bytes, self.output(number)) {
            output::put(&bytes?, &target)?;
        }
        report_statistics(&drawn.statistics, verbosity, &self.reporter);
        self.console.drawn(settings, &drawn.statistics);
        Ok(())
    }
}

/// The progress over all frames; under the name of POV-Ray each frame has a line of its own.
fn progress_of_frames(verbosity: Verbosity) -> ProgressKind {
    match verbosity.is_povray {
        true => ProgressKind::Nothing,
        false => progress_kind(verbosity),
    }
}

fn writes_files(failure: &Failure) -> bool {
    let code = Some(Code::WritesFiles);
    failure.errors.iter().any(|error| error.code == code)
}
