//! PGM and PPM decoding that matches POV-Ray (measured): samples are divided by a maximum other than 255 and 65535.

use super::format::Format;
use super::handling::{Fault, decode_by_crate};
use image::DynamicImage;

/// Decodes the samples of a file.
pub(super) fn samples(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    let image = decode_by_crate(bytes, Format::Ppm)?;
    let Some(most) = divisor(bytes).map(f32::from) else {
        return Ok(image);
    };
    let mut image = image.into_rgb32f();
    // The decoder has scaled them to bytes or words.
    let samples = image.iter_mut();
    samples.for_each(|sample| *sample = (*sample * most).round() / most);
    Ok(DynamicImage::ImageRgb32F(image))
}

/// The maximum of samples, if they are divided by it.
pub(crate) fn divisor(bytes: &[u8]) -> Option<u16> {
    maximum(bytes).filter(|most| ![255, 65535].contains(most))
}

/// The maximum that the header of a file of numbers states for samples.
fn maximum(bytes: &[u8]) -> Option<u16> {
    matches!(bytes.get(1)?, b'2' | b'3' | b'5' | b'6').then_some(())?;
    let mut last = None;
    let mut rest = bytes.get(2..)?;
    // Width, height and the maximum.
    for _ in 0..3 {
        loop {
            rest = rest.trim_ascii_start();
            match rest.first()? {
                b'#' => rest = &rest[rest.iter().position(|&byte| byte == b'\n')?..],
                _ => break,
            }
        }
        let (digits, behind) = rest.split_at(rest.iter().position(u8::is_ascii_whitespace)?);
        last = std::str::from_utf8(digits).ok();
        rest = behind;
    }
    last?.parse().ok().filter(|&most| most > 0)
}
