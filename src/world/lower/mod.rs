//! Lowering: from the objects of a scene to primitives, CSG programs and lights.

pub(super) mod csg;
pub(super) mod cutaway;
pub(super) mod flatten;
pub(super) mod inherit;
pub(super) mod instancing;
pub(super) mod model;
pub(super) mod parallel;
pub(super) mod probe;
pub(super) mod seen_in;
pub(super) mod spheres;
pub(super) mod targets;
pub(super) mod uses_random;
mod world;
