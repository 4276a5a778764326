//! One rendering for `povr watch`: a coarse picture first, then the whole one; both are shown. The worker compiles the
//! scene once for both, and keeps it for other cameras and other textures.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use super::files::Known;
use super::povray;
use super::scenes::SceneFile;
use super::shown::{Overlaid, Picture, Shown};
use super::terminal;
use super::wishes::{Overlay, Pick, SceneWish, Wish, Wished, Wishes};
use crate::app::cli::draw::report::{Reporter, say};
use crate::app::cli::kernel;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::settings::Settings;
use crate::app::worker::{
    Control, Draw, Live, LiveTask, LiveText, Lost, MapKind, MapReport, PictureKey, Report, Splice,
    Worker,
};
use crate::base::options::{CancelToken, Event, RenderOptions, Sampling};
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
/// The whole picture of a camera in motion is begun if no other wish comes for this long.
const REST: Duration = Duration::from_millis(60);
/// The larger side of a map of costs at most.
const MAP: u32 = 400;
/// Pictures of fewer pixels have no preview.
const SMALL: u64 = 200 * 150;

/// Renders and shows pictures.
pub(super) struct Painter {
    pub(super) scene: SceneFile,
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
    /// The last whole picture, with its number on the page.
    pub(super) delivered: Mutex<Option<(PictureKey, u64)>>,
    /// The number of the last pixel that was reported on.
    pub(super) picked: Mutex<Option<u64>>,
    /// The warnings of the scene of a number.
    pub(super) warnings: Mutex<(u64, String)>,
    /// The last view beside a picture, with the number and the camera of the scene.
    pub(super) overlaid: Mutex<Option<(Overlay, u64, Option<View>)>>,
}

/// A picture to draw.
#[derive(Debug)]
pub(super) struct Order {
    /// The number of the scene's text with its values; the scene is read again for a new one.
    pub(super) number: u64,
    /// The text, if it is not that of the file.
    pub(super) text: Option<String>,
    /// The change of the text since that of an earlier number.
    pub(super) change: Option<(u64, Splice)>,
    pub(super) wished: Wished,
    /// True if viewers have asked for it, and not a change of files.
    pub(super) is_wished: bool,
}

/// One task of a drawing.
struct Pass {
    render: RenderOptions,
    task: LiveTask,
}

/// Reports of a worker on its task.
#[derive(Debug, Default)]
struct News {
    traced: Duration,
    /// The number that the picture has on the page already, as a patch.
    number: Option<u64>,
    map: Option<MapReport>,
    statistics: Option<String>,
}

/// A view beside a picture: a PNG file, a note, and the scale of a map.
type OverlayPicture = (Vec<u8>, String, Option<MapReport>);

