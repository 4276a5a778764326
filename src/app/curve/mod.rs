//! Error against run time: a scene is rendered with many settings, and each picture compared with a near-perfect one,
//! the truth.
//!
//! The plots are work-precision diagrams (Hairer, Nørsett and Wanner, "Solving Ordinary Differential Equations I",
//! 1993): the logarithm of the error over the logarithm of the time, a line for each method. Times are those of
//! tracing: the median of several runs, with their spread. All results are written as soon as they are known, and a
//! later run with the same scene continues where an earlier one ended.

mod error;
pub(crate) mod files;
mod page;
mod plot;
mod povray;
mod setting;
mod store;
mod truth;

pub use error::{Errors, Linear};
pub use povray::Task;
pub use setting::{Family, Setting, USUAL};
pub use store::{Measured, Report, Spread};
pub use truth::{ERROR, Truth};

use std::fmt;
use std::path::{Path, PathBuf};

use crate::base::color::Gamma;
use crate::base::options::{AdaptiveOutcome, Picture, Sampling};

/// A rendered picture and its cost.
#[derive(Debug)]
pub struct Drawn {
    /// The picture.
    pub picture: Linear,
    /// The error reached with adaptive sampling.
    pub reached: Option<AdaptiveOutcome>,
    /// Camera rays for each pixel.
    pub samples_per_pixel: f64,
    /// Seconds of tracing, over all processors.
    pub processor: f64,
    /// Seconds of tracing by the clock.
    pub wall: f64,
}

/// Renders the scene with a sampling method.
pub type Draw<'a> = dyn Fn(Sampling) -> Result<Drawn, CurveError> + 'a;

/// A set of measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The scene's name for people.
    pub scene: String,
    /// All inputs of its picture except the sampling; measurements under another key do not count.
    pub key: String,
    /// The settings.
    pub settings: Vec<Setting>,
    /// Number of renderings with each setting.
    pub runs: usize,
    /// POV-Ray's options beside the switches of a setting.
    pub povray: Task,
    /// The requested error of the truth, in steps of 1/255.
    pub truth_error: f64,
    /// The folder of all files.
    pub folder: PathBuf,
}

/// Progress of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Steps done, out of `of`.
    pub done: usize,
    /// Number of steps.
    pub of: usize,
    /// The next step.
    pub next: &'a str,
}

/// An error that ends a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CurveError {
    /// The message.
    pub message: String,
    /// The hint.
    pub hint: Option<String>,
}

impl CurveError {
    /// An error in lower case, without a full stop.
    #[must_use]
    pub fn new(message: impl Into<String>) -> Self {
        CurveError {
            message: message.into(),
            hint: None,
        }
    }

