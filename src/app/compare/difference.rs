//! The differences of two pictures, as a picture.

use super::kinds::{Kind, visit};
use super::{Mismatch, off};
use image::{DynamicImage, GrayImage, Luma};

/// The differences of the pixels of two pictures in steps of 1/255, each by its most different channel. Any difference
/// counts as at least 1, so that none is lost.
///
/// # Errors
/// When the pictures differ in size or in depth.
pub fn steps_apart(expected: &DynamicImage, actual: &DynamicImage) -> Result<GrayImage, Mismatch> {
    super::compare(expected, actual)?;
    let kind = Kind::of(expected);
    let mut steps = GrayImage::new(expected.width(), expected.height());
    visit(expected, actual, kind, |x, y, expected, actual| {
        let pairs = expected.into_iter().zip(actual);
        let most = pairs.map(|(e, a)| off(e, a)).fold(0.0, f64::max);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 255; what is infinite is 255"
        )]
        let step = (most / kind.full() * 255.0 - 1e-9).ceil().clamp(0.0, 255.0) as u8;
        steps.put_pixel(x, y, Luma([step]));
    });
    Ok(steps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Rgb};

    #[test]
    fn the_least_difference_is_a_step() {
        let picture = |v: u16| DynamicImage::from(ImageBuffer::from_pixel(1, 1, Rgb([0, v, 0])));
        let step = |v| {
            steps_apart(&picture(1000), &picture(v))
                .unwrap()
                .get_pixel(0, 0)
                .0[0]
        };
        assert_eq!(
            [step(1000), step(1001), step(1257), step(1258), step(65535)],
            [0, 1, 1, 2, 252]
        );
    }
}
