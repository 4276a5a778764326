//! Reading long data by all threads: pieces of the text are read side by side, and what they come to is taken in turn.
//!
//! A piece counts only if the one before it ends where it begins. Where something in a piece is more than literals, what
//! lies behind that place is read again.

use super::known::{Known, Told};
use super::literal::{Ground, Literal, Memory};
use super::part_cache::Parts;
use super::plain::{Read, literal_object};
use crate::base::args::Parse;
use crate::base::source::FileId;
use crate::lang::reader::Reader;
use crate::scene::texture::{Finish, Layer, Texture};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// A piece has about so many bytes.
const PIECE: usize = 1 << 14;
/// So many pieces are read at once.
const AT_ONCE: usize = 24;
/// Shorter data are read by one thread.
pub(crate) const LONG: usize = PIECE * AT_ONCE / 4;
/// So much is read by one thread first: by then the data have shown what they are, and which identifiers they use.
pub(crate) const FIRST: usize = PIECE;
/// Braces are counted in runs of so many bytes.
const RUN: usize = 128;

/// What becomes of objects that are written as plain literals.
pub(crate) trait Taker {
    /// What is kept of one.
    type Kept: Send;

    /// What is kept of an object; any thread may ask for it.
    fn kept(read: Read, defaults: &Defaults<'_>) -> Self::Kept;

    /// Takes what is kept of the objects of a piece.
    fn take(&mut self, reader: &mut Reader<'_>, piece: Vec<Self::Kept>) -> Parse<()>;
}

/// What objects have that say nothing else.
pub(crate) struct Defaults<'a> {
    pub(crate) layer: &'a Layer,
    pub(crate) texture: &'a Arc<Texture>,
    /// That of the layer. Each piece has its own, for threads that count who has it would wait for each other.
    pub(crate) finish: Arc<Finish>,
}

/// What a piece needs.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    pub(crate) of_all: OfAll<'a>,
    pub(crate) known: Known<'a>,
}

/// What is the same for all pieces, whoever reads them.
#[derive(Clone, Copy)]
pub(crate) struct OfAll<'a> {
    pub(crate) file: FileId,
    pub(crate) version: f64,
    pub(crate) layer: &'a Layer,
    pub(crate) texture: &'a Arc<Texture>,
}

/// What a piece of the text came to.
pub(crate) struct Piece<T> {
    pub(crate) read: Vec<T>,
    /// How many objects there are in those read.
    pub(crate) parts: u64,
    /// Where it begins and how far it was read.
    pub(crate) range: Range<usize>,
}

/// Whether reading by all threads is worth while.
pub(crate) fn is_worth_while() -> bool {
    rayon::current_num_threads() > 1
}

/// The objects of a range, as far as they are written as plain literals.
pub(crate) fn piece_of_objects<T: Taker>(
    text: &str,
    range: Range<usize>,
    around: &Around<'_>,
    memory: &Memory,
) -> Piece<T::Kept> {
    let ground = around.ground(memory);
    let defaults = Defaults {
        layer: around.of_all.layer,
        texture: around.of_all.texture,
        finish: Arc::new((*around.of_all.layer.finish).clone()),
    };
    let mut parts = Parts::default();
    let mut piece = Piece {
        read: Vec::new(),
        parts: 0,
        range: range.start..range.start,
    };
    while piece.range.end < range.end
        && let Some(object) =
            literal_object(text, piece.range.end, &ground, (defaults.layer, &mut parts))
    {
        piece.range.end = object.end;
        piece.parts += u64::from(object.parts);
        piece.read.push(T::kept(object.read, &defaults));
    }
    piece.read.shrink_to_fit();
    piece
}

/// Reads the pieces of data from a byte on, at which an object begins, while `take` takes those before them; until
/// `take` says to stop, or what is left is no more than one thread reads.
pub(crate) fn objects<T: Taker>(
    text: &str,
    from: usize,
    told: &Told,
    of_all: OfAll<'_>,
    take: impl FnMut(Piece<T::Kept>) -> bool,
) {
    let read = |range: &Range<usize>| {
        let known = Known::Told(told);
        let around = Around { of_all, known };
        piece_of_objects::<T>(text, range.clone(), &around, &Memory::default())
    };
    batch_by_batch(text, from, behind_object, read, take);
}

