//! A worker process: draws pictures for the command that has started it ([`crate::app::worker`]).

use super::draw::limits::{Limits, Watch};
use super::kernel;
use crate::RenderSession;
use crate::app::worker::{Draw, Reply, Request, read_message, write_message};
use crate::base::options::{CancelToken, Event, Failure, Input};
use crate::output::{self, EncodeOptions};
use std::any::Any;
use std::io::{self, Stdout, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{self, ExitCode};
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Interval of progress messages.
const INTERVAL: Duration = Duration::from_millis(50);
/// Time for a cancelled picture to end by itself when the command has ended.
const GRACE: Duration = Duration::from_secs(1);

/// Draws pictures until standard input ends.
pub(super) fn run() -> ExitCode {
    let Ok(Request::Draw(first)) = read_message(&mut io::stdin()) else {
        return ExitCode::FAILURE;
    };
    let replies = Arc::new(Replies::new());
    // Before any thread is started, so that the sandbox holds for all.
    if first.is_sandboxed {
        for lack in kernel::enter_to_draw_one(&first.scene, &first.read) {
            replies.send(&Reply::Weaker(lack));
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
    };
    for (draw, control) in waiting {
        worker.draw(*draw, &control);
    }
    ExitCode::SUCCESS
}

/// Passes requests on; ends the process when there are no more.
fn receive(sender: &Sender<(Box<Draw>, Control)>, mut control: Control) {
    while let Ok(request) = read_message(&mut io::stdin()) {
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
    control.gate.admit(usize::MAX);
    thread::sleep(GRACE);
    process::exit(1);
}

/// The control of one picture by the command.
#[derive(Clone, Debug, Default)]
struct Control {
    stop: CancelToken,
    gate: Arc<Gate>,
}

/// A gate at which some threads of a pool wait.
#[derive(Debug, Default)]
struct Gate {
    state: Mutex<GateState>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct GateState {
    /// Threads of the pool.
    all: usize,
    /// Threads that may work.
    admitted: usize,
    /// Tasks of waiting that have been started.
    started: usize,
    waiting: usize,
}

impl Gate {
    /// Makes all threads of an idle pool wait but `admitted`. Returns when all tasks of waiting are started, so that no
    /// thread that draws takes one.
    fn hold(self: &Arc<Self>, pool: &rayon::ThreadPool, admitted: usize) {
        let all = pool.current_num_threads();
        let held = all.saturating_sub(admitted.max(1));
        self.state().all = all;
        self.admit(admitted.max(1));
        for _ in 0..held {
            let gate = Arc::clone(self);
            pool.spawn(move || gate.wait());
        }
        let starts = |state: &mut GateState| state.started < held;
        drop(self.changed.wait_while(self.state(), starts));
    }

    fn wait(&self) {
        let mut state = self.state();
        state.started += 1;
        state.waiting += 1;
        self.changed.notify_all();
        let is_held = |state: &mut GateState| state.all - state.waiting >= state.admitted;
        let waited = self.changed.wait_while(state, is_held);
        waited.unwrap_or_else(PoisonError::into_inner).waiting -= 1;
    }

    /// Lets this number of threads work, if it is more than before.
    fn admit(&self, count: usize) {
        let mut state = self.state();
        state.admitted = state.admitted.max(count);
        self.changed.notify_all();
    }

    fn state(&self) -> MutexGuard<'_, GateState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The state between pictures.
struct Worker {
    replies: Arc<Replies>,
    pool: Option<Arc<rayon::ThreadPool>>,
    /// The series that was drawn last.
    session: Option<(usize, RenderSession)>,
}

impl Worker {
    fn draw(&mut self, draw: Draw, control: &Control) {
        let replies = Arc::clone(&self.replies);
        let limits = Limits::new(draw.timeout, draw.max_memory);
        let watch = Watch::start(limits, Some(control.stop.clone()), move |limit| {
            replies.send(&Reply::Limit(limit));
        });
        let drawn = catch_unwind(AssertUnwindSafe(|| self.files(draw, control)));
        control.gate.admit(usize::MAX);
        drop(watch);
        match drawn {
            Ok(Ok(files)) => self.replies.finish(&files),
            Ok(Err(reason)) => self.replies.send(&Reply::Failed(reason)),
            Err(panic) => self.replies.send(&Reply::Failed(Some(format!(
                "povr broke down: {}; please report it with the scene",
                words(&*panic)
            )))),
        }
    }

    /// Draws a picture and encodes its files; the error is `None` if the findings give the reason.
    fn files(&mut self, draw: Draw, control: &Control) -> Result<Vec<Vec<u8>>, Option<String>> {
        let Draw {
            mut read,
            mut render,
            files,
            ..
        } = draw;
        (read.stop, render.stop) = (control.stop.clone(), control.stop.clone());
        let replies = Arc::clone(&self.replies);
        let listen = |event: Event<'_>| match event {
            Event::SceneOutput(_) if !draw.tells_output => {}
            event => replies.report(event),
        };
        let pool = match (&self.pool, render.threads) {
            (None, Some(threads)) => {
                let pool = crate::pool(threads, &listen).map_err(|_| None)?;
                Some(Arc::clone(self.pool.insert(Arc::new(pool))))
            }
            (pool, _) => pool.clone(),
        };
        if let (Some(pool), Some(threads)) = (&pool, draw.threads) {
            control.gate.hold(pool, threads);
        }
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
        let drawn = session.draw(&Input::File(draw.scene), &read, &render, &listen);
        let drawn = drawn.map_err(|Failure { .. }| None)?;
        let encoded = files.into_iter().map(|options| {
            let options = EncodeOptions {
                working: drawn.working,
                rounding: drawn.rounding,
                ..options
            };
            output::encode(&drawn.film, &options).map_err(|refused| Some(refused.to_string()))
        });
        encoded.collect()
    }
}

/// Standard output.
struct Replies(Mutex<Pipe>);

struct Pipe {
    out: io::BufWriter<Stdout>,
    /// Pixels drawn but not reported.
    pixels: u64,
    reported: Instant,
}

impl Replies {
    fn new() -> Self {
        Replies(Mutex::new(Pipe {
            out: io::BufWriter::new(io::stdout()),
            pixels: 0,
            reported: Instant::now(),
        }))
    }

    /// Sends the reply that stands for an event; progress only once in an interval.
    fn report(&self, event: Event<'_>) {
        let Event::Drawn(pixels) = event else {
            if let Some(reply) = Reply::of(event) {
                self.send(&reply);
            }
            return;
        };
        let mut pipe = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        pipe.pixels += pixels;
        if pipe.reported.elapsed() > INTERVAL {
            pipe.send_pixels();
            let _ = pipe.out.flush();
        }
    }

    fn send(&self, reply: &Reply) {
        let mut pipe = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        pipe.send_pixels();
        pipe.send(reply);
        let _ = pipe.out.flush();
    }

    /// Sends the files of a picture.
    fn finish(&self, files: &[Vec<u8>]) {
        let mut pipe = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        pipe.send_pixels();
        pipe.send(&Reply::Done(
            files.iter().map(|file| file.len() as u64).collect(),
        ));
        for file in files {
            let _ = pipe.out.write_all(file);
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
    fn send(&mut self, reply: &Reply) {
        let _ = write_message(&mut self.out, reply);
    }
}

/// The message of a panic.
fn words(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("nobody knows why")
}
