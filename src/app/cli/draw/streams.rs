//! Message files: `+GDfile` and related switches, `Debug_File` and related options.
//!
//! POV-Ray sorts its messages into streams, and each may go to a file as well as to the console. The files are created
//! anew for each run; a banner separates the frames of an animation, except in the `#debug` output (measured with
//! POV-Ray 3.7). `#debug` output is written as in POV-Ray; findings have the format of POV-Ray's files, in this
//! program's words; statistics are this program's own.

use crate::app::cli::options::error::CliError;
use crate::app::cli::options::output_kinds::Stream;
use crate::app::cli::options::settings::{Scene, Settings};
use crate::base::options::{Method, Sampling};
use crate::base::source::{Message, Severity};
use crate::output::{DitherMethod, EncodeOptions, Format, POVRAY_QUALITY, Target};
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Maximum length of the lines of findings.
const WIDTH: usize = 79;

const RULE: &str = "----------------------------------------------------------------------------";

const BANNER: &str = "
==============================================================================
=                       Appending to stream output file                      =
==============================================================================

";

/// The files of a run.
#[derive(Debug, Default)]
pub(crate) struct Files {
    files: Vec<(Stream, Mutex<File>)>,
}

impl Files {
    /// Creates the files anew.
    ///
    /// # Errors
    /// When one cannot be created.
    pub(crate) fn create(wanted: &[(Stream, PathBuf)]) -> Result<Self, CliError> {
        let mut files = Vec::new();
        for (stream, path) in wanted {
            let file = File::create(path).map_err(|error| {
                CliError::new(format!("cannot write `{}`: {error}", path.display()))
                    .with_hint("Name a file in a folder that exists and may be written.")
            })?;
            files.push((*stream, Mutex::new(file)));
        }
        Ok(Files { files })
    }

    /// Announces a frame other than the first.
    pub(crate) fn next_frame(&self) {
        for (stream, file) in &self.files {
            if *stream != Stream::Debug {
                put(file, BANNER);
            }
        }
    }

    /// Writes text to a stream.
    pub(crate) fn write(&self, stream: Stream, text: &str) {
        for (kind, file) in &self.files {
            if *kind == stream || *kind == Stream::All {
                put(file, text);
            }
        }
    }

    /// Writes a finding.
    pub(crate) fn write_finding(&self, message: &Message) {
        if self.files.is_empty() {
            return;
        }
        let (stream, kind) = match message.severity {
            Severity::Error => (Stream::Fatal, "Error"),
            Severity::Warning => (Stream::Warning, "Warning"),
        };
        let position = message.location.as_ref();
        let position = position.map_or_else(String::new, |position| {
            format!("File: {}  Line: {}\n", position.file, position.line)
        });
        let text = wrapped(&format!("Parse {kind}: {}", message.message));
        self.write(stream, &format!("{position}{text}\n"));
    }

    /// Writes the scene and the render options.
    pub(crate) fn begin(&self, settings: &Settings, picture: Option<&Target>) {
        if !self.files.is_empty() {
            let what = drawn_what(settings, picture);
            let text = format!("{what}{RULE}\n{}", drawn_how(settings));
            self.write(Stream::Render, &text);
        }
    }
}

/// A full disk is no reason to stop rendering.
fn put(file: &Mutex<File>, text: &str) {
    let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
    let _ = file.write_all(text.as_bytes());
}

/// The text wrapped into lines, all but the first with a leading blank.
fn wrapped(text: &str) -> String {
    let mut lines = String::new();
    let mut length = 0;
    for (at, word) in text.split_whitespace().enumerate() {
        let letters = word.chars().count();
        if at > 0 {
            let is_full = length + 1 + letters > WIDTH;
            lines.push_str(if is_full { "\n " } else { " " });
            length = if is_full { 1 } else { length + 1 };
        }
        lines.push_str(word);
        length += letters;
    }
    lines
}

/// The options of scene and picture as POV-Ray lists them, where they apply here. `picture` is the file of a frame.
pub(crate) fn drawn_what(settings: &Settings, picture: Option<&Target>) -> String {
    let scene = match &settings.scene {
        Scene::File(path) => path.display().to_string(),
        Scene::Stdin => "standard input".to_owned(),
    };
    let version = settings.read.version;
    let version = version.map(|version| format!(" (compatible to version {version:.2})"));
    let version = version.unwrap_or_default();
    let mut text = format!("Parser Options\n  Input file: {scene}{version}\n  Library paths:\n");
    for path in &settings.read.library_paths {
        text += &format!("    {}\n", path.display());
    }
    text += &animation(settings);
    let render = &settings.render;
    let (rows, columns) = (&render.rows, &render.columns);
    text += &format!(
        "Image Output Options\n  Image resolution.....{} by {} \
         (rows {} to {}, columns {} to {}).\n",
        render.width,
        render.height,
        rows.start + 1,
        rows.end,
        columns.start + 1,
        columns.end
    );
    let options = settings.output.as_ref().map(|(_, options)| options);
    text += &match (picture, options) {
        (Some(Target::File(path)), Some(options)) => {
            let name = path.display();
            format!("  Output file..........{name}, {}\n", encoding(options))
        }
        (Some(Target::Stdout), Some(options)) => {
            format!("  Output file..........stdout, {}\n", encoding(options))
        }
        _ => "  Output file: Disabled\n".to_owned(),
    };
    let continued = if settings.continues { "On " } else { "Off" };
    if let (Some(_), Some(options)) = (picture, options) {
        let dithering = options.dither.map_or("Off", dithering_name);
        text += &format!("  Dithering............{dithering}\n");
    }
    text += &format!(
        "  Graphic display......Off\n  Mosaic preview.......Off\n  Continued trace......{continued}\n"
    );
    text
}

