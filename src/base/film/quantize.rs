//! Quantization of pixels to integer levels, with POV-Ray's rounding: `floor(clamp(curve(c)) · max + 0.5)`, in single
//! precision throughout.
//!
//! The transfer curves cost a `powf` for each value. For 8 bits a table replaces it: floats with the same exponent and
//! the same eight leading mantissa bits share an entry. Within such a range the level rises at most once, so an entry
//! is a level and the first float of the next level. The table is built by evaluating the curve and is only used if
//! every range has at most one step. For linear to sRGB and linear to gamma 2.2 it was compared with the curve at every
//! float from 0 to 1: no difference.

use std::borrow::Cow;

use rayon::prelude::*;

use super::dither::{Dither, MAX_CHANNELS};
use super::{Film, Pixel};
use crate::base::color::{Gamma, Rgb};
use crate::base::encoding::{EncodeOptions, Rounding};

/// The channels of a stored pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    Grey,
    GreyAlpha,
    Rgb,
    RgbAlpha,
}

impl Channels {
    /// The channels of a file with encoded values.
    pub(crate) fn of(options: &EncodeOptions) -> Channels {
        let has_grey = options.format.has_grey;
        let is_grey = has_grey && options.grayscale;
        match (is_grey, options.alpha && options.format.has_alpha) {
            (true, false) => Channels::Grey,
            (true, true) => Channels::GreyAlpha,
            (false, false) => Channels::Rgb,
            (false, true) => Channels::RgbAlpha,
        }
    }

    fn count(self) -> usize {
        match self {
            Channels::Grey => 1,
            Channels::GreyAlpha => 2,
            Channels::Rgb => 3,
            Channels::RgbAlpha => 4,
        }
    }

    fn has_alpha(self) -> bool {
        matches!(self, Channels::GreyAlpha | Channels::RgbAlpha)
    }

    /// The channels of a pixel before quantization, alpha last.
    fn values(self, pixel: Pixel) -> [f32; MAX_CHANNELS] {
        let (rgb, alpha) = match self.has_alpha() {
            true => straight(pixel),
            false => (pixel.rgb, 1.0),
        };
        match self {
            Channels::Grey | Channels::GreyAlpha => [rgb.grey(), alpha, 0.0, 0.0],
            Channels::Rgb | Channels::RgbAlpha => [rgb.r, rgb.g, rgb.b, alpha],
        }
    }
}

/// Bits per channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    Byte,
    /// Two bytes, big-endian.
    Word,
}

impl Depth {
    /// The depth of a file with encoded values.
    pub(crate) fn of(options: &EncodeOptions) -> Depth {
        if options.format.has_words && options.bits > 8 {
            Depth::Word
        } else {
            Depth::Byte
        }
    }
}

/// Bits per channel that count, 1 to 16. POV-Ray 3.7 takes fewer than 5 for 5.
pub(crate) fn bits_of(options: &EncodeOptions) -> u8 {
    let least = match options.rounding {
        Rounding::Encoded => 5,
        Rounding::Working => 1,
    };
    match options.format.has_words {
        true => options.bits.clamp(least, 16),
        false => 8,
    }
}

/// The highest level of 1 to 16 bits.
pub(crate) fn max_level(bits: u8) -> u16 {
    u16::MAX >> (16 - bits)
}

/// A level of 1 to 16 bits, repeated until it fills 16; a byte takes the high ones. POV-Ray's PNG files have such levels.
fn spread(level: u16, bits: u8) -> u16 {
    let mut spread = level << (16 - bits);
    let mut filled = bits;
    while filled < 16 {
        spread |= spread >> filled;
        filled *= 2;
    }
    spread
}

/// A picture as the quantized levels of one kind of file: channels interleaved, rows from the top, no padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    width: u32,
    height: u32,
    options: EncodeOptions,
    bytes: Vec<u8>,
}

impl Levels {
    /// True if all pixels are equal.
    pub(crate) fn is_flat(&self) -> bool {
        let pixels = self.width as usize * self.height as usize;
        let size = self.bytes.len().checked_div(pixels).unwrap_or(0);
        size == 0 || self.bytes.windows(size + 1).all(|two| two[0] == two[size])
    }

