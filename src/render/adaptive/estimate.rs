//! The mean of a pixel's samples, and its estimated error.
//!
//! The first `2^k` samples lie one in each cell of a grid. A cell crossed by an edge of contrast `d` has a variance of
//! `d²/6` on average over all positions of the edge, and about as many pairs of neighbouring cells differ by `d` as
//! there are such cells. For a smooth surface the same rule gives double the variance, for noise about the right one.
//! So the variance of the mean is about a sixth of the sum of squared differences of neighbours, over the square of the
//! count. A scrambled (0, 2)-sequence is better than that by a third, which serves as a reserve.
//!
//! Where the samples around show an even colour slope, the slope is removed from both the mean and the error.

use super::sample::AdaptiveSample;
use super::slope::Slopes;

/// The variance of a cell over the squared difference of neighbours.
pub(super) const SHARE_OF_VARIANCE: f64 = 1.0 / 6.0;
/// Least share of the error with half the samples that is assumed to remain with all of them: an estimate that drops by
/// more than can be expected is luck.
const MIN_LEFT: f64 = 0.5;
/// Share of the change since half the samples that is assumed to be still to come.
pub(super) const STILL_TO_COME: f64 = 0.33;

/// An estimate of a pixel from some of its samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Estimate {
    /// The mean of each channel.
    pub(super) mean: [f64; 4],
    /// The estimated standard error of the worst channel.
    pub(super) error: f64,
}

impl Estimate {
    /// From a mean and the variances of its channels.
    pub(super) fn of(mean: [f64; 4], variances: [f64; 4], channels: usize) -> Estimate {
        let error_of = |c: usize| {
            let error = variances[c].sqrt();
            // Anything above full white is displayed as white.
            if mean[c] - 2.0 * error > 1.0 {
                0.0
            } else {
                error
            }
        };
        Estimate {
            mean,
            error: (0..channels).map(error_of).fold(0.0, f64::max),
        }
    }

    /// The largest difference of two means in a channel; values above full white are clipped.
    pub(super) fn max_difference(&self, other: &Estimate, channels: usize) -> f64 {
        (0..channels)
            .map(|c| (self.mean[c].min(1.0) - other.mean[c].min(1.0)).abs())
            .fold(0.0, f64::max)
    }
}

/// Range of values in each channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ChannelRange {
    least: [f32; 4],
    most: [f32; 4],
}

impl ChannelRange {
    pub(super) const NOTHING: ChannelRange = ChannelRange {
        least: [f32::INFINITY; 4],
        most: [f32::NEG_INFINITY; 4],
    };

    pub(super) fn of(samples: &[AdaptiveSample]) -> ChannelRange {
        samples.iter().fold(ChannelRange::NOTHING, |range, sample| {
            range.with(&ChannelRange {
                least: sample.channels,
                most: sample.channels,
            })
        })
    }

    pub(super) fn with(mut self, other: &ChannelRange) -> ChannelRange {
        for c in 0..4 {
            // `f32::min` handles NaN, which takes longer than all the rest.
            if other.least[c] < self.least[c] {
                self.least[c] = other.least[c];
            }
            if other.most[c] > self.most[c] {
                self.most[c] = other.most[c];
            }
        }
        self
    }

    /// The largest contrast of a channel; values above full white are clipped.
    pub(super) fn contrast(&self, channels: usize) -> f64 {
        let contrast = |c: usize| f64::from(self.most[c].min(1.0) - self.least[c].min(1.0));
        (0..channels).map(contrast).fold(0.0, f64::max)
    }
}

/// The estimate from all samples, made cautious by the estimate from the first half.
pub(super) fn limited_by_half(whole: Estimate, half: &Estimate, channels: usize) -> Estimate {
    Estimate {
        error: whole
            .error
            .max(half.error * MIN_LEFT)
            .max(whole.max_difference(half, channels) * STILL_TO_COME),
        ..whole
    }
}

/// The estimate from the first samples of a pixel, a power of two of them, on a surface with these slopes. `grid` is a
/// buffer.
pub(super) fn estimate(
    samples: &[AdaptiveSample],
    channels: usize,
    slopes: &Slopes,
    grid: &mut Vec<[f64; 4]>,
) -> Estimate {
    let bits = samples.len().ilog2();
    let (across, down) = (bits.div_ceil(2), bits / 2);
    grid.clear();
    grid.resize(samples.len(), [0.0; 4]);
    let mut sum = [0.0; 4];
    for sample in samples {
        let column = u32::from(sample.position.0) >> (16 - across);
        let row = u32::from(sample.position.1) >> (16 - down);
        let color = slopes.levelled(sample);
        grid[(row << across | column) as usize] = color;
        sum = [0, 1, 2, 3].map(|c| sum[c] + color[c]);
    }
    let (width, height) = (1usize << across, 1usize << down);
    let mut apart = [0.0; 4];
    let mut compare = |a: &[f64; 4], b: &[f64; 4]| {
        for c in 0..4 {
            let d = a[c] - b[c];
            apart[c] += d * d;
        }
    };
    for row in 0..height {
        let here = &grid[row * width..(row + 1) * width];
        let below = grid.get((row + 1) * width..(row + 2) * width);
        for (column, own) in here.iter().enumerate() {
            if let Some(next) = here.get(column + 1) {
                compare(own, next);
            }
            if let Some(below) = below {
                compare(own, &below[column]);
            }
        }
    }
    let count = as_f64(samples.len());
    // In a small grid the cells at the border have fewer neighbours than those inside.
    let pairs = as_f64((2 * width * height - width - height).max(1));
    let share = SHARE_OF_VARIANCE * 2.0 / (count * pairs);
    Estimate::of(
        sum.map(|sum| sum / count),
        apart.map(|apart| share * apart),
        channels,
    )
}

#[allow(clippy::cast_precision_loss, reason = "samples of a pixel are few")]
fn as_f64(n: usize) -> f64 {
    n as f64
}
