//! Reading through long stretches of data, of which tokens are made only where they are needed.
//!
//! Objects and lists that are written as plain literals are read straight from the text ([`Literal`]); of what is not,
//! tokens are made for the piece at hand.

use super::cursor::Place;
use super::literal::{Ground, Literal};
use super::plain::{Read, plain_object};
use super::reader::Reader;
use crate::args::{Args, Parse};
use crate::syntax::{Kind, behind_more, more_from, tokenize_more};
use std::sync::Arc;

/// Tokens are made of pieces of about so many bytes: few where literals are interrupted, more where they end.
pub(super) const SHORTEST_PIECE: usize = 1 << 10;
const LONGEST_PIECE: usize = 1 << 15;

impl Reader<'_> {
    /// At a [`Kind::More`]: goes on to the tokens of the next piece, or behind the stretch.
    pub(super) fn read_on(&mut self) {
        let (tokens, at, faults) =
            tokenize_more(&self.here.tokens, self.here.at, self.piece, &mut self.names);
        self.piece = LONGEST_PIECE.min(2 * self.piece);
        self.here = Place { tokens, at };
        for fault in faults {
            let fault = self.with_trace(fault);
            self.record(*fault);
        }
    }

    /// Goes behind the stretch at hand.
    pub(super) fn leave_stretch(&mut self) {
        let (tokens, at) = behind_more(&self.here.tokens, self.here.at);
        self.here = Place { tokens, at };
    }

    /// Whether objects and lists may be read from the text here.
    fn is_at_data(&self) -> bool {
        self.raw().kind == Kind::More && self.deprecated.is_empty()
    }

    /// Where in which text the data at hand lies.
    fn data(&self) -> Option<(Arc<String>, std::ops::Range<usize>)> {
        let tokens = &self.here.tokens;
        let rest = tokens.more(self.here.at)?;
        let range = rest.start as usize..rest.end as usize;
        Some((Arc::clone(tokens.text()), range))
    }

    /// Goes to a byte of the stretch at hand.
    fn go_to(&mut self, from: usize) {
        let tokens = more_from(&self.here.tokens, self.here.at, from);
        self.last = Place { tokens, at: 0 };
        self.here = self.last.clone();
        self.here.at = 1;
    }

    /// Takes the objects at hand, as long as they are written as plain literals, and gives them to `take`.
    pub(super) fn take_literal_objects(
        &mut self,
        mut take: impl FnMut(&mut Self, Read) -> Parse<()>,
    ) -> Parse<()> {
        if !self.is_at_data() {
            return Ok(());
        }
        let Some((text, range)) = self.data() else {
            return Ok(());
        };
        let mut at = range.start;
        let mut result = Ok(());
        while let Some((object, end)) = self.literal_object(&text[..range.end], at) {
            at = end;
            result = take(self, object);
            if result.is_err() {
                break;
            }
        }
        if at > range.start {
            self.go_to(at);
            self.piece = SHORTEST_PIECE;
        }
        result
    }

    /// The object that begins at a byte, and its end, if it is a shape that is written as plain literals.
    fn literal_object(&self, text: &str, at: usize) -> Option<(Read, usize)> {
        let ground = Ground {
            file: self.here.tokens.file,
            names: &self.names,
            scopes: &self.scopes,
            version: self.version,
            memory: &self.memory,
        };
        let mut args = Literal::new(text, at, &ground);
        let object = plain_object(&mut args, &self.default_layer).ok()??;
        args.reached().map(|end| (object, end))
    }

    /// Takes the literal vectors at hand as [`Args::literal_vectors`] does, if the data go on here, or behind the comma
    /// at hand.
    pub(super) fn take_vectors_of_data(
        &mut self,
        len: usize,
        take: &mut dyn FnMut(&[f64]) -> bool,
    ) {
        let has_comma = self.raw().is_mark(',') && self.raw_ahead(1).kind == Kind::More;
        self.here.at += usize::from(has_comma);
        let begins = if has_comma { "<" } else { "" };
        if !self.take_vectors_here(len, begins, take) {
            self.here.at -= usize::from(has_comma);
        }
    }

    /// Takes the vectors of the data at hand, if these begin so; says whether there were any.
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
        let ground = Ground {
            file: self.here.tokens.file,
            names: &self.names,
            scopes: &self.scopes,
            version: self.version,
            memory: &self.memory,
        };
        let mut args = Literal::new(&text[..range.end], range.start, &ground);
        args.literal_vectors(len, take);
        match args.reached().filter(|end| *end > range.start) {
            Some(end) => {
                self.go_to(end);
                true
            }
            None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lang::literal::Memory;
    use crate::lang::scope::Scopes;
    use crate::source::FileId;
    use crate::syntax::Names;
    use crate::texture::Layer;

    /// How much of a text is read as one object of literals.
    fn reached(text: &str) -> Option<usize> {
        let (names, scopes) = (Names::new(), Scopes::default());
        let ground = Ground {
            file: FileId(0),
            names: &names,
            scopes: &scopes,
            version: 3.7,
            memory: &Memory::default(),
        };
        let mut args = Literal::new(text, 0, &ground);
        plain_object(&mut args, &Layer::default()).ok()??;
        args.reached()
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
        ] {
            assert_eq!(reached(text), Some(text.len()), "{text}");
        }
    }

    #[test]
    fn what_is_more_than_literals_is_left_to_the_tokens() {
        for text in [
            "sphere { x, 0.5 }",
            "sphere { <1, 2, 3>*2, 0.5 }",
            "sphere { <1, 2, 3>, R }",
            "sphere { <1, 2, 3>, 0.5 hollow }",
            "union { sphere { 0, 1 } }",
        ] {
            assert_eq!(reached(text), None, "{text}");
        }
    }
}
