//! The settings of a run, derived from the options as typed.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::environment::Environment;
use super::error::{CliError, Stage};
use super::ini::neighbour;
use super::raw_args::{Output, RawArgs, Shellout};
use super::safety::LimitOptions;
use super::values::format_of_ending;
use crate::app::cli::draw::frames::{Frames, Wanted};
use crate::app::cli::options::output_kinds::MessageFormat;
use crate::app::cli::options::output_kinds::Stream;
use crate::base::color::Gamma;
use crate::base::options::{
    Adaptive, Antialias, CancelToken, ReadOptions, RenderOptions, Sampling,
};
use crate::output::{DitherMethod, Effort, EncodeOptions, Format, OptionsOf38, Target};

/// Upper limit of the pixels of a picture: a film of 8 GiB.
const MAX_PIXELS: u64 = 1 << 29;

/// The settings of a whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The scene.
    pub scene: Scene,
    /// Options for reading the scene.
    pub read: ReadOptions,
    /// Options for rendering.
    pub render: RenderOptions,
    /// Time after which the process ends.
    pub timeout: Option<Duration>,
    /// Memory of the process, in bytes, above which it ends.
    pub max_memory: Option<u64>,
    /// True if the scene is not trusted.
    pub is_sandboxed: bool,
    /// The frames of an animation; `None` for a still picture.
    pub frames: Option<Frames>,
    /// The options about frames, as given.
    pub(crate) animation: Wanted,
    /// True to continue from a checkpoint.
    pub continues: bool,
    /// Destination and encoding of the picture; `None` renders without storing it. The working colour space comes from
    /// the scene.
    pub output: Option<(Target, EncodeOptions)>,
    /// True if the options name the destination, on the command line or in an ini file.
    pub names_output: bool,
    /// The output for people and programs.
    pub verbosity: Verbosity,
    /// Files for messages, one for each stream.
    pub streams: Vec<(Stream, PathBuf)>,
    /// Warnings about the command line, ready to print.
    pub warnings: Vec<String>,
    /// The file that receives the options, with its text.
    pub created_ini: Option<(PathBuf, String)>,
    /// The programs that POV-Ray would say it does not run.
    pub(crate) shellouts: Vec<Shellout>,
    /// Options without effect, ready to print in verbose mode.
    pub notes: Vec<String>,
}

/// The scene of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scene {
    /// An existing file.
    File(PathBuf),
    /// Standard input.
    Stdin,
}

impl Scene {
    /// The path of a file.
    pub(crate) fn path(&self) -> Option<&Path> {
        match self {
            Scene::File(path) => Some(path),
            Scene::Stdin => None,
        }
    }
}

/// The output besides errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verbosity {
    /// Errors of the scene.
    pub errors: bool,
    /// Warnings.
    pub warnings: bool,
    /// The scene's `#debug` output.
    pub debugs: bool,
    /// The form of errors and warnings.
    pub format: MessageFormat,
    /// Progress lines and notes.
    pub verbose: bool,
    /// Nothing but errors.
    pub quiet: bool,
    /// Not even the output of POV-Ray's console under `-GA`.
    pub is_silent: bool,
    /// On POV-Ray's console: the render options,
    pub renders: bool,
    /// and the times.
    pub statistics: bool,
    /// Statistics.
    pub stats: bool,
    /// The same as an object in a line.
    pub json: bool,
    /// True if people read standard error: a progress bar, and a line about the picture at the end.
    pub is_terminal: bool,
    /// True to print all output of POV-Ray's console in its format.
    pub is_povray: bool,
}

