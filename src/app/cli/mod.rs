//! The command line: POV-Ray's switches and ini files, a few long options beside them, and commands by name.
//!
//! `povr scene.pov +W320 ...` draws, as `povray` would. `povr NAME ...` is the command of that name in `COMMANDS`: one
//! file each. What was typed goes into `Typed` option by option, later ones winning; `settings` decides what that means.
//! Arguments that begin with `--`, and `-o`, are read by clap; all others as POV-Ray reads them. Both kinds may be mixed.
//! Exit codes: POV-Ray's 0 and 1 for drawing; commands end with 2 when the command line itself is at fault.

mod batch;
mod check;
mod compare;
mod completions;
mod curve;
mod draw;
mod help;
mod man;
mod options;
mod sheet;
mod watch;

pub use draw::frames::Frames;
pub use draw::progress::{Progress, ProgressKind};
pub use draw::report::MessageFormat;
pub use draw::{Request, request};
pub use options::environment::Environment;
pub use options::error::CliError;
pub use options::settings::{Scene, Settings, Talk};

use std::path::Path;
use std::process::ExitCode;

use draw::report::say;

/// A command by name.
struct Command {
    /// The first argument.
    name: &'static str,
    /// What it does, in a line of `--help`.
    about: &'static str,
    /// Does it, with the arguments behind the name.
    run: Run,
    /// Its options.
    face: fn() -> clap::Command,
}

type Run = fn(&[String], &Environment) -> Result<ExitCode, CliError>;

/// The commands beside drawing.
const COMMANDS: &[Command] = &[
    batch::COMMAND,
    check::COMMAND,
    compare::COMMAND,
    completions::COMMAND,
    curve::COMMAND,
    help::COMMAND,
    man::COMMAND,
    sheet::COMMAND,
    watch::COMMAND,
];

/// The exit code of a command that could not begin.
const MISUSED: u8 = 2;

/// Does what the arguments ask for, of which the first is the name by which the program was called. By the name `povray`
/// it has no commands, and writes to standard error what POV-Ray writes there.
pub fn run(arguments: impl IntoIterator<Item = String>) -> ExitCode {
    draw::limits::outlive_file_limit();
    let mut arguments = arguments.into_iter();
    let program = arguments.next().unwrap_or_default();
    let arguments: Vec<String> = arguments.collect();
    let around = Environment {
        is_povray: is_povray(&program),
        ..Environment::of_this_process()
    };
    let (done, refused) = match named(&arguments).filter(|_| !around.is_povray) {
        Some((command, rest)) => ((command.run)(rest, &around), ExitCode::from(MISUSED)),
        None => (draw::run(&arguments, &around), ExitCode::FAILURE),
    };
    done.unwrap_or_else(|refusal| {
        say(format_args!("povr: {refusal}"));
        refused
    })
}

/// Returns true if a program of this path is called as POV-Ray is.
fn is_povray(program: &str) -> bool {
    let name = Path::new(program).file_stem();
    name.is_some_and(|name| name.eq_ignore_ascii_case("povray"))
}

/// The command that the first argument names, and the arguments behind it. A file of that name is `./check`.
fn named(arguments: &[String]) -> Option<(&'static Command, &[String])> {
    let (name, rest) = arguments.split_first()?;
    let command = COMMANDS.iter().find(|command| command.name == name)?;
    Some((command, rest))
}

#[cfg(test)]
mod tests;
