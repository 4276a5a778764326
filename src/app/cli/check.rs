//! `povr check`: reads scenes to their end and reports their errors, without rendering and without writing files: files
//! that scenes write are stored in memory.
//!
//! Findings and counts go to standard output, as the result of the command; `#debug` output of scenes goes to standard
//! error. Exit code 0: every scene could be rendered; 1: some could not; 2: the command line is wrong.

use crate::app::cli::options::command_line;
use crate::app::cli::options::ini;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use super::Command;
use super::draw::limits::{Limits, Watch};
use super::draw::report::{Line, Reporter, Stream, counted, say};
use super::kernel;
use super::options::arg_words;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::ini::Reader;
use super::options::long_options;
use super::options::output_kinds::MessageFormat;
use super::options::raw_args::RawArgs;
use super::options::safety::{LimitOptions, SafetyOptions};
use super::options::settings::{Scene, find_scene, read_options};
use crate::app::batch::scenes_below;
use crate::base::nearest::nearest;
use crate::base::options::{CancelToken, Event, ReadOptions};
use crate::base::source::{Code, Diagnostic, Message, Sources};

pub(super) const COMMAND: Command = Command {
    name: "check",
    about: "read scenes and say what is wrong with them",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Reads scenes without drawing them and says what is wrong with them.
#[derive(Debug, Parser)]
#[command(
    name = "povr check",
    override_usage = "povr check [OPTIONS] [+/-SWITCHES] [FILE.ini] SCENE|FOLDER|-...",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr check scene.pov                     one scene
  povr check scenes                        all scenes of a folder
  povr check scene.pov --message-format short    for editors",
    after_help = "\
In a folder every .pov file is read, and those of the folders inside. `-` is standard input. Nothing is written: \
files that a scene writes are kept in memory.
POV-Ray's switches and ini files count as far as reading goes: +LFOLDER, Declare=Name=1, +K0.5, +W320, ...
`--timeout` counts for each scene; those behind one that takes longer are read.
A comment `// povr: allow NAME` in a scene leaves out a kind of warning as --allow does.
Exit code: 0 no errors, 1 errors found, 2 bad command line.
With `short` a finding is a line `file:line:column: error: message`. With `json` it is an object in a line, whose `type` \
is `finding` (with severity, code, message, file, line, column, end, labels, trace, hints, fix), `scene_output` (text of #debug), \
`file` (counts of errors and warnings, words_of_3_8) or `total` (counts).
For a scene without errors the features that POV-Ray 3.7 lacks are named."
)]
struct CommandOptions {
    /// Format of errors and warnings: povray, human, short or json
    #[arg(long, value_name = "FORM", value_enum, hide_possible_values = true)]
    message_format: Option<MessageFormat>,
    /// Print errors, and nothing of scenes without errors
    #[arg(long)]
    quiet: bool,
    /// Leave out a kind of warning, by the name in brackets after it; may be given several times
    #[arg(long, value_name = "NAME", value_parser = lint)]
    allow: Vec<String>,
    #[command(flatten)]
    safety: SafetyOptions,
    #[command(flatten)]
    limits: LimitOptions,
}

/// A command line of this command.
#[derive(Debug, Default)]
struct Wanted {
    scenes: Vec<String>,
    format: Option<MessageFormat>,
    is_quiet: bool,
    allowed: Vec<String>,
}

