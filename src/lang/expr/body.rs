//! The formula of a user function.
//!
//! It is not an expression of the language: it knows only numbers, compares exactly, `&` binds tighter than `|`, and
//! its parameters have no value while it is read. Names that hold numbers are replaced by their value at once.

use super::callee::Callee;
use super::value::{Number, Value};
use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Symbol};
use crate::scene::function::{Binary, ChainTail, Graph, Id, Operand, chain, product};

/// The name of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Name {
    Symbol(Symbol),
    /// `x`, `y`, `z`, `u` or `v`.
    Word(Word),
}

/// A formula being read.
pub(crate) struct Body {
    pub(crate) graph: Graph,
    parameters: Vec<Name>,
    /// The variables of the enclosing loops, outermost first.
    pub(crate) variables: Vec<(Name, Id)>,
}

impl Body {
    /// An empty formula with these parameters.
    pub(crate) fn new(parameters: Vec<Name>) -> Self {
        Body {
            graph: Graph::new(),
            parameters,
            variables: Vec::new(),
        }
    }

    /// The formula whose value is `result`.
    pub(crate) fn finish(self, result: Id) -> Graph {
        self.graph.finish(result)
    }

    /// The value of a name. Of several parameters with the same name the first counts; of reserved words the last.
    fn value_of(&mut self, name: Name) -> Option<Id> {
        let variable = self.variables.iter().rev().find(|known| known.0 == name);
        let mut indices = (0..self.parameters.len())
            .filter(|&index| canonical(self.parameters[index]) == canonical(name));
        let parameter = match name {
            Name::Symbol(_) => indices.next(),
            Name::Word(_) => indices.next_back(),
        };
        match (name, variable, parameter) {
            // POV-Ray looks up `x` and the like as parameters before variables.
            (Name::Word(_), _, Some(index)) | (_, None, Some(index)) => {
                Some(self.graph.parameter(u16::try_from(index).unwrap_or(0)))
            }
            (_, Some(&(_, id)), _) => Some(id),
            _ => None,
        }
    }
}

/// `u` and `v` are aliases of `x` and `y`.
fn canonical(name: Name) -> Name {
    match name {
        Name::Word(Word::U) => Name::Word(Word::X),
        Name::Word(Word::V) => Name::Word(Word::Y),
        _ => name,
    }
}