impl Painter {
    /// Renders the preview and the picture, in a worker process, so that a scene cannot end the watch.
    pub(super) fn draw(&self, drawing: &Drawing, began: SystemTime, order: &Order) {
        let taken = Instant::now();
        let errors = Mutex::new(String::new());
        // A scene that stays compiled is not read for each picture.
        let warnings = &self.warnings;
        if lock(warnings).0 != order.number {
            *lock(warnings) = (order.number, String::new());
        }
        let is_reported =
            |event: &Event<'_>| !drawing.is_cancelled() && !matches!(event, Event::Drawn(_));
        let listen = |event: Event<'_>| {
            if let Event::Read { dependencies, .. } = event {
                let paths = dependencies.iter().map(|one| one.path.clone());
                let known = Known::of(paths.chain([self.scene.path.clone()]), began);
                *lock(&drawing.read) = Some(known);
            }
            if let Event::Finding(message) = event
                && !drawing.is_cancelled()
            {
                let excerpt = format!("{}\n", message.excerpt);
                match message.severity {
                    Severity::Error => lock(&errors).push_str(&excerpt),
                    Severity::Warning => {
                        let warnings = &mut lock(warnings).1;
                        if !warnings.contains(&excerpt) {
                            warnings.push_str(&excerpt);
                        }
                    }
                }
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
        let is_drawn = order.is_wished && *lock(&self.drawn) == current;
        let passes = self.passes().into_iter().filter(|_| !is_drawn);
        let picked = pick.map(|pick| self.pick(pick));
        let mut passes: VecDeque<_> = picked.into_iter().chain(passes).collect();
        let mut has_better = false;
        while let Some(pass) = passes.pop_front() {
            let task = pass.task;
            let is_preview = task == LiveTask::Coarse;
            if is_preview || task == LiveTask::Whole {
                *lock(&self.drawn) = None;
            }
            let start = Instant::now();
            let draw = self.order(pass, order);
            // Of previews the first is finished when other wishes come.
            let finishes = is_preview && !has_better;
            let drawn = self.drawn(draw, (drawing, finishes), order, &listen);
            let seconds = start.elapsed().as_secs_f64();
            self.reporter.take_counts();
            if drawn.is_err() && drawing.is_cancelled() {
                return;
            }
            if let (LiveTask::Pixel(..), Some(pick)) = (task, pick) {
                *lock(&self.picked) = Some(pick.number);
            }
            let (files, news) = match drawn {
                Ok(drawn) => drawn,
                Err(lost) => {
                    let errors = errors.into_inner().unwrap_or_else(PoisonError::into_inner);
                    return self.fail(errors, lost);
                }
            };
            if let LiveTask::Pixel(..) = task {
                continue;
            }
            let traced = news.traced;
            if let Some(statistics) = news.statistics {
                self.shown.plan(&statistics);
            }
            let mut files = files.into_iter();
            let png = files.next().unwrap_or_default();
            if is_preview && png.is_empty() {
                continue;
            }
            let number = self.show(png, (is_preview, news.number), seconds);
            if is_preview {
                if !has_better {
                    has_better = true;
                    if let Some(better) = self.better_preview(traced) {
                        passes.push_front(better);
                    }
                    self.adapt(traced);
                }
                if order.is_wished {
                    drawing.wait_for_wishes(REST.saturating_sub(taken.elapsed()));
                }
                continue;
            }
            (*lock(&self.drawn)).clone_from(&current);
            let camera = wish.view.as_ref().map(View::to_string);
            *lock(&self.delivered) = Some(((order.number, camera), number));
            self.store(files.next());
            if !self.settings.verbosity.quiet {
                say(format_args!("povr: drawn in {seconds:.2} s"));
            }
        }
        self.overlay(drawing, order, &listen);
    }

    /// Draws the view beside the picture, unless it has been drawn.
    fn overlay(&self, drawing: &Drawing, order: &Order, listen: &dyn Fn(Event<'_>)) {
        let Wish { view, overlay, .. } = &order.wished.wish;
        let Some(overlay) = *overlay else {
            return;
        };
        let current = Some((overlay, order.number, view.clone()));
        if *lock(&self.overlaid) == current {
            return self.shown.overlay_again();
        }
        let start = Instant::now();
        let drawn = match overlay {
            Overlay::PovRay => self.by_povray(drawing, order),
            Overlay::Rays => self.map(MapKind::Rays, drawing, order, listen),
            Overlay::Time => self.map(MapKind::Time, drawing, order, listen),
            Overlay::Error => self.map(MapKind::Error, drawing, order, listen),
        };
        if drawing.is_cancelled() {
            return;
        }
        *lock(&self.overlaid) = current;
        let (png, note, scale) = match drawn {
            Ok((png, note, scale)) => (Some(png.into()), note, scale),
            Err(reason) => (None, reason, None),
        };
        self.shown.overlay(Overlaid {
            kind: overlay,
            png,
            note,
            scale,
            seconds: start.elapsed().as_secs_f64(),
        });
    }

    /// A map as a PNG file, with its scale.
    fn map(
        &self,
        kind: MapKind,
        drawing: &Drawing,
        order: &Order,
        listen: &dyn Fn(Event<'_>),
    ) -> Result<OverlayPicture, String> {
        let whole = &self.settings.render;
        let render = match kind {
            MapKind::Error => whole.clone(),
            MapKind::Rays | MapKind::Time => {
                self.smaller(whole.width.max(whole.height).div_ceil(MAP))
            }
        };
        let task = LiveTask::Map(kind);
        let draw = self.order(Pass { render, task }, order);
        let drawn = self.drawn(draw, (drawing, false), order, listen);
        self.reporter.take_counts();
        let no_map = || "no map has been drawn".to_owned();
        match drawn {
            Ok((files, News { map: Some(map), .. })) => {
                let png = files.into_iter().next().ok_or_else(no_map)?;
                Ok((png, String::new(), Some(map)))
            }
            Ok(_) => Err(no_map()),
            Err(lost) => Err(self.reason(lost).unwrap_or_default()),
        }
    }

    /// POV-Ray's picture as a PNG file, with a note on the differences.
    fn by_povray(&self, drawing: &Drawing, order: &Order) -> Result<OverlayPicture, String> {
        let stop = CancelToken::default();
        if drawing.begin(Stop::PovRay(stop.clone()), false).is_err() {
            return Err(String::new());
        }
        let wished = &order.wished;
        let Some(program) = &self.wishes.povray else {
            return Err(String::new());
        };
        let text = match &order.text {
            Some(text) => text,
            None => match &wished.source.text {
                Some(text) => text,
                None => return Err("the scene is not a text in UTF-8".to_owned()),
            },
        };
        let statement = self.wishes.camera_statement(wished);
        let text = povray::text(text, wished.wish.view.as_ref(), statement);
        let mut read = self.settings.read.clone();
        wished.wish.scene.declare(&mut read);
        let task = povray::Task {
            program,
            scene: &self.scene.path,
            text: &text,
            read: &read,
            render: &self.settings.render,
            stop: &stop,
        };
        let (png, version) = task.draw()?;
        let own = self.shown.png().unwrap_or_default();
        let note = povray::difference(&own, &png);
        Ok((png, format!("{version}; {note}"), None))
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
            task: LiveTask::Pixel(column, row),
        }
    }

    /// The order for the worker of a pass. Only the picture of the file as it is has an output.
    fn order(&self, Pass { render, task }: Pass, order: &Order) -> Draw {
        let Wish { view, scene, .. } = &order.wished.wish;
        let is_unchanged = view.is_none() && *scene == SceneWish::default();
        let is_output = task == LiveTask::Whole && is_unchanged;
        let output = self.settings.output.as_ref().filter(|_| is_output);
        let mut read = self.settings.read.clone();
        scene.declare(&mut read);
        Draw {
            scene: self.scene.path.clone(),
            series: Some(usize::try_from(order.number).unwrap_or_default()),
            read,
            render,
            files: match task {
                LiveTask::Pixel(..) => Vec::new(),
                _ => [self.png()]
                    .into_iter()
                    .chain(output.map(|(_, options)| options.clone()))
                    .collect(),
            },
            threads: None,
            tells_output: true,
            timeout: self.settings.timeout,
            max_memory: self.settings.max_memory,
            is_sandboxed: self.settings.is_sandboxed,
            is_background: false,
            live: Some(Live {
                number: order.number,
                // Once it is known which worker draws.
                text: LiveText::File,
                is_built_in: self.scene.built_in.is_some(),
                camera: view.as_ref().map(View::to_string),
                task,
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
        let side = next_side(self.preview_side.load(Ordering::Relaxed), time);
        self.preview_side.store(side, Ordering::Relaxed);
    }

    /// The files of a picture, from the worker of the last picture or a new one, and the time to trace it.
    fn drawn(
        &self,
        mut draw: Draw,
        (drawing, finishes): (&Drawing, bool),
        order: &Order,
        listen: &dyn Fn(Event<'_>),
    ) -> Result<(Vec<Vec<u8>>, News), Lost> {
        let mut worker = lock(&self.worker);
        let worker = Worker::ready(&mut worker)
            .map_err(|error| Lost::Failed(Some(format!("no process to draw in: {error}"))))?;
        drawing.begin(Stop::Worker(worker.control()), finishes)?;
        let wished = &order.wished;
        if let Some(live) = &mut draw.live {
            let whole = order.text.as_ref().or(wished.source.text.as_ref());
            let whole = whole.map(String::as_str);
            live.text = worker.text_for(order.number, order.change.as_ref(), whole);
        }
        let read = (wished.source.number, &wished.wish.scene.edits);
        let news = RefCell::new(News::default());
        let start = Instant::now();
        let files = worker.draw(draw, listen, &|report| match report {
            Report::Weaker(lack) => kernel::warn(&[lack]),
            Report::Camera(camera) => self.wishes.take_camera(*camera, read),
            Report::Traced(time) => news.borrow_mut().traced = time,
            Report::Map(map) => news.borrow_mut().map = Some(map),
            Report::Statistics(json) => news.borrow_mut().statistics = Some(json),
            Report::Picked(picked) => self.shown.pick(*picked),
            Report::Patch(patch) => {
                let delivered = lock(&self.delivered);
                let delivered = delivered.as_ref().filter(|(key, _)| *key == patch.over);
                if let Some((_, over)) = delivered.filter(|_| !drawing.is_cancelled()) {
                    news.borrow_mut().number = self.shown.patch(*over, *patch);
                }
            }
            Report::Partial(png) => {
                if !drawing.is_cancelled() {
                    self.show_on_page(png, (true, None), start.elapsed().as_secs_f64());
                }
            }
        })?;
        Ok((files, news.into_inner()))
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
    fn passes(&self) -> Vec<Pass> {
        let render = RenderOptions {
            // The worker takes them once the changed part of the picture is sent.
            statistics: false,
            ..self.settings.render.clone()
        };
        let (width, height) = (render.width, render.height);
        let is_whole =
            (render.columns.len(), render.rows.len()) == (width as usize, height as usize);
        let whole = Pass {
            render,
            task: LiveTask::Whole,
        };
        if !is_whole || u64::from(width) * u64::from(height) < SMALL {
            return vec![whole];
        }
        let side = self.preview_side.load(Ordering::Relaxed);
        vec![self.preview(side), whole]
    }

    /// A preview between the first, which took this time, and a picture that takes long.
    fn better_preview(&self, time: Duration) -> Option<Pass> {
        let first = self.preview_side.load(Ordering::Relaxed);
        let side = match self.settings.render.sampling {
            Sampling::Centres => 3,
            Sampling::PovRay(_) | Sampling::Adaptive(_) => 2,
        };
        let is_long = time.saturating_mul(first * first) > LONG;
        (is_long && side < first).then(|| self.preview(side))
    }

    fn preview(&self, side: u32) -> Pass {
        Pass {
            render: self.smaller(side),
            task: LiveTask::Coarse,
        }
    }

    /// The picture without antialiasing in a smaller size, for a side that is this part of the whole.
    fn smaller(&self, side: u32) -> RenderOptions {
        let whole = &self.settings.render;
        let (width, height) = ((whole.width / side).max(1), (whole.height / side).max(1));
        whole.coarse(width, height)
    }

    /// Shows a picture, which may have a number already; returns its number on the page.
    fn show(&self, png: Vec<u8>, kind: (bool, Option<u64>), seconds: f64) -> u64 {
        if !self.is_silent {
            let (is_preview, _) = kind;
            terminal::show(&png, is_preview);
        }
        self.show_on_page(png, kind, seconds)
    }

    fn show_on_page(
        &self,
        png: Vec<u8>,
        (is_preview, number): (bool, Option<u64>),
        seconds: f64,
    ) -> u64 {
        let picture = Picture {
            png: png.into(),
            is_preview,
            seconds,
            size: (self.settings.render.width, self.settings.render.height),
            warnings: lock(&self.warnings).1.clone(),
        };
        self.shown.put(picture, number)
    }
}

/// The side of the next preview, from that of one and its time, which falls with the square of the side.
fn next_side(side: u32, time: Duration) -> u32 {
    let [short, long] = PREVIEW_TIMES;
    let is_short_enough =
        |new: &u32| time.saturating_mul(side * side) <= long.saturating_mul(new * new);
    match time {
        _ if time > long => (side..COARSEST).find(is_short_enough).unwrap_or(COARSEST),
        _ if time < short => (side - 1).max(2),
        _ => side,
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
    /// Ends the current pass.
    pass: Option<Stop>,
    /// True for the first preview, which is finished when the wishes change, so that a camera in motion is seen.
    finishes: bool,
    /// True if the wishes have changed: nothing but such a pass is begun.
    is_superseded: bool,
    is_cancelled: bool,
}

/// Ends a pass.
#[derive(Debug)]
enum Stop {
    Worker(Control),
    PovRay(CancelToken),
}

impl Drawing {
    /// Begins a pass; an error if the drawing is cancelled.
    fn begin(&self, stop: Stop, finishes: bool) -> Result<(), Lost> {
        let mut progress = lock(&self.progress);
        progress.pass = Some(stop);
        progress.finishes = finishes;
        progress.is_cancelled |= progress.is_superseded && !finishes;
        match progress.is_cancelled {
            false => Ok(()),
            true => Err(Lost::Failed(None)),
        }
    }

    /// Ends the drawing, as other wishes have come, after a first preview that is in progress.
    pub(super) fn supersede(&self) {
        let finishes = {
            let mut progress = lock(&self.progress);
            progress.is_superseded = true;
            self.superseded.notify_all();
            progress.pass.is_none() || progress.finishes
        };
        if !finishes {
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
            match &progress.pass {
                Some(Stop::Worker(control)) => control.stop(),
                Some(Stop::PovRay(stop)) => stop.cancel(),
                None => {}
            }
        }
    }

    fn is_cancelled(&self) -> bool {
        lock(&self.progress).is_cancelled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn previews_take_no_longer_than_they_may() {
        let after = |side, milliseconds| next_side(side, Duration::from_millis(milliseconds));
        assert_eq!([after(4, 26), after(4, 100), after(4, 240)], [5, 8, 13]);
        assert_eq!([after(4, 90_000), after(16, 90_000)], [16, 16]);
        assert_eq!([after(16, 20), after(16, 5), after(2, 5)], [16, 15, 2]);
    }
}
