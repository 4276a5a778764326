//! Transforms, rays, bounds and root finders: mathematics that knows nothing of scenes.

mod bounds;
pub(crate) mod chord;
pub(crate) mod conditioning;
mod ray;
mod transform;
pub(crate) mod watertight;

pub use bounds::Bounds;
pub use ray::Ray;
pub use transform::{Step, Transform, axis_rotation, normal_from_inverse, rotation};
