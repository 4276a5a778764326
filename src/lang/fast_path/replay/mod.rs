//! Replay of expressions: recorded once, then evaluated again without looking at a token.
//!
//! While an expression is read in a loop or a macro, each step of its evaluation is recorded, with the number of
//! components of its operands. An expression has no branches (`? :` evaluates both sides), so the record is a program
//! for a stack of floats, and there is no second grammar. The program is stored under the position of the first token.
//! A macro that holds nothing but a part of the expression is inlined; its parameters become slots.
//!
//! A replay gives up, and the tokens are read again, wherever something differs from the recording or an error or a
//! warning is due: an identifier holds another kind of value, an index is out of range, a divisor is zero. Up to there
//! it has changed nothing but streams of random numbers, which are reset. So a replay means what the tokens mean.
//!
//! Some expressions cannot be recorded: those in which a directive runs or a file ends, strings, and the functions that
//! [`Op::of_call`] does not cover. Their parts are recorded on their own.
//!
//! Statements are replayed as far as they consist of recorded expressions: the directives of loops and the arguments of
//! macros ([`directives`]), and whole objects, which their readers take from the tokens without the cursor ([`reader`])
//! or, for spheres, from the recorded expressions alone ([`ball`]).

mod ball;
#[cfg(test)]
mod both_ways;
mod directives;
mod notes;
mod op;
mod reader;
mod stack;

pub(in crate::lang) use notes::{Recording, Source};
pub(in crate::lang) use op::{Binary, Op};

use crate::base::args::Parse;
use crate::base::source::FileId;
use crate::lang::cursor::is_bare_directive;
use crate::lang::directive::macros::Macro;
use crate::lang::expr::streams::Streams;
use crate::lang::expr::value::{Number, Value};
use crate::lang::reader::Reader;
use crate::lang::scope::Scopes;
use crate::lang::syntax::{Kind, Symbol};
use ball::RecordedSphere;
use stack::Stack;
use std::rc::Rc;

/// After this many replays that gave up, an expression is no longer recorded.
const MAX_MISSES: u8 = 50;
/// Cost of inlining a macro, beside its tokens.
const MACRO_COST: usize = 8;
/// Tokens of a page of [`ReplayCache`].
const PAGE: usize = 32;

/// Where in the grammar an expression begins. At one token there may be one of each level.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Level {
    /// Anything that may stand after `#declare X =`.
    Value,
    /// With comparisons, logic and `? :`.
    Full,
    /// With `+` and `-`.
    Sum,
    /// With `*` and `/`.
    Product,
    /// No expression: an object.
    Object,
}

/// Number of levels.
const LEVELS: usize = 5;

/// The result of an expression.
pub(in crate::lang) trait Replayed: Sized {
    /// The result for a recorded number.
    fn of(number: Number) -> Self;
    /// The number that it is, if it is one.
    fn number(&self) -> Option<&Number>;
}

impl Replayed for Number {
    fn of(number: Number) -> Self {
        number
    }

    fn number(&self) -> Option<&Number> {
        Some(self)
    }
}

impl Replayed for Option<Value> {
    fn of(number: Number) -> Self {
        Some(Value::Number(number))
    }

    fn number(&self) -> Option<&Number> {
        match self {
            Some(Value::Number(number)) => Some(number),
            _ => None,
        }
    }
}

/// A recorded expression.
#[derive(Debug)]
struct Program {
    steps: Steps,
    /// Number of components of its value.
    len: u8,
    /// The index of the token after it.
    after: usize,
    /// The identifier that stands there: if it becomes a macro, the expression continues in its body.
    next_name: Option<Symbol>,
    /// The macros that it calls, with their lengths in tokens.
    calls: Box<[(Symbol, Rc<Macro>)]>,
    reread: usize,
    misses: u8,
    /// True if no macros have to be checked.
    is_plain: bool,
}

/// The steps of a recorded expression. Most are short, and need no stack.
#[derive(Debug)]
enum Steps {
    Float(f64),
    /// The value of an identifier, which must have this many components.
    Name(Symbol, u8),
    /// The float of an identifier, combined with a constant on its right.
    NameAnd(Symbol, Binary, f64),
    Many(Box<[Op]>),
}

