//! Objects smaller than a pixel or hardly larger, which samples easily miss.
//!
//! The world knows the bounding boxes of all objects, and the camera projects them. A pixel with something tiny in it
//! gets samples for that alone: all other samples are moved out of the rectangle that the object covers, so that they
//! show the pixel without it, and the samples in the rectangle show what it adds. This is exact rather than a guess at
//! hidden features: the mean is the same however the samples are moved.

use super::estimate::{Estimate, estimate};
use super::pixels::{Band, FinishedPixel};
use super::rectangles::{Rectangle, TinyObjects, TinyObjectsOfPixel};
use super::sample::{AdaptiveSample, PixelSampler, SamplerScratch, pixel};
use super::slope::Slopes;
use crate::base::math::Bounds;
use crate::scene::camera::Camera;
use crate::world::{RayCounts, World};
use glam::DVec3;
use rayon::prelude::*;

/// Larger boxes, in pixels, are hit by regular samples.
const WIDEST: f64 = 2.0;
/// Regular samples see enough of objects that cover more of a pixel together.
const MAX_COVERED: f64 = 0.6;
/// Most rectangles in a pixel; the largest are retained.
const MOST: usize = 16;
/// Brightness, in multiples of white, up to which an object is still looked for if it could count.
const BRIGHTEST: f64 = 8.0;
/// Margin around a box, as a share of its size and in pixels: boxes are rounded.
const MARGIN: f64 = 0.01;
const MIN_MARGIN: f64 = 1e-6;
/// Samples in a rectangle: the first batch, and the limit.
const FIRST: u32 = 16;
const MAX_SAMPLES: u32 = 1 << 10;
/// Share of the requested error that a rectangle may have.
const SHARE: f64 = 0.25;

/// A rectangle with its number in its pixel, from 1, which selects its Sobol sequence.
#[derive(Clone, Copy)]
struct NumberedRectangle<'a> {
    number: u32,
    rectangle: &'a Rectangle,
}

impl TinyObjects {
    /// The tiny objects of a world in a picture of this size that can matter for this error.
    pub(super) fn of(world: &World, size: (u32, u32), error: f64) -> TinyObjects {
        let mut tiny_objects = TinyObjects::default();
        if world.lens.is_some() {
            return tiny_objects;
        }
        for bounds in world.boxes() {
            if let Some(projection) = projection(&world.camera, &bounds, size) {
                tiny_objects.add_projection(&projection, size, error);
            }
        }
        tiny_objects.of_pixels.retain(|_, rectangles| {
            unite(rectangles);
            rectangles.sort_by(|a, b| b.area().total_cmp(&a.area()));
            rectangles.truncate(MOST);
            let covered: f64 = rectangles.iter().map(Rectangle::area).sum();
            covered <= MAX_COVERED
        });
        tiny_objects
    }

