//! Reading `{ [format] "file" [gamma g] [premultiplied] ... }`, what `image_map` and its kin hold.

use super::decode::{Handling, decode};
use super::format::Format;
use super::size::bytes_to_decode;
use super::{Bitmap, Mapping, Samples, mapping::NO_INDEX};
use crate::base::args::{Args, Parse, Sampled, Word, not_built};
use crate::base::color::{Color, Gamma, Rgb};
use crate::base::source::{Diagnostic, Span};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// What a picture is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Its colours: stored values are decoded, and `filter` and `transmit` may change them.
    Colors,
    /// Its values as they are stored.
    Values,
    /// Its values, for bumps: `bump_size` may stand among its parameters.
    Bumps,
    /// Its values, for a list of textures: it begins at the first `texture` of the block, which stays open.
    Textures,
}

/// What `image_pattern` takes for its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// The grey of the colour.
    #[default]
    Ignored,
    /// How clear it is, where the file has alpha.
    Used,
}

/// A picture of a scene, and how it is laid over space.
#[derive(Clone, Debug)]
pub struct Source {
    /// The pixels.
    pub bitmap: Arc<Bitmap>,
    /// How they are laid over space.
    pub mapping: Mapping,
    /// What is added to the filter and transmit of every pixel.
    pub all: (f32, f32),
    /// `use_alpha`.
    pub alpha: Alpha,
    /// `use_index`: the index in the palette counts, not the colour.
    pub uses_index: bool,
    /// `bump_size` among the parameters.
    pub bump_size: Option<f64>,
}

impl Source {
    /// The colour at a point: of the picture, with what the scene adds; clear outside of a picture that is there once.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let Some(mut color) = self.mapping.color(&self.bitmap, point) else {
            return Color {
                rgb: Rgb::WHITE,
                filter: 0.0,
                transmit: 1.0,
            };
        };
        color.filter += self.all.0;
        color.transmit += self.all.1;
        color
    }

    /// The heights of a `bump_map` at three places in the picture, in pixels from the left and from the top: the greys
    /// of the colours, or with `use_index` the indices where all three have one.
    #[must_use]
    pub fn heights(&self, places: [DVec2; 3]) -> [f64; 3] {
        if self.uses_index {
            let indices = places.map(|at| self.mapping.index_at(&self.bitmap, at));
            if !indices.contains(&NO_INDEX) {
                return indices.map(|index| index as f64);
            }
        }
        places.map(|at| f64::from(self.mapping.color_at(&self.bitmap, at).rgb.grey()))
    }

    /// Which of so many textures `material_map` takes at a point: the one numbered like the index in the palette, or
    /// like the red of the colour as a byte. A number beyond the textures is divided by their count and the remainder
    /// counts, but the count itself is the last one. The first outside of a picture that is there once.
    #[must_use]
    pub fn material(&self, point: DVec3, textures: usize) -> usize {
        let Some(at) = self.mapping.place(&self.bitmap, point) else {
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

    /// Whether light passes somewhere.
    #[must_use]
    pub fn can_be_transparent(&self) -> bool {
        self.mapping.is_once
            || self.all != (0.0, 0.0)
            || self.bitmap.has_alpha()
            || self.bitmap.has_clear_colors()
    }
}

/// `filter` or `transmit` of one colour of a palette, or of all.
struct Entry {
    word: Word,
    number: Option<f64>,
    amount: f32,
    span: Span,
}

/// Reads the block behind `image_map` and the like, with the braces unless a list of textures follows in it.
///
/// # Errors
/// A malformed block, or a file that is missing or no picture.
pub fn read(args: &mut dyn Args, purpose: Purpose) -> Parse<Source> {
    args.open()?;
    pass_orientation(args)?;
    let content = match args.sampled()? {
        Some(sampled) => Content::Sampled(sampled),
        None => read_file(args)?,
    };
    let mut handling = Handling {
        gamma: None,
        working: args.working_gamma(),
        assumes_srgb: purpose == Purpose::Colors && args.effective_version() >= SRGB_SINCE,
        is_premultiplied: false,
    };
    // Values are as they are stored; a gamma must be written to change them.
    if purpose != Purpose::Colors {
        handling.working = None;
    }
    let mut mapping = Mapping::default();
    let mut all = (0.0, 0.0);
    let mut alpha = Alpha::Ignored;
    let mut uses_index = false;
    let mut bump_size = None;
    let mut entries = Vec::new();
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of the picture or `}`"));
        };
        match word {
            Word::Gamma => {
                args.accept(word)?;
                handling.gamma = Some(read_gamma(args)?);
                // A gamma that is written is heeded without gamma handling too. Values become light itself.
                let working = handling.working.unwrap_or(Gamma::LINEAR);
                handling.working = Some(working);
            }
            Word::Premultiplied => {
                args.accept(word)?;
                handling.is_premultiplied = args.float_or(1.0)? != 0.0;
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
            Word::UseIndex => uses_index = args.accept(word)?,
            Word::UseColor | Word::UseColour => uses_index = !args.accept(word)?,
            _ if mapping.read(word, purpose, args)? => {}
            _ => return Err(args.expected("a parameter of the picture or `}`")),
        }
    }
    let mut bitmap = content.into_bitmap(&handling, args)?;
    for entry in &entries {
        entry.apply(&mut bitmap, &mut all)?;
    }
    Ok(Source {
        bitmap: Arc::new(bitmap),
        mapping,
        all,
        alpha,
        uses_index,
        bump_size,
    })
}

