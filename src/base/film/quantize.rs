//! Linear values to whole numbers, as POV-Ray counts them: `floor(clamp(curve(c)) · max + 0.5)`, single precision throughout.
//!
//! The curves cost a power a value. For 8 bits a table takes its place: floats of one exponent and eight leading bits
//! of mantissa share an entry, and within such a stretch the level rises at most once, so an entry is a level and the
//! first float of the next. The table is made by asking the curve itself, and is only used if every stretch fits.
//! For linear to sRGB and to 2.2 it was compared with the curve at every float from 0 to 1: no difference.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{Film, Pixel};
use crate::base::color::{Gamma, Rgb};
use crate::base::encoding::EncodeOptions;

/// What a stored pixel consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    Grey,
    GreyAlpha,
    Rgb,
    RgbAlpha,
}

impl Channels {
    /// Of a file that holds encoded values.
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
}

/// How many bits a level has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    Byte,
    /// Two bytes, the higher one first.
    Word,
}

impl Depth {
    /// Of a file that holds encoded values.
    pub(crate) fn of(options: &EncodeOptions) -> Depth {
        if options.format.has_words && options.bits > 8 {
            Depth::Word
        } else {
            Depth::Byte
        }
    }
}

/// A picture as the levels that one kind of file holds: channels interleaved, rows from the top without padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    width: u32,
    height: u32,
    options: EncodeOptions,
    bytes: Vec<u8>,
}

impl Levels {
    /// A black picture.
    pub(crate) fn black(leveller: &Quantizer, width: u32, height: u32) -> Self {
        let black = leveller.levels(&[Pixel::default()]);
        let pixels = width as usize * height as usize;
        let bytes = if black.iter().all(|&byte| byte == 0) {
            vec![0; pixels * black.len()]
        } else {
            black.repeat(pixels)
        };
        Levels {
            width,
            height,
            options: leveller.options.clone(),
            bytes,
        }
    }

    /// Width and height in pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// How many bytes a pixel takes.
    pub(crate) fn bytes_of_pixel(&self) -> usize {
        bytes_of_pixel(&self.options)
    }

    /// The levels, to be changed.
    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.bytes
    }
}

fn bytes_of_pixel(options: &EncodeOptions) -> usize {
    let of_level = match Depth::of(options) {
        Depth::Byte => 1,
        Depth::Word => 2,
    };
    Channels::of(options).count() * of_level
}

/// Makes levels of light.
pub(crate) struct Quantizer {
    options: EncodeOptions,
    curve: Curve,
    /// For levels of eight bits, if there can be one.
    table: Option<StepTable>,
}

impl Quantizer {
    /// For such a file; `None` if it holds light itself.
    pub(crate) fn of(options: &EncodeOptions) -> Option<Self> {
        if options.format.is_linear {
            return None;
        }
        let curve = Curve::of(options);
        let table = match Depth::of(options) {
            Depth::Byte => StepTable::new(curve),
            Depth::Word => None,
        };
        Some(Quantizer {
            options: options.clone(),
            curve,
            table,
        })
    }

    /// The levels of some pixels.
    pub(crate) fn levels(&self, pixels: &[Pixel]) -> Vec<u8> {
        let mut out = vec![0; pixels.len() * bytes_of_pixel(&self.options)];
        self.fill(pixels, &mut out);
        out
    }

    fn fill(&self, pixels: &[Pixel], out: &mut [u8]) {
        let channels = Channels::of(&self.options);
        match (Depth::of(&self.options), &self.table) {
            (Depth::Byte, Some(table)) => {
                fill(pixels, channels, out, |c| table.level(c), alpha_8);
            }
            (Depth::Byte, None) => {
                fill(pixels, channels, out, |c| self.curve.level_8(c), alpha_8);
            }
            (Depth::Word, _) => {
                let level = |c| self.curve.level_16(c).to_be_bytes();
                let alpha = |a| word(a * 65535.0 + 0.5).to_be_bytes();
                fill(pixels, channels, out.as_chunks_mut().0, level, alpha);
            }
        }
    }
}

/// Why a picture cannot be written.
pub(crate) const OF_ANOTHER: &str = "it was drawn for another kind of file";

