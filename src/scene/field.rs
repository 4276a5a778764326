//! The fields of which objects are isosurfaces, for pattern `potential`.

use super::object::{Kind, Object};
use super::pattern::Field;
use super::shape::Shape;
use crate::base::math::Transform;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// The field of a blob or isosurface with its transforms.
#[derive(Clone, Debug)]
pub struct ObjectField {
    shape: Arc<Shape>,
    object_from_world: DAffine3,
}

impl ObjectField {
    /// The field of an object, `None` unless it is a blob or isosurface.
    #[must_use]
    pub fn new(object: &Object) -> Option<Self> {
        match &object.kind {
            Kind::Shape(shape) if matches!(**shape, Shape::Blob(_) | Shape::Isosurface(_)) => {
                Some(ObjectField {
                    shape: Arc::clone(shape),
                    object_from_world: Transform::from_steps(&object.steps).object_from_world,
                })
            }
            _ => None,
        }
    }
}

impl Field for ObjectField {
    fn value(&self, point: DVec3) -> f64 {
        let point = self.object_from_world.transform_point3(point);
        match &*self.shape {
            Shape::Blob(blob) => blob.field(point),
            Shape::Isosurface(isosurface) => isosurface.function_value(point),
            _ => 0.0,
        }
    }

    fn threshold(&self) -> f64 {
        match &*self.shape {
            Shape::Blob(blob) => blob.threshold(),
            Shape::Isosurface(isosurface) => isosurface.threshold(),
            _ => 0.0,
        }
    }
}
