//! What a drawing starts from and what comes of it: plain types between the command line and the stages.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use serde::Serialize;

use crate::base::color::Gamma;
use crate::base::encoding::EncodeOptions;
use crate::base::film::Film;
use crate::base::source::{Dependency, Message};

/// What reading and drawing say while they are at work.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// Text that the scene writes by `#debug`, `#render` or `#statistics`, to be written as it is.
    Said(&'a str),
    /// A finding about the scene, in the order of finding.
    Found(&'a Message),
    /// The scene has been read to its end, or as far as it could be.
    Read {
        /// The files that were read or asked for.
        dependencies: &'a [Dependency],
        /// Whether the scene wrote files itself.
        wrote_files: bool,
    },
    /// The drawing goes on with so many pixels of an unfinished picture.
    GoesOn(u64),
    /// There is an unfinished picture, of another scene, with other options or by another program: it is given up.
    StartsAnew,
    /// The unfinished picture cannot be kept.
    KeepsNothing(std::io::ErrorKind),
    /// The drawing was stopped, and this many of its pixels are kept for a later run.
    Kept(u64),
    /// So many pixels have been finished since the last event of this kind. Comes from any thread.
    Drawn(u64),
}

/// Who hears what happens.
pub type EventHandler<'a> = dyn Fn(Event<'_>) + Sync + 'a;

/// Where the scene's text comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// A file, as the user named it.
    File(PathBuf),
    /// A text that is already here: standard input, a test, a Rust caller.
    Text {
        /// What messages call it: "standard input".
        name: String,
        /// The text itself, in whatever encoding it came.
        text: Vec<u8>,
    },
}

/// What the scene language asks its surroundings for.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadOptions {
    /// Folders searched for included and other files after the current one, in this order.
    pub library_paths: Vec<PathBuf>,
    /// Folders into which and below which a scene may write files; none lets it write nothing.
    pub writable: Vec<PathBuf>,
    /// The destination of the files that a scene writes.
    pub writes: Writes,
    /// Names declared before the scene is read.
    pub declares: Vec<(String, f64)>,
    /// The language version in force at the start; `None` leaves it to the scene.
    pub version: Option<f64>,
    /// A file included before the scene.
    pub include_header: Option<PathBuf>,
    /// `image_width`.
    pub width: u32,
    /// `image_height`.
    pub height: u32,
    /// `clock`.
    pub clock: f64,
    /// `clock_on`: whether anybody set the clock.
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
    /// How many tokens loops and macros may read again, before a scene counts as one that does not come to an end.
    pub patience: u64,
    /// The most memory that reading may take in bytes, if it is to be less than the machine has.
    pub memory: Option<u64>,
    /// Ends reading.
    pub stop: CancelToken,
}

/// The destination of the files that a scene writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Writes {
    /// To disk.
    #[default]
    ToDisk,
    /// Nowhere: the scene finds them in memory, and nothing changes on disk.
    InMemory,
}

/// A wish that reading and drawing end before they are done; its copies are one wish.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Wishes it, from any thread.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// The flag whose setting is the wish: for the handler of a signal, which may do no more.
    #[must_use]
    pub fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// Whether it was wished.
    #[must_use]
    #[inline]
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Wishes make no difference between options.
impl PartialEq for CancelToken {
    fn eq(&self, _: &CancelToken) -> bool {
        true
    }
}

/// Ten seconds' worth of tokens. A loop of ten tokens goes round eight million times.
const PATIENCE: u64 = 150_000_000;

/// What to draw of the scene, and with what effort.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderOptions {
    /// Pixels in a row of the whole picture.
    pub width: u32,
    /// Rows of the whole picture.
    pub height: u32,
    /// The columns to draw, counted from 0. May be empty.
    pub columns: Range<u32>,
    /// The rows to draw, counted from 0. May be empty.
    pub rows: Range<u32>,
    /// POV-Ray's quality, 0 to 11; 9 and above is everything.
    pub quality: u8,
    /// How many threads to use; `None` takes one for each core.
    pub threads: Option<usize>,
    /// Whether the background's transparency is kept.
    pub alpha: bool,
    /// From which distance on a ray meets surfaces.
    pub least_distance: LeastDistance,
    /// In which order pixels take random numbers.
    pub random_order: RandomOrder,
    /// Whether to tell what was left out.
    pub statistics: bool,
    /// How pixels are sampled.
    pub sampling: Sampling,
    /// Where what has been drawn is kept until all is.
    pub keep: Option<CheckpointOptions>,
    /// The one file that the picture is for: what it cannot hold need not be kept. `working` is the scene's, whatever it
    /// says here.
    pub only_for: Option<EncodeOptions>,
    /// Ends drawing.
    pub stop: CancelToken,
}

