//! A run: what is not up to date is drawn, several pictures side by side.
//!
//! Workers read scenes, one each; all of them draw with the threads of one pool. What must not be beside other work is
//! left for the end and done alone: scenes that write files, that found too little memory, and very large pictures.

use std::any::Any;
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::fingerprint::{Fingerprints, now};
use super::journal::Journal;
use super::watchdog::Watchdog;
use super::{BatchError, Shard};
use crate::RenderSession;
use crate::base::options::{CancelToken, Event, Failure, Input, ReadOptions, RenderOptions};
use crate::base::source::{Code, Dependency, Message, Severity};
use crate::output::{self, EncodeOptions};

/// Pictures of more pixels are drawn alone: their films take a GiB and more.
const LARGE: u64 = 1 << 26;

/// A picture to draw.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The scene.
    pub scene: PathBuf,
    /// Pictures that follow each other and have the same number are frames of one animation.
    pub series: usize,
    /// Where it goes, below the folder of the run. The ending is that of the format.
    pub output: PathBuf,
    /// How to read the scene.
    pub read: ReadOptions,
    /// How to draw it; `threads` does not count.
    pub render: RenderOptions,
    /// How to write it; the working space is the scene's to tell.
    pub encode: EncodeOptions,
}

/// How a run is to be done.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// The folder of the pictures.
    pub out: PathBuf,
    /// How many scenes are read side by side; `None` takes as many as there are threads.
    pub jobs: Option<usize>,
    /// How many threads draw; `None` takes one for each core.
    pub threads: Option<usize>,
    /// After this time a picture counts as failed.
    pub timeout: Option<Duration>,
    /// Which part of the pictures is drawn; `None` draws all.
    pub shard: Option<Shard>,
    /// Whether what is up to date is drawn all the same.
    pub draws_all: bool,
}

/// What became of a picture.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Which picture of the list.
    pub picture: usize,
    /// What became of it.
    pub status: Status,
    /// How long it took in seconds.
    pub seconds: f64,
    /// What was found in the scene: errors and warnings.
    pub messages: Vec<Message>,
}

/// What became of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// It was drawn.
    Drawn,
    /// It was there, and would have been the same.
    UpToDate,
    /// It could not be drawn: why not, unless the messages tell.
    Failed(Option<String>),
}

/// What happens in a run. Comes from any thread.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// What is up to date has been told; this is left.
    Left {
        /// Pictures to draw.
        pictures: usize,
        /// Their pixels.
        pixels: u64,
    },
    /// So many pixels have been finished since the last event of this kind.
    Drawn(u64),
    /// A picture is done with.
    Done(&'a Outcome),
}

/// Draws what is not up to date. Pictures that fail are told among the news, and the others are drawn.
///
/// # Errors
/// When the folder cannot be written to at all, or another process is at work there.
pub fn run(
    pictures: &[Picture],
    batch: &Batch,
    hear: &(dyn Fn(News<'_>) + Sync),
) -> Result<(), BatchError> {
    let journal = Journal::open(&batch.out, batch.shard)?;
    let threads = batch
        .threads
        .unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.min(crate::MOST_THREADS))
        .build();
    let pool =
        pool.map_err(|error| BatchError::new(format!("no threads to draw with: {error}")))?;
    let run = Run {
        pictures,
        journal,
        pool: Arc::new(pool),
        fingerprints: Fingerprints::new(),
        watchdog: Watchdog::new(batch.timeout),
        is_part: batch.shard.is_some_and(|shard| shard.of > 1),
        timeout: batch.timeout,
        hear,
        state: Mutex::default(),
        changed: Condvar::new(),
    };
    let left = run.left(batch);
    let pixels = left.iter().map(|&index| pixels(&pictures[index])).sum();
    hear(News::Left {
        pictures: left.len(),
        pixels,
    });
    if !left.is_empty() {
        run.all(&left, batch.jobs.unwrap_or(threads).max(1));
    }
    run.journal.close()
}

/// A run under way.
struct Run<'a> {
    pictures: &'a [Picture],
    journal: Journal,
    pool: Arc<rayon::ThreadPool>,
    fingerprints: Fingerprints,
    watchdog: Watchdog,
    /// Whether other pictures of the list are drawn elsewhere.
    is_part: bool,
    timeout: Option<Duration>,
    hear: &'a (dyn Fn(News<'_>) + Sync),
    state: Mutex<State>,
    changed: Condvar,
}

/// What is to be done and what is being done.
#[derive(Default)]
struct State {
    waiting: VecDeque<Task>,
    /// How many tasks are under way; each may bring more.
    under_way: usize,
    /// What is to be done alone, in the end.
    alone: Vec<Task>,
}

