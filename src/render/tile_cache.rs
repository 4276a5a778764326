//! The finished tiles of a picture, cached to draw it again after some surfaces have got other textures.
//!
//! A tile is stored with the primitives that its rays have hit. If none of these has changed, and shadows have not either,
//! the tile is still the same: pixels depend on nothing else of the surfaces, as long as no tile depends on another one
//! (as with radiosity or one stream of random numbers) and there are no photons. With antialiasing, tiles share the
//! samples on their borders, which any of the two may have traced. So a tile is drawn again with its neighbours then.

use super::tiles::{Pixels, Tile, tile_side};
use crate::base::options::{RenderOptions, Sampling};
use crate::base::sync::lock;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;
use std::sync::{Arc, Mutex};

/// The finished tiles of a picture.
#[derive(Debug)]
pub struct TileCache {
    /// The pixels of the picture that are drawn.
    columns: Range<u32>,
    rows: Range<u32>,
    /// The side of a tile.
    side: u32,
    /// True if tiles share samples on their borders.
    shares_borders: bool,
    /// By the column and the row of their first pixels.
    tiles: Mutex<FxHashMap<[u32; 2], Arc<CachedTile>>>,
}

/// A finished tile.
#[derive(Debug)]
pub(super) struct CachedTile {
    pub(super) pixels: Pixels,
    /// The primitives that its rays hit, ascending.
    leaves: Vec<u32>,
}

impl TileCache {
    /// None yet of a picture with these options.
    #[must_use]
    pub fn new(options: &RenderOptions) -> Self {
        TileCache {
            columns: options.columns.clone(),
            rows: options.rows.clone(),
            side: tile_side(options),
            shares_borders: !matches!(options.sampling, Sampling::Centres),
            tiles: Mutex::default(),
        }
    }

    /// Forgets the tiles that depend on the textures of these primitives, in ascending order.
    pub fn forget(&self, leaves: &[u32]) {
        let mut tiles = lock(&self.tiles);
        let is_hit = |tile: &CachedTile| {
            let mut leaves = leaves.iter();
            leaves.any(|leaf| tile.leaves.binary_search(leaf).is_ok())
        };
        tiles.retain(|_, tile| !is_hit(tile));
        if self.shares_borders {
            let left: FxHashSet<[u32; 2]> = tiles.keys().copied().collect();
            tiles.retain(|&at, _| self.neighbours(at).all(|other| left.contains(&other)));
        }
    }

    /// Forgets all tiles.
    pub fn forget_all(&self) {
        lock(&self.tiles).clear();
    }

    /// Number of tiles.
    #[must_use]
    pub fn count(&self) -> usize {
        lock(&self.tiles).len()
    }

    /// True if seven of eight tiles are there.
    #[must_use]
    pub fn are_most(&self) -> bool {
        let tiles = |range: &Range<u32>| range.len().div_ceil(self.side as usize);
        8 * self.count() >= 7 * tiles(&self.columns) * tiles(&self.rows)
    }

    /// Number of columns that are drawn.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.columns.end - self.columns.start
    }

    /// The tile that begins where this one does.
    pub(super) fn tile(&self, tile: &Tile) -> Option<Arc<CachedTile>> {
        let key = [tile.columns.start, tile.rows.start];
        lock(&self.tiles).get(&key).cloned()
    }

    /// Adds a finished tile.
    pub(super) fn add(&self, tile: &Tile, pixels: Pixels, leaves: Vec<u32>) {
        let key = [tile.columns.start, tile.rows.start];
        let cached = CachedTile { pixels, leaves };
        lock(&self.tiles).insert(key, Arc::new(cached));
    }

    /// The tiles around one, as far as they are drawn.
    fn neighbours(&self, [column, row]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let side = self.side;
        let around = move |at: u32, range: &Range<u32>| {
            // At the edges of what is drawn tiles are cut off.
            let start = at / side * side;
            let starts = [
                start.checked_sub(side),
                Some(start),
                start.checked_add(side),
            ];
            let (first, end) = (range.start, range.end);
            let cut = move |start: u32| {
                let is_drawn = start < end && start + side > first;
                is_drawn.then_some(start.max(first))
            };
            starts
                .into_iter()
                .flatten()
                .filter_map(cut)
                .collect::<Vec<_>>()
        };
        let rows = around(row, &self.rows);
        let columns = around(column, &self.columns);
        let all = rows
            .into_iter()
            .flat_map(move |row| columns.clone().into_iter().map(move |column| [column, row]));
        all.filter(move |&other| other != [column, row])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::film::Pixel;
    use crate::base::options::Antialias;
    use crate::render::tiles::{TILE, tiles_of};
    use crate::world::RayCounts;

    /// The tiles that are left of a picture of 5 by 3, each of which hits the primitive of its number, in rows.
    fn left(options: &RenderOptions, forgotten: &[u32]) -> Vec<u32> {
        let cache = TileCache::new(options);
        let tiles = tiles_of(options, tile_side(options));
        for (number, tile) in (0..).zip(&tiles) {
            let pixels = (vec![Pixel::default()], RayCounts::default());
            cache.add(tile, pixels, vec![number, 100]);
        }
        cache.forget(forgotten);
        let is_left = |(number, tile): (u32, &Tile)| cache.tile(tile).map(|_| number);
        (0..).zip(&tiles).filter_map(is_left).collect()
    }

    #[test]
    fn tiles_that_hit_a_primitive_are_forgotten_with_antialiasing_also_their_neighbours() {
        let mut options = RenderOptions::of_size(5 * TILE - 7, 3 * TILE - 1);
        assert_eq!(left(&options, &[6, 7, 50]).len(), 13);
        assert!(left(&options, &[3, 100]).is_empty());
        options.sampling = Sampling::PovRay(Antialias::default());
        assert_eq!(left(&options, &[]).len(), 15);
        assert_eq!(left(&options, &[6]), [3, 4, 8, 9, 13, 14]);
        assert_eq!(left(&options, &[0]).len(), 11);
    }
}
