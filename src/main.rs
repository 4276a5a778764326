//! The `povr` command.

use std::env;
use std::process::ExitCode;

use povr::cli;
use povr::options::{Failure, Input, Picture, ReadOptions, RenderOptions};

fn main() -> ExitCode {
    let arguments = env::args_os().skip(1);
    cli::run(arguments.map(|a| a.to_string_lossy().into_owned()), &draw)
}

/// Stands between the command line and the stages until these exist.
fn draw(
    _: &Input,
    _: &ReadOptions,
    _: &RenderOptions,
    _: &(dyn Fn(u64) + Sync),
) -> Result<Picture, Failure> {
    Err(Failure {
        warnings: Vec::new(),
        errors: vec!["povr: scenes cannot be drawn yet".to_owned()],
    })
}
