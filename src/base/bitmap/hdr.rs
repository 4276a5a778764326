//! Radiance HDR decoding that matches POV-Ray (measured): each channel is `(m + 0.5) * 2^(e - 136)`, and black if the
//! exponent is 0.

use super::handling::{Fault, check_size};
use image::{DynamicImage, Rgb32FImage};

/// Decodes the pixels of a file whose rows run from the top left.
pub(super) fn decode(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    let (width, height, stored) = header(bytes).ok_or("it is not an HDR file from the top left")?;
    check_size(u64::from(width), u64::from(height))?;
    let mut rest = stored;
    let mut samples = Vec::new();
    for _ in 0..height {
        let row = row(&mut rest, width as usize).ok_or("it is too short")?;
        samples.extend(row.into_iter().flat_map(rgb));
    }
    let image = Rgb32FImage::from_raw(width, height, samples).ok_or("it is too short")?;
    Ok(DynamicImage::ImageRgb32F(image))
}

/// Width, height and the bytes of the pixels.
fn header(bytes: &[u8]) -> Option<(u32, u32, &[u8])> {
    if !bytes.starts_with(b"#?") {
        return None;
    }
    let blank = bytes.windows(2).position(|pair| pair == b"\n\n")? + 2;
    let end = blank + bytes[blank..].iter().position(|&byte| byte == b'\n')?;
    let mut words = std::str::from_utf8(&bytes[blank..end])
        .ok()?
        .split_whitespace();
    let (y, height, x, width) = (words.next()?, words.next()?, words.next()?, words.next()?);
    (y == "-Y" && x == "+X").then_some(())?;
    Some((width.parse().ok()?, height.parse().ok()?, &bytes[end + 1..]))
}

/// Takes the next row: four channels in run lengths, or plain pixels with runs of the old kind.
fn row(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    let first: [u8; 4] = *rest.first_chunk()?;
    let mut row = vec![[0; 4]; width];
    let is_by_channel = first[0] == 2 && first[1] == 2 && first[2] < 128;
    if is_by_channel && usize::from(u16::from_be_bytes([first[2], first[3]])) == width {
        *rest = &rest[4..];
        for channel in 0..4 {
            let mut at = 0;
            while at < width {
                let count = take(rest)?;
                let is_run = count > 128;
                let value = if is_run { take(rest)? } else { 0 };
                for _ in 0..if is_run { count & 127 } else { count } {
                    row.get_mut(at)?[channel] = if is_run { value } else { take(rest)? };
                    at += 1;
                }
            }
        }
        return Some(row);
    }
    let (mut at, mut shift) = (0, 0);
    while at < width {
        let pixel: [u8; 4] = *rest.first_chunk()?;
        *rest = &rest[4..];
        if pixel[..3] == [1; 3] {
            let last = *row.get(at.checked_sub(1)?)?;
            for _ in 0..usize::from(pixel[3]).checked_shl(shift)? {
                *row.get_mut(at)? = last;
                at += 1;
            }
            shift += 8;
        } else {
            row[at] = pixel;
            at += 1;
            shift = 0;
        }
    }
    Some(row)
}

fn take(rest: &mut &[u8]) -> Option<u8> {
    let (&byte, behind) = rest.split_first()?;
    *rest = behind;
    Some(byte)
}

fn rgb([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = f32::from(exponent) - 136.0;
    [r, g, b].map(|mantissa| (f32::from(mantissa) + 0.5) * unit.exp2())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_may_have_runs_of_either_kind_or_none() {
        let file = |pixels: &[u8]| [b"#?RADIANCE\n\n-Y 1 +X 8\n", pixels].concat();
        let samples = |pixels: &[u8]| decode(&file(pixels)).map(|it| it.into_rgb32f().into_raw());
        let plain = samples(&[9, 8, 7, 129].repeat(8)).unwrap();
        assert_eq!(plain[..3], [9.5 / 128.0, 8.5 / 128.0, 7.5 / 128.0]);
        let old = [9, 8, 7, 129, 1, 1, 1, 7];
        assert_eq!(samples(&old).unwrap(), plain);
        let new = [2, 2, 0, 8, 136, 9, 136, 8, 136, 7, 136, 129];
        assert_eq!(samples(&new).unwrap(), plain);
        assert!(samples(&new[..11]).is_err());
        assert_eq!(samples(&[9, 8, 7, 0].repeat(8)).unwrap(), [0.0; 24]);
    }
}
