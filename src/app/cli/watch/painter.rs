//! One rendering for `povr watch`: a coarse picture first, then the whole one; both are shown. The worker compiles the
//! scene once for both, and keeps it for other cameras.

use std::cell::Cell;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use super::files::Known;
use super::shown::{Picture, Shown};
use super::terminal;
use super::wishes::{Pick, SceneWish, Wish, Wished, Wishes};
use crate::app::cli::draw::report::{Reporter, say};
use crate::app::cli::kernel;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::settings::Settings;
use crate::app::worker::{Control, Draw, Live, Lost, Report, Worker};
use crate::base::options::{Event, RenderOptions, Sampling};
use crate::base::source::Severity;
use crate::base::sync::lock;
use crate::output::{self, EncodeOptions, Format};
use crate::scene::camera::View;

/// Side of a picture over side of its preview, at first and at most.
pub(super) const PREVIEW: u32 = 4;
const COARSEST: u32 = 16;
/// Previews of a camera in motion become coarser above the longer of these times, and finer below the shorter.
const PREVIEW_TIMES: [Duration; 2] = [Duration::from_millis(8), Duration::from_millis(25)];
/// A picture that takes longer than this, as its preview tells, has a second preview. It takes a ninth of the time of the
/// picture at most.
const LONG: Duration = Duration::from_secs(1);
/// Time without new wishes after which the whole picture of a camera in motion is begun.
const REST: Duration = Duration::from_millis(60);
/// Pictures of fewer pixels have no preview.
const SMALL: u64 = 200 * 150;

/// Renders and shows pictures.
pub(super) struct Painter {
    pub(super) scene: PathBuf,
    pub(super) settings: Settings,
    pub(super) reporter: Reporter,
    pub(super) shown: Arc<Shown>,
    /// True to show nothing in the terminal.
    pub(super) is_silent: bool,
    pub(super) worker: Mutex<Option<Worker>>,
    pub(super) wishes: Arc<Wishes>,
    /// Side of a picture over side of its preview.
    pub(super) preview_side: AtomicU32,
    /// The number of the scene in the last whole picture, with its camera.
    pub(super) drawn: Mutex<Option<(u64, Option<View>)>>,
    /// The number of the last pixel that was reported on.
    pub(super) picked: Mutex<Option<u64>>,
}

/// A picture to draw.
#[derive(Debug)]
pub(super) struct Order {
    /// The number of the scene's text with its values; the scene is read again for a new one.
    pub(super) number: u64,
    /// The text, if it is not that of the file.
    pub(super) text: Option<String>,
    pub(super) wished: Wished,
    /// True if viewers have asked for it, and not a change of files.
    pub(super) is_wished: bool,
}

/// One picture of a drawing, or a report on one of its pixels.
struct Pass {
    render: RenderOptions,
    /// The number of the report, and the column and row of the pixel.
    pick: Option<(u64, (u32, u32))>,
}

impl Pass {
    fn picture(render: RenderOptions) -> Self {
        Pass { render, pick: None }
    }
}

