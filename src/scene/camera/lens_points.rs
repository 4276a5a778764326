//! Sample points on the lens, in POV-Ray's order.
//!
//! Up to six samples start with a square, more with a hexagon of 7, 19 or 37 points of a triangular lattice. Points of
//! a Halton sequence that fall into empty cells of a grid make up the rest. A `bokeh` uses points of that sequence,
//! accepted in proportion to its brightness.

use crate::base::math::halton;
use crate::base::math::sampling::mersenne::numbers;
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// Corners of a square, for up to six samples.
const SQUARE: [(i32, i32); 4] = [(-1, 1), (1, 1), (-1, -1), (1, -1)];

/// Hexagons, by batches: x in half lattice units, y in rows.
const HEXAGON_7: &[&[(i32, i32)]] =
    &[&[(-2, 0), (0, 0), (2, 0), (-1, 1), (-1, -1), (1, 1), (1, -1)]];
const HEXAGON_19: &[&[(i32, i32)]] = &[
    &[(-2, 2), (-2, -2), (2, 2), (2, -2), (4, 0), (-4, 0), (0, 0)],
    &[(0, 2), (0, -2), (-3, 1), (-3, -1), (3, 1), (3, -1)],
    &[(-1, 1), (-1, -1), (1, 1), (1, -1), (-2, 0), (2, 0)],
];
const HEXAGON_37: &[&[(i32, i32)]] = &[
    &[(0, 0), (-3, 3), (3, -3), (-3, -3), (3, 3), (-6, 0), (6, 0)],
    &[(-2, 2), (2, -2), (-2, -2), (2, 2), (-4, 0), (4, 0)],
    &[(-1, 1), (1, -1), (-1, -1), (1, 1), (-2, 0), (2, 0)],
    &[(-5, 1), (-5, -1), (5, 1), (5, -1)],
    &[(-4, 2), (-4, -2), (4, 2), (4, -2)],
    &[(-1, 3), (-1, -3), (1, 3), (1, -3)],
    &[(-3, 1), (-3, -1), (3, 1), (3, -1)],
    &[(0, 2), (0, -2)],
];
/// Size of the further batches.
const BATCH: usize = 4;
/// Average number of candidates tried per point.
const CANDIDATES_PER_POINT: usize = 10;

/// Sample points on a lens of diameter 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LensPoints {
    /// The points, in sampling order.
    pub(super) points: Vec<DVec2>,
    /// Sample counts after which POV-Ray tests for convergence, in rising order; the last is the total.
    pub(super) batch_ends: Vec<usize>,
    /// Amplitude of the random offset from a point.
    pub(super) spread: f64,
}

/// Lattice points of a hexagon, by batches.
type Hexagon = &'static [&'static [(i32, i32)]];

impl LensPoints {
    /// The points of a round lens of uniform brightness; `count` is not 0.
    pub(super) fn uniform(count: usize) -> Self {
        let hexagon: Option<(Hexagon, f64)> = match count {
            0..7 => None,
            7..19 => Some((HEXAGON_7, 2.0)),
            19..37 => Some((HEXAGON_19, 3.0)),
            _ => Some((HEXAGON_37, 4.0)),
        };
        let mut points = Vec::new();
        let mut batch_ends = Vec::new();
        if let Some((batches, rings)) = hexagon {
            let (half_unit, row) = (0.5 / (rings * 3.0_f64.sqrt()), 0.5 / rings);
            for batch in batches {
                let point = |&(x, y): &(i32, i32)| {
                    DVec2::new(
                        six_digits(f64::from(x) * half_unit),
                        six_digits(f64::from(y) * row),
                    )
                };
                points.extend(batch.iter().map(point));
                batch_ends.push(points.len());
            }
        } else {
            let point = |&(x, y): &(i32, i32)| DVec2::new(0.25 * f64::from(x), 0.25 * f64::from(y));
            points.extend(SQUARE.iter().map(point));
            points.truncate(count);
        }
        let spread = match count {
            7 => 0.144_338,
            19 => 0.096_225,
            37 => 0.072_168_8,
            _ => 0.5 / as_float(count).sqrt(),
        };
        fill(&mut points, count);
        LensPoints {
            batch_ends: with_batches(batch_ends, count),
            points,
            spread,
        }
    }