    /// A black picture.
    pub(crate) fn black(quantizer: &Quantizer, width: u32, height: u32) -> Self {
        let black = quantizer.levels(&[Pixel::default()]);
        let pixels = width as usize * height as usize;
        let bytes = if black.iter().all(|&byte| byte == 0) {
            vec![0; pixels * black.len()]
        } else {
            black.repeat(pixels)
        };
        Levels {
            width,
            height,
            options: quantizer.options.clone(),
            bytes,
        }
    }

    /// Width and height in pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Bytes per pixel.
    pub(crate) fn bytes_per_pixel(&self) -> usize {
        bytes_per_pixel(&self.options)
    }

    /// The levels, for writing.
    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.bytes
    }
}

fn bytes_per_pixel(options: &EncodeOptions) -> usize {
    let bytes_per_level = match Depth::of(options) {
        Depth::Byte => 1,
        Depth::Word => 2,
    };
    Channels::of(options).count() * bytes_per_level
}

/// Converts pixels to levels.
pub(crate) struct Quantizer {
    options: EncodeOptions,
    curve: Rounded,
    /// For 8-bit levels, if the curve allows one.
    table: Option<StepTable>,
}

impl Quantizer {
    /// The quantizer for the tiles of a picture; `None` if the file stores linear light, or if its dithering needs
    /// the whole picture.
    pub(crate) fn of_tiles(options: &EncodeOptions) -> Option<Self> {
        Self::of(options).filter(|_| options.dither.is_none())
    }

    /// The quantizer for a kind of file; `None` if the file stores linear light.
    pub(crate) fn of(options: &EncodeOptions) -> Option<Self> {
        if options.format.is_linear {
            return None;
        }
        let curve = Rounded::of(options);
        let table = match bits_of(options) {
            8 => StepTable::new(curve),
            _ => None,
        };
        Some(Quantizer {
            options: options.clone(),
            curve,
            table,
        })
    }

    /// The levels of `pixels`.
    pub(crate) fn levels(&self, pixels: &[Pixel]) -> Vec<u8> {
        let mut out = vec![0; pixels.len() * bytes_per_pixel(&self.options)];
        self.fill(pixels, &mut out);
        out
    }

    fn fill(&self, pixels: &[Pixel], out: &mut [u8]) {
        let channels = Channels::of(&self.options);
        let bits = bits_of(&self.options);
        let max = f32::from(max_level(bits));
        let level = |c| spread(word(self.curve.level(c, max)), bits);
        let alpha = |a: f32| spread(word(a * max + 0.5), bits);
        match (Depth::of(&self.options), &self.table) {
            (Depth::Byte, Some(table)) => {
                fill(pixels, channels, out, |c| table.level(c), alpha_8);
            }
            (Depth::Byte, None) if bits == 8 => {
                fill(pixels, channels, out, |c| self.curve.level_8(c), alpha_8);
            }
            (Depth::Byte, None) => {
                let high = |level: u16| level.to_be_bytes()[0];
                fill(
                    pixels,
                    channels,
                    out,
                    |c| high(level(c)),
                    |a| high(alpha(a)),
                );
            }
            (Depth::Word, _) => {
                let level = |c| level(c).to_be_bytes();
                let alpha = |a| alpha(a).to_be_bytes();
                fill(pixels, channels, out.as_chunks_mut().0, level, alpha);
            }
        }
    }
}

