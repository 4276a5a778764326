//! Heights from the pixels of an image as POV-Ray 3.7 reads them (measured), 16 bits per pixel:
//!
//! * 8-bit grey: the byte times 257; in a PNG without transparency the byte first goes through a sum in single
//!   precision that lowers about half of all values by one;
//! * 16-bit grey: unchanged;
//! * grey of a PGM with another maximum: 65535 times its share of that, cut;
//! * palette: the index times 256;
//! * 8-bit colour: red times 256 plus green; 16-bit colour: its grey value; HDR, and a PPM with a maximum below 255: the
//!   sum of red times 256 and green, times 255, modulo 65536.
//!
//! `gamma` decodes the samples to linear light first, whatever the gamma of the scene; indices stay. The gamma that a
//! file declares has no effect.

use crate::base::args::{SampledFunction, Word};
use crate::base::bitmap::{self, Content, Format};
use crate::base::color::{Color, Gamma, Rgb};
use image::DynamicImage;
use std::io::Cursor;

/// The image formats: keyword, file name endings, and decoder.
pub(super) const KINDS: &[Kind] = &[
    Kind::new(Word::Png, &[".png", ".PNG"], Decoder::Png),
    Kind::new(Word::Gif, &[".gif", ".GIF"], Decoder::Gif),
    Kind::new(Word::Tga, &[".tga", ".TGA"], Decoder::Other(Format::Tga)),
    Kind::new(Word::Bmp, &[".bmp", ".BMP"], Decoder::Other(Format::Bmp)),
    Kind::new(Word::Ppm, &[".ppm", ".PPM"], Decoder::Other(Format::Ppm)),
    Kind::new(Word::Pgm, &[".pgm", ".PGM"], Decoder::Other(Format::Ppm)),
    Kind::new(
        Word::Jpeg,
        &[".jpg", ".JPG", ".jpeg", ".JPEG"],
        Decoder::Other(Format::Jpeg),
    ),
    Kind::new(
        Word::Tiff,
        &[".tif", ".TIF", ".tiff", ".TIFF"],
        Decoder::Other(Format::Tiff),
    ),
    Kind::new(Word::Exr, &[".exr", ".EXR"], Decoder::Unsupported),
    Kind::new(Word::Hdr, &[".hdr", ".HDR"], Decoder::Other(Format::Hdr)),
    Kind::new(Word::Pot, &[".pot", ".POT"], Decoder::Pot),
    Kind::new(Word::Iff, &[".iff", ".IFF"], Decoder::Unsupported),
    Kind::new(Word::Sys, &[], Decoder::Unsupported),
];

/// Memory limit for decoding an image, in bytes.
const MAX_BYTES: u64 = 1 << 31;

/// An image format.
pub(super) struct Kind {
    pub(super) word: Word,
    pub(super) endings: &'static [&'static str],
    pub(super) decoder: Decoder,
}

/// Decoder of an image format.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Decoder {
    Png,
    Gif,
    /// A GIF whose left half has the high bytes and whose right half the low ones.
    Pot,
    Other(Format),
    /// Not supported.
    Unsupported,
}

impl Kind {
    const fn new(word: Word, endings: &'static [&'static str], decoder: Decoder) -> Self {
        Kind {
            word,
            endings,
            decoder,
        }
    }
}

/// The heights of an image, row by row from the top.
pub(super) struct Heights {
    pub(super) width: usize,
    pub(super) rows: Vec<u16>,
}

impl Heights {
    /// The heights of an image computed from a function: its grey values in 16 bits. The grey of colours is truncated,
    /// so that white with n steps is n or n - 1 steps high (n in version 3.8); plain numbers are rounded.
    pub(super) fn from_function(sampled: &SampledFunction, is_3_8: bool) -> Self {
        let height = |color: &Color| {
            let Rgb { r, g, b } = color.rgb;
            match sampled.is_grey {
                true => cut((f64::from(r) * f64::from(DEEP)).round(), 1.0, false),
                false => cut(grey([r, g, b]), DEEP, is_3_8),
            }
        };
        Heights {
            width: sampled.width,
            rows: sampled.colors.iter().map(height).collect(),
        }
    }
}

