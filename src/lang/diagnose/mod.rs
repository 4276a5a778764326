//! Hints, recovery and the words that are not supported.

pub(super) mod hints;
pub(super) mod other_dialects;
pub(super) mod recover;
pub(super) mod rewrite;
pub(super) mod trace;
pub(super) mod unclosed;
pub(super) mod unsupported;
