//! Reads a scene and draws nothing: `read_only SCENE.pov`. `tools/read_bench` times it.

use povr::base::options::ReadOptions;
use povr::base::source::Sources;
use povr::lang;
use std::process::ExitCode;

#[allow(clippy::print_stderr, reason = "a command line tool")]
fn main() -> ExitCode {
    let mut sources = Sources::new(Vec::new());
    let file = match sources.load_file(std::env::args().nth(1).unwrap_or_default()) {
        Ok(file) => file,
        Err(error) => {
            eprintln!("read_only: {}", error.message);
            return ExitCode::from(2);
        }
    };
    let reading = lang::evaluate(file, &mut sources, &ReadOptions::default());
    for finding in &reading.findings {
        eprintln!("read_only: {}", finding.message);
    }
    eprint!("{}", reading.messages);
    let is_read = reading.scene.is_some();
    // POV-Ray's time of parsing does not include freeing the scene either.
    std::mem::forget(reading);
    ExitCode::from(u8::from(!is_read))
}
