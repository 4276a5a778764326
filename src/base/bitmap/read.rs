//! Parser of `{ [format] "file" [gamma g] [premultiplied] ... }`, the block of `image_map` and its relatives.

use super::decode::decode;
use super::format::Format;
use super::handling::Handling;
use super::mapping::{Interpolation, NO_INDEX, Purpose};
use super::size::bytes_to_decode;
use super::{Bitmap, Mapping, Samples};
use crate::base::args::{Args, Parse, SampledFunction, Word, not_built};
use crate::base::color::{Color, Gamma, Rgb};
use crate::base::source::{Diagnostic, Span};
use crate::base::version::has_defaults_of_3_8;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The channel that `image_pattern` takes for its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// The grey of the colour.
    #[default]
    Ignored,
    /// The alpha channel, if the file has one.
    Used,
}

/// The amounts of `filter all` and `transmit all`, for images without a palette.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AddedTransparency {
    /// Added to the filter of every pixel.
    pub filter: f32,
    /// Added to the transmit of every pixel.
    pub transmit: f32,
    /// True if both apply to the opaque share of a pixel alone, as from version 3.8 on.
    pub scales_by_alpha: bool,
}

/// A bitmap with its mapping to space and the parameters of its block.
#[derive(Clone, Debug)]
pub struct MappedBitmap {
    /// The pixels.
    pub bitmap: Arc<Bitmap>,
    /// The mapping from points to pixels.
    pub mapping: Mapping,
    /// Filter and transmit added to every pixel (`filter all`, `transmit all`).
    pub added: AddedTransparency,
    /// `use_alpha`.
    pub alpha: Alpha,
    /// `use_index`: lookups use the palette index instead of the colour.
    pub uses_index: bool,
    /// `bump_size`, if given in the block.
    pub bump_size: Option<f64>,
}

impl MappedBitmap {
    /// The bitmap's colour at a point plus `filter all` and `transmit all`; transparent outside an image mapped `once`.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let Some(at) = self.mapping.image_position(&self.bitmap, point) else {
            return Color {
                rgb: Rgb::WHITE,
                filter: 0.0,
                transmit: 1.0,
            };
        };
        let mut color = self.mapping.stored_color_at(&self.bitmap, at);
        let AddedTransparency {
            filter,
            transmit,
            scales_by_alpha,
        } = self.added;
        let share = if scales_by_alpha {
            1.0 - color.transmit
        } else {
            1.0
        };
        color.filter += filter * share;
        color.transmit += transmit * share;
        // Of premultiplied colours the sum counts as their alpha (measured).
        self.bitmap.divided_by_alpha(color)
    }

    /// Heights of a `bump_map` at three image positions, in pixels from the top left: the grey values of the colours,
    /// or with `use_index` the palette indices if all three have one.
    #[must_use]
    pub fn heights(&self, positions: [DVec2; 3]) -> [f64; 3] {
        if self.uses_index {
            let indices = positions.map(|at| self.mapping.index_at(&self.bitmap, at));
            if !indices.contains(&NO_INDEX) {
                return indices.map(|index| index as f64);
            }
        }
        positions.map(|at| f64::from(self.mapping.color_at(&self.bitmap, at).rgb.grey()))
    }

    /// True if rounding decides whether an index counts: that of an image without a palette is interpolated to a number
    /// next to -1, the mark of no index.
    #[must_use]
    pub fn rounds_index(&self) -> bool {
        self.mapping.interpolation != Interpolation::None && self.bitmap.palette_len().is_none()
    }

    /// Index of the texture that a `material_map` of `textures` textures selects at a point.
    ///
    /// The number is the palette index, or without a palette the red channel as a byte. Numbers above `textures` wrap
    /// around (modulo), but `textures` itself selects the last one. Outside an image mapped `once` the result is 0.
    #[must_use]
    pub fn material(&self, point: DVec3, textures: usize) -> usize {
        let Some(at) = self.mapping.image_position(&self.bitmap, point) else {
            return 0;
        };
        let number = self.mapping.index_at(&self.bitmap, at);
        #[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
        let number = if number == NO_INDEX {
            let red = self.mapping.color_at(&self.bitmap, at).rgb.r;
            (red * 255.0) as i64
        } else {
            number
        };
        let number = usize::try_from(number).unwrap_or(0);
        if number > textures {
            number % textures.max(1)
        } else {
            number.min(textures.saturating_sub(1))
        }
    }

    /// The width and the height in pixels, and 0.
    #[must_use]
    pub fn sample_counts(&self) -> DVec3 {
        DVec3::new(self.bitmap.width() as f64, self.bitmap.height() as f64, 0.0)
    }

    /// True if some point may have a transparent colour.
    #[must_use]
    pub fn can_be_transparent(&self) -> bool {
        self.mapping.is_once
            || self.added.filter != 0.0
            || self.added.transmit != 0.0
            || self.bitmap.has_alpha()
            || self.bitmap.has_transparent_colors()
    }

    /// True if POV-Ray takes the image for opaque within a pigment that is mapped or blended: filter does not count
    /// there, and `transmit all` for images with a palette alone.
    #[must_use]
    pub fn is_opaque_within(&self) -> bool {
        let is_clear = self.bitmap.palette_len().is_some() && self.added.transmit != 0.0;
        let is_transparent = self.bitmap.has_alpha() || self.bitmap.has_clear_colors();
        !(self.mapping.is_once || is_clear || is_transparent)
    }
}

