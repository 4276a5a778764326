//! Letters of a TrueType font, and their layout in POV-Ray 3.7 (measured): the first begins at zero, the others follow
//! by advance, kerning and the offset of the text, whose depth is ignored.

use super::outline::Outline;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;
use ttf_parser::cmap::{Format, Subtable};
use ttf_parser::{Face, FaceParsingError, GlyphId, OutlineBuilder, PlatformId, Tag, loca};

/// Symbol fonts have their characters from this code on.
const SYMBOLS: u32 = 0xF000;
/// Codes below this are looked up among the symbols.
const SYMBOL_CODES: u32 = 0x100;

/// Size of the header of a kerning table, and of a pair, in bytes.
const KERN_HEADER: usize = 14;
const PAIR_BYTES: usize = 6;
/// Coverage bits of a kerning table that matter: format, horizontal, minimum values, cross-stream.
const KERN_KIND: u16 = 0xFF07;
const KERN_HORIZONTAL: u16 = 1;

/// A positioned letter.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Letter {
    pub(super) outline: Arc<Outline>,
    /// The corners of its box as the font gives it, before positioning; in units of the em.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    pub(super) at: DVec3,
}

/// Lays out a text in the font of these bytes.
pub(super) fn set(
    bytes: &[u8],
    text: &str,
    offset: DVec3,
) -> Result<Vec<Letter>, FaceParsingError> {
    let face = Face::parse(bytes, 0)?;
    let em = f64::from(face.units_per_em());
    let offset = DVec3::new(offset.x, offset.y, 0.0);
    let table = table(&face);
    let mut glyphs: FxHashMap<GlyphId, Glyph> = FxHashMap::default();
    let mut letters = Vec::new();
    let mut pen = DVec3::ZERO;
    let mut before = None;
    for letter in text.chars() {
        let id = table
            .as_ref()
            .map_or(GlyphId(0), |table| glyph_id(table, letter));
        let glyph = glyphs
            .entry(id)
            .or_insert_with(|| Glyph::new(&face, id, em));
        let mut at = pen;
        match before {
            None => {
                at.x = -glyph.low.x;
                pen.x = glyph.advance - glyph.bearing;
            }
            Some(before) => {
                let kern = kerning(&face, before, id) / em;
                at.x += glyph.bearing - glyph.low.x + kern;
                pen.x += glyph.advance + kern;
            }
        }
        letters.push(Letter {
            outline: Arc::clone(&glyph.outline),
            low: glyph.low,
            high: glyph.high,
            at,
        });
        pen += offset;
        before = Some(id);
    }
    Ok(letters)
}

/// A glyph of the font, in units of the em.
struct Glyph {
    outline: Arc<Outline>,
    low: DVec2,
    high: DVec2,
    advance: f64,
    bearing: f64,
}

impl Glyph {
    fn new(face: &Face, id: GlyphId, em: f64) -> Self {
        let mut pen = Pen {
            em,
            pieces: Vec::new(),
            start: DVec2::ZERO,
            at: DVec2::ZERO,
        };
        face.outline_glyph(id, &mut pen);
        let outline = Outline::new(pen.pieces);
        let (mut low, mut high) = outline.bounds();
        if let Some([x_min, y_min, x_max, y_max]) = header(face, id) {
            low = low.min(DVec2::new(x_min, y_min) / em);
            high = high.max(DVec2::new(x_max, y_max) / em);
        }
        if low.x > high.x {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        Glyph {
            outline: Arc::new(outline),
            low,
            high,
            advance: face.glyph_hor_advance(id).map_or(0.0, f64::from) / em,
            bearing: face.glyph_hor_side_bearing(id).map_or(0.0, f64::from) / em,
        }
    }
}

/// The box of a glyph stored in the font: the four numbers after its count of contours.
fn header(face: &Face, id: GlyphId) -> Option<[f64; 4]> {
    let table = |name| face.raw_face().table(Tag::from_bytes(name));
    let count = face.tables().maxp.number_of_glyphs;
    let format = face.tables().head.index_to_location_format;
    let locations = loca::Table::parse(count, format, table(b"loca")?)?;
    let bytes = table(b"glyf")?.get(locations.glyph_range(id)?)?;
    let number = |at: usize| {
        Some(f64::from(i16::from_be_bytes([
            *bytes.get(at)?,
            *bytes.get(at + 1)?,
        ])))
    };
    Some([number(2)?, number(4)?, number(6)?, number(8)?])
}

/// The character map: as in POV-Ray for Latin letters, first one for the Macintosh, then one for Windows.
fn table<'a>(face: &Face<'a>) -> Option<Subtable<'a>> {
    let tables = face.tables().cmap?.subtables;
    let platforms = [
        PlatformId::Macintosh,
        PlatformId::Windows,
        PlatformId::Unicode,
    ];
    platforms.into_iter().find_map(|platform| {
        tables.into_iter().find(|table| {
            let is_known = matches!(
                table.format,
                Format::ByteEncodingTable(_)
                    | Format::SegmentMappingToDeltaValues(_)
                    | Format::TrimmedTableMapping(_)
            );
            table.platform_id == platform && is_known
        })
    })
}

