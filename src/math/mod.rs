//! Transforms, rays, bounds and root finders: mathematics that knows nothing of scenes.

mod bounds;
mod ray;
mod transform;

pub use bounds::Bounds;
pub use ray::Ray;
pub use transform::{Step, Transform, axis_rotation, normal_from_inverse, rotation};
