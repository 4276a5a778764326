//! The picture that tiles are put into as they are drawn, in any order and by any thread.

use super::Tile;
use crate::base::film::{Film, Levels, Pixel, Quantizer};
use crate::base::options::RenderOptions;
use crate::render::shade::BlockScratch;
use crate::world::RayCounts;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// A tile as it was drawn, and the rays that it took.
pub(super) type DrawnTile = (Tile, TilePixels, RayCounts);

/// What is kept of the pixels of a tile, row by row.
pub(super) enum TilePixels {
    Light(Vec<Pixel>),
    Levels(Vec<u8>),
}

/// A picture in the making.
pub(super) struct Canvas {
    pub(super) film: Film,
    pub(super) rays: RayCounts,
}

impl Canvas {
    /// An empty one; what is drawn for one format alone is kept as that has it.
    pub(super) fn new(
        options: &RenderOptions,
        leveller: Option<&Quantizer>,
        rays: RayCounts,
    ) -> Self {
        let (width, height) = (options.width, options.height);
        let (columns, rows) = (options.columns.clone(), options.rows.clone());
        let film = match leveller {
            Some(leveller) => {
                Film::of_levels(Levels::black(leveller, width, height), columns, rows)
            }
            None => Film::new(width, height, columns, rows),
        };
        Canvas { film, rays }
    }

    /// Draws tiles, each as soon as a thread is free: one may take as long as a hundred others.
    pub(super) fn draw_all(
        self,
        tiles: &[Tile],
        draw: impl Fn(&mut BlockScratch, &Tile) -> DrawnTile + Sync,
    ) -> Canvas {
        let canvas = Mutex::new(self);
        let idle: Mutex<Vec<BlockScratch>> = Mutex::default();
        tiles.par_iter().with_max_len(1).for_each(|tile| {
            let kept = locked(&idle, Vec::pop);
            let mut scratch = kept.unwrap_or_default();
            let drawn = draw(&mut scratch, tile);
            locked(&canvas, |canvas| canvas.take(drawn));
            locked(&idle, |idle| idle.push(scratch));
        });
        canvas.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// Puts a tile into it.
    pub(super) fn take(&mut self, (tile, kept, rays): DrawnTile) {
        self.rays += rays;
        let film = &mut self.film;
        let width = film.width;
        match (kept, &mut film.levels) {
            (TilePixels::Light(pixels), _) => put(&mut film.pixels, &pixels, &tile, width, 1),
            (TilePixels::Levels(bytes), Some(levels)) => {
                let of_pixel = levels.bytes_of_pixel();
                put(levels.bytes_mut(), &bytes, &tile, width, of_pixel);
            }
            (TilePixels::Levels(_), None) => {}
        }
    }
}

/// What `use_it` says of what is behind a lock; a thread that has failed leaves it whole.
fn locked<T, A>(lock: &Mutex<T>, use_it: impl FnOnce(&mut T) -> A) -> A {
    use_it(&mut lock.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Puts what a tile holds, so many values for each pixel, into a picture of this width.
fn put<T: Copy>(picture: &mut [T], of_tile: &[T], tile: &Tile, width: u32, of_pixel: usize) {
    let length = tile.columns.len() * of_pixel;
    for (y, row) in tile.rows.clone().zip(of_tile.chunks(length.max(1))) {
        let start = (y as usize * width as usize + tile.columns.start as usize) * of_pixel;
        picture[start..start + length].copy_from_slice(row);
    }
}
