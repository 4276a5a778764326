//! Transforms, rays, bounds and root finders: mathematics that knows nothing of scenes.

mod bernstein;
mod bounds;
pub mod chi_square;
pub(crate) mod chord;
pub(crate) mod conditioning;
#[cfg(test)]
pub(crate) mod exact;
mod halton;
pub mod hash;
pub(crate) mod hyperbolic;
pub(crate) mod interval_roots;
mod jitter;
pub mod mersenne;
pub mod noise;
pub(crate) mod polynomial;
pub(crate) mod powers;
pub(crate) mod quartic;
#[cfg(test)]
pub(crate) mod random;
mod ray;
pub(crate) mod rounding;
mod shear;
pub(crate) mod simd;
pub(crate) mod sobol;
mod spline;
mod transform;
pub(crate) mod watertight;

pub use bounds::Bounds;
pub use halton::halton;
pub use jitter::jitter;
pub use ray::Ray;
pub use shear::Shear;
pub use spline::{Spline, SplineKind};
pub use transform::{Step, Transform, axis_rotation, normal_from_inverse, rotation, shorten};
