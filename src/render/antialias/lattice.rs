//! The initial samples of a method, and the ones that tiles share.
//!
//! They lie on a lattice one pixel apart, with one column and one row more than the tile has pixels. Its first column
//! is the last one of the tile on the left, and its first row the last one of the tile above. A tile leaves its last
//! column and row for these neighbours, and traces itself any border that is not there yet: neighbours may still be in
//! progress on other threads.

use super::super::tiles::{TILE, Tile};
use super::{Point, Position, Sampler, cells, position};
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

/// Last columns and rows of lattices that the tiles on the right and below have not taken yet. Some stay, of tiles
/// whose neighbours began before them or need not be rendered: a byte a pixel at the most.
pub(super) struct Borders {
    columns: Range<u32>,
    rows: Range<u32>,
    /// Keyed by the first pixel of the tile that will take them, and its side.
    pending: Mutex<FxHashMap<(u32, u32, Side), Vec<Pixel>>>,
}

impl Borders {
    /// Starts without borders.
    pub(super) fn new(options: &RenderOptions) -> Borders {
        Borders {
            columns: options.columns.clone(),
            rows: options.rows.clone(),
            pending: Mutex::default(),
        }
    }

    /// True if the picture has a tile on that side of this tile.
    fn has_neighbour(&self, tile: &Tile, side: Side) -> bool {
        match side {
            Side::Left => tile.columns.start > self.columns.start,
            Side::Above => tile.rows.start > self.rows.start,
        }
    }

    /// Takes the border on that side of a tile, if the neighbour has left it.
    fn take(&self, tile: &Tile, side: Side) -> Option<Vec<Pixel>> {
        let key = (tile.columns.start, tile.rows.start, side);
        let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
        pending.remove(&key)
    }

    /// Leaves the last column and the last row of a tile's lattice for its neighbours.
    fn leave(&self, tile: &Tile, lattice: &[Pixel]) {
        let width = tile.columns.len() + 1;
        let (columns, rows) = (&tile.columns, &tile.rows);
        let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
        if columns.end < self.columns.end {
            let last = lattice.iter().skip(width - 1).step_by(width);
            let key = (columns.end, rows.start, Side::Left);
            pending.insert(key, last.copied().collect());
        }
        if rows.end < self.rows.end {
            let last = &lattice[lattice.len() - width..];
            let key = (columns.start, rows.end, Side::Above);
            pending.insert(key, last.to_vec());
        }
    }
}

impl Sampler<'_> {
    /// The samples of a tile's lattice, row by row. `first` is the position of the first sample, which is left out
    /// without `has_first`, because nothing is compared with it. Rays of borders are counted for the neighbour that
    /// owns them, whoever traces them.
    pub(super) fn lattice(
        &self,
        tile: &Tile,
        first: Position,
        has_first: bool,
        scratch: &mut BlockScratch,
    ) -> Vec<Pixel> {
        let (width, height) = (tile.columns.len() + 1, tile.rows.len() + 1);
        let mut lattice = vec![Pixel::default(); width * height];
        let mut trace = |points: &[Point], scratch: &mut BlockScratch| {
            let positions: Vec<Position> = points.iter().map(|&at| position(first, at)).collect();
            let pixels = self.trace(&positions, false, scratch);
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
                    let rays = scratch.single().query.rays;
                    trace(&points, scratch);
                    if is_owned {
                        scratch.single().query.rays = rays;
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

/// The points of a lattice without its borders, for a tile of this size, neighbours together.
pub(super) fn own_points(width: usize, height: usize) -> Vec<Point> {
    let points = cells(width, height);
    points.map(|(column, row)| (column + 1, row + 1)).collect()
}
