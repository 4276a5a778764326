//! Even colour slopes: the least-squares plane through samples.

use super::sample::AdaptiveSample;

/// The middle of a pixel, the origin of slopes.
const MIDDLE: f64 = 0.5;
/// Determinant of points on a line, relative to that of points all around.
const ON_A_LINE: f64 = 1e-3;

/// The slope of each channel across and down a pixel; `None` if level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Slopes(Option<[[f64; 2]; 4]>);

impl Slopes {
    /// The value a sample would have in the middle of the pixel.
    #[inline]
    pub(super) fn levelled(&self, sample: &AdaptiveSample) -> [f64; 4] {
        self.levelled_at(sample, [0.0; 2])
    }

    /// The same for a sample of the pixel at an offset in columns and rows.
    #[inline]
    pub(super) fn levelled_at(&self, sample: &AdaptiveSample, away: [f64; 2]) -> [f64; 4] {
        let mut channels = sample.channels.map(f64::from);
        let Some(slopes) = &self.0 else {
            return channels;
        };
        let [x, y] = sample.share();
        let [x, y] = [x + away[0], y + away[1]];
        for (c, slope) in channels.iter_mut().zip(slopes) {
            *c -= slope[0] * (x - MIDDLE) + slope[1] * (y - MIDDLE);
        }
        channels
    }
}

/// Sums over samples for fitting planes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    count: f64,
    point: [f64; 2],
    /// `xx`, `xy`, `yy`.
    squares: [f64; 3],
    value: [f64; 4],
    /// Point times value: across by channel, and down.
    mixed: [[f64; 4]; 2],
    value_squares: [f64; 4],
}

/// The plane through samples, and their deviation from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    middle: [f64; 2],
    mean: [f64; 4],
    slopes: [[f64; 2]; 4],
    /// The variance, by channel, of the mean of this many samples.
    pub(super) variances: [f64; 4],
}

impl Sums {
    /// Adds a sample at a point in pixels.
    pub(super) fn add(&mut self, [x, y]: [f64; 2], channels: &[f32; 4]) {
        let (x, y) = (x - MIDDLE, y - MIDDLE);
        self.count += 1.0;
        self.point = [self.point[0] + x, self.point[1] + y];
        let [xx, xy, yy] = self.squares;
        self.squares = [xx + x * x, xy + x * y, yy + y * y];
        let values = channels.map(f64::from);
        for (c, value) in values.into_iter().enumerate() {
            self.value[c] += value;
            self.mixed[0][c] += x * value;
            self.mixed[1][c] += y * value;
            self.value_squares[c] += value * value;
        }
    }

    /// The number of samples.
    pub(super) fn count(&self) -> f64 {
        self.count
    }

    /// The plane, level where there are too few samples for a slope; `None` for less than two samples.
    pub(super) fn plane(&self) -> Option<Plane> {
        let n = self.count;
        if n < 2.0 {
            return None;
        }
        let [x, y] = self.point.map(|sum| sum / n);
        let [xx, xy, yy] = self.squares;
        let (xx, xy, yy) = (xx - n * x * x, xy - n * x * y, yy - n * y * y);
        let determinant = xx * yy - xy * xy;
        let slopes_too = n >= 5.0 && determinant > ON_A_LINE * (xx + yy) * (xx + yy);
        let mut plane = Plane {
            middle: [x, y],
            mean: self.value.map(|sum| sum / n),
            slopes: [[0.0; 2]; 4],
            variances: [0.0; 4],
        };
        for c in 0..4 {
            let mean = plane.mean[c];
            let mut rest = self.value_squares[c] - n * mean * mean;
            if slopes_too {
                let [xv, yv] = [
                    self.mixed[0][c] - n * x * mean,
                    self.mixed[1][c] - n * y * mean,
                ];
                let slope = [
                    (xv * yy - yv * xy) / determinant,
                    (yv * xx - xv * xy) / determinant,
                ];
                rest -= slope[0] * xv + slope[1] * yv;
                plane.slopes[c] = slope;
            }
            let freedom = if slopes_too { n - 3.0 } else { n - 1.0 };
            plane.variances[c] = rest.max(0.0) / freedom / n;
        }
        Some(plane)
    }
}

impl Plane {
    /// The colour at a point in pixels.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let (x, y) = (x - MIDDLE - self.middle[0], y - MIDDLE - self.middle[1]);
        let mut color = self.mean;
        for (c, slope) in color.iter_mut().zip(self.slopes) {
            *c += slope[0] * x + slope[1] * y;
        }
        color
    }

    pub(super) fn slopes(&self) -> Slopes {
        Slopes(Some(self.slopes))
    }
}
