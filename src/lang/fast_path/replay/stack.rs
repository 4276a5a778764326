//! The interpreter of recorded expressions.

use super::op::{Binary, Op};
use crate::base::args::Word;
use crate::base::math::conditioning::Normalization;
use crate::lang::expr::builtins;
use crate::lang::expr::builtins::whole_index;
use crate::lang::expr::streams::Streams;
use crate::lang::expr::value::{Number, Value};
use crate::lang::limits::EQUAL;
use crate::lang::scope::Scopes;
use crate::lang::syntax::Symbol;

/// The stack of a replay. `Recording` has checked that it neither overflows nor underflows.
#[derive(Debug)]
pub(super) struct Stack {
    floats: [f64; DEPTH],
    top: usize,
    /// The arguments of the macros that the expression calls.
    slots: [Number; SLOTS],
    /// Streams that the replay has drawn from, with their earlier states.
    drawn: Vec<(usize, u32)>,
}

/// Floats that a program may hold at once; a power of two.
pub(super) const DEPTH: usize = 32;
/// Slots that a program may use; a power of two.
pub(super) const SLOTS: usize = 16;

impl Default for Stack {
    fn default() -> Self {
        Stack {
            floats: [0.0; DEPTH],
            top: 0,
            slots: [Number::float(0.0); SLOTS],
            drawn: Vec::new(),
        }
    }
}

impl Stack {
    /// Begins a replay, which succeeds or has no effect.
    pub(super) fn begin(&mut self) {
        self.drawn.clear();
    }

    /// Abandons a replay: the streams are reset.
    pub(super) fn give_up(&mut self, streams: &mut Streams) {
        while let Some((stream, state)) = self.drawn.pop() {
            streams.put_back(stream, state);
        }
    }

    /// Runs the steps of a program; `None` if its value has to be read from the tokens. The floats of the value are at
    /// the bottom of the stack.
    pub(super) fn run(&mut self, ops: &[Op], scopes: &Scopes, streams: &mut Streams) -> Option<()> {
        // The most frequent steps run here, where the top of the stack is held in a register.
        let mut top = 0;
        for op in ops {
            match *op {
                Op::Float(float) => {
                    self.floats[top % DEPTH] = float;
                    top += 1;
                }
                Op::Name(name, 1) => {
                    self.floats[top % DEPTH] = float(scopes, name)?;
                    top += 1;
                }
                Op::WithFloat(binary, right) => {
                    let left = &mut self.floats[top.wrapping_sub(1) % DEPTH];
                    *left = combined(binary, *left, right)?;
                }
                Op::WithName(binary, name) => {
                    let left = &mut self.floats[top.wrapping_sub(1) % DEPTH];
                    *left = combined(binary, *left, float(scopes, name)?)?;
                }
                Op::Binary(binary, 1, 1) => {
                    top = top.wrapping_sub(1);
                    let right = self.floats[top % DEPTH];
                    let left = &mut self.floats[top.wrapping_sub(1) % DEPTH];
                    *left = combined(binary, *left, right)?;
                }
                Op::One(Word::Sin) => {
                    let float = &mut self.floats[top.wrapping_sub(1) % DEPTH];
                    *float = float.sin();
                }
                Op::One(Word::Cos) => {
                    let float = &mut self.floats[top.wrapping_sub(1) % DEPTH];
                    *float = float.cos();
                }
                op => {
                    self.top = top;
                    self.step(op, scopes, streams)?;
                    top = self.top;
                }
            }
        }
        Some(())
    }

    /// The first float.
    #[inline]
    pub(super) fn first(&self) -> f64 {
        self.floats[0]
    }

    /// The first floats as a value.
    #[inline]
    pub(super) fn number(&self, len: u8) -> Number {
        let floats = &self.floats;
        match len {
            1 => Number::float(floats[0]),
            3 => Number {
                v: [floats[0], floats[1], floats[2], 0.0, 0.0],
                len,
            },
            _ => {
                let mut number = Number { v: [0.0; 5], len };
                for (to, from) in number.v.iter_mut().zip(floats).take(usize::from(len)) {
                    *to = *from;
                }
                number
            }
        }
    }

