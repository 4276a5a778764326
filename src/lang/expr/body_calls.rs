//! Calls in a formula: other user functions, the built-in ones, `select`, `sum` and `prod`.

use super::body::{Body, Name};
use crate::base::args::{Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene::function::{Binary, Component, Fold, Function, Id, Operand, Unary};
use smallvec::SmallVec;
use std::sync::Arc;

impl Reader<'_> {
    /// A call of another user function, after its name.
    pub(crate) fn body_call(
        &mut self,
        function: &Arc<Function>,
        body: &mut Body,
    ) -> Parse<Operand> {
        let name = self.taken_span();
        let arguments = self.body_arguments(name, function.parameters(), body)?;
        let component = if function.is_scalar() {
            Component::At(0)
        } else {
            self.body_component(function.components())?
        };
        let id = body.graph.call(function, &arguments, component);
        Ok(Operand::closed(id))
    }

    fn body_arguments(
        &mut self,
        name: Span,
        wanted: usize,
        body: &mut Body,
    ) -> Parse<SmallVec<[Id; 8]>> {
        self.expect_mark('(', "`(` and the arguments of the function")?;
        let open = self.start_taken();
        let mut arguments = SmallVec::new();
        while arguments.len() < wanted && !self.peek()?.is_mark(')') {
            arguments.push(self.body_expression(body)?);
            if arguments.len() < wanted {
                self.take_mark(',')?;
            }
        }
        if arguments.len() < wanted || self.peek()?.is_mark(',') {
            return Err(self.wrong_count(name, wanted, arguments.len()));
        }
        self.expect_end(')', "an operator or `)` at the end of the call", open)?;
        Ok(arguments)
    }

    /// `.x`, `.red`, ... after the call of a function whose value is a vector of `len` components.
    fn body_component(&mut self, len: u8) -> Parse<Component> {
        const WHAT: &str = "`.` and a component: this function gives no single number";
        self.expect_mark('.', WHAT)?;
        let token = self.peek()?;
        let component = match token.word() {
            Some(Word::X | Word::U | Word::Red) => Component::At(0),
            Some(Word::Y | Word::V | Word::Green) => Component::At(1),
            Some(Word::Z | Word::Blue) => Component::At(2),
            Some(Word::T | Word::Filter) => Component::At(3),
            Some(Word::Transmit) => Component::At(4),
            Some(Word::Gray) => Component::Gray,
            None if token.kind == Kind::Name => match self.names.spelling(Symbol(token.value)) {
                "grey" => Component::Gray,
                "hf" => Component::Height,
                _ => return Err(self.expected_here("a component such as `x`, `red` or `gray`")),
            },
            _ => return Err(self.expected_here("a component such as `x`, `red` or `gray`")),
        };
        self.pass();
        if matches!(component, Component::At(at) if at >= len.max(2)) {
            let member = self.source_text(self.taken_span()).to_owned();
            return Err(self.error_taken(format!("this function has no component `.{member}`")));
        }
        Ok(component)
    }

    /// A built-in function.
    pub(crate) fn body_function(&mut self, word: Word, body: &mut Body) -> Parse<Id> {
        match word {
            Word::Sum => return self.body_loop(Fold::Sum, body),
            Word::Prod => return self.body_loop(Fold::Product, body),
            Word::Select => return self.body_select(body),
            _ => {}
        }
        if let Some(f) = Unary::of(word) {
            self.pass();
            let arguments = self.body_arguments(self.taken_span(), 1, body)?;
            return Ok(body.graph.unary(f, arguments[0]));
        }
        let Some(f) = Binary::of(word) else {
            let message = format!("`{word}` is not allowed in a function");
            return Err(self.with_trace(
                Diagnostic::error(self.here_span(), message)
                    .with_hint(match word {
                        Word::Vlength => {
                            "Functions compute with numbers: write `sqrt(x*x + y*y + z*z)` for `vlength(<x, y, z>)`."
                        }
                        _ => "Compute it before, and use the name of the result.",
                    }),
            ));
        };
        self.pass();
        let name = self.taken_span();
        if !matches!(f, Binary::Min | Binary::Max) {
            let arguments = self.body_arguments(name, 2, body)?;
            return Ok(body.graph.binary(f, arguments[0], arguments[1]));
        }
        self.expect_mark('(', &format!("`(` after `{word}`"))?;
        let open = self.start_taken();
        let mut value = self.body_expression(body)?;
        self.expect_mark(',', &format!("an operator or `,` in `{word}`"))?;
        loop {
            let next = self.body_expression(body)?;
            value = body.graph.binary(f, value, next);
            if !self.take_mark(',')? {
                break;
            }
        }
        self.expect_end(')', "an operator, `,` or `)`", open)?;
        Ok(value)
    }

    /// `select(test, negative, zero, positive)` or `select(test, negative, zero or positive)`.
    fn body_select(&mut self, body: &mut Body) -> Parse<Id> {
        const COMMA: &str = "an operator or `,` in `select`";
        self.pass();
        self.expect_mark('(', "`(` after `select`")?;
        let open = self.start_taken();
        let test = self.body_expression(body)?;
        self.expect_mark(',', COMMA)?;
        body.graph.open();
        let negative = self.body_expression(body)?;
        let negative = body.graph.close(negative);
        self.expect_mark(',', COMMA)?;
        body.graph.open();
        let zero = self.body_expression(body)?;
        let zero = body.graph.close(zero);
        let positive = if self.take_mark(',')? {
            body.graph.open();
            let positive = self.body_expression(body)?;
            Some(body.graph.close(positive))
        } else {
            None
        };
        self.expect_end(')', "an operator or `)` at the end of `select(...)`", open)?;
        Ok(body.graph.select(test, negative, zero, positive))
    }

    /// `sum(i, from, to, expression)` or `prod(...)`.
    fn body_loop(&mut self, fold: Fold, body: &mut Body) -> Parse<Id> {
        self.pass();
        let word = self.source_text(self.taken_span()).to_owned();
        self.expect_mark('(', &format!("`(` after `{word}`"))?;
        let open = self.start_taken();
        let token = self.peek()?;
        let name = match (token.kind, token.word()) {
            (Kind::Name, _) => Name::Symbol(Symbol(token.value)),
            (_, Some(word @ (Word::X | Word::Y | Word::Z | Word::U | Word::V))) => Name::Word(word),
            _ => return Err(self.expected_here(&format!("the variable of `{word}`"))),
        };
        self.pass();
        let comma = format!("an operator or `,` in `{word}`");
        self.expect_mark(',', &comma)?;
        let from = self.body_expression(body)?;
        self.expect_mark(',', &comma)?;
        // In the last number the variable stands for the start value.
        body.variables.push((name, from));
        let to = self.body_expression(body)?;
        body.variables.pop();
        self.expect_mark(',', &comma)?;
        let variable = body.graph.variable();
        body.variables.push((name, variable));
        body.graph.open();
        let value = self.body_expression(body);
        body.variables.pop();
        let block = body.graph.close(value?);
        self.expect_end(
            ')',
            &format!("an operator or `)` at the end of `{word}(...)`"),
            open,
        )?;
        Ok(body.graph.repeat(fold, variable, (from, to), block))
    }
}
