//! `function { ... }`, and calls of functions and splines in expressions.

use super::body::{Body, Name};
use super::callee::{Callee, FUNCTION, SPLINE, is_callable};
use super::value::{Element, Number, Value};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::{Spline, SplineKind, Step, Transform};
use crate::base::source::{Diagnostic, Span};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene::function::{
    Function, Internal, Kind as Computes, MAX_PARAMETERS, Refusal, internal,
};
use crate::scene::pattern::{Settings, read_field};
use crate::scene::texture::{Pigment, PreparedPigment, read_pattern};
use std::sync::Arc;

impl Reader<'_> {
    /// True if the next identifier calls a function or spline: it holds one, and `(` follows.
    pub(crate) fn at_call(&self) -> bool {
        let token = self.raw();
        token.kind == Kind::Name
            && self.raw_ahead(1).is_mark('(')
            && self
                .scopes
                .get(Symbol(token.value))
                .is_some_and(is_callable)
    }

    /// The value of a call, whose `(` is next.
    pub(crate) fn call(&mut self, callee: &Callee) -> Parse<Number> {
        let name = self.taken_span();
        match callee {
            Callee::Function(function) => {
                let function = self.with_current_noise(Arc::clone(function));
                self.call_user_function(&function, name)
            }
            Callee::Spline(spline) => self.call_spline(spline),
        }
    }

    fn call_user_function(&mut self, function: &Function, name: Span) -> Parse<Number> {
        self.expect_mark('(', "`(` and the arguments of the function")?;
        let open = self.start_taken();
        let wanted = function.parameters();
        let mut arguments: smallvec::SmallVec<[f64; 8]> = smallvec::SmallVec::new();
        while arguments.len() < wanted && !self.peek()?.is_mark(')') {
            arguments.push(self.number_at_sum()?);
            if arguments.len() < wanted {
                self.take_mark(',')?;
            }
        }
        if arguments.len() < wanted || !self.peek()?.is_mark(')') && self.begins_argument()? {
            return Err(self.wrong_count(name, wanted, arguments.len()));
        }
        self.expect_end(')', "an operator or `)` at the end of the call", open)?;
        Ok(if function.is_scalar() {
            Number::float(function.eval(&arguments))
        } else {
            Number {
                v: function.eval_vector(&arguments),
                len: function.components(),
            }
        })
    }

    /// True if another argument begins at the next token.
    pub(crate) fn begins_argument(&mut self) -> Parse<bool> {
        Ok(self.peek()?.is_mark(',') || self.begins_number()?)
    }

    /// The error for a call with `found` arguments or more.
    pub(crate) fn wrong_count(
        &mut self,
        name: Span,
        wanted: usize,
        found: usize,
    ) -> Box<Diagnostic> {
        let called = self.source_text(name).to_owned();
        let found = if found < wanted {
            format!("found {found}")
        } else {
            "found a further one".to_owned()
        };
        let plural = if wanted == 1 { "" } else { "s" };
        let span = name.to(self.here_span());
        let message = format!("`{called}` takes {wanted} argument{plural}, {found}");
        let error = Diagnostic::error(span, message);
        let names = ["a", "b", "c", "d", "e"];
        self.with_trace(match names.get(..wanted) {
            Some(names) => error.with_hint(format!("Write `{called}({})`.", names.join(", "))),
            None => error,
        })
    }

    fn call_spline(&mut self, spline: &Spline) -> Parse<Number> {
        self.expect_mark('(', "`(` and the position on the spline")?;
        let open = self.start_taken();
        let t = self.number_at_sum()?;
        let kind = if self.take_mark(',')? {
            let Some(kind) = self.spline_kind()? else {
                return Err(self.expected_here(
                    "`linear_spline`, `quadratic_spline`, `cubic_spline` or `natural_spline`",
                ));
            };
            kind
        } else {
            spline.kind()
        };
        self.expect_end(')', "an operator, `,` and a kind of spline, or `)`", open)?;
        Ok(Number {
            v: spline.at_as(kind, t),
            len: spline.components(),
        })
    }

    /// The kind of spline, if the next word names one.
    fn spline_kind(&mut self) -> Parse<Option<SplineKind>> {
        let kind = match self.peek()?.word() {
            Some(Word::LinearSpline) => SplineKind::Linear,
            Some(Word::QuadraticSpline) => SplineKind::Quadratic,
            Some(Word::CubicSpline) => SplineKind::Cubic,
            Some(Word::NaturalSpline) => SplineKind::Natural,
            _ => return Ok(None),
        };
        self.pass();
        Ok(Some(kind))
    }

    /// `{ declared_spline kind  t, value, ... }`, after `spline`.
    pub(crate) fn spline_block(&mut self) -> Parse<Arc<Spline>> {
        self.open_block()?;
        let known = crate::base::args::declared::<Spline>(self)?;
        let kind = self.spline_kind()?;
        let mut points = Vec::new();
        while !self.take_close()? {
            if !self.begins_number()? {
                return Err(self.expected_here("a number and its point, or `}` in `spline`"));
            }
            let key = Args::float(self)?;
            self.take_mark(',')?;
            let start = self.start()?;
            let point = self.sum()?.promoted(2);
            self.finite(&point.v, start)?;
            self.take_mark(',')?;
            points.push((key, point.v, point.len));
        }
        let known = known.unwrap_or_default();
        if known.is_empty() && points.is_empty() {
            return Err(self.error_taken("a spline has at least one point"));
        }
        let kind = kind.unwrap_or(known.kind());
        Ok(Arc::new(Spline::new(&known, kind, &points)))
    }

    /// The value of `spline { ... }`.
    pub(crate) fn spline_value(&mut self) -> Parse<Value> {
        self.pass();
        let value = self.spline_block()?;
        Ok(Value::Element(Element {
            name: SPLINE,
            value,
        }))
    }

    /// The value of `function { ... }`.
    pub(crate) fn function_value(&mut self) -> Parse<Value> {
        self.pass();
        let value = self.function_block()?;
        Ok(Value::Element(Element {
            name: FUNCTION,
            value,
        }))
    }

    /// `(a, b, ...) { ... }`, after `function`.
    pub(crate) fn function_block(&mut self) -> Parse<Arc<Function>> {
        let start = self.taken_span();
        let named = if self.take_mark('(')? {
            // A directive between the parameters does not end the declaration around the function.
            let declaring = self.statement.declaring.take();
            let names = self.parameters();
            self.statement.declaring = declaring;
            Some((names?, self.taken_span()))
        } else {
            None
        };
        self.open_block()?;
        self.pass_hash_of_new_name();
        if self.peek()?.kind == Kind::String {
            // POV-Ray accepts a name for messages here.
            self.string()?;
        }
        if let Some(computes) = self.function_without_formula()? {
            let is_internal = matches!(
                computes,
                Computes::Internal(_) | Computes::Noise(_) | Computes::Ridged(_)
            );
            if let (Some((_, span)), false) = (&named, is_internal) {
                return Err(self.with_trace(
                    Diagnostic::error(
                        start.to(*span),
                        "the parameters of this kind of function cannot be named",
                    )
                    .with_hint("Remove the names and their parentheses."),
                ));
            }
            Args::close(self)?;
            return Ok(Arc::new(Function::of(computes)));
        }
        let parameters = named.map_or_else(
            || {
                vec![
                    Name::Word(Word::X),
                    Name::Word(Word::Y),
                    Name::Word(Word::Z),
                ]
            },
            |named| named.0,
        );
        let count = parameters.len();
        let mut body = Body::new(parameters);
        let result = self.body_expression(&mut body)?;
        if !self.take_close()? {
            return Err(self.expected_here("an operator or `}` at the end of the function"));
        }
        let graph = body.finish(result);
        let span = start.to(self.taken_span());
        match Function::formula(graph, count) {
            Ok(function) => Ok(Arc::new(function)),
            Err(refusal) => Err(self.refused(refusal, span)),
        }
    }

    fn refused(&self, refusal: Refusal, span: Span) -> Box<Diagnostic> {
        let (message, hint) = match refusal {
            Refusal::TooLarge => (
                "this function is too large to be computed",
                "Split it into several, and let fewer functions call each other.",
            ),
            Refusal::TooLong => (
                "one value of this function would take more than ten thousand million steps",
                "Let `sum` and `prod` run over fewer numbers, or call fewer functions.",
            ),
        };
        self.with_trace(Diagnostic::error(span, message).with_hint(hint))
    }

    /// `a, b, ...)`, after `(`.
    fn parameters(&mut self) -> Parse<Vec<Name>> {
        const WHAT: &str = "a parameter of the function";
        let mut names = Vec::new();
        loop {
            self.pass_hash_of_new_name();
            let token = self.peek()?;
            names.push(match (token.kind, token.word()) {
                (Kind::Name, _) => Name::Symbol(Symbol(token.value)),
                (_, Some(word @ (Word::X | Word::Y | Word::Z | Word::U | Word::V))) => {
                    Name::Word(word)
                }
                _ => return Err(self.expected_here(WHAT)),
            });
            self.pass();
            if names.len() > MAX_PARAMETERS {
                return Err(self.error_taken(format!(
                    "a function has at most {MAX_PARAMETERS} parameters"
                )));
            }
            if self.take_mark(')')? {
                return Ok(names);
            }
            self.take_mark(',')?;
        }
    }

    fn pattern_settings(&self) -> Settings {
        Settings {
            solid_of: self.probe.solid_of(),
            ..self.draft.globals.pattern_settings(self.draft.version)
        }
    }

    /// The function as called from here: `f_noise3d` uses the noise generator that is set at the call.
    pub(crate) fn with_current_noise(&self, function: Arc<Function>) -> Arc<Function> {
        let noise = self.pattern_settings().noise_generator;
        match function.kind() {
            Computes::Noise(known) if *known != noise => {
                Arc::new(Function::of(Computes::Noise(noise)))
            }
            _ => function,
        }
    }

    /// The content of a function block that holds no formula.
    fn function_without_formula(&mut self) -> Parse<Option<Computes>> {
        let computes = match self.peek()?.word() {
            Some(Word::Internal) => {
                self.pass();
                let internal = self.internal_function()?;
                if internal.number == internal::NOISE_3D {
                    Computes::Noise(self.pattern_settings().noise_generator)
                } else if internal.number == internal::RIDGED_MF {
                    Computes::Ridged(Arc::clone(&self.draft.globals.ridged_calls))
                } else {
                    Computes::Internal(internal)
                }
            }
            Some(Word::Spline) => {
                self.pass();
                Computes::Spline(self.spline_block()?)
            }
            Some(Word::Transform) => {
                let step = transform_step(self)?;
                Computes::Transform(step.map_or(Transform::IDENTITY, |step: Step| step.transform()))
            }
            Some(Word::Pattern) => {
                self.pass();
                let settings = self.pattern_settings();
                Computes::Field(Arc::new(read_field(self, &settings, read_pattern)?))
            }
            Some(Word::Pigment) => {
                self.pass();
                let default = self.draft.default_layer.pigment.clone();
                let pigment = Pigment::read(self, &default)?;
                let settings = self.pattern_settings();
                Computes::Color(Arc::new(PreparedPigment::new(&pigment, &[], &settings)))
            }
            _ => return Ok(None),
        };
        Ok(Some(computes))
    }

    /// `(n)`, after `internal`.
    fn internal_function(&mut self) -> Parse<&'static Internal> {
        let start = self.taken_span();
        self.expect_mark('(', "`(` after `internal`")?;
        let number = self.number_at_sum()?;
        self.expect_mark(')', "`)` after the number of the function")?;
        internal::of_number(number, self.draft.globals.is_for_3_8).ok_or_else(|| {
            self.with_trace(
                Diagnostic::error(
                    start.to(self.taken_span()),
                    format!("there is no internal function {number}"),
                )
                .with_hint(
                    "The file functions.inc gives the internal functions names: `f_torus`, ...",
                ),
            )
        })
    }
}
