//! Scenes with their options, and the pictures drawn of them.

use super::arrays::{Rows, adding};
use super::watch::{CancelToken, Stop, same_process, watched};
use super::{Cancelled, Refused, environment, value_error};
use povr::RenderSession;
use povr::app::cli::{Request, Settings, request};
use povr::base::color::Gamma;
use povr::base::file::Folders;
use povr::base::film::{Film, levels_of};
use povr::base::options::{Event, Failure, Input, Picture, ReadOptions, RenderOptions, Sampling};
use povr::base::source::Message;
use povr::output::{self, EncodeOptions, Format};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use serde_json::Value;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// The name of the scene for options, where it is a text.
const STANDARD_INPUT: &str = "-";

/// A scene and its options, to be drawn any number of times, from any thread.
#[pyclass(frozen, module = "povr._povr")]
pub(crate) struct Session {
    input: Input,
    settings: Settings,
    encoding: EncodeOptions,
    session: RenderSession,
    stop: Stop,
}

/// A drawn picture.
#[pyclass(frozen, get_all, module = "povr._povr")]
pub(crate) struct Drawn {
    /// The pixels, or an encoded file.
    data: Py<PyByteArray>,
    /// Rows, columns and channels.
    shape: (u32, u32, usize),
    /// Findings, as JSON.
    findings: String,
    /// The text written by the scene.
    output: String,
    /// Statistics, as JSON.
    statistics: String,
}

/// Findings, text and progress of a scene while it is read and drawn.
#[derive(Default)]
struct Reports {
    findings: Mutex<Vec<Value>>,
    output: Mutex<String>,
    pixels: AtomicU64,
}

impl Reports {
    fn listen(&self, event: Event<'_>) {
        match event {
            Event::Finding(message) => lock(&self.findings).push(finding(message)),
            Event::SceneOutput(text) => lock(&self.output).push_str(text),
            Event::Drawn(pixels) => {
                self.pixels.fetch_add(pixels, Ordering::Relaxed);
            }
            _ => {}
        }
    }

