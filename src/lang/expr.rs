//! Expressions: POV-Ray's precedence and promotion.
//!
//! Outside of parentheses an expression ends at the additive level; comparisons, logic and `? :` stand only inside
//! parentheses and in the arguments of some built-in functions. `&` and `|` bind alike, from left to right.

use super::flow::EQUAL;
use super::function::Callee;
use super::limits;
use super::reader::Reader;
use super::value::{Number, Value};
use crate::args::{Parse, Word};
use crate::source::Diagnostic;
use crate::syntax::{Class, Kind, Symbol};
use glam::DVec3;
use std::rc::Rc;

impl Reader<'_> {
    /// A float at the additive level.
    pub(super) fn number_at_sum(&mut self) -> Parse<f64> {
        let start = self.start_span()?;
        let number = self.sum()?;
        self.only_float(number, start)
    }

    fn only_float(&self, number: Number, start: crate::source::Span) -> Parse<f64> {
        if number.len == 1 {
            return Ok(number.v[0]);
        }
        Err(self.with_trace(
            Diagnostic::error(
                start.to(self.taken_span()),
                format!("expected a number, found {}", number.kind()),
            )
            .with_hint("Take one component: `.x`, `.y`, `.z`, `.red` and so on."),
        ))
    }

    /// The place of the next token.
    pub(super) fn start_span(&mut self) -> Parse<crate::source::Span> {
        self.peek()?;
        Ok(self.here_span())
    }

    /// The value of a condition: comparisons of numbers or of strings, logic, `? :`.
    pub(super) fn condition_value(&mut self) -> Parse<f64> {
        let start = self.start_span()?;
        let number = self.full()?;
        self.only_float(number, start)
    }

    /// A whole expression, as inside parentheses.
    pub(super) fn full(&mut self) -> Parse<Number> {
        let test = self.logic()?;
        if !self.take_mark('?')? {
            return Ok(test);
        }
        let start = self.taken_span();
        let is_true = self.only_float(test, start)?.abs() > EQUAL;
        let yes = self.nested(Self::full)?;
        self.expect_mark(':', "`:` and the other value of `? :`")?;
        let no = self.nested(Self::full)?;
        let len = yes.len.max(no.len);
        Ok(if is_true {
            yes.promoted(len)
        } else {
            no.promoted(len)
        })
    }

    fn logic(&mut self) -> Parse<Number> {
        let mut left = self.comparison()?;
        loop {
            let is_and = if self.take_mark('&')? {
                true
            } else if self.take_mark('|')? {
                false
            } else {
                return Ok(left);
            };
            let right = self.comparison()?;
            left = by_component(left, right, |a, b| {
                let (a, b) = (a.abs() > EQUAL, b.abs() > EQUAL);
                f64::from(u8::from(if is_and { a && b } else { a || b }))
            });
        }
    }

    fn comparison(&mut self) -> Parse<Number> {
        if self.at_string()? {
            return self.string_comparison();
        }
        let mut left = self.sum()?;
        while let Some(relation) = self.relation()? {
            let right = self.sum()?;
            left = by_component(left, right, |a, b| {
                f64::from(u8::from(relation.holds(a, b)))
            });
        }
        Ok(left)
    }

    fn string_comparison(&mut self) -> Parse<Number> {
        let left = self.string()?;
        let Some(relation) = self.relation()? else {
            return Err(self.expected_here("a comparison after the string"));
        };
        let right = self.string()?;
        Ok(Number::truth(
            relation.orders(left.as_bytes().cmp(right.as_bytes())),
        ))
    }

    fn relation(&mut self) -> Parse<Option<Relation>> {
        let token = self.peek()?;
        let relation = match token.kind {
            Kind::LessEqual => Relation::LessEqual,
            Kind::GreaterEqual => Relation::GreaterEqual,
            Kind::NotEqual => Relation::NotEqual,
            Kind::Mark => match char::from_u32(token.value) {
                Some('<') => Relation::Less,
                Some('>') => Relation::Greater,
                Some('=') => Relation::Equal,
                _ => return Ok(None),
            },
            _ => return Ok(None),
        };
        self.pass();
        Ok(Some(relation))
    }

    /// Terms with `+` and `-` between them.
    pub(super) fn sum(&mut self) -> Parse<Number> {
        let mut left = self.product()?;
        loop {
            if self.take_mark('+')? {
                let right = self.product()?;
                left = by_component(left, right, |a, b| a + b);
            } else if self.take_mark('-')? {
                let right = self.product()?;
                left = by_component(left, right, |a, b| a - b);
            } else {
                return Ok(left);
            }
        }
    }

    fn product(&mut self) -> Parse<Number> {
        let mut left = self.factor()?;
        loop {
            if self.take_mark('*')? {
                let right = self.factor()?;
                left = by_component(left, right, |a, b| a * b);
            } else if self.take_mark('/')? {
                let at = self.taken_span();
                let right = self.factor()?;
                let len = usize::from(left.len.max(right.len));
                let divisor = right.promoted(left.len);
                if divisor.v[..len].contains(&0.0) {
                    self.warning(Diagnostic::warning(
                        at,
                        "division by zero; the result is taken as infinite",
                    ));
                }
                left = by_component(
                    left,
                    right,
                    |a, b| if b == 0.0 { f64::INFINITY } else { a / b },
                );
            } else {
                return Ok(left);
            }
        }
    }

    fn factor(&mut self) -> Parse<Number> {
        let mut is_negative = false;
        let mut nots = 0u32;
        loop {
            let token = self.peek()?;
            match (token.kind, char::from_u32(token.value)) {
                (Kind::Mark, Some('-')) if nots == 0 => is_negative = !is_negative,
                (Kind::Mark, Some('+')) => {}
                (Kind::Mark, Some('!')) => nots += 1,
                _ => break,
            }
            self.pass();
        }
        self.depth += 1;
        if self.depth > limits::EXPRESSION {
            self.depth = 0;
            return Err(self.error_here(format!(
                "expressions are nested more than {} deep",
                limits::EXPRESSION
            )));
        }
        let value = self.primary();
        self.depth = self.depth.saturating_sub(1);
        let mut value = self.members(value?)?;
        for _ in 0..nots {
            value
                .v
                .iter_mut()
                .for_each(|c| *c = f64::from(u8::from(c.abs() <= EQUAL)));
            value.v[usize::from(value.len)..].fill(0.0);
        }
        if is_negative {
            value.v.iter_mut().for_each(|c| *c = -*c);
        }
        Ok(value)
    }

    fn primary(&mut self) -> Parse<Number> {
        let token = self.peek()?;
        match token.kind {
            Kind::Number => {
                self.pass();
                Ok(Number::float(
                    self.last_tokens.numbers[token.value as usize],
                ))
            }
            Kind::Mark if token.value == '(' as u32 => {
                self.pass();
                let open = self.taken_span();
                let value = self.full()?;
                self.expect_end(')', "an operator or `)`", open)?;
                Ok(value)
            }
            Kind::Mark if token.value == '<' as u32 => self.vector_literal(),
            Kind::Name => self.number_of_name(Symbol(token.value)),
            Kind::Word => match token.word() {
                Some(word) if word.class() == Class::Value || word == Word::Version => {
                    self.pass();
                    Ok(self.value_word(word))
                }
                Some(word) if word.class() == Class::Function => self.call_function(word),
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
            Word::True | Word::Yes | Word::On => Number::float(1.0),
            Word::Clock => Number::float(self.options.clock),
            Word::ClockOn => Number::truth(self.options.clock_on),
            Word::Now => Number::float(self.now),
            Word::Version => Number::float(self.version),
            _ => Number::float(0.0),
        }
    }

    /// `< a, b, ... >`: two to five components.
    fn vector_literal(&mut self) -> Parse<Number> {
        self.pass();
        let opened = self.taken_span();
        let mut number = Number {
            v: [0.0; 5],
            len: 0,
        };
        loop {
            let start = self.start_span()?;
            if number.len > 0 && !self.begins_number()? {
                let error = self.expected_here("`>` or a further component of the vector");
                return Err(self.with_opened(error, '>', opened));
            }
            let component = self.sum()?;
            number.v[usize::from(number.len)] = self.only_float(component, start)?;
            number.len += 1;
            self.take_mark(',')?;
            if self.take_mark('>')? {
                break;
            }
            if number.len == 5 {
                let mut error = self.expected_here("`>` after five components");
                if !error.message.is_empty() {
                    error.hints = vec!["A vector has two to five components.".to_owned()];
                }
                return Err(self.with_opened(error, '>', opened));
            }
        }
        if number.len == 1 {
            return Err(self.with_trace(
                Diagnostic::error(
                    opened.to(self.taken_span()),
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
                Ok(number)
            }
            Some(Value::Array(_)) => match self.array_or_item()? {
                Value::Number(number) => Ok(number),
                other => match Callee::of(&other) {
                    Some(callee) => self.call(&callee),
                    None => Err(self.error_taken(format!(
                        "expected a number or vector, found {}",
                        other.kind()
                    ))),
                },
            },
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            other => match other.and_then(Callee::of) {
                Some(callee) => {
                    self.pass();
                    self.call(&callee)
                }
                None => Err(self.expected_here("a number, a vector or an expression")),
            },
        }
    }

    /// The array of the identifier at hand, or its item if indices follow.
    pub(super) fn array_or_item(&mut self) -> Parse<Value> {
        let symbol = Symbol(self.raw().value);
        let mut value = self
            .scopes
            .get(symbol)
            .cloned()
            .unwrap_or(Value::Poison(None));
        self.pass();
        while let Value::Array(array) = &value {
            let token = self.peek()?;
            if token.kind != Kind::Mark || token.value != '[' as u32 {
                break;
            }
            let array = Rc::clone(array);
            let start = self.here_span();
            let at = self.array_index(&array.sizes)?;
            value = array.items[at].clone().ok_or_else(|| {
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

    /// `.x`, `.red` and the like behind a value.
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
                    let grey = 0.297 * value.v[0] + 0.589 * value.v[1] + 0.114 * value.v[2];
                    value = Number::float(grey);
                    continue;
                }
                _ => {
                    return Err(self.expected_here(
                        "`x`, `y`, `z`, `t`, `u`, `v` or a colour component after `.`",
                    ));
                }
            };
            self.pass();
            if at >= usize::from(value.len) {
                let member = self.source_text(self.taken_span()).to_owned();
                return Err(
                    self.error_taken(format!("{} has no component `.{member}`", value.kind()))
                );
            }
            value = Number::float(value.v[at]);
        }
        Ok(value)
    }

    /// A vector of `len` components at the additive level; a float stands for all of them.
    pub(super) fn vector_of(&mut self, len: u8) -> Parse<Number> {
        let start = self.start_span()?;
        let number = self.sum()?;
        if number.len > len {
            let wanted = Number { v: [0.0; 5], len };
            return Err(self.with_trace(Diagnostic::error(
                start.to(self.taken_span()),
                format!("expected {}, found {}", wanted.kind(), number.kind()),
            )));
        }
        Ok(number.promoted(len))
    }

    /// A vector of three at the additive level.
    pub(super) fn vector3(&mut self) -> Parse<DVec3> {
        let number = self.vector_of(3)?;
        Ok(DVec3::new(number.v[0], number.v[1], number.v[2]))
    }
}

/// How two values compare.
#[derive(Clone, Copy, Debug)]
enum Relation {
    Less,
    LessEqual,
    Equal,
    NotEqual,
    GreaterEqual,
    Greater,
}

impl Relation {
    /// On floats: equality, and the two relations that include it, allow for rounding.
    fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Relation::Less => a < b,
            Relation::LessEqual => a <= b + EQUAL,
            Relation::Equal => (a - b).abs() <= EQUAL,
            Relation::NotEqual => (a - b).abs() > EQUAL,
            Relation::GreaterEqual => a + EQUAL >= b,
            Relation::Greater => a > b,
        }
    }

    fn orders(self, order: std::cmp::Ordering) -> bool {
        match self {
            Relation::Less => order.is_lt(),
            Relation::LessEqual => order.is_le(),
            Relation::Equal => order.is_eq(),
            Relation::NotEqual => order.is_ne(),
            Relation::GreaterEqual => order.is_ge(),
            Relation::Greater => order.is_gt(),
        }
    }
}

/// Both operands brought to the same length, then combined.
fn by_component(a: Number, b: Number, f: impl Fn(f64, f64) -> f64) -> Number {
    if a.len == 1 && b.len == 1 {
        return Number::float(f(a.v[0], b.v[0]));
    }
    let len = a.len.max(b.len);
    let (a, b) = (a.promoted(len), b.promoted(len));
    let mut sum = Number { v: [0.0; 5], len };
    for i in 0..usize::from(len) {
        sum.v[i] = f(a.v[i], b.v[i]);
    }
    sum
}
