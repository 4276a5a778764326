//! The options as typed, before they are interpreted: every option's last value.

use super::safety::{LimitOptions, SafetyOptions};
use crate::base::options::{Antialias, RandomOrder, TMinRule};
use std::path::PathBuf;
use std::time::Duration;

use crate::app::cli::draw::frames::Wanted;
use crate::app::cli::options::output_kinds::MessageFormat;
use crate::app::cli::options::output_kinds::Stream;
use crate::base::color::Gamma;
use crate::output::{DitherMethod, Format};

/// The last value of every option that has a meaning here.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RawArgs {
    pub(crate) scene: Option<String>,
    pub(crate) output: Output,
    pub(crate) to_file: bool,
    /// `None` unless set.
    pub(crate) format: Option<Format>,
    pub(crate) bits: Option<u8>,
    pub(crate) grayscale: bool,
    pub(crate) alpha: bool,
    pub(crate) file_gamma: Option<Gamma>,
    pub(crate) compression: Option<u8>,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) start_column: Option<f32>,
    pub(crate) end_column: Option<f32>,
    pub(crate) start_row: Option<f32>,
    pub(crate) end_row: Option<f32>,
    pub(crate) quality: u8,
    pub(crate) threads: Option<usize>,
    pub(crate) library_paths: Vec<PathBuf>,
    /// Include folders for scenes of version 3.8 alone: those named, and those of the system.
    pub(crate) library_paths_of_3_8: Vec<PathBuf>,
    pub(crate) standard_folders_of_3_8: Vec<PathBuf>,
    pub(crate) declares: Vec<(String, f64)>,
    pub(crate) version: Option<f64>,
    pub(crate) include_header: Option<PathBuf>,
    /// True if the command line names it, which may name a pipe.
    pub(crate) is_header_by_user: bool,
    pub(crate) clock: Option<f64>,
    pub(crate) frames: Wanted,
    /// `None` unless set.
    pub(crate) verbose: Option<bool>,
    pub(crate) quiet: bool,
    /// By `--quiet`, which suppresses even the output that POV-Ray prints under `-GA`.
    pub(crate) silent: bool,
    pub(crate) warnings: bool,
    pub(crate) debugs: bool,
    pub(crate) errors: bool,
    /// Options and times on POV-Ray's console.
    pub(crate) renders: bool,
    pub(crate) statistics: bool,
    /// Files for messages.
    pub(crate) streams: Vec<(Stream, PathBuf)>,
    /// `None` unless set.
    pub(crate) message_format: Option<MessageFormat>,
    /// Set by any option about a console: the messages then have POV-Ray's form.
    pub(crate) has_console: bool,
    pub(crate) stats: bool,
    pub(crate) json: bool,
    pub(crate) least_distance: TMinRule,
    pub(crate) has_clean_cuts: bool,
    pub(crate) random_order: RandomOrder,
    /// True to continue from a checkpoint.
    pub(crate) continues: bool,
    pub(crate) is_antialiased: bool,
    pub(crate) is_jittered: bool,
    /// The method, if antialiasing is on.
    pub(crate) antialias: Antialias,
    /// True for adaptive sampling.
    pub(crate) converges: bool,
    /// The target error of adaptive sampling in steps of 1/255, and its time limit.
    pub(crate) error: Option<f64>,
    pub(crate) time: Option<Duration>,
    /// The files that scenes may use.
    pub(crate) safety: SafetyOptions,
    /// Limits on the whole process.
    pub(crate) limits: LimitOptions,
    /// Requested features that are not built, with the words that requested them. Removed by the opposite option.
    pub(crate) unbuilt: Vec<(Unbuilt, String)>,
    pub(crate) is_dithered: bool,
    /// The method of dithering, if it is named.
    pub(crate) dither: Option<DitherMethod>,
    /// True for a program that is called by the name of POV-Ray: what POV-Ray accepts is no error then.
    pub(crate) is_povray: bool,
    /// True while words of the command line are read, false for those of ini files.
    pub(crate) is_command_line: bool,
    /// The file that receives the options.
    pub(crate) create_ini: Option<PathBuf>,
    /// All options with their values in the order of reading, for that file.
    pub(crate) given: Vec<(&'static str, String)>,
    /// The programs of `Pre_Scene_Command` and its relatives; none is run.
    pub(crate) shellouts: Vec<Shellout>,
    /// Options that are known and have no effect, as typed.
    pub(crate) idle: Vec<String>,
    /// Warnings about assumptions made for doubtful values.
    pub(crate) doubts: Vec<String>,
}

