//! PNG: 8 or 16 bits, greyscale or colour, with or without alpha.
//!
//! Uses the fastest compression unless asked for more: the best would take several times as long as rendering a small
//! scene. The `gAMA` and
//! `sRGB` chunks are the same as POV-Ray's; a picture without gamma handling is declared as sRGB, as in POV-Ray.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter, chunk};
use std::io::Write;

use super::quantize::{self, Channels, Depth};
use super::{Effort, EncodeOptions, EncodeResult, Format, FormatProperties, WriteError};
use crate::base::color::Gamma;
use crate::base::film::Film;

impl Format {
    /// Portable Network Graphics.
    pub const PNG: Format = Format(&FormatProperties {
        name: "PNG",
        letter: 'N',
        extensions: &["png"],
        has_alpha: true,
        has_grey: true,
        has_words: true,
        is_linear: false,
        bits: 8,
        max_side: u32::MAX,
    });
}

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let data = quantize::levels_of(film, options)?;
    let mut file = Vec::with_capacity(data.len() / 2 + 1024);
    write_png(film, options, &data, &mut file).map_err(|e| e.to_string())?;
    Ok(file)
}

/// Encodes directly into `to`, which avoids a copy of the whole file in memory.
pub(super) fn write(
    film: &Film,
    options: &EncodeOptions,
    to: &mut impl Write,
) -> Result<(), WriteError> {
    let data = quantize::levels_of(film, options).map_err(WriteError::Format)?;
    write_png(film, options, &data, to).map_err(|error| match error {
        EncodingError::IoError(error) => WriteError::System(error),
        other => WriteError::Format(other.to_string()),
    })
}

fn write_png(
    film: &Film,
    options: &EncodeOptions,
    data: &[u8],
    file: &mut impl Write,
) -> Result<(), EncodingError> {
    let mut encoder = Encoder::new(file, film.width, film.height);
    encoder.set_color(match Channels::of(options) {
        Channels::Grey => ColorType::Grayscale,
        Channels::GreyAlpha => ColorType::GrayscaleAlpha,
        Channels::Rgb => ColorType::Rgb,
        Channels::RgbAlpha => ColorType::Rgba,
    });
    encoder.set_depth(match Depth::of(options) {
        Depth::Byte => BitDepth::Eight,
        Depth::Word => BitDepth::Sixteen,
    });
    match options.effort {
        Effort::Fastest => encoder.set_compression(Compression::Fastest),
        Effort::Balanced => {
            encoder.set_compression(Compression::Balanced);
            // The filter that adapts takes longer for the same size.
            encoder.set_filter(Filter::Sub);
        }
    }
    let mut writer = encoder.write_header()?;
    // Without gamma handling POV-Ray declares sRGB regardless of `File_Gamma`.
    let declared = match options.working {
        Some(_) => options.file_gamma,
        None => Gamma::Srgb,
    };
    let exponent = match declared {
        Gamma::Srgb => 45455,
        Gamma::Bt709 | Gamma::Bt2020 => 45000,
        Gamma::Power(g) => hundred_thousandths(1.0 / f64::from(g)),
    };
    writer.write_chunk(chunk::gAMA, &exponent.to_be_bytes())?;
    if declared == Gamma::Srgb {
        writer.write_chunk(chunk::sRGB, &[0])?;
    }
    writer.write_image_data(data)?;
    writer.finish()
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped before"
)]
fn hundred_thousandths(v: f64) -> u32 {
    (v * 100_000.0).round().clamp(1.0, 1e9) as u32
}
