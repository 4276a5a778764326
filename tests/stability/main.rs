//! Correctness where rounding and fixed distances fail: pictures and rays whose answers are known to 77 digits.
//!
//! The catalogue has 54 items. `tools/stability` adds those marked slow, and POV-Ray's answers beside povr's.

#![allow(dead_code, reason = "tools/stability uses the rest")]

#[path = "../support/mod.rs"]
mod support;

mod case;
mod catalogue;
mod certain;
mod draw;
mod model;
mod oracle;
mod rays;
mod sheet;
mod wide;

use libtest_mimic::{Arguments, Failed, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let trials = catalogue::all()
        .into_iter()
        .map(|case| {
            let name = format!("{:02} {}", case.item, case.name);
            let is_slow = case.is_slow;
            Trial::test(name, move || check(&case)).with_ignored_flag(is_slow)
        })
        .collect();
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn check(case: &case::Case) -> Result<(), Failed> {
    let outcome = case.outcome(&|text, size| draw::by_povr(text, size));
    let (allowed, why) = case.allowed.unwrap_or((0, "nothing is allowed"));
    if outcome.not_numbers > 0 {
        return Err(format!("{} pixels are not numbers", outcome.not_numbers).into());
    }
    if outcome.wrong > allowed {
        let folder = support::scratch("stability/failed")?;
        let file = folder.join(format!(
            "{:02} {}.png",
            case.item,
            case.name.replace('/', "-")
        ));
        sheet::row(case, &[&outcome]).save(file)?;
        return Err(format!(
            "{} of {} are wrong ({why}); povr says: {}",
            outcome.wrong, outcome.decided, outcome.said
        )
        .into());
    }
    Ok(())
}
