//! POV-Ray's two methods of antialiasing, sample by sample.
//!
//! Both work on blocks of 32 by 32 pixels that know nothing of each other. Method 1 traces the centre of each pixel and
//! samples a pixel again, on a grid, where it differs from its left or upper neighbour. Method 2 traces the corners of
//! each pixel and divides it as long as they differ. (The fact sheet, section 7; checked by pictures.)

use super::Tile;
use crate::compile::Scratch;
use crate::film::Pixel;
use crate::math::jitter;
use crate::options::{Antialias, Method, RenderOptions};
use crate::trace::Tracer;
use rustc_hash::FxHashMap;

/// The smallest step by which the loop over a grid may miss its last position through rounding.
const GRID_SLACK: f64 = 1e-10;

/// Draws blocks of one picture with antialiasing.
pub(super) struct Sampler<'a> {
    tracer: &'a Tracer<'a>,
    options: &'a RenderOptions,
    how: &'a Antialias,
}

/// A pixel of method 1.
#[derive(Clone, Copy)]
struct Known {
    value: Pixel,
    /// Whether it is finished: sampled on the grid, or none of this block's.
    is_final: bool,
}

impl<'a> Sampler<'a> {
    pub(super) fn new(
        tracer: &'a Tracer<'a>,
        options: &'a RenderOptions,
        how: &'a Antialias,
    ) -> Self {
        Sampler {
            tracer,
            options,
            how,
        }
    }

    /// The pixels of a block, row by row.
    pub(super) fn block(&self, tile: &Tile, scratch: &mut Scratch) -> Vec<Pixel> {
        match self.how.method {
            Method::One => self.by_neighbours(tile, scratch),
            Method::Two => self.by_corners(tile, scratch),
        }
    }

    fn trace(&self, x: f64, y: f64, scratch: &mut Scratch) -> Pixel {
        let sample = self
            .tracer
            .pixel(x, y, self.options.width, self.options.height, scratch);
        Pixel::new(sample.rgb, sample.transmit)
    }

    /// Whether two colours are so far apart that the pixel deserves more samples.
    fn differ(&self, a: &Pixel, b: &Pixel) -> bool {
        let coded = |v: f32| f64::from(v).max(0.0).powf(1.0 / self.how.gamma);
        let apart = |a: f32, b: f32| (coded(a) - coded(b)).abs();
        let sum = apart(a.rgb.r, b.rgb.r) + apart(a.rgb.g, b.rgb.g) + apart(a.rgb.b, b.rgb.b);
        // Where the picture keeps no transparency the background is opaque, whatever it says.
        let shining_through = match self.options.alpha {
            true => apart(a.transmit, b.transmit),
            false => 0.0,
        };
        sum + shining_through >= self.how.threshold
    }

    /// Method 1. The row above the block and the column left of it are traced too, and are never sampled again.
    fn by_neighbours(&self, tile: &Tile, scratch: &mut Scratch) -> Vec<Pixel> {
        let centre = |x: f64, y: f64, is_final, scratch: &mut Scratch| Known {
            value: self.trace(x, y, scratch),
            is_final,
        };
        let columns: Vec<f64> = tile.columns.clone().map(f64::from).collect();
        let above = f64::from(tile.rows.start) - 1.0;
        let mut row_above: Vec<Known> = columns
            .iter()
            .map(|&x| centre(x, above, true, scratch))
            .collect();
        let mut pixels = Vec::with_capacity(tile.rows.len() * columns.len());
        let mut rows: Vec<Vec<Known>> = Vec::with_capacity(tile.rows.len());
        for y in tile.rows.clone().map(f64::from) {
            let mut left = centre(f64::from(tile.columns.start) - 1.0, y, true, scratch);
            let mut row: Vec<Known> = Vec::with_capacity(columns.len());
            for (i, &x) in columns.iter().enumerate() {
                let mut here = centre(x, y, false, scratch);
                let differs_left = self.differ(&left.value, &here.value);
                let differs_above = self.differ(&row_above[i].value, &here.value);
                if differs_left {
                    if let Some(neighbour) = row.last_mut() {
                        self.finish(neighbour, x - 1.0, y, scratch);
                    }
                    self.finish(&mut here, x, y, scratch);
                }
                if differs_above {
                    self.finish(&mut row_above[i], x, y - 1.0, scratch);
                    self.finish(&mut here, x, y, scratch);
                }
                left = here;
                row.push(here);
            }
            rows.push(std::mem::replace(&mut row_above, row));
        }
        rows.push(row_above);
        // The first of them is the row above the block.
        pixels.extend(rows.iter().skip(1).flatten().map(|known| known.value));
        pixels
    }

    /// Samples a pixel on its grid unless that has been done; the centre counts as one more sample.
    fn finish(&self, pixel: &mut Known, x: f64, y: f64, scratch: &mut Scratch) {
        if pixel.is_final {
            return;
        }
        let depth = f64::from(self.how.depth);
        let step = 1.0 / depth;
        let reach = 0.5 - step / 2.0;
        let spread = self.how.jitter / depth;
        let mut sum = Sum::default();
        sum.add(&pixel.value);
        let mut yy = -reach;
        while yy <= reach + GRID_SLACK {
            let mut xx = -reach;
            while xx <= reach + GRID_SLACK {
                let (jx, jy) = if spread > 0.0 {
                    jitter(x + xx, y + yy)
                } else {
                    (0.0, 0.0)
                };
                sum.add(&self.trace(x + xx + jx * spread, y + yy + jy * spread, scratch));
                xx += step;
            }
            yy += step;
        }
        *pixel = Known {
            value: sum.mean(depth * depth + 1.0),
            is_final: true,
        };
    }

