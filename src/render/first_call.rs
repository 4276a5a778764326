//! The first call of `f_ridged_mf` in a picture, which sets the octave weights of all.

use super::shade::{BlockScratch, Tracer};
use super::tiles::{TILE, tiles_of};
use crate::base::options::RenderOptions;
use std::sync::Arc;

/// Traces pixels of the whole picture in POV-Ray's order until a call is evaluated, if the picture depends on it. Where
/// none is, each call has weights of its own.
pub(super) fn find(tracer: &Tracer<'_>, options: &RenderOptions) {
    let calls = &tracer.world().globals.ridged_calls;
    // Functions that are only declared no longer exist.
    let is_used = Arc::strong_count(calls) > 1;
    if !is_used || !calls.is_open() {
        return;
    }
    let (width, height) = (options.width, options.height);
    let whole = RenderOptions {
        columns: 0..width,
        rows: 0..height,
        ..options.clone()
    };
    let mut scratch = BlockScratch::default();
    for tile in tiles_of(&whole, TILE) {
        for y in tile.rows.clone().map(f64::from) {
            for x in tile.columns.clone().map(f64::from) {
                if !calls.is_open() || options.stop.is_cancelled() {
                    return;
                }
                let _ = tracer.pixel(x, y, width, height, scratch.single());
            }
        }
    }
    calls.close();
}
