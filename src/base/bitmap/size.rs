//! The memory that an image needs, estimated from its file header before anything is allocated.

use super::format::Format;
use super::handling::{Fault, check_size, image_format};
use super::{bmp, gif, jpeg, png, pnm, tiff};
use image::{ImageDecoder, ImageReader};
use std::borrow::Cow;
use std::io::Cursor;

/// Upper limit of pixels per byte of a file. Deflated 1-bit PNG reaches about 8,260; a file that claims more is forged
/// or truncated. TIFF is exempt: its fax codes need one bit for a row of any length.
const MAX_PIXELS_PER_BYTE: u64 = 1 << 14;

/// Approximate peak memory in bytes while an image is decoded, including the result.
///
/// # Errors
/// The file is not of this format, has too many pixels, or is too short for its pixels.
pub(crate) fn bytes_to_decode(file: &[u8], format: Format) -> Result<u64, Fault> {
    let known = match format {
        Format::Bmp => bmp::size(file)?,
        Format::Gif => Some(gif::size(file)?),
        Format::Jpeg => Some(jpeg::size(file)?),
        Format::Png => Some(png::size(file)?),
        _ => None,
    };
    let ([width, height], bytes) = match known {
        Some(known) => known,
        None => size_by_crate(file, format)?,
    };
    check_size(width, height)?;
    let pixels = width * height;
    if format != Format::Tiff && pixels / MAX_PIXELS_PER_BYTE > file.len() as u64 {
        let length = file.len();
        return Err(format!(
            "its {length} bytes are too few for {width} by {height} pixels"
        ));
    }
    Ok(bytes)
}

/// Width, height and memory of formats that the `image` crate decodes; its sample buffer becomes the bitmap's.
fn size_by_crate(file: &[u8], format: Format) -> Result<([u64; 2], u64), Fault> {
    let decodable = match format {
        Format::Tiff => tiff::decodable(file),
        _ => Cow::Borrowed(file),
    };
    let reader = ImageReader::with_format(Cursor::new(&*decodable), image_format(format));
    let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions();
    let bytes = decoder.total_bytes();
    let pixels = u64::from(width) * u64::from(height);
    let bytes = match format {
        // The EXR decoder holds a second buffer of pixels.
        Format::Exr => bytes.saturating_mul(2),
        // Three shares of a maximum.
        Format::Pgm | Format::Ppm if pnm::divisor(file).is_some() => {
            bytes.saturating_add(pixels.saturating_mul(12))
        }
        // Samples of 16 bits beside those of 8, and the file with other tags.
        Format::Tiff => bytes
            .saturating_add(bytes / 2)
            .saturating_add(file.len() as u64),
        _ => bytes,
    };
    Ok(([width, height].map(u64::from), bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An RLE8 BMP header, padded with zeros to `length` bytes.
    fn rle8_file(width: u32, height: u32, length: usize) -> Vec<u8> {
        let mut file = b"BM\0\0\0\0\0\0\0\0\0\0\0\0\x28\0\0\0".to_vec();
        for number in [width, height, 0x8_0001, 1, 0, 0, 0, 0, 0] {
            file.extend(number.to_le_bytes());
        }
        file.resize(length, 0);
        file
    }

    #[test]
    fn a_short_file_cannot_hold_a_large_image() {
        let too_short = bytes_to_decode(&rle8_file(16_384, 16_384, 1_080), Format::Bmp);
        let why = "its 1080 bytes are too few for 16384 by 16384 pixels";
        assert_eq!(too_short, Err(why.to_owned()));
        let long_enough = bytes_to_decode(&rle8_file(16_384, 16_384, 20_000), Format::Bmp);
        assert_eq!(long_enough, Ok(1 << 28));
        let too_large = bytes_to_decode(&rle8_file(16_384, 16_385, 20_000), Format::Bmp);
        assert!(too_large.is_err_and(|why| why.contains("more than")));
    }

    #[test]
    fn an_image_needs_the_memory_of_its_samples() {
        let gray = b"P5 300 200 255\n";
        assert_eq!(bytes_to_decode(gray, Format::Pgm), Ok(60_000));
        let rgb = include_bytes!("../../../pov_scenes/texture/images/rgb.png");
        let size = png::size(rgb).expect("it is a PNG file").0;
        let bytes = size[0] * size[1] * 3;
        assert_eq!(bytes_to_decode(rgb, Format::Png), Ok(bytes));
    }
}
