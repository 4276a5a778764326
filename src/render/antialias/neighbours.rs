//! Method 1: a pixel that differs from its left or upper neighbour is sampled again on a grid, and so is that neighbour.
//!
//! Comparisons go row by row, and a pixel that has been sampled again takes part in those that follow with the mean of its
//! grid: each decision depends on those before it. Where a grid is not traced yet the centre stands for it, and all
//! decisions are made once more when it is. A difference from such a stand-in makes no pixel wanted: half of these would be
//! traced in vain.

use super::super::Tile;
use super::{Graded, Place, Sampler, Sum, cell, cells};
use crate::film::Pixel;
use crate::trace::BlockScratch;

/// The smallest step by which the loop over a grid may miss its last position through rounding.
const GRID_SLACK: f64 = 1e-10;

/// The pixels of a tile. With them come the row above and the column left of it, which they are compared with and which
/// are never sampled again; all are numbered row by row.
pub(super) struct Neighbours<'s, 'a> {
    sampler: &'s Sampler<'a>,
    scratch: &'s mut BlockScratch,
    /// True if each sample is traced as soon as it is asked for.
    in_order: bool,
    /// The place of number 0, with which nothing is compared.
    first: Place,
    width: usize,
    height: usize,
    /// The places of a grid about the centre of its pixel.
    offsets: Vec<Place>,
    centres: Vec<Option<Graded>>,
    /// The means of the grids traced so far.
    grids: Vec<Option<Graded>>,
    /// Tells for each pixel, as soon as it is known, whether its centre differs from its left neighbour's centre and grid
    /// and from its upper neighbour's: decisions are made again and again.
    differs: Vec<[Option<bool>; 4]>,
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
        tile: &Tile,
        scratch: &'s mut BlockScratch,
    ) -> Self {
        let (width, height) = (tile.columns.len() + 1, tile.rows.len() + 1);
        let [x, y] = [tile.columns.start, tile.rows.start].map(f64::from);
        Neighbours {
            sampler,
            in_order: scratch.single().minds_order(),
            scratch,
            first: (x - 1.0, y - 1.0),
            width,
            height,
            offsets: offsets(sampler.how.depth),
            centres: vec![None; width * height],
            grids: vec![None; width * height],
            differs: vec![[None; 4]; width * height],
            wanted: Vec::new(),
        }
    }

    /// The tile's own pixels, row by row.
    pub(super) fn pixels(mut self) -> Vec<Pixel> {
        if !self.in_order {
            let numbers = cells(self.width, self.height);
            self.trace_centres(&numbers[1..]);
        }
        loop {
            let made = self.decide();
            if self.wanted.is_empty() {
                let rows = (1..self.height).map(|row| row * self.width);
                let own = rows.flat_map(|start| start + 1..start + self.width);
                return own.map(|at| self.pixel(at, made[at])).collect();
            }
            self.trace_grids();
        }
    }

    fn pixel(&self, at: usize, made: Made) -> Pixel {
        let values = if made == Made::Grid {
            &self.grids
        } else {
            &self.centres
        };
        values[at].unwrap_or_default().pixel
    }

    /// Decides which pixels are sampled again, as far as samples are known; notes which grids are missing.
    fn decide(&mut self) -> Vec<Made> {
        let mut made = vec![Made::Border; self.centres.len()];
        for row in 0..self.height {
            for column in 0..self.width {
                let at = row * self.width + column;
                if at > 0 && self.centres[at].is_none() {
                    self.trace_centres(&[at]);
                }
                if column == 0 || row == 0 {
                    continue;
                }
                made[at] = Made::Centre;
                let neighbours = [at - 1, at - self.width];
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
        let (values, kind) = match made[other] {
            Made::Nothing => return false,
            Made::Grid => (&self.grids, 1),
            Made::Centre | Made::Border => (&self.centres, 0),
        };
        let sampler = self.sampler;
        *self.differs[at][2 * side + kind].get_or_insert_with(|| {
            let [a, b] = [values[other], self.centres[at]].map(Option::unwrap_or_default);
            sampler.differ(&a, &b)
        })
    }

    /// Takes the mean of its grid for a pixel, if it has been traced.
    fn finish(&mut self, at: usize, made: &mut [Made]) {
        if made[at] != Made::Centre {
            return;
        }
        if self.grids[at].is_none() {
            self.wanted.push(at);
            if self.in_order {
                self.trace_grids();
            }
        }
        made[at] = match self.grids[at] {
            Some(_) => Made::Grid,
            None => Made::Nothing,
        };
    }

    fn trace_centres(&mut self, numbers: &[usize]) {
        let places: Vec<Place> = numbers.iter().map(|&at| self.place(at)).collect();
        let pixels = self.sampler.trace(&places, self.in_order, self.scratch);
        for (&at, pixel) in numbers.iter().zip(pixels) {
            self.centres[at] = Some(self.sampler.scale.graded(pixel));
        }
    }

    /// Traces the grids that are missing.
    fn trace_grids(&mut self) {
        let mut wanted = std::mem::take(&mut self.wanted);
        wanted.sort_by_key(|&at| cell(at % self.width, at / self.width));
        let places: Vec<Place> = wanted.iter().flat_map(|&at| self.grid(at)).collect();
        let pixels = self.sampler.trace(&places, self.in_order, self.scratch);
        for (&at, pixels) in wanted.iter().zip(pixels.chunks(self.offsets.len())) {
            self.grids[at] = Some(self.mean(at, pixels));
        }
    }

    #[allow(
        clippy::cast_precision_loss,
        reason = "a tile has few rows and columns"
    )]
    fn place(&self, at: usize) -> Place {
        let (x, y) = self.first;
        (x + (at % self.width) as f64, y + (at / self.width) as f64)
    }

    /// The places of a pixel's grid, row by row.
    fn grid(&self, at: usize) -> impl Iterator<Item = Place> {
        let (x, y) = self.place(at);
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
        let centre = self.centres[at].iter().map(|centre| &centre.pixel);
        centre.chain(samples).for_each(|pixel| sum.add(pixel));
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
