//! BMP decoding that matches POV-Ray (measured): palette images keep their indices, and the fourth byte of 32-bit
//! pixels is alpha.
//!
//! The pixels of a palette image follow the palette directly; the pixel offset in the file header is ignored. Pixels
//! skipped by run-length data get the last palette entry, and so do all pixels of 1-bit images. Bit fields and 16-bit
//! pixels, which POV-Ray rejects, are decoded by the `image` crate.

use super::format::Format;
use super::handling::{Content, Fault, decode_by_crate};
use super::png::words;
use image::{DynamicImage, RgbImage, RgbaImage};

/// The file header and the info header.
struct Header {
    width: usize,
    height: usize,
    /// True if the file stores the top row first.
    is_from_top: bool,
    bits: u16,
    compression: u32,
    /// Bytes per palette entry.
    bytes_per_color: usize,
    colors: usize,
    /// File offset of the palette.
    palette: usize,
    /// File offset of the pixels, as the header states it.
    pixels: usize,
}

/// Width and height of the image, and the bytes that decoding needs; `None` for formats left to the `image` crate.
pub(super) fn size(bytes: &[u8]) -> Result<Option<([u64; 2], u64)>, Fault> {
    let Some(header) = Header::read(bytes) else {
        return Err("it is not a BMP file".to_owned());
    };
    let size = [header.width, header.height].map(|length| length as u64);
    let pixels = size[0].saturating_mul(size[1]);
    Ok(match (header.bits, header.compression) {
        (1 | 4 | 8, 0) | (8, 1) | (4, 2) => Some((size, pixels)),
        (24 | 32, 0) => Some((size, pixels.saturating_mul(4))),
        _ => None,
    })
}

/// Decodes the pixels of a file.
pub(super) fn content(bytes: &[u8]) -> Result<Content, Fault> {
    let header = Header::read(bytes).ok_or("it is not a BMP file")?;
    match (header.bits, header.compression) {
        (1 | 4 | 8, 0) | (8, 1) | (4, 2) => header.indexed(bytes),
        (24 | 32, 0) => header.colors(bytes).map(Content::Colors),
        _ => decode_by_crate(bytes, Format::Bmp).map(Content::Colors),
    }
}

