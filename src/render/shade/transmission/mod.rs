//! Transmission: refracted rays, dispersion, and the interiors that a ray is in.

pub(super) mod interior_stack;
pub(super) mod refraction;
pub(super) mod spectrum;
