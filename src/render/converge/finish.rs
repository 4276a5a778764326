//! Finishing one pixel: what its samples and those around it tell, and more samples until that is enough.

use super::band::{Band, Done, Sight};
use super::edge::{Division, Told};
use super::estimate::{Estimate, SHARE_OF_VARIANCE, estimate};
use super::kinds::Kinds;
use super::look::{EyeScratch, Look, pixel};
use super::parts::Parts;
use super::slope::{Slopes, Sums};
use super::strip::strip;
use crate::compile::Rays;

/// The share of `contrast / samples` that a feature may make which no sample saw. A half plane that a (0, 2)-sequence of
/// `n` points does not see covers up to about `1/n` of the pixel, and most do less.
const UNSEEN: f64 = 0.25;
/// The same where the samples around a pixel go with its own.
pub(super) const HIDDEN: f64 = 0.0625;
/// No pixel gets more samples.
const MOST_SAMPLES: usize = 1 << 14;
/// With more samples none for one that a strip crosses.
const MOST_AT_STRIPS: usize = 16;
/// So many samples are put on an edge at most, and so many at once.
const MOST_ON_AN_EDGE: u32 = 18;
const ON_AN_EDGE_TOGETHER: u32 = 3;
/// With more samples a pixel is not taken for one that an edge divides: it has failed to be so too often.
const MOST_AT_EDGES: usize = 64;
/// First samples so far around a pixel tell how an edge goes on and how colours slope, in pixels: those within half a
/// pixel let three times as many be fooled.
const RING: f64 = 0.75;
/// The same where pixels have more samples.
const CLOSE: f64 = 0.25;
/// How much of the contrast of two cells raises doubts about the pixel that one is in, as in the estimate of its error.
const DOUBT: f64 = 0.4;

/// The first samples of a pixel and of those around.
const FIRST: (Sight, Sight) = (Sight::First, Sight::First);

/// The share of the error asked for that pixels may have which need few samples for it: so a picture is best for all its
/// samples together, since halving their error costs little.
const EVEN: f64 = 0.25;

/// Buffers of a thread that finishes pixels.
#[derive(Default)]
pub(super) struct Finishing {
    eye: EyeScratch,
    looks: Vec<Look>,
    /// Samples around the pixel, and their places.
    ring: Vec<(Look, [f64; 2])>,
    order: Vec<u32>,
    values: Vec<f32>,
    told: Vec<Told>,
    /// For each of these, the part of the pixel it lies in.
    groups: Vec<u8>,
    on_edge: Vec<Look>,
}

impl Finishing {
    /// How many rays were followed with it since this was last asked.
    pub(super) fn take_rays(&mut self) -> Rays {
        self.eye.take_rays()
    }

    /// Whether the first samples of a pixel, and those next to them around it, leave nothing to be asked.
    pub(super) fn is_calm(&mut self, band: &Band<'_>, (x, y): (u32, u32)) -> bool {
        let channels = band.eye.channels;
        let (found, is_torn) = first_estimate(band, (x, y), &Slopes::default());
        if is_torn {
            return band.reach_around(x, y).contrast(channels) <= band.target.error;
        }
        found.error <= band.target.error * EVEN
    }

    /// What the first samples of a pixel at an edge come to, if a little more is enough; and how many more they were.
    pub(super) fn settled(&mut self, band: &Band<'_>, (x, y): (u32, u32)) -> (Option<Done>, u32) {
        if band.may_hide(x, y) {
            return (None, 0);
        }
        let looks = band.first_of(band.at(x, y));
        self.looks.clear();
        self.looks.extend_from_slice(looks);
        self.gather_ring(band, (x, y), RING, |at| band.first_of(at));
        let all_alike = self
            .ring
            .iter()
            .all(|(look, _)| look.is_same_side(&looks[0]))
            && looks.iter().all(|look| look.is_same_side(&looks[0]));
        if all_alike {
            let slopes = self.sums(|_| true).plane().map(|plane| plane.slopes());
            let slopes = slopes.unwrap_or_default();
            let tests = band.target.first;
            let channels = band.eye.channels;
            let (found, _) = first_estimate(band, (x, y), &slopes);
            if found.error <= band.target.error * EVEN {
                self.test(band, (x, y));
                let found = estimate(&self.looks, channels, &slopes, &mut self.order);
                let settled = found.error <= band.target.error * EVEN;
                return (settled.then(|| done(&found, found.error)), tests);
            }
        }
        let (divided, more) = self.divided(band, (x, y), true);
        (divided.map(|found| done(&found, found.error)), more)
    }

