//! A band of the picture: first samples for every pixel, more at edges, until the estimated errors are low enough.
//!
//! 1. Each pixel gets its first samples.
//! 2. A pixel is broken if its samples, or its samples and its neighbours', hit different surfaces or different sides
//!    of one, or if its error is too large. Exceptions: one straight edge divides the pixel and its surroundings, or
//!    the colour slopes evenly there.
//! 3. A broken pixel and its neighbours get four times as many samples. Neighbours that turn out to be broken pass this
//!    on, so that a wire that only some pixels saw is followed along its length, for [`ROUNDS`] pixels.
//! 4. These pixels get more samples until their error is small. The error is never taken to be smaller than the error
//!    of a feature between the samples with the contrast of the surroundings.
//!
//! A pixel depends only on pixels within [`MARGIN`] of it, so that a crop is rendered exactly as in the whole picture.

use super::estimate::ChannelRange;
use super::finish::{Finisher, HIDDEN, Outcome, Task, is_calm};
use super::neighbours::doubts;
use super::pixels::{Band, ErrorTarget, FINER, FinishedPixel, SampleFilter};
use super::sample::{AdaptiveSample, PixelSampler, SamplerScratch, TOGETHER};
use crate::world::RayCounts;
use rayon::prelude::*;
use std::ops::Range;

/// Distance in pixels over which a broken pixel passes on that state.
const ROUNDS: u32 = 8;
/// Largest distance in pixels at which one pixel influences another.
pub(super) const MARGIN: u32 = ROUNDS + 4;

/// Side of the squares of pixels whose first samples are traced together.
const SQUARE: u32 = 8;
/// Side of the squares of pixels that are finished together: a power of two.
const WORKED: u32 = 32;

impl<'a> Band<'a> {
    /// Samples a band up to step 2.
    pub(super) fn new(
        sampler: &'a PixelSampler<'a>,
        target: ErrorTarget,
        columns: Range<u32>,
        rows: Range<u32>,
    ) -> Self {
        let count = columns.len() * rows.len();
        let mut band = Band {
            sampler,
            target,
            columns,
            rows,
            first: Vec::new(),
            first_order: Vec::new(),
            finer: Vec::new(),
            finer_order: Vec::new(),
            finer_at: vec![None; count],
            ranges: Vec::new(),
            is_broken: Vec::new(),
            settled: Vec::new(),
            samples: 0,
            rays: RayCounts::default(),
        };
        band.sample_first();
        band.find_broken();
        let mut broken: Vec<usize> = (0..count).filter(|&at| band.is_broken[at]).collect();
        for _ in 0..ROUNDS {
            if broken.is_empty() || target.is_over() {
                break;
            }
            broken = band.sample_around(&broken);
        }
        band
    }

