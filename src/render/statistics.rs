//! The output of `--stats`: the time of each stage, the rays by kind, and the plan.

use crate::base::options::{Plan, Stage, Statistics};
use crate::render::tiles::Drawn;
use std::fmt;
use std::time::{Duration, Instant};

/// Measures the time of stages.
#[derive(Debug)]
pub struct StageTimer {
    wall: Instant,
    processor: Duration,
    laps: Vec<Stage>,
}

impl StageTimer {
    /// Starts the first stage.
    #[must_use]
    pub fn start() -> Self {
        StageTimer {
            wall: Instant::now(),
            processor: processor_time(),
            laps: Vec::new(),
        }
    }

    /// Ends a stage and starts the next.
    pub fn lap(&mut self, stage: &'static str) {
        let (wall, processor) = (Instant::now(), processor_time());
        self.laps.push(Stage {
            name: stage,
            wall: (wall - self.wall).as_secs_f64(),
            processor: processor.saturating_sub(self.processor).as_secs_f64(),
        });
        (self.wall, self.processor) = (wall, processor);
    }
}

/// The processor time of this process so far; zero where it is unknown.
fn processor_time() -> Duration {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Duration::try_from(time).unwrap_or_default()
    }
    #[cfg(not(unix))]
    Duration::ZERO
}

/// Collects all statistics.
#[must_use]
pub fn gather(watch: StageTimer, drawn: &Drawn, plan: Plan, pixels: u64) -> Statistics {
    let rays = &drawn.rays;
    #[allow(clippy::cast_precision_loss, reason = "a mean has few digits")]
    let samples_per_pixel = rays.camera as f64 / pixels.max(1) as f64;
    Statistics {
        stages: watch.laps,
        rays: [
            ("camera", rays.camera),
            ("onward", rays.onward),
            ("reflected", rays.reflected),
            ("gathering", rays.gathering),
            ("shadow", rays.shadow),
            ("filtered", rays.filtered),
        ]
        .into(),
        pixels,
        samples_per_pixel,
        reached: drawn.reached,
        radiosity: drawn.radiosity,
        photons: drawn.photons.as_ref().map(|shot| shot.taken),
        peak_bytes: peak_bytes(),
        plan,
    }
}

/// Peak memory of this process, on systems that report it in `/proc`.
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

/// One fact a line. `tools/bench` parses the lines of the stages and of the rays.
impl fmt::Display for Statistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for stage in &self.stages {
            writeln!(
                f,
                "{:<11} {:.4} s, processor {:.4} s",
                stage.name, stage.wall, stage.processor
            )?;
        }
        let rays = ["camera", "onward", "reflected", "shadow", "filtered"]
            .map(|kind| format!("{} {kind}", self.rays.get(kind).copied().unwrap_or(0)));
        writeln!(f, "rays        {}", rays.join(", "))?;
        writeln!(
            f,
            "pixels      {}, camera rays for each {:.2}",
            self.pixels, self.samples_per_pixel
        )?;
        if let Some(taken) = &self.radiosity {
            let gathering = self.rays.get("gathering").copied().unwrap_or(0);
            writeln!(
                f,
                "radiosity   {} samples, {} of them before rendering in {:.4} s; {} bytes, {gathering} rays, \
                 {} tiles revised",
                taken.samples, taken.pretraced, taken.pretrace_seconds, taken.bytes, taken.revised
            )?;
        }
        if let Some(taken) = &self.photons {
            writeln!(
                f,
                "photons     {} shot in {:.4} s, {} stored on surfaces and {} in media; {} bytes, radius {}",
                taken.shot,
                taken.seconds,
                taken.on_surfaces,
                taken.in_media,
                taken.bytes,
                taken.radius
            )?;
        }
        if let Some(bytes) = self.peak_bytes {
            writeln!(f, "memory      {} MiB at most", bytes >> 20)?;
        }
        let plan = &self.plan;
        let kinds: Vec<String> = plan
            .primitives
            .iter()
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        writeln!(
            f,
            "primitives  {} ({} transformed by a matrix), in {} CSG objects; {} unbounded",
            kinds.join(", "),
            plan.behind_matrix,
            plan.combinations,
            plan.unbounded
        )?;
        if plan.instances > 0 {
            writeln!(
                f,
                "copies      {} of {} shared unions, {} bytes each",
                plan.instances, plan.shared, plan.instance_bytes
            )?;
        }
        writeln!(
            f,
            "materials   {}, lights {}, tree {} bytes, views {} bytes",
            plan.surfaces, plan.lights, plan.tree_bytes, plan.view_bytes
        )?;
        writeln!(f, "left out    {}", plan.left_out.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_stand_in_their_order_with_both_times() {
        let mut watch = StageTimer::start();
        watch.lap("read");
        watch.lap("trace");
        let statistics = Statistics {
            stages: watch.laps,
            ..Statistics::default()
        };
        let text = statistics.to_string();
        let stages: Vec<&str> = text
            .lines()
            .filter(|line| line.contains(" s, processor "))
            .filter_map(|line| line.split_whitespace().next())
            .collect();
        assert_eq!(stages, ["read", "trace"]);
    }
}
