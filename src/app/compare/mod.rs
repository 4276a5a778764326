//! Comparison of two pictures: the number of equal pixels, the differences of the others, and their positions; and the
//! comparison of this program with POV-Ray, scene by scene.
//!
//! A pixel that is one step off is counted separately from one that is off by more: the first is rounding, the second
//! is an error in geometry or shading (BRL-CAD's benchmark separates them in the same way). Channels are compared as
//! stored, in steps of the picture's depth: 1/255 for 8 bits, 1/65535 for 16 bits. Two pictures of linear light in
//! floating point are compared as numbers, with half-float steps. [`alike`] converts pictures of different kinds to a
//! common form. A picture without alpha is opaque.

mod case;
mod check;
mod difference;
pub(crate) mod error;
mod flip;
mod kinds;
mod limits;
mod noise;
mod process;
mod reference;
mod renderer;
mod side_by_side;
mod thresholds;

pub use case::{Case, CaseError};
pub use check::{Bench, Checked, Compared, Explanation, pictures};
pub use difference::steps_apart;
pub use error::CheckError;
pub use flip::flip;
pub use kinds::alike;
pub(crate) use kinds::shown;
pub use limits::{LimitError, Limits, Verdict};
pub use noise::Noise;
pub use process::{Ended, run};
pub use reference::Reference;
pub use renderer::{Picture, Renderer, tail};
pub use side_by_side::side_by_side;
pub use thresholds::{Grade, Thresholds};

use image::DynamicImage;
use kinds::{Kind, visit};
use std::fmt;

/// The comparison of two pictures of one size.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Pixels equal in all channels.
    pub same: u64,
    /// Pixels whose most different channel is one step off.
    pub off_by_one: u64,
    /// Pixels with a channel that is more than one step off.
    pub off_by_many: u64,
    /// The mean of the absolute differences over all channels, in steps.
    pub mean: f64,
    /// The root of the mean of the squared differences over all channels, in steps.
    pub rms: f64,
    /// The value of full intensity: 255 or 65535, or 1 for floating point.
    pub full: f64,
    /// The pixel with the largest difference in one channel; of several the first in reading order.
    pub worst: Option<WorstPixel>,
}

/// The pixel with the largest difference between two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    /// Column from the left, from 0.
    pub x: u32,
    /// Row from the top, from 0.
    pub y: u32,
    /// The largest difference of its channels, in steps.
    pub difference: f64,
    /// Red, green, blue and alpha of the expected picture.
    pub expected: [f64; 4],
    /// Red, green, blue and alpha of the actual picture.
    pub actual: [f64; 4],
}

/// Reasons why two pictures cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The sizes differ: expected, then actual, as width and height.
    Size((u32, u32), (u32, u32)),
    /// The bits of a channel differ: expected, then actual.
    Depth(u16, u16),
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mismatch::Size((ew, eh), (aw, ah)) => {
                write!(f, "expected {ew}x{eh} pixels, found {aw}x{ah}")
            }
            Mismatch::Depth(expected, actual) => {
                write!(
                    f,
                    "expected {expected} bits in a channel, found {actual} bits"
                )
            }
        }
    }
}

impl std::error::Error for Mismatch {}

/// Compares two pictures pixel by pixel.
///
/// # Errors
/// When the pictures differ in size or in depth.
pub fn compare(expected: &DynamicImage, actual: &DynamicImage) -> Result<Comparison, Mismatch> {
    let sizes = [expected, actual].map(|picture| (picture.width(), picture.height()));
    if sizes[0] != sizes[1] {
        return Err(Mismatch::Size(sizes[0], sizes[1]));
    }
    let [kind, actual_kind] = [expected, actual].map(Kind::of);
    if kind != actual_kind {
        return Err(Mismatch::Depth(kind.bits(), actual_kind.bits()));
    }
    Ok(count(expected, actual, kind))
}

