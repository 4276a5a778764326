//! TIFF decoding that matches POV-Ray (measured): colours are multiplied by their alpha in 8 bits, and any gamma is that
//! of the products.

use super::Bitmap;
use super::format::Format;
use super::handling::{Fault, Handling, bitmap_from_image, decode_by_crate};
use image::DynamicImage;

/// The tag of the kinds of samples beyond the colours, and its value for alpha that colours are multiplied by already.
const EXTRA_SAMPLES: u16 = 338;
const ASSOCIATED: u16 = 1;

pub(super) fn decode(bytes: &[u8], handling: &Handling) -> Result<Bitmap, Fault> {
    let image = samples(bytes)?;
    let is_premultiplied = handling.is_premultiplied.or(Some(is_multiplied(&image)));
    let handling = Handling {
        is_premultiplied,
        ..*handling
    };
    bitmap_from_image(image, handling.transfer(Format::Tiff, None), &handling)
}

/// Decodes the samples of a file; those of 8 bits are multiplied by their alpha.
pub(super) fn samples(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    let mut image = decode_by_crate(bytes, Format::Tiff)?;
    if first_value(bytes, EXTRA_SAMPLES) == Some(ASSOCIATED) {
        return Ok(image);
    }
    match &mut image {
        DynamicImage::ImageLumaA8(image) => image.pixels_mut().for_each(|it| multiply(&mut it.0)),
        DynamicImage::ImageRgba8(image) => image.pixels_mut().for_each(|it| multiply(&mut it.0)),
        _ => {}
    }
    Ok(image)
}

fn is_multiplied(image: &DynamicImage) -> bool {
    matches!(
        image,
        DynamicImage::ImageLumaA8(_) | DynamicImage::ImageRgba8(_)
    )
}

fn multiply(pixel: &mut [u8]) {
    if let Some((&mut alpha, colors)) = pixel.split_last_mut() {
        for color in colors {
            let product = (u16::from(*color) * u16::from(alpha) + 127) / 255;
            *color = u8::try_from(product).expect("it is below 256");
        }
    }
}

/// The first value of a tag of short numbers in the first directory.
fn first_value(bytes: &[u8], tag: u16) -> Option<u16> {
    let is_little = bytes.starts_with(b"II");
    let short = |at: usize| {
        let bytes = *bytes.get(at..)?.first_chunk()?;
        Some(if is_little {
            u16::from_le_bytes(bytes)
        } else {
            u16::from_be_bytes(bytes)
        })
    };
    let long = |at: usize| {
        let bytes = *bytes.get(at..)?.first_chunk()?;
        let value = if is_little {
            u32::from_le_bytes(bytes)
        } else {
            u32::from_be_bytes(bytes)
        };
        usize::try_from(value).ok()
    };
    let directory = long(4)?;
    let entries = 0..usize::from(short(directory)?);
    let mut entries = entries.map(|entry| directory + 2 + 12 * entry);
    let entry = entries.find(|&at| short(at) == Some(tag))?;
    match long(entry + 4)? {
        0 => None,
        1 | 2 => short(entry + 8),
        _ => short(long(entry + 8)?),
    }
}