fn glyph_id(table: &Subtable, letter: char) -> GlyphId {
    let code = u32::from(letter);
    let direct = table.glyph_index(code).filter(|id| id.0 != 0);
    let is_symbol =
        matches!(table.format, Format::SegmentMappingToDeltaValues(_)) && code < SYMBOL_CODES;
    let direct = direct.or_else(|| {
        is_symbol
            .then(|| table.glyph_index(SYMBOLS + code))
            .flatten()
    });
    direct.unwrap_or(GlyphId(0))
}

/// Kerning of two letters, in units of the font. Real fonts have pairs out of order, so they are searched linearly, and
/// as in POV-Ray up to the first whose left letter comes later.
fn kerning(face: &Face, left: GlyphId, right: GlyphId) -> f64 {
    let table = face.raw_face().table(Tag::from_bytes(b"kern"));
    kern_tables(table.unwrap_or(&[]))
        .filter_map(|pairs| {
            let mut pairs = pairs.chunks_exact(PAIR_BYTES).map(|pair| {
                let number = |at: usize| u16::from_be_bytes([pair[at], pair[at + 1]]);
                (number(0), number(2), i16::from_be_bytes([pair[4], pair[5]]))
            });
            pairs
                .by_ref()
                .take_while(|pair| pair.0 <= left.0)
                .find(|pair| (pair.0, pair.1) == (left.0, right.0))
        })
        .map(|(_, _, nearer)| f64::from(nearer))
        .sum()
}

/// The pairs of each horizontal kerning table of the common format.
fn kern_tables(table: &[u8]) -> impl Iterator<Item = &[u8]> {
    let number = |at: usize| Some(u16::from_be_bytes([*table.get(at)?, *table.get(at + 1)?]));
    let mut left = number(2).unwrap_or(0);
    let mut at = 4;
    std::iter::from_fn(move || {
        while left > 0 {
            left -= 1;
            let (len, kind) = (usize::from(number(at + 2)?), number(at + 4)?);
            let start = at + KERN_HEADER;
            let end = start + PAIR_BYTES * usize::from(number(at + 6)?);
            at += len;
            if kind & KERN_KIND == KERN_HORIZONTAL {
                return Some(table.get(start..end.min(table.len())).unwrap_or(&[]));
            }
        }
        None
    })
}

/// Records an outline.
struct Pen {
    em: f64,
    pieces: Vec<[DVec2; 3]>,
    start: DVec2,
    at: DVec2,
}

impl Pen {
    fn em_point(&self, x: f32, y: f32) -> DVec2 {
        DVec2::new(f64::from(x), f64::from(y)) / self.em
    }

    fn line(&mut self, to: DVec2) {
        self.pieces.push([self.at, 0.5 * (self.at + to), to]);
        self.at = to;
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.at = self.em_point(x, y);
        self.start = self.at;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.em_point(x, y);
        self.line(to);
    }

    fn quad_to(&mut self, bend_x: f32, bend_y: f32, x: f32, y: f32) {
        let to = self.em_point(x, y);
        self.pieces
            .push([self.at, self.em_point(bend_x, bend_y), to]);
        self.at = to;
    }

    /// TrueType has no cubic segments, and other fonts are not read: the curve becomes its chord.
    fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, x: f32, y: f32) {
        let to = self.em_point(x, y);
        self.line(to);
    }

    fn close(&mut self) {
        if self.at != self.start {
            let start = self.start;
            self.line(start);
        }
    }
}
