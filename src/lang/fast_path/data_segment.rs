//! Reading through long segments of data, which are tokenized only where needed.
//!
//! Objects and lists written as plain literals are parsed straight from the text ([`Literal`]); anything else is
//! tokenized in pieces.

use super::known::{Known, NotedValues};
use super::literal::Literal;
use super::literal_cache::{CachedPiece, Context, LiteralReuse, OpenRun};
use super::parallel;
use super::parallel::{LiteralSink, Piece, PieceContext, SharedContext};
use crate::base::args::Parse;
use crate::lang::frame::Position;
use crate::lang::limits::MIN_PIECE;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, after_more, more_from, tokenize_more};
use std::cell::RefCell;
use std::sync::Arc;

const MAX_PIECE: usize = 1 << 15;

impl Reader<'_> {
    /// At a [`Kind::DataSegment`]: goes on to the tokens of the next piece, or after the segment.
    pub(crate) fn read_on(&mut self) {
        let (tokens, at, faults) =
            tokenize_more(&self.here.tokens, self.here.at, self.piece, &mut self.names);
        self.piece = MAX_PIECE.min(2 * self.piece);
        self.here = Position { tokens, at };
        for fault in faults {
            let fault = self.with_trace(fault);
            self.record(*fault);
        }
    }

    /// Goes past the current data segment.
    pub(crate) fn leave_segment(&mut self) {
        let (tokens, at) = after_more(&self.here.tokens, self.here.at);
        self.here = Position { tokens, at };
    }

    /// True if objects and lists may be parsed from the text here.
    fn is_at_data(&self) -> bool {
        self.raw().kind == Kind::DataSegment && self.usage.deprecated.is_empty()
    }

    /// The text with the data at the cursor, and their range in it.
    fn data(&self) -> Option<(Arc<String>, std::ops::Range<usize>)> {
        let tokens = &self.here.tokens;
        let rest = tokens.data_segment(self.here.at)?;
        let range = rest.start as usize..rest.end as usize;
        Some((Arc::clone(tokens.text()), range))
    }

    /// Goes to a byte of the current data segment.
    fn go_to(&mut self, from: usize) {
        let tokens = more_from(&self.here.tokens, self.here.at, from);
        self.last = Position { tokens, at: 0 };
        self.here = self.last.clone();
        self.here.at = 1;
    }

    /// Passes the next objects to `sink`, as long as they are written as plain literals.
    pub(crate) fn take_literal_objects(&mut self, sink: &mut impl LiteralSink) -> Parse<()> {
        if !self.is_at_data() {
            return Ok(());
        }
        let Some((text, range)) = self.data() else {
            return Ok(());
        };
        let mut at = range.start;
        let result = self.take_objects_of(&text[..range.end], &mut at, sink);
        if at > range.start {
            self.go_to(at);
            self.piece = MIN_PIECE;
        }
        result
    }

    /// Passes the objects of a text from a byte on to `sink`, and moves the byte past them.
    fn take_objects_of<T: LiteralSink>(
        &mut self,
        text: &str,
        at: &mut usize,
        sink: &mut T,
    ) -> Parse<()> {
        let noted = RefCell::default();
        let file = self.here.tokens.file;
        let is_reusable = !self.is_repeated();
        let reuse = self.reuse.take_if(|reuse| is_reusable && reuse.keeps(file));
        let Some(mut reuse) = reuse else {
            return self.take_run(text, at, sink, &noted, None);
        };
        let mut run = OpenRun::default();
        let result = self.take_run(text, at, sink, &noted, Some((&mut reuse, &mut run)));
        let context = Context {
            version: self.draft.version,
            layer: self.draft.default_layer.clone(),
            texture: Arc::clone(&self.draft.default_texture),
            known: noted.into_inner(),
        };
        reuse.end(run, context);
        self.reuse = Some(reuse);
        result
    }

    /// The same; pieces of the last reading are taken again, and those of this one cached, if there is a reuse.
    fn take_run<T: LiteralSink>(
        &mut self,
        text: &str,
        at: &mut usize,
        sink: &mut T,
        noted: &RefCell<NotedValues>,
        mut cached: Option<(&mut LiteralReuse<'_>, &mut OpenRun)>,
    ) -> Parse<()> {
        loop {
            if let Some((reuse, run)) = &mut cached
                && self.take_cached(text, at, sink, noted, (reuse, run))?
            {
                continue;
            }
            let next = cached_from(cached.as_ref(), *at);
            let mut take = |reader: &mut Self, piece: Piece<T::Item>, at: &mut usize| {
                *at = piece.range.end;
                reader.count_objects(piece.parts)?;
                let Some((_, run)) = &mut cached else {
                    return sink.take(reader, piece.read);
                };
                let objects = T::to_cached(piece.read);
                run.keep(CachedPiece {
                    range: piece.range,
                    parts: piece.parts,
                    objects: objects.clone(),
                });
                sink.take_cached(reader, &objects)
            };
            let first = *at..next.min(*at + parallel::FIRST_BYTES);
            let piece_context = self.piece_context(noted);
            let piece =
                parallel::piece_of_objects::<T>(text, first.clone(), &piece_context, &self.memory);
            if !piece.range.is_empty() {
                take(self, piece, at)?;
            }
            if *at < first.end {
                return Ok(());
            }
            if !parallel::has_many_threads() {
                continue;
            }
            let (layer, texture) = (
                self.draft.default_layer.clone(),
                Arc::clone(&self.draft.default_texture),
            );
            let shared = SharedContext {
                layer: &layer,
                texture: &texture,
                ..self.shared()
            };
            let mut result = Ok(());
            let text = &text[..next.clamp(*at, text.len())];
            parallel::objects::<T>(text, *at, &noted.borrow(), shared, |piece| {
                let follows = piece.range.start == *at;
                if follows {
                    result = take(self, piece, at);
                }
                follows && result.is_ok()
            });
            result?;
        }
    }

    /// Takes a piece of the last reading, if one begins here and its context is the current one.
    fn take_cached<T: LiteralSink>(
        &mut self,
        text: &str,
        at: &mut usize,
        sink: &mut T,
        noted: &RefCell<NotedValues>,
        (reuse, run): (&mut LiteralReuse<'_>, &mut OpenRun),
    ) -> Parse<bool> {
        let is_current = |context: &Context| {
            let PieceContext { shared, known } = self.piece_context(noted);
            context.is_same(shared.version, shared.layer, shared.texture, known)
        };
        let Some(piece) = reuse.piece_at(*at, text.len(), run, is_current) else {
            return Ok(false);
        };
        if !T::suits(&piece.objects) {
            return Ok(false);
        }
        reuse.note_taken();
        *at = piece.range.end;
        self.count_objects(piece.parts)?;
        sink.take_cached(self, &piece.objects)?;
        run.keep(piece);
        Ok(true)
    }

    fn piece_context<'a>(&'a self, noted: &'a RefCell<NotedValues>) -> PieceContext<'a> {
        PieceContext {
            shared: self.shared(),
            known: Known::Scopes(&self.names, &self.scopes, noted),
        }
    }

    fn shared(&self) -> SharedContext<'_> {
        SharedContext {
            file: self.here.tokens.file,
            version: self.draft.version,
            layer: &self.draft.default_layer,
            texture: &self.draft.default_texture,
        }
    }

    /// Takes the literal vectors that come next as [`crate::base::args::Args::literal_vectors`] does, if a data segment
    /// begins here, or after the next comma.
    pub(crate) fn take_vectors_of_data(
        &mut self,
        len: usize,
        take: &mut dyn FnMut(&[f64]) -> bool,
    ) {
        let has_comma = self.raw().is_mark(',') && self.raw_ahead(1).kind == Kind::DataSegment;
        self.here.at += usize::from(has_comma);
        let begins = if has_comma { "<" } else { "" };
        if !self.take_vectors_here(len, begins, take) {
            self.here.at -= usize::from(has_comma);
        }
    }

    /// Takes the vectors of the data at the cursor, if these start with `begins`; true if there were any.
    fn take_vectors_here(
        &mut self,
        len: usize,
        begins: &str,
        take: &mut dyn FnMut(&[f64]) -> bool,
    ) -> bool {
        if !self.is_at_data() {
            return false;
        }
        let Some((text, range)) = self.data() else {
            return false;
        };
        if !text[range.clone()].trim_ascii_start().starts_with(begins) {
            return false;
        }
        let mut at = range.start;
        self.take_vectors_of(&text[..range.end], &mut at, len, take);
        if at > range.start {
            self.go_to(at);
        }
        at > range.start
    }

    /// Passes the vectors of a text from a byte on to `take`, and moves the byte past them.
    fn take_vectors_of(
        &self,
        text: &str,
        at: &mut usize,
        len: usize,
        take: &mut dyn FnMut(&[f64]) -> bool,
    ) {
        let noted = RefCell::default();
        let piece_context = self.piece_context(&noted);
        let literal_context = piece_context.literal_context(&self.memory);
        loop {
            let mut args = Literal::new(text, *at, &literal_context);
            let first = *at;
            while *at < first + parallel::FIRST_BYTES {
                if !args.item(len).is_some_and(|vector| take(&vector[..len])) {
                    return;
                }
                *at = args.at();
            }
            if !parallel::has_many_threads() {
                continue;
            }
            let mut is_wanted = true;
            parallel::vectors(text, *at, len, piece_context.shared.file, |piece| {
                if piece.range.start != *at {
                    return false;
                }
                let vectors = piece.read.chunks_exact(len);
                let taken = vectors.take_while(|vector| take(vector)).count();
                is_wanted = taken == piece.read.len() / len;
                if is_wanted {
                    *at = piece.range.end;
                    return true;
                }
                let mut args = Literal::new(text, *at, &literal_context);
                for _ in 0..taken {
                    args.item(len);
                }
                *at = args.at();
                false
            });
            if !is_wanted {
                return;
            }
        }
    }
}

