//! What lies next to a sample, in its pixel and in those around.

use super::band::{Band, Sight};
use super::estimate::{Estimate, SHARE_OF_VARIANCE};
use super::look::Look;
use super::slope::Slopes;

/// How much of the contrast of two cells raises doubts about the pixel that one is in, as in the estimate of its error.
const DOUBT: f64 = 0.4;

/// The first samples of a pixel and of those around.
const FIRST: (Sight, Sight) = (Sight::First, Sight::First);

/// What the first samples of a pixel tell on a surface with these slopes if they are compared with those next to them,
/// in the pixel and around it; and whether two of these met different surfaces or sides.
pub(super) fn first_estimate(
    band: &Band<'_>,
    (x, y): (u32, u32),
    slopes: &Slopes,
) -> (Estimate, bool) {
    let at = band.at(x, y);
    let count = band.target.first;
    let bits = count.ilog2();
    let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
    let (mut mean, mut variances) = ([0.0; 4], [0.0; 4]);
    let mut is_torn = false;
    let area = 1.0 / f64::from(count);
    // Two pairs of neighbours belong to each cell.
    let share = area * area * SHARE_OF_VARIANCE * 2.0;
    for cell in 0..width * height {
        let (column, row) = (cell % width, cell / width);
        let look = inside(band, Sight::First, at, (column, row), width);
        let own = slopes.levelled(look);
        let (mut apart, mut pairs) = ([0.0; 4], 0.0);
        for (dx, dy) in [(-1, 0), (1, 0), (0, -1), (0, 1i32)] {
            let (column, row) = (column + i64::from(dx), row + i64::from(dy));
            let is_outside = column < 0 || row < 0 || column >= width || row >= height;
            let (other, away) = if is_outside {
                let Some((_, other)) = beyond(band, (x, y), (column, row), FIRST) else {
                    continue;
                };
                (other, [dx, dy])
            } else {
                (inside(band, Sight::First, at, (column, row), width), [0, 0])
            };
            is_torn |= !look.is_same_side(other);
            pairs += 1.0;
            let other = slopes.levelled_at(other, away.map(f64::from));
            for (sum, (a, b)) in apart.iter_mut().zip(own.iter().zip(other)) {
                *sum += (a - b) * (a - b);
            }
        }
        for c in 0..4 {
            mean[c] += area * own[c];
            variances[c] += share * apart[c] / f64::max(pairs, 1.0);
        }
    }
    (Estimate::of(mean, variances, band.eye.channels), is_torn)
}

/// The sample of a pixel in a cell of the grid of all that it has.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few"
)]
fn inside<'a>(
    band: &'a Band<'_>,
    sight: Sight,
    at: usize,
    (column, row): (i64, i64),
    width: i64,
) -> &'a Look {
    band.look_in(sight, at, (row * width + column) as usize)
}

/// What was seen beyond the border of a pixel, next to a cell of the grid of its samples; and in which pixel.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few"
)]
fn beyond<'a>(
    band: &'a Band<'_>,
    (x, y): (u32, u32),
    (column, row): (i64, i64),
    (own, others): (Sight, Sight),
) -> Option<(usize, &'a Look)> {
    let bits = band.count(own, band.at(x, y)).ilog2();
    let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
    let at = band.at_next((x, y), (column.div_euclid(width), row.div_euclid(height)))?;
    let coarser = bits.saturating_sub(band.count(others, at).ilog2()) / 2;
    let column = (column.rem_euclid(width) >> coarser) as usize;
    let row = (row.rem_euclid(height) >> coarser) as usize;
    let cell = row * (width as usize >> coarser) + column;
    Some((at, band.look_in(others, at, cell)))
}

/// The pixels around a broken one about which its samples raise doubts.
pub(super) fn doubts(band: &Band<'_>, (x, y): (u32, u32), doubtful: &mut Vec<usize>) {
    let at = band.at(x, y);
    let looks = band.looks_of(at);
    let channels = band.eye.channels;
    let bits = looks.len().ilog2();
    let (width, height) = (1i64 << bits.div_ceil(2), 1i64 << (bits / 2));
    let target = band.target.error;
    let area = 1.0 / f64::from(band.target.first);
    // As in the estimate of a pixel.
    let differs = |a: &Look, b: &Look| {
        let apart = |c: usize| f64::from((a.channels[c].min(1.0) - b.channels[c].min(1.0)).abs());
        (0..channels).map(apart).fold(0.0, f64::max) * area * DOUBT > target
    };
    let mut alone = band.may_hide(x, y);
    for row in 0..height {
        for column in 0..width {
            let own = inside(band, Sight::All, at, (column, row), width);
            let mut like = 0;
            for (dx, dy) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
                let (column, row) = (column + dx, row + dy);
                let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
                if is_inside {
                    like += u32::from(!differs(
                        own,
                        inside(band, Sight::All, at, (column, row), width),
                    ));
                    continue;
                }
                let Some((other, look)) =
                    beyond(band, (x, y), (column, row), (Sight::All, Sight::First))
                else {
                    continue;
                };
                if differs(own, look) {
                    if band.settled_at(other).is_none() {
                        doubtful.push(other);
                    }
                } else {
                    like += 1;
                }
            }
            alone |= like == 0;
        }
    }
    if alone {
        let around = band.around(x, y).map(|(x, y)| band.at(x, y));
        doubtful.extend(around.filter(|&at| band.settled_at(at).is_none()));
    }
}
