//! Objects written as literals, cached from one reading of a scene to the next.
//!
//! Most of the text stays while an author works on a scene. A piece that was read as literals gives the same objects
//! again if its text is the same, as are version, defaults and named values, and if a reader of literals comes to its
//! first byte as before. So its objects are taken from the last reading. All else is read as ever.

use super::known::{Known, KnownValue, NotedValues};
use crate::base::source::{FileId, TextChange};
use crate::scene::likeness::alike;
use crate::scene::texture::{Finish, Layer, Material, Pigment, Texture};
use crate::scene::{Object, SharedEntries};
use rustc_hash::FxHashMap;
use std::any::Any;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

/// The objects of a scene's text that were read as literals.
#[derive(Clone, Debug, Default)]
pub struct LiteralCache {
    /// The text; `None` if its changes are reported.
    text: Option<Arc<String>>,
    runs: Vec<Run>,
    /// True if some were taken from the reading before.
    has_taken: bool,
}

/// Pieces that were read one after the other, in one context.
#[derive(Clone, Debug)]
struct Run {
    context: Context,
    pieces: Vec<CachedPiece>,
}

/// Everything that the meaning of literals depends on beside their text.
#[derive(Clone, Debug)]
pub(super) struct Context {
    pub(super) version: f64,
    pub(super) layer: Layer,
    pub(super) texture: Arc<Texture>,
    pub(super) known: NotedValues,
}

/// The objects of a piece of text.
#[derive(Clone, Debug)]
pub(super) struct CachedPiece {
    pub(super) range: Range<usize>,
    /// Number of objects in it, with their parts.
    pub(super) parts: u64,
    pub(super) objects: CachedObjects,
}

/// Objects as their readers store them.
#[derive(Clone, Debug)]
pub(crate) enum CachedObjects {
    /// Those of the scene itself.
    Entries(SharedEntries),
    /// Parts of an object.
    Parts(Arc<[Arc<Object>]>),
}

/// Takes objects from the last reading of a scene, and keeps those of the current one.
#[derive(Debug)]
pub(crate) struct LiteralReuse<'a> {
    scene: FileId,
    last: &'a LiteralCache,
    change: TextChange,
    /// The first byte of each piece of the last reading, ascending, with its run and its number there.
    starts: Vec<(usize, [usize; 2])>,
    now: LiteralCache,
}

/// The run of pieces that is being read.
#[derive(Debug, Default)]
pub(super) struct OpenRun {
    /// For the runs of the last reading, true if their context is the current one.
    usable: FxHashMap<usize, bool>,
    pieces: Vec<CachedPiece>,
}