/// The first byte behind `at` from which objects may be taken from the last reading; `usize::MAX` without any.
fn cached_from(cached: Option<&(&mut LiteralReuse<'_>, &mut OpenRun)>, at: usize) -> usize {
    let next = cached.and_then(|(reuse, _)| reuse.next_piece(at));
    next.unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::options::ReadOptions;
    use crate::base::source::{FileId, Sources};
    use crate::lang::evaluate;
    use crate::lang::fast_path::common_object::literal_object;
    use crate::lang::fast_path::literal::{LiteralContext, Memory};
    use crate::lang::fast_path::part_cache::Parts;
    use crate::scene::Kind;
    use crate::scene::texture::Layer;

    /// Length of the text that is parsed as one object of literals.
    fn reached(text: &str) -> Option<usize> {
        let literal_context = LiteralContext {
            file: FileId(0),
            known: Known::Noted(&NotedValues::default()),
            version: 3.7,
            memory: &Memory::default(),
        };
        let mut parts = Parts::default();
        literal_object(text, 0, &literal_context, &Layer::default(), &mut parts)
            .map(|object| object.end)
    }

    #[test]
    fn objects_in_literals_need_no_tokens() {
        for text in [
            "sphere { <-1.5, 2, 3>, 0.5 }",
            "\nsphere { <1,2,3>, 0.5 pigment { rgb <0.1, 0.2, 0.3> } }",
            "sphere {<1,2,3>,0.5 pigment{color rgbt <0.1, 0.2, 0.3, 0.4>}finish{phong 1 ambient 0.2}}",
            "box { -1, 1 rotate <0, 30, 0> scale 2 translate <1, 2, 3> texture { pigment { rgb 1 } } }",
            "cylinder { <0,0,0>, <0,1,0>, 0.25 open }",
            "triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }",
            "cylinder { -2*x, 2 * y, 0.6 }",
            "sphere { -z, 1 }",
            "union { sphere { 0, 1 } difference { box { -1, 1 } sphere { y, 1 } } no_shadow scale 2 }",
        ] {
            assert_eq!(reached(text), Some(text.len()), "{text}");
        }
    }

    #[test]
    fn non_literals_are_left_to_the_tokens() {
        for text in [
            "sphere { x + y, 0.5 }",
            "sphere { 2*x*3, 0.5 }",
            "sphere { 2*xx, 0.5 }",
            "sphere { <1, 2, 3>*2, 0.5 }",
            "sphere { <1, 2, 3>, R }",
            "sphere { <1, 2, 3>, 0.5 hollow }",
            "union { sphere { 0, 1 } }",
            "union { sphere { 0, 1 } sphere { R, 1 } }",
            "light_group { sphere { 0, 1 } sphere { 1, 1 } }",
        ] {
            assert_eq!(reached(text), None, "{text}");
        }
    }

    #[test]
    fn parts_that_are_written_alike_are_read_once() {
        let text = "difference { box { -1, 1 } intersection { sphere { 0, 1 } box { 0, 2 } } scale 2 }
            difference { box { -1, 1 } intersection { sphere { 0, 1 } box { 0, 3 } } sphere { y, 1 } }
            difference { box { -1, 1 pigment { rgb 1 } } intersection { sphere { 0, 1 } box { 0, 2 } } }";
        let literal_context = LiteralContext {
            file: FileId(0),
            known: Known::Noted(&NotedValues::default()),
            version: 3.7,
            memory: &Memory::default(),
        };
        let (mut known, mut at) = (Parts::default(), 0);
        let mut objects = Vec::new();
        while at < text.len() {
            let layer = Layer::default();
            let object = literal_object(text, at, &literal_context, &layer, &mut known).unwrap();
            at = object.end;
            objects.push((object.parts, object.read.into_object(&Layer::default())));
        }
        let parts = |number: usize| match &objects[number].1.kind {
            Kind::Csg { children, .. } => &**children,
            _ => panic!("a combination"),
        };
        let is_shared =
            |one: usize, other: usize, at: usize| Arc::ptr_eq(&parts(one)[at], &parts(other)[at]);
        assert!(is_shared(0, 1, 0) && !is_shared(0, 1, 1));
        assert!(!is_shared(0, 2, 0) && is_shared(0, 2, 1));
        assert_eq!([0, 1, 2].map(|number| objects[number].0), [4, 5, 4]);
    }

    /// The result of reading a text, in full.
    fn reading_text(text: &str) -> String {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov".to_owned(), text);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        let scene = reading
            .scene
            .unwrap_or_else(|| panic!("{:?}", reading.findings));
        let objects = scene.objects.iter();
        objects.map(|object| format!("{object:?}\n")).collect()
    }

    #[test]
    fn long_data_mean_what_they_mean_token_by_token() {
        let head = "#version 3.7; #declare T = texture { pigment { rgb 0.5 } }
            #declare S = sphere { 0, 1 } #declare R = 3;";
        let number = |at: usize| at % 17;
        let data = |behind: &str| -> String {
            let object = |at: usize| match at % 7 {
                0 => format!(
                    "sphere {{ <{}, 2, -3>, 0.5 texture {{ T }} }}{behind}\n",
                    number(at)
                ),
                1 => format!("object {{ S scale {} }}{behind}\n", 1 + number(at)),
                2 => format!(
                    "difference {{ sphere {{ 0, {} }} cylinder {{ -2*x, 2*x, 1 }} pigment {{ rgb 1 }} }}{behind}\n",
                    1 + number(at)
                ),
                3 if at % 1000 == 3 => format!("sphere {{ R*y, {} }}{behind}\n", number(at)),
                _ => format!("box {{ -1, <1, 2, {}> rotate 3*y }}{behind}\n", number(at)),
            };
            (0..6000).map(object).collect()
        };
        let (plain, commented) = (data(""), data(" /**/"));
        assert!(plain.len() > 2 * crate::lang::fast_path::parallel::MIN_PARALLEL_BYTES);
        let (one, other) = (
            reading_text(&(head.to_owned() + &plain)),
            reading_text(&(head.to_owned() + &commented)),
        );
        assert!(one == other);
    }

    #[test]
    fn long_lists_mean_what_they_mean_token_by_token() {
        let mesh = |behind: &str| -> String {
            let vector = |at: usize| format!("<{}, {}, -0.5>,{behind}\n", at % 19, at % 23);
            let vectors: String = (0..12_000).map(vector).collect();
            let face = |at: usize| format!("<{at}, {}, {}>,{behind}\n", at + 1, at + 2);
            let faces: String = (0..9_000).map(face).collect();
            format!(
                "mesh2 {{ vertex_vectors {{ 12000, {vectors} }} face_indices {{ 9000, {faces} }} }}"
            )
        };
        assert!(mesh("").len() > 2 * crate::lang::fast_path::parallel::MIN_PARALLEL_BYTES);
        assert!(reading_text(&mesh("")) == reading_text(&mesh(" /**/")));
    }
}
