//! A run: renders the pictures that are not up to date, several in parallel.
//!
//! Worker processes draw one scene each at a time, so that a scene ends no other. Each begins a scene with its share of
//! the threads, and gets more when no others wait. Scenes that need the machine to themselves are rendered alone at the
//! end: scenes that write files, that ran out of memory, and very large pictures.

use super::fingerprint::{Fingerprints, now};
use super::journal::Journal;
use super::picture::Picture;
use super::sharing::Sharing;
use super::{BatchError, Shard};
use crate::app::worker::{Draw, Lost, Report, Worker};
use crate::base::file::Folders;
use crate::base::options::Event;
use crate::base::source::{Code, Dependency, Message, Severity};
use crate::base::sync::lock;
use crate::useful_threads;
use rayon::prelude::*;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Interval in which a thread without a task lets the others use its share.
const LOOK: Duration = Duration::from_millis(100);
/// Larger pictures are rendered alone: their films take a GiB and more.
const LARGE: u64 = 1 << 26;

/// Options of a run.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// The output folder.
    pub out: PathBuf,
    /// Number of scenes drawn in parallel; `None` for the number of threads.
    pub jobs: Option<usize>,
    /// Number of render threads, as far as they are of use; `None` for one per core.
    pub threads: Option<usize>,
    /// Time limit for a picture.
    pub timeout: Option<Duration>,
    /// Memory limit for the process that draws a picture, in bytes.
    pub memory: Option<u64>,
    /// True to draw each picture in a sandbox of the kernel, which admits the files of that picture.
    pub is_sandboxed: bool,
    /// The part of the pictures to render; `None` renders all.
    pub shard: Option<Shard>,
    /// True to render pictures that are up to date as well.
    pub draws_all: bool,
}

/// The outcome of a picture.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Its index in the list.
    pub picture: usize,
    /// Its status.
    pub status: Status,
    /// The time in seconds.
    pub seconds: f64,
    /// Errors and warnings of the scene.
    pub messages: Vec<Message>,
}

/// The status of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// It was rendered.
    Drawn,
    /// It exists and would have been the same.
    UpToDate,
    /// It failed; with the reason, unless the messages give it.
    Failed(Option<String>),
}

/// Events of a run, sent from any thread.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// All pictures that are up to date have been reported; these are left.
    Left {
        /// Pictures to render.
        pictures: usize,
        /// Their pixels.
        pixels: u64,
    },
    /// The picture of this number is begun.
    Begun(usize),
    /// This many pixels have been finished since the last event of this kind.
    Drawn(u64),
    /// A picture is finished.
    Done(&'a Outcome),
    /// The kernel does not enforce this part of the sandbox.
    Weaker(&'a str),
}

/// Renders the pictures that are not up to date. Failed pictures are reported, and the others are rendered.
///
/// # Errors
/// When the folder cannot be written to at all, or another process is using it.
pub fn run(
    pictures: &[Picture],
    batch: &Batch,
    listener: &(dyn Fn(News<'_>) + Sync),
) -> Result<(), BatchError> {
    let journal = Journal::open(&batch.out, batch.shard)?;
    let threads = batch
        .threads
        .unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let threads = useful_threads(threads);
    let run = Run {
        pictures,
        batch,
        journal,
        threads,
        jobs: batch.jobs.unwrap_or(threads).max(1),
        fingerprints: Fingerprints::new(),
        sharing: Sharing::default(),
        is_part: batch.shard.is_some_and(|shard| shard.of > 1),
        listener,
        state: Mutex::default(),
        changed: Condvar::new(),
    };
    let left = run.left();
    let pixels = left.iter().map(|&index| pixels(&pictures[index])).sum();
    listener(News::Left {
        pictures: left.len(),
        pixels,
    });
    if !left.is_empty() {
        run.all(&left);
    }
    run.journal.close()
}

/// A run in progress.
struct Run<'a> {
    pictures: &'a [Picture],
    batch: &'a Batch,
    journal: Journal,
    /// Render threads, which the workers share.
    threads: usize,
    /// Scenes drawn in parallel.
    jobs: usize,
    fingerprints: Fingerprints,
    sharing: Sharing,
    /// True if other pictures of the list are rendered elsewhere.
    is_part: bool,
    listener: &'a (dyn Fn(News<'_>) + Sync),
    state: Mutex<State>,
    changed: Condvar,
}

/// Tasks to do and tasks in progress.
#[derive(Default)]
struct State {
    waiting: VecDeque<Task>,
    /// Number of tasks in progress; each may add more.
    in_progress: usize,
    /// Number of threads that work on tasks.
    threads: usize,
    /// Tasks to do alone at the end.
    alone: Vec<Task>,
}

/// A scene and those of its pictures that are to be rendered, one after the other.
#[derive(Debug)]
struct Task {
    pictures: VecDeque<usize>,
    /// The series, if there are several.
    series: Option<usize>,
    /// True if earlier frames were rendered on the assumption that the scene writes no files.
    follows: bool,
}

