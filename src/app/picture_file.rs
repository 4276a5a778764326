//! Picture files that the commands read and write.
//!
//! Files are decoded from memory and written as PNG only: the decoders and encoders of `image` are generic over their
//! streams, and each other stream compiles all formats once more.

use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, ImageBuffer, ImageFormat, ImageResult, PixelWithColorType};

/// Reads a picture in any format that povr reads, recognized by its content, else by its name.
///
/// # Errors
/// The file cannot be read or is no such picture.
pub fn open(path: &Path) -> ImageResult<DynamicImage> {
    let bytes = std::fs::read(path)?;
    let format = image::guess_format(&bytes).or_else(|_| ImageFormat::from_path(path))?;
    image::load_from_memory_with_format(&bytes, format)
}

/// An 8-bit picture as a PNG file in memory.
pub fn png<P>(picture: &ImageBuffer<P, Vec<u8>>, compression: CompressionType) -> Vec<u8>
where
    P: PixelWithColorType<Subpixel = u8>,
{
    let mut file = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut file, compression, FilterType::Adaptive);
    // Writing to memory cannot fail, and no picture of a command is empty.
    let _ = picture.write_with_encoder(encoder);
    file
}