    /// The pixels around a broken one about which its samples raise doubts.
    pub(super) fn doubts(
        &mut self,
        band: &Band<'_>,
        (x, y): (u32, u32),
        doubtful: &mut Vec<usize>,
    ) {
        let at = band.at(x, y);
        let looks = band.looks_of(at);
        let channels = band.eye.channels;
        let bits = looks.len().ilog2();
        let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
        let target = band.target.error;
        let area = 1.0 / f64::from(band.target.first);
        // As in the estimate of a pixel.
        let differs = |a: &Look, b: &Look| {
            let apart =
                |c: usize| f64::from((a.channels[c].min(1.0) - b.channels[c].min(1.0)).abs());
            (0..channels).map(apart).fold(0.0, f64::max) * area * DOUBT > target
        };
        let mut alone = band.may_hide(x, y);
        for row in 0..height {
            for column in 0..width {
                let own = inside(band, Sight::All, at, (column, row), width);
                let mut like = 0;
                for (dx, dy) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
                    let (column, row) = (column + dx, row + dy);
                    let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
                    if is_inside {
                        like += u32::from(!differs(
                            own,
                            inside(band, Sight::All, at, (column, row), width),
                        ));
                        continue;
                    }
                    let Some((other, look)) =
                        beyond(band, (x, y), (column, row), (Sight::All, Sight::First))
                    else {
                        continue;
                    };
                    if differs(own, look) {
                        if band.settled_at(other).is_none() {
                            doubtful.push(other);
                        }
                    } else {
                        like += 1;
                    }
                }
                alone |= like == 0;
            }
        }
        if alone {
            let around = band.around(x, y).map(|(x, y)| band.at(x, y));
            doubtful.extend(around.filter(|&at| band.settled_at(at).is_none()));
        }
    }

    /// A finished pixel, and how many more samples it took.
    pub(super) fn finished(&mut self, band: &Band<'_>, (x, y): (u32, u32)) -> (Done, u32) {
        let at = band.at(x, y);
        let channels = band.eye.channels;
        if let Some(settled) = band.settled_at(at) {
            return (settled, 0);
        }
        self.looks.clear();
        self.looks.extend_from_slice(band.looks_of(at));
        let first = estimate(&self.looks, channels, &Slopes::default(), &mut self.order);
        if !band.is_finer(at) {
            // It was found calm by comparison with those around it, or the time is over.
            let error = match band.is_broken_at(at) {
                true => first.error,
                false => first.error.min(band.target.error),
            };
            return (done(&first, error), 0);
        }
        let target = band.target.error;
        let contrast = band.reach_around(x, y).contrast(channels);
        self.gather_ring(band, (x, y), CLOSE, |at| band.looks_of(at));
        let mut found = first;
        let mut taken = 0;
        loop {
            let count = self.looks.len();
            let samples = f64::from(u32::try_from(count).unwrap_or(u32::MAX));
            let error = found.error.max(contrast * UNSEEN / samples);
            let is_last = count >= MOST_SAMPLES || band.target.is_over();
            if error <= target || is_last {
                return (done(&found, error), taken);
            }
            let hidden = contrast * HIDDEN / samples;
            if hidden <= target && count <= MOST_AT_EDGES {
                let (divided, more) = self.divided(band, (x, y), false);
                taken += more;
                if let Some(divided) = divided {
                    return (done(&divided, divided.error.max(hidden)), taken);
                }
            }
            let numbers = u32::try_from(count).unwrap_or(u32::MAX);
            let pixel = std::iter::once((x, y));
            band.eye
                .looks(pixel, numbers..2 * numbers, &mut self.eye, &mut self.looks);
            taken += numbers;
            found = estimate(&self.looks, channels, &Slopes::default(), &mut self.order);
        }
    }

    /// Gathers the samples just around a pixel.
    fn gather_ring<'a>(
        &mut self,
        band: &'a Band<'_>,
        (x, y): (u32, u32),
        ring: f64,
        looks_of: impl Fn(usize) -> &'a [Look],
    ) {
        self.ring.clear();
        for (other_x, other_y) in band.around(x, y).filter(|&other| other != (x, y)) {
            let from = [
                f64::from(other_x) - f64::from(x),
                f64::from(other_y) - f64::from(y),
            ];
            for look in looks_of(band.at(other_x, other_y)) {
                let share = look.share();
                let place = [from[0] + share[0], from[1] + share[1]];
                if place.iter().all(|v| (-ring..=1.0 + ring).contains(v)) {
                    self.ring.push((*look, place));
                }
            }
        }
    }

    /// The sums over the samples of a pixel and around it that are of some kind.
    fn sums(&self, is_one: impl Fn(&Look) -> bool) -> Sums {
        let mut sums = Sums::default();
        let own = self.looks.iter().map(|look| (look, look.share()));
        let ring = self.ring.iter().map(|(look, place)| (look, *place));
        for (look, place) in own.chain(ring).filter(|(look, _)| is_one(look)) {
            sums.add(place, &look.channels);
        }
        sums
    }

    /// More samples of a pixel, as many as it has had.
    fn test(&mut self, band: &Band<'_>, pixel: (u32, u32)) {
        let numbers = band.target.first..2 * band.target.first;
        let pixel = std::iter::once(pixel);
        band.eye
            .looks(pixel, numbers, &mut self.eye, &mut self.looks);
    }

    /// What is found if the pixel is divided by a straight edge, or by two of a strip, and if that is good enough; and how
    /// many more samples it took.
    fn divided(
        &mut self,
        band: &Band<'_>,
        pixel: (u32, u32),
        mut needs_test: bool,
    ) -> (Option<Estimate>, u32) {
        let (channels, target) = (band.eye.channels, band.target.error * EVEN);
        let around = self.ring.iter().map(|(look, _)| look);
        let all = self.looks.iter().chain(around);
        let Some(kinds) = Kinds::of(all, channels, &mut self.values) else {
            return (None, 0);
        };
        self.told.clear();
        let own = self.looks.iter().map(|look| (look.share(), look));
        let around = self.ring.iter().map(|(look, place)| (*place, look));
        let told = own
            .chain(around)
            .map(|(place, look)| (place, kinds.is_bright(look).unwrap_or(false)));
        self.told.extend(told);
        self.groups.clear();
        self.groups
            .extend(self.told.iter().map(|told| u8::from(told.1)));
        let mut strip_is_bright = None;
        let mut known = Division::of(&self.told);
        if known.is_none() {
            if self.looks.len() > MOST_AT_STRIPS {
                return (None, 0);
            }
            let Some(strip) = strip(&self.told, &mut self.groups) else {
                return (None, 0);
            };
            strip_is_bright = Some(strip.is_bright);
        }
        let lines: u8 = if strip_is_bright.is_some() { 2 } else { 1 };
        let mut sums = [Sums::default(); 3];
        let own = self.looks.iter().map(|look| (look.share(), look));
        let around = self.ring.iter().map(|(look, place)| (*place, look));
        for ((place, look), &group) in own.chain(around).zip(&self.groups) {
            sums[usize::from(group)].add(place, &look.channels);
        }
        let mut taken = 0;
        loop {
            let mut divisions = [known.take(), None];
            for line in u8::from(divisions[0].is_some())..lines {
                for (told, &group) in self.told.iter_mut().zip(&self.groups) {
                    told.1 = group > line;
                }
                divisions[usize::from(line)] = Division::of(&self.told);
            }
            let Some(first) = divisions[0] else {
                return (None, taken);
            };
            let second = match (lines, divisions[1]) {
                (1, _) => None,
                (_, None) => return (None, taken),
                (_, second) => second,
            };
            let Some(parts) = Parts::of(&first, second.as_ref(), &sums) else {
                return (None, taken);
            };
            let (mut rest, mut whole) = (0.0, 0.0);
            for c in 0..channels {
                let (of_parts, of_lines) = parts.variances(c, &first, second.as_ref());
                rest = f64::max(rest, of_parts);
                whole = f64::max(whole, of_parts + of_lines);
            }
            if rest > target * target {
                return (None, taken);
            }
            if whole <= target * target && needs_test {
                needs_test = false;
                let start = self.looks.len();
                self.test(band, pixel);
                taken += u32::try_from(self.looks.len() - start).unwrap_or(0);
                for look in &self.looks[start..] {
                    let Some(is_bright) = kinds.is_bright(look) else {
                        return (None, taken);
                    };
                    let place = look.share();
                    let group = match strip_is_bright {
                        None => u8::from(is_bright),
                        Some(strip) if strip == is_bright => 1,
                        Some(_) => 2 * u8::from(first.is_beyond(place)),
                    };
                    self.told.push((place, false));
                    self.groups.push(group);
                    sums[usize::from(group)].add(place, &look.channels);
                }
                continue;
            }
            if whole <= target * target {
                let error = whole.sqrt();
                return (
                    Some(Estimate {
                        mean: parts.mean(),
                        error,
                    }),
                    taken,
                );
            }
            if taken >= MOST_ON_AN_EDGE * u32::from(lines) {
                return (None, taken);
            }
            // The line that is known worse.
            let line = u8::from(second.is_some_and(|second| second.error > first.error));
            let division = if line == 0 {
                first
            } else {
                second.unwrap_or(first)
            };
            self.on_edge.clear();
            let numbers = taken..taken + ON_AN_EDGE_TOGETHER;
            let start = self.told.len();
            let places = numbers.map(|number| (division.place(number), false));
            self.told.extend(places);
            let shares = self.told[start..].iter().map(|(place, _)| *place);
            band.eye
                .looks_at(pixel, shares, &mut self.eye, &mut self.on_edge);
            taken += ON_AN_EDGE_TOGETHER;
            for (told, look) in self.told[start..].iter().zip(&self.on_edge) {
                let Some(is_bright) = kinds.is_bright(look) else {
                    return (None, taken);
                };
                let group = match strip_is_bright {
                    None => u8::from(is_bright),
                    Some(strip) if strip == is_bright => 1,
                    Some(_) => 2 * line,
                };
                self.groups.push(group);
                sums[usize::from(group)].add(told.0, &look.channels);
            }
        }
    }
}