/// The steps of samples of 16 bits.
const DEEP: f32 = 65535.0;

/// The grey value of a colour.
fn grey(rgb: [f32; 3]) -> f64 {
    let [r, g, b] = rgb.map(f64::from);
    0.297 * r + 0.589 * g + 0.114 * b
}

/// The whole steps in a value, which version 3.8 rounds to single precision: grey colours keep theirs.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cut, and the cast saturates"
)]
fn cut(value: f64, steps: f32, is_3_8: bool) -> u16 {
    if is_3_8 {
        (value as f32 * steps) as u16
    } else {
        (value * f64::from(steps)) as u16
    }
}

/// Reason why an image cannot be read.
type Fault = Box<dyn std::error::Error + Send + Sync>;

impl Decoder {
    /// The format of the file, if it is supported.
    fn format(self) -> Option<Format> {
        Some(match self {
            Decoder::Png => Format::Png,
            Decoder::Gif | Decoder::Pot => Format::Gif,
            Decoder::Other(format) => format,
            Decoder::Unsupported => return None,
        })
    }
}

/// Estimated memory for reading the heights of an image, in bytes.
pub(super) fn bytes_to_read(decoder: Decoder, bytes: &[u8]) -> Result<u64, String> {
    decoder
        .format()
        .map_or(Ok(0), |format| bitmap::bytes_to_decode(bytes, format))
}

/// Reads the heights of an image.
pub(super) fn heights(decoder: Decoder, bytes: &[u8], samples: Samples) -> Result<Heights, String> {
    let read = match decoder {
        Decoder::Png => png(bytes, samples),
        Decoder::Gif => gif(bytes),
        Decoder::Pot => pot(bytes),
        Decoder::Other(format) => other(format, bytes, samples),
        Decoder::Unsupported => Err("this kind of image is not supported yet".into()),
    };
    read.map_err(|fault| fault.to_string())
}

fn from_index(index: u8) -> u16 {
    from_bytes(index, 0)
}

fn from_bytes(high: u8, low: u8) -> u16 {
    u16::from_be_bytes([high, low])
}

/// The conversion of samples to heights.
#[derive(Clone, Copy)]
pub(super) struct Samples {
    /// The gamma of the samples.
    pub(super) gamma: Gamma,
    /// True for the roundings of version 3.8.
    pub(super) is_3_8: bool,
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cut, and the casts saturate"
)]
impl Samples {
    fn is_linear(self) -> bool {
        self.gamma == Gamma::LINEAR
    }

    fn decoded_deep(self, sample: u16) -> f32 {
        self.gamma.decode(f32::from(sample) / 65535.0)
    }

    fn decoded(self, sample: u8) -> f32 {
        self.gamma.decode(f32::from(sample) / 255.0)
    }

    fn deep_grey(self, grey: u16) -> u16 {
        if self.is_linear() {
            grey
        } else {
            (self.decoded_deep(grey) * 65535.0) as u16
        }
    }

    fn grey(self, grey: u8) -> u16 {
        self.deep_grey(u16::from(grey) * 257)
    }

    fn color(self, red: u8, green: u8) -> u16 {
        if self.is_linear() {
            from_bytes(red, green)
        } else {
            let [red, green] = [red, green].map(|sample| f64::from(self.decoded(sample)));
            ((red * 256.0 + green) * 255.0) as u16
        }
    }

    /// The height of a colour in single precision; what is too bright wraps around.
    fn float_color(self, [red, green, _]: [f32; 3]) -> u16 {
        let [red, green] = [red, green].map(|sample| f64::from(self.gamma.decode(sample)));
        ((red * 256.0 + green) * 255.0) as i64 as u16
    }

    /// The height of a grey share of its maximum.
    fn share(self, share: f32) -> u16 {
        (self.gamma.decode(share) * DEEP) as u16
    }

    /// The height of a colour of 16 bits, from its shares.
    fn deep_float(self, color: [f32; 3]) -> u16 {
        cut(
            grey(color.map(|share| self.gamma.decode(share))),
            DEEP,
            self.is_3_8,
        )
    }

