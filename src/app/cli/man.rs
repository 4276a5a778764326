//! `povr man`: the manual page, generated from the lists of options that the program itself uses.

use crate::app::cli::options::command_line;
use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};

use super::draw::report::say;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::{keys, long_options, switches};
use super::{COMMANDS, Command, help};

pub(super) const COMMAND: Command = Command {
    name: "man",
    about: "print the manual page, or that of a command",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Prints the manual page of povr, or of one of its commands.
#[derive(Debug, Parser)]
#[command(
    name = "povr man",
    after_help = "`povr man | man -l -` shows it; `povr man > ~/.local/share/man/man1/povr.1` installs it."
)]
struct CommandOptions {
    /// The command; without one the page is that of povr itself
    command: Option<String>,
}

fn run(arguments: &[String], _: &Environment) -> Result<ExitCode, CliError> {
    let name = std::iter::once("povr man".to_owned());
    match CommandOptions::try_parse_from(name.chain(arguments.iter().cloned())) {
        Ok(options) => put(&page(options.command.as_deref())?),
        Err(error) => say(command_line::printed::<CommandOptions>(&error)?.trim_end()),
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints the output of a command. A closed pipe is no reason to fail.
pub(super) fn put(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

fn page(command: Option<&str>) -> Result<String, CliError> {
    let mut bytes = Vec::new();
    let made = match command {
        None => whole(&mut bytes),
        Some(name) => {
            let options = (help::named(name)?.options)();
            Man::new(options.version(env!("CARGO_PKG_VERSION"))).render(&mut bytes)
        }
    };
    made.map_err(|error| CliError::new(format!("cannot make the page: {error}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The page of the program: its own options, POV-Ray's switches and ini options, the commands.
fn whole(to: &mut Vec<u8>) -> std::io::Result<()> {
    // The commands and the switches have sections of their own.
    let man = Man::new(long_options::everything().after_help(""));
    man.render_title(to)?;
    man.render_name_section(to)?;
    man.render_synopsis_section(to)?;
    man.render_description_section(to)?;
    man.render_options_section(to)?;
    let mut roff = Roff::new();
    roff.control("SH", ["POV-RAY'S SWITCHES"]);
    roff.control("nf", []);
    for line in long_options::SWITCHES.lines() {
        roff.text([roman(line)]);
    }
    roff.control("fi", []);
    roff.control("SH", ["ALL SWITCHES"]);
    roff.text([roman(
        "Each is another name for an option of ini files, in upper or lower case; its value follows without a space.",
    )]);
    for one in switches::described() {
        roff.control("TP", []);
        roff.text([bold(one.name), roman(one.value)]);
        roff.text([roman(one.sets)]);
    }
    roff.control("SH", ["INI OPTIONS"]);
    roff.text([roman(
        "Written Key=Value, in ini files and on the command line. Those in brackets are known and have no effect here.",
    )]);
    let named = keys::names().map(|(name, acts)| match acts {
        true => name.to_owned(),
        false => format!("[{name}]"),
    });
    roff.control("PP", []);
    roff.text([roman(named.collect::<Vec<_>>().join(", "))]);
    roff.control("SH", ["COMMANDS"]);
    for command in COMMANDS {
        roff.control("TP", []);
        roff.text([bold(format!("povr {}", command.name))]);
        roff.text([roman(command.about)]);
    }
    roff.control("SH", ["EXIT STATUS"]);
    roff.text([roman(
        "0 if the picture was drawn, 1 if not. Commands end with 2 when the command line itself is at fault.",
    )]);
    roff.control("SH", ["SEE ALSO"]);
    roff.text([bold("povray"), roman("(1), "), bold("povr man COMMAND")]);
    roff.to_writer(to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_every_option_switch_and_command() {
        let text = page(None).unwrap().replace("\\-", "-");
        for one in switches::described() {
            assert!(
                text.contains(&format!("\\fB{}\\fR", one.name)),
                "{}",
                one.name
            );
        }
        for (name, _) in keys::names() {
            assert!(text.contains(name), "{name}");
        }
        for argument in long_options::everything().get_arguments() {
            if let Some(long) = argument.get_long() {
                assert!(text.contains(&format!("--{long}")), "{long}");
            }
        }
        for command in COMMANDS {
            assert!(
                text.contains(&format!("povr {}", command.name)),
                "{}",
                command.name
            );
        }
        assert!(text.contains("[Display]") && text.contains(" Width,"));
    }

    #[test]
    fn every_command_has_a_page() {
        for command in COMMANDS {
            let text = page(Some(command.name)).unwrap().replace("\\-", "-");
            let options = (command.options)();
            for argument in options.get_arguments().filter(|one| !one.is_hide_set()) {
                if let Some(long) = argument.get_long() {
                    assert!(
                        text.contains(&format!("--{long}")),
                        "{}: {long}",
                        command.name
                    );
                }
            }
        }
        let refused = page(Some("cmp")).unwrap_err().to_string();
        assert!(
            refused.starts_with("there is no command `cmp`\n  hint: Commands are "),
            "{refused}"
        );
    }
}
