//! A running command of povr, killed on drop.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Time within which povr says or does everything.
pub(crate) const TIME_LIMIT: Duration = Duration::from_secs(60);

/// The process, and its lines on standard error.
pub(crate) struct Running {
    pub(crate) child: Child,
    said: Receiver<String>,
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Running {
    /// Starts povr in a folder.
    pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Running {
        let mut child = Command::new(env!("CARGO_BIN_EXE_povr"))
            .current_dir(folder)
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("povr starts");
        let pipe = BufReader::new(child.stderr.take().expect("a pipe"));
        let (tell, said) = channel();
        std::thread::spawn(move || {
            for line in pipe.lines().map_while(Result::ok) {
                let _ = tell.send(line);
            }
        });
        Running { child, said }
    }

    /// True if nothing more has been said.
    pub(crate) fn is_silent(&self) -> bool {
        self.said.try_recv().is_err()
    }

    /// All lines up to the first that contains a text.
    pub(crate) fn until(&self, text: &str) -> Vec<String> {
        let start = Instant::now();
        let mut lines = Vec::new();
        loop {
            let left = TIME_LIMIT.saturating_sub(start.elapsed());
            match self.said.recv_timeout(left) {
                Ok(line) => lines.push(line),
                Err(_) => panic!("`{text}` is not said; what is: {lines:#?}"),
            }
            if lines.last().is_some_and(|line| line.contains(text)) {
                return lines;
            }
        }
    }
}
