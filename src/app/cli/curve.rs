//! `povr curve`: renders a scene with many settings and reports error against run time.

use crate::app::cli::options::command_line;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};

use super::Command;
use super::draw::limits::{Limits, Watch};
use super::draw::report::{Reporter, Stream, say};
use super::draw::{Request, request, request_of};
use super::kernel;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::settings::{Scene, Settings};
use crate::app::curve::{self, CurveError, Drawn, Family, Report, Setting, Step, Sweep, Task};
use crate::base::options::{CancelToken, Event, Input, RenderOptions, Sampling};

pub(super) const COMMAND: Command = Command {
    name: "curve",
    about: "draw with many settings: error against run time",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Draws a scene with many settings and reports error against run time.
#[derive(Debug, Parser)]
#[command(
    name = "povr curve",
    override_usage = "povr curve [OPTIONS] [+/-SWITCHES] [Key=Value] [FILE.ini[section]] SCENE",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr curve scene.pov                     writes scene-curve/index.html
  povr curve scene.pov +W320 +H240 --settings \"--error 1; +A0.1 +AM1 +R3\"",
    after_help = "\
POV-Ray's switches and ini files are accepted, except antialiasing switches: +W320 +H240, +LFOLDER, Declare=Name=1, ...
Written into the folder: index.html (all in one), curve.csv, curve.json, curve.svg, the pictures, and the \
reference image that they are measured against. Run again, it measures only what is missing. --timeout, --max-memory \
and --sandbox are limits of the whole run."
)]
struct CommandOptions {
    /// Folder for all files [default: SCENE-curve]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Settings to measure, switches each, divided by semicolons: "--error 1; +A0.1 +AM1 +R3"
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    settings: Option<String>,
    /// Measure POV-Ray itself too, with those of the settings that it knows
    #[arg(long)]
    povray: bool,
    /// Renders with each setting
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    runs: Option<u16>,
    /// Estimated error of the reference image, in steps of 1/255
    #[arg(long, value_name = "E")]
    truth: Option<f64>,
    /// Measure everything anew
    #[arg(long)]
    fresh: bool,
}

/// Default number of renderings for each setting.
const RUNS: u16 = 3;

