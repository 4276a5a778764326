//! Targa: 24 bits, or 32 with alpha, rows from the top.

use image::ExtendedColorType;
use image::codecs::tga::TgaEncoder;

use super::quantize;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// Targa without compression.
    pub const TGA: Format = Format(&FormatProperties {
        name: "TGA",
        letter: 'T',
        extensions: &["tga"],
        has_alpha: true,
        has_grey: false,
        has_words: false,
        is_linear: false,
        bits: 8,
        max_side: 65535,
    });

    /// Targa with run-length compression.
    pub const COMPRESSED_TGA: Format = Format(&FormatProperties {
        name: "compressed TGA",
        letter: 'C',
        extensions: &["tga"],
        has_alpha: true,
        has_grey: false,
        has_words: false,
        is_linear: false,
        bits: 8,
        max_side: 65535,
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
    let mut encoder = TgaEncoder::new(&mut file);
    if options.format != Format::COMPRESSED_TGA {
        encoder = encoder.disable_rle();
    }
    encoder
        .encode(&data, film.width, film.height, color)
        .map_err(|e| e.to_string())?;
    Ok(file)
}