/// From this version on, files that say nothing hold light by the sRGB curve.
const SRGB_SINCE: f64 = 3.7;

/// What a picture is made of.
enum Content {
    /// The bytes of a file, its format, and its place in the scene.
    File(Arc<[u8]>, Format, Span),
    Sampled(Sampled),
}

impl Content {
    fn into_bitmap(self, handling: &Handling, args: &mut dyn Args) -> Parse<Bitmap> {
        match self {
            Content::File(bytes, format, span) => {
                let fault = |fault| {
                    let message = format!("this file cannot be read as a picture: {fault}");
                    Box::new(Diagnostic::error(span, message))
                };
                let wanted = bytes_to_decode(&bytes, format).map_err(fault)?;
                args.make_room("this picture", wanted, span)?;
                decode(&bytes, format, handling).map_err(fault)
            }
            Content::Sampled(sampled) => Ok(Bitmap {
                width: sampled.width,
                height: sampled.height,
                samples: Samples::Colors(sampled.colors),
                has_alpha: false,
                is_premultiplied: false,
            }),
        }
    }
}

/// Passes over what may stand before the file: a vector that once said how the picture lies, or a number that said
/// which map it is.
fn pass_orientation(args: &mut dyn Args) -> Parse<()> {
    if !args.at_expression()? {
        return Ok(());
    }
    let start = args.span();
    args.vector()?;
    let place = start.to(args.last_span());
    args.warn(
        Diagnostic::warning(place, "a vector or number before a picture has no effect").with_hint(
            "Turn the picture with transformations, and choose the map with `map_type`.",
        ),
    );
    Ok(())
}

/// `[format] "file"`.
fn read_file(args: &mut dyn Args) -> Parse<Content> {
    let word = args.word()?;
    let said = word.and_then(Format::of_word);
    match word {
        Some(word) if said.is_some() => {
            args.accept(word)?;
        }
        Some(word @ (Word::Iff | Word::Sys | Word::Pot)) => {
            return Err(not_built(args, word));
        }
        _ => {}
    }
    let endings = said.map_or(&[][..], Format::endings);
    let (name, bytes) = args.file("the picture", endings)?;
    let span = args.last_span();
    match said.or_else(|| Format::of_name(&name)) {
        Some(format) => Ok(Content::File(bytes, format, span)),
        None => Err(Box::new(
            Diagnostic::error(span, "the name does not tell the format of this picture")
                .with_hint("Write `png`, `jpeg`, ... before it."),
        )),
    }
}

fn read_gamma(args: &mut dyn Args) -> Parse<Gamma> {
    if args.accept(Word::Srgb)? {
        return Ok(Gamma::Srgb);
    }
    let start = args.span();
    let gamma = args.float()?;
    if gamma > 0.0 {
        return Ok(Gamma::power(gamma));
    }
    let place = start.to(args.last_span());
    let message = format!("`gamma` is a positive number or `srgb`, found {gamma}");
    Err(Box::new(Diagnostic::error(place, message)))
}

/// `filter all f` or `filter n, f`, and the same with `transmit`; the word is taken.
fn read_entry(word: Word, args: &mut dyn Args) -> Parse<Entry> {
    let start = args.span();
    let number = if args.accept(Word::All)? {
        None
    } else {
        let number = args.float()?.trunc();
        args.comma()?;
        Some(number)
    };
    Ok(Entry {
        word,
        number,
        amount: args.single()?,
        span: start.to(args.last_span()),
    })
}

impl Entry {
    /// Sets what passes through colours of a palette; without a palette, what is added to every pixel.
    fn apply(&self, bitmap: &mut Bitmap, all: &mut (f32, f32)) -> Parse<()> {
        let Some(palette) = bitmap.palette_mut() else {
            return self.apply_to_all(all);
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
        let message = format!("the palette of this picture has {len} colours, from 0");
        Err(Box::new(Diagnostic::error(self.span, message)))
    }

    fn apply_to_all(&self, all: &mut (f32, f32)) -> Parse<()> {
        let Entry { word, number, .. } = self;
        if let Some(number) = number {
            let message = format!("`{word} {number}` needs a picture with a palette");
            let hint = format!("Write `{word} all` for every colour.");
            let error = Diagnostic::error(self.span, message).with_hint(hint);
            return Err(Box::new(error));
        }
        if *word == Word::Filter {
            all.0 = self.amount;
        } else {
            all.1 = self.amount;
        }
        Ok(())
    }
}
