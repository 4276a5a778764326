//! A worker process: draws pictures for the command that has started it ([`crate::app::worker`]).

mod live;
mod map;
mod mosaic;

use super::draw::limits::{Limits, Watch};
use super::draw::report::say;
use super::kernel;
use crate::RenderSession;
use crate::app::worker::{COMMAND, Draw, LONGEST_PARTIAL, Reply, Report, Request};
use crate::base::options::{CancelToken, Event, Failure, Input};
use crate::base::sync::lock;
use crate::output::{self, EncodeOptions};
use live::{LiveProduct, LiveScene, LiveScenes};
use std::any::Any;
use std::io::{self, Stdout, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{self, ExitCode};
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Interval of progress messages.
const INTERVAL: Duration = Duration::from_millis(50);
/// Time for a cancelled picture to end by itself when the command has ended.
const GRACE: Duration = Duration::from_secs(1);

/// Draws pictures until standard input ends.
pub(super) fn run() -> ExitCode {
    ignore_interrupts();
    continue_after_parent();
    let Ok(Request::Draw(first)) = Request::read(&mut io::stdin()) else {
        say(format_args!(
            "povr: `{COMMAND}` is for processes that povr starts itself, not for the command line"
        ));
        return ExitCode::FAILURE;
    };
    // Threads that are started later have the same priority.
    if first.is_background {
        lower_priority();
    }
    let replies = Arc::new(Replies::new());
    // Before any thread is started, so that the sandbox holds for all.
    if first.is_sandboxed {
        for lack in kernel::enter_to_draw_one(&first.scene, &first.read) {
            replies.send(&Reply::Report(Report::Weaker(lack)));
        }
    }
    let (sender, waiting) = mpsc::channel();
    let control = Control::default();
    let _ = sender.send((first, control.clone()));
    let receiving = thread::Builder::new()
        .name("requests".to_owned())
        .spawn(move || receive(&sender, control));
    if receiving.is_err() {
        return ExitCode::FAILURE;
    }
    let mut worker = Worker {
        replies,
        pool: None,
        session: None,
        live: LiveScenes::default(),
    };
    for (draw, control) in waiting {
        worker.draw(*draw, &control);
    }
    ExitCode::SUCCESS
}

/// Ignores Ctrl-C: it ends the command, and then this process, which removes its temporary files first.
fn ignore_interrupts() {
    #[cfg(unix)]
    {
        use signal_hook::{consts::SIGINT, flag};
        // If no handler can be installed, the default remains.
        let _ = flag::register(SIGINT, Arc::default());
    }
}

/// Gives this process the lowest priority.
fn lower_priority() {
    #[cfg(unix)]
    {
        const LOWEST: i32 = 19;
        // Where the system refuses, it has the priority of the others.
        let _ = rustix::process::nice(LOWEST);
    }
}

/// Lets the kernel continue this process when the command ends, so that a stopped worker finds its standard input at an
/// end too. A command that ends before this call has closed the pipe already, and a signal that comes early, with the
/// thread that has started this process, changes nothing. The signal is not SIGKILL: a worker removes its temporary files.
fn continue_after_parent() {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{Signal, set_parent_process_death_signal};
        // Where the kernel refuses, a stopped worker waits for its own `SIGCONT`.
        let _ = set_parent_process_death_signal(Some(Signal::CONT));
    }
}

/// Passes requests on; ends the process when there are no more.
fn receive(sender: &Sender<(Box<Draw>, Control)>, mut control: Control) {
    while let Ok(request) = Request::read(&mut io::stdin()) {
        match request {
            Request::Stop => control.stop.cancel(),
            Request::Threads(count) => control.gate.admit(count),
            Request::Draw(draw) => {
                control = Control::default();
                if sender.send((draw, control.clone())).is_err() {
                    break;
                }
            }
        }
    }
    // The command has ended. A cancelled picture removes its temporary files.
    control.stop.cancel();
    control.gate.open();
    thread::sleep(GRACE);
    process::exit(1);
}

/// The control of one picture by the command.
#[derive(Clone, Default)]
struct Control {
    stop: CancelToken,
    gate: Arc<Gate>,
}

/// Render threads, each of which is started when a picture first uses it.
struct Pool {
    threads: Arc<rayon::ThreadPool>,
    state: Mutex<PoolState>,
}

struct PoolState {
    running: usize,
    unstarted: Vec<rayon::ThreadBuilder>,
}

impl Pool {
    fn new(threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let mut unstarted = Vec::new();
        let pool = crate::pool_builder(threads)
            .spawn_handler(|thread| {
                unstarted.push(thread);
                Ok(())
            })
            .build()?;
        Ok(Pool {
            threads: Arc::new(pool),
            state: Mutex::new(PoolState {
                running: 0,
                unstarted,
            }),
        })
    }

    /// Starts threads until this number runs, or there are no more; returns the number that runs.
    fn start(&self, count: usize) -> usize {
        let mut state = lock(&self.state);
        while state.running < count
            && let Some(thread) = state.unstarted.pop()
        {
            let builder =
                thread::Builder::new().stack_size(thread.stack_size().unwrap_or_default());
            if builder.spawn(move || thread.run()).is_err() {
                break;
            }
            state.running += 1;
        }
        state.running
    }
}

