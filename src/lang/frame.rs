//! Positions in the token stream, and the constructs entered around them.

use super::limits::EQUAL;
use super::syntax::{Symbol, Token, Tokens};
use crate::base::args::Word;
use crate::base::source::{FileId, Span};
use std::rc::Rc;

/// A position in a list of tokens, where reading goes on.
#[derive(Clone, Debug)]
pub(crate) struct Position {
    /// The tokens of a file.
    pub(crate) tokens: Rc<Tokens>,
    /// The index of the next token.
    pub(crate) at: usize,
}

/// Start of a token. Its end is computed only for a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Start {
    pub(crate) file: FileId,
    pub(crate) start: u32,
}

impl Start {
    pub(crate) fn of(tokens: &Tokens, at: usize) -> Self {
        Start {
            file: tokens.file,
            start: tokens.tokens[at].start,
        }
    }
}

/// A `#declare` whose value is being read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Declaring {
    pub(crate) symbol: Symbol,
    pub(crate) is_local: bool,
    /// Number of scopes open at the name.
    pub(crate) scope: u32,
    /// True if an item of a named array is declared, not the name itself.
    pub(crate) is_item: bool,
    /// Number of frames, parentheses and blocks open at the start of the value.
    pub(crate) frames: usize,
    pub(crate) depth: usize,
    pub(crate) blocks: usize,
    /// True if the value may be complete; what follows is then only peeked at.
    pub(crate) is_complete: bool,
    /// True if the value ends before the next token, which leaves a macro or file or calls a macro.
    pub(crate) has_ended: bool,
}

/// A construct that has been entered and not yet left.
#[derive(Debug)]
pub(crate) struct Frame {
    /// The file in which it ends.
    pub(crate) home: Rc<Tokens>,
    /// The index of its `#end` there; `u32::MAX` without one.
    pub(crate) end: u32,
    pub(crate) kind: Entered,
    /// True if its text may be read again: it is a loop or a macro, or lies within one.
    pub(crate) repeats: bool,
}

/// The kinds of [`Frame`].
#[derive(Debug)]
pub(crate) enum Entered {
    /// The part of an `#if` that is taken.
    If,
    /// A `#switch` with its value, and whether one of its parts has been taken: from there on it falls through.
    Switch { value: f64, is_chosen: bool },
    /// A `#while`, with the index of its condition, the current round, and the change count of the reader at the start
    /// of that round.
    While {
        condition: usize,
        rounds: u64,
        changes: Option<u64>,
    },
    /// A `#for`.
    For(Box<For>),
    /// A macro call.
    Macro {
        back: Position,
        call: Start,
        /// The last token of the call.
        called_to: Start,
        name: Symbol,
        called: Rc<Macro>,
    },
    /// An include file.
    Include { back: Position, from: Span },
}

/// `declare` and `include` may stand without `#`, with a warning.
pub(crate) fn is_bare_directive(token: Token) -> bool {
    token.value == Word::Declare as u32 || token.value == Word::Include as u32
}

/// A declared macro.
#[derive(Debug)]
pub(crate) struct Macro {
    pub(crate) tokens: Rc<Tokens>,
    pub(crate) body: usize,
    pub(crate) end: u32,
    pub(crate) parameters: Vec<Symbol>,
    /// True for each parameter that a call may leave out.
    pub(crate) optional: Vec<bool>,
    pub(crate) defined: Span,
}

impl Macro {
    /// The names of the parameters.
    pub(crate) fn parameters(&self) -> &[Symbol] {
        &self.parameters
    }
}

/// A running `#for`.
#[derive(Debug)]
pub(crate) struct For {
    /// Where the body begins.
    pub(crate) body: usize,
    pub(crate) variable: Symbol,
    pub(crate) start: f64,
    pub(crate) value: f64,
    pub(crate) end: f64,
    pub(crate) step: f64,
}

impl For {
    /// The start of its body, after its head.
    pub(crate) fn body(&self) -> usize {
        self.body
    }

    /// Its variable.
    pub(crate) fn variable(&self) -> Symbol {
        self.variable
    }

    /// True after the first round.
    pub(crate) fn has_gone_round(&self) -> bool {
        (self.value - self.start).abs() > EQUAL
    }

    /// Adds the step to the current value of the variable; returns the next value.
    pub(crate) fn count_on(&mut self, now: Option<f64>) -> f64 {
        self.value = now.unwrap_or(self.value) + self.step;
        self.value
    }

    /// True if no further round follows.
    pub(crate) fn is_over(&self) -> bool {
        if self.step > 0.0 {
            self.value > self.end + EQUAL
        } else {
            self.value < self.end - EQUAL
        }
    }
}
