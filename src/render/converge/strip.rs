//! Pixels that a strip crosses: a wire, a gap, what two straight lines bound.

use super::edge::Told;

/// A strip of one kind of samples between others: for each sample 0 or 2 for either side, 1 for the strip; or `None` if
/// there is no direction in which the samples follow each other like that.
pub(super) fn strip(told: &[Told], groups: &mut Vec<u8>) -> Option<Strip> {
    let mut best: Option<(f64, Strip)> = None;
    let (sin_step, cos_step) = (std::f64::consts::PI / f64::from(STRIP_DIRECTIONS)).sin_cos();
    let (mut sin, mut cos) = (0.0, 1.0);
    for _ in 0..STRIP_DIRECTIONS {
        let direction = [cos, sin];
        (sin, cos) = (
            sin * cos_step + cos * sin_step,
            cos * cos_step - sin * sin_step,
        );
        let along = |told: &Told| told.0[0] * direction[0] + told.0[1] * direction[1];
        // How far both kinds reach, the darker first.
        let mut ranges = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        for told in told {
            let along = along(told);
            for (range, counts) in ranges.iter_mut().zip([!told.1, told.1]) {
                range.0 = range.0.min(if counts { along } else { f64::INFINITY });
                range.1 = range.1.max(if counts { along } else { f64::NEG_INFINITY });
            }
        }
        let is_within = |a: (f64, f64), b: (f64, f64)| a.0 > b.0 && a.1 < b.1;
        let is_bright = is_within(ranges[1], ranges[0]);
        if !is_bright && !is_within(ranges[0], ranges[1]) {
            continue;
        }
        let (from, to) = ranges[usize::from(is_bright)];
        // How far the others reach on either side.
        let (mut before, mut behind) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut is_mixed = false;
        for told in told.iter().filter(|told| told.1 != is_bright) {
            let along = along(told);
            is_mixed |= along >= from && along <= to;
            if along < from {
                before = before.max(along);
            } else {
                behind = behind.min(along);
            }
        }
        let width = (from - before).min(behind - to);
        if !is_mixed && width > 0.0 && best.is_none_or(|(widest, _)| width > widest) {
            best = Some((
                width,
                Strip {
                    direction,
                    is_bright,
                    from,
                },
            ));
        }
    }
    let (_, strip) = best?;
    groups.clear();
    groups.extend(told.iter().map(|told| strip.group(told)));
    Some(strip)
}

/// Directions in which a strip is looked for.
const STRIP_DIRECTIONS: u32 = 16;

/// A strip of one kind between others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    direction: [f64; 2],
    /// Whether the strip is the brighter.
    pub(super) is_bright: bool,
    from: f64,
}

impl Strip {
    fn group(&self, told: &Told) -> u8 {
        let [cos, sin] = self.direction;
        match told.1 == self.is_bright {
            true => 1,
            false if told.0[0] * cos + told.0[1] * sin < self.from => 0,
            false => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether places on a grid are of one kind, tested for lying in a strip.
    fn told(is_bright: impl Fn([f64; 2]) -> bool) -> Vec<Told> {
        let places = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        places.map(|place| (place, is_bright(place))).collect()
    }

    #[test]
    fn a_slanted_strip_is_found_between_its_sides() {
        for dark in [false, true] {
            let along = |[x, y]: [f64; 2]| x + y;
            let told = told(|place| (0.7..1.1).contains(&along(place)) != dark);
            let mut groups = Vec::new();
            let strip = strip(&told, &mut groups).expect("there is a strip");
            assert_eq!(strip.is_bright, !dark);
            for ((place, _), group) in told.iter().zip(groups) {
                let along = along(*place);
                let middle = (0.7..1.1).contains(&along);
                assert_eq!(group == 1, middle, "{place:?}");
                assert!(middle || group == 0 || group == 2);
            }
        }
    }

    #[test]
    fn a_chequer_is_no_strip() {
        let told = told(|[x, y]| (x < 0.4) != (y < 0.4));
        assert!(strip(&told, &mut Vec::new()).is_none());
    }
}
