//! Data gathered by lowering before the world is built: models, shared slots, deferred spheres and inherited attributes.

pub(crate) mod inherited;
pub(super) mod model;
pub(crate) mod plain_shapes;
pub(crate) mod slots;
pub(super) mod spheres;
pub(in crate::world) mod targets;