/// Derives the settings. `command` is the one to name in hints: `povr`, or `povr watch`.
pub(crate) fn settle(
    raw_args: RawArgs,
    standard_folders: &[PathBuf],
    environment: &Environment,
    command: &str,
) -> Result<Settings, CliError> {
    let mut warnings = raw_args.doubts.clone();
    for (unbuilt, written) in &raw_args.unbuilt {
        let (what, instead) = unbuilt.refusal();
        let doubt = format!("`{written}`: {what}");
        if !raw_args.is_povray {
            return Err(CliError::new(doubt).with_hint(instead));
        }
        warnings.push(doubt);
    }
    let render = render_options(&raw_args)?;
    let name = raw_args.scene.clone().ok_or_else(|| {
        CliError::new("no scene is named")
            .with_hint(format!(
                "Write `{command} scene.pov`, or `{command} --help`."
            ))
            .at_stage(Stage::NoScene)
    })?;
    let output = output(&raw_args, &name, &mut warnings)?;
    let frames = Frames::of(&raw_args.frames);
    if frames.is_some() && raw_args.continues {
        return Err(
            CliError::new("`+C`: continuing an animation is not supported yet")
                .with_hint("Draw the frames that are missing: `+SF` is the first, `+EF` the last."),
        );
    }
    if frames.is_some_and(|frames| frames.is_single()) {
        warnings.push(
            "an animation of one frame has no step: its clock is `Initial_Clock` (in POV-Ray it is not a number)".to_owned(),
        );
    }
    let library_paths = [raw_args.library_paths.as_slice(), standard_folders].concat();
    let scene = match name.as_str() {
        "-" => Scene::Stdin,
        name => Scene::File(find_scene(name, &library_paths)?),
    };
    let limits = LimitOptions::of(&raw_args);
    Ok(Settings {
        read: read_options(&raw_args, library_paths, scene.path(), environment),
        scene,
        timeout: limits.timeout,
        max_memory: limits.max_memory,
        is_sandboxed: raw_args.safety.sandbox,
        render,
        continues: raw_args.continues,
        frames,
        animation: raw_args.frames,
        output,
        names_output: !matches!(raw_args.output, Output::Unnamed),
        verbosity: verbosity(&raw_args, environment),
        streams: raw_args.streams.clone(),
        warnings: warnings
            .iter()
            .map(|doubt| format!("povr: warning: {doubt}"))
            .collect(),
        created_ini: None,
        shellouts: raw_args.shellouts.clone(),
        notes: raw_args
            .idle
            .iter()
            .map(|written| format!("povr: note: `{written}` has no effect here"))
            .collect(),
    })
}

fn verbosity(raw_args: &RawArgs, environment: &Environment) -> Verbosity {
    let format = match raw_args.message_format {
        Some(format) => format,
        None if raw_args.has_console => MessageFormat::Povray,
        None => environment.message_format(),
    };
    Verbosity {
        errors: raw_args.errors,
        warnings: raw_args.warnings,
        debugs: raw_args.debugs,
        format,
        // POV-Ray's own ini file says so.
        verbose: raw_args.verbose.unwrap_or(environment.is_povray),
        quiet: raw_args.quiet,
        is_silent: raw_args.silent,
        renders: raw_args.renders,
        statistics: raw_args.statistics,
        stats: raw_args.stats,
        json: raw_args.json,
        is_terminal: environment.is_terminal,
        is_povray: environment.is_povray,
    }
}

/// The options for reading the scene `file`.
pub(crate) fn read_options(
    raw_args: &RawArgs,
    library_paths: Vec<PathBuf>,
    file: Option<&Path>,
    environment: &Environment,
) -> ReadOptions {
    let (safety, header) = (&raw_args.safety, raw_args.include_header.as_ref());
    let of_3_8 = paths_of_3_8(raw_args, &library_paths);
    let readable = if of_3_8.is_empty() {
        &library_paths
    } else {
        &of_3_8
    };
    ReadOptions {
        readable: safety.readable(file, readable, header),
        library_paths_of_3_8: of_3_8,
        writable: safety.writable(environment.conf.writable()),
        memory: LimitOptions::of(raw_args).max_memory,
        library_paths,
        declares: raw_args.declares.clone(),
        version: raw_args.version,
        include_header: raw_args.include_header.clone(),
        is_header_by_user: raw_args.is_header_by_user,
        width: raw_args.width,
        height: raw_args.height,
        clock: raw_args.clock.unwrap_or(0.0),
        clock_on: raw_args.clock.is_some(),
        ..ReadOptions::default()
    }
}

/// The folders for scenes of version 3.8: those of 3.8 stand between the named ones and the standard ones. Empty if there
/// are none of 3.8.
fn paths_of_3_8(raw_args: &RawArgs, library_paths: &[PathBuf]) -> Vec<PathBuf> {
    let own = [
        raw_args.library_paths_of_3_8.as_slice(),
        &raw_args.standard_folders_of_3_8,
    ]
    .concat();
    if own.is_empty() {
        return own;
    }
    let (named, standard) = library_paths.split_at(raw_args.library_paths.len());
    [named, &own, standard].concat()
}

