//! Method 2: a pixel is divided into four squares as long as the corners of a square differ; the result is their mean.

use super::super::tiles::Tile;
use super::{Graded, Position, Sampler, Sum, position};
use crate::base::film::Pixel;
use crate::render::shade::BlockScratch;
use rustc_hash::FxHashMap;

/// Samples inside pixels that are stored at a time: as many as a tile divided five times has.
const MAX_INNER: usize = 1 << 20;

/// A point on the finest grid of a pixel: the pixel's index, then column and row.
type Point = (usize, u32, u32);

/// The pixels of a tile, which share their corners.
pub(super) struct Corners<'s, 'a> {
    sampler: &'s Sampler<'a>,
    tile: &'s Tile,
    scratch: &'s mut BlockScratch,
    /// True if each sample is traced as soon as it is needed.
    in_order: bool,
    /// The centre of the upper left pixel.
    first: Position,
    width: usize,
    height: usize,
    /// The samples inside pixels; `None` while they are not traced.
    inner: FxHashMap<Point, Option<Graded>>,
    /// The samples to be traced.
    wanted: Vec<Point>,
}

/// A square of a pixel.
struct Square {
    /// The index of its pixel.
    pixel: usize,
    /// Its middle on the finest grid.
    middle: (u32, u32),
    /// Upper left, upper right, lower left, lower right.
    corners: [Graded; 4],
    /// The remaining number of divisions; half the side on the finest grid is 2 to this power.
    level: u32,
}

impl<'s, 'a> Corners<'s, 'a> {
    pub(super) fn new(
        sampler: &'s Sampler<'a>,
        tile: &'s Tile,
        scratch: &'s mut BlockScratch,
    ) -> Self {
        Corners {
            sampler,
            in_order: scratch.single().order_dependent(),
            tile,
            scratch,
            first: (f64::from(tile.columns.start), f64::from(tile.rows.start)),
            width: tile.columns.len(),
            height: tile.rows.len(),
            inner: FxHashMap::default(),
            wanted: Vec::new(),
        }
    }

    /// The pixels, row by row.
    pub(super) fn pixels(mut self) -> Vec<Pixel> {
        let corners = self.trace_corners();
        let mut pixels = vec![Pixel::default(); self.width * self.height];
        let numbers: Vec<usize> = (0..pixels.len()).collect();
        // Each division quadruples the samples of a pixel.
        let together = (MAX_INNER >> (2 * self.sampler.settings.depth)).max(1);
        for numbers in numbers.chunks(together) {
            let mut open = numbers.to_vec();
            while !open.is_empty() {
                open.retain(|&number| {
                    let pixel = self.mean(&self.whole(number, &corners));
                    pixels[number] = pixel.unwrap_or_default();
                    pixel.is_none()
                });
                self.trace_wanted();
            }
            self.inner.clear();
        }
        pixels
    }

    /// The samples at the corners of all pixels, row by row.
    fn trace_corners(&mut self) -> Vec<Graded> {
        let (x, y) = self.first;
        let first = (x - 0.5, y - 0.5);
        let pixels = if self.in_order {
            let (wide, high) = (self.width + 1, self.height + 1);
            let points = (0..high).flat_map(|row| (0..wide).map(move |column| (column, row)));
            let positions = points.map(|(column, row)| {
                let (x, y) = position(self.first, (column, row));
                (x - 0.5, y - 0.5)
            });
            let positions: Vec<Position> = positions.collect();
            self.sampler.trace(&positions, true, self.scratch)
        } else {
            self.sampler.lattice(self.tile, first, true, self.scratch)
        };
        let graded = pixels
            .into_iter()
            .map(|pixel| self.sampler.scale.graded(pixel));
        graded.collect()
    }

    fn whole(&self, number: usize, corners: &[Graded]) -> Square {
        let wide = self.width + 1;
        let at = number / self.width * wide + number % self.width;
        let level = self.sampler.settings.depth - 1;
        Square {
            pixel: number,
            middle: (1 << level, 1 << level),
            corners: [at, at + 1, at + wide, at + wide + 1].map(|at| corners[at]),
            level,
        }
    }

    /// The mean of a square; `None` if samples are missing, which are added to the wanted ones.
    fn mean(&mut self, square: &Square) -> Option<Pixel> {
        let corners = &square.corners;
        let differ = |a: usize, b: usize| self.sampler.differ(&corners[a], &corners[b]);
        let is_rough = square.level > 0 && (0..4).any(|a| (a + 1..4).any(|b| differ(a, b)));
        if !is_rough {
            return Some(mean(&corners.map(|corner| corner.pixel)));
        }
        let parts = self.divided(square)?;
        let parts = parts.map(|part| self.mean(&part));
        let [Some(a), Some(b), Some(c), Some(d)] = parts else {
            return None;
        };
        Some(mean(&[a, b, c, d]))
    }

    /// The quarters of a square, in POV-Ray's order: the left two first.
    fn divided(&mut self, square: &Square) -> Option<[Square; 4]> {
        let &Square {
            pixel,
            middle: (x, y),
            corners: [upper_left, upper_right, lower_left, lower_right],
            level,
        } = square;
        let d = 1u32 << level;
        let samples = [(x - d, y), (x, y - d), (x + d, y), (x, y + d), (x, y)]
            .map(|(column, row)| self.sample((pixel, column, row)));
        let [
            Some(left),
            Some(above),
            Some(right),
            Some(below),
            Some(middle),
        ] = samples
        else {
            return None;
        };
        let q = d / 2;
        let part = |middle, corners| Square {
            pixel,
            middle,
            corners,
            level: level - 1,
        };
        Some([
            part((x - q, y - q), [upper_left, above, left, middle]),
            part((x - q, y + q), [left, middle, lower_left, below]),
            part((x + q, y - q), [above, upper_right, middle, right]),
            part((x + q, y + q), [middle, right, below, lower_right]),
        ])
    }

    fn sample(&mut self, point: Point) -> Option<Graded> {
        if let Some(&known) = self.inner.get(&point) {
            return known;
        }
        self.inner.insert(point, None);
        self.wanted.push(point);
        if self.in_order {
            self.trace_wanted();
        }
        self.inner[&point]
    }

    /// Traces the wanted samples.
    fn trace_wanted(&mut self) {
        let wanted = std::mem::take(&mut self.wanted);
        let positions: Vec<Position> = wanted.iter().map(|&at| self.inner_position(at)).collect();
        let pixels = self.sampler.trace(&positions, self.in_order, self.scratch);
        for (point, pixel) in wanted.into_iter().zip(pixels) {
            let sample = self.sampler.scale.graded(pixel);
            self.inner.insert(point, Some(sample));
        }
    }

    fn inner_position(&self, (pixel, column, row): Point) -> Position {
        let cells = f64::from(1u32 << self.sampler.settings.depth);
        let cell = 1.0 / cells;
        let (x, y) = position(self.first, (pixel % self.width, pixel / self.width));
        let x = x - 0.5 + f64::from(column) * cell;
        let y = y - 0.5 + f64::from(row) * cell;
        Sampler::jittered((x, y), self.sampler.settings.jitter / (1.0 / cell + 1.0))
    }
}

fn mean(of: &[Pixel; 4]) -> Pixel {
    let mut sum = Sum::default();
    of.iter().for_each(|pixel| sum.add(pixel));
    sum.mean(4.0)
}
