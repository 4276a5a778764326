//! POV-Ray's methods of antialiasing, sample by sample.
//!
//! All work on tiles of 32 by 32 pixels, which share only the samples at their borders ([`lattice`]). Method 1
//! ([`neighbours`]) traces the centre of each pixel, and supersamples a pixel on a grid where it differs from its left
//! or upper neighbour. Method 2 ([`corners`]) traces the corners of each pixel and divides it as long as they differ.
//! Method 3 ([`repeated`]) takes further samples until the mean is known. (The fact sheet, sections 7 and 15; checked
//! against pictures.)
//!
//! POV-Ray traces a sample when it needs it. Here a method decides as far as the known samples allow and collects the
//! missing ones. These are traced together, in packets, and the method decides again until none is missing. The samples
//! of a pixel and the order of its sums are POV-Ray's in any case. Where tracing one sample affects the next (random
//! numbers from one stream, a growing radiosity cache), each is traced at once, in POV-Ray's order.

mod centres;
mod corners;
mod lattice;
mod neighbours;
mod repeated;

use super::tiles::{TILE, Tile};
use crate::base::color::Gamma;
use crate::base::film::Pixel;
use crate::base::math::jitter;
use crate::base::math::powers::{POWER_ERROR, power};
use crate::base::math::simd::{F64x4, SimdKernel, with_widest};
use crate::base::options::{Antialias, Method, RenderOptions};
use crate::render::shade::{BLOCK, BlockScratch, Sample, Tracer};
use corners::Corners;
use lattice::{Borders, own_points};
use neighbours::Neighbours;
use std::ops::{Range, RangeInclusive};

/// Samples traced in one call.
const BATCH: usize = (BLOCK * BLOCK) as usize;

/// A position in the picture in pixels; pixel centres have integer coordinates.
type Position = (f64, f64);

/// A column and a row of a grid with points one pixel apart.
type Point = (usize, usize);

/// Renders antialiased tiles of one picture.
pub(super) struct Sampler<'a> {
    tracer: &'a Tracer<'a>,
    options: &'a RenderOptions,
    settings: &'a Antialias,
    scale: Scale,
    borders: Borders,
    /// The points of the lattice of a whole tile without its borders.
    whole_tile: Vec<Point>,
}

/// A sample, or a mean of several, with its values on the scale used for comparison.
#[derive(Clone, Copy, Default)]
struct Graded {
    pixel: Pixel,
    /// Estimates of [`Scale::grades`].
    grades: [f64; 4],
}

/// Estimates from here on may stand for infinite grades.
const ENDLESS: f64 = 1e40;
/// Error of the sum of two estimated grades: relative to their sum, and absolute.
const GRADE_CARE: [f64; 2] = [2.0 * POWER_ERROR, 1e-90];

/// The scale for comparing colours: linear light to the power of 1 / `Antialias_Gamma`, and transmit as it is. Values
/// of a picture without gamma handling count as linear light.
struct Scale {
    working: Gamma,
    exponent: f64,
    has_alpha: bool,
}

impl Scale {
    fn new(working: Option<Gamma>, settings: &Antialias, has_alpha: bool) -> Scale {
        let (working, gamma) = match working.unwrap_or(Gamma::LINEAR) {
            Gamma::Power(g) => (Gamma::LINEAR, f64::from(g)),
            curve => (curve, 1.0),
        };
        Scale {
            working,
            exponent: gamma / settings.gamma,
            has_alpha,
        }
    }

    /// The linear red, green and blue to compare, and transmit. Transmit is 0 if the picture stores no transparency:
    /// its background is opaque then, regardless of the scene.
    fn values(&self, Pixel { rgb, transmit }: Pixel) -> [f64; 4] {
        let value = |value: f32| f64::from(self.working.decode(value)).max(0.0);
        let [r, g, b] = [rgb.r, rgb.g, rgb.b].map(value);
        let transmit = if self.has_alpha { transmit } else { 0.0 };
        [r, g, b, f64::from(transmit).max(0.0)]
    }

