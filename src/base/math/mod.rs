//! Transforms, rays, bounds, root finders, noise and sampling: mathematics independent of the scene.

mod bounds;
mod complex;
pub(crate) mod conditioning;
#[cfg(test)]
pub(crate) mod exact;
pub mod noise;
pub(crate) mod powers;
mod ray;
pub(crate) mod roots;
pub(crate) mod rounding;
pub mod sampling;
mod shear;
pub(crate) mod simd;
mod spline;
mod transform;
pub(crate) mod watertight;

pub use bounds::{Bounds, COINCIDENT};
pub(crate) use complex::Complex;
pub use conditioning::Normalization;
pub use ray::Ray;
pub use sampling::halton::halton;
pub use sampling::jitter::jitter;
pub use shear::Shear;
pub use spline::{Spline, SplineKind};
pub use transform::{Step, Transform, axis_rotation, merge_steps, normal_from_inverse, rotation};
