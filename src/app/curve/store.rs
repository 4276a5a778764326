//! What has been measured, in files: JSON that a later run goes on from, and CSV for tables.

use std::fmt::Write as _;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::CurveError;
use super::error::Errors;
use super::setting::Family;
use super::truth::Truth;
use crate::output::Pending;

/// Everything that is known about a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Of which scene and settings this is one: what was measured under another key does not count.
    pub(super) key: String,
    /// The scene, as it was named.
    pub scene: String,
    /// Threads of each drawing.
    pub threads: usize,
    /// The picture that all are measured against.
    pub truth: Truth,
    /// What was measured, in the order of the settings.
    pub measured: Vec<Measured>,
}

/// A setting that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Who drew.
    pub family: Family,
    /// With which switches.
    pub switches: String,
    /// The files of its pictures have this name, with `.png` and `-difference.png` behind it.
    pub file_stem: String,
    /// Seconds of tracing of all processors.
    pub processor: Spread,
    /// The same by the clock.
    pub wall: Spread,
    /// Camera rays for each pixel.
    pub samples_a_pixel: f64,
    /// The largest estimated error of a pixel and that of the mean of squares, in linear light, if it was estimated.
    pub estimated: Option<(f64, f64)>,
    /// How far the picture is from the truth.
    pub errors: Errors,
}

/// Several measurements of one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The middle one.
    pub median: f64,
    /// The least.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// How many there are.
    pub runs: usize,
}

impl Spread {
    /// Of a list that is not empty.
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
    /// The table as comma-separated values with a line of names.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = "program,switches,processor_s,processor_least_s,processor_most_s,wall_s,\
            wall_least_s,wall_most_s,runs,samples_a_pixel,rmse,max,p999,flip,estimated_max,estimated_rms\n"
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
                m.samples_a_pixel,
                e.rmse,
                e.max,
                e.p999,
                e.flip,
            );
        }
        text
    }

    /// What was measured before under the same key.
    pub(super) fn kept(path: &Path, key: &str) -> Option<Report> {
        let bytes = std::fs::read(path).ok()?;
        let report: Report = serde_json::from_slice(&bytes).ok()?;
        (report.key == key).then_some(report)
    }
}

/// Writes a file, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), CurveError> {
    let written = Pending::new(path).and_then(|mut file| {
        std::io::Write::write_all(&mut file, bytes)?;
        file.take_name()
    });
    written.map(drop).map_err(|error| {
        CurveError::new(format!("cannot write `{}`: {error}", path.display()))
            .with_hint("name another folder with `--out`")
    })
}

pub(super) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), CurveError> {
    match serde_json::to_vec_pretty(value) {
        Ok(bytes) => write(path, &bytes),
        Err(error) => Err(CurveError::new(format!(
            "cannot write `{}`: {error}",
            path.display()
        ))),
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