/// A `filter` or `transmit` parameter: of one palette entry, or of all if `number` is `None`.
struct TransparencyEntry {
    word: Word,
    number: Option<f64>,
    amount: f32,
    span: Span,
}

/// Reads the block of `image_map` and its relatives, with both braces; [`Purpose::Textures`] leaves it open.
///
/// # Errors
/// The block is malformed, or the file is missing or cannot be decoded.
pub fn read(args: &mut dyn Args, purpose: Purpose) -> Parse<MappedBitmap> {
    args.open()?;
    skip_orientation(args)?;
    let content = match args.sampled_function()? {
        Some(sampled) => Content::Sampled(sampled),
        None => read_file(args)?,
    };
    let mut handling = Handling {
        gamma: None,
        working: args.working_gamma(),
        assumes_srgb: purpose == Purpose::Colors && args.effective_version() >= SRGB_SINCE,
        keeps_grey: args.is_for_3_8(),
        is_premultiplied: None,
    };
    // Values are used as stored unless the block specifies a gamma.
    if purpose != Purpose::Colors {
        handling.working = None;
    }
    let mut mapping = Mapping::default();
    let mut added = AddedTransparency {
        scales_by_alpha: has_defaults_of_3_8(args.version()),
        ..AddedTransparency::default()
    };
    let mut alpha = Alpha::Ignored;
    let mut uses_index = false;
    let mut bump_size = None;
    let mut entries = Vec::new();
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of the image or `}`"));
        };
        match word {
            Word::Gamma => {
                args.accept(word)?;
                handling.gamma = Some(read_gamma(Word::Gamma, args)?);
                // An explicit gamma applies even without gamma handling; the values then become linear.
                let working = handling.working.unwrap_or(Gamma::LINEAR);
                handling.working = Some(working);
            }
            Word::Premultiplied => {
                args.accept(word)?;
                handling.is_premultiplied = Some(args.float_or(1.0)? != 0.0);
            }
            Word::BumpSize if purpose == Purpose::Bumps => {
                args.accept(word)?;
                bump_size = Some(args.float()?);
            }
            Word::Texture if purpose == Purpose::Textures => break,
            Word::Filter | Word::Transmit if purpose == Purpose::Colors => {
                args.accept(word)?;
                entries.push(read_entry(word, args)?);
            }
            Word::UseAlpha => {
                args.accept(word)?;
                alpha = Alpha::Used;
            }
            Word::UseIndex | Word::UseColor | Word::UseColour => {
                uses_index = args.accept(word)? && word == Word::UseIndex;
                if purpose == Purpose::Textures {
                    let reason = format!("`{word}` has no effect in `material_map`");
                    args.refused_by_povray(args.last_span(), &reason, "Remove it.");
                }
            }
            _ if mapping.read(word, purpose, args)? => {}
            _ => return Err(args.expected("a parameter of the image or `}`")),
        }
    }
    let mut bitmap = content.into_bitmap(&handling, args)?;
    // Values are not divided by alpha (measured).
    bitmap.is_premultiplied &= purpose == Purpose::Colors;
    for entry in &entries {
        entry.apply(&mut bitmap, &mut added)?;
    }
    // From version 3.8 on an image without alpha channel takes neither, as if its alpha were 0 (measured).
    if added.scales_by_alpha && !bitmap.has_alpha() {
        added = AddedTransparency::default();
    }
    Ok(MappedBitmap {
        bitmap: Arc::new(bitmap),
        mapping,
        added,
        alpha,
        uses_index,
        bump_size,
    })
}

/// The language version from which files without gamma information are sRGB.
const SRGB_SINCE: f64 = 3.7;

/// The content of a bitmap before decoding.
enum Content {
    /// The bytes of a file, its format, and the span of its name in the scene.
    File(Arc<[u8]>, Format, Span),
    Sampled(SampledFunction),
}

