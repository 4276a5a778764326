//! Broken and hostile scenes end in a message or a picture: never in a crash, a panic or a hang.
//!
//! `broken` damages the scenes of `pov_scenes/` at random from fixed seeds; `hostile` holds cases that random damage
//! would not produce: endless loops, deep nesting, huge numbers. A failing scene is stored in `target/malformed/`.

mod broken;
mod hostile;
mod random;
#[path = "../support/mod.rs"]
mod support;

use libtest_mimic::{Arguments, Failed, Trial};
use random::Random;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::sync::Arc;
use std::time::Duration;

/// No small scene needs this long, however broken.
const TIME_LIMIT: Duration = Duration::from_secs(20);
/// The address space a renderer may use, in KiB; the stack of its reader reserves half of it.
const MEMORY_LIMIT: u32 = 2 << 20;
/// Number of scenes for each kind of damage.
const VARIANTS: u64 = 16;
/// After this time a render stops by itself: loops that count for ever would end only after minutes.
const TIMEOUT: &str = "5s";

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let trials = match read_scenes() {
        Ok(scenes) => trials(&Arc::new(scenes)),
        Err(error) => vec![Trial::test("pov_scenes", move || Err(error.into()))],
    };
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn read_scenes() -> std::io::Result<Vec<Vec<u8>>> {
    let paths = support::scenes(Path::new(support::SCENES))?;
    paths.into_iter().map(fs::read).collect()
}

/// One test for each kind of damage, and one for each hostile scene.
fn trials(scenes: &Arc<Vec<Vec<u8>>>) -> Vec<Trial> {
    let broken = broken::KINDS.iter().map(|&(kind, damage)| {
        let scenes = Arc::clone(scenes);
        Trial::test(format!("broken/{kind}"), move || {
            let mut failures = Vec::new();
            for variant in 0..VARIANTS {
                let mut random = Random::new(variant, kind);
                let scene = damage(&mut random, &scenes);
                if let Err(failure) = check(&format!("{kind}-{variant}"), &scene) {
                    failures.push(failure);
                }
            }
            if failures.is_empty() {
                return Ok(());
            }
            Err(Failed::from(failures.join("\n")))
        })
    });
    let hostile = hostile::scenes().into_iter().map(|(name, scene)| {
        Trial::test(format!("hostile/{name}"), move || {
            Ok(check(name, scene.as_bytes())?)
        })
    });
    broken.chain(hostile).collect()
}

/// Renders a scene and checks how the run ends. The failure names the stored scene.
fn check(name: &str, scene: &[u8]) -> Result<(), String> {
    let failure = |what: String| format!("{name}: {what}");
    let folder = support::scratch("malformed").map_err(|error| failure(error.to_string()))?;
    let input = folder.join(format!("{name}.pov"));
    let picture = folder.join(format!("{name}.png"));
    fs::write(&input, scene).map_err(|error| failure(error.to_string()))?;
    judge(name, &folder, &picture)
        .map_err(|what| failure(format!("{what}; the scene is {}", input.display())))?;
    // A passing scene can be generated again from its seed.
    let _ = fs::remove_file(&input);
    Ok(())
}

fn judge(name: &str, folder: &Path, picture: &Path) -> Result<(), String> {
    let _ = fs::remove_file(picture);
    let mut command = Command::new("sh");
    command
        .current_dir(folder)
        .arg("-c")
        .arg(format!("ulimit -v {MEMORY_LIMIT}; exec \"$0\" \"$@\""))
        .arg(support::renderer())
        .args([&format!("+I{name}.pov"), &format!("+O{name}.png")])
        .args(["+W16", "+H12", "-D", "-A", "+WT2"])
        .args(["--timeout", TIMEOUT])
        // Each thread's stack and heap reserve address space, which is what the limit counts.
        .env("RAYON_NUM_THREADS", "2")
        .env("MALLOC_ARENA_MAX", "2");
    let ended = support::run(&mut command, TIME_LIMIT).map_err(|error| error.to_string())?;
    // POV-Ray breaks its messages at 80 columns, anywhere between words.
    let words: Vec<_> = ended.stderr.split_whitespace().collect();
    let said = words.join(" ");
    if said.contains("panicked at") {
        return Err(format!("panic: {}", last(&said)));
    }
    match ended.status {
        None => Err(format!("it ran for more than {TIME_LIMIT:?}")),
        Some(status) => match status.code() {
            Some(0) => image::open(picture)
                .map(|_| ())
                .map_err(|error| format!("exit 0 without a picture: {error}")),
            Some(1) if said.contains("File '") && said.contains("Parse Error:") => Ok(()),
            Some(1) if said.contains(&format!("this took longer than {TIMEOUT}")) => Ok(()),
            Some(1) => Err(format!("exit 1 without a parse error: {}", last(&said))),
            _ => Err(format!("it ended with {status}: {}", last(&said))),
        },
    }
    .inspect(|()| {
        let _ = fs::remove_file(picture);
    })
}

/// The end of a message that may be very long.
fn last(said: &str) -> String {
    let letters: Vec<char> = said.chars().collect();
    letters[letters.len().saturating_sub(300)..]
        .iter()
        .collect()
}