    /// The findings as JSON, and the text written by the scene.
    fn into_texts(self) -> (String, String) {
        let findings = self.findings.into_inner();
        let output = self.output.into_inner();
        (
            Value::from(findings.unwrap_or_else(PoisonError::into_inner)).to_string(),
            output.unwrap_or_else(PoisonError::into_inner),
        )
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A finding as the object of `--message-format json`, with the lines of the scene.
fn finding(message: &Message) -> Value {
    let mut value = serde_json::to_value(message).unwrap_or_default();
    if let Value::Object(fields) = &mut value {
        fields.insert("excerpt".to_owned(), message.excerpt.clone().into());
    }
    value
}

/// The exception for a scene that cannot be drawn.
fn refused(failure: &Failure) -> PyErr {
    let errors: Vec<Value> = failure.errors.iter().map(finding).collect();
    Refused::new_err(Value::from(errors).to_string())
}

#[pymethods]
impl Session {
    /// The scene is `text`, a name for messages and the bytes, or the file that `switches` name. The last objects of the
    /// text are the models of `objects`, which replace them. Pictures have `depth` bits per channel, and `token`
    /// cancels all of them. The tokens of a series are cached from one drawing to the next.
    #[new]
    fn new(
        py: Python<'_>,
        switches: Vec<String>,
        text: Option<(String, Vec<u8>)>,
        objects: Vec<Rows>,
        depth: u8,
        token: Option<Py<CancelToken>>,
        is_series: bool,
    ) -> PyResult<Self> {
        same_process()?;
        let mut switches = switches;
        if text.is_some() {
            switches.push(STANDARD_INPUT.to_owned());
        }
        let wanted = request(&switches, &environment());
        let Request::Draw(settings) = wanted.map_err(|error| value_error(&error))? else {
            return Err(value_error(&"options ask for help or a version"));
        };
        let mut settings = *settings;
        if is_for_a_process(&settings) {
            return Err(value_error(
                &"`--sandbox`, `--timeout`, `--max-memory`, `+C` and `+GI` need a process of their own: run the program \
                  `povr`",
            ));
        }
        let stop = Stop::new(token.as_ref().map(Py::get));
        settings.read.stop = stop.token().clone();
        settings.render.stop = stop.token().clone();
        let Some((_, encoding)) = settings.output.take() else {
            return Err(value_error(&"options ask for no picture"));
        };
        check_encoding(&encoding, depth)?;
        let input = match (text, &settings.scene) {
            (Some((name, text)), _) => Input::Text { name, text },
            (None, povr::app::cli::Scene::File(path)) => Input::File(path.clone()),
            (None, povr::app::cli::Scene::Stdin) => return Err(value_error(&"no scene is named")),
        };
        let threads = settings.render.threads;
        let (pool, add) = py.detach(|| (pool(threads), adding(objects)));
        let pool = Some(pool.map_err(|failure| refused(&failure))?);
        let session = match is_series {
            true => RenderSession::new(pool),
            false => RenderSession::of_one(pool),
        };
        Ok(Session {
            input,
            settings,
            encoding,
            session: session.with_objects(add?),
            stop,
        })
    }

    /// Cancels all drawing, and leaves the token of the caller as it is.
    fn cancel(&self) {
        self.stop.token().cancel();
    }

    /// True if frames are to be drawn one after the other: the scene may write files, which later frames may read, or
    /// each frame has the time that it is given.
    #[getter]
    fn is_sequential(&self) -> bool {
        let writes = self.settings.read.writable != Folders::Only(Vec::new());
        let is_timed = matches!(
            &self.settings.render.sampling,
            Sampling::Adaptive(adaptive) if adaptive.time.is_some()
        );
        writes || is_timed
    }

    /// The numbers of the frames of an animation, in order; empty for a still picture.
    #[getter]
    fn frames(&self) -> Vec<u32> {
        let frames = self.settings.frames.as_ref();
        frames.map_or_else(Vec::new, povr::app::cli::Frames::numbers)
    }

    /// The warnings about the options.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = self.settings.warnings.iter();
        let bare = |warning: &String| warning.trim_start_matches("povr: warning: ").to_owned();
        warnings.map(bare).collect()
    }

    /// Draws the scene or one of its frames: pixels, or with `is_file` an encoded file. `progress` is called with the
    /// part done, from 0 to 1.
    #[pyo3(signature = (frame=None, is_file=false, progress=None))]
    fn draw(
        &self,
        py: Python<'_>,
        frame: Option<u32>,
        is_file: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Drawn> {
        let read = match (&self.settings.frames, frame) {
            (Some(frames), Some(frame)) => frames.read_options_for(frame, &self.settings.read),
            _ => self.settings.read.clone(),
        };
        let render = RenderOptions {
            target_format: Some(self.encoding.clone()),
            ..self.settings.render.clone()
        };
        let encoded = |picture: Picture| {
            let bytes = self.bytes_of(&picture, is_file);
            bytes.map(|bytes| (bytes, picture.statistics))
        };
        let drawn = self.drawn(py, &read, &render, progress.as_ref(), encoded)?;
        let (bytes, statistics) = drawn.what?;
        let (width, height) = (render.width, render.height);
        Ok(Drawn {
            data: PyByteArray::new(py, &bytes).unbind(),
            shape: (height, width, if self.encoding.alpha { 4 } else { 3 }),
            findings: drawn.findings,
            output: drawn.output,
            statistics: json(&statistics),
        })
    }

    /// Reads the scene without drawing it. Returns the findings as JSON.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let reports = Reports::default();
        let done = watched(py, &self.stop, &mut |_| Ok(()), || {
            povr::check(&self.input, &self.settings.read, &|event| {
                reports.listen(event)
            })
        })?;
        match done {
            Err(_) if self.stop.token().is_cancelled() => Err(cancelled()),
            _ => Ok(reports.into_texts().0),
        }
    }

    /// Reads and lowers the scene. Returns the findings and the statistics of the lowered scene as JSON.
    fn plan(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let render = RenderOptions {
            columns: 0..0,
            rows: 0..0,
            statistics: true,
            ..self.settings.render.clone()
        };
        let lowered = |picture: Picture| picture.statistics;
        let drawn = self.drawn(py, &self.settings.read, &render, None, lowered)?;
        Ok((drawn.findings, json(&drawn.what.plan)))
    }
}

/// A result with the reports of its scene.
struct Reported<T> {
    what: T,
    findings: String,
    output: String,
}

impl Session {
    /// Draws, and lets `finish` make the result of the picture before the interpreter is locked again.
    fn drawn<T: Send>(
        &self,
        py: Python<'_>,
        read: &ReadOptions,
        render: &RenderOptions,
        progress: Option<&Py<PyAny>>,
        finish: impl FnOnce(Picture) -> T + Send,
    ) -> PyResult<Reported<T>> {
        let reports = Reports::default();
        let of = render.columns.len() as u64 * render.rows.len() as u64;
        let mut tick = |py: Python<'_>| match progress {
            None => Ok(()),
            Some(progress) => {
                let part = share(reports.pixels.load(Ordering::Relaxed), of);
                progress.call1(py, (part,)).map(drop)
            }
        };
        let done = watched(py, &self.stop, &mut tick, || {
            let listen = |event: Event<'_>| reports.listen(event);
            self.session
                .draw(&self.input, read, render, &listen)
                .map(finish)
        })?;
        let what = match done {
            Ok(what) => what,
            Err(_) if self.stop.token().is_cancelled() => return Err(cancelled()),
            Err(_) => return Err(Refused::new_err(reports.into_texts().0)),
        };
        if let Some(progress) = progress {
            progress.call1(py, (1.0,))?;
        }
        let (findings, output) = reports.into_texts();
        Ok(Reported {
            what,
            findings,
            output,
        })
    }

