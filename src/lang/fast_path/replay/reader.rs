//! Whole objects whose expressions are all recorded or literal: their readers take them from the tokens directly.
//!
//! [`ReplayReader`] gives up at any token other than words, marks, elements and such expressions: at a directive, a
//! macro, a string, and at every error or warning. It has no effect up to there, and the cursor reads the object.

use super::cache::{Known, Level, ReplayCache};
use super::recorded_sphere::color_of;
use super::recording::RecordedSphere;
use crate::base::args::{AnyObject, Args, Interner, Parse, Word};
use crate::base::color::{Color, Gamma};
use crate::base::source::{Diagnostic, Span};
use crate::lang::expr::streams::Streams;
use crate::lang::expr::value::{Number, Value};
use crate::lang::fast_path::common_object::{Read, plain_object};
use crate::lang::fast_path::numbers::literal_at;
use crate::lang::frame::is_bare_directive;
use crate::lang::reader::Reader;
use crate::lang::scope::Scopes;
use crate::lang::syntax::{Class, Kind, Symbol, Token, Tokens};
use crate::scene::shape::Shape;
use crate::scene::texture::{Layer, Pigment};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

/// After this many readings in a row that could not be replayed, an object is always read.
const MAX_READINGS: u8 = 20;

/// Limit on recorded spheres; a scene may have them recorded again and again.
const MAX_SPHERES: usize = 1 << 16;

/// A cursor over the tokens of one file that runs no directives.
struct ReplayReader<'a> {
    tokens: &'a Tokens,
    at: usize,
    replays: &'a mut ReplayCache,
    scopes: &'a Scopes,
    streams: &'a mut Streams,
    default: &'a Layer,
    version: f64,
    gamma: Option<Gamma>,
    alike: &'a Interner,
    /// True if there was something that only the cursor can decide.
    needs_tokens: Cell<bool>,
}

impl Reader<'_> {
    /// The next object if it can be replayed.
    pub(in crate::lang) fn replay_object(&mut self) -> Parse<Option<Read>> {
        if !self.is_repeated() || !self.may_replay() {
            return Ok(None);
        }
        let (file, start) = (self.here.tokens.file, self.here.at);
        let readings = match self.replays.known(file, start, Level::Object) {
            Known::RecordedSphere(index) => {
                if let Some((sphere, color)) = self.replay_recorded_sphere(index)? {
                    let shape = Shape::Sphere(sphere);
                    return Ok(Some(Read::Shape { shape, color }));
                }
                0
            }
            Known::Replayed => 0,
            Known::Read(readings) => readings,
            // Its expressions are recorded now.
            Known::Nothing => {
                if matches!(self.raw().word(), Some(word) if begins_object(word)) {
                    self.replays.set(file, start, Level::Object, Known::Read(0));
                }
                return Ok(None);
            }
            Known::Never | Known::Program(_) => return Ok(None),
        };
        let gamma = Args::working_gamma(self);
        self.replays.begin();
        let mut quiet = ReplayReader {
            tokens: &self.here.tokens,
            at: start,
            replays: &mut self.replays,
            scopes: &self.scopes,
            streams: &mut self.streams,
            default: &self.draft.default_layer,
            version: self.draft.version,
            gamma,
            alike: &self.memory.alike,
            needs_tokens: Cell::new(false),
        };
        let object = plain_object(&mut quiet, &self.draft.default_layer);
        let (end, needs_tokens) = (quiet.at, quiet.needs_tokens.get());
        match object {
            Ok(Some(object)) if !needs_tokens => {
                let known = self.replays.known(file, start, Level::Object);
                if matches!(known, Known::Read(_)) {
                    let known = self.replays.record_sphere(&self.here.tokens, start, end);
                    self.replays.set(file, start, Level::Object, known);
                }
                self.count_replayed()?;
                self.here.at = end - 1;
                self.pass();
                Ok(Some(object))
            }
            _ => {
                self.replays.give_up(&mut self.streams);
                let known = match readings + 1 {
                    MAX_READINGS => Known::Never,
                    readings => Known::Read(readings),
                };
                self.replays.set(file, start, Level::Object, known);
                Ok(None)
            }
        }
    }
}

