//! Chains of operators of equal precedence, folded as POV-Ray folds them.
//!
//! POV-Ray parses `a + b - c` as a list and rewrites it before evaluation. This changes the last bits of results, and
//! in two cases the result itself. Measured with POV-Ray 3.7:
//! * `- k` with a literal number becomes `+ (-k)`; `/ k` after a non-constant operand becomes `* (1/k)`.
//! * In sums and comparisons, adjacent constants after the first operand are combined by the operator between them; the
//!   result keeps the operator on its left: `x + 1 - 2` is `x + (1 - 2)`. A product of constants is not negated, so
//!   `x - 3*5 - 2` is `x - (15 - 2)`, and `x = 2 = 1` is `x = (2 = 1)`.
//! * Parentheses and calls hide a constant from these rules.

use super::graph::{Graph, Id};
use super::operation::{Binary, Unary};
use smallvec::SmallVec;

/// The syntactic form of an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A number, possibly signed, or an identifier declared as one.
    Literal,
    /// Operations on literals, without parentheses.
    Folded,
    /// Anything else.
    Closed,
}

/// An operand of a chain.
#[derive(Clone, Copy, Debug)]
pub struct Operand {
    /// The value.
    pub id: Id,
    /// The syntactic form.
    pub form: Form,
}

/// The operators after the first operand of a chain, each with its right operand.
pub type ChainTail = SmallVec<[(Binary, Operand); 4]>;

/// A literal divisor is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DivisionByZero;

impl Operand {
    /// A literal number.
    pub fn literal(graph: &mut Graph, value: f64) -> Self {
        Operand {
            id: graph.constant(value),
            form: Form::Literal,
        }
    }

    /// An operand that is not a constant.
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

    fn is_constant(self) -> bool {
        self.form != Form::Closed
    }
}

/// `first * a / b ...`.
///
/// # Errors
/// If a non-constant operand is divided by a literal zero.
pub fn product(
    graph: &mut Graph,
    first: Operand,
    rest: &[(Binary, Operand)],
) -> Result<Operand, DivisionByZero> {
    let mut left = first;
    for &(f, right) in rest {
        let form = if left.is_constant() && right.is_constant() {
            Form::Folded
        } else {
            Form::Closed
        };
        let divisor = graph.constant_of(right.id);
        let id = match (f, divisor) {
            (Binary::Div, Some(k)) if right.form == Form::Literal && !left.is_constant() => {
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
            Some((before, number)) if right.is_constant() => {
                Some((before, combine(graph, number, f, right)))
            }
            Some((before, number)) => {
                left = combine(graph, left, before, number);
                left = combine(graph, left, f, right);
                None
            }
            None if right.is_constant() && !left.is_constant() => Some((f, right)),
            None => {
                left = combine(graph, left, f, right);
                None
            }
        };
    }
    match pending {
        Some((f, number)) => combine(graph, left, f, number),
        None => left,
    }
}

fn combine(graph: &mut Graph, left: Operand, f: Binary, right: Operand) -> Operand {
    let form = if left.is_constant() && right.is_constant() {
        Form::Folded
    } else {
        Form::Closed
    };
    Operand {
        id: graph.binary(f, left.id, right.id),
        form,
    }
}
