//! Right where rounding and fixed distances go wrong: pictures and rays whose answers are known to 77 digits.
//!
//! The catalogue has 54 items. Those marked slow, and POV-Ray's answers beside povr's, come with `tools/stability`.

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
    let found = case.outcome(&|text, size| draw::by_povr(text, size));
    let (allowed, why) = case.allowed.unwrap_or((0, "nothing is allowed"));
    if found.not_numbers > 0 {
        return Err(format!("{} pixels are not numbers", found.not_numbers).into());
    }
    if found.wrong > allowed {
        let folder = support::scratch("stability/failed")?;
        let file = folder.join(format!(
            "{:02} {}.png",
            case.item,
            case.name.replace('/', "-")
        ));
        sheet::row(case, &[&found]).save(file)?;
        return Err(format!(
            "{} of {} are wrong ({why}); povr says: {}",
            found.wrong, found.decided, found.said
        )
        .into());
    }
    Ok(())
}