impl From<Box<[Op]>> for Steps {
    fn from(ops: Box<[Op]>) -> Self {
        match *ops {
            [Op::Float(float)] => Steps::Float(float),
            [Op::Name(name, len)] => Steps::Name(name, len),
            [Op::Name(name, 1), Op::WithFloat(binary, right)] => {
                Steps::NameAnd(name, binary, right)
            }
            _ => Steps::Many(ops),
        }
    }
}

/// State of the expressions that begin at a token, one for each [`Level`].
#[derive(Clone, Copy, Debug, Default)]
enum Known {
    #[default]
    Nothing,
    /// It cannot be recorded.
    Never,
    /// The index of its program.
    Program(u32),
    /// An object, with the number of times it was read since its last replay.
    Read(u8),
    /// An object that was replayed, and is no [`RecordedSphere`].
    Replayed,
    /// The index of its [`RecordedSphere`].
    RecordedSphere(u32),
}

/// State of the tokens of a page.
type Page = [[Known; LEVELS]; PAGE];

/// All recorded expressions of a run.
#[derive(Debug, Default)]
pub(in crate::lang) struct ReplayCache {
    /// The pages of each file, made when something in them is recorded.
    files: Vec<Vec<Option<Box<Page>>>>,
    programs: Vec<Program>,
    spheres: Vec<Rc<RecordedSphere>>,
    stack: Stack,
    /// Tokens of macros that were inlined since the last [`ReplayCache::begin`].
    reread: usize,
    /// True if nothing is replayed: tests compare with and without.
    is_off: bool,
}

impl ReplayCache {
    /// Turns replays off.
    #[cfg(test)]
    pub(in crate::lang) fn disable(&mut self) {
        self.is_off = true;
    }

    /// Drops all recordings.
    pub(in crate::lang) fn clear(&mut self) {
        self.files.clear();
        self.programs.clear();
        self.spheres.clear();
    }

    /// Begins a replay, which succeeds or has no effect.
    fn begin(&mut self) {
        self.reread = 0;
        self.stack.begin();
    }

    /// Abandons a replay, without effect.
    fn give_up(&mut self, streams: &mut Streams) {
        self.stack.give_up(streams);
    }

    /// Checks that the macros of a recorded expression are the same as before; counts their tokens.
    #[inline(never)]
    fn look_at_macros(&mut self, index: u32, scopes: &Scopes) -> Option<()> {
        let program = &self.programs[index as usize];
        if program.next_name.is_some_and(|name| scopes.is_macro(name)) {
            return None;
        }
        let is_still = |(name, called): &(Symbol, Rc<Macro>)| match scopes.get(*name) {
            Some(Value::Macro(now)) => Rc::ptr_eq(now, called),
            _ => false,
        };
        if !program.calls.iter().all(is_still) {
            return None;
        }
        self.reread += program.reread;
        Some(())
    }

    /// The value of a recorded expression that gives a float; `None` if it has to be read.
    #[inline]
    fn float(&mut self, index: u32, scopes: &Scopes, streams: &mut Streams) -> Option<f64> {
        if !self.programs[index as usize].is_plain {
            self.look_at_macros(index, scopes)?;
        }
        match &self.programs[index as usize].steps {
            Steps::Float(float) => Some(*float),
            Steps::Name(name, _) => stack::float(scopes, *name),
            Steps::NameAnd(name, binary, right) => {
                stack::combined(*binary, stack::float(scopes, *name)?, *right)
            }
            Steps::Many(ops) => {
                self.stack.run(ops, scopes, streams)?;
                Some(self.stack.first())
            }
        }
    }

    /// The value of a recorded expression; `None` if it has to be read.
    #[inline]
    fn value(&mut self, index: u32, scopes: &Scopes, streams: &mut Streams) -> Option<Number> {
        if !self.programs[index as usize].is_plain {
            self.look_at_macros(index, scopes)?;
        }
        let program = &self.programs[index as usize];
        match &program.steps {
            Steps::Float(float) => Some(Number::float(*float)),
            Steps::Name(name, len) => match scopes.get(*name) {
                Some(Value::Number(number)) if number.len == *len => Some(*number),
                _ => None,
            },
            Steps::NameAnd(name, binary, right) => {
                let left = stack::float(scopes, *name)?;
                stack::combined(*binary, left, *right).map(Number::float)
            }
            Steps::Many(ops) => {
                self.stack.run(ops, scopes, streams)?;
                Some(self.stack.number(program.len))
            }
        }
    }

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

