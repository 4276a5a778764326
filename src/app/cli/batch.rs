//! `povr batch`: renders all scenes of folders into a parallel tree, and skips pictures that are up to date.
//!
//! Standard output receives the log of `--json`; all else goes to standard error. Exit code 0: all pictures are there;
//! 1: some are not; 2: the command line is wrong.

mod list;
mod tell;

use crate::app::cli::options::command_line;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;

use self::list::List;
use self::tell::BatchReporter;
use super::Command;
use super::draw::report::say;
use super::options::arg_words;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::long_options::Size;
use super::options::output_kinds::MessageFormat;
use super::options::safety::{LimitOptions, SafetyOptions};
use super::options::values::{bytes, duration};
use crate::app::batch::{self, Batch, Figure, Shard};

pub(super) const COMMAND: Command = Command {
    name: "batch",
    about: "render every scene of a folder that is not up to date",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Draws all scenes of folders into a tree like theirs.
#[derive(Debug, Parser)]
#[command(
    name = "povr batch",
    override_usage = "povr batch [OPTIONS] [+/-SWITCHES] FOLDER|PATTERN|SCENE... -o OUT",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr batch scenes -o pictures            all scenes of a folder
  povr batch scenes -o pictures --sheet    with a page of all pictures
  povr batch 'scenes/**/*.pov' -o pictures +W640 +H480 +A0.3",
    after_help = "\
`FOLDER/a/b.pov` becomes `OUT/a/b.png`; with several folders, `OUT/FOLDER/a/b.png`. Patterns: `*`, `?`, `[ab]`, `{a,b}`, \
and `**` for folders inside folders. `b.ini` beside `b.pov` is read for that scene, before the switches of the command \
line; an animation becomes its frames. +FN, +FJ, ... choose the type of the files.
A picture is up to date if it and the scene, every file read or looked for, the options and this program are the same \
as when it was drawn; scenes that write files are always drawn. A run that was killed may be started again: it resumes where it was.
Exit code 0: all pictures are there; 1: some are not; 2: the command line is at fault."
)]
struct CommandOptions {
    /// The folder of the pictures; it is made if it is missing
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Draw only scenes whose path below their folder, or name, matches; may be given several times
    #[arg(long, value_name = "PATTERN")]
    only: Vec<String>,
    /// Leave out such scenes, or folders
    #[arg(long, value_name = "PATTERN")]
    exclude: Vec<String>,
    /// Size of the pictures in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT")]
    size: Option<Size>,
    /// Scenes drawn side by side, on a thread each or more [default: the number of threads]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Number of threads, for all scenes together [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// A picture that takes longer has failed: 10s, 500ms, 2m
    #[arg(long, value_name = "TIME", value_parser = |text: &str| duration(text, "--timeout"))]
    timeout: Option<Duration>,
    /// The most memory that a scene may take: 500M, 4G [default: what the machine has]
    #[arg(long, visible_alias = "max-memory", value_name = "SIZE", value_parser = |text: &str| bytes(text, "--memory"))]
    memory: Option<u64>,
    #[command(flatten)]
    safety: SafetyOptions,
    /// Draw one part of several, for several machines: 2/8. In a Slurm array this is known
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Draw what is up to date as well
    #[arg(long)]
    again: bool,
    /// Write OUT/contact.png and OUT/index.html with all pictures
    #[arg(long)]
    sheet: bool,
    /// Print one object per picture on standard output
    #[arg(long)]
    json: bool,
    /// Print nothing but what failed
    #[arg(long)]
    quiet: bool,
    /// Format of errors: povray, human, short or json
    #[arg(long, value_name = "FORM", value_enum, hide_possible_values = true)]
    message_format: Option<MessageFormat>,
}

