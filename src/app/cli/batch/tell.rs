//! Reports on a batch: a progress bar, the failures at the end, a log for programs.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;

use super::Wanted;
use crate::app::batch::{News, Outcome, Picture, Status};
use crate::app::cli::draw::report::{Reporter, Stream, counted, say};
use crate::app::cli::kernel;
use crate::app::cli::options::environment::Environment;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::output_kinds::MessageFormat;
use crate::base::options::Event;
use crate::base::source::Message;

/// Reports on a batch.
pub(super) struct BatchReporter<'a> {
    pictures: &'a [Picture],
    out: &'a Path,
    is_json: bool,
    is_quiet: bool,
    format: MessageFormat,
    started: Instant,
    bar: ProgressBar,
    tally: Mutex<Tally>,
}

#[derive(Default)]
struct Tally {
    has_begun: bool,
    left: usize,
    /// The pictures being drawn, in the order of their beginnings.
    drawing: Vec<usize>,
    drawn: usize,
    up_to_date: usize,
    failed: BTreeMap<usize, Outcome>,
    seconds: BTreeMap<usize, f64>,
    refused: usize,
    /// Reported parts of a sandbox that the kernel lacks.
    lacks: BTreeSet<String>,
}

/// The results of a batch by the number of the picture.
pub(super) struct Finished {
    /// The reasons of those that failed, as lines of text.
    pub(super) failed: BTreeMap<usize, String>,
    /// The times of those that were drawn.
    pub(super) seconds: BTreeMap<usize, f64>,
}

/// A line of `--json`.
#[derive(Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Line<'a> {
    Picture {
        scene: &'a Path,
        #[serde(skip_serializing_if = "Option::is_none")]
        output: Option<&'a Path>,
        status: &'static str,
        seconds: f64,
        pixels: u64,
        #[serde(skip_serializing_if = "Option::is_none")]
        why: Option<&'a str>,
        errors: &'a [Message],
    },
    Total {
        drawn: usize,
        up_to_date: usize,
        failed: usize,
        seconds: f64,
    },
}

impl Tally {
    /// The counts, and the scene that has been drawn longest: `13 of 37, 1 failed: gears.pov`.
    fn message(&self, pictures: &[Picture]) -> String {
        let (done, failed) = (self.drawn + self.failed.len(), self.failed.len());
        let mut message = format!("{done} of {}", self.left);
        if failed > 0 {
            message += &format!(", {failed} failed");
        }
        let scene = self
            .drawing
            .first()
            .map(|&picture| &pictures[picture].scene);
        if let Some(name) = scene.and_then(|scene| scene.file_name()) {
            message += &format!(": {}", name.to_string_lossy());
        }
        message
    }
}

