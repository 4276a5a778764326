//! Queries for packets of rays: the same bits as one ray at a time.

pub(in crate::world) mod area;
pub(in crate::world) mod bundle;
pub(in crate::world) mod csg;
pub(crate) mod csg_packet;
pub(in crate::world) mod csg_tree;
pub(in crate::world) mod hits;
pub(in crate::world) mod instance;
pub(in crate::world) mod light_buffer;
pub(in crate::world) mod mesh;
pub(in crate::world) mod parallel;
pub(in crate::world) mod primitive;
pub(in crate::world) mod rays;
