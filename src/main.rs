//! The `povr` command.

use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    povr::base::memory::claim_heap();
    povr::app::cli::run(env::args_os().map(|a| a.to_string_lossy().into_owned()))
}
