//! A function body as a linear program on registers, and its interpreter.
//!
//! The operations are independent of the number type: the same program runs on `f64` and on any other [`Number`],
//! such as intervals. It uses no memory except the stack, so all threads share one program.

use super::Function;
use super::graph::Graph;
use super::number::{Component, Fold, MAX_ITERATIONS, Number};
use super::operation::{Binary, Unary};
use smallvec::SmallVec;
use std::sync::Arc;

/// The index of a register. The first registers hold the parameters.
pub(super) type Register = u16;

/// Limit on the registers of a program.
pub(super) const MAX_REGISTERS: usize = 2048;
/// Calls of at most this number of arguments allocate no memory.
const ARGUMENTS: usize = 12;

/// One operation; `to` is the destination, `k` a constant.
#[derive(Clone, Copy, Debug)]
#[rustfmt::skip]
pub(super) enum Op {
    Constant { to: Register, k: f64 },
    Add { to: Register, a: Register, b: Register },
    Sub { to: Register, a: Register, b: Register },
    Mul { to: Register, a: Register, b: Register },
    Square { to: Register, a: Register },
    Div { to: Register, a: Register, b: Register },
    AddTo { to: Register, a: Register, k: f64 },
    SubFrom { to: Register, a: Register, k: f64 },
    MulBy { to: Register, a: Register, k: f64 },
    DivInto { to: Register, a: Register, k: f64 },
    Unary { to: Register, a: Register, f: Unary },
    Binary { to: Register, a: Register, b: Register, f: Binary },
    /// Index in the list of calls.
    Call { to: Register, index: u32 },
    /// Index in the list of `select`s; the operations of the parts follow.
    Select { to: Register, test: Register, index: u32 },
    /// Index in the list of loops; the operations of the body follow.
    Loop { to: Register, index: u32 },
}

