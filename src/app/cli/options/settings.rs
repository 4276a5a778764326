//! What is to be done, decided from what was typed.

use std::env;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::environment::Environment;
use super::error::CliError;
use super::ini::neighbour;
use super::raw_args::{Output, RawArgs};
use super::values::{format_of_ending, has_grey};
use crate::app::cli::draw::frames::Frames;
use crate::app::cli::draw::report::MessageFormat;
use crate::app::cli::draw::streams::Stream;
use crate::base::options::{
    Adaptive, Antialias, CancelToken, ReadOptions, RenderOptions, Sampling,
};
use crate::output::{EncodeOptions, Format, Target};

/// The most pixels of a picture: a film of 8 GiB.
const MOST_PIXELS: u64 = 1 << 29;

/// A whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The scene.
    pub scene: Scene,
    /// How to read it.
    pub read: ReadOptions,
    /// How to draw it.
    pub render: RenderOptions,
    /// The frames of an animation; `None` for a still picture.
    pub frames: Option<Frames>,
    /// Whether to go on with an unfinished picture.
    pub continues: bool,
    /// Where the picture goes and how; `None` draws it without keeping it. The working space is the scene's to tell.
    pub output: Option<(Target, EncodeOptions)>,
    /// What is said on the way.
    pub talk: Talk,
    /// Files for what is said, one for each stream.
    pub streams: Vec<(Stream, PathBuf)>,
    /// Doubts about the command line, each ready to print.
    pub warnings: Vec<String>,
    /// Options without effect, each ready to print in verbose mode.
    pub notes: Vec<String>,
}

/// The scene a run is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scene {
    /// A file that was found.
    File(PathBuf),
    /// Standard input.
    Stdin,
}

/// What is printed besides errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Talk {
    /// Warnings.
    pub warnings: bool,
    /// What the scene writes by `#debug`.
    pub debugs: bool,
    /// The form of errors and warnings.
    pub format: MessageFormat,
    /// Progress lines and notes.
    pub verbose: bool,
    /// Nothing but errors.
    pub quiet: bool,
    /// Not even what POV-Ray's console shows under `-GA`.
    pub is_silent: bool,
    /// On POV-Ray's console: the options of the drawing,
    pub renders: bool,
    /// and its times.
    pub statistics: bool,
    /// Statistics.
    pub stats: bool,
    /// The same as an object in a line.
    pub json: bool,
    /// Set if people read standard error: a bar of progress, and a line about the picture at the end.
    pub is_terminal: bool,
    /// Set if all that POV-Ray's console shows is to be printed in its form.
    pub is_povray: bool,
}

/// Decides. `command` is the one to name in a remedy: `povr`, or `povr watch`.
pub(crate) fn settle(
    typed: RawArgs,
    standard_folders: &[PathBuf],
    around: &Environment,
    command: &str,
) -> Result<Settings, CliError> {
    if let Some((unbuilt, said)) = typed.unbuilt.first() {
        let (what, instead) = unbuilt.refusal();
        return Err(CliError::new(format!("`{said}`: {what}")).with_hint(instead));
    }
    let mut warnings = typed.doubts.clone();
    let render = render_options(&typed)?;
    let name = typed.scene.clone().ok_or_else(|| {
        CliError::new("no scene is named").with_hint(format!(
            "write `{command} scene.pov`, or `{command} --help`"
        ))
    })?;
    let output = output(&typed, &name, &mut warnings)?;
    let frames = Frames::of(&typed.frames);
    if frames.is_some() && typed.continues {
        return Err(
            CliError::new("`+C`: continuing an animation is not built yet")
                .with_hint("draw the frames that are missing: `+SF` is the first, `+EF` the last"),
        );
    }
    if frames.is_some_and(|frames| frames.is_single()) {
        warnings.push(
            "an animation of one frame has no step: its clock is `Initial_Clock` (in POV-Ray it is no number)".to_owned(),
        );
    }
    let library_paths = [typed.library_paths.as_slice(), standard_folders].concat();
    let scene = match name.as_str() {
        "-" => Scene::Stdin,
        name => Scene::File(find_scene(name, &library_paths)?),
    };
    Ok(Settings {
        scene,
        read: read_options(&typed, library_paths),
        render,
        continues: typed.continues,
        frames,
        output,
        talk: talk(&typed, around),
        streams: typed.streams.clone(),
        warnings: warnings
            .iter()
            .map(|doubt| format!("povr: warning: {doubt}"))
            .collect(),
        notes: typed
            .idle
            .iter()
            .map(|said| format!("povr: note: `{said}` has no effect here"))
            .collect(),
    })
}

