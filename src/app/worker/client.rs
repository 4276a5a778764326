//! A command's end of a worker.

use super::COMMAND;
use super::wire::{
    Draw, LONGEST_PARTIAL, Limit, LiveText, Reply, Report, Request, Splice, read_bytes,
};
use crate::app::program;
use crate::app::watchdog::Watchdog;
use crate::base::file::Folders;
use crate::base::options::Event;
use crate::base::sync::lock;
use std::io::{self, BufReader, Read, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Time for a process to exit after it has closed its pipes: it may have much memory to free.
const EXIT: Duration = Duration::from_secs(2);

/// Time beyond the limit of a picture for a worker to report the limit itself.
const BEYOND: Duration = Duration::from_secs(3);

/// Time for a worker to report that its picture is cancelled.
const GRACE: Duration = Duration::from_secs(1);

/// Workers read longer texts from their files.
const LONGEST_TEXT: usize = 1 << 26;

/// Maximum length of the quoted end of standard error in bytes.
const LAST_WORDS: usize = 1 << 10;

/// Held while a worker is started, which takes several file descriptors for a moment: if all threads started theirs at
/// once, all could fail where some are left.
static STARTING: Mutex<()> = Mutex::new(());

/// Number of workers of this process.
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// File descriptors that storing a picture takes at most. They must be left for each worker when another is started.
const FOR_STORING: usize = 4;

/// A running worker; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Worker {
    control: Control,
    replies: BufReader<ChildStdout>,
    last_words: Option<JoinHandle<Vec<u8>>>,
    is_spent: bool,
    /// The number of the live scene whose text it has.
    text: Option<u64>,
}

/// Controls the picture that a worker draws; from any thread.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    child: Arc<Mutex<Child>>,
    requests: Arc<Mutex<Requests>>,
    has_killed: Arc<AtomicBool>,
}

/// Requests on their way to a worker. A thread writes them, as a stopped worker reads none and the pipe may be full.
#[derive(Debug)]
struct Requests {
    sender: Sender<Vec<u8>>,
    /// Kills the worker.
    watchdog: Watchdog,
    picture: Progress,
}

/// The current picture of a worker.
#[derive(Clone, Copy, Debug)]
enum Progress {
    /// There is none. If the next is cancelled already, this is true.
    Idle { is_cancelled: bool },
    /// It is being drawn with this number of threads admitted.
    Drawing {
        threads: usize,
        deadline: Option<Instant>,
    },
}

/// The reason that a worker has delivered no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Lost {
    /// The scene cannot be drawn; with the reason, unless the findings give it.
    Failed(Option<String>),
    /// The scene reached a limit.
    Limit(Limit),
    /// The process ended.
    Ended {
        /// The reason.
        reason: String,
        /// True if the system killed it, as it does when the machine runs out of memory.
        is_killed: bool,
    },
}

impl Worker {
    /// The worker, or a new one if there is none or it draws nothing more.
    ///
    /// # Errors
    /// When the system starts no more processes or threads.
    pub(crate) fn ready(worker: &mut Option<Worker>) -> io::Result<&mut Worker> {
        let usable = worker.take().filter(|worker| !worker.is_spent());
        Ok(worker.insert(match usable {
            Some(worker) => worker,
            None => Worker::start()?,
        }))
    }

