//! Pixels in which three sides of surfaces follow each other: the front of a bar, its flank, and what is behind.

use super::edge_fit::PlacedSample;
use super::sample::AdaptiveSample;
use smallvec::SmallVec;

/// Three sides of surfaces, the second between the others: a sample of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides([AdaptiveSample; 3]);

/// A side, and the middle of where it was seen.
struct Side {
    look: AdaptiveSample,
    sum: [f64; 2],
    count: f64,
}

impl Sides {
    /// The sides that samples met, if these are three.
    pub(super) fn of(placed: &[PlacedSample]) -> Option<Sides> {
        let mut sides: SmallVec<[Side; 3]> = SmallVec::new();
        for (place, look) in placed {
            let known = sides.iter().position(|side| side.look.is_same_side(look));
            match known {
                Some(known) => {
                    let side = &mut sides[known];
                    side.sum = [side.sum[0] + place[0], side.sum[1] + place[1]];
                    side.count += 1.0;
                }
                None if sides.len() == 3 => return None,
                None => sides.push(Side {
                    look: *look,
                    sum: *place,
                    count: 1.0,
                }),
            }
        }
        let [a, b, c] = sides.into_inner().ok()?;
        let middle = |side: &Side| side.sum.map(|sum| sum / side.count);
        let [at_a, at_b, at_c] = [&a, &b, &c].map(middle);
        let (a, b, c) = (a.look, b.look, c.look);
        // From the one between the ways to the two others lead apart.
        let apart = |from: [f64; 2], one: [f64; 2], other: [f64; 2]| {
            (one[0] - from[0]) * (other[0] - from[0]) + (one[1] - from[1]) * (other[1] - from[1])
        };
        let orders = [
            (apart(at_a, at_b, at_c), [b, a, c]),
            (apart(at_b, at_a, at_c), [a, b, c]),
            (apart(at_c, at_a, at_b), [a, c, b]),
        ];
        let least = orders.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Sides(least.1))
    }

    /// Which of them a sample met; `None` if none.
    pub(super) fn number(&self, look: &AdaptiveSample) -> Option<usize> {
        self.0.iter().position(|side| side.is_same_side(look))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(sides: impl Fn([f64; 2]) -> u32) -> Vec<PlacedSample> {
        let places = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        places
            .map(|place| (place, AdaptiveSample::on_side(sides(place))))
            .collect()
    }

    #[test]
    fn of_three_sides_the_one_between_is_the_second() {
        for turned in 0..3 {
            let leaf = |part: u32| (part + turned) % 3;
            let placed = placed(|[x, _]| leaf(u32::from(x > 0.3) + u32::from(x > 0.6)));
            let sides = Sides::of(&placed).expect("there are three");
            assert_eq!(sides.number(&placed[2].1), Some(1));
            let ends = [0, 5].map(|i| sides.number(&placed[i].1));
            assert!(ends == [Some(0), Some(2)] || ends == [Some(2), Some(0)]);
        }
    }

    #[test]
    fn two_sides_or_four_are_not_three() {
        for count in [2.0, 4.0] {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "small"
            )]
            let placed = placed(|[x, _]| (x * count) as u32);
            assert!(Sides::of(&placed).is_none());
        }
    }
}
