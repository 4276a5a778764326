//! The samples adjacent to a sample, in its pixel and in the pixels around.

use super::estimate::{Estimate, SHARE_OF_VARIANCE};
use super::pixels::{Band, FINER, FIRST_AT_MOST, SampleFilter};
use super::sample::AdaptiveSample;
use super::slope::Slopes;
use smallvec::SmallVec;

/// Most samples of a pixel that are compared with those around.
const MOST: usize = (FIRST_AT_MOST * FINER) as usize;

/// Share of the contrast of two adjacent cells that counts as doubt about a pixel, as in the estimate of its error.
const DOUBT: f64 = 0.4;

/// The samples of a pixel in a grid, and the adjacent pixels: left, right, above and below.
struct Grid {
    width: usize,
    height: usize,
    /// The binary logarithm of the number of samples.
    bits: u32,
    around: [Option<usize>; 4],
}

/// The neighbour of a cell on one side.
enum Next {
    /// A cell of the same pixel.
    Inside(usize),
    /// The pixel on that side, and its cell if it has as many samples.
    Outside(usize, (usize, usize)),
    /// None: the edge of the band.
    Nothing,
}

impl Grid {
    fn new(band: &Band<'_>, pixel: (u32, u32), count: usize) -> Grid {
        let bits = count.ilog2();
        Grid {
            width: 1 << bits.div_ceil(2),
            height: 1 << (bits / 2),
            bits,
            around: SIDES.map(|side| band.index_at(pixel, side)),
        }
    }

    /// The neighbour of a cell on a side given by its index.
    #[inline]
    fn next(&self, (column, row): (usize, usize), side: usize) -> Next {
        let (is_outside, column, row) = match side {
            0 => (column == 0, column.wrapping_sub(1), row),
            1 => (column + 1 == self.width, column + 1, row),
            2 => (row == 0, column, row.wrapping_sub(1)),
            _ => (row + 1 == self.height, column, row + 1),
        };
        // Both sides are powers of two.
        let (column, row) = (column & (self.width - 1), row & (self.height - 1));
        if !is_outside {
            return Next::Inside(row * self.width + column);
        }
        match self.around[side] {
            Some(at) => Next::Outside(at, (column, row)),
            None => Next::Nothing,
        }
    }

    /// The sample in a cell of an adjacent pixel, which may have fewer samples.
    #[inline]
    fn sample<'a>(
        &self,
        band: &'a Band<'_>,
        filter: SampleFilter,
        at: usize,
        (column, row): (usize, usize),
    ) -> &'a AdaptiveSample {
        let coarser = self.bits.saturating_sub(band.count(filter, at).ilog2()) / 2;
        let cell = (row >> coarser) * (self.width >> coarser) + (column >> coarser);
        band.sample_in_cell(filter, at, cell)
    }
}

/// Offsets in columns and rows to the adjacent pixels.
const SIDES: [(i64, i64); 4] = [(-1, 0), (1, 0), (0, -1), (0, 1)];
const AWAY: [[f64; 2]; 4] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];

/// The estimate from the first samples of a pixel, each compared with its neighbours inside and outside the pixel, on a
/// surface with these slopes; and true if two neighbours hit different surfaces or sides.
pub(super) fn first_estimate(
    band: &Band<'_>,
    (x, y): (u32, u32),
    slopes: &Slopes,
) -> (Estimate, bool) {
    let at = band.at(x, y);
    let count = band.target.first as usize;
    let grid = Grid::new(band, (x, y), count);
    let levelled = |cell| slopes.levelled(band.sample_in_cell(SampleFilter::First, at, cell));
    let colors: SmallVec<[[f64; 4]; FIRST_AT_MOST as usize]> = (0..count).map(levelled).collect();
    let (mut mean, mut variances) = ([0.0; 4], [0.0; 4]);
    let mut is_torn = false;
    let area = 1.0 / f64::from(band.target.first);
    // Each cell has two pairs of neighbours on average.
    let share = area * area * SHARE_OF_VARIANCE * 2.0;
    for (cell, own) in colors.iter().enumerate() {
        let sample = band.sample_in_cell(SampleFilter::First, at, cell);
        let position = (cell & (grid.width - 1), cell / grid.width);
        let (mut apart, mut pairs) = ([0.0; 4], 0.0);
        for (side, away) in AWAY.into_iter().enumerate() {
            let (other, color) = match grid.next(position, side) {
                Next::Inside(cell) => (
                    band.sample_in_cell(SampleFilter::First, at, cell),
                    colors[cell],
                ),
                Next::Outside(at, position) => {
                    let other = grid.sample(band, SampleFilter::First, at, position);
                    (other, slopes.levelled_at(other, away))
                }
                Next::Nothing => continue,
            };
            is_torn = is_torn || !sample.is_same_side(other);
            pairs += 1.0;
            for c in 0..4 {
                let d = own[c] - color[c];
                apart[c] += d * d;
            }
        }
        for c in 0..4 {
            mean[c] += area * own[c];
            variances[c] += share * apart[c] / f64::max(pairs, 1.0);
        }
    }
    (
        Estimate::of(mean, variances, band.sampler.channels),
        is_torn,
    )
}

/// The colours of a sample, clipped at full white.
#[inline]
fn clipped(sample: &AdaptiveSample) -> [f32; 4] {
    sample.channels.map(|c| if c < 1.0 { c } else { 1.0 })
}

/// Collects the pixels around a broken pixel that its samples make doubtful.
pub(super) fn doubts(band: &Band<'_>, (x, y): (u32, u32), doubtful: &mut Vec<usize>) {
    let at = band.at(x, y);
    let count = band.count(SampleFilter::All, at);
    let channels = band.sampler.channels;
    let grid = Grid::new(band, (x, y), count);
    let clip = |cell| clipped(band.sample_in_cell(SampleFilter::All, at, cell));
    let colors: SmallVec<[[f32; 4]; MOST]> = (0..count).map(clip).collect();
    let target = band.target.error;
    let area = 1.0 / f64::from(band.target.first);
    // As in the estimate of a pixel.
    let differs = |a: &[f32; 4], b: &[f32; 4]| {
        let mut most = 0.0;
        for c in 0..channels {
            let apart = (a[c] - b[c]).abs();
            most = if apart > most { apart } else { most };
        }
        f64::from(most) * area * DOUBT > target
    };
    let mut alone = band.may_miss_features(x, y);
    for (cell, own) in colors.iter().enumerate() {
        let position = (cell & (grid.width - 1), cell / grid.width);
        let mut has_like = false;
        for side in 0..SIDES.len() {
            match grid.next(position, side) {
                Next::Inside(cell) => has_like = has_like || !differs(own, &colors[cell]),
                Next::Outside(other, position) => {
                    let sample = grid.sample(band, SampleFilter::First, other, position);
                    if !differs(own, &clipped(sample)) {
                        has_like = true;
                    } else if band.settled_at(other).is_none() {
                        doubtful.push(other);
                    }
                }
                Next::Nothing => {}
            }
        }
        alone |= !has_like;
    }
    if alone {
        let around = band.around(x, y).map(|(x, y)| band.at(x, y));
        doubtful.extend(around.filter(|&at| band.settled_at(at).is_none()));
    }
}