fn count(expected: &DynamicImage, actual: &DynamicImage, kind: Kind) -> Comparison {
    let mut comparison = Comparison {
        same: 0,
        off_by_one: 0,
        off_by_many: 0,
        mean: 0.0,
        rms: 0.0,
        full: kind.full(),
        worst: None,
    };
    let (mut sum, mut sum_sq, mut is_opaque) = (0.0, 0.0, true);
    visit(expected, actual, kind, |x, y, expected, actual| {
        let (mut difference, mut is_one) = (0.0, true);
        for (e, a) in expected.into_iter().zip(actual) {
            let off = off(e, a);
            difference = f64::max(difference, off);
            is_one &= off <= kind.step(e, a);
            sum += off;
            sum_sq += off * off;
        }
        is_opaque &= expected[3] >= kind.full() && actual[3] >= kind.full();
        match (difference > 0.0, is_one) {
            (false, _) => comparison.same += 1,
            (true, true) => comparison.off_by_one += 1,
            (true, false) => comparison.off_by_many += 1,
        }
        if difference > comparison.max() {
            comparison.worst = Some(WorstPixel {
                x,
                y,
                difference,
                expected,
                actual,
            });
        }
    });
    // Alpha counts for equality, but a channel that is opaque in both must not dilute the mean.
    let values = comparison.pixels() * if is_opaque { 3 } else { 4 };
    if values > 0 {
        comparison.mean = sum / as_f64(values);
        comparison.rms = (sum_sq / as_f64(values)).sqrt();
    }
    comparison
}

/// The difference of two values. NaN equals NaN, and is infinitely far from any number.
fn off(expected: f64, actual: f64) -> f64 {
    match (expected.is_nan(), actual.is_nan()) {
        (true, true) => 0.0,
        (false, false) if expected == actual => 0.0,
        (false, false) => (expected - actual).abs(),
        _ => f64::INFINITY,
    }
}

/// A count of pixels as a number; exact below 2^53.
#[allow(
    clippy::cast_precision_loss,
    reason = "no picture has 2^53 pixels: its sides are 32 bits and it must fit in memory"
)]
pub(crate) fn as_f64(count: u64) -> f64 {
    count as f64
}

impl Comparison {
    /// The number of pixels of each picture.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        self.same + self.off_by_one + self.off_by_many
    }

    /// The share of pixels that differ, in percent; 0 for an empty picture.
    #[must_use]
    pub fn differing_percent(&self) -> f64 {
        100.0 * as_f64(self.off_by_one + self.off_by_many) / as_f64(self.pixels().max(1))
    }

    /// The largest difference in one channel, in steps.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.worst.map_or(0.0, |worst| worst.difference)
    }

    /// The peak signal-to-noise ratio in decibels; infinite for equal pictures.
    #[must_use]
    pub fn psnr(&self) -> f64 {
        20.0 * (self.full / self.rms).log10()
    }

    /// True if all pixels are equal.
    #[must_use]
    pub fn is_equal(&self) -> bool {
        self.same == self.pixels()
    }
}

/// One line with the counts and measures, and a second with the worst pixel if there is one.
impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_equal() {
            return write!(f, "all {} pixels are equal", self.pixels());
        }
        let Comparison {
            same,
            off_by_one,
            off_by_many,
            mean,
            rms,
            ..
        } = self;
        write!(
            f,
            "{same} pixels equal, {off_by_one} off by one, {off_by_many} off by more ({:.3} % differ); \
             mean {mean:.4}, RMS {rms:.4}, PSNR {:.2} dB",
            self.differing_percent(),
            self.psnr()
        )?;
        if let Some(worst) = &self.worst {
            write!(f, "\n{worst}")?;
        }
        Ok(())
    }
}

