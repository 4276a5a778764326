//! Side-by-side view of a failure: expected, difference and actual picture.

use image::{DynamicImage, Rgb, RgbImage, imageops};

/// The gap between the three pictures, in pixels of the result.
const GAP: u32 = 4;
/// Narrower pictures are scaled up by an integer factor, so that single pixels are visible.
const WIDTH: u32 = 320;
/// Least brightness of a channel that differs at all, so that one step is visible beside a large difference.
const FAINTEST: u32 = 48;

/// Expected | difference | actual, side by side.
///
/// The difference is taken per channel at 8 bits and scaled so that the largest is full intensity; equal pixels are
/// black. Pictures of different sizes are aligned at the top left corner.
#[must_use]
pub fn side_by_side(expected: &DynamicImage, actual: &DynamicImage) -> RgbImage {
    let (expected, actual) = (expected.to_rgb8(), actual.to_rgb8());
    let difference = difference(&expected, &actual);
    let (width, height) = difference.dimensions();
    let factor = (WIDTH / width.max(1)).max(1);
    let mut sheet = RgbImage::from_pixel(
        3 * width * factor + 2 * GAP,
        height * factor,
        Rgb([128, 128, 128]),
    );
    let mut left = 0;
    for picture in [&expected, &difference, &actual] {
        let scaled = imageops::resize(
            picture,
            picture.width() * factor,
            picture.height() * factor,
            imageops::FilterType::Nearest,
        );
        imageops::replace(&mut sheet, &scaled, i64::from(left), 0);
        left += width * factor + GAP;
    }
    sheet
}

/// The scaled difference; a pixel that only one picture has is full intensity.
fn difference(expected: &RgbImage, actual: &RgbImage) -> RgbImage {
    let largest = expected
        .enumerate_pixels()
        .filter_map(|(x, y, e)| Some((e, actual.get_pixel_checked(x, y)?)))
        .flat_map(|(e, a)| [0, 1, 2].map(|i| e.0[i].abs_diff(a.0[i])))
        .max()
        .map_or(1, |largest| u32::from(largest).max(1));
    let amplify = |off: u8| match u32::from(off) {
        0 => 0,
        off => u8::try_from((255 * off / largest).max(FAINTEST)).unwrap_or(u8::MAX),
    };
    let (width, height) = (
        expected.width().max(actual.width()),
        expected.height().max(actual.height()),
    );
    RgbImage::from_fn(width, height, |x, y| {
        match (
            expected.get_pixel_checked(x, y),
            actual.get_pixel_checked(x, y),
        ) {
            (Some(e), Some(a)) => Rgb([0, 1, 2].map(|i| amplify(e.0[i].abs_diff(a.0[i])))),
            _ => Rgb([255; 3]),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_a_black_middle() {
        let picture = DynamicImage::from(RgbImage::from_pixel(320, 2, Rgb([9, 99, 199])));
        let sheet = side_by_side(&picture, &picture);
        assert_eq!(sheet.dimensions(), (3 * 320 + 2 * GAP, 2));
        assert_eq!(sheet.get_pixel(0, 0).0, [9, 99, 199]);
        assert_eq!(sheet.get_pixel(320 + GAP, 1).0, [0, 0, 0]);
        assert_eq!(sheet.get_pixel(967, 1).0, [9, 99, 199]);
    }

    #[test]
    fn the_largest_difference_is_white_and_one_step_still_shows() {
        let expected = RgbImage::new(2, 1);
        let mut actual = expected.clone();
        actual.put_pixel(0, 0, Rgb([200; 3]));
        actual.put_pixel(1, 0, Rgb([0, 1, 0]));
        let result = difference(&expected, &actual);
        assert_eq!(result.get_pixel(0, 0).0, [255; 3]);
        assert_eq!(result.get_pixel(1, 0).0, [0, 48, 0]);
    }

    #[test]
    fn small_pictures_are_scaled_by_a_whole_factor() {
        let picture = DynamicImage::from(RgbImage::new(100, 5));
        assert_eq!(side_by_side(&picture, &picture).dimensions(), (908, 15));
    }

    #[test]
    fn unlike_sizes_show_where_only_one_picture_is() {
        let result = difference(&RgbImage::new(2, 1), &RgbImage::new(1, 2));
        assert_eq!(result.dimensions(), (2, 2));
        assert_eq!(result.get_pixel(0, 0).0, [0; 3]);
        assert_eq!(result.get_pixel(1, 0).0, [255; 3]);
    }
}
