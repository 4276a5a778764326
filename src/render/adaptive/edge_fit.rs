//! Fits one straight edge, or the two edges of a strip, to the samples of a pixel, and adds samples on the lines until
//! the coverage of the parts is known well enough.

use super::coverage::PixelParts;
use super::edge::{ClassifiedPoint, Division, Wedge};
use super::estimate::Estimate;
use super::sample::{AdaptiveSample, PointSample};
use super::slope::Sums;
use super::strip::Strip;
use super::triple_edge::Sides;
use super::two_class::SampleClasses;

/// Samples on an edge: the limit, and the number added at once.
const MAX_ON_AN_EDGE: u32 = 18;
const ON_AN_EDGE_TOGETHER: u32 = 3;
/// Variance over the target above which twice as many are added at once.
const FAR: f64 = 64.0;
/// Parts with this many samples do not need the samples on their edges for their colour.
const ENOUGH: f64 = 4.0;

/// The error to reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct ErrorGoal {
    /// The error to aim for.
    pub(super) best: f64,
    /// The error that is acceptable where a part of the pixel is not of one colour, so that many more samples would be
    /// needed.
    pub(super) most: f64,
}

/// Buffers for the start of a fit.
#[derive(Default)]
pub(super) struct Buffers {
    classified: Vec<ClassifiedPoint>,
    groups: Vec<u8>,
}

/// A pixel and the lines fitted to it.
#[derive(Default)]
pub(super) struct EdgeFit {
    /// The surface sides of the parts, if there are three distinct ones; otherwise there are two classes.
    sides: Option<Sides>,
    classes: Option<SampleClasses>,
    /// For a strip between two lines: true if the strip is the brighter class.
    strip_is_bright: Option<bool>,
    /// The sample points of each part: before the first line, behind it, and behind the second.
    groups: [Vec<[f64; 2]>; 3],
    lines: [Line; 2],
    sums: [Sums; 3],
    needs_test: bool,
    /// Samples placed on lines.
    taken: u32,
    first: Option<Division>,
    /// The line that gets samples, and their points.
    line: usize,
    pub(super) points: Vec<[f64; 2]>,
}

/// A line: its possible directions, and the nearest points before and behind it.
#[derive(Default)]
struct Line {
    wedge: Wedge,
    before: Vec<[f64; 2]>,
    behind: Vec<[f64; 2]>,
}

/// The next step of a fit.
pub(super) enum NextStep {
    /// Give up: no lines divide the pixel.
    GiveUp,
    /// Take more samples all over the pixel to test the lines.
    Test,
    /// Take samples at `points`.
    Points,
    /// The estimate is good enough.
    Done(Estimate),
}

impl EdgeFit {
    /// Fits lines to the samples; false if none fit. With `needs_test` the result is tested with more samples.
    pub(super) fn begin(
        &mut self,
        point_samples: &[PointSample],
        channels: usize,
        needs_test: bool,
        buffers: &mut Buffers,
    ) -> bool {
        self.needs_test = needs_test;
        self.taken = 0;
        if !self.split_by_sides(point_samples, &mut buffers.groups)
            && !self.split_by_classes(point_samples, channels, buffers)
        {
            return false;
        }
        self.sums = [Sums::default(); 3];
        for ((point, sample), &group) in point_samples.iter().zip(&buffers.groups) {
            self.sums[usize::from(group)].add(*point, &sample.channels);
        }
        true
    }

    /// Fits two lines between three surface sides.
    fn split_by_sides(&mut self, point_samples: &[PointSample], groups: &mut Vec<u8>) -> bool {
        self.sides = None;
        let Some(sides) = Sides::of(point_samples) else {
            return false;
        };
        groups.clear();
        for (_, sample) in point_samples {
            // All samples were counted among the three sides.
            let number = sides.number(sample).unwrap_or(0);
            groups.push(u8::try_from(number).unwrap_or(0));
        }
        self.strip_is_bright = None;
        self.sides = Some(sides);
        if !self.separate(point_samples, groups) {
            self.sides = None;
        }
        self.sides.is_some()
    }

    /// Fits a line between two classes of samples, or two lines around a strip of one of them.
    fn split_by_classes(
        &mut self,
        point_samples: &[PointSample],
        channels: usize,
        Buffers { classified, groups }: &mut Buffers,
    ) -> bool {
        let Some(classes) =
            SampleClasses::of(point_samples.iter().map(|(_, sample)| sample), channels)
        else {
            return false;
        };
        self.classes = Some(classes);
        classified.clear();
        classified.extend(
            point_samples
                .iter()
                .map(|(point, sample)| (*point, classes.is_bright(sample).unwrap_or(false))),
        );
        self.strip_is_bright = None;
        groups.clear();
        groups.extend(classified.iter().map(|classified| u8::from(classified.1)));
        if self.separate(point_samples, groups) {
            return true;
        }
        let Some(strip) = Strip::between(&self.groups[0], &self.groups[1]) else {
            return false;
        };
        groups.clear();
        groups.extend(classified.iter().map(|classified| strip.group(classified)));
        self.strip_is_bright = Some(strip.is_bright);
        self.separate(point_samples, groups)
    }

