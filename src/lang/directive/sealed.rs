//! Positions where POV-Ray 3.7 runs no directive behind a value, and povr does.
//!
//! The value in the parentheses of `#if`, `#while`, `#switch`, `#case` and `#range`, and a number as an argument of a
//! macro, the size of an array and the index of an item that gets a value must not be followed by a macro call or a
//! directive, not even by the `#end` of an `#if` in a macro that yields the value. From version 3.5 on no macro call
//! may follow a number that is declared, before its `;`. In the list of an array no directive and no macro call may
//! stand before or behind an item. Within parentheses of their own, after an operator and within the blocks of elements
//! they may, as far as this module knows.

use crate::base::args::Args;
use crate::base::source::Span;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Token};

/// A slot of this kind that is being read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sealed {
    slot: Slot,
    /// Nesting depth of expressions, and number of open blocks.
    level: (usize, usize),
    frames: usize,
    /// Number of tokens taken before it.
    taken: u64,
    /// The first macro call behind a declared value that may be a number.
    macro_behind: Option<Span>,
}

/// The kinds of slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    /// Parentheses of a directive, or the brackets of an array.
    Condition,
    /// Argument of a macro.
    Argument,
    /// List of the items of an array.
    List,
    /// Value of a declaration.
    Declared,
}

impl Reader<'_> {
    /// Reads such a slot.
    pub(crate) fn sealed<T>(&mut self, slot: Slot, read: impl FnOnce(&mut Self) -> T) -> T {
        self.read_slot(slot, read).0
    }

    /// Reads a value that is declared, and finds the macro call that POV-Ray refuses if the value is a number.
    pub(crate) fn sealed_declared<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> T,
    ) -> (T, Option<Span>) {
        self.read_slot(Slot::Declared, read)
    }

    /// Warns of a macro call between a declared number and its `;`.
    pub(crate) fn warn_of_macro_behind(&mut self, is_number: bool, macro_behind: Option<Span>) {
        if let Some(at) = macro_behind.filter(|_| is_number && self.draft.version >= 3.5) {
            let reason = "no macro may stand between a number and its `;`";
            let remedy =
                "Write the `;` before the macro, or an operator if the macro yields a value.";
            self.refused_by_povray(at, reason, remedy);
        }
    }

    fn read_slot<T>(&mut self, slot: Slot, read: impl FnOnce(&mut Self) -> T) -> (T, Option<Span>) {
        let sealed = Sealed {
            slot,
            level: (self.statement.depth, self.blocks.len()),
            frames: self.frames.len(),
            taken: self.taken,
            macro_behind: None,
        };
        let outer = self.statement.sealed.replace(sealed);
        let value = read(self);
        let macro_behind = self.statement.sealed.and_then(|sealed| sealed.macro_behind);
        self.statement.sealed = outer;
        (value, macro_behind)
    }

    /// Warns of a directive or a macro call, which is next, if POV-Ray runs none here.
    pub(crate) fn warn_if_sealed(&mut self, next: Token) {
        let Some(sealed) = self.statement.sealed else {
            return;
        };
        let level = (self.statement.depth, self.blocks.len());
        // Behind another directive it is as before that one.
        if sealed.level != level || self.statement.directive_end == self.taken {
            return;
        }
        let (reason, remedy) = match sealed.slot {
            Slot::List if self.is_within(sealed.frames) && self.may_end_item() => (
                "no directive or macro may stand between the items of an array",
                "Declare the items before, or write a number in parentheses: `(M())`.",
            ),
            Slot::Condition | Slot::Argument
                if self.taken > sealed.taken
                    && !self.is_end_of_macro()
                    && self.may_end_number(sealed.slot) =>
            {
                (
                    match next.kind {
                        Kind::Directive => "no directive may follow the number here",
                        _ => "no macro may follow the number here",
                    },
                    "Write the number in parentheses of its own: `#if ((A))`, `M((A))`.",
                )
            }
            Slot::Declared
                if next.kind == Kind::Name
                    && self.taken > sealed.taken
                    && sealed.macro_behind.is_none()
                    && (self.may_end_number(Slot::Condition)
                        || self.may_end_number(Slot::Argument)) =>
            {
                self.statement.sealed = Some(Sealed {
                    macro_behind: Some(self.here_span()),
                    ..sealed
                });
                return;
            }
            _ => return,
        };
        self.refused_by_povray(self.here_span(), reason, remedy);
        self.statement.sealed = None;
    }

    /// True if an item of an array may begin or end behind the last token.
    fn may_end_item(&self) -> bool {
        let last = self.last.tokens.tokens[self.last.at];
        match last.kind {
            Kind::Mark => ['{', '}', ',', ')', ']', '>']
                .into_iter()
                .any(|mark| last.is_mark(mark)),
            Kind::Number | Kind::Name | Kind::String => true,
            _ => false,
        }
    }

    /// True if a number, or a vector as an argument, ends with the last token.
    fn may_end_number(&self, slot: Slot) -> bool {
        let last = self.last.tokens.tokens[self.last.at];
        let is_condition = slot == Slot::Condition;
        match last.kind {
            Kind::Number => true,
            Kind::Name => {
                let held = last.symbol().and_then(|name| self.scopes.get(name));
                is_condition || matches!(held, Some(Value::Number(_)))
            }
            Kind::Word => {
                is_condition || last.word().is_some_and(|word| word.class() == Class::Value)
            }
            Kind::Mark if is_condition => last.is_mark(')') || last.is_mark(']'),
            Kind::Mark => last.is_mark('>'),
            _ => false,
        }
    }
}
