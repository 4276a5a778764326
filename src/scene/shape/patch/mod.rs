//! Surfaces without a volume.

pub(super) mod bicubic_patch;
pub(super) mod disc;
pub(super) mod parametric;
pub(super) mod parametric_patch;
pub(super) mod polygon;
pub(super) mod smooth_triangle;
pub(super) mod triangle;