    fn count_of_lines(&self) -> usize {
        1 + usize::from(self.strip_is_bright.is_some() || self.sides.is_some())
    }

    /// Sorts samples into groups; true if lines separate these.
    fn separate(&mut self, point_samples: &[PointSample], groups: &[u8]) -> bool {
        for group in &mut self.groups {
            group.clear();
        }
        for ((point, _), &group) in point_samples.iter().zip(groups) {
            self.groups[usize::from(group)].push(*point);
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

    /// The next step: more samples, or the estimate.
    pub(super) fn next(&mut self, channels: usize, goal: ErrorGoal) -> NextStep {
        let lines = self.count_of_lines();
        let division = |line: usize| {
            let line = &self.lines[line];
            Division::of(line.wedge, &line.before, &line.behind)
        };
        let Some(first) = division(0) else {
            return NextStep::GiveUp;
        };
        let second = if lines == 2 { division(1) } else { None };
        if lines == 2 && second.is_none() {
            return NextStep::GiveUp;
        }
        let are_alike = self.strip_is_bright.is_some();
        let Some(parts) = PixelParts::of(&first, second.as_ref(), &self.sums, are_alike) else {
            return NextStep::GiveUp;
        };
        let (mut rest, mut whole, mut by_line) = (0.0, 0.0, [0.0; 2]);
        for c in 0..channels {
            let (of_parts, of_lines) = parts.variances(c, &first, second.as_ref());
            rest = f64::max(rest, of_parts);
            whole = f64::max(whole, of_parts + of_lines[0] + of_lines[1]);
            by_line = [0, 1].map(|line| f64::max(by_line[line], of_lines[line]));
        }
        self.first = Some(first);
        let (best, most) = (goal.best * goal.best, goal.most * goal.most);
        if rest > most / 2.0 {
            return NextStep::GiveUp;
        }
        // Lines need not be known much better than colours.
        let aimed = best.max(2.0 * rest).min(most);
        let is_last = self.taken >= MAX_ON_AN_EDGE << (lines - 1);
        let is_enough = whole <= if is_last { most } else { aimed };
        if (is_enough || rest > best) && std::mem::take(&mut self.needs_test) {
            return NextStep::Test;
        }
        if is_enough {
            return NextStep::Done(Estimate {
                mean: parts.mean(),
                error: whole.sqrt(),
            });
        }
        if is_last {
            return NextStep::GiveUp;
        }
        // The line with the larger error.
        self.line = usize::from(by_line[1] > by_line[0]);
        let division = match second {
            Some(second) if self.line == 1 => second,
            _ => first,
        };
        // Each point about halves the range of possible lines.
        let together = match whole > FAR * aimed {
            true => 2 * ON_AN_EDGE_TOGETHER,
            false => ON_AN_EDGE_TOGETHER,
        };
        let numbers = self.taken..self.taken + together;
        self.taken = numbers.end;
        self.points.clear();
        self.points
            .extend(numbers.map(|number| division.point(number)));
        NextStep::Points
    }

    /// Takes samples all over the pixel; false if they show that no lines divide it.
    pub(super) fn test(&mut self, samples: &[AdaptiveSample]) -> bool {
        samples.iter().all(|sample| {
            let point = sample.share();
            let is_beyond = self.first.is_some_and(|first| first.is_beyond(point));
            let group = self.take(sample, point, 2 * usize::from(is_beyond));
            group.is_some_and(|group| {
                self.sums[group].add(point, &sample.channels);
                true
            })
        })
    }

    /// Takes the samples at `points`; false if they show that no lines divide the pixel.
    pub(super) fn take_points(&mut self, samples: &[AdaptiveSample]) -> bool {
        samples.iter().enumerate().all(|(i, sample)| {
            let point = self.points[i];
            let group = self.take(sample, point, 2 * self.line);
            group.is_some_and(|group| {
                // Colours next to a line are not representative of the whole part.
                if self.sums[group].count() < ENOUGH {
                    self.sums[group].add(point, &sample.channels);
                }
                true
            })
        })
    }

    /// The group of a sample by its side or class; `beside` if it lies beside a strip.
    fn group(&self, sample: &AdaptiveSample, beside: usize) -> Option<usize> {
        if let Some(sides) = &self.sides {
            return sides.number(sample);
        }
        let is_bright = self.classes?.is_bright(sample)?;
        Some(match self.strip_is_bright {
            None => usize::from(is_bright),
            Some(strip) if strip == is_bright => 1,
            Some(_) => beside,
        })
    }

    /// Adds the point of a sample and returns its group; `None` if it shows that no lines divide the pixel.
    fn take(&mut self, sample: &AdaptiveSample, point: [f64; 2], beside: usize) -> Option<usize> {
        let group = self.group(sample, beside)?;
        for line in 0..self.count_of_lines() {
            let is_behind = group > line;
            let line = &mut self.lines[line];
            let (own, others) = match is_behind {
                true => (&mut line.behind, &line.before),
                false => (&mut line.before, &line.behind),
            };
            if !line.wedge.take(point, is_behind, others) {
                return None;
            }
            own.push(point);
        }
        Some(group)
    }
}
