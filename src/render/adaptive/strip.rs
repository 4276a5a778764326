//! Pixels that a strip crosses: a wire, a gap, what two straight lines bound.

use super::edge::ClassifiedPoint;
use crate::base::math::simd::with_widest;
use std::f64::consts::PI;

/// Directions in which a strip is looked for at once.
const DIRECTIONS: usize = 16;
/// How often it is looked for: after the first time around the direction in which fewest samples are mixed.
const ROUNDS: u32 = 3;
/// Where at most this share of the samples is mixed, a strip may be seen in a direction that lies nearby.
const MOST_MIXED: f32 = 1.0 / 6.0;

/// A strip of one kind between others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    direction: [f32; 2],
    /// Whether the strip is the brighter.
    pub(super) is_bright: bool,
    from: f32,
}

impl Strip {
    /// A strip of one kind of samples between the others; `None` if no direction is found in which the samples follow each
    /// other like that. Of several that are found at once it is the one that lies the widest apart from the others.
    pub(super) fn between(dark: &[[f64; 2]], bright: &[[f64; 2]]) -> Option<Strip> {
        #[allow(clippy::cast_precision_loss, reason = "samples of a pixel are few")]
        let most = MOST_MIXED * (dark.len() + bright.len()) as f32;
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

    /// 0 or 2 for either side of it, 1 for the strip.
    pub(super) fn group(&self, told: &ClassifiedPoint) -> u8 {
        let [cos, sin] = self.direction;
        match told.1 == self.is_bright {
            true => 1,
            false if along(single(told.0), [cos, sin]) < self.from => 0,
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
    /// All there are: the opposite of a direction tells the same.
    const HALF_TURN: Fan = Fan {
        first: 0.0,
        step: PI / 16.0,
    };

    /// Those between the neighbours of one of them.
    fn around(self, number: u8) -> Fan {
        // Sixteen between the two neighbours, which are known and left out.
        let step = 2.0 * self.step / 17.0;
        Fan {
            first: self.first + (f64::from(number) - 1.0) * self.step + step,
            step,
        }
    }

    /// Of each its cosine and its sine.
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

/// How samples of two kinds follow each other in each direction.
struct Mixed {
    /// The least and the most of how far the dark ones and the bright ones lie in it.
    reaches: [Reaches; 2],
    /// How many samples of the one kind lie where those of the other do, dark and bright.
    counts: [[f32; DIRECTIONS]; 2],
}

impl Mixed {
    /// `None` if one kind reaches further to both sides in none.
    #[inline(always)]
    fn of(
        dark: &[[f64; 2]],
        bright: &[[f64; 2]],
        directions: &[[f32; DIRECTIONS]; 2],
    ) -> Option<Mixed> {
        let mut mixed = Mixed {
            reaches: [reaches(dark, directions), reaches(bright, directions)],
            counts: [[0.0; DIRECTIONS]; 2],
        };
        (0..DIRECTIONS).find_map(|number| mixed.is_bright_within(number))?;
        mixed.counts = [
            count_within(dark, &mixed.reaches[1], directions),
            count_within(bright, &mixed.reaches[0], directions),
        ];
        Some(mixed)
    }

    /// Whether in a direction the one kind reaches further to both sides, and if so, whether it is the bright one that lies
    /// between.
    fn is_bright_within(&self, number: usize) -> Option<bool> {
        let [dark, bright] = [0, 1].map(|kind: usize| self.reaches[kind].of(number));
        let is_within = |a: (f32, f32), b: (f32, f32)| a.0 > b.0 && a.1 < b.1;
        let is_bright = is_within(bright, dark);
        (is_bright || is_within(dark, bright)).then_some(is_bright)
    }

    /// The least number of samples that lie where those between them do, and a direction in which that is so.
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

    /// Of the directions in which no samples are mixed the one in which the strip lies the widest apart from the others.
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
            let (from, to) = self.reaches[usize::from(is_bright)].of(number);
            // How far the others reach on either side.
            let (mut before, mut behind) = (f32::NEG_INFINITY, f32::INFINITY);
            for &place in [dark, bright][others] {
                let along = along(single(place), direction);
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

/// A place in single precision.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "what is found is tested again"
)]
fn single(place: [f64; 2]) -> [f32; 2] {
    place.map(|v| v as f32)
}

/// How far a place lies in a direction.
#[inline(always)]
fn along([x, y]: [f32; 2], [cos, sin]: [f32; 2]) -> f32 {
    x * cos + y * sin
}

/// The least and the most of how far places lie in each direction.
struct Reaches {
    least: [f32; DIRECTIONS],
    most: [f32; DIRECTIONS],
}

impl Reaches {
    /// Those in one direction.
    fn of(&self, number: usize) -> (f32, f32) {
        (self.least[number], self.most[number])
    }
}

#[inline(always)]
fn reaches(places: &[[f64; 2]], directions: &[[f32; DIRECTIONS]; 2]) -> Reaches {
    let [cos, sin] = directions;
    let mut all = Reaches {
        least: [f32::INFINITY; DIRECTIONS],
        most: [f32::NEG_INFINITY; DIRECTIONS],
    };
    for &place in places {
        let place = single(place);
        for number in 0..DIRECTIONS {
            let along = along(place, [cos[number], sin[number]]);
            let (least, most) = (all.least[number], all.most[number]);
            // What `min` does about numbers that are none takes longer than all the rest.
            all.least[number] = if along < least { along } else { least };
            all.most[number] = if along > most { along } else { most };
        }
    }
    all
}

/// How many places lie within the reaches of others in each direction.
#[inline(always)]
fn count_within(
    places: &[[f64; 2]],
    others: &Reaches,
    directions: &[[f32; DIRECTIONS]; 2],
) -> [f32; DIRECTIONS] {
    let [cos, sin] = directions;
    let mut counts = [0.0; DIRECTIONS];
    for &place in places {
        let place = single(place);
        for number in 0..DIRECTIONS {
            let along = along(place, [cos[number], sin[number]]);
            let is_within = (along >= others.least[number]) & (along <= others.most[number]);
            counts[number] += if is_within { 1.0 } else { 0.0 };
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether places on a grid are of one kind, tested for lying in a strip.
    fn told(is_bright: impl Fn([f64; 2]) -> bool) -> Vec<ClassifiedPoint> {
        let places = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        places.map(|place| (place, is_bright(place))).collect()
    }

    /// The strip between samples.
    fn between(told: &[ClassifiedPoint]) -> Option<Strip> {
        let of = |kind: bool| -> Vec<[f64; 2]> {
            let ours = told.iter().filter(|told| told.1 == kind);
            ours.map(|told| told.0).collect()
        };
        Strip::between(&of(false), &of(true))
    }

    #[test]
    fn a_slanted_strip_is_found_between_its_sides() {
        for dark in [false, true] {
            let along = |[x, y]: [f64; 2]| x + y;
            let told = told(|place| (0.7..1.1).contains(&along(place)) != dark);
            let strip = between(&told).expect("there is a strip");
            assert_eq!(strip.is_bright, !dark);
            for told in &told {
                let (place, group) = (told.0, strip.group(told));
                let along = along(place);
                let middle = (0.7..1.1).contains(&along);
                assert_eq!(group == 1, middle, "{place:?}");
                assert!(middle || group == 0 || group == 2);
            }
        }
    }

    #[test]
    fn a_thin_strip_is_found_in_whatever_direction_it_runs() {
        let places = |strip: bool, (sin, cos): (f64, f64)| -> Vec<[f64; 2]> {
            let all = (0..1024).map(|i| [f64::from(i % 32) / 32.0, f64::from(i / 32) / 32.0]);
            let across = |[x, y]: [f64; 2]| (x - 0.5) * cos + (y - 0.5) * sin;
            all.filter(|&place| (across(place).abs() < 0.06) == strip)
                .collect()
        };
        for step in 0..100 {
            let angle = (f64::from(step) * 0.031).sin_cos();
            let strip = Strip::between(&places(false, angle), &places(true, angle));
            assert!(strip.is_some_and(|strip| strip.is_bright), "{step}");
        }
    }

    #[test]
    fn a_chequer_is_no_strip() {
        let told = told(|[x, y]| (x < 0.4) != (y < 0.4));
        assert!(between(&told).is_none());
    }
}
