//! POV-Ray's own noise: the differences between renderings with the blocks in different orders.
//!
//! With one thread POV-Ray renders the same picture every time. But where it jitters (area lights, media, radiosity)
//! the picture depends on one stream of random numbers that runs through all blocks. In a rendering with the blocks in
//! another order (`Render_Pattern`, `+RP1`) these pixels change and no others do: measured, a scene with a jittered
//! area light differs from itself in 4.50 % of its pixels, and antialiased scenes without jittered lights in none.

use super::{compare, steps_apart};
use image::{DynamicImage, GrayImage};

/// Switches that render the same picture with its blocks in other orders, the most revealing first. One order does not
/// reveal all random pixels, because two values may coincide: measured on six of Debian's example scenes with area
/// lights, one other order left up to 3.3 % of the pixels that are random undetected, and all four together none.
/// other order left up to 3.3 % of the pixels that are random unseen, and all four together none.
pub(super) const OTHER_ORDERS: [&str; 4] = ["+RP1", "+RP3", "+RP2", "+RP4"];

/// Distance in pixels from a noisy pixel within which pixels count as random: their noise may be lost in rounding.
const REACH: u32 = 2;

/// The factor by which two samples of the same noise may differ in the root mean square of their differences.
const SPREAD: f64 = 1.25;

/// The differences between POV-Ray's picture and its renderings with blocks in other orders: the largest of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Noise {
    /// Pixels that differ, in percent.
    pub percent: f64,
    /// The root of the mean of the squared differences, in steps.
    pub rms: f64,
    /// The largest difference, in steps.
    pub max: f64,
    /// The random pixels: not 0.
    random: GrayImage,
}

impl Noise {
    /// Adds one more rendering; `None` if all are equal.
    pub(super) fn with(mut self, expected: &DynamicImage, again: &DynamicImage) -> Option<Noise> {
        let comparison = compare(expected, again).ok()?;
        let apart = steps_apart(expected, again).ok()?;
        if comparison.is_equal() {
            return (self.max > 0.0).then_some(self);
        }
        self.percent = self.percent.max(comparison.differing_percent());
        self.rms = self.rms.max(comparison.rms);
        self.max = self.max.max(comparison.max());
        let random = spread(&apart);
        if self.random.dimensions() == random.dimensions() {
            let pixels = self.random.pixels_mut().zip(random.pixels());
            pixels.for_each(|(all, new)| all.0[0] |= new.0[0]);
        } else {
            self.random = random;
        }
        Some(self)
    }

    /// The picture with random pixels replaced by the expected ones: the remaining differences are not noise.
    pub(super) fn without(
        &self,
        expected: &DynamicImage,
        actual: &DynamicImage,
    ) -> Option<DynamicImage> {
        if actual.color() != expected.color() {
            return None;
        }
        let mut quiet = actual.clone();
        match (&mut quiet, expected) {
            (DynamicImage::ImageRgb8(quiet), DynamicImage::ImageRgb8(expected)) => {
                self.put(quiet, expected);
            }
            (DynamicImage::ImageRgba8(quiet), DynamicImage::ImageRgba8(expected)) => {
                self.put(quiet, expected);
            }
            (DynamicImage::ImageRgb16(quiet), DynamicImage::ImageRgb16(expected)) => {
                self.put(quiet, expected);
            }
            (DynamicImage::ImageRgba16(quiet), DynamicImage::ImageRgba16(expected)) => {
                self.put(quiet, expected);
            }
            _ => return None,
        }
        Some(quiet)
    }

    fn put<P: image::Pixel>(
        &self,
        quiet: &mut image::ImageBuffer<P, Vec<P::Subpixel>>,
        expected: &image::ImageBuffer<P, Vec<P::Subpixel>>,
    ) {
        let pixels = quiet.pixels_mut().zip(expected.pixels());
        for ((quiet, expected), random) in pixels.zip(self.random.pixels()) {
            if random.0[0] > 0 {
                *quiet = *expected;
            }
        }
    }

    /// True if a picture is no further from the expected one than POV-Ray's own are from each other.
    pub(super) fn covers(&self, rms: f64) -> bool {
        rms <= SPREAD * self.rms
    }
}

/// Every nonzero pixel, and those around it.
fn spread(apart: &GrayImage) -> GrayImage {
    let (width, height) = apart.dimensions();
    let mut random = GrayImage::new(width, height);
    for (x, y, step) in apart.enumerate_pixels() {
        if step.0[0] == 0 {
            continue;
        }
        for y in y.saturating_sub(REACH)..(y + REACH + 1).min(height) {
            for x in x.saturating_sub(REACH)..(x + REACH + 1).min(width) {
                random.put_pixel(x, y, image::Luma([255]));
            }
        }
    }
    random
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    #[test]
    fn differences_outside_the_noise_remain() {
        let expected = RgbImage::new(20, 20);
        let (mut again, mut actual) = (expected.clone(), expected.clone());
        again.put_pixel(5, 5, Rgb([9, 0, 0]));
        actual.put_pixel(6, 7, Rgb([0, 8, 0]));
        actual.put_pixel(15, 5, Rgb([0, 0, 7]));
        let (expected, actual) = (DynamicImage::from(expected), DynamicImage::from(actual));
        let noise = Noise::default().with(&expected, &again.into()).unwrap();
        assert!((noise.percent - 0.25).abs() < 1e-9 && (noise.max - 9.0).abs() < 1e-9);
        let left = noise.without(&expected, &actual).unwrap();
        let left = compare(&expected, &left).unwrap();
        assert_eq!((left.same, left.worst.unwrap().x), (399, 15));
        assert!(noise.covers(1.2 * noise.rms) && !noise.covers(1.3 * noise.rms));
        assert!(Noise::default().with(&expected, &expected).is_none());
    }
}