fn render_options(raw_args: &RawArgs) -> Result<RenderOptions, CliError> {
    let (width, height) = (raw_args.width, raw_args.height);
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(CliError::new(format!(
            "a picture of {width} by {height} pixels is too large: the most is {MAX_PIXELS} pixels"
        )));
    }
    Ok(RenderOptions {
        width,
        height,
        columns: pixel_range("column", raw_args.start_column, raw_args.end_column, width)?,
        rows: pixel_range("row", raw_args.start_row, raw_args.end_row, height)?,
        quality: raw_args.quality,
        threads: raw_args.threads,
        alpha: raw_args.alpha,
        t_min_rule: raw_args.least_distance,
        has_clean_cuts: raw_args.has_clean_cuts,
        random_order: raw_args.random_order,
        statistics: raw_args.stats || raw_args.json || raw_args.keeps_statistics(),
        sampling: sampling(raw_args),
        checkpoint: None,
        target_format: None,
        stop: CancelToken::default(),
    })
}

fn sampling(raw_args: &RawArgs) -> Sampling {
    let jitter = if raw_args.is_jittered {
        raw_args.antialias.jitter
    } else {
        0.0
    };
    match raw_args.is_antialiased {
        false => Sampling::Centres,
        true if raw_args.converges => Sampling::Adaptive(Adaptive {
            error: match (raw_args.error, raw_args.time) {
                (Some(error), _) => error,
                // As small as the time allows.
                (None, Some(_)) => 0.0,
                (None, None) => Adaptive::default().error,
            },
            time: raw_args.time,
        }),
        true => Sampling::PovRay(Antialias {
            jitter,
            ..raw_args.antialias
        }),
    }
}

/// The pixels from a first to a last one, counted from 1, or given as shares of the side. A first value below 1 and a
/// last value up to 1 are shares. A share is in single precision, as in POV-Ray: `+ER0.9` of 30 rows ends with row 26.
fn pixel_range(
    what: &str,
    first: Option<f32>,
    last: Option<f32>,
    side: u32,
) -> Result<Range<u32>, CliError> {
    let share = |v: f32| (f64::from(v) * f64::from(side)).floor();
    let start = match first.unwrap_or(0.0) {
        v if v < 1.0 => share(v),
        v => f64::from(v).floor() - 1.0,
    };
    let end = match last.unwrap_or(1.0) {
        v if v <= 1.0 => share(v),
        v => f64::from(v).floor(),
    };
    let refuse = |end: &str, value: Option<f32>| {
        let value = value.unwrap_or_default();
        CliError::new(format!(
            "the {end} {what} is {value}, of a picture of {side}"
        ))
        .with_hint(format!(
            "Give a {what} from 1 to {side}, or a share of the picture between 0 and 1."
        ))
    };
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to lie between 0 and the side"
    )]
    let within =
        |v: f64, least: u32| Some(v as u32).filter(|&n| v >= 0.0 && (least..=side).contains(&n));
    let start = within(start, 0)
        .filter(|&start| start < side)
        .ok_or_else(|| refuse("first", first))?;
    let end = within(end, 1).ok_or_else(|| refuse("last", last))?;
    Ok(start..end.max(start))
}

/// The scene's file: as named, or with `.pov`, in the current folder or one of the library's.
pub(crate) fn find_scene(name: &str, folders: &[PathBuf]) -> Result<PathBuf, CliError> {
    let current = [PathBuf::new()];
    current
        .iter()
        .chain(folders)
        .flat_map(|folder| ["", ".pov", ".POV"].map(|end| folder.join(format!("{name}{end}"))))
        .find(|file| file.exists() && !file.is_dir())
        .ok_or_else(|| {
            let refusal =
                CliError::new(format!("cannot find the scene `{name}`")).at_stage(Stage::Scene);
            if let Some(near) = neighbour(Path::new(name)) {
                return refusal.with_hint(format!("Did you mean `{near}`?"));
            }
            let searched: Vec<_> = folders
                .iter()
                .map(|f| format!("`{}`", f.display()))
                .collect();
            let also = match searched.as_slice() {
                [] => String::new(),
                folders => format!(" and in {}", folders.join(", ")),
            };
            refusal.with_hint(format!("Looked in the current folder{also}."))
        })
}

