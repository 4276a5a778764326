//! The steps of recorded expressions.

use crate::base::args::Word;
use crate::base::math::conditioning::Normalization;
use crate::lang::expr::builtins;
use crate::lang::limits::EQUAL;
use crate::lang::syntax::Symbol;

/// A step on a stack of floats. A vector is its components, the first one lowest; its length is their number.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Op {
    /// Pushes a float.
    Float(f64),
    /// Pushes the value of an identifier, which must have this many components.
    Name(Symbol, u8),
    /// Pops a value and stores it in a slot (slot, length): the argument of a macro.
    Store(u8, u8),
    /// Pushes the value of a slot (slot, length).
    Load(u8, u8),
    /// Pops indices and pushes the item of an array (number of indices, length).
    Item(Symbol, u8, u8),
    /// Combines two values of these lengths.
    Binary(Binary, u8, u8),
    /// Combines the float on top with a constant.
    WithFloat(Binary, f64),
    /// Combines the float on top with that of an identifier.
    WithName(Binary, Symbol),
    /// Negates a value of this length.
    Negate(u8),
    /// Replaces each component of a value of this length by its logical negation.
    Not(u8),
    /// Replaces a value by one of its components (length, index).
    Member(u8, u8),
    /// Replaces a colour of this length by its grey value.
    Grey(u8),
    /// Promotes a value from the first length to the second.
    Promote(u8, u8),
    /// Replaces a test and two values of these lengths by one of the values.
    Choose(u8, u8),
    /// The least of this many floats.
    Min(u8),
    /// The greatest of this many floats.
    Max(u8),
    /// A function of one float.
    One(Word),
    /// A function of two floats.
    Two(Word),
    /// A function of vectors.
    Vectors(Word),
    /// Replaces the handle of a stream by its next number.
    Rand,
}

/// An operator on two values, component by component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::lang) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    And,
    Or,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    GreaterEqual,
    Greater,
}

impl Binary {
    /// On two floats. Equality, and the two relations that include it, allow for rounding.
    #[inline]
    pub(in crate::lang) fn of(self, a: f64, b: f64) -> f64 {
        let truth = |is_so: bool| f64::from(u8::from(is_so));
        match self {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide if b == 0.0 => f64::INFINITY,
            Binary::Divide => a / b,
            Binary::And => truth(a.abs() > EQUAL && b.abs() > EQUAL),
            Binary::Or => truth(a.abs() > EQUAL || b.abs() > EQUAL),
            Binary::Less => truth(a < b),
            Binary::LessEqual => truth(a <= b + EQUAL),
            Binary::Equal => truth((a - b).abs() <= EQUAL),
            Binary::NotEqual => truth((a - b).abs() > EQUAL),
            Binary::GreaterEqual => truth(a + EQUAL >= b),
            Binary::Greater => truth(a > b),
        }
    }
}

/// The same steps, fewer where one replaces two.
pub(super) fn fused(ops: Vec<Op>) -> Box<[Op]> {
    let mut fewer: Vec<Op> = Vec::with_capacity(ops.len());
    for op in ops {
        let one = match (fewer.last(), op) {
            (Some(&Op::Float(float)), Op::Binary(binary, 1, 1)) => Op::WithFloat(binary, float),
            (Some(&Op::Name(name, 1)), Op::Binary(binary, 1, 1)) => Op::WithName(binary, name),
            (Some(&Op::Float(float)), Op::Negate(1)) => Op::Float(-float),
            _ => {
                fewer.push(op);
                continue;
            }
        };
        fewer.pop();
        fewer.push(one);
    }
    fewer.into()
}

impl Op {
    /// The step of a call, if calls of this function can be replayed, which unit vectors of version 3.8 are not; `min`
    /// and `max` record theirs themselves.
    pub(in crate::lang) fn of_call(word: Word, normalization: Normalization) -> Option<Op> {
        match word {
            Word::Rand => Some(Op::Rand),
            Word::Vnormalize if normalization != Normalization::Reciprocal => None,
            Word::Vlength
            | Word::Vnormalize
            | Word::Vdot
            | Word::Vcross
            | Word::Vrotate
            | Word::VaxisRotate => Some(Op::Vectors(word)),
            _ if builtins::is_of_one(word) => Some(Op::One(word)),
            _ if builtins::is_of_two(word) => Some(Op::Two(word)),
            _ => None,
        }
    }

    /// Number of floats it pops, and number it pushes.
    pub(super) fn effect(self) -> (u8, u8) {
        match self {
            Op::Float(_) => (0, 1),
            Op::Name(_, len) | Op::Load(_, len) => (0, len),
            Op::Store(_, len) => (len, 0),
            Op::Item(_, indices, len) => (indices, len),
            Op::Binary(_, a, b) => (a + b, a.max(b)),
            Op::WithFloat(..) | Op::WithName(..) => (1, 1),
            Op::Negate(len) | Op::Not(len) => (len, len),
            Op::Member(len, _) | Op::Grey(len) | Op::Min(len) | Op::Max(len) => (len, 1),
            Op::Promote(from, to) => (from, to),
            Op::Choose(yes, no) => (1 + yes + no, yes.max(no)),
            Op::One(_) | Op::Rand => (1, 1),
            Op::Two(_) => (2, 1),
            Op::Vectors(Word::Vlength) => (3, 1),
            Op::Vectors(Word::Vnormalize) => (3, 3),
            Op::Vectors(Word::Vdot) => (6, 1),
            Op::Vectors(Word::VaxisRotate) => (7, 3),
            Op::Vectors(_) => (6, 3),
        }
    }
}