    /// Points distributed in proportion to `brightness`, a function on the unit square (rejection sampling; the
    /// acceptance rises with the number of candidates).
    pub(super) fn weighted(count: usize, brightness: impl Fn(DVec2) -> f64) -> Self {
        let mut points = Vec::with_capacity(count);
        let mut random = numbers().skip(1);
        let square = as_float(count) * as_float(count);
        for candidate in 0u32.. {
            if points.len() == count {
                break;
            }
            let at = halton(candidate + 1);
            let threshold = random.next().unwrap_or_default();
            if threshold <= brightness(at) + f64::from(candidate) / square {
                points.push(at - 0.5);
            }
        }
        LensPoints {
            points,
            batch_ends: with_batches(Vec::new(), count),
            spread: 0.5 / as_float(count).sqrt(),
        }
    }
}

/// Adds points of the Halton sequence that fall into empty cells, until there are `count` points. When the candidates
/// run low, occupied cells are accepted, too.
fn fill(points: &mut Vec<DVec2>, count: usize) {
    if points.len() >= count {
        return;
    }
    let side = 2.0 * (as_float(count) / PI).sqrt().ceil() + 1.0;
    let row = |at: f64| index(((at + 0.5) * side).trunc().min(side - 1.0));
    let cell = |at: DVec2| row(at.y) * index(side) + row(at.x);
    let mut is_occupied = vec![false; index(side) * index(side)];
    for point in points.iter() {
        is_occupied[cell(*point)] = true;
    }
    let mut candidates_left = CANDIDATES_PER_POINT * count;
    for candidate in 1u32.. {
        let missing = count - points.len();
        if missing == 0 {
            break;
        }
        let in_square = halton(candidate);
        let (sin, cos) = (TAU * in_square.y).sin_cos();
        let point = (0.25 * in_square.x).sqrt() * DVec2::new(cos, sin);
        let cell = cell(point);
        if !is_occupied[cell] || candidates_left <= missing {
            is_occupied[cell] = true;
            points.push(point);
        }
        candidates_left = candidates_left.saturating_sub(1);
    }
}

/// Adds batches of [`BATCH`] samples up to `count`.
fn with_batches(mut batch_ends: Vec<usize>, count: usize) -> Vec<usize> {
    let mut last = batch_ends.last().copied().unwrap_or(0);
    while last < count {
        last = (last + BATCH).min(count);
        batch_ends.push(last);
    }
    batch_ends
}

fn six_digits(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[allow(clippy::cast_precision_loss, reason = "samples are few")]
fn as_float(count: usize) -> f64 {
    count as f64
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few, and points lie within the square"
)]
fn index(at: f64) -> usize {
    at as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_points_make_a_hexagon() {
        let points = LensPoints::uniform(7);
        assert_eq!(points.points[0], DVec2::new(-0.288_675, 0.0));
        assert_eq!(points.points[6], DVec2::new(0.144_338, -0.25));
        assert_eq!(points.batch_ends, [7]);
    }

    #[test]
    fn larger_hexagons_come_in_batches() {
        assert_eq!(LensPoints::uniform(19).batch_ends, [7, 13, 19]);
        let points = LensPoints::uniform(40);
        assert_eq!(points.batch_ends, [7, 13, 19, 23, 27, 31, 35, 37, 40]);
        assert_eq!(points.points[5], DVec2::new(-0.433_013, 0.0));
        assert_eq!(points.points.len(), 40);
    }

    #[test]
    fn up_to_six_points_start_with_a_square() {
        assert_eq!(LensPoints::uniform(2).points.len(), 2);
        assert_eq!(LensPoints::uniform(4).points[3], DVec2::new(0.25, -0.25));
        assert_eq!(LensPoints::uniform(6).batch_ends, [4, 6]);
    }

    #[test]
    fn all_points_lie_on_the_lens() {
        for count in [1, 6, 12, 30, 100, 1000] {
            let points = LensPoints::uniform(count).points;
            assert_eq!(points.len(), count);
            assert!(points.iter().all(|point| point.length() <= 0.5));
        }
    }

    #[test]
    fn a_weighted_lens_has_its_points_where_it_is_bright() {
        let half = |at: DVec2| f64::from(u8::from(at.x < 0.5));
        let points = LensPoints::weighted(60, half).points;
        let bright = points.iter().filter(|point| point.x < 0.0).count();
        assert!(points.len() == 60 && bright > 50, "{bright}");
    }
}
