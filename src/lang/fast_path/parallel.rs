//! Parallel reading of long data: threads parse pieces of the text, and the results are taken in order.
//!
//! A piece counts only if the one before it ends where it begins. Where a piece holds more than literals, the text
//! after that position is read again.

use super::common_object::{Read, literal_object};
use super::known::{Known, NotedValues};
use super::literal::{Literal, LiteralContext, Memory};
use super::literal_cache::CachedObjects;
use super::part_cache::Parts;
use crate::base::args::Parse;
use crate::base::source::FileId;
use crate::lang::reader::Reader;
use crate::scene::texture::{Finish, Layer, Texture};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Approximate size of a piece in bytes.
const PIECE_BYTES: usize = 1 << 14;
/// Number of pieces read at once.
const PIECES_AT_ONCE: usize = 24;
/// Shorter data are read by one thread.
pub(crate) const MIN_PARALLEL_BYTES: usize = PIECE_BYTES * PIECES_AT_ONCE / 4;
/// Bytes read by one thread first: by then the kind of the data and their identifiers are known.
pub(crate) const FIRST_BYTES: usize = PIECE_BYTES;
/// Braces are counted in runs of this many bytes, so that a count fits into a byte.
const BRACE_RUN: usize = 128;

/// Receives objects that are written as plain literals.
pub(crate) trait LiteralSink {
    /// The stored form of an object.
    type Item: Send;

    /// Converts an object; any thread may call it.
    fn item(read: Read, defaults: &Defaults<'_>) -> Self::Item;

    /// Objects of this kind for the next reading.
    fn to_cached(objects: Vec<Self::Item>) -> CachedObjects;

    /// Takes the objects of a piece.
    fn take(&mut self, reader: &mut Reader<'_>, piece: Vec<Self::Item>) -> Parse<()>;

    /// True if cached objects are of this kind.
    fn suits(objects: &CachedObjects) -> bool;

    /// Takes cached objects of this kind.
    fn take_cached(&mut self, reader: &mut Reader<'_>, objects: &CachedObjects) -> Parse<()>;
}

/// Attributes of objects that set none.
pub(crate) struct Defaults<'a> {
    pub(crate) layer: &'a Layer,
    pub(crate) texture: &'a Arc<Texture>,
    /// The finish of the layer. Each piece has its own: threads would contend for one reference count.
    pub(crate) finish: Arc<Finish>,
}

/// The context of a piece.
#[derive(Clone, Copy)]
pub(crate) struct PieceContext<'a> {
    pub(crate) shared: SharedContext<'a>,
    pub(crate) known: Known<'a>,
}

/// Context that all pieces share, on any thread.
#[derive(Clone, Copy)]
pub(crate) struct SharedContext<'a> {
    pub(crate) file: FileId,
    pub(crate) version: f64,
    pub(crate) layer: &'a Layer,
    pub(crate) texture: &'a Arc<Texture>,
}

/// The parsed objects or numbers of a piece of text.
pub(crate) struct Piece<T> {
    pub(crate) read: Vec<T>,
    /// Number of objects in `read`, with their parts.
    pub(crate) parts: u64,
    /// From the start of the piece to where parsing ended.
    pub(crate) range: Range<usize>,
}

/// True if there are several threads.
pub(crate) fn has_many_threads() -> bool {
    rayon::current_num_threads() > 1
}

/// The objects of a range, as far as they are written as plain literals.
pub(crate) fn piece_of_objects<T: LiteralSink>(
    text: &str,
    range: Range<usize>,
    context: &PieceContext<'_>,
    memory: &Memory,
) -> Piece<T::Item> {
    let literal_context = context.literal_context(memory);
    let defaults = Defaults {
        layer: context.shared.layer,
        texture: context.shared.texture,
        finish: Arc::new((*context.shared.layer.finish).clone()),
    };
    let mut parts = Parts::default();
    let mut piece = Piece {
        read: Vec::new(),
        parts: 0,
        range: range.start..range.start,
    };
    while piece.range.end < range.end
        && let Some(object) = literal_object(
            text,
            piece.range.end,
            &literal_context,
            defaults.layer,
            &mut parts,
        )
    {
        piece.range.end = object.end;
        piece.parts += u64::from(object.parts);
        piece.read.push(T::item(object.read, &defaults));
    }
    piece.read.shrink_to_fit();
    piece
}

/// Reads objects in pieces, from a byte at which an object begins, while `take` receives the pieces before; until
/// `take` returns false, or the rest is short enough for one thread.
pub(crate) fn objects<T: LiteralSink>(
    text: &str,
    from: usize,
    noted: &NotedValues,
    shared: SharedContext<'_>,
    take: impl FnMut(Piece<T::Item>) -> bool,
) {
    let read = |range: &Range<usize>| {
        let known = Known::Noted(noted);
        let context = PieceContext { shared, known };
        piece_of_objects::<T>(text, range.clone(), &context, &Memory::default())
    };
    batch_by_batch(text, from, end_of_object, read, take);
}

/// The same with the vectors of `len` components of a list; one begins at `from`, with or without a comma before it.
pub(crate) fn vectors(
    text: &str,
    from: usize,
    len: usize,
    file: FileId,
    take: impl FnMut(Piece<f64>) -> bool,
) {
    let read = |range: &Range<usize>| {
        let literal_context = LiteralContext {
            file,
            known: Known::Noted(&NotedValues::default()),
            version: 0.0,
            memory: &Memory::default(),
        };
        let mut args = Literal::new(text, range.start, &literal_context);
        let mut read = Vec::new();
        while args.at() < range.end
            && let Some(vector) = args.item(len)
        {
            read.extend_from_slice(&vector[..len]);
        }
        Piece {
            read,
            parts: 0,
            range: range.start..args.at(),
        }
    };
    batch_by_batch(text, from, end_of_vector, read, take);
}

