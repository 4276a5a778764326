//! Reads every kind of broken scene of the whole-program tests: reading ends, with or without findings, and never
//! panics. `tools/fuzz_all` reads many more.

#[path = "../../tests/malformed/broken.rs"]
mod broken;
#[path = "../../tests/malformed/random.rs"]
pub(crate) mod random;

use super::evaluate;
use crate::base::options::ReadOptions;
use crate::base::source::{Message, Severity, Sources};
use random::Random;
use std::fs;
use std::path::{Path, PathBuf};

/// Number of scenes, about ten seconds of reading.
const SCENES: u64 = 2_000;
/// Token limit of loops and macros; the loops of the valid scenes end before.
const PATIENCE: u64 = 100_000;
/// Findings of each scene that are formatted as messages.
const MESSAGES: usize = 3;

fn scenes(folder: &Path, to: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the project's scenes are there")
        .map(|entry| entry.expect("a folder can be read").path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            scenes(&path, to);
        } else if path.extension().is_some_and(|ending| ending == "pov") {
            to.push(path);
        }
    }
}

#[test]
fn broken_scenes_are_read_to_an_end() {
    // Scenes nest up to the limits, so the stack is the one that reading always has.
    let reader = std::thread::Builder::new().stack_size(crate::STACK_BYTES);
    let read = reader.spawn(read_broken_scenes).expect("a thread");
    if let Err(panic) = read.join() {
        std::panic::resume_unwind(panic);
    }
}

fn read_broken_scenes() {
    let mut paths = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    scenes(&root.join("pov_scenes"), &mut paths);
    let good: Vec<Vec<u8>> = paths
        .iter()
        .map(|path| fs::read(path).expect("a scene can be read"))
        .collect();
    assert!(good.len() > 100);
    let options = ReadOptions {
        max_repeated_tokens: PATIENCE,
        ..ReadOptions::default()
    };
    let mut read = 0;
    for number in 0..SCENES {
        let at = usize::try_from(number).expect("few") % broken::KINDS.len();
        let (kind, damage) = broken::KINDS[at];
        let text = damage(&mut Random::new(number, kind), &good);
        let reading = std::panic::catch_unwind(|| {
            let mut sources = Sources::new(vec![root.join("pov_scenes/language/include")]);
            let file = sources.add_text("broken", &text);
            let reading = evaluate(file, &mut sources, &options);
            for finding in reading.findings.iter().take(MESSAGES) {
                assert!(!Message::new(finding, &sources).excerpt.is_empty());
            }
            reading
        });
        let shown = || String::from_utf8_lossy(&text).into_owned();
        let Ok(reading) = reading else {
            panic!("{kind} {number} ends in a panic:\n{}", shown());
        };
        let has_error = reading
            .findings
            .iter()
            .any(|finding| finding.severity == Severity::Error);
        assert_ne!(
            reading.scene.is_some(),
            has_error,
            "{kind} {number}:\n{}",
            shown()
        );
        read += u64::from(reading.scene.is_some());
    }
    assert!(read > SCENES / 20, "some scenes stay right: {read}");
}
