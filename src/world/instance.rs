//! An instance of a shared model: one copy of a union that a scene repeats.

use super::model::Model;
use crate::base::math::normal_from_inverse;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A shared model with its transform.
#[derive(Debug)]
pub(super) struct Instance {
    /// The shared model.
    pub(super) model: Arc<Model>,
    /// World-to-model matrix; the world is the surrounding model.
    pub(super) object_from_world: DAffine3,
    /// Index of its first leaf.
    pub(super) first: u32,
    /// Index of its first surface.
    pub(super) surface: u32,
}

impl Instance {
    /// The unit outward normals at a point of a leaf: the geometric one and the shading normal.
    pub(super) fn normals(&self, leaf: u32, point: DVec3, face: u32) -> (DVec3, DVec3) {
        let local = self.object_from_world.transform_point3(point);
        let (geometric, shading) = self.model.normals(leaf - self.first, local, face);
        let around =
            |normal| normal_from_inverse(&self.object_from_world, normal).normalize_or_zero();
        let turned = around(geometric);
        let is_smooth = shading != geometric;
        (turned, if is_smooth { around(shading) } else { turned })
    }
}