    fn start() -> io::Result<Self> {
        let _alone = lock(&STARTING);
        #[cfg(unix)]
        let _left = (0..FOR_STORING * (RUNNING.load(Ordering::Relaxed) + 1))
            .map(|_| std::os::fd::AsFd::as_fd(&io::stderr()).try_clone_to_owned())
            .collect::<io::Result<Vec<_>>>()?;
        let mut command = Command::new(program::again()?);
        #[cfg(unix)]
        std::os::unix::process::CommandExt::arg0(&mut command, env!("CARGO_PKG_NAME"));
        let mut child = command
            .arg(COMMAND)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let (Some(requests), Some(replies), Some(errors)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(io::ErrorKind::BrokenPipe.into());
        };
        let (sender, receiver) = mpsc::channel();
        let child = Arc::new(Mutex::new(child));
        let has_killed = Arc::new(AtomicBool::new(false));
        let (watched, killed) = (Arc::clone(&child), Arc::clone(&has_killed));
        // Without this thread the process ends by itself, as its standard input is closed.
        let watchdog = Watchdog::start(move || kill(&watched, &killed))?;
        RUNNING.fetch_add(1, Ordering::Relaxed);
        let mut worker = Worker {
            control: Control {
                child,
                requests: Arc::new(Mutex::new(Requests {
                    sender,
                    watchdog,
                    picture: Progress::Idle {
                        is_cancelled: false,
                    },
                })),
                has_killed,
            },
            replies: BufReader::new(replies),
            last_words: None,
            is_spent: false,
            text: None,
        };
        let named = |name: &str| thread::Builder::new().name(name.to_owned());
        named("requests").spawn(move || write_requests(requests, &receiver))?;
        worker.last_words = Some(named("last words").spawn(move || end_of(errors))?);
        Ok(worker)
    }

    /// The text for a request for the live scene of a number. `change` is that of the text since an earlier number, `whole`
    /// the text, without which the worker reads the file.
    pub(crate) fn text_for(
        &mut self,
        number: u64,
        change: Option<&(u64, Splice)>,
        whole: Option<&str>,
    ) -> LiveText {
        let before = self.text.replace(number);
        if before == Some(number) {
            return LiveText::Sent;
        }
        if let Some((_, splice)) = change.filter(|(of, _)| before == Some(*of)) {
            return LiveText::Changed(splice.clone());
        }
        if let Some(text) = whole.filter(|text| text.len() <= LONGEST_TEXT) {
            return LiveText::Whole(text.to_owned());
        }
        self.text = None;
        LiveText::File
    }

    /// Controls the next picture.
    pub(crate) fn control(&self) -> Control {
        lock(&self.control.requests).picture = Progress::Idle {
            is_cancelled: false,
        };
        self.control.clone()
    }

    /// True if this worker draws nothing more, or has ended.
    fn is_spent(&self) -> bool {
        let has_ended = || !matches!(lock(&self.control.child).try_wait(), Ok(None));
        self.is_spent || self.control.has_killed.load(Ordering::Relaxed) || has_ended()
    }

    /// Draws a picture; returns the contents of its files.
    ///
    /// `report` receives what is no event of the scene.
    ///
    /// # Errors
    /// When there is no picture.
    pub(crate) fn draw(
        &mut self,
        draw: Draw,
        listen: &dyn Fn(Event<'_>),
        report: &dyn Fn(Report),
    ) -> Result<Vec<Vec<u8>>, Lost> {
        self.is_spent = (draw.is_sandboxed || draw.max_memory.is_some()) && draw.live.is_none();
        let expected = Expected::of(&draw);
        if let Err(error) = self.control.begin(draw) {
            self.text = None;
            let reason = format!("the picture cannot be requested of a process: {error}");
            return Err(Lost::Failed(Some(reason)));
        }
        let mut limit = None;
        let drawn = expected.replies(&mut self.replies, listen, report, &mut limit);
        self.control.end();
        self.is_spent |= limit.is_some() || drawn.is_err();
        match (drawn, limit) {
            (_, Some(limit)) => Err(Lost::Limit(limit)),
            (Err(_), None) if self.control.has_killed.load(Ordering::Relaxed) => {
                Err(Lost::Limit(Limit::Time))
            }
            (Ok(Ok(all)), None) => Ok(all),
            (Ok(Err(failed)), None) => Err(Lost::Failed(failed)),
            (Err(_), None) => Err(self.end()),
        }
    }

    /// Ends the process, unless it has ended, and returns the reason that it had.
    fn end(&mut self) -> Lost {
        let status = self.control.status();
        let words = self.last_words.take().and_then(|words| words.join().ok());
        let words = String::from_utf8_lossy(&words.unwrap_or_default()).into_owned();
        let mut lines = words.lines().rev();
        let last = lines.find(|line| !line.trim().is_empty());
        // These words may be the text of a scene, with control characters of a terminal.
        let plain = |line: &str| line.replace(char::is_control, " ");
        let mut reason = match &status {
            Ok(status) => format!("its process ended ({status})"),
            Err(error) => format!("its process ended ({error})"),
        };
        if let Some(last) = last {
            reason += &format!(": {}", plain(last.trim()));
        }
        Lost::Ended {
            is_killed: status.is_ok_and(is_kill),
            reason,
        }
    }
}

/// Bounds on the replies of a worker that draws a picture.
#[derive(Debug)]
pub(super) struct Expected {
    scene: PathBuf,
    /// The folders in which the scene may read.
    readable: Folders,
    /// Number of files of the picture.
    files: usize,
    /// Maximum length of all replies in bytes: a worker sends no more than it may hold.
    bytes: u64,
}

impl Expected {
    pub(super) fn of(draw: &Draw) -> Self {
        Expected {
            scene: draw.scene.clone(),
            readable: draw.read.readable.clone(),
            files: draw.files.len(),
            bytes: draw.max_memory.unwrap_or(u64::MAX),
        }
    }