    /// Finishes the pixels of a rectangle of the band, row by row, and reports them to `progress`.
    pub(super) fn finish(
        &mut self,
        columns: &Range<u32>,
        rows: &Range<u32>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Vec<FinishedPixel> {
        let band = &*self;
        let finished: Vec<(Vec<Outcome>, RayCounts)> = squares(columns, rows, WORKED)
            .into_par_iter()
            .map_init(
                || (Finisher::default(), Vec::new()),
                |(scratch, pixels), square| {
                    pixels.clear();
                    pixels.extend(along_curve(&square));
                    let mut outcomes = Vec::with_capacity(pixels.len());
                    scratch.work(band, pixels, Task::Finish, |outcome| outcomes.push(outcome));
                    progress(pixels.len() as u64);
                    (outcomes, scratch.take_rays())
                },
            )
            .collect();
        let width = columns.len();
        let mut done = vec![FinishedPixel::default(); width * rows.len()];
        for (outcomes, rays) in finished {
            self.rays += rays;
            for outcome in outcomes {
                let (x, y) = outcome.pixel;
                let at = (y - rows.start) as usize * width + (x - columns.start) as usize;
                done[at] = outcome.done.unwrap_or_default();
                self.samples += u64::from(outcome.taken);
            }
        }
        let index = |(x, y): (u32, u32)| {
            let is_here = columns.contains(&x) && rows.contains(&y);
            is_here.then(|| (y - rows.start) as usize * width + (x - columns.start) as usize)
        };
        let (samples, rays) = self.sampler.tiny_objects.add(self, index, &mut done);
        self.samples += samples;
        self.rays += rays;
        done
    }

    pub(super) fn at(&self, x: u32, y: u32) -> usize {
        (y - self.rows.start) as usize * self.columns.len() + (x - self.columns.start) as usize
    }

    /// The pixel at an offset in columns and rows, if it lies in the band.
    pub(super) fn index_at(&self, (x, y): (u32, u32), (dx, dy): (i64, i64)) -> Option<usize> {
        let next = |v: u32, d: i64, range: &Range<u32>| {
            let next = u32::try_from(i64::from(v) + d).ok()?;
            range.contains(&next).then_some(next)
        };
        Some(self.at(next(x, dx, &self.columns)?, next(y, dy, &self.rows)?))
    }

    /// The 3 × 3 pixels around a pixel, itself included, clipped to the band.
    pub(super) fn around(&self, x: u32, y: u32) -> impl Iterator<Item = (u32, u32)> + use<> {
        let near = |v: u32, range: &Range<u32>| {
            v.saturating_sub(1).max(range.start)..(v + 2).min(range.end)
        };
        let columns = near(x, &self.columns);
        near(y, &self.rows).flat_map(move |y| columns.clone().map(move |x| (x, y)))
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "a band has far fewer pixels than 2^32"
    )]
    pub(super) fn pixel_at(&self, at: usize) -> (u32, u32) {
        let width = self.columns.len();
        (
            self.columns.start + (at % width) as u32,
            self.rows.start + (at / width) as u32,
        )
    }

    /// The result of a pixel that is already settled.
    pub(super) fn settled_at(&self, at: usize) -> Option<FinishedPixel> {
        self.settled[at]
    }

    /// True for a broken pixel.
    pub(super) fn is_broken_at(&self, at: usize) -> bool {
        self.is_broken[at]
    }

    /// True for a pixel with more than its first samples.
    pub(super) fn is_finer(&self, at: usize) -> bool {
        self.finer_at[at].is_some()
    }

    /// True if the contrast around a pixel is so high that its first samples may have missed a feature that matters.
    pub(super) fn may_miss_features(&self, x: u32, y: u32) -> bool {
        let contrast = self.range_around(x, y).contrast(self.sampler.channels);
        contrast * HIDDEN / f64::from(self.target.first) > self.target.error
    }

    pub(super) fn range_around(&self, x: u32, y: u32) -> ChannelRange {
        self.around(x, y)
            .fold(ChannelRange::NOTHING, |all, (x, y)| {
                all.with(&self.ranges[self.at(x, y)])
            })
    }

    pub(super) fn first_of(&self, at: usize) -> &[AdaptiveSample] {
        let n = self.target.first as usize;
        &self.first[at * n..(at + 1) * n]
    }

    pub(super) fn samples_of(&self, at: usize) -> &[AdaptiveSample] {
        match self.finer_at[at] {
            Some(start) => &self.finer[start as usize..][..(self.target.first * FINER) as usize],
            None => self.first_of(at),
        }
    }

    /// Samples of a pixel that count under a filter.
    pub(super) fn count(&self, filter: SampleFilter, at: usize) -> usize {
        match (filter, self.finer_at[at]) {
            (SampleFilter::All, Some(_)) => (self.target.first * FINER) as usize,
            _ => self.target.first as usize,
        }
    }

