//! Decoding image files into [`Bitmap`]s.

use super::format::Format;
use super::handling::{Fault, Handling, bitmap_from_image, decode_by_crate};
use super::{Bitmap, bmp, gif, jpeg, png};
use image::DynamicImage;

/// Decodes a file of the given format.
pub(super) fn decode(bytes: &[u8], format: Format, handling: &Handling) -> Result<Bitmap, Fault> {
    match format {
        Format::Bmp => bmp::decode(bytes, handling),
        Format::Png => png::decode(bytes, handling),
        Format::Gif => gif::decode(bytes, handling),
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
        Format::Jpeg => jpeg::decode(bytes),
        _ => decode_by_crate(bytes, format),
    }
}