/// The same with the vectors of `len` components of a list, one after the other; one begins at `from`, with or without a
/// comma before it.
pub(crate) fn vectors(
    text: &str,
    from: usize,
    (len, file): (usize, FileId),
    take: impl FnMut(Piece<f64>) -> bool,
) {
    let read = |range: &Range<usize>| {
        let ground = Ground {
            file,
            known: Known::Told(&Told::default()),
            version: 0.0,
            memory: &Memory::default(),
        };
        let mut args = Literal::new(text, range.start, &ground);
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
    batch_by_batch(text, from, behind_vector, read, take);
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
    let mut next = (text.len() - from >= LONG).then(|| batch(from));
    while let Some((pieces, end)) = next.take() {
        let goes_on = rayon::in_place_scope(|scope| {
            if text.len() - end >= LONG {
                scope.spawn(|_| next = Some(batch(end)));
            }
            pieces.into_iter().all(&mut take)
        });
        if !goes_on {
            return;
        }
    }
}

impl<'a> Around<'a> {
    pub(crate) fn ground(&self, memory: &'a Memory) -> Ground<'a> {
        Ground {
            file: self.of_all.file,
            known: self.known,
            version: self.of_all.version,
            memory,
        }
    }
}

/// The ranges of the next pieces; `behind` finds the end of what stands at a byte, in a range that begins with something
/// whole.
fn pieces(
    text: &str,
    from: usize,
    behind: impl Fn(&[u8], Range<usize>) -> usize,
) -> Vec<Range<usize>> {
    let mut ranges = Vec::with_capacity(AT_ONCE);
    let mut start = from;
    while ranges.len() < AT_ONCE && start < text.len() {
        let near = text.len().min(start + PIECE);
        let end = behind(text.as_bytes(), start..near);
        ranges.push(start..end);
        start = end;
    }
    ranges
}

/// The end of the object in which a range ends.
fn behind_object(text: &[u8], range: Range<usize>) -> usize {
    let mut depth: i64 = text[range.clone()].chunks(RUN).map(deepening).sum();
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

/// How many more braces a run opens than it closes.
fn deepening(run: &[u8]) -> i64 {
    let count = |brace: u8| {
        run.iter()
            .fold(0_u8, |count, byte| count + u8::from(*byte == brace))
    };
    i64::from(count(b'{')) - i64::from(count(b'}'))
}

/// The end of the vector in which a range ends.
fn behind_vector(text: &[u8], range: Range<usize>) -> usize {
    memchr::memchr(b'>', &text[range.end..]).map_or(text.len(), |at| range.end + at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nothing;

    impl Taker for Nothing {
        type Kept = ();

        fn kept(_: Read, _: &Defaults<'_>) {}

        fn take(&mut self, _: &mut Reader<'_>, _: Vec<()>) -> Parse<()> {
            Ok(())
        }
    }

    #[test]
    fn pieces_end_behind_objects_and_follow_each_other() {
        let one =
            "sphere { <1, 2, 3>, 0.5 pigment { rgb <0.1, 0.2, 0.3> }\n finish { phong 1 } }\n";
        let text = one.repeat(3 * PIECE / one.len());
        let pieces = pieces(&text, 0, behind_object);
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
    fn all_that_is_written_as_literals_is_read_and_no_more() {
        let one = "sphere { <1, 2, 3>, 0.5 }\n";
        let text = one.repeat(1000) + "sphere { <1, 2, 3>, sin(2) }\n" + &one.repeat(9000);
        let layer = Layer::default();
        let texture = Arc::new(Texture::from(layer.clone()));
        let told = Told::default();
        let of_all = OfAll {
            file: FileId(0),
            version: 3.7,
            layer: &layer,
            texture: &texture,
        };
        let mut pieces = Vec::new();
        objects::<Nothing>(&text, 0, &told, of_all, |piece| {
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
