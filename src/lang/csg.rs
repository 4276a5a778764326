//! `union`, `merge`, `intersection` and `difference`: blocks of objects.

use super::reader::Reader;
use crate::args::{Parse, Word};
use crate::scene::{Kind, LightGroup, Object, Operation};
use crate::source::Diagnostic;
use std::sync::Arc;

impl Reader<'_> {
    pub(super) fn csg(&mut self, operation: Operation) -> Parse<Object> {
        self.pass();
        let word = self.source_text(self.taken_span()).to_owned();
        let start = self.taken_span();
        self.open_block()?;
        if let Some(known) = self.object_of_name()? {
            let mut object = (*known).clone();
            self.modifiers(&mut object, &word)?;
            return Ok(object);
        }
        let mut children = Vec::new();
        loop {
            self.take_literal_objects(&mut children)?;
            let Some(child) = self.object()? else { break };
            children.push(child);
            self.count_object()?;
        }
        let is_lone = children.len() < 2;
        let mut object = Object::new(Kind::Csg {
            operation,
            children: Arc::new(children),
        });
        let is_group = word == Word::LightGroup.spelling();
        object.light_group = is_group.then(LightGroup::default);
        self.check_size(&object, start)?;
        self.modifiers(&mut object, &word)?;
        if is_lone && !is_group {
            let text = format!("`{word}` should have at least two objects");
            self.warning(Diagnostic::warning(start, text));
        }
        Ok(object)
    }
}
