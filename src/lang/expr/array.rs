//! Arrays: their values, items and indices.

use super::builtins::whole_index;
use super::callee::FUNCTION;
use super::streams::Streams;
use super::value::{Array, Extent, Value};
use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use crate::base::version::Novelty;
use crate::lang::diagnose::unclosed::begins_new;
use crate::lang::directive::sealed::Slot;
use crate::lang::frame::{Declaring, Position};
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
        let (value, macro_behind) = self.sealed_declared(|reader| reader.value("a value"));
        self.statement.declaring = outer;
        if value.is_err() {
            self.usage.faulty_arrays.insert(symbol);
        }
        let Some(value) = value? else {
            return Err(self.expected_here("a value"));
        };
        let is_number = self.is_like_number(&value);
        self.warn_of_macro_behind(is_number, macro_behind);
        if self.scopes.depth() > declaring.scope {
            // A macro whose result this is ends behind it; its names hide those of the statement until then.
            self.peek()?;
        }
        let held = self.scopes.get(symbol).and_then(|held| held.item(&item));
        if is_function(&value) && held.is_some_and(is_function) {
            let reason = "this item holds a function already";
            let remedy = "Write `#undef` and the item above.";
            self.refused_by_povray(start, reason, remedy);
        }
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
            let at = if matches!(array.extent, Extent::Growing) {
                self.index_that_grows(symbol, &path)?
            } else {
                // Held until the index is known, and no longer: a change copies an array that is held twice.
                let array = Rc::clone(array);
                self.sealed(Slot::Condition, |reader| reader.array_index(&array.sizes))?
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
        if !self.is_raw_mark('.') {
            return Ok(None);
        }
        if let Some(word) = behind.word() {
            self.pass();
            let error = self.expected_here("a key that is no reserved word");
            let word = word.spelling();
            let hint = format!("Write `[\"{word}\"]` instead of `.{word}`.");
            return Err(Box::new(error.with_hint(hint)));
        }
        if behind.kind != Kind::Name {
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
        if let Some(ahead) = self.item_ahead.as_ref().filter(|ahead| ahead.is_at(self)) {
            return Ok(Some(ahead.value.clone()));
        }
        self.discard_recording();
        let start = self.reading();
        let item = self.array_or_item();
        let end = self.go_back(&start);
        let value = item?;
        self.keep_ahead(value.clone(), None, start, end);
        Ok(Some(value))
    }

    /// The state of reading, to go back to.
    pub(crate) fn reading(&self) -> ReadState {
        ReadState {
            here: self.here.clone(),
            last: self.last.clone(),
            streams: self.streams.clone(),
            steps: self.steps,
        }
    }

    /// Goes back before an item that was read, as it begins something longer. The macros and directives in its indices
    /// do not run again.
    pub(crate) fn read_again(&mut self, item: Value, start: ReadState) {
        let has_run = self.steps != start.steps;
        let end = self.go_back(&start);
        if has_run {
            self.discard_recording();
            self.keep_ahead(item, None, start, end);
        }
    }

    /// Goes back to a state of reading; returns the one that it replaces.
    fn go_back(&mut self, to: &ReadState) -> ReadState {
        let ReadState {
            here,
            last,
            streams,
            ..
        } = to.clone();
        ReadState {
            steps: self.steps,
            here: std::mem::replace(&mut self.here, here),
            last: std::mem::replace(&mut self.last, last),
            streams: std::mem::replace(&mut self.streams, streams),
        }
    }

    /// Keeps an item that was read from `start` to `end`: macros in its indices must not run again when it is taken.
    fn keep_ahead(
        &mut self,
        value: Value,
        path: Option<Vec<usize>>,
        start: ReadState,
        end: ReadState,
    ) {
        self.item_ahead = Some(ItemAhead {
            start: start.here,
            taken: self.taken,
            value,
            path,
            end,
        });
    }

    /// The path of the item of an array that begins with the next token, a name, and the item, if it has a value.
    /// `is_taken` decides if they are taken, once the tokens behind them are next; else nothing is.
    pub(crate) fn item_if(
        &mut self,
        symbol: Symbol,
        is_taken: impl FnOnce(&mut Self, bool) -> Parse<bool>,
    ) -> Parse<Option<Vec<usize>>> {
        let is_mixed = self.scopes.get(symbol).is_some_and(Value::is_mixed);
        let start = self.reading();
        let path = match self.take_path_ahead() {
            Some(path) => path,
            None => {
                self.pass();
                self.item_path(symbol)?
            }
        };
        let item = self.scopes.get(symbol).and_then(|array| array.item(&path));
        let item = item.cloned();
        if is_taken(self, item.is_some())? {
            return Ok(Some(path));
        }
        let is_recorded = is_mixed || self.steps != start.steps;
        let end = self.go_back(&start);
        if let Some(value) = item.filter(|_| is_recorded) {
            self.keep_ahead(value, Some(path), start, end);
        }
        Ok(None)
    }

    /// Takes the item that was read ahead, if it begins with the next token.
    pub(crate) fn take_item_ahead(&mut self) -> Option<Value> {
        if !self.item_ahead.as_ref()?.is_at(self) {
            return None;
        }
        let ItemAhead { value, end, .. } = self.item_ahead.take()?;
        self.discard_recording();
        self.go_back(&end);
        self.taken += 1;
        Some(value)
    }

    /// The same for its path, where that is known.
    fn take_path_ahead(&mut self) -> Option<Vec<usize>> {
        let path = self.item_ahead.as_ref()?.path.clone()?;
        self.take_item_ahead().map(|_| path)
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
            let size = self.sealed(Slot::Condition, Self::number_at_sum)?;
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
            let error = *self.error_taken("an array has one to five dimensions");
            return Err(Box::new(match self.size_of_array() {
                Some(remedy) => remedy.added_to(error),
                None if may_grow => error,
                None => error.with_hint(
                    "From `#version 3.8` on it may be `mixed`, and without a size it grows.",
                ),
            }));
        }
        let extent = match sizes.is_empty() {
            true => Extent::Growing,
            false => Extent::Fixed,
        };
        if sizes.is_empty() {
            self.draft.note_novelty(Novelty::Word(Word::Array));
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
        self.sealed(Slot::List, |reader| {
            reader.items_to_close(array, dimension, from, is_optional)
        })
    }

    fn items_to_close(
        &mut self,
        array: &mut Array,
        dimension: usize,
        from: usize,
        is_optional: bool,
    ) -> Parse<()> {
        let inner: usize = array.sizes[dimension + 1..].iter().product();
        let mut index = 0;
        while !self.take_close()? {
            if matches!(array.extent, Extent::Growing) {
                self.take_memory(array_bytes(1), self.taken_span())?;
                array.grow(index + 1);
            }
            if index == array.sizes[dimension] {
                if !self.is_after_mark(',') && begins_new(self.raw()) {
                    return Err(self.expected_here("`}` at the end of the array"));
                }
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
        let size = array.sizes[dimension];
        if index < size && !is_optional {
            let reason = format!("this list has {index} items, the array {size}");
            self.refused_by_povray(self.taken_span(), &reason, "Give the array as many items.");
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
        let is_nothing =
            |reader: &mut Self, has_value: bool| Ok(!has_value && is_end(reader.raw()));
        Ok(self.item_if(name, is_nothing)?.is_some())
    }
}

/// A state of reading.
#[derive(Clone, Debug)]
pub(crate) struct ReadState {
    here: Position,
    last: Position,
    streams: Streams,
    /// The number of directives run and macros called so far, which going back does not change.
    steps: u64,
}

/// An item of an array that was read although another reader may take it.
#[derive(Debug)]
pub(crate) struct ItemAhead {
    /// Where it begins.
    start: Position,
    /// Number of tokens taken until it was read: any further token makes it obsolete.
    taken: u64,
    value: Value,
    /// The path of indices to it, if it was read by that.
    path: Option<Vec<usize>>,
    /// The state behind it.
    end: ReadState,
}

impl ItemAhead {
    /// True if the item begins with the next token.
    fn is_at(&self, reader: &Reader<'_>) -> bool {
        self.taken == reader.taken
            && self.start.at == reader.here.at
            && Rc::ptr_eq(&self.start.tokens, &reader.here.tokens)
    }
}

fn is_function(value: &Value) -> bool {
    matches!(value, Value::Element(element) if element.name == FUNCTION)
}

/// Memory of the items of an array, in bytes.
fn array_bytes(items: usize) -> u64 {
    (items * size_of::<Option<Value>>()) as u64
}
