//! Reads the include files of Debian's packages: alone where POV-Ray can read them alone, and the others after the
//! file that they need.
//!
//! Files with an unsupported word are listed with that word, and must fail for just that: the list shrinks with each
//! word that is supported.

use povr::base::options::{Event, Input, ReadOptions};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The files that scenes include by their bare names.
const STANDARD: &str = "/usr/share/povray-3.7/include";
/// The files of the example scenes.
const EXAMPLES: &str = "/usr/share/doc/povray/examples";

/// Standard files that need another one before them.
const BEHIND: &[(&str, &str)] = &[
    ("shapes2.inc", "shapes.inc"),
    ("shapesq.inc", "shapes.inc"),
    ("skies.inc", "colors.inc"),
    ("stdcam.inc", "colors.inc"),
    ("stoneold.inc", "colors.inc"),
    ("stones.inc", "colors.inc"),
    ("stones1.inc", "colors.inc"),
    ("stones2.inc", "colors.inc"),
];

/// Files of examples that POV-Ray cannot read alone either: they use what their scenes declare.
const PARTS: &[&str] = &[
    "axisbox.inc",
    "chess.inc",
    "cloth.inc",
    "demo_common.inc",
    "demo_room.inc",
    "drums.inc",
    "local.inc",
    "makestacks.inc",
    "ntreal.inc",
    "pignorm.inc",
    "sample.inc",
    "shotxtr.inc",
    "stacks.inc",
    "stage_xy.inc",
    "stage_xz.inc",
    "table.inc",
    "teapot.inc",
    "teapot_sph.inc",
    "testobjs.inc",
    "vase1.inc",
    "vase2.inc",
];

/// Reads a scene that includes these files and ends; returns the first error.
fn first_error(names: &[&str], folders: &[&Path]) -> Option<String> {
    let includes: String = names
        .iter()
        .map(|name| format!("#include \"{name}\"\n"))
        .collect();
    let text = format!("#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n{includes}");
    let input = Input::Text {
        name: "includes.pov".to_owned(),
        text: text.into_bytes(),
    };
    let read = ReadOptions {
        library_paths: folders.iter().map(|folder| (*folder).to_owned()).collect(),
        ..ReadOptions::default()
    };
    let failure = povr::check(&input, &read, &|_: Event<'_>| {}).err()?;
    let error = failure.errors.first();
    Some(error.map_or("no error is told".to_owned(), |error| error.message.clone()))
}

/// The include files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            paths.append(&mut files(&path));
        } else if path
            .extension()
            .is_some_and(|extension| extension == "inc" || extension == "map")
        {
            paths.push(path);
        }
    }
    paths.sort();
    paths
}

/// A failure to read a file, with its name.
fn complaint(name: &str, error: Option<String>) -> Option<String> {
    error.map(|error| format!("{name}: {error}"))
}

/// Reads all the files, several in parallel, and reports the failures.
fn check(files: &[PathBuf], read: impl Fn(&Path) -> Option<String> + Sync) {
    let complaints = Mutex::new(Vec::new());
    let next = std::sync::atomic::AtomicUsize::new(0);
    std::thread::scope(|threads| {
        for _ in 0..4 {
            threads.spawn(|| {
                while let Some(file) =
                    files.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
                {
                    let name = file.file_name().unwrap_or_default().to_string_lossy();
                    if let Some(complaint) = complaint(&name, read(file)) {
                        complaints.lock().expect("no thread fails").push(complaint);
                    }
                }
            });
        }
    });
    let complaints = complaints.into_inner().expect("no thread fails");
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn standard_include_files_are_read() {
    let files = files(Path::new(STANDARD));
    assert!(
        files.len() >= 49,
        "povray-includes has 49 files, found {}",
        files.len()
    );
    check(&files, |file| {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let before = BEHIND.iter().find(|(file, _)| *file == name);
        let names: Vec<&str> = before
            .map(|(_, before)| *before)
            .into_iter()
            .chain([&*name])
            .collect();
        first_error(&names, &[Path::new(STANDARD)])
    });
}

#[test]
fn include_files_of_examples_are_read() {
    let mut files = files(Path::new(EXAMPLES));
    files.retain(|file| {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        !PARTS.contains(&&*name)
    });
    check(&files, |file| {
        let folder = file.parent().unwrap_or(Path::new("."));
        first_error(
            &[&file.display().to_string()],
            &[folder, Path::new(STANDARD)],
        )
    });
}
