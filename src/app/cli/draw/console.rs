//! POV-Ray's console output, for programs that call this one by the name `povray` and wait for its lines on standard
//! error.
//!
//! The lines are those of POV-Ray 3.7.0.10 as far as they apply here: a banner with the version, the options,
//! `[Parsing...]` and `[Rendering...]`, times, `POV-Ray finished` or `Render failed`. Progress between them comes from
//! `progress`. As in POV-Ray, `-GA` omits the options and the times, and so do `-GR` and `-GS`; `--quiet`, which
//! POV-Ray does not know, omits everything.

use std::time::Duration;

use super::report::say;
use super::streams::{drawn_how, drawn_what};
use crate::app::cli::options::error::{CliError, Stage};
use crate::app::cli::options::settings::{Settings, Verbosity};
use crate::base::options::Statistics;
use crate::output::Target;

/// The version of the language and of the command line that programs check for.
const POVRAY: &str = "3.7.0";

const RULE: &str = "----------------------------------------------------------------------------";

/// Writes POV-Ray's console output, if this program was called by its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Console {
    verbosity: Verbosity,
}

impl Console {
    /// The console of a run.
    pub(crate) fn new(verbosity: Verbosity) -> Self {
        Console { verbosity }
    }

    fn is_on(&self) -> bool {
        self.verbosity.is_povray && !self.verbosity.is_silent
    }

    fn has_options(&self) -> bool {
        self.is_on() && !self.verbosity.quiet && self.verbosity.renders
    }

    fn has_statistics(&self) -> bool {
        self.is_on() && !self.verbosity.quiet && self.verbosity.statistics
    }

    /// The banner and the options of the scene.
    pub(crate) fn begin(&self, settings: &Settings) {
        if !self.is_on() {
            return;
        }
        say(banner());
        self.shellouts(settings, false);
        if settings.frames.is_none() {
            let target = settings.output.as_ref().map(|(target, _)| target);
            self.shellouts(settings, true);
            self.options(settings, target);
        }
    }

    /// Announces a frame of an animation, and the options that it is drawn with.
    pub(crate) fn frame(
        &self,
        number: u32,
        of: u32,
        settings: &Settings,
        picture: Option<&Target>,
    ) {
        if self.is_on() {
            say(format_args!("Rendering frame {number} of {of}"));
            self.shellouts(settings, true);
            self.options(settings, picture);
        }
    }

    /// Reports that all pixels of a frame are there.
    pub(crate) fn rendered(&self, pixels: u64) {
        if self.is_on() && self.verbosity.verbose {
            say(format_args!(
                "Rendered {pixels} of {pixels} pixels (100%)\r"
            ));
        }
    }

    /// Names the programs that are not run, twice each as POV-Ray does.
    fn shellouts(&self, settings: &Settings, is_of_frames: bool) {
        let shellouts = settings.shellouts.iter();
        for shellout in shellouts.filter(|shellout| shellout.is_of_frames == is_of_frames) {
            let line = format!("Execution of shellout '{}' prohibited", shellout.program);
            say(format_args!("{line}\n{line}"));
        }
    }

    fn options(&self, settings: &Settings, picture: Option<&Target>) {
        if self.has_options() {
            say(drawn_what(settings, picture).trim_end());
            say(self.streams());
        }
    }

    /// The messages that go to the console.
    fn streams(&self) -> String {
        let shown = self.verbosity;
        let all = !shown.quiet;
        let lines = [
            ("All Streams to console..........", all),
            ("Debug Stream to console.........", shown.debugs),
            ("Fatal Stream to console.........", shown.errors),
            ("Render Stream to console........", shown.renders),
            ("Statistics Stream to console....", shown.statistics),
            ("Warning Stream to console.......", shown.warnings),
        ];
        let mut text = "Information Output Options".to_owned();
        for (name, is_on) in lines {
            text += &format!("\n  {name}{}", if is_on { "On " } else { "Off" });
        }
        text
    }

    /// Announces the parsing of the scene.
    pub(crate) fn parsing(&self) {
        self.stage("Parsing");
    }

    /// Announces the rendering, with the time of parsing if it is known.
    pub(crate) fn rendering(&self, settings: &Settings, reading: Option<Duration>) {
        if let Some(took) = reading.filter(|_| self.has_statistics()) {
            let took = clock(took);
            say(format_args!(
                "{RULE}\nParser Time\n  Parse Time:       {took}\n  Bounding Time:    {}",
                clock(Duration::ZERO)
            ));
        }
        if self.has_options() {
            say(format_args!("{RULE}\n{}", drawn_how(settings).trim_end()));
        }
        self.stage("Rendering");
    }