    /// The sample of a pixel in a cell of its grid.
    pub(super) fn sample_in_cell(
        &self,
        filter: SampleFilter,
        at: usize,
        cell: usize,
    ) -> &AdaptiveSample {
        match (filter, self.finer_at[at]) {
            (SampleFilter::All, Some(start)) => {
                let start = start as usize;
                &self.finer[start + self.finer_order[start + cell] as usize]
            }
            _ => {
                let start = at * self.target.first as usize;
                &self.first[start + self.first_order[start + cell] as usize]
            }
        }
    }

    fn sample_first(&mut self) {
        let n = self.target.first as usize;
        let squares = squares(&self.columns, &self.rows, SQUARE);
        let sampler = self.sampler;
        let traced: Vec<(Vec<AdaptiveSample>, RayCounts)> = squares
            .par_iter()
            .map_init(SamplerScratch::default, |scratch, square| {
                let mut samples = Vec::with_capacity(square.0.len() * square.1.len() * n);
                sampler.trace_sequence(
                    pixels_of(square),
                    0..self.target.first,
                    scratch,
                    &mut samples,
                );
                (samples, scratch.take_rays())
            })
            .collect();
        let count = self.columns.len() * self.rows.len();
        self.first = vec![AdaptiveSample::NONE; count * n];
        for ((columns, rows), (samples, rays)) in squares.iter().zip(traced) {
            self.rays += rays;
            let wide = columns.len() * n;
            for (row, y) in samples.chunks(wide.max(1)).zip(rows.clone()) {
                let start = self.at(columns.start, y) * n;
                self.first[start..start + wide].copy_from_slice(row);
            }
        }
        self.first_order = orders(&self.first, n);
        self.samples += self.first.len() as u64;
        self.ranges = self.first.chunks(n).map(ChannelRange::of).collect();
    }

    /// Finds pixels at edges and pixels whose error is too large; finishes those that need few more samples.
    fn find_broken(&mut self) {
        let band = &*self;
        let traced: Vec<(Vec<Outcome>, RayCounts)> = squares(&self.columns, &self.rows, WORKED)
            .into_par_iter()
            .map_init(
                || (Finisher::default(), Vec::new()),
                |(scratch, pixels), square| {
                    pixels.clear();
                    pixels.extend(along_curve(&square).filter(|&pixel| !is_calm(band, pixel)));
                    let mut outcomes = Vec::with_capacity(pixels.len());
                    scratch.work(band, pixels, Task::Settle, |outcome| outcomes.push(outcome));
                    (outcomes, scratch.take_rays())
                },
            )
            .collect();
        let count = self.finer_at.len();
        self.is_broken = vec![false; count];
        self.settled = vec![None; count];
        for (outcomes, rays) in traced {
            self.rays += rays;
            for outcome in outcomes {
                let at = self.at(outcome.pixel.0, outcome.pixel.1);
                self.is_broken[at] = outcome.done.is_none();
                self.settled[at] = outcome.done;
                self.samples += u64::from(outcome.taken);
            }
        }
    }

    /// Takes finer samples of broken pixels, and of the neighbours they make doubtful, where that has not been done
    /// yet. Returns the pixels that turn out to be broken too.
    fn sample_around(&mut self, broken: &[usize]) -> Vec<usize> {
        let mut refined: Vec<usize> = Vec::new();
        for &at in broken {
            self.request_finer(at, &mut refined);
        }
        self.sample_finer(&refined);
        let band = &*self;
        let doubtful: Vec<Vec<usize>> = refined
            .par_iter()
            .map(|&at| {
                let mut doubtful = Vec::new();
                doubts(band, band.pixel_at(at), &mut doubtful);
                doubtful
            })
            .collect();
        let mut newly = Vec::new();
        for at in doubtful.into_iter().flatten() {
            if !self.is_broken[at] {
                self.is_broken[at] = true;
                newly.push(at);
            }
        }
        newly.sort_unstable();
        newly
    }

