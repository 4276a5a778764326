//! Directives that choose what is read next: conditions, loops, `#switch`, macros' `#end`.

use super::cursor::{Entered, Frame, Place, Start, State};
use super::limits;
use super::reader::Reader;
use super::value::{Number, Value};
use crate::args::{Args, Parse, Word};
use crate::source::{Code, Diagnostic, Span};
use crate::syntax::{Class, Kind, Symbol, Token, Tokens};
use std::rc::Rc;

/// How far two floats may differ and still be equal to the language.
pub(super) const EQUAL: f64 = 1e-10;

/// Whether a loop may draw from more streams of random numbers than this is not asked at each round.
const FEW_STREAMS: usize = 16;

/// A running `#for`.
#[derive(Debug)]
pub(super) struct For {
    /// Where the body begins.
    body: usize,
    variable: Symbol,
    start: f64,
    value: f64,
    end: f64,
    step: f64,
}

impl For {
    /// Where its body begins, behind its head.
    pub(super) fn body(&self) -> usize {
        self.body
    }

    /// Its variable.
    pub(super) fn variable(&self) -> Symbol {
        self.variable
    }

    /// Whether this is not its first round.
    pub(super) fn has_gone_round(&self) -> bool {
        (self.value - self.start).abs() > EQUAL
    }

    fn is_over(&self) -> bool {
        if self.step > 0.0 {
            self.value > self.end + EQUAL
        } else {
            self.value < self.end - EQUAL
        }
    }
}