impl Header {
    fn read(bytes: &[u8]) -> Option<Self> {
        let word = |at: usize| Some(u16::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
        let long = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
        let size = |at: usize| usize::try_from(long(at)?).ok();
        let pixels = size(10)?;
        let length = size(14)?;
        if !bytes.starts_with(b"BM") {
            return None;
        }
        let palette = length.checked_add(14)?;
        if length == 12 {
            let bits = word(24)?;
            return Some(Header {
                width: usize::from(word(18)?),
                height: usize::from(word(20)?),
                is_from_top: false,
                bits,
                compression: 0,
                bytes_per_color: 3,
                colors: default_palette_len(bits),
                palette,
                pixels,
            });
        }
        if length < 40 {
            return None;
        }
        let [width, height] = [18, 22].map(|at| long(at).map(u32::cast_signed));
        let bits = word(28)?;
        let colors = size(46)?;
        Some(Header {
            width: usize::try_from(width?).ok()?,
            height: usize::try_from(height?.unsigned_abs()).ok()?,
            is_from_top: height? < 0,
            bits,
            compression: long(30)?,
            bytes_per_color: 4,
            colors: if colors == 0 {
                default_palette_len(bits)
            } else {
                colors
            },
            palette,
            pixels,
        })
    }

    fn indexed(&self, bytes: &[u8]) -> Result<Content, Fault> {
        let ends_early = || "it ends early".to_owned();
        if self.colors > 256 {
            return Err("its palette is too large".to_owned());
        }
        let rest = bytes.get(self.palette..).ok_or_else(ends_early)?;
        let length = self.colors * self.bytes_per_color;
        let (palette, pixels) = rest.split_at_checked(length).ok_or_else(ends_early)?;
        let colors = palette.chunks_exact(self.bytes_per_color);
        let palette = colors.map(|color| words([color[2], color[1], color[0], u8::MAX]));
        let last = u8::try_from(self.colors.saturating_sub(1)).unwrap_or(u8::MAX);
        let mut indices = if self.compression == 0 {
            self.uncompressed(pixels).ok_or_else(ends_early)?
        } else {
            self.run_length(pixels, last).ok_or_else(ends_early)?
        };
        if self.bits == 1 {
            indices.fill(last);
        }
        Ok(Content::Indexed {
            width: self.width,
            height: self.height,
            indices,
            palette: palette.collect(),
        })
    }

    /// The rows from the top, without their padding to four bytes; `None` if the file ends early.
    fn rows<'a>(&self, pixels: &'a [u8]) -> Option<impl Iterator<Item = &'a [u8]>> {
        let bits = self.width.checked_mul(usize::from(self.bits))?;
        let stride = bits.div_ceil(32) * 4;
        let all = pixels.get(..stride.checked_mul(self.height)?)?;
        let (height, is_from_top) = (self.height, self.is_from_top);
        let row = move |y: usize| {
            let y = if is_from_top { y } else { height - 1 - y };
            &all[y * stride..][..bits.div_ceil(8)]
        };
        Some((0..height).map(row))
    }

    fn uncompressed(&self, pixels: &[u8]) -> Option<Vec<u8>> {
        let rows = self.rows(pixels)?;
        let mut indices = Vec::with_capacity(self.width * self.height);
        for row in rows {
            match self.bits {
                8 => indices.extend(row),
                4 => {
                    let nibbles = row.iter().flat_map(|byte| [byte >> 4, byte & 15]);
                    indices.extend(nibbles.take(self.width));
                }
                _ => {
                    let bits = row
                        .iter()
                        .flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1));
                    indices.extend(bits.take(self.width));
                }
            }
        }
        Some(indices)
    }

    /// Decodes run-length data (RLE8, RLE4). Pixels outside the image are dropped, and skipped pixels are `fill`.
    fn run_length(&self, pixels: &[u8], fill: u8) -> Option<Vec<u8>> {
        let mut indices = vec![fill; self.width * self.height];
        let mut bytes = pixels.iter().copied();
        let (mut x, mut y) = (0_usize, 0_usize);
        loop {
            let [count, value] = [bytes.next()?, bytes.next()?];
            match (count, value) {
                (0, 0) => (x, y) = (0, y.saturating_add(1)),
                (0, 1) => return Some(indices),
                (0, 2) => {
                    x = x.saturating_add(bytes.next()?.into());
                    y = y.saturating_add(bytes.next()?.into());
                }
                _ => {
                    let is_run = count > 0;
                    let length = usize::from(if is_run { count } else { value });
                    let mut row = self.row_mut(&mut indices, y);
                    let mut byte = value;
                    for at in 0..length {
                        let is_new = self.bits == 8 || at % 2 == 0;
                        if !is_run && is_new {
                            byte = bytes.next()?;
                        }
                        let index = match self.bits {
                            8 => byte,
                            _ if at % 2 == 0 => byte >> 4,
                            _ => byte & 15,
                        };
                        if let Some(pixel) = row.as_mut().and_then(|row| row.get_mut(x)) {
                            *pixel = index;
                        }
                        x = x.saturating_add(1);
                    }
                    let byte_count = if self.bits == 8 {
                        length
                    } else {
                        length.div_ceil(2)
                    };
                    if !is_run && byte_count % 2 == 1 {
                        bytes.next()?;
                    }
                }
            }
        }
    }

    /// The image row for row `y` of the file; `None` outside the image.
    fn row_mut<'a>(&self, indices: &'a mut [u8], y: usize) -> Option<&'a mut [u8]> {
        if y >= self.height {
            return None;
        }
        let y = if self.is_from_top {
            y
        } else {
            self.height - 1 - y
        };
        Some(&mut indices[y * self.width..][..self.width])
    }

    fn colors(&self, bytes: &[u8]) -> Result<DynamicImage, Fault> {
        let ends_early = || "it ends early".to_owned();
        let pixels = bytes.get(self.pixels..).ok_or_else(ends_early)?;
        let rows = self.rows(pixels).ok_or_else(ends_early)?;
        let bytes_per_pixel = usize::from(self.bits / 8);
        let mut samples = Vec::with_capacity(self.width * self.height * bytes_per_pixel);
        for row in rows {
            for pixel in row.chunks_exact(bytes_per_pixel) {
                samples.extend([pixel[2], pixel[1], pixel[0]]);
                samples.extend(pixel.get(3));
            }
        }
        let [width, height] = [self.width, self.height].map(|length| u32::try_from(length).ok());
        let (width, height) = width.zip(height).ok_or("it is too large")?;
        let image = if bytes_per_pixel == 3 {
            RgbImage::from_raw(width, height, samples).map(DynamicImage::ImageRgb8)
        } else {
            RgbaImage::from_raw(width, height, samples).map(DynamicImage::ImageRgba8)
        };
        image.ok_or_else(ends_early)
    }
}

/// The palette size where the header gives none.
fn default_palette_len(bits: u16) -> usize {
    if bits <= 8 { 1 << bits } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decodes RLE8 `data` of a 4×3 image.
    fn run_length(data: &[u8]) -> Option<Vec<u8>> {
        let header = Header {
            width: 4,
            height: 3,
            is_from_top: false,
            bits: 8,
            compression: 1,
            bytes_per_color: 4,
            colors: 256,
            palette: 54,
            pixels: 0,
        };
        header.run_length(data, 255)
    }

    #[test]
    fn runs_fill_rows_from_below_and_skipped_pixels_have_the_last_index() {
        let data = [2, 7, 0, 2, 1, 1, 9, 1, 0, 0, 0, 3, 1, 2, 3, 0, 9, 5, 0, 1];
        let rows = [1, 2, 3, 5, 255, 255, 255, 1, 7, 7, 255, 255];
        assert_eq!(run_length(&data), Some(rows.to_vec()));
    }

    #[test]
    fn run_length_data_without_an_end_is_rejected() {
        assert_eq!(run_length(&[4, 1, 0, 0]), None);
    }
}