fn talk(typed: &RawArgs, around: &Environment) -> Talk {
    let format = match typed.message_format {
        Some(format) => format,
        None if typed.has_console => MessageFormat::Povray,
        None => around.message_format(),
    };
    Talk {
        warnings: typed.warnings,
        debugs: typed.debugs,
        format,
        verbose: typed.verbose,
        quiet: typed.quiet,
        is_silent: typed.silent,
        renders: typed.renders,
        statistics: typed.statistics,
        stats: typed.stats,
        json: typed.json,
        is_terminal: around.is_terminal,
        is_povray: around.is_povray,
    }
}

/// What reading takes from what was typed.
pub(crate) fn read_options(typed: &RawArgs, library_paths: Vec<PathBuf>) -> ReadOptions {
    ReadOptions {
        library_paths,
        // As Debian's povray.conf has it.
        writable: vec![PathBuf::from("."), env::temp_dir()],
        declares: typed.declares.clone(),
        version: typed.version,
        include_header: typed.include_header.clone(),
        width: typed.width,
        height: typed.height,
        clock: typed.clock.unwrap_or(0.0),
        clock_on: typed.clock.is_some(),
        ..ReadOptions::default()
    }
}

fn render_options(typed: &RawArgs) -> Result<RenderOptions, CliError> {
    let (width, height) = (typed.width, typed.height);
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(CliError::new(format!(
            "a picture of {width} by {height} pixels is too large: the most is {MOST_PIXELS} pixels"
        )));
    }
    Ok(RenderOptions {
        width,
        height,
        columns: stretch("column", typed.start_column, typed.end_column, width)?,
        rows: stretch("row", typed.start_row, typed.end_row, height)?,
        quality: typed.quality,
        threads: typed.threads,
        alpha: typed.alpha,
        least_distance: typed.least_distance,
        random_order: typed.random_order,
        statistics: typed.stats || typed.json || typed.keeps_statistics(),
        sampling: sampling(typed),
        keep: None,
        only_for: None,
        stop: CancelToken::default(),
    })
}

fn sampling(typed: &RawArgs) -> Sampling {
    let jitter = if typed.is_jittered {
        typed.antialias.jitter
    } else {
        0.0
    };
    match typed.is_antialiased {
        false => Sampling::Centres,
        true if typed.converges => Sampling::Converging(Adaptive {
            error: match (typed.error, typed.time) {
                (Some(error), _) => error,
                // The smaller the better, as long as there is time.
                (None, Some(_)) => 0.0,
                (None, None) => Adaptive::default().error,
            },
            time: typed.time,
        }),
        true => Sampling::PovRay(Antialias {
            jitter,
            ..typed.antialias
        }),
    }
}

