//! Each scene of `pov_scenes/` is drawn by POV-Ray and by povr, and the pictures must agree. Those of
//! `pov_scenes/version38/` are drawn by POV-Ray 3.8 and skipped where it is not installed.
//!
//! A scene's first line is a comment that says what it shows. Further comments may state a size, switches and limits
//! (`povr::app::compare::Case`); without limits `Limits::DEFAULT` holds. Single pixels (never more than
//! `Limits::DEFAULT` allows) may differ by more if that is explained: POV-Ray drops surfaces nearer than a fixed
//! distance to the one that a ray leaves, and with `--pov-distances` povr does so too and must then be within
//! `Limits::DEFAULT`. Noise is no excuse here: a scene that is random states limits of its own. POV-Ray's pictures are
//! cached in `target/parity/reference/` under a hash of all their inputs, so that only new and changed scenes cost its
//! start-up time. A failure leaves expected | difference | actual in `target/parity/failed/`. Run one folder with
//! `cargo test --test parity shape/`; `povr compare pov_scenes` is the command for users.

mod support;

use libtest_mimic::{Arguments, Failed, Trial};
use povr::app::compare::{
    Bench, Case, CheckError, Compared, Explanation, Limits, Renderer, Verdict, side_by_side,
};
use std::ffi::OsStr;
use std::fmt::Display;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Arc, LazyLock, Mutex};
use std::time::Duration;

/// POV-Ray needs some seconds for the slowest scene; beside all other tests, which go first, it takes minutes.
const TIME_LIMIT: Duration = Duration::from_secs(900);
/// The size of pictures whose scenes set none.
const SIZE: (u32, u32) = (160, 120);
/// The folder of the scenes that are drawn by POV-Ray 3.8, not 3.7.
const OF_38: &str = "version38/";
/// POV-Ray spends most of its wall time asleep, so more tests run in parallel than there are processors.
const TESTS_PER_PROCESSOR: usize = 4;

/// Remarks on scenes that pass, printed after the last test.
type Remarks = Arc<Mutex<Vec<String>>>;

fn main() -> ExitCode {
    let mut arguments = Arguments::from_args();
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    arguments
        .test_threads
        .get_or_insert(TESTS_PER_PROCESSOR * processors);
    let remarks = Remarks::default();
    if let Err(why) = BENCH_38.as_ref() {
        print_remarks(&format!("{}* are not compared: {why}", OF_38));
    }
    let trials = match support::scenes(Path::new(support::SCENES)) {
        Ok(scenes) => scenes
            .into_iter()
            .flat_map(|path| trials(&path, &remarks))
            .collect(),
        Err(error) => vec![Trial::test("pov_scenes", move || Err(error.into()))],
    };
    let conclusion = libtest_mimic::run(&arguments, trials);
    let remarks = remarks.lock().map(|list| list.join("\n"));
    if let Ok(remarks) = remarks
        && !remarks.is_empty()
    {
        print_remarks(&remarks);
    }
    conclusion.exit_code()
}

#[allow(
    clippy::print_stderr,
    reason = "the end of a test run is read on the terminal"
)]
fn print_remarks(remarks: &str) {
    eprintln!("{remarks}\n");
}

/// The name of a scene: its path below `pov_scenes/` without extension, with `/` on every system.
fn scene_name(path: &Path) -> String {
    let relative = path.strip_prefix(support::SCENES).unwrap_or(path);
    let parts: Vec<_> = relative.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/").trim_end_matches(".pov").to_owned()
}

/// A test for each line of switches of a scene, or one without any.
fn trials(path: &Path, remarks: &Remarks) -> Vec<Trial> {
    let name = scene_name(path);
    let cases = match Case::of(path, &name) {
        Ok(cases) => cases,
        Err(error) => return vec![Trial::test(name, move || Err(error.into()))],
    };
    let trial = |case: Case| {
        let remarks = Arc::clone(remarks);
        let is_skipped = case.name.starts_with(OF_38) && BENCH_38.is_err();
        Trial::test(case.name.clone(), move || {
            let remark = check(&case)?;
            if let (Some(remark), Ok(mut list)) = (remark, remarks.lock()) {
                list.push(format!("{}: {remark}", case.name));
            }
            Ok(())
        })
        .with_ignored_flag(is_skipped)
    };
    cases.into_iter().map(trial).collect()
}

