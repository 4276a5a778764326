//! The `;` after declarations.
//!
//! A number, a vector, a colour and a named function need one from version 3.5 on, and may have two; anything else may
//! have one. Each may stand after the end of the macro or file in which the value ends, as in
//! `#macro M() #declare A = 1 #end  M();`, but no directive may stand before it.

use crate::base::args::{Args, Parse};
use crate::base::source::{Diagnostic, Fix, Span};
use crate::lang::expr::value::Value;
use crate::lang::frame::{Declaring, Entered, Frame};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Token};

impl Reader<'_> {
    /// The token after consecutive ends of macros and files, from a token of the current text on, and the number of
    /// these ends.
    pub(crate) fn after_ends(&self, from: usize) -> (u32, Token) {
        let (mut tokens, mut at) = (&self.here.tokens, from);
        let mut ends = 0;
        for frame in self.frames.iter().rev() {
            let token = tokens.tokens[at];
            let back = match &frame.kind {
                Entered::Macro { back, .. } if tokens.is_end(token) => back,
                Entered::Include { back, .. } if token.kind == Kind::End => back,
                _ => break,
            };
            (tokens, at) = (&back.tokens, back.at);
            ends += 1;
        }
        (ends, tokens.tokens[at])
    }

    /// Takes a `;` that is next, or that follows ends of macros and files, which are then left.
    pub(crate) fn take_semicolon(&mut self) -> bool {
        let (ends, token) = self.after_ends(self.here.at);
        let is_it = token.is_mark(';');
        if is_it {
            for _ in 0..ends {
                self.leave_macro_or_file();
            }
            self.pass();
        }
        is_it
    }

    fn leave_macro_or_file(&mut self) {
        self.discard_recording();
        if let Some(Frame {
            kind: Entered::Macro { back, .. } | Entered::Include { back, .. },
            ..
        }) = self.frames.pop()
        {
            self.here = back;
            self.scopes.leave();
        }
    }

    /// After a part of a number that is being declared: if a directive follows, a `;` is missing. Before 3.5 the number
    /// ends there. From then on the directive runs before the name has its value, and must not report the name as
    /// undeclared.
    pub(crate) fn look_for_semicolon(&mut self) {
        let next = self.raw();
        if !matches!(next.kind, Kind::Directive | Kind::End | Kind::Name) {
            return;
        }
        let level = (self.statement.depth, self.blocks.len());
        let Some(open) = self
            .statement
            .declaring
            .filter(|open| (open.depth, open.blocks) == level)
        else {
            return;
        };
        if self.ends_before_directive(next)
            || self.ends_before_macro(next)
            || self.ends_with_scope(&open)
        {
            self.statement.declaring = Some(Declaring {
                has_ended: true,
                ..open
            });
            return;
        }
        if next.kind != Kind::Directive || self.draft.version < 3.5 {
            return;
        }
        if self.is_end_of_macro() && self.scopes.depth() > open.scope {
            return;
        }
        self.statement.without_semicolon =
            Some((self.taken_span(), self.here.clone(), self.frames.len()));
        if !open.is_item && self.scopes.get(open.symbol).is_none() {
            self.assign(&open, Value::Poison(None));
        }
    }

    /// True if a number ends here because a directive follows: before 3.5 it needs no `;`.
    fn ends_before_directive(&self, next: Token) -> bool {
        self.draft.version < 3.5 && next.kind == Kind::Directive && !self.is_end_of_macro()
    }

    /// True if a number ends here because a macro call follows, which may use its name: before 3.5 it needs no `;`.
    fn ends_before_macro(&self, next: Token) -> bool {
        self.draft.version < 3.5 && next.symbol().is_some_and(|name| self.scopes.is_macro(name))
    }

    /// True if the macro or file that declares a name ends next, and the number with it: the name, which may be a
    /// parameter, must get its value before the scope closes.
    fn ends_with_scope(&self, open: &Declaring) -> bool {
        let (ends, behind) = self.after_ends(self.here.at);
        let goes_on = || {
            ['+', '-', '*', '/', '.']
                .into_iter()
                .any(|mark| behind.is_mark(mark))
        };
        ends > self.scopes.depth().saturating_sub(open.scope)
            && (behind.is_mark(';') || self.draft.version < 3.5 && !goes_on())
    }

    /// Numbers must end with `;` from version 3.5 on; elsewhere it is optional.
    pub(crate) fn end_of_declaration(&mut self, is_number: bool) -> Parse<()> {
        let next = self.raw();
        let has_ended = is_number && self.ends_before_directive(next);
        let is_before_macro = next.symbol().is_some_and(|name| self.scopes.is_macro(name));
        if self.take_semicolon() || !has_ended && self.take_mark(';')? {
            if is_number {
                self.take_semicolon();
            } else if is_before_macro || self.statement.directive_end + 1 == self.taken {
                let reason = "no directive or macro may stand between a value and its `;`";
                let remedy = "Remove the `;`: only numbers, vectors and colours need one.";
                self.refused_by_povray(self.taken_span(), reason, remedy);
            }
            if let Some((last, ..)) = self.statement.without_semicolon.take() {
                self.report_missing_semicolon(last);
            }
            return Ok(());
        }
        if !is_number {
            self.statement.without_semicolon = None;
            return Ok(());
        }
        let next = self.raw();
        if self.draft.version >= 3.5
            && self.statement.without_semicolon.is_none()
            && self.is_at_foreign_operator()
        {
            return Err(self.expected_here("an operator or `;` after the value"));
        }
        if self.draft.version >= 3.5
            && self.statement.without_semicolon.is_none()
            && self.is_factor_in_the_same_line(next)
        {
            let error = self.expected_here("an operator or `;` after the value");
            return Err(Box::new(error.with_hint("Write `*` between factors.")));
        }
        let last = match self.statement.without_semicolon.take() {
            Some((last, position, frames)) => {
                // The directive ran without the value; from here on the value is there.
                if self.is_within(frames) {
                    self.frames.truncate(frames);
                    self.here = position;
                }
                last
            }
            None => self.taken_span(),
        };
        self.report_missing_semicolon(last);
        Ok(())
    }

    /// True if the next token is a number or the name of one, and the line of the last one goes on with it.
    fn is_factor_in_the_same_line(&self, next: Token) -> bool {
        let name = next.symbol().and_then(|name| self.scopes.get(name));
        let is_factor = next.kind == Kind::Number || matches!(name, Some(Value::Number(_)));
        let (last, here) = (self.taken_span(), self.here_span());
        let between = Span::new(here.file, last.end, here.start);
        is_factor
            && last.file == here.file
            && last.end < here.start
            && !self.source_text(between).contains(['\n', '\r'])
    }

    /// Reports a missing `;` after a number.
    pub(crate) fn report_missing_semicolon(&mut self, last: Span) {
        let behind = Span::new(last.file, last.end.saturating_sub(1), last.end);
        let message = "a declared number, vector or colour must end with `;`";
        if self.draft.version >= 3.5 {
            let end = Fix {
                span: Span::new(last.file, last.end, last.end),
                text: ";".to_owned(),
            };
            let error = Diagnostic::error(behind, message).with_fix("Add `;` here.", end);
            self.record_in_passing(*self.with_trace(error));
        } else {
            self.warning(Diagnostic::warning(behind, message));
        }
    }
}
