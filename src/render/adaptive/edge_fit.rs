//! A pixel that is being divided: by a straight edge, or by two of a strip. Samples are put on the lines until it is known
//! well enough how much lies on each side.

use super::coverage::PixelParts;
use super::edge::{ClassifiedPoint, Division, Wedge};
use super::estimate::Estimate;
use super::sample::AdaptiveSample;
use super::slope::Sums;
use super::strip::Strip;
use super::triple_edge::Sides;
use super::two_class::SampleClasses;

/// So many samples are put on an edge at most, and so many at once.
const MOST_ON_AN_EDGE: u32 = 18;
const ON_AN_EDGE_TOGETHER: u32 = 3;
/// Twice as many where the variance is so many times what is aimed at.
const FAR: f64 = 64.0;
/// With so many samples the colour of a part is known without those on its edges.
const ENOUGH: f64 = 4.0;

/// A sample and its place in pixels.
pub(super) type PlacedSample = ([f64; 2], AdaptiveSample);

/// Which error is to be reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct ErrorGoal {
    /// What is aimed at.
    pub(super) best: f64,
    /// What will do where the parts of the pixel are not of one colour each, so that many more samples would be needed.
    pub(super) most: f64,
}

/// Buffers for the beginning of a division.
#[derive(Default)]
pub(super) struct Buffers {
    told: Vec<ClassifiedPoint>,
    groups: Vec<u8>,
}

/// A pixel and the lines that divide it.
#[derive(Default)]
pub(super) struct Dividing {
    /// The sides of surfaces in the parts, if these are three and tell them apart; otherwise there are two kinds.
    sides: Option<Sides>,
    kinds: Option<SampleClasses>,
    /// If two lines bound a strip, whether that is the brighter kind.
    strip_is_bright: Option<bool>,
    /// Where the samples of each part lie: before the first line, behind it, and behind the second.
    groups: [Vec<[f64; 2]>; 3],
    lines: [Line; 2],
    sums: [Sums; 3],
    needs_test: bool,
    /// How many samples were put on lines.
    taken: u32,
    first: Option<Division>,
    /// Which line samples are put on, and where.
    line: usize,
    pub(super) places: Vec<[f64; 2]>,
}

/// A line: the directions that it may have, and what lies next to it before it and behind it.
#[derive(Default)]
struct Line {
    wedge: Wedge,
    before: Vec<[f64; 2]>,
    behind: Vec<[f64; 2]>,
}

/// What comes next of a pixel that is being divided.
pub(super) enum Next {
    /// It is not divided by lines.
    Nothing,
    /// More samples all over the pixel are to show whether it is.
    Test,
    /// Samples at `places`.
    Places,
    /// It is known well enough.
    Found(Estimate),
}

impl Dividing {
    /// Finds lines between the samples; false if there are none. `needs_test` if what is found is to be tested.
    pub(super) fn begin(
        &mut self,
        placed: &[PlacedSample],
        channels: usize,
        needs_test: bool,
        buffers: &mut Buffers,
    ) -> bool {
        self.needs_test = needs_test;
        self.taken = 0;
        if !self.tell_by_sides(placed, &mut buffers.groups)
            && !self.tell_by_kinds(placed, channels, buffers)
        {
            return false;
        }
        self.sums = [Sums::default(); 3];
        for ((place, look), &group) in placed.iter().zip(&buffers.groups) {
            self.sums[usize::from(group)].add(*place, &look.channels);
        }
        true
    }

    /// Finds two lines between three sides of surfaces.
    fn tell_by_sides(&mut self, placed: &[PlacedSample], groups: &mut Vec<u8>) -> bool {
        self.sides = None;
        let Some(sides) = Sides::of(placed) else {
            return false;
        };
        groups.clear();
        for (_, look) in placed {
            // Each was counted among the three.
            let number = sides.number(look).unwrap_or(0);
            groups.push(u8::try_from(number).unwrap_or(0));
        }
        self.strip_is_bright = None;
        self.sides = Some(sides);
        if !self.separate(placed, groups) {
            self.sides = None;
        }
        self.sides.is_some()
    }

    /// Finds a line between two kinds of samples, or two that bound a strip of one of them.
    fn tell_by_kinds(
        &mut self,
        placed: &[PlacedSample],
        channels: usize,
        Buffers { told, groups }: &mut Buffers,
    ) -> bool {
        let Some(kinds) = SampleClasses::of(placed.iter().map(|(_, look)| look), channels) else {
            return false;
        };
        self.kinds = Some(kinds);
        told.clear();
        told.extend(
            placed
                .iter()
                .map(|(place, look)| (*place, kinds.is_bright(look).unwrap_or(false))),
        );
        self.strip_is_bright = None;
        groups.clear();
        groups.extend(told.iter().map(|told| u8::from(told.1)));
        if self.separate(placed, groups) {
            return true;
        }
        let Some(strip) = Strip::between(&self.groups[0], &self.groups[1]) else {
            return false;
        };
        groups.clear();
        groups.extend(told.iter().map(|told| strip.group(told)));
        self.strip_is_bright = Some(strip.is_bright);
        self.separate(placed, groups)
    }

    fn count_of_lines(&self) -> usize {
        1 + usize::from(self.strip_is_bright.is_some() || self.sides.is_some())
    }

