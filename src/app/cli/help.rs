//! `povr help`: the same as `povr --help`, and `povr help COMMAND` as `povr COMMAND --help`.

use crate::app::cli::options::command_line;
use crate::base::nearest::nearest;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use super::draw::report::say;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::{COMMANDS, Command, draw};

pub(super) const COMMAND: Command = Command {
    name: "help",
    about: "print this text, or that of a command",
    run,
    options: <CommandOptions as CommandFactory>::command,
};

/// Prints what povr, or one of its commands, can do.
#[derive(Debug, Parser)]
#[command(name = "povr help")]
struct CommandOptions {
    /// The command; without one the text is that of povr itself
    command: Option<String>,
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let name = std::iter::once("povr help".to_owned());
    let options = match CommandOptions::try_parse_from(name.chain(arguments.iter().cloned())) {
        Ok(options) => options,
        Err(error) => {
            say(command_line::printed::<CommandOptions>(&error)?.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let help = ["--help".to_owned()];
    match options.command {
        None => draw::run(&help, environment),
        Some(name) => (named(&name)?.run)(&help, environment),
    }
}

/// The command with a name.
///
/// # Errors
/// When there is none.
pub(super) fn named(name: &str) -> Result<&'static Command, CliError> {
    let names = || COMMANDS.iter().map(|command| command.name);
    let known = COMMANDS.iter().find(|command| command.name == name);
    known.ok_or_else(|| {
        let refusal = CliError::new(format!("there is no command `{name}`"));
        match nearest(name, names()) {
            Some(near) => refusal.with_hint(format!("Did you mean `{near}`?")),
            None => {
                let all: Vec<&str> = names().collect();
                refusal.with_hint(format!("Commands are {}.", all.join(", ")))
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_that_is_not_there_has_its_neighbour() {
        assert_eq!(
            named("bacth")
                .map(|command| command.name)
                .unwrap_err()
                .to_string(),
            "there is no command `bacth`\n  hint: Did you mean `batch`?"
        );
        assert!(named("watch").is_ok());
    }
}