/// Other work in parallel.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OtherWork {
    Others,
    Nothing,
}

/// The end of an attempt.
enum Ended {
    Done(Outcome),
    /// It must be repeated alone.
    Later,
}

impl Run<'_> {
    /// The pictures of this part that are not up to date; the others are reported.
    fn left(&self) -> Vec<usize> {
        let batch = self.batch;
        let records = self.journal.records();
        let is_done = |index: &usize| {
            let picture = &self.pictures[*index];
            let path = self.journal.path(&picture.output);
            let known = records.get(&picture.output).into_iter().flatten();
            let mut known = known.filter(|_| !batch.draws_all);
            known.any(|record| self.fingerprints.holds(record, picture, &path))
        };
        let is_mine = |index: &usize| batch.shard.is_none_or(|shard| shard.has(*index));
        let mine: Vec<usize> = (0..self.pictures.len()).filter(is_mine).collect();
        let done: Vec<bool> = mine.par_iter().map(is_done).collect();
        let (done, left): (Vec<_>, Vec<_>) = mine.into_iter().zip(done).partition(|one| one.1);
        for (picture, _) in done {
            self.report(Outcome {
                picture,
                status: Status::UpToDate,
                seconds: 0.0,
                messages: Vec::new(),
            });
        }
        left.into_iter().map(|(index, _)| index).collect()
    }

    fn all(&self, left: &[usize]) {
        {
            let mut state = self.lock();
            for frames in left.chunk_by(|&a, &b| self.series_of(a) == self.series_of(b)) {
                let task = Task {
                    pictures: frames.iter().copied().collect(),
                    series: (frames.len() > 1).then(|| self.series_of(frames[0])),
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
            let count = self.jobs.min(left.len());
            self.lock().threads = count;
            let spawn = |_| thread::Builder::new().spawn_scoped(scope, || self.work());
            // This thread works too; where the system gives none besides, it works alone.
            let others: Vec<_> = (1..count).map_while(|number| spawn(number).ok()).collect();
            self.lock().threads -= count - 1 - others.len();
            self.work();
            for other in others {
                // It does not panic: pictures are rendered in another process.
                let _ = other.join();
            }
            let mut alone = std::mem::take(&mut self.lock().alone);
            alone.sort_by_key(|task| task.pictures.front().copied());
            let mut worker = None;
            for task in alone {
                for &index in &task.pictures {
                    let ended = self.attempt(index, &task, OtherWork::Nothing, &mut worker);
                    if let Ended::Done(outcome) = ended {
                        self.report(outcome);
                    }
                }
            }
        });
    }

    /// Works on tasks until none are left, or there is no process to draw in.
    fn work(&self) {
        let mut worker = None;
        while let Some(mut task) = self.next_task(&mut worker) {
            if Worker::ready(&mut worker).is_err() {
                match self.left_to_others(task) {
                    Some(own) => task = own,
                    None => return,
                }
            }
            let Some(&index) = task.pictures.front() else {
                self.finished(Vec::new(), None);
                continue;
            };
            match self.attempt(index, &task, OtherWork::Others, &mut worker) {
                Ended::Later => self.finished(Vec::new(), Some(task)),
                Ended::Done(outcome) => {
                    self.report(outcome);
                    task.pictures.pop_front();
                    let rest = task.pictures.into_iter().map(|index| Task {
                        pictures: [index].into(),
                        series: task.series,
                        follows: true,
                    });
                    self.finished(rest.collect(), None);
                }
            }
        }
    }

    /// Puts a task back for other threads, and ends this one; returns it if there are no others.
    fn left_to_others(&self, task: Task) -> Option<Task> {
        let mut state = self.lock();
        if state.threads <= 1 {
            return Some(task);
        }
        state.threads -= 1;
        state.in_progress -= 1;
        state.waiting.push_front(task);
        self.changed.notify_all();
        None
    }

    /// The next task; `None` at the end. A worker that has none for a while is ended.
    fn next_task(&self, worker: &mut Option<Worker>) -> Option<Task> {
        let waits = |state: &mut State| state.waiting.is_empty() && state.in_progress > 0;
        let mut state = self.lock();
        while waits(&mut state) {
            drop(state);
            // Repeated, as it may come too early for pictures that have just been begun.
            self.sharing.share(self.threads);
            let waited = self.changed.wait_timeout_while(self.lock(), LOOK, waits);
            let (waited, time) = waited.unwrap_or_else(PoisonError::into_inner);
            drop(waited);
            if time.timed_out() {
                *worker = None;
            }
            state = self.lock();
        }
        let task = state.waiting.pop_front()?;
        state.in_progress += 1;
        Some(task)
    }

    /// The share of the threads of a picture that is begun now.
    fn share(&self) -> usize {
        let state = self.lock();
        let pictures = (state.in_progress + state.waiting.len()).clamp(1, self.jobs);
        self.threads.div_ceil(pictures)
    }

    fn finished(&self, rest: Vec<Task>, alone: Option<Task>) {
        let mut state = self.lock();
        // Frames go before other scenes: their tokens stay in memory while they wait.
        for task in rest.into_iter().rev() {
            state.waiting.push_front(task);
        }
        state.alone.extend(alone);
        state.in_progress -= 1;
        self.changed.notify_all();
    }

    /// Renders a picture and writes it to its file.
    fn attempt(
        &self,
        index: usize,
        task: &Task,
        other_work: OtherWork,
        worker: &mut Option<Worker>,
    ) -> Ended {
        let started = Instant::now();
        (self.listener)(News::Begun(index));
        let events = Mutex::new(SceneEvents::default());
        let drawn = self.draw(&self.pictures[index], task, other_work, worker, &events);
        let messages = events
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .messages;
        let has = |code: Code| messages.iter().any(|message| message.code == Some(code));
        let status = match drawn {
            Ok(()) => Status::Drawn,
            Err(Lost::Limit(limit)) => {
                let excess = limit.excess(self.batch.timeout, self.batch.memory);
                Status::Failed(Some(format!("it {excess}")))
            }
            Err(Lost::Failed(_)) if has(Code::WritesFiles) && task.follows => Status::Failed(Some(
                "this animation writes files, but not in its first frame: draw it without `povr batch`"
                    .to_owned(),
            )),
            Err(Lost::Failed(_)) if has(Code::WritesFiles) && self.is_part && self.is_frame(index) => {
                Status::Failed(Some(
                    "the frames of this animation write files: draw them without `--shard`"
                        .to_owned(),
                ))
            }
            Err(Lost::Failed(_))
                if other_work == OtherWork::Others && (has(Code::WritesFiles) || has(Code::Memory)) =>
            {
                return Ended::Later;
            }
            // Linux kills a process when the machine has no memory left; alone, the scene may have enough.
            Err(Lost::Ended { is_killed: true, .. }) if other_work == OtherWork::Others => {
                return Ended::Later;
            }
            Err(Lost::Ended { reason, .. }) => Status::Failed(Some(reason)),
            Err(Lost::Failed(why)) => Status::Failed(why),
        };
        Ended::Done(Outcome {
            picture: index,
            status,
            seconds: started.elapsed().as_secs_f64(),
            messages,
        })
    }

    /// Renders a picture in a worker, which is started if there is none, and stores it.
    fn draw(
        &self,
        picture: &Picture,
        task: &Task,
        other_work: OtherWork,
        worker: &mut Option<Worker>,
        events: &Mutex<SceneEvents>,
    ) -> Result<(), Lost> {
        let since = now();
        let mut draw = Draw {
            scene: picture.scene.clone(),
            series: task.series,
            read: picture.read.clone(),
            render: picture.render.clone(),
            threads: None,
            files: vec![picture.encode.clone()],
            tells_output: false,
            timeout: self.batch.timeout,
            max_memory: self.batch.memory,
            is_sandboxed: self.batch.is_sandboxed,
            is_background: false,
            live: None,
        };
        if other_work == OtherWork::Others {
            draw.read.writable = Folders::Only(Vec::new());
        }
        draw.render.threads = Some(self.threads);
        draw.threads = Some(self.share());
        draw.render.target_format = Some(picture.encode.clone());
        let failed = |why: &dyn std::fmt::Display| Lost::Failed(Some(why.to_string()));
        let worker = Worker::ready(worker)
            .map_err(|error| failed(&format!("no process to draw it in: {error}")))?;
        let shared = self.sharing.add(worker.control());
        let drawn = worker.draw(
            draw,
            &|event| match event {
                Event::Drawn(pixels) => (self.listener)(News::Drawn(pixels)),
                event => lock(events).record(event),
            },
            &|report| {
                if let Report::Weaker(lack) = report {
                    (self.listener)(News::Weaker(&lack));
                }
            },
        );
        drop(shared);
        let bytes = drawn?.into_iter().next().unwrap_or_default();
        self.journal
            .put(&picture.output, &bytes)
            .map_err(|refused| failed(&refused))?;
        let events = lock(events);
        let record = self
            .fingerprints
            .record(picture, &bytes, &events.dependencies, since);
        if let Some(record) = record.filter(|_| !events.wrote_files) {
            // Without the record the picture is still there; the next run renders it again.
            let _ = self.journal.note(&record);
        }
        Ok(())
    }

    fn report(&self, outcome: Outcome) {
        (self.listener)(News::Done(&outcome));
    }

    /// True for one of several pictures of a scene.
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

/// Messages and requests of a scene.
#[derive(Default)]
struct SceneEvents {
    messages: Vec<Message>,
    dependencies: Vec<Dependency>,
    wrote_files: bool,
}

impl SceneEvents {
    fn record(&mut self, event: Event<'_>) {
        match event {
            Event::Finding(message) if message.severity == Severity::Error => {
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
