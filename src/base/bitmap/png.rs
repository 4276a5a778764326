//! PNG decoding. Palette images keep their indices, gamma chunks (`gAMA`, `sRGB`) are applied, and 8-bit grey is
//! rounded as POV-Ray rounds it.

use super::format::Format;
use super::handling;
use super::handling::{Fault, Handling, bitmap_from_image};
use super::{Bitmap, Samples, Transfer};
use crate::base::color::{Color, Gamma, Rgb};
use image::DynamicImage;
use png::{BitDepth, ColorType, Decoder, Info, Transformations};
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], handling: &Handling) -> Result<Bitmap, Fault> {
    let fault = |error: png::DecodingError| error.to_string();
    let mut decoder = Decoder::new(Cursor::new(bytes));
    let info = decoder.read_header_info().map_err(fault)?;
    if info.color_type == ColorType::Indexed {
        decoder.set_transformations(Transformations::IDENTITY);
        return indexed(decoder, handling);
    }
    let is_8_bit_grey =
        info.color_type == ColorType::Grayscale && info.bit_depth != BitDepth::Sixteen;
    let mut reader = decoder.read_info().map_err(fault)?;
    let has_transparency_chunk = reader.info().trns.is_some();
    let has_clear_color = has_transparency_chunk && reader.info().color_type == ColorType::Rgb;
    let transfer = handling.transfer(Format::Png, gamma_of(reader.info()));
    if is_8_bit_grey && !has_transparency_chunk {
        let mut image = decode_by_crate(bytes)?.into_luma8();
        if !(handling.keeps_grey && transfer.is_identity()) {
            for level in image.iter_mut() {
                *level = pov_grey(*level, transfer);
            }
        }
        return bitmap_from_image(DynamicImage::ImageLuma8(image), IDENTITY, handling);
    }
    // This reader served for the chunks only; the `image` crate decodes the file again from the start.
    let _ = reader.finish();
    let image = decode_by_crate(bytes)?;
    let image = match image {
        // The colour that the file declares clear is opaque in POV-Ray.
        DynamicImage::ImageRgba8(_) if has_clear_color => image.into_rgb8().into(),
        DynamicImage::ImageRgba16(_) if has_clear_color => image.into_rgb16().into(),
        image => image,
    };
    bitmap_from_image(image, transfer, handling)
}

/// The identity transfer, for values already in the working space.
const IDENTITY: Transfer = Transfer {
    file: None,
    working: None,
};

fn decode_by_crate(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    handling::decode_by_crate(bytes, Format::Png)
}

/// Width and height of the image, and the bytes that decoding needs.
pub(super) fn size(bytes: &[u8]) -> Result<([u64; 2], u64), Fault> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    let info = decoder.read_header_info();
    let info = info.map_err(|error| error.to_string())?;
    let size = [info.width, info.height].map(u64::from);
    let samples = info.color_type.samples() as u64;
    let bytes_per_pixel = match (info.color_type, info.bit_depth) {
        (ColorType::Indexed, _) => 2,
        (_, BitDepth::Sixteen) => 2 * samples,
        _ => samples,
    };
    Ok((
        size,
        size[0]
            .saturating_mul(size[1])
            .saturating_mul(bytes_per_pixel),
    ))
}

/// 8-bit grey after decoding, as POV-Ray stores it: the luminance of three equal channels in single precision,
/// truncated to a byte.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn pov_grey(level: u8, transfer: Transfer) -> u8 {
    let value = transfer.apply(f32::from(level) / 255.0);
    let grey = Rgb::splat(value).grey();
    (255.0 * grey) as u8
}

/// The gamma declared by the file's `sRGB` or `gAMA` chunk.
fn gamma_of(info: &Info) -> Option<Gamma> {
    if info.srgb.is_some() {
        return Some(Gamma::Srgb);
    }
    let encoded = f64::from(info.gama_chunk?.into_value());
    (encoded > 0.0).then(|| Gamma::power(1.0 / encoded))
}

fn indexed(decoder: Decoder<Cursor<&[u8]>>, handling: &Handling) -> Result<Bitmap, Fault> {
    let fault = |error: png::DecodingError| error.to_string();
    let mut reader = decoder.read_info().map_err(fault)?;
    let info = reader.info();
    let transfer = handling.transfer(Format::Png, gamma_of(info));
    let (width, height) = (info.width as usize, info.height as usize);
    let bits = info.bit_depth as usize;
    let alpha_entries = info.trns.as_deref().unwrap_or_default();
    let rgb_entries = info.palette.as_deref().unwrap_or_default();
    let palette: Vec<Color> = rgb_entries
        .chunks_exact(3)
        .enumerate()
        .map(|(i, rgb)| {
            let alpha = alpha_entries.get(i).copied().unwrap_or(u8::MAX);
            palette_color(words([rgb[0], rgb[1], rgb[2], alpha]), transfer)
        })
        .collect();
    let has_alpha = !alpha_entries.is_empty();
    let mut packed = vec![0; reader.output_buffer_size().ok_or("it is too large")?];
    let frame = reader.next_frame(&mut packed).map_err(fault)?;
    let mut indices = Vec::with_capacity(width * height);
    for row in packed.chunks_exact(frame.line_size).take(height) {
        let index_at = |x: usize| {
            let bit = x * bits;
            let byte = row.get(bit / 8).copied().unwrap_or_default();
            // The leftmost pixel is in the most significant bits.
            let shifted = byte >> (8 - bits - bit % 8);
            shifted & (0xff >> (8 - bits))
        };
        indices.extend((0..width).map(index_at));
    }
    if indices.len() != width * height {
        return Err("it ends early".to_owned());
    }
    Ok(Bitmap {
        width,
        height,
        samples: Samples::Indexed(indices, palette),
        has_alpha,
        stores_alpha: false,
        is_premultiplied: handling.is_premultiplied.unwrap_or(false),
    })
}

/// Samples of 8 bits in 16 bits.
pub(super) fn words(rgba: [u8; 4]) -> [u16; 4] {
    rgba.map(|sample| u16::from(sample) * 257)
}

/// A palette entry, of 16 bits each, as a scene colour.
pub(super) fn palette_color(rgba: [u16; 4], transfer: Transfer) -> Color {
    let [r, g, b, alpha] = rgba.map(|sample| f32::from(sample) / 65535.0);
    let [r, g, b] = [r, g, b].map(|stored| transfer.apply(stored));
    Color {
        rgb: Rgb::new(r, g, b),
        filter: 0.0,
        transmit: 1.0 - alpha,
    }
}