/// The options beside the render switches.
#[derive(Debug, Default)]
struct Wanted {
    out: Option<PathBuf>,
    settings: Option<String>,
    has_povray: bool,
    runs: Option<u16>,
    truth: Option<f64>,
    is_fresh: bool,
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let (wanted, rest) = match read_arguments(arguments)? {
        Ok(read) => read,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let mut settings = match request_of("povr curve", &rest, environment)? {
        Request::Print(text) => {
            say(text.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
        Request::Draw(settings) => *settings,
    };
    let stop = CancelToken::default();
    let Some((report, folder)) = report_of(&wanted, &mut settings, environment, &stop)? else {
        return Ok(ExitCode::FAILURE);
    };
    if !settings.verbosity.quiet {
        say(summary(&report, &folder));
    }
    Ok(ExitCode::SUCCESS)
}

/// Measures as `povr curve` with these arguments, and returns the measurements. `stop` cancels it.
///
/// # Errors
/// When an option is wrong, the scene cannot be drawn, or a file cannot be written.
pub fn report(
    arguments: &[String],
    environment: &Environment,
    stop: &CancelToken,
) -> Result<Report, CliError> {
    let no_help = || CliError::new("expected a scene to measure");
    let (wanted, rest) = read_arguments(arguments)?.map_err(|_| no_help())?;
    let Request::Draw(mut settings) = request_of("povr curve", &rest, environment)? else {
        return Err(no_help());
    };
    let report = report_of(&wanted, &mut settings, environment, stop)?;
    let limit = || CliError::new("stopped at a limit of the run");
    report.map(|(report, _)| report).ok_or_else(limit)
}

/// The measurements, and the folder of their files; `None` if a limit was reached. `stop` cancels them.
fn report_of(
    wanted: &Wanted,
    settings: &mut Settings,
    environment: &Environment,
    stop: &CancelToken,
) -> Result<Option<(Report, PathBuf)>, CliError> {
    settings.read.stop = stop.clone();
    settings.render.stop = stop.clone();
    let settings = &*settings;
    let Scene::File(file) = &settings.scene else {
        return Err(CliError::new(
            "`povr curve` needs a scene file, not standard input",
        ));
    };
    if settings.is_sandboxed && wanted.has_povray {
        return Err(CliError::new("POV-Ray does not run in a sandbox")
            .with_hint("Leave `--povray` or `--sandbox` out."));
    }
    let sweep = sweep(wanted, settings, file, environment)?;
    if settings.is_sandboxed {
        // The sandbox allows no new folder outside of this one; without it, writing fails with a message.
        let _ = std::fs::create_dir_all(&sweep.folder);
        kernel::enter_to_draw(settings, Some(&sweep.folder));
    }
    let limits = Limits::new(settings.timeout, settings.max_memory);
    let messages = (settings.verbosity.format, Stream::Err);
    let watch = Watch::over_command(limits, Some(stop.clone()), messages);
    if wanted.is_fresh && sweep.folder.is_dir() {
        // Missing files need not be removed.
        let _ = std::fs::remove_file(sweep.folder.join("curve.json"));
        let _ = std::fs::remove_file(sweep.folder.join("truth.json"));
    }
    match measured(&sweep, settings, file) {
        Err(_) if watch.is_over() => Ok(None),
        report => Ok(Some((report?, sweep.folder))),
    }
}

/// The options of this command, and all other arguments.
fn read_arguments(arguments: &[String]) -> Result<Result<(Wanted, Vec<String>), String>, CliError> {
    let mut wanted = Wanted::default();
    let mut others = Vec::new();
    let mut rest = arguments;
    while let Some((first, behind)) = rest.split_first() {
        let is_own = first.split('=').next().is_some_and(|name| {
            [
                "--out",
                "--settings",
                "--povray",
                "--runs",
                "--truth",
                "--fresh",
                "--help",
                "-h",
            ]
            .contains(&name)
        });
        let length = if is_own {
            long_options::length::<CommandOptions>(rest)
        } else {
            0
        };
        if length == 0 {
            others.push(first.clone());
            rest = behind;
            continue;
        }
        let (option, behind) = rest.split_at(length);
        match command_line::parse::<CommandOptions>(option) {
            Ok(options) => {
                wanted.out = options.out.or(wanted.out);
                wanted.settings = options.settings.or(wanted.settings);
                wanted.has_povray |= options.povray;
                wanted.runs = options.runs.or(wanted.runs);
                wanted.truth = options.truth.or(wanted.truth);
                wanted.is_fresh |= options.fresh;
            }
            Err(error) => return command_line::printed::<CommandOptions>(&error).map(Err),
        }
        rest = behind;
    }
    Ok(Ok((wanted, others)))
}

/// The measurements to make.
fn sweep(
    wanted: &Wanted,
    settings: &Settings,
    file: &Path,
    environment: &Environment,
) -> Result<Sweep, CliError> {
    let list = match &wanted.settings {
        Some(list) => list.split(';').map(str::trim).map(str::to_owned).collect(),
        None => curve::USUAL
            .iter()
            .map(|&text| text.to_owned())
            .collect::<Vec<_>>(),
    };
    let mut chosen = Vec::new();
    for switches in list.iter().filter(|switches| !switches.is_empty()) {
        let setting = setting(switches, file, environment)?;
        let is_known = !matches!(setting.sampling, Sampling::Adaptive(_));
        let theirs = Setting {
            family: Family::PovRay,
            ..setting.clone()
        };
        chosen.push(setting);
        if wanted.has_povray && is_known {
            chosen.push(theirs);
        }
    }
    let folder = wanted.out.clone().unwrap_or_else(|| {
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        PathBuf::from(format!("{stem}-curve"))
    });
    let text = std::fs::read(file)
        .map_err(|error| CliError::new(format!("cannot read `{}`: {error}", file.display())))?;
    let mut hasher = DefaultHasher::new();
    (text, env!("CARGO_PKG_VERSION")).hash(&mut hasher);
    let render = RenderOptions {
        sampling: Sampling::Centres,
        ..settings.render.clone()
    };
    format!("{:?} {render:?}", settings.read).hash(&mut hasher);
    Ok(Sweep {
        scene: file.display().to_string(),
        key: format!("{:016x}", hasher.finish()),
        settings: chosen,
        runs: usize::from(wanted.runs.unwrap_or(RUNS)),
        povray: Task {
            scene: std::path::absolute(file).unwrap_or_else(|_| file.to_owned()),
            size: (settings.render.width, settings.render.height),
            library_paths: settings.read.library_paths.clone(),
            declares: settings.read.declares.clone(),
            threads: settings.render.threads.unwrap_or(1),
            stop: settings.render.stop.clone(),
        },
        truth_error: wanted.truth.unwrap_or(curve::ERROR),
        folder,
    })
}

/// Parses the switches of a setting like those of a rendering.
fn setting(switches: &str, file: &Path, environment: &Environment) -> Result<Setting, CliError> {
    let mut arguments: Vec<String> = switches.split_whitespace().map(str::to_owned).collect();
    arguments.push(format!("+I{}", file.display()));
    let Request::Draw(settings) = request(&arguments, environment)? else {
        return Err(CliError::new(format!("`{switches}` is not a setting"))
            .with_hint("Write switches of antialiasing, like `--error 1` or `+A0.3 +AM2 +R3`."));
    };
    let sampling = settings.render.sampling;
    Ok(Setting {
        family: match sampling {
            Sampling::Centres => Family::Centres,
            Sampling::PovRay(_) => Family::Grid,
            Sampling::Adaptive(_) => Family::Converging,
        },
        switches: switches.split_whitespace().collect::<Vec<_>>().join(" "),
        sampling,
    })
}

/// Measures, with a bar on a terminal and a line for each setting elsewhere.
fn measured(sweep: &Sweep, settings: &Settings, file: &Path) -> Result<Report, CliError> {
    let mut reporter = Reporter::new(settings.verbosity.format, Stream::Err);
    reporter.warns = false;
    reporter.debugs = false;
    let input = Input::File(file.to_owned());
    let draw = |sampling| {
        let render = RenderOptions {
            sampling,
            threads: Some(sweep.povray.threads),
            ..settings.render.clone()
        };
        let listen = |event: Event<'_>| reporter.report(event);
        match crate::draw(&input, &settings.read, &render, &listen) {
            Ok(picture) => Ok(Drawn::of(&picture)),
            Err(_) => Err(CurveError::new("the scene cannot be drawn")),
        }
    };
    let is_quiet = settings.verbosity.quiet;
    let bar = (!is_quiet && std::io::stderr().is_terminal()).then(|| {
        let bar = ProgressBar::new(sweep.settings.len() as u64 + 1);
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {elapsed}  {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(std::time::Duration::from_millis(200));
        bar
    });
    let report = sweep.run(&draw, &|step: Step<'_>| match &bar {
        Some(bar) => {
            bar.set_position(step.done as u64);
            bar.set_message(step.next.to_owned());
        }
        None if is_quiet => {}
        None => say(format_args!("{}/{}: {}", step.done, step.of, step.next)),
    });
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    report.map_err(|error| {
        let refusal = CliError::new(error.message);
        match error.hint {
            Some(hint) => refusal.with_hint(hint),
            None => refusal,
        }
    })
}

/// The table for people, and the path of the page.
fn summary(report: &Report, folder: &Path) -> String {
    let mut text = format!(
        "{:<34} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n",
        "setting", "CPU s", "wall s", "spp", "RMSE", "max", "99.9 %", "FLIP"
    );
    for m in &report.measured {
        let program = match m.family {
            Family::PovRay => "povray",
            _ => "povr",
        };
        text += &format!(
            "{:<34} {:>9.3} {:>9.3} {:>8.2} {:>8.5} {:>8.4} {:>8.4} {:>8.5}\n",
            format!("{program} {}", m.switches),
            m.processor.median,
            m.wall.median,
            m.samples_per_pixel,
            m.errors.rmse,
            m.errors.max,
            m.errors.p999,
            m.errors.flip
        );
    }
    let truth = &report.truth;
    text += &format!(
        "reference image: {:.0} samples per pixel, estimated error {:.5} (root mean square), {:.5} at most\n{}",
        truth.samples_per_pixel,
        truth.rms,
        truth.largest,
        folder.join("index.html").display()
    );
    text
}
