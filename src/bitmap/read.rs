//! Reading `{ [format] "file" [gamma g] [premultiplied] ... }`, what `image_map` and its kin hold.

use super::decode::{Handling, decode};
use super::format::Format;
use super::{Bitmap, Mapping};
use crate::args::{Args, Parse, Word, not_built};
use crate::color::{Color, Gamma, Rgb};
use crate::source::{Diagnostic, Span};
use glam::DVec3;
use std::sync::Arc;

/// What a picture is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Its colours: stored values are decoded, and `filter` and `transmit` may change them.
    Colors,
    /// Its values as they are stored.
    Values,
}

/// What `image_pattern` takes for its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// The grey of the colour.
    #[default]
    Ignored,
    /// Alpha, where the file has it.
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

    /// Whether light passes somewhere.
    #[must_use]
    pub fn can_be_transparent(&self) -> bool {
        self.mapping.is_once
            || self.all != (0.0, 0.0)
            || self.bitmap.has_alpha()
            || self.bitmap.has_clear_palette()
    }
}

/// `filter` or `transmit` of one colour of a palette.
struct Entry {
    word: Word,
    number: f64,
    amount: f32,
    span: Span,
}

/// Reads the block behind `image_map` and the like, with the braces.
///
/// # Errors
/// A malformed block, or a file that is missing or no picture.
pub fn read(args: &mut dyn Args, purpose: Purpose) -> Parse<Source> {
    args.open()?;
    let (bytes, format, span) = read_file(args)?;
    let mut handling = Handling {
        gamma: None,
        working: args.working_gamma(),
        assumes_srgb: purpose == Purpose::Colors && args.version() >= SRGB_SINCE,
        is_premultiplied: false,
    };
    // Values are as they are stored; a gamma must be written to change them.
    if purpose == Purpose::Values {
        handling.working = None;
    }
    let mut mapping = Mapping::default();
    let mut all = (0.0, 0.0);
    let mut alpha = Alpha::Ignored;
    let mut uses_index = false;
    let mut entries = Vec::new();
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of the picture or `}`"));
        };
        match word {
            Word::Gamma => {
                args.accept(word)?;
                handling.gamma = Some(read_gamma(args)?);
                handling.working = args.working_gamma();
            }
            Word::Premultiplied => {
                args.accept(word)?;
                handling.is_premultiplied = args.float_or(1.0)? != 0.0;
            }
            Word::Filter | Word::Transmit if purpose == Purpose::Colors => {
                args.accept(word)?;
                read_transparency(word, args, &mut all, &mut entries)?;
            }
            Word::UseAlpha => {
                args.accept(word)?;
                alpha = Alpha::Used;
            }
            Word::UseIndex => uses_index = args.accept(word)?,
            Word::UseColor | Word::UseColour => uses_index = !args.accept(word)?,
            _ if mapping.read(word, args)? => {}
            _ => return Err(args.expected("a parameter of the picture or `}`")),
        }
    }
    let mut bitmap = decode(&bytes, format, &handling).map_err(|fault| {
        let message = format!("this file cannot be read as a picture: {fault}");
        Box::new(Diagnostic::error(span, message))
    })?;
    for entry in &entries {
        entry.apply(&mut bitmap)?;
    }
    Ok(Source {
        bitmap: Arc::new(bitmap),
        mapping,
        all,
        alpha,
        uses_index,
    })
}

/// From this version on, files that say nothing hold light by the sRGB curve.
const SRGB_SINCE: f64 = 3.7;

/// `[format] "file"`: its bytes, its format, and its place in the scene.
fn read_file(args: &mut dyn Args) -> Parse<(Vec<u8>, Format, Span)> {
    let word = args.word()?;
    let said = word.and_then(Format::of_word);
    match word {
        Some(word) if said.is_some() => {
            args.accept(word)?;
        }
        Some(word @ (Word::Iff | Word::Sys | Word::Pot | Word::Function)) => {
            return Err(not_built(args, word));
        }
        _ => {}
    }
    let endings = said.map_or(&[][..], Format::endings);
    let (name, bytes) = args.file("the picture", endings)?;
    let span = args.last_span();
    match said.or_else(|| Format::of_name(&name)) {
        Some(format) => Ok((bytes, format, span)),
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

/// `filter all f`, `filter n, f`, and the same with `transmit`.
fn read_transparency(
    word: Word,
    args: &mut dyn Args,
    all: &mut (f32, f32),
    entries: &mut Vec<Entry>,
) -> Parse<()> {
    if args.accept(Word::All)? {
        let amount = args.single()?;
        if word == Word::Filter {
            all.0 = amount;
        } else {
            all.1 = amount;
        }
        return Ok(());
    }
    let start = args.span();
    let number = args.float()?.trunc();
    args.comma()?;
    entries.push(Entry {
        word,
        number,
        amount: args.single()?,
        span: start.to(args.last_span()),
    });
    Ok(())
}

impl Entry {
    fn apply(&self, bitmap: &mut Bitmap) -> Parse<()> {
        let Entry { word, number, .. } = self;
        let Some(palette) = bitmap.palette_mut() else {
            let message = format!("`{word} {number}` needs a picture with a palette");
            let hint = format!("Write `{word} all` for every colour.");
            let error = Diagnostic::error(self.span, message).with_hint(hint);
            return Err(Box::new(error));
        };
        let len = palette.len();
        let mut numbered = (0_u32..).zip(palette);
        let found = numbered.find(|(at, _)| f64::from(*at) == *number);
        let Some((
            _,
            Color {
                filter, transmit, ..
            },
        )) = found
        else {
            let message = format!("the palette has {len} colours, from 0, and none is {number}");
            return Err(Box::new(Diagnostic::error(self.span, message)));
        };
        if *word == Word::Filter {
            *filter = self.amount;
        } else {
            *transmit = self.amount;
        }
        Ok(())
    }
}
