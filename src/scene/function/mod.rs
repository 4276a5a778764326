//! User functions: `function { ... }`, compiled once and called often.
//!
//! The parser builds a [`Graph`] from a body, with common subexpressions merged and small callees inlined. The graph is
//! lowered to a [`Program`] on registers, which runs on `f64` and on any other [`Number`], such as intervals. Functions
//! without a formula are trait objects: a pattern is a [`Field`], a pigment a [`ColorField`].
//!
//! Missing: `function { }` as an image (`image_map { function W, H { } }`).

mod first_call;
mod fold;
mod graph;
pub mod internal;
mod interval;
mod lower;
mod number;
mod operation;
mod program;
#[cfg(test)]
mod tests;

pub use first_call::RidgedCalls;
pub use fold::{ChainTail, DivisionByZero, Form, Operand, chain, product};
pub use graph::{Block, Graph, Id};
pub use internal::Internal;
pub use interval::Interval;
pub use number::{Component, Fold, Number, Part};
pub use operation::{Binary, Unary};
pub use program::{Program, TooLarge};

use crate::base::args::{Args, Parse};
use crate::base::color::Color;
use crate::base::math::noise::NoiseGenerator;
use crate::base::math::{Spline, Transform};
use crate::base::source::Diagnostic;
use glam::DVec3;
use std::fmt::Debug;
use std::sync::Arc;

/// Limit on the parameters of a function, as in POV-Ray.
pub const MAX_PARAMETERS: usize = 56;
/// Limit on the operations of one evaluation. A few hundred million run in a second.
const MAX_COST: u64 = 10_000_000_000;
/// Limit on the bytes of stack of one evaluation; render threads have two million.
const MAX_STACK: usize = 250_000;

/// A scalar field in space, called by `function { pattern { ... } }`.
pub trait Field: Debug + Send + Sync {
    /// The number at a point.
    fn value(&self, point: DVec3) -> f64;
}

/// A colour field in space, called by `function { pigment { ... } }`.
pub trait ColorField: Debug + Send + Sync {
    /// The colour at a point.
    fn color(&self, point: DVec3) -> Color;
}

/// The definition of a function.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A formula.
    Program(Program),
    /// `internal(n)`.
    Internal(&'static Internal),
    /// `f_noise3d`: the noise of the scene.
    Noise(NoiseGenerator),
    /// `f_ridged_mf`.
    Ridged(Arc<RidgedCalls>),
    /// `pattern { ... }`.
    Field(Arc<dyn Field>),
    /// `pigment { ... }`.
    Color(Arc<dyn ColorField>),
    /// `transform { ... }`: maps a point.
    Transform(Transform),
    /// `spline { ... }`.
    Spline(Arc<Spline>),
}

/// A function of numbers.
#[derive(Clone, Debug)]
pub struct Function {
    kind: Kind,
    parameters: usize,
    cost: u64,
    stack: usize,
}

/// The reason for refusing a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// It needs too many registers, or its calls are nested too deeply.
    TooLarge,
    /// One evaluation takes too many operations.
    TooLong,
}

impl Function {
    /// The function of a finished graph.
    ///
    /// # Errors
    /// If the function is too large or takes too long.
    pub fn formula(graph: Graph, parameters: usize) -> Result<Self, Refusal> {
        let program = Program::new(graph, parameters).map_err(|TooLarge| Refusal::TooLarge)?;
        let (cost, stack) = (program.cost(), program.stack());
        if stack > MAX_STACK {
            return Err(Refusal::TooLarge);
        }
        if cost > MAX_COST {
            return Err(Refusal::TooLong);
        }
        Ok(Function {
            kind: Kind::Program(program),
            parameters,
            cost,
            stack,
        })
    }

    /// A function without a formula.
    #[must_use]
    pub fn of(kind: Kind) -> Self {
        let parameters = match &kind {
            Kind::Internal(internal) => internal.parameters(),
            Kind::Ridged(_) => 9,
            Kind::Spline(_) => 1,
            _ => 3,
        };
        Function {
            kind,
            parameters,
            // About the cost of a pattern; the limits only matter for loops over very many calls.
            cost: 10,
            stack: 1000,
        }
    }

