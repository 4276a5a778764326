//! Directives that control the flow of reading: conditions, loops, `#switch`, the `#end` of macros.

use crate::base::args::{Parse, Word};
use crate::base::source::{Code, Diagnostic, Span};
use crate::lang::directive::sealed::Slot;
use crate::lang::expr::value::{Number, Value};
use crate::lang::frame::{Entered, Frame, Position};
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Token, Tokens};
use std::rc::Rc;

impl Reader<'_> {
    /// Runs the next directive and leaves the cursor where reading goes on.
    pub(crate) fn run_directive(&mut self, token: Token) -> Parse<()> {
        let index = self.here.at;
        let span = self.here_span();
        self.steps += 1;
        self.pass();
        let Some(word) = self.here.tokens.directives[token.value as usize].word else {
            return self.nested(|reader| reader.run_hash(span));
        };
        let frames = self.frames.len();
        let home = Rc::clone(&self.here.tokens);
        // The text of a directive is not part of the value being declared around it.
        let declaring = self.statement.declaring.take();
        let sealed = self.statement.sealed.take();
        let result = self.nested(|reader| reader.dispatch_directive(word, index, span));
        self.statement.declaring = declaring;
        self.statement.sealed = sealed;
        match result {
            Err(error) if crate::lang::diagnose::hints::opens_group(word) && !self.is_over => self
                .resume_in_group(
                    error,
                    &Position {
                        tokens: home,
                        at: index,
                    },
                    frames,
                ),
            // Errors in passing, as a missing `;`, do not end the statement.
            Ok(()) if self.report.is_full() => Err(self.consequence()),
            result => result,
        }
    }

    /// After an error in the head of a directive that opens a group: reports it and goes on in the first part of an
    /// `#if`, after the `#end` of anything else, so that this `#end` does not count as unmatched.
    fn resume_in_group(
        &mut self,
        error: Box<Diagnostic>,
        opener: &Position,
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
        if self.report.is_full() {
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

    /// Skips the next parentheses, or, where they are missing, everything up to the next object, statement or
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

    fn dispatch_directive(&mut self, word: Word, index: usize, span: Span) -> Parse<()> {
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
                        changes: None,
                    },
                );
                self.run_while(index)
            }
            Word::For => self.run_for(index, span),
            Word::Switch => self.run_switch(index),
            Word::Case | Word::Range => self.run_case(index, span, word),
            Word::Break => self.run_break(span),
            Word::End => self.run_end(),
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
                Diagnostic::error(span, format!("`#{word}` is not supported yet"))
                    .with_code(Code::NotBuilt),
            )),
        }
    }

    /// Runs `declare` or `include` written without `#`.
    pub(crate) fn run_bare_directive(&mut self, token: Token) -> Parse<()> {
        let span = self.here_span();
        self.changes += 1;
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

    /// Goes past the next directive of the group; an error where the group is not closed.
    pub(crate) fn jump(&mut self, to: u32, span: Span) -> Parse<()> {
        if to == u32::MAX {
            return Err(self.with_trace(
                Diagnostic::error(span, "this directive has no matching `#end`")
                    .with_hint("Write `#end` where it is to end."),
            ));
        }
        self.here.at = to as usize;
        Ok(())
    }

    /// Enters the group of the directive at `index` of the current file.
    pub(crate) fn enter(&mut self, index: usize, kind: Entered) {
        let (_, end) = self.group(index);
        self.enter_frame(Rc::clone(&self.here.tokens), end, kind);
    }

    pub(crate) fn innermost(&self) -> Option<&Entered> {
        self.frames.last().map(|frame| &frame.kind)
    }

    /// The next part and the `#end` of the group of a directive of the current file.
    pub(crate) fn group(&self, index: usize) -> (u32, u32) {
        let tokens = &self.here.tokens;
        let token = tokens.tokens.get(index);
        let directive = token.and_then(|token| tokens.directives.get(token.value as usize));
        directive.map_or((u32::MAX, u32::MAX), |directive| {
            (directive.next, directive.end)
        })
    }

    /// The innermost group, which may have begun in a file that includes the current one.
    pub(crate) fn innermost_group(&mut self) -> Option<&mut Entered> {
        let is_group = |frame: &&mut Frame| !matches!(frame.kind, Entered::Include { .. });
        let mut frames = self.frames.iter_mut().rev();
        frames.find(is_group).map(|frame| &mut frame.kind)
    }

    /// Ends the innermost group.
    pub(crate) fn leave_group(&mut self) {
        let is_group = |frame: &Frame| !matches!(frame.kind, Entered::Include { .. });
        if let Some(at) = self.frames.iter().rposition(is_group) {
            self.frames.remove(at);
        }
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

    /// `#end` closes the innermost group: a loop starts its next round, a macro returns to its call.
    pub(crate) fn run_end(&mut self) -> Parse<()> {
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
            return Err(self.unopened_end());
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
                // The body may have changed the variable: POV-Ray counts on from its current value.
                let now = match self.scopes.get(run.variable()) {
                    Some(Value::Number(now)) => Some(now.v[0]),
                    _ => None,
                };
                let value = run.count_on(now);
                let (variable, is_over, body) = (run.variable(), run.is_over(), run.body());
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
            Entered::Include { .. } => Err(self.unopened_end()),
        }
    }

    fn unopened_end(&self) -> Box<Diagnostic> {
        let span = self.taken_span();
        self.with_trace(
            Diagnostic::error(
                span,
                "`#end` without an open `#if`, `#while`, `#for`, `#switch` or `#macro`",
            )
            .with_hint("Remove it, or look for a directive above that lacks its `#`."),
        )
    }

    /// Checks that a condition ended in the file where it began.
    pub(crate) fn stay_in(&mut self, home: &Rc<Tokens>, span: Span) -> Parse<()> {
        if Rc::ptr_eq(home, &self.here.tokens) {
            return Ok(());
        }
        Err(self.with_trace(Diagnostic::error(
            span,
            "the condition of this directive ends in another file",
        )))
    }

    /// The condition in parentheses of `#if`, `#elseif` or `#while`.
    pub(crate) fn condition(&mut self) -> Parse<bool> {
        Ok(self.number_in_parentheses()?.abs() > EQUAL)
    }

    pub(crate) fn number_in_parentheses(&mut self) -> Parse<f64> {
        if let Some(number) = self.replay_parentheses(self.here.at)? {
            return Ok(number);
        }
        if !self.take_mark('(')? {
            return Err(self.no_condition());
        }
        let open = self.start_taken();
        let value = self.sealed(Slot::Condition, Self::condition_value)?;
        self.expect_end(')', "an operator or `)`", open)?;
        Ok(value)
    }

    pub(crate) fn pair_in_parentheses(&mut self) -> Parse<(f64, f64)> {
        self.expect_mark('(', "`(`")?;
        let low = self.sealed(Slot::Condition, Self::condition_value)?;
        self.take_mark(',')?;
        let high = self.sealed(Slot::Condition, Self::condition_value)?;
        self.expect_mark(')', "`)`")?;
        Ok((low, high))
    }
}

/// True where the current text ends, or its next token is not all of it.
fn ends_text(token: Token) -> bool {
    matches!(token.kind, Kind::End | Kind::DataSegment | Kind::Directive)
}

/// True if a directive may change the value of an expression.
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
