//! Targa: 24 bits, or 32 with alpha, rows from the top.

use image::ExtendedColorType;
use image::codecs::tga::TgaEncoder;

use super::quantize;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;
use std::ops::Range;

/// The length of the header, and the place of the picture's height in it.
const HEADER_BYTES: usize = 18;
const HEIGHT_BYTES: Range<usize> = 14..16;

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
    if options.format != Format::COMPRESSED_TGA {
        let mut file = Vec::new();
        let encoder = TgaEncoder::new(&mut file).disable_rle();
        let encoded = encoder.encode(&data, film.width, film.height, color);
        return encoded.map(|()| file).map_err(|e| e.to_string());
    }
    // Packets end with their row: readers refuse those that do not.
    let row_bytes = film.width as usize * if options.alpha { 4 } else { 3 };
    let mut file = Vec::new();
    for row in data.chunks(row_bytes) {
        let mut encoded = Vec::new();
        TgaEncoder::new(&mut encoded)
            .encode(row, film.width, 1, color)
            .map_err(|e| e.to_string())?;
        match file.is_empty() {
            true => file = encoded,
            false => file.extend(&encoded[HEADER_BYTES..]),
        }
    }
    let height = u16::try_from(film.height).map_err(|e| e.to_string())?;
    file[HEIGHT_BYTES].copy_from_slice(&height.to_le_bytes());
    Ok(file)
}