fn output(
    raw_args: &RawArgs,
    scene: &str,
    warnings: &mut Vec<String>,
) -> Result<Option<(Target, EncodeOptions)>, CliError> {
    if !raw_args.to_file {
        return Ok(None);
    }
    let format = format(raw_args)?;
    let target = match &raw_args.output {
        Output::Povray(name) | Output::Exact(name) if name == "-" => Target::Stdout,
        Output::Exact(name) => Target::File(exact_path(name, scene, format)),
        Output::Povray(name) => Target::File(povray_path(name, scene, format)),
        Output::Unnamed => Target::File(povray_path("", scene, format)),
    };
    let ending = format.extension();
    if raw_args.alpha && !format.has_alpha {
        warnings.push(format!(
            "{ending} files have no alpha channel: it is left out"
        ));
    }
    if raw_args.grayscale && !format.has_grey {
        warnings.push(format!(
            "{ending} files have no grey form: colours are written"
        ));
    }
    let default = EncodeOptions::new(format);
    let bits = raw_args.bits.unwrap_or(default.bits);
    let is_ppm = format == Format::PPM;
    let dither = |default| {
        let method = raw_args.dither.unwrap_or(default);
        raw_args.is_dithered.then_some(method)
    };
    let of_3_8 = OptionsOf38 {
        bits: raw_args.grayscale.then_some(bits),
        file_gamma: match raw_args.file_gamma {
            // Whatever `File_Gamma` says, grey files of this format are linear.
            _ if is_ppm && raw_args.grayscale => Some(Gamma::LINEAR),
            None if is_ppm => Some(Gamma::Bt709),
            _ => None,
        },
        is_plain: is_ppm && raw_args.compression == Some(0),
        dither: dither(DitherMethod::BlueNoise),
    };
    let options = EncodeOptions {
        // The grey files of POV-Ray 3.7 have 16 bits, regardless of other options.
        bits: if raw_args.grayscale { 16 } else { bits },
        grayscale: raw_args.grayscale,
        alpha: raw_args.alpha,
        file_gamma: raw_args.file_gamma.unwrap_or(Gamma::Srgb),
        quality: raw_args.compression.unwrap_or(0),
        dither: dither(DitherMethod::FloydSteinberg),
        of_3_8,
        effort: match raw_args.is_povray {
            true => Effort::Balanced,
            false => Effort::Fastest,
        },
        ..default
    };
    Ok(Some((target, options)))
}

/// The type that is set, or the one for the ending of a name given with `-o`, or PNG.
fn format(raw_args: &RawArgs) -> Result<Format, CliError> {
    match (&raw_args.output, raw_args.format) {
        (_, Some(format)) => Ok(format),
        (Output::Exact(name), None) => match ending(name) {
            Some(end) => format_of_ending(end).ok_or_else(|| {
                CliError::new(format!("no file type has the ending `.{end}` of `{name}`"))
                    .with_hint("End the name in .png, .jpg, .ppm, .tga, .bmp, .exr or .hdr, or choose a type with `+F`.")
            }),
            None => Ok(Format::PNG),
        },
        _ => Ok(Format::PNG),
    }
}

fn ending(name: &str) -> Option<&str> {
    Path::new(name).extension()?.to_str()
}

/// The path for `-o`: the very name, with an ending if it has none; in a folder, the scene's name.
fn exact_path(name: &str, scene: &str, format: Format) -> PathBuf {
    let path = Path::new(name);
    if name.ends_with('/') || path.is_dir() {
        return path.join(format!("{}.{}", stem(scene), format.extension()));
    }
    match ending(name) {
        Some(_) => path.to_owned(),
        None => PathBuf::from(format!("{name}.{}", format.extension())),
    }
}

/// The path for `+O`: the ending of the type is appended unless the name already has it. An empty name is replaced by
/// the scene's: beside the scene by default, or in a folder that was named.
fn povray_path(name: &str, scene: &str, format: Format) -> PathBuf {
    let end = format!(".{}", format.extension());
    let bare = name.strip_suffix(&end).unwrap_or(name);
    let (folder, file) = bare
        .rsplit_once('/')
        .map_or(("", bare), |(folder, file)| (&bare[..=folder.len()], file));
    if !file.is_empty() {
        return PathBuf::from(format!("{bare}{end}"));
    }
    let file = format!("{}{end}", stem(scene));
    if folder.is_empty() {
        Path::new(scene).with_file_name(file)
    } else {
        Path::new(folder).join(file)
    }
}