    /// Splits a rectangle of the picture into the pixels it covers.
    fn add_projection(&mut self, projection: &Rectangle, (width, height): (u32, u32), error: f64) {
        // Pixel centres have integer coordinates.
        let range = |i: usize, end: u32| {
            let first = (projection.from[i] + 0.5)
                .floor()
                .clamp(0.0, f64::from(end));
            let last = (projection.to[i] + 0.5)
                .floor()
                .clamp(-1.0, f64::from(end) - 1.0);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between 0 and the side of the picture"
            )]
            let range = first as u32..(last + 1.0) as u32;
            range
        };
        for y in range(1, height) {
            for x in range(0, width) {
                let corner = [f64::from(x) - 0.5, f64::from(y) - 0.5];
                let rectangle = Rectangle {
                    from: [0, 1].map(|i| (projection.from[i] - corner[i]).clamp(0.0, 1.0)),
                    to: [0, 1].map(|i| (projection.to[i] - corner[i]).clamp(0.0, 1.0)),
                };
                if rectangle.area() * BRIGHTEST > error {
                    self.of_pixels.entry((x, y)).or_default().push(rectangle);
                }
            }
        }
    }

    /// The rectangles of one pixel.
    pub(super) fn of_pixel(&self, pixel: (u32, u32)) -> TinyObjectsOfPixel<'_> {
        // Most pictures have none at all.
        if self.of_pixels.is_empty() {
            return TinyObjectsOfPixel(&[]);
        }
        let rectangles = self.of_pixels.get(&pixel);
        TinyObjectsOfPixel(rectangles.map_or(&[][..], Vec::as_slice))
    }

    /// Adds tiny objects to the finished pixels for which `pixels` has an index. Returns samples and rays.
    pub(super) fn add(
        &self,
        band: &Band<'_>,
        pixels: impl Fn((u32, u32)) -> Option<usize>,
        done: &mut [FinishedPixel],
    ) -> (u64, RayCounts) {
        let mut here: Vec<(usize, (u32, u32))> = self
            .of_pixels
            .keys()
            .filter_map(|&pixel| Some((pixels(pixel)?, pixel)))
            .collect();
        here.sort_unstable();
        let added: Vec<(Added, RayCounts)> = here
            .par_iter()
            .map_init(
                || (SamplerScratch::default(), Vec::new()),
                |(scratch, samples), &(_, pixel)| {
                    let added = self.added(band, pixel, scratch, samples);
                    (added, scratch.take_rays())
                },
            )
            .collect();
        let (mut samples, mut all_rays) = (0, RayCounts::default());
        for (&(at, _), (added, rays)) in here.iter().zip(added) {
            samples += added.samples;
            all_rays += rays;
            let one = &mut done[at];
            let value = one.value;
            let [r, g, b, transmit] = added.mean;
            let sum = [
                f64::from(value.rgb.r) + r,
                f64::from(value.rgb.g) + g,
                f64::from(value.rgb.b) + b,
                f64::from(value.transmit) + transmit,
            ];
            one.value = pixel(sum);
            one.error = one.error.hypot(added.error);
        }
        (samples, all_rays)
    }

    /// The contribution of the tiny objects in a pixel.
    fn added(
        &self,
        band: &Band<'_>,
        at: (u32, u32),
        scratch: &mut SamplerScratch,
        samples: &mut Vec<AdaptiveSample>,
    ) -> Added {
        let mut added = Added::default();
        for (number, rectangle) in (1u32..).zip(self.of_pixel(at).0) {
            let numbered = NumberedRectangle { number, rectangle };
            let mut grid = Vec::new();
            samples.clear();
            let mut taken = 0;
            let estimate = loop {
                let numbers = taken..(2 * taken).max(FIRST);
                taken = numbers.end;
                self.differences(band.sampler, at, numbered, numbers, scratch, samples);
                let estimate = estimate(
                    samples,
                    band.sampler.channels,
                    &Slopes::default(),
                    &mut grid,
                );
                let is_enough = estimate.error <= band.target.error * SHARE;
                if is_enough || taken >= MAX_SAMPLES || band.target.is_over() {
                    break estimate;
                }
            };
            added.samples += 2 * u64::from(taken);
            added.take(&estimate);
        }
        added
    }

    /// Traces the differences between samples in a rectangle and the same samples moved out of it.
    fn differences(
        &self,
        sampler: &PixelSampler<'_>,
        at: (u32, u32),
        NumberedRectangle { number, rectangle }: NumberedRectangle<'_>,
        numbers: std::ops::Range<u32>,
        scratch: &mut SamplerScratch,
        samples: &mut Vec<AdaptiveSample>,
    ) {
        scratch.clear();
        let all = self.of_pixel(at);
        scratch.add_rectangle(at, number, numbers, |share| {
            let point = rectangle.at(share);
            (point, all.moved_out(point))
        });
        let start = samples.len();
        sampler.trace_batch(scratch, samples);
        #[allow(
            clippy::cast_possible_truncation,
            reason = "colours are single precision"
        )]
        let area = rectangle.area() as f32;
        let count = (samples.len() - start) / 2;
        for i in 0..count {
            let (inside, outside) = (samples[start + 2 * i], samples[start + 2 * i + 1]);
            let mut difference = inside;
            for c in 0..4 {
                difference.channels[c] = (inside.channels[c] - outside.channels[c]) * area;
            }
            samples[start + i] = difference;
        }
        samples.truncate(start + count);
    }
}

/// The contribution to a pixel.
#[derive(Default)]
struct Added {
    mean: [f64; 4],
    error: f64,
    samples: u64,
}

