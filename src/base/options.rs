//! Options and results of reading and rendering: plain types between the command line and the stages.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::base::color::Gamma;
use crate::base::encoding::{EncodeOptions, Rounding};
use crate::base::file::Folders;
use crate::base::film::{Film, Pixel};
use crate::base::source::{Dependency, Message, TextChange};

/// Progress events of reading and rendering.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// Text that the scene writes with `#debug`, `#render` or `#statistics`, to be printed unchanged.
    SceneOutput(&'a str),
    /// An error or warning about the scene, in the order of detection.
    Finding(&'a Message),
    /// The scene has been read, to its end or to the first error.
    Read {
        /// The files that were read or searched.
        dependencies: &'a [Dependency],
        /// True if the scene wrote files.
        wrote_files: bool,
    },
    /// Rendering resumes from a checkpoint with this number of pixels.
    Resumed(u64),
    /// The checkpoint is discarded: it is of another scene, other options or another program.
    CheckpointDiscarded,
    /// The checkpoint cannot be written.
    CheckpointFailed(std::io::ErrorKind),
    /// Rendering was cancelled, with this number of pixels in the checkpoint.
    Checkpointed(u64),
    /// Number of pixels finished since the last event of this kind. Sent from any thread.
    Drawn(u64),
    /// A part of the picture in the working space of the scene, row by row; a later one may replace it. Not sent for
    /// pictures of a target format. Sent from any thread.
    Tile {
        /// Its columns in the picture.
        columns: &'a Range<u32>,
        /// Its rows in the picture.
        rows: &'a Range<u32>,
        /// Its pixels.
        pixels: &'a [Pixel],
    },
}

/// Callback for progress events.
pub type EventHandler<'a> = dyn Fn(Event<'_>) + Sync + 'a;

/// Source of the scene's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// A file, as the user named it.
    File(PathBuf),
    /// A file with another text in place of its own: one that is being edited.
    Edited {
        /// The file, as the user named it.
        path: PathBuf,
        /// The text.
        text: Arc<String>,
        /// For the next version of a scene, the change of its text since the version that is given, if all are reported.
        change: Option<TextChange>,
    },
    /// A text in memory: standard input, a test, a Rust caller.
    Text {
        /// Its name in messages: "standard input".
        name: String,
        /// The undecoded text.
        text: Vec<u8>,
    },
}

/// Options of reading a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadOptions {
    /// Folders searched for included and other files after the current folder, in this order.
    pub library_paths: Vec<PathBuf>,
    /// The same while `#version` is 3.8; empty if they are no others.
    pub library_paths_of_3_8: Vec<PathBuf>,
    /// Folders in which a scene may read files.
    pub readable: Folders,
    /// Folders in which a scene may write files.
    pub writable: Folders,
    /// The destination of the files that a scene writes.
    pub writes: Writes,
    /// Names declared before the scene is read.
    pub declares: Vec<(String, f64)>,
    /// The language version in force at the start; `None` leaves it to the scene.
    pub version: Option<f64>,
    /// A file included before the scene.
    pub include_header: Option<PathBuf>,
    /// True if the user names it on the command line: it may then be a pipe.
    pub is_header_by_user: bool,
    /// `image_width`.
    pub width: u32,
    /// `image_height`.
    pub height: u32,
    /// `clock`.
    pub clock: f64,
    /// `clock_on`: true if the clock was set.
    pub clock_on: bool,
    /// `clock_delta`: the clock's step from frame to frame; 0 for a still picture.
    pub clock_delta: f64,
    /// `frame_number`; 0 for a still picture.
    pub frame_number: u32,
    /// `initial_frame`; 0 for a still picture.
    pub initial_frame: u32,
    /// `final_frame`; 0 for a still picture.
    pub final_frame: u32,
    /// `initial_clock`; 0 for a still picture.
    pub initial_clock: f64,
    /// `final_clock`; 0 for a still picture.
    pub final_clock: f64,
    /// Number of tokens that loops and macros may repeat before the scene is rejected as endless.
    pub max_repeated_tokens: u64,
    /// Memory limit of reading in bytes, if it is below the memory of the machine.
    pub memory: Option<u64>,
    /// True to note the statement of each object, for which they are read one by one.
    pub notes_objects: bool,
    /// True to report doubts about the scene as a whole, which cost time: see `lint`.
    pub lints: bool,
    /// The names of lints that are switched off.
    pub allowed_lints: Vec<String>,
    /// Cancels reading.
    #[serde(skip)]
    pub stop: CancelToken,
}

