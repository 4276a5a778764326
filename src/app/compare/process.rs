//! Processes with a time limit.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Of what a process says on standard error, so many bytes of the beginning and of the end are kept: a scene in a loop
/// may say a lot.
const MOST_SAID: usize = 1 << 20;

/// How a process ended.
#[derive(Debug)]
pub struct Ended {
    /// The exit status, or `None` if it ran past the limit and was killed.
    pub status: Option<ExitStatus>,
    /// What it wrote on standard error; of very much the beginning and the end.
    pub stderr: String,
    /// How long it ran.
    pub took: Duration,
}

/// Runs a command to its end, but no longer than `limit`. Its standard output is thrown away.
///
/// # Errors
/// When the process does not start, or cannot be waited for.
pub fn run(command: &mut Command, limit: Duration) -> io::Result<Ended> {
    let start = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let pipe = child.stderr.take();
    let reader = thread::spawn(move || pipe.map(heard).unwrap_or_default());
    let status = wait(&mut child, limit)?;
    let took = start.elapsed();
    let stderr = reader.join().unwrap_or_default();
    Ok(Ended {
        status,
        stderr,
        took,
    })
}

/// All that comes out of a pipe, or the beginning and the end of it. What was read before it failed is worth showing too.
fn heard(mut pipe: impl Read) -> String {
    let mut bytes = Vec::new();
    let mut part = vec![0; 1 << 16];
    while let Ok(read @ 1..) = pipe.read(&mut part) {
        bytes.extend_from_slice(&part[..read]);
        if bytes.len() > 3 * MOST_SAID {
            bytes.drain(MOST_SAID..2 * MOST_SAID);
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn wait(child: &mut Child, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > limit {
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

    #[test]
    fn what_runs_too_long_is_ended() {
        let ended = run(Command::new("sleep").arg("60"), Duration::from_millis(50)).unwrap();
        assert!(ended.status.is_none() && ended.took < Duration::from_secs(30));
    }

    #[test]
    fn what_is_said_comes_with_the_status() {
        let ended = run(
            Command::new("sh").args(["-c", "echo no >&2; exit 3"]),
            Duration::from_secs(30),
        )
        .unwrap();
        assert_eq!(
            (ended.status.and_then(|s| s.code()), ended.stderr.as_str()),
            (Some(3), "no\n")
        );
    }
}