/// The levels of a film with dithering, channels and depth as in [`Quantizer::fill`].
fn dithered(film: &Film, quantizer: &Quantizer, mut dither: Dither) -> Vec<u8> {
    let options = &quantizer.options;
    let (channels, bits) = (Channels::of(options), bits_of(options));
    let max = f32::from(max_level(bits));
    let straight_line = Rounded {
        curve: Curve::Same,
        spaces: None,
        ..quantizer.curve
    };
    let mut out = Vec::with_capacity(film.pixels.len() * bytes_per_pixel(options));
    for (y, row) in film.rows_of_pixels().enumerate() {
        for (x, &pixel) in row.iter().enumerate() {
            let values = channels.values(pixel);
            for (channel, &value) in values[..channels.count()].iter().enumerate() {
                let is_alpha = channels.has_alpha() && channel + 1 == channels.count();
                let curve = if is_alpha {
                    straight_line
                } else {
                    quantizer.curve
                };
                let level = match &mut dither {
                    Dither::Ordered(thresholds) => {
                        curve.level_above(value, max, thresholds.at(x, y, channel))
                    }
                    Dither::Diffused(diffusion) => {
                        let (level, error) =
                            curve.level_and_error(value, diffusion.due(x, channel), max);
                        diffusion.spread(x, channel, error);
                        level
                    }
                };
                let stored = spread(level, bits).to_be_bytes();
                match Depth::of(options) {
                    Depth::Byte => out.push(stored[0]),
                    Depth::Word => out.extend(stored),
                }
            }
        }
        if let Dither::Diffused(diffusion) = &mut dither {
            diffusion.end_row();
        }
    }
    out
}

/// Error: the levels are those of another kind of file.
pub(crate) const WRONG_FILE_KIND: &str = "it was drawn for another kind of file";

/// The levels of a film for a file with encoded values: channels interleaved, rows from the top, no padding; levels of
/// 16 bits are big-endian.
///
/// # Errors
/// The film was drawn for another kind of file, or the file stores linear light. The error is the reason.
pub fn levels_of<'a>(film: &'a Film, options: &EncodeOptions) -> Result<Cow<'a, [u8]>, String> {
    if let Some(levels) = &film.levels {
        return match levels.options == *options {
            true => Ok(Cow::Borrowed(&levels.bytes)),
            false => Err(WRONG_FILE_KIND.to_owned()),
        };
    }
    let Some(quantizer) = Quantizer::of(options) else {
        return Err("it holds light itself".to_owned());
    };
    let (width, bytes_per_pixel) = (film.width as usize, bytes_per_pixel(options));
    if let Some(method) = options.dither {
        let dither = Dither::new(method, options.rounding, width);
        return Ok(Cow::Owned(dithered(film, &quantizer, dither)));
    }
    let mut out = vec![0; film.pixels.len() * bytes_per_pixel];
    out.par_chunks_mut(width * bytes_per_pixel)
        .zip(film.pixels.par_chunks(width))
        .for_each(|(stored, pixels)| quantizer.fill(pixels, stored));
    Ok(Cow::Owned(out))
}

/// Converts a channel to linear light, for the formats that store that.
pub(crate) fn to_linear(working: Option<Gamma>) -> impl Fn(f32) -> f32 {
    let working = working.unwrap_or(Gamma::Srgb);
    move |c| working.decode(c)
}

fn fill<T: Copy>(
    pixels: &[Pixel],
    channels: Channels,
    out: &mut [T],
    level: impl Fn(f32) -> T,
    alpha_level: impl Fn(f32) -> T,
) {
    match channels {
        Channels::Grey => fill_pixels(pixels, out, |pixel| [level(pixel.rgb.grey())]),
        Channels::GreyAlpha => fill_pixels(pixels, out, |pixel| {
            let (rgb, alpha) = straight(pixel);
            [level(rgb.grey()), alpha_level(alpha)]
        }),
        Channels::Rgb => fill_pixels(pixels, out, |Pixel { rgb, .. }| {
            [level(rgb.r), level(rgb.g), level(rgb.b)]
        }),
        Channels::RgbAlpha => fill_pixels(pixels, out, |pixel| {
            let (rgb, alpha) = straight(pixel);
            [level(rgb.r), level(rgb.g), level(rgb.b), alpha_level(alpha)]
        }),
    }
}

