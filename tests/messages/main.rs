//! The commonest mistakes, with the full text that their author sees and POV-Ray's own message.
//!
//! Each `NAME.pov` here holds a mistake and states its line first: `// mistake in line 3: ...`; with
//! `mistakes in lines 3, 7` for several, and `doubt in line 3` for a warning. All findings must refer to these lines,
//! whatever line POV-Ray names. `NAME.txt` holds the text of povr, and then POV-Ray's. `UPDATE=1` rewrites these texts;
//! read them before committing: is the position right, is the cause named, is there something to do, is nothing
//! repeated?

use povr::app::compare as process;

use libtest_mimic::{Arguments, Failed, Trial};
use povr::base::options::ReadOptions;
use povr::base::source::print::{Styling, annotated, pov_line};
use povr::base::source::{Diagnostic, Severity, Sources};
use povr::lang::evaluate;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Duration;

/// Relative, so that messages are the same on every machine; cargo runs tests in the root of the package.
const FOLDER: &str = "tests/messages";
/// POV-Ray needs half a second to start.
const TIME_LIMIT: Duration = Duration::from_secs(60);
/// POV-Ray spends most of its wall time asleep.
const TESTS_PER_PROCESSOR: usize = 8;

fn main() -> ExitCode {
    let mut arguments = Arguments::from_args();
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    arguments
        .test_threads
        .get_or_insert(TESTS_PER_PROCESSOR * processors);
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
    let stored = scene.with_extension("txt");
    let mistake = Mistake::of(scene)?;
    let ours = messages(scene, &mistake)?;
    let said = format!("{ours}{}\n", pov_ray(scene, &mistake)?);
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&stored, &said)?;
    }
    let expected = fs::read_to_string(&stored).unwrap_or_default();
    if said == expected {
        return Ok(());
    }
    Err(format!("expected\n{expected}\nfound\n{said}").into())
}

/// The mistake described in the first line of a scene.
struct Mistake {
    severity: Severity,
    lines: Vec<usize>,
}

impl Mistake {
    fn of(scene: &Path) -> Result<Self, Failed> {
        let text = fs::read_to_string(scene)?;
        let first = text.lines().next().unwrap_or_default();
        let header = first
            .strip_prefix("// ")
            .and_then(|header| header.split_once(':'));
        let (lines, _) = header.ok_or("the first line tells no place")?;
        let kind = lines.split(' ').next().unwrap_or_default();
        let severity = match kind {
            "mistake" | "mistakes" => Severity::Error,
            "doubt" | "doubts" => Severity::Warning,
            _ => return Err("neither a mistake nor a doubt is told".into()),
        };
        let numbers = lines.split(|c: char| !c.is_ascii_digit());
        Ok(Mistake {
            severity,
            lines: numbers.filter_map(|number| number.parse().ok()).collect(),
        })
    }
}

/// All findings, in POV-Ray's format and with the lines of the scene.
fn messages(scene: &Path, mistake: &Mistake) -> Result<String, Failed> {
    let library = Path::new(FOLDER).join("library");
    let mut sources = Sources::new(vec![library]);
    let file = sources.load_file(scene).map_err(|error| error.message)?;
    let reading = evaluate(file, &mut sources, &ReadOptions::default());
    let line = |finding: &Diagnostic| finding.span.map_or(0, |span| sources.line_column(span).0);
    let findings = || reading.findings.iter().chain(&reading.undrawn);
    let of_kind = |finding: &&Diagnostic| finding.severity == mistake.severity;
    let lines: Vec<usize> = findings().filter(of_kind).map(line).collect();
    if lines != mistake.lines {
        let stated = &mistake.lines;
        return Err(
            format!("the mistake is in {stated:?}, the findings are about {lines:?}").into(),
        );
    }
    let texts = findings().map(|finding| {
        let line = pov_line(finding, &sources);
        format!("{line}\n{}\n", annotated(finding, &sources, Styling::Plain))
    });
    Ok(texts.collect())
}

/// POV-Ray's message for a scene, and whether it names the line of the first mistake.
fn pov_ray(scene: &Path, mistake: &Mistake) -> Result<String, Failed> {
    let mut command = Command::new("povray");
    command.arg(format!("+I{}", scene.display())).args([
        &format!("+L{FOLDER}/library"),
        "-F",
        "-D",
        "+W4",
        "+H3",
    ]);
    let ended = process::run(&mut command, TIME_LIMIT)?;
    let failed = ended.status.is_none_or(|status| !status.success());
    let unfolded = unfolded(&ended.stderr);
    let word = |wanted: &str| {
        // Warnings of these appear with any scene that lacks them.
        let is_of_every_scene = |line: &str| {
            !failed
                && ["assumed_gamma", "#version "]
                    .iter()
                    .any(|word| line.contains(word))
        };
        let is_it = |line: &&&String| line.contains(wanted) && !is_of_every_scene(line);
        unfolded
            .iter()
            .collect::<Vec<_>>()
            .iter()
            .find(is_it)
            .map(|line| (*line).clone())
    };
    let said = match failed {
        true => word(": Parse Error: ").or_else(|| word("Parse Error: ")),
        false => word(": Parse Warning: ").or_else(|| word(": Possible Parse Error: ")),
    };
    let Some(said) = said else {
        return Ok("POV-Ray says nothing and draws it".to_owned());
    };
    let message = said.split_once("Error: ").or(said.split_once("Warning: "));
    let message = message.map_or("", |(_, message)| message.trim_end());
    let kind = if failed { "" } else { " and draws it" };
    let line: Option<usize> = said
        .split_once(" line ")
        .and_then(|(_, rest)| rest.split(':').next()?.parse().ok());
    Ok(match line {
        Some(line) if mistake.lines.first() == Some(&line) => {
            format!("POV-Ray says in the same line{kind}: {message}")
        }
        Some(line) => format!("POV-Ray says in line {line}{kind}: {message}"),
        None => format!("POV-Ray says without a line{kind}: {message}"),
    })
}

/// POV-Ray's messages without its line breaks at 80 columns; a line that begins with a blank continues the one before.
fn unfolded(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        match lines.last_mut() {
            Some(last) if line.starts_with(' ') => last.push_str(line),
            _ => lines.push(line.to_owned()),
        }
    }
    lines
}
