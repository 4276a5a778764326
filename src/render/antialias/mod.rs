//! POV-Ray's two methods of antialiasing, sample by sample.
//!
//! Both work on tiles of 32 by 32 pixels that know nothing of each other. Method 1 ([`neighbours`]) traces the centre of
//! each pixel and samples a pixel again, on a grid, where it differs from its left or upper neighbour. Method 2
//! ([`corners`]) traces the corners of each pixel and divides it as long as they differ. (The fact sheet, section 7;
//! checked by pictures.)
//!
//! POV-Ray traces a sample when it needs it. Here a method asks for its samples and decides as far as those known allow;
//! all that are missing are traced together, in packets, and the method decides anew until none is missing. Which samples
//! a pixel is made of and the order of its sums are POV-Ray's in any case. Where tracing one sample changes the next
//! (random numbers in one stream, a growing radiosity cache), each is traced at once, in POV-Ray's order.

mod corners;
mod neighbours;

use super::Tile;
use crate::color::Gamma;
use crate::film::Pixel;
use crate::math::jitter;
use crate::options::{Antialias, Method, RenderOptions};
use crate::trace::{BLOCK, BlockScratch, Sample, Tracer};
use corners::Corners;
use neighbours::Neighbours;

/// Samples traced in one call.
const BATCH: usize = (BLOCK * BLOCK) as usize;

/// A place in the picture in pixels; whole numbers are centres of pixels.
type Place = (f64, f64);

/// Draws tiles of one picture with antialiasing.
pub(super) struct Sampler<'a> {
    tracer: &'a Tracer<'a>,
    options: &'a RenderOptions,
    how: &'a Antialias,
    scale: Scale,
}

/// A sample, or a mean of several, with its values on the scale on which they are compared.
#[derive(Clone, Copy, Default)]
struct Graded {
    pixel: Pixel,
    /// Red, green, blue and transmit; this last one 0 where the picture keeps no transparency.
    grades: [f64; 4],
}

/// The scale on which colours are compared: linear light to the power of 1 / `Antialias_Gamma`. A picture without gamma
/// handling has its values taken for linear light.
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

    fn grade(&self, value: f32) -> f64 {
        f64::from(self.working.decode(value))
            .max(0.0)
            .powf(self.exponent)
    }

    fn graded(&self, pixel: Pixel) -> Graded {
        let Pixel { rgb, transmit } = pixel;
        let transmit = match self.has_alpha {
            true => self.grade(transmit),
            // The background is opaque then, whatever it says.
            false => 0.0,
        };
        let [r, g, b] = [rgb.r, rgb.g, rgb.b].map(|value| self.grade(value));
        let grades = [r, g, b, transmit];
        Graded { pixel, grades }
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
        let [r, g, b, transmit] = std::array::from_fn(|i| (a.grades[i] - b.grades[i]).abs());
        r + g + b + transmit >= self.how.threshold
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

/// The points of a grid, numbered row by row, in an order that keeps neighbours together.
fn cells(width: usize, height: usize) -> impl Iterator<Item = usize> {
    let mut numbers: Vec<usize> = (0..width * height).collect();
    numbers.sort_by_key(|&at| cell(at % width, at / width));
    numbers.into_iter()
}

/// The key by which points are sorted so that neighbours stay together: in cells of 4 by 2 in squares of 16 by 16, which
/// packets are made of.
fn cell(column: usize, row: usize) -> [usize; 4] {
    [row / 16, column / 16, row / 2, column / 4]
}
