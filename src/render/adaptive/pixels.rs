//! The pixels of a band: their samples, and the finished ones.

use super::estimate::ChannelRange;
use super::sample::{AdaptiveSample, PixelSampler};
use crate::base::film::Pixel;
use crate::world::RayCounts;
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

/// Upper limit of the first samples of a pixel.
pub(crate) const FIRST_AT_MOST: u32 = 32;

/// Factor from the first samples of a pixel to its samples at edges.
pub(crate) const FINER: u32 = 4;

/// Error to reach, and limits of the sampling.
#[derive(Clone, Copy)]
pub(crate) struct ErrorTarget {
    /// The largest estimated error of a pixel.
    pub(crate) error: f64,
    /// First samples of each pixel: a power of two.
    pub(crate) first: u32,
    /// Time at which rendering stops with the current result.
    pub(crate) deadline: Option<Instant>,
}

impl ErrorTarget {
    /// The smaller the error, the smaller a feature may be that the first samples miss.
    pub(crate) fn new(error: f64, deadline: Option<Instant>) -> ErrorTarget {
        const FIRST: [(f64, u32); 3] = [(1.25 / 255.0, 4), (0.35 / 255.0, 8), (0.15 / 255.0, 16)];
        let first = FIRST.iter().find(|(least, _)| error >= *least);
        ErrorTarget {
            error,
            first: first.map_or(FIRST_AT_MOST, |&(_, first)| first),
            deadline,
        }
    }

    pub(crate) fn is_over(&self) -> bool {
        self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}

/// Which samples of a pixel count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SampleFilter {
    /// The first samples only.
    First,
    /// All samples of a pixel before it is finished.
    All,
}

/// A finished pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FinishedPixel {
    pub(crate) value: Pixel,
    pub(crate) error: f64,
}

/// The samples of a rectangle of pixels.
pub(crate) struct Band<'a> {
    pub(crate) sampler: &'a PixelSampler<'a>,
    pub(crate) target: ErrorTarget,
    pub(crate) columns: Range<u32>,
    pub(crate) rows: Range<u32>,
    /// The first samples, pixel by pixel.
    pub(crate) first: Vec<AdaptiveSample>,
    /// For each pixel, the index of the sample in each cell of its grid.
    pub(crate) first_order: Vec<u8>,
    /// All samples of the pixels that got more, including the first ones.
    pub(crate) finer: Vec<AdaptiveSample>,
    /// The index into these samples for each cell.
    pub(crate) finer_order: Vec<u8>,
    /// For each pixel, the start of its samples in `finer`, if it has any there.
    pub(crate) finer_at: Vec<Option<u32>>,
    pub(crate) ranges: Vec<ChannelRange>,
    pub(crate) is_broken: Vec<bool>,
    /// Edge pixels that are finished with a few more samples.
    pub(crate) settled: Vec<Option<FinishedPixel>>,
    /// Samples taken.
    pub(crate) samples: u64,
    /// Rays traced for them.
    pub(crate) rays: RayCounts,
}