/// A gate at which some threads of a pool wait.
#[derive(Default)]
struct Gate {
    state: Mutex<GateState>,
    changed: Condvar,
}

#[derive(Default)]
struct GateState {
    pool: Option<Arc<Pool>>,
    /// Threads of the pool that run.
    running: usize,
    /// Threads that may work.
    admitted: usize,
    /// Tasks of waiting that have been started.
    started: usize,
    waiting: usize,
}

impl Gate {
    /// Makes all threads of an idle pool wait but `admitted`, which are started. Returns when all tasks of waiting are
    /// started, so that no thread that draws takes one.
    ///
    /// # Errors
    /// When the system gives no thread.
    fn hold(self: &Arc<Self>, pool: &Arc<Pool>, admitted: usize) -> Result<(), String> {
        let held = pool.start(1).saturating_sub(admitted.max(1));
        lock(&self.state).pool = Some(Arc::clone(pool));
        self.admit(admitted.max(1));
        if lock(&self.state).running == 0 {
            return Err("no threads to draw with".to_owned());
        }
        for _ in 0..held {
            let gate = Arc::clone(self);
            pool.threads.spawn(move || gate.wait());
        }
        let starts = |state: &mut GateState| state.started < held;
        drop(self.changed.wait_while(lock(&self.state), starts));
        Ok(())
    }

    fn wait(&self) {
        let mut state = lock(&self.state);
        state.started += 1;
        state.waiting += 1;
        self.changed.notify_all();
        let is_held = |state: &mut GateState| state.running - state.waiting >= state.admitted;
        let waited = self.changed.wait_while(state, is_held);
        waited.unwrap_or_else(PoisonError::into_inner).waiting -= 1;
    }

    /// Lets this number of threads work, if it is more than before.
    fn admit(&self, count: usize) {
        let mut state = lock(&self.state);
        state.admitted = state.admitted.max(count);
        let admitted = state.admitted;
        if let Some(running) = state.pool.as_ref().map(|pool| pool.start(admitted)) {
            state.running = running;
        }
        self.changed.notify_all();
    }

    /// Lets all threads go, at the end of the picture.
    fn open(&self) {
        let mut state = lock(&self.state);
        state.pool = None;
        state.admitted = usize::MAX;
        self.changed.notify_all();
    }
}

/// The state between pictures.
struct Worker {
    replies: Arc<Replies>,
    pool: Option<Arc<Pool>>,
    /// The series that was drawn last.
    session: Option<(usize, RenderSession)>,
    live: LiveScenes,
}

impl Worker {
    fn draw(&mut self, draw: Draw, control: &Control) {
        let replies = Arc::clone(&self.replies);
        let limits = Limits::new(draw.timeout, draw.max_memory);
        let watch = Watch::start(limits, Some(control.stop.clone()), move |limit| {
            replies.send(&Reply::Limit(limit));
        });
        let drawn = catch_unwind(AssertUnwindSafe(|| self.files(draw, control)));
        control.gate.open();
        drop(watch);
        match drawn {
            Ok(Ok(files)) => self.replies.finish(&files),
            Ok(Err(reason)) => self.replies.fail(reason),
            Err(panic) => self.replies.fail(Some(format!(
                "internal error: {}; please report it with the scene",
                words(&*panic)
            ))),
        }
    }

    /// Draws a picture and encodes its files; the error is `None` if the findings give the reason.
    fn files(&mut self, draw: Draw, control: &Control) -> Result<Vec<Vec<u8>>, Option<String>> {
        let Draw {
            mut read,
            mut render,
            mut live,
            files,
            ..
        } = draw;
        // Before anything can fail: the next change of the text builds on it.
        let input = live.as_mut().map(|live| self.live.input(&draw.scene, live));
        (read.stop, render.stop) = (control.stop.clone(), control.stop.clone());
        let stop = &control.stop;
        let replies = Arc::clone(&self.replies);
        let listen = |event: Event<'_>| match event {
            Event::SceneOutput(_) if !draw.tells_output => {}
            // Without all replies there is no picture.
            event => match replies.report(event) {
                Sent::Whole => {}
                Sent::Nothing => stop.cancel(),
            },
        };
        let pool = match (&self.pool, render.threads) {
            (None, Some(threads)) => {
                let pool = Pool::new(threads).map_err(|error| Some(error.to_string()))?;
                Some(Arc::clone(self.pool.insert(Arc::new(pool))))
            }
            (pool, _) => pool.clone(),
        };
        if let Some(pool) = &pool {
            let admitted = draw.threads.unwrap_or(usize::MAX);
            control.gate.hold(pool, admitted).map_err(Some)?;
        }
        let pool = pool.map(|pool| Arc::clone(&pool.threads));
        let single;
        let session = match (draw.series, &mut self.session) {
            (None, session) => {
                *session = None;
                single = RenderSession::of_one(pool);
                &single
            }
            (Some(series), session) => {
                if session.as_ref().is_none_or(|(known, _)| *known != series) {
                    *session = Some((series, RenderSession::new(pool)));
                }
                &session.as_ref().expect("there is one now").1
            }
        };
        let drawn = match live.as_mut().zip(input) {
            None => session.draw(&Input::File(draw.scene), &read, &render, &listen),
            Some((live, input)) => {
                let scene = LiveScene {
                    path: &draw.scene,
                    session,
                    read: &read,
                    render: &render,
                    listen: &listen,
                };
                let encode = files.first();
                match self
                    .live
                    .draw(&scene, (live, &input), encode, &self.replies)
                {
                    Ok(LiveProduct::Files(files)) => return Ok(files),
                    Ok(LiveProduct::Picture(picture)) => Ok(*picture),
                    Err(failure) => Err(failure),
                }
            }
        };
        let drawn = drawn.map_err(|Failure { .. }| None)?;
        let of_scene = |options: &EncodeOptions| options.for_scene(drawn.working, drawn.rounding);
        let of_page = files.first().map(of_scene);
        let encoded = files.iter().map(|options| {
            let options = of_scene(options);
            output::encode(&drawn.film, &options).map_err(|refused| Some(refused.to_string()))
        });
        let encoded = encoded.collect();
        if let Some(live) = &live {
            self.live.store(live, drawn.film, of_page);
        }
        encoded
    }
}