/// What the first samples of a pixel tell on a surface with these slopes if they are compared with those next to them,
/// in the pixel and around it; and whether two of these met different surfaces or sides.
fn first_estimate(band: &Band<'_>, (x, y): (u32, u32), slopes: &Slopes) -> (Estimate, bool) {
    let at = band.at(x, y);
    let count = band.target.first;
    let bits = count.ilog2();
    let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
    let (mut mean, mut variances) = ([0.0; 4], [0.0; 4]);
    let mut is_torn = false;
    let area = 1.0 / f64::from(count);
    // Two pairs of neighbours belong to each cell.
    let share = area * area * SHARE_OF_VARIANCE * 2.0;
    for cell in 0..width * height {
        let (column, row) = (cell % width, cell / width);
        let look = inside(band, Sight::First, at, (column, row), width);
        let own = slopes.levelled(look);
        let (mut apart, mut pairs) = ([0.0; 4], 0.0);
        for (dx, dy) in [(-1, 0), (1, 0), (0, -1), (0, 1i32)] {
            let (column, row) = (column + i64::from(dx), row + i64::from(dy));
            let is_outside = column < 0 || row < 0 || column >= width || row >= height;
            let (other, away) = if is_outside {
                let Some((_, other)) = beyond(band, (x, y), (column, row), FIRST) else {
                    continue;
                };
                (other, [dx, dy])
            } else {
                (inside(band, Sight::First, at, (column, row), width), [0, 0])
            };
            is_torn |= !look.is_same_side(other);
            pairs += 1.0;
            let other = slopes.levelled_at(other, away.map(f64::from));
            for (sum, (a, b)) in apart.iter_mut().zip(own.iter().zip(other)) {
                *sum += (a - b) * (a - b);
            }
        }
        for c in 0..4 {
            mean[c] += area * own[c];
            variances[c] += share * apart[c] / f64::max(pairs, 1.0);
        }
    }
    (Estimate::of(mean, variances, band.eye.channels), is_torn)
}