impl fmt::Display for WorstPixel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let channels = |c: [f64; 4]| format!("{} {} {} {}", c[0], c[1], c[2], c[3]);
        write!(
            f,
            "worst pixel at column {}, row {}: off by {}, expected {}, found {}",
            self.x,
            self.y,
            self.difference,
            channels(self.expected),
            channels(self.actual)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Rgb, RgbImage, Rgba, RgbaImage};

    fn grey(width: u32, height: u32, value: u8) -> RgbImage {
        RgbImage::from_pixel(width, height, Rgb([value; 3]))
    }

    #[test]
    fn equal_pictures_have_no_worst_pixel() {
        let comparison = compare(&grey(4, 3, 7).into(), &grey(4, 3, 7).into()).unwrap();
        assert!(comparison.is_equal());
        assert_eq!(
            (comparison.same, comparison.max(), comparison.worst),
            (12, 0.0, None)
        );
        assert_eq!(comparison.psnr(), f64::INFINITY);
        assert_eq!(comparison.to_string(), "all 12 pixels are equal");
    }

    #[test]
    fn off_by_one_and_off_by_many_are_counted_apart() {
        let mut actual = grey(5, 2, 100);
        actual.put_pixel(1, 0, Rgb([100, 101, 100]));
        actual.put_pixel(4, 1, Rgb([99, 90, 100]));
        let comparison = compare(&grey(5, 2, 100).into(), &actual.into()).unwrap();
        assert_eq!(
            (
                comparison.same,
                comparison.off_by_one,
                comparison.off_by_many
            ),
            (8, 1, 1),
            "{comparison}"
        );
        assert_eq!(
            comparison.worst,
            Some(WorstPixel {
                x: 4,
                y: 1,
                difference: 10.0,
                expected: [100.0, 100.0, 100.0, 255.0],
                actual: [99.0, 90.0, 100.0, 255.0],
            })
        );
        assert!((comparison.mean - 12.0 / 30.0).abs() < 1e-12);
        assert!((comparison.rms - (102.0f64 / 30.0).sqrt()).abs() < 1e-12);
        assert!((comparison.differing_percent() - 20.0).abs() < 1e-12);
    }

    #[test]
    fn psnr_of_one_step_everywhere_is_48_decibels() {
        let comparison = compare(&grey(3, 3, 10).into(), &grey(3, 3, 11).into()).unwrap();
        assert!((comparison.psnr() - 48.130_803_6).abs() < 1e-6);
    }

    #[test]
    fn sixteen_bits_are_compared_in_their_own_steps() {
        let picture =
            |v: u16| DynamicImage::from(ImageBuffer::from_pixel(2, 2, Rgb([v, 65535, 0])));
        let comparison = compare(&picture(1000), &picture(1001)).unwrap();
        assert_eq!((comparison.off_by_one, comparison.full), (4, 65535.0));
    }

    #[test]
    fn floating_point_is_compared_in_steps_of_a_half_float() {
        let picture =
            |v: f32| DynamicImage::from(ImageBuffer::from_pixel(2, 2, Rgb([v, 8.0, 0.0])));
        let comparison = compare(&picture(1.0), &picture(1.000_9)).unwrap();
        assert_eq!((comparison.off_by_one, comparison.off_by_many), (4, 0));
        let comparison = compare(&picture(1.0), &picture(1.01)).unwrap();
        assert_eq!((comparison.off_by_many, comparison.full), (4, 1.0));
        let none = compare(&picture(f32::NAN), &picture(f32::NAN)).unwrap();
        assert!(none.is_equal());
        let some = compare(&picture(f32::NAN), &picture(1.0)).unwrap();
        assert_eq!(some.max(), f64::INFINITY);
    }

    #[test]
    fn a_picture_without_alpha_is_opaque() {
        let mut actual = RgbaImage::from_pixel(2, 1, Rgba([9, 9, 9, 255]));
        let opaque = compare(&grey(2, 1, 9).into(), &actual.clone().into()).unwrap();
        assert!(opaque.is_equal());
        actual.put_pixel(1, 0, Rgba([9, 9, 9, 0]));
        let clear = compare(&grey(2, 1, 9).into(), &actual.into()).unwrap();
        assert_eq!(clear.max(), 255.0);
    }

    #[test]
    fn other_sizes_and_depths_are_refused() {
        let size = compare(&grey(2, 1, 0).into(), &grey(1, 2, 0).into());
        assert_eq!(size, Err(Mismatch::Size((2, 1), (1, 2))));
        let wide: ImageBuffer<Rgb<u16>, Vec<u16>> = ImageBuffer::new(2, 1);
        let depth = compare(&grey(2, 1, 0).into(), &wide.into()).unwrap_err();
        assert_eq!(
            depth.to_string(),
            "expected 8 bits in a channel, found 16 bits"
        );
    }

    #[test]
    fn an_empty_picture_is_equal_to_itself() {
        let comparison = compare(&grey(0, 0, 0).into(), &grey(0, 0, 0).into()).unwrap();
        assert!(comparison.is_equal());
        assert!(comparison.mean.abs() < 1e-12 && comparison.differing_percent().abs() < 1e-12);
    }
}
