//! Lowering: from the objects of a scene to primitives, CSG programs and lights.

pub(super) mod csg;
pub(super) mod cutaway;
pub(super) mod flatten;
pub(super) mod inherit;
pub(super) mod instancing;
mod light_buffers;
pub(crate) mod lowering;
pub(super) mod parallel;
pub(crate) mod parts;
pub(super) mod probe;
pub(crate) mod restyle;
pub(super) mod uses_random;
pub(super) mod visibility_box;
mod world;
