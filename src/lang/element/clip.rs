//! `clipped_by` and `bounded_by`: objects that clip or bound an object.

use crate::base::args::{Args, Parse, Word};
use crate::lang::reader::Reader;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::{Attached, Kind, Object};
use std::sync::Arc;

/// Levels of CSG that [`objection`] examines, and the parts of each.
const PARTS_DEPTH: usize = 4;
const MOST_PARTS: usize = 8;

impl Reader<'_> {
    /// `clipped_by { objects transforms }`, `bounded_by { objects transforms }`, and `{ the other }` in either. The
    /// transforms move all of the objects.
    pub(crate) fn clip_or_bound(&mut self, object: &mut Object, word: Word) -> Parse<()> {
        self.pass();
        let start = self.taken_span();
        self.open_block()?;
        let is_clip = word == Word::ClippedBy;
        let other = if is_clip {
            Word::BoundedBy
        } else {
            Word::ClippedBy
        };
        if self.take_word(other)? {
            let copied = if is_clip {
                object.bounded_by().to_vec()
            } else {
                object.clipped_by().to_vec()
            };
            for attached in copied {
                clip_or_bound(object, is_clip, attached);
            }
            return Args::close(self);
        }
        let mut objects = Vec::new();
        while let Some(next) = self.object_or_name()? {
            objects.push(next);
        }
        if objects.is_empty() {
            return Err(self.expected_here(&format!("an object in `{word}`")));
        }
        if let Some(reason) = objects.iter().find_map(|next| objection(next, PARTS_DEPTH)) {
            self.refused_by_povray(start, reason, "Take a copy of the shape without it.");
        }
        self.move_all(&mut objects)?;
        for next in objects {
            let next = object.attach(next);
            clip_or_bound(object, is_clip, next);
            self.check_size(object, start)?;
        }
        if self.take_close()? {
            return Ok(());
        }
        let error = self.expected_here("a transform or `}`");
        Err(if self.raw().word() == Some(Word::Inverse) {
            let hint = "Write it into the object: `object { ... inverse }`.";
            Box::new(error.with_hint(hint))
        } else {
            error
        })
    }
}

/// The reason why POV-Ray 3.7 refuses an object that clips or bounds, if it does. Of CSG with many parts or many levels
/// only some are examined.
fn objection(object: &Object, depth: usize) -> Option<&'static str> {
    if object.texture.is_some() {
        return Some("what clips or bounds an object has no texture");
    }
    match &object.kind {
        Kind::Shape(shape) if !shape.is_solid() && !matches!(**shape, Shape::Polygon(_)) => {
            Some("a patch neither clips nor bounds an object")
        }
        Kind::Csg { children, .. } if depth > 0 => {
            let mut parts = children.iter().take(MOST_PARTS);
            parts.find_map(|part| objection(part, depth - 1))
        }
        Kind::Light { .. } if depth == PARTS_DEPTH => {
            Some("a light neither clips nor bounds an object")
        }
        _ => None,
    }
}

fn clip_or_bound(object: &mut Object, is_clip: bool, by: Attached<Arc<Object>>) {
    if is_clip {
        object.clip(by);
    } else {
        object.bound(by);
    }
}
