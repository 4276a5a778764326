//! `#` before anything but a directive.
//!
//! It is ignored unless a float follows: a number, a name of one, or a function that gives one. The lexer keeps the `#`
//! where that has to be checked.

use crate::base::args::{Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::css_colors::{hexadecimal_color, written_color};
use crate::lang::diagnose::other_dialects;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::{Number, Value};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Token};

impl Reader<'_> {
    /// Handles a `#` that begins no directive and has been taken. An undeclared name after it is taken for a misspelt
    /// directive.
    pub(crate) fn run_hash(&mut self, hash: Span) -> Parse<()> {
        let name = self.raw().symbol();
        if name.is_some_and(|name| self.scopes.get(name).is_none()) {
            let name = self.here_span();
            self.here.at += 1;
            // A name that the misspelt directive declares need not be reported as undeclared.
            if let Some(declared) = self.raw().symbol() {
                self.usage.undeclared.insert(declared);
            }
            return Err(self.no_directive(hash, name));
        }
        let color = self.hexadecimal_color(hash);
        let token = self.peek()?;
        if !self.is_float(token) {
            return Ok(());
        }
        let error = Diagnostic::error(hash, "unexpected `#` before a number");
        Err(self.with_trace(match color {
            Some(remedy) => remedy.added_to(error),
            None => error.with_hint("Remove it."),
        }))
    }

    fn no_directive(&self, hash: Span, name: Span) -> Box<Diagnostic> {
        let found = self.source_text(name).to_owned();
        let both = hash.to(name);
        let error = Diagnostic::error(both, format!("`#{found}` is not a directive"));
        let remedy = if let Some(remedy) = self.hexadecimal_color(hash) {
            remedy
        } else if let Some(near) = Self::similar_directive(&found) {
            let directive = format!("#{near}");
            Remedy::fix(format!("Did you mean `{directive}`?"), both, directive)
        } else if hash.end < name.start {
            Remedy::fix("Comments begin with `//`.", hash, "//")
        } else if found == "define"
            && let Some(remedy) = self.definition_of_c(hash)
        {
            remedy
        } else if let Some(directive) = other_dialects::directive(&found) {
            Remedy::fix(format!("Write `{directive}`."), both, directive)
        } else {
            "Comments begin with `//`; directives are `#declare`, `#if`, `#while`, `#macro`, `#include` and the like.".into()
        };
        self.with_trace(remedy.added_to(error))
    }

    /// A colour in HTML's form: `#ff8000`. Without digits it may be a word, except in a block.
    fn hexadecimal_color(&self, hash: Span) -> Option<Remedy> {
        let behind = self.sources.text(hash.file).get(hash.end as usize..)?;
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let len = behind.find(|c| !is_part(c)).unwrap_or(behind.len());
        let digits = &behind[..len];
        let color = hexadecimal_color(digits)?;
        let is_color = !self.blocks.is_empty() || digits.contains(|c: char| c.is_ascii_digit());
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < hash.start);
        let end = hash.end + u32::try_from(len).ok()?;
        let span = Span::new(hash.file, hash.start, end);
        (is_color && tokens.file == hash.file).then(|| self.colored(at, span, written_color(color)))
    }

    /// True if a float begins with this token.
    fn is_float(&self, token: Token) -> bool {
        match token.kind {
            Kind::Number => true,
            Kind::Name => match token.symbol().and_then(|name| self.scopes.get(name)) {
                Some(Value::Number(Number { len: 1, .. })) => true,
                Some(Value::Array(array)) => array.holds == Some(FLOAT),
                _ => false,
            },
            _ => token.word().is_some_and(Word::gives_float),
        }
    }

    /// Skips a `#` before a name, declared or not.
    pub(crate) fn pass_hash(&mut self) {
        if self.here.tokens.is_hash(self.raw()) {
            self.pass();
        }
    }

    /// Skips a `#` before a name that is not declared: one that a loop or a function introduces.
    pub(crate) fn pass_hash_of_new_name(&mut self) {
        let name = self.raw_ahead(1).symbol();
        if name.is_some_and(|name| self.scopes.get(name).is_none()) {
            self.pass_hash();
        }
    }
}

/// The sort of floats in arrays.
const FLOAT: &str = "a number";
