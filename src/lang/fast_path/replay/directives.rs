//! Directives and macro calls whose expressions are all recorded.
//!
//! Each method checks that the next tokens have the common form, evaluates, and has the same effect as reading them.
//! Otherwise it has no effect, and they are read.

use super::cache::{Known, Level};
use crate::base::args::{Parse, Word};
use crate::lang::directive::macros::{Argument, Arguments};
use crate::lang::expr::value::Value;
use crate::lang::frame::Entered;
use crate::lang::limits;
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::{END_OF_FILE, Kind, Token};

impl Reader<'_> {
    /// True if recorded expressions may be used here.
    #[inline]
    pub(super) fn may_replay(&self) -> bool {
        self.recording.is_none()
            && self.usage.deprecated.is_empty()
            && !self.here.tokens.is_part()
            && self.statement.nesting + 1 < limits::READING
    }

    /// Runs the next directive; false if it has to be read.
    pub(in crate::lang) fn replay_directive(&mut self, token: Token) -> Parse<bool> {
        let at = self.here.at;
        match self.here.tokens.directives[token.value as usize].word {
            Some(Word::End) => {
                self.pass();
                self.nested(Self::run_end).map(|()| true)
            }
            Some(Word::If) => self.replay_if(at),
            Some(Word::Else) => Ok(self.pass_else(at)),
            Some(Word::Declare) => self.replay_declaration(at, false),
            Some(Word::Local) => self.replay_declaration(at, true),
            _ => Ok(false),
        }
    }

    /// An `#if` that no `#elseif` follows.
    fn replay_if(&mut self, at: usize) -> Parse<bool> {
        let (next, _) = self.group(at);
        let tokens = &self.here.tokens;
        let Some(part) = tokens.tokens.get(next as usize) else {
            return Ok(false);
        };
        let part = tokens.directives[part.value as usize].word;
        if part == Some(Word::Elseif) {
            return Ok(false);
        }
        let Some(test) = self.replay_parentheses(at + 1)? else {
            return Ok(false);
        };
        if test.abs() > EQUAL {
            self.enter(at, Entered::If);
            return Ok(true);
        }
        self.here.at = next as usize;
        self.pass();
        if part == Some(Word::Else) {
            self.enter(next as usize, Entered::If);
        }
        Ok(true)
    }

    /// `#else` after the taken part of an `#if`: goes past its `#end`.
    fn pass_else(&mut self, at: usize) -> bool {
        let (_, end) = self.group(at);
        if end == END_OF_FILE || !matches!(self.innermost(), Some(Entered::If)) {
            return false;
        }
        self.here.at = end as usize;
        self.pass();
        self.frames.pop();
        true
    }

    /// The number in the parentheses that begin at a token of the current text; goes past them.
    #[inline]
    pub(in crate::lang) fn replay_parentheses(&mut self, at: usize) -> Parse<Option<f64>> {
        let tokens = &self.here.tokens;
        if !self.may_replay()
            || !tokens
                .tokens
                .get(at)
                .is_some_and(|token| token.is_mark('('))
        {
            return Ok(None);
        }
        let Known::Program(index) = self.replays.known(tokens.file, at + 1, Level::Full) else {
            return Ok(None);
        };
        let program = &self.replays.programs[index as usize];
        if program.len != 1 || !tokens.tokens[program.after].is_mark(')') {
            return Ok(None);
        }
        let number = self.replay_float(index)?;
        if number.is_some() {
            self.pass();
        }
        Ok(number)
    }

    /// `#declare Name = number;`
    fn replay_declaration(&mut self, at: usize, is_local: bool) -> Parse<bool> {
        let tokens = &self.here.tokens.tokens;
        let Some([_, name, equals, _, ..]) = tokens.get(at..) else {
            return Ok(false);
        };
        let (Some(symbol), true) = (name.symbol(), equals.is_mark('=')) else {
            return Ok(false);
        };
        let is_number = matches!(self.scopes.get(symbol), None | Some(Value::Number(_)));
        let file = self.here.tokens.file;
        let Known::Program(index) = self.replays.known(file, at + 3, Level::Value) else {
            return Ok(false);
        };
        let after = self.replays.programs[index as usize].after;
        let ends = tokens[after].is_mark(';') && !tokens[after + 1].is_mark(';');
        if !is_number || !ends || !self.may_replay() {
            return Ok(false);
        }
        let Some(number) = self.replay(index)? else {
            return Ok(false);
        };
        self.pass();
        self.changes += 1;
        self.statement.without_semicolon = None;
        if is_local {
            self.scopes.local(symbol, Value::Number(number));
        } else if !self.scopes.declare_over(symbol, &number) {
            self.scopes.declare(symbol, Value::Number(number));
        }
        if matches!(self.raw().kind, Kind::Directive | Kind::End) {
            // Its second `;` may stand after the end of the macro or file.
            self.take_semicolon();
        }
        Ok(true)
    }

    /// The parenthesised arguments of a macro; false, without effect, if they have to be read.
    pub(in crate::lang) fn replay_arguments(
        &mut self,
        wanted: usize,
        arguments: &mut Arguments,
    ) -> Parse<bool> {
        if !self.may_replay() || !self.raw().is_mark('(') {
            return Ok(false);
        }
        self.replays.begin();
        let mut at = self.here.at + 1;
        for _ in 0..wanted {
            let Some(after) = self.replay_argument(at, arguments) else {
                break;
            };
            at = after + usize::from(self.here.tokens.tokens[after].is_mark(','));
        }
        if arguments.values.len() < wanted || !self.here.tokens.tokens[at].is_mark(')') {
            arguments.values.clear();
            self.replays.give_up(&mut self.streams);
            return Ok(false);
        }
        self.count_replayed()?;
        self.here.at = at;
        self.pass();
        Ok(true)
    }

    /// Adds the argument that begins at a token; returns the index after it.
    fn replay_argument(&mut self, at: usize, arguments: &mut Arguments) -> Option<usize> {
        let tokens = &self.here.tokens.tokens;
        let [token, behind, ..] = tokens.get(at..)? else {
            return None;
        };
        if let Some(name) = token.symbol()
            && (behind.is_mark(',') || behind.is_mark(')'))
        {
            if self.scopes.is_macro(name) {
                return None;
            }
            let target = self.scopes.target(name)?;
            arguments.values.push(Argument::Reference(target));
            return Some(at + 1);
        }
        let file = self.here.tokens.file;
        let Known::Program(index) = self.replays.known(file, at, Level::Value) else {
            return None;
        };
        let number = self.replays.value(index, &self.scopes, &mut self.streams)?;
        arguments
            .values
            .push(Argument::Value(Value::Number(number)));
        Some(self.replays.programs[index as usize].after)
    }
}
