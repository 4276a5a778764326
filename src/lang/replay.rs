//! Expressions that are evaluated again: recorded once, then replayed without looking at a token.
//!
//! While an expression is read in a loop or a macro, each step of its evaluation is noted, with the number of
//! components of its operands. An expression has no branches (`? :` evaluates both sides), so the notes are a program
//! for a stack of floats, and there is no second grammar. The program is kept under the place of the first token.
//!
//! A replay gives up, and the tokens are read again, wherever something is not as it was recorded or an error or a
//! warning is due: an identifier holds something else, an index is out of range, a divisor is zero. Up to there it
//! has changed nothing but streams of random numbers, which are put back. So a replay means what the tokens mean.
//!
//! Not recorded is what cannot be repeated in this way: expressions in which a directive runs, a macro is called or a
//! file ends, strings, and the functions that [`Op::of_call`] does not know. What their parts hold is recorded alone.

use super::cursor::is_bare_directive;
use super::flow::EQUAL;
use super::functions;
use super::reader::Reader;
use super::scope::Scopes;
use super::value::{Number, Value};
use crate::args::{Parse, Word};
use crate::source::FileId;
use crate::syntax::{Kind, Symbol};

/// Floats that a program may keep at once; a power of two.
const DEPTH: usize = 32;
/// After so many replays that gave up, an expression is no longer recorded.
const MOST_MISSES: u8 = 50;
/// Tokens of a page of [`Replays`].
const PAGE: usize = 32;

/// Where in the grammar an expression begins. At one token there may be one of each.
#[derive(Clone, Copy, Debug)]
pub(super) enum Level {
    /// With comparisons, logic and `? :`.
    Full,
    /// With `+` and `-`.
    Sum,
    /// With `*` and `/`.
    Product,
}

/// A step on a stack of floats, on which a vector is its components, the first one lowest.
#[derive(Clone, Copy, Debug)]
pub(super) enum Op {
    /// Pushes a float.
    Float(f64),
    /// Pushes what an identifier holds, which is to have so many components.
    Name(Symbol, u8),
    /// Takes so many indices, and pushes the item of an array, which is to have so many components.
    Item(Symbol, u8, u8),
    /// Combines two values with so many components.
    Binary(Binary, u8, u8),
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
pub(super) enum Binary {
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
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
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

impl Op {
    /// The step of a call, if calls of this function can be repeated; `min` and `max` note theirs themselves.
    pub(super) fn of_call(word: Word) -> Option<Op> {
        match word {
            Word::Rand => Some(Op::Rand),
            Word::Vlength
            | Word::Vnormalize
            | Word::Vdot
            | Word::Vcross
            | Word::Vrotate
            | Word::VaxisRotate => Some(Op::Vectors(word)),
            _ if functions::is_of_one(word) => Some(Op::One(word)),
            _ if functions::is_of_two(word) => Some(Op::Two(word)),
            _ => None,
        }
    }