/// A command line of this command.
#[derive(Debug, Default)]
struct Wanted {
    names: Vec<String>,
    switches: Vec<String>,
    only: Vec<String>,
    except: Vec<String>,
    size: Option<Size>,
    memory: Option<u64>,
    safety: SafetyOptions,
    batch: Batch,
    has_sheet: bool,
    is_json: bool,
    is_quiet: bool,
    format: Option<MessageFormat>,
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let mut wanted = match read_arguments(arguments)? {
        Ok(wanted) => wanted,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    if wanted.batch.shard.is_none() {
        wanted.batch.shard = Shard::of_slurm(|name| std::env::var(name).ok());
        if let Some(Shard { number, of }) = wanted.batch.shard.filter(|_| !wanted.is_quiet) {
            say(format_args!("povr: part {number} of {of}, as Slurm has it"));
        }
    }
    if wanted.safety.sandbox {
        let limits = LimitOptions {
            timeout: wanted.batch.timeout,
            max_memory: wanted.memory,
        };
        let limits = limits.of_sandbox();
        (wanted.batch.timeout, wanted.memory) = (limits.timeout, limits.max_memory);
    }
    wanted.batch.memory = wanted.memory;
    wanted.batch.is_sandboxed = wanted.safety.sandbox;
    let List { pictures, refused } = list::list(&wanted, environment)?;
    let teller = BatchReporter::new(&wanted, &pictures, environment);
    for (scene, refusal) in &refused {
        teller.refused(scene, refusal);
    }
    let ran = batch::run(&pictures, &wanted.batch, &|news| teller.report(news));
    if !teller.has_begun() {
        return Ok(ran.map(|()| ExitCode::SUCCESS)?);
    }
    // Failures are reported even if the log could not be written at the end.
    let finished = teller.finish();
    ran?;
    if wanted.has_sheet {
        let drawn = pictures.iter().enumerate().map(|(index, picture)| Figure {
            name: picture.output.with_extension("").display().to_string(),
            file: picture.output.clone(),
            scene: picture.scene.clone(),
            seconds: finished.seconds.get(&index).copied(),
            missing: match finished.failed.get(&index) {
                Some(why) => Some(why.clone()),
                None if wanted.batch.out.join(&picture.output).is_file() => None,
                None => Some("not drawn yet".to_owned()),
            },
        });
        let undrawable = refused.iter().map(|(scene, refusal)| Figure {
            name: scene.display().to_string(),
            file: PathBuf::new(),
            scene: scene.clone(),
            seconds: None,
            missing: Some(refusal.to_string()),
        });
        let figures: Vec<Figure> = drawn.chain(undrawable).collect();
        batch::write_index(&wanted.batch.out, &figures)?;
    }
    Ok(if finished.failed.is_empty() && refused.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// Parses the arguments; returns the help text if requested.
fn read_arguments(arguments: &[String]) -> Result<Result<Wanted, String>, CliError> {
    let mut wanted = Wanted::default();
    let mut out = None;
    let mut rest = arguments;
    while let Some((first, others)) = rest.split_first() {
        if first == "--" {
            wanted.names.extend_from_slice(others);
            break;
        }
        let long = long_options::length::<CommandOptions>(rest);
        if long == 0 {
            wanted.word(first);
            rest = others;
            continue;
        }
        let (option, others) = rest.split_at(long);
        match command_line::parse::<CommandOptions>(option) {
            Ok(options) => {
                out = options.output.clone().or(out);
                wanted.take_in(options);
            }
            Err(error) => return command_line::printed::<CommandOptions>(&error).map(Err),
        }
        rest = others;
    }
    if wanted.names.is_empty() {
        return Err(CliError::new("no folder is named")
            .with_hint("Write `povr batch scenes -o pictures`, or `povr batch --help`."));
    }
    wanted.batch.out = out.ok_or_else(|| {
        CliError::new("no folder for the pictures is named").with_hint("Name one with `-o`.")
    })?;
    Ok(Ok(wanted))
}

impl Wanted {
    /// A folder, a pattern or a scene; all else is as on POV-Ray's command line.
    fn word(&mut self, argument: &str) {
        let is_switch = argument.starts_with(['+', '-'])
            || arg_words::assignment(argument).is_some()
            || argument.ends_with(']') && argument.contains(".ini[")
            || arg_words::has_ending(argument, ".ini");
        if is_switch {
            self.switches.extend(arg_words::of_argument(argument));
        } else {
            self.names.push(argument.to_owned());
        }
    }

    fn take_in(&mut self, options: CommandOptions) {
        self.only.extend(options.only);
        self.except.extend(options.exclude);
        self.size = options.size.or(self.size);
        self.memory = options.memory.or(self.memory);
        self.safety.add(options.safety);
        self.format = options.message_format.or(self.format);
        self.has_sheet |= options.sheet;
        self.is_json |= options.json;
        self.is_quiet |= options.quiet;
        let batch = &mut self.batch;
        batch.jobs = options.jobs.map(usize::from).or(batch.jobs);
        batch.threads = options.threads.map(usize::from).or(batch.threads);
        batch.timeout = options.timeout.or(batch.timeout);
        batch.shard = options.shard.or(batch.shard);
        batch.draws_all |= options.again;
    }
}
