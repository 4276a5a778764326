//! The radiosity pretrace: passes with few rays first, then more and more, so that samples lie everywhere before they
//! are used. Block by block and ray by ray in POV-Ray's order, on one thread, since each sample depends on those before
//! it.

use super::tiles::{TILE, tiles_of};
use crate::base::math::sampling::mersenne;
use crate::base::options::RenderOptions;
use crate::render::radiosity::Session;
use crate::render::shade::Scratch;
use crate::render::shade::Tracer;
use std::ops::Range;

/// Rounding must not add a pass.
const SLACK: f64 = 1e-10;
/// Differences of the random seeds between passes and between blocks.
const OF_PASS: u32 = 17;
const OF_BLOCK: u32 = 13;
/// The number of random numbers for jittering.
const NUMBERS: u32 = 2047;
/// A pass with this many rays in a block tells if the block needs indirect light.
const TELLING_RAYS: u32 = 9;
/// Upper limit of the passes, however small the last spacing.
const MAX_PASSES: u32 = 64;

/// The spacings of the rays of each pass, in pixels. None if the last would be much larger than the first; POV-Ray then
/// counts below zero and makes a great many passes.
fn spacings(options: &RenderOptions, start: f64, end: f64) -> impl Iterator<Item = f64> + use<> {
    let size = f64::from(options.width.max(options.height));
    let (start, end) = (start * size, (end * size).max(1.0));
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and is not negative"
    )]
    let steps = ((start / end).log2() + 2.0 - SLACK).floor().max(0.0) as u32;
    (0..steps.min(MAX_PASSES)).map(move |pass| (start / f64::from(pass).exp2()).max(end))
}

/// Random numbers from -1 to 1 that jitter rays.
struct Jitter {
    last: u32,
}

impl Jitter {
    fn of_block(pass: u32, block: u32) -> Self {
        let last = (pass + 1) * OF_PASS;
        Jitter {
            last: last.wrapping_add(block.wrapping_mul(OF_BLOCK)) % NUMBERS,
        }
    }

    fn next_number(&mut self) -> f64 {
        self.last = (self.last + 1) % NUMBERS;
        2.0 * mersenne::random(self.last) - 1.0
    }
}

/// The positions of a grid of this spacing in a range.
fn positions(range: &Range<u32>, spacing: f64) -> impl Iterator<Item = f64> + use<> {
    let (first, end) = (f64::from(range.start), f64::from(range.end));
    let start = ((first - 0.5) / spacing).ceil() * spacing;
    let all = std::iter::successors(Some(start), move |at| Some(at + spacing));
    all.skip_while(move |&at| at < first)
        .take_while(move |&at| at < end)
}

/// Makes the samples of a picture. A block in which a pass of enough rays needs no indirect light is left out of later
/// passes, as in POV-Ray (measured by the samples that it saves, with 4 to 9 rays in a block).
pub(super) fn pretrace(tracer: &Tracer<'_>, options: &RenderOptions, scratch: &mut Scratch) {
    let Some(radiosity) = tracer.radiosity() else {
        return;
    };
    let settings = &radiosity.settings;
    let whole = RenderOptions {
        columns: 0..options.width,
        rows: 0..options.height,
        ..options.clone()
    };
    let tiles = tiles_of(&whole, TILE);
    let spacings = spacings(options, settings.pretrace_start, settings.pretrace_end);
    // Rays of version 3.8 lie half a pixel further to the left and up (measured by the samples that it saves).
    let shift = match tracer.world().globals.is_3_8 {
        true => 0.5,
        false => 0.0,
    };
    let mut is_lit = vec![true; tiles.len()];
    for (pass, spacing) in (0..).zip(spacings) {
        for ((block, tile), is_lit) in (0..).zip(&tiles).zip(&mut is_lit) {
            if !*is_lit {
                continue;
            }
            let mut jitter = Jitter::of_block(pass, block);
            let amount = (0.5 * spacing).min(1.0);
            let middle = 0.5 * (spacing - 1.0) - shift;
            let mut rays = 0;
            for y in positions(&tile.rows, spacing) {
                for x in positions(&tile.columns, spacing) {
                    let down = amount * jitter.next_number();
                    let right = amount * jitter.next_number();
                    let (x, y) = (x + middle + right, y + middle + down);
                    let _ = tracer.pixel(x, y, options.width, options.height, scratch);
                    rays += 1;
                }
            }
            let session = scratch.radiosity.as_deref_mut();
            *is_lit = session.is_some_and(Session::take_was_queried) || rays < TELLING_RAYS;
            if options.stop.is_cancelled() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(width: u32, start: f64, end: f64) -> Vec<f64> {
        let options = RenderOptions {
            width,
            height: width / 2,
            ..RenderOptions::default()
        };
        spacings(&options, start, end).collect()
    }

    /// Numbers of passes as POV-Ray 3.7 reports them.
    #[test]
    fn passes_halve_the_spacing_down_to_the_last() {
        assert_eq!(of(160, 0.08, 0.04), [12.8, 6.4]);
        assert_eq!(of(160, 0.08, 0.03), [12.8, 6.4, 4.8]);
        assert_eq!(of(160, 1.0, 1.0), [160.0]);
        assert_eq!(of(8, 0.08, 0.04), [1.0]);
        assert!(of(4, 0.08, 0.04).is_empty());
        assert!(of(160, 0.01, 1.0).is_empty());
    }

    #[test]
    fn positions_in_a_block_lie_on_a_grid_of_the_picture() {
        let of = |range: Range<u32>| positions(&range, 12.8).collect::<Vec<_>>();
        assert_eq!(of(0..32), [0.0, 12.8, 25.6]);
        let next = of(32..64);
        assert_eq!(next.len(), 2);
        assert!((next[0] - 38.4).abs() < 1e-9 && (next[1] - 51.2).abs() < 1e-9);
    }

    #[test]
    fn jitter_starts_after_the_seed_of_pass_and_block() {
        let mut jitter = Jitter::of_block(1, 2);
        assert_eq!(
            jitter.next_number(),
            2.0 * mersenne::random(2 * 17 + 2 * 13 + 1) - 1.0
        );
    }
}
