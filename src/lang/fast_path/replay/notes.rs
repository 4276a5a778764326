//! The recording of an expression while it is read for the first time.

use super::cache::MACRO_COST;
use super::op::Op;
use super::recording::Source;
use crate::base::args::Word;
use crate::lang::expr::value::{Number, Value};
use crate::lang::frame::Macro;
use crate::lang::reader::Reader;
use crate::lang::syntax::Symbol;
use std::rc::Rc;

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
