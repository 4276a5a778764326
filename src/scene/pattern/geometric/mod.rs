//! Patterns that are a formula of the coordinates.

pub(super) mod boxed;
pub(super) mod cubic;
pub(super) mod cylindrical;
pub(super) mod formula;
pub(super) mod gradient;
pub(super) mod leopard;
pub(super) mod onion;
pub(super) mod planar;
pub(super) mod quilted;
pub(super) mod radial;
pub(super) mod spherical;
pub(super) mod spiral;
