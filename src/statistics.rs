//! What `--stats` prints: the time of each stage, the rays by kind, and the plan.

use crate::compile::{Plan, Rays};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Takes the time of stages.
#[derive(Debug)]
pub struct Watch {
    wall: Instant,
    processor: Duration,
    laps: Vec<Lap>,
}

/// How long a stage took.
#[derive(Clone, Copy, Debug)]
struct Lap {
    stage: &'static str,
    wall: Duration,
    /// Of all threads together.
    processor: Duration,
}

impl Watch {
    /// Starts the first stage.
    #[must_use]
    pub fn start() -> Self {
        Watch {
            wall: Instant::now(),
            processor: processor_time(),
            laps: Vec::new(),
        }
    }

    /// Ends a stage and starts the next.
    pub fn lap(&mut self, stage: &'static str) {
        let (wall, processor) = (Instant::now(), processor_time());
        self.laps.push(Lap {
            stage,
            wall: wall - self.wall,
            processor: processor.saturating_sub(self.processor),
        });
        (self.wall, self.processor) = (wall, processor);
    }
}

/// The processor time of this process so far; zero where it is not known.
fn processor_time() -> Duration {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Duration::try_from(time).unwrap_or_default()
    }
    #[cfg(not(unix))]
    Duration::ZERO
}

/// All of it, a fact a line. `tools/bench` reads the lines of the stages and of the rays.
#[must_use]
pub fn text(watch: &Watch, rays: &Rays, plan: &Plan) -> String {
    let mut text = String::new();
    for lap in &watch.laps {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<11} {:.4} s, processor {:.4} s",
            lap.stage,
            lap.wall.as_secs_f64(),
            lap.processor.as_secs_f64()
        );
    }
    let _ = writeln!(
        text,
        "rays        {} camera, {} onward, {} reflected, {} shadow, {} filtered",
        rays.camera, rays.onward, rays.reflected, rays.shadow, rays.filtered
    );
    let _ = write!(text, "{plan}");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_stand_in_their_order_with_both_times() {
        let mut watch = Watch::start();
        watch.lap("read");
        watch.lap("trace");
        let text = text(&watch, &Rays::default(), &Plan::default());
        let stages: Vec<&str> = text
            .lines()
            .filter(|line| line.contains(" s, processor "))
            .filter_map(|line| line.split_whitespace().next())
            .collect();
        assert_eq!(stages, ["read", "trace"]);
    }
}
