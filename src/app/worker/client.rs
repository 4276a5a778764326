//! A command's end of a worker.

use super::COMMAND;
use super::wire::{Draw, Limit, Reply, Request, read_bytes, read_message, write_message};
use crate::app::program;
use crate::base::options::Event;
use std::io::{self, BufReader, Read};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Time for a process to exit after it has closed its pipes: it may have much memory to free.
const EXIT: Duration = Duration::from_secs(2);

/// Maximum length of the quoted end of standard error in bytes.
const LAST_WORDS: usize = 1 << 10;

/// A running worker; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Worker {
    control: Control,
    replies: BufReader<ChildStdout>,
    last_words: Option<JoinHandle<Vec<u8>>>,
    is_spent: bool,
}

/// Controls the picture that a worker draws; from any thread.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    child: Arc<Mutex<Child>>,
    requests: Arc<Mutex<ChildStdin>>,
    has_killed: Arc<AtomicBool>,
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
    /// Starts a worker.
    ///
    /// # Errors
    /// When the system starts no more processes or threads.
    pub(crate) fn start() -> io::Result<Self> {
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
        let reader = thread::Builder::new().name("last words".to_owned());
        Ok(Worker {
            control: Control {
                child: Arc::new(Mutex::new(child)),
                requests: Arc::new(Mutex::new(requests)),
                has_killed: Arc::default(),
            },
            replies: BufReader::new(replies),
            last_words: Some(reader.spawn(move || end_of(errors))?),
            is_spent: false,
        })
    }

    /// Controls the current picture.
    pub(crate) fn control(&self) -> Control {
        self.control.clone()
    }

    /// True if this worker draws nothing more.
    pub(crate) fn is_spent(&self) -> bool {
        self.is_spent
    }

    /// Draws a picture; returns the contents of its files.
    ///
    /// `warn` is called with parts of a sandbox that the kernel lacks.
    ///
    /// # Errors
    /// When there is no picture.
    pub(crate) fn draw(
        &mut self,
        draw: Draw,
        listen: &dyn Fn(Event<'_>),
        warn: &dyn Fn(&str),
    ) -> Result<Vec<Vec<u8>>, Lost> {
        self.is_spent = draw.is_sandboxed || draw.max_memory.is_some();
        let files = draw.files.len();
        let mut limit = None;
        let drawn = self.replies_to(draw, listen, warn, &mut limit);
        self.is_spent |= limit.is_some() || drawn.is_err();
        match (drawn, limit) {
            (_, Some(limit)) => Err(Lost::Limit(limit)),
            (Err(_), None) if self.control.has_killed.load(Ordering::Relaxed) => {
                Err(Lost::Limit(Limit::Time))
            }
            (Ok(Ok(all)), None) if all.len() == files => Ok(all),
            (Ok(Err(failed)), None) => Err(Lost::Failed(failed)),
            (Ok(Ok(_)) | Err(_), None) => Err(self.end()),
        }
    }

    /// The files of a picture, or the reason that there are none; the error is that of the pipe.
    fn replies_to(
        &mut self,
        draw: Draw,
        listen: &dyn Fn(Event<'_>),
        warn: &dyn Fn(&str),
        limit: &mut Option<Limit>,
    ) -> io::Result<Result<Vec<Vec<u8>>, Option<String>>> {
        // A worker that a scene has taken over sends no more than one that is within its limit.
        let longest = draw.max_memory.unwrap_or(u64::MAX);
        let mut replies = self.replies.by_ref().take(longest);
        let request = Request::Draw(Box::new(draw));
        write_message(&mut *lock(&self.control.requests), &request)?;
        loop {
            match read_message(&mut replies)? {
                Reply::Weaker(lack) => warn(&lack),
                Reply::Output(text) => listen(Event::SceneOutput(&text)),
                Reply::Finding(mut message, texts) => {
                    [message.pov_line, message.excerpt, message.colored] = texts;
                    listen(Event::Finding(&message));
                }
                Reply::Read {
                    dependencies,
                    wrote_files,
                } => listen(Event::Read {
                    dependencies: &dependencies,
                    wrote_files,
                }),
                Reply::Drawn(pixels) => listen(Event::Drawn(pixels)),
                Reply::Limit(reached) => *limit = Some(reached),
                Reply::Failed(reason) => return Ok(Err(reason)),
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

    /// Ends the process, unless it has ended, and returns the reason that it had.
    fn end(&mut self) -> Lost {
        let status = self.control.status();
        let words = self.last_words.take().and_then(|words| words.join().ok());
        let words = String::from_utf8_lossy(&words.unwrap_or_default()).into_owned();
        let mut lines = words.lines().rev();
        let last = lines.find(|line| !line.trim().is_empty());
        // What a worker writes may be the text of a scene.
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

impl Drop for Worker {
    fn drop(&mut self) {
        self.control.kill();
        let _ = lock(&self.control.child).wait();
    }
}

impl Control {
    /// Cancels the current picture, which the worker then reports as failed.
    pub(crate) fn stop(&self) {
        // A process that has ended draws nothing.
        let _ = write_message(&mut *lock(&self.requests), &Request::Stop);
    }

    /// Lets the current picture use more threads of its worker.
    pub(crate) fn use_threads(&self, count: usize) {
        let _ = write_message(&mut *lock(&self.requests), &Request::Threads(count));
    }

    /// Kills the worker, which has not reported in time that its picture is cancelled.
    pub(crate) fn kill(&self) {
        self.has_killed.store(true, Ordering::Relaxed);
        let _ = lock(&self.child).kill();
    }

    /// The exit status of a worker whose pipes are closed. One that goes on nevertheless is killed.
    fn status(&self) -> io::Result<ExitStatus> {
        let started = Instant::now();
        let mut child = lock(&self.child);
        while started.elapsed() < EXIT {
            if let Some(status) = child.try_wait()? {
                return Ok(status);
            }
            thread::sleep(Duration::from_millis(1));
        }
        child.kill()?;
        child.wait()
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

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
