//! Pixels with three surface sides in a row, as the front of a bar, its flank, and the background.

use super::sample::AdaptiveSample;
use super::sample::PointSample;
use smallvec::SmallVec;

/// Three surface sides, the second between the others: a sample of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides([AdaptiveSample; 3]);

/// A side, and the sum of the points where it was seen.
struct Side {
    sample: AdaptiveSample,
    sum: [f64; 2],
    count: f64,
}

impl Sides {
    /// The sides hit by samples, if there are exactly three.
    pub(super) fn of(point_samples: &[PointSample]) -> Option<Sides> {
        let mut sides: SmallVec<[Side; 3]> = SmallVec::new();
        for (point, sample) in point_samples {
            let known = sides
                .iter()
                .position(|side| side.sample.is_same_side(sample));
            match known {
                Some(known) => {
                    let side = &mut sides[known];
                    side.sum = [side.sum[0] + point[0], side.sum[1] + point[1]];
                    side.count += 1.0;
                }
                None if sides.len() == 3 => return None,
                None => sides.push(Side {
                    sample: *sample,
                    sum: *point,
                    count: 1.0,
                }),
            }
        }
        let [a, b, c] = sides.into_inner().ok()?;
        let middle = |side: &Side| side.sum.map(|sum| sum / side.count);
        let [at_a, at_b, at_c] = [&a, &b, &c].map(middle);
        let (a, b, c) = (a.sample, b.sample, c.sample);
        // From the middle one, the directions to the two others are opposed.
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

    /// The index of the side that a sample hit; `None` for none of them.
    pub(super) fn number(&self, sample: &AdaptiveSample) -> Option<usize> {
        self.0.iter().position(|side| side.is_same_side(sample))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point_samples(sides: impl Fn([f64; 2]) -> u32) -> Vec<PointSample> {
        let points = (0..36).map(|i| [f64::from(i % 6) / 6.0, f64::from(i / 6) / 6.0]);
        points
            .map(|point| (point, AdaptiveSample::on_side(sides(point))))
            .collect()
    }

    #[test]
    fn of_three_sides_the_one_between_is_the_second() {
        for turned in 0..3 {
            let leaf = |part: u32| (part + turned) % 3;
            let point_samples =
                point_samples(|[x, _]| leaf(u32::from(x > 0.3) + u32::from(x > 0.6)));
            let sides = Sides::of(&point_samples).expect("there are three");
            assert_eq!(sides.number(&point_samples[2].1), Some(1));
            let ends = [0, 5].map(|i| sides.number(&point_samples[i].1));
            assert!(ends == [Some(0), Some(2)] || ends == [Some(2), Some(0)]);
        }
    }

    #[test]
    fn two_or_more_than_three_sides_are_rejected() {
        for count in [2.0, 4.0] {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "small"
            )]
            let point_samples = point_samples(|[x, _]| (x * count) as u32);
            assert!(Sides::of(&point_samples).is_none());
        }
    }
}
