//! The cursor: one stream of tokens out of files, loops and macro calls.
//!
//! POV-Ray's directives act between any two tokens, and a macro is text substituted for its call. So `peek` runs every
//! directive, enters every include and opens every macro call before the next token; the readers see none of that.

use super::expr::scope_key::is_scope;
use super::expr::value::Value;
use super::frame::{Entered, Frame, Start, is_bare_directive};
use super::reader::Reader;
use super::syntax::{Kind, Symbol, Token, Tokens};
use super::{limits, syntax};
use crate::base::args::{Parse, Word};
use crate::base::source::{Code, Diagnostic, Span};
use std::rc::Rc;

impl Reader<'_> {
    /// Pushes a frame.
    pub(super) fn enter_frame(&mut self, home: Rc<Tokens>, end: u32, kind: Entered) {
        let repeats = match kind {
            Entered::While { .. } | Entered::For(_) | Entered::Macro { .. } => true,
            Entered::If | Entered::Switch { .. } | Entered::Include { .. } => self.is_repeated(),
        };
        self.frames.push(Frame {
            home,
            end,
            kind,
            repeats,
        });
    }

    /// True if the current text may be read again.
    pub(super) fn is_repeated(&self) -> bool {
        self.frames.last().is_some_and(|frame| frame.repeats)
    }

    /// The next token, without taking it. Directives before it have run.
    #[inline(always)]
    pub(super) fn peek(&mut self) -> Parse<Token> {
        let token = self.raw();
        match token.kind {
            Kind::Name | Kind::Word | Kind::Directive | Kind::DataSegment | Kind::End => {
                self.peek_word(token)
            }
            _ => Ok(token),
        }
    }

    /// The same where a name or word may be a macro call or a bare directive.
    fn peek_word(&mut self, token: Token) -> Parse<Token> {
        let stays = match token.kind {
            Kind::Name => {
                !self.scopes.is_macro(Symbol(token.value)) && self.usage.deprecated.is_empty()
            }
            Kind::Word => !is_bare_directive(token) && !is_scope(token),
            _ => false,
        };
        if stays {
            return Ok(token);
        }
        self.peek_through(token)
    }

    /// Goes through macro calls, directives and the ends of files to the next token.
    #[inline(never)]
    fn peek_through(&mut self, mut token: Token) -> Parse<Token> {
        if self.statement.declaring.is_some_and(|open| open.has_ended) {
            return Ok(token);
        }
        loop {
            match token.kind {
                Kind::Name => {
                    if !self.usage.deprecated.is_empty() {
                        self.warn_of_deprecated(Symbol(token.value));
                    }
                    let Some(Value::Macro(called)) = self.scopes.get(Symbol(token.value)) else {
                        return Ok(token);
                    };
                    let called = Rc::clone(called);
                    self.warn_if_sealed(token);
                    self.call_macro(Symbol(token.value), &called)?;
                    self.statement.directive_end = self.taken;
                }
                Kind::Directive if self.ends_value(token) => return Ok(token),
                Kind::Directive => {
                    if !(self.here.tokens.is_end(token) && self.is_in_noted_call()) {
                        self.discard_recording();
                    }
                    self.warn_if_sealed(token);
                    let leaves_macro = self.is_end_of_macro();
                    let is_run = match self.replay_directive(token) {
                        Ok(false) => self.run_directive(token),
                        Ok(true) => Ok(()),
                        Err(error) => Err(error),
                    };
                    if !leaves_macro {
                        self.statement.directive_end = self.taken;
                    }
                    if let Err(error) = is_run {
                        self.statement.has_faulty_directive = true;
                        return Err(error);
                    }
                }
                Kind::Word if is_bare_directive(token) => {
                    self.discard_recording();
                    self.run_bare_directive(token)?;
                }
                Kind::Word if self.begins_scope_key(token) => self.resolve_scope_key()?,
                Kind::DataSegment => {
                    self.discard_recording();
                    self.read_on();
                }
                Kind::End => {
                    self.discard_recording();
                    if !self.leave_file() {
                        return Ok(token);
                    }
                }
                _ => return Ok(token),
            }
            token = self.raw();
        }
    }

    /// True if a directive ends the value of the `#declare` being read: another declaration at the same level does,
    /// since it would otherwise run before the name has its value. After a complete value it may stand in an `#if` or
    /// a loop as well, entered while peeking. The number of `#version` is ended by any directive.
    fn ends_value(&self, token: Token) -> bool {
        if self.statement.is_in_version {
            return true;
        }
        let Some(open) = self.statement.declaring else {
            return false;
        };
        let frames = self.frames.len();
        (frames <= open.frames || open.is_complete)
            && (self.statement.depth, self.blocks.len()) == (open.depth, open.blocks)
            && self.here.tokens.directives[token.value as usize]
                .word
                .is_some_and(|word| self.is_unrelated_directive(word))
    }

    /// True for a directive that does not belong to the value before it. In old versions no `;` is needed there.
    fn is_unrelated_directive(&self, word: Word) -> bool {
        match word {
            Word::Declare | Word::Local | Word::Macro | Word::Undef => true,
            Word::Debug
            | Word::Warning
            | Word::Error
            | Word::Render
            | Word::Statistics
            | Word::Include
            | Word::Default
            | Word::Version
            | Word::Fopen
            | Word::Fclose
            | Word::Read
            | Word::Write => self.draft.version < 3.5,
            _ => false,
        }
    }

    /// True if the next token is the `#end` of the innermost macro.
    pub(super) fn is_end_of_macro(&self) -> bool {
        let token = self.raw();
        let innermost = self.frames.last().map(|frame| &frame.kind);
        token.kind == Kind::Directive
            && self.here.tokens.is_end(token)
            && matches!(innermost, Some(Entered::Macro { .. }))
    }

    /// Takes the next token, which `peek` has returned.
    pub(super) fn pass(&mut self) {
        if !Rc::ptr_eq(&self.last.tokens, &self.here.tokens) {
            self.last.tokens = Rc::clone(&self.here.tokens);
        }
        self.last.at = self.here.at;
        self.here.at += 1;
        self.taken += 1;
    }

    /// The next token as it stands in the file: no directive is run, no macro called.
    pub(super) fn raw(&self) -> Token {
        self.in_version(self.here.tokens.tokens[self.here.at])
    }

    /// A token as the language version in force reads it: names may be reserved words since 3.8.
    #[inline(always)]
    fn in_version(&self, token: Token) -> Token {
        match self.dialect.has_words_of_3_8() {
            true => self.dialect.token(token, self.here.tokens.file),
            false => token,
        }
    }

    /// The token `ahead` tokens further in the same file.
    pub(super) fn raw_ahead(&self, ahead: usize) -> Token {
        let tokens = &self.here.tokens.tokens;
        self.in_version(tokens[(self.here.at + ahead).min(tokens.len() - 1)])
    }

    /// The span of the next token.
    pub(super) fn here_span(&self) -> Span {
        self.here.tokens.span(self.here.at)
    }

    /// The span of the last token taken.
    pub(super) fn taken_span(&self) -> Span {
        self.last.tokens.span(self.last.at)
    }

    /// The start of the next token, once directives before it have run.
    pub(super) fn start(&mut self) -> Parse<Start> {
        let start = self.peek()?.start;
        Ok(Start {
            file: self.here.tokens.file,
            start,
        })
    }

    /// The start of the next token as it stands in the file.
    pub(super) fn start_here(&self) -> Start {
        Start::of(&self.here.tokens, self.here.at)
    }

    /// The start of the last token taken.
    pub(super) fn start_taken(&self) -> Start {
        Start::of(&self.last.tokens, self.last.at)
    }

    /// The span of the token that begins at `start`.
    pub(super) fn span_of(&self, start: Start) -> Span {
        syntax::span_at(start.file, self.sources.text(start.file), start.start)
    }

    /// From a token to the last one taken.
    pub(super) fn span_from(&self, start: Start) -> Span {
        self.span_of(start).to(self.taken_span())
    }

    /// Takes the next token if it is a punctuation mark.
    #[inline(always)]
    pub(super) fn take_mark(&mut self, mark: char) -> Parse<bool> {
        let is_it = self.peek()?.is_mark(mark);
        if is_it {
            self.pass();
        }
        Ok(is_it)
    }

    /// Takes the next token if it is a reserved word.
    pub(super) fn take_word(&mut self, word: Word) -> Parse<bool> {
        let token = self.peek()?;
        let is_it = token.kind == Kind::Word && token.value == word as u32;
        if is_it {
            self.pass();
        }
        Ok(is_it)
    }

    /// Takes a punctuation mark, or reports what should stand there.
    pub(super) fn expect_mark(&mut self, mark: char, what: &str) -> Parse<()> {
        if self.take_mark(mark)? {
            Ok(())
        } else {
            Err(self.expected_here(what))
        }
    }

    /// Takes the mark that closes what was opened at `open`, or reports what should stand there.
    pub(super) fn expect_end(&mut self, mark: char, what: &str, open: Start) -> Parse<()> {
        self.expect_mark(mark, what)
            .map_err(|error| self.with_opened(error, mark, open))
    }

    /// Takes the `{` of an element and remembers it for messages.
    pub(super) fn open_block(&mut self) -> Parse<()> {
        if !self.take_mark('{')? {
            let element = self.taken_span();
            let error = self.no_block(element);
            // Recovery has to skip its `}` as well.
            self.blocks.push(self.start_taken());
            return Err(error);
        }
        if self.blocks.len() >= limits::NESTING {
            let message = format!("blocks are nested more than {} deep", limits::NESTING);
            return Err(self.error_here(message));
        }
        self.blocks.push(self.start_taken());
        Ok(())
    }

    /// Takes the `}` of the innermost open element if it is next.
    pub(super) fn take_close(&mut self) -> Parse<bool> {
        let is_it = self.take_mark('}')?;
        if is_it {
            self.blocks.pop();
        }
        Ok(is_it)
    }

    /// "expected WHAT, found ..." at the next token.
    pub(super) fn expected_here(&mut self, what: &str) -> Box<Diagnostic> {
        if let Err(earlier) = self.peek() {
            return earlier;
        }
        let token = self.raw();
        if let Some(error) = self.poison_error(token) {
            return error;
        }
        if self.is_known_as_undeclared(token) {
            return self.consequence();
        }
        let found = self.describe(token);
        // The end of the file is reported where the text ends, not after the blank lines that follow it.
        let span = match (token.kind, self.here.at.checked_sub(1)) {
            (Kind::End, Some(last)) => {
                let last = self.here.tokens.span(last);
                let end = self.end_of_text(last);
                Span::new(last.file, end, end)
            }
            _ => self.here_span(),
        };
        let mut diagnostic = Diagnostic::error(span, format!("expected {what}, found {found}"));
        if token.kind == Kind::Name && self.scopes.get(Symbol(token.value)).is_none() {
            diagnostic.code = Some(Code::Undeclared);
        }
        if let Some(rule) = self.foreign_format() {
            self.is_over = true;
            return self.with_trace(diagnostic.with_hint(rule));
        }
        if let Some(remedy) = self.remedy(token, what) {
            diagnostic = remedy.added_to(diagnostic);
        }
        if let Some(&open) = self.blocks.last()
            && (token.kind == Kind::End || what.contains("`}`"))
        {
            diagnostic = self.with_block(diagnostic, token, self.span_of(open));
        }
        self.with_trace(diagnostic)
    }

    /// The end of the text of a file whose last token is known: literal objects behind it have none.
    fn end_of_text(&self, last: Span) -> u32 {
        let text = self.sources.text(last.file);
        let behind = text.get(last.end as usize..).unwrap_or_default().trim();
        match behind.is_empty() || behind.starts_with("//") || behind.starts_with("/*") {
            true => last.end,
            false => u32::try_from(text.trim_end().len()).unwrap_or(last.end),
        }
    }

    /// An error at the next token.
    pub(super) fn error_here(&self, message: impl Into<String>) -> Box<Diagnostic> {
        self.with_trace(Diagnostic::error(self.here_span(), message))
    }

    /// An error at the last token taken.
    pub(super) fn error_taken(&self, message: impl Into<String>) -> Box<Diagnostic> {
        self.with_trace(Diagnostic::error(self.taken_span(), message))
    }

    /// Describes a token in the author's words.
    pub(super) fn describe(&self, token: Token) -> String {
        let text = || {
            let text = self.source_text(self.here_span());
            let line = text.lines().next().unwrap_or_default();
            let short: String = line.chars().take(limits::QUOTED).collect();
            match (short.len() < text.len(), token.kind) {
                (false, _) => short,
                (true, Kind::String) => format!("{short}...\""),
                (true, _) => format!("{short}..."),
            }
        };
        match token.kind {
            Kind::End => "the end of the file".to_owned(),
            Kind::Number => format!("the number `{}`", text()),
            Kind::String => format!("the string {}", text()),
            Kind::Name => {
                let symbol = Symbol(token.value);
                // A computed key stands in the text as an expression.
                let name = match self.names.is_qualified(symbol) {
                    true => self.names.spelling(symbol).to_owned(),
                    false => text(),
                };
                match self.scopes.get(symbol) {
                    None => format!("the undeclared identifier `{name}`"),
                    Some(value) => format!("`{name}`, which is {}", value.kind()),
                }
            }
            Kind::Mark if token.is_mark('`') => "a backquote".to_owned(),
            Kind::Mark if is_invisible(token.value) => {
                format!("the invisible character U+{:04X}", token.value)
            }
            _ => format!("`{}`", text()),
        }
    }

    /// The text of a span.
    pub(super) fn source_text(&self, span: Span) -> &str {
        let text = self.sources.text(span.file);
        text.get(span.start as usize..span.end as usize)
            .unwrap_or("")
    }

    /// At the end of a file: returns to the `#include` that entered it. False in the scene file itself.
    pub(super) fn leave_file(&mut self) -> bool {
        let Some(at) = self
            .frames
            .iter()
            .rposition(|frame| matches!(frame.kind, Entered::Include { .. }))
        else {
            return false;
        };
        if self.frames[at..]
            .iter()
            .any(|frame| matches!(frame.kind, Entered::Macro { .. }))
        {
            return false;
        }
        if let Entered::Include { back, .. } = self.frames.remove(at).kind {
            self.here = back;
            self.scopes.leave();
        }
        true
    }
}

/// True for the code of a character that cannot be seen in a message.
fn is_invisible(code: u32) -> bool {
    let letter = char::from_u32(code);
    letter.is_some_and(|letter| letter.is_whitespace() || letter.is_control())
        || matches!(code, 0xad | 0x200b..=0x200f | 0x2028..=0x202e | 0x2060)
}
