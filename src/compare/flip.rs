//! How different two pictures look: FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020,
//! "FLIP: A Difference Evaluator for Alternating Images").

use super::kinds::shown;
use image::DynamicImage;

/// The mean of FLIP over two pictures of one size, at the usual distance of 67 pixels a degree: 0 for pictures that look
/// the same, 1 for black beside white. Alpha is left out, and linear light is clipped at white.
#[must_use]
pub fn flip(expected: &DynamicImage, actual: &DynamicImage) -> f64 {
    let [expected, actual] = [expected, actual].map(|picture| shown(picture).to_rgb8());
    if expected.dimensions() != actual.dimensions() || expected.is_empty() {
        return 0.0;
    }
    let image = |picture: &image::RgbImage| {
        nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), picture)
    };
    let map = nv_flip::flip(
        image(&expected),
        image(&actual),
        nv_flip::DEFAULT_PIXELS_PER_DEGREE,
    );
    f64::from(nv_flip::FlipPool::from_image(&map).mean())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    #[test]
    fn the_same_has_none_and_white_for_black_is_nearly_one() {
        let grey = |v| DynamicImage::from(RgbImage::from_pixel(40, 30, Rgb([v; 3])));
        assert!(flip(&grey(90), &grey(90)).abs() < 1e-6);
        assert!(flip(&grey(0), &grey(255)) > 0.9);
        assert!(flip(&RgbImage::new(0, 0).into(), &RgbImage::new(0, 0).into()).abs() < 1e-9);
    }
}
