//! Expressions: POV-Ray's precedence and promotion.
//!
//! Outside of parentheses an expression ends at the additive level; comparisons, logic and `? :` occur only inside
//! parentheses and in the arguments of some built-in functions. `&` and `|` have the same precedence, left to right.

pub(super) mod array;
pub(super) mod body;
pub(super) mod body_calls;
pub(super) mod builtins;
pub(crate) mod callee;
pub(super) mod color;
pub(super) mod datetime;
pub(super) mod declared_value;
pub(super) mod function;
pub(super) mod function_picture;
pub(super) mod functions;
pub(super) mod probe_calls;
pub(super) mod scope_key;
pub(super) mod streams;
pub(super) mod strings;
pub(super) mod text;
pub(super) mod value;

use super::expr::callee::Callee;
use super::expr::value::{Number, Value};
use super::fast_path::replay::cache::Level;
use super::fast_path::replay::op::{Binary, Op};
use super::frame::Start;
use super::limits;
use super::limits::EQUAL;
use super::reader::Reader;
use crate::base::args::{Parse, Word};
use crate::base::source::{Diagnostic, Fix};
use crate::lang::syntax::{Class, Kind, Symbol};
use glam::DVec3;
use std::rc::Rc;

/// The first language version with operators outside of parentheses and colours; POV-Ray compares hundredths, rounded.
/// In older ones `<1 -1 0>` has three components.
pub(super) const FIRST_WITH_OPERATORS: f64 = 1.495;

