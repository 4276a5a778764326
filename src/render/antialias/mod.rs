//! POV-Ray's two methods of antialiasing, sample by sample.
//!
//! Both work on tiles of 32 by 32 pixels, which share no more than the samples at their borders ([`lattice`]). Method 1
//! ([`neighbours`]) traces the centre of each pixel and samples a pixel again, on a grid, where it differs from its left
//! or upper neighbour. Method 2 ([`corners`]) traces the corners of each pixel and divides it as long as they differ. (The
//! fact sheet, section 7; checked by pictures.)
//!
//! POV-Ray traces a sample when it needs it. Here a method asks for its samples and decides as far as those known allow;
//! all that are missing are traced together, in packets, and the method decides anew until none is missing. Which samples
//! a pixel is made of and the order of its sums are POV-Ray's in any case. Where tracing one sample changes the next
//! (random numbers in one stream, a growing radiosity cache), each is traced at once, in POV-Ray's order.

mod centres;
mod corners;
mod lattice;
mod neighbours;

use super::{TILE, Tile};
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

/// A place in the picture in pixels; whole numbers are centres of pixels.
type Place = (f64, f64);

/// A column and a row of a grid whose points lie one pixel apart.
type Point = (usize, usize);

/// Draws tiles of one picture with antialiasing.
pub(super) struct Sampler<'a> {
    tracer: &'a Tracer<'a>,
    options: &'a RenderOptions,
    how: &'a Antialias,
    scale: Scale,
    borders: Borders,
    /// The points of the lattice of a whole tile that are none of its borders.
    whole_tile: Vec<Point>,
}

/// A sample, or a mean of several, with its values on the scale on which they are compared.
#[derive(Clone, Copy, Default)]
struct Graded {
    pixel: Pixel,
    /// Nearly those of [`Scale::grades`].
    grades: [f64; 4],
}

/// Estimates from here on may stand for endless grades.
const ENDLESS: f64 = 1e40;
/// What two estimates of a grade may be off together, as a share of their sum and at all.
const GRADE_CARE: [f64; 2] = [2.0 * POWER_ERROR, 1e-90];

/// The scale on which colours are compared: linear light to the power of 1 / `Antialias_Gamma`, and transmit as it is. A
/// picture without gamma handling has its values taken for linear light.
struct Scale {
    working: Gamma,
    exponent: f64,
    has_alpha: bool,
}

impl Scale {
    fn new(working: Option<Gamma>, how: &Antialias, has_alpha: bool) -> Scale {
        let (working, gamma) = match working.unwrap_or(Gamma::LINEAR) {
            Gamma::Power(g) => (Gamma::LINEAR, f64::from(g)),
            Gamma::Srgb => (Gamma::Srgb, 1.0),
        };
        Scale {
            working,
            exponent: gamma / how.gamma,
            has_alpha,
        }
    }

    /// The linear red, green and blue that are compared, and transmit; this last one 0 where the picture keeps no
    /// transparency. The background is opaque then, whatever it says.
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

    /// Number of channels compared: transmit counts only where the picture keeps it.
    fn channels(&self) -> usize {
        if self.has_alpha { 4 } else { 3 }
    }

    /// True if estimates of the powers may stand for grades.
    fn has_estimates(&self) -> bool {
        /// Single precision numbers to such a power are in the bounds of estimates, and only endless ones reach [`ENDLESS`].
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

    /// Tells whether the grades of two colours differ by a threshold or more.
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
        how: &'a Antialias,
    ) -> Self {
        let working = tracer.world().globals.working_gamma;
        Sampler {
            tracer,
            options,
            how,
            scale: Scale::new(working, how, options.alpha),
            borders: Borders::new(options),
            whole_tile: own_points(TILE as usize, TILE as usize),
        }
    }

    /// The pixels of a tile, row by row.
    pub(super) fn tile(&self, tile: &Tile, scratch: &mut BlockScratch) -> Vec<Pixel> {
        match self.how.method {
            Method::One => Neighbours::new(self, tile, scratch).pixels(),
            Method::Two => Corners::new(self, tile, scratch).pixels(),
        }
    }

    /// Tells whether two colours are so far apart that the pixel deserves more samples.
    fn differ(&self, a: &Graded, b: &Graded) -> bool {
        self.scale.differ(a, b, self.how.threshold)
    }

    /// Samples at places of which neighbours in the list lie near each other; `in_order` one after the other.
    fn trace(&self, places: &[Place], in_order: bool, scratch: &mut BlockScratch) -> Vec<Pixel> {
        let size @ (width, height) = (self.options.width, self.options.height);
        if in_order {
            let samples = places.iter().map(|&(x, y)| {
                let single = scratch.single();
                self.tracer.pixel(x, y, width, height, single)
            });
            return samples.map(pixel).collect();
        }
        let mut pixels = vec![Pixel::default(); places.len()];
        for (places, pixels) in places.chunks(BATCH).zip(pixels.chunks_mut(BATCH)) {
            let take = |number: usize, sample, _| pixels[number] = pixel(sample);
            self.tracer.places(places, size, scratch, take);
        }
        pixels
    }

    /// A place moved by POV-Ray's jitter, of which `spread` is the size.
    fn jittered((x, y): Place, spread: f64) -> Place {
        if spread > 0.0 {
            let (right, down) = jitter(x, y);
            (x + right * spread, y + down * spread)
        } else {
            (x, y)
        }
    }
}

/// The place of a point of a grid that begins at `first`.
#[allow(
    clippy::cast_precision_loss,
    reason = "a tile has few rows and columns"
)]
fn place((x, y): Place, (column, row): Point) -> Place {
    (x + column as f64, y + row as f64)
}

fn pixel(sample: Sample) -> Pixel {
    Pixel::new(sample.rgb, sample.transmit)
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

/// The tiles of this size of a rectangle, row by row, those at its right and lower edges cut off there.
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

/// The key of an order of points that keeps neighbours together: in cells of 4 by 2 in squares of 16 by 16, which
/// packets are made of.
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
    fn estimates_of_grades_decide_as_the_grades_themselves() {
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
                    _ => nearest(rng.share()),
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
