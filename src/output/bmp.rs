//! Windows bitmap: 24 bits, or 32 with alpha.

use image::ExtendedColorType;
use image::codecs::bmp::BmpEncoder;

use super::quantize;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// Windows bitmap.
    pub const BMP: Format = Format(&FormatProperties {
        name: "BMP",
        letter: 'B',
        extensions: &["bmp"],
        has_alpha: true,
        has_grey: false,
        has_words: false,
        is_linear: false,
        bits: 8,
        max_side: u32::MAX,
    });
}

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let data = quantize::levels_of(film, options)?;
    let color = if options.alpha {
        ExtendedColorType::Rgba8
    } else {
        ExtendedColorType::Rgb8
    };
    let mut file = Vec::new();
    BmpEncoder::new(&mut file)
        .encode(&data, film.width, film.height, color)
        .map_err(|e| e.to_string())?;
    Ok(file)
}