/// An unfinished picture, with which a later run can go on. Drawing with a time limit keeps none: what it draws depends
/// on the speed of the machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckpointOptions {
    /// The file. It stays until somebody removes it.
    pub file: PathBuf,
    /// Whether to go on with what is there and to keep everything from the beginning on. Otherwise what is there is
    /// replaced as soon as the drawing has taken two seconds.
    pub continues: bool,
    /// What tells this program from others, which may draw other pictures.
    pub build: String,
}

/// How pixels are sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Sampling {
    /// By one ray through the centre of each.
    #[default]
    Centres,
    /// As POV-Ray antialiases.
    PovRay(Antialias),
    /// Until an estimate of the error holds.
    Converging(Adaptive),
}

/// Sampling until the estimated error of every pixel is small (`+AM4`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// The largest estimated error of a channel of a pixel, in steps of 1/255 in the working space of the scene.
    pub error: f64,
    /// When to stop whatever the error is. The picture then depends on the speed of the machine.
    pub time: Option<Duration>,
}

impl Default for Adaptive {
    /// A step of a picture with 8 bits.
    fn default() -> Self {
        Adaptive {
            error: 1.0,
            time: None,
        }
    }
}

/// What sampling until the error is small came to. Errors are in steps of 1/255 in the working space of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AdaptiveOutcome {
    /// The error asked for.
    pub target: f64,
    /// The largest estimated error of a pixel.
    pub largest: f64,
    /// The root of the mean of the squared estimated errors of all pixels.
    pub rms: f64,
    /// How many camera rays it took.
    pub samples: u64,
}

/// How POV-Ray samples pixels more than once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Antialias {
    /// Which of POV-Ray's methods.
    pub method: Method,
    /// From which difference of two colours on a pixel is sampled again: the sum over red, green, blue and transmit.
    pub threshold: f64,
    /// The side of the grid in method 1, how often a pixel is halved in method 2: 1 to 9.
    pub depth: u32,
    /// The share of a grid cell by which samples are moved, 0 to 1.
    pub jitter: f64,
    /// The gamma in which colours are compared.
    pub gamma: f64,
}

/// POV-Ray's methods of antialiasing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// A grid in pixels that differ from a neighbour (`+AM1`).
    One,
    /// Dividing pixels whose corners differ (`+AM2`).
    Two,
}

impl Default for Antialias {
    /// What `+A` alone means.
    fn default() -> Self {
        Antialias {
            method: Method::One,
            threshold: 0.3,
            depth: 3,
            jitter: 1.0,
            gamma: 2.5,
        }
    }
}

/// From which distance on a ray that leaves a surface meets others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LeastDistance {
    /// From the error of the point it leaves: thin things are seen whole in any unit of length.
    #[default]
    Rounding,
    /// From POV-Ray's 1/10000 of a unit, 1/1000 for shadows: what is thinner is lost, as there. This tells whether
    /// two pictures differ by nothing else.
    PovRay,
}

/// In which order pixels take the random numbers of lamps, grain and media. It never hangs on the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RandomOrder {
    /// As [`RandomOrder::PovRay`] in pictures of up to [`IN_ORDER`] pixels, which are soon drawn. In larger ones each
    /// pixel takes numbers of its own, so that all threads can draw.
    #[default]
    BySize,
    /// One after the other, as POV-Ray with one thread: the numbers are POV-Ray's, but one thread draws alone.
    PovRay,
}

/// Pictures of no more pixels are drawn in POV-Ray's order if that matters: 400 by 300 and a little more.
pub const IN_ORDER: u64 = 1 << 17;

/// A drawn scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The pixels.
    pub film: Film,
    /// The working space they are in; `None` for a scene without gamma handling, whose values are stored as they are.
    pub working: Option<Gamma>,
    /// What it took.
    pub statistics: Statistics,
}

