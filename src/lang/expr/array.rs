//! Arrays: their values, items and indices.

use super::builtins::whole_index;
use super::value::{Array, Value};
use crate::base::args::Parse;
use crate::base::source::Diagnostic;
use crate::lang::frame::Declaring;
use crate::lang::limits;
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

impl Reader<'_> {
    /// `[i] = value` after `#declare` or `#local` and the name of an array, which may hold arrays.
    pub(crate) fn declare_item(&mut self, symbol: Symbol, is_local: bool) -> Parse<()> {
        let start = self.taken_span();
        let item = self.item_path(symbol)?;
        if !self.take_mark('=')? {
            return Err(self.expected_here("`=` after the item of an array"));
        }
        let declaring = Declaring {
            is_item: true,
            ..self.declaring_here(symbol, is_local)
        };
        let outer = self.statement.declaring.replace(declaring);
        let value = self.value("a value");
        self.statement.declaring = outer;
        let Some(value) = value? else {
            return Err(self.expected_here("a value"));
        };
        let is_number = self.is_like_number(&value);
        if is_local && !self.scopes.is_local(symbol) {
            let message = "`#local` does not reach this array, which is not local; nothing changes";
            let warning = Diagnostic::warning(start, message);
            self.warning(warning.with_hint("Write `#declare` to change it."));
        } else {
            self.set_item(symbol, &item, value)?;
        }
        let outer = self.statement.declaring.replace(Declaring {
            is_complete: true,
            ..declaring
        });
        let end = self.end_of_declaration(is_number);
        self.statement.declaring = outer;
        end
    }

    /// Reads `[i]`, and further indices while the items are arrays: the path of indices into nested arrays.
    pub(crate) fn item_path(&mut self, symbol: Symbol) -> Parse<Vec<usize>> {
        let mut path: Vec<usize> = Vec::new();
        loop {
            let held = self.scopes.get(symbol).and_then(|value| value.item(&path));
            let Some(Value::Array(array)) = held else {
                return Ok(path);
            };
            if !path.is_empty() && !self.is_raw_mark('[') {
                return Ok(path);
            }
            let array = Rc::clone(array);
            path.push(self.array_index(&array.sizes)?);
        }
    }

    /// Assigns a value to an item of a named array.
    pub(crate) fn set_item(&mut self, symbol: Symbol, path: &[usize], value: Value) -> Parse<()> {
        // Arrays that are shared with another name are copied.
        let copied = self
            .scopes
            .get(symbol)
            .map_or(0, |array| array.copied_by(path));
        self.take_memory(array_bytes(copied), self.taken_span())?;
        let Some(array) = self.scopes.get_mut(symbol) else {
            return Ok(());
        };
        let kind = value.kind();
        let Some(other) = array.put(path, value) else {
            return Ok(());
        };
        Err(self.mixed(other, &kind))
    }

    /// The error for an item of another kind than the others.
    fn mixed(&self, others: &str, this: &str) -> Box<Diagnostic> {
        let others = others.trim_start_matches("an ").trim_start_matches("a ");
        let message = format!("this array holds values of the kind `{others}`, not {this}");
        let hint = "All items of an array are of one kind: <1, 1, 1> and not 1 among vectors.";
        Box::new(self.error_taken(message).with_hint(hint))
    }

    /// `[i][j]...` as an index into the row-major items of an array of these sizes.
    pub(crate) fn array_index(&mut self, sizes: &[usize]) -> Parse<usize> {
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

    fn checked_index(
        &self,
        index: f64,
        size: usize,
        span: crate::base::source::Span,
    ) -> Parse<usize> {
        whole_index(index, size).ok_or_else(|| {
            let whole = (index + EQUAL.copysign(index)).trunc();
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
    pub(crate) fn array_value(&mut self) -> Parse<Value> {
        self.pass();
        let mut sizes = Vec::new();
        loop {
            let so_far = || Value::Array(Rc::new(Array::new(sizes.clone())));
            if !self.peek_after(so_far)?.is_mark('[') {
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
                let sort = value.sort();
                if let (Some(sort), Some(others)) = (sort, array.holds)
                    && sort != others
                {
                    return Err(self.mixed(others, &value.kind()));
                }
                array.holds = array.holds.or(sort);
                array.items[at] = Some(value);
            }
            self.take_mark(',')?;
            index += 1;
        }
        Ok(())
    }
}

/// Memory of the items of an array, in bytes.
fn array_bytes(items: usize) -> u64 {
    (items * size_of::<Option<Value>>()) as u64
}
