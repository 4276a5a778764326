//! Dithering: values between two levels take the upper one in a part of the pixels, so that the mean stays the same.
//!
//! A method either compares with thresholds that repeat over the picture, or adds to a pixel what its neighbours lost
//! by rounding (error diffusion, after Floyd and Steinberg 1976). The thresholds and the distribution of errors are
//! POV-Ray's (`docs/povray-facts.md`, 3 and 15), among them what version 3.7 does at the left edge.

use crate::base::encoding::{DitherMethod, Rounding};

/// The most channels of a pixel.
pub(super) const MAX_CHANNELS: usize = 4;

/// The columns that errors can go beyond either side.
const MARGIN: usize = 2;

/// The rank of each threshold of 64 by 64 pixels of blue noise, 0 to 4095, in 16 bits, little-endian.
const BLUE_NOISE: &[u8; 64 * 64 * 2] = include_bytes!("blue_noise.bin");

/// The dithering of one picture, from the left to the right in each row and from the top to the bottom.
pub(super) enum Dither {
    Ordered(Thresholds),
    Diffused(Diffusion),
}

impl Dither {
    /// The state at the upper left pixel.
    pub(super) fn new(method: DitherMethod, rounding: Rounding, width: usize) -> Dither {
        let is_3_7 = rounding == Rounding::Encoded;
        let thresholds = |side, ranks| {
            let offset = if is_3_7 { 0.0 } else { 0.5 };
            Dither::Ordered(Thresholds::Matrix {
                side,
                ranks,
                offset,
            })
        };
        let diffused = |edge, of, parts| Dither::Diffused(Diffusion::new(width, edge, of, parts));
        match method {
            DitherMethod::Bayer2 if is_3_7 => thresholds(2, &[3, 0, 1, 2]),
            DitherMethod::Bayer2 => thresholds(2, &[3, 1, 0, 2]),
            DitherMethod::Bayer3 if is_3_7 => thresholds(3, &[6, 3, 7, 2, 8, 1, 5, 0, 4]),
            DitherMethod::Bayer3 => thresholds(3, &[8, 5, 2, 1, 7, 4, 3, 0, 6]),
            DitherMethod::Bayer4 if is_3_7 => {
                thresholds(4, &[15, 3, 12, 0, 7, 11, 4, 8, 13, 1, 14, 2, 5, 9, 6, 10])
            }
            DitherMethod::Bayer4 => {
                thresholds(4, &[15, 7, 13, 5, 3, 11, 1, 9, 12, 4, 14, 6, 0, 8, 2, 10])
            }
            DitherMethod::BlueNoise => Dither::Ordered(Thresholds::BlueNoise),
            DitherMethod::BlueNoiseInverted => Dither::Ordered(Thresholds::BlueNoiseInverted),
            DitherMethod::Diffusion1D if is_3_7 => diffused(Edge::Wraps, 1.0, &[(1, 0, 1.0)]),
            DitherMethod::Diffusion1D => diffused(Edge::Loses, 1.0, &[(1, 0, 1.0)]),
            DitherMethod::Diffusion2D if is_3_7 => {
                diffused(Edge::IsLate, 4.0, &[(1, 0, 2.0), (0, 1, 1.0), (1, 1, 1.0)])
            }
            DitherMethod::Diffusion2D => {
                diffused(Edge::Loses, 4.0, &[(1, 0, 2.0), (-1, 1, 1.0), (0, 1, 1.0)])
            }
            DitherMethod::FloydSteinberg => diffused(
                if is_3_7 { Edge::IsLate } else { Edge::Loses },
                16.0,
                &[(1, 0, 7.0), (-1, 1, 3.0), (0, 1, 5.0), (1, 1, 1.0)],
            ),
            DitherMethod::Atkinson => diffused(Edge::Loses, 8.0, ATKINSON),
            DitherMethod::Burkes => diffused(Edge::Loses, 32.0, BURKES),
            DitherMethod::JarvisJudiceNinke => diffused(Edge::Loses, 48.0, JARVIS_JUDICE_NINKE),
            DitherMethod::Sierra2 => diffused(Edge::Loses, 16.0, SIERRA_2),
            DitherMethod::Sierra3 => diffused(Edge::Loses, 32.0, SIERRA_3),
            DitherMethod::Stucki => diffused(Edge::Loses, 42.0, STUCKI),
        }
    }
}