impl Painter {
    /// Renders the preview and the picture, in a worker process, so that a scene cannot end the watch.
    pub(super) fn draw(&self, drawing: &Drawing, began: SystemTime, order: &Order) {
        let (errors, warnings) = (Mutex::new(String::new()), Mutex::new(String::new()));
        let is_reported =
            |event: &Event<'_>| !drawing.is_cancelled() && !matches!(event, Event::Drawn(_));
        let listen = |event: Event<'_>| {
            if let Event::Read { dependencies, .. } = event {
                let paths = dependencies.iter().map(|one| one.path.clone());
                let known = Known::of(paths.chain([self.scene.clone()]), began);
                *lock(&drawing.read) = Some(known);
            }
            if let Event::Finding(message) = event
                && !drawing.is_cancelled()
            {
                let findings = match message.severity {
                    Severity::Error => &errors,
                    Severity::Warning => &warnings,
                };
                lock(findings).push_str(&format!("{}\n", message.excerpt));
            }
            if is_reported(&event) {
                self.reporter.report(event);
            }
        };
        let wish = &order.wished.wish;
        let pick = wish
            .pick
            .filter(|pick| Some(pick.number) != *lock(&self.picked));
        let current = Some((order.number, wish.view.clone()));
        let is_drawn = *lock(&self.drawn) == current;
        let passes = self.passes().into_iter().map(Pass::picture);
        let passes = passes.filter(|_| !(is_drawn && pick.is_some()));
        let pick = pick.map(|pick| self.pick(pick));
        let mut passes: VecDeque<_> = pick.into_iter().chain(passes).collect();
        let mut has_better = false;
        while let Some(pass) = passes.pop_front() {
            let is_preview = pass.render.width < self.settings.render.width;
            let pick = pass.pick;
            if pick.is_none() {
                *lock(&self.drawn) = None;
            }
            // Each pass reads the scene anew.
            lock(&warnings).clear();
            let start = Instant::now();
            let draw = self.order(pass, order);
            let drawn = self.drawn(draw, (drawing, is_preview), order, &listen);
            let seconds = start.elapsed().as_secs_f64();
            self.reporter.take_counts();
            if drawn.is_err() && drawing.is_cancelled() {
                return;
            }
            if let Some((number, _)) = pick {
                *lock(&self.picked) = Some(number);
            }
            let (files, traced) = match drawn {
                Ok(drawn) => drawn,
                Err(lost) => {
                    let errors = errors.into_inner().unwrap_or_else(PoisonError::into_inner);
                    return self.fail(errors, lost);
                }
            };
            if pick.is_some() {
                continue;
            }
            let mut files = files.into_iter();
            let warnings = std::mem::take(&mut *lock(&warnings));
            let png = files.next().unwrap_or_default();
            self.show(png, is_preview, seconds, warnings);
            if is_preview {
                if !has_better {
                    has_better = true;
                    if let Some(better) = self.better_preview(traced) {
                        passes.push_front(Pass::picture(better));
                    }
                    self.adapt(traced);
                }
                if order.is_wished {
                    drawing.wait_for_wishes(REST);
                }
                continue;
            }
            (*lock(&self.drawn)).clone_from(&current);
            self.store(files.next());
            if !self.settings.verbosity.quiet {
                say(format_args!("povr: drawn in {seconds:.2} s"));
            }
        }
    }

    /// The pass that reports on a pixel.
    fn pick(&self, pick: Pick) -> Pass {
        let render = self.settings.render.clone();
        let [x, y] = pick.position;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of the size of a picture"
        )]
        let [column, row] =
            [x * f64::from(render.width), y * f64::from(render.height)].map(|part| part as u32);
        Pass {
            render,
            pick: Some((pick.number, (column, row))),
        }
    }

    /// The order for the worker of a pass. Only the picture of the file as it is has an output.
    fn order(&self, Pass { render, pick }: Pass, order: &Order) -> Draw {
        let Wish { view, scene, .. } = &order.wished.wish;
        let is_unchanged = view.is_none() && *scene == SceneWish::default();
        let is_output = render.width == self.settings.render.width && is_unchanged;
        let output = self.settings.output.as_ref().filter(|_| is_output);
        let mut read = self.settings.read.clone();
        scene.declare(&mut read);
        Draw {
            scene: self.scene.clone(),
            series: Some(usize::try_from(order.number).unwrap_or_default()),
            read,
            render,
            files: match pick {
                Some(_) => Vec::new(),
                None => [self.png()]
                    .into_iter()
                    .chain(output.map(|(_, options)| options.clone()))
                    .collect(),
            },
            threads: None,
            tells_output: true,
            timeout: self.settings.timeout,
            max_memory: self.settings.max_memory,
            is_sandboxed: self.settings.is_sandboxed,
            live: Some(Live {
                number: order.number,
                text: order.text.clone(),
                camera: view.as_ref().map(View::to_string),
                pick: pick.map(|(_, pixel)| pixel),
            }),
        }
    }

    /// Stores the file of a picture.
    fn store(&self, file: Option<Vec<u8>>) {
        if let (Some((target, _)), Some(bytes)) = (&self.settings.output, file)
            && let Err(error) = output::put(&bytes, target)
        {
            say(format_args!("povr: {}", CliError::from(error)));
        }
    }

    /// Says why there is no picture, beside the errors of the scene.
    fn fail(&self, mut errors: String, lost: Lost) {
        if let Some(reason) = self.reason(lost) {
            say(format_args!("povr: {reason}"));
            errors.push_str(&reason);
        }
        self.shown.fail(errors);
        say("povr: render failed; keeping the last picture");
    }

    /// The encoding of the picture on the page: that of the output, if it is a PNG file.
    fn png(&self) -> EncodeOptions {
        let output = self.settings.output.as_ref().map(|(_, options)| options);
        let png = output.filter(|options| options.format == Format::PNG);
        png.cloned().unwrap_or_else(|| EncodeOptions {
            alpha: self.settings.render.alpha,
            ..EncodeOptions::new(Format::PNG)
        })
    }

    /// Adapts the size of the next preview to the time of one.
    fn adapt(&self, time: Duration) {
        let [short, long] = PREVIEW_TIMES;
        let side = self.preview_side.load(Ordering::Relaxed);
        let side = match time {
            _ if time > long => (side + 1).min(COARSEST),
            _ if time < short => (side - 1).max(2),
            _ => side,
        };
        self.preview_side.store(side, Ordering::Relaxed);
    }

    /// The files of a picture, from the worker of the last picture or a new one, and the time to trace it.
    fn drawn(
        &self,
        draw: Draw,
        (drawing, is_preview): (&Drawing, bool),
        order: &Order,
        listen: &dyn Fn(Event<'_>),
    ) -> Result<(Vec<Vec<u8>>, Duration), Lost> {
        let mut worker = lock(&self.worker);
        let worker = Worker::ready(&mut worker)
            .map_err(|error| Lost::Failed(Some(format!("no process to draw in: {error}"))))?;
        drawing.begin(worker.control(), is_preview)?;
        let wished = &order.wished;
        let read = (wished.source.number, &wished.wish.scene.edits);
        let traced = Cell::default();
        let files = worker.draw(draw, listen, &|report| match report {
            Report::Weaker(lack) => kernel::warn(&[lack]),
            Report::Camera(camera) => self.wishes.take_camera(*camera, read),
            Report::Traced(time) => traced.set(time),
            Report::Picked(picked) => self.shown.pick(*picked),
        })?;
        Ok((files, traced.get()))
    }

    /// The reason that there is no picture, unless the messages of the scene give it.
    fn reason(&self, lost: Lost) -> Option<String> {
        match lost {
            Lost::Failed(reason) => reason,
            Lost::Limit(limit) => {
                let excess = limit.excess(self.settings.timeout, self.settings.max_memory);
                Some(format!("it {excess}"))
            }
            Lost::Ended { reason, .. } => Some(reason),
        }
    }

    /// The passes: a preview first, unless the picture is small itself.
    fn passes(&self) -> Vec<RenderOptions> {
        let whole = self.settings.render.clone();
        let (width, height) = (whole.width, whole.height);
        let is_whole = (whole.columns.len(), whole.rows.len()) == (width as usize, height as usize);
        if !is_whole || u64::from(width) * u64::from(height) < SMALL {
            return vec![whole];
        }
        vec![
            self.preview(self.preview_side.load(Ordering::Relaxed)),
            whole,
        ]
    }

    /// A preview between the first, which took this time, and a picture that takes long.
    fn better_preview(&self, time: Duration) -> Option<RenderOptions> {
        let first = self.preview_side.load(Ordering::Relaxed);
        let side = match self.settings.render.sampling {
            Sampling::Centres => 3,
            Sampling::PovRay(_) | Sampling::Adaptive(_) => 2,
        };
        let is_long = time.saturating_mul(first * first) > LONG;
        (is_long && side < first).then(|| self.preview(side))
    }

    /// The picture without antialiasing in a smaller size, for a side that is this part of the whole.
    fn preview(&self, side: u32) -> RenderOptions {
        let whole = &self.settings.render;
        let (width, height) = ((whole.width / side).max(1), (whole.height / side).max(1));
        RenderOptions {
            width,
            height,
            columns: 0..width,
            rows: 0..height,
            sampling: Sampling::Centres,
            ..whole.clone()
        }
    }

    fn show(&self, png: Vec<u8>, is_preview: bool, seconds: f64, warnings: String) {
        if !self.is_silent {
            terminal::show(&png, is_preview);
        }
        self.shown.put(Picture {
            png: png.into(),
            is_preview,
            seconds,
            size: (self.settings.render.width, self.settings.render.height),
            warnings,
        });
    }
}

