//! PPM and PGM, binary: 8 or 16 bits, no alpha.

use super::levels::{self, Channels};
use super::{EncodeOptions, EncodeResult};
use crate::film::Film;

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let channels = Channels::of(options.grayscale, false);
    let kind = if options.grayscale { 5 } else { 6 };
    let (most, data) = if options.bits <= 8 {
        (255, levels::bytes(film, options, channels))
    } else {
        (65535, levels::words(film, options, channels))
    };
    let mut file = format!("P{kind}\n{} {}\n{most}\n", film.width, film.height).into_bytes();
    file.extend(data);
    Ok(file)
}