impl Reader<'_> {
    /// Runs the directive at hand and leaves the cursor where reading goes on.
    pub(super) fn run_directive(&mut self, token: Token) -> Parse<()> {
        let index = self.here.at;
        let span = self.here_span();
        let Some(word) = self.here.tokens.directives[token.value as usize].word else {
            let found = self.source_text(span).to_owned();
            self.here.at += 1;
            let hint = match Self::similar_directive(found.trim_start_matches(['#', ' '])) {
                Some(near) => format!("Did you mean `#{near}`?"),
                None => {
                    "Directives are `#declare`, `#if`, `#while`, `#macro`, `#include` and the like."
                        .to_owned()
                }
            };
            let error = Diagnostic::error(span, format!("`{found}` is no directive"));
            return Err(self.with_trace(error.with_hint(hint)));
        };
        self.pass();
        let frames = self.frames.len();
        let home = Rc::clone(&self.here.tokens);
        match self.nested(|reader| reader.run_known(word, index, span)) {
            Err(error) if super::hints::opens_group(word) && !self.is_over => self.go_on_in_group(
                error,
                &Place {
                    tokens: home,
                    at: index,
                },
                frames,
            ),
            result => result,
        }
    }

    /// After an error in the head of a directive that opens a group: tells it and goes on in the first part of an
    /// `#if`, behind the `#end` of anything else, so that the `#end` is not taken for one too many.
    fn go_on_in_group(
        &mut self,
        error: Box<Diagnostic>,
        opener: &Place,
        frames: usize,
    ) -> Parse<()> {
        let directives = &opener.tokens.directives;
        let directive = &directives[opener.tokens.tokens[opener.at].value as usize];
        let (word, end) = (directive.word, directive.end);
        if end == u32::MAX || !self.is_within(frames) {
            return Err(error);
        }
        self.frames.truncate(frames);
        self.record(*error);
        if self.errors >= limits::ERRORS {
            return Err(self.consequence());
        }
        self.here = opener.clone();
        self.pass();
        if matches!(word, Some(Word::If | Word::Ifdef | Word::Ifndef)) {
            self.pass_parentheses();
            self.enter(opener.at, Entered::If);
        } else {
            self.here.at = end as usize + 1;
        }
        Ok(())
    }

    /// Goes behind the parentheses at hand, or, where they are missing, to the next object or statement; not past a
    /// directive.
    fn pass_parentheses(&mut self) {
        let begins = |token: Token| {
            token.word().is_some_and(|word| {
                matches!(word.class(), Class::Shape | Class::Csg | Class::Statement)
            })
        };
        if !self.is_raw_mark('(') {
            while !ends_text(self.raw()) && !begins(self.raw()) {
                self.pass();
            }
            return;
        }
        let mut depth = 0;
        loop {
            let token = self.raw();
            if ends_text(token) {
                return;
            }
            depth += i32::from(token.is_mark('(')) - i32::from(token.is_mark(')'));
            self.pass();
            if depth <= 0 {
                return;
            }
        }
    }

    fn run_known(&mut self, word: Word, index: usize, span: Span) -> Parse<()> {
        if changes_values(word) {
            self.changes += 1;
        }
        match word {
            Word::If => self.run_if(index, span, |reader| reader.condition()),
            Word::Ifdef => self.run_if(index, span, |reader| reader.is_defined()),
            Word::Ifndef => self.run_if(index, span, |reader| Ok(!reader.is_defined()?)),
            Word::Else | Word::Elseif => self.run_else(index, span, word),
            Word::While => {
                self.enter(
                    index,
                    Entered::While {
                        condition: self.here.at,
                        rounds: 1,
                        state: None,
                    },
                );
                self.run_while(index)
            }
            Word::For => self.run_for(index, span),
            Word::Switch => self.run_switch(index),
            Word::Case | Word::Range => self.run_case(index, span, word),
            Word::Break => self.run_break(span),
            Word::End => self.run_end(span),
            Word::Macro => self.define_macro(index, span),
            Word::Declare => self.run_declare(false),
            Word::Local => self.run_declare(true),
            Word::Undef => self.run_undef(),
            Word::Include => self.run_include(),
            Word::Default => self.run_default(),
            Word::Version => self.run_version(),
            Word::Fopen => self.run_fopen(),
            Word::Fclose => self.run_fclose(),
            Word::Read => self.run_read(),
            Word::Write => self.run_write(),
            Word::Debug | Word::Warning | Word::Error | Word::Render | Word::Statistics => {
                self.run_message(word, span)
            }
            _ => Err(self.with_trace(
                Diagnostic::error(span, format!("`#{word}` is not built yet"))
                    .with_code(Code::NotBuilt),
            )),
        }
    }

    /// Runs `declare` or `include` written without `#`.
    pub(super) fn run_bare_directive(&mut self, token: Token) -> Parse<()> {
        let span = self.here_span();
        self.pass();
        let is_include = token.value == Word::Include as u32;
        let word = if is_include {
            Word::Include
        } else {
            Word::Declare
        };
        self.warning(Diagnostic::warning(
            span,
            format!("`{word}` without `#`; read as `#{word}`"),
        ));
        if is_include {
            self.run_include()
        } else {
            self.run_declare(false)
        }
    }

    /// Goes to the token behind the directive that follows in its group; an error where the group is not closed.
    fn jump(&mut self, to: u32, span: Span) -> Parse<()> {
        if to == u32::MAX {
            return Err(self.with_trace(
                Diagnostic::error(span, "this directive has no matching `#end`")
                    .with_hint("Write `#end` where it is to end."),
            ));
        }
        self.here.at = to as usize;
        Ok(())
    }

    /// Enters the group of the directive at `index` of the file at hand.
    fn enter(&mut self, index: usize, kind: Entered) {
        let (_, end) = self.group(index);
        self.enter_frame(Rc::clone(&self.here.tokens), end, kind);
    }

    fn innermost(&self) -> Option<&Entered> {
        self.frames.last().map(|frame| &frame.kind)
    }

    /// The next part and the `#end` of the group of a directive of the file at hand.
    fn group(&self, index: usize) -> (u32, u32) {
        let tokens = &self.here.tokens;
        let token = tokens.tokens.get(index);
        let directive = token.and_then(|token| tokens.directives.get(token.value as usize));
        directive.map_or((u32::MAX, u32::MAX), |directive| {
            (directive.next, directive.end)
        })
    }

    fn run_if(
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

    /// From a part that is not chosen to the first later one that is.
    fn next_branch(&mut self, mut index: usize, span: Span) -> Parse<()> {
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

    /// Goes to the next part of the group that `index` belongs to. A group that its file does not end may end in the
    /// file that includes it.
    fn next_part(&mut self, index: usize, span: Span) -> Parse<()> {
        let (next, _) = self.group(index);
        if next != u32::MAX {
            self.here.at = next as usize;
            return Ok(());
        }
        self.find_on(span, |word| {
            matches!(word, Word::End | Word::Else | Word::Elseif)
        })
    }

    /// Goes to the first directive that `is_it` likes and that is in no group which begins from here on, in this file,
    /// or in the file that includes it or one further out.
    fn find_on(&mut self, span: Span, is_it: impl Fn(Word) -> bool) -> Parse<()> {
        let mut depth = 0_usize;
        loop {
            let token = self.raw();
            if token.kind == Kind::End && !self.leave_file() {
                return self.jump(u32::MAX, span);
            }
            if token.kind == Kind::Directive {
                let word = self.here.tokens.directives[token.value as usize].word;
                match word {
                    Some(word) if super::hints::opens_group(word) => depth += 1,
                    Some(word) if depth == 0 && is_it(word) => return Ok(()),
                    Some(Word::End) => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
            match token.kind {
                Kind::End => {}
                // There are no directives in it.
                Kind::More => self.leave_stretch(),
                _ => self.here.at += 1,
            }
        }
    }

    /// `#else` reached from a chosen part: everything to the `#end` is left out, but in a `#switch`, which falls
    /// through.
    fn run_else(&mut self, index: usize, span: Span, word: Word) -> Parse<()> {
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
            (u32::MAX, u32::MAX) => self.find_on(span, |word| word == Word::End)?,
            (_, end) => self.jump(end, span)?,
        }
        self.pass();
        self.leave_group();
        Ok(())
    }

    /// The innermost group, which may have begun in a file that includes the one at hand.
    fn innermost_group(&mut self) -> Option<&mut Entered> {
        let is_group = |frame: &&mut Frame| !matches!(frame.kind, Entered::Include { .. });
        let mut frames = self.frames.iter_mut().rev();
        frames.find(is_group).map(|frame| &mut frame.kind)
    }

    /// Ends the innermost group.
    fn leave_group(&mut self) {
        let is_group = |frame: &Frame| !matches!(frame.kind, Entered::Include { .. });
        if let Some(at) = self.frames.iter().rposition(is_group) {
            self.frames.remove(at);
        }
    }

    fn run_while(&mut self, index: usize) -> Parse<()> {
        let home = Rc::clone(&self.here.tokens);
        let (_, end) = self.group(index);
        self.count_round(index, end, Start::of(&home, index))?;
        let span = home.span(index);
        self.look_for_change(span)?;
        if self.condition()? {
            return Ok(());
        }
        self.stay_in(&home, span)?;
        self.frames.pop();
        let (_, end) = self.group(index);
        self.jump(end, span)?;
        self.pass();
        Ok(())
    }

    /// At the condition of a `#while`: an error if the round behind it has changed nothing that the next one could read.
    fn look_for_change(&mut self, at: Span) -> Parse<()> {
        if self.streams.len() > FEW_STREAMS {
            self.changes += 1;
        }
        let streams = self.streams.iter();
        let state = State {
            changes: self.changes,
            streams: streams.fold(0, |sum, &stream| sum.rotate_left(5) ^ stream),
        };
        let Some(Frame {
            kind: Entered::While { state: known, .. },
            ..
        }) = self.frames.last_mut()
        else {
            return Ok(());
        };
        if known.replace(state) != Some(state) {
            return Ok(());
        }
        let error = Diagnostic::error(
            at,
            "this loop does not end: no round of it changes anything",
        );
        let hint = "Change what its condition asks for, or leave it by `#break`.";
        Err(self.with_trace(error.with_hint(hint)))
    }

    fn run_for(&mut self, index: usize, span: Span) -> Parse<()> {
        self.expect_mark('(', "`(` after `#for`")?;
        let variable = self.identifier("a variable after `#for (`")?;
        self.take_mark(',')?;
        if !self.begins_number()? {
            return Err(self.expected_here("`,` and the start of `#for`"));
        }
        let start = self.float()?;
        self.take_mark(',')?;
        let end = self.float()?;
        let step = if self.take_mark(',')? {
            self.float()?
        } else {
            1.0
        };
        self.expect_mark(')', "`)` at the end of `#for`")?;
        if step.abs() < EQUAL {
            return Err(self.with_trace(Diagnostic::error(span, "the step of `#for` is zero")));
        }
        let run = For {
            body: self.here.at,
            variable,
            start,
            value: start,
            end,
            step,
        };
        // The variable is local to the macro or file, whoever else has that name.
        self.scopes
            .local(variable, Value::Number(Number::float(start)));
        if run.is_over() {
            let (_, end) = self.group(index);
            self.jump(end, span)?;
            self.pass();
        } else {
            self.enter(index, Entered::For(Box::new(run)));
        }
        Ok(())
    }

    /// `#switch (value)`: what stands before its first part is read, then its parts tell whether they are chosen.
    fn run_switch(&mut self, index: usize) -> Parse<()> {
        let value = self.number_in_parentheses()?;
        let is_chosen = false;
        self.enter(index, Entered::Switch { value, is_chosen });
        Ok(())
    }

    /// `#case` or `#range`. Reached from a chosen part above it, it falls through.
    fn run_case(&mut self, index: usize, span: Span, word: Word) -> Parse<()> {
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

    /// `#break` leaves the innermost loop, `#switch` or macro.
    fn run_break(&mut self, span: Span) -> Parse<()> {
        let is_target =
            |frame: &Frame| !matches!(frame.kind, Entered::If | Entered::Include { .. });
        let Some(at) = self.frames.iter().rposition(is_target) else {
            return Err(self.with_trace(
                Diagnostic::error(span, "`#break` outside of a loop, `#switch` or macro")
                    .with_hint(
                        "Remove it, or put it inside `#while`, `#for`, `#switch` or `#macro`.",
                    ),
            ));
        };
        for left in self.frames.drain(at + 1..) {
            if matches!(left.kind, Entered::Include { .. }) {
                self.scopes.leave();
            }
        }
        let frame = &self.frames[at];
        let end = frame.end;
        self.here.tokens = Rc::clone(&frame.home);
        self.jump(end, span)?;
        if !matches!(self.innermost(), Some(Entered::Macro { .. })) {
            self.frames.pop();
            self.pass();
        }
        Ok(())
    }

    /// `#end` closes the innermost group: a loop goes round, a macro goes back to its call.
    fn run_end(&mut self, span: Span) -> Parse<()> {
        if matches!(self.innermost(), Some(Entered::Include { .. }))
            && matches!(
                self.innermost_group(),
                Some(Entered::If | Entered::Switch { .. })
            )
        {
            self.leave_group();
            return Ok(());
        }
        let Some(frame) = self.frames.last_mut() else {
            return Err(self.unopened_end(span));
        };
        match &mut frame.kind {
            Entered::If | Entered::Switch { .. } => {
                self.frames.pop();
                Ok(())
            }
            Entered::While {
                condition, rounds, ..
            } => {
                *rounds += 1;
                self.here.at = *condition;
                self.here.tokens = Rc::clone(&frame.home);
                self.run_while(self.here.at - 1)
            }
            Entered::For(run) => {
                // The body may have changed the variable: POV-Ray counts on from what it holds.
                if let Some(Value::Number(now)) = self.scopes.get(run.variable) {
                    run.value = now.v[0];
                }
                run.value += run.step;
                let (variable, value, is_over, body) =
                    (run.variable, run.value, run.is_over(), run.body);
                if is_over {
                    self.frames.pop();
                } else {
                    self.here.at = body;
                    self.here.tokens = Rc::clone(&frame.home);
                    let end = frame.end;
                    self.count_round(body, end, self.start_taken())?;
                }
                self.scopes
                    .local(variable, Value::Number(Number::float(value)));
                Ok(())
            }
            Entered::Macro { .. } => {
                if let Some(Frame {
                    kind: Entered::Macro { back, .. },
                    ..
                }) = self.frames.pop()
                {
                    self.here = back;
                    self.scopes.leave();
                }
                Ok(())
            }
            Entered::Include { .. } => Err(self.unopened_end(span)),
        }
    }

    fn unopened_end(&self, span: Span) -> Box<Diagnostic> {
        self.with_trace(
            Diagnostic::error(
                span,
                "`#end` without an open `#if`, `#while`, `#for`, `#switch` or `#macro`",
            )
            .with_hint("Remove it, or look for a directive above that lacks its `#`."),
        )
    }

    /// After a condition was read: it must have ended in the file where it began.
    fn stay_in(&mut self, home: &Rc<Tokens>, span: Span) -> Parse<()> {
        if Rc::ptr_eq(home, &self.here.tokens) {
            return Ok(());
        }
        Err(self.with_trace(Diagnostic::error(
            span,
            "the condition of this directive ends in another file",
        )))
    }

    /// Counts the tokens from `from` to the `#end` of a loop, which are read once more.
    fn count_round(&mut self, from: usize, end: u32, at: Start) -> Parse<()> {
        let end = (end as usize).min(self.here.tokens.tokens.len());
        self.count_again(end.saturating_sub(from), at)
    }

    /// The bracketed condition of `#if`, `#elseif` or `#while`.
    fn condition(&mut self) -> Parse<bool> {
        Ok(self.number_in_parentheses()?.abs() > EQUAL)
    }

    fn number_in_parentheses(&mut self) -> Parse<f64> {
        self.expect_mark('(', "`(` and a condition or number")?;
        let open = self.start_taken();
        let value = self.condition_value()?;
        self.expect_end(')', "an operator or `)`", open)?;
        Ok(value)
    }

    fn pair_in_parentheses(&mut self) -> Parse<(f64, f64)> {
        self.expect_mark('(', "`(`")?;
        let low = self.condition_value()?;
        self.take_mark(',')?;
        let high = self.condition_value()?;
        self.expect_mark(')', "`)`")?;
        Ok((low, high))
    }
}

/// Whether the text at hand ends, or what comes next is not all of it.
fn ends_text(token: Token) -> bool {
    matches!(token.kind, Kind::End | Kind::More | Kind::Directive)
}

/// Whether a directive may change what an expression gives.
fn changes_values(word: Word) -> bool {
    matches!(
        word,
        Word::Declare
            | Word::Local
            | Word::Undef
            | Word::For
            | Word::Macro
            | Word::Include
            | Word::Version
            | Word::Default
            | Word::Fopen
            | Word::Fclose
            | Word::Read
    )
}
