//! The storage kinds of pictures that a comparison distinguishes, and conversion between them.

use super::Mismatch;
use crate::base::color::Gamma;
use image::{DynamicImage, GenericImageView, ImageBuffer, Rgba};

/// The storage of a picture's channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Encoded, 8 bits.
    Bytes,
    /// Encoded, 16 bits.
    Words,
    /// Linear light in floating point.
    Floats,
}

impl Kind {
    pub(super) fn of(picture: &DynamicImage) -> Kind {
        let color = picture.color();
        match color.bits_per_pixel() / u16::from(color.channel_count()) {
            0..=8 => Kind::Bytes,
            9..=16 => Kind::Words,
            _ => Kind::Floats,
        }
    }

    /// Bits of a channel.
    pub(super) fn bits(self) -> u16 {
        match self {
            Kind::Bytes => 8,
            Kind::Words => 16,
            Kind::Floats => 32,
        }
    }

    /// Full intensity.
    pub(super) fn full(self) -> f64 {
        match self {
            Kind::Bytes => 255.0,
            Kind::Words => 65535.0,
            Kind::Floats => 1.0,
        }
    }

    /// The size of one step between two values: half floats have 11 bits, down to 2^-14.
    pub(super) fn step(self, a: f64, b: f64) -> f64 {
        match self {
            Kind::Bytes | Kind::Words => 1.0,
            Kind::Floats => a.abs().max(b.abs()).max((-14f64).exp2()) * (-10f64).exp2(),
        }
    }
}

/// Calls `each` with every pixel of two pictures of one size and kind: column, row, red, green, blue and alpha of both.
pub(super) fn visit(
    expected: &DynamicImage,
    actual: &DynamicImage,
    kind: Kind,
    mut each: impl FnMut(u32, u32, [f64; 4], [f64; 4]),
) {
    match kind {
        Kind::Bytes => {
            let [expected, actual] = [expected, actual].map(DynamicImage::to_rgba8);
            for ((x, y, e), a) in expected.enumerate_pixels().zip(actual.pixels()) {
                each(x, y, e.0.map(f64::from), a.0.map(f64::from));
            }
        }
        Kind::Words => {
            let [expected, actual] = [expected, actual].map(DynamicImage::to_rgba16);
            for ((x, y, e), a) in expected.enumerate_pixels().zip(actual.pixels()) {
                each(x, y, e.0.map(f64::from), a.0.map(f64::from));
            }
        }
        Kind::Floats => {
            let [expected, actual] = [expected, actual].map(DynamicImage::to_rgba32f);
            for ((x, y, e), a) in expected.enumerate_pixels().zip(actual.pixels()) {
                each(x, y, e.0.map(f64::from), a.0.map(f64::from));
            }
        }
    }
}

/// Converts two pictures to a common form for comparison: that of the one with fewer bits. Linear light becomes sRGB
/// where the other picture is encoded, clipped at white, as a file of this depth would store it.
///
/// # Errors
/// When the pictures differ in size.
pub fn alike(
    expected: &DynamicImage,
    actual: &DynamicImage,
) -> Result<(DynamicImage, DynamicImage), Mismatch> {
    let sizes = [expected, actual].map(GenericImageView::dimensions);
    if sizes[0] != sizes[1] {
        return Err(Mismatch::Size(sizes[0], sizes[1]));
    }
    let kinds = [expected, actual].map(Kind::of);
    let kind = if kinds.contains(&Kind::Bytes) {
        Kind::Bytes
    } else if kinds.contains(&Kind::Words) {
        Kind::Words
    } else {
        Kind::Floats
    };
    Ok((as_kind(expected, kind), as_kind(actual, kind)))
}

/// The picture as 8-bit sRGB, for display.
pub(crate) fn shown(picture: &DynamicImage) -> DynamicImage {
    as_kind(picture, Kind::Bytes)
}

fn as_kind(picture: &DynamicImage, kind: Kind) -> DynamicImage {
    let own = Kind::of(picture);
    if own == kind {
        return picture.clone();
    }
    if own != Kind::Floats {
        return match kind {
            Kind::Bytes => picture.to_rgba8().into(),
            Kind::Words => picture.to_rgba16().into(),
            Kind::Floats => picture.clone(),
        };
    }
    let encoded = picture.to_rgba32f();
    let (width, height) = encoded.dimensions();
    let level = |value: f32, full: f32| (value.clamp(0.0, 1.0) * full).round();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "rounded, between 0 and full intensity"
    )]
    let words = |full: f32| {
        encoded.pixels().flat_map(move |&Rgba([r, g, b, alpha])| {
            let light = [r, g, b].map(|c| level(Gamma::Srgb.encode(c.max(0.0)), full) as u16);
            [light[0], light[1], light[2], level(alpha, full) as u16]
        })
    };
    if kind == Kind::Words {
        let stored = words(65535.0).collect();
        let picture: Option<ImageBuffer<Rgba<u16>, Vec<u16>>> =
            ImageBuffer::from_raw(width, height, stored);
        return picture.unwrap_or_default().into();
    }
    let stored = words(255.0).map(|v| u8::try_from(v).unwrap_or(u8::MAX));
    let picture: Option<ImageBuffer<Rgba<u8>, Vec<u8>>> =
        ImageBuffer::from_raw(width, height, stored.collect());
    picture.unwrap_or_default().into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::compare::compare;
    use image::{Rgb, RgbImage};

    #[test]
    fn linear_light_is_compared_with_bytes_as_srgb() {
        // 0.214 of linear light is the byte 127.5 rounded: 128 (IEC 61966-2-1).
        let light = ImageBuffer::from_pixel(2, 1, Rgb([0.215_86_f32, 0.0, 3.0]));
        let bytes = RgbImage::from_pixel(2, 1, Rgb([128, 0, 255]));
        let (a, b) = alike(&light.into(), &bytes.into()).unwrap();
        assert!(compare(&a, &b).unwrap().is_equal());
    }

    #[test]
    fn sixteen_bits_are_rounded_to_bytes() {
        let words = ImageBuffer::from_pixel(1, 1, Rgb([257_u16 * 9 + 100, 0, 65535]));
        let bytes = RgbImage::from_pixel(1, 1, Rgb([9, 0, 255]));
        let (a, b) = alike(&bytes.into(), &words.into()).unwrap();
        assert!(compare(&a, &b).unwrap().is_equal());
    }

    #[test]
    fn unlike_sizes_are_refused() {
        let refused = alike(&RgbImage::new(1, 2).into(), &RgbImage::new(2, 1).into());
        assert_eq!(refused.unwrap_err(), Mismatch::Size((1, 2), (2, 1)));
    }
}
