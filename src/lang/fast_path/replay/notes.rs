//! The recording of an expression while it is read for the first time.

use super::MACRO_COST;
use super::op::Op;
use super::stack::{DEPTH, SLOTS};
use crate::base::args::Word;
use crate::lang::directive::macros::Macro;
use crate::lang::expr::value::{Number, Value};
use crate::lang::reader::Reader;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

/// Limit on the steps of a program; a longer one saves no time.
const MAX_OPS: usize = 1000;

/// An expression while it is read for the first time.
#[derive(Debug)]
pub(in crate::lang) struct Recording {
    pub(super) ops: Vec<Op>,
    /// The macros that were called, with their lengths in tokens.
    pub(super) calls: Vec<(Symbol, Rc<Macro>)>,
    pub(super) reread: usize,
    /// Number of floats that the steps leave on the stack, and the most that were there.
    depth: usize,
    deepest: usize,
    slots: usize,
    /// The bindings made by the calls, by symbol and index in its stack of bindings, with their sources.
    bound: Vec<((Symbol, usize), Source)>,
    /// Number of frames open at its start.
    frames: usize,
}

/// Where the steps of an expression read the value of an identifier.
#[derive(Clone, Copy, Debug)]
pub(in crate::lang) enum Source {
    /// From the identifier.
    Name(Symbol),
    /// From a slot.
    Slot(u8),
}

impl Recording {
    /// An empty recording, with the number of frames open.
    pub(super) fn new(frames: usize) -> Self {
        Recording {
            ops: Vec::new(),
            calls: Vec::new(),
            reread: 0,
            depth: 0,
            deepest: 0,
            slots: 0,
            bound: Vec::new(),
            frames,
        }
    }

    /// True if it is the whole of an expression with `len` components, which ends with `frames` frames open.
    pub(super) fn is_whole(&self, len: u8, frames: usize) -> bool {
        self.depth == usize::from(len)
            && self.deepest <= DEPTH
            && self.slots <= SLOTS
            && self.ops.len() <= MAX_OPS
            && self.frames == frames
    }

    fn push(&mut self, op: Op) {
        let (taken, given) = op.effect();
        self.depth = self.depth.saturating_sub(usize::from(taken)) + usize::from(given);
        self.deepest = self.deepest.max(self.depth + usize::from(taken));
        if self.ops.len() <= MAX_OPS {
            self.ops.push(op);
        }
    }
}

impl Reader<'_> {
    /// Records a step of the expression that is being read.
    #[inline]
    pub(in crate::lang) fn note(&mut self, op: Op) {
        if let Some(recording) = &mut self.recording {
            recording.push(op);
        }
    }

    /// Records the value of a reserved word.
    pub(in crate::lang) fn note_constant(&mut self, word: Word, number: &Number) {
        if word == Word::Version {
            self.discard_recording();
        }
        for &float in &number.v[..usize::from(number.len)] {
            self.note(Op::Float(float));
        }
    }

    /// Records the number of an identifier.
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

    /// Records an item of an array with `dimensions` dimensions, whose indices were recorded after the first `before`
    /// floats.
    pub(in crate::lang) fn note_item(
        &mut self,
        array: Symbol,
        before: usize,
        dimensions: usize,
        len: u8,
    ) {
        let dimensions = match u8::try_from(dimensions) {
            Ok(count) if self.noted() == before + dimensions => count,
            // An item of an array within an array.
            _ => return self.discard_recording(),
        };
        match self.source(array) {
            Source::Name(array) => self.note(Op::Item(array, dimensions, len)),
            Source::Slot(_) => self.discard_recording(),
        }
    }

    /// Number of floats that the recorded steps leave.
    pub(in crate::lang) fn noted(&self) -> usize {
        self.recording
            .as_ref()
            .map_or(0, |recording| recording.depth)
    }

    /// Discards the recording: the expression being read cannot be replayed.
    #[inline]
    pub(in crate::lang) fn discard_recording(&mut self) {
        self.recording = None;
    }

    /// True if the innermost frame is a macro that the expression being recorded has called.
    pub(in crate::lang) fn is_in_noted_call(&self) -> bool {
        let recording = self.recording.as_ref();
        recording.is_some_and(|recording| self.frames.len() > recording.frames)
    }

    /// Where the steps read the current value of an identifier.
    fn source(&self, name: Symbol) -> Source {
        let bound = self.recording.as_ref().map(|recording| &recording.bound);
        let key = self.scopes.top(name).map(|top| (name, top));
        let known = |&&(binding, _): &&((Symbol, usize), Source)| Some(binding) == key;
        let source = bound.and_then(|bound| bound.iter().rev().find(known));
        source.map_or(Source::Name(name), |&(_, source)| source)
    }

    /// The source of a macro argument that is an identifier itself.
    pub(in crate::lang) fn note_reference(&self, name: Symbol) -> Option<Source> {
        self.recording.is_some().then(|| self.source(name))
    }

    /// Records a macro argument by value, whose steps have been recorded.
    pub(in crate::lang) fn note_argument(&mut self, value: &Value) -> Option<Source> {
        let Value::Number(number) = value else {
            self.discard_recording();
            return None;
        };
        let recording = self.recording.as_mut()?;
        let slot = u8::try_from(recording.slots).ok()?;
        recording.slots += 1;
        self.note(Op::Store(slot, number.len));
        Some(Source::Slot(slot))
    }

    /// Records the call of a macro whose parameters are read from `sources`.
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
        recording.reread += length + MACRO_COST;
        let parameters = called.parameters();
        for (at, (&parameter, source)) in parameters.iter().zip(sources).enumerate() {
            let (Some(top), &Some(source)) = (self.scopes.top(parameter), source) else {
                return self.discard_recording();
            };
            if parameters[..at].contains(&parameter) {
                return self.discard_recording();
            }
            recording.bound.push(((parameter, top), source));
        }
    }
}
