//! Command lines of commands, parsed by clap, with remedies for what they do not know.

use super::error::CliError;
use super::unknown;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser};

/// Parses one option with its value.
///
/// # Errors
/// clap's output: an error, or the text of `--help` or `--version`.
pub(crate) fn parse<CommandOptions: Parser>(
    option: &[String],
) -> Result<CommandOptions, clap::Error> {
    let words = option.iter().map(|word| match word.as_str() {
        "-help" | "-?" => "--help",
        "-version" => "--version",
        other => other,
    });
    CommandOptions::try_parse_from(std::iter::once("povr").chain(words))
}

/// The text that clap printed: an answer, or an error about an option of this command.
pub(crate) fn printed<CommandOptions: CommandFactory>(
    error: &clap::Error,
) -> Result<String, CliError> {
    if let (ErrorKind::UnknownArgument, Some(ContextValue::String(option))) =
        (error.kind(), error.get(ContextKind::InvalidArg))
    {
        return Err(unknown::unknown_option(option, &CommandOptions::command()));
    }
    if error.kind() == ErrorKind::ValueValidation
        && let Some(why) = std::error::Error::source(error)
    {
        return Err(invalid_value(error, &why.to_string()));
    }
    let text = error.render().to_string();
    if error.use_stderr() {
        let text = text.trim_end();
        Err(CliError::new(text.strip_prefix("error: ").unwrap_or(text)))
    } else {
        Ok(text)
    }
}

/// The error for a value that an option does not take. The reason may name the option itself.
fn invalid_value(error: &clap::Error, why: &str) -> CliError {
    let of = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => text.as_str(),
        _ => "",
    };
    let option = of(ContextKind::InvalidArg).split(' ').next();
    let option = option.unwrap_or_default();
    match why.starts_with(&format!("`{option}`")) {
        true => CliError::new(why),
        false => CliError::new(format!(
            "`{option} {}`: {why}",
            of(ContextKind::InvalidValue)
        )),
    }
}
