//! The samples of a pixel, and the sampler that traces them.

use super::rectangles::TinyObjects;
use crate::base::film::Pixel;
use crate::base::math::sampling::sobol::Sobol;
use crate::render::shade::{BLOCK, BlockScratch, Tracer};
use crate::world::RayCounts;
use std::ops::Range;

/// Most samples traced together.
pub(super) const TOGETHER: usize = (BLOCK * BLOCK) as usize;
/// The surface of samples that hit none or an unknown one.
const NO_SURFACE: u32 = u32::MAX;
/// Normals with a smaller dot product are on two sides of an edge: they are 37 degrees apart.
const SAME_SIDE: f32 = 0.8;

/// One sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct AdaptiveSample {
    /// Red, green, blue, and the transmittance to the background.
    pub(super) channels: [f32; 4],
    /// Position in the pixel, in units of 2^-16 of its side.
    pub(super) position: (u16, u16),
    /// The first surface hit, and its normal.
    pub(super) leaf: u32,
    normal: [f32; 3],
}

impl AdaptiveSample {
    /// A placeholder.
    pub(super) const NONE: AdaptiveSample = AdaptiveSample {
        channels: [0.0; 4],
        position: (0, 0),
        leaf: NO_SURFACE,
        normal: [0.0; 3],
    };

    /// True if both hit the same side of the same surface.
    #[inline]
    pub(super) fn is_same_side(&self, other: &AdaptiveSample) -> bool {
        if self.leaf != other.leaf || self.leaf == NO_SURFACE {
            return self.leaf == other.leaf;
        }
        let (a, b) = (self.normal, other.normal);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] >= SAME_SIDE
    }

    /// Position in the pixel, as shares of its side.
    pub(super) fn share(&self) -> [f64; 2] {
        let (x, y) = self.position;
        [x, y].map(|v| (f64::from(v) + 0.5) / 65536.0)
    }

    /// A sample on the surface with this number.
    #[cfg(test)]
    pub(super) fn on_side(leaf: u32) -> AdaptiveSample {
        AdaptiveSample {
            leaf,
            normal: [0.0, 1.0, 0.0],
            ..AdaptiveSample::NONE
        }
    }

    #[cfg(test)]
    pub(super) fn of(sobol: Sobol, number: u32, value: f32) -> AdaptiveSample {
        AdaptiveSample {
            channels: [value; 4],
            position: position(sobol.point(number)),
            ..AdaptiveSample::NONE
        }
    }
}

/// The pixel with a mean of samples as its colour.
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision"
)]
pub(super) fn pixel(mean: [f64; 4]) -> Pixel {
    let [r, g, b, transmit] = mean.map(|c| c as f32);
    Pixel::new(crate::base::color::Rgb::new(r, g, b), transmit)
}

/// Traces samples of a picture.
pub(super) struct PixelSampler<'a> {
    pub(super) tracer: &'a Tracer<'a>,
    /// Width and height of the picture.
    pub(super) size: (u32, u32),
    /// The number of channels that count.
    pub(super) channels: usize,
    /// Objects too small for regular samples.
    pub(super) tiny_objects: &'a TinyObjects,
}

/// Buffers of a thread.
#[derive(Default)]
pub(super) struct SamplerScratch {
    block: BlockScratch,
    positions: Vec<(f64, f64)>,
    cells: Vec<(u16, u16)>,
}

impl SamplerScratch {
    /// Returns the rays traced since the last call, and resets them.
    pub(super) fn take_rays(&mut self) -> RayCounts {
        self.block.take_rays()
    }

    /// Clears the batch.
    pub(super) fn clear(&mut self) {
        self.positions.clear();
        self.cells.clear();
    }

    /// The number of samples in the batch.
    pub(super) fn len(&self) -> usize {
        self.positions.len()
    }

