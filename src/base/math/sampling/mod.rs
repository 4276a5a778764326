//! Random number generators, low-discrepancy sequences and POV-Ray's tables.

pub mod chi_square;
pub(super) mod halton;
pub mod hash;
pub(super) mod jitter;
pub mod mersenne;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod sobol;
