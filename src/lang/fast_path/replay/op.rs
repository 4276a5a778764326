//! The steps that expressions are recorded in.

use crate::base::args::Word;
use crate::lang::directive::flow::EQUAL;
use crate::lang::expr::builtins;
use crate::lang::syntax::Symbol;

/// A step on a stack of floats, on which a vector is its components, the first one lowest.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Op {
    /// Pushes a float.
    Float(f64),
    /// Pushes what an identifier holds, which is to have so many components.
    Name(Symbol, u8),
    /// Keeps a value of so many components in a slot: the argument of a macro.
    Store(u8, u8),
    /// Pushes the value of a slot.
    Load(u8, u8),
    /// Takes so many indices, and pushes the item of an array, which is to have so many components.
    Item(Symbol, u8, u8),
    /// Combines two values with so many components.
    Binary(Binary, u8, u8),
    /// Combines the float on top with another one.
    WithFloat(Binary, f64),
    /// Combines the float on top with the one that an identifier holds.
    WithName(Binary, Symbol),
    /// Turns the sign of so many components.
    Negate(u8),
    /// Takes so many components for truths and turns them.
    Not(u8),
    /// Of so many components leaves that with an index.
    Member(u8, u8),
    /// The grey of so many components.
    Grey(u8),
    /// Gives a value with so many components so many more that it is as long as the second says.
    Promote(u8, u8),
    /// Of a test and two values of so many components leaves one value.
    Choose(u8, u8),
    /// The least of so many floats.
    Min(u8),
    /// The greatest of so many floats.
    Max(u8),
    /// A function of one float.
    One(Word),
    /// A function of two floats.
    Two(Word),
    /// A function of vectors.
    Vectors(Word),
    /// The next number of a stream.
    Rand,
}

/// How two values are combined, component by component.
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

/// The same steps, fewer where one does for two.
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
    /// The step of a call, if calls of this function can be repeated; `min` and `max` note theirs themselves.
    pub(in crate::lang) fn of_call(word: Word) -> Option<Op> {
        match word {
            Word::Rand => Some(Op::Rand),
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

    /// How many floats it takes, and how many it pushes.
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