impl Reader<'_> {
    /// A float at the additive level.
    pub(super) fn number_at_sum(&mut self) -> Parse<f64> {
        let start = self.start()?;
        let number = self.sum()?;
        self.only_float(number, start)
    }

    pub(super) fn only_float(&self, number: Number, start: Start) -> Parse<f64> {
        if number.len == 1 {
            return Ok(number.v[0]);
        }
        let span = self.span_from(start);
        let error = Diagnostic::error(span, format!("expected a number, found {}", number.kind()));
        let component = self.raw().is_mark('[').then(|| self.component_by_number());
        let remedy = component.flatten().or_else(|| self.factor_before(span));
        Err(self.with_trace(match remedy {
            Some(remedy) => remedy.added_to(error),
            None if self.source_text(span).starts_with('<') => error,
            None => error.with_hint("Take one component: `.x`, `.y`, `.z`, `.red` and so on."),
        }))
    }

    /// The value of a condition: comparisons of numbers or of strings, logic, `? :`.
    pub(super) fn condition_value(&mut self) -> Parse<f64> {
        let start = self.start()?;
        let number = self.full()?;
        self.only_float(number, start)
    }

    /// A whole expression, as inside parentheses.
    pub(super) fn full(&mut self) -> Parse<Number> {
        self.replayed(Level::Full, Self::read_full)
    }

    fn read_full(&mut self) -> Parse<Number> {
        self.with_operators(true, |reader| {
            let left = reader.comparison()?;
            reader.full_after(left)
        })
    }

    /// Reads with or without operators in language versions before [`FIRST_WITH_OPERATORS`].
    pub(super) fn with_operators<T>(
        &mut self,
        has_operators: bool,
        read: impl FnOnce(&mut Self) -> Parse<T>,
    ) -> Parse<T> {
        let outer = std::mem::replace(&mut self.statement.has_operators, has_operators);
        let value = read(self);
        self.statement.has_operators = outer;
        value
    }

    /// Returns true if an operator continues the sum being read.
    fn has_operators(&self) -> bool {
        self.statement.has_operators || self.draft.version >= FIRST_WITH_OPERATORS
    }

    /// A whole expression of which the first sum may be replayed by itself.
    pub(super) fn full_of_sum(&mut self) -> Parse<Number> {
        self.with_operators(true, |reader| {
            let sum = reader.sum()?;
            let left = reader.comparison_after(sum)?;
            reader.full_after(left)
        })
    }

    /// The rest of a whole expression, after its first comparison.
    fn full_after(&mut self, left: Number) -> Parse<Number> {
        let test = self.logic_after(left)?;
        if !self.take_mark('?')? {
            return Ok(test);
        }
        let start = self.start_taken();
        let is_true = self.only_float(test, start)?.abs() > EQUAL;
        let yes = self.nested(Self::full)?;
        self.expect_mark(':', "`:` and the other value of `? :`")?;
        let no = self.nested(Self::full)?;
        self.note(Op::Choose(yes.len, no.len));
        let len = yes.len.max(no.len);
        Ok(if is_true {
            yes.promoted(len)
        } else {
            no.promoted(len)
        })
    }

    fn logic_after(&mut self, mut left: Number) -> Parse<Number> {
        while let Some(binary) = self.binary(|mark| match mark {
            '&' => Some(Binary::And),
            '|' => Some(Binary::Or),
            _ => None,
        })? {
            let right = self.comparison()?;
            left = self.combined(binary, left, right);
        }
        Ok(left)
    }

    fn comparison(&mut self) -> Parse<Number> {
        if self.at_string()? {
            self.discard_recording();
            return self.string_comparison();
        }
        let left = self.sum()?;
        self.comparison_after(left)
    }

    fn comparison_after(&mut self, mut left: Number) -> Parse<Number> {
        while let Some(relation) = self.relation()? {
            let right = self.sum()?;
            left = self.combined(relation, left, right);
        }
        Ok(left)
    }

    fn string_comparison(&mut self) -> Parse<Number> {
        let left = self.string()?;
        let Some(relation) = self.relation()? else {
            return Err(self.expected_here("a comparison after the string"));
        };
        let right = self.string()?;
        let order = left.as_bytes().cmp(right.as_bytes());
        Ok(Number::float(relation.of(f64::from(order as i8), 0.0)))
    }

    fn relation(&mut self) -> Parse<Option<Binary>> {
        let relation = match self.peek()?.kind {
            Kind::LessEqual => Binary::LessEqual,
            Kind::GreaterEqual => Binary::GreaterEqual,
            Kind::NotEqual => Binary::NotEqual,
            Kind::Mark => {
                return self.binary(|mark| match mark {
                    '<' => Some(Binary::Less),
                    '>' => Some(Binary::Greater),
                    '=' => Some(Binary::Equal),
                    _ => None,
                });
            }
            _ => return Ok(None),
        };
        self.pass();
        Ok(Some(relation))
    }

    /// Takes the next token if it is an operator.
    #[inline]
    fn binary(&mut self, named: impl Fn(char) -> Option<Binary>) -> Parse<Option<Binary>> {
        let token = self.peek()?;
        let mark = match token.kind {
            Kind::Mark => char::from_u32(token.value),
            _ => None,
        };
        let binary = mark.and_then(named);
        if binary.is_some() {
            self.pass();
        }
        Ok(binary)
    }

    /// Terms with `+` and `-` between them.
    pub(super) fn sum(&mut self) -> Parse<Number> {
        match self.take_literal() {
            Some(number) => Ok(number),
            // A recording holds for one reading: with operators or without.
            None if self.draft.version < FIRST_WITH_OPERATORS => self.read_sum(),
            None => self.replayed(Level::Sum, Self::read_sum),
        }
    }

    fn read_sum(&mut self) -> Parse<Number> {
        if !self.has_operators() {
            return self.factor();
        }
        let mut left = self.product()?;
        while let Some(binary) = self.binary(|mark| match mark {
            '+' => Some(Binary::Add),
            '-' => Some(Binary::Subtract),
            _ => None,
        })? {
            let right = self.product()?;
            left = self.combined(binary, left, right);
        }
        Ok(left)
    }

    fn product(&mut self) -> Parse<Number> {
        self.replayed(Level::Product, Self::read_product)
    }

    fn read_product(&mut self) -> Parse<Number> {
        let mut left = self.factor()?;
        while let Some(binary) = self.binary(|mark| match mark {
            '*' => Some(Binary::Multiply),
            '/' => Some(Binary::Divide),
            _ => None,
        })? {
            let at = self.start_taken();
            let right = self.factor()?;
            let len = usize::from(left.len.max(right.len));
            if binary == Binary::Divide && right.promoted(left.len).v[..len].contains(&0.0) {
                self.warning(Diagnostic::warning(
                    self.span_of(at),
                    "division by zero; the result is taken as infinite",
                ));
            }
            left = self.combined(binary, left, right);
        }
        Ok(left)
    }

    /// Promotes both operands to the same length and combines them.
    fn combined(&mut self, binary: Binary, a: Number, b: Number) -> Number {
        self.note(Op::Binary(binary, a.len, b.len));
        if a.len == 1 && b.len == 1 {
            return Number::float(binary.of(a.v[0], b.v[0]));
        }
        let len = a.len.max(b.len);
        let (a, b) = (a.promoted(len), b.promoted(len));
        let mut sum = Number { v: [0.0; 5], len };
        for i in 0..usize::from(len) {
            sum.v[i] = binary.of(a.v[i], b.v[i]);
        }
        sum
    }

    fn factor(&mut self) -> Parse<Number> {
        let mut is_negative = false;
        let mut nots = 0u32;
        loop {
            let token = self.peek()?;
            match (token.kind, char::from_u32(token.value)) {
                (Kind::Mark, Some('-')) if nots == 0 => is_negative = !is_negative,
                // Behind `!` only zero or not counts, whatever the sign.
                (Kind::Mark, Some('+' | '-')) => {}
                (Kind::Mark, Some('!')) => nots += 1,
                _ => break,
            }
            self.pass();
        }
        self.statement.depth += 1;
        if self.statement.depth > limits::EXPRESSION {
            self.statement.depth = 0;
            return Err(self.error_here(format!(
                "expressions are nested more than {} deep",
                limits::EXPRESSION
            )));
        }
        let value = self.primary();
        self.statement.depth = self.statement.depth.saturating_sub(1);
        let mut value = self.members(value?)?;
        let len = usize::from(value.len);
        for _ in 0..nots {
            self.note(Op::Not(value.len));
            for c in &mut value.v[..len] {
                *c = f64::from(u8::from(c.abs() <= EQUAL));
            }
        }
        if is_negative {
            self.note(Op::Negate(value.len));
            value.v[..len].iter_mut().for_each(|c| *c = -*c);
        }
        Ok(value)
    }

    fn primary(&mut self) -> Parse<Number> {
        let token = self.peek()?;
        match token.kind {
            Kind::Number => {
                self.pass();
                let number = self.last.tokens.numbers[token.value as usize];
                self.note(Op::Float(number));
                Ok(Number::float(number))
            }
            Kind::Mark if token.value == '(' as u32 => {
                self.pass();
                let open = self.start_taken();
                let value = self.full()?;
                self.expect_end(')', "an operator or `)`", open)?;
                Ok(value)
            }
            Kind::Mark if token.value == '<' as u32 => self.vector_literal(),
            Kind::Name => self.number_of_name(Symbol(token.value)),
            Kind::Word => match token.word() {
                Some(word) if word.class() == Class::Value || word == Word::Version => {
                    self.pass();
                    let number = self.value_word(word);
                    self.note_constant(word, &number);
                    Ok(number)
                }
                Some(word) if word.class() == Class::Function => {
                    self.with_operators(true, |reader| reader.call_function(word))
                }
                _ => Err(self.expected_here("a number, a vector or an expression")),
            },
            _ => Err(self.expected_here("a number, a vector or an expression")),
        }
    }

    pub(super) fn value_word(&self, word: Word) -> Number {
        let unit = |at: usize, len: u8| {
            let mut number = Number { v: [0.0; 5], len };
            number.v[at] = 1.0;
            number
        };
        match word {
            Word::X => unit(0, 3),
            Word::Y => unit(1, 3),
            Word::Z => unit(2, 3),
            Word::T => unit(3, 4),
            Word::U => unit(0, 2),
            Word::V => unit(1, 2),
            Word::Pi => Number::float(std::f64::consts::PI),
            Word::Tau => Number::float(std::f64::consts::TAU),
            Word::True | Word::Yes | Word::On => Number::float(1.0),
            Word::Clock => Number::float(self.options.clock),
            Word::ClockOn => Number::truth(self.options.clock_on),
            Word::Now => Number::float(self.now),
            Word::Version => Number::float(self.draft.version),
            _ => Number::float(0.0),
        }
    }

    /// `< a, b, ... >`: two to five components.
    fn vector_literal(&mut self) -> Parse<Number> {
        self.pass();
        let opened = self.start_taken();
        if self.is_raw_mark('>') {
            let error = self.expected_here("a component of the vector");
            let hint = "A vector has two to five components: `<0, 0, 0>`.";
            return Err(Box::new(error.with_hint(hint)));
        }
        let mut number = Number {
            v: [0.0; 5],
            len: 0,
        };
        loop {
            let start = self.start()?;
            if number.len > 0 && !self.begins_number()? {
                let error = self.expected_here("`>` or a further component of the vector");
                return Err(self.with_opened(error, '>', opened));
            }
            let component = self.with_operators(false, Self::sum)?;
            number.v[usize::from(number.len)] = self.only_float(component, start)?;
            number.len += 1;
            self.take_mark(',')?;
            if self.take_mark('>')? {
                break;
            }
            if number.len == 5 {
                let mut error = self.expected_here("`>` after five components");
                error.hints.clear();
                error.fix = None;
                let begins_component = self.begins_number()?;
                let mut error = self.with_opened(error, '>', opened);
                let is_cut = |fix: &Fix| begins_component && fix.text == ">";
                if error.fix.as_deref().is_none_or(is_cut) && !error.message.is_empty() {
                    error.fix = None;
                    error.hints = vec!["A vector has two to five components.".to_owned()];
                }
                return Err(error);
            }
        }
        if number.len == 1 {
            return Err(self.with_trace(
                Diagnostic::error(
                    self.span_from(opened),
                    "a vector has at least two components",
                )
                .with_hint("Write a lone number without `<` and `>`."),
            ));
        }
        Ok(number)
    }

    fn number_of_name(&mut self, symbol: Symbol) -> Parse<Number> {
        match self.scopes.get(symbol) {
            Some(Value::Number(number)) => {
                let number = *number;
                self.pass();
                if self.scopes.is_qualified(symbol) {
                    self.discard_recording();
                    self.warn_of_qualified(symbol);
                }
                self.note_name(symbol, number.len);
                Ok(number)
            }
            Some(Value::Array(array)) => {
                let (dimensions, before) = (array.sizes.len(), self.noted());
                if array.is_mixed {
                    self.discard_recording();
                }
                match self.array_or_item()? {
                    Value::Number(number) => {
                        self.note_item(symbol, before, dimensions, number.len);
                        Ok(number)
                    }
                    other => match Callee::of(&other) {
                        Some(callee) => {
                            self.discard_recording();
                            self.call(&callee)
                        }
                        None => {
                            let error = self.error_taken(format!(
                                "expected a number or vector, found {}",
                                other.kind()
                            ));
                            Err(match self.item_in_parentheses() {
                                Some(remedy) => Box::new(remedy.added_to(*error)),
                                None => error,
                            })
                        }
                    },
                }
            }
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            other => match other.and_then(Callee::of) {
                Some(callee) => {
                    self.pass();
                    self.discard_recording();
                    self.call(&callee)
                }
                None => Err(self.expected_here("a number, a vector or an expression")),
            },
        }
    }

    /// The array of the next identifier, or an item of it if indices follow.
    pub(super) fn array_or_item(&mut self) -> Parse<Value> {
        if let Some(value) = self.take_item_ahead() {
            return Ok(value);
        }
        let symbol = Symbol(self.raw().value);
        let mut value = self
            .scopes
            .get(symbol)
            .cloned()
            .unwrap_or(Value::Poison(None));
        self.pass();
        self.warn_of_qualified(symbol);
        while let Value::Array(array) = &value {
            let array = Rc::clone(array);
            let start = self.here_span();
            let item = if array.is_dictionary() {
                match self.key()? {
                    Some(key) => array.index_of(&key).and_then(|at| array.items[at].clone()),
                    None => break,
                }
            } else {
                let token = match array.is_mixed {
                    true => self.raw(),
                    false => self.peek()?,
                };
                if token.kind != Kind::Mark || token.value != '[' as u32 {
                    break;
                }
                array.items[self.array_index(&array.sizes)?].clone()
            };
            value = item.ok_or_else(|| {
                if self.usage.faulty_arrays.contains(&symbol) {
                    return self.consequence();
                }
                let name = self.names.spelling(symbol).to_owned();
                self.with_trace(
                    Diagnostic::error(
                        start.to(self.taken_span()),
                        format!("this item of `{name}` has no value yet"),
                    )
                    .with_hint("Give it a value with `#declare` first."),
                )
            })?;
        }
        Ok(value)
    }

    /// `.x`, `.red` and the like after a value.
    fn members(&mut self, mut value: Number) -> Parse<Number> {
        self.look_for_semicolon();
        while self.take_mark('.')? {
            let token = self.peek()?;
            let at = match token.word() {
                Some(Word::X | Word::U | Word::Red) => 0,
                Some(Word::Y | Word::V | Word::Green) => 1,
                Some(Word::Z | Word::Blue) => 2,
                Some(Word::T | Word::Filter) => 3,
                Some(Word::Transmit) => 4,
                Some(Word::Gray) => {
                    self.pass();
                    self.note(Op::Grey(value.len));
                    value = Number::float(value.grey());
                    self.look_for_semicolon();
                    continue;
                }
                _ => {
                    return Err(self.expected_here(
                        "`x`, `y`, `z`, `t`, `u`, `v` or a colour component after `.`",
                    ));
                }
            };
            self.pass();
            if at >= value.len {
                let member = self.source_text(self.taken_span()).to_owned();
                return Err(
                    self.error_taken(format!("{} has no component `.{member}`", value.kind()))
                );
            }
            self.note(Op::Member(value.len, at));
            value = Number::float(value.v[usize::from(at)]);
            self.look_for_semicolon();
        }
        Ok(value)
    }

    /// A vector of `len` components at the additive level; a float is repeated.
    pub(super) fn vector_of(&mut self, len: u8) -> Parse<Number> {
        let start = self.start()?;
        let number = self.sum()?;
        if number.len > len {
            let wanted = Number { v: [0.0; 5], len };
            return Err(self.with_trace(Diagnostic::error(
                self.span_from(start),
                format!("expected {}, found {}", wanted.kind(), number.kind()),
            )));
        }
        self.note(Op::Promote(number.len, len));
        Ok(number.promoted(len))
    }

    /// A vector of three at the additive level.
    pub(super) fn vector3(&mut self) -> Parse<DVec3> {
        Ok(self.vector_of(3)?.xyz())
    }
}