    /// Runs a step; `None` if it cannot be run.
    #[inline(never)]
    fn step(&mut self, op: Op, scopes: &Scopes, streams: &mut Streams) -> Option<()> {
        match op {
            Op::Float(float) => self.push(float),
            Op::Name(name, 1) => {
                let float = float(scopes, name)?;
                self.push(float);
            }
            Op::Name(name, len) => match scopes.get(name) {
                Some(Value::Number(number)) if number.len == len => self.push_all(number),
                _ => return None,
            },
            Op::Store(slot, len) => self.slots[usize::from(slot) % SLOTS] = self.take(len),
            Op::Load(slot, _) => {
                let number = self.slots[usize::from(slot) % SLOTS];
                self.push_all(&number);
            }
            Op::Item(name, indices, len) => {
                let number = item(scopes, name, self.last(indices))?;
                if number.len != len {
                    return None;
                }
                let number = *number;
                self.drop(indices);
                self.push_all(&number);
            }
            Op::WithFloat(binary, right) => {
                let left = self.pop();
                self.push(combined(binary, left, right)?);
            }
            Op::WithName(binary, name) => {
                let left = self.pop();
                self.push(combined(binary, left, float(scopes, name)?)?);
            }
            Op::Binary(binary, left, right) => self.combine(binary, left, right)?,
            Op::Negate(len) => self.change(len, |float| -float),
            Op::Not(len) => self.change(len, |float| f64::from(u8::from(float.abs() <= EQUAL))),
            Op::Member(len, at) => {
                let member = self.last(len)[usize::from(at)];
                self.drop(len);
                self.push(member);
            }
            Op::Grey(len) => {
                let grey = self.take(len).grey();
                self.push(grey);
            }
            Op::Promote(from, to) => {
                let number = self.take(from).promoted(to);
                self.push_all(&number);
            }
            Op::Choose(yes, no) => {
                let len = yes.max(no);
                let (no, yes) = (self.take(no), self.take(yes));
                let chosen = if self.pop().abs() > EQUAL { yes } else { no };
                self.push_all(&chosen.promoted(len));
            }
            Op::Min(count) => self.fold(count, f64::min),
            Op::Max(count) => self.fold(count, f64::max),
            Op::One(word) => {
                let a = self.pop();
                if builtins::is_outside(word, a) {
                    return None;
                }
                self.push(builtins::one(word, a).ok()?);
            }
            Op::Two(word) => {
                let b = self.pop();
                let a = self.pop();
                self.push(builtins::two(word, a, b).ok()?);
            }
            Op::Vectors(word) => {
                let degrees = match word {
                    Word::VaxisRotate => self.pop(),
                    _ => 0.0,
                };
                let a = match word {
                    Word::Vlength => self.take(3),
                    Word::Vnormalize => Some(self.take(3)).filter(|v| v.v != [0.0; 5])?,
                    _ => {
                        let b = self.take(3);
                        let a = self.take(3);
                        self.push_all(&builtins::vectors(word, a.xyz(), b.xyz(), degrees));
                        return Some(());
                    }
                };
                self.push_all(&builtins::vector(word, a.xyz(), Normalization::Reciprocal));
            }
            Op::Rand => {
                let handle = self.pop();
                let stream = streams.find(handle)?;
                self.drawn.push((stream, streams.state(stream)));
                let number = streams.draw(stream);
                self.push(number);
            }
        }
        Some(())
    }

    #[inline]
    fn push(&mut self, float: f64) {
        self.floats[self.top % DEPTH] = float;
        self.top += 1;
    }

    #[inline]
    fn push_all(&mut self, number: &Number) {
        for (at, &float) in number.v.iter().enumerate() {
            if at < usize::from(number.len) {
                self.push(float);
            }
        }
    }

    #[inline]
    fn pop(&mut self) -> f64 {
        self.top = self.top.wrapping_sub(1);
        self.floats[self.top % DEPTH]
    }

    #[inline]
    fn drop(&mut self, len: u8) {
        self.top = self.top.wrapping_sub(usize::from(len));
    }

    /// The floats on top.
    #[inline]
    fn last(&self, len: u8) -> &[f64] {
        &self.floats[self.top - usize::from(len)..self.top]
    }

    /// Pops the floats on top as a value.
    #[inline]
    fn take(&mut self, len: u8) -> Number {
        if len == 1 {
            return Number::float(self.pop());
        }
        self.drop(len);
        let mut number = Number { v: [0.0; 5], len };
        for (at, float) in number.v.iter_mut().enumerate() {
            if at < usize::from(len) {
                *float = self.floats[(self.top + at) % DEPTH];
            }
        }
        number
    }

    fn change(&mut self, len: u8, f: impl Fn(f64) -> f64) {
        let start = self.top - usize::from(len);
        for float in &mut self.floats[start..self.top] {
            *float = f(*float);
        }
    }

    /// Folds floats in the order in which `min` and `max` go through their arguments.
    fn fold(&mut self, count: u8, f: impl Fn(f64, f64) -> f64) {
        let all = self.last(count);
        let first = all.first().copied().unwrap_or_default();
        let best = all.iter().skip(1).fold(first, |best, &next| f(best, next));
        self.drop(count);
        self.push(best);
    }

    /// Combines two values that are not both floats; `None` if a divisor is zero.
    fn combine(&mut self, binary: Binary, left: u8, right: u8) -> Option<()> {
        let len = left.max(right);
        let right = self.take(right).promoted(len);
        let left = self.take(left).promoted(len);
        for (&a, &b) in left.v.iter().zip(&right.v).take(usize::from(len)) {
            if binary == Binary::Divide && b == 0.0 {
                return None;
            }
            self.push(binary.of(a, b));
        }
        Some(())
    }
}

/// Combines two floats; `None` if the second is a divisor of zero.
#[inline(always)]
pub(super) fn combined(binary: Binary, left: f64, right: f64) -> Option<f64> {
    match binary {
        Binary::Add => Some(left + right),
        Binary::Subtract => Some(left - right),
        Binary::Multiply => Some(left * right),
        Binary::Divide if right == 0.0 => None,
        Binary::Divide => Some(left / right),
        _ => Some(binary.of(left, right)),
    }
}

/// The float that an identifier holds, if it holds one.
#[inline]
pub(super) fn float(scopes: &Scopes, name: Symbol) -> Option<f64> {
    match scopes.get(name) {
        Some(Value::Number(number)) if number.len == 1 => Some(number.v[0]),
        _ => None,
    }
}

/// The item of an array, if it exists and is a number.
fn item<'a>(scopes: &'a Scopes, array: Symbol, indices: &[f64]) -> Option<&'a Number> {
    let Some(Value::Array(array)) = scopes.get(array) else {
        return None;
    };
    if array.sizes.len() != indices.len() {
        return None;
    }
    let mut at = 0;
    for (&index, &size) in indices.iter().zip(&array.sizes) {
        at = at * size + whole_index(index, size)?;
    }
    match array.items.get(at)? {
        Some(Value::Number(number)) => Some(number),
        _ => None,
    }
}