/// What a drawing took, and what its scene was spared. It displays as `--stats` prints it, and serialises as `--json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Statistics {
    /// How long each stage took, in their order.
    pub stages: Vec<Stage>,
    /// How many rays were followed, by kind: `camera`, `onward` (straight on or bent through surfaces), `reflected`,
    /// `shadow`, `filtered` (through surfaces to a light).
    pub rays: BTreeMap<&'static str, u64>,
    /// The pixels drawn.
    pub pixels: u64,
    /// Camera rays for each of them.
    pub samples_a_pixel: f64,
    /// What was reached, of a picture that was sampled until its error is small.
    pub reached: Option<AdaptiveOutcome>,
    /// What radiosity took, where it was drawn.
    pub radiosity: Option<RadiosityStatistics>,
    /// What photons took, where some were shot.
    pub photons: Option<PhotonStatistics>,
    /// The most memory that the process ever held, if the system tells.
    pub peak_bytes: Option<u64>,
    /// What the scene needs.
    pub plan: Plan,
}

/// What light that surfaces gather from each other took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RadiosityStatistics {
    /// Samples that were kept before the picture was drawn.
    pub pretraced: usize,
    /// All samples that were kept.
    pub samples: usize,
    /// Their memory in bytes.
    pub bytes: usize,
    /// The time before the picture was drawn, in seconds.
    pub pretrace_seconds: f64,
    /// Tiles of the picture that other samples changed while they were drawn, so that they were looked through again.
    pub revised: usize,
}

/// What photons took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PhotonStatistics {
    /// How many were shot.
    pub shot: u64,
    /// How many are kept on surfaces.
    pub on_surfaces: usize,
    /// How many are kept in media.
    pub in_media: usize,
    /// Their memory in bytes.
    pub bytes: usize,
    /// How far around a point of a surface they count at first.
    pub radius: f64,
    /// The time before the picture was drawn, in seconds.
    pub seconds: f64,
}

/// How long a stage took, in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stage {
    /// `read`, `compile` or `trace`.
    pub name: &'static str,
    /// By the clock.
    pub wall: f64,
    /// Of all processors together; 0 where that is not known.
    pub processor: f64,
}

/// What a scene needs of all that a tracer can do.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Plan {
    /// How many primitives there are of each kind, those of combinations included.
    pub primitives: BTreeMap<&'static str, usize>,
    /// How many combinations there are.
    pub combinations: usize,
    /// Unions that are prepared once for several copies.
    pub shared: usize,
    /// The copies of them.
    pub instances: usize,
    /// Bytes for each copy, without its looks and its part of the tree.
    pub instance_bytes: usize,
    /// Objects that no box holds; every ray tries them.
    pub unbounded: usize,
    /// Primitives that stand behind a matrix; the others are in the world's own coordinates.
    pub behind_matrix: usize,
    /// The looks that are told apart.
    pub surfaces: usize,
    /// The lights.
    pub lights: usize,
    /// The memory of the tree in bytes.
    pub tree_bytes: usize,
    /// The memory in bytes of what camera and lamps see around them: rays from there look it up and walk no tree.
    pub view_bytes: usize,
    /// What no ray needs.
    pub left_out: Vec<&'static str>,
}

/// Why a scene was not drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What is wrong. Who listened has heard it.
    pub errors: Vec<Message>,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<&str> = self.errors.iter().map(|e| e.pov_line.as_str()).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Failure {}

impl Default for ReadOptions {
    /// A still picture of 800 by 600 pixels, as on Debian.
    fn default() -> Self {
        ReadOptions {
            library_paths: Vec::new(),
            writable: Vec::new(),
            writes: Writes::default(),
            declares: Vec::new(),
            version: None,
            include_header: None,
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
            patience: PATIENCE,
            memory: None,
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

    /// Whether pixels take random numbers one after the other.
    #[must_use]
    pub fn takes_numbers_in_order(&self) -> bool {
        let pixels = u64::from(self.width) * u64::from(self.height);
        self.random_order == RandomOrder::PovRay || pixels <= IN_ORDER
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
            least_distance: LeastDistance::default(),
            random_order: RandomOrder::default(),
            statistics: false,
            sampling: Sampling::Centres,
            keep: None,
            only_for: None,
            stop: CancelToken::default(),
        }
    }
}
