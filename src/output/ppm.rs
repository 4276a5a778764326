//! PPM and PGM, binary or plain (decimal numbers, a line for each pixel): 1 to 16 bits, no alpha.

use super::quantize::{self, Depth, bits_of, max_level};
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
        max_side: u32::MAX,
    });
}

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let kind = match (options.is_plain, options.grayscale) {
        (true, true) => 2,
        (true, false) => 3,
        (false, true) => 5,
        (false, false) => 6,
    };
    let bits = bits_of(options);
    let data = quantize::levels_of(film, options)?;
    let (width, height, max_level) = (film.width, film.height, max_level(bits));
    let mut file = format!("P{kind}\n{width} {height}\n{max_level}\n").into_bytes();
    // The high bits are the level, the others repeat them.
    match Depth::of(options) {
        Depth::Byte => {
            let levels = data.iter().map(|&byte| byte >> (8 - bits));
            match options.is_plain {
                true => write_plain(levels.map(u16::from), options, &mut file),
                false => file.extend(levels),
            }
        }
        Depth::Word => {
            let words = data.as_chunks().0.iter().copied();
            let levels = words.map(|word| u16::from_be_bytes(word) >> (16 - bits));
            match options.is_plain {
                true => write_plain(levels, options, &mut file),
                false => file.extend(levels.flat_map(u16::to_be_bytes)),
            }
        }
    }
    Ok(file)
}

/// Writes levels as decimal numbers, those of a pixel on one line as in POV-Ray.
fn write_plain(levels: impl Iterator<Item = u16>, options: &EncodeOptions, file: &mut Vec<u8>) {
    let ends: &[u8] = if options.grayscale { b"\n" } else { b"  \n" };
    for (level, &end) in levels.zip(ends.iter().cycle()) {
        file.extend_from_slice(level.to_string().as_bytes());
        file.push(end);
    }
}
