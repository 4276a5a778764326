//! PPM and PGM, binary: 8 or 16 bits, no alpha.

use super::quantize::{self, Depth};
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// Portable pixmap, or portable graymap for a greyscale picture.
    pub const PPM: Format = Format(&FormatProperties {
        name: "PPM",
        letter: 'P',
        extensions: &["ppm", "pgm", "pnm"],
        has_alpha: false,
        has_grey: true,
        has_words: true,
        is_linear: false,
        bits: 8,
    });
}

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let kind = if options.grayscale { 5 } else { 6 };
    let max_level = match Depth::of(options) {
        Depth::Byte => 255,
        Depth::Word => 65535,
    };
    let data = quantize::levels_of(film, options)?;
    let mut file = format!("P{kind}\n{} {}\n{max_level}\n", film.width, film.height).into_bytes();
    file.extend_from_slice(&data);
    Ok(file)
}