/// The scene's name without folders and ending.
fn stem(scene: &str) -> String {
    match scene {
        "-" => "stdin".to_owned(),
        name => Path::new(name).file_stem().map_or_else(
            || "picture".to_owned(),
            |s| s.to_string_lossy().into_owned(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with povray 3.7.0.10 on pictures of 40 by 30 pixels.
    #[test]
    fn partial_pictures_end_where_those_of_povray_end() {
        for (first, last, side, expected) in [
            (None, None, 40, 0..40),
            (Some(5.0), Some(10.0), 40, 4..10),
            (Some(0.25), Some(0.75), 40, 10..30),
            (Some(0.1), Some(0.9), 30, 3..26),
            (Some(0.33), Some(0.67), 30, 9..20),
            (Some(0.33), Some(0.67), 40, 13..26),
            (Some(0.35), Some(0.7), 40, 13..27),
            (Some(0.7), Some(0.8), 30, 20..24),
            (Some(0.02), None, 40, 0..40),
            (Some(0.03), None, 40, 1..40),
            (Some(0.999), None, 40, 39..40),
            (Some(1.0), Some(1.0), 40, 0..40),
            (None, Some(0.9999), 40, 0..39),
            (Some(2.7), Some(2.7), 40, 1..2),
            (Some(0.0), None, 40, 0..40),
            (Some(40.0), None, 40, 39..40),
            (Some(10.0), Some(5.0), 40, 9..9),
            (Some(0.51), Some(0.52), 40, 20..20),
        ] {
            let range = pixel_range("column", first, last, side);
            assert_eq!(range, Ok(expected), "{first:?} {last:?} of {side}");
        }
    }

    #[test]
    fn a_part_outside_the_picture_is_refused() {
        for (first, last, end, value) in [
            (Some(41.0), None, "first", 41.0),
            (Some(-3.0), None, "first", -3.0),
            (None, Some(41.0), "last", 41.0),
            (None, Some(0.0), "last", 0.0),
            (None, Some(0.01), "last", 0.01),
        ] {
            let refused = pixel_range("column", first, last, 40)
                .unwrap_err()
                .to_string();
            assert_eq!(
                refused,
                format!(
                    "the {end} column is {value}, of a picture of 40\n  hint: Give a column from 1 to 40, or a share of the picture between 0 and 1."
                )
            );
        }
        assert!(pixel_range("row", Some(f32::NAN), None, 40).is_err());
    }

    /// Measured with povray 3.7.0.10.
    #[test]
    fn pictures_have_the_names_povray_gives_them() {
        for (name, scene, format, expected) in [
            ("", "s.pov", Format::PNG, "s.png"),
            ("", "s", Format::PNG, "s.png"),
            ("", "sub/t.pov", Format::PNG, "sub/t.png"),
            ("", "a b.pov", Format::JPEG, "a b.jpg"),
            ("sub/", "other/t.pov", Format::PNG, "sub/t.png"),
            ("out", "sub/t.pov", Format::PNG, "out.png"),
            ("out.png", "s.pov", Format::PNG, "out.png"),
            ("out.jpg", "s.pov", Format::PNG, "out.jpg.png"),
            ("out.png", "s.pov", Format::JPEG, "out.png.jpg"),
            ("out.PNG", "s.pov", Format::PNG, "out.PNG.png"),
            ("k.tga", "k.pov", Format::PNG, "k.tga.png"),
            ("out.jpeg", "s.pov", Format::JPEG, "out.jpeg.jpg"),
            ("a.b.c", "s.pov", Format::PNG, "a.b.c.png"),
            (".png", "s.pov", Format::PNG, "s.png"),
            ("d/.png", "s.pov", Format::PNG, "d/s.png"),
            ("", "-", Format::PNG, "stdin.png"),
        ] {
            assert_eq!(
                povray_path(name, scene, format),
                Path::new(expected),
                "{name}"
            );
        }
    }
}
