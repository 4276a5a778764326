//! Chains of operators of one level, put together as POV-Ray puts them together.
//!
//! POV-Ray reads `a + b - c` as a list and rewrites it before it computes anything, which changes the last bits of results,
//! and in two cases the result itself. Measured with POV-Ray 3.7:
//! * `- k` with a written number becomes `+ (-k)`, and `/ k` behind something that varies becomes `* (1/k)`.
//! * In sums and comparisons, neighbours that are numbers, but for the first of the list, are combined with each other by
//!   the sign of the right one, and keep the sign of the left one: `x + 1 - 2` is `x + (1 - 2)`. As products of numbers
//!   keep their minus sign, `x - 3*5 - 2` is `x - (15 - 2)`, and `x = 2 = 1` is `x = (2 = 1)`.
//! * Parentheses and calls hide a number from this.

use super::graph::{Graph, Id};
use super::operation::{Binary, Unary};
use smallvec::SmallVec;

/// How an operand is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A number, perhaps with a sign, or a name that stands for one.
    Literal,
    /// Operations on such numbers, without parentheses.
    Folded,
    /// Anything else.
    Closed,
}

/// A value in a chain.
#[derive(Clone, Copy, Debug)]
pub struct Operand {
    /// The value.
    pub id: Id,
    /// How it is written.
    pub form: Form,
}

/// The operators of a chain behind its first operand, each with its right operand.
pub type Rest = SmallVec<[(Binary, Operand); 4]>;

/// A written divisor is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DivisionByZero;

impl Operand {
    /// A number as it is written.
    pub fn literal(graph: &mut Graph, value: f64) -> Self {
        Operand {
            id: graph.constant(value),
            form: Form::Literal,
        }
    }

    /// What is no written number.
    #[must_use]
    pub fn closed(id: Id) -> Self {
        Operand {
            id,
            form: Form::Closed,
        }
    }

    /// The operand with a minus sign in front.
    #[must_use]
    pub fn negated(self, graph: &mut Graph) -> Self {
        Operand {
            id: graph.unary(Unary::Negative, self.id),
            ..self
        }
    }

    fn is_number(self) -> bool {
        self.form != Form::Closed
    }
}

/// `first * a / b ...`.
///
/// # Errors
/// When something that varies is divided by a written zero.
pub fn product(
    graph: &mut Graph,
    first: Operand,
    rest: &[(Binary, Operand)],
) -> Result<Operand, DivisionByZero> {
    let mut left = first;
    for &(f, right) in rest {
        let form = if left.is_number() && right.is_number() {
            Form::Folded
        } else {
            Form::Closed
        };
        let divisor = graph.constant_of(right.id);
        let id = match (f, divisor) {
            (Binary::Div, Some(k)) if right.form == Form::Literal && !left.is_number() => {
                if k == 0.0 {
                    return Err(DivisionByZero);
                }
                let factor = graph.constant(1.0 / k);
                graph.binary(Binary::Mul, left.id, factor)
            }
            _ => graph.binary(f, left.id, right.id),
        };
        left = Operand { id, form };
    }
    Ok(left)
}

/// `first + a - b ...` or `first < a = b ...`.
pub fn chain(graph: &mut Graph, first: Operand, rest: &[(Binary, Operand)]) -> Operand {
    let mut left = first;
    let mut pending: Option<(Binary, Operand)> = None;
    for &(f, right) in rest {
        let (f, right) = match f {
            Binary::Sub if right.form == Form::Literal => (Binary::Add, right.negated(graph)),
            _ => (f, right),
        };
        pending = match pending {
            Some((before, number)) if right.is_number() => {
                Some((before, combined(graph, number, f, right)))
            }
            Some((before, number)) => {
                left = combined(graph, left, before, number);
                left = combined(graph, left, f, right);
                None
            }
            None if right.is_number() && !left.is_number() => Some((f, right)),
            None => {
                left = combined(graph, left, f, right);
                None
            }
        };
    }
    match pending {
        Some((f, number)) => combined(graph, left, f, number),
        None => left,
    }
}

fn combined(graph: &mut Graph, left: Operand, f: Binary, right: Operand) -> Operand {
    let form = if left.is_number() && right.is_number() {
        Form::Folded
    } else {
        Form::Closed
    };
    Operand {
        id: graph.binary(f, left.id, right.id),
        form,
    }
}
