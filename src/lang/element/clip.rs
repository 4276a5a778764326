//! `clipped_by` and `bounded_by`: objects that clip or bound an object.

use crate::base::args::{Args, Parse, Word};
use crate::lang::reader::Reader;
use crate::scene::{Attached, Object};
use std::sync::Arc;

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

fn clip_or_bound(object: &mut Object, is_clip: bool, by: Attached<Arc<Object>>) {
    if is_clip {
        object.clip(by);
    } else {
        object.bound(by);
    }
}