    /// Reports a finished picture.
    pub(crate) fn drawn(&self, settings: &Settings, statistics: &Statistics) {
        if !self.has_statistics() {
            return;
        }
        let (width, height) = (settings.render.width, settings.render.height);
        let pixels = statistics.pixels;
        let is_part = pixels < u64::from(width) * u64::from(height);
        let part = if is_part {
            " (Partial Image Rendered)"
        } else {
            ""
        };
        say(format_args!(
            "{RULE}\nRender Statistics{part}\nImage Resolution {width} x {height}\n{RULE}\nPixels: {pixels:>16}\n{RULE}\nRender Time:"
        ));
        let Some(trace) = statistics.stages.iter().find(|stage| stage.name == "trace") else {
            return;
        };
        let took = clock(Duration::try_from_secs_f64(trace.wall).unwrap_or_default());
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = settings.render.threads.unwrap_or_else(cores);
        say(format_args!(
            "  Trace Time:       {took}\n              using {threads} thread(s) with {:.3} CPU-seconds total",
            trace.processor
        ));
    }

    /// Reports success.
    pub(crate) fn finished(&self) {
        self.end("POV-Ray finished");
    }

    /// Reports a faulty scene.
    pub(crate) fn failed(&self) {
        self.end("Fatal error in parser: Cannot parse input.\nRender failed");
    }

    /// Reports a cancelled rendering.
    pub(crate) fn cancelled(&self) {
        self.end("Fatal error in renderer: Frontend halted render.\nRender cancelled by user");
    }

    fn stage(&self, name: &str) {
        if self.is_on() {
            let begin = format!("==== [{name}...] ");
            say(format_args!("{begin:=<76}"));
        }
    }

    fn end(&self, line: &str) {
        if self.is_on() {
            say(format_args!("{line}\n"));
        }
    }
}

/// Reports an error of the command line, or of a file, between the lines with which POV-Ray would end.
pub(crate) fn refused(program: &str, arguments: &[String], refusal: &CliError) {
    if arguments.iter().any(|argument| argument == "--quiet") {
        return say(format_args!("povr: {refusal}"));
    }
    let option = |last: &str| {
        let words = arguments.join(" ");
        say(format_args!(
            "povr: {refusal}\n\nProblem with option setting\n{program} {words}\n{last}"
        ));
    };
    match refusal.stage {
        Stage::Options => option("Failed to parse command-line option"),
        Stage::NoScene => option("No input file provided"),
        Stage::Scene => say(format_args!(
            "{}\npovr: {refusal}\nParse Error: Cannot open input file.\nFatal error in parser: Cannot parse \
             input.\nRender failed\n",
            banner()
        )),
        Stage::Output => say(format_args!("povr: {refusal}\nRender failed\n")),
    }
}

/// The banner; programs look for its first line.
fn banner() -> String {
    let own = env!("CARGO_PKG_VERSION");
    format!(
        "Persistence of Vision(tm) Ray Tracer Version {POVRAY}.povr (povr {own})\n{}\n",
        honesty()
    )
}

/// The answer to `povray --version`: POV-Ray's first line, and the true identity of this program.
pub(crate) fn version() -> String {
    format!("POV-Ray {POVRAY}.povr\n\n{}\n", honesty())
}

fn honesty() -> String {
    format!(
        "This is povr {}, called by the name of POV-Ray: a program of its own that takes\n\
         the scenes and the command line of POV-Ray {POVRAY}. It is not POV-Ray, and the\n\
         POV-Ray Team is not responsible for it.",
        env!("CARGO_PKG_VERSION")
    )
}

/// `0 hours  0 minutes  2 seconds (2.345 seconds)`.
fn clock(took: Duration) -> String {
    let whole = took.as_secs();
    format!(
        "{} hours {:>2} minutes {:>2} seconds ({:.3} seconds)",
        whole / 3600,
        whole / 60 % 60,
        whole % 60,
        took.as_secs_f64()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_written_as_by_povray() {
        for (milliseconds, expected) in [
            (9, "0 hours  0 minutes  0 seconds (0.009 seconds)"),
            (
                3_672_345,
                "1 hours  1 minutes 12 seconds (3672.345 seconds)",
            ),
        ] {
            assert_eq!(clock(Duration::from_millis(milliseconds)), expected);
        }
    }

    #[test]
    fn the_version_says_what_this_is() {
        let version = version();
        assert!(version.starts_with("POV-Ray 3.7"), "{version}");
        assert!(version.contains("This is povr") && version.contains("not POV-Ray"));
        assert!(banner().starts_with("Persistence of Vision(tm) Ray Tracer Version 3.7"));
    }
}