impl<'a> LiteralReuse<'a> {
    /// The reuse for the scene in a file, from the cache of the last reading. `reported` is the change of the text since, if
    /// all changes are reported.
    pub(crate) fn new(
        scene: FileId,
        text: &Arc<String>,
        (last, reported): (&'a LiteralCache, Option<&TextChange>),
    ) -> Self {
        let change = match (reported, &last.text) {
            (Some(reported), _) => reported.clone(),
            (None, Some(last)) => TextChange::between(last.as_bytes(), text.as_bytes()),
            // All of it may have changed.
            (None, None) => TextChange {
                old: 0..usize::MAX / 2,
                new_end: text.len(),
            },
        };
        let runs = last.runs.iter().enumerate();
        let positions = runs.flat_map(|(run, pieces)| {
            let pieces = pieces.pieces.iter().enumerate();
            pieces.map(move |(number, piece)| (piece.range.start, [run, number]))
        });
        let mut starts: Vec<_> = positions.collect();
        starts.sort_unstable();
        LiteralReuse {
            scene,
            last,
            change,
            starts,
            now: LiteralCache {
                text: reported.is_none().then(|| Arc::clone(text)),
                ..LiteralCache::default()
            },
        }
    }

    /// The literals of the reading that has ended.
    pub(crate) fn finish(self) -> LiteralCache {
        self.now
    }

    /// True if it keeps the literals of a file.
    pub(super) fn keeps(&self, file: FileId) -> bool {
        file == self.scene
    }

    /// The piece of the last reading that begins at a byte of the current text and ends within `end`, if its objects are
    /// those of the current text and context.
    pub(super) fn piece_at(
        &mut self,
        at: usize,
        end: usize,
        run: &mut OpenRun,
        is_current: impl Fn(&Context) -> bool,
    ) -> Option<CachedPiece> {
        let start = self.change.old_position(at)?;
        let first = self.starts.partition_point(|(other, _)| *other < start);
        let positions = self.starts[first..].iter();
        let mut positions = positions.take_while(|(other, _)| *other == start);
        positions.find_map(|&(_, [number, piece])| {
            let of = &self.last.runs[number];
            let piece = &of.pieces[piece];
            let range = self.change.moved(&piece.range)?;
            let usable = run.usable.entry(number);
            let is_usable = range.start == at
                && range.end <= end
                && *usable.or_insert_with(|| is_current(&of.context));
            is_usable.then(|| CachedPiece {
                range,
                ..piece.clone()
            })
        })
    }

    /// The first byte behind `at` where an unchanged piece of the last reading begins.
    pub(super) fn next_piece(&self, at: usize) -> Option<usize> {
        let from = match self.change.old_position(at) {
            Some(old) => old + 1,
            None => self.change.old.end,
        };
        let first = self.starts.partition_point(|(start, _)| *start < from);
        self.starts[first..].iter().find_map(|&(_, [run, piece])| {
            let range = self
                .change
                .moved(&self.last.runs[run].pieces[piece].range)?;
            (range.start > at).then_some(range.start)
        })
    }

    /// Keeps the pieces of a run, unless they may use objects: those are instanced by the number of references to them.
    pub(super) fn end(&mut self, run: OpenRun, context: Context) {
        let pieces = run.pieces;
        let mut known = context.known.values();
        let uses_objects = known.any(|value| matches!(value, KnownValue::Object(_)));
        if !(pieces.is_empty() || uses_objects) {
            self.now.runs.push(Run { context, pieces });
        }
    }

    /// Notes that objects of the last reading are part of the scene.
    pub(super) fn note_taken(&mut self) {
        self.now.has_taken = true;
    }
}

impl LiteralCache {
    /// True if objects of the reading before it are among them.
    #[must_use]
    pub fn has_taken(&self) -> bool {
        self.has_taken
    }
}

impl OpenRun {
    /// Adds a piece, unless it is empty: the next reading would not get past it.
    pub(super) fn keep(&mut self, piece: CachedPiece) {
        if !piece.range.is_empty() {
            self.pieces.push(piece);
        }
    }
}

impl Context {
    /// True if the two contexts give the same meaning to literals that use no other names than this one knows.
    pub(super) fn is_same(
        &self,
        version: f64,
        layer: &Layer,
        texture: &Arc<Texture>,
        known: Known<'_>,
    ) -> bool {
        self.version.to_bits() == version.to_bits()
            && alike(&self.layer, layer)
            && (Arc::ptr_eq(&self.texture, texture) || alike(&self.texture, texture))
            && self
                .known
                .iter()
                .all(|(name, old)| known.get(name).is_some_and(|new| is_same_value(old, &new)))
    }
}

fn is_same_value(old: &KnownValue, new: &KnownValue) -> bool {
    match (old, new) {
        (KnownValue::Element(old), KnownValue::Element(new)) => {
            Arc::ptr_eq(old, new)
                || are_alike::<Texture>(&**old, &**new)
                || are_alike::<Pigment>(&**old, &**new)
                || are_alike::<Finish>(&**old, &**new)
                || are_alike::<Material>(&**old, &**new)
        }
        _ => false,
    }
}

/// True if both are of this type, and alike.
fn are_alike<T: Any + Debug>(old: &dyn Any, new: &dyn Any) -> bool {
    let both = old.downcast_ref::<T>().zip(new.downcast_ref::<T>());
    both.is_some_and(|(old, new)| alike(old, new))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_without_text_are_not_cached() {
        let mut run = OpenRun::default();
        for range in [5..5, 5..9, 9..9, 9..12] {
            run.keep(CachedPiece {
                range,
                parts: 0,
                objects: CachedObjects::Parts(Arc::from([])),
            });
        }
        let ranges: Vec<_> = run.pieces.iter().map(|piece| piece.range.clone()).collect();
        assert_eq!(ranges, [5..9, 9..12]);
    }
}
