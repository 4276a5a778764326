//! The command line: POV-Ray's switches and ini files, and a few long options beside them.
//!
//! What was typed goes into `Typed` option by option, later ones winning; `settings` decides what that means. Arguments
//! that begin with `--`, and `-o`, are read by clap; all others as POV-Ray reads them. Both kinds may be mixed.

mod error;
mod ini;
mod keys;
mod modern;
mod progress;
mod settings;
mod switches;
mod typed;
mod values;
mod words;

pub use error::CliError;
pub use progress::{Progress, ProgressKind};
pub use settings::{Scene, Settings, Talk};

use std::env;
use std::fmt;
use std::io::{self, IsTerminal, Read, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use crate::options::{Failure, Input, Picture, ReadOptions, RenderOptions};
use crate::output;
use crate::source::MAX_FILE_BYTES;
use ini::Reader;
use typed::Typed;

/// Draws a scene: what the stages do together. The last argument takes counts of drawn pixels, from any thread.
pub type Draw =
    dyn Fn(&Input, &ReadOptions, &RenderOptions, &(dyn Fn(u64) + Sync)) -> Result<Picture, Failure>;

/// Where settings come from besides the command line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Surroundings {
    /// The system's ini file. Only its folders count: its display and its talk are the distributor's taste.
    pub system_ini: Option<PathBuf>,
    /// The user's ini file.
    pub user_ini: Option<PathBuf>,
    /// What was wrong with it.
    pub warning: Option<String>,
}

/// What a command line asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// To draw.
    Draw(Box<Settings>),
    /// To print a text: help, or the version.
    Print(String),
}

/// Does what the arguments ask for. `draw` is called once at most. Every message goes to standard error; standard
/// output takes the picture, if that is where it is to go, and nothing else.
pub fn run(arguments: impl IntoIterator<Item = String>, draw: &Draw) -> ExitCode {
    let arguments: Vec<String> = arguments.into_iter().collect();
    match request(&arguments, &Surroundings::of_this_process()) {
        Ok(Request::Print(text)) => {
            say(text.trim_end());
            ExitCode::SUCCESS
        }
        Ok(Request::Draw(settings)) => match carry_out(&settings, draw) {
            Ok(()) => ExitCode::SUCCESS,
            Err(messages) => {
                messages.iter().for_each(say);
                ExitCode::FAILURE
            }
        },
        Err(refusal) => {
            say(format!("povr: {refusal}"));
            ExitCode::FAILURE
        }
    }
}

/// What the arguments, without the program's own name, ask for.
///
/// # Errors
/// When an option is unknown, has no sense, or asks for what is not built; when a named file is not there.
pub fn request(arguments: &[String], around: &Surroundings) -> Result<Request, CliError> {
    let standard_folders = standard_folders(around)?;
    let mut typed = Typed::default();
    typed.doubts.extend(around.warning.clone());
    let mut reader = Reader::new(&mut typed, &standard_folders);
    if let Some(file) = &around.user_ini {
        reader.read_file(file, None)?;
    }
    let mut rest = arguments;
    while let Some((first, others)) = rest.split_first() {
        if first == "--" {
            if let Some(scene) = others.last() {
                reader.typed.scene = Some(scene.clone());
            }
            break;
        }
        let modern = modern::length(rest);
        if modern > 0 {
            let (option, others) = rest.split_at(modern);
            if let Err(said) = modern::read(reader.typed, option) {
                return printed(&said);
            }
            rest = others;
        } else {
            for word in words::of_argument(first) {
                words::read(&mut reader, &word)?;
            }
            rest = others;
        }
    }
    let settings = settings::settle(typed, &standard_folders)?;
    Ok(Request::Draw(Box::new(settings)))
}

