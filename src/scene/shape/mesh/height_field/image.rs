//! The heights in a picture, as POV-Ray 3.7 finds them (measured): 16 bits of each pixel.
//!
//! * grey of 8 bits: the byte times 257; in a PNG without transparency the byte first goes through a sum in single
//!   precision that takes one from about half of all bytes;
//! * grey of 16 bits: as it is;
//! * a palette: the number of the colour times 256;
//! * colours of 8 bits: red times 256 plus green; of 16 bits: their grey.

use crate::base::args::{Sampled, Word};
use crate::base::bitmap::{self, BmpContent, Format};
use crate::base::color::Color;
use image::DynamicImage;
use std::io::Cursor;

/// The kinds of pictures: word, endings, and whether it is built.
pub(super) const KINDS: &[Kind] = &[
    Kind::new(Word::Png, &[".png", ".PNG"], Reading::Png),
    Kind::new(Word::Gif, &[".gif", ".GIF"], Reading::Gif),
    Kind::new(Word::Tga, &[".tga", ".TGA"], Reading::Tga),
    Kind::new(Word::Bmp, &[".bmp", ".BMP"], Reading::Bmp),
    Kind::new(Word::Ppm, &[".ppm", ".PPM"], Reading::Other(Format::Ppm)),
    Kind::new(Word::Pgm, &[".pgm", ".PGM"], Reading::Other(Format::Ppm)),
    Kind::new(
        Word::Jpeg,
        &[".jpg", ".JPG", ".jpeg", ".JPEG"],
        Reading::Other(Format::Jpeg),
    ),
    Kind::new(
        Word::Tiff,
        &[".tif", ".TIF", ".tiff", ".TIFF"],
        Reading::NotBuilt,
    ),
    Kind::new(Word::Exr, &[".exr", ".EXR"], Reading::NotBuilt),
    Kind::new(Word::Hdr, &[".hdr", ".HDR"], Reading::NotBuilt),
    Kind::new(Word::Pot, &[".pot", ".POT"], Reading::Pot),
    Kind::new(Word::Iff, &[".iff", ".IFF"], Reading::NotBuilt),
    Kind::new(Word::Sys, &[], Reading::NotBuilt),
];

/// Bytes that reading a picture may take.
const MAX_BYTES: u64 = 1 << 31;

/// A kind of pictures.
pub(super) struct Kind {
    pub(super) word: Word,
    pub(super) endings: &'static [&'static str],
    pub(super) reading: Reading,
}

/// How a kind of pictures is read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    Png,
    Gif,
    Tga,
    Bmp,
    /// A GIF whose left half has the high bytes and whose right half the low ones.
    Pot,
    Other(Format),
    /// Not at all.
    NotBuilt,
}

impl Kind {
    const fn new(word: Word, endings: &'static [&'static str], reading: Reading) -> Self {
        Kind {
            word,
            endings,
            reading,
        }
    }
}

/// The heights of a picture, row by row from the top.
pub(super) struct Heights {
    pub(super) width: usize,
    pub(super) rows: Vec<u16>,
}

impl Heights {
    /// The heights of a picture that a function has made: 16 bits of its grey. The grey of colours is cut, so that white
    /// of n steps is n or n - 1 steps high; numbers are as high as they are kept.
    pub(super) fn of_function(picture: &Sampled) -> Self {
        let shares = [0.297, 0.589, 0.114];
        let height = |color: &Color| {
            let channels = [color.rgb.r, color.rgb.g, color.rgb.b].map(f64::from);
            let steps = if picture.is_grey {
                (channels[0] * 65535.0).round()
            } else {
                let [r, g, b] = [0, 1, 2].map(|channel| shares[channel] * channels[channel]);
                (r + g + b) * 65535.0
            };
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "cut, and the cast saturates"
            )]
            let height = steps as u16;
            height
        };
        Heights {
            width: picture.width,
            rows: picture.colors.iter().map(height).collect(),
        }
    }
}

/// Why a picture cannot be read.
type Fault = Box<dyn std::error::Error + Send + Sync>;

impl Reading {
    /// The format of the file, if it is built.
    fn format(self) -> Option<Format> {
        Some(match self {
            Reading::Png => Format::Png,
            Reading::Gif | Reading::Pot => Format::Gif,
            Reading::Tga => Format::Tga,
            Reading::Bmp => Format::Bmp,
            Reading::Other(format) => format,
            Reading::NotBuilt => return None,
        })
    }
}

/// About how many bytes reading the heights of a picture takes.
pub(super) fn bytes_to_read(reading: Reading, bytes: &[u8]) -> Result<u64, String> {
    reading
        .format()
        .map_or(Ok(0), |format| bitmap::bytes_to_decode(bytes, format))
}

