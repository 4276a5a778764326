//! The `povr` command.

use std::env;
use std::process::ExitCode;

#[global_allocator]
static MEMORY: povr::memory::LargePages = povr::memory::LargePages;

fn main() -> ExitCode {
    povr::memory::keep_large_pieces_apart();
    let arguments = env::args_os().skip(1);
    povr::cli::run(arguments.map(|a| a.to_string_lossy().into_owned()))
}
