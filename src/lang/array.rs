//! Arrays: their values, items and indices.

use super::flow::EQUAL;
use super::limits;
use super::reader::Reader;
use super::value::{Array, Value};
use crate::args::Parse;
use crate::source::Diagnostic;
use crate::syntax::Symbol;
use std::rc::Rc;

impl Reader<'_> {
    /// `[i] = value` behind `#declare` and the name of an array.
    pub(super) fn declare_item(&mut self, symbol: Symbol) -> Parse<()> {
        let Some(Value::Array(array)) = self.scopes.get(symbol) else {
            return Ok(());
        };
        let sizes = array.sizes.clone();
        let at = self.array_index(&sizes)?;
        if !self.take_mark('=')? {
            return Err(self.expected_here("`=` after the item of an array"));
        }
        let Some(value) = self.value("a value")? else {
            return Err(self.expected_here("a value"));
        };
        self.end_of_declaration(matches!(value, Value::Number(_)))?;
        self.set_item(symbol, at, value)
    }

    /// Gives an item of the array of this name a value.
    pub(super) fn set_item(&mut self, symbol: Symbol, at: usize, value: Value) -> Parse<()> {
        // An array that has another name as well is copied.
        let copied = match self.scopes.get(symbol) {
            Some(Value::Array(array)) if Rc::strong_count(array) > 1 => array.items.len(),
            _ => 0,
        };
        self.take_memory(array_bytes(copied), self.taken_span())?;
        if let Some(Value::Array(array)) = self.scopes.get_mut(symbol) {
            Rc::make_mut(array).items[at] = Some(value);
        }
        Ok(())
    }

    /// `[i][j]...` as an index into the row-major items of an array with these sizes.
    pub(super) fn array_index(&mut self, sizes: &[usize]) -> Parse<usize> {
        let mut at = 0;
        for &size in sizes {
            self.expect_mark('[', "`[` and an index of the array")?;
            let index = self.number_at_sum()?;
            let span = self.taken_span();
            self.expect_mark(']', "`]` after the index")?;
            at = at * size + self.checked_index(index, size, span)?;
        }
        Ok(at)
    }

    fn checked_index(&self, index: f64, size: usize, span: crate::source::Span) -> Parse<usize> {
        whole_index(index, size).ok_or_else(|| {
            let whole = (index + EQUAL).trunc();
            self.with_trace(
                Diagnostic::error(
                    span,
                    format!(
                        "the index {whole} is outside of the array, which has {size} items here"
                    ),
                )
                .with_hint(format!("Indices run from 0 to {}.", size.saturating_sub(1))),
            )
        })
    }

    /// `array[n][m] { ... }`.
    pub(super) fn array_value(&mut self) -> Parse<Value> {
        self.pass();
        let mut sizes = Vec::new();
        loop {
            let so_far = || Value::Array(Rc::new(Array::new(sizes.clone())));
            if !self.peek_behind(so_far)?.is_mark('[') {
                break;
            }
            self.pass();
            let size = self.number_at_sum()?;
            let span = self.taken_span();
            self.expect_mark(']', "`]` after the size of the array")?;
            let whole = (size + EQUAL).trunc();
            if !(1.0..=limits::ARRAY_ITEMS as f64).contains(&whole) {
                return Err(self.with_trace(Diagnostic::error(
                    span,
                    format!("an array cannot have {size} items"),
                )));
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "checked just above"
            )]
            sizes.push(whole as usize);
            let total = sizes
                .iter()
                .try_fold(1usize, |product, &size| product.checked_mul(size));
            let Some(total) = total.filter(|&total| total <= limits::ARRAY_ITEMS) else {
                return Err(self.error_taken(format!(
                    "an array has at most {} items",
                    limits::ARRAY_ITEMS
                )));
            };
            self.take_memory(array_bytes(total), span)?;
        }
        if sizes.is_empty() || sizes.len() > 5 {
            return Err(self.error_taken("an array has one to five dimensions"));
        }
        let mut array = Array::new(sizes);
        if self.is_raw_mark('{') {
            self.array_items(&mut array, 0, 0)?;
        }
        Ok(Value::Array(Rc::new(array)))
    }

    fn array_items(&mut self, array: &mut Array, dimension: usize, from: usize) -> Parse<()> {
        self.open_block()?;
        let inner: usize = array.sizes[dimension + 1..].iter().product();
        let mut index = 0;
        while !self.take_close()? {
            if index == array.sizes[dimension] {
                let error = self.error_here(format!("the array has only {index} items here"));
                return Err(Box::new(
                    error.with_hint("Give it a larger size, or fewer values."),
                ));
            }
            let at = from + index * inner;
            if dimension + 1 < array.sizes.len() {
                self.array_items(array, dimension + 1, at)?;
            } else {
                let Some(value) = self.value("an item of the array")? else {
                    return Err(self.expected_here("an item of the array or `}`"));
                };
                array.items[at] = Some(value);
            }
            self.take_mark(',')?;
            index += 1;
        }
        Ok(())
    }
}

/// An index into so many items, without what stands behind its decimal point; `None` if there is no such item.
pub(super) fn whole_index(index: f64, size: usize) -> Option<usize> {
    let whole = (index + EQUAL).trunc();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 <= whole < size"
    )]
    (whole >= 0.0 && whole < size as f64).then_some(whole as usize)
}

/// The memory of so many items of an array.
fn array_bytes(items: usize) -> u64 {
    (items * size_of::<Option<Value>>()) as u64
}
