//! Decoding image files into [`Bitmap`]s.

use super::format::Format;
use super::handling::{Content, Fault, Handling, bitmap_from_content, decode_by_crate};
use super::{Bitmap, bmp, gif, hdr, jpeg, png, pnm, tga, tiff};

/// Decodes a file of the given format.
pub(super) fn decode(bytes: &[u8], format: Format, handling: &Handling) -> Result<Bitmap, Fault> {
    let mut bitmap = match format {
        Format::Png => png::decode(bytes, handling),
        Format::Gif => gif::decode(bytes, handling),
        _ => {
            let by_format = (format == Format::Tiff).then_some(true);
            let handling = Handling {
                is_premultiplied: handling.is_premultiplied.or(by_format),
                ..*handling
            };
            let transfer = handling.transfer(format, None);
            bitmap_from_content(content(bytes, format)?, transfer, &handling)
        }
    }?;
    let has_palette = bitmap.palette_len().is_some();
    bitmap.stores_alpha = bitmap.has_alpha
        || match format {
            Format::Tiff => !has_palette,
            Format::Hdr => true,
            Format::Bmp => false,
            _ => has_palette,
        };
    Ok(bitmap)
}

/// Decodes a file to its stored samples, without gamma handling. Palettes of PNG and GIF are expanded.
pub(crate) fn content(bytes: &[u8], format: Format) -> Result<Content, Fault> {
    match format {
        Format::Bmp => bmp::content(bytes),
        Format::Tga => tga::content(bytes),
        Format::Tiff => tiff::content(bytes),
        Format::Hdr => hdr::decode(bytes).map(Content::Colors),
        Format::Jpeg => jpeg::decode(bytes).map(Content::Colors),
        Format::Pgm | Format::Ppm => pnm::samples(bytes).map(Content::Colors),
        _ => decode_by_crate(bytes, format).map(Content::Colors),
    }
}
