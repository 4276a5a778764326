//! Pixels crossed by a strip between two straight lines: a wire or a gap.

use super::edge::ClassifiedPoint;
use crate::base::math::simd::with_widest;
use std::f64::consts::PI;

/// Directions tested at once.
const DIRECTIONS: usize = 16;
/// Rounds of the search; later rounds search around the direction with the fewest mixed samples.
const ROUNDS: u32 = 3;
/// Share of mixed samples up to which a strip may lie in a nearby direction.
const MAX_MIXED: f32 = 1.0 / 6.0;

/// A strip of one class between samples of the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    direction: [f32; 2],
    /// True if the strip is the brighter class.
    pub(super) is_bright: bool,
    from: f32,
}

impl Strip {
    /// A strip of one class of samples between the others; `None` if the samples are mixed in every direction. Of
    /// several strips in one round the widest gap to the others wins.
    pub(super) fn between(dark: &[[f64; 2]], bright: &[[f64; 2]]) -> Option<Strip> {
        #[allow(clippy::cast_precision_loss, reason = "samples of a pixel are few")]
        let most = MAX_MIXED * (dark.len() + bright.len()) as f32;
        let mut fan = Fan::HALF_TURN;
        for _ in 0..ROUNDS {
            let directions = fan.directions();
            let mixed = with_widest(|_| Mixed::of(dark, bright, &directions))?;
            let (least, number) = mixed.least()?;
            if least == 0.0 {
                return mixed.widest(&directions, dark, bright);
            }
            if least > most {
                return None;
            }
            fan = fan.around(number);
        }
        None
    }

    /// 1 inside the strip; 0 or 2 on either side of it.
    pub(super) fn group(&self, classified: &ClassifiedPoint) -> u8 {
        let [cos, sin] = self.direction;
        match classified.1 == self.is_bright {
            true => 1,
            false if along(single(classified.0), [cos, sin]) < self.from => 0,
            false => 2,
        }
    }
}

/// Directions at even steps.
#[derive(Clone, Copy)]
struct Fan {
    first: f64,
    step: f64,
}

impl Fan {
    /// Half a turn covers all: opposite directions are equivalent.
    const HALF_TURN: Fan = Fan {
        first: 0.0,
        step: PI / 16.0,
    };

    /// Directions between the two neighbours of one of them.
    fn around(self, number: u8) -> Fan {
        // Sixteen between the neighbours, which are known and left out.
        let step = 2.0 * self.step / 17.0;
        Fan {
            first: self.first + (f64::from(number) - 1.0) * self.step + step,
            step,
        }
    }

    /// The cosine and the sine of each.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is found is tested again"
    )]
    fn directions(self) -> [[f32; DIRECTIONS]; 2] {
        let mut directions = [[0.0; DIRECTIONS]; 2];
        let (sin_step, cos_step) = self.step.sin_cos();
        let (mut sin, mut cos) = self.first.sin_cos();
        let [cosines, sines] = &mut directions;
        for direction in cosines.iter_mut().zip(sines) {
            (*direction.0, *direction.1) = (cos as f32, sin as f32);
            (sin, cos) = (
                sin * cos_step + cos * sin_step,
                cos * cos_step - sin * sin_step,
            );
        }
        directions
    }
}

/// The order of samples of two classes in each direction.
struct Mixed {
    /// The extent of the dark and of the bright samples.
    extents: [Extents; 2],
    /// Samples of one class within the extent of the other, dark and bright.
    counts: [[f32; DIRECTIONS]; 2],
}

impl Mixed {
    /// `None` if neither class lies within the other in any direction.
    #[inline(always)]
    fn of(
        dark: &[[f64; 2]],
        bright: &[[f64; 2]],
        directions: &[[f32; DIRECTIONS]; 2],
    ) -> Option<Mixed> {
        let mut mixed = Mixed {
            extents: [extents(dark, directions), extents(bright, directions)],
            counts: [[0.0; DIRECTIONS]; 2],
        };
        (0..DIRECTIONS).find_map(|number| mixed.is_bright_within(number))?;
        mixed.counts = [
            count_within(dark, &mixed.extents[1], directions),
            count_within(bright, &mixed.extents[0], directions),
        ];
        Some(mixed)
    }

    /// The class that lies within the other in a direction, true for bright; `None` if neither does.
    fn is_bright_within(&self, number: usize) -> Option<bool> {
        let [dark, bright] = [0, 1].map(|class: usize| self.extents[class].of(number));
        let is_within = |a: (f32, f32), b: (f32, f32)| a.0 > b.0 && a.1 < b.1;
        let is_bright = is_within(bright, dark);
        (is_bright || is_within(dark, bright)).then_some(is_bright)
    }

    /// The lowest count of outer samples within the extent of the inner class, and its direction.
    fn least(&self) -> Option<(f32, u8)> {
        let mut best: Option<(f32, u8)> = None;
        for (number, direction) in (0..DIRECTIONS).zip(0u8..) {
            if let Some(is_bright) = self.is_bright_within(number) {
                let count = self.counts[usize::from(!is_bright)][number];
                if best.is_none_or(|(least, _)| count < least) {
                    best = Some((count, direction));
                }
            }
        }
        best
    }

