//! A function body as a list of operations on registers, and running it.
//!
//! The operations know nothing of the numbers they work on: the same list runs on `f64` and on every other
//! [`Number`], such as bounds of all values in a box. Running takes no memory but the stack, so that one program serves
//! all threads.

use super::Function;
use super::graph::{Graph, SMALL};
use super::lower;
use super::number::{Component, Fold, MOST_ROUNDS, Number};
use super::operation::{Binary, Unary};
use smallvec::SmallVec;
use std::sync::Arc;

/// A place for a number while a program runs. The parameters lie in the first ones.
pub(super) type Register = u16;

/// Programs that need more registers at once are refused.
pub(super) const MOST_REGISTERS: usize = 2048;
/// Arguments of a call up to which no memory is taken.
const ARGUMENTS: usize = 16;

/// One operation; `k` is a number that the body writes.
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
    /// By its place in the list of calls.
    Call { to: Register, at: u32 },
    /// By its place in the list of `select`s; the operations of the parts follow.
    Select { to: Register, test: Register, at: u32 },
    /// By its place in the list of loops; the operations of the body follow.
    Loop { to: Register, at: u32 },
}

#[derive(Clone, Debug)]
pub(super) struct Call {
    pub(super) function: Arc<Function>,
    pub(super) component: Component,
    pub(super) arguments: Box<[Register]>,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Select {
    /// For each part where it starts and ends, and the register of its value.
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
    /// How often it runs, if the body says so in numbers.
    pub(super) rounds: Option<u32>,
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
    /// The graph it was made from, if that is small enough to stand in place of a call.
    graph: Option<Graph>,
}

/// The body needs more numbers at once than a program can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge;

impl Program {
    /// The program of a finished graph that has `parameters`.
    ///
    /// # Errors
    /// When it needs too many registers.
    pub fn new(graph: Graph, parameters: usize) -> Result<Self, TooLarge> {
        let mut program = lower::lower(&graph, parameters)?;
        program.graph = (graph.nodes.len() <= SMALL).then_some(graph);
        Ok(program)
    }

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

    /// The body as it can stand in place of a call.
    pub(super) fn small_graph(&self) -> Option<&Graph> {
        self.graph.as_ref()
    }

    /// The value for these arguments, of which there are as many as parameters.
    #[inline]
    #[must_use]
    pub fn run<N: Number>(&self, arguments: &[N]) -> N {
        match self.registers {
            0..=16 => self.run_in::<N, 16>(arguments),
            17..=64 => self.run_in::<N, 64>(arguments),
            65..=256 => self.run_in::<N, 256>(arguments),
            _ => self.run_in::<N, MOST_REGISTERS>(arguments),
        }
    }

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
        // All sizes are powers of two, and registers are below them: the mask only tells the compiler so.
        let of = |frame: &[N; SIZE], register: Register| frame[usize::from(register) & (SIZE - 1)];
        let mut at = start;
        while at < end {
            let op = self.ops[at];
            at += 1;
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
                Op::Call { to, at } => {
                    let call = &self.calls[at as usize];
                    let value = match *call.arguments {
                        // A point, as most functions take.
                        [x, y, z] => {
                            let point = [of(frame, x), of(frame, y), of(frame, z)];
                            N::call(&call.function, &point, call.component)
                        }
                        _ => {
                            let arguments: SmallVec<[N; ARGUMENTS]> =
                                call.arguments.iter().map(|&a| of(frame, a)).collect();
                            N::call(&call.function, &arguments, call.component)
                        }
                    };
                    (to, value)
                }
                Op::Select { to, test, at: site } => {
                    let site = self.selects[site as usize];
                    at = site.end as usize;
                    let value = of(frame, test).select(|part| {
                        let (start, end, value) = site.parts[part as usize];
                        self.run_part(start as usize, end as usize, frame);
                        of(frame, value)
                    });
                    (to, value)
                }
                Op::Loop { to, at: site } => {
                    let run = self.loops[site as usize];
                    let start = at;
                    at = run.end as usize;
                    let (first, last) = (of(frame, run.from), of(frame, run.to));
                    let value = N::repeat(run.fold, first, last, |variable| {
                        frame[usize::from(run.variable) & (SIZE - 1)] = variable;
                        self.run_part(start, at, frame);
                        of(frame, run.value)
                    });
                    (to, value)
                }
            };
            frame[usize::from(to) & (SIZE - 1)] = value;
        }
    }

    /// About how many operations one value takes, those of called functions included; loops whose number of rounds is
    /// not known count as one round.
    #[must_use]
    pub fn cost(&self) -> u64 {
        // What the operations at hand run in: the end of each loop, and how often it runs.
        let mut around: SmallVec<[(usize, u64); 4]> = SmallVec::new();
        let mut cost = 0u64;
        for (at, op) in self.ops.iter().enumerate() {
            around.retain(|(end, _)| at < *end);
            let times = around
                .iter()
                .fold(1u64, |n, (_, rounds)| n.saturating_mul(*rounds));
            let one = match op {
                Op::Call { at, .. } => self.calls[*at as usize].function.cost(),
                Op::Loop { at: site, .. } => {
                    let run = self.loops[*site as usize];
                    let rounds = run.rounds.unwrap_or(1).min(MOST_ROUNDS);
                    around.push((run.end as usize, u64::from(rounds)));
                    1
                }
                _ => 1,
            };
            cost = cost.saturating_add(times.saturating_mul(one));
        }
        cost
    }

    /// Bytes of stack that running takes, those of called functions included.
    #[must_use]
    pub fn stack(&self) -> usize {
        let frame = match self.registers {
            0..=16 => 16,
            17..=64 => 64,
            65..=256 => 256,
            _ => MOST_REGISTERS,
        };
        let called = self.calls.iter().map(|call| call.function.stack());
        frame * size_of::<f64>() + CALL_BYTES + called.max().unwrap_or(0)
    }
}

/// Bytes of stack that a call takes beside its registers; measured below 400.
const CALL_BYTES: usize = 600;
