//! Radiance HDR: linear light, with a shared exponent for the three channels.

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
        max_side: u32::MAX,
    });
}

/// The limit of the shared exponent is 2^127; this is slightly less.
const MAX_VALUE: f32 = 1.7e38;

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let linear = to_linear(options.working);
    // NaN and negative values become black: the format cannot store them.
    let stored = |c| match linear(c) {
        light if light > 0.0 => light.min(MAX_VALUE),
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
