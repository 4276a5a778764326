//! Pixels that a strip crosses: a wire, a gap, what two straight lines bound.

use super::edge::Told;
use crate::math::lanes::with_widest;
use std::f64::consts::PI;

/// Directions in which a strip is looked for.
const DIRECTIONS: usize = 16;
/// The angle from one to the next.
const STEP: f64 = PI / 16.0;

/// A strip of one kind between others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    direction: [f64; 2],
    /// Whether the strip is the brighter.
    pub(super) is_bright: bool,
    from: f64,
}

impl Strip {
    /// A strip of one kind of samples between the others, the widest apart from these; `None` if there is no direction in
    /// which the samples follow each other like that.
    pub(super) fn between(dark: &[[f64; 2]], bright: &[[f64; 2]]) -> Option<Strip> {
        let directions = directions();
        let (of_dark, of_bright) =
            with_widest(|_| (reaches(dark, &directions), reaches(bright, &directions)));
        let mut best: Option<(f64, Strip)> = None;
        for number in 0..DIRECTIONS {
            let direction = directions.map(|part| part[number]);
            let (of_dark, of_bright) = (of_dark.of(number), of_bright.of(number));
            let is_within = |a: (f64, f64), b: (f64, f64)| a.0 > b.0 && a.1 < b.1;
            let is_bright = is_within(of_bright, of_dark);
            if !is_bright && !is_within(of_dark, of_bright) {
                continue;
            }
            let ((from, to), others) = if is_bright {
                (of_bright, dark)
            } else {
                (of_dark, bright)
            };
            // How far the others reach on either side.
            let (mut before, mut behind) = (f64::NEG_INFINITY, f64::INFINITY);
            let mut is_mixed = false;
            for place in others {
                let along = place[0] * direction[0] + place[1] * direction[1];
                if along < from {
                    before = if along > before { along } else { before };
                } else {
                    is_mixed |= along <= to;
                    behind = if along < behind { along } else { behind };
                }
            }
            let width = f64::min(from - before, behind - to);
            if !is_mixed && width > 0.0 && best.is_none_or(|(widest, _)| width > widest) {
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

    /// 0 or 2 for either side of it, 1 for the strip.
    pub(super) fn group(&self, told: &Told) -> u8 {
        let [cos, sin] = self.direction;
        match told.1 == self.is_bright {
            true => 1,
            false if told.0[0] * cos + told.0[1] * sin < self.from => 0,
            false => 2,
        }
    }
}

/// The directions: half a turn, of each its cosine and its sine.
fn directions() -> [[f64; DIRECTIONS]; 2] {
    let mut directions = [[0.0; DIRECTIONS]; 2];
    let (sin_step, cos_step) = STEP.sin_cos();
    let (mut sin, mut cos) = (0.0, 1.0);
    let [cosines, sines] = &mut directions;
    for direction in cosines.iter_mut().zip(sines) {
        (*direction.0, *direction.1) = (cos, sin);
        (sin, cos) = (
            sin * cos_step + cos * sin_step,
            cos * cos_step - sin * sin_step,
        );
    }
    directions
}

/// The least and the most of how far places lie in each direction.
struct Reaches {
    least: [f64; DIRECTIONS],
    most: [f64; DIRECTIONS],
}

impl Reaches {
    /// Those in one direction.
    fn of(&self, number: usize) -> (f64, f64) {
        (self.least[number], self.most[number])
    }
}

#[inline(always)]
fn reaches(places: &[[f64; 2]], directions: &[[f64; DIRECTIONS]; 2]) -> Reaches {
    let [cos, sin] = directions;
    let mut all = Reaches {
        least: [f64::INFINITY; DIRECTIONS],
        most: [f64::NEG_INFINITY; DIRECTIONS],
    };
    for place in places {
        for number in 0..DIRECTIONS {
            let along = place[0] * cos[number] + place[1] * sin[number];
            let (least, most) = (all.least[number], all.most[number]);
            // What `min` does about numbers that are none takes longer than all the rest.
            all.least[number] = if along < least { along } else { least };
            all.most[number] = if along > most { along } else { most };
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether places on a grid are of one kind, tested for lying in a strip.
    fn told(is_bright: impl Fn([f64; 2]) -> bool) -> Vec<Told> {
        let places = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        places.map(|place| (place, is_bright(place))).collect()
    }

    /// The strip between samples.
    fn between(told: &[Told]) -> Option<Strip> {
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
    fn a_chequer_is_no_strip() {
        let told = told(|[x, y]| (x < 0.4) != (y < 0.4));
        assert!(between(&told).is_none());
    }
}