impl Content {
    fn into_bitmap(self, handling: &Handling, args: &mut dyn Args) -> Parse<Bitmap> {
        match self {
            Content::File(bytes, format, span) => {
                let error = |error| {
                    let message = format!("this file cannot be read as an image: {error}");
                    Box::new(Diagnostic::error(span, message))
                };
                if bytes.is_empty() {
                    return Err(error("it is empty".to_owned()));
                }
                let bytes_needed = bytes_to_decode(&bytes, format).map_err(error)?;
                args.reserve_memory("this image", bytes_needed, span)?;
                decode(&bytes, format, handling).map_err(error)
            }
            Content::Sampled(sampled) => Ok(Bitmap {
                width: sampled.width,
                height: sampled.height,
                samples: Samples::Colors(sampled.colors),
                has_alpha: false,
                stores_alpha: false,
                is_premultiplied: false,
            }),
        }
    }
}

/// Skips the obsolete vector (orientation) or number (map type) before the file name, with a warning.
fn skip_orientation(args: &mut dyn Args) -> Parse<()> {
    if !args.at_expression()? {
        return Ok(());
    }
    let start = args.span();
    args.vector()?;
    let span = start.to(args.last_span());
    args.warn(
        Diagnostic::warning(span, "a vector or number before an image has no effect")
            .with_hint("Turn the image with transformations, and choose the map with `map_type`."),
    );
    Ok(())
}

/// `[format] "file"`.
fn read_file(args: &mut dyn Args) -> Parse<Content> {
    let word = args.word()?;
    let explicit = word.and_then(Format::of_word);
    match word {
        Some(word) if explicit.is_some() => {
            args.accept(word)?;
        }
        Some(word @ (Word::Iff | Word::Sys | Word::Pot)) => {
            return Err(not_built(args, word));
        }
        _ => {}
    }
    let extensions = explicit.map_or(&[][..], Format::extensions);
    let (name, bytes) = args.file("the image", extensions)?;
    let span = args.last_span();
    match explicit.or_else(|| Format::of_name(&name)) {
        Some(format) => Ok(Content::File(bytes, format, span)),
        None => Err(Box::new(
            Diagnostic::error(span, "cannot tell the image format from the file name")
                .with_hint("Write `png`, `jpeg`, ... before it."),
        )),
    }
}

/// Reads the value after `word` (`gamma`, `blend_gamma`, `assumed_gamma`): a positive number or `srgb`, from version 3.8
/// on also `bt709` and `bt2020`.
///
/// # Errors
/// Anything else.
pub fn read_gamma(word: Word, args: &mut dyn Args) -> Parse<Gamma> {
    for (name, gamma) in [
        (Word::Srgb, Gamma::Srgb),
        (Word::Bt709, Gamma::Bt709),
        (Word::Bt2020, Gamma::Bt2020),
    ] {
        if args.accept(name)? {
            return Ok(gamma);
        }
    }
    let start = args.span();
    let gamma = args.float()?;
    if gamma > 0.0 && gamma.is_finite() {
        return Ok(Gamma::power(gamma));
    }
    let span = start.to(args.last_span());
    let message = format!("`{word}` is a positive number or `srgb`, found {gamma}");
    Err(Box::new(Diagnostic::error(span, message)))
}

/// Reads `all f` or `n, f` after `filter` or `transmit`; `word` is already consumed.
fn read_entry(word: Word, args: &mut dyn Args) -> Parse<TransparencyEntry> {
    let start = args.span();
    let number = if args.accept(Word::All)? {
        None
    } else {
        let number = args.float()?.trunc();
        args.comma()?;
        Some(number)
    };
    Ok(TransparencyEntry {
        word,
        number,
        amount: args.single()?,
        span: start.to(args.last_span()),
    })
}

impl TransparencyEntry {
    /// Sets filter or transmit of palette entries, or without a palette the amount added to every pixel.
    fn apply(&self, bitmap: &mut Bitmap, added: &mut AddedTransparency) -> Parse<()> {
        let Some(palette) = bitmap.palette_mut() else {
            return self.add_to_all(added);
        };
        let len = palette.len();
        let mut is_known = self.number.is_none();
        for (at, color) in (0_u32..).zip(palette) {
            if self.number.is_none_or(|number| number == f64::from(at)) {
                is_known = true;
                if self.word == Word::Filter {
                    color.filter = self.amount;
                } else {
                    color.transmit = self.amount;
                }
            }
        }
        if is_known {
            return Ok(());
        }
        let message = format!("the palette of this image has {len} colours, from 0");
        Err(Box::new(Diagnostic::error(self.span, message)))
    }

    fn add_to_all(&self, added: &mut AddedTransparency) -> Parse<()> {
        let TransparencyEntry { word, number, .. } = self;
        if let Some(number) = number {
            let message = format!("`{word} {number}` needs an image with a palette");
            let hint = format!("Write `{word} all` for every colour.");
            let error = Diagnostic::error(self.span, message).with_hint(hint);
            return Err(Box::new(error));
        }
        if *word == Word::Filter {
            added.filter = self.amount;
        } else {
            added.transmit = self.amount;
        }
        Ok(())
    }
}
