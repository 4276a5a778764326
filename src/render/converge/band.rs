//! A band of the picture: every pixel is sampled a little, those at edges more, until the estimate holds.
//!
//! 1. Each pixel gets its first samples.
//! 2. A pixel is broken if its samples, or those of it and its neighbours, met different surfaces or sides of them, or if
//!    its error is too large. A broken pixel and all around it get four times as many samples; those that turn out to be
//!    broken too pass that on. So a wire that only some pixels saw is followed along its length, for [`ROUNDS`] pixels.
//! 3. Those pixels get more samples until their error is small. It is never taken for smaller than what a feature
//!    between the samples would do whose contrast is that of the surroundings.
//!
//! A pixel depends on those within [`MARGIN`] of it and on no others, so that a part of a picture is drawn as it is in the
//! whole.

use super::edge::{Division, Kinds, Told};
use super::estimate::{Estimate, Reach, estimate, of_all};
use super::look::{Eye, EyeScratch, Look, TOGETHER, pixel};
use crate::compile::Rays;
use crate::film::Pixel;
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

/// How far being broken is passed on, in pixels.
const ROUNDS: u32 = 8;
/// How far away a pixel may lie that decides about another.
pub(super) const MARGIN: u32 = ROUNDS + 2;
/// How many times as many samples there are at edges.
const FINER: u32 = 4;
/// The share of `contrast / samples` that a feature may make which no sample saw. A half plane that a (0, 2)-sequence of
/// `n` points does not see covers up to about `1/n` of the pixel, and most do less. Measured on wires and glass: with a
/// sixteenth the true error of one pixel in a thousand is three times as large, with a half it is the same as with this.
const UNSEEN: f64 = 0.25;
/// No pixel gets more samples.
const MOST_SAMPLES: u32 = 1 << 14;
/// With these numbers of samples a pixel may be taken for one that a straight edge divides. With fewer a line separates
/// the samples of too many that are not; with more it has failed to be divided so often that it never will.
const AT_EDGES: std::ops::RangeInclusive<u32> = 32..=256;
/// So many samples are put on an edge at most, and so many at once.
const MOST_ON_AN_EDGE: u32 = 18;
const ON_AN_EDGE_TOGETHER: u32 = 3;
/// The side of the squares of pixels that are sampled first together.
const SQUARE: u32 = 8;

/// What to reach.
#[derive(Clone, Copy)]
pub(super) struct Target {
    /// The largest estimated error of a pixel.
    pub(super) error: f64,
    /// How many samples a pixel gets first: a power of two.
    pub(super) first: u32,
    /// When to stop with what there is.
    pub(super) deadline: Option<Instant>,
}

impl Target {
    /// The smaller the error, the smaller what may stay unseen where nothing is to be seen.
    pub(super) fn new(error: f64, deadline: Option<Instant>) -> Target {
        const FIRST: [(f64, u32); 3] = [(0.4 / 255.0, 4), (0.2 / 255.0, 8), (0.1 / 255.0, 16)];
        let first = FIRST.iter().find(|(least, _)| error >= *least);
        Target {
            error,
            first: first.map_or(32, |&(_, first)| first),
            deadline,
        }
    }

    pub(super) fn is_over(&self) -> bool {
        self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}

/// A finished pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Done {
    pub(super) value: Pixel,
    pub(super) error: f64,
}

/// The samples of a rectangle of pixels.
pub(super) struct Band<'a> {
    eye: &'a Eye<'a>,
    target: Target,
    columns: Range<u32>,
    rows: Range<u32>,
    /// The first samples, pixel by pixel.
    first: Vec<Look>,
    /// More of them for some pixels, the first included.
    finer: Vec<Look>,
    /// For each pixel where its samples in `finer` begin, if it has some there.
    finer_at: Vec<Option<u32>>,
    reach: Vec<Reach>,
    is_broken: Vec<bool>,
    /// How many samples were taken.
    pub(super) samples: u64,
    /// The rays that they took.
    pub(super) rays: Rays,
}

