//! Long options (clap) beside POV-Ray's switches, and `-o`.

use super::output_kinds::MessageFormat;
use super::raw_args::{Output, RawArgs};
use super::safety::{LimitOptions, SafetyOptions};
use super::values::{duration, error};
use crate::app::cli::{COMMANDS, HELP_TEMPLATE};
use crate::base::options::{RandomOrder, TMinRule};
use clap::{CommandFactory, Parser};
use std::str::FromStr;
use std::time::Duration;

/// Draws POV-Ray scenes.
#[derive(Debug, Parser)]
#[command(
    name = "povr",
    version,
    override_usage = "povr [OPTIONS] [+/-SWITCHES] [Key=Value] [FILE.ini[section]] SCENE.pov",
    help_template = HELP_TEMPLATE,
    before_help = "\
Examples:
  povr scene.pov +W800 +H600 +A0.3         POV-Ray's switches; draws scene.png
  povr scene.pov -o picture.exr --size 1920x1080
  povr scene.pov --error 0.5               sample until the error is small
  povr check scene.pov                     only say what is wrong with it",
    after_help = commands(),
    disable_version_flag = true
)]
pub(crate) struct LongOptions {
    /// Output file, in the format of its extension; `-`: standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT")]
    size: Option<Size>,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Format of errors and warnings: povray, human, short or json
    #[arg(long, value_name = "FORM", value_enum, hide_possible_values = true)]
    message_format: Option<MessageFormat>,
    /// Print statistics and timings
    #[arg(long)]
    stats: bool,
    /// Print them as one line of JSON
    #[arg(long)]
    json: bool,
    /// Sample until the estimated error of every pixel is at most E/255 (as +AM4 does with 1)
    #[arg(long, value_name = "E", value_parser = |text: &str| error(text, "--error"))]
    error: Option<f64>,
    /// Stop after this time with the best picture so far: 10s, 500ms, 2m
    #[arg(long, value_name = "TIME", value_parser = |text: &str| duration(text, "--time"))]
    time: Option<Duration>,
    /// Use POV-Ray's minimum and maximum distances, which drop very thin and very distant surfaces
    #[arg(long)]
    pov_distances: bool,
    /// Cut coincident faces in CSG cleanly, where POV-Ray leaves a skin
    #[arg(long)]
    clean_cuts: bool,
    /// Match POV-Ray's random numbers in large images too (one thread)
    #[arg(long)]
    pov_random: bool,
    #[command(flatten)]
    safety: SafetyOptions,
    #[command(flatten)]
    limits: LimitOptions,
    // Without a short form: `-V` is POV-Ray's.
    /// Print version
    #[arg(long, action = clap::ArgAction::Version)]
    version: Option<bool>,
}

/// The switches that people look for, in lines that fit a terminal of 80 columns.
pub(crate) const SWITCHES: &str = "\
POV-Ray's switches, upper or lower case; later ones win:
  SCENE.pov, +IFILE     the scene; - is standard input
  +OFILE                output file (extension added); +O- standard output
  +W800 +H600           size in pixels
  +FN +FN16 +FNg        PNG, with 16 bits, grey; +FT Targa, +FB BMP, +FP PPM,
                        +FJ JPEG, +FE EXR, +FH HDR, -F no file
  +UA                   keep the transparency of the background
  +Q9                   quality, 0 to 11
  +A0.3 +AM2 +R3 -J     antialiasing: threshold, method (4: see --error),
                        depth, jitter; -A off
  +SC +EC +SR +ER       first and last column and row: pixels from 1, or
                        shares like 0.25
  +LFOLDER              search includes here too
  +K0.5                 the clock
  +KFI1 +KFF30 +KC      an animation: first and last frame, cyclic; +KI0 +KF1
                        its clock, +SF +EF a part of it
  +C                    resume an interrupted render
  Declare=Name=1.5      declare a number before the scene
  +MV3.6 +HIFILE        language version, file to include first
  +WT4 +V -GA           threads, verbose, quiet
All options of POV-Ray's ini files work as Key=Value, here and in files.";

/// `320x240`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size(pub(crate) u32, pub(crate) u32);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Size, String> {
        let side = |text: &str| {
            text.parse()
                .ok()
                .filter(|side| (1..=1 << 20).contains(side))
        };
        text.split_once(['x', 'X', '×'])
            .and_then(|(width, height)| Some(Size(side(width)?, side(height)?)))
            .ok_or_else(|| "a size is written like 320x240".to_owned())
    }
}

/// Number of arguments, from the first on, that belong to an option of `CommandOptions`; 0 if the first is none.
pub(crate) fn length<CommandOptions: CommandFactory>(arguments: &[String]) -> usize {
    let Some(first) = arguments.first() else {
        return 0;
    };
    let takes_value = |is_it: &dyn Fn(&clap::Arg) -> bool| {
        CommandOptions::command()
            .get_arguments()
            .any(|a| is_it(a) && a.get_action().takes_values())
    };
    let takes_value = match first.strip_prefix("--") {
        Some(name) if name.contains('=') => false,
        Some(name) => takes_value(&|a| {
            let aliases = a.get_all_aliases().unwrap_or_default();
            a.get_long() == Some(name) || aliases.contains(&name)
        }),
        None if first == "-o" && takes_value(&|a| a.get_short() == Some('o')) => true,
        None if matches!(first.as_str(), "-h" | "-help" | "-version" | "-?") => false,
        None => return 0,
    };
    (1 + usize::from(takes_value)).min(arguments.len())
}

impl LongOptions {
    /// Sets the options given.
    pub(crate) fn set(self, raw_args: &mut RawArgs) {
        if let Some(output) = self.output {
            raw_args.output = Output::Exact(output);
            raw_args.to_file = true;
        }
        if let Some(Size(width, height)) = self.size {
            (raw_args.width, raw_args.height) = (width, height);
        }
        if let Some(threads) = self.threads {
            raw_args.threads = Some(usize::from(threads));
        }
        raw_args.message_format = self.message_format.or(raw_args.message_format);
        raw_args.quiet |= self.quiet;
        raw_args.silent |= self.quiet;
        raw_args.stats |= self.stats;
        raw_args.json |= self.json;
        if self.error.is_some() || self.time.is_some() {
            raw_args.error = self.error.or(raw_args.error);
            raw_args.time = self.time.or(raw_args.time);
            raw_args.converge();
        }
        if self.pov_distances {
            raw_args.least_distance = TMinRule::PovRay;
        }
        raw_args.safety.add(self.safety);
        raw_args.limits.add(self.limits);
        raw_args.has_clean_cuts |= self.clean_cuts;
        if self.pov_random {
            raw_args.random_order = RandomOrder::PovRay;
        }
    }
}

/// The whole command line for generated documentation: options, and commands with theirs.
pub(crate) fn everything() -> clap::Command {
    let commands = COMMANDS.iter().map(|command| {
        let options = (command.options)().about(command.about);
        options
            .name(command.name)
            .bin_name(format!("povr {}", command.name))
    });
    LongOptions::command()
        .disable_help_subcommand(true)
        .arg(
            clap::Arg::new("scene")
                .value_name("SCENE.pov")
                .value_hint(clap::ValueHint::FilePath)
                .num_args(0..),
        )
        .subcommands(commands)
}

/// The commands, for the help of the program: a line each.
fn commands() -> String {
    let lines = COMMANDS
        .iter()
        .map(|command| format!("  povr {:<18}{}\n", command.name, command.about));
    format!(
        "Commands, each with its own --help:\n{}\n{SWITCHES}",
        lines.collect::<String>()
    )
}
