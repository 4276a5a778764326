//! One rendering for `povr watch`: a preview first, then the whole picture; both are shown.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Instant, SystemTime};

use super::files::Known;
use super::shown::{Picture, Shown};
use super::terminal;
use crate::RenderSession;
use crate::app::cli::draw::report::{Reporter, say};
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::settings::Settings;
use crate::base::color::Gamma;
use crate::base::film::Film;
use crate::base::options::{CancelToken, Event, Input, RenderOptions, Sampling};
use crate::base::source::Severity;
use crate::output::{self, EncodeOptions, Format};

/// Side of a picture over side of its preview.
const PREVIEW: u32 = 4;
/// Pictures of fewer pixels have no preview.
const SMALL: u64 = 200 * 150;

/// Renders and shows pictures.
pub(super) struct Painter {
    pub(super) input: Input,
    pub(super) settings: Settings,
    pub(super) reporter: Reporter,
    pub(super) shown: Arc<Shown>,
    /// True to show nothing in the terminal.
    pub(super) is_silent: bool,
}

impl Painter {
    /// Renders the preview and the picture.
    pub(super) fn draw(&self, stop: &CancelToken, began: SystemTime, read: &Mutex<Option<Known>>) {
        let verbosity = self.settings.verbosity;
        let pool = self.settings.render.threads.map(|threads| {
            crate::pool(threads, &|event| self.reporter.report(event)).map(Arc::new)
        });
        let pool = match pool.transpose() {
            Ok(pool) => pool,
            Err(_) => return,
        };
        let series = RenderSession::new(pool);
        let errors = Mutex::new(String::new());
        let mut options = self.settings.read.clone();
        options.stop = stop.clone();
        for (pass, render) in self.passes(stop).into_iter().enumerate() {
            let is_preview = render.width < self.settings.render.width;
            let listen = |event: Event<'_>| {
                if let Event::Read { dependencies, .. } = event {
                    let paths = dependencies.iter().map(|one| one.path.clone());
                    let scene = match &self.input {
                        Input::File(path) => Some(path.clone()),
                        Input::Text { .. } => None,
                    };
                    let known = Known::of(paths.chain(scene), began);
                    *read.lock().unwrap_or_else(PoisonError::into_inner) = Some(known);
                }
                if let Event::Finding(message) = event
                    && message.severity == Severity::Error
                    && !stop.is_cancelled()
                {
                    let mut errors = errors.lock().unwrap_or_else(PoisonError::into_inner);
                    errors.push_str(&format!("{}\n", message.excerpt));
                }
                // The second pass repeats the messages of the first.
                if (pass == 0 || !matches!(event, Event::SceneOutput(_) | Event::Finding(_)))
                    && !stop.is_cancelled()
                {
                    self.reporter.report(event);
                }
            };
            let start = Instant::now();
            let Ok(picture) = series.draw(&self.input, &options, &render, &listen) else {
                self.reporter.take_counts();
                if !stop.is_cancelled() {
                    let errors = errors.into_inner().unwrap_or_else(PoisonError::into_inner);
                    self.shown.fail(errors);
                    say("povr: render failed; keeping the last picture");
                }
                return;
            };
            self.reporter.take_counts();
            let seconds = start.elapsed().as_secs_f64();
            self.show(&picture.film, picture.working, is_preview, seconds);
            if is_preview {
                continue;
            }
            if let Err(error) = self.write(&picture) {
                say(format_args!("povr: {error}"));
            }
            if !verbosity.quiet {
                say(format_args!("povr: drawn in {seconds:.2} s"));
            }
        }
    }

    /// The passes: a small picture without antialiasing first, unless the picture is small itself.
    fn passes(&self, stop: &CancelToken) -> Vec<RenderOptions> {
        let whole = RenderOptions {
            stop: stop.clone(),
            ..self.settings.render.clone()
        };
        let (width, height) = (whole.width, whole.height);
        let is_whole = (whole.columns.len(), whole.rows.len()) == (width as usize, height as usize);
        if !is_whole || u64::from(width) * u64::from(height) < SMALL {
            return vec![whole];
        }
        let (width, height) = ((width / PREVIEW).max(1), (height / PREVIEW).max(1));
        let preview = RenderOptions {
            width,
            height,
            columns: 0..width,
            rows: 0..height,
            sampling: Sampling::Centres,
            ..whole.clone()
        };
        vec![preview, whole]
    }

    fn show(&self, film: &Film, working: Option<Gamma>, is_preview: bool, seconds: f64) {
        let options = EncodeOptions {
            working,
            alpha: self.settings.render.alpha,
            ..EncodeOptions::new(Format::PNG)
        };
        let Ok(png) = output::encode(film, &options) else {
            return;
        };
        if !self.is_silent {
            terminal::show(&png, is_preview);
        }
        self.shown.put(Picture {
            png: png.into(),
            is_preview,
            seconds,
            size: (self.settings.render.width, self.settings.render.height),
        });
    }

    fn write(&self, picture: &crate::base::options::Picture) -> Result<(), CliError> {
        let Some((target, options)) = &self.settings.output else {
            return Ok(());
        };
        let options = EncodeOptions {
            working: picture.working,
            rounding: picture.rounding,
            ..options.clone()
        };
        Ok(output::write(&picture.film, target, &options)?)
    }
}