/// A program that POV-Ray would run, if it were allowed to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shellout {
    /// Its name.
    pub(crate) program: String,
    /// True to run it for each frame, false to run it once.
    pub(crate) is_of_frames: bool,
}

/// The destination of the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// Not set: named after the scene.
    Unnamed,
    /// By `+O`: the type's ending is appended if it is missing. `-` is standard output.
    Povray(String),
    /// By `-o`: this very name, and it chooses the type unless `+F` did.
    Exact(String),
}

/// POV-Ray's features that this program does not have yet. Requesting one is an error: ignoring it would change the
/// picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unbuilt {
    Clockless,
    Fields,
    OddField,
    SavedRadiosity,
}

impl Default for RawArgs {
    fn default() -> Self {
        RawArgs {
            scene: None,
            output: Output::Unnamed,
            to_file: true,
            format: None,
            bits: None,
            grayscale: false,
            alpha: false,
            file_gamma: None,
            compression: None,
            width: 800,
            height: 600,
            start_column: None,
            end_column: None,
            start_row: None,
            end_row: None,
            quality: 9,
            threads: None,
            library_paths: Vec::new(),
            library_paths_of_3_8: Vec::new(),
            standard_folders_of_3_8: Vec::new(),
            declares: Vec::new(),
            version: None,
            include_header: None,
            is_header_by_user: false,
            clock: None,
            frames: Wanted::default(),
            verbose: None,
            quiet: false,
            silent: false,
            renders: true,
            statistics: true,
            warnings: true,
            debugs: true,
            errors: true,
            streams: Vec::new(),
            message_format: None,
            has_console: false,
            stats: false,
            json: false,
            least_distance: TMinRule::default(),
            has_clean_cuts: false,
            random_order: RandomOrder::default(),
            continues: false,
            is_antialiased: false,
            is_jittered: true,
            antialias: Antialias::default(),
            converges: false,
            error: None,
            time: None,
            safety: SafetyOptions::default(),
            limits: LimitOptions::default(),
            unbuilt: Vec::new(),
            is_dithered: false,
            dither: None,
            is_povray: false,
            is_command_line: false,
            create_ini: None,
            given: Vec::new(),
            shellouts: Vec::new(),
            idle: Vec::new(),
            doubts: Vec::new(),
        }
    }
}

impl RawArgs {
    /// Names the file of a stream; an empty name means none, and "yes" means POV-Ray's own name for it.
    pub(crate) fn stream(&mut self, stream: Stream, name: &str) {
        const YES: [&str; 4] = ["on", "true", "yes", "1"];
        self.streams.retain(|(other, _)| *other != stream);
        let is_yes = YES.iter().any(|yes| name.eq_ignore_ascii_case(yes));
        let name = if is_yes { stream.file() } else { name };
        if !name.is_empty() {
            self.streams.push((stream, PathBuf::from(name)));
        }
    }

    /// True if statistics go to a file.
    pub(crate) fn keeps_statistics(&self) -> bool {
        let mut streams = self.streams.iter();
        streams.any(|(stream, _)| matches!(stream, Stream::Statistics | Stream::All))
    }

    /// Chooses adaptive sampling.
    pub(crate) fn converge(&mut self) {
        self.is_antialiased = true;
        self.converges = true;
    }

    /// Records a request for an unbuilt feature, or its withdrawal.
    pub(crate) fn request(&mut self, what: Unbuilt, wanted: bool, word: &str) {
        self.unbuilt.retain(|(requested, _)| *requested != what);
        if wanted {
            self.unbuilt.push((what, word.to_owned()));
        }
    }
}

impl Unbuilt {
    /// The feature, and a workaround: the two halves of an error message.
    pub(crate) fn refusal(self) -> (&'static str, &'static str) {
        match self {
            Unbuilt::Clockless => (
                "animation by several cameras is not supported yet",
                "Leave `Clockless_Animation` out and move one camera with `clock`.",
            ),
            Unbuilt::Fields => (
                "rendering of fields is not supported yet",
                "Use `-UF` (or `Field_Render=off`).",
            ),
            Unbuilt::OddField => (
                "rendering of fields is not supported yet",
                "Use `-UO` (or `Odd_Field=off`).",
            ),
            Unbuilt::SavedRadiosity => (
                "radiosity files are not supported yet",
                "Use `-RFI` and `-RFO` (or leave `Radiosity_From_File` and `Radiosity_To_File` out).",
            ),
        }
    }
}
