//! Hints, recovery and the words that are not supported.

mod arguments;
mod arrays;
mod counts;
pub(super) mod css_colors;
pub(super) mod hints;
mod loops;
mod marks;
mod misplaced;
mod names;
pub(super) mod notation;
mod operators;
pub(super) mod other_dialects;
mod pasted;
pub(super) mod recover;
pub(super) mod remedy;
pub(super) mod rewrite;
mod signatures;
pub(super) mod trace;
pub(super) mod trial;
mod typography;
pub(super) mod unclosed;
pub(super) mod unsupported;
mod usage;
