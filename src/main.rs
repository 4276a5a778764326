//! The `povr` command.

use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    povr::memory::keep_large_pieces_apart();
    let arguments = env::args_os().skip(1);
    povr::cli::run(arguments.map(|a| a.to_string_lossy().into_owned()))
}
