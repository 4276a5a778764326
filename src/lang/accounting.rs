//! Counting of tokens, objects and memory against the limits of a run.

use super::budget::Shared;
use super::frame::Start;
use super::limits;
use super::reader::Reader;
use crate::base::args::Parse;
use crate::base::source::{Code, Diagnostic, Span};
use crate::scene::Object;

impl Reader<'_> {
    /// Counts tokens that a loop or a macro makes the reader read again.
    pub(super) fn count_reread(&mut self, tokens: usize, at: Start) -> Parse<()> {
        let budget = &mut self.budget;
        // A round costs something beside its tokens.
        budget.reread += tokens as u64 + 8;
        if self.options.stop.is_cancelled() {
            return Err(self.stopped(at));
        }
        let budget = &self.budget;
        if budget.reread <= self.options.max_repeated_tokens {
            return self.take_memory_at(limits::ROUND_BYTES, |reader| reader.span_of(at));
        }
        let most = self.options.max_repeated_tokens
            + self.options.max_repeated_tokens / limits::PATIENCE_FOR_OBJECT * budget.objects
            + limits::TOKENS_FOR_BYTE * self.files.written();
        if budget.reread > most {
            let message = format!(
                "the loops and macros of this scene do not come to an end: {} tokens were read in them",
                budget.reread
            );
            let error = Diagnostic::error(self.span_of(at), message)
                .with_hint("Look for a condition that stays true, or for too many rounds.");
            return Err(self.fatal(error));
        }
        self.take_memory_at(limits::ROUND_BYTES, |reader| reader.span_of(at))
    }

    /// The error of a reading that was cancelled.
    pub(super) fn stopped(&mut self, at: Start) -> Box<Diagnostic> {
        let error = Diagnostic::error(self.span_of(at), "reading was stopped here");
        self.fatal(error)
    }

    /// Counts a stream of random numbers.
    pub(super) fn count_stream(&mut self) -> Parse<()> {
        self.take_memory_at(limits::STREAM_BYTES, Self::taken_span)
    }

    /// Counts an object.
    pub(super) fn count_object(&mut self) -> Parse<()> {
        self.count_objects(1)
    }

    /// Counts this many objects.
    pub(super) fn count_objects(&mut self, count: u64) -> Parse<()> {
        self.budget.objects += count;
        self.take_memory_at(count * limits::OBJECT_BYTES, Self::taken_span)
    }

    /// Counts the primitives of a top-level object.
    pub(super) fn count_leaves(&mut self, object: &Object) -> Parse<()> {
        self.count_object()?;
        let leaves = self.budget.shared.stored(object);
        self.count_shapes(leaves, u64::from(object.size().leaves))
    }

    /// The same for an object that is a single shape.
    pub(super) fn count_leaf(&mut self) -> Parse<()> {
        self.count_single_shapes(1)
    }

    /// The same for `count` objects that are a single shape each.
    pub(super) fn count_single_shapes(&mut self, count: u64) -> Parse<()> {
        self.count_objects(count)?;
        self.count_shapes(count, count)
    }

    /// Counts shapes to be prepared, and shapes as often as they are drawn.
    fn count_shapes(&mut self, leaves: u64, shown: u64) -> Parse<()> {
        self.budget.leaves += leaves;
        self.budget.shown += shown;
        let many = if self.budget.leaves > limits::LEAVES {
            format!("a scene has at most {} shapes", limits::LEAVES)
        } else if self.budget.shown > limits::SHOWN {
            format!("a scene shows at most {} shapes", limits::SHOWN)
        } else {
            return self.take_memory_at(leaves * limits::LEAF_BYTES, Self::taken_span);
        };
        let error = Diagnostic::error(self.taken_span(), many)
            .with_hint("Objects that hold each other twice double their shapes each time.");
        Err(self.fatal(error))
    }

    /// Checks that there is memory to compile an object for `trace` and `inside`.
    pub(super) fn check_probed(&mut self, object: &Object) -> Parse<()> {
        if object.size().leaves < limits::PROBED {
            return Ok(());
        }
        let leaves = Shared::default().stored(object);
        if leaves <= limits::LEAVES && self.budget.memory.allows(0, leaves) {
            return Ok(());
        }
        let message = format!("this object comes to {leaves} shapes, too many to look into");
        Err(self.with_trace(Diagnostic::error(self.taken_span(), message)))
    }

    /// Checks the nesting depth and the number of the parts of an object.
    pub(super) fn check_size(&mut self, object: &Object, at: Span) -> Parse<()> {
        match limits::exceeded(object) {
            Some(message) => Err(self.with_trace(Diagnostic::error(at, message))),
            None => Ok(()),
        }
    }

    /// Notes about `bytes` of memory taken, or about to be; an error if there is no more.
    pub(super) fn take_memory(&mut self, bytes: u64, at: Span) -> Parse<()> {
        self.take_memory_at(bytes, |_| at)
    }

    /// The same; the span is computed only for a message.
    #[inline]
    fn take_memory_at(&mut self, bytes: u64, at: impl FnOnce(&Self) -> Span) -> Parse<()> {
        let unmeasured = self.budget.unmeasured.saturating_add(bytes);
        if unmeasured < limits::MEMORY_STEP {
            self.budget.unmeasured = unmeasured;
            return Ok(());
        }
        self.budget.unmeasured = 0;
        let ahead = if bytes < limits::MEMORY_STEP {
            0
        } else {
            bytes
        };
        if self.budget.memory.allows(ahead, self.budget.leaves) {
            return Ok(());
        }
        let error = Diagnostic::error(at(self), "this scene needs more memory than there is")
            .with_hint("Look for a loop that does not end, or draw it on a larger machine.");
        Err(self.fatal(error.with_code(Code::Memory)))
    }

    /// Notes that one thing is about to take `bytes`; the error names it.
    pub(super) fn take_memory_for(&mut self, what: &str, bytes: u64, at: Span) -> Parse<()> {
        if bytes < limits::MEMORY_STEP || self.budget.memory.allows(bytes, self.budget.leaves) {
            return self.take_memory(bytes.min(limits::MEMORY_STEP - 1), at);
        }
        let megabytes = bytes.div_ceil(1_000_000);
        let message = format!("{what} takes {megabytes} MB of memory, more than there is left");
        let error = Diagnostic::error(at, message)
            .with_hint("Make it smaller, or draw the scene on a larger machine.");
        Err(self.fatal(error.with_code(Code::Memory)))
    }

    /// Reads a part that may hold parts of its own kind, up to a limit on the nesting.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parse<T>) -> Parse<T> {
        if self.statement.nesting >= limits::READING {
            let message = format!(
                "directives, conditions and calls are nested more than {} deep",
                limits::READING
            );
            let error = Diagnostic::error(self.taken_span(), message);
            return Err(self.fatal(error));
        }
        self.statement.nesting += 1;
        let result = read(self);
        self.statement.nesting -= 1;
        result
    }

    /// The error that ends reading.
    fn fatal(&mut self, error: Diagnostic) -> Box<Diagnostic> {
        self.is_over = true;
        let code = error.code.unwrap_or(Code::Limit);
        self.with_trace(error.with_code(code))
    }
}