/// Stores the levels of each pixel. Equal neighbours are common, so the last result is reused.
fn fill_pixels<T: Copy, const CHANNELS: usize>(
    pixels: &[Pixel],
    out: &mut [T],
    levels: impl Fn(Pixel) -> [T; CHANNELS],
) {
    let bits = |Pixel { rgb, transmit }: Pixel| {
        let [r, g, b, t] = [rgb.r, rgb.g, rgb.b, transmit].map(|c| u64::from(c.to_bits()));
        [r | g << 32, b | t << 32]
    };
    let mut last_bits = bits(Pixel::default());
    let mut last_levels = levels(Pixel::default());
    for (stored, &pixel) in out.as_chunks_mut().0.iter_mut().zip(pixels) {
        let pixel_bits = bits(pixel);
        if pixel_bits != last_bits {
            (last_bits, last_levels) = (pixel_bits, levels(pixel));
        }
        *stored = last_levels;
    }
}

fn alpha_8(alpha: f32) -> u8 {
    byte(alpha * 255.0 + 0.5)
}

/// Unassociated (straight) alpha in the working space. A pixel brighter than its coverage gets a larger coverage.
fn straight(pixel: Pixel) -> (Rgb, f32) {
    let grey = pixel.rgb.grey();
    let mut alpha = 1.0 - pixel.transmit;
    if grey > alpha {
        alpha = grey.min(1.0);
    }
    let divisor = if alpha == 0.0 { 1e-6 } else { alpha };
    (pixel.rgb.map(|c| c / divisor), unit(alpha))
}

/// The transfer curve from the working space to that of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Curve {
    /// The identity.
    Same,
    /// From one power law to another with a single power, as in POV-Ray; two in a row round differently.
    Power(f32),
    /// Decoding by `working`, then encoding by `file`.
    Between { working: Gamma, file: Gamma },
}

impl Curve {
    fn of(options: &EncodeOptions) -> Curve {
        match (options.working, options.file_gamma) {
            (None, _) => Curve::Same,
            (Some(working), file) if working == file => Curve::Same,
            (Some(Gamma::Power(working)), Gamma::Power(file)) => Curve::Power(working / file),
            (Some(working), file) => Curve::Between { working, file },
        }
    }

    fn apply(self, c: f32) -> f32 {
        match self {
            Curve::Same => c,
            Curve::Power(exponent) => c.max(0.0).powf(exponent),
            Curve::Between { working, file } => file.encode(working.decode(c)),
        }
    }
}

/// A curve, and the rounding of its values to levels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rounded {
    curve: Curve,
    /// The working space and that of the file, if they differ.
    spaces: Option<(Gamma, Gamma)>,
    rounding: Rounding,
}

impl Rounded {
    fn of(options: &EncodeOptions) -> Rounded {
        let spaces = options.working.map(|working| (working, options.file_gamma));
        Rounded {
            curve: Curve::of(options),
            spaces: spaces.filter(|(working, file)| working != file),
            rounding: options.rounding,
        }
    }

    fn level_8(self, c: f32) -> u8 {
        byte(self.level(c, 255.0))
    }

    /// The level of a value among those from 0 to `max`; its fraction does not count.
    fn level(self, c: f32, max: f32) -> f32 {
        let encoded = unit(self.curve.apply(c)) * max;
        if self.spaces.is_none() || self.rounding == Rounding::Encoded {
            return encoded + 0.5;
        }
        let (below, [lower, upper]) = self.around(encoded, max);
        below + f32::from(u8::from(unit(c) >= 0.5 * (lower + upper)))
    }

    /// The level below an encoded value, and the values of that and the next one in the working space.
    fn around(self, encoded: f32, max: f32) -> (f32, [f32; 2]) {
        let below = f32::from(word(encoded)).min(max - 1.0);
        let values = [below, below + 1.0].map(|level| self.value_of(level, max));
        (below, values)
    }

    /// The value of a level in the working space.
    fn value_of(self, level: f32, max: f32) -> f32 {
        match self.spaces {
            Some((working, file)) => working.encode(file.decode(level / max)),
            None => level / max,
        }
    }

