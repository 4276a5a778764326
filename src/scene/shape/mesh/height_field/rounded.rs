//! Hits to the last bit of POV-Ray (docs/povray-shapes.md, section 5.4): on level ground the sign of a coordinate that is
//! zero but for rounding decides which end of a `gradient` shows.

use super::{Field, HeightField, WATER};
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Ray, Transform, normal_from_inverse};
use crate::scene::shape::{RoundedHit, Steps};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A height field with all its transforms, whose hits are rounded as in POV-Ray.
#[derive(Clone, Debug)]
pub(in crate::scene::shape) struct RoundedField {
    field: Arc<Field>,
    /// From the world to field space, by the product of the inverse matrices.
    field_from_world: DAffine3,
    normalization: Normalization,
}

impl RoundedField {
    /// The field with these further steps.
    pub(super) fn new(shape: &HeightField, steps: &Steps<'_>) -> Self {
        let field = Arc::clone(&shape.field);
        // POV-Ray scales by the reciprocals: the inverse is not always the number of cells to the last bit.
        let size = Transform::scaling(field.scale().recip());
        let before = size.object_from_world * shape.transform.object_from_world;
        let field_from_world = steps
            .steps
            .iter()
            .fold(before, |sum, step| sum * step.transform().object_from_world);
        RoundedField {
            field,
            field_from_world,
            normalization: steps.normalization,
        }
    }

    /// The hit on the plane of a triangle.
    pub(in crate::scene::shape) fn hit(&self, ray: &Ray, face: u32) -> Option<RoundedHit> {
        if face >= WATER {
            return None;
        }
        let Self {
            field,
            field_from_world,
            ..
        } = self;
        let (corner, normal) = field.triangle(face);
        let local = ray.to_object(field_from_world);
        let t = normal.dot(corner - local.origin) / normal.dot(local.dir);
        let point = ray.at(t);
        let unit_in_world = |normal: DVec3| {
            self.normalization
                .unit(normal_from_inverse(field_from_world, normal))
        };
        let at = field_from_world.transform_point3(point);
        let normal = match field.smooth_normal(at, face, unit_in_world) {
            Some(mixed) => self.normalization.unit(mixed),
            None => unit_in_world(normal),
        };
        Some(RoundedHit { t, point, normal })
    }
}

impl Field {
    /// The right-angled corner of a triangle in field space, and its upward normal.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    fn triangle(&self, face: u32) -> (DVec3, DVec3) {
        let (x, z, is_far) = self.cell(face);
        let (x, z) = (x + usize::from(is_far), z + usize::from(is_far));
        let corner = DVec3::new(x as f64, self.height(x, z), z as f64);
        (corner, self.flat_normal(face))
    }
}
