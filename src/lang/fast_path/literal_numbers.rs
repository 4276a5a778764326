//! Literal numbers and vectors in expressions, taken straight from the tokens.

use crate::lang::expr::value::Number;
use crate::lang::fast_path::numbers::{ends_item, literal_at, literal_vector, signed};
use crate::lang::frame::Position;
use crate::lang::reader::Reader;
use std::rc::Rc;

impl Reader<'_> {
    /// Takes the next literal number or vector if it is a whole expression.
    #[inline]
    pub(crate) fn take_literal(&mut self) -> Option<Number> {
        if self.recording.is_some() {
            return None;
        }
        let (number, after) = literal_at(&self.here.tokens, self.here.at)?;
        self.here.at = after - 1;
        self.pass();
        Some(number)
    }

    /// Takes literal vectors of `len` components, each with an optional comma before it, until `take` returns false.
    pub(crate) fn take_literal_vectors(
        &mut self,
        len: usize,
        take: &mut dyn FnMut(&[f64]) -> bool,
    ) {
        let tokens = Rc::clone(&self.here.tokens);
        let start = self.here.at;
        let mut is_wanted = true;
        while is_wanted && let Some((vector, after)) = literal_vector(&tokens, self.here.at, len) {
            is_wanted = take(&vector[..len]);
            if is_wanted {
                self.here.at = after;
            }
        }
        if self.here.at > start {
            self.last = Position {
                tokens,
                at: self.here.at - 1,
            };
        }
        if is_wanted {
            self.take_vectors_of_data(len, take);
        }
    }

    /// Takes a literal number with an optional comma before it.
    pub(crate) fn take_literal_number(&mut self) -> Option<f64> {
        let tokens = Rc::clone(&self.here.tokens);
        let token = |at: usize| tokens.tokens.get(at).copied();
        let mut at = self.here.at;
        at += usize::from(token(at)?.is_mark(','));
        let (number, after) = signed(&tokens, at)?;
        if !ends_item(token(after)?) {
            return None;
        }
        self.here.at = after;
        self.last = Position {
            tokens,
            at: after - 1,
        };
        Some(number)
    }
}
