//! What is noted of an expression while it is read for the first time.

use super::AGAIN;
use super::op::Op;
use super::stack::{DEPTH, SLOTS};
use crate::base::args::Word;
use crate::lang::directive::macros::Macro;
use crate::lang::expr::value::{Number, Value};
use crate::lang::reader::Reader;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

/// Steps of a program; a longer one saves no time.
const MOST_OPS: usize = 1000;

/// An expression while it is read for the first time.
#[derive(Debug)]
pub(in crate::lang) struct Recording {
    pub(super) ops: Vec<Op>,
    /// The macros that were called, and how many tokens they come to.
    pub(super) calls: Vec<(Symbol, Rc<Macro>)>,
    pub(super) again: usize,
    /// How many floats the steps leave on the stack, and how many were there at most.
    depth: usize,
    deepest: usize,
    slots: usize,
    /// The bindings that the calls made, by symbol and place in its stack of bindings, with what they stand for.
    bound: Vec<((Symbol, usize), Source)>,
    /// How many frames were open when it began.
    frames: usize,
}

/// Where the steps of an expression find the value of an identifier.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Source {
    /// In what the identifier holds.
    Name(Symbol),
    /// In a slot.
    Slot(u8),
}

impl Recording {
    /// Nothing noted, with so many frames open.
    pub(super) fn new(frames: usize) -> Self {
        Recording {
            ops: Vec::new(),
            calls: Vec::new(),
            again: 0,
            depth: 0,
            deepest: 0,
            slots: 0,
            bound: Vec::new(),
            frames,
        }
    }

    /// Whether it is the whole of an expression with so many components, which ends with so many frames open.
    pub(super) fn is_whole(&self, len: u8, frames: usize) -> bool {
        self.depth == usize::from(len)
            && self.deepest <= DEPTH
            && self.slots <= SLOTS
            && self.ops.len() <= MOST_OPS
            && self.frames == frames
    }

    fn push(&mut self, op: Op) {
        let (taken, given) = op.effect();
        self.depth = self.depth.saturating_sub(usize::from(taken)) + usize::from(given);
        self.deepest = self.deepest.max(self.depth + usize::from(taken));
        if self.ops.len() <= MOST_OPS {
            self.ops.push(op);
        }
    }
}

impl Reader<'_> {
    /// Notes a step of the expression that is being read.
    #[inline]
    pub(in crate::lang) fn note(&mut self, op: Op) {
        if let Some(recording) = &mut self.recording {
            recording.push(op);
        }
    }

    /// Notes what a word of the language stands for.
    pub(in crate::lang) fn note_constant(&mut self, word: Word, number: &Number) {
        if word == Word::Version {
            self.spoil();
        }
        for &float in &number.v[..usize::from(number.len)] {
            self.note(Op::Float(float));
        }
    }

    /// Notes the number that an identifier holds.
    #[inline]
    pub(in crate::lang) fn note_name(&mut self, name: Symbol, len: u8) {
        if self.recording.is_some() {
            let op = match self.source(name) {
                Source::Name(name) => Op::Name(name, len),
                Source::Slot(slot) => Op::Load(slot, len),
            };
            self.note(op);
        }
    }

    /// Notes an item of an array with so many dimensions, whose indices have been noted since there were `before`
    /// floats.
    pub(in crate::lang) fn note_item(
        &mut self,
        array: Symbol,
        before: usize,
        dimensions: usize,
        len: u8,
    ) {
        let dimensions = match u8::try_from(dimensions) {
            Ok(few) if self.noted() == before + dimensions => few,
            // An item of an array within an array.
            _ => return self.spoil(),
        };
        match self.source(array) {
            Source::Name(array) => self.note(Op::Item(array, dimensions, len)),
            Source::Slot(_) => self.spoil(),
        }
    }

    /// How many floats the noted steps leave.
    pub(in crate::lang) fn noted(&self) -> usize {
        self.recording
            .as_ref()
            .map_or(0, |recording| recording.depth)
    }

    /// Says that what is being read cannot be repeated by notes.
    #[inline]
    pub(in crate::lang) fn spoil(&mut self) {
        self.recording = None;
    }

    /// Whether the innermost frame is a macro that the expression being recorded has called.
    pub(in crate::lang) fn is_in_noted_call(&self) -> bool {
        let recording = self.recording.as_ref();
        recording.is_some_and(|recording| self.frames.len() > recording.frames)
    }

    /// Where the steps find what an identifier holds now.
    fn source(&self, name: Symbol) -> Source {
        let bound = self.recording.as_ref().map(|recording| &recording.bound);
        let key = self.scopes.top(name).map(|top| (name, top));
        let known = |&&(binding, _): &&((Symbol, usize), Source)| Some(binding) == key;
        let source = bound.and_then(|bound| bound.iter().rev().find(known));
        source.map_or(Source::Name(name), |&(_, source)| source)
    }

    /// Notes the argument of a macro that is called by the expression: an identifier itself.
    pub(in crate::lang) fn note_reference(&self, name: Symbol) -> Option<Source> {
        self.recording.is_some().then(|| self.source(name))
    }

    /// Notes the argument of a macro that is called by the expression: a value, which has been noted.
    pub(in crate::lang) fn note_argument(&mut self, value: &Value) -> Option<Source> {
        let Value::Number(number) = value else {
            self.spoil();
            return None;
        };
        let recording = self.recording.as_mut()?;
        let slot = u8::try_from(recording.slots).ok()?;
        recording.slots += 1;
        self.note(Op::Store(slot, number.len));
        Some(Source::Slot(slot))
    }

    /// Notes that a macro has been entered whose parameters stand for `sources`.
    pub(in crate::lang) fn note_call(
        &mut self,
        name: Symbol,
        called: &Rc<Macro>,
        length: usize,
        sources: &[Option<Source>],
    ) {
        let Some(recording) = &mut self.recording else {
            return;
        };
        recording.calls.push((name, Rc::clone(called)));
        recording.again += length + AGAIN;
        let parameters = called.parameters();
        for (at, (&parameter, source)) in parameters.iter().zip(sources).enumerate() {
            let (Some(top), &Some(source)) = (self.scopes.top(parameter), source) else {
                return self.spoil();
            };
            if parameters[..at].contains(&parameter) {
                return self.spoil();
            }
            recording.bound.push(((parameter, top), source));
        }
    }
}
