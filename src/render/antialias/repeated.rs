//! Method 3, of POV-Ray 3.8: passes over the picture, each with a sample of every pixel that is not known well enough.
//!
//! The samples of a pixel and of its four neighbours together decide: the error of their mean, at the confidence
//! of the options and summed over the channels, must not exceed the threshold. (The fact sheet, section 15.) POV-Ray's
//! samples lie at random, other ones in every run; these lie at the points of a sequence of the pixel. Neighbours in other
//! tiles do not count.

use super::super::tiles::Tile;
use super::{Position, Sampler, Sum, cell, position};
use crate::base::film::Pixel;
use crate::base::math::sampling::chi_square::chi_square;
use crate::base::math::sampling::sobol::Sobol;
use crate::render::shade::BlockScratch;

/// The samples of a pixel.
#[derive(Default)]
struct Samples {
    count: u32,
    sum: Sum,
    moments: Moments,
}

/// Sums of values on the scale of comparison, and of their squares.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sums: [f64; 4],
    squares: [f64; 4],
}

impl Moments {
    fn of(grades: [f64; 4]) -> Moments {
        Moments {
            count: 1.0,
            sums: grades,
            squares: grades.map(|grade| grade * grade),
        }
    }

    fn add(&mut self, other: &Moments) {
        self.count += other.count;
        for channel in 0..4 {
            self.sums[channel] += other.sums[channel];
            self.squares[channel] += other.squares[channel];
        }
    }

    /// The standard error of the mean, summed over the channels.
    fn error(&self) -> f64 {
        let error = |channel: usize| {
            let mean = self.sums[channel] / self.count;
            let variance = self.squares[channel] / self.count - mean * mean;
            (variance.max(0.0) / self.count).sqrt()
        };
        (0..4).map(error).sum()
    }
}

/// A tile in progress.
struct Repeated<'s, 'a> {
    sampler: &'s Sampler<'a>,
    tile: &'s Tile,
    width: usize,
    samples: Vec<Samples>,
}

/// The pixels of a tile, row by row.
pub(super) fn pixels(sampler: &Sampler, tile: &Tile, scratch: &mut BlockScratch) -> Vec<Pixel> {
    let count = tile.columns.len() * tile.rows.len();
    let mut repeated = Repeated {
        sampler,
        tile,
        width: tile.columns.len(),
        samples: std::iter::repeat_with(Samples::default)
            .take(count)
            .collect(),
    };
    let in_order = scratch.single().order_dependent();
    let mut wanted: Vec<usize> = (0..count).collect();
    let quantile = chi_square(1, 1.0 - sampler.settings.confidence).sqrt();
    let max_error = sampler.settings.threshold / quantile;
    while !wanted.is_empty() {
        if !in_order {
            wanted.sort_by_key(|&at| cell(at % repeated.width, at / repeated.width));
        }
        let positions: Vec<Position> = wanted.iter().map(|&at| repeated.next(at)).collect();
        let traced = sampler.trace(&positions, in_order, scratch);
        for (&at, pixel) in wanted.iter().zip(&traced) {
            repeated.add(at, pixel);
        }
        wanted = (0..count)
            .filter(|&at| repeated.needs_more(at, max_error))
            .collect();
    }
    let mean = |samples: &Samples| samples.sum.mean(f64::from(samples.count));
    repeated.samples.iter().map(mean).collect()
}

impl Repeated<'_, '_> {
    /// The position of the next sample of a pixel.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a tile has few rows and columns"
    )]
    fn next(&self, at: usize) -> Position {
        let (column, row) = (at % self.width, at / self.width);
        let first = [self.tile.columns.start, self.tile.rows.start];
        let (x, y) = position(first.map(f64::from).into(), (column, row));
        let (seed_x, seed_y) = (first[0] + column as u32, first[1] + row as u32);
        let sequence = Sobol::of_pixel(seed_x.cast_signed(), seed_y.cast_signed());
        let (right, down) = sequence.point(self.samples[at].count);
        let share = |bits: u32| (f64::from(bits) + 0.5) / 2_f64.powi(32) - 0.5;
        (x + share(right), y + share(down))
    }

    fn add(&mut self, at: usize, pixel: &Pixel) {
        let grades = self.sampler.scale.graded(*pixel).grades;
        let samples = &mut self.samples[at];
        samples.count += 1;
        samples.sum.add(pixel);
        samples.moments.add(&Moments::of(grades));
    }

    /// True if a pixel is not known well enough and may have more samples.
    fn needs_more(&self, at: usize, max_error: f64) -> bool {
        let mut all = self.samples[at].moments;
        let (column, row) = (at % self.width, at / self.width);
        let height = self.samples.len() / self.width;
        let neighbours = [
            (column > 0).then(|| at - 1),
            (column + 1 < self.width).then(|| at + 1),
            (row > 0).then(|| at - self.width),
            (row + 1 < height).then(|| at + self.width),
        ];
        for neighbour in neighbours.into_iter().flatten() {
            all.add(&self.samples[neighbour].moments);
        }
        let most = 1 << (2 * self.sampler.settings.depth);
        self.samples[at].count < most && all.error() > max_error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_mean_falls_with_the_root_of_the_count() {
        let mut moments = Moments::default();
        for number in 0..100 {
            let value = f64::from(number % 2);
            moments.add(&Moments::of([value, value, 0.5, 0.0]));
        }
        assert!((moments.error() - 2.0 * 0.5 / 10.0).abs() < 1e-12);
    }
}