impl ReplayCache {
    /// The state of an object that was replayed, up to the token at `end`.
    fn record_sphere(&mut self, tokens: &Tokens, start: usize, end: usize) -> Known {
        let sphere = RecordedSphere::at(tokens, start, self).filter(|sphere| sphere.after == end);
        match (sphere, u32::try_from(self.spheres.len())) {
            (Some(sphere), Ok(index)) if self.spheres.len() < MAX_SPHERES => {
                self.spheres.push(Rc::new(sphere));
                Known::RecordedSphere(index)
            }
            _ => Known::Replayed,
        }
    }
}

fn begins_object(word: Word) -> bool {
    matches!(word.class(), Class::Shape | Class::Csg)
}

fn give_up<T>() -> Parse<T> {
    Err(nothing())
}

fn nothing() -> Box<Diagnostic> {
    Box::new(Diagnostic::error(None, ""))
}

impl ReplayReader<'_> {
    /// The next token if the cursor would return the same one.
    #[inline(always)]
    fn peek(&self) -> Parse<Token> {
        let token = self.tokens.tokens[self.at];
        let is_plain_token = match token.kind {
            Kind::Directive | Kind::DataSegment | Kind::End => false,
            Kind::Name => !self.scopes.is_macro(Symbol(token.value)),
            Kind::Word => !is_bare_directive(token),
            _ => true,
        };
        if is_plain_token { Ok(token) } else { give_up() }
    }

    #[inline]
    fn is_at(&self, mark: char) -> Parse<bool> {
        let token = self.tokens.tokens[self.at];
        if token.kind == Kind::Mark {
            return Ok(token.value == u32::from(mark));
        }
        self.peek().map(|_| false)
    }

    /// An expression at the additive level.
    #[inline]
    fn sum(&mut self) -> Parse<Number> {
        if let Some((number, after)) = literal_at(self.tokens, self.at) {
            self.at = after;
            return Ok(number);
        }
        let known = self.replays.known(self.tokens.file, self.at, Level::Sum);
        let Known::Program(index) = known else {
            return give_up();
        };
        match self.replays.value(index, self.scopes, self.streams) {
            Some(number) => {
                self.at = self.replays.programs[index as usize].after;
                Ok(number)
            }
            None => give_up(),
        }
    }

    #[inline]
    fn vector_of(&mut self, len: u8) -> Parse<Number> {
        let number = self.sum()?;
        let number = number.promoted(len);
        let is_finite = number.v.iter().all(|float| float.is_finite());
        if number.len == len && is_finite {
            Ok(number)
        } else {
            give_up()
        }
    }

    /// A colour that begins with such a word, or with an expression.
    fn color_from(&mut self, mut word: Option<Word>) -> Parse<Color> {
        if matches!(word, Some(Word::Color | Word::Colour)) {
            self.at += 1;
            word = color_word(self.peek()?);
        }
        let color = match word {
            Some(word) => {
                self.at += 1;
                color_of(word, self.sum()?)
            }
            None => color_of(Word::Rgbft, self.sum()?),
        };
        match color {
            Some(color) if color_word(self.peek()?).is_none() => Ok(color),
            _ => give_up(),
        }
    }
}

fn color_word(token: Token) -> Option<Word> {
    token.word().filter(|word| word.class() == Class::Color)
}