/// Reads batches of pieces, each while the one before it is taken.
fn batch_by_batch<T: Send>(
    text: &str,
    from: usize,
    behind: impl Fn(&[u8], Range<usize>) -> usize + Sync,
    read: impl Fn(&Range<usize>) -> Piece<T> + Sync,
    mut take: impl FnMut(Piece<T>) -> bool,
) {
    let batch = |from: usize| {
        let ranges = pieces(text, from, &behind);
        let end = ranges.last().map_or(from, |range| range.end);
        let read: Vec<Piece<T>> = ranges.par_iter().map(&read).collect();
        (read, end)
    };
    let mut next = (text.len() - from >= MIN_PARALLEL_BYTES).then(|| batch(from));
    while let Some((pieces, end)) = next.take() {
        let goes_on = rayon::in_place_scope(|scope| {
            if text.len() - end >= MIN_PARALLEL_BYTES {
                scope.spawn(|_| next = Some(batch(end)));
            }
            pieces.into_iter().all(&mut take)
        });
        if !goes_on {
            return;
        }
    }
}

impl<'a> PieceContext<'a> {
    pub(crate) fn literal_context(&self, memory: &'a Memory) -> LiteralContext<'a> {
        LiteralContext {
            file: self.shared.file,
            known: self.known,
            version: self.shared.version,
            memory,
        }
    }
}

/// The ranges of the next pieces; `behind` finds the end of the item at the end of a range that begins with a whole
/// one.
fn pieces(
    text: &str,
    from: usize,
    behind: impl Fn(&[u8], Range<usize>) -> usize,
) -> Vec<Range<usize>> {
    let mut ranges = Vec::with_capacity(PIECES_AT_ONCE);
    let mut start = from;
    while ranges.len() < PIECES_AT_ONCE && start < text.len() {
        let near = text.len().min(start + PIECE_BYTES);
        let end = behind(text.as_bytes(), start..near);
        ranges.push(start..end);
        start = end;
    }
    ranges
}

/// The end of the object in which a range ends.
fn end_of_object(text: &[u8], range: Range<usize>) -> usize {
    let mut depth: i64 = text[range.clone()]
        .chunks(BRACE_RUN)
        .map(brace_balance)
        .sum();
    let braces = memchr::memchr2_iter(b'{', b'}', &text[range.end..]);
    for brace in braces {
        let at = range.end + brace;
        depth += if text[at] == b'{' { 1 } else { -1 };
        if depth <= 0 {
            return at + 1;
        }
    }
    text.len()
}

/// Opening minus closing braces of a run.
fn brace_balance(run: &[u8]) -> i64 {
    let count = |brace: u8| {
        run.iter()
            .fold(0_u8, |count, byte| count + u8::from(*byte == brace))
    };
    i64::from(count(b'{')) - i64::from(count(b'}'))
}

/// The end of the vector in which a range ends.
fn end_of_vector(text: &[u8], range: Range<usize>) -> usize {
    memchr::memchr(b'>', &text[range.end..]).map_or(text.len(), |at| range.end + at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nothing;

    impl LiteralSink for Nothing {
        type Item = ();

        fn item(_: Read, _: &Defaults<'_>) {}

        fn to_cached(_: Vec<()>) -> CachedObjects {
            CachedObjects::Parts(Arc::default())
        }

        fn take(&mut self, _: &mut Reader<'_>, _: Vec<()>) -> Parse<()> {
            Ok(())
        }

        fn suits(_: &CachedObjects) -> bool {
            false
        }

        fn take_cached(&mut self, _: &mut Reader<'_>, _: &CachedObjects) -> Parse<()> {
            Ok(())
        }
    }

    #[test]
    fn pieces_end_behind_objects_and_follow_each_other() {
        let one =
            "sphere { <1, 2, 3>, 0.5 pigment { rgb <0.1, 0.2, 0.3> }\n finish { phong 1 } }\n";
        let text = one.repeat(3 * PIECE_BYTES / one.len());
        let pieces = pieces(&text, 0, end_of_object);
        assert!(pieces.len() >= 3);
        let mut at = 0;
        for piece in pieces {
            assert_eq!(piece.start, at);
            at = piece.end;
            assert!(text[..at].ends_with("} }") || at == text.len());
        }
        assert_eq!(at, text.len());
    }

    #[test]
    fn only_literal_objects_are_read() {
        let one = "sphere { <1, 2, 3>, 0.5 }\n";
        let text = one.repeat(1000) + "sphere { <1, 2, 3>, sin(2) }\n" + &one.repeat(9000);
        let layer = Layer::default();
        let texture = Arc::new(Texture::from(layer.clone()));
        let noted = NotedValues::default();
        let shared = SharedContext {
            file: FileId(0),
            version: 3.7,
            layer: &layer,
            texture: &texture,
        };
        let mut pieces = Vec::new();
        objects::<Nothing>(&text, 0, &noted, shared, |piece| {
            pieces.push(piece);
            true
        });
        assert!(pieces.len() > 2);
        let stopped = pieces.iter().position(|piece| piece.read.len() < 600);
        let before: usize = pieces[..=stopped.unwrap()]
            .iter()
            .map(|piece| piece.read.len())
            .sum();
        assert_eq!(before, 1000);
    }
}