    /// Method 2. Corners are shared by the pixels of the block.
    fn by_corners(&self, tile: &Tile, scratch: &mut Scratch) -> Vec<Pixel> {
        let (left, top) = (
            f64::from(tile.columns.start) - 0.5,
            f64::from(tile.rows.start) - 0.5,
        );
        let wide = tile.columns.len() + 1;
        let mut corners = Vec::with_capacity(wide * (tile.rows.len() + 1));
        for row in (0..=tile.rows.len()).map(count) {
            for column in (0..wide).map(count) {
                corners.push(self.trace(left + column, top + row, scratch));
            }
        }
        let mut pixels = Vec::with_capacity(tile.rows.len() * tile.columns.len());
        for (row, y) in tile.rows.clone().map(f64::from).enumerate() {
            for (column, x) in tile.columns.clone().map(f64::from).enumerate() {
                let at = row * wide + column;
                let square = [
                    corners[at],
                    corners[at + 1],
                    corners[at + wide],
                    corners[at + wide + 1],
                ];
                pixels.push(Division::new(self, x, y).whole(square, scratch));
            }
        }
        pixels
    }
}

/// A pixel of method 2 that is being divided.
struct Division<'a> {
    sampler: &'a Sampler<'a>,
    x: f64,
    y: f64,
    /// Samples by their place on the finest grid of the pixel.
    grid: FxHashMap<(u32, u32), Pixel>,
    /// The spacing of that grid, and the size of the jitter.
    cell: f64,
}

impl<'a> Division<'a> {
    fn new(sampler: &'a Sampler<'a>, x: f64, y: f64) -> Self {
        let cells = f64::from(1u32 << sampler.how.depth);
        Division {
            sampler,
            x,
            y,
            grid: FxHashMap::default(),
            cell: 1.0 / cells,
        }
    }

    fn whole(&mut self, corners: [Pixel; 4], scratch: &mut Scratch) -> Pixel {
        let level = self.sampler.how.depth - 1;
        self.part((1 << level, 1 << level), corners, level, scratch)
    }

    /// The colour of the square about a place of the grid. `corners`: upper left, upper right, lower left, lower right.
    fn part(
        &mut self,
        centre: (u32, u32),
        corners: [Pixel; 4],
        level: u32,
        scratch: &mut Scratch,
    ) -> Pixel {
        let differ = |a: usize, b: usize| self.sampler.differ(&corners[a], &corners[b]);
        let is_rough = level > 0 && (0..4).any(|a| (a + 1..4).any(|b| differ(a, b)));
        let [upper_left, upper_right, lower_left, lower_right] = corners;
        if !is_rough {
            return mean(&corners);
        }
        let (cx, cy) = centre;
        let d = 1u32 << level;
        let left = self.sample(cx - d, cy, scratch);
        let above = self.sample(cx, cy - d, scratch);
        let right = self.sample(cx + d, cy, scratch);
        let below = self.sample(cx, cy + d, scratch);
        let middle = self.sample(cx, cy, scratch);
        let q = d / 2;
        let parts = [
            self.part(
                (cx - q, cy - q),
                [upper_left, above, left, middle],
                level - 1,
                scratch,
            ),
            self.part(
                (cx - q, cy + q),
                [left, middle, lower_left, below],
                level - 1,
                scratch,
            ),
            self.part(
                (cx + q, cy - q),
                [above, upper_right, middle, right],
                level - 1,
                scratch,
            ),
            self.part(
                (cx + q, cy + q),
                [middle, right, below, lower_right],
                level - 1,
                scratch,
            ),
        ];
        mean(&parts)
    }

    fn sample(&mut self, i: u32, j: u32, scratch: &mut Scratch) -> Pixel {
        if let Some(known) = self.grid.get(&(i, j)) {
            return *known;
        }
        let x = self.x - 0.5 + f64::from(i) * self.cell;
        let y = self.y - 0.5 + f64::from(j) * self.cell;
        let spread = self.sampler.how.jitter / (1.0 / self.cell + 1.0);
        let (jx, jy) = if spread > 0.0 {
            jitter(x, y)
        } else {
            (0.0, 0.0)
        };
        let sample = self
            .sampler
            .trace(x + jx * spread, y + jy * spread, scratch);
        self.grid.insert((i, j), sample);
        sample
    }
}

fn mean(of: &[Pixel; 4]) -> Pixel {
    let mut sum = Sum::default();
    of.iter().for_each(|pixel| sum.add(pixel));
    sum.mean(4.0)
}

/// A sum of colours in single precision, as POV-Ray keeps it.
#[derive(Default)]
struct Sum {
    pixel: Pixel,
}

impl Sum {
    fn add(&mut self, other: &Pixel) {
        self.pixel.rgb += other.rgb;
        self.pixel.transmit += other.transmit;
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "colours are single precision"
    )]
    fn mean(&self, count: f64) -> Pixel {
        let transmit = (f64::from(self.pixel.transmit) / count) as f32;
        let rgb = self.pixel.rgb.map(|c| (f64::from(c) / count) as f32);
        Pixel::new(rgb, transmit)
    }
}

#[allow(clippy::cast_precision_loss, reason = "blocks are small")]
fn count(n: usize) -> f64 {
    n as f64
}
