//! Suggestions for options that a command does not have.

use clap::CommandFactory;

use super::error::CliError;
use super::long_options::LongOptions;
use super::{keys, switches};
use crate::app::cli::COMMANDS;
use crate::base::nearest::nearest;

/// The error for a long option that `own` does not have. `option` is the option as typed, with or without a value after
/// `=`.
pub(crate) fn unknown_option(option: &str, own: &clap::Command) -> CliError {
    let option = option.split('=').next().unwrap_or(option);
    let listed = format!("`{} --help` lists the options.", own.get_name());
    let refusal = CliError::new(format!("unknown option `{option}`"));
    let Some(name) = option.strip_prefix("--") else {
        return CliError::new(format!("unexpected argument `{option}`")).with_hint(listed);
    };
    if let Some(command) = commands_with(name, own).first() {
        return CliError::new(format!("`{option}` is an option of `{command}`"));
    }
    if let Some(near) = nearest(name, long_options(own)) {
        return refusal.with_hint(format!("Did you mean `--{near}`?"));
    }
    if let Some(switch) = switch_for(name) {
        return refusal.with_hint(format!("Did you mean {switch}?"));
    }
    let others = every_command().filter(|(_, options)| options.get_name() != own.get_name());
    let others = others.flat_map(|(command, options)| {
        long_options(&options)
            .into_iter()
            .map(move |option| CommandOption {
                option,
                command: command.clone(),
            })
    });
    match nearest(name, others) {
        Some(CommandOption { option, command }) => refusal.with_hint(format!(
            "Did you mean `--{option}`, an option of `{command}`?"
        )),
        None => refusal.with_hint(listed),
    }
}

/// An option of a command.
struct CommandOption {
    option: String,
    command: String,
}

impl AsRef<str> for CommandOption {
    fn as_ref(&self) -> &str {
        &self.option
    }
}

/// Rendering, and the commands, with their options.
fn every_command() -> impl Iterator<Item = (String, clap::Command)> {
    let drawing = std::iter::once(("povr".to_owned(), LongOptions::command()));
    drawing.chain(COMMANDS.iter().map(|command| {
        let options = (command.options)();
        (format!("povr {}", command.name), options)
    }))
}

/// The other commands that have an option of this name.
fn commands_with(name: &str, own: &clap::Command) -> Vec<String> {
    every_command()
        .filter(|(_, options)| options.get_name() != own.get_name())
        .filter(|(_, options)| long_options(options).iter().any(|option| option == name))
        .map(|(command, _)| command)
        .collect()
}

fn long_options(options: &clap::Command) -> Vec<String> {
    let shown = options.get_arguments().filter(|arg| !arg.is_hide_set());
    let longs = shown.filter_map(clap::Arg::get_long);
    longs.map(str::to_owned).collect()
}

/// POV-Ray's form of an option written with two hyphens: `--work-threads` is `Work_Threads`, or `+WT`.
fn switch_for(name: &str) -> Option<String> {
    let key = name.replace('-', "_");
    let (known, _) = keys::names().find(|(known, _)| known.eq_ignore_ascii_case(&key))?;
    Some(match switches::of_key(known) {
        Some(switch) => format!("`{switch}` (`{known}`)"),
        None => format!("`{known}=...`"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_of_other_commands_and_of_povray_are_named() {
        let own = LongOptions::command();
        for (option, expected) in [
            ("--serve", "`--serve` is an option of `povr watch`"),
            ("--port=80", "`--port` is an option of `povr live`"),
            (
                "--verbose",
                "unknown option `--verbose`\n  hint: Did you mean `+V` (`Verbose`)?",
            ),
            (
                "--width",
                "unknown option `--width`\n  hint: Did you mean `+W<value>` (`Width`)?",
            ),
            (
                "--clock-on",
                "unknown option `--clock-on`\n  hint: `povr --help` lists the options.",
            ),
            (
                "--sise",
                "unknown option `--sise`\n  hint: Did you mean `--size`?",
            ),
            (
                "--serv",
                "unknown option `--serv`\n  hint: Did you mean `--serve`, an option of `povr watch`?",
            ),
            (
                "--foo",
                "unknown option `--foo`\n  hint: `povr --help` lists the options.",
            ),
        ] {
            assert_eq!(unknown_option(option, &own).to_string(), expected);
        }
        let watch = COMMANDS.iter().find(|command| command.name == "watch");
        let watch = (watch.expect("it is there").options)();
        let refusal = unknown_option("--threads", &watch).to_string();
        assert_eq!(refusal, "`--threads` is an option of `povr`");
    }
}
