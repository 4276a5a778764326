//! BMP: palettes keep their indices, and 32 bits hold alpha, as POV-Ray reads them (measured).
//!
//! The pixels of a palette follow it at once, whatever the head of the file says of their place. Packed pixels that the
//! file passes over have the last colour of the palette, and so have all pixels of one bit. Bit fields and pixels of 16
//! bits, which POV-Ray refuses, are left to the crate `image`.

use super::decode::{Fault, Handling, by_crate, of_picture};
use super::format::Format;
use super::png::palette_color;
use super::{Bitmap, Samples};
use image::{DynamicImage, RgbImage, RgbaImage};

/// A picture as the file has it.
pub(crate) enum Content {
    /// Indices into a palette of red, green and blue.
    Indexed {
        width: usize,
        height: usize,
        indices: Vec<u8>,
        palette: Vec<[u8; 3]>,
    },
    /// Colours.
    Colors(DynamicImage),
}

/// The head of a file.
struct Head {
    width: usize,
    height: usize,
    /// True if the rows begin at the top.
    is_from_top: bool,
    bits: u16,
    packing: u32,
    /// Bytes of a colour of the palette.
    color_bytes: usize,
    colors: usize,
    /// Where the palette begins.
    palette: usize,
    /// Where the pixels begin, as the file says.
    pixels: usize,
}

pub(super) fn decode(bytes: &[u8], handling: &Handling) -> Result<Bitmap, Fault> {
    let transfer = handling.transfer(Format::Bmp, None);
    match content(bytes)? {
        Content::Colors(picture) => of_picture(picture, transfer, handling),
        Content::Indexed {
            width,
            height,
            indices,
            palette,
        } => {
            let colors = palette.iter();
            let palette = colors.map(|rgb| palette_color(rgb, None, transfer));
            Ok(Bitmap {
                width,
                height,
                samples: Samples::Indexed(indices, palette.collect()),
                has_alpha: false,
                is_premultiplied: false,
            })
        }
    }
}

/// The width and height of a file, and the bytes that decoding takes; `None` for what is left to the crate `image`.
pub(super) fn size(bytes: &[u8]) -> Result<Option<([u64; 2], u64)>, Fault> {
    let Some(head) = Head::read(bytes) else {
        return Err("it is no BMP file".to_owned());
    };
    let size = [head.width, head.height].map(|length| length as u64);
    let pixels = size[0].saturating_mul(size[1]);
    Ok(match (head.bits, head.packing) {
        (1 | 4 | 8, 0) | (8, 1) | (4, 2) => Some((size, pixels)),
        (24 | 32, 0) => Some((size, pixels.saturating_mul(4))),
        _ => None,
    })
}

/// The pixels of a file.
pub(crate) fn content(bytes: &[u8]) -> Result<Content, Fault> {
    let head = Head::read(bytes).ok_or("it is no BMP file")?;
    match (head.bits, head.packing) {
        (1 | 4 | 8, 0) | (8, 1) | (4, 2) => head.indexed(bytes),
        (24 | 32, 0) => head.colors(bytes).map(Content::Colors),
        _ => by_crate(bytes, Format::Bmp).map(Content::Colors),
    }
}