impl Args for ReplayReader<'_> {
    fn interner(&self) -> Option<&Interner> {
        Some(self.alike)
    }

    fn float(&mut self) -> Parse<f64> {
        let number = self.sum()?;
        if number.len == 1 && number.v[0].is_finite() {
            Ok(number.v[0])
        } else {
            give_up()
        }
    }

    fn float_or(&mut self, default: f64) -> Parse<f64> {
        if self.at_expression()? {
            self.float()
        } else {
            Ok(default)
        }
    }

    fn vector2(&mut self) -> Parse<DVec2> {
        let number = self.vector_of(2)?;
        Ok(DVec2::new(number.v[0], number.v[1]))
    }

    fn vector(&mut self) -> Parse<DVec3> {
        Ok(self.vector_of(3)?.xyz())
    }

    fn vector4(&mut self) -> Parse<[f64; 4]> {
        let number = self.vector_of(4)?;
        Ok([number.v[0], number.v[1], number.v[2], number.v[3]])
    }

    fn color(&mut self) -> Parse<Color> {
        let word = color_word(self.peek()?);
        self.color_from(word)
    }

    fn color_if_any(&mut self) -> Parse<Option<Color>> {
        let token = self.peek()?;
        match token.kind {
            Kind::Word => match color_word(token) {
                None => Ok(None),
                word => self.color_from(word).map(Some),
            },
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Number(number)) if number.len == 5 => self.color_from(None).map(Some),
                Some(Value::Number(_) | Value::Element(_)) => Ok(None),
                _ => give_up(),
            },
            Kind::Mark if token.is_mark('<') => give_up(),
            _ => Ok(None),
        }
    }

    fn string(&mut self) -> Parse<String> {
        give_up()
    }

    fn sampled_function(&mut self) -> Parse<Option<crate::base::args::SampledFunction>> {
        give_up()
    }

    fn object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        let name = self.peek()?.symbol();
        match name.and_then(|name| self.scopes.get(name)) {
            Some(Value::Object(object)) => {
                let object = Arc::clone(object);
                self.at += 1;
                Ok(object)
            }
            _ => give_up(),
        }
    }

    fn working_gamma(&self) -> Option<Gamma> {
        self.gamma
    }

    fn comma(&mut self) -> Parse<bool> {
        self.accept_mark(',')
    }

    fn word(&mut self) -> Parse<Option<Word>> {
        Ok(self.peek()?.word())
    }

    fn accept(&mut self, word: Word) -> Parse<bool> {
        let token = self.peek()?;
        let is_it = token.kind == Kind::Word && token.value == word as u32;
        self.at += usize::from(is_it);
        Ok(is_it)
    }

    fn accept_mark(&mut self, mark: char) -> Parse<bool> {
        let is_it = self.is_at(mark)?;
        self.at += usize::from(is_it);
        Ok(is_it)
    }

    fn at_mark(&mut self, mark: char) -> Parse<bool> {
        self.is_at(mark)
    }

    fn open(&mut self) -> Parse<()> {
        if self.accept_mark('{')? {
            Ok(())
        } else {
            give_up()
        }
    }

    fn accept_close(&mut self) -> Parse<bool> {
        self.accept_mark('}')
    }

    fn close(&mut self) -> Parse<()> {
        if self.accept_mark('}')? {
            Ok(())
        } else {
            give_up()
        }
    }

    fn at_expression(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        match token.kind {
            Kind::Number => Ok(true),
            Kind::Mark => Ok("<(-+!".contains(char::from_u32(token.value).unwrap_or(' '))),
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Number(_)) => Ok(true),
                Some(Value::Object(_)) => Ok(false),
                _ => give_up(),
            },
            Kind::Word => match token.word().map(Word::class) {
                Some(Class::Value) => Ok(true),
                None | Some(Class::Function) => give_up(),
                _ if token.word() == Some(Word::Version) => give_up(),
                _ => Ok(false),
            },
            _ => give_up(),
        }
    }

    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        let Some(name) = self.peek()?.symbol() else {
            return Ok(None);
        };
        match self.scopes.get(name) {
            Some(Value::Element(element)) if element.kind() == kind => {
                self.at += 1;
                Ok(Some(Arc::clone(&element.value)))
            }
            Some(Value::Number(_) | Value::Element(_) | Value::Object(_)) => Ok(None),
            _ => give_up(),
        }
    }

    fn default_any(&self, kind: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        if kind == TypeId::of::<Pigment>() {
            Some(Arc::new(self.default.pigment.clone()))
        } else if kind == TypeId::of::<Layer>() {
            Some(Arc::new(self.default.clone()))
        } else {
            None
        }
    }

    fn function_any(&mut self) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        give_up()
    }

    fn span(&mut self) -> Span {
        self.tokens.span(self.at)
    }

    fn last_span(&self) -> Span {
        self.tokens.span(self.at.saturating_sub(1))
    }

    fn expected(&mut self, _: &str) -> Box<Diagnostic> {
        nothing()
    }

    fn warn(&mut self, _: Diagnostic) {
        self.needs_tokens.set(true);
    }

    fn version(&self) -> f64 {
        self.version
    }
}
