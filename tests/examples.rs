//! Reads the example scenes of Debian's `povray-examples`: a scene may fail only for an unsupported word, or where
//! POV-Ray fails as well.
//!
//! The number of scenes that lack each word is written to `target/tmp/examples.txt`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

const EXAMPLES: &str = "/usr/share/doc/povray/examples";

/// Scenes that POV-Ray does not read either: they lack a file, or need a frame number.
const REFUSED: &[&str] = &[
    "advanced/cliche/cliche.pov",
    "incdemo/sort.pov",
    "portfolio/__empty.pov",
    "portfolio/allnormals.pov",
    "portfolio/allpatterns.pov",
    "portfolio/c_colors.pov",
    "portfolio/f_finish.pov",
    "portfolio/m_textures.pov",
    "portfolio/o_2shapes.pov",
    "portfolio/o_shapes_old.pov",
    "portfolio/p_skies.pov",
    "portfolio/p_textures.pov",
    "portfolio/p_woods.pov",
    "portfolio/t_1stones.pov",
    "portfolio/t_2stones.pov",
    "portfolio/t_metals.pov",
    "portfolio/t_stars.pov",
    "portfolio/t_textures.pov",
    "portfolio/t_woods.pov",
];

/// Copies a folder: scenes may write files beside them.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("the copy can be made");
    for entry in fs::read_dir(from).into_iter().flatten().flatten() {
        let (path, copied) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &copied);
        } else {
            fs::copy(&path, &copied).expect("the copy can be made");
        }
    }
}

fn scenes(folder: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            paths.append(&mut scenes(&path));
        } else if path.extension().is_some_and(|extension| extension == "pov") {
            paths.push(path);
        }
    }
    paths.sort();
    paths
}

/// The faults of a scene: unsupported words, and other messages.
#[derive(Default)]
struct Verdict {
    missing: Vec<String>,
    faults: Vec<String>,
}

fn verdict(scene: &Path) -> Verdict {
    let output = Command::new(env!("CARGO_BIN_EXE_povr"))
        .args(["check", "--message-format", "json", "+W80", "+H60"])
        .arg(scene)
        .current_dir(scene.parent().expect("a scene lies in a folder"))
        .output()
        .expect("povr can be run");
    let mut verdict = Verdict::default();
    let said = [output.stdout, output.stderr].concat();
    for line in String::from_utf8_lossy(&said).lines() {
        let Ok(said) = serde_json::from_str::<serde_json::Value>(line) else {
            continue;
        };
        if said["type"] != "finding" || said["severity"] != "error" {
            continue;
        }
        let message = said["message"].as_str().unwrap_or_default();
        match message.strip_suffix(" is not supported yet") {
            Some(word) if said["code"] == "not-built" => verdict.missing.push(word.to_owned()),
            _ => verdict
                .faults
                .push(format!("line {}: {message}", said["line"])),
        }
    }
    if !matches!(output.status.code(), Some(0 | 1)) {
        verdict.faults.push(format!("{}", output.status));
    }
    verdict.missing.sort();
    verdict.missing.dedup();
    verdict
}

#[test]
fn scenes_of_examples_are_read() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("examples");
    copy(Path::new(EXAMPLES), &folder);
    let scenes = scenes(&folder);
    assert!(scenes.len() >= 396, "povray-examples has 396 scenes");
    let verdicts = Mutex::new(BTreeMap::new());
    let next = AtomicUsize::new(0);
    std::thread::scope(|threads| {
        for _ in 0..4 {
            threads.spawn(|| {
                while let Some(scene) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let name = scene.strip_prefix(&folder).unwrap_or(scene);
                    let name = name.display().to_string();
                    let verdict = verdict(scene);
                    let mut verdicts = verdicts.lock().expect("no thread fails");
                    verdicts.insert(name, verdict);
                }
            });
        }
    });
    let verdicts = verdicts.into_inner().expect("no thread fails");
    fs::write(folder.with_extension("txt"), table(&verdicts)).expect("the table can be written");
    let mut wrong = Vec::new();
    for (name, verdict) in &verdicts {
        let is_refused = REFUSED.contains(&name.as_str());
        if is_refused && verdict.faults.is_empty() {
            wrong.push(format!("{name} is read, though POV-Ray refuses it"));
        } else if !is_refused && let Some(fault) = verdict.faults.first() {
            wrong.push(format!("{name}: {fault}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn table(verdicts: &BTreeMap<String, Verdict>) -> String {
    let is_right = |verdict: &&Verdict| verdict.faults.is_empty() && verdict.missing.is_empty();
    let refused = REFUSED.len();
    let right = verdicts.values().filter(is_right).count();
    let total = verdicts.len();
    let mut table = format!("{total} scenes, {right} right, {refused} refused by POV-Ray too\n");
    let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for verdict in verdicts.values() {
        for word in &verdict.missing {
            let count = counts.entry(word).or_default();
            count.0 += 1;
            count.1 += usize::from(verdict.missing.len() == 1 && verdict.faults.is_empty());
        }
    }
    let mut rows: Vec<_> = counts.into_iter().collect();
    rows.sort_by_key(|(_, (scenes, _))| std::cmp::Reverse(*scenes));
    table.push_str("scenes  lack nothing else  word\n");
    for (word, (scenes, alone)) in rows {
        table.push_str(&format!("{scenes:6}  {alone:17}  {word}\n"));
    }
    table
}