impl Head {
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
            return Some(Head {
                width: usize::from(word(18)?),
                height: usize::from(word(20)?),
                is_from_top: false,
                bits,
                packing: 0,
                color_bytes: 3,
                colors: colors_of(bits),
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
        Some(Head {
            width: usize::try_from(width?).ok()?,
            height: usize::try_from(height?.unsigned_abs()).ok()?,
            is_from_top: height? < 0,
            bits,
            packing: long(30)?,
            color_bytes: 4,
            colors: if colors == 0 { colors_of(bits) } else { colors },
            palette,
            pixels,
        })
    }

    fn indexed(&self, bytes: &[u8]) -> Result<Content, Fault> {
        let early = || "it ends early".to_owned();
        if self.colors > 256 {
            return Err("its palette is too large".to_owned());
        }
        let rest = bytes.get(self.palette..).ok_or_else(early)?;
        let length = self.colors * self.color_bytes;
        let (palette, pixels) = rest.split_at_checked(length).ok_or_else(early)?;
        let colors = palette.chunks_exact(self.color_bytes);
        let palette = colors.map(|color| [color[2], color[1], color[0]]).collect();
        let last = u8::try_from(self.colors.saturating_sub(1)).unwrap_or(u8::MAX);
        let mut indices = if self.packing == 0 {
            self.plain(pixels).ok_or_else(early)?
        } else {
            self.packed(pixels, last).ok_or_else(early)?
        };
        if self.bits == 1 {
            indices.fill(last);
        }
        Ok(Content::Indexed {
            width: self.width,
            height: self.height,
            indices,
            palette,
        })
    }

    /// The rows of the file from the top, without what fills them up to four bytes; `None` if it ends early.
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

    fn plain(&self, pixels: &[u8]) -> Option<Vec<u8>> {
        let rows = self.rows(pixels)?;
        let mut indices = Vec::with_capacity(self.width * self.height);
        for row in rows {
            match self.bits {
                8 => indices.extend(row),
                4 => {
                    let halves = row.iter().flat_map(|byte| [byte >> 4, byte & 15]);
                    indices.extend(halves.take(self.width));
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

    /// The indices of runs; what runs over an edge is lost, and what they pass over is `untouched`.
    fn packed(&self, pixels: &[u8], untouched: u8) -> Option<Vec<u8>> {
        let mut indices = vec![untouched; self.width * self.height];
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
                    let taken = if self.bits == 8 {
                        length
                    } else {
                        length.div_ceil(2)
                    };
                    if !is_run && taken % 2 == 1 {
                        bytes.next()?;
                    }
                }
            }
        }
    }

    /// A row of the picture by its number in the file.
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
        let early = || "it ends early".to_owned();
        let pixels = bytes.get(self.pixels..).ok_or_else(early)?;
        let rows = self.rows(pixels).ok_or_else(early)?;
        let step = usize::from(self.bits / 8);
        let mut samples = Vec::with_capacity(self.width * self.height * step);
        for row in rows {
            for pixel in row.chunks_exact(step) {
                samples.extend([pixel[2], pixel[1], pixel[0]]);
                samples.extend(pixel.get(3));
            }
        }
        let [width, height] = [self.width, self.height].map(|length| u32::try_from(length).ok());
        let (width, height) = width.zip(height).ok_or("it is too large")?;
        let picture = if step == 3 {
            RgbImage::from_raw(width, height, samples).map(DynamicImage::ImageRgb8)
        } else {
            RgbaImage::from_raw(width, height, samples).map(DynamicImage::ImageRgba8)
        };
        picture.ok_or_else(early)
    }
}

/// The colours of a palette whose size is not written.
fn colors_of(bits: u16) -> usize {
    if bits <= 8 { 1 << bits } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 4 by 3 pixels of eight bits with the colours 0 to 3.
    fn packed(data: &[u8]) -> Option<Vec<u8>> {
        let head = Head {
            width: 4,
            height: 3,
            is_from_top: false,
            bits: 8,
            packing: 1,
            color_bytes: 4,
            colors: 256,
            palette: 54,
            pixels: 0,
        };
        head.packed(data, 255)
    }

    #[test]
    fn runs_fill_rows_from_below_and_what_is_passed_over_has_the_last_index() {
        let data = [2, 7, 0, 2, 1, 1, 9, 1, 0, 0, 0, 3, 1, 2, 3, 0, 9, 5, 0, 1];
        let rows = [1, 2, 3, 5, 255, 255, 255, 1, 7, 7, 255, 255];
        assert_eq!(packed(&data), Some(rows.to_vec()));
    }

    #[test]
    fn packed_data_without_an_end_are_refused() {
        assert_eq!(packed(&[4, 1, 0, 0]), None);
    }
}