/// Reads the heights of a picture.
pub(super) fn heights(reading: Reading, bytes: &[u8]) -> Result<Heights, String> {
    let read = match reading {
        Reading::Png => png(bytes),
        Reading::Gif => gif(bytes),
        Reading::Tga => tga(bytes),
        Reading::Bmp => bmp(bytes),
        Reading::Pot => pot(bytes),
        Reading::Other(format) => other(format, bytes),
        Reading::NotBuilt => Err("this kind of pictures is not built yet".into()),
    };
    read.map_err(|fault| fault.to_string())
}

fn of_index(index: u8) -> u16 {
    u16::from(index) * 256
}

fn of_grey(byte: u8) -> u16 {
    u16::from(byte) * 257
}

fn of_color(red: u8, green: u8) -> u16 {
    u16::from(red) * 256 + u16::from(green)
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a mean of 16-bit numbers, without what stands behind its decimal point"
)]
fn of_deep_color([red, green, blue]: [u16; 3]) -> u16 {
    (0.297 * f64::from(red) + 0.589 * f64::from(green) + 0.114 * f64::from(blue)) as u16
}

/// A byte of a grey PNG after POV-Ray has taken it for a colour and back.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 255, and what stands behind the decimal point is lost"
)]
fn worn(byte: u8) -> u8 {
    let g = f32::from(byte) / 255.0;
    (255.0 * (0.297 * g + 0.589 * g + 0.114 * g)) as u8
}

fn png(bytes: &[u8]) -> Result<Heights, Fault> {
    let limits = png::Limits {
        bytes: usize::try_from(MAX_BYTES).unwrap_or(usize::MAX),
    };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info()?;
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    if size as u64 > MAX_BYTES {
        return Err("it is too large".into());
    }
    let mut buffer = vec![0; size];
    let frame = reader.next_frame(&mut buffer)?;
    let is_clear = reader.info().trns.is_some();
    let width = frame.width as usize;
    let lines = buffer
        .chunks_exact(frame.line_size)
        .take(frame.height as usize);
    let is_deep = frame.bit_depth == png::BitDepth::Sixteen;
    let depth = frame.bit_depth as u8;
    let mut rows = Vec::with_capacity(width * frame.height as usize);
    for line in lines {
        let deep = |at: usize| u16::from_be_bytes([line[2 * at], line[2 * at + 1]]);
        let pixels = 0..width;
        match (frame.color_type, is_deep) {
            (png::ColorType::Indexed, _) => {
                rows.extend(pixels.map(|x| of_index(packed(line, x, depth))));
            }
            (png::ColorType::Grayscale, true) => rows.extend(pixels.map(deep)),
            (png::ColorType::Grayscale, false) => rows.extend(pixels.map(|x| {
                let byte = scaled(packed(line, x, depth), depth);
                of_grey(if is_clear { byte } else { worn(byte) })
            })),
            (png::ColorType::GrayscaleAlpha, true) => rows.extend(pixels.map(|x| deep(2 * x))),
            (png::ColorType::GrayscaleAlpha, false) => {
                rows.extend(pixels.map(|x| of_grey(line[2 * x])));
            }
            (kind @ (png::ColorType::Rgb | png::ColorType::Rgba), is_deep) => {
                let step = kind.samples();
                rows.extend(pixels.map(|x| step * x).map(|at| {
                    if is_deep {
                        of_deep_color([deep(at), deep(at + 1), deep(at + 2)])
                    } else {
                        of_color(line[at], line[at + 1])
                    }
                }));
            }
        }
    }
    Ok(Heights { width, rows })
}

/// A sample of 1, 2, 4 or 8 bits of a line.
fn packed(line: &[u8], x: usize, depth: u8) -> u8 {
    let per_byte = usize::from(8 / depth.min(8));
    let shift = 8 - depth.min(8) as usize * (x % per_byte + 1);
    let mask = u8::MAX >> (8 - depth.min(8));
    (line[x / per_byte] >> shift) & mask
}

/// A sample of so many bits as one of eight.
fn scaled(sample: u8, depth: u8) -> u8 {
    sample * (u8::MAX / (u8::MAX >> (8 - depth.min(8))))
}

fn gif(bytes: &[u8]) -> Result<Heights, Fault> {
    let (width, rows) = indices(bytes)?;
    Ok(Heights {
        width,
        rows: rows.into_iter().map(of_index).collect(),
    })
}

