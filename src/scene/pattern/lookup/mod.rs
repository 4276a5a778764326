//! Patterns whose values come from files, functions, objects or the surface.

pub(super) mod aoi;
pub(super) mod density_file;
pub(super) mod function;
pub(super) mod image_pattern;
pub(super) mod object;
pub(super) mod slope;
