//! Surfaces given by a field: blobs, functions, polynomials and fractals.

pub(super) mod blob;
pub(super) mod isosurface;
pub(super) mod julia_fractal;
pub(super) mod poly;
