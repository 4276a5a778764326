//! Choices: `#if` with its branches, `#switch` with its cases.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::lang::frame::Entered;
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;
use std::rc::Rc;

impl Reader<'_> {
    pub(crate) fn run_if(
        &mut self,
        index: usize,
        span: Span,
        test: impl FnOnce(&mut Self) -> Parse<bool>,
    ) -> Parse<()> {
        let home = Rc::clone(&self.here.tokens);
        if test(self)? {
            self.enter(index, Entered::If);
            return Ok(());
        }
        self.stay_in(&home, span)?;
        self.next_branch(index, span)
    }

    /// Goes from a part that is not taken to the next one that is.
    pub(crate) fn next_branch(&mut self, mut index: usize, span: Span) -> Parse<()> {
        loop {
            self.next_part(index, span)?;
            index = self.here.at;
            let token = self.raw();
            let word = self.here.tokens.directives[token.value as usize].word;
            self.pass();
            match word {
                Some(Word::Elseif) if !self.condition()? => {}
                Some(Word::End) => return Ok(()),
                _ => {
                    self.enter(index, Entered::If);
                    return Ok(());
                }
            }
        }
    }

    /// Goes to the next part of the group of `index`. A group that its file leaves open may end in the including file.
    pub(crate) fn next_part(&mut self, index: usize, span: Span) -> Parse<()> {
        let (next, _) = self.group(index);
        if next != u32::MAX {
            self.here.at = next as usize;
            return Ok(());
        }
        self.find_directive(span, |word| {
            matches!(word, Word::End | Word::Else | Word::Elseif)
        })
    }

    /// Goes to the first directive accepted by `is_it` outside of the groups that begin after the cursor, in this file
    /// or one that includes it.
    pub(crate) fn find_directive(&mut self, span: Span, is_it: impl Fn(Word) -> bool) -> Parse<()> {
        let mut depth = 0_usize;
        loop {
            let token = self.raw();
            if token.kind == Kind::End && !self.leave_file() {
                return self.jump(u32::MAX, span);
            }
            if token.kind == Kind::Directive {
                let word = self.here.tokens.directives[token.value as usize].word;
                match word {
                    Some(word) if crate::lang::diagnose::hints::opens_group(word) => depth += 1,
                    Some(word) if depth == 0 && is_it(word) => return Ok(()),
                    Some(Word::End) => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
            match token.kind {
                Kind::End => {}
                // Data holds no directives.
                Kind::DataSegment => self.leave_segment(),
                _ => self.here.at += 1,
            }
        }
    }

    /// `#else` reached from a part that was taken: skips to `#end`, except in a `#switch`, which falls through.
    pub(crate) fn run_else(&mut self, index: usize, span: Span, word: Word) -> Parse<()> {
        match self.innermost_group() {
            Some(Entered::If) => {}
            Some(Entered::Switch { is_chosen, .. }) if word == Word::Else => {
                *is_chosen = true;
                return Ok(());
            }
            _ => {
                let error = Diagnostic::error(span, format!("`#{word}` without an open `#if`"));
                return Err(self
                    .with_trace(error.with_hint(
                        "Remove it, or look for an `#end` above that closes too early.",
                    )));
            }
        }
        match self.group(index) {
            (u32::MAX, u32::MAX) => self.find_directive(span, |word| word == Word::End)?,
            (_, end) => self.jump(end, span)?,
        }
        self.pass();
        self.leave_group();
        Ok(())
    }

    /// `#switch (value)`: reads the text before its first part, then the parts decide whether they are taken.
    pub(crate) fn run_switch(&mut self, index: usize) -> Parse<()> {
        let value = self.number_in_parentheses()?;
        let is_chosen = false;
        let next = self.raw();
        let begins_part = next.kind == Kind::Directive && {
            let word = self.here.tokens.directives[next.value as usize].word;
            !matches!(word, Some(Word::Else | Word::End))
        };
        if !begins_part {
            let reason = "`#case` or `#range` must follow `#switch`";
            self.refused_by_povray(self.taken_span(), reason, "Write `#case (...)` first.");
        }
        self.enter(index, Entered::Switch { value, is_chosen });
        Ok(())
    }

    /// `#case` or `#range`. Reached from a part above that was taken, it falls through.
    pub(crate) fn run_case(&mut self, index: usize, span: Span, word: Word) -> Parse<()> {
        let Some(&Entered::Switch { value, is_chosen }) = self.innermost() else {
            return Err(self.with_trace(Diagnostic::error(
                span,
                format!("`#{word}` without `#switch`"),
            )));
        };
        let is_chosen = is_chosen
            | if word == Word::Case {
                (self.number_in_parentheses()? - value).abs() < EQUAL
            } else {
                let (low, high) = self.pair_in_parentheses()?;
                value >= low - EQUAL && value <= high + EQUAL
            };
        if !is_chosen {
            let (next, _) = self.group(index);
            return self.jump(next, span);
        }
        if let Some(Entered::Switch { is_chosen, .. }) = self.innermost_group() {
            *is_chosen = true;
        }
        Ok(())
    }
}
