//! Processes with a time limit.

use crate::base::options::CancelToken;
use crate::base::sync::lock;
use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// Number of bytes stored from the start and from the end of standard error: a scene in a loop may write much.
const MAX_SAID: usize = 1 << 20;

/// Time after the end of a process to read the rest of its standard error.
const LINGER: Duration = Duration::from_secs(2);

/// The end of a process.
#[derive(Debug)]
pub struct Ended {
    /// The exit status, or `None` if it ran past the limit, or was cancelled, and was killed.
    pub status: Option<ExitStatus>,
    /// Its standard error; of long output the start and the end.
    pub stderr: String,
    /// The run time.
    pub took: Duration,
}

/// Runs a command to its end, but no longer than `limit`. Its standard output is discarded.
///
/// # Errors
/// When the process does not start, or cannot be waited for.
pub fn run(command: &mut Command, limit: Duration) -> io::Result<Ended> {
    run_until(command, limit, &CancelToken::default())
}

/// Runs a command as [`run`] does, but no longer than until `stop` is cancelled.
pub(super) fn run_until(
    command: &mut Command,
    limit: Duration,
    stop: &CancelToken,
) -> io::Result<Ended> {
    let start = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let said = Arc::new(Mutex::new(Vec::new()));
    let (all, end) = mpsc::channel::<()>();
    if let Some(pipe) = child.stderr.take() {
        let said = Arc::clone(&said);
        thread::spawn(move || read_output(pipe, &said, all));
    }
    let status = wait(&mut child, limit, stop)?;
    let took = start.elapsed();
    // A process that it has started may hold the pipe open for longer.
    let _ = end.recv_timeout(LINGER);
    let stderr = String::from_utf8_lossy(&lock(&said)).into_owned();
    Ok(Ended {
        status,
        stderr,
        took,
    })
}

/// Reads the contents of a pipe, or its start and end, and then drops `all`. Output read before a failure is worth
/// showing too.
fn read_output(mut pipe: impl Read, said: &Mutex<Vec<u8>>, all: Sender<()>) {
    let mut part = vec![0; 1 << 16];
    while let Ok(read @ 1..) = pipe.read(&mut part) {
        let mut bytes = lock(said);
        bytes.extend_from_slice(&part[..read]);
        if bytes.len() > 3 * MAX_SAID {
            bytes.drain(MAX_SAID..2 * MAX_SAID);
        }
    }
    drop(all);
}

fn wait(child: &mut Child, limit: Duration, stop: &CancelToken) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > limit || stop.is_cancelled() {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    const LONG: Duration = Duration::from_secs(60);

    fn shell(command: &str, limit: Duration) -> Ended {
        run(Command::new("sh").args(["-c", command]), limit).expect("the shell runs")
    }

    #[test]
    fn slow_processes_are_killed() {
        let ended = run(Command::new("sleep").arg("60"), Duration::from_millis(50)).unwrap();
        assert!(ended.status.is_none() && ended.took < Duration::from_secs(30));
    }

    #[test]
    fn a_process_that_holds_the_pipe_open_is_not_waited_for() {
        let ended = shell("echo no >&2; sleep 60; true", Duration::from_millis(500));
        assert_eq!((ended.status, ended.stderr.as_str()), (None, "no\n"));
        let start = Instant::now();
        let ended = shell("sleep 20 & echo no >&2", LONG);
        assert!(ended.status.is_some() && ended.stderr == "no\n");
        assert!(start.elapsed() < Duration::from_secs(15));
    }

    #[test]
    fn output_comes_with_the_status() {
        let ended = shell("echo no >&2; exit 3", LONG);
        assert_eq!(
            (ended.status.and_then(|s| s.code()), ended.stderr.as_str()),
            (Some(3), "no\n")
        );
    }
}
