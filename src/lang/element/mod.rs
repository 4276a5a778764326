//! Objects, lights and settings: the blocks of a scene.

pub(super) mod args;
pub(super) mod clip;
pub(super) mod csg;
pub(crate) mod fold;
pub(super) mod global_blocks;
pub(super) mod light;
pub(super) mod object;
pub(super) mod settings;
pub(super) mod statement;