/// POV-Ray's name of a method of dithering.
fn dithering_name(method: DitherMethod) -> &'static str {
    match method {
        DitherMethod::Bayer2 => "2x2 Bayer pattern",
        DitherMethod::Bayer3 => "3x3 Bayer pattern",
        DitherMethod::Bayer4 => "4x4 Bayer pattern",
        DitherMethod::BlueNoise => "Blue noise pattern",
        DitherMethod::BlueNoiseInverted => "Blue noise pattern (inverted for Red/Blue)",
        DitherMethod::Diffusion1D => "simple 1-D error diffusion",
        DitherMethod::Diffusion2D => "simple 2-D error diffusion",
        DitherMethod::FloydSteinberg => "Floyd-Steinberg error diffusion",
        DitherMethod::Atkinson => "Atkinson error diffusion",
        DitherMethod::Burkes => "Burkes error diffusion",
        DitherMethod::JarvisJudiceNinke => "Jarvis-Judice-Ninke error diffusion",
        DitherMethod::Sierra2 => "Two-row Sierra error diffusion",
        DitherMethod::Sierra3 => "Sierra error diffusion",
        DitherMethod::Stucki => "Stucki error diffusion",
    }
}

/// The clock of a still picture that has none, otherwise the options about frames, as given.
fn animation(settings: &Settings) -> String {
    if settings.frames.is_none() && settings.read.clock == 0.0 {
        return "  Clock value:    0.000  (Animation off)\n".to_owned();
    }
    let given = &settings.animation;
    let (first, last) = (given.initial_frame, given.final_frame);
    let cyclic = if given.is_cyclic { "On " } else { "Off" };
    format!(
        "Animation Options\n  Initial Frame: {:8}  Final Frame: {:8}\n  Frame Step:    {:8}\n  Initial Clock: {:8.3}  \
         Final Clock: {:8.3}\n  Cyclic Animation.....{cyclic}  Field render.........Off  Odd lines/frames.....Off\n",
        first.unwrap_or(1),
        last.unwrap_or(1),
        given.step,
        given.initial_clock,
        given.final_clock.unwrap_or(0.0),
    )
}

/// The encoding of the picture as POV-Ray names it: `24 bpp PNG`.
fn encoding(options: &EncodeOptions) -> String {
    let bits = u32::from(options.bits);
    let name = match options.format.name {
        "TGA" => "Targa",
        "compressed TGA" => "RLE Targa",
        name => name,
    };
    if options.format == Format::JPEG {
        let quality = match options.quality {
            0 => POVRAY_QUALITY,
            quality => quality,
        };
        return format!("24 bpp, quality {quality}% JPEG");
    }
    match (options.grayscale, options.alpha && options.format.has_alpha) {
        (true, _) if options.format.has_grey => format!("grayscale {name}"),
        (_, true) => format!("{} bpp with alpha {name}", 4 * bits),
        _ => format!("{} bpp {name}", 3 * bits),
    }
}

/// The render options as POV-Ray lists them.
pub(crate) fn drawn_how(settings: &Settings) -> String {
    let antialiasing = match &settings.render.sampling {
        Sampling::Centres => "Off".to_owned(),
        Sampling::Adaptive(_) => "On  (Method 4)".to_owned(),
        Sampling::PovRay(how) => {
            let method = match how.method {
                Method::One => 1,
                Method::Two => 2,
                Method::Three => 3,
            };
            let jitter = match how.jitter {
                0.0 => "Off".to_owned(),
                jitter => format!("{jitter:.2}"),
            };
            let (threshold, depth, gamma) = (how.threshold, how.depth, how.gamma);
            format!(
                "On  (Method {method}, Threshold {threshold:.3}, Depth {depth}, Jitter {jitter},\n Gamma {gamma:.2})"
            )
        }
    };
    let quality = settings.render.quality;
    format!("Render Options\n  Quality: {quality:2}\n  Antialiasing.........{antialiasing}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_findings_are_wrapped_as_by_povray() {
        let text = "Parse Warning: assumed_gamma not specified, so gamma_correction is turned off for compatibility with \
                    this pre POV-Ray 3.7 scene. See the documentation for more details.";
        assert_eq!(
            wrapped(text),
            "Parse Warning: assumed_gamma not specified, so gamma_correction is turned off\n for compatibility with \
             this pre POV-Ray 3.7 scene. See the documentation for\n more details."
        );
    }

    #[test]
    fn each_stream_has_its_file_and_all_have_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let wanted = [
            (Stream::Debug, path("debug")),
            (Stream::All, path("all")),
            (Stream::Warning, path("warning")),
        ];
        let files = Files::create(&wanted).unwrap();
        files.write(Stream::Debug, "one\n");
        files.next_frame();
        files.write(Stream::Statistics, "two\n");
        let read = |name: &str| std::fs::read_to_string(path(name)).unwrap();
        assert_eq!(read("debug"), "one\n");
        assert_eq!(read("all"), format!("one\n{BANNER}two\n"));
        assert_eq!(read("warning"), BANNER);
        assert!(Files::create(&[(Stream::All, path("none/all"))]).is_err());
    }
}