    /// Stores a program, in place of an old one if there is one.
    fn keep(&mut self, mut program: Program, old: Option<u32>) -> Known {
        // The old index may be from before the cache was cleared.
        let old = old.filter(|&index| (index as usize) < self.programs.len());
        match old {
            Some(index) => {
                let old = &mut self.programs[index as usize];
                program.misses = old.misses.saturating_add(1);
                *old = program;
                if old.misses > MAX_MISSES {
                    Known::Never
                } else {
                    Known::Program(index)
                }
            }
            None => match u32::try_from(self.programs.len()) {
                Ok(index) => {
                    self.programs.push(program);
                    Known::Program(index)
                }
                Err(_) => Known::Never,
            },
        }
    }
}

impl Reader<'_> {
    /// Reads the next expression, or replays it if it was recorded here.
    #[inline]
    pub(in crate::lang) fn replayed<T: Replayed>(
        &mut self,
        level: Level,
        read: impl FnOnce(&mut Self) -> Parse<T>,
    ) -> Parse<T> {
        if self.recording.is_some()
            || self.here.tokens.is_part()
            || self.replays.is_off
            || !self.usage.deprecated.is_empty()
        {
            return read(self);
        }
        let old = match self
            .replays
            .known(self.here.tokens.file, self.here.at, level)
        {
            Known::Never | Known::Read(_) | Known::Replayed | Known::RecordedSphere(_) => {
                return read(self);
            }
            Known::Nothing if !self.is_repeated() => return read(self),
            Known::Nothing => None,
            Known::Program(index) => match self.replay(index)? {
                Some(number) => return Ok(T::of(number)),
                None => Some(index),
            },
        };
        let (file, start) = (self.here.tokens.file, self.here.at);
        self.recording = Some(Recording::new(self.frames.len()));
        let value = read(self);
        let recording = self.recording.take();
        let value = value?;
        let program = match (recording, value.number()) {
            (Some(recording), Some(number)) => self.program(recording, number.len),
            _ => None,
        };
        let known = match program {
            Some(program) => self.replays.keep(program, old),
            None => Known::Never,
        };
        self.replays.set(file, start, level, known);
        Ok(value)
    }

    /// The program of a recording, if the token after the expression allows it.
    fn program(&self, recording: Recording, len: u8) -> Option<Program> {
        let behind = self.raw();
        let is_plain_token = match behind.kind {
            Kind::Directive | Kind::More | Kind::End => false,
            Kind::Word => !is_bare_directive(behind),
            _ => true,
        };
        let is_whole = recording.is_whole(len, self.frames.len());
        (is_plain_token && is_whole).then(|| Program {
            steps: op::fused(recording.ops).into(),
            len,
            after: self.here.at,
            next_name: behind.symbol(),
            is_plain: behind.symbol().is_none() && recording.calls.is_empty(),
            calls: recording.calls.into(),
            reread: recording.reread,
            misses: 0,
        })
    }

    /// The same for an expression that gives a float.
    fn replay_float(&mut self, index: u32) -> Parse<Option<f64>> {
        self.replays.begin();
        let value = self.replays.float(index, &self.scopes, &mut self.streams);
        if value.is_none() {
            self.replays.give_up(&mut self.streams);
            return Ok(None);
        }
        let after = self.replays.programs[index as usize].after;
        self.count_replayed()?;
        self.here.at = after - 1;
        self.pass();
        Ok(value)
    }

    /// The value of a recorded expression; `None`, without effect, if it has to be read.
    fn replay(&mut self, index: u32) -> Parse<Option<Number>> {
        self.replays.begin();
        let value = self.replays.value(index, &self.scopes, &mut self.streams);
        let Some(number) = value else {
            self.replays.give_up(&mut self.streams);
            return Ok(None);
        };
        let after = self.replays.programs[index as usize].after;
        self.count_replayed()?;
        self.here.at = after - 1;
        self.pass();
        Ok(Some(number))
    }

    /// Counts the tokens of inlined macros.
    #[inline]
    fn count_replayed(&mut self) -> Parse<()> {
        match self.replays.reread {
            0 => Ok(()),
            // The count itself adds the cost of one round.
            reread => self.count_reread(reread - MACRO_COST, self.start_here()),
        }
    }
}