    /// The grades of a pixel: a power of each colour, and transmit.
    fn grades(&self, pixel: Pixel) -> [f64; 4] {
        let [r, g, b, transmit] = self.values(pixel);
        let [r, g, b] = [r, g, b].map(|value| value.powf(self.exponent));
        [r, g, b, transmit]
    }

    /// Number of compared channels: transmit counts only if the picture stores it.
    fn channels(&self) -> usize {
        if self.has_alpha { 4 } else { 3 }
    }

    /// True if estimated powers may stand for grades.
    fn has_estimates(&self) -> bool {
        /// Single-precision values to these powers are within the bounds of the estimates, and only infinite ones reach
        /// [`ENDLESS`].
        const EXPONENTS: RangeInclusive<f64> = 0.14..=1.0;
        EXPONENTS.contains(&self.exponent)
    }

    fn graded(&self, pixel: Pixel) -> Graded {
        let grades = if self.has_estimates() {
            let values = self.values(pixel);
            let [r, g, b, _] = with_widest(
                #[inline(always)]
                |lanes| lanes.run(Powers(values, self.exponent)),
            );
            [r, g, b, values[3]]
        } else {
            self.grades(pixel)
        };
        Graded { pixel, grades }
    }

    /// True if the grades of two colours differ by a threshold or more.
    fn differ(&self, a: &Graded, b: &Graded, threshold: f64) -> bool {
        let (mut size, mut difference) = (0.0, 0.0);
        for (a, b) in a.grades.into_iter().zip(b.grades) {
            size += a + b;
            difference += (a - b).abs();
        }
        let [share, more] = GRADE_CARE;
        if size < ENDLESS && (difference - threshold).abs() > share * size + more {
            return difference > threshold;
        }
        let (a, b) = (self.grades(a.pixel), self.grades(b.pixel));
        let [r, g, b, transmit] = std::array::from_fn(|i| (a[i] - b[i]).abs());
        r + g + b + transmit >= threshold
    }
}

/// Estimates of powers of four values.
struct Powers([f64; 4], f64);

impl SimdKernel for Powers {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [f64; 4] {
        let Powers(values, exponent) = self;
        power(F::from_array(&values), exponent).to_array()
    }
}

impl<'a> Sampler<'a> {
    pub(super) fn new(
        tracer: &'a Tracer<'a>,
        options: &'a RenderOptions,
        settings: &'a Antialias,
    ) -> Self {
        let working = tracer.world().globals.working_gamma;
        Sampler {
            tracer,
            options,
            settings,
            scale: Scale::new(working, settings, options.alpha),
            borders: Borders::new(options),
            whole_tile: own_points(TILE as usize, TILE as usize),
        }
    }

    /// The pixels of a tile, row by row.
    pub(super) fn tile(&self, tile: &Tile, scratch: &mut BlockScratch) -> Vec<Pixel> {
        match self.settings.method {
            Method::One => Neighbours::new(self, tile, scratch).pixels(),
            Method::Three if self.tracer.world().globals.is_3_8 => {
                repeated::pixels(self, tile, scratch)
            }
            Method::Two | Method::Three => Corners::new(self, tile, scratch).pixels(),
        }
    }

    /// True if two colours differ enough for the pixel to be supersampled.
    fn differ(&self, a: &Graded, b: &Graded) -> bool {
        self.scale.differ(a, b, self.settings.threshold)
    }

    /// Traces samples at positions; neighbours in the list lie near each other. With `in_order` they are traced one by
    /// one.
    fn trace(
        &self,
        positions: &[Position],
        in_order: bool,
        scratch: &mut BlockScratch,
    ) -> Vec<Pixel> {
        let size = (self.options.width, self.options.height);
        let mut pixels = vec![Pixel::default(); positions.len()];
        if in_order {
            let take = |number: usize, sample| pixels[number] = pixel(sample);
            self.tracer.sample_in_order(positions, size, scratch, take);
            return pixels;
        }
        for (positions, pixels) in positions.chunks(BATCH).zip(pixels.chunks_mut(BATCH)) {
            let take = |number: usize, sample, _| pixels[number] = pixel(sample);
            self.tracer.sample_positions(positions, size, scratch, take);
        }
        pixels
    }

