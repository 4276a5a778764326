//! Computed keys of scopes: `global[K]` and `local[K]` of version 3.8, where `K` is any string.
//!
//! The key is computed where the scope is named. Its `]` is the name from then on, so that all that takes a name, and
//! goes back to one, takes it like any other.

use crate::base::args::{Parse, Word};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Token};
use std::rc::Rc;

impl Reader<'_> {
    /// True if the next token is the word of a scope whose key follows.
    pub(crate) fn begins_scope_key(&self, token: Token) -> bool {
        is_scope(token) && self.dialect.has_words_of_3_8() && self.raw_ahead(1).is_mark('[')
    }

    /// Goes to the name that `global[K]` or `local[K]` stands for.
    pub(crate) fn resolve_scope_key(&mut self) -> Parse<()> {
        let is_local = self.raw().value == Word::Local as u32;
        self.discard_recording();
        let home = Rc::clone(&self.here.tokens);
        let close = self.end_of_key();
        let slot = close.map(|close| (home.file, home.tokens[close].start));
        if let Some(slot) = slot {
            self.dialect.forget_key(slot);
        }
        self.pass();
        self.pass();
        let key = self.string()?;
        let is_closed = self.peek()?.is_mark(']') && Rc::ptr_eq(&home, &self.here.tokens);
        let Some(slot) = slot.filter(|_| is_closed && Some(self.here.at) == close) else {
            return Err(self.expected_here("`]` after the key"));
        };
        self.take_memory(2 * key.len() as u64 + KEY_BYTES, self.here_span())?;
        let name = self.names.intern(&key);
        let symbol = self.names.intern_qualified(is_local, name);
        self.scopes.qualify(self.names.qualified());
        self.dialect.set_key(slot, symbol);
        Ok(())
    }

    /// The index of the `]` that closes the `[` behind the next token.
    fn end_of_key(&self) -> Option<usize> {
        let mut open = 0;
        let first = self.here.at + 1;
        let rest = self.here.tokens.tokens.get(first..)?;
        let is_end = |token: &Token| {
            open += i32::from(token.is_mark('[')) - i32::from(token.is_mark(']'));
            open == 0
        };
        Some(first + rest.iter().position(is_end)?)
    }
}

/// Memory for a key that is new, without its letters.
const KEY_BYTES: u64 = 200;

/// True for the words of the scopes.
pub(crate) fn is_scope(token: Token) -> bool {
    let is_it = token.value == Word::Global as u32 || token.value == Word::Local as u32;
    is_it && token.kind == Kind::Word
}