    /// How many floats it takes, and how many it pushes.
    fn effect(self) -> (u8, u8) {
        match self {
            Op::Float(_) => (0, 1),
            Op::Name(_, len) => (0, len),
            Op::Item(_, indices, len) => (indices, len),
            Op::Binary(_, a, b) => (a + b, a.max(b)),
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

/// An expression while it is read for the first time.
#[derive(Debug, Default)]
pub(super) struct Recording {
    ops: Vec<Op>,
    depth: usize,
    deepest: usize,
}

/// A recorded expression.
#[derive(Debug)]
struct Program {
    ops: Box<[Op]>,
    /// How many components it gives.
    len: u8,
    /// The token behind it.
    after: usize,
    /// The identifier that stands there: if it is a macro, the expression goes on in its body.
    behind: Option<Symbol>,
    misses: u8,
}

/// What is known of the expressions that begin at a token, one for each [`Level`].
#[derive(Clone, Copy, Debug, Default)]
enum Known {
    #[default]
    Nothing,
    /// It cannot be recorded.
    Never,
    /// The index of its program.
    Program(u32),
}

/// Steps of a [`Level`] for the tokens of a page.
type Page = [[Known; 3]; PAGE];

/// All recorded expressions of a run.
#[derive(Debug, Default)]
pub(super) struct Replays {
    /// For each file its pages, made when something in them is recorded.
    files: Vec<Vec<Option<Box<Page>>>>,
    programs: Vec<Program>,
    stack: Stack,
    /// Streams that the current replay has drawn from, with the states that they had.
    drawn: Vec<(usize, u32)>,
}

impl Replays {
    #[inline]
    fn known(&self, file: FileId, at: usize, level: Level) -> Known {
        let pages = self.files.get(file.0 as usize);
        match pages.and_then(|pages| pages.get(at / PAGE)) {
            Some(Some(page)) => page[at % PAGE][level as usize],
            _ => Known::Nothing,
        }
    }

    fn set(&mut self, file: FileId, at: usize, level: Level, known: Known) {
        let file = file.0 as usize;
        if self.files.len() <= file {
            self.files.resize_with(file + 1, Vec::new);
        }
        let pages = &mut self.files[file];
        if pages.len() <= at / PAGE {
            pages.resize_with(at / PAGE + 1, || None);
        }
        let page = pages[at / PAGE].get_or_insert_default();
        page[at % PAGE][level as usize] = known;
    }
}

impl Reader<'_> {
    /// Reads the expression at hand, or replays it if it was recorded here.
    #[inline]
    pub(super) fn replayed(
        &mut self,
        level: Level,
        read: fn(&mut Self) -> Parse<Number>,
    ) -> Parse<Number> {
        if self.recording.is_some() {
            return read(self);
        }
        // Macro calls and directives before the expression are no part of it.
        self.peek()?;
        let file = self.here.tokens.file;
        match self.replays.known(file, self.here.at, level) {
            Known::Never => read(self),
            Known::Nothing if !self.is_repeated() => read(self),
            Known::Nothing => self.keep_steps(level, None, read),
            Known::Program(index) => match self.replay(index as usize) {
                Some(number) => Ok(number),
                None => self.keep_steps(level, Some(index), read),
            },
        }
    }

    /// Notes a step of the expression that is being read.
    #[inline]
    pub(super) fn note(&mut self, op: Op) {
        if let Some(recording) = &mut self.recording {
            let (taken, given) = op.effect();
            recording.depth = (recording.depth + usize::from(given))
                .checked_sub(usize::from(taken))
                .unwrap_or(usize::MAX / 2);
            recording.deepest = recording.deepest.max(recording.depth + usize::from(taken));
            recording.ops.push(op);
        }
    }

    /// Notes what a word of the language stands for.
    pub(super) fn note_constant(&mut self, word: Word, number: &Number) {
        if word == Word::Version {
            self.spoil();
        }
        for &float in &number.v[..usize::from(number.len)] {
            self.note(Op::Float(float));
        }
    }

    /// Notes an item of an array with so many dimensions whose indices have been noted since there were `before`
    /// floats.
    pub(super) fn note_item(&mut self, array: Symbol, before: usize, dimensions: usize, len: u8) {
        if self.noted() != before + dimensions {
            // An item of an array within an array.
            self.spoil();
        }
        self.note(Op::Item(array, dimensions as u8, len));
    }

    /// How many floats the noted steps leave.
    pub(super) fn noted(&self) -> usize {
        self.recording
            .as_ref()
            .map_or(0, |recording| recording.depth)
    }

    /// Says that what is being read cannot be repeated by notes.
    #[inline]
    pub(super) fn spoil(&mut self) {
        self.recording = None;
    }

    /// Reads the expression at hand and keeps its steps, in place of those of the program `old`.
    fn keep_steps(
        &mut self,
        level: Level,
        old: Option<u32>,
        read: fn(&mut Self) -> Parse<Number>,
    ) -> Parse<Number> {
        let (file, start) = (self.here.tokens.file, self.here.at);
        self.recording = Some(Recording::default());
        let number = read(self);
        let recording = self.recording.take();
        let number = number?;
        let program = recording.and_then(|recording| self.program(recording, number.len));
        let known = match (program, old) {
            (None, _) => Known::Never,
            (Some(program), None) => match u32::try_from(self.replays.programs.len()) {
                Ok(index) => {
                    self.replays.programs.push(program);
                    Known::Program(index)
                }
                Err(_) => Known::Never,
            },
            (Some(mut program), Some(index)) => {
                let old = &mut self.replays.programs[index as usize];
                program.misses = old.misses.saturating_add(1);
                let is_hopeless = program.misses > MOST_MISSES;
                *old = program;
                if is_hopeless {
                    Known::Never
                } else {
                    Known::Program(index)
                }
            }
        };
        self.replays.set(file, start, level, known);
        Ok(number)
    }

    /// The program of what was noted, if nothing behind the expression stands against it.
    fn program(&self, recording: Recording, len: u8) -> Option<Program> {
        let behind = self.raw();
        let is_quiet = match behind.kind {
            Kind::Directive | Kind::End => false,
            Kind::Word => !is_bare_directive(behind),
            _ => true,
        };
        let is_whole = recording.depth == usize::from(len) && recording.deepest <= DEPTH;
        (is_quiet && is_whole).then(|| Program {
            ops: recording.ops.into(),
            len,
            after: self.here.at,
            behind: behind.symbol(),
            misses: 0,
        })
    }

    /// The value of a recorded expression; `None`, and nothing changed, if it has to be read.
    fn replay(&mut self, index: usize) -> Option<Number> {
        let Replays {
            programs,
            stack,
            drawn,
            ..
        } = &mut self.replays;
        let program = &programs[index];
        let (len, after) = (program.len, program.after);
        if let Some(name) = program.behind
            && matches!(self.scopes.get(name), Some(Value::Macro(_)))
        {
            return None;
        }
        stack.top = 0;
        drawn.clear();
        for &op in program.ops.iter() {
            if stack
                .step(op, &self.scopes, &mut self.streams, drawn)
                .is_none()
            {
                while let Some((stream, state)) = drawn.pop() {
                    self.streams[stream] = state;
                }
                return None;
            }
        }
        let mut number = Number { v: [0.0; 5], len };
        number.v[..usize::from(len)].copy_from_slice(stack.last(len));
        self.here.at = after - 1;
        self.pass();
        Some(number)
    }
}

/// The floats of a replay. [`Recording`] has seen to it that they are enough and not too many.
#[derive(Debug, Default)]
struct Stack {
    floats: [f64; DEPTH],
    top: usize,
}

impl Stack {
    /// Takes a step; `None` if it cannot be taken.
    #[inline]
    fn step(
        &mut self,
        op: Op,
        scopes: &Scopes,
        streams: &mut [u32],
        drawn: &mut Vec<(usize, u32)>,
    ) -> Option<()> {
        match op {
            Op::Float(float) => self.push(float),
            Op::Name(name, len) => match scopes.get(name) {
                Some(Value::Number(number)) if number.len == len => self.push_all(number),
                _ => return None,
            },
            Op::Item(name, indices, len) => {
                let number = item(scopes, name, self.last(indices))?;
                if number.len != len {
                    return None;
                }
                let number = *number;
                self.drop(indices);
                self.push_all(&number);
            }
            Op::Binary(binary, 1, 1) => {
                let right = self.pop();
                if binary == Binary::Divide && right == 0.0 {
                    return None;
                }
                let left = self.pop();
                self.push(binary.of(left, right));
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
                if functions::is_outside(word, a) {
                    return None;
                }
                self.push(functions::one(word, a).ok()?);
            }
            Op::Two(word) => {
                let b = self.pop();
                let a = self.pop();
                self.push(functions::two(word, a, b).ok()?);
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
                        self.push_all(&functions::vectors(word, a.xyz(), b.xyz(), degrees));
                        return Some(());
                    }
                };
                self.push_all(&functions::vector(word, a.xyz()));
            }
            Op::Rand => {
                let handle = self.pop();
                let stream = functions::stream(handle, streams)?;
                let state = streams[stream];
                drawn.push((stream, state));
                let number = functions::draw(&mut streams[stream]);
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
        for &float in &number.v[..usize::from(number.len)] {
            self.push(float);
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

    /// Takes the floats on top as a value.
    fn take(&mut self, len: u8) -> Number {
        let mut number = Number { v: [0.0; 5], len };
        number.v[..usize::from(len)].copy_from_slice(self.last(len));
        self.drop(len);
        number
    }

    fn change(&mut self, len: u8, f: impl Fn(f64) -> f64) {
        let start = self.top - usize::from(len);
        for float in &mut self.floats[start..self.top] {
            *float = f(*float);
        }
    }

    /// As `min` and `max` go through their arguments.
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

/// The item of an array, if that is there and a number.
fn item<'a>(scopes: &'a Scopes, array: Symbol, indices: &[f64]) -> Option<&'a Number> {
    let Some(Value::Array(array)) = scopes.get(array) else {
        return None;
    };
    if array.sizes.len() != indices.len() {
        return None;
    }
    let mut at = 0;
    for (&index, &size) in indices.iter().zip(&array.sizes) {
        at = at * size + super::array::whole_index(index, size)?;
    }
    match array.items.get(at)? {
        Some(Value::Number(number)) => Some(number),
        _ => None,
    }
}