    fn request_finer(&mut self, at: usize, refined: &mut Vec<usize>) {
        let all = self.target.first * FINER;
        if self.finer_at[at].is_none() {
            let next = self.finer.len() + refined.len() * all as usize;
            self.finer_at[at] = u32::try_from(next).ok();
            refined.push(at);
        }
    }

    fn sample_finer(&mut self, refined: &[usize]) {
        let all = self.target.first * FINER;
        let more = self.target.first..all;
        let together = (TOGETHER / more.len()).max(1);
        let sampler = self.sampler;
        let traced: Vec<(Vec<AdaptiveSample>, RayCounts)> = refined
            .par_chunks(together)
            .map_init(
                || (SamplerScratch::default(), Vec::new()),
                |(scratch, new), chunk| {
                    new.clear();
                    let pixels = chunk.iter().map(|&at| self.pixel_at(at));
                    sampler.trace_sequence(pixels, more.clone(), scratch, new);
                    let mut samples = Vec::with_capacity(chunk.len() * all as usize);
                    for (&at, new) in chunk.iter().zip(new.chunks(more.len())) {
                        samples.extend_from_slice(self.first_of(at));
                        samples.extend_from_slice(new);
                    }
                    (samples, scratch.take_rays())
                },
            )
            .collect();
        let start = self.finer.len();
        for (samples, rays) in traced {
            self.rays += rays;
            self.finer.extend(samples);
        }
        let new = &self.finer[start..];
        self.finer_order.extend(orders(new, all as usize));
        for (samples, &at) in new.chunks(all as usize).zip(refined) {
            self.ranges[at] = ChannelRange::of(samples);
        }
        self.samples += refined.len() as u64 * more.len() as u64;
    }
}

/// Columns and rows of pixels.
type Square = (Range<u32>, Range<u32>);

/// Splits a rectangle of pixels into squares with this side; those at the right and bottom are smaller.
fn squares(columns: &Range<u32>, rows: &Range<u32>, side: u32) -> Vec<Square> {
    let split = |range: &Range<u32>| {
        let end = range.end;
        let starts = range.clone().step_by(side as usize);
        starts.map(move |start| start..(start + side).min(end))
    };
    split(rows)
        .flat_map(|rows| split(columns).map(move |columns| (columns, rows.clone())))
        .collect()
}

/// The pixels of a square, row by row.
fn pixels_of((columns, rows): &Square) -> impl Iterator<Item = (u32, u32)> + use<> {
    let columns = columns.clone();
    rows.clone()
        .flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// The pixels of a square in Morton order, which keeps neighbours together.
fn along_curve((columns, rows): &Square) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (columns, rows) = (columns.clone(), rows.clone());
    let even_bits = |v: u32| {
        let v = v & 0x5555;
        let v = (v | v >> 1) & 0x3333;
        let v = (v | v >> 2) & 0x0f0f;
        (v | v >> 4) & 0x00ff
    };
    (0..WORKED * WORKED)
        .map(move |number| {
            let (across, down) = (even_bits(number), even_bits(number >> 1));
            (columns.start + across, rows.start + down)
        })
        .filter({
            let (right, bottom) = (columns.end, rows.end);
            move |&(x, y)| x < right && y < bottom
        })
}

/// For `count` samples of each pixel: the index of the sample in each cell of the pixel's grid.
fn orders(samples: &[AdaptiveSample], count: usize) -> Vec<u8> {
    let bits = count.ilog2();
    let (across, down) = (bits.div_ceil(2), bits / 2);
    let mut orders = vec![0u8; samples.len()];
    for (order, samples) in orders.chunks_mut(count).zip(samples.chunks(count)) {
        for (number, sample) in (0u8..=u8::MAX).zip(samples) {
            let column = usize::from(sample.position.0) >> (16 - across);
            let row = usize::from(sample.position.1) >> (16 - down);
            order[row << across | column] = number;
        }
    }
    orders
}
