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
//! or, for spheres, from the recorded expressions alone ([`recorded_sphere`]).

pub(in crate::lang) mod cache;
mod directives;
#[cfg(test)]
mod equivalence;
mod notes;
pub(in crate::lang) mod op;
mod reader;
mod recorded_sphere;
pub(in crate::lang) mod recording;
mod spheres;
mod stack;

use crate::base::args::Parse;
use crate::lang::expr::value::{Number, Value};
use crate::lang::frame::is_bare_directive;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;
use cache::{Known, Level, MACRO_COST, Program};
use recording::Recording;

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
            Kind::Directive | Kind::DataSegment | Kind::End => false,
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

    /// Value of a recorded float expression; `None`, without effect, if it must be read again.
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
