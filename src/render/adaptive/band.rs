//! A band of the picture: every pixel is sampled a little, those at edges more, until the estimate holds.
//!
//! 1. Each pixel gets its first samples.
//! 2. A pixel is broken if its samples, or those of it and its neighbours, met different surfaces or sides of them, or if
//!    its error is too large; unless it turns out that one straight edge divides it and what is around, or that the
//!    colour slopes evenly there.
//! 3. A broken pixel and all around it get four times as many samples; those that turn out to be broken too pass that
//!    on. So a wire that only some pixels saw is followed along its length, for [`ROUNDS`] pixels.
//! 4. Those pixels get more samples until their error is small. It is never taken for smaller than what a feature
//!    between the samples would do whose contrast is that of the surroundings.
//!
//! A pixel depends on those within [`MARGIN`] of it and on no others, so that a part of a picture is drawn as it is in the
//! whole.

use super::estimate::Reach;
use super::finish::{Finishing, HIDDEN, Outcome, Task, is_calm};
use super::neighbors::doubts;
use super::sample::{AdaptiveSample, Eye, EyeScratch, TOGETHER};
use crate::base::film::Pixel;
use crate::world::RayCounts;
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

/// How far being broken is passed on, in pixels.
const ROUNDS: u32 = 8;
/// How far away a pixel may lie that decides about another.
pub(super) const MARGIN: u32 = ROUNDS + 4;
/// The most samples that a pixel gets first.
pub(super) const FIRST_AT_MOST: u32 = 32;
/// How many times as many samples there are at edges.
pub(super) const FINER: u32 = 4;
/// The side of the squares of pixels that are sampled first together.
const SQUARE: u32 = 8;
/// The same of those that are worked on together: a power of two.
const WORKED: u32 = 32;

/// What to reach.
#[derive(Clone, Copy)]
pub(super) struct ErrorTarget {
    /// The largest estimated error of a pixel.
    pub(super) error: f64,
    /// How many samples a pixel gets first: a power of two.
    pub(super) first: u32,
    /// When to stop with what there is.
    pub(super) deadline: Option<Instant>,
}

impl ErrorTarget {
    /// The smaller the error, the smaller what may stay unseen where nothing is to be seen.
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

/// Which samples count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SampleFilter {
    /// The first ones.
    First,
    /// All that a pixel got before it is finished.
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
    pub(super) eye: &'a Eye<'a>,
    pub(super) target: ErrorTarget,
    columns: Range<u32>,
    rows: Range<u32>,
    /// The first samples, pixel by pixel.
    first: Vec<AdaptiveSample>,
    /// For each pixel which of them lies in each cell of a grid.
    first_order: Vec<u8>,
    /// More of them for some pixels, the first included.
    finer: Vec<AdaptiveSample>,
    /// Which of these lies in each cell.
    finer_order: Vec<u8>,
    /// For each pixel where its samples in `finer` begin, if it has some there.
    finer_at: Vec<Option<u32>>,
    reach: Vec<Reach>,
    is_broken: Vec<bool>,
    /// The pixels at edges that are finished without further ado.
    settled: Vec<Option<FinishedPixel>>,
    /// How many samples were taken.
    pub(super) samples: u64,
    /// The rays that they took.
    pub(super) rays: RayCounts,
}