/// The destination of the files that a scene writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Writes {
    /// To disk.
    #[default]
    ToDisk,
    /// To memory, where the scene can read them; the disk does not change.
    InMemory,
}

/// A shared flag that cancels reading and rendering; clones share it.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Requests cancellation; from any thread.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// The flag itself, for a signal handler, which may do no more than set it.
    #[must_use]
    pub fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// Returns true if cancellation was requested.
    #[must_use]
    #[inline]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Options are equal whatever their cancel tokens.
impl PartialEq for CancelToken {
    fn eq(&self, _: &CancelToken) -> bool {
        true
    }
}

/// Some minutes of reading, which real scenes that grow hair or leaves take. A loop of ten tokens can run 160 million
/// times.
const MAX_REPEATED_TOKENS: u64 = 3_000_000_000;

/// Options of rendering.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RenderOptions {
    /// Pixels in a row of the whole picture.
    pub width: u32,
    /// Rows of the whole picture.
    pub height: u32,
    /// The columns to render, counted from 0. May be empty.
    pub columns: Range<u32>,
    /// The rows to render, counted from 0. May be empty.
    pub rows: Range<u32>,
    /// POV-Ray's quality, 0 to 11; 9 and above enable everything.
    pub quality: u8,
    /// Number of threads; `None` uses one per core.
    pub threads: Option<usize>,
    /// True if the transparency of the background is stored.
    pub alpha: bool,
    /// The rule for the smallest hit distance.
    pub t_min_rule: TMinRule,
    /// True if coincident faces in CSG are cut cleanly, where POV-Ray leaves a skin.
    pub has_clean_cuts: bool,
    /// The order in which pixels draw random numbers.
    pub random_order: RandomOrder,
    /// True to collect the statistics of the lowered scene ([`Plan`]).
    pub statistics: bool,
    /// Pixel sampling.
    pub sampling: Sampling,
    /// The checkpoint file, if one is used.
    pub checkpoint: Option<CheckpointOptions>,
    /// The only file format that the picture is needed for: data that it cannot hold may be omitted. `working` is
    /// ignored in favour of the scene's.
    pub target_format: Option<EncodeOptions>,
    /// Cancels rendering.
    #[serde(skip)]
    pub stop: CancelToken,
}

/// A checkpoint, from which a later run can resume. Adaptive sampling with a time limit writes none, because its result
/// depends on the speed of the machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CheckpointOptions {
    /// The file. It is never deleted automatically.
    pub file: PathBuf,
    /// True to resume from an existing file and to write checkpoints from the start. Otherwise an existing file is
    /// replaced as soon as rendering has taken two seconds.
    pub resume: bool,
    /// Identifies the build of the program, because others may render other pictures.
    pub build: String,
}

/// Methods of pixel sampling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Sampling {
    /// One ray through the centre of each pixel.
    #[default]
    Centres,
    /// POV-Ray's antialiasing.
    PovRay(Antialias),
    /// Adaptive sampling until an error estimate is below a limit.
    Adaptive(Adaptive),
}

/// Adaptive sampling until the estimated error of every pixel is small (`+AM4`).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Adaptive {
    /// Limit of the estimated error of each channel of a pixel, in steps of 1/255 in the working space of the scene.
    pub error: f64,
    /// Time after which sampling stops whatever the error. The picture then depends on the speed of the machine.
    pub time: Option<Duration>,
}

impl Default for Adaptive {
    /// An error of one step of a picture with 8 bits.
    fn default() -> Self {
        Adaptive {
            error: 1.0,
            time: None,
        }
    }
}

/// Result of adaptive sampling. Errors are in steps of 1/255 in the working space of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AdaptiveOutcome {
    /// The requested error.
    pub target: f64,
    /// The largest estimated error of a pixel.
    pub largest: f64,
    /// Root mean square of the estimated errors of all pixels.
    pub rms: f64,
    /// Number of camera rays.
    pub samples: u64,
}