/// A scene and the pictures of it that are to be drawn, one after the other.
#[derive(Debug)]
struct Task {
    pictures: VecDeque<usize>,
    series: Arc<RenderSession>,
    /// Whether frames before these were drawn on the understanding that the scene writes no files.
    follows: bool,
}

/// Whether other work is going on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Beside {
    Others,
    Nothing,
}

/// How an attempt ended.
enum Ended {
    Done(Outcome),
    /// It must be tried alone.
    Later,
}

impl Run<'_> {
    /// The pictures of this part that are not up to date; the others are told.
    fn left(&self, batch: &Batch) -> Vec<usize> {
        let records = self.journal.records();
        let is_done = |index: &usize| {
            let picture = &self.pictures[*index];
            let place = self.journal.place(&picture.output);
            let known = records.get(&picture.output).into_iter().flatten();
            let mut known = known.filter(|_| !batch.draws_all);
            known.any(|record| self.fingerprints.holds(record, picture, &place))
        };
        let is_mine = |index: &usize| batch.shard.is_none_or(|shard| shard.has(*index));
        let mine: Vec<usize> = (0..self.pictures.len()).filter(is_mine).collect();
        let done: Vec<bool> = self.pool.install(|| mine.par_iter().map(is_done).collect());
        let (done, left): (Vec<_>, Vec<_>) = mine.into_iter().zip(done).partition(|one| one.1);
        for (picture, _) in done {
            self.tell(Outcome {
                picture,
                status: Status::UpToDate,
                seconds: 0.0,
                messages: Vec::new(),
            });
        }
        left.into_iter().map(|(index, _)| index).collect()
    }

    fn all(&self, left: &[usize], jobs: usize) {
        {
            let mut state = self.lock();
            for frames in left.chunk_by(|&a, &b| self.series_of(a) == self.series_of(b)) {
                let pool = Some(Arc::clone(&self.pool));
                let task = Task {
                    pictures: frames.iter().copied().collect(),
                    series: Arc::new(match frames {
                        [_] => RenderSession::of_one(pool),
                        _ => RenderSession::new(pool),
                    }),
                    follows: false,
                };
                if pixels(&self.pictures[frames[0]]) > LARGE {
                    state.alone.push(task);
                } else {
                    state.waiting.push_back(task);
                }
            }
        }
        thread::scope(|scope| {
            scope.spawn(|| self.watchdog.run());
            let workers: Vec<_> = (0..jobs.min(left.len()))
                .map(|_| scope.spawn(|| self.work()))
                .collect();
            for worker in workers {
                // A worker cannot panic: what it draws is caught.
                let _ = worker.join();
            }
            let mut alone = std::mem::take(&mut self.lock().alone);
            alone.sort_by_key(|task| task.pictures.front().copied());
            for task in alone {
                for &index in &task.pictures {
                    if let Ended::Done(outcome) = self.attempt(index, &task, Beside::Nothing) {
                        self.tell(outcome);
                    }
                }
            }
            self.watchdog.end();
        });
    }

    /// Does tasks until there are none.
    fn work(&self) {
        while let Some(mut task) = self.next_task() {
            let Some(&index) = task.pictures.front() else {
                self.finished(Vec::new(), None);
                continue;
            };
            match self.attempt(index, &task, Beside::Others) {
                Ended::Later => self.finished(Vec::new(), Some(task)),
                Ended::Done(outcome) => {
                    self.tell(outcome);
                    task.pictures.pop_front();
                    let rest = task.pictures.into_iter().map(|index| Task {
                        pictures: [index].into(),
                        series: Arc::clone(&task.series),
                        follows: true,
                    });
                    self.finished(rest.collect(), None);
                }
            }
        }
    }

    fn next_task(&self) -> Option<Task> {
        let waits = |state: &mut State| state.waiting.is_empty() && state.under_way > 0;
        let waited = self.changed.wait_while(self.lock(), waits);
        let mut state = waited.unwrap_or_else(PoisonError::into_inner);
        let task = state.waiting.pop_front()?;
        state.under_way += 1;
        Some(task)
    }

    fn finished(&self, rest: Vec<Task>, alone: Option<Task>) {
        let mut state = self.lock();
        // Frames go before other scenes: their tokens are held as long as they wait.
        for task in rest.into_iter().rev() {
            state.waiting.push_front(task);
        }
        state.alone.extend(alone);
        state.under_way -= 1;
        self.changed.notify_all();
    }

    /// Draws a picture and puts it into its place.
    fn attempt(&self, index: usize, task: &Task, beside: Beside) -> Ended {
        let started = Instant::now();
        let stop = CancelToken::default();
        self.watchdog.watch(&stop);
        let heard = Mutex::new(Heard::default());
        let drawn = catch_unwind(AssertUnwindSafe(|| {
            self.draw(&self.pictures[index], task, beside, &stop, &heard)
        }));
        let messages = heard
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .messages;
        let has = |code: Code| messages.iter().any(|message| message.code == Some(code));
        let status = match drawn {
            Ok(Ok(())) => Status::Drawn,
            _ if stop.is_asked() => Status::Failed(Some(format!(
                "it took longer than {:?}, which `--timeout` allows",
                self.timeout.unwrap_or_default()
            ))),
            Ok(Err(_)) if has(Code::WritesFiles) && task.follows => Status::Failed(Some(
                "this animation writes files, but not in its first frame: draw it without `povr batch`"
                    .to_owned(),
            )),
            Ok(Err(_)) if has(Code::WritesFiles) && self.is_part && self.is_frame(index) => {
                Status::Failed(Some(
                    "the frames of this animation write files: draw them without `--shard`"
                        .to_owned(),
                ))
            }
            Ok(Err(_))
                if beside == Beside::Others && (has(Code::WritesFiles) || has(Code::Memory)) =>
            {
                return Ended::Later;
            }
            Ok(Err(why)) => Status::Failed(why),
            Err(panic) => Status::Failed(Some(format!("povr broke down: {}", words(&*panic)))),
        };
        Ended::Done(Outcome {
            picture: index,
            status,
            seconds: started.elapsed().as_secs_f64(),
            messages,
        })
    }

    /// The same, or why not, unless what was heard tells.
    fn draw(
        &self,
        picture: &Picture,
        task: &Task,
        beside: Beside,
        stop: &CancelToken,
        heard: &Mutex<Heard>,
    ) -> Result<(), Option<String>> {
        let since = now();
        let mut read = picture.read.clone();
        read.stop = stop.clone();
        if beside == Beside::Others {
            read.writable.clear();
        }
        let mut render = picture.render.clone();
        render.stop = stop.clone();
        render.only_for = Some(picture.encode.clone());
        let input = Input::File(picture.scene.clone());
        let drawn = task
            .series
            .draw(&input, &read, &render, &|event| match event {
                Event::Drawn(pixels) => (self.hear)(News::Drawn(pixels)),
                event => lock(heard).hear(event),
            });
        let drawn = drawn.map_err(|Failure { .. }| None)?;
        let options = EncodeOptions {
            working: drawn.working,
            ..picture.encode.clone()
        };
        let told = |refused: &dyn std::fmt::Display| Some(refused.to_string());
        let bytes = output::encode(&drawn.film, &options).map_err(|refused| told(&refused))?;
        if stop.is_asked() {
            return Err(None);
        }
        self.journal
            .put(&picture.output, &bytes)
            .map_err(|refused| told(&refused))?;
        let heard = lock(heard);
        let record = self
            .fingerprints
            .record(picture, &bytes, &heard.dependencies, since);
        if let Some(record) = record.filter(|_| !heard.wrote_files) {
            // Without the note the picture is there all the same; the next run draws it again.
            let _ = self.journal.note(&record);
        }
        Ok(())
    }

    fn tell(&self, outcome: Outcome) {
        (self.hear)(News::Done(&outcome));
    }

    /// Whether a picture is one of several of its scene.
    fn is_frame(&self, index: usize) -> bool {
        let series = |index: usize| self.pictures.get(index).map(|picture| picture.series);
        let own = series(index);
        index > 0 && series(index - 1) == own || series(index + 1) == own
    }

    fn series_of(&self, index: usize) -> usize {
        self.pictures[index].series
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }
}

/// What a scene said and asked for.
#[derive(Default)]
struct Heard {
    messages: Vec<Message>,
    dependencies: Vec<Dependency>,
    wrote_files: bool,
}

impl Heard {
    fn hear(&mut self, event: Event<'_>) {
        match event {
            Event::Found(message) if message.severity == Severity::Error => {
                self.messages.push(message.clone());
            }
            Event::Read {
                dependencies,
                wrote_files,
            } => {
                self.dependencies = dependencies.to_vec();
                self.wrote_files = wrote_files;
            }
            _ => {}
        }
    }
}

fn pixels(picture: &Picture) -> u64 {
    picture.render.columns.len() as u64 * picture.render.rows.len() as u64
}

/// The words of a panic.
fn words(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("nobody knows why")
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