    /// The strip with the widest gap to the others, among the directions without mixed samples.
    fn widest(
        &self,
        directions: &[[f32; DIRECTIONS]; 2],
        dark: &[[f64; 2]],
        bright: &[[f64; 2]],
    ) -> Option<Strip> {
        let mut best: Option<(f32, Strip)> = None;
        for number in 0..DIRECTIONS {
            let Some(is_bright) = self.is_bright_within(number) else {
                continue;
            };
            let others = usize::from(!is_bright);
            if self.counts[others][number] > 0.0 {
                continue;
            }
            let direction = directions.map(|part| part[number]);
            let (from, to) = self.extents[usize::from(is_bright)].of(number);
            // The extent of the others on either side.
            let (mut before, mut behind) = (f32::NEG_INFINITY, f32::INFINITY);
            for &point in [dark, bright][others] {
                let along = along(single(point), direction);
                if along < from {
                    before = if along > before { along } else { before };
                } else {
                    behind = if along < behind { along } else { behind };
                }
            }
            let width = f32::min(from - before, behind - to);
            if best.is_none_or(|(widest, _)| width > widest) {
                let strip = Strip {
                    direction,
                    is_bright,
                    from,
                };
                best = Some((width, strip));
            }
        }
        best.map(|(_, strip)| strip)
    }
}

/// A point in single precision.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "what is found is tested again"
)]
fn single(point: [f64; 2]) -> [f32; 2] {
    point.map(|v| v as f32)
}

/// The coordinate of a point along a direction.
#[inline(always)]
fn along([x, y]: [f32; 2], [cos, sin]: [f32; 2]) -> f32 {
    x * cos + y * sin
}

/// The extent of points in each direction.
struct Extents {
    least: [f32; DIRECTIONS],
    most: [f32; DIRECTIONS],
}

impl Extents {
    /// The extent in one direction.
    fn of(&self, number: usize) -> (f32, f32) {
        (self.least[number], self.most[number])
    }
}

#[inline(always)]
fn extents(points: &[[f64; 2]], directions: &[[f32; DIRECTIONS]; 2]) -> Extents {
    let [cos, sin] = directions;
    let mut all = Extents {
        least: [f32::INFINITY; DIRECTIONS],
        most: [f32::NEG_INFINITY; DIRECTIONS],
    };
    for &point in points {
        let point = single(point);
        for number in 0..DIRECTIONS {
            let along = along(point, [cos[number], sin[number]]);
            let (least, most) = (all.least[number], all.most[number]);
            // `f32::min` handles NaN, which takes longer than all the rest.
            all.least[number] = if along < least { along } else { least };
            all.most[number] = if along > most { along } else { most };
        }
    }
    all
}

/// The number of points within the extent of others in each direction.
#[inline(always)]
fn count_within(
    points: &[[f64; 2]],
    others: &Extents,
    directions: &[[f32; DIRECTIONS]; 2],
) -> [f32; DIRECTIONS] {
    let [cos, sin] = directions;
    let mut counts = [0.0; DIRECTIONS];
    for &point in points {
        let point = single(point);
        for number in 0..DIRECTIONS {
            let along = along(point, [cos[number], sin[number]]);
            let is_within = (along >= others.least[number]) & (along <= others.most[number]);
            counts[number] += if is_within { 1.0 } else { 0.0 };
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a grid, classified by a test for a strip.
    fn classified(is_bright: impl Fn([f64; 2]) -> bool) -> Vec<ClassifiedPoint> {
        let points = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        points.map(|point| (point, is_bright(point))).collect()
    }

    /// The strip between classified points.
    fn between(classified: &[ClassifiedPoint]) -> Option<Strip> {
        let of = |class: bool| -> Vec<[f64; 2]> {
            let ours = classified.iter().filter(|classified| classified.1 == class);
            ours.map(|classified| classified.0).collect()
        };
        Strip::between(&of(false), &of(true))
    }

    #[test]
    fn a_slanted_strip_lies_between_its_sides() {
        for dark in [false, true] {
            let along = |[x, y]: [f64; 2]| x + y;
            let classified = classified(|point| (0.7..1.1).contains(&along(point)) != dark);
            let strip = between(&classified).expect("there is a strip");
            assert_eq!(strip.is_bright, !dark);
            for classified in &classified {
                let (point, group) = (classified.0, strip.group(classified));
                let along = along(point);
                let middle = (0.7..1.1).contains(&along);
                assert_eq!(group == 1, middle, "{point:?}");
                assert!(middle || group == 0 || group == 2);
            }
        }
    }

    #[test]
    fn thin_strips_are_detected_in_all_directions() {
        let points = |strip: bool, (sin, cos): (f64, f64)| -> Vec<[f64; 2]> {
            let all = (0..1024).map(|i| [f64::from(i % 32) / 32.0, f64::from(i / 32) / 32.0]);
            let across = |[x, y]: [f64; 2]| (x - 0.5) * cos + (y - 0.5) * sin;
            all.filter(|&point| (across(point).abs() < 0.06) == strip)
                .collect()
        };
        for step in 0..100 {
            let angle = (f64::from(step) * 0.031).sin_cos();
            let strip = Strip::between(&points(false, angle), &points(true, angle));
            assert!(strip.is_some_and(|strip| strip.is_bright), "{step}");
        }
    }

    #[test]
    fn a_checkerboard_is_no_strip() {
        let classified = classified(|[x, y]| (x < 0.4) != (y < 0.4));
        assert!(between(&classified).is_none());
    }
}
