//! Macros: text substituted for its call.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::base::version::Novelty;
use crate::lang::diagnose::notation::TYPES;
use crate::lang::directive::sealed::Slot;
use crate::lang::expr::value::Value;
use crate::lang::fast_path::replay::recording::Source;
use crate::lang::frame::{Entered, Macro, Position, Start};
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::scope::Target;
use crate::lang::syntax::{Class, Kind, Symbol};
use smallvec::SmallVec;
use std::rc::Rc;

/// First version whose scenes may have macros.
const FIRST_WITH_MACROS: f64 = 3.1;
const MACRO_IN_OLD_VERSION: &str = "macros need version 3.1 or later";
const NEWER_VERSION: &str = "Write `#version 3.1;` before it.";

/// The argument of a call for one parameter.
pub(crate) enum Argument {
    Reference(Target),
    Value(Value),
    /// An optional argument that is left out: its parameter stays undeclared.
    None,
}

/// The arguments of a call, and where a recorded expression finds each of them. Few macros have more than six.
#[derive(Default)]
pub(crate) struct Arguments {
    pub(crate) values: SmallVec<[Argument; 6]>,
    sources: SmallVec<[Option<Source>; 6]>,
}

impl Reader<'_> {
    /// `#macro Name(A, B) ... #end`: records the position of the body and goes past its `#end`.
    pub(crate) fn define_macro(&mut self, index: usize, span: Span) -> Parse<()> {
        let token = self.here.tokens.tokens[index];
        let end = self.here.tokens.directives[token.value as usize].end;
        if self.draft.version < FIRST_WITH_MACROS {
            self.refused_by_povray(span, MACRO_IN_OLD_VERSION, NEWER_VERSION);
        }
        if end == u32::MAX {
            // The macro takes the rest of the file.
            self.here.at = self.here.tokens.tokens.len() - 1;
            let tokens = Rc::clone(&self.here.tokens);
            let error = Diagnostic::error(span, "this `#macro` has no matching `#end`");
            let error = self.with_swallowed_directive(&tokens, error);
            let remedy = self
                .end_without_hash(index)
                .or_else(|| self.braces_of_macro(index));
            return Err(self.with_trace(match remedy {
                Some(remedy) => remedy.added_to(error),
                None => error.with_hint("Write `#end` after the macro."),
            }));
        }
        let name = self.identifier("a name after `#macro`")?;
        if let Some(held) = self.scopes.get(name)
            && !matches!(held, Value::Macro(_) | Value::Poison(_))
        {
            let error = self.name_is_taken(name, self.start_taken());
            self.record_in_passing(*error);
        }
        let (mut parameters, mut optional) = (Vec::new(), Vec::new());
        if !self.take_raw_mark('(') {
            let name = self.taken_span();
            let text = self.source_text(name).to_owned();
            let error = self.expected_after(name, "`(` after the macro's name");
            return Err(Box::new(error.with_hint(format!(
                "Write `#macro {text}()` if it takes nothing."
            ))));
        }
        loop {
            self.take_raw_mark(',');
            if self.take_raw_mark(')') {
                break;
            }
            let is_optional = self.take_raw_word(Word::Optional);
            optional.push(is_optional);
            let parameter = self.identifier("a parameter or `)` in `#macro`");
            parameters.push(parameter.map_err(|error| {
                self.usage.undeclared.insert(name);
                match self.parameter_of_other_languages() {
                    Some(remedy) if error.hints.is_empty() => Box::new(remedy.added_to(*error)),
                    _ => error,
                }
            })?);
        }
        let defined = Macro {
            tokens: Rc::clone(&self.here.tokens),
            body: self.here.at,
            end,
            parameters,
            optional,
            defined: span.to(self.taken_span()),
        };
        self.scopes.declare(name, Value::Macro(Rc::new(defined)));
        self.here.at = end as usize;
        self.pass();
        Ok(())
    }

    /// Takes the next token of the file if it is a reserved word; no directive before it is run.
    pub(crate) fn take_raw_word(&mut self, word: Word) -> bool {
        let is_it = self.raw().word() == Some(word);
        if is_it {
            self.pass();
        }
        is_it
    }

    fn take_raw_mark(&mut self, mark: char) -> bool {
        let token = self.raw();
        let is_it = token.kind == Kind::Mark && token.value == mark as u32;
        if is_it {
            self.pass();
        }
        is_it
    }

    /// Calls a macro, whose name is next: reads its arguments and enters the body.
    pub(crate) fn call_macro(&mut self, name: Symbol, called: &Rc<Macro>) -> Parse<()> {
        self.pass();
        let call = self.start_taken();
        if self.draft.version < FIRST_WITH_MACROS {
            self.refused_by_povray(self.taken_span(), MACRO_IN_OLD_VERSION, NEWER_VERSION);
        }
        let mut arguments = Arguments::default();
        if !self.replay_arguments(called.parameters.len(), &mut arguments)? {
            // The arguments are not part of the value being declared around the call, or before it without a `;`.
            let declaring = self.statement.declaring.take();
            let sealed = self.statement.sealed.take();
            let read = self.nested(|reader| reader.macro_arguments(name, called, call));
            self.statement.declaring = declaring;
            self.statement.sealed = sealed;
            arguments = read?;
        }
        if self.scopes.depth() as usize >= limits::CALLS {
            return Err(self.with_trace(
                Diagnostic::error(
                    self.span_of(call),
                    format!("macros call each other more than {} deep", limits::CALLS),
                )
                .with_hint("A macro that calls itself needs an `#if` that ends the recursion."),
            ));
        }
        let length = (called.end as usize).saturating_sub(called.body);
        self.count_reread(length, call)?;
        let body = Position {
            tokens: Rc::clone(&called.tokens),
            at: called.body,
        };
        let kind = Entered::Macro {
            back: std::mem::replace(&mut self.here, body),
            call,
            called_to: self.start_taken(),
            name,
            called: Rc::clone(called),
        };
        self.steps += 1;
        self.enter_frame(Rc::clone(&called.tokens), called.end, kind);
        self.scopes.enter();
        for (&parameter, argument) in called.parameters.iter().zip(arguments.values.drain(..)) {
            match argument {
                Argument::Reference(target) => self.scopes.alias(parameter, target),
                Argument::Value(value) => self.scopes.local(parameter, value),
                Argument::None => {}
            }
        }
        if called.optional.contains(&true) {
            self.discard_recording();
        }
        self.note_call(name, called, length, &arguments.sources);
        Ok(())
    }

    fn macro_arguments(&mut self, name: Symbol, called: &Macro, call: Start) -> Parse<Arguments> {
        if !self.take_mark('(')? {
            let spelling = self.names.spelling(name);
            let mut error = self.expected_here(&format!("`(` after the macro `{spelling}`"));
            if !error.message.is_empty() {
                error.hints = vec![self.call_form(name, called)];
                *error = self
                    .name_behind_end(*error, call)
                    .with_label(called.defined, "defined here");
            }
            return Err(error);
        }
        let mut arguments = Arguments::default();
        let wanted = called.parameters.len();
        // An argument is left out at the start or after a comma.
        let mut may_lack = true;
        loop {
            let is_optional = called.optional.get(arguments.values.len()) == Some(&true);
            if is_optional && may_lack && self.take_nothing()? {
                arguments.values.push(Argument::None);
                arguments.sources.push(None);
                may_lack = self.take_mark(',')?;
                continue;
            }
            if self.take_mark(')')? {
                break;
            }
            if arguments.values.len() == wanted {
                let spelling = self.names.spelling(name);
                let error = self.error_here(format!(
                    "the macro `{spelling}` takes {wanted} {}, found a further one",
                    arguments_word(wanted)
                ));
                return Err(Box::new(
                    error
                        .with_label(called.defined, "defined here")
                        .with_hint(self.call_form(name, called)),
                ));
            }
            self.macro_argument(&mut arguments)?;
            may_lack = self.take_mark(',')?;
        }
        if arguments.values.len() < wanted {
            let found = arguments.values.len();
            let spelling = self.names.spelling(name);
            return Err(self.with_trace(
                Diagnostic::error(
                    self.span_of(call),
                    format!(
                        "the macro `{spelling}` takes {wanted} {}, found {found}",
                        arguments_word(wanted)
                    ),
                )
                .with_label(called.defined, "defined here")
                .with_hint(self.call_form(name, called)),
            ));
        }
        Ok(arguments)
    }

    /// The call syntax of a macro, for messages.
    fn call_form(&self, name: Symbol, called: &Macro) -> String {
        let spelling = |&symbol: &Symbol| self.names.spelling(symbol);
        let parameters: Vec<&str> = called.parameters.iter().map(spelling).collect();
        if parameters.contains(&Word::Optional.spelling()) {
            return "Begin the scene with `#version 3.8;` if parameters are `optional`.".to_owned();
        }
        if parameters.iter().any(|name| TYPES.contains(name)) {
            return "Parameters have no types, and are separated by `,`.".to_owned();
        }
        format!("Write `{}({})`.", spelling(&name), parameters.join(", "))
    }

    /// A bare identifier is passed by reference, everything else by value, also names of one scope (`global.Name`).
    fn macro_argument(&mut self, arguments: &mut Arguments) -> Parse<()> {
        let token = self.peek()?;
        let behind = self.raw_ahead(1);
        let ends =
            behind.kind == Kind::Mark && (behind.value == ',' as u32 || behind.value == ')' as u32);
        if token.kind == Kind::Name
            && ends
            && !self.names.is_qualified(Symbol(token.value))
            && let Some(target) = self.scopes.target(Symbol(token.value))
        {
            self.pass();
            let source = self.note_reference(Symbol(token.value));
            arguments.values.push(Argument::Reference(target));
            arguments.sources.push(source);
            return Ok(());
        }
        if token.kind == Kind::Name
            && (behind.is_mark('[') || behind.is_mark('.'))
            && let Some(target) = self.item_by_reference(Symbol(token.value))?
        {
            arguments.values.push(Argument::Reference(target));
            arguments.sources.push(None);
            return Ok(());
        }
        let what = "an argument of the macro";
        match self.sealed(Slot::Argument, |reader| reader.value(what))? {
            Some(value) => {
                arguments.sources.push(self.note_argument(&value));
                arguments.values.push(Argument::Value(value));
                Ok(())
            }
            None => Err(self.expected_here(what)),
        }
    }

    /// An item of an array as a reference, if the argument is nothing else; otherwise nothing is taken.
    fn item_by_reference(&mut self, symbol: Symbol) -> Parse<Option<Target>> {
        let is_entry = self.raw_ahead(1).is_mark('.');
        match self.scopes.get(symbol) {
            Some(Value::Array(array)) if !is_entry || array.is_dictionary() => {}
            _ => return Ok(None),
        }
        self.discard_recording();
        let path = self.item_if(symbol, |reader, has_value| {
            let behind = reader.peek()?;
            Ok(has_value && (behind.is_mark(',') || behind.is_mark(')')))
        })?;
        Ok(path.and_then(|path| self.scopes.target_of_item(symbol, &path)))
    }

    /// An identifier as it is written, whatever it holds; a macro of that name is not called.
    pub(crate) fn identifier(&mut self, what: &str) -> Parse<Symbol> {
        if self.begins_scope_key(self.raw()) {
            self.resolve_scope_key()?;
        }
        let token = self.raw();
        match token.kind {
            Kind::Name => {
                let symbol = Symbol(token.value);
                if self.names.is_qualified(symbol) {
                    if !self.dialect.has_words_of_3_8() {
                        return Err(self.expected_here(what));
                    }
                    self.draft.note_novelty(Novelty::ScopedName);
                }
                self.pass();
                Ok(symbol)
            }
            Kind::Word => {
                let is_value = |word: &Word| matches!(word.class(), Class::Value | Class::Color);
                if token.word().is_some_and(|word| is_value(&word)) {
                    self.usage.declared_words.push(self.here_span());
                }
                let word = token.word().map_or("", Word::spelling);
                Err(self.with_trace(
                    Diagnostic::error(
                        self.here_span(),
                        format!("expected {what}, found the reserved word `{word}`"),
                    )
                    .with_hint(format!(
                        "Reserved words cannot be declared; `{}` could.",
                        capitalised(word)
                    )),
                ))
            }
            Kind::Directive => {
                let found = self.describe(token);
                let error = self.error_here(format!("expected {what}, found {found}"));
                let last = self.here.at.saturating_sub(1);
                let last = self.source_text(self.here.tokens.span(last));
                let is_doubled = found.trim_matches('`') == last;
                Err(match is_doubled {
                    true => Box::new(error.with_hint("Remove one of the two.")),
                    false => error,
                })
            }
            Kind::End => {
                self.peek()?;
                Err(self.expected_here(what))
            }
            _ => Err(self.expected_here(what)),
        }
    }
}

fn arguments_word(count: usize) -> &'static str {
    if count == 1 { "argument" } else { "arguments" }
}

fn capitalised(word: &str) -> String {
    word.split('_')
        .map(|part| part[..1].to_uppercase() + &part[1..])
        .collect::<Vec<_>>()
        .join("_")
}
