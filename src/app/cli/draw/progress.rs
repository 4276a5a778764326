//! Progress of the rendering: a bar for people, POV-Ray's lines for programs that read them.

use std::io::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The form of progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgressKind {
    /// None.
    Nothing,
    /// POV-Ray's `Rendered N of M pixels (P%)`, each ended by a carriage return.
    Lines,
    /// A bar on a terminal.
    Bar,
}

/// Counts finished pixels, from any number of threads, and shows the count on standard error.
pub struct Progress {
    total: u64,
    done: AtomicU64,
    shown: Shown,
}

enum Shown {
    Nothing,
    /// The last percentage written.
    Lines(AtomicU64),
    Bar(ProgressBar),
}

impl Progress {
    /// A count that ends at `total` pixels. A bar shows the name of the scene.
    #[must_use]
    pub fn new(kind: ProgressKind, name: &str, total: u64) -> Self {
        let shown = match kind {
            ProgressKind::Nothing => Shown::Nothing,
            ProgressKind::Lines => Shown::Lines(AtomicU64::new(0)),
            ProgressKind::Bar => {
                let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
                let style = ProgressStyle::with_template(
                    "{msg}  {wide_bar} {percent:>3}%  {elapsed} elapsed, {eta} to go",
                );
                bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
                Shown::Bar(bar.with_message(name.to_owned()))
            }
        };
        Progress {
            total,
            done: AtomicU64::new(0),
            shown,
        }
    }

    /// Adds finished pixels.
    pub fn advance(&self, pixels: u64) {
        let done = self.done.fetch_add(pixels, Ordering::Relaxed) + pixels;
        match &self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => bar.inc(pixels),
            Shown::Lines(last) => {
                let percent = self.percent(done);
                if last.fetch_max(percent, Ordering::Relaxed) < percent {
                    // A closed pipe is no reason to stop rendering.
                    let _ = write!(io::stderr(), "{}\r", self.line(done));
                }
            }
        }
    }

    /// Clears the line for the next output.
    pub fn finish(&self) {
        match &self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => bar.finish_and_clear(),
            Shown::Lines(last) if last.load(Ordering::Relaxed) > 0 => {
                let _ = writeln!(io::stderr());
            }
            Shown::Lines(_) => {}
        }
    }

    fn percent(&self, done: u64) -> u64 {
        let hundredfold = done.saturating_mul(100);
        hundredfold.checked_div(self.total).unwrap_or(100)
    }

    fn line(&self, done: u64) -> String {
        let (total, percent) = (self.total, self.percent(done));
        format!("Rendered {done} of {total} pixels ({percent}%)")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_those_of_povray() {
        let progress = Progress::new(ProgressKind::Nothing, "", 57_600);
        assert_eq!(progress.line(4096), "Rendered 4096 of 57600 pixels (7%)");
        assert_eq!(
            Progress::new(ProgressKind::Nothing, "", 0).line(0),
            "Rendered 0 of 0 pixels (100%)"
        );
    }

    #[test]
    fn pixels_of_all_threads_are_counted() {
        let progress = Progress::new(ProgressKind::Nothing, "", 400);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| (0..100).for_each(|_| progress.advance(1)));
            }
        });
        assert_eq!(progress.done.into_inner(), 400);
    }
}
