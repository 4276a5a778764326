//! Decoding image files into [`Bitmap`]s.

use super::format::Format;
use super::handling::{Fault, Handling, bitmap_from_image, decode_by_crate};
use super::{Bitmap, bmp, gif, hdr, jpeg, png, tga, tiff};
use image::DynamicImage;

/// Decodes a file of the given format.
pub(super) fn decode(bytes: &[u8], format: Format, handling: &Handling) -> Result<Bitmap, Fault> {
    match format {
        Format::Bmp => bmp::decode(bytes, handling),
        Format::Png => png::decode(bytes, handling),
        Format::Gif => gif::decode(bytes, handling),
        Format::Tga => tga::decode(bytes, handling),
        Format::Tiff => tiff::decode(bytes, handling),
        Format::Pgm | Format::Ppm => pnm(bytes, format, handling),
        _ => bitmap_from_image(
            decode_samples(bytes, format)?,
            handling.transfer(format, None),
            handling,
        ),
    }
}

/// Decodes a file to its stored samples, with palettes expanded and without gamma handling.
pub(crate) fn decode_samples(bytes: &[u8], format: Format) -> Result<DynamicImage, Fault> {
    match format {
        Format::Hdr => hdr::decode(bytes),
        Format::Jpeg => jpeg::decode(bytes),
        Format::Tiff => tiff::samples(bytes),
        _ => decode_by_crate(bytes, format),
    }
}

/// Decodes a PGM or PPM file. Samples whose maximum is below 255 are divided by it, and not rounded to bytes.
fn pnm(bytes: &[u8], format: Format, handling: &Handling) -> Result<Bitmap, Fault> {
    let image = decode_samples(bytes, format)?;
    let image = match pnm_maximum(bytes) {
        Some(most) if most < 255 => {
            let most = f32::from(most);
            let mut image = image.into_rgb32f();
            let samples = image.iter_mut();
            samples.for_each(|sample| *sample = (*sample * most).round() / most);
            DynamicImage::ImageRgb32F(image)
        }
        _ => image,
    };
    bitmap_from_image(image, handling.transfer(format, None), handling)
}

/// The maximum that the header of a PGM or PPM file states for samples, if it is below 256.
fn pnm_maximum(bytes: &[u8]) -> Option<u8> {
    matches!(bytes.get(1)?, b'2' | b'3' | b'5' | b'6').then_some(())?;
    let mut last = None;
    let mut rest = bytes.get(2..)?;
    // Width, height and the maximum.
    for _ in 0..3 {
        loop {
            rest = rest.trim_ascii_start();
            match rest.first()? {
                b'#' => rest = &rest[rest.iter().position(|&byte| byte == b'\n')?..],
                _ => break,
            }
        }
        let (digits, behind) = rest.split_at(rest.iter().position(u8::is_ascii_whitespace)?);
        last = std::str::from_utf8(digits).ok();
        rest = behind;
    }
    last?.parse().ok().filter(|&most| most > 0)
}
