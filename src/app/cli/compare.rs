//! `povr compare`: compares scenes rendered by POV-Ray and by povr, or two pictures; reports as a table, as JSON, or as
//! a page.
//!
//! Thresholds and exit codes are those of OpenImageIO's `idiff`.

mod page;
mod row;
mod table;

use crate::app::cli::options::command_line;
use crate::app::page::escaped;
use std::fs;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use image::codecs::png::CompressionType;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

use self::page::About;
use self::row::Row;
use self::table::Total;
use super::Command;
use super::check::find_scenes;
use super::draw::report::say;
use super::options::arg_words;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::settings::Scene;
use super::options::values::duration;
use crate::app::compare::{self, Bench, Case, Renderer, Thresholds};
use crate::app::picture_file::png;
use crate::app::program;

pub(super) const COMMAND: Command = Command {
    name: "compare",
    about: "compare with POV-Ray's pictures, or two pictures",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Draws scenes with POV-Ray and with povr and compares the pictures; or compares two pictures.
#[derive(Debug, Parser)]
#[command(
    name = "povr compare",
    override_usage = "povr compare [OPTIONS] [+/-SWITCHES] SCENE.pov|FOLDER...\n       povr compare [OPTIONS] EXPECTED ACTUAL",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr compare scene.pov                   with POV-Ray's picture
  povr compare scenes --html report.html   all scenes of a folder, as a page
  povr compare a.png b.png                 two pictures",
    after_help = "\
Scenes are drawn at 160x120 without antialiasing unless switches or comments in them (`// size:`, `// switches:`) say \
otherwise; both renderers get the same switches and one thread. They PASS if at least 99.9 % of the pixels are equal and \
no channel is more than one step off, or by limits that a scene states (`// compare: channel<=2 pixels<=0.5% because \
\"...\"`); options like --fail override both. WARNING is a difference that is explained: by POV-Ray's minimum \
distances, or because POV-Ray's own picture is random: drawn again with its blocks in other orders it differs as much.
Pictures of unlike kinds are compared as the one with fewer bits; linear light counts as sRGB beside encoded values.
Exit code: 0 PASS, 1 WARNING, 2 FAILURE, 3 sizes differ, 4 a file cannot be read or a scene is not drawn; the command \
line at fault: 2."
)]
pub(super) struct CommandOptions {
    /// Pixels that differ by more than this share of full intensity fail: 0.01 or 2/255
    #[arg(long, value_name = "A", value_parser = share)]
    fail: Option<f64>,
    /// Percentage of pixels allowed to fail
    #[arg(long, value_name = "P", value_parser = percent)]
    failpercent: Option<f64>,
    /// No pixel may differ by more than this
    #[arg(long, value_name = "A", value_parser = share)]
    hardfail: Option<f64>,
    /// The same for warnings
    #[arg(long, value_name = "A", value_parser = share)]
    warn: Option<f64>,
    /// Percentage of pixels allowed to warn
    #[arg(long, value_name = "P", value_parser = percent)]
    warnpercent: Option<f64>,
    /// A pixel that differs by more than this warns
    #[arg(long, value_name = "A", value_parser = share)]
    hardwarn: Option<f64>,
    /// Write the report as one page
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Print one object a line instead of the table
    #[arg(long)]
    json: bool,
    /// Write expected | difference | actual here, of two pictures, as PNG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Save POV-Ray's pictures in this folder: later runs draw only what has changed
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
    /// The POV-Ray to compare with, 3.7 or 3.8 [default: povray]
    #[arg(long, value_name = "PROGRAM")]
    against: Option<String>,
    /// Time limit of a renderer for a scene [default: 60s]
    #[arg(long, value_name = "TIME", value_parser = |text: &str| duration(text, "--timeout"))]
    timeout: Option<Duration>,
    /// Scenes drawn side by side [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Largest side of pictures in the report, in pixels [default: 320]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..))]
    shown: Option<u32>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Size of pictures whose scenes request none.
const SIZE: (u32, u32) = (160, 120);
const PATIENCE: Duration = Duration::from_secs(60);
const SHOWN: u32 = 320;
/// Exit code for a file that is not a picture, as in `idiff`.
const UNREAD: u8 = 4;

/// The parsed command line.
#[derive(Debug, Default)]
struct Wanted {
    names: Vec<String>,
    switches: Vec<String>,
    thresholds: Option<Thresholds>,
    html: Option<PathBuf>,
    is_json: bool,
    output: Option<PathBuf>,
    keep: Option<PathBuf>,
    against: Option<String>,
    timeout: Option<Duration>,
    jobs: Option<u16>,
    shown: Option<u32>,
    is_quiet: bool,
}

fn run(arguments: &[String], _: &Environment) -> Result<ExitCode, CliError> {
    let wanted = match read_arguments(arguments)? {
        Ok(wanted) => wanted,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    if let Some(file) = &wanted.html {
        // Comparing may take hours, and the page comes last.
        let opened = fs::OpenOptions::new().create(true).append(true).open(file);
        opened.map_err(|error| unwritten(file, &error))?;
    }
    let is_scene = |name: &String| Path::new(name).is_dir() || arg_words::has_ending(name, ".pov");
    let (rows, about) = if wanted.names.iter().all(is_scene) {
        if wanted.output.is_some() {
            return Err(CliError::new("`--output` is for two pictures")
                .with_hint("Write the report of scenes with `--html report.html`."));
        }
        scenes(&wanted)?
    } else if let [expected, actual] = wanted.names.as_slice() {
        let output = wanted.output.as_ref().map(|file| file.to_string_lossy());
        if let Some(file) = output.filter(|file| !arg_words::has_ending(file, ".png")) {
            return Err(CliError::new(format!("`{file}` is no PNG file"))
                .with_hint("`--output` writes PNG: `--output beside.png`."));
        }
        match pictures(&wanted, expected, actual) {
            Ok(compared) => compared,
            Err(refusal) => {
                say(format_args!("povr: {refusal}"));
                return Ok(ExitCode::from(UNREAD));
            }
        }
    } else {
        return Err(
            CliError::new("expected scenes and folders, or two pictures").with_hint(
                "Write `povr compare scene.pov`, `povr compare folder` or `povr compare a.png b.png`.",
            ),
        );
    };
    write_report(&wanted, rows, &about)
}

fn unwritten(file: &Path, error: &std::io::Error) -> CliError {
    CliError::new(format!("cannot write `{}`: {error}", file.display()))
}

/// Sorts, writes the page, prints.
fn write_report(
    wanted: &Wanted,
    mut rows: Vec<Row>,
    about: &About<'_>,
) -> Result<ExitCode, CliError> {
    let order = |a: &Row, b: &Row| {
        let worst = b.badness().total_cmp(&a.badness());
        worst.then_with(|| a.name.cmp(&b.name))
    };
    rows.sort_by(order);
    let total = Total::of(&rows);
    if let Some(file) = &wanted.html {
        let page = page::html(&rows, &total, about);
        fs::write(file, page).map_err(|error| unwritten(file, &error))?;
    }
    let text = if wanted.is_json {
        table::json(&rows, &total)
    } else if wanted.is_quiet {
        String::new()
    } else {
        table::text(&rows, &total)
    };
    // A closed pipe is no reason to fail.
    let _ = std::io::stdout().write_all(text.as_bytes());
    Ok(ExitCode::from(total.exit_code()))
}

/// Parses the arguments; returns the help text if requested.
fn read_arguments(arguments: &[String]) -> Result<Result<Wanted, String>, CliError> {
    let mut wanted = Wanted::default();
    let mut rest = arguments;
    while let Some((first, others)) = rest.split_first() {
        if first == "--" {
            wanted.names.extend_from_slice(others);
            break;
        }
        let long = long_options::length::<CommandOptions>(rest);
        if long == 0 {
            wanted.word(first);
            rest = others;
            continue;
        }
        let (option, others) = rest.split_at(long);
        match command_line::parse::<CommandOptions>(option) {
            Ok(options) => wanted.set(options),
            Err(error) => return command_line::printed::<CommandOptions>(&error).map(Err),
        }
        rest = others;
    }
    if wanted.names.is_empty() {
        return Err(CliError::new("nothing is named to compare")
            .with_hint("Write `povr compare scene.pov`, or `povr compare --help`."));
    }
    Ok(Ok(wanted))
}

impl Wanted {
    /// A name, or a switch for both renderers. File names in switches are relative to here, wherever renderers run.
    fn word(&mut self, argument: &str) {
        let is_switch =
            argument.starts_with(['+', '-']) || arg_words::assignment(argument).is_some();
        if !is_switch && !arg_words::has_ending(argument, ".ini") && !argument.ends_with(']') {
            return self.names.push(argument.to_owned());
        }
        let absolute = |name: &str| match std::path::absolute(name) {
            Ok(path) => path.display().to_string(),
            Err(_) => name.to_owned(),
        };
        for word in arg_words::of_argument(argument) {
            let folder = word.strip_prefix("+L").or_else(|| word.strip_prefix("+l"));
            self.switches.push(match folder {
                Some(folder) => format!("+L{}", absolute(folder)),
                None if word.starts_with(['+', '-']) || word.contains('=') => word,
                None => absolute(&word),
            });
        }
    }

    fn set(&mut self, options: CommandOptions) {
        let given = [
            options.fail,
            options.failpercent,
            options.hardfail,
            options.warn,
            options.warnpercent,
            options.hardwarn,
        ];
        if given.iter().any(Option::is_some) {
            let set = self.thresholds.get_or_insert_default();
            let [fail, fail_percent, hard_fail, warn, warn_percent, hard_warn] = given;
            set.fail = fail.unwrap_or(set.fail);
            set.fail_percent = fail_percent.unwrap_or(set.fail_percent);
            set.hard_fail = hard_fail.unwrap_or(set.hard_fail);
            set.warn = warn.unwrap_or(set.warn);
            set.warn_percent = warn_percent.unwrap_or(set.warn_percent);
            set.hard_warn = hard_warn.unwrap_or(set.hard_warn);
        }
        self.html = options.html.or(self.html.take());
        self.output = options.output.or(self.output.take());
        self.keep = options.keep.or(self.keep.take());
        self.against = options.against.or(self.against.take());
        self.timeout = options.timeout.or(self.timeout);
        self.jobs = options.jobs.or(self.jobs);
        self.shown = options.shown.or(self.shown);
        self.is_json |= options.json;
        self.is_quiet |= options.quiet;
    }
}

/// Compares two pictures.
fn pictures<'a>(
    wanted: &Wanted,
    expected: &'a str,
    actual: &'a str,
) -> Result<(Vec<Row>, About<'a>), CliError> {
    let name = format!("{expected} {actual}");
    let side = wanted.shown.unwrap_or(SHOWN.max(4096));
    let (first, second) = (
        row::open(Path::new(expected))?,
        row::open(Path::new(actual))?,
    );
    let thresholds = wanted.thresholds.unwrap_or_default();
    let about = About {
        title: "povr compare",
        text: format!(
            "<code>{}</code> and <code>{}</code>",
            escaped(expected),
            escaped(actual)
        ),
        sides: (expected, actual),
    };
    let (first, second, compared) = match compare::pictures(&first, &second, &thresholds) {
        Ok((first, second, compared)) => (first, second, Ok(compared)),
        Err(mismatch) => (first, second, Err(mismatch)),
    };
    if let Some(file) = &wanted.output {
        let sheet = compare::side_by_side(&first, &second);
        fs::write(file, png(&sheet, CompressionType::Default))
            .map_err(|error| unwritten(file, &error))?;
    }
    let row = Row::of_pictures(&name, &first, &second, &compared, side);
    Ok((vec![row], about))
}

/// Compares all scenes named.
fn scenes(wanted: &Wanted) -> Result<(Vec<Row>, About<'static>), CliError> {
    let program = wanted.against.as_deref().unwrap_or("povray");
    let povray = Renderer::povray(program).map_err(|error| {
        CliError::new(format!("`{program}` does not run: {error}")).with_hint(
            "Install POV-Ray 3.7 (Debian: `apt-get install povray`), or name another with `--against`.",
        )
    })?;
    let own = program::start()
        .map_err(|error| CliError::new(format!("cannot find this program to run it: {error}")))?;
    let cannot = |what: &Path, error: &std::io::Error| {
        CliError::new(format!(
            "cannot make a folder in `{}`: {error}",
            what.display()
        ))
    };
    let scratch = tempfile::tempdir().map_err(|e| cannot(&std::env::temp_dir(), &e))?;
    let references = match &wanted.keep {
        Some(folder) => std::path::absolute(folder).map_err(|error| cannot(folder, &error))?,
        None => scratch.path().join("povray"),
    };
    let pictures = scratch.path().join("povr");
    for folder in [&references, &pictures] {
        std::fs::create_dir_all(folder).map_err(|error| cannot(folder, &error))?;
    }
    let mut lines = povray.version.lines();
    let version = lines.find(|line| line.starts_with("POV-Ray"));
    let version = version.unwrap_or_default().to_owned();
    let bench = Bench {
        povr: Renderer {
            program: own.into(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            switches: vec!["+WT1".to_owned()],
            includes: povray.includes.clone(),
        },
        povray,
        size: SIZE,
        switches: wanted.switches.clone(),
        root: PathBuf::from("/"),
        references,
        pictures,
        limit: wanted.timeout.unwrap_or(PATIENCE),
        thresholds: wanted.thresholds,
    };
    let (cases, mut rows) = cases(&wanted.names)?;
    let names = wanted.names.join(" ");
    let about = About {
        title: "povr beside POV-Ray",
        text: format!(
            "<code>povr compare {}</code>: same switches, one thread each. Differences in 1/255 \
             steps; times are wall-clock for the whole process, with other jobs running. {}",
            escaped(&[names, wanted.switches.join(" ")].join(" ")),
            escaped(&version)
        ),
        sides: ("POV-Ray", "povr"),
    };
    rows.extend(drawn(wanted, &bench, &cases)?);
    Ok((rows, about))
}

/// A case, and the folder that contains it and all files it reads.
type CaseInRoot = (Case, PathBuf);

/// The cases of all scenes named; a scene that cannot be read gets its row at once.
fn cases(names: &[String]) -> Result<(Vec<CaseInRoot>, Vec<Row>), CliError> {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    for name in names {
        let root = match Path::new(name) {
            path if path.is_dir() => path,
            path => path.parent().unwrap_or(Path::new("")),
        };
        for scene in find_scenes(std::slice::from_ref(name), &[])? {
            let Scene::File(path) = scene else { continue };
            let inside = path.strip_prefix(root).unwrap_or(&path);
            // Parts of scenes, not scenes.
            if inside
                .parent()
                .is_some_and(|folder| folder.ends_with("include"))
            {
                continue;
            }
            let called = inside.with_extension("").display().to_string();
            // A comment that only resembles one of ours must not prevent a comparison.
            match Case::of(&path, &called)
                .or_else(|_| Case::plain(&path, &called).map(|case| vec![case]))
            {
                Ok(of_scene) => {
                    let root = std::path::absolute(root).unwrap_or_else(|_| root.to_owned());
                    cases.extend(of_scene.into_iter().map(|case| (case, root.clone())));
                }
                Err(error) => rows.push(Row::unread(&called, error.to_string())),
            }
        }
    }
    Ok((cases, rows))
}

/// Renders and compares all cases, some in parallel.
fn drawn(wanted: &Wanted, bench: &Bench, cases: &[CaseInRoot]) -> Result<Vec<Row>, CliError> {
    let jobs = wanted.jobs.map_or_else(
        || std::thread::available_parallelism().map_or(1, usize::from),
        usize::from,
    );
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .build()
        .map_err(|error| CliError::new(format!("no threads to compare with: {error}")))?;
    let is_shown = !wanted.is_quiet && std::io::stderr().is_terminal();
    let bar = is_shown.then(|| {
        let bar = ProgressBar::new(cases.len() as u64);
        let style =
            ProgressStyle::with_template("{bar:30} {pos}/{len}  {elapsed}, {eta} to go  {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        bar
    });
    let side = wanted.shown.unwrap_or(SHOWN);
    let compared = |(case, root): &CaseInRoot| {
        if let Some(bar) = &bar {
            bar.set_message(case.name.clone());
        }
        let bench = Bench {
            root: root.clone(),
            ..bench.clone()
        };
        let row = Row::of_scene(&bench, case, side);
        if let Some(bar) = &bar {
            bar.inc(1);
        }
        row
    };
    let rows = pool.install(|| cases.par_iter().with_max_len(1).map(compared).collect());
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    Ok(rows)
}

/// A share of full intensity: `0.01`, or `2/255`.
fn share(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| *v >= 0.0);
    let value = match text.split_once('/') {
        Some((a, b)) => number(a)
            .zip(number(b).filter(|b| *b > 0.0))
            .map(|(a, b)| a / b),
        None => number(text),
    };
    value.ok_or_else(|| "a share of full intensity is written like 0.01 or 2/255".to_owned())
}

fn percent(text: &str) -> Result<f64, String> {
    let value = text.trim_end_matches('%').trim().parse().ok();
    value
        .filter(|v| (0.0..=100.0).contains(v))
        .ok_or_else(|| "a share of the pixels is 0 to 100 percent".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_numbers_or_fractions() {
        assert_eq!(share("0.25"), Ok(0.25));
        assert_eq!(share("2/255"), Ok(2.0 / 255.0));
        for text in ["", "x", "-1", "1/0", "1/x", "/", "NaN"] {
            assert!(share(text).is_err(), "{text}");
        }
        assert_eq!(percent("0.5%"), Ok(0.5));
        assert!(percent("101").is_err());
    }

    #[test]
    fn switches_go_to_both_and_names_are_compared() {
        let raw_args = [
            "a.pov",
            "+W320 +H240",
            "--fail",
            "1/255",
            "Declare=A=1",
            "-J",
            "--jobs=3",
            "dir",
        ];
        let wanted = read_arguments(&raw_args.map(str::to_owned))
            .unwrap()
            .unwrap();
        assert_eq!(wanted.names, ["a.pov", "dir"]);
        assert_eq!(wanted.switches, ["+W320", "+H240", "Declare=A=1", "-J"]);
        assert_eq!(
            (wanted.thresholds.unwrap().fail, wanted.jobs),
            (1.0 / 255.0, Some(3))
        );
    }
}
