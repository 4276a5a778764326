//! The commonest mistakes and the whole text that their author sees.
//!
//! Each `NAME.pov` here holds a mistake, `NAME.txt` what is said about it. `UPDATE=1` writes the texts anew, to be read
//! before they are kept: is the place right, is the cause named, is there something to do, is nothing said twice?

use libtest_mimic::{Arguments, Failed, Trial};
use povr::lang::evaluate;
use povr::options::ReadOptions;
use povr::source::Sources;
use povr::source::print::{Styling, annotated, pov_line};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Relative, so that it reads the same on every machine; cargo runs tests in the root of the package.
const FOLDER: &str = "tests/messages";

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let trials = match scenes() {
        Ok(scenes) => scenes.into_iter().map(trial).collect(),
        Err(error) => vec![Trial::test(FOLDER, move || Err(error.into()))],
    };
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn scenes() -> std::io::Result<Vec<PathBuf>> {
    let mut scenes = Vec::new();
    for entry in fs::read_dir(FOLDER)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "pov") {
            scenes.push(path);
        }
    }
    scenes.sort();
    Ok(scenes)
}

fn trial(scene: PathBuf) -> Trial {
    let name = scene
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    Trial::test(name, move || compare(&scene))
}

fn compare(scene: &Path) -> Result<(), Failed> {
    let kept = scene.with_extension("txt");
    let said = messages(scene)?;
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&kept, &said)?;
    }
    let expected = fs::read_to_string(&kept).unwrap_or_default();
    if said == expected {
        return Ok(());
    }
    Err(format!("expected\n{expected}\nfound\n{said}").into())
}

/// All findings, as POV-Ray's line and with the lines of the scene.
fn messages(scene: &Path) -> Result<String, Failed> {
    let library = Path::new(FOLDER).join("library");
    let mut sources = Sources::new(vec![library]);
    let file = sources.load_file(scene).map_err(|error| error.message)?;
    let reading = evaluate(file, &mut sources, &ReadOptions::default());
    let texts = reading.findings.iter().map(|finding| {
        let line = pov_line(finding, &sources);
        format!("{line}\n{}\n", annotated(finding, &sources, Styling::Plain))
    });
    Ok(texts.collect())
}