    fn with_hint(mut self, hint: &str) -> Self {
        self.hint = Some(hint.to_owned());
        self
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for CurveError {}

impl Drawn {
    /// From a picture of the render pipeline.
    #[must_use]
    pub fn of(picture: &Picture) -> Drawn {
        let statistics = &picture.statistics;
        let trace = statistics.stages.iter().find(|stage| stage.name == "trace");
        let working: Option<Gamma> = picture.working;
        Drawn {
            picture: Linear::of_film(&picture.film, working),
            reached: statistics.reached,
            samples_per_pixel: statistics.samples_per_pixel,
            processor: trace.map_or(0.0, |stage| stage.processor),
            wall: trace.map_or(0.0, |stage| stage.wall),
        }
    }
}

impl Sweep {
    /// Makes the missing measurements, and writes all files. `on_step` receives the next step.
    ///
    /// # Errors
    /// When the scene cannot be rendered, POV-Ray does not run, or a file cannot be written.
    pub fn run(&self, draw: &Draw<'_>, on_step: &dyn Fn(Step<'_>)) -> Result<Report, CurveError> {
        let pictures = self.folder.join("pictures");
        std::fs::create_dir_all(&pictures).map_err(|error| {
            CurveError::new(format!("cannot create `{}`: {error}", pictures.display()))
                .with_hint("Name another folder with `--out`.")
        })?;
        let of = self.settings.len() + 1;
        let step = |done, next: &str| on_step(Step { done, of, next });
        step(0, "the reference image");
        let (truth, picture) =
            truth::stored_or_rendered(&self.key, self.truth_error, &self.folder, draw)?;
        write_png(&pictures.join("truth.png"), &picture, &picture.srgb())?;
        let json = self.folder.join("curve.json");
        let before = Report::stored(&json, &self.key);
        let mut report = Report {
            key: self.key.clone(),
            scene: self.scene.clone(),
            threads: self.povray.threads,
            truth,
            measured: Vec::new(),
        };
        for (number, setting) in self.settings.iter().enumerate() {
            let known = before
                .iter()
                .flat_map(|report| &report.measured)
                .find(|known| {
                    known.file_stem == setting.file_stem() && known.processor.runs >= self.runs
                });
            if let Some(known) = known {
                report.measured.push(known.clone());
                continue;
            }
            step(number + 1, &setting.name());
            let measured = self.measure(setting, &picture, &pictures, draw)?;
            report.measured.push(measured);
            // Measurements of an earlier run that this one has not reached yet are retained for the next.
            let mut stored = report.clone();
            let of_before = before.iter().flat_map(|report| &report.measured);
            let to_come = &self.settings[number + 1..];
            stored.measured.extend(
                of_before
                    .filter(|known| to_come.iter().any(|s| s.file_stem() == known.file_stem))
                    .cloned(),
            );
            files::write_json(&json, &stored)?;
        }
        step(of, "the page");
        files::write_json(&json, &report)?;
        self.publish(&report)?;
        Ok(report)
    }

    /// Writes table, plot and page.
    fn publish(&self, report: &Report) -> Result<(), CurveError> {
        let svg = plot::svg(report)?;
        files::write(&self.folder.join("curve.csv"), report.csv().as_bytes())?;
        files::write(&self.folder.join("curve.svg"), svg.as_bytes())?;
        #[cfg(feature = "plot-png")]
        files::write(&self.folder.join("curve.png"), &plot::png(&svg)?)?;
        let page = page::html(
            report,
            &plot::panels(report)?,
            &self.folder.join("pictures"),
        )?;
        files::write(&self.folder.join("index.html"), page.as_bytes())
    }

    fn measure(
        &self,
        setting: &Setting,
        truth: &Linear,
        pictures: &Path,
        draw: &Draw<'_>,
    ) -> Result<Measured, CurveError> {
        let mut processor = Vec::new();
        let mut wall = Vec::new();
        let mut last = None;
        for _ in 0..self.runs.max(1) {
            let drawn = match setting.family {
                Family::PovRay => {
                    let by = povray::draw(&self.povray, &setting.switches, &self.folder)?;
                    Drawn {
                        picture: by.picture,
                        reached: None,
                        samples_per_pixel: by.samples_per_pixel,
                        processor: by.processor,
                        wall: by.wall,
                    }
                }
                _ => draw(setting.sampling)?,
            };
            processor.push(drawn.processor);
            wall.push(drawn.wall);
            last = Some(drawn);
        }
        let Some(drawn) = last else {
            return Err(CurveError::new("nothing was drawn"));
        };
        let is_alike = (drawn.picture.width, drawn.picture.height) == (truth.width, truth.height);
        if !is_alike {
            return Err(CurveError::new(format!(
                "`{}` drew another size",
                setting.name()
            )));
        }
        let stem = setting.file_stem();
        let difference = truth.difference(&drawn.picture);
        write_png(
            &pictures.join(format!("{stem}.png")),
            truth,
            &drawn.picture.srgb(),
        )?;
        write_png(
            &pictures.join(format!("{stem}-difference.png")),
            truth,
            &difference,
        )?;
        Ok(Measured {
            family: setting.family,
            switches: setting.switches.clone(),
            file_stem: stem,
            processor: Spread::of(processor),
            wall: Spread::of(wall),
            samples_per_pixel: drawn.samples_per_pixel,
            estimated: drawn
                .reached
                .map(|reached| (reached.largest / 255.0, reached.rms / 255.0)),
            errors: truth.errors(&drawn.picture),
        })
    }
}

/// Writes RGB bytes as a PNG file of the size of a picture.
fn write_png(path: &Path, size: &Linear, bytes: &[u8]) -> Result<(), CurveError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size.width, size.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder
        .write_header()
        .and_then(|mut writer| {
            writer.write_image_data(bytes)?;
            writer.finish()
        })
        .map_err(|error| CurveError::new(format!("cannot write `{}`: {error}", path.display())))?;
    files::write(path, &file)
}