    fn bytes_of(&self, picture: &Picture, is_file: bool) -> PyResult<Vec<u8>> {
        let options = self.encoding.for_scene(picture.working, picture.rounding);
        if is_file {
            return output::encode(&picture.film, &options).map_err(|error| value_error(&error));
        }
        if options.format.is_linear {
            return Ok(floats_of(&picture.film, &options));
        }
        let levels = levels_of(&picture.film, &options);
        levels
            .map(std::borrow::Cow::into_owned)
            .map_err(|error| value_error(&error))
    }
}

/// Linear light with premultiplied alpha, as in an EXR file, in single precision and native byte order.
fn floats_of(film: &Film, options: &EncodeOptions) -> Vec<u8> {
    let working = options.working.unwrap_or(Gamma::Srgb);
    let channels = if options.alpha { 4 } else { 3 };
    let mut bytes = Vec::with_capacity(film.pixels.len() * channels * size_of::<f32>());
    for pixel in &film.pixels {
        let [r, g, b] = [pixel.rgb.r, pixel.rgb.g, pixel.rgb.b].map(|c| working.decode(c));
        for channel in &[r, g, b, 1.0 - pixel.transmit][..channels] {
            bytes.extend_from_slice(&channel.to_ne_bytes());
        }
    }
    bytes
}

/// True if some option limits or stores what only a process of povr's own can.
fn is_for_a_process(settings: &Settings) -> bool {
    settings.is_sandboxed
        || settings.timeout.is_some()
        || settings.max_memory.is_some()
        || settings.continues
        || settings.created_ini.is_some()
}

/// Checks that pictures have the type of the arrays and files that are promised.
fn check_encoding(encoding: &EncodeOptions, depth: u8) -> PyResult<()> {
    let EncodeOptions {
        format,
        bits,
        grayscale,
        ..
    } = encoding;
    let stored = match *format {
        Format::PNG if !grayscale => Some(if *bits > 8 { 16 } else { 8 }),
        Format::EXR => Some(32),
        _ => None,
    };
    if stored == Some(depth) {
        return Ok(());
    }
    let kind = if *grayscale { "grey " } else { "" };
    Err(value_error(&format!(
        "options ask for a {kind}{} file with {bits} bits per channel: set `depth` (8, 16 or 32) in place of a file type \
         or `Bits_Per_Color`, and run the program `povr` for other files and grey ones",
        format.name
    )))
}

fn share(done: u64, of: u64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a share for people")]
    let share = done as f64 / of.max(1) as f64;
    share.min(1.0)
}

fn json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

fn cancelled() -> PyErr {
    Cancelled::new_err("the render was cancelled")
}

/// The threads of all renders that ask for no number.
static POOL: Mutex<Option<Arc<rayon::ThreadPool>>> = Mutex::new(None);

/// The threads to draw with: those of a number, or one for each core.
fn pool(threads: Option<usize>) -> Result<Arc<rayon::ThreadPool>, Failure> {
    if let Some(threads) = threads {
        return povr::pool(threads, &|_| {}).map(Arc::new);
    }
    let mut pool = lock(&POOL);
    if let Some(pool) = &*pool {
        return Ok(Arc::clone(pool));
    }
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let new = Arc::new(povr::pool(cores, &|_| {})?);
    *pool = Some(Arc::clone(&new));
    Ok(new)
}
