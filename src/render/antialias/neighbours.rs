//! Method 1: a pixel that differs from its left or upper neighbour is sampled again on a grid, and so is that neighbour.
//!
//! Comparisons go row by row, and a pixel that has been sampled again takes part in those that follow with the mean of its
//! grid: each decision depends on those before it. Where a grid is not traced yet the centre stands for it, and all
//! decisions are made once more when it is. A difference from such a stand-in makes no pixel wanted: half of these would be
//! traced in vain.

use super::super::Tile;
use super::centres::{Apart, Centres};
use super::{Graded, Place, Sampler, Sum, cell, place};
use crate::base::film::Pixel;
use crate::render::shade::BlockScratch;
use rustc_hash::FxHashMap;

/// The smallest step by which the loop over a grid may miss its last position through rounding.
const GRID_SLACK: f64 = 1e-10;

/// The pixels of a tile. With them come the row above and the column left of it, which they are compared with and which
/// are never sampled again; all are numbered row by row.
pub(super) struct Neighbours<'s, 'a> {
    sampler: &'s Sampler<'a>,
    tile: &'s Tile,
    scratch: &'s mut BlockScratch,
    /// True if each sample is traced as soon as it is asked for.
    in_order: bool,
    /// The place of number 0, with which nothing is compared.
    first: Place,
    width: usize,
    height: usize,
    /// The places of a grid about the centre of its pixel.
    offsets: Vec<Place>,
    centres: Centres,
    /// Tells of each pixel from which of its neighbours' centres its own differs.
    apart: Vec<Apart>,
    /// The means of the grids traced so far.
    grids: FxHashMap<usize, Graded>,
    /// Tells of each pixel, as soon as it is known, whether its centre differs from its left neighbour's grid and from its
    /// upper neighbour's: decisions are made again and again.
    differs: Vec<[Option<bool>; 2]>,
    /// The pixels whose grids are missing.
    wanted: Vec<usize>,
}

/// What a pixel is made of, as far as it is decided.
#[derive(Clone, Copy, PartialEq)]
enum Made {
    /// Its centre, unless it turns out to differ from a neighbour.
    Centre,
    /// Its centre: it is none of the tile's own.
    Border,
    Grid,
    /// A grid that is missing.
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
            tile,
            scratch,
            first: (x - 1.0, y - 1.0),
            width,
            height,
            offsets: offsets(sampler.how.depth),
            centres: Centres::new(width, height),
            apart: vec![[false; 2]; width * height],
            grids: FxHashMap::default(),
            differs: vec![[None; 2]; width * height],
            wanted: Vec::new(),
        }
    }

    /// The tile's own pixels, row by row.
    pub(super) fn pixels(mut self) -> Vec<Pixel> {
        if !self.in_order {
            self.trace_centres();
        }
        loop {
            let made = self.decide();
            if self.wanted.is_empty() {
                return self.finished(&made);
            }
            self.trace_grids();
        }
    }

    /// The tile's own pixels, row by row, all of which are decided.
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

    /// Decides which pixels are sampled again, as far as samples are known; notes which grids are missing.
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
                for (differs, other) in differ.into_iter().zip(neighbours) {
                    if differs {
                        self.finish(other, &mut made);
                        self.finish(at, &mut made);
                    }
                }
            }
        }
        made
    }

    /// Tells whether the centre of a pixel differs from what its neighbour on that side is made of.
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

    /// Takes the mean of its grid for a pixel, if it has been traced.
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

    /// Traces all centres but the first, which nothing is compared with.
    fn trace_centres(&mut self) {
        let Sampler { scale, how, .. } = self.sampler;
        let first = (self.first, false);
        let pixels = self.sampler.lattice(self.tile, first, self.scratch);
        self.centres.put_all(pixels, scale);
        self.apart = self.centres.compare(scale, how.threshold);
    }

    /// Traces one centre.
    fn trace_centre(&mut self, at: usize, has_neighbours: bool) {
        let place = place(self.first, self.point(at));
        let pixels = self.sampler.trace(&[place], true, self.scratch);
        let graded = pixels
            .first()
            .map(|&pixel| self.sampler.scale.graded(pixel));
        let graded = graded.unwrap_or_default();
        self.centres.put_graded(at, graded);
        if has_neighbours {
            self.apart[at] = self.centres.neighbours().map(|before| {
                let other = self.centres.graded(at - before);
                self.sampler.differ(&other, &graded)
            });
        }
    }

    /// Traces the grids that are missing.
    fn trace_grids(&mut self) {
        let mut wanted = std::mem::take(&mut self.wanted);
        wanted.sort_by_key(|&at| {
            let (column, row) = self.point(at);
            cell(column, row)
        });
        let places: Vec<Place> = wanted.iter().flat_map(|&at| self.grid(at)).collect();
        let pixels = self.sampler.trace(&places, self.in_order, self.scratch);
        for (&at, pixels) in wanted.iter().zip(pixels.chunks(self.offsets.len())) {
            let mean = self.mean(at, pixels);
            self.grids.insert(at, mean);
        }
    }

    /// The column and the row of a pixel.
    fn point(&self, at: usize) -> (usize, usize) {
        (at % self.width, at / self.width)
    }

    /// The places of a pixel's grid, row by row.
    fn grid(&self, at: usize) -> impl Iterator<Item = Place> {
        let (x, y) = place(self.first, self.point(at));
        let spread = self.sampler.how.jitter / f64::from(self.sampler.how.depth);
        let places = self
            .offsets
            .iter()
            .map(move |(right, down)| (x + right, y + down));
        places.map(move |place| Sampler::jittered(place, spread))
    }

    /// The mean of a pixel's grid, in which its centre counts as one more sample.
    fn mean(&self, at: usize, samples: &[Pixel]) -> Graded {
        let mut sum = Sum::default();
        sum.add(&self.centres.pixel(at));
        samples.iter().for_each(|pixel| sum.add(pixel));
        let depth = f64::from(self.sampler.how.depth);
        self.sampler.scale.graded(sum.mean(depth * depth + 1.0))
    }
}

/// The places of a grid of `depth` by `depth` about the centre of its pixel, row by row.
fn offsets(depth: u32) -> Vec<Place> {
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
