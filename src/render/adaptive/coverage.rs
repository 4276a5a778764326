//! Coverage and colour of the parts of a pixel between straight lines, and their mean.

use super::edge::Division;
use super::slope::Sums;

/// The parts of a divided pixel, up to three: the area that each covers, and its colour.
pub(super) struct PixelParts {
    shares: [f64; 3],
    colors: [[f64; 4]; 3],
    variances: [[f64; 4]; 3],
}

impl PixelParts {
    /// The parts between the lines; `None` if a part has too few samples. If the first and the last part are alike,
    /// either stands in for the other.
    pub(super) fn of(
        first: &Division,
        second: Option<&Division>,
        sums: &[Sums; 3],
        are_alike: bool,
    ) -> Option<PixelParts> {
        let last = second.map_or(0.0, |second| 1.0 - second.dark);
        let between = (1.0 - first.dark - last).max(0.0);
        let shares = [first.dark, between, last];
        let of_first = first.centroids();
        let middle_of_last = second.map_or([0.5; 2], |second| second.centroids()[1]);
        let middle = match second {
            None => of_first[1],
            Some(_) if between < MIN_PART => [0.5; 2],
            Some(_) => [0, 1]
                .map(|i| (0.5 - first.dark * of_first[0][i] - last * middle_of_last[i]) / between),
        };
        let centroids = [of_first[0], middle, middle_of_last];
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
            parts.colors[part] = plane.at(centroids[part]);
            parts.variances[part] = plane.variances;
        }
        Some(parts)
    }

    /// The variance of the mean in a channel: due to the colours of the parts, and due to each line.
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

/// Parts with less area have no centroid.
const MIN_PART: f64 = 1e-3;