/// The heights of Fractint: a byte from each half of a row. A column left over in the middle has no partner and is lost.
fn pot(bytes: &[u8]) -> Result<Heights, Fault> {
    let (wide, rows) = indices(bytes)?;
    let width = wide / 2;
    if width == 0 {
        return Err("it is too narrow for two bytes of a height".into());
    }
    let rows = rows.chunks_exact(wide).flat_map(|row| {
        let (high, low) = (&row[..width], &row[width..]);
        high.iter()
            .zip(low)
            .map(|(high, low)| of_color(*high, *low))
    });
    Ok(Heights {
        width,
        rows: rows.collect(),
    })
}

/// The width of a GIF and the numbers of the colours of its pixels, row by row.
fn indices(bytes: &[u8]) -> Result<(usize, Vec<u8>), Fault> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    options.set_memory_limit(gif::MemoryLimit::Unlimited);
    let mut decoder = options.read_info(Cursor::new(bytes))?;
    let is_interlaced = decoder
        .next_frame_info()?
        .is_some_and(|frame| frame.interlaced);
    let [width, height] = [decoder.width(), decoder.height()].map(usize::from);
    let mut pixels = vec![0; decoder.buffer_size()];
    decoder.read_into_buffer(&mut pixels)?;
    let rows = if is_interlaced {
        stored_order(height)
    } else {
        (0..height).collect()
    };
    let row = |row: usize| pixels.get(row * width..(row + 1) * width).unwrap_or(&[]);
    Ok((width, rows.into_iter().flat_map(row).copied().collect()))
}

/// The rows of an interlaced picture as the file has them. POV-Ray 3.7 takes them in this order (measured).
fn stored_order(height: usize) -> Vec<usize> {
    let passes = [(0, 8), (4, 8), (2, 4), (1, 2)];
    let rows = |(first, step)| (first..height).step_by(step);
    passes.into_iter().flat_map(rows).collect()
}

fn bmp(bytes: &[u8]) -> Result<Heights, Fault> {
    Ok(match bitmap::bmp_content(bytes)? {
        BmpContent::Colors(picture) => decoded(picture),
        BmpContent::Indexed { width, indices, .. } => Heights {
            width,
            rows: indices.into_iter().map(of_index).collect(),
        },
    })
}

fn tga(bytes: &[u8]) -> Result<Heights, Fault> {
    // The second byte says whether there is a palette, of which only the colours could be had.
    if bytes.get(1) == Some(&1) {
        return Err("a TGA file with a palette is not built yet".into());
    }
    other(Format::Tga, bytes)
}

fn other(format: Format, bytes: &[u8]) -> Result<Heights, Fault> {
    Ok(decoded(bitmap::picture(bytes, format)?))
}

fn decoded(image: DynamicImage) -> Heights {
    let width = image.width() as usize;
    let rows = match image {
        DynamicImage::ImageLuma8(image) => image.pixels().map(|p| of_grey(p.0[0])).collect(),
        DynamicImage::ImageLumaA8(image) => image.pixels().map(|p| of_grey(p.0[0])).collect(),
        DynamicImage::ImageLuma16(image) => image.into_raw(),
        DynamicImage::ImageLumaA16(image) => image.pixels().map(|p| p.0[0]).collect(),
        DynamicImage::ImageRgb16(image) => image.pixels().map(|p| of_deep_color(p.0)).collect(),
        colors => {
            let colors = colors.into_rgb8();
            colors.pixels().map(|p| of_color(p.0[0], p.0[1])).collect()
        }
    };
    Heights { width, rows }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_samples_are_unpacked_from_the_left() {
        assert_eq!(
            [0, 1, 2, 3].map(|x| packed(&[0b1101_1000], x, 2)),
            [3, 1, 2, 0]
        );
        assert_eq!(packed(&[1, 77], 1, 8), 77);
        assert_eq!((scaled(1, 1), scaled(3, 2), scaled(5, 4)), (255, 255, 85));
    }

    #[test]
    fn grey_bytes_of_a_png_wear() {
        // Measured with POV-Ray 3.7.
        assert_eq!(
            [202, 221, 129, 121, 255].map(worn),
            [202, 220, 129, 120, 255]
        );
    }

    #[test]
    fn a_pot_file_has_a_byte_from_each_half_of_a_row() {
        let bytes = include_bytes!("../../../../../pov_scenes/shape/heights/potential.pot");
        let (wide, rows) = indices(bytes).expect("it is a GIF");
        let found = heights(Reading::Pot, bytes).expect("it has heights");
        assert_eq!((wide, found.width), (48, 24));
        let (high, low) = (u16::from(rows[5]), u16::from(rows[5 + 24]));
        assert_eq!(found.rows[5], 256 * high + low);
    }
}