/// Options of POV-Ray's antialiasing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Antialias {
    /// The method.
    pub method: Method,
    /// Threshold of the difference of two colours, summed over red, green, blue and transmit, above which a pixel is
    /// supersampled.
    pub threshold: f64,
    /// Confidence, in `[0, 1]`, that the mean of a pixel's samples is within the threshold, in method 3.
    pub confidence: f64,
    /// Side of the sample grid in method 1; number of subdivisions of a pixel in method 2; in method 3 a pixel has up to
    /// 4 to this power samples. 1 to 9.
    pub depth: u32,
    /// Jitter of samples as a fraction of a grid cell, 0 to 1.
    pub jitter: f64,
    /// The gamma in which colours are compared.
    pub gamma: f64,
}

/// POV-Ray's methods of antialiasing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// A sample grid in pixels that differ from a neighbour (`+AM1`).
    One,
    /// Recursive subdivision of pixels whose corners differ (`+AM2`).
    Two,
    /// Samples until the mean is known with some confidence (`+AM3` from version 3.8 on; before that, method 2).
    Three,
}

impl Default for Antialias {
    /// The values that `+A` alone sets.
    fn default() -> Self {
        Antialias {
            method: Method::One,
            threshold: 0.3,
            confidence: 0.9,
            depth: 3,
            jitter: 1.0,
            gamma: 2.5,
        }
    }
}

/// The rule for the smallest hit distance of rays that leave a surface, and for the largest of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TMinRule {
    /// Derived from the rounding error of the origin: thin objects are rendered correctly in any unit of length. Pictures
    /// with radiosity or POV-Ray's random numbers follow [`TMinRule::PovRay`] all the same: a ray more or less would shift
    /// the samples or numbers after it.
    #[default]
    Rounding,
    /// POV-Ray's 1/10000 of a unit, 1/1000 for shadow rays: thinner objects are lost, as in POV-Ray. So are hits at 1e7
    /// units and more. Shows if two pictures differ for this reason alone.
    PovRay,
}

/// The order in which pixels draw the random numbers of lights, grain and media. It never depends on the number of
/// threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RandomOrder {
    /// As [`RandomOrder::PovRay`] in pictures of up to [`MAX_SEQUENTIAL_PIXELS`] pixels, which take little time. In
    /// larger ones each pixel has a random sequence of its own, so that all threads can render.
    #[default]
    BySize,
    /// In sequence, as POV-Ray with one thread: the numbers are POV-Ray's, but only one thread renders. Rays follow
    /// [`TMinRule::PovRay`].
    PovRay,
}

/// Pictures of up to this number of pixels are rendered in POV-Ray's order if that matters: 400 by 300 and a little
/// more.
pub const MAX_SEQUENTIAL_PIXELS: u64 = 1 << 17;

/// A rendered scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The pixels.
    pub film: Film,
    /// The working space of the pixels; `None` for a scene without gamma handling, whose values are stored unchanged.
    pub working: Option<Gamma>,
    /// The rule by which the scene's language version rounds pixels to the levels of a file.
    pub rounding: Rounding,
    /// Statistics of the run.
    pub statistics: Statistics,
}

/// Statistics of a run. They display as `--stats` prints them and serialise as `--json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Statistics {
    /// Times of the stages, in order.
    pub stages: Vec<Stage>,
    /// Number of traced rays by kind: `camera`, `onward` (transmitted or refracted), `reflected`, `shadow`, `filtered`
    /// (shadow rays through transmissive surfaces).
    pub rays: BTreeMap<&'static str, u64>,
    /// Number of rendered pixels.
    pub pixels: u64,
    /// Camera rays per pixel.
    pub samples_per_pixel: f64,
    /// Result of adaptive sampling, if it was used.
    pub reached: Option<AdaptiveOutcome>,
    /// Statistics of radiosity, if it was used.
    pub radiosity: Option<RadiosityStatistics>,
    /// Statistics of photon mapping, if it was used.
    pub photons: Option<PhotonStatistics>,
    /// Peak memory of the process, if the system reports it.
    pub peak_bytes: Option<u64>,
    /// Statistics of the lowered scene.
    pub plan: Plan,
}

/// Statistics of radiosity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RadiosityStatistics {
    /// Samples stored by the pretrace.
    pub pretraced: usize,
    /// All stored samples.
    pub samples: usize,
    /// Their memory in bytes.
    pub bytes: usize,
    /// Time of the pretrace in seconds.
    pub pretrace_seconds: f64,
    /// Tiles that were revised because samples of other tiles were made while they were rendered.
    pub revised: usize,
}

