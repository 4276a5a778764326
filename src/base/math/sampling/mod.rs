//! Sequences and generators of random numbers.

pub mod chi_square;
pub(super) mod halton;
pub mod hash;
pub(super) mod jitter;
pub mod mersenne;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod sobol;
