//! Shapes made of a curve or an outline: turned, extruded or swept.

pub(super) mod lathe;
pub(super) mod prism;
pub(super) mod sor;
pub(super) mod sphere_sweep;
pub(super) mod spline;
pub(super) mod text;