    fn deep_color(self, color: [u16; 3]) -> u16 {
        if self.is_3_8 {
            return cut(
                grey(color.map(|sample| self.decoded_deep(sample))),
                DEEP,
                true,
            );
        }
        let [red, green, blue] = color.map(|sample| {
            if self.is_linear() {
                f64::from(sample)
            } else {
                f64::from(self.decoded_deep(sample)) * 65535.0
            }
        });
        (0.297 * red + 0.589 * green + 0.114 * blue) as u16
    }

    /// The height of an 8-bit grey value of a PNG, after POV-Ray's conversion to a colour and back.
    fn degraded_grey(self, grey: u8) -> u16 {
        let g = self.decoded(grey);
        if self.is_3_8 {
            return cut(self::grey([g; 3]), 255.0, true) * 257;
        }
        u16::from((255.0 * (0.297 * g + 0.589 * g + 0.114 * g)) as u8) * 257
    }
}

fn png(bytes: &[u8], samples: Samples) -> Result<Heights, Fault> {
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
    let has_transparency = reader.info().trns.is_some();
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
                rows.extend(pixels.map(|x| from_index(unpack(line, x, depth))));
            }
            (png::ColorType::Grayscale, true) => {
                rows.extend(pixels.map(|x| samples.deep_grey(deep(x))));
            }
            (png::ColorType::Grayscale, false) => rows.extend(pixels.map(|x| {
                let byte = rescale_sample(unpack(line, x, depth), depth);
                if has_transparency {
                    samples.grey(byte)
                } else {
                    samples.degraded_grey(byte)
                }
            })),
            (png::ColorType::GrayscaleAlpha, true) => {
                rows.extend(pixels.map(|x| samples.deep_grey(deep(2 * x))));
            }
            (png::ColorType::GrayscaleAlpha, false) => {
                rows.extend(pixels.map(|x| samples.grey(line[2 * x])));
            }
            (kind @ (png::ColorType::Rgb | png::ColorType::Rgba), is_deep) => {
                let step = kind.samples();
                rows.extend(pixels.map(|x| step * x).map(|at| {
                    if is_deep {
                        samples.deep_color([deep(at), deep(at + 1), deep(at + 2)])
                    } else {
                        samples.color(line[at], line[at + 1])
                    }
                }));
            }
        }
    }
    Ok(Heights { width, rows })
}

/// Unpacks a sample of 1, 2, 4 or 8 bits.
fn unpack(line: &[u8], x: usize, depth: u8) -> u8 {
    let per_byte = usize::from(8 / depth.min(8));
    let shift = 8 - depth.min(8) as usize * (x % per_byte + 1);
    let mask = u8::MAX >> (8 - depth.min(8));
    (line[x / per_byte] >> shift) & mask
}

/// Scales a sample of `depth` bits to eight bits.
fn rescale_sample(sample: u8, depth: u8) -> u8 {
    sample * (u8::MAX / (u8::MAX >> (8 - depth.min(8))))
}

fn gif(bytes: &[u8]) -> Result<Heights, Fault> {
    let (width, rows) = indices(bytes)?;
    Ok(Heights {
        width,
        rows: rows.into_iter().map(from_index).collect(),
    })
}

/// The heights of a Fractint file: one byte from each half of a row. A column left over in the middle has no partner
/// and is dropped.
fn pot(bytes: &[u8]) -> Result<Heights, Fault> {
    let (gif_width, rows) = indices(bytes)?;
    let width = gif_width / 2;
    if width == 0 {
        return Err("it is too narrow for two bytes of a height".into());
    }
    let rows = rows.chunks_exact(gif_width).flat_map(|row| {
        let (high, low) = (&row[..width], &row[width..]);
        high.iter()
            .zip(low)
            .map(|(high, low)| from_bytes(*high, *low))
    });
    Ok(Heights {
        width,
        rows: rows.collect(),
    })
}

/// The width of a GIF and the palette indices of its pixels, row by row.
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

/// The rows of an interlaced image in file order, which POV-Ray 3.7 does not undo (measured).
fn stored_order(height: usize) -> Vec<usize> {
    let passes = [(0, 8), (4, 8), (2, 4), (1, 2)];
    let rows = |(first, step)| (first..height).step_by(step);
    passes.into_iter().flat_map(rows).collect()
}