/// One rendering of the current files.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    /// The files that the scene has read, once it has.
    read: Mutex<Option<Known>>,
    progress: Mutex<Progress>,
    /// Notified when other wishes have come, or files have changed.
    superseded: Condvar,
}

#[derive(Debug, Default)]
struct Progress {
    /// The worker of the current pass.
    pass: Option<Control>,
    /// True for a preview.
    is_preview: bool,
    /// True if the wishes have changed: a preview is finished, so that a camera in motion is seen, and the picture is not
    /// begun.
    is_superseded: bool,
    is_cancelled: bool,
}

impl Drawing {
    /// Begins a pass; an error if the drawing is cancelled.
    fn begin(&self, control: Control, is_preview: bool) -> Result<(), Lost> {
        let mut progress = lock(&self.progress);
        progress.pass = Some(control);
        progress.is_preview = is_preview;
        progress.is_cancelled |= progress.is_superseded && !is_preview;
        match progress.is_cancelled {
            false => Ok(()),
            true => Err(Lost::Failed(None)),
        }
    }

    /// Ends the drawing, as other wishes have come, after a preview that is in progress.
    pub(super) fn supersede(&self) {
        let is_preview = {
            let mut progress = lock(&self.progress);
            progress.is_superseded = true;
            self.superseded.notify_all();
            progress.pass.is_none() || progress.is_preview
        };
        if !is_preview {
            self.cancel();
        }
    }

    /// Waits for other wishes, for this time at most.
    fn wait_for_wishes(&self, time: Duration) {
        let is_current =
            |progress: &mut Progress| !progress.is_superseded && !progress.is_cancelled;
        let progress = lock(&self.progress);
        drop(
            self.superseded
                .wait_timeout_while(progress, time, is_current),
        );
    }

    /// Returns the files that the scene has read, once.
    pub(super) fn take_read(&self) -> Option<Known> {
        lock(&self.read).take()
    }

    /// Cancels the drawing.
    pub(super) fn cancel(&self) {
        let mut progress = lock(&self.progress);
        if !std::mem::replace(&mut progress.is_cancelled, true) {
            self.superseded.notify_all();
            if let Some(control) = &progress.pass {
                control.stop();
            }
        }
    }

    fn is_cancelled(&self) -> bool {
        lock(&self.progress).is_cancelled
    }
}
