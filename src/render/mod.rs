//! From a world to a film: tiles over all cores.

use crate::compile::{Scratch, World};
use crate::film::{Film, Pixel};
use crate::options::RenderOptions;
use crate::trace::Tracer;
use rayon::prelude::*;

/// The side of a tile in pixels: small enough to share the work evenly, large enough to keep neighbours together.
const TILE: u32 = 32;

/// A rectangle of pixels: columns and rows from, to (not included).
struct Tile {
    columns: std::ops::Range<u32>,
    rows: std::ops::Range<u32>,
}

/// Draws the world. `progress` is told how many pixels have been finished since it was last told, from any thread.
/// The picture is the same for any number of threads.
#[must_use]
pub fn render(world: &World, options: &RenderOptions, progress: &(dyn Fn(u64) + Sync)) -> Film {
    let tracer = Tracer::new(world, options.quality);
    let tiles = tiles(options);
    let draw = |tile: &Tile| {
        let pixels = draw_tile(&tracer, tile, options);
        progress(pixels.len() as u64);
        pixels
    };
    let drawn: Vec<Vec<Pixel>> = tiles.par_iter().map(draw).collect();
    let mut film = Film::new(
        options.width,
        options.height,
        options.columns.clone(),
        options.rows.clone(),
    );
    for (tile, pixels) in tiles.iter().zip(drawn) {
        let width = (tile.columns.end - tile.columns.start) as usize;
        for (y, row) in tile.rows.clone().zip(pixels.chunks(width)) {
            let start = y as usize * options.width as usize + tile.columns.start as usize;
            film.pixels[start..start + width].copy_from_slice(row);
        }
    }
    film
}

fn tiles(options: &RenderOptions) -> Vec<Tile> {
    let starts = |range: &std::ops::Range<u32>| {
        let range = range.clone();
        range
            .clone()
            .step_by(TILE as usize)
            .map(move |start| start..(start + TILE).min(range.end))
    };
    starts(&options.rows)
        .flat_map(|rows| {
            starts(&options.columns).map(move |columns| Tile {
                columns,
                rows: rows.clone(),
            })
        })
        .collect()
}

fn draw_tile(tracer: &Tracer<'_>, tile: &Tile, options: &RenderOptions) -> Vec<Pixel> {
    let mut scratch = Scratch::default();
    let mut pixels = Vec::with_capacity(TILE as usize * TILE as usize);
    for y in tile.rows.clone() {
        for x in tile.columns.clone() {
            let (x, y) = (f64::from(x), f64::from(y));
            let sample = tracer.pixel(x, y, options.width, options.height, &mut scratch);
            pixels.push(Pixel {
                rgb: sample.rgb,
                transmit: sample.transmit,
            });
        }
    }
    pixels
}