    /// A position moved by POV-Ray's jitter of size `spread`.
    fn jittered((x, y): Position, spread: f64) -> Position {
        if spread > 0.0 {
            let (right, down) = jitter(x, y);
            (x + right * spread, y + down * spread)
        } else {
            (x, y)
        }
    }
}

/// The position of a point in a grid that begins at `(x, y)`.
#[allow(
    clippy::cast_precision_loss,
    reason = "a tile has few rows and columns"
)]
fn position((x, y): Position, (column, row): Point) -> Position {
    (x + column as f64, y + row as f64)
}

fn pixel(sample: Sample) -> Pixel {
    Pixel::new(sample.rgb, sample.transmit)
}

/// A sum of colours in single precision, as in POV-Ray.
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

/// The points of a grid by column and row, in the order of [`cell`].
fn cells(width: usize, height: usize) -> impl Iterator<Item = (usize, usize)> {
    let squares = tiles((0..width, 0..height), (16, 16));
    let cells = squares.flat_map(|square| tiles(square, (4, 2)));
    cells.flat_map(|(columns, rows)| {
        rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
    })
}

/// Columns and rows.
type Rectangle = (Range<usize>, Range<usize>);

/// Splits a rectangle into tiles of this size, row by row; tiles at the right and lower edges are cut off.
fn tiles(
    (columns, rows): Rectangle,
    (width, height): (usize, usize),
) -> impl Iterator<Item = Rectangle> {
    let starts = rows.clone().step_by(height).flat_map(move |top| {
        columns
            .clone()
            .step_by(width)
            .map(move |left| (left, top, columns.end))
    });
    starts.map(move |(left, top, right)| {
        (
            left..right.min(left + width),
            top..rows.end.min(top + height),
        )
    })
}

/// Sort key for points that keeps neighbours together: cells of 4 by 2, as in packets, within squares of 16 by 16.
fn cell(column: usize, row: usize) -> [usize; 4] {
    [row / 16, column / 16, row / 2, column / 4]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use crate::base::math::rounding::nearest;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn points_are_in_the_order_of_their_cells() {
        for (width, height) in [(33, 33), (32, 32), (17, 5), (1, 1), (3, 40)] {
            let points = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
            let mut sorted: Vec<(usize, usize)> = points.collect();
            sorted.sort_by_key(|&(column, row)| cell(column, row));
            assert!(cells(width, height).eq(sorted));
        }
    }

    #[test]
    fn estimated_grades_give_the_same_decisions() {
        let mut rng = Random::new(5);
        for exponent in [0.14, 0.4, 0.454, 0.88, 1.0, 3.0] {
            let scale = Scale {
                working: Gamma::LINEAR,
                exponent,
                has_alpha: true,
            };
            for round in 0..20_000 {
                let value = |rng: &mut Random| match round % 16 {
                    0 => f32::INFINITY,
                    1 => 0.0,
                    2 => f32::MAX,
                    _ => nearest(rng.uniform()),
                };
                let [a, b] = [(); 2].map(|()| {
                    let [r, g, b, transmit] = [(); 4].map(|()| value(&mut rng));
                    Pixel::new(Rgb::new(r, g, b), transmit)
                });
                let (x, y) = (scale.grades(a), scale.grades(b));
                let [r, g, b_, transmit] = std::array::from_fn(|i| (x[i] - y[i]).abs());
                let difference = r + g + b_ + transmit;
                let (a, b) = (scale.graded(a), scale.graded(b));
                for threshold in [
                    0.3,
                    difference,
                    difference.next_up(),
                    difference.next_down(),
                ] {
                    let expected = difference >= threshold;
                    assert_eq!(scale.differ(&a, &b, threshold), expected, "{difference}");
                }
            }
        }
    }
}
