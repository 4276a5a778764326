//! The pixels of a band: their samples, and the finished ones.

use super::estimate::ChannelRange;
use super::sample::{AdaptiveSample, PixelSampler};
use crate::base::film::Pixel;
use crate::world::RayCounts;
use std::ops::Range;
use std::time::Instant;

/// Upper limit of the first samples of a pixel.
pub(super) const FIRST_AT_MOST: u32 = 32;

/// Factor from the first samples of a pixel to its samples at edges.
pub(super) const FINER: u32 = 4;

/// Error to reach, and limits of the sampling.
#[derive(Clone, Copy)]
pub(super) struct ErrorTarget {
    /// The largest estimated error of a pixel.
    pub(super) error: f64,
    /// First samples of each pixel: a power of two.
    pub(super) first: u32,
    /// Time at which rendering stops with the current result.
    pub(super) deadline: Option<Instant>,
}

impl ErrorTarget {
    /// The smaller the error, the smaller a feature may be that the first samples miss.
    pub(super) fn new(error: f64, deadline: Option<Instant>) -> ErrorTarget {
        const FIRST: [(f64, u32); 3] = [(1.25 / 255.0, 4), (0.35 / 255.0, 8), (0.15 / 255.0, 16)];
        let first = FIRST.iter().find(|(least, _)| error >= *least);
        ErrorTarget {
            error,
            first: first.map_or(FIRST_AT_MOST, |&(_, first)| first),
            deadline,
        }
    }

    pub(super) fn is_over(&self) -> bool {
        self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}

/// Which samples of a pixel count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SampleFilter {
    /// The first samples only.
    First,
    /// All samples of a pixel before it is finished.
    All,
}

/// A finished pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FinishedPixel {
    pub(super) value: Pixel,
    pub(super) error: f64,
}

/// The samples of a rectangle of pixels.
pub(super) struct Band<'a> {
    pub(super) sampler: &'a PixelSampler<'a>,
    pub(super) target: ErrorTarget,
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
    /// The first samples, pixel by pixel.
    pub(super) first: Vec<AdaptiveSample>,
    /// For each pixel, the index of the sample in each cell of its grid.
    pub(super) first_order: Vec<u8>,
    /// All samples of the pixels that got more, including the first ones.
    pub(super) finer: Vec<AdaptiveSample>,
    /// The index into these samples for each cell.
    pub(super) finer_order: Vec<u8>,
    /// For each pixel, the start of its samples in `finer`, if it has any there.
    pub(super) finer_at: Vec<Option<u32>>,
    pub(super) ranges: Vec<ChannelRange>,
    pub(super) is_broken: Vec<bool>,
    /// Edge pixels that are finished with a few more samples.
    pub(super) settled: Vec<Option<FinishedPixel>>,
    /// Samples taken.
    pub(super) samples: u64,
    /// Rays traced for them.
    pub(super) rays: RayCounts,
}
