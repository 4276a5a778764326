//! The `povr` command.

use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    povr::memory::keep_large_pieces_apart();
    povr::cli::run(env::args_os().map(|a| a.to_string_lossy().into_owned()))
}
