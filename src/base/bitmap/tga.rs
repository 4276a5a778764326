//! TGA decoding that matches POV-Ray (measured): palette images keep their indices, five-bit channels are multiplied by
//! eight, the top bit of 16-bit pixels is alpha, and the flag for columns from the right is ignored.

use super::handling::{Content, Fault, check_size};
use super::png::words;
use image::{DynamicImage, GrayImage, RgbImage, RgbaImage};

const HEADER: usize = 18;

/// The file header.
struct Header {
    /// Bytes of the comment behind the header.
    comment: usize,
    has_palette: bool,
    /// Image type without the flag of run lengths: 1 palette, 2 colours, 3 grey.
    kind: u8,
    has_run_lengths: bool,
    /// Index of the first stored palette entry.
    first_color: usize,
    colors: usize,
    color_bits: u8,
    width: usize,
    height: usize,
    bits: u8,
    is_from_top: bool,
}

/// Decodes the pixels of a file.
pub(super) fn content(bytes: &[u8]) -> Result<Content, Fault> {
    let header = Header::read(bytes).ok_or("it is not a TGA file")?;
    check_size(header.width as u64, header.height as u64)?;
    let too_short = || "it is too short".to_owned();
    let palette_at = HEADER + header.comment;
    let palette_len = match header.has_palette {
        true => header.colors * bytes_of(header.color_bits),
        false => 0,
    };
    let palette = bytes.get(palette_at..palette_at + palette_len);
    let palette = palette.ok_or_else(too_short)?;
    let stored = &bytes[palette_at + palette_len..];
    let pixels = header.pixels(stored).ok_or_else(too_short)?;
    let (width, height) = (header.width, header.height);
    let sizes = || Some((u32::try_from(width).ok()?, u32::try_from(height).ok()?));
    let (w, h) = sizes().ok_or("it is too large")?;
    match (header.kind, header.bits) {
        (1, 8) if header.has_palette => {
            let entry = bytes_of(header.color_bits);
            let black = words([0, 0, 0, u8::MAX]);
            let colors = palette.chunks_exact(entry.max(1));
            let colors = colors.map(|color| words(rgba(color, header.color_bits)));
            let unstored = std::iter::repeat_n(black, header.first_color);
            Ok(Content::Indexed {
                width,
                height,
                indices: pixels,
                palette: unstored.chain(colors).collect(),
            })
        }
        (3, 8) => {
            let image = GrayImage::from_raw(w, h, pixels).ok_or_else(too_short)?;
            Ok(Content::Colors(DynamicImage::ImageLuma8(image)))
        }
        (2 | 3, 15 | 24) => {
            let pixels = pixels.chunks_exact(bytes_of(header.bits));
            let colors = pixels.flat_map(|pixel| {
                let [r, g, b, _] = rgba(pixel, header.bits);
                [r, g, b]
            });
            let image = RgbImage::from_raw(w, h, colors.collect()).ok_or_else(too_short)?;
            Ok(Content::Colors(DynamicImage::ImageRgb8(image)))
        }
        (2 | 3, 16 | 32) => {
            let pixels = pixels.chunks_exact(bytes_of(header.bits));
            let colors = pixels.flat_map(|pixel| rgba(pixel, header.bits));
            let image = RgbaImage::from_raw(w, h, colors.collect()).ok_or_else(too_short)?;
            Ok(Content::Colors(DynamicImage::ImageRgba8(image)))
        }
        (kind, bits) => Err(format!(
            "it is of the kind {kind} with {bits} bits per pixel"
        )),
    }
}

const fn bytes_of(bits: u8) -> usize {
    (bits as usize).div_ceil(8)
}

/// The colour of a pixel or palette entry of 15, 16, 24 or 32 bits.
fn rgba(stored: &[u8], bits: u8) -> [u8; 4] {
    match *stored {
        [low, high] => {
            let word = u16::from_le_bytes([low, high]);
            let five_bits = |shift: u32| (word >> shift << 3).to_le_bytes()[0];
            let [r, g, b] = [10, 5, 0].map(five_bits);
            let is_opaque = bits == 15 || word >> 15 == 1;
            [r, g, b, if is_opaque { u8::MAX } else { 0 }]
        }
        [b, g, r] => [r, g, b, u8::MAX],
        [b, g, r, a] => [r, g, b, a],
        _ => [0, 0, 0, u8::MAX],
    }
}

impl Header {
    fn read(bytes: &[u8]) -> Option<Self> {
        let header: &[u8; HEADER] = bytes.first_chunk()?;
        let word = |at: usize| usize::from(u16::from_le_bytes([header[at], header[at + 1]]));
        Some(Header {
            comment: usize::from(header[0]),
            has_palette: header[1] == 1,
            kind: header[2] & !8,
            has_run_lengths: header[2] & 8 != 0,
            first_color: word(3),
            colors: word(5),
            color_bits: header[7],
            width: word(12),
            height: word(14),
            bits: header[16],
            is_from_top: header[17] & 0x20 != 0,
        })
    }

    /// The stored pixels without run lengths, the top row first.
    fn pixels(&self, stored: &[u8]) -> Option<Vec<u8>> {
        let pixel = bytes_of(self.bits);
        let length = (self.width * self.height).checked_mul(pixel)?;
        let mut pixels = if self.has_run_lengths {
            let mut rest = stored;
            let mut pixels = Vec::new();
            while pixels.len() < length {
                let (&packet, behind) = rest.split_first()?;
                let count = usize::from(packet & 127) + 1;
                if packet & 128 == 0 {
                    pixels.extend_from_slice(behind.get(..count * pixel)?);
                    rest = &behind[count * pixel..];
                } else {
                    let one = behind.get(..pixel)?;
                    (0..count).for_each(|_| pixels.extend_from_slice(one));
                    rest = &behind[pixel..];
                }
            }
            pixels.truncate(length);
            pixels
        } else {
            stored.get(..length)?.to_vec()
        };
        if !self.is_from_top {
            let rows = pixels.chunks_exact((self.width * pixel).max(1)).rev();
            pixels = rows.flatten().copied().collect();
        }
        Some(pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_file_is_rejected() {
        let mut file = vec![0; HEADER];
        file[2] = 10;
        file[12..17].copy_from_slice(&[2, 0, 2, 0, 24]);
        assert!(content(&file).is_err());
        file.extend([0x83, 1, 2, 3]);
        let Ok(Content::Colors(image)) = content(&file) else {
            panic!("four equal pixels");
        };
        assert_eq!(image.into_rgb8().into_raw(), [3, 2, 1].repeat(4));
    }
}
