//! Reports findings in scenes: for people, for editors, for programs.
//!
//! With `json`, everything about a scene is one object a line:
//! * `{"type":"finding", ...}`: `severity` ("error" or "warning"), `message`, and where they are known `code`
//!   ("not-built", "undeclared", "missing-file", "author", "limit", "writes-files", "memory"), `file`, `line`, `column`,
//!   `end` (`line` and `column` of the position after it); `labels` and `trace` (related positions, and the enclosing calls and includes,
//!   innermost first: `text`, `file`, `line`, `column`, `end`); `hints` (sentences); `fix`, where the last hint is certain
//!   (the `text` to write in place of what is at `file`, `line`, `column` to `end`). The code of a lint is its name.
//! * `{"type":"scene_output","text":...}`: the scene's `#debug` output.
//! * `{"type":"file","file":...,"errors":N,"warnings":N}` and at the end `{"type":"total","files":N,
//!   "errors":N,"warnings":N}`: the counts of `povr check`.
//! * `{"type":"statistics", ...}`: the statistics of a rendering with `--json`, as in `options::Statistics`.
//!
//! Lines and columns count from 1, columns in characters. Lines of standard error that do not begin with `{` are about
//! the command line.

use super::streams::Files;
use crate::app::cli::options::output_kinds;
use crate::app::cli::options::output_kinds::MessageFormat;
use crate::app::cli::options::settings::Settings;
use crate::base::options::{Event, Statistics};
use crate::base::source::{Message, Severity};
use serde::Serialize;
use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::{fmt, io};

/// The standard stream for findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stream {
    /// For commands with findings as their result.
    Out,
    /// If standard output may receive the picture.
    Err,
}

/// Reports on scenes.
#[derive(Debug)]
pub(crate) struct Reporter {
    /// The format of findings.
    pub(crate) format: MessageFormat,
    /// The stream of findings.
    pub(crate) stream: Stream,
    /// True to write errors.
    pub(crate) shows_errors: bool,
    /// True to write warnings.
    pub(crate) warns: bool,
    /// True to write the scene's `#debug` output.
    pub(crate) debugs: bool,
    /// Message files that receive the same.
    pub(crate) files: Files,
    counts: Mutex<Counts>,
}

/// Counts of findings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
    /// True if the scene's output has ended in the middle of a line.
    is_within_line: bool,
}

/// A line of `json`.
#[derive(Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(crate) enum Line<'a> {
    Finding(&'a Message),
    SceneOutput {
        text: &'a str,
    },
    File {
        file: &'a str,
        errors: usize,
        warnings: usize,
        /// The novelties of version 3.8 in the scene.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        words_of_3_8: Vec<&'static str>,
    },
    Total {
        files: usize,
        errors: usize,
        warnings: usize,
    },
    Statistics(&'a Statistics),
}

impl Reporter {
    pub(crate) fn new(format: MessageFormat, stream: Stream) -> Self {
        Reporter {
            format,
            stream,
            shows_errors: true,
            warns: true,
            debugs: true,
            files: Files::default(),
            counts: Mutex::new(Counts::default()),
        }
    }

    /// Reports an event.
    pub(crate) fn report(&self, event: Event<'_>) {
        match &event {
            Event::SceneOutput(text) => self.files.write(output_kinds::Stream::Debug, text),
            Event::Finding(message) => self.files.write_finding(message),
            _ => {}
        }
        match event {
            Event::SceneOutput(text) if self.debugs => self.scene_output(text),
            Event::Finding(message) => self.write_finding(message),
            Event::Resumed(pixels) if self.warns => {
                say(format_args!(
                    "povr: resuming: {pixels} pixels already rendered"
                ));
            }
            Event::CheckpointDiscarded if self.warns => say(
                "povr: ignoring the saved state: it belongs to another scene, other options or another version of povr",
            ),
            Event::CheckpointFailed(kind) if self.warns => {
                say(format_args!(
                    "povr: cannot save the state of the interrupted render: {kind}"
                ));
            }
            _ => {}
        }
    }

    /// The counts so far.
    pub(crate) fn counts(&self) -> Counts {
        *self.lock()
    }

    /// Returns the counts since the last call, and resets them.
    pub(crate) fn take_counts(&self) -> Counts {
        self.end_line();
        std::mem::take(&mut *self.lock())
    }

    /// Writes the number of errors of a rendering, if there are several.
    pub(crate) fn total(&self, settings: &Settings, counts: Counts) {
        let verbosity = settings.verbosity;
        let is_wanted =
            !verbosity.quiet && !verbosity.is_povray && self.format != MessageFormat::Json;
        if is_wanted && counts.errors > 1 {
            self.line(format_args!("{}: {counts}", settings.scene.name()));
        }
    }

    /// Writes a line to the stream of findings.
    pub(crate) fn line(&self, line: impl fmt::Display) {
        // A closed pipe is no reason to fail.
        let _ = match self.stream {
            Stream::Out => writeln!(io::stdout(), "{line}"),
            Stream::Err => writeln!(io::stderr(), "{line}"),
        };
    }

    /// Writes an object to the stream of findings.
    pub(crate) fn json(&self, line: &Line<'_>) {
        if let Ok(line) = serde_json::to_string(line) {
            self.line(line);
        }
    }

    fn scene_output(&self, text: &str) {
        if self.format == MessageFormat::Json {
            return self.json(&Line::SceneOutput { text });
        }
        if let Some(last) = text.chars().last() {
            self.lock().is_within_line = last != '\n';
            let _ = write!(io::stderr(), "{text}");
        }
    }

    fn write_finding(&self, message: &Message) {
        self.end_line();
        let mut counts = self.lock();
        match message.severity {
            Severity::Error => counts.errors += 1,
            Severity::Warning => counts.warnings += 1,
        }
        drop(counts);
        let is_shown = match message.severity {
            Severity::Error => self.shows_errors,
            Severity::Warning => self.warns,
        };
        if !is_shown {
            return;
        }
        match self.format {
            MessageFormat::Povray => self.line(message.povray()),
            MessageFormat::Human if self.is_colored() => {
                self.line(format_args!("{}\n", message.colored));
            }
            MessageFormat::Human => self.line(format_args!("{}\n", message.excerpt)),
            MessageFormat::Short => self.line(message.short()),
            MessageFormat::Json => self.json(&Line::Finding(message)),
        }
    }

    /// Colour is for terminals, and not wanted on all: <https://no-color.org>.
    fn is_colored(&self) -> bool {
        let is_terminal = match self.stream {
            Stream::Out => io::stdout().is_terminal(),
            Stream::Err => io::stderr().is_terminal(),
        };
        is_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
    }

    /// Ends the line of the scene's output, so that the next output begins a line.
    fn end_line(&self) {
        if std::mem::take(&mut self.lock().is_within_line) {
            say("");
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Counts> {
        self.counts
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

impl fmt::Display for Counts {
    /// `2 errors, 1 warning`, or `ok`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = [(self.errors, "error"), (self.warnings, "warning")]
            .into_iter()
            .filter(|&(count, _)| count > 0)
            .map(|(count, what)| counted(count, what))
            .collect();
        f.write_str(if parts.is_empty() { "ok" } else { "" })?;
        f.write_str(&parts.join(", "))
    }
}

/// `1 file`, `2 files`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// Writes one message to standard error. A closed pipe is no reason to fail.
pub(crate) fn say(message: impl fmt::Display) {
    let _ = writeln!(io::stderr(), "{message}");
}
