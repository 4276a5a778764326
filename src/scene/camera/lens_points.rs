//! Where the rays of a lens pass it: POV-Ray's points, in the order in which it takes them.
//!
//! Few samples stand on a square, more of them on hexagons of 7, 19 or 37 points of a triangular lattice; beyond
//! those, points of a Halton sequence fill cells that are still empty. A `bokeh` takes
//! points of that sequence where it is bright.

use crate::base::math::halton;
use crate::base::math::sampling::mersenne::numbers;
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// A square, for up to six samples.
const SQUARE: [(i32, i32); 4] = [(-1, 1), (1, 1), (-1, -1), (1, -1)];

/// Hexagons: points in halves of the lattice's unit and in rows, by batches.
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
/// Further samples are taken by so many.
const BATCH: usize = 4;
/// For each sample, how many candidates are tried for it in the mean.
const TRIES: usize = 10;

/// The points of a lens of diameter 1 and how they are used.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LensPoints {
    /// The points.
    pub(super) points: Vec<DVec2>,
    /// After how many samples POV-Ray looks whether they are enough, in rising order; the last is all of them.
    pub(super) stops: Vec<usize>,
    /// How far each ray is moved off its point at random.
    pub(super) spread: f64,
}

/// Rows of points of a hexagonal grid.
type Hexagon = &'static [&'static [(i32, i32)]];

impl LensPoints {
    /// The points of a round, even lens; `count` is not 0.
    pub(super) fn even(count: usize) -> Self {
        let hexagon: Option<(Hexagon, f64)> = match count {
            0..7 => None,
            7..19 => Some((HEXAGON_7, 2.0)),
            19..37 => Some((HEXAGON_19, 3.0)),
            _ => Some((HEXAGON_37, 4.0)),
        };
        let mut points = Vec::new();
        let mut stops = Vec::new();
        if let Some((batches, rings)) = hexagon {
            let (half_unit, row) = (0.5 / (rings * 3.0_f64.sqrt()), 0.5 / rings);
            for batch in batches {
                let place = |&(x, y): &(i32, i32)| {
                    DVec2::new(
                        six_digits(f64::from(x) * half_unit),
                        six_digits(f64::from(y) * row),
                    )
                };
                points.extend(batch.iter().map(place));
                stops.push(points.len());
            }
        } else {
            let place = |&(x, y): &(i32, i32)| DVec2::new(0.25 * f64::from(x), 0.25 * f64::from(y));
            points.extend(SQUARE.iter().map(place));
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
            stops: with_batches(stops, count),
            points,
            spread,
        }
    }

    /// The points of a lens that lets through as much light at each point of the unit square as `brightness` says.
    pub(super) fn shaped(count: usize, brightness: impl Fn(DVec2) -> f64) -> Self {
        let mut points = Vec::with_capacity(count);
        let mut random = numbers().skip(1);
        let square = as_float(count) * as_float(count);
        for tried in 0u32.. {
            if points.len() == count {
                break;
            }
            let at = halton(tried + 1);
            let least = random.next().unwrap_or_default();
            if least <= brightness(at) + f64::from(tried) / square {
                points.push(at - 0.5);
            }
        }
        LensPoints {
            points,
            stops: with_batches(Vec::new(), count),
            spread: 0.5 / as_float(count).sqrt(),
        }
    }
}

/// Fills up to `count` points with those of a sequence that fall into empty cells.
fn fill(points: &mut Vec<DVec2>, count: usize) {
    if points.len() >= count {
        return;
    }
    let side = 2.0 * (as_float(count) / PI).sqrt().ceil() + 1.0;
    let row = |at: f64| index(((at + 0.5) * side).trunc().min(side - 1.0));
    let cell = |at: DVec2| row(at.y) * index(side) + row(at.x);
    let mut is_taken = vec![false; index(side) * index(side)];
    for point in points.iter() {
        is_taken[cell(*point)] = true;
    }
    let mut tries = TRIES * count;
    for tried in 1u32.. {
        let missing = count - points.len();
        if missing == 0 {
            break;
        }
        let in_square = halton(tried);
        let (sin, cos) = (TAU * in_square.y).sin_cos();
        let point = (0.25 * in_square.x).sqrt() * DVec2::new(cos, sin);
        let cell = cell(point);
        if !is_taken[cell] || tries <= missing {
            is_taken[cell] = true;
            points.push(point);
        }
        tries = tries.saturating_sub(1);
    }
}

/// Adds stops after every four further samples, and at the end.
fn with_batches(mut stops: Vec<usize>, count: usize) -> Vec<usize> {
    let mut last = stops.last().copied().unwrap_or(0);
    while last < count {
        last = (last + BATCH).min(count);
        stops.push(last);
    }
    stops
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
        let points = LensPoints::even(7);
        assert_eq!(points.points[0], DVec2::new(-0.288_675, 0.0));
        assert_eq!(points.points[6], DVec2::new(0.144_338, -0.25));
        assert_eq!(points.stops, [7]);
    }

    #[test]
    fn larger_hexagons_come_in_batches() {
        assert_eq!(LensPoints::even(19).stops, [7, 13, 19]);
        let points = LensPoints::even(40);
        assert_eq!(points.stops, [7, 13, 19, 23, 27, 31, 35, 37, 40]);
        assert_eq!(points.points[5], DVec2::new(-0.433_013, 0.0));
        assert_eq!(points.points.len(), 40);
    }

    #[test]
    fn few_points_stand_on_a_square() {
        assert_eq!(LensPoints::even(2).points.len(), 2);
        assert_eq!(LensPoints::even(4).points[3], DVec2::new(0.25, -0.25));
        assert_eq!(LensPoints::even(6).stops, [4, 6]);
    }

    #[test]
    fn all_points_lie_on_the_lens() {
        for count in [1, 6, 12, 30, 100, 1000] {
            let points = LensPoints::even(count).points;
            assert_eq!(points.len(), count);
            assert!(points.iter().all(|point| point.length() <= 0.5));
        }
    }

    #[test]
    fn a_shaped_lens_has_its_points_where_it_is_bright() {
        let half = |at: DVec2| f64::from(u8::from(at.x < 0.5));
        let points = LensPoints::shaped(60, half).points;
        let bright = points.iter().filter(|point| point.x < 0.0).count();
        assert!(points.len() == 60 && bright > 50, "{bright}");
    }
}