    /// The level of a value that takes the upper of two from this share of their difference on.
    fn level_above(self, c: f32, max: f32, share: f32) -> u16 {
        if self.rounding == Rounding::Encoded {
            return word((self.curve.apply(c) * max + (1.0 - share)).min(max));
        }
        let encoded = unit(self.curve.apply(c)) * max;
        if self.spaces.is_none() {
            return word((encoded + (1.0 - share)).min(max));
        }
        let (below, [lower, upper]) = self.around(encoded, max);
        // In POV-Ray the thresholds are inverted here.
        let is_above = unit(c) >= lower + (1.0 - share) * (upper - lower);
        word(below) + u16::from(is_above)
    }

    /// The level of a value to which an error of others is added, and the error that is left.
    fn level_and_error(self, c: f32, due: f32, max: f32) -> (u16, f32) {
        let (wanted, counted) = match self.rounding {
            Rounding::Encoded => (c + due, unit(c + due)),
            Rounding::Working => (unit(c) + due, unit(c) + due),
        };
        let level = word(self.level(unit(wanted), max));
        (level, counted - self.value_of(f32::from(level), max))
    }
}

/// Clamps to 0..=1. NaN stays NaN and becomes level 0.
fn unit(c: f32) -> f32 {
    c.clamp(0.0, 1.0)
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "0 ≤ v < 256 or not a number, which becomes 0; the fraction is meant to go"
)]
fn byte(v: f32) -> u8 {
    v as u8
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "0 ≤ v < 65536 or not a number, which becomes 0; the fraction is meant to go"
)]
fn word(v: f32) -> u16 {
    v as u16
}

/// The 8-bit levels of a curve, one entry for each range of floats.
struct StepTable {
    curve: Rounded,
    ranges: Vec<FloatRange>,
}

/// A range of floats with the same exponent and leading mantissa bits.
#[derive(Clone, Copy)]
struct FloatRange {
    /// The level of the first float.
    level: u8,
    /// The first float of the next level; infinite if the range has one level.
    next_at: f32,
}

impl StepTable {
    /// The low mantissa bits, which do not select the entry. At 15 a range has a relative width of 1/256, in
    /// which the steepest curve in use, a straight line, rises by less than one level.
    const SHIFT: u32 = 15;
    /// Values below this are evaluated by the curve: they are rare, and a power law is too steep there.
    const FIRST: f32 = 1.0 / 4096.0;

    /// `None` if the curve is the identity and needs no table, or too steep for one.
    fn new(curve: Rounded) -> Option<StepTable> {
        if curve.curve == Curve::Same {
            return None;
        }
        let first = Self::FIRST.to_bits() >> Self::SHIFT;
        let end = 1f32.to_bits() >> Self::SHIFT;
        let ranges = (first..end)
            .map(|key| FloatRange::new(curve, key << Self::SHIFT, (key + 1) << Self::SHIFT))
            .collect::<Option<Vec<_>>>()?;
        Some(StepTable { curve, ranges })
    }

    #[inline]
    fn level(&self, c: f32) -> u8 {
        // Values below the first, negative values and NaN have keys far beyond the last entry.
        let key = c.to_bits().wrapping_sub(Self::FIRST.to_bits()) >> Self::SHIFT;
        match self.ranges.get(key as usize) {
            Some(range) => range.level + u8::from(c >= range.next_at),
            None => self.curve.level_8(c),
        }
    }
}

impl FloatRange {
    /// The range of floats with bits in `start..end`; `None` if it has more than one step.
    fn new(curve: Rounded, start: u32, end: u32) -> Option<FloatRange> {
        let level_of = |bits: u32| curve.level_8(f32::from_bits(bits));
        let level = level_of(start);
        let rise = level_of(end - 1).checked_sub(level)?;
        let next_at = match rise {
            0 => f32::INFINITY,
            1 => {
                let (mut below, mut above) = (start, end - 1);
                while above - below > 1 {
                    let middle = below + (above - below) / 2;
                    if level_of(middle) > level {
                        above = middle;
                    } else {
                        below = middle;
                    }
                }
                f32::from_bits(above)
            }
            _ => return None,
        };
        Some(FloatRange { level, next_at })
    }
}

#[cfg(test)]
mod tests;