impl<'a> Band<'a> {
    /// Samples a band as far as step 2.
    pub(super) fn new(
        eye: &'a Eye<'a>,
        target: Target,
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
            finer: Vec::new(),
            finer_at: vec![None; count],
            reach: Vec::new(),
            is_broken: Vec::new(),
            samples: 0,
            rays: Rays::default(),
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

    /// The finished pixels of a rectangle in it, row by row, `progress` told of each row.
    pub(super) fn finish(
        &mut self,
        columns: &Range<u32>,
        rows: &Range<u32>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Vec<Done> {
        let width = columns.len();
        let mut done = vec![Done::default(); width * rows.len()];
        let (samples, rays) = done
            .par_chunks_mut(width.max(1))
            .zip(rows.clone().into_par_iter())
            .map_init(Finishing::default, |scratch, (row, y)| {
                let mut samples = 0u64;
                for (done, x) in row.iter_mut().zip(columns.clone()) {
                    let (finished, more) = self.finished(x, y, scratch);
                    *done = finished;
                    samples += u64::from(more);
                }
                progress(width as u64);
                (samples, scratch.eye.take_rays())
            })
            .reduce(
                || (0, Rays::default()),
                |(samples, mut rays), (more, others)| {
                    rays += others;
                    (samples + more, rays)
                },
            );
        self.samples += samples;
        self.rays += rays;
        done
    }

    fn at(&self, x: u32, y: u32) -> usize {
        (y - self.rows.start) as usize * self.columns.len() + (x - self.columns.start) as usize
    }

    /// The pixels around one, itself included.
    fn around(&self, x: u32, y: u32) -> impl Iterator<Item = (u32, u32)> + use<> {
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
    fn pixel_at(&self, at: usize) -> (u32, u32) {
        let width = self.columns.len();
        (
            self.columns.start + (at % width) as u32,
            self.rows.start + (at / width) as u32,
        )
    }

    fn first_of(&self, at: usize) -> &[Look] {
        let n = self.target.first as usize;
        &self.first[at * n..(at + 1) * n]
    }

    fn looks_of(&self, at: usize) -> &[Look] {
        match self.finer_at[at] {
            Some(start) => &self.finer[start as usize..][..(self.target.first * FINER) as usize],
            None => self.first_of(at),
        }
    }

    fn sample_first(&mut self) {
        let n = self.target.first as usize;
        let mut squares = Vec::new();
        for top in self.rows.clone().step_by(SQUARE as usize) {
            for left in self.columns.clone().step_by(SQUARE as usize) {
                let (right, bottom) = (left + SQUARE, top + SQUARE);
                squares.push((
                    left..right.min(self.columns.end),
                    top..bottom.min(self.rows.end),
                ));
            }
        }
        let eye = self.eye;
        let seen: Vec<(Vec<Look>, Rays)> = squares
            .par_iter()
            .map_init(EyeScratch::default, |scratch, (columns, rows)| {
                let mut looks = Vec::with_capacity(columns.len() * rows.len() * n);
                let pixels = rows
                    .clone()
                    .flat_map(|y| columns.clone().map(move |x| (x, y)));
                eye.looks(pixels, 0..self.target.first, scratch, &mut looks);
                (looks, scratch.take_rays())
            })
            .collect();
        let count = self.columns.len() * self.rows.len();
        self.first = vec![Look::NONE; count * n];
        for ((columns, rows), (looks, rays)) in squares.iter().zip(seen) {
            self.rays += rays;
            let wide = columns.len() * n;
            for (row, y) in looks.chunks(wide.max(1)).zip(rows.clone()) {
                let start = self.at(columns.start, y) * n;
                self.first[start..start + wide].copy_from_slice(row);
            }
        }
        self.samples += self.first.len() as u64;
        self.reach = self.first.chunks(n).map(Reach::of).collect();
    }

    /// Finds the pixels at edges and those whose error is too large.
    fn find_broken(&mut self) {
        let n = self.target.first as usize;
        let channels = self.eye.channels;
        self.is_broken = self
            .first
            .par_chunks(n)
            .map_init(Vec::new, |cells, looks| {
                is_torn(looks) || estimate(looks, channels, cells).error > self.target.error
            })
            .collect();
        let width = self.columns.len();
        for at in 0..self.is_broken.len() {
            let (x, y) = self.pixel_at(at);
            let right = (x + 1 < self.columns.end).then_some(at + 1);
            let below = (y + 1 < self.rows.end).then_some(at + width);
            for other in [right, below].into_iter().flatten() {
                if !self.first[at * n].is_same_side(&self.first[other * n]) {
                    self.is_broken[at] = true;
                    self.is_broken[other] = true;
                }
            }
        }
    }

    /// Samples around broken pixels what has not been so yet, and gives what of it turns out to be broken too.
    fn sample_around(&mut self, broken: &[usize]) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        let all = self.target.first * FINER;
        let mut next = u32::try_from(self.finer.len()).unwrap_or(u32::MAX);
        for &at in broken {
            let (x, y) = self.pixel_at(at);
            for (x, y) in self.around(x, y) {
                let at = self.at(x, y);
                if self.finer_at[at].is_none() {
                    self.finer_at[at] = Some(next);
                    next += all;
                    found.push(at);
                }
            }
        }
        let more = self.target.first..all;
        let together = (TOGETHER / more.len()).max(1);
        let (eye, channels) = (self.eye, self.eye.channels);
        let seen: Vec<(Vec<Look>, Vec<bool>, Rays)> = found
            .par_chunks(together)
            .map_init(
                || (EyeScratch::default(), Vec::new(), Vec::new()),
                |(scratch, new, cells), places| {
                    new.clear();
                    let pixels = places.iter().map(|&at| self.pixel_at(at));
                    eye.looks(pixels, more.clone(), scratch, new);
                    let mut looks = Vec::with_capacity(places.len() * all as usize);
                    for (&at, new) in places.iter().zip(new.chunks(more.len())) {
                        looks.extend_from_slice(self.first_of(at));
                        looks.extend_from_slice(new);
                    }
                    let are_broken = looks.chunks(all as usize).map(|looks| {
                        is_torn(looks) || estimate(looks, channels, cells).error > self.target.error
                    });
                    let are_broken = are_broken.collect();
                    (looks, are_broken, scratch.take_rays())
                },
            )
            .collect();
        let mut newly = Vec::new();
        let mut places = found.iter();
        for (looks, are_broken, rays) in seen {
            self.rays += rays;
            for (looks, is_broken) in looks.chunks(all as usize).zip(are_broken) {
                let Some(&at) = places.next() else { break };
                self.reach[at] = Reach::of(looks);
                if is_broken && !self.is_broken[at] {
                    self.is_broken[at] = true;
                    newly.push(at);
                }
            }
            self.finer.extend(looks);
        }
        self.samples += found.len() as u64 * more.len() as u64;
        newly
    }

    /// A finished pixel, and how many more samples it took.
    fn finished(&self, x: u32, y: u32, scratch: &mut Finishing) -> (Done, u32) {
        let at = self.at(x, y);
        let channels = self.eye.channels;
        scratch.looks.clear();
        scratch.looks.extend_from_slice(self.looks_of(at));
        let mut found = estimate(&scratch.looks, channels, &mut scratch.cells);
        if self.finer_at[at].is_none() {
            return (done(&found, found.error), 0);
        }
        let around = self.around(x, y).fold(Reach::NOTHING, |all, (x, y)| {
            all.with(&self.reach[self.at(x, y)])
        });
        let unseen = around.contrast(channels) * UNSEEN;
        let mut count = self.target.first * FINER;
        let mut taken = 0;
        loop {
            let unseen = unseen / f64::from(count);
            let is_last = count >= MOST_SAMPLES || self.target.is_over();
            if found.error.max(unseen) <= self.target.error || is_last {
                return (done(&found, found.error.max(unseen)), taken);
            }
            if unseen <= self.target.error && AT_EDGES.contains(&count) {
                let (divided, more) = self.divided((x, y), scratch);
                taken += more;
                if let Some(divided) = divided {
                    return (done(&divided, divided.error.max(unseen)), taken);
                }
            }
            let pixel = std::iter::once((x, y));
            self.eye.looks(
                pixel,
                count..2 * count,
                &mut scratch.eye,
                &mut scratch.looks,
            );
            taken += count;
            count *= 2;
            found = estimate(&scratch.looks, channels, &mut scratch.cells);
        }
    }

    /// What is found if the pixel is divided by a straight edge, and if that is good enough; and how many more samples
    /// it took.
    fn divided(&self, pixel: (u32, u32), scratch: &mut Finishing) -> (Option<Estimate>, u32) {
        let channels = self.eye.channels;
        let Some(kinds) = Kinds::of(&scratch.looks, channels, &mut scratch.values) else {
            return (None, 0);
        };
        scratch.told.clear();
        let told = scratch.looks.iter().map(|look| {
            let is_bright = kinds.is_bright(look).unwrap_or(false);
            (look.share(), is_bright)
        });
        scratch.told.extend(told);
        let (sides, rest) = self.sides(&kinds, scratch);
        if rest > self.target.error {
            return (None, 0);
        }
        let contrast = (0..channels)
            .map(|c| (sides[0][c].min(1.0) - sides[1][c].min(1.0)).abs())
            .fold(0.0, f64::max);
        let mut taken = 0;
        loop {
            let Some(division) = Division::of(&scratch.told) else {
                return (None, taken);
            };
            let error = rest.hypot(contrast * division.error);
            if error <= self.target.error {
                let dark = division.dark;
                let mean = [0, 1, 2, 3].map(|c| sides[1][c] + dark * (sides[0][c] - sides[1][c]));
                return (Some(Estimate { mean, error }), taken);
            }
            if taken >= MOST_ON_AN_EDGE {
                return (None, taken);
            }
            scratch.on_edge.clear();
            let numbers = taken..taken + ON_AN_EDGE_TOGETHER;
            let places = numbers.map(|number| division.place(number));
            let start = scratch.told.len();
            scratch.told.extend(places.map(|place| (place, false)));
            let shares = scratch.told[start..].iter().map(|(place, _)| *place);
            self.eye
                .looks_at(pixel, shares, &mut scratch.eye, &mut scratch.on_edge);
            taken += ON_AN_EDGE_TOGETHER;
            for (told, look) in scratch.told[start..].iter_mut().zip(&scratch.on_edge) {
                let Some(is_bright) = kinds.is_bright(look) else {
                    return (None, taken);
                };
                told.1 = is_bright;
            }
        }
    }

    /// The mean colours of both kinds, the darker first, and the error of the mean that is not due to the edge.
    fn sides(&self, kinds: &Kinds, scratch: &mut Finishing) -> ([[f64; 4]; 2], f64) {
        let mut sums = [[0.0; 4]; 2];
        let mut counts = [0.0; 2];
        for (look, (_, is_bright)) in scratch.looks.iter().zip(&scratch.told) {
            let side = usize::from(*is_bright);
            counts[side] += 1.0;
            for (sum, c) in sums[side].iter_mut().zip(look.channels) {
                *sum += f64::from(c);
            }
        }
        let means = [0, 1].map(|side| sums[side].map(|sum: f64| sum / counts[side]));
        let rest = of_all(
            &scratch.looks,
            self.eye.channels,
            &mut scratch.cells,
            |a, b| kinds.is_bright(a) == kinds.is_bright(b),
        );
        (means, rest.error)
    }
}

/// Buffers of a thread that finishes pixels.
#[derive(Default)]
struct Finishing {
    eye: EyeScratch,
    looks: Vec<Look>,
    cells: Vec<u32>,
    values: Vec<f32>,
    told: Vec<Told>,
    on_edge: Vec<Look>,
}

/// Whether an edge of a surface runs through samples.
fn is_torn(looks: &[Look]) -> bool {
    looks.iter().any(|look| !look.is_same_side(&looks[0]))
}

fn done(found: &Estimate, error: f64) -> Done {
    Done {
        value: pixel(found.mean),
        error,
    }
}
