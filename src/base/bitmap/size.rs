//! The memory that a picture takes, by the head of its file: known before any of it is taken.

use super::decode::{Fault, check_size, crate_format};
use super::format::Format;
use super::{bmp, gif, jpeg, png};
use image::{ImageDecoder, ImageReader};
use std::io::Cursor;

/// Pixels that a byte of a file stands for at most: about 8,260 of one bit as PNG packs them. A file that claims more
/// has been made up or cut off. Fax codes in TIFF need a bit for a row, however long.
const DENSEST: u64 = 1 << 14;

/// About how many bytes a picture takes while it is decoded, itself included.
///
/// # Errors
/// A file that is no such picture, is too large, or is too short for its pixels.
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
        None => of_crate(file, format)?,
    };
    check_size(width, height)?;
    let pixels = width * height;
    if format != Format::Tiff && pixels / DENSEST > file.len() as u64 {
        let length = file.len();
        return Err(format!(
            "its {length} bytes are too few for {width} by {height} pixels"
        ));
    }
    Ok(bytes)
}

/// The same by the crate `image`, whose samples are kept.
fn of_crate(file: &[u8], format: Format) -> Result<([u64; 2], u64), Fault> {
    let reader = ImageReader::with_format(Cursor::new(file), crate_format(format));
    let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions();
    let bytes = match format {
        // The crate for EXR has pixels of its own.
        Format::Exr => decoder.total_bytes().saturating_mul(2),
        _ => decoder.total_bytes(),
    };
    Ok(([width, height].map(u64::from), bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The head of a BMP file of eight bits in runs, and as many bytes of it as that.
    fn packed(width: u32, height: u32, length: usize) -> Vec<u8> {
        let mut file = b"BM\0\0\0\0\0\0\0\0\0\0\0\0\x28\0\0\0".to_vec();
        for number in [width, height, 0x8_0001, 1, 0, 0, 0, 0, 0] {
            file.extend(number.to_le_bytes());
        }
        file.resize(length, 0);
        file
    }

    #[test]
    fn a_few_bytes_cannot_hold_a_large_picture() {
        let of_few = bytes_to_decode(&packed(16_384, 16_384, 1_080), Format::Bmp);
        let why = "its 1080 bytes are too few for 16384 by 16384 pixels";
        assert_eq!(of_few, Err(why.to_owned()));
        let of_many = bytes_to_decode(&packed(16_384, 16_384, 20_000), Format::Bmp);
        assert_eq!(of_many, Ok(1 << 28));
        let too_large = bytes_to_decode(&packed(16_384, 16_385, 20_000), Format::Bmp);
        assert!(too_large.is_err_and(|why| why.contains("more than")));
    }

    #[test]
    fn a_picture_takes_its_samples() {
        let gray = b"P5 300 200 255\n";
        assert_eq!(bytes_to_decode(gray, Format::Pgm), Ok(60_000));
        let rgb = include_bytes!("../../../pov_scenes/texture/images/rgb.png");
        let size = png::size(rgb).expect("it is a PNG file").0;
        let bytes = size[0] * size[1] * 3;
        assert_eq!(bytes_to_decode(rgb, Format::Png), Ok(bytes));
    }
}
