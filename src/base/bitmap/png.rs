//! PNG: palettes keep their indices, gamma chunks are heeded, and grey of eight bits becomes what POV-Ray makes of it.

use super::decode::{self, Fault, Handling, of_picture};
use super::format::Format;
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
    let is_grey = info.color_type == ColorType::Grayscale && info.bit_depth != BitDepth::Sixteen;
    let mut reader = decoder.read_info().map_err(fault)?;
    let has_key = reader.info().trns.is_some();
    let transfer = handling.transfer(Format::Png, gamma_of(reader.info()));
    if is_grey && !has_key {
        let mut picture = by_crate(bytes)?.into_luma8();
        for level in picture.iter_mut() {
            *level = grey_as_pov(*level, transfer);
        }
        return of_picture(DynamicImage::ImageLuma8(picture), AS_IT_IS, handling);
    }
    // The reader is done with: the crate `image` takes the file once more.
    let _ = reader.finish();
    of_picture(by_crate(bytes)?, transfer, handling)
}

/// Values that are numbers of the scene already.
const AS_IT_IS: Transfer = Transfer {
    file: None,
    working: None,
};

fn by_crate(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    decode::by_crate(bytes, Format::Png)
}

/// The width and height of a file, and the bytes that decoding takes.
pub(super) fn size(bytes: &[u8]) -> Result<([u64; 2], u64), Fault> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    let info = decoder.read_header_info();
    let info = info.map_err(|error| error.to_string())?;
    let size = [info.width, info.height].map(u64::from);
    let samples = info.color_type.samples() as u64;
    let each = match (info.color_type, info.bit_depth) {
        (ColorType::Indexed, _) => 2,
        (_, BitDepth::Sixteen) => 2 * samples,
        _ => samples,
    };
    Ok((size, size[0].saturating_mul(size[1]).saturating_mul(each)))
}

/// The byte that POV-Ray keeps of a decoded grey of eight bits: the grey value of three equal channels in single
/// precision, cut off.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn grey_as_pov(level: u8, transfer: Transfer) -> u8 {
    let value = transfer.apply(f32::from(level) / 255.0);
    let grey = Rgb::splat(value).grey();
    (255.0 * grey) as u8
}

/// The gamma that the file says its values have.
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
    let alphas = info.trns.as_deref().unwrap_or_default();
    let stored = info.palette.as_deref().unwrap_or_default();
    let palette: Vec<Color> = stored
        .chunks_exact(3)
        .enumerate()
        .map(|(i, rgb)| palette_color(rgb, alphas.get(i).copied(), transfer))
        .collect();
    let has_alpha = !alphas.is_empty();
    let mut packed = vec![0; reader.output_buffer_size().ok_or("it is too large")?];
    let frame = reader.next_frame(&mut packed).map_err(fault)?;
    let mut indices = Vec::with_capacity(width * height);
    for row in packed.chunks_exact(frame.line_size).take(height) {
        let of_pixel = |x: usize| {
            let bit = x * bits;
            let byte = row.get(bit / 8).copied().unwrap_or_default();
            // The leftmost pixel is in the highest bits.
            let shifted = byte >> (8 - bits - bit % 8);
            shifted & (0xff >> (8 - bits))
        };
        indices.extend((0..width).map(of_pixel));
    }
    if indices.len() != width * height {
        return Err("it ends early".to_owned());
    }
    Ok(Bitmap {
        width,
        height,
        samples: Samples::Indexed(indices, palette),
        has_alpha,
        is_premultiplied: false,
    })
}

/// A colour of a palette.
pub(super) fn palette_color(rgb: &[u8], alpha: Option<u8>, transfer: Transfer) -> Color {
    let value = |i: usize| transfer.apply(f32::from(rgb[i]) / 255.0);
    Color {
        rgb: Rgb::new(value(0), value(1), value(2)),
        filter: 0.0,
        transmit: 1.0 - f32::from(alpha.unwrap_or(u8::MAX)) / 255.0,
    }
}