/// Draws a scene twice and compares. Returns a remark if the scene passes but deserves attention.
fn check(case: &Case) -> Result<Option<String>, Failed> {
    let first = case.text.lines().next().unwrap_or_default();
    if first
        .strip_prefix("// ")
        .is_none_or(|fact| fact.trim().len() < 10)
    {
        return Err("the first line is to be a comment that says what the scene shows".into());
    }
    let bench = match case.name.starts_with(OF_38) {
        true => &BENCH_38,
        false => &BENCH,
    };
    let bench = bench.as_ref().map_err(Failed::from)?;
    let checked = bench.check(case).map_err(|error| error.to_string())?;
    let sheet = support::scratch("parity/failed")?.join(case.file_name("png"));
    let save = || {
        let saved = side_by_side(&checked.expected, &checked.actual).save(&sheet);
        seen_in(&sheet, saved)
    };
    let compared = match checked.compared {
        Ok(compared) => compared,
        Err(mismatch) => return Err(format!("{mismatch}{}", save()).into()),
    };
    let Compared {
        limits,
        comparison,
        explanation,
        ..
    } = compared;
    let broken = match compared.verdict {
        Verdict::Within => None,
        Verdict::TooManyPixels => Some("too many pixels differ"),
        Verdict::ChannelOff if explanation == Some(Explanation::Distances) => None,
        Verdict::ChannelOff => Some("a channel is off by too much"),
    };
    if let Some(broken) = broken {
        return Err(format!("{broken} for `{limits}`\n{comparison}{}", save()).into());
    }
    // An old sheet would show a failure that is fixed.
    let _ = fs::remove_file(&sheet);
    let is_idle = case.limits.is_some() && Limits::DEFAULT.verdict(&comparison) == Verdict::Within;
    Ok(is_idle.then(|| format!("no longer needs its limits `{limits}`; {comparison}")))
}

/// The two renderers, or the reason why there is none to compare with.
static BENCH: LazyLock<Result<Bench, String>> = LazyLock::new(|| {
    bench("povray".as_ref()).map_err(|error| {
        format!("`povray` does not run ({error}); `tools/test` installs it and then runs this test")
    })
});

/// The same with POV-Ray 3.8: the program in the environment variable `POVRAY38`, or where `tools/povray38` puts it.
static BENCH_38: LazyLock<Result<Bench, String>> = LazyLock::new(|| {
    let program = match std::env::var_os("POVRAY38") {
        Some(program) => program,
        None => concat!(env!("CARGO_MANIFEST_DIR"), "/target/povray38/povray").into(),
    };
    bench(&program).map_err(|error| {
        format!("POV-Ray 3.8 does not run ({error}); `tools/povray38 target/povray38` installs it")
    })
});

fn bench(povray: &OsStr) -> Result<Bench, String> {
    let povray = Renderer::povray(povray).map_err(|error| error.to_string())?;
    let program = support::renderer();
    let povr = Renderer::new(&program)
        .map_err(|why| CheckError::NotStarted(program.display().to_string(), why.to_string()));
    let folder = |name| support::scratch(name).map_err(|error| error.to_string());
    Ok(Bench {
        povray,
        povr: povr.map_err(|error| error.to_string())?,
        size: SIZE,
        switches: Vec::new(),
        root: support::SCENES.into(),
        references: folder("parity/reference")?,
        pictures: folder("parity/actual")?,
        limit: TIME_LIMIT,
        thresholds: None,
    })
}

fn seen_in(sheet: &Path, saved: Result<(), impl Display>) -> String {
    match saved {
        Ok(()) => format!("\nexpected | difference | actual: {}", sheet.display()),
        Err(error) => format!("\n{} cannot be written: {error}", sheet.display()),
    }
}
