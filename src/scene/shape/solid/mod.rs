//! Solids given by a formula.

pub(super) mod axial;
pub(super) mod cone;
pub(super) mod cuboid;
pub(super) mod cylinder;
pub(super) mod ovus;
pub(super) mod plane;
pub(super) mod quadric;
pub(super) mod quadric_packet;
pub(super) mod sphere;
pub(super) mod superellipsoid;
pub(super) mod torus;
pub(super) mod torus_packet;