#[derive(Clone, Debug)]
pub(super) struct Call {
    pub(super) function: Arc<Function>,
    pub(super) component: Component,
    pub(super) arguments: Box<[Register]>,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Select {
    /// Start, end and value register of each part.
    pub(super) parts: [(u32, u32, Register); 3],
    pub(super) end: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Loop {
    pub(super) fold: Fold,
    pub(super) variable: Register,
    pub(super) from: Register,
    pub(super) to: Register,
    pub(super) end: u32,
    pub(super) value: Register,
    /// The number of iterations, if the bounds are constant.
    pub(super) iterations: Option<u32>,
}

/// A compiled body.
#[derive(Clone, Debug)]
pub struct Program {
    pub(super) ops: Vec<Op>,
    pub(super) calls: Vec<Call>,
    pub(super) selects: Vec<Select>,
    pub(super) loops: Vec<Loop>,
    pub(super) registers: usize,
    pub(super) result: Register,
    /// The graph of the body, if it is small enough to be inlined.
    pub(crate) graph: Option<Graph>,
}

/// The body needs more registers than a program can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge;

impl Program {
    /// A program without operations.
    pub(super) fn empty() -> Self {
        Program {
            ops: Vec::new(),
            calls: Vec::new(),
            selects: Vec::new(),
            loops: Vec::new(),
            registers: 0,
            result: 0,
            graph: None,
        }
    }

    /// The graph of the body, if it is small enough to be inlined.
    pub(super) fn small_graph(&self) -> Option<&Graph> {
        self.graph.as_ref()
    }

    /// The value for one argument per parameter.
    #[inline(always)]
    #[must_use]
    pub fn run<N: Number>(&self, arguments: &[N]) -> N {
        match self.registers {
            0..=16 => self.run_in::<N, 16>(arguments),
            17..=64 => self.run_in::<N, 64>(arguments),
            65..=256 => self.run_in::<N, 256>(arguments),
            _ => self.run_in_most_registers(arguments),
        }
    }

    /// Runs a program of more than 256 registers. Not inlined, so that its large frame is not set up for small ones.
    #[inline(never)]
    fn run_in_most_registers<N: Number>(&self, arguments: &[N]) -> N {
        self.run_in::<N, MAX_REGISTERS>(arguments)
    }

    /// Inlined, so that a known number of arguments is not copied by `memcpy`: isosurfaces took a quarter longer with it.
    #[inline(always)]
    fn run_in<N: Number, const SIZE: usize>(&self, arguments: &[N]) -> N {
        let mut frame = [N::constant(0.0); SIZE];
        for (register, argument) in frame.iter_mut().zip(arguments) {
            *register = *argument;
        }
        self.run_part(0, self.ops.len(), &mut frame);
        frame[usize::from(self.result) & (SIZE - 1)]
    }

    fn run_part<N: Number, const SIZE: usize>(
        &self,
        start: usize,
        end: usize,
        frame: &mut [N; SIZE],
    ) {
        // `SIZE` is a power of two above all register indices: the mask only removes the bounds check.
        let of = |frame: &[N; SIZE], register: Register| frame[usize::from(register) & (SIZE - 1)];
        let mut pc = start;
        while pc < end {
            let op = self.ops[pc];
            pc += 1;
            let (to, value) = match op {
                Op::Constant { to, k } => (to, N::constant(k)),
                Op::Add { to, a, b } => (to, of(frame, a) + of(frame, b)),
                Op::Sub { to, a, b } => (to, of(frame, a) - of(frame, b)),
                Op::Mul { to, a, b } => (to, of(frame, a) * of(frame, b)),
                Op::Square { to, a } => (to, of(frame, a).squared()),
                Op::Div { to, a, b } => (to, of(frame, a) / of(frame, b)),
                Op::AddTo { to, a, k } => (to, of(frame, a) + N::constant(k)),
                Op::SubFrom { to, a, k } => (to, N::constant(k) - of(frame, a)),
                Op::MulBy { to, a, k } => (to, of(frame, a) * N::constant(k)),
                Op::DivInto { to, a, k } => (to, N::constant(k) / of(frame, a)),
                Op::Unary { to, a, f } => (to, of(frame, a).unary(f)),
                Op::Binary { to, a, b, f } => (to, of(frame, a).binary(f, of(frame, b))),
                Op::Call { to, index } => {
                    let call = &self.calls[index as usize];
                    // Most functions are of a point.
                    let value = if let [x, y, z] = *call.arguments {
                        let point = [of(frame, x), of(frame, y), of(frame, z)];
                        N::call(&call.function, &point, call.component)
                    } else {
                        // No `SmallVec` is collected: it would be moved as a whole.
                        let mut arguments = [N::constant(0.0); ARGUMENTS];
                        match arguments.get_mut(..call.arguments.len()) {
                            Some(arguments) => {
                                for (argument, &a) in arguments.iter_mut().zip(&call.arguments) {
                                    *argument = of(frame, a);
                                }
                                N::call(&call.function, arguments, call.component)
                            }
                            None => {
                                let arguments: Vec<N> =
                                    call.arguments.iter().map(|&a| of(frame, a)).collect();
                                N::call(&call.function, &arguments, call.component)
                            }
                        }
                    };
                    (to, value)
                }
                Op::Select {
                    to,
                    test,
                    index: site,
                } => {
                    let site = self.selects[site as usize];
                    pc = site.end as usize;
                    let value = of(frame, test).select(|part| {
                        let (start, end, value) = site.parts[part as usize];
                        self.run_part(start as usize, end as usize, frame);
                        of(frame, value)
                    });
                    (to, value)
                }
                Op::Loop { to, index: site } => {
                    let loop_op = self.loops[site as usize];
                    let start = pc;
                    pc = loop_op.end as usize;
                    let (first, last) = (of(frame, loop_op.from), of(frame, loop_op.to));
                    let value = N::repeat(loop_op.fold, first, last, |variable| {
                        frame[usize::from(loop_op.variable) & (SIZE - 1)] = variable;
                        self.run_part(start, pc, frame);
                        of(frame, loop_op.value)
                    });
                    (to, value)
                }
            };
            frame[usize::from(to) & (SIZE - 1)] = value;
        }
    }

    /// The approximate number of operations of one evaluation, including called functions; a loop with an unknown
    /// number of iterations counts as one iteration.
    #[must_use]
    pub fn cost(&self) -> u64 {
        // For each enclosing loop, its end and its number of iterations.
        let mut enclosing: SmallVec<[(usize, u64); 4]> = SmallVec::new();
        let mut cost = 0u64;
        for (pc, op) in self.ops.iter().enumerate() {
            enclosing.retain(|(end, _)| pc < *end);
            let times = enclosing
                .iter()
                .fold(1u64, |n, (_, iterations)| n.saturating_mul(*iterations));
            let one = match op {
                Op::Call { index, .. } => self.calls[*index as usize].function.cost(),
                Op::Loop { index: site, .. } => {
                    let loop_op = self.loops[*site as usize];
                    let iterations = loop_op.iterations.unwrap_or(1).min(MAX_ITERATIONS);
                    enclosing.push((loop_op.end as usize, u64::from(iterations)));
                    1
                }
                _ => 1,
            };
            cost = cost.saturating_add(times.saturating_mul(one));
        }
        cost
    }

    /// Bytes of stack of one evaluation, including called functions.
    #[must_use]
    pub fn stack(&self) -> usize {
        let frame = match self.registers {
            0..=16 => 16,
            17..=64 => 64,
            65..=256 => 256,
            _ => MAX_REGISTERS,
        };
        let called = self.calls.iter().map(|call| call.function.stack());
        frame * size_of::<f64>() + CALL_BYTES + called.max().unwrap_or(0)
    }
}

/// Bytes of stack of a call without its registers; measured below 400.
const CALL_BYTES: usize = 600;