    /// Adds points of a pixel's Sobol sequence to the batch.
    pub(super) fn add_sequence(
        &mut self,
        (x, y): (u32, u32),
        numbers: Range<u32>,
        tiny_objects: &TinyObjects,
    ) {
        let sobol = Sobol::of_pixel(x.cast_signed(), y.cast_signed());
        let share = |v: u32| (f64::from(v) + 0.5) / 2f64.powi(32);
        let tiny_objects = tiny_objects.of_pixel((x, y));
        for number in numbers {
            let point = sobol.point(number);
            let [dx, dy] = tiny_objects.moved_out([share(point.0), share(point.1)]);
            self.positions
                .push((f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5));
            self.cells.push(position(point));
        }
    }

    /// Adds pairs of points from the own sequence of a rectangle in a pixel: `to_pair` maps each point to a pair.
    pub(super) fn add_rectangle(
        &mut self,
        (x, y): (u32, u32),
        rectangle: u32,
        numbers: Range<u32>,
        to_pair: impl Fn([f64; 2]) -> ([f64; 2], [f64; 2]),
    ) {
        // Pictures have fewer than 2^16 pixels on a side: no pixel has this sequence.
        let sobol = Sobol::of_pixel(x.cast_signed(), (y | rectangle << 24).cast_signed());
        let share = |v: u32| (f64::from(v) + 0.5) / 2f64.powi(32);
        for number in numbers {
            let point = sobol.point(number);
            let both = to_pair([share(point.0), share(point.1)]);
            for [dx, dy] in [both.0, both.1] {
                let position = (f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5);
                self.positions.push(position);
                self.cells.push(self::position(point));
            }
        }
    }

    /// Adds points of a pixel, given as shares of its side.
    pub(super) fn add_points(
        &mut self,
        (x, y): (u32, u32),
        shares: &[[f64; 2]],
        tiny_objects: &TinyObjects,
    ) {
        let tiny_objects = tiny_objects.of_pixel((x, y));
        for &share in shares {
            let [dx, dy] = tiny_objects.moved_out(share);
            let position = (f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5);
            self.positions.push(position);
            self.cells.push((0, 0));
        }
    }
}

impl PixelSampler<'_> {
    /// Traces the samples of some pixels with these numbers, pixel by pixel.
    pub(super) fn trace_sequence(
        &self,
        pixels: impl Iterator<Item = (u32, u32)>,
        numbers: Range<u32>,
        scratch: &mut SamplerScratch,
        samples: &mut Vec<AdaptiveSample>,
    ) {
        scratch.clear();
        for pixel in pixels {
            scratch.add_sequence(pixel, numbers.clone(), self.tiny_objects);
        }
        self.trace_batch(scratch, samples);
    }

    /// Traces the batch.
    pub(super) fn trace_batch(
        &self,
        scratch: &mut SamplerScratch,
        samples: &mut Vec<AdaptiveSample>,
    ) {
        let start = samples.len();
        samples.resize(start + scratch.positions.len(), AdaptiveSample::NONE);
        let chunks = scratch.positions.chunks(TOGETHER);
        for (first, positions) in (start..).step_by(TOGETHER).zip(chunks) {
            self.tracer.sample_positions(
                positions,
                self.size,
                &mut scratch.block,
                |number, seen, hit| {
                    let (leaf, normal) = hit.map_or((NO_SURFACE, [0.0; 3]), |hit| {
                        (hit.leaf, hit.normal.as_vec3().to_array())
                    });
                    samples[first + number] = AdaptiveSample {
                        channels: [seen.rgb.r, seen.rgb.g, seen.rgb.b, seen.transmit],
                        position: scratch.cells[first - start + number],
                        leaf,
                        normal,
                    };
                },
            );
        }
    }
}

#[allow(clippy::cast_possible_truncation, reason = "sixteen bits are left")]
fn position((x, y): (u32, u32)) -> (u16, u16) {
    ((x >> 16) as u16, (y >> 16) as u16)
}

/// A sample and its point in pixels.
pub(crate) type PointSample = ([f64; 2], AdaptiveSample);
