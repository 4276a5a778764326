//! `union`, `merge`, `intersection` and `difference`: blocks of objects.

use crate::base::args::Parse;
use crate::base::source::Diagnostic;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::Class;
use crate::scene::{Kind, Object, Operation};
use std::sync::Arc;

impl Reader<'_> {
    /// A CSG object, or the object whose name comes first in the block.
    pub(crate) fn csg(&mut self, operation: Operation) -> Parse<Object> {
        self.pass();
        let word = self.source_text(self.taken_span()).to_owned();
        let start = self.taken_span();
        self.open_block()?;
        if let Some(known) = self.object_of_name()? {
            self.check_no_part_follows(&word)?;
            let mut object = (*known).clone();
            self.modifiers(&mut object, &word)?;
            return Ok(object);
        }
        let children = self.children()?;
        let is_lone = children.len() < 2;
        let mut object = Object::new(Kind::Csg {
            operation,
            children: Arc::new(children),
        });
        self.check_size(&object, start)?;
        self.modifiers(&mut object, &word)?;
        if is_lone {
            let text = format!("`{word}` should have at least two objects");
            self.warning(Diagnostic::warning(start, text));
        }
        Ok(object)
    }

    /// The objects that follow, written out or by name, in any order.
    pub(crate) fn children(&mut self) -> Parse<Vec<Arc<Object>>> {
        let mut children = Vec::new();
        loop {
            self.take_literal_objects(&mut children)?;
            let Some(child) = self.object_or_name()? else {
                return Ok(children);
            };
            children.push(child);
            self.count_object()?;
        }
    }

    /// An error if another object follows the name at the start of the block.
    fn check_no_part_follows(&mut self, word: &str) -> Parse<()> {
        let token = self.peek()?;
        let is_part = match token.word() {
            Some(found) => matches!(found.class(), Class::Shape | Class::Csg),
            None => {
                let value = token.symbol().and_then(|name| self.scopes.get(name));
                matches!(value, Some(Value::Object(_) | Value::Array(_)))
            }
        };
        if !is_part {
            return Ok(());
        }
        let mut error = self.expected_here(&format!("a modifier of `{word}` or its `}}`"));
        error.hints = vec![format!(
            "A name that comes first is all of the `{word}`: write `object {{ }}` around it to make it a part."
        )];
        Err(error)
    }
}
