//! User functions: `function { ... }`, compiled once and called often.
//!
//! A body is read into a [`Graph`], in which equal operations are one and small functions stand in place of their
//! calls, and becomes a [`Program`] on registers. The program runs on `f64` and on any other [`Number`], such as bounds.
//! What is no formula stands behind a trait: a pattern is a [`Field`], a pigment a [`ColorField`].
//!
//! Missing: `function { }` as an image (`image_map { function W, H { } }`).

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

pub use fold::{DivisionByZero, Form, Operand, Rest, chain, product};
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

/// Parameters that a function may have, as in POV-Ray.
pub const MOST_PARAMETERS: usize = 56;
/// Steps that one value may take. A second holds a few hundred million.
const MOST_COST: u64 = 10_000_000_000;
/// Bytes of stack that one value may take; the threads that draw have two million.
const MOST_STACK: usize = 250_000;

/// A number at each point of space: what `function { pattern { ... } }` calls.
pub trait Field: Debug + Send + Sync {
    /// The number at a point.
    fn value(&self, point: DVec3) -> f64;
}

/// A colour at each point of space: what `function { pigment { ... } }` calls.
pub trait ColorField: Debug + Send + Sync {
    /// The colour at a point.
    fn color(&self, point: DVec3) -> Color;
}

/// What a function computes.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A formula.
    Program(Program),
    /// `internal(n)`.
    Internal(&'static Internal),
    /// `f_noise3d`: the noise of the scene.
    Noise(NoiseGenerator),
    /// `pattern { ... }`.
    Field(Arc<dyn Field>),
    /// `pigment { ... }`.
    Color(Arc<dyn ColorField>),
    /// `transform { ... }`: where a point goes.
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

/// Why a function is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// It needs too many numbers at once, or its calls are nested too deep.
    TooLarge,
    /// One value would take too many steps.
    TooLong,
}

impl Function {
    /// The function of a finished graph.
    ///
    /// # Errors
    /// When it is too large or takes too long.
    pub fn formula(graph: Graph, parameters: usize) -> Result<Self, Refusal> {
        let program = Program::new(graph, parameters).map_err(|TooLarge| Refusal::TooLarge)?;
        let (cost, stack) = (program.cost(), program.stack());
        if stack > MOST_STACK {
            return Err(Refusal::TooLarge);
        }
        if cost > MOST_COST {
            return Err(Refusal::TooLong);
        }
        Ok(Function {
            kind: Kind::Program(program),
            parameters,
            cost,
            stack,
        })
    }

    /// A function that is no formula.
    #[must_use]
    pub fn of(kind: Kind) -> Self {
        let parameters = match &kind {
            Kind::Internal(internal) => internal.parameters(),
            Kind::Spline(_) => 1,
            _ => 3,
        };
        Function {
            kind,
            parameters,
            // About what a pattern takes; only sums of very many matter.
            cost: 10,
            stack: 1000,
        }
    }

    /// What it computes.
    #[must_use]
    pub fn kind(&self) -> &Kind {
        &self.kind
    }

    /// How many arguments it takes.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.parameters
    }

    /// Whether it gives one number; otherwise a vector or colour.
    #[must_use]
    pub fn is_scalar(&self) -> bool {
        matches!(
            self.kind,
            Kind::Program(_) | Kind::Internal(_) | Kind::Noise(_) | Kind::Field(_)
        )
    }

    /// The number of components of what it gives.
    #[must_use]
    pub fn components(&self) -> u8 {
        match &self.kind {
            Kind::Program(_) | Kind::Internal(_) | Kind::Noise(_) | Kind::Field(_) => 1,
            Kind::Color(_) => 5,
            Kind::Transform(_) => 3,
            Kind::Spline(spline) => spline.components(),
        }
    }

    /// The value for these arguments, of which there are as many as parameters; of a vector its first component.
    #[inline]
    #[must_use]
    pub fn eval(&self, arguments: &[f64]) -> f64 {
        match &self.kind {
            Kind::Program(program) => program.run(arguments),
            Kind::Internal(internal) => internal.value(arguments),
            Kind::Noise(noise) => noise.noise(point_of(arguments)),
            Kind::Field(field) => field.value(point_of(arguments)),
            _ => self.eval_vector(arguments)[0],
        }
    }

    /// The components for these arguments, of which there are as many as parameters; the further ones are zero.
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

    /// Bounds of the values for arguments within these bounds, of which there are as many as parameters.
    #[must_use]
    pub fn bounds(&self, arguments: &[Interval]) -> Interval {
        <Interval as Number>::call(self, arguments, Component::At(0))
    }

    /// About how many steps a value takes.
    fn cost(&self) -> u64 {
        self.cost
    }

    /// Bytes of stack that a value takes.
    fn stack(&self) -> usize {
        self.stack
    }
}

fn point_of(arguments: &[f64]) -> DVec3 {
    let at = |i: usize| arguments.get(i).copied().unwrap_or(0.0);
    DVec3::new(at(0), at(1), at(2))
}

/// The function in the block that follows the word `function`, with the parameters `x, y, z` if it names no others.
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

/// The function in the block that follows the word `function`, where a number for each point of space is wanted.
///
/// # Errors
/// A malformed body, or a function of other than three numbers, or one that gives no number.
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
