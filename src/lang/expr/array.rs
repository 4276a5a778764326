//! Arrays: their values, items and indices.

use super::builtins::whole_index;
use super::value::{Array, Extent, Value};
use crate::base::args::{Parse, Word};
use crate::base::source::Diagnostic;
use crate::lang::frame::Declaring;
use crate::lang::limits;
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol, Token};
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
            if array.is_dictionary() {
                let Some(key) = self.key()? else {
                    return Ok(path);
                };
                self.take_memory(array_bytes(1) + key.len() as u64, self.taken_span())?;
                let array = self.array_for_change(symbol, &path)?;
                let at = array.map_or(0, |array| array.index_for(&key));
                path.push(at);
                continue;
            }
            if !path.is_empty() && !self.is_raw_mark('[') {
                return Ok(path);
            }
            let array = Rc::clone(array);
            let at = match array.extent {
                Extent::Growing => self.index_that_grows(symbol, &path)?,
                Extent::Fixed | Extent::Keys(_) => self.array_index(&array.sizes)?,
            };
            path.push(at);
        }
    }

    /// An array of a name, to change it; one that is shared with another name is copied.
    fn array_for_change(&mut self, symbol: Symbol, path: &[usize]) -> Parse<Option<&mut Array>> {
        let held = self.scopes.get(symbol);
        let copied = held.map_or(0, |array| array.copied_by(path));
        self.take_memory(array_bytes(copied), self.taken_span())?;
        let held = self.scopes.get_mut(symbol);
        Ok(held.and_then(|held| held.array_mut(path)))
    }

    /// `[i]` of an array that grows to hold the item.
    fn index_that_grows(&mut self, symbol: Symbol, path: &[usize]) -> Parse<usize> {
        let at = self.array_index(&[limits::ARRAY_ITEMS])?;
        let size = |array: &Array| array.items.len();
        let old = self
            .array_for_change(symbol, path)?
            .map_or(0, |array| size(array));
        self.take_memory(array_bytes((at + 1).saturating_sub(old)), self.taken_span())?;
        if let Some(array) = self.array_for_change(symbol, path)? {
            array.grow(at + 1);
        }
        Ok(at)
    }

    /// `["key"]` or `.key` of a dictionary, if it follows.
    pub(crate) fn key(&mut self) -> Parse<Option<String>> {
        if self.is_raw_mark('[') {
            self.pass();
            let key = self.string()?;
            self.expect_mark(']', "`]` after the key")?;
            return Ok(Some(key));
        }
        let behind = self.raw_ahead(1);
        if !self.is_raw_mark('.') || behind.kind != Kind::Name {
            return Ok(None);
        }
        self.pass();
        self.pass();
        Ok(Some(self.names.spelling(Symbol(behind.value)).to_owned()))
    }

    /// True if the name that was taken holds an array of which an item follows.
    pub(crate) fn begins_item(&self, symbol: Symbol) -> bool {
        match self.scopes.get(symbol) {
            Some(Value::Array(array)) => {
                self.is_raw_mark('[') || array.is_dictionary() && self.is_raw_mark('.')
            }
            _ => false,
        }
    }

    /// The item of an array of several kinds that begins with the next token, a name; nothing is taken. `None` for any
    /// other array, all of whose items are of one kind.
    pub(crate) fn mixed_item_ahead(&mut self, symbol: Symbol) -> Parse<Option<Value>> {
        if !self.scopes.get(symbol).is_some_and(Value::is_mixed) {
            return Ok(None);
        }
        self.discard_recording();
        let before = (self.here.clone(), self.last.clone(), self.streams.clone());
        let item = self.array_or_item();
        (self.here, self.last, self.streams) = before;
        item.map(Some)
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

    /// `dictionary { ["key"]: value, .key: value }`.
    pub(crate) fn dictionary_value(&mut self) -> Parse<Value> {
        self.pass();
        let mut array = Array::dictionary();
        if !self.is_raw_mark('{') {
            return Ok(Value::Array(Rc::new(array)));
        }
        self.open_block()?;
        while !self.take_close()? {
            self.peek()?;
            let Some(key) = self.key()? else {
                return Err(self.expected_here("`[\"key\"]:` or `.key:` of the dictionary or `}`"));
            };
            self.expect_mark(':', "`:` after the key")?;
            let Some(value) = self.value("a value of the dictionary")? else {
                return Err(self.expected_here("a value of the dictionary"));
            };
            self.take_memory(array_bytes(1) + key.len() as u64, self.taken_span())?;
            let at = array.index_for(&key);
            array.set(at, value);
            self.take_mark(',')?;
        }
        Ok(Value::Array(Rc::new(array)))
    }

    /// `array[n][m] { ... }`; from version 3.8 on also `array mixed`, and `array` without sizes, which grows.
    pub(crate) fn array_value(&mut self) -> Parse<Value> {
        self.pass();
        let is_mixed = self.take_raw_word(Word::Mixed);
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
        let may_grow = self.dialect.has_words_of_3_8();
        if sizes.is_empty() && !may_grow || sizes.len() > 5 {
            let error = self.error_taken("an array has one to five dimensions");
            return Err(match may_grow {
                true => error,
                false => Box::new(error.with_hint(
                    "From `#version 3.8` on it may be `mixed`, and without a size it grows.",
                )),
            });
        }
        let extent = match sizes.is_empty() {
            true => Extent::Growing,
            false => Extent::Fixed,
        };
        if sizes.is_empty() {
            sizes.push(0);
        }
        let mut array = Array::new(sizes);
        array.is_mixed = is_mixed;
        array.extent = extent;
        let is_optional = self.take_raw_word(Word::Optional);
        if self.is_raw_mark('{') {
            self.array_items(&mut array, 0, 0, is_optional)?;
        }
        Ok(Value::Array(Rc::new(array)))
    }

    fn array_items(
        &mut self,
        array: &mut Array,
        dimension: usize,
        from: usize,
        is_optional: bool,
    ) -> Parse<()> {
        self.open_block()?;
        let inner: usize = array.sizes[dimension + 1..].iter().product();
        let mut index = 0;
        while !self.take_close()? {
            if matches!(array.extent, Extent::Growing) {
                self.take_memory(array_bytes(1), self.taken_span())?;
                array.grow(index + 1);
            }
            if index == array.sizes[dimension] {
                let error = self.error_here(format!("the array has only {index} items here"));
                return Err(Box::new(
                    error.with_hint("Give it a larger size, or fewer values."),
                ));
            }
            let at = from + index * inner;
            if dimension + 1 < array.sizes.len() {
                self.array_items(array, dimension + 1, at, is_optional)?;
            } else if !(is_optional && self.take_nothing()?) {
                let Some(value) = self.value("an item of the array")? else {
                    return Err(self.expected_here("an item of the array or `}`"));
                };
                let kind = value.kind();
                if let Some(others) = array.set(at, value) {
                    return Err(self.mixed(others, &kind));
                }
            }
            self.take_mark(',')?;
            index += 1;
        }
        Ok(())
    }

    /// True if an optional value is left out here: nothing stands before the next `,` or the end, or only a name
    /// without a value, which is taken.
    pub(crate) fn take_nothing(&mut self) -> Parse<bool> {
        let is_end = |token: Token| [',', ')', '}'].into_iter().any(|mark| token.is_mark(mark));
        let token = self.peek()?;
        if is_end(token) {
            return Ok(true);
        }
        let Some(name) = token.symbol() else {
            return Ok(false);
        };
        if self.scopes.get(name).is_none() {
            let is_alone = is_end(self.raw_ahead(1));
            if is_alone {
                self.pass();
            }
            return Ok(is_alone);
        }
        let behind = self.raw_ahead(1);
        if !self.scopes.get(name).is_some_and(Value::is_mixed)
            || !(behind.is_mark('.') || behind.is_mark('['))
        {
            return Ok(false);
        }
        let before = (self.here.clone(), self.last.clone());
        self.pass();
        let path = self.item_path(name)?;
        let has_value = self
            .scopes
            .get(name)
            .is_some_and(|held| held.item(&path).is_some());
        let is_nothing = !has_value && is_end(self.raw());
        if !is_nothing {
            (self.here, self.last) = before;
        }
        Ok(is_nothing)
    }
}

/// Memory of the items of an array, in bytes.
fn array_bytes(items: usize) -> u64 {
    (items * size_of::<Option<Value>>()) as u64
}
