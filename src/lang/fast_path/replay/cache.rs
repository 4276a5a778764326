//! Cache of recorded expressions, by their position in a file.

use super::op::{Binary, Op};
use super::recording::RecordedSphere;
use super::stack::Stack;
use crate::base::source::FileId;
use crate::lang::expr::streams::Streams;
use crate::lang::expr::value::{Number, Value};
use crate::lang::fast_path::replay::stack;
use crate::lang::frame::Macro;
use crate::lang::scope::Scopes;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

/// After this many replays that gave up, an expression is no longer recorded.
pub(crate) const MAX_MISSES: u8 = 50;

/// Cost of inlining a macro, beside its tokens.
pub(crate) const MACRO_COST: usize = 8;

/// Tokens of a page of [`ReplayCache`].
pub(crate) const PAGE: usize = 32;

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
pub(crate) const LEVELS: usize = 5;

/// A recorded expression.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) steps: Steps,
    /// Number of components of its value.
    pub(crate) len: u8,
    /// The index of the token after it.
    pub(crate) after: usize,
    /// The identifier that stands there: if it becomes a macro, the expression continues in its body.
    pub(crate) next_name: Option<Symbol>,
    /// The macros that it calls, with their lengths in tokens.
    pub(crate) calls: Box<[(Symbol, Rc<Macro>)]>,
    pub(crate) reread: usize,
    pub(crate) misses: u8,
    /// True if no macros have to be checked.
    pub(crate) is_plain: bool,
}

/// The steps of a recorded expression. Most are short, and need no stack.
#[derive(Debug)]
pub(crate) enum Steps {
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
pub(crate) enum Known {
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
pub(crate) type Page = [[Known; LEVELS]; PAGE];

/// All recorded expressions of a run.
#[derive(Debug, Default)]
pub(in crate::lang) struct ReplayCache {
    /// The pages of each file, made when something in them is recorded.
    pub(crate) files: Vec<Vec<Option<Box<Page>>>>,
    pub(crate) programs: Vec<Program>,
    pub(crate) spheres: Vec<Rc<RecordedSphere>>,
    pub(super) stack: Stack,
    /// Tokens of macros that were inlined since the last [`ReplayCache::begin`].
    pub(crate) reread: usize,
    /// True if nothing is replayed: tests compare with and without.
    pub(crate) is_off: bool,
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
    pub(in crate::lang) fn begin(&mut self) {
        self.reread = 0;
        self.stack.begin();
    }

    /// Abandons a replay, without effect.
    pub(in crate::lang) fn give_up(&mut self, streams: &mut Streams) {
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
    pub(in crate::lang) fn float(
        &mut self,
        index: u32,
        scopes: &Scopes,
        streams: &mut Streams,
    ) -> Option<f64> {
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
    pub(in crate::lang) fn value(
        &mut self,
        index: u32,
        scopes: &Scopes,
        streams: &mut Streams,
    ) -> Option<Number> {
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
    pub(in crate::lang) fn known(&self, file: FileId, at: usize, level: Level) -> Known {
        let pages = self.files.get(file.0 as usize);
        match pages.and_then(|pages| pages.get(at / PAGE)) {
            Some(Some(page)) => page[at % PAGE][level as usize],
            _ => Known::Nothing,
        }
    }

    pub(in crate::lang) fn set(&mut self, file: FileId, at: usize, level: Level, known: Known) {
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
    pub(in crate::lang) fn keep(&mut self, mut program: Program, old: Option<u32>) -> Known {
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