/// Thresholds that repeat over the picture.
pub(super) enum Thresholds {
    /// `(rank + offset) / side²`, the ranks row by row.
    Matrix {
        side: usize,
        ranks: &'static [u8],
        offset: f32,
    },
    BlueNoise,
    BlueNoiseInverted,
}

impl Thresholds {
    /// The share of the step to the upper level from which on a channel of this pixel takes that.
    pub(super) fn at(&self, x: usize, y: usize, channel: usize) -> f32 {
        match self {
            Thresholds::Matrix {
                side,
                ranks,
                offset,
            } => {
                let rank = f32::from(ranks[y % side * side + x % side]);
                (rank + offset) / f32::from(u16::try_from(ranks.len()).unwrap_or(u16::MAX))
            }
            Thresholds::BlueNoise => blue_noise(x, y),
            Thresholds::BlueNoiseInverted if channel.is_multiple_of(2) => 1.0 - blue_noise(x, y),
            Thresholds::BlueNoiseInverted => blue_noise(x, y),
        }
    }
}

fn blue_noise(x: usize, y: usize) -> f32 {
    let at = (y % 64 * 64 + x % 64) * 2;
    let rank = u16::from_le_bytes([BLUE_NOISE[at], BLUE_NOISE[at + 1]]);
    (f32::from(rank) + 0.5) / 4096.0
}

/// A part of an error: columns to the right, rows down, and its weight.
type Part = (isize, usize, f32);

const ATKINSON: &[Part] = &[
    (1, 0, 1.0),
    (2, 0, 1.0),
    (-1, 1, 1.0),
    (0, 1, 1.0),
    (1, 1, 1.0),
    (0, 2, 1.0),
];
const BURKES: &[Part] = &[
    (1, 0, 8.0),
    (2, 0, 4.0),
    (-2, 1, 2.0),
    (-1, 1, 4.0),
    (0, 1, 8.0),
    (1, 1, 4.0),
    (2, 1, 2.0),
];
const JARVIS_JUDICE_NINKE: &[Part] = &[
    (1, 0, 7.0),
    (2, 0, 5.0),
    (-2, 1, 3.0),
    (-1, 1, 5.0),
    (0, 1, 7.0),
    (1, 1, 5.0),
    (2, 1, 3.0),
    (-2, 2, 1.0),
    (-1, 2, 3.0),
    (0, 2, 5.0),
    (1, 2, 3.0),
    (2, 2, 1.0),
];
const SIERRA_2: &[Part] = &[
    (1, 0, 4.0),
    (2, 0, 3.0),
    (-2, 1, 1.0),
    (-1, 1, 2.0),
    (0, 1, 3.0),
    (1, 1, 2.0),
    (2, 1, 1.0),
];
const SIERRA_3: &[Part] = &[
    (1, 0, 5.0),
    (2, 0, 3.0),
    (-2, 1, 2.0),
    (-1, 1, 4.0),
    (0, 1, 5.0),
    (1, 1, 4.0),
    (2, 1, 2.0),
    (-1, 2, 2.0),
    (0, 2, 3.0),
    (1, 2, 2.0),
];
const STUCKI: &[Part] = &[
    (1, 0, 8.0),
    (2, 0, 4.0),
    (-2, 1, 2.0),
    (-1, 1, 4.0),
    (0, 1, 8.0),
    (1, 1, 4.0),
    (2, 1, 2.0),
    (-2, 2, 1.0),
    (-1, 2, 2.0),
    (0, 2, 4.0),
    (1, 2, 2.0),
    (2, 2, 1.0),
];

/// The treatment of errors at the sides of the picture.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Edge {
    /// Errors beyond the sides of the picture are lost.
    Loses,
    /// Errors beyond the right end of a row go to the start of the next one.
    Wraps,
    /// As `Loses`, and the first pixel of a row gets the errors that are due in the row before it.
    IsLate,
}

