//! The picture that tiles are put into as they are rendered, in any order and by any thread.

use super::photon_pass::PhotonPass;
use super::shade::BlockScratch;
use crate::base::film::{Film, Levels, Pixel, Quantizer};
use crate::base::options::{
    AdaptiveOutcome, Event, EventHandler, RadiosityStatistics, RenderOptions, Sampling,
};
use crate::world::RayCounts;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Pixels of a tile, row by row, and the rays traced for them.
pub(super) type Pixels = (Vec<Pixel>, RayCounts);

/// A rendered tile, and the rays traced for it.
pub(super) struct DrawnTile {
    pub(super) tile: Tile,
    pub(super) pixels: TilePixels,
    pub(super) rays: RayCounts,
}

/// The pixels of a tile, row by row: colours, or quantised for one file format.
pub(super) enum TilePixels {
    Light(Vec<Pixel>),
    Levels(Vec<u8>),
}

/// A picture in progress.
pub(super) struct Canvas {
    pub(super) film: Film,
    pub(super) rays: RayCounts,
}

impl DrawnTile {
    /// Sends the colours of the tile.
    pub(super) fn report(&self, listen: &EventHandler<'_>) {
        if let TilePixels::Light(pixels) = &self.pixels {
            let Tile { columns, rows } = &self.tile;
            listen(Event::Tile {
                columns,
                rows,
                pixels,
            });
        }
    }
}

impl Canvas {
    /// An empty canvas; with a quantizer it stores quantised pixels.
    pub(super) fn new(
        options: &RenderOptions,
        quantizer: Option<&Quantizer>,
        rays: RayCounts,
    ) -> Self {
        let (width, height) = (options.width, options.height);
        let (columns, rows) = (options.columns.clone(), options.rows.clone());
        let film = match quantizer {
            Some(quantizer) => {
                Film::of_levels(Levels::black(quantizer, width, height), columns, rows)
            }
            None => Film::new(width, height, columns, rows),
        };
        Canvas { film, rays }
    }

    /// Renders tiles, each as soon as a thread is free: one may take as long as a hundred others.
    pub(super) fn draw_all(
        self,
        tiles: &[Tile],
        draw: impl Fn(&mut BlockScratch, &Tile) -> DrawnTile + Sync,
    ) -> Canvas {
        let canvas = Mutex::new(self);
        let idle: Mutex<Vec<BlockScratch>> = Mutex::default();
        tiles.par_iter().with_max_len(1).for_each(|tile| {
            let reused = locked(&idle, Vec::pop);
            let mut scratch = reused.unwrap_or_default();
            let drawn = draw(&mut scratch, tile);
            locked(&canvas, |canvas| canvas.take(drawn));
            locked(&idle, |idle| idle.push(scratch));
        });
        canvas.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// Copies a tile into the picture.
    pub(super) fn take(&mut self, drawn: DrawnTile) {
        let DrawnTile { tile, pixels, rays } = drawn;
        self.rays += rays;
        let film = &mut self.film;
        let width = film.width;
        match (pixels, &mut film.levels) {
            (TilePixels::Light(colors), _) => put(&mut film.pixels, &colors, &tile, width, 1),
            (TilePixels::Levels(bytes), Some(levels)) => {
                let of_pixel = levels.bytes_per_pixel();
                put(levels.bytes_mut(), &bytes, &tile, width, of_pixel);
            }
            (TilePixels::Levels(_), None) => {}
        }
    }
}

/// Runs a closure on locked data; a thread that panics leaves it valid.
fn locked<T, A>(lock: &Mutex<T>, use_it: impl FnOnce(&mut T) -> A) -> A {
    use_it(&mut lock.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Copies the values of a tile, `of_pixel` for each pixel, into a picture of this width.
fn put<T: Copy>(picture: &mut [T], of_tile: &[T], tile: &Tile, width: u32, of_pixel: usize) {
    let length = tile.columns.len() * of_pixel;
    for (y, row) in tile.rows.clone().zip(of_tile.chunks(length.max(1))) {
        let start = (y as usize * width as usize + tile.columns.start as usize) * of_pixel;
        picture[start..start + length].copy_from_slice(row);
    }
}

/// The side of a tile in pixels: small enough to share the work evenly, large enough to keep neighbours together.
pub(super) const TILE: u32 = 32;

/// The least side of a tile: smaller ones would hold fewer rays than a packet takes together.
const SMALLEST_TILE: u32 = 8;

/// The number of tiles of a small picture: with a dozen a few threads have as much to do.
const ENOUGH_TILES: u32 = 12;

/// With radiosity, the least number of tiles rendered before they are put into the film.
pub(super) const MIN_AT_ONCE: usize = 128;

/// The same for each thread: threads wait for the last one at the end of each turn.
pub(super) const TILES_OF_THREAD: usize = 32;

/// A rectangle of pixels: half-open ranges of columns and rows.
#[derive(PartialEq, Eq)]
pub(super) struct Tile {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
}

/// A rendered world.
#[derive(Debug)]
pub struct Drawn {
    /// The picture.
    pub film: Film,
    /// The rays traced.
    pub rays: RayCounts,
    /// The error reached with adaptive sampling.
    pub reached: Option<AdaptiveOutcome>,
    /// Radiosity statistics, with radiosity.
    pub radiosity: Option<RadiosityStatistics>,
    /// The photons, if the scene uses photon mapping.
    pub photons: Option<PhotonPass>,
}

/// The side of the tiles of a picture whose pixels do not depend on the order of tracing: smaller ones for a small picture
/// without antialiasing, such as the preview of a live scene.
pub(super) fn tile_side(options: &RenderOptions) -> u32 {
    let is_enough =
        |side: u32| options.width.div_ceil(side) * options.height.div_ceil(side) >= ENOUGH_TILES;
    let mut side = TILE;
    while matches!(options.sampling, Sampling::Centres) && side > SMALLEST_TILE && !is_enough(side)
    {
        side /= 2;
    }
    side
}

/// The tiles of this side that contain the requested pixels. They lie on a grid of the whole picture, so that a crop is
/// rendered with the same blocks as the whole.
pub(super) fn tiles_of(options: &RenderOptions, side: u32) -> Vec<Tile> {
    let starts = |range: &Range<u32>, length: u32| {
        let (first, end) = (range.start / side * side, range.end);
        (first..end)
            .step_by(side as usize)
            .map(move |start| start..(start + side).min(length))
    };
    if options.columns.is_empty() || options.rows.is_empty() {
        return Vec::new();
    }
    starts(&options.rows, options.height)
        .flat_map(|rows| {
            starts(&options.columns, options.width).map(move |columns| Tile {
                columns,
                rows: rows.clone(),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::options::Antialias;

    #[test]
    fn small_pictures_without_antialiasing_have_small_tiles() {
        let sides = [(640, 480), (160, 120), (80, 60), (40, 30), (4, 3)];
        let sides = sides.map(|(width, height)| tile_side(&RenderOptions::of_size(width, height)));
        assert_eq!(sides, [32, 32, 16, 8, 8]);
        let antialiased = RenderOptions {
            sampling: Sampling::PovRay(Antialias::default()),
            ..RenderOptions::of_size(40, 30)
        };
        assert_eq!(tile_side(&antialiased), 32);
    }
}