/// The levels of a picture for a file that holds encoded values.
pub(crate) fn of<'a>(film: &'a Film, options: &EncodeOptions) -> Result<Cow<'a, [u8]>, String> {
    if let Some(levels) = &film.levels {
        return match levels.options == *options {
            true => Ok(Cow::Borrowed(&levels.bytes)),
            false => Err(OF_ANOTHER.to_owned()),
        };
    }
    let Some(leveller) = Quantizer::of(options) else {
        return Err("it holds light itself".to_owned());
    };
    let (width, of_pixel) = (film.width as usize, bytes_of_pixel(options));
    let mut out = vec![0; film.pixels.len() * of_pixel];
    out.par_chunks_mut(width * of_pixel)
        .zip(film.pixels.par_chunks(width))
        .for_each(|(stored, pixels)| leveller.fill(pixels, stored));
    Ok(Cow::Owned(out))
}

/// A channel in linear light, for the formats that hold that.
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
        Channels::Grey => each(pixels, out, |pixel| [level(pixel.rgb.grey())]),
        Channels::GreyAlpha => each(pixels, out, |pixel| {
            let (rgb, alpha) = straight(pixel);
            [level(rgb.grey()), alpha_level(alpha)]
        }),
        Channels::Rgb => each(pixels, out, |Pixel { rgb, .. }| {
            [level(rgb.r), level(rgb.g), level(rgb.b)]
        }),
        Channels::RgbAlpha => each(pixels, out, |pixel| {
            let (rgb, alpha) = straight(pixel);
            [level(rgb.r), level(rgb.g), level(rgb.b), alpha_level(alpha)]
        }),
    }
}

/// Stores the levels of each pixel. Often one looks like that before it.
fn each<T: Copy, const CHANNELS: usize>(
    pixels: &[Pixel],
    out: &mut [T],
    levels: impl Fn(Pixel) -> [T; CHANNELS],
) {
    let bits = |Pixel { rgb, transmit }: Pixel| {
        let [r, g, b, t] = [rgb.r, rgb.g, rgb.b, transmit].map(|c| u64::from(c.to_bits()));
        [r | g << 32, b | t << 32]
    };
    let mut last = bits(Pixel::default());
    let mut known = levels(Pixel::default());
    for (stored, &pixel) in out.as_chunks_mut().0.iter_mut().zip(pixels) {
        let this = bits(pixel);
        if this != last {
            (last, known) = (this, levels(pixel));
        }
        *stored = known;
    }
}

fn alpha_8(alpha: f32) -> u8 {
    byte(alpha * 255.0 + 0.5)
}

/// Colour and coverage apart, in the working space. A pixel brighter than its coverage allows gets more coverage.
fn straight(pixel: Pixel) -> (Rgb, f32) {
    let grey = pixel.rgb.grey();
    let mut alpha = 1.0 - pixel.transmit;
    if grey > alpha {
        alpha = grey.min(1.0);
    }
    let divisor = if alpha == 0.0 { 1e-6 } else { alpha };
    (pixel.rgb.map(|c| c / divisor), unit(alpha))
}

/// From the working space to the stored one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Curve {
    /// Stored as it is.
    Same,
    /// From one power law to another in a single power, as POV-Ray does; two in turn round differently.
    Power(f32),
    Between {
        working: Gamma,
        file: Gamma,
    },
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

    fn level_8(self, c: f32) -> u8 {
        byte(unit(self.apply(c)) * 255.0 + 0.5)
    }

    fn level_16(self, c: f32) -> u16 {
        word(unit(self.apply(c)) * 65535.0 + 0.5)
    }
}

/// Between 0 and 1; what is no number stays so, and becomes level 0.
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

/// The 8-bit levels of a curve, a stretch of floats an entry.
struct StepTable {
    curve: Curve,
    stretches: Vec<FloatRange>,
}

/// Floats that share exponent and leading mantissa bits.
#[derive(Clone, Copy)]
struct FloatRange {
    /// The level of the first of them.
    level: u8,
    /// The first float of the next level, beyond the stretch if none.
    next_at: f32,
}

impl StepTable {
    /// Mantissa bits that do not choose the entry. At 15 a stretch is 1/256 wide, and the steepest curve in use, the
    /// straight line, rises by less than one level in it.
    const SHIFT: u32 = 15;
    /// Values below this are put through the curve: they are few, and a power law is too steep there.
    const FIRST: f32 = 1.0 / 4096.0;

