//! `povr install-as-povray`: a link by the name of POV-Ray, for programs that start `povray`.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use super::Command;
use super::draw::report::say;
use super::options::command_line;
use super::options::environment::Environment;
use super::options::error::CliError;
use crate::app::program;

pub(super) const COMMAND: Command = Command {
    name: "install-as-povray",
    about: "link povr as povray, for programs that start that",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Makes a link to povr named `povray` in a folder. By that name povr writes POV-Ray's messages.
#[derive(Debug, Parser)]
#[command(
    name = "povr install-as-povray",
    after_help = "Put the folder before that of POV-Ray in PATH: export PATH=FOLDER:$PATH"
)]
struct CommandOptions {
    /// The folder; it is made if it does not exist
    folder: PathBuf,
}

fn run(arguments: &[String], _: &Environment) -> Result<ExitCode, CliError> {
    let name = std::iter::once("povr install-as-povray".to_owned());
    match CommandOptions::try_parse_from(name.chain(arguments.iter().cloned())) {
        Ok(options) => link(&options.folder)?,
        Err(error) => say(command_line::printed::<CommandOptions>(&error)?.trim_end()),
    }
    Ok(ExitCode::SUCCESS)
}

/// Makes the link. One that leads to this program already is left as it is; anything else by that name is an error.
fn link(folder: &Path) -> Result<(), CliError> {
    let path = folder.join(format!("povray{}", env::consts::EXE_SUFFIX));
    let failed = |error| CliError::new(format!("cannot make `{}`: {error}", path.display()));
    let own = program::start()
        .and_then(fs::canonicalize)
        .map_err(failed)?;
    fs::create_dir_all(folder).map_err(failed)?;
    if fs::canonicalize(&path).is_ok_and(|there| there == own) {
        return Ok(());
    }
    if path.symlink_metadata().is_ok() {
        let there = path.display();
        return Err(CliError::new(format!("`{there}` exists already"))
            .with_hint("Remove it, or name another folder."));
    }
    make(&own, &path).map_err(failed)
}

#[cfg(unix)]
fn make(own: &Path, path: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(own, path)
}

/// Links need a permission that few users have.
#[cfg(not(unix))]
fn make(own: &Path, path: &Path) -> std::io::Result<()> {
    fs::copy(own, path).map(drop)
}