/// The sample of a pixel in a cell of the grid of all that it has.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few"
)]
fn inside<'a>(
    band: &'a Band<'_>,
    sight: Sight,
    at: usize,
    (column, row): (i64, i64),
    width: i64,
) -> &'a Look {
    band.look_in(sight, at, (row * width + column) as usize)
}

/// What was seen beyond the border of a pixel, next to a cell of the grid of its samples; and in which pixel.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few"
)]
fn beyond<'a>(
    band: &'a Band<'_>,
    (x, y): (u32, u32),
    (column, row): (i64, i64),
    (own, others): (Sight, Sight),
) -> Option<(usize, &'a Look)> {
    let bits = band.count(own, band.at(x, y)).ilog2();
    let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
    let at = band.at_next((x, y), (column.div_euclid(width), row.div_euclid(height)))?;
    let coarser = bits.saturating_sub(band.count(others, at).ilog2()) / 2;
    let column = (column.rem_euclid(width) >> coarser) as usize;
    let row = (row.rem_euclid(height) >> coarser) as usize;
    let cell = row * (width as usize >> coarser) + column;
    Some((at, band.look_in(others, at, cell)))
}

fn done(found: &Estimate, error: f64) -> Done {
    Done {
        value: pixel(found.mean),
        error,
    }
}