fn of_content(content: Content, samples: Samples) -> Heights {
    match content {
        Content::Colors(picture) => decoded(picture, samples),
        Content::Indexed { width, indices, .. } => Heights {
            width,
            rows: indices.into_iter().map(from_index).collect(),
        },
    }
}

fn other(format: Format, bytes: &[u8], samples: Samples) -> Result<Heights, Fault> {
    let content = bitmap::content(bytes, format)?;
    let Content::Colors(DynamicImage::ImageRgb32F(image)) = &content else {
        return Ok(of_content(content, samples));
    };
    let height = |[r, g, b]: [f32; 3]| match (format, bytes.get(1)) {
        (Format::Ppm, Some(b'2' | b'5')) => samples.share(r),
        (Format::Ppm, _) if bitmap::pnm_divisor(bytes).is_some_and(|most| most > 255) => {
            samples.deep_float([r, g, b])
        }
        _ => samples.float_color([r, g, b]),
    };
    Ok(Heights {
        width: image.width() as usize,
        rows: image.pixels().map(|pixel| height(pixel.0)).collect(),
    })
}

fn decoded(image: DynamicImage, samples: Samples) -> Heights {
    let width = image.width() as usize;
    let grey = |sample: u8| samples.grey(sample);
    let deep_grey = |sample: u16| samples.deep_grey(sample);
    let rows = match image {
        DynamicImage::ImageLuma8(image) => image.pixels().map(|p| grey(p.0[0])).collect(),
        DynamicImage::ImageLumaA8(image) => image.pixels().map(|p| grey(p.0[0])).collect(),
        DynamicImage::ImageLuma16(image) => image.pixels().map(|p| deep_grey(p.0[0])).collect(),
        DynamicImage::ImageLumaA16(image) => image.pixels().map(|p| deep_grey(p.0[0])).collect(),
        DynamicImage::ImageRgb16(image) => {
            let pixels = image.pixels();
            pixels.map(|p| samples.deep_color(p.0)).collect()
        }
        colors => {
            let colors = colors.into_rgb8();
            let pixels = colors.pixels();
            pixels.map(|p| samples.color(p.0[0], p.0[1])).collect()
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
            [0, 1, 2, 3].map(|x| unpack(&[0b1101_1000], x, 2)),
            [3, 1, 2, 0]
        );
        assert_eq!(unpack(&[1, 77], 1, 8), 77);
        assert_eq!(
            (
                rescale_sample(1, 1),
                rescale_sample(3, 2),
                rescale_sample(5, 4)
            ),
            (255, 255, 85)
        );
    }

    #[test]
    fn grey_bytes_of_a_png_lose_precision_as_in_pov_ray() {
        // Measured with POV-Ray 3.7.
        let linear = Samples {
            gamma: Gamma::LINEAR,
            is_3_8: false,
        };
        assert_eq!(
            [202, 221, 129, 121, 255].map(|byte| linear.degraded_grey(byte)),
            [202, 220, 129, 120, 255].map(|byte| byte * 257)
        );
    }

    #[test]
    fn gamma_decodes_samples() {
        // Measured with POV-Ray 3.7.
        let samples = Samples {
            gamma: Gamma::power(2.2),
            is_3_8: false,
        };
        assert_eq!([50, 100].map(|byte| samples.grey(byte)), [1818, 8357]);
        assert_eq!(samples.degraded_grey(50), 1799);
        assert_eq!(samples.color(50, 58), 1821);
        assert_eq!(samples.deep_grey(12881), 1828);
    }

    #[test]
    fn a_pot_file_has_a_byte_from_each_half_of_a_row() {
        let bytes = include_bytes!("../../../../../pov_scenes/shape/heights/potential.pot");
        let (gif_width, rows) = indices(bytes).expect("it is a GIF");
        let samples = Samples {
            gamma: Gamma::LINEAR,
            is_3_8: false,
        };
        let result = heights(Decoder::Pot, bytes, samples).expect("it has heights");
        assert_eq!((gif_width, result.width), (48, 24));
        let (high, low) = (u16::from(rows[5]), u16::from(rows[5 + 24]));
        assert_eq!(result.rows[5], 256 * high + low);
    }
}