    /// The definition of the function.
    #[must_use]
    pub fn kind(&self) -> &Kind {
        &self.kind
    }

    /// The number of parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.parameters
    }

    /// Returns true if the value is one number, not a vector or colour.
    #[must_use]
    pub fn is_scalar(&self) -> bool {
        matches!(
            self.kind,
            Kind::Program(_)
                | Kind::Internal(_)
                | Kind::Noise(_)
                | Kind::Ridged(_)
                | Kind::Field(_)
        )
    }

    /// The number of components of the value.
    #[must_use]
    pub fn components(&self) -> u8 {
        match &self.kind {
            Kind::Color(_) => 5,
            Kind::Transform(_) => 3,
            Kind::Spline(spline) => spline.components(),
            _ => 1,
        }
    }

    /// The value for one argument per parameter; the first component if it is a vector.
    #[inline(always)]
    #[must_use]
    pub fn eval(&self, arguments: &[f64]) -> f64 {
        match &self.kind {
            Kind::Program(program) => program.run(arguments),
            Kind::Internal(internal) => internal.value(arguments),
            Kind::Noise(noise) => noise.noise(point_of(arguments)),
            Kind::Ridged(calls) => calls.value(arguments),
            Kind::Field(field) => field.value(point_of(arguments)),
            _ => self.eval_vector(arguments)[0],
        }
    }

    /// The components of the value for one argument per parameter; unused ones are zero.
    #[must_use]
    pub fn eval_vector(&self, arguments: &[f64]) -> [f64; 5] {
        match &self.kind {
            Kind::Color(field) => {
                let color = field.color(point_of(arguments));
                let rgb = color.rgb;
                [rgb.r, rgb.g, rgb.b, color.filter, color.transmit].map(f64::from)
            }
            Kind::Transform(transform) => {
                let p = transform
                    .world_from_object
                    .transform_point3(point_of(arguments));
                [p.x, p.y, p.z, 0.0, 0.0]
            }
            Kind::Spline(spline) => spline.at(arguments.first().copied().unwrap_or(0.0)),
            _ => [self.eval(arguments), 0.0, 0.0, 0.0, 0.0],
        }
    }

    /// Bounds of the value over a box of arguments, one interval per parameter.
    #[must_use]
    pub fn bounds(&self, arguments: &[Interval]) -> Interval {
        <Interval as Number>::call(self, arguments, Component::At(0))
    }

    /// The approximate number of operations of one evaluation.
    fn cost(&self) -> u64 {
        self.cost
    }

    /// Bytes of stack of one evaluation.
    fn stack(&self) -> usize {
        self.stack
    }
}

fn point_of(arguments: &[f64]) -> DVec3 {
    let at = |i: usize| arguments.get(i).copied().unwrap_or(0.0);
    DVec3::new(at(0), at(1), at(2))
}

/// Reads the block after the word `function`; the parameters are `x, y, z` unless it names others.
///
/// # Errors
/// A malformed body.
pub fn read(args: &mut dyn Args) -> Parse<Arc<Function>> {
    let read = args.function_any()?;
    match read.and_then(|function| function.downcast().ok()) {
        Some(function) => Ok(function),
        None => Err(args.expected("a function")),
    }
}

/// Reads the block after the word `function` where the scene needs a scalar field in space.
///
/// # Errors
/// A malformed body, a function that does not take three numbers, or one whose value is not a number.
pub fn read_of_point(args: &mut dyn Args) -> Parse<Arc<Function>> {
    let function = read(args)?;
    let (wrong, hint) = if function.parameters() != 3 {
        (
            format!(
                "a function of three numbers is wanted here, this one takes {}",
                function.parameters()
            ),
            "Leave its parameters out: then they are `x, y, z`.",
        )
    } else if !function.is_scalar() {
        (
            "a function that gives one number is wanted here, this one gives a vector or colour"
                .to_owned(),
            "Declare it as `F`, and write a formula here: `function { F(x, y, z).gray }`.",
        )
    } else {
        return Ok(function);
    };
    Err(Box::new(
        Diagnostic::error(args.last_span(), wrong).with_hint(hint),
    ))
}