impl<'a> BatchReporter<'a> {
    pub(super) fn new(
        wanted: &'a Wanted,
        pictures: &'a [Picture],
        environment: &Environment,
    ) -> Self {
        let target = if wanted.is_quiet || !environment.is_terminal {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        let style = ProgressStyle::with_template(
            "{bar:30} {percent:>3}%  {elapsed} elapsed, {eta} to go  {wide_msg}",
        );
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        BatchReporter {
            pictures,
            out: &wanted.batch.out,
            is_json: wanted.is_json,
            is_quiet: wanted.is_quiet,
            format: wanted
                .format
                .unwrap_or_else(|| environment.message_format()),
            started: Instant::now(),
            bar,
            tally: Mutex::default(),
        }
    }

    /// Reports a scene that cannot be rendered.
    pub(super) fn refused(&self, scene: &Path, refusal: &CliError) {
        let why = refusal.to_string();
        self.line(&Line::Picture {
            scene,
            output: None,
            status: "failed",
            seconds: 0.0,
            pixels: 0,
            why: Some(&why),
            errors: &[],
        });
        say(format_args!("povr: {}: {why}", scene.display()));
        self.lock().refused += 1;
    }

    /// Reports an event.
    pub(super) fn report(&self, news: News<'_>) {
        match news {
            News::Left { pictures, pixels } => {
                let mut tally = self.lock();
                (tally.has_begun, tally.left) = (true, pictures);
                drop(tally);
                self.bar.set_length(pixels);
                self.bar.reset();
            }
            News::Begun(picture) => {
                let mut tally = self.lock();
                tally.drawing.retain(|&other| other != picture);
                tally.drawing.push(picture);
                self.bar.set_message(tally.message(self.pictures));
            }
            News::Drawn(pixels) => self.bar.inc(pixels),
            News::Done(outcome) => self.done(outcome),
            News::Weaker(lack) => {
                if self.lock().lacks.insert(lack.to_owned()) {
                    kernel::warn(&[lack.to_owned()]);
                }
            }
        }
    }

    fn done(&self, outcome: &Outcome) {
        let picture = &self.pictures[outcome.picture];
        let (status, why) = match &outcome.status {
            Status::Drawn => ("drawn", None),
            Status::UpToDate => ("up-to-date", None),
            Status::Failed(why) => ("failed", why.as_deref()),
        };
        let output = self.out.join(&picture.output);
        let mut tally = self.lock();
        self.line(&Line::Picture {
            scene: &picture.scene,
            output: Some(&output),
            status,
            seconds: outcome.seconds,
            pixels: picture.render.columns.len() as u64 * picture.render.rows.len() as u64,
            why,
            errors: &outcome.messages,
        });
        tally.drawing.retain(|&other| other != outcome.picture);
        match outcome.status {
            Status::Drawn => {
                tally.drawn += 1;
                tally.seconds.insert(outcome.picture, outcome.seconds);
            }
            Status::UpToDate => tally.up_to_date += 1,
            Status::Failed(_) => drop(tally.failed.insert(outcome.picture, outcome.clone())),
        }
        self.bar.set_message(tally.message(self.pictures));
    }

    /// True if the pictures to draw are known.
    pub(super) fn has_begun(&self) -> bool {
        self.lock().has_begun
    }

    /// Reports failures and totals.
    pub(super) fn finish(&self) -> Finished {
        self.bar.finish_and_clear();
        let tally = self.lock();
        let mut failed = BTreeMap::new();
        for (&index, outcome) in &tally.failed {
            let scene = self.pictures[index].scene.display();
            let reporter = Reporter::new(self.format, Stream::Err);
            let why = match &outcome.status {
                Status::Failed(Some(why)) => {
                    say(format_args!("povr: {scene}: {why}"));
                    why.clone()
                }
                _ => {
                    say(format_args!("povr: {scene}: it cannot be drawn"));
                    for message in &outcome.messages {
                        reporter.report(Event::Finding(message));
                    }
                    let texts: Vec<&str> = outcome
                        .messages
                        .iter()
                        .map(|m| m.excerpt.as_str())
                        .collect();
                    texts.join("\n\n")
                }
            };
            failed.insert(index, why);
        }
        let seconds = self.started.elapsed().as_secs_f64();
        self.line(&Line::Total {
            drawn: tally.drawn,
            up_to_date: tally.up_to_date,
            failed: failed.len() + tally.refused,
            seconds,
        });
        if !self.is_quiet {
            say(format_args!(
                "povr: {} drawn, {} up to date, {} failed; {seconds:.1} s",
                counted(tally.drawn, "picture"),
                tally.up_to_date,
                failed.len() + tally.refused
            ));
        }
        Finished {
            failed,
            seconds: tally.seconds.clone(),
        }
    }

    fn line(&self, line: &Line<'_>) {
        if let (true, Ok(line)) = (self.is_json, serde_json::to_string(line)) {
            // A closed pipe is no reason to fail.
            let _ = writeln!(io::stdout(), "{line}");
        }
    }

    fn lock(&self) -> MutexGuard<'_, Tally> {
        self.tally.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::options::{ReadOptions, RenderOptions};
    use crate::output::{EncodeOptions, Format};

    #[test]
    fn the_scene_drawn_longest_is_named() {
        let picture = |scene: &str| Picture {
            scene: scene.into(),
            series: 0,
            output: "o.png".into(),
            read: ReadOptions::default(),
            render: RenderOptions::default(),
            encode: EncodeOptions::new(Format::PNG),
        };
        let pictures = [picture("a/one.pov"), picture("two.pov")];
        let mut tally = Tally {
            left: 2,
            drawing: vec![0, 1],
            ..Tally::default()
        };
        assert_eq!(tally.message(&pictures), "0 of 2: one.pov");
        tally.drawing.remove(0);
        tally.drawn = 1;
        assert_eq!(tally.message(&pictures), "1 of 2: two.pov");
        tally.drawing.clear();
        assert_eq!(tally.message(&pictures), "1 of 2");
    }
}
