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
    let text = error.render().to_string();
    if error.use_stderr() {
        let text = text.trim_end();
        Err(CliError::new(text.strip_prefix("error: ").unwrap_or(text)))
    } else {
        Ok(text)
    }
}
