//! Reads broken scenes until something goes wrong: `cargo run -p povr-tools --bin fuzz -- NUMBER [SEED] [--draw]`
//!
//! The scenes are those of `pov_scenes/`, damaged by all the methods of `tests/malformed/broken.rs`. Each is read, its
//! findings are formatted as messages, and a scene that is still valid is lowered; `--draw` draws it too, very small. A
//! panic, more than ten seconds or more than a gibibyte is a failure, and the scene is stored in `target/fuzz/`. The
//! same SEED and number give the same scene. Exit code 1 after a failure.

#![allow(clippy::print_stdout, reason = "the output is the purpose")]

#[path = "../tests/malformed/broken.rs"]
mod broken;
#[path = "../tests/malformed/random.rs"]
mod random;

use povr::base::options::{ReadOptions, RenderOptions};
use povr::base::source::{Message, Severity, Sources};
use povr::lang::evaluate;
use povr::render::render;
use povr::world::compile;
use random::Random;
use std::fs;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::exit;
use std::sync::Mutex;
use std::thread;
use std::time::{Duration, Instant};

/// Token limit of loops and macros; the loops of the valid scenes end before.
const PATIENCE: u64 = 100_000;
/// Findings of each scene that are formatted as messages.
const MESSAGES: usize = 3;
/// Larger scenes are not lowered: that is not what is tested.
const MAX_OBJECTS: usize = 1_000;
const TIME_LIMIT: Duration = Duration::from_secs(10);
const MEMORY_LIMIT: u64 = 1 << 30;
/// The stack on which `povr` reads.
const STACK_BYTES: usize = 256 << 20;
/// Folder of failing scenes.
const FAILURES: &str = "target/fuzz";

/// The scene being read, for the thread that watches the time.
struct Work {
    name: String,
    text: Vec<u8>,
    since: Instant,
}

fn main() -> io::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<u64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(10_000);
    let seed = numbers.get(1).copied().unwrap_or(1);
    let draws = words.iter().any(|word| word == "--draw");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut good = Vec::new();
    find_scenes(&root.join("pov_scenes"), &mut good)?;
    let work: Mutex<Option<Work>> = Mutex::new(None);
    thread::scope(|scope| {
        scope.spawn(|| watch(&work));
        thread::Builder::new()
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, || run(count, seed, draws, &good, &work))
            .map(drop)
    })
}

/// All scenes below a folder, sorted.
fn find_scenes(folder: &Path, to: &mut Vec<Vec<u8>>) -> io::Result<()> {
    let mut entries: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder)? {
        entries.push(entry?.path());
    }
    entries.sort();
    for path in entries {
        if path.is_dir() {
            find_scenes(&path, to)?;
        } else if path.extension().is_some_and(|ending| ending == "pov") {
            to.push(fs::read(path)?);
        }
    }
    Ok(())
}

/// Reads the scenes and ends the program.
fn run(count: u64, seed: u64, draws: bool, good: &[Vec<u8>], work: &Mutex<Option<Work>>) {
    let (mut right, mut failures, mut slowest) = (0u64, 0u64, Duration::ZERO);
    let start = Instant::now();
    for number in 0..count {
        let at = usize::try_from(number).unwrap_or(0) % broken::KINDS.len();
        let (kind, damage) = broken::KINDS[at];
        let number = seed.wrapping_mul(1_000_003).wrapping_add(number);
        let text = damage(&mut Random::new(number, kind), good);
        let name = format!("{kind}-{number}");
        let since = Instant::now();
        set(
            work,
            Some(Work {
                name: name.clone(),
                text: text.clone(),
                since,
            }),
        );
        let ended = catch_unwind(AssertUnwindSafe(|| read(&text, draws)));
        set(work, None);
        slowest = slowest.max(since.elapsed());
        match ended {
            Ok(is_right) => right += u64::from(is_right),
            Err(_) => {
                failures += 1;
                keep(&name, &text, "panics");
            }
        }
        if number % 64 == 0 && resident() > MEMORY_LIMIT {
            failures += 1;
            keep(
                &name,
                &text,
                "or one of the 64 before it takes more memory than the limit",
            );
            break;
        }
    }
    println!(
        "{count} scenes of seed {seed}, {right} of them right, {failures} failures; {:.1?}, the slowest {slowest:.1?}, \
         memory {} MiB",
        start.elapsed(),
        resident() >> 20
    );
    exit(i32::from(failures > 0));
}

/// Reads a scene and processes it as far as allowed; true if it is valid.
fn read(text: &[u8], draws: bool) -> bool {
    let options = ReadOptions {
        max_repeated_tokens: PATIENCE,
        ..ReadOptions::default()
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("pov_scenes/language/include");
    let mut sources = Sources::new(vec![folder]);
    let file = sources.add_text("broken.pov", text);
    let reading = evaluate(file, &mut sources, &options);
    for finding in reading.findings.iter().take(MESSAGES) {
        assert!(!Message::new(finding, &sources).excerpt.is_empty());
    }
    let is_error = |severity| severity == Severity::Error;
    let has_error = reading
        .findings
        .iter()
        .any(|finding| is_error(finding.severity));
    assert_ne!(reading.scene.is_some(), has_error, "a scene or an error");
    let Some(scene) = reading.scene else {
        return false;
    };
    if scene.objects.len() <= MAX_OBJECTS {
        let options = RenderOptions {
            width: 8,
            height: 6,
            columns: 0..8,
            rows: 0..6,
            ..RenderOptions::default()
        };
        let world = compile(scene, &options);
        if draws {
            let film = render(&world, &options, None, &|_| {}).film;
            assert_eq!(film.pixels.len(), 48);
        }
    }
    true
}

/// Ends the run when a scene takes too long: its thread cannot be stopped.
fn watch(work: &Mutex<Option<Work>>) {
    loop {
        thread::sleep(Duration::from_millis(200));
        let work = work
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(work) = work
            .as_ref()
            .filter(|work| work.since.elapsed() > TIME_LIMIT)
        {
            keep(&work.name, &work.text, "takes longer than the limit");
            exit(1);
        }
    }
}

fn set(work: &Mutex<Option<Work>>, to: Option<Work>) {
    *work
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner) = to;
}

fn keep(name: &str, text: &[u8], what: &str) {
    let path = Path::new(FAILURES).join(format!("{name}.pov"));
    let saved = fs::create_dir_all(FAILURES).and_then(|()| fs::write(&path, text));
    match saved {
        Ok(()) => println!("{} {what}", path.display()),
        Err(error) => println!("{name} {what}, and could not be kept: {error}"),
    }
}

/// The memory of this process in bytes; 0 where the system does not report it.
fn resident() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kibibytes.unwrap_or(0) << 10
}
