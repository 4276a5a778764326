//! Steps of the expression being recorded.

use super::op::Op;
use super::stack::{DEPTH, SLOTS};
use crate::base::args::Word;
use crate::lang::expr::value::Number;
use crate::lang::frame::Macro;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

/// Limit on the steps of a program; a longer one saves no time.
pub(crate) const MAX_OPS: usize = 1000;

/// An expression while it is read for the first time.
#[derive(Debug)]
pub(in crate::lang) struct Recording {
    pub(crate) ops: Vec<Op>,
    /// The macros that were called, with their lengths in tokens.
    pub(crate) calls: Vec<(Symbol, Rc<Macro>)>,
    pub(crate) reread: usize,
    /// Number of floats that the steps leave on the stack, and the most that were there.
    pub(crate) depth: usize,
    pub(crate) deepest: usize,
    pub(crate) slots: usize,
    /// The bindings made by the calls, by symbol and index in its stack of bindings, with their sources.
    pub(crate) bound: Vec<((Symbol, usize), Source)>,
    /// Number of frames open at its start.
    pub(crate) frames: usize,
}

/// Where the steps of an expression read the value of an identifier.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Source {
    /// From the identifier.
    Name(Symbol),
    /// From a slot.
    Slot(u8),
}

impl Recording {
    /// An empty recording, with the number of frames open.
    pub(crate) fn new(frames: usize) -> Self {
        Recording {
            ops: Vec::new(),
            calls: Vec::new(),
            reread: 0,
            depth: 0,
            deepest: 0,
            slots: 0,
            bound: Vec::new(),
            frames,
        }
    }

    /// True if it is the whole of an expression with `len` components, which ends with `frames` frames open.
    pub(crate) fn is_whole(&self, len: u8, frames: usize) -> bool {
        self.depth == usize::from(len)
            && self.deepest <= DEPTH
            && self.slots <= SLOTS
            && self.ops.len() <= MAX_OPS
            && self.frames == frames
    }

    pub(in crate::lang) fn push(&mut self, op: Op) {
        let (taken, given) = op.effect();
        self.depth = self.depth.saturating_sub(usize::from(taken)) + usize::from(given);
        self.deepest = self.deepest.max(self.depth + usize::from(taken));
        if self.ops.len() <= MAX_OPS {
            self.ops.push(op);
        }
    }
}

#[derive(Debug)]
pub(crate) struct RecordedSphere {
    pub(crate) centre: Part,
    pub(crate) radius: Part,
    /// `rgb` or one of its kin, and the colour after it.
    pub(crate) color: Option<(Word, Part)>,
    /// The token after the last `}`.
    pub(crate) after: usize,
}

/// One of its numbers.
#[derive(Debug)]
pub(crate) enum Part {
    Literal(Number),
    /// A recorded expression, and the token after it.
    Program(u32, usize),
}