    /// The files of a picture, or the reason that there are none; the error is that of the pipe.
    pub(super) fn replies(
        &self,
        from: &mut impl Read,
        listen: &dyn Fn(Event<'_>),
        report: &dyn Fn(Report),
        limit: &mut Option<Limit>,
    ) -> io::Result<Result<Vec<Vec<u8>>, Option<String>>> {
        let mut replies = from.take(self.bytes);
        loop {
            match Reply::read(&mut replies)? {
                Reply::Report(news) => report(news),
                Reply::Output(text) => listen(Event::SceneOutput(&text)),
                Reply::Finding(mut message, texts) => {
                    [message.pov_line, message.excerpt, message.colored] = texts;
                    listen(Event::Finding(&message));
                }
                Reply::Read {
                    mut dependencies,
                    wrote_files,
                } => {
                    dependencies
                        .retain(|one| one.path == self.scene || self.readable.reach(&one.path));
                    listen(Event::Read {
                        dependencies: &dependencies,
                        wrote_files,
                    });
                }
                Reply::Drawn(pixels) => listen(Event::Drawn(pixels)),
                Reply::Partial(length) if length > LONGEST_PARTIAL => {
                    return Err(io::ErrorKind::InvalidData.into());
                }
                Reply::Partial(length) => {
                    report(Report::Partial(read_bytes(&mut replies, length)?));
                }
                Reply::Limit(reached) => *limit = Some(reached),
                Reply::Failed(reason) => return Ok(Err(reason)),
                Reply::Done(lengths) if lengths.len() != self.files => {
                    return Err(io::ErrorKind::InvalidData.into());
                }
                Reply::Done(lengths) => {
                    let mut read = |length| read_bytes(&mut replies, length);
                    return lengths
                        .into_iter()
                        .map(&mut read)
                        .collect::<io::Result<_>>()
                        .map(Ok);
                }
            }
        }
    }
}

/// Reads the replies to a request of one file as a command does; returns the number of files, if they are all there. For
/// the fuzz target `replies`.
pub fn read_replies(mut bytes: &[u8]) -> Option<usize> {
    let expected = Expected {
        scene: PathBuf::from("/scene.pov"),
        readable: Folders::Only(Vec::new()),
        files: 1,
        bytes: 1 << 20,
    };
    let listen = |event: Event<'_>| {
        if let Event::Read { dependencies, .. } = event {
            assert!(dependencies.iter().all(|one| one.path == expected.scene));
        }
    };
    let read = expected.replies(&mut bytes, &listen, &|_| {}, &mut None);
    let files = read.ok()?.ok()?;
    assert_eq!(files.len(), expected.files);
    Some(files.len())
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.control.kill();
        let _ = lock(&self.control.child).wait();
        RUNNING.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Control {
    /// Requests a picture. The worker is killed if it goes on for long after its time limit.
    ///
    /// # Errors
    /// As [`Request::encoded`].
    fn begin(&self, draw: Draw) -> io::Result<()> {
        let threads = draw.threads.unwrap_or(usize::MAX);
        let limit = draw.timeout.map(|limit| limit.saturating_add(BEYOND));
        let request = Request::Draw(Box::new(draw)).encoded()?;
        let mut requests = lock(&self.requests);
        let is_cancelled = matches!(requests.picture, Progress::Idle { is_cancelled: true });
        let deadline = limit.and_then(|limit| Instant::now().checked_add(limit));
        requests.picture = Progress::Drawing { threads, deadline };
        requests.watchdog.set(deadline);
        // A process that has ended receives nothing; its replies end too.
        let _ = requests.sender.send(request);
        drop(requests);
        if is_cancelled {
            self.stop();
        }
        Ok(())
    }

    /// Ends the watch over a picture.
    fn end(&self) {
        let mut requests = lock(&self.requests);
        requests.watchdog.set(None);
        requests.picture = Progress::Idle {
            is_cancelled: false,
        };
    }

    /// Cancels the picture, which the worker then reports as failed. If it does not, it is killed.
    pub(crate) fn stop(&self) {
        let mut requests = lock(&self.requests);
        match &mut requests.picture {
            Progress::Idle { is_cancelled } => *is_cancelled = true,
            Progress::Drawing { deadline, .. } => {
                let soon = Instant::now() + GRACE;
                let deadline = *deadline.insert(deadline.map_or(soon, |known| known.min(soon)));
                requests.watchdog.set(Some(deadline));
                requests.send(Request::Stop);
            }
        }
    }

    /// Lets the current picture use more threads of its worker.
    pub(crate) fn use_threads(&self, count: usize) {
        let mut requests = lock(&self.requests);
        if let Progress::Drawing { threads, .. } = &mut requests.picture
            && *threads < count
        {
            *threads = count;
            requests.send(Request::Threads(count));
        }
    }

    fn kill(&self) {
        kill(&self.child, &self.has_killed);
    }

    /// The exit status of a worker whose pipes are closed. One that goes on nevertheless is killed.
    fn status(&self) -> io::Result<ExitStatus> {
        let started = Instant::now();
        while started.elapsed() < EXIT {
            if let Some(status) = lock(&self.child).try_wait()? {
                return Ok(status);
            }
            thread::sleep(Duration::from_millis(1));
        }
        let mut child = lock(&self.child);
        child.kill()?;
        child.wait()
    }
}

impl Requests {
    /// Sends a short request.
    fn send(&self, request: Request) {
        if let Ok(request) = request.encoded() {
            let _ = self.sender.send(request);
        }
    }
}

fn kill(child: &Mutex<Child>, has_killed: &AtomicBool) {
    has_killed.store(true, Ordering::Relaxed);
    let _ = lock(child).kill();
}

/// Writes requests until the process or its controls are gone.
fn write_requests(mut pipe: ChildStdin, requests: &Receiver<Vec<u8>>) {
    while let Ok(request) = requests.recv() {
        if pipe.write_all(&request).is_err() {
            return;
        }
    }
}

/// True if the process was killed from outside.
fn is_kill(status: ExitStatus) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::process::ExitStatusExt;
        status.signal() == Some(signal_hook::consts::SIGKILL)
    }
    #[cfg(not(unix))]
    {
        let _ = status;
        false
    }
}

/// The end of what a process writes.
fn end_of(mut errors: ChildStderr) -> Vec<u8> {
    let mut end = Vec::new();
    let mut piece = [0; LAST_WORDS];
    while let Ok(length @ 1..) = errors.read(&mut piece) {
        end.extend_from_slice(&piece[..length]);
        end.drain(..end.len().saturating_sub(LAST_WORDS));
    }
    end
}
