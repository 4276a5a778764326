//! The command line: POV-Ray's switches and ini files, a few long options beside them, and commands by name.
//!
//! `povr scene.pov +W320 ...` renders, as `povray` would. `povr NAME ...` runs the command of that name in `COMMANDS`:
//! one file each. Options are collected in `RawArgs`, later ones winning; `settings` interprets them. Arguments that
//! begin with `--`, and `-o`, are parsed by clap; all others as in POV-Ray. Both kinds may be mixed. Exit codes:
//! POV-Ray's 0 and 1 for rendering; commands end with 2 when the command line itself is wrong.

mod batch;
mod check;
mod compare;
mod completions;
mod curve;
mod draw;
mod help;
mod install_as_povray;
mod kernel;
mod man;
mod options;
mod sheet;
mod watch;
mod worker;

pub use curve::report as curve_report;
pub use draw::frames::Frames;
pub use draw::progress::{Progress, ProgressKind};
pub use draw::{Request, request};
pub use options::environment::Environment;
pub use options::error::CliError;
pub use options::output_kinds::MessageFormat;
pub use options::settings::{Scene, Settings, Verbosity};

use std::path::Path;
use std::process::ExitCode;

use draw::report::say;

/// A command by name.
struct Command {
    /// The first argument.
    name: &'static str,
    /// A one-line description for `--help`.
    about: &'static str,
    /// Runs it with the arguments after the name.
    run: Run,
    /// Its options.
    options: fn() -> clap::Command,
}

type Run = fn(&[String], &Environment) -> Result<ExitCode, CliError>;

/// The commands beside rendering.
const COMMANDS: &[Command] = &[
    batch::COMMAND,
    check::COMMAND,
    compare::COMMAND,
    completions::COMMAND,
    curve::COMMAND,
    help::COMMAND,
    install_as_povray::COMMAND,
    watch::LIVE,
    man::COMMAND,
    sheet::COMMAND,
    watch::COMMAND,
];

/// The order of the parts of a help text: examples, the `before_help` of a command, precede its options.
const HELP_TEMPLATE: &str =
    "{about-with-newline}\n{usage-heading} {usage}\n\n{before-help}{all-args}{after-help}";

/// The exit code of a command that could not start.
const MISUSED: u8 = 2;

/// Executes the arguments, the first of which is the name by which the program was called. By the name `povray` it has
/// no commands, and its standard error has POV-Ray's format.
pub fn run(arguments: impl IntoIterator<Item = String>) -> ExitCode {
    draw::limits::outlive_file_limit();
    let mut arguments = arguments.into_iter();
    let program = arguments.next().unwrap_or_default();
    let arguments: Vec<String> = arguments.collect();
    if arguments == [crate::app::worker::COMMAND] {
        return worker::run();
    }
    let surroundings = match arguments.iter().any(|argument| argument == "--sandbox") {
        true => Environment::outside_of_this_folder(),
        false => Environment::of_this_process(),
    };
    let environment = Environment {
        is_povray: is_povray(&program),
        ..surroundings
    };
    let (done, refused) = match named(&arguments).filter(|_| !environment.is_povray) {
        Some((command, rest)) => ((command.run)(rest, &environment), ExitCode::from(MISUSED)),
        None => (draw::run(&arguments, &environment), ExitCode::FAILURE),
    };
    done.unwrap_or_else(|refusal| {
        match environment.is_povray {
            true => draw::console::refused(&program, &arguments, &refusal),
            false => say(format_args!("povr: {refusal}")),
        }
        refused
    })
}

/// True if the program at this path is called as POV-Ray is.
fn is_povray(program: &str) -> bool {
    let name = Path::new(program).file_stem();
    name.is_some_and(|name| name.eq_ignore_ascii_case("povray"))
}

/// The command named by the first argument, and the arguments after it. A file of that name is `./check`.
fn named(arguments: &[String]) -> Option<(&'static Command, &[String])> {
    let (name, rest) = arguments.split_first()?;
    let command = COMMANDS.iter().find(|command| command.name == name)?;
    Some((command, rest))
}

#[cfg(test)]
mod tests;
