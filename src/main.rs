//! The `povr` command.

use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    povr::base::memory::set_mmap_threshold();
    povr::app::cli::run(env::args_os().map(|a| a.to_string_lossy().into_owned()))
}
