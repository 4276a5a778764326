//! Method 1: a pixel that differs from its left or upper neighbour is supersampled on a grid, and so is that neighbour.
//!
//! Comparisons go row by row, and a supersampled pixel takes part in later ones with the mean of its grid: each
//! decision depends on those before it. While a grid is not traced yet the centre stands for it, and all decisions are
//! repeated once it is. A difference from such a stand-in does not request a grid: half of these would be traced in
//! vain.

use super::super::tiles::Tile;
use super::centres::{Apart, Centres};
use super::{Graded, Position, Sampler, Sum, cell, cells, pixel, position};
use crate::base::film::Pixel;
use crate::render::shade::{Ahead, BlockScratch};
use rustc_hash::FxHashMap;

/// Tolerance for rounding at the last position of the loop over a grid.
const GRID_SLACK: f64 = 1e-10;

/// The pixels of a tile in row-major order, with the row above and the column left of it, which are only compared with
/// and never supersampled.
pub(super) struct Neighbours<'s, 'a> {
    sampler: &'s Sampler<'a>,
    tile: &'s Tile,
    scratch: &'s mut BlockScratch,
    /// True if each sample is traced as soon as it is needed.
    in_order: bool,
    /// In that case the centres of the pixels, and the index of each pixel among these.
    ahead: Ahead,
    numbers: Vec<usize>,
    /// The position of pixel 0, with which nothing is compared.
    first: Position,
    width: usize,
    height: usize,
    /// The positions of a grid about the centre of its pixel.
    offsets: Vec<Position>,
    centres: Centres,
    /// For each pixel, the neighbours whose centres differ from its own.
    apart: Vec<Apart>,
    /// The means of the grids traced so far.
    grids: FxHashMap<usize, Graded>,
    /// For each pixel, once known: true if its centre differs from its left neighbour's grid, and from its upper
    /// neighbour's. Cached because decisions are repeated.
    differs: Vec<[Option<bool>; 2]>,
    /// The pixels with missing grids.
    wanted: Vec<usize>,
}

/// The source of a pixel's value, as far as it is decided.
#[derive(Clone, Copy, PartialEq)]
enum Made {
    /// Its centre, unless it turns out to differ from a neighbour.
    Centre,
    /// Its centre: it belongs to a neighbouring tile.
    Border,
    Grid,
    /// A grid that is not traced yet.
    Nothing,
}

impl<'s, 'a> Neighbours<'s, 'a> {
    pub(super) fn new(
        sampler: &'s Sampler<'a>,
        tile: &'s Tile,
        scratch: &'s mut BlockScratch,
    ) -> Self {
        let (width, height) = (tile.columns.len() + 1, tile.rows.len() + 1);
        let [x, y] = [tile.columns.start, tile.rows.start].map(f64::from);
        Neighbours {
            sampler,
            in_order: scratch.single().order_dependent(),
            ahead: Ahead::default(),
            numbers: Vec::new(),
            tile,
            scratch,
            first: (x - 1.0, y - 1.0),
            width,
            height,
            offsets: offsets(sampler.settings.depth),
            centres: Centres::new(width, height),
            apart: vec![[false; 2]; width * height],
            grids: FxHashMap::default(),
            differs: vec![[None; 2]; width * height],
            wanted: Vec::new(),
        }
    }

    /// The tile's own pixels, row by row.
    pub(super) fn pixels(mut self) -> Vec<Pixel> {
        match self.in_order {
            true => self.look_at_centres(),
            false => self.trace_centres(),
        }
        loop {
            let made = self.decide();
            if self.wanted.is_empty() {
                return self.finished(&made);
            }
            self.trace_grids();
        }
    }

    /// The tile's own pixels, row by row, once all are decided.
    fn finished(self, made: &[Made]) -> Vec<Pixel> {
        let mut pixels = self.centres.into_pixels();
        for (&at, grid) in &self.grids {
            if made[at] == Made::Grid {
                pixels[at] = grid.pixel;
            }
        }
        let mut own = Vec::with_capacity(pixels.len());
        for row in pixels.chunks(self.width).skip(1) {
            own.extend_from_slice(&row[1..]);
        }
        own
    }

    /// Decides which pixels are supersampled, as far as samples are known, and collects the missing grids.
    fn decide(&mut self) -> Vec<Made> {
        let width = self.width;
        let mut made = vec![Made::Centre; self.centres.len()];
        made[..width].fill(Made::Border);
        let is_centre = |made: &Made| matches!(made, Made::Centre | Made::Border);
        for row in 0..self.height {
            let start = row * width;
            made[start] = Made::Border;
            let above = row.checked_sub(1).map(|above| above * width);
            if !self.in_order {
                let apart = self.apart[start..start + width].as_flattened();
                let differs_not = !apart.contains(&true);
                if above.is_none_or(|above| differs_not && made[above..start].iter().all(is_centre))
                {
                    continue;
                }
            }
            for at in start..start + width {
                let has_neighbours = row > 0 && at > start;
                if self.in_order && at > 0 {
                    self.trace_centre(at, has_neighbours);
                }
                if !has_neighbours {
                    continue;
                }
                let neighbours = [at - 1, at - width];
                let are_centres = neighbours.into_iter().all(|at| is_centre(&made[at]));
                if self.apart[at] == [false; 2] && are_centres {
                    continue;
                }
                let differ = [0, 1].map(|side| self.differs(at, side, neighbours[side], &made));
                // Both neighbours before the pixel itself, as POV-Ray traces them (measured with radiosity).
                for (differs, other) in differ.into_iter().zip(neighbours) {
                    if differs {
                        self.finish(other, &mut made);
                    }
                }
                if differ.contains(&true) {
                    self.finish(at, &mut made);
                }
            }
        }
        made
    }