/// The pixels from a first to a last one, counted from 1, or given as shares of the side. A first one below 1 and a
/// last one up to 1 is a share. The share is in single precision, as in POV-Ray: `+ER0.9` of 30 rows ends with row 26.
fn stretch(
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
            "give a {what} from 1 to {side}, or a share of the picture between 0 and 1"
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

/// The scene's file: as named, with `.pov`, in the current folder or one of the library's.
pub(crate) fn find_scene(name: &str, folders: &[PathBuf]) -> Result<PathBuf, CliError> {
    let current = [PathBuf::new()];
    current
        .iter()
        .chain(folders)
        .flat_map(|folder| ["", ".pov", ".POV"].map(|end| folder.join(format!("{name}{end}"))))
        .find(|file| file.exists() && !file.is_dir())
        .ok_or_else(|| {
            let refusal = CliError::new(format!("cannot find the scene `{name}`"));
            if let Some(near) = neighbour(Path::new(name)) {
                return refusal.with_hint(format!("did you mean `{near}`?"));
            }
            let searched: Vec<_> = folders
                .iter()
                .map(|f| format!("`{}`", f.display()))
                .collect();
            let also = match searched.as_slice() {
                [] => String::new(),
                folders => format!(" and in {}", folders.join(", ")),
            };
            refusal.with_hint(format!("looked in the current folder{also}"))
        })
}

fn output(
    typed: &RawArgs,
    scene: &str,
    warnings: &mut Vec<String>,
) -> Result<Option<(Target, EncodeOptions)>, CliError> {
    if !typed.to_file {
        return Ok(None);
    }
    let format = format(typed)?;
    let target = match &typed.output {
        Output::Povray(name) | Output::Exact(name) if name == "-" => Target::Stdout,
        Output::Exact(name) => Target::File(exact_path(name, scene, format)),
        Output::Povray(name) => Target::File(povray_path(name, scene, format)),
        Output::Unnamed => Target::File(povray_path("", scene, format)),
    };
    let ending = format.extension();
    if typed.alpha && !format.has_alpha() {
        warnings.push(format!(
            "{ending} files have no alpha channel: it is left out"
        ));
    }
    if typed.grayscale && !has_grey(format) {
        warnings.push(format!(
            "{ending} files have no grey form: colours are written"
        ));
    }
    let default = EncodeOptions::new(format);
    let options = EncodeOptions {
        // POV-Ray's grey files have 16 bits, whatever else was said.
        bits: match typed.grayscale {
            true => 16,
            false => typed.bits.unwrap_or(default.bits),
        },
        grayscale: typed.grayscale,
        alpha: typed.alpha,
        file_gamma: typed.file_gamma,
        quality: typed.compression,
        ..default
    };
    Ok(Some((target, options)))
}

/// The type that was named, or that of the ending of a name given with `-o`, or PNG.
fn format(typed: &RawArgs) -> Result<Format, CliError> {
    match (&typed.output, typed.format) {
        (_, Some(format)) => Ok(format),
        (Output::Exact(name), None) => match ending(name) {
            Some(end) => format_of_ending(end).ok_or_else(|| {
                CliError::new(format!("no file type has the ending `.{end}` of `{name}`"))
                    .with_hint("end the name in .png, .jpg, .ppm, .tga, .bmp, .exr or .hdr, or choose a type with `+F`")
            }),
            None => Ok(Format::Png),
        },
        _ => Ok(Format::Png),
    }
}

fn ending(name: &str) -> Option<&str> {
    Path::new(name).extension()?.to_str()
}

/// Where `-o` writes: the very name, with an ending if it has none; in a folder, under the scene's name.
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

/// Where `+O` writes: the ending of the type is appended unless the name has just that. An empty name is the
/// scene's: beside the scene if nothing was said, in a folder that was named.
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
            let found = stretch("column", first, last, side);
            assert_eq!(found, Ok(expected), "{first:?} {last:?} of {side}");
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
            let refused = stretch("column", first, last, 40).unwrap_err().to_string();
            assert_eq!(
                refused,
                format!(
                    "the {end} column is {value}, of a picture of 40\n  hint: give a column from 1 to 40, or a share of the picture between 0 and 1"
                )
            );
        }
        assert!(stretch("row", Some(f32::NAN), None, 40).is_err());
    }

    /// Measured with povray 3.7.0.10.
    #[test]
    fn pictures_have_the_names_povray_gives_them() {
        for (name, scene, format, expected) in [
            ("", "s.pov", Format::Png, "s.png"),
            ("", "s", Format::Png, "s.png"),
            ("", "sub/t.pov", Format::Png, "sub/t.png"),
            ("", "a b.pov", Format::Jpeg, "a b.jpg"),
            ("sub/", "other/t.pov", Format::Png, "sub/t.png"),
            ("out", "sub/t.pov", Format::Png, "out.png"),
            ("out.png", "s.pov", Format::Png, "out.png"),
            ("out.jpg", "s.pov", Format::Png, "out.jpg.png"),
            ("out.png", "s.pov", Format::Jpeg, "out.png.jpg"),
            ("out.PNG", "s.pov", Format::Png, "out.PNG.png"),
            ("k.tga", "k.pov", Format::Png, "k.tga.png"),
            ("out.jpeg", "s.pov", Format::Jpeg, "out.jpeg.jpg"),
            ("a.b.c", "s.pov", Format::Png, "a.b.c.png"),
            (".png", "s.pov", Format::Png, "s.png"),
            ("d/.png", "s.pov", Format::Png, "d/s.png"),
            ("", "-", Format::Png, "stdin.png"),
        ] {
            assert_eq!(
                povray_path(name, scene, format),
                Path::new(expected),
                "{name}"
            );
        }
    }
}