    /// Puts samples into their groups; whether lines separate these.
    fn separate(&mut self, placed: &[PlacedSample], groups: &[u8]) -> bool {
        for group in &mut self.groups {
            group.clear();
        }
        for ((place, _), &group) in placed.iter().zip(groups) {
            self.groups[usize::from(group)].push(*place);
        }
        for line in 0..self.count_of_lines() {
            let (before, behind) = self.groups.split_at(line + 1);
            let line = &mut self.lines[line];
            let fill = |line: &mut Vec<[f64; 2]>, groups: &[Vec<[f64; 2]>]| {
                line.clear();
                for group in groups {
                    line.extend_from_slice(group);
                }
            };
            fill(&mut line.before, before);
            fill(&mut line.behind, behind);
            let Some(wedge) = Wedge::between(&mut line.before, &mut line.behind) else {
                return false;
            };
            line.wedge = wedge;
        }
        true
    }

    /// What comes next: samples, or what was found.
    pub(super) fn next(&mut self, channels: usize, aim: ErrorGoal) -> Next {
        let lines = self.count_of_lines();
        let division = |line: usize| {
            let line = &self.lines[line];
            Division::of(line.wedge, &line.before, &line.behind)
        };
        let Some(first) = division(0) else {
            return Next::Nothing;
        };
        let second = if lines == 2 { division(1) } else { None };
        if lines == 2 && second.is_none() {
            return Next::Nothing;
        }
        let are_alike = self.strip_is_bright.is_some();
        let Some(parts) = PixelParts::of(&first, second.as_ref(), &self.sums, are_alike) else {
            return Next::Nothing;
        };
        let (mut rest, mut whole, mut by_line) = (0.0, 0.0, [0.0; 2]);
        for c in 0..channels {
            let (of_parts, of_lines) = parts.variances(c, &first, second.as_ref());
            rest = f64::max(rest, of_parts);
            whole = f64::max(whole, of_parts + of_lines[0] + of_lines[1]);
            by_line = [0, 1].map(|line| f64::max(by_line[line], of_lines[line]));
        }
        self.first = Some(first);
        let (best, most) = (aim.best * aim.best, aim.most * aim.most);
        if rest > most / 2.0 {
            return Next::Nothing;
        }
        // Lines need not be known much better than colours.
        let aimed = best.max(2.0 * rest).min(most);
        let is_last = self.taken >= MOST_ON_AN_EDGE << (lines - 1);
        let is_enough = whole <= if is_last { most } else { aimed };
        if (is_enough || rest > best) && std::mem::take(&mut self.needs_test) {
            return Next::Test;
        }
        if is_enough {
            return Next::Found(Estimate {
                mean: parts.mean(),
                error: whole.sqrt(),
            });
        }
        if is_last {
            return Next::Nothing;
        }
        // The line that leaves more to be known.
        self.line = usize::from(by_line[1] > by_line[0]);
        let division = match second {
            Some(second) if self.line == 1 => second,
            _ => first,
        };
        // Every place about halves what is possible on a line.
        let together = match whole > FAR * aimed {
            true => 2 * ON_AN_EDGE_TOGETHER,
            false => ON_AN_EDGE_TOGETHER,
        };
        let numbers = self.taken..self.taken + together;
        self.taken = numbers.end;
        self.places.clear();
        self.places
            .extend(numbers.map(|number| division.place(number)));
        Next::Places
    }

    /// Takes samples all over the pixel; false if they show that no lines divide it.
    pub(super) fn test(&mut self, looks: &[AdaptiveSample]) -> bool {
        looks.iter().all(|look| {
            let place = look.share();
            let is_beyond = self.first.is_some_and(|first| first.is_beyond(place));
            let group = self.take(look, place, 2 * usize::from(is_beyond));
            group.is_some_and(|group| {
                self.sums[group].add(place, &look.channels);
                true
            })
        })
    }

    /// Takes the samples at `places`; false if they show that no lines divide the pixel.
    pub(super) fn take_places(&mut self, looks: &[AdaptiveSample]) -> bool {
        looks.iter().enumerate().all(|(i, look)| {
            let place = self.places[i];
            let group = self.take(look, place, 2 * self.line);
            group.is_some_and(|group| {
                // The colours next to a line are not those of the whole part.
                if self.sums[group].count() < ENOUGH {
                    self.sums[group].add(place, &look.channels);
                }
                true
            })
        })
    }

    /// The group of a sample: that of its side or kind, or `beside` if it lies beside a strip.
    fn group(&self, look: &AdaptiveSample, beside: usize) -> Option<usize> {
        if let Some(sides) = &self.sides {
            return sides.number(look);
        }
        let is_bright = self.kinds?.is_bright(look)?;
        Some(match self.strip_is_bright {
            None => usize::from(is_bright),
            Some(strip) if strip == is_bright => 1,
            Some(_) => beside,
        })
    }

    /// Takes the place of a sample, and gives its group; `None` if it shows that no lines divide the pixel.
    fn take(&mut self, look: &AdaptiveSample, place: [f64; 2], beside: usize) -> Option<usize> {
        let group = self.group(look, beside)?;
        for line in 0..self.count_of_lines() {
            let is_behind = group > line;
            let line = &mut self.lines[line];
            let (own, others) = match is_behind {
                true => (&mut line.behind, &line.before),
                false => (&mut line.before, &line.behind),
            };
            if !line.wedge.take(place, is_behind, others) {
                return None;
            }
            own.push(place);
        }
        Some(group)
    }
}