/// The name of a lint.
fn lint(name: &str) -> Result<String, CliError> {
    let names = || Code::LINTS.iter().map(|(_, name)| *name);
    if names().any(|known| known == name) {
        return Ok(name.to_owned());
    }
    let refusal = CliError::new(format!("`--allow`: there is no warning `{name}`"));
    Err(match nearest(name, names()) {
        Some(near) => refusal.with_hint(format!("Did you mean `{near}`?")),
        None => {
            let all: Vec<&str> = names().collect();
            refusal.with_hint(format!("Names are {}.", all.join(", ")))
        }
    })
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let standard_folders = environment.standard_folders()?;
    let mut raw_args = environment.raw_args(&standard_folders)?;
    let wanted = match read_arguments(arguments, &mut raw_args, &standard_folders)? {
        Ok(wanted) => wanted,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let library_paths = [raw_args.library_paths.as_slice(), &standard_folders].concat();
    let scenes = find_scenes(&wanted.scenes, &library_paths)?;
    let mut reporter = Reporter::new(wanted.format.unwrap_or(MessageFormat::Human), Stream::Out);
    let is_quiet = wanted.is_quiet || raw_args.quiet;
    reporter.warns = raw_args.warnings && !is_quiet;
    reporter.debugs = raw_args.debugs && !is_quiet;
    if reporter.warns {
        for doubt in &raw_args.doubts {
            say(format_args!("povr: warning: {doubt}"));
        }
    }
    let limits = LimitOptions::of(&raw_args);
    let options_of = |scene: &Scene| ReadOptions {
        lints: true,
        stop: CancelToken::default(),
        allowed_lints: wanted.allowed.clone(),
        ..read_options(&raw_args, library_paths.clone(), scene.path(), environment)
    };
    if raw_args.safety.sandbox {
        kernel::enter_to_read(&scenes, &options_of);
    }
    let of_memory = Limits::new(None, limits.max_memory);
    let _watch = Watch::over_command(of_memory, None, (reporter.format, reporter.stream));
    let of_time = Limits::new(limits.timeout, None);
    let are_right = check(&scenes, &options_of, (&reporter, of_time), is_quiet);
    Ok(if are_right {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// Parses the arguments; returns the help text if requested.
fn read_arguments(
    arguments: &[String],
    raw_args: &mut RawArgs,
    standard_folders: &[PathBuf],
) -> Result<Result<Wanted, String>, CliError> {
    let mut wanted = Wanted::default();
    let mut reader = Reader::new(raw_args, standard_folders);
    let mut rest = arguments;
    while let Some((first, others)) = rest.split_first() {
        if first == "--" {
            wanted.scenes.extend_from_slice(others);
            break;
        }
        let long = long_options::length::<CommandOptions>(rest);
        if long == 0 {
            read_word(first, &mut reader, &mut wanted.scenes)?;
            rest = others;
            continue;
        }
        let (option, others) = rest.split_at(long);
        match command_line::parse::<CommandOptions>(option) {
            Ok(options) => {
                wanted.is_quiet |= options.quiet;
                wanted.allowed.extend(options.allow);
                reader.raw_args.safety.add(options.safety);
                reader.raw_args.limits.add(options.limits);
                wanted.format = options.message_format.or(wanted.format);
            }
            Err(error) => return command_line::printed::<CommandOptions>(&error).map(Err),
        }
        rest = others;
    }
    if wanted.scenes.is_empty() {
        // From an ini file, or from `+I`.
        wanted.scenes.extend(raw_args.scene.take());
    }
    if wanted.scenes.is_empty() {
        return Err(CliError::new("no scene is named")
            .with_hint("Write `povr check scene.pov`, or `povr check --help`."));
    }
    Ok(Ok(wanted))
}

/// A scene or folder goes to `scenes`; all else is as on POV-Ray's command line.
fn read_word(
    argument: &str,
    reader: &mut Reader<'_>,
    scenes: &mut Vec<String>,
) -> Result<(), CliError> {
    let is_ini = argument.ends_with(']') || arg_words::has_ending(argument, ".ini");
    let is_scene = argument == "-"
        || Path::new(argument).exists() && !is_ini
        || !argument.starts_with(['+', '-'])
            && arg_words::assignment(argument).is_none()
            && !is_ini;
    if is_scene {
        scenes.push(argument.to_owned());
        return Ok(());
    }
    arg_words::of_argument(argument)
        .iter()
        .try_for_each(|word| ini::read(reader, word))
}

/// The scenes for some names: files in the order given, those of a folder sorted, without duplicates.
pub(super) fn find_scenes(
    names: &[String],
    library_paths: &[PathBuf],
) -> Result<Vec<Scene>, CliError> {
    let mut scenes = Vec::new();
    for name in names {
        let path = Path::new(name);
        let scenes_named = if name == "-" {
            vec![Scene::Stdin]
        } else if path.is_dir() {
            let files = scenes_below(path).map_err(|error| CliError::new(error.to_string()))?;
            if files.is_empty() {
                return Err(CliError::new(format!("no scene (`.pov`) lies in `{name}`")));
            }
            files.into_iter().map(Scene::File).collect()
        } else {
            // A missing file is reported among the findings: the others are read anyway.
            let file = find_scene(name, library_paths).unwrap_or_else(|_| path.to_owned());
            vec![Scene::File(file)]
        };
        for scene in scenes_named {
            if !scenes.contains(&scene) {
                scenes.push(scene);
            }
        }
    }
    Ok(scenes)
}

/// Reads all scenes, each within a limit, with a line about each and one total; true if all could be rendered.
fn check(
    scenes: &[Scene],
    options: &dyn Fn(&Scene) -> ReadOptions,
    (reporter, limits): (&Reporter, Limits),
    is_quiet: bool,
) -> bool {
    let is_json = reporter.format == MessageFormat::Json;
    let (mut errors, mut warnings, mut faulty) = (0, 0, 0);
    for scene in scenes {
        let listen = |event: Event<'_>| reporter.report(event);
        let mut novelties = Vec::new();
        let options = options(scene);
        let output = (reporter.format, reporter.stream);
        let watch = Watch::over_command(limits, Some(options.stop.clone()), output);
        match scene.input() {
            Ok(input) => {
                // The reason of a failure has already been reported.
                if let Ok(result) = crate::check(&input, &options, &listen) {
                    novelties = result;
                }
            }
            Err(refusal) => {
                let error = Diagnostic::error(None, refusal.to_string());
                listen(Event::Finding(&Message::new(&error, &Sources::default())));
            }
        }
        let mut counts = reporter.take_counts();
        if watch.is_over() {
            counts.errors = counts.errors.max(1);
        }
        drop(watch);
        let file = scene.name();
        if is_json {
            reporter.json(&Line::File {
                file: &file,
                errors: counts.errors,
                warnings: counts.warnings,
                words_of_3_8: novelties.iter().map(|novelty| novelty.name()).collect(),
            });
        } else if counts.errors > 0 || !is_quiet {
            let quoted: Vec<String> = novelties.iter().map(|novelty| novelty.quoted()).collect();
            let needs = match quoted.as_slice() {
                [] => String::new(),
                names => format!("; needs POV-Ray 3.8 for {}", names.join(", ")),
            };
            reporter.line(format_args!("{file}: {counts}{needs}"));
        }
        errors += counts.errors;
        warnings += counts.warnings;
        faulty += usize::from(counts.errors > 0);
    }
    if is_json {
        reporter.json(&Line::Total {
            files: scenes.len(),
            errors,
            warnings,
        });
    } else if scenes.len() > 1 && (faulty > 0 || !is_quiet) {
        reporter.line(format_args!(
            "{}: {} right, {faulty} faulty; {}, {}",
            counted(scenes.len(), "scene"),
            scenes.len() - faulty,
            counted(errors, "error"),
            counted(warnings, "warning"),
        ));
    }
    faulty == 0
}

impl Scene {
    /// The name for messages.
    pub(super) fn name(&self) -> String {
        match self {
            Scene::File(path) => path.display().to_string(),
            Scene::Stdin => "standard input".to_owned(),
        }
    }
}