impl Surroundings {
    /// Those of this process, found where POV-Ray looks: `$POVINI`, `povray.ini` here, in `~/.povray/3.7`, in `/etc`.
    #[must_use]
    pub fn of_this_process() -> Self {
        let named = env::var_os("POVINI").map(PathBuf::from);
        let missing = named.as_ref().filter(|file| !file.is_file());
        let home = env::var_os("HOME").map(PathBuf::from);
        let places = [
            named.clone(),
            Some(PathBuf::from("povray.ini")),
            home.map(|home| home.join(".povray/3.7/povray.ini")),
        ];
        Surroundings {
            system_ini: Some(PathBuf::from("/etc/povray/3.7/povray.ini")).filter(|f| f.is_file()),
            warning: missing
                .map(|file| format!("`POVINI` names `{}`, which is not there", file.display())),
            user_ini: places.into_iter().flatten().find(|file| file.is_file()),
        }
    }
}

/// The folders of the system's ini file.
fn standard_folders(around: &Surroundings) -> Result<Vec<PathBuf>, CliError> {
    let mut system = Typed::default();
    if let Some(file) = &around.system_ini {
        Reader::new(&mut system, &[]).read_file(file, None)?;
    }
    Ok(system.library_paths)
}

/// What clap printed: an answer, or a refusal.
fn printed(said: &clap::Error) -> Result<Request, CliError> {
    let text = said.render().to_string();
    if said.use_stderr() {
        let text = text.trim_end();
        Err(CliError::new(text.strip_prefix("error: ").unwrap_or(text)))
    } else {
        Ok(Request::Print(text))
    }
}

/// Draws and writes. The messages of a failure are ready to print.
fn carry_out(settings: &Settings, draw: &Draw) -> Result<(), Vec<String>> {
    let talk = settings.talk;
    let warn = |warnings: &[String]| {
        if talk.warnings && !talk.quiet {
            warnings.iter().for_each(say);
        }
    };
    let input = input(&settings.scene).map_err(|message| vec![message])?;
    warn(&settings.warnings);
    if talk.verbose && !talk.quiet {
        for note in &settings.notes {
            say(note);
        }
    }
    let progress = Progress::new(progress_kind(talk), pixels(&settings.render));
    let drawn = draw(&input, &settings.read, &settings.render, &|n| {
        progress.advance(n);
    });
    progress.finish();
    let tell = |said: &str| {
        if !talk.quiet && !said.is_empty() {
            say(said.trim_end_matches('\n'));
        }
    };
    let picture = drawn.map_err(|failure| {
        tell(&failure.said);
        warn(&failure.warnings);
        failure.errors
    })?;
    tell(&picture.said);
    warn(&picture.warnings);
    if let Some((target, options)) = &settings.output {
        let options = output::EncodeOptions {
            working: picture.working,
            ..options.clone()
        };
        output::write(&picture.film, target, &options).map_err(|refused| {
            let hint = refused.hint().map(|hint| format!("\n  hint: {hint}"));
            vec![format!("povr: {refused}{}", hint.unwrap_or_default())]
        })?;
    }
    if talk.stats && !picture.statistics.is_empty() {
        say(picture.statistics.trim_end());
    }
    Ok(())
}

fn input(scene: &Scene) -> Result<Input, String> {
    match scene {
        Scene::File(path) => Ok(Input::File(path.clone())),
        Scene::Stdin => {
            let mut text = Vec::new();
            io::stdin()
                .lock()
                .take(MAX_FILE_BYTES + 1)
                .read_to_end(&mut text)
                .map_err(|error| format!("povr: cannot read standard input: {error}"))?;
            if text.len() as u64 > MAX_FILE_BYTES {
                return Err("povr: standard input is too large for a scene".to_owned());
            }
            Ok(Input::Text {
                name: "standard input".to_owned(),
                text,
            })
        }
    }
}

fn progress_kind(talk: Talk) -> ProgressKind {
    if talk.quiet {
        ProgressKind::Nothing
    } else if io::stderr().is_terminal() {
        ProgressKind::Bar
    } else if talk.verbose {
        ProgressKind::Lines
    } else {
        ProgressKind::Nothing
    }
}

fn pixels(render: &RenderOptions) -> u64 {
    u64::from(render.columns.end - render.columns.start)
        * u64::from(render.rows.end - render.rows.start)
}

/// One message. A reader that has gone away is no reason to fail.
fn say(message: impl fmt::Display) {
    let _ = writeln!(io::stderr(), "{message}");
}

#[cfg(test)]
mod tests;