    /// `None` where a straight line needs no table, or where the curve climbs too fast for one.
    fn new(curve: Curve) -> Option<StepTable> {
        if curve == Curve::Same {
            return None;
        }
        let first = Self::FIRST.to_bits() >> Self::SHIFT;
        let end = 1f32.to_bits() >> Self::SHIFT;
        let stretches = (first..end)
            .map(|key| FloatRange::new(curve, key << Self::SHIFT, (key + 1) << Self::SHIFT))
            .collect::<Option<Vec<_>>>()?;
        Some(StepTable { curve, stretches })
    }

    #[inline]
    fn level(&self, c: f32) -> u8 {
        // What is below the first, negative or not a number is far beyond the last by its bits.
        let key = c.to_bits().wrapping_sub(Self::FIRST.to_bits()) >> Self::SHIFT;
        match self.stretches.get(key as usize) {
            Some(stretch) => stretch.level + u8::from(c >= stretch.next_at),
            None => self.curve.level_8(c),
        }
    }
}

impl FloatRange {
    /// The stretch of floats with bits from `start` to before `end`.
    fn new(curve: Curve, start: u32, end: u32) -> Option<FloatRange> {
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
mod tests {
    use super::*;

    fn curves() -> Vec<Curve> {
        let spaces = [
            Gamma::LINEAR,
            Gamma::Srgb,
            Gamma::power(1.8),
            Gamma::power(2.2),
        ];
        spaces
            .iter()
            .flat_map(|&working| {
                spaces.iter().map(move |&file| {
                    Curve::of(&EncodeOptions {
                        working: Some(working),
                        file_gamma: file,
                        ..EncodeOptions::new(crate::output::Format::PNG)
                    })
                })
            })
            .collect()
    }

    #[test]
    fn the_table_gives_the_level_of_the_curve_on_both_sides_of_every_step() {
        let linear_to_srgb = Curve::Between {
            working: Gamma::LINEAR,
            file: Gamma::Srgb,
        };
        assert!(StepTable::new(linear_to_srgb).is_some());
        for curve in curves() {
            let Some(table) = StepTable::new(curve) else {
                continue;
            };
            for stretch in &table.stretches {
                if stretch.next_at.is_infinite() {
                    continue;
                }
                // The curves are monotone up to rounding; if that failed anywhere it would be beside a step.
                let bits = stretch.next_at.to_bits();
                for c in (bits - 300..bits + 300).map(f32::from_bits) {
                    assert_eq!(table.level(c), curve.level_8(c), "{curve:?} at {c:e}");
                }
            }
        }
    }

    #[test]
    fn the_table_gives_the_level_of_the_curve_at_a_million_floats() {
        let end = 1.5f32.to_bits();
        for curve in curves() {
            let Some(table) = StepTable::new(curve) else {
                continue;
            };
            for c in (0..=end).step_by(8191).map(f32::from_bits) {
                assert_eq!(table.level(c), curve.level_8(c), "{curve:?} at {c:e}");
                assert_eq!(table.level(-c), 0);
            }
        }
    }

    #[test]
    fn values_that_are_no_numbers_are_black_and_infinite_ones_white() {
        for curve in curves() {
            assert_eq!(curve.level_8(f32::NAN), 0);
            assert_eq!(curve.level_16(f32::INFINITY), 65535);
            assert_eq!(curve.level_16(f32::NEG_INFINITY), 0);
        }
    }

    #[test]
    fn a_pixel_brighter_than_its_coverage_gets_the_coverage_it_needs() {
        // POV-Ray: rgbt <1,.8,.6,.5> with ambient 1.2 and +FN16 +UA File_Gamma=1 is 65535 62668 47001 32896.
        let pixel = Pixel {
            rgb: Rgb::new(0.6, 0.48, 0.36),
            transmit: 0.5,
        };
        let (rgb, alpha) = straight(pixel);
        let levels = [rgb.r, rgb.g, rgb.b].map(|c| Curve::Same.level_16(c));
        assert_eq!(levels, [65535, 62668, 47001]);
        assert_eq!(Curve::Same.level_16(alpha), 32896);
    }
}