impl Reader<'_> {
    /// A whole formula.
    pub(crate) fn body_expression(&mut self, body: &mut Body) -> Parse<Id> {
        let mut left = self.body_and(body)?;
        while self.take_mark('|')? {
            let right = self.body_and(body)?;
            left = body.graph.binary(Binary::Or, left, right);
        }
        Ok(left)
    }

    fn body_and(&mut self, body: &mut Body) -> Parse<Id> {
        let mut left = self.body_comparison(body)?.id;
        while self.take_mark('&')? {
            let right = self.body_comparison(body)?.id;
            left = body.graph.binary(Binary::And, left, right);
        }
        Ok(left)
    }

    fn body_comparison(&mut self, body: &mut Body) -> Parse<Operand> {
        let first = self.body_sum(body)?;
        let mut rest = ChainTail::new();
        while let Some(f) = self.body_relation()? {
            rest.push((f, self.body_sum(body)?));
        }
        Ok(chain(&mut body.graph, first, &rest))
    }

    fn body_relation(&mut self) -> Parse<Option<Binary>> {
        let token = self.peek()?;
        let f = match token.kind {
            Kind::LessEqual => Binary::LessEqual,
            Kind::GreaterEqual => Binary::GreaterEqual,
            Kind::NotEqual => Binary::NotEqual,
            Kind::Mark => match char::from_u32(token.value) {
                Some('<') => Binary::Less,
                Some('>') => Binary::Greater,
                Some('=') => Binary::Equal,
                _ => return Ok(None),
            },
            _ => return Ok(None),
        };
        self.pass();
        Ok(Some(f))
    }

    fn body_sum(&mut self, body: &mut Body) -> Parse<Operand> {
        let first = self.body_product(body)?;
        let mut rest = ChainTail::new();
        loop {
            let f = if self.take_mark('+')? {
                Binary::Add
            } else if self.take_mark('-')? {
                Binary::Sub
            } else {
                return Ok(chain(&mut body.graph, first, &rest));
            };
            rest.push((f, self.body_product(body)?));
        }
    }

    fn body_product(&mut self, body: &mut Body) -> Parse<Operand> {
        let first = self.body_operand(body)?;
        let mut rest = ChainTail::new();
        let start = self.taken_span();
        loop {
            let f = if self.take_mark('*')? {
                Binary::Mul
            } else if self.take_mark('/')? {
                Binary::Div
            } else {
                break;
            };
            rest.push((f, self.body_operand(body)?));
        }
        product(&mut body.graph, first, &rest).map_err(|_| {
            let span = start.to(self.taken_span());
            self.with_trace(
                Diagnostic::error(span, "division by zero")
                    .with_hint("Divide by a parameter, or by a number that is not zero."),
            )
        })
    }

    /// A value with its sign.
    fn body_operand(&mut self, body: &mut Body) -> Parse<Operand> {
        let mut is_negative = false;
        loop {
            self.pass_hash_of_new_name();
            if self.take_mark('-')? {
                is_negative = !is_negative;
            } else if !self.take_mark('+')? {
                break;
            }
        }
        self.statement.depth += 1;
        if self.statement.depth > limits::EXPRESSION {
            self.statement.depth = 0;
            return Err(self.error_here(format!(
                "expressions are nested more than {} deep",
                limits::EXPRESSION
            )));
        }
        let value = self.body_value(body);
        self.statement.depth = self.statement.depth.saturating_sub(1);
        let value = value?;
        Ok(if is_negative {
            value.negated(&mut body.graph)
        } else {
            value
        })
    }

    fn body_value(&mut self, body: &mut Body) -> Parse<Operand> {
        let token = self.peek()?;
        match token.kind {
            Kind::Number => {
                self.pass();
                let value = self.last.tokens.numbers[token.value as usize];
                Ok(Operand::literal(&mut body.graph, value))
            }
            Kind::Mark if token.is_mark('(') => {
                self.pass();
                let open = self.start_taken();
                let id = self.body_expression(body)?;
                self.expect_end(')', "an operator or `)`", open)?;
                Ok(Operand::closed(id))
            }
            Kind::Name => self.body_name(Symbol(token.value), body),
            Kind::Word => match token.word() {
                Some(word @ (Word::X | Word::Y | Word::Z | Word::U | Word::V)) => {
                    self.pass();
                    Ok(Operand::closed(self.body_coordinate(word, body)))
                }
                Some(word) if word.class() == Class::Value && word != Word::T => {
                    self.pass();
                    if NOT_IN_FUNCTIONS.contains(&word) {
                        let reason = format!("`{word}` is no number in a function");
                        let remedy =
                            format!("Write its value, or declare it: `#declare A = {word};`.");
                        self.refused_by_povray(self.taken_span(), &reason, &remedy);
                    }
                    let value = self.value_word(word).v[0];
                    Ok(Operand::literal(&mut body.graph, value))
                }
                Some(word) if word.class() == Class::Function => {
                    let id = self.body_function(word, body)?;
                    Ok(Operand::closed(id))
                }
                _ => Err(self.expected_here(OPERAND)),
            },
            _ => Err(self.expected_here(OPERAND)),
        }
    }

    fn body_coordinate(&mut self, word: Word, body: &mut Body) -> Id {
        body.value_of(Name::Word(word)).unwrap_or_else(|| {
            self.warning(
                Diagnostic::warning(
                    self.taken_span(),
                    format!("this function has no parameter `{word}`; it is taken as 0"),
                )
                .with_hint(format!("Name it: `function(..., {word}) {{ ... }}`.")),
            );
            body.graph.constant(0.0)
        })
    }

    fn body_name(&mut self, symbol: Symbol, body: &mut Body) -> Parse<Operand> {
        if let Some(id) = body.value_of(Name::Symbol(symbol)) {
            self.pass();
            return Ok(Operand::closed(id));
        }
        let value = match self.scopes.get(symbol) {
            None => return Err(self.undeclared_in_body(body)),
            Some(Value::Array(_)) => self.array_or_item()?,
            Some(Value::Poison(why)) => return Err(self.consequence_of(why.as_deref())),
            Some(value) => {
                let value = value.clone();
                self.pass();
                value
            }
        };
        match (&value, Callee::of(&value)) {
            (Value::Number(Number { v, len: 1 }), _) => Ok(Operand::literal(&mut body.graph, v[0])),
            (_, Some(Callee::Function(function))) => {
                let function = self.with_current_noise(function);
                self.body_call(&function, body)
            }
            (_, Some(Callee::Spline(_))) => Err(self.unfit_in_body(
                "a spline",
                "Wrap it: `#declare F = function { spline { S } }`, and write `F(x).x`.",
            )),
            (Value::Number(number), _) => Err(self.unfit_in_body(
                number.kind(),
                "Declare what you need of it: `#declare A = V.x;`.",
            )),
            _ => Err(self.unfit_in_body(&value.kind(), "A formula is made of numbers only.")),
        }
    }

    fn unfit_in_body(&mut self, found: &str, hint: &str) -> Box<Diagnostic> {
        let message = format!("expected {OPERAND}, found {found}");
        let span = self.taken_span();
        self.with_trace(Diagnostic::error(span, message).with_hint(hint))
    }

    fn undeclared_in_body(&mut self, body: &Body) -> Box<Diagnostic> {
        let mut error = self.expected_here(OPERAND);
        if !error.message.is_empty() && error.hints.is_empty() {
            let names: Vec<String> = body
                .parameters
                .iter()
                .map(|name| match name {
                    Name::Symbol(symbol) => self.names.spelling(*symbol).to_owned(),
                    Name::Word(word) => word.to_string(),
                })
                .collect();
            let text = format!("The parameters of this function: {}.", names.join(", "));
            error = Box::new(error.with_hint(text));
        }
        error
    }
}

/// Words for numbers that POV-Ray 3.7 does not know in functions.
const NOT_IN_FUNCTIONS: [Word; 8] = [
    Word::On,
    Word::Off,
    Word::Yes,
    Word::No,
    Word::True,
    Word::False,
    Word::Now,
    Word::ClockOn,
];

/// Operands of a formula, for messages.
const OPERAND: &str = "a number, a parameter or a function";
