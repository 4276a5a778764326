//! Root finders, and the ray intersections built on them.

pub(super) mod bernstein;
pub(crate) mod bracket;
pub(crate) mod hyperbolic;
pub(crate) mod interval_roots;
pub(crate) mod polynomial;
pub(crate) mod quartic;
pub(crate) mod ray_sphere;
