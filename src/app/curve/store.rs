//! Stored measurements: JSON for continuing in a later run, and CSV for tables.

use super::error::Errors;
use super::setting::Family;
use super::truth::Truth;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::Path;

/// All results for a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The scene and options of the report: measurements under another key do not count.
    pub(super) key: String,
    /// The scene, as it was named.
    pub scene: String,
    /// Threads of each rendering.
    pub threads: usize,
    /// The reference picture of all measurements.
    pub truth: Truth,
    /// The measurements, in the order of the settings.
    pub measured: Vec<Measured>,
}

/// A measured setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The program and kind of method.
    pub family: Family,
    /// The switches.
    pub switches: String,
    /// The name of its picture files, followed by `.png` and `-difference.png`.
    pub file_stem: String,
    /// Seconds of tracing, over all processors.
    pub processor: Spread,
    /// Seconds of tracing by the clock.
    pub wall: Spread,
    /// Camera rays for each pixel.
    pub samples_per_pixel: f64,
    /// The largest estimated error of a pixel and the root mean square over all pixels, in linear light, if it was
    /// estimated.
    pub estimated: Option<(f64, f64)>,
    /// The errors relative to the truth.
    pub errors: Errors,
}

/// Repeated measurements of one quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The least.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// Number of measurements.
    pub runs: usize,
}

impl Spread {
    /// From a list that is not empty.
    pub(super) fn of(mut values: Vec<f64>) -> Spread {
        values.sort_unstable_by(f64::total_cmp);
        let at = |i: usize| values.get(i).copied().unwrap_or(0.0);
        let middle = values.len() / 2;
        Spread {
            median: if values.len().is_multiple_of(2) {
                f64::midpoint(at(middle.saturating_sub(1)), at(middle))
            } else {
                at(middle)
            },
            least: at(0),
            most: at(values.len().saturating_sub(1)),
            runs: values.len(),
        }
    }
}

impl Report {
    /// The table as comma-separated values with a header line.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = "program,switches,processor_s,processor_least_s,processor_most_s,wall_s,\
            wall_least_s,wall_most_s,runs,samples_per_pixel,rmse,max,p999,flip,estimated_max,estimated_rms\n"
            .to_owned();
        for m in &self.measured {
            let program = match m.family {
                Family::PovRay => "povray",
                _ => "povr",
            };
            let (p, w, e) = (&m.processor, &m.wall, &m.errors);
            let estimated = m.estimated.map_or_else(
                || ",".to_owned(),
                |(most, rms)| format!("{most:.6},{rms:.6}"),
            );
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{program},{},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4},{},{:.3},{:.6},{:.6},{:.6},{:.6},{estimated}",
                m.switches,
                p.median,
                p.least,
                p.most,
                w.median,
                w.least,
                w.most,
                p.runs,
                m.samples_per_pixel,
                e.rmse,
                e.max,
                e.p999,
                e.flip,
            );
        }
        text
    }

    /// The stored report with the same key.
    pub(super) fn stored(path: &Path, key: &str) -> Option<Report> {
        let bytes = std::fs::read(path).ok()?;
        let report: Report = serde_json::from_slice(&bytes).ok()?;
        (report.key == key).then_some(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_an_even_number_lies_between_the_middle_two() {
        let spread = Spread::of(vec![4.0, 1.0, 2.0, 9.0]);
        assert_eq!(
            (spread.median, spread.least, spread.most, spread.runs),
            (3.0, 1.0, 9.0, 4)
        );
        assert!((Spread::of(vec![5.0]).median - 5.0).abs() < 1e-12);
    }
}