/// Standard output.
struct Replies(Mutex<Pipe>);

struct Pipe {
    out: io::BufWriter<Stdout>,
    /// Pixels drawn but not reported.
    pixels: u64,
    reported: Instant,
    /// The reason that a reply about this picture could not be sent: it is too long, for example.
    unsent: Option<String>,
}

/// The outcome of sending a reply.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sent {
    Whole,
    Nothing,
}

impl Replies {
    fn new() -> Self {
        Replies(Mutex::new(Pipe {
            out: io::BufWriter::new(io::stdout()),
            pixels: 0,
            reported: Instant::now(),
            unsent: None,
        }))
    }

    /// Sends the reply that stands for an event; progress only once in an interval.
    fn report(&self, event: Event<'_>) -> Sent {
        let Event::Drawn(pixels) = event else {
            return Reply::of(event).map_or(Sent::Whole, |reply| self.send(&reply));
        };
        let mut pipe = lock(&self.0);
        pipe.pixels += pixels;
        if pipe.reported.elapsed() > INTERVAL {
            pipe.send_pixels();
            let _ = pipe.out.flush();
        }
        Sent::Whole
    }

    /// Sends the file of a picture in progress, unless it is too long.
    fn partial(&self, file: &[u8]) {
        let length = file.len() as u64;
        if length > LONGEST_PARTIAL {
            return;
        }
        let mut pipe = lock(&self.0);
        pipe.send_pixels();
        if pipe.send(&Reply::Partial(length)) == Sent::Whole {
            let _ = pipe.out.write_all(file);
        }
        let _ = pipe.out.flush();
    }

    fn send(&self, reply: &Reply) -> Sent {
        let mut pipe = lock(&self.0);
        pipe.send_pixels();
        let sent = pipe.send(reply);
        let _ = pipe.out.flush();
        sent
    }

    /// Sends the files of a picture, or the reason that the replies before them are not all there.
    fn finish(&self, files: &[Vec<u8>]) {
        let mut pipe = lock(&self.0);
        pipe.send_pixels();
        if pipe.unsent.is_some() {
            drop(pipe);
            return self.fail(None);
        }
        pipe.send(&Reply::Done(
            files.iter().map(|file| file.len() as u64).collect(),
        ));
        for file in files {
            let _ = pipe.out.write_all(file);
        }
        let _ = pipe.out.flush();
    }

    /// Reports that there is no picture.
    fn fail(&self, reason: Option<String>) {
        let mut pipe = lock(&self.0);
        pipe.send_pixels();
        let reason = pipe.unsent.take().or(reason);
        if pipe.send(&Reply::Failed(reason)) == Sent::Nothing {
            let reason = pipe.unsent.take();
            pipe.send(&Reply::Failed(reason));
        }
        let _ = pipe.out.flush();
    }
}

impl Pipe {
    fn send_pixels(&mut self) {
        let pixels = std::mem::take(&mut self.pixels);
        self.reported = Instant::now();
        if pixels > 0 {
            self.send(&Reply::Drawn(pixels));
        }
    }

    /// A command that has ended receives nothing; the worker ends by itself then.
    fn send(&mut self, reply: &Reply) -> Sent {
        match reply.encoded() {
            Ok(bytes) => {
                let _ = self.out.write_all(&bytes);
                Sent::Whole
            }
            Err(error) => {
                let reason = || format!("a message of this scene cannot be passed on: {error}");
                self.unsent.get_or_insert_with(reason);
                Sent::Nothing
            }
        }
    }
}

/// The message of a panic.
fn words(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("a panic without a message")
}
