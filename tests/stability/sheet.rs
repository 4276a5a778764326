//! Pictures side by side: the exact one, those of the renderers, and their errors.

use super::case::{Asks, Case, Outcome, reference};
use super::draw::Picture;
use image::{Rgb, RgbImage, imageops};

/// Magnification of pixels.
pub(crate) const FACTOR: u32 = 3;
pub(crate) const GAP: u32 = 4;
/// Stripes in place of a missing picture.
const NOTHING: [Rgb<u8>; 2] = [Rgb([200, 200, 200]), Rgb([228, 228, 228])];
/// The background of wrong pixels, and their colours: of the first renderer, of the second, of both.
const GROUND: Rgb<u8> = Rgb([236, 236, 236]);
const OF_FIRST: Rgb<u8> = Rgb([200, 60, 40]);
const OF_SECOND: Rgb<u8> = Rgb([20, 110, 190]);
const OF_BOTH: Rgb<u8> = Rgb([120, 30, 140]);

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte"
)]
fn shown(picture: &Picture) -> RgbImage {
    let (width, height) = picture.size;
    RgbImage::from_fn(width, height, |x, y| {
        let color = picture.pixels[(y * width + x) as usize];
        // A gamma that makes dark colours visible.
        Rgb(color.map(|c| (255.0 * c.clamp(0.0, 1.0).powf(0.45)).round() as u8))
    })
}

fn nothing(size: (u32, u32)) -> RgbImage {
    RgbImage::from_fn(size.0, size.1, |x, y| NOTHING[((x + y) / 3 % 2) as usize])
}

/// The wrong pixels of two renderers, the last of which is povr.
fn wrong(outcomes: &[&Outcome], size: (u32, u32)) -> RgbImage {
    let (first, second) = match outcomes {
        [one] => (None, Some(*one)),
        [first, second, ..] => (Some(*first), Some(*second)),
        [] => (None, None),
    };
    let is_wrong = |of: Option<&Outcome>, at: usize| {
        of.is_some_and(|one| one.picture.is_none() || one.map.get(at).copied().unwrap_or(false))
    };
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let at = (y * size.0 + x) as usize;
        match (is_wrong(first, at), is_wrong(second, at)) {
            (true, true) => OF_BOTH,
            (true, false) => OF_FIRST,
            (false, true) => OF_SECOND,
            (false, false) => GROUND,
        }
    })
}

/// The exact picture, the picture of each outcome, and the wrong pixels of all, in a row; povr is the last.
pub(crate) fn row(case: &Case, outcomes: &[&Outcome]) -> RgbImage {
    let size = case.size();
    let right = match &case.asks {
        Asks::Model(model) => Some(shown(&reference(model))),
        Asks::Even { color, .. } => Some(shown(&Picture {
            size,
            pixels: vec![*color; (size.0 * size.1) as usize],
        })),
        _ => outcomes
            .last()
            .and_then(|outcome| outcome.like.as_ref().map(shown)),
    };
    let drawn = outcomes
        .iter()
        .map(|outcome| outcome.picture.as_ref().map(shown));
    let mut pictures: Vec<RgbImage> = [right]
        .into_iter()
        .chain(drawn)
        .map(|picture| picture.unwrap_or_else(|| nothing(size)))
        .collect();
    pictures.push(wrong(outcomes, size));
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
