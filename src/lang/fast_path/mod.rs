//! Long literal data, repeated statements and plain objects, read without an evaluation of tokens.

pub(super) mod common_object;
pub(super) mod data_segment;
pub(super) mod known;
pub(super) mod literal;
pub(super) mod literal_cache;
mod literal_numbers;
pub(super) mod numbers;
pub(super) mod parallel;
pub(super) mod part_cache;
pub(super) mod replay;
