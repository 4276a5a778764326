//! JPEG: 8 bits, no alpha.

use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;

use super::quantize;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// JPEG.
    pub const JPEG: Format = Format(&FormatProperties {
        name: "JPEG",
        letter: 'J',
        extensions: &["jpg", "jpeg"],
        has_alpha: false,
        has_grey: false,
        has_words: false,
        is_linear: false,
        bits: 8,
        max_side: 65535,
    });
}

/// POV-Ray's default quality.
pub(crate) const POVRAY_QUALITY: u8 = 85;

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let data = quantize::levels_of(film, options)?;
    let quality = match options.quality {
        0 => POVRAY_QUALITY,
        q => q.min(100),
    };
    let mut file = Vec::new();
    JpegEncoder::new_with_quality(&mut file, quality)
        .encode(&data, film.width, film.height, ExtendedColorType::Rgb8)
        .map_err(|e| e.to_string())?;
    Ok(file)
}