impl<'a> Band<'a> {
    /// Samples a band as far as step 2.
    pub(super) fn new(
        eye: &'a Eye<'a>,
        target: ErrorTarget,
        columns: Range<u32>,
        rows: Range<u32>,
    ) -> Self {
        let count = columns.len() * rows.len();
        let mut band = Band {
            eye,
            target,
            columns,
            rows,
            first: Vec::new(),
            first_order: Vec::new(),
            finer: Vec::new(),
            finer_order: Vec::new(),
            finer_at: vec![None; count],
            reach: Vec::new(),
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

    /// The finished pixels of a rectangle in it, row by row, `progress` told of them.
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
                || (Finishing::default(), Vec::new()),
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
        let place = |(x, y): (u32, u32)| {
            let is_here = columns.contains(&x) && rows.contains(&y);
            is_here.then(|| (y - rows.start) as usize * width + (x - columns.start) as usize)
        };
        let (samples, rays) = self.eye.specks.add(self, place, &mut done);
        self.samples += samples;
        self.rays += rays;
        done
    }

    pub(super) fn at(&self, x: u32, y: u32) -> usize {
        (y - self.rows.start) as usize * self.columns.len() + (x - self.columns.start) as usize
    }

    /// A pixel so many columns and rows away, if the band has it.
    pub(super) fn at_next(&self, (x, y): (u32, u32), (dx, dy): (i64, i64)) -> Option<usize> {
        let next = |v: u32, d: i64, range: &Range<u32>| {
            let next = u32::try_from(i64::from(v) + d).ok()?;
            range.contains(&next).then_some(next)
        };
        Some(self.at(next(x, dx, &self.columns)?, next(y, dy, &self.rows)?))
    }

    /// The pixels around one, itself included.
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

    /// The settled outcome of a pixel, if it has one.
    pub(super) fn settled_at(&self, at: usize) -> Option<FinishedPixel> {
        self.settled[at]
    }

    /// Whether a pixel is broken.
    pub(super) fn is_broken_at(&self, at: usize) -> bool {
        self.is_broken[at]
    }

    /// Whether a pixel got more than its first samples.
    pub(super) fn is_finer(&self, at: usize) -> bool {
        self.finer_at[at].is_some()
    }

    /// Whether the first samples of a pixel may have missed what counts, by the contrast of its surroundings.
    pub(super) fn may_hide(&self, x: u32, y: u32) -> bool {
        let contrast = self.reach_around(x, y).contrast(self.eye.channels);
        contrast * HIDDEN / f64::from(self.target.first) > self.target.error
    }

    pub(super) fn reach_around(&self, x: u32, y: u32) -> Reach {
        self.around(x, y).fold(Reach::NOTHING, |all, (x, y)| {
            all.with(&self.reach[self.at(x, y)])
        })
    }

    pub(super) fn first_of(&self, at: usize) -> &[AdaptiveSample] {
        let n = self.target.first as usize;
        &self.first[at * n..(at + 1) * n]
    }

    pub(super) fn looks_of(&self, at: usize) -> &[AdaptiveSample] {
        match self.finer_at[at] {
            Some(start) => &self.finer[start as usize..][..(self.target.first * FINER) as usize],
            None => self.first_of(at),
        }
    }

    /// How many of the samples of a pixel count.
    pub(super) fn count(&self, sight: SampleFilter, at: usize) -> usize {
        match (sight, self.finer_at[at]) {
            (SampleFilter::All, Some(_)) => (self.target.first * FINER) as usize,
            _ => self.target.first as usize,
        }
    }

    /// The sample of a pixel in a cell of its grid.
    pub(super) fn look_in(&self, sight: SampleFilter, at: usize, cell: usize) -> &AdaptiveSample {
        match (sight, self.finer_at[at]) {
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
        let eye = self.eye;
        let seen: Vec<(Vec<AdaptiveSample>, RayCounts)> = squares
            .par_iter()
            .map_init(EyeScratch::default, |scratch, square| {
                let mut looks = Vec::with_capacity(square.0.len() * square.1.len() * n);
                eye.looks(pixels_of(square), 0..self.target.first, scratch, &mut looks);
                (looks, scratch.take_rays())
            })
            .collect();
        let count = self.columns.len() * self.rows.len();
        self.first = vec![AdaptiveSample::NONE; count * n];
        for ((columns, rows), (looks, rays)) in squares.iter().zip(seen) {
            self.rays += rays;
            let wide = columns.len() * n;
            for (row, y) in looks.chunks(wide.max(1)).zip(rows.clone()) {
                let start = self.at(columns.start, y) * n;
                self.first[start..start + wide].copy_from_slice(row);
            }
        }
        self.first_order = orders(&self.first, n);
        self.samples += self.first.len() as u64;
        self.reach = self.first.chunks(n).map(Reach::of).collect();
    }

    /// Finds the pixels at edges and those whose error is too large, and finishes what needs little.
    fn find_broken(&mut self) {
        let band = &*self;
        let seen: Vec<(Vec<Outcome>, RayCounts)> = squares(&self.columns, &self.rows, WORKED)
            .into_par_iter()
            .map_init(
                || (Finishing::default(), Vec::new()),
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
        for (outcomes, rays) in seen {
            self.rays += rays;
            for outcome in outcomes {
                let at = self.at(outcome.pixel.0, outcome.pixel.1);
                self.is_broken[at] = outcome.done.is_none();
                self.settled[at] = outcome.done;
                self.samples += u64::from(outcome.taken);
            }
        }
    }

    /// Samples broken pixels, and around them what they make doubtful, as far as that has not been so yet; gives what
    /// turns out to be broken too.
    fn sample_around(&mut self, broken: &[usize]) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        for &at in broken {
            self.ask_for_more(at, &mut found);
        }
        self.sample_finer(&found);
        let band = &*self;
        let doubtful: Vec<Vec<usize>> = found
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

    fn ask_for_more(&mut self, at: usize, found: &mut Vec<usize>) {
        let all = self.target.first * FINER;
        if self.finer_at[at].is_none() {
            let next = self.finer.len() + found.len() * all as usize;
            self.finer_at[at] = u32::try_from(next).ok();
            found.push(at);
        }
    }

    fn sample_finer(&mut self, found: &[usize]) {
        let all = self.target.first * FINER;
        let more = self.target.first..all;
        let together = (TOGETHER / more.len()).max(1);
        let eye = self.eye;
        let seen: Vec<(Vec<AdaptiveSample>, RayCounts)> = found
            .par_chunks(together)
            .map_init(
                || (EyeScratch::default(), Vec::new()),
                |(scratch, new), places| {
                    new.clear();
                    let pixels = places.iter().map(|&at| self.pixel_at(at));
                    eye.looks(pixels, more.clone(), scratch, new);
                    let mut looks = Vec::with_capacity(places.len() * all as usize);
                    for (&at, new) in places.iter().zip(new.chunks(more.len())) {
                        looks.extend_from_slice(self.first_of(at));
                        looks.extend_from_slice(new);
                    }
                    (looks, scratch.take_rays())
                },
            )
            .collect();
        let start = self.finer.len();
        for (looks, rays) in seen {
            self.rays += rays;
            self.finer.extend(looks);
        }
        let new = &self.finer[start..];
        self.finer_order.extend(orders(new, all as usize));
        for (looks, &at) in new.chunks(all as usize).zip(found) {
            self.reach[at] = Reach::of(looks);
        }
        self.samples += found.len() as u64 * more.len() as u64;
    }
}

/// Columns and rows of pixels.
type Square = (Range<u32>, Range<u32>);

/// A rectangle of pixels in squares with this side, those at the right and below smaller.
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

/// The same, along a curve that keeps neighbours together.
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

/// For looks of pixels, so many for each, which of them lies in each cell of a grid.
fn orders(looks: &[AdaptiveSample], count: usize) -> Vec<u8> {
    let bits = count.ilog2();
    let (across, down) = (bits.div_ceil(2), bits / 2);
    let mut orders = vec![0u8; looks.len()];
    for (order, looks) in orders.chunks_mut(count).zip(looks.chunks(count)) {
        for (number, look) in (0u8..=u8::MAX).zip(looks) {
            let column = usize::from(look.place.0) >> (16 - across);
            let row = usize::from(look.place.1) >> (16 - down);
            order[row << across | column] = number;
        }
    }
    orders
}
