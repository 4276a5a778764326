//! Targa: 24 bits, or 32 with alpha, rows from the top.

use image::ExtendedColorType;
use image::codecs::tga::TgaEncoder;

use super::quantize;
use super::{EncodeOptions, EncodeResult, Format};
use crate::base::film::Film;

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let data = quantize::of(film, options)?;
    let color = if options.alpha {
        ExtendedColorType::Rgba8
    } else {
        ExtendedColorType::Rgb8
    };
    let mut file = Vec::new();
    let mut encoder = TgaEncoder::new(&mut file);
    if options.format != Format::CompressedTga {
        encoder = encoder.disable_rle();
    }
    encoder
        .encode(&data, film.width, film.height, color)
        .map_err(|e| e.to_string())?;
    Ok(file)
}
