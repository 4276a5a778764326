//! Streams of random numbers: `seed` opens them, `rand` draws from them.
//!
//! A stream never closes: its handle is a number, which a scene may compute. Most scenes open a few, but a loop may
//! open one in each round, so the cost of every operation is independent of their number.

use crate::lang::frame::Start;
use std::rc::Rc;

/// All streams of a run, by their handles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Streams {
    /// Shared with the copy that the reader holds while it tries a parse, so that copies are free.
    states: Rc<Vec<u32>>,
    /// See [`Streams::changes`].
    changes: u64,
    /// The parentheses of the call that opened the newest stream.
    newest: Option<Call>,
}

/// The parentheses of a call of `seed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Call {
    /// Where `(` stands.
    pub(crate) open: Start,
    /// Where `)` stands.
    pub(crate) close: Start,
}

impl Streams {
    /// Opens a stream and returns its handle.
    pub(crate) fn open(&mut self, seed: u32) -> f64 {
        let states = Rc::make_mut(&mut self.states);
        states.push(seed);
        self.changes += 1;
        (states.len() - 1) as f64
    }

    /// Notes the call that opened the newest stream.
    pub(crate) fn opened_by(&mut self, call: Call) {
        self.newest = Some(call);
    }

    /// The index of the stream with this handle.
    pub(crate) fn find(&self, handle: f64) -> Option<usize> {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "out of range means no stream"
        )]
        Some(handle as usize).filter(|&stream| stream < self.states.len())
    }

    /// The next number of a stream, in [0, 1].
    pub(crate) fn draw(&mut self, stream: usize) -> f64 {
        self.changes += 1;
        let state = &mut Rc::make_mut(&mut self.states)[stream];
        *state = state.wrapping_mul(1_812_433_253).wrapping_add(12345);
        f64::from(*state) / f64::from(u32::MAX)
    }

    /// The same where the whole argument of `rand` is a call, as in `rand(seed(1))`.
    ///
    /// If that call opened the newest stream, its handle is unknown to everybody else and nothing later depends on it:
    /// it counts as no change. So a loop that does nothing else is detected as endless.
    pub(crate) fn draw_by(&mut self, argument: Call, stream: usize) -> f64 {
        let number = self.draw(stream);
        if self.newest.take() == Some(argument) && stream + 1 == self.states.len() {
            // The changes of opening and of drawing.
            self.changes -= 2;
        }
        number
    }

    /// Number of streams opened and numbers drawn with an effect on what is read later.
    pub(crate) fn changes(&self) -> u64 {
        self.changes
    }

    /// The state of a stream.
    pub(crate) fn state(&self, stream: usize) -> u32 {
        self.states[stream]
    }

    /// Resets a stream to an earlier state.
    pub(crate) fn put_back(&mut self, stream: usize, state: u32) {
        Rc::make_mut(&mut self.states)[stream] = state;
    }
}

#[cfg(test)]
mod tests {
    use super::{Call, Streams};
    use crate::base::source::FileId;
    use crate::lang::frame::Start;

    fn call(start: u32) -> Call {
        let at = |start| Start {
            file: FileId(0),
            start,
        };
        Call {
            open: at(start),
            close: at(start + 2),
        }
    }

    #[test]
    fn drawing_from_an_unreferenced_stream_is_no_change() {
        let mut streams = Streams::default();
        streams.open(1);
        streams.opened_by(call(5));
        assert_eq!(
            (streams.draw_by(call(5), 0) > 0.0, streams.changes()),
            (true, 0)
        );
        // The same call, but the stream is not the one it has just opened.
        streams.draw_by(call(5), 0);
        assert_eq!(streams.changes(), 1);
        streams.open(1);
        streams.opened_by(call(5));
        streams.draw_by(call(7), 1);
        assert_eq!(streams.changes(), 3);
    }

    #[test]
    fn a_copy_is_not_drawn_from() {
        let mut streams = Streams::default();
        streams.open(7);
        let copy = streams.clone();
        let first = streams.draw(0);
        assert_ne!(streams.draw(0).to_bits(), first.to_bits());
        streams = copy;
        assert_eq!(streams.draw(0).to_bits(), first.to_bits());
        assert_eq!((streams.find(0.9), streams.find(1.0)), (Some(0), None));
    }
}