    /// True if the centre of a pixel differs from the value of its neighbour on that side.
    fn differs(&mut self, at: usize, side: usize, other: usize, made: &[Made]) -> bool {
        match made[other] {
            Made::Nothing => false,
            Made::Centre | Made::Border => self.apart[at][side],
            Made::Grid => *self.differs[at][side].get_or_insert_with(|| {
                let grid = self.grids.get(&other).copied().unwrap_or_default();
                self.sampler.differ(&grid, &self.centres.graded(at))
            }),
        }
    }

    /// Uses the mean of its grid for a pixel, if it has been traced.
    fn finish(&mut self, at: usize, made: &mut [Made]) {
        if made[at] != Made::Centre {
            return;
        }
        if !self.grids.contains_key(&at) {
            self.wanted.push(at);
            if self.in_order {
                self.trace_grids();
            }
        }
        made[at] = match self.grids.contains_key(&at) {
            true => Made::Grid,
            false => Made::Nothing,
        };
    }

    /// Traces all centres but the first, with which nothing is compared.
    fn trace_centres(&mut self) {
        let Sampler {
            scale, settings, ..
        } = self.sampler;
        let pixels = self
            .sampler
            .lattice(self.tile, self.first, false, self.scratch);
        self.centres.put_all(pixels, scale);
        self.apart = self.centres.compare(scale, settings.threshold);
    }

    /// Prepares the centres that [`Self::trace_centre`] traces.
    fn look_at_centres(&mut self) {
        let points = cells(self.width, self.height).filter(|&point| point != (0, 0));
        self.numbers = vec![0; self.centres.len()];
        let mut positions = Vec::with_capacity(self.centres.len());
        for (column, row) in points {
            self.numbers[row * self.width + column] = positions.len();
            positions.push(position(self.first, (column, row)));
        }
        let Sampler {
            tracer, options, ..
        } = self.sampler;
        let size = (options.width, options.height);
        tracer.look_ahead(&positions, size, &mut self.ahead, self.scratch);
    }

    /// Traces one centre.
    fn trace_centre(&mut self, at: usize, has_neighbours: bool) {
        let Sampler {
            tracer, options, ..
        } = self.sampler;
        let (number, position) = (self.numbers[at], position(self.first, self.point(at)));
        let size = (options.width, options.height);
        let single = self.scratch.single();
        let sample = tracer.sample_ahead(&self.ahead, number, position, size, single);
        let graded = self.sampler.scale.graded(pixel(sample));
        self.centres.put_graded(at, graded);
        if has_neighbours {
            self.apart[at] = self.centres.neighbours().map(|before| {
                let other = self.centres.graded(at - before);
                self.sampler.differ(&other, &graded)
            });
        }
    }

    /// Traces the missing grids.
    fn trace_grids(&mut self) {
        let mut wanted = std::mem::take(&mut self.wanted);
        wanted.sort_by_key(|&at| {
            let (column, row) = self.point(at);
            cell(column, row)
        });
        let positions: Vec<Position> = wanted.iter().flat_map(|&at| self.grid(at)).collect();
        let pixels = self.sampler.trace(&positions, self.in_order, self.scratch);
        for (&at, pixels) in wanted.iter().zip(pixels.chunks(self.offsets.len())) {
            let mean = self.mean(at, pixels);
            self.grids.insert(at, mean);
        }
    }

    /// The column and the row of a pixel.
    fn point(&self, at: usize) -> (usize, usize) {
        (at % self.width, at / self.width)
    }

    /// The positions of a pixel's grid, row by row.
    fn grid(&self, at: usize) -> impl Iterator<Item = Position> {
        let (x, y) = position(self.first, self.point(at));
        let spread = self.sampler.settings.jitter / f64::from(self.sampler.settings.depth);
        let positions = self
            .offsets
            .iter()
            .map(move |(right, down)| (x + right, y + down));
        positions.map(move |position| Sampler::jittered(position, spread))
    }

    /// The mean of a pixel's grid, in which its centre counts as one more sample.
    fn mean(&self, at: usize, samples: &[Pixel]) -> Graded {
        let mut sum = Sum::default();
        sum.add(&self.centres.pixel(at));
        samples.iter().for_each(|pixel| sum.add(pixel));
        let depth = f64::from(self.sampler.settings.depth);
        self.sampler.scale.graded(sum.mean(depth * depth + 1.0))
    }
}

/// The positions of a grid of `depth` by `depth` about the centre of its pixel, row by row.
fn offsets(depth: u32) -> Vec<Position> {
    let step = 1.0 / f64::from(depth);
    let reach = 0.5 - step / 2.0;
    let steps = || {
        std::iter::successors(Some(-reach), move |at| Some(at + step))
            .take_while(move |&at| at <= reach + GRID_SLACK)
    };
    steps()
        .flat_map(|down| steps().map(move |right| (right, down)))
        .collect()
}
