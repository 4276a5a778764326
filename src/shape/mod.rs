//! The shapes: one file each, with its mathematics, what it reads, and its hits.
//!
//! A shape reports *all* places where the whole line of a ray crosses it, as the edges of spans inside the solid,
//! so that CSG needs no inside test at a hit point. What must not be seen although it bounds the solid (the missing
//! cap of an open cylinder) is reported as not visible.

use crate::math::{Bounds, Ray, Step};
use glam::DVec3;

/// What a ray does to the inside of a solid at a crossing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// It goes in.
    Enter,
    /// It comes out.
    Leave,
    /// It meets a surface without a volume (triangle, the disc of a half-space seen from neither side).
    Touch,
}

/// A place where the line of a ray meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Where on the ray: `origin + t · dir`; may be negative, is never NaN or infinite.
    pub t: f64,
    /// What happens to the inside there.
    pub crossing: Crossing,
    /// Which smooth piece of the shape: a face of a box, side or cap of a cylinder.
    pub face: u16,
    /// Whether the surface is there to be seen.
    pub is_visible: bool,
}

/// Whether the far start of a line (`t → −∞`) lies inside the solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Outside, as for every bounded solid.
    Outside,
    /// Inside, as for a half-space that the line leaves.
    Inside,
}

/// What every shape can do. All of it happens in the shape's own object space.
pub trait Geometry {
    /// Appends all roots on the whole line of `ray` to `roots`, sorted by `t`; enter and leave alternate.
    /// Says whether the line starts inside. A shape without volume appends only `Touch`.
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start;

    /// The outward normal, not normalised, at a point of the surface piece `face`.
    fn normal(&self, point: DVec3, face: u16) -> DVec3;

    /// Whether a point lies in the solid, by POV-Ray's rule for points on the surface. Never for shapes without volume.
    fn contains(&self, point: DVec3) -> bool;

    /// A box around the surface, infinite for unbounded shapes.
    fn bounds(&self) -> Bounds;

    /// Takes a transform into the shape's own numbers if the shape stays of its kind and POV-Ray does the same
    /// (a sphere under translation; a box under scaling). Says whether it did; if not, nothing has changed.
    fn absorb(&mut self, step: &Step) -> bool;

    /// Texture coordinates of a surface point for `uv_mapping`.
    fn uv(&self, point: DVec3) -> [f64; 2] {
        [point.x, point.y]
    }

    /// The shading normal where it differs from the geometric one (smooth triangles); not normalised.
    fn shading_normal(&self, point: DVec3, face: u16) -> DVec3 {
        self.normal(point, face)
    }

    /// Whether [`Geometry::contains`] can ever be true: solids and half-spaces can be cut, patches cannot.
    fn is_solid(&self) -> bool {
        true
    }
}