/// The errors of one row, with a margin on both sides.
type Row = Vec<[f32; MAX_CHANNELS]>;

/// Errors on their way to later pixels.
pub(super) struct Diffusion {
    parts: Vec<Part>,
    edge: Edge,
    /// The row before the current one, that one, and the next two.
    rows: [Row; 4],
}

impl Diffusion {
    fn new(width: usize, edge: Edge, of: f32, parts: &[Part]) -> Diffusion {
        let share = |&(right, down, weight): &Part| (right, down, weight / of);
        Diffusion {
            parts: parts.iter().map(share).collect(),
            edge,
            rows: std::array::from_fn(|_| vec![[0.0; MAX_CHANNELS]; width + 2 * MARGIN]),
        }
    }

    /// The error that a channel of the pixel in column `x` of the current row receives.
    pub(super) fn due(&self, x: usize, channel: usize) -> f32 {
        let row = usize::from(x > 0 || self.edge != Edge::IsLate);
        self.rows[row][MARGIN + x][channel]
    }

    /// Distributes the error of a channel of that pixel.
    pub(super) fn spread(&mut self, x: usize, channel: usize, error: f32) {
        for &(right, down, share) in &self.parts {
            let column = (MARGIN + x).saturating_add_signed(right);
            self.rows[1 + down][column][channel] += error * share;
        }
    }

    /// Ends the current row.
    pub(super) fn end_row(&mut self) {
        let beyond = self.rows[1].len() - MARGIN;
        let leaving = self.rows[1][beyond];
        self.rows.rotate_left(1);
        self.rows[3].fill([0.0; MAX_CHANNELS]);
        if self.edge == Edge::Wraps {
            self.rows[1][MARGIN] = leaving;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BLUE_NOISE, Dither, MAX_CHANNELS};
    use crate::base::encoding::{DitherMethod, Rounding};

    #[test]
    fn blue_noise_has_every_threshold_once() {
        let mut ranks: Vec<u16> = BLUE_NOISE
            .as_chunks()
            .0
            .iter()
            .map(|&two| u16::from_le_bytes(two))
            .collect();
        ranks.sort_unstable();
        assert!(ranks.iter().copied().eq(0..4096));
    }

    #[test]
    fn errors_are_distributed_whole_except_by_atkinson() {
        for (name, method) in DitherMethod::ALL {
            for rounding in [Rounding::Encoded, Rounding::Working] {
                if let Dither::Diffused(mut diffusion) = Dither::new(method, rounding, 9) {
                    diffusion.spread(4, 1, 1.0);
                    let cells = diffusion.rows.iter().flatten();
                    let sum: f32 = cells.map(|cell: &[f32; MAX_CHANNELS]| cell[1]).sum();
                    let expected = if name == "AT" { 0.75 } else { 1.0 };
                    assert!((sum - expected).abs() < 1e-6, "{name}: {sum}");
                }
            }
        }
    }

    #[test]
    fn version_3_7_carries_the_error_of_one_row_to_the_next() {
        let of = |method, rounding| match Dither::new(method, rounding, 3) {
            Dither::Diffused(mut diffusion) => {
                diffusion.spread(2, 0, 0.5);
                diffusion.spread(0, 0, 0.25);
                diffusion.end_row();
                let first = diffusion.due(0, 0);
                diffusion.end_row();
                (first, diffusion.due(0, 0))
            }
            Dither::Ordered(_) => panic!("it has no errors"),
        };
        let (old, new) = (Rounding::Encoded, Rounding::Working);
        assert_eq!(of(DitherMethod::Diffusion1D, old), (0.5, 0.0));
        assert_eq!(of(DitherMethod::Diffusion1D, new), (0.0, 0.0));
        assert_eq!(of(DitherMethod::Diffusion2D, old), (0.0, 0.0625));
        assert_eq!(of(DitherMethod::Diffusion2D, new), (0.0625, 0.0));
    }
}