/// Statistics of photon mapping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PhotonStatistics {
    /// Number of emitted photons.
    pub shot: u64,
    /// Number of photons stored on surfaces.
    pub on_surfaces: usize,
    /// Number of photons stored in media.
    pub in_media: usize,
    /// Their memory in bytes.
    pub bytes: usize,
    /// Initial gather radius on surfaces.
    pub radius: f64,
    /// Time of photon emission in seconds, before rendering.
    pub seconds: f64,
}

/// Time of a stage, in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stage {
    /// `read`, `compile` or `trace`.
    pub name: &'static str,
    /// Wall-clock time.
    pub wall: f64,
    /// Processor time of all threads; 0 if unknown.
    pub processor: f64,
}

/// Statistics of the lowered scene.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Plan {
    /// Number of primitives of each kind, with those in CSG objects.
    pub primitives: BTreeMap<&'static str, usize>,
    /// Number of CSG objects.
    pub combinations: usize,
    /// Unions that are lowered once for several instances.
    pub shared: usize,
    /// Number of their instances.
    pub instances: usize,
    /// Bytes per instance, without its material and its BVH nodes.
    pub instance_bytes: usize,
    /// Number of unbounded objects, which every ray tests.
    pub unbounded: usize,
    /// Number of primitives with a transform of their own; the others are in world space.
    pub behind_matrix: usize,
    /// Number of distinct materials.
    pub surfaces: usize,
    /// Number of lights.
    pub lights: usize,
    /// Memory of the BVH in bytes.
    pub tree_bytes: usize,
    /// Memory of the light buffers of camera and lights in bytes: rays from there look up their candidates and traverse
    /// no BVH.
    pub view_bytes: usize,
    /// Names of features that no ray needs.
    pub left_out: Vec<&'static str>,
}

/// The reason that a scene was not rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The errors. The event handler has already received them.
    pub errors: Vec<Message>,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<&str> = self.errors.iter().map(|e| e.pov_line.as_str()).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Failure {}

impl ReadOptions {
    /// True if the statement of each object is noted: on request, and for lints.
    pub(crate) fn locates_objects(&self) -> bool {
        self.notes_objects || self.lints
    }
}

impl Default for ReadOptions {
    /// A still picture of 800 by 600 pixels, as on Debian.
    fn default() -> Self {
        ReadOptions {
            library_paths: Vec::new(),
            library_paths_of_3_8: Vec::new(),
            readable: Folders::All,
            writable: Folders::Only(Vec::new()),
            writes: Writes::default(),
            declares: Vec::new(),
            version: None,
            include_header: None,
            is_header_by_user: false,
            width: 800,
            height: 600,
            clock: 0.0,
            clock_on: false,
            clock_delta: 0.0,
            frame_number: 0,
            initial_frame: 0,
            final_frame: 0,
            initial_clock: 0.0,
            final_clock: 0.0,
            max_repeated_tokens: MAX_REPEATED_TOKENS,
            memory: None,
            notes_objects: false,
            lints: false,
            allowed_lints: Vec::new(),
            stop: CancelToken::default(),
        }
    }
}

impl RenderOptions {
    /// The default options for a picture of this size.
    #[must_use]
    pub fn of_size(width: u32, height: u32) -> Self {
        RenderOptions {
            width,
            height,
            columns: 0..width,
            rows: 0..height,
            ..RenderOptions::default()
        }
    }

    /// The same options for a whole picture of another size without antialiasing.
    #[must_use]
    pub fn coarse(&self, width: u32, height: u32) -> Self {
        RenderOptions {
            width,
            height,
            columns: 0..width,
            rows: 0..height,
            sampling: Sampling::Centres,
            ..self.clone()
        }
    }

    /// Returns true if pixels draw random numbers in sequence.
    #[must_use]
    pub fn uses_sequential_random(&self) -> bool {
        let pixels = u64::from(self.width) * u64::from(self.height);
        self.random_order == RandomOrder::PovRay || pixels <= MAX_SEQUENTIAL_PIXELS
    }
}

impl Default for RenderOptions {
    /// All of a picture of 800 by 600 pixels, as on Debian.
    fn default() -> Self {
        RenderOptions {
            width: 800,
            height: 600,
            columns: 0..800,
            rows: 0..600,
            quality: 9,
            threads: None,
            alpha: false,
            t_min_rule: TMinRule::default(),
            has_clean_cuts: false,
            random_order: RandomOrder::default(),
            statistics: false,
            sampling: Sampling::Centres,
            checkpoint: None,
            target_format: None,
            stop: CancelToken::default(),
        }
    }
}
