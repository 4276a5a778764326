//! The parts of a pixel between straight lines, their colours, and the mean of all.

use super::edge::Division;
use super::slope::Sums;

/// The parts of a divided pixel, up to three: how much each covers and what colour it has.
pub(super) struct PixelParts {
    shares: [f64; 3],
    colors: [[f64; 4]; 3],
    variances: [[f64; 4]; 3],
}

impl PixelParts {
    /// Between the lines; `None` if there are too few samples of a part. If the first and the last are
    /// alike, either stands in for the other.
    pub(super) fn of(
        first: &Division,
        second: Option<&Division>,
        sums: &[Sums; 3],
        are_alike: bool,
    ) -> Option<PixelParts> {
        let last = second.map_or(0.0, |second| 1.0 - second.dark);
        let between = (1.0 - first.dark - last).max(0.0);
        let shares = [first.dark, between, last];
        let of_first = first.middles();
        let middle_of_last = second.map_or([0.5; 2], |second| second.middles()[1]);
        let middle = match second {
            None => of_first[1],
            Some(_) if between < LEAST_PART => [0.5; 2],
            Some(_) => [0, 1]
                .map(|i| (0.5 - first.dark * of_first[0][i] - last * middle_of_last[i]) / between),
        };
        let middles = [of_first[0], middle, middle_of_last];
        let mut parts = PixelParts {
            shares,
            colors: [[0.0; 4]; 3],
            variances: [[0.0; 4]; 3],
        };
        let count = if second.is_some() { 3 } else { 2 };
        for part in 0..count {
            let of_the_other = || match are_alike && part != 1 {
                true => sums[2 - part].plane(),
                false => None,
            };
            let plane = sums[part].plane().or_else(of_the_other)?;
            parts.colors[part] = plane.at(middles[part]);
            parts.variances[part] = plane.variances;
        }
        Some(parts)
    }

    /// Of a channel: the variance of the mean that is due to the colours of the parts, and that due to each line.
    pub(super) fn variances(
        &self,
        c: usize,
        first: &Division,
        second: Option<&Division>,
    ) -> (f64, [f64; 2]) {
        let of_parts = (0..3).map(|part| self.shares[part].powi(2) * self.variances[part][c]);
        let contrast = |a: usize, b: usize| self.colors[a][c].min(1.0) - self.colors[b][c].min(1.0);
        let of_first = (contrast(0, 1) * first.error).powi(2);
        let of_second = second.map_or(0.0, |second| (contrast(1, 2) * second.error).powi(2));
        (of_parts.sum(), [of_first, of_second])
    }

    pub(super) fn mean(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|c| {
            (0..3)
                .map(|part| self.shares[part] * self.colors[part][c])
                .sum()
        })
    }
}

/// A part of a pixel that is smaller has no middle.
const LEAST_PART: f64 = 1e-3;
