//! Radiance: linear light, a common exponent for the three channels.

use image::Rgb;
use image::codecs::hdr::HdrEncoder;

use super::quantize::to_linear;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// Radiance.
    pub const HDR: Format = Format(&FormatProperties {
        name: "HDR",
        letter: 'H',
        extensions: &["hdr"],
        has_alpha: false,
        has_grey: false,
        has_words: false,
        is_linear: true,
        bits: 8,
    });
}

/// The largest value the common exponent can name, 2^127, and a little less.
const BRIGHTEST: f32 = 1.7e38;

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let linear = to_linear(options.working);
    // What is no number, and what is negative, is black: the format has no such values.
    let stored = |c| match linear(c) {
        light if light > 0.0 => light.min(BRIGHTEST),
        _ => 0.0,
    };
    let pixels: Vec<Rgb<f32>> = film
        .pixels
        .iter()
        .map(|p| Rgb([stored(p.rgb.r), stored(p.rgb.g), stored(p.rgb.b)]))
        .collect();
    let mut file = Vec::new();
    HdrEncoder::new(&mut file)
        .encode(&pixels, film.width as usize, film.height as usize)
        .map_err(|e| e.to_string())?;
    Ok(file)
}
