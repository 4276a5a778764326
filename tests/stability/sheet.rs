//! Pictures beside each other: what is right, what renderers draw, and where they are wrong.

use super::case::{Asks, Case, Outcome, reference};
use super::draw::Picture;
use image::{Rgb, RgbImage, imageops};

/// How much larger pixels are shown.
const FACTOR: u32 = 3;
const GAP: u32 = 4;
/// What is shown where there is no picture.
const NOTHING: Rgb<u8> = Rgb([90, 90, 90]);

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte"
)]
fn shown(picture: &Picture) -> RgbImage {
    let (width, height) = picture.size;
    RgbImage::from_fn(width, height, |x, y| {
        let color = picture.pixels[(y * width + x) as usize];
        // A gamma that shows dark colours.
        Rgb(color.map(|c| (255.0 * c.clamp(0.0, 1.0).powf(0.45)).round() as u8))
    })
}

/// White where a pixel is wrong.
fn map(outcome: &Outcome, size: (u32, u32)) -> RgbImage {
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let at = (y * size.0 + x) as usize;
        match outcome.map.get(at) {
            Some(true) => Rgb([255, 255, 255]),
            Some(false) => Rgb([0, 0, 0]),
            None => NOTHING,
        }
    })
}

/// What is right, and for each outcome its picture and its wrong pixels, in a row.
pub(crate) fn row(case: &Case, outcomes: &[&Outcome]) -> RgbImage {
    let size = case.size();
    let empty = || RgbImage::from_pixel(size.0, size.1, NOTHING);
    let mut pictures = vec![match &case.asks {
        Asks::Model(model) => shown(&reference(model)),
        Asks::Even { color, .. } => shown(&Picture {
            size,
            pixels: vec![*color; (size.0 * size.1) as usize],
        }),
        _ => empty(),
    }];
    for outcome in outcomes {
        pictures.push(outcome.picture.as_ref().map_or_else(empty, shown));
        pictures.push(map(outcome, size));
    }
    let step = size.0 * FACTOR + GAP;
    let count = u32::try_from(pictures.len()).unwrap_or(0);
    let mut row = RgbImage::from_pixel(count * step - GAP, size.1 * FACTOR, Rgb([255; 3]));
    for (picture, left) in pictures.iter().zip((0..).step_by(step as usize)) {
        let (width, height) = (size.0 * FACTOR, size.1 * FACTOR);
        let large = imageops::resize(picture, width, height, imageops::FilterType::Nearest);
        imageops::replace(&mut row, &large, left, 0);
    }
    row
}
