//! Compares two pictures: `compare EXPECTED ACTUAL [SIDE_BY_SIDE]`.
//!
//! Prints what differs; with a third path it also writes expected | difference | actual there. Exits with 0 if the
//! pictures are within the default limits, 1 if not, 2 if they cannot be compared.

use povr::compare::{Limits, Verdict, compare, side_by_side};
use std::error::Error;
use std::process::ExitCode;

#[allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command line tool"
)]
fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok((report, Verdict::Within)) => {
            println!("{report}");
            ExitCode::SUCCESS
        }
        Ok((report, _)) => {
            println!("{report}");
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("compare: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> Result<(String, Verdict), Box<dyn Error>> {
    let (expected, actual, sheet) = match arguments {
        [expected, actual] => (expected, actual, None),
        [expected, actual, sheet] => (expected, actual, Some(sheet)),
        _ => return Err("expected two pictures and perhaps a third to write".into()),
    };
    let (expected, actual) = (image::open(expected)?, image::open(actual)?);
    if let Some(sheet) = sheet {
        side_by_side(&expected, &actual).save(sheet)?;
    }
    let found = compare(&expected, &actual)?;
    Ok((found.to_string(), Limits::DEFAULT.verdict(&found)))
}
