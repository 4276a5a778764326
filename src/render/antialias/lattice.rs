//! The samples that a method starts from, and those of them that tiles share.
//!
//! They lie on a lattice one pixel apart, one column and one row more than the tile has pixels. Its first column is the
//! last one of the tile on the left, and its first row the last one of the tile above. A tile leaves its last column and
//! row for those neighbours, and traces what they have not left: on several threads they may still be at work.

use super::super::{TILE, Tile};
use super::{Place, Point, Sampler, cells, place};
use crate::base::film::Pixel;
use crate::base::options::RenderOptions;
use crate::render::shade::BlockScratch;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// The side of a tile on which a neighbour lies.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Side {
    Left,
    Above,
}

/// Last columns and rows of lattices that the tiles on the right and below have not taken. Those of tiles whose neighbours
/// began before them, or need not be drawn, stay: a byte a pixel at the most.
pub(super) struct Borders {
    columns: Range<u32>,
    rows: Range<u32>,
    /// By the first pixel of the tile that is to take them, and its side.
    kept: Mutex<FxHashMap<(u32, u32, Side), Vec<Pixel>>>,
}

impl Borders {
    /// No borders yet of the tiles of a picture.
    pub(super) fn new(options: &RenderOptions) -> Borders {
        Borders {
            columns: options.columns.clone(),
            rows: options.rows.clone(),
            kept: Mutex::default(),
        }
    }

    /// True if the picture has a tile on that side of a tile.
    fn has_neighbour(&self, tile: &Tile, side: Side) -> bool {
        match side {
            Side::Left => tile.columns.start > self.columns.start,
            Side::Above => tile.rows.start > self.rows.start,
        }
    }

    /// The border of a tile on that side, if its neighbour has left it.
    fn take(&self, tile: &Tile, side: Side) -> Option<Vec<Pixel>> {
        let key = (tile.columns.start, tile.rows.start, side);
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.remove(&key)
    }

    /// Leaves the last column and the last row of a tile's lattice for its neighbours.
    fn leave(&self, tile: &Tile, lattice: &[Pixel]) {
        let width = tile.columns.len() + 1;
        let (columns, rows) = (&tile.columns, &tile.rows);
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if columns.end < self.columns.end {
            let last = lattice.iter().skip(width - 1).step_by(width);
            let key = (columns.end, rows.start, Side::Left);
            kept.insert(key, last.copied().collect());
        }
        if rows.end < self.rows.end {
            let last = &lattice[lattice.len() - width..];
            let key = (columns.start, rows.end, Side::Above);
            kept.insert(key, last.to_vec());
        }
    }
}

impl Sampler<'_> {
    /// The samples of a tile's lattice, row by row; `first` is the place of the first one, which is left out if nothing
    /// is compared with it. Rays of borders count as those of the neighbour that owns them, whoever traces them.
    pub(super) fn lattice(
        &self,
        tile: &Tile,
        first: (Place, bool),
        scratch: &mut BlockScratch,
    ) -> Vec<Pixel> {
        let (first, has_first) = first;
        let (width, height) = (tile.columns.len() + 1, tile.rows.len() + 1);
        let mut lattice = vec![Pixel::default(); width * height];
        let mut trace = |points: &[Point], scratch: &mut BlockScratch| {
            let places: Vec<Place> = points.iter().map(|&at| place(first, at)).collect();
            let pixels = self.trace(&places, false, scratch);
            for (&(column, row), pixel) in points.iter().zip(pixels) {
                lattice[row * width + column] = pixel;
            }
        };
        let whole = TILE as usize + 1;
        match (width, height) == (whole, whole) {
            true => trace(&self.whole_tile, scratch),
            false => trace(&own_points(width - 1, height - 1), scratch),
        }
        // Radiosity depends on the samples traced before.
        let shares = scratch.single().radiosity.is_none();
        let mut borders = Vec::new();
        for side in [Side::Above, Side::Left] {
            let points: Vec<Point> = match side {
                Side::Above => (usize::from(!has_first)..width).map(|at| (at, 0)).collect(),
                Side::Left => (1..height).map(|at| (0, at)).collect(),
            };
            let is_owned = shares && self.borders.has_neighbour(tile, side);
            match self.borders.take(tile, side).filter(|_| is_owned) {
                Some(border) => borders.push((points, border)),
                None => {
                    let rays = scratch.single().rays;
                    trace(&points, scratch);
                    if is_owned {
                        scratch.single().rays = rays;
                    }
                }
            }
        }
        for (points, border) in borders {
            for (column, row) in points {
                lattice[row * width + column] = border[column.max(row)];
            }
        }
        if shares {
            self.borders.leave(tile, &lattice);
        }
        lattice
    }
}

/// The points of a lattice that are none of its borders, for a tile of this size, neighbours together.
pub(super) fn own_points(width: usize, height: usize) -> Vec<Point> {
    let points = cells(width, height);
    points.map(|(column, row)| (column + 1, row + 1)).collect()
}