impl Added {
    fn take(&mut self, estimate: &Estimate) {
        self.mean = [0, 1, 2, 3].map(|c| self.mean[c] + estimate.mean[c]);
        self.error = self.error.hypot(estimate.error);
    }
}

/// The projected bounding box in the picture, if it is tiny.
fn projection(camera: &Camera, bounds: &Bounds, (width, height): (u32, u32)) -> Option<Rectangle> {
    if !bounds.is_finite() || bounds.is_empty() {
        return None;
    }
    let mut all = Rectangle {
        from: [f64::INFINITY; 2],
        to: [f64::NEG_INFINITY; 2],
    };
    for corner in 0..8 {
        let of = |bit: u32, min: f64, max: f64| if corner >> bit & 1 == 0 { min } else { max };
        let corner = DVec3::new(
            of(0, bounds.min.x, bounds.max.x),
            of(1, bounds.min.y, bounds.max.y),
            of(2, bounds.min.z, bounds.max.z),
        );
        let (x, y) = camera.project(corner, width, height)?;
        all = all.with(&Rectangle {
            from: [x, y],
            to: [x, y],
        });
        let is_small = (0..2).all(|i| all.to[i] - all.from[i] < WIDEST);
        if !is_small {
            return None;
        }
    }
    let margin = [0, 1].map(|i| (all.to[i] - all.from[i]) * MARGIN + MIN_MARGIN);
    Some(Rectangle {
        from: [0, 1].map(|i| all.from[i] - margin[i]),
        to: [0, 1].map(|i| all.to[i] + margin[i]),
    })
}

/// Merges overlapping rectangles.
fn unite(rectangles: &mut Vec<Rectangle>) {
    let mut first = 0;
    while first < rectangles.len() {
        let overlapping =
            (first + 1..rectangles.len()).find(|&i| rectangles[first].overlaps(&rectangles[i]));
        match overlapping {
            Some(other) => {
                let other = rectangles.swap_remove(other);
                rectangles[first] = rectangles[first].with(&other);
                // The larger rectangle may overlap some that the smaller one did not.
                first = 0;
            }
            None => first += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(from: [f64; 2], to: [f64; 2]) -> Rectangle {
        Rectangle { from, to }
    }

    #[test]
    fn overlapping_rectangles_are_merged() {
        let mut all = vec![
            rectangle([0.1, 0.1], [0.2, 0.2]),
            rectangle([0.6, 0.6], [0.7, 0.7]),
            rectangle([0.3, 0.1], [0.4, 0.2]),
            rectangle([0.15, 0.1], [0.35, 0.15]),
        ];
        unite(&mut all);
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(all.contains(&rectangle([0.1, 0.1], [0.4, 0.2])));
    }

    #[test]
    fn points_are_moved_out_but_not_into_another_pixel() {
        let one = rectangle([0.0, 0.4], [0.2, 0.7]);
        assert_eq!(one.moved_out([0.01, 0.5]), [0.01, 0.4]);
        assert_eq!(one.moved_out([0.19, 0.5]), [0.2, 0.5]);
        assert!(!one.holds(one.moved_out([0.19, 0.5])));
    }

    #[test]
    fn a_tiny_object_lies_in_the_pixels_that_see_it() {
        let mut tiny_objects = TinyObjects::default();
        let at_a_corner = rectangle([3.4, 6.3], [3.6, 6.6]);
        tiny_objects.add_projection(&at_a_corner, (10, 8), 1e-4);
        let mut pixels: Vec<_> = tiny_objects.of_pixels.keys().copied().collect();
        pixels.sort_unstable();
        assert_eq!(pixels, [(3, 6), (3, 7), (4, 6), (4, 7)]);
        let area: f64 = tiny_objects
            .of_pixels
            .values()
            .flatten()
            .map(Rectangle::area)
            .sum();
        assert!((area - at_a_corner.area()).abs() < 1e-12);
        let here = tiny_objects.of_pixel((3, 6));
        assert_eq!(here.moved_out([0.2, 0.2]), [0.2, 0.2]);
        assert!(here.moved_out([0.95, 0.95]) != [0.95, 0.95]);
    }
}
