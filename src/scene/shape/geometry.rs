//! The operations of a shape on rays and points, and the crossings of its surface that they report.

use super::{FaceTexture, Rounded, TextureWeights, first_visible};
use crate::base::math::{Bounds, Ray, Step};
use crate::scene::shape::Steps;
use glam::{DAffine3, DMat3, DVec3};
use std::cmp::Ordering;

/// Direction in which a ray crosses the surface of a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// The ray enters the solid.
    Enter,
    /// The ray leaves the solid.
    Leave,
    /// The inside does not change: a surface without volume (triangle), or one within the solid (the inner lemon of a
    /// spindle torus).
    Touch,
}

/// A crossing of the line of a ray with a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Ray parameter, at `origin + t · dir`; may be negative, is never NaN or infinite.
    pub t: f64,
    /// Entry, exit, or neither.
    pub crossing: Crossing,
    /// Smooth piece of the shape: a face of a box, side or cap of a cylinder, a triangle of a mesh.
    pub face: u32,
    /// False for surfaces that only bound the solid, such as the missing cap of an open cylinder.
    pub is_visible: bool,
}

impl Root {
    /// A visible root on a shape that is one smooth piece.
    #[inline(always)]
    pub(crate) fn on_smooth(t: f64, is_exit: bool) -> Self {
        let crossing = match is_exit {
            true => Crossing::Leave,
            false => Crossing::Enter,
        };
        Root {
            t,
            crossing,
            face: 0,
            is_visible: true,
        }
    }
}

/// Side of the solid on which a line starts (`t → −∞`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Outside, as for every bounded solid.
    Outside,
    /// Inside, as for a half-space that the line leaves.
    Inside,
}

/// Side on which POV-Ray's inside test puts the points of a surface: it decides coincident surfaces in CSG. The tolerances
/// of the tests differ by shape (measured with shapes cut by themselves).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceSide {
    /// Inside the solid, outside its inverse.
    Inside,
    /// Outside the solid, inside its inverse.
    Outside,
    /// Inside both the solid and its inverse.
    Both,
    /// Either, by rounding: the test has no tolerance, and POV-Ray leaves speckles. Counts as inside; where nothing shows
    /// then, the cut is a clean one.
    Rounded,
}

/// A flat face across an axis of object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatFace {
    /// The axis, 0 to 2.
    pub axis: usize,
    /// The coordinate on it.
    pub coordinate: f64,
    /// The solid lies beyond it, in the direction of the axis.
    pub is_low: bool,
    /// Points exactly on it are inside.
    pub is_closed: bool,
}

impl FlatFace {
    /// The side on which a point at this position relative to the face lies.
    #[must_use]
    pub fn side(&self, position: Ordering) -> SurfaceSide {
        let is_inside = match position {
            Ordering::Equal => self.is_closed,
            Ordering::Greater => self.is_low,
            Ordering::Less => !self.is_low,
        };
        match is_inside {
            true => SurfaceSide::Inside,
            false => SurfaceSide::Outside,
        }
    }
}

/// Operations of a shape, all in its own object space.
pub trait Geometry {
    /// Appends all roots on the whole line of `ray` to `roots`, sorted by `t`; enter and leave alternate. Returns the
    /// side on which the line starts. A shape without volume appends only `Touch`.
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start;

    /// Appends a part of the roots of [`Geometry::roots`]: at least those beyond `from`, up to the first one beyond
    /// `enough`. Returns true only if these are certainly all of them.
    fn roots_from(&self, ray: &Ray, _from: f64, _enough: f64, roots: &mut Vec<Root>) -> bool {
        self.roots(ray, roots);
        true
    }

    /// First visible root with `from < t < to`, both ends excluded: bit for bit the root that [`Geometry::roots`]
    /// appends.
    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut roots = Vec::new();
        self.roots(ray, &mut roots);
        first_visible(&roots, from, to)
    }

    /// True if the ray certainly cannot enter the solid: the solid is convex, and the ray goes away from it. A ray that
    /// starts on the surface only has to start on the convex hull. False if in doubt.
    fn is_exiting(&self, _ray: &Ray) -> bool {
        false
    }

    /// True if a ray is exiting ([`Geometry::is_exiting`]) wherever it lies between rays from the same point that are.
    fn exits_in_cones(&self) -> bool {
        true
    }

    /// The outward normal, not normalised, at a point of surface piece `face`.
    fn normal(&self, point: DVec3, face: u32) -> DVec3;

    /// The same where a ray in the direction `dir` was the one to hit it, if the normal depends on that.
    fn normal_along(&self, point: DVec3, _dir: DVec3, face: u32) -> DVec3 {
        self.normal(point, face)
    }

    /// Inside test, with POV-Ray's rule for points on the surface. Always false for shapes without volume.
    fn contains(&self, point: DVec3) -> bool;

    /// Bounding box of the surface, infinite for unbounded shapes and empty for one that no ray can hit.
    fn bounds(&self) -> Bounds;

    /// Bounding box of all points for which [`Geometry::contains`] may be true: larger than the bounds of the surface
    /// where the surface is only a part of the boundary of the solid (`disc`).
    fn solid_bounds(&self) -> Bounds {
        if self.extends_beyond_bounds() {
            Bounds::EVERYTHING
        } else {
            self.bounds()
        }
    }

    /// True if the inside extends beyond the bounding box of the surface.
    fn extends_beyond_bounds(&self) -> bool {
        false
    }

    /// Applies a transform to the shape's own parameters if the shape stays of its kind and POV-Ray does the same (a
    /// sphere under translation; a box under scaling). Returns false, without a change, otherwise. With
    /// [`Geometry::loses_uv`], texture coordinates of the shape before the step are lost.
    fn absorb(&mut self, step: &Step) -> bool;

    /// Notes the transforms that it did not absorb, which its rays go through.
    fn note_steps(&mut self, _steps: &[Step]) {}

    /// Precomputes the data that ray queries need; no step is absorbed afterwards.
    fn prepare(&mut self) {}

    /// Scales the lengths that POV-Ray measures in scene units, whatever the transform of the shape: the resolution of
    /// a root search along a ray, the flatness of patches.
    fn scale_scene_lengths(&mut self, _factor: f64) {}

    /// Texture coordinates for `uv_mapping` at a point of surface piece `face`; `None` for shapes without their own,
    /// which take those of the world.
    fn uv(&self, _point: DVec3, _face: u32) -> Option<[f64; 2]> {
        None
    }

    /// True if [`Geometry::uv`] changes with the steps that [`Geometry::absorb`] applies.
    fn loses_uv(&self) -> bool {
        false
    }

    /// Textures of single surface pieces.
    fn face_textures(&self) -> &[FaceTexture] {
        &[]
    }

    /// Weights of [`Geometry::face_textures`] at a point of surface piece `face`; empty where the texture of the object
    /// applies.
    fn texture_weights(&self, _point: DVec3, _face: u32) -> TextureWeights {
        TextureWeights::new()
    }

    /// The shading normal where it may differ from the geometric one (smooth triangles); not normalised.
    fn shading_normal(&self, _point: DVec3, _face: u32) -> Option<DVec3> {
        None
    }

    /// True if the shape consists of flat pieces, each with a `face` of its own, which a line crosses at most once.
    fn is_faceted(&self) -> bool {
        false
    }

    /// The same as [`Geometry::nearest`] without the piece `face`, which the ray has just left. Only called for faceted
    /// shapes.
    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let mut roots = Vec::new();
        self.roots(ray, &mut roots);
        roots.retain(|root| root.face != face);
        first_visible(&roots, from, to)
    }

    /// True if the shape itself excludes the surface that a ray has just left, so that the caller must not hide any of
    /// its roots. Its roots then begin at the start of the ray, and [`Geometry::roots`] returns the side on which the
    /// ray starts.
    fn excludes_spawn_surface(&self) -> bool {
        false
    }

    /// True if rays that miss its `bounded_by` miss it, although it is no part of a CSG object; it may have a `clipped_by`.
    fn tests_bounds(&self, _is_clipped: bool) -> bool {
        false
    }

    /// True if `bounded_by` does not change its box.
    fn keeps_its_box(&self) -> bool {
        false
    }

    /// True if `clipped_by` gives it a smaller box but cuts nothing away.
    fn is_never_clipped(&self) -> bool {
        false
    }

    /// True if a search finds the roots, which may miss some, so that CSG tests the points of other surfaces for being
    /// inside, as POV-Ray does for all shapes.
    fn may_miss_roots(&self) -> bool {
        false
    }

    /// Bounding box for `min_extent` and `max_extent` of a shape that POV-Ray stores in a rotated space of its own, and
    /// the transform from that space to the shape's. `None` where [`Geometry::bounds`] serves.
    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        None
    }

    /// POV-Ray's box after as many of these steps as it takes into account, and their number; later ones transform the box.
    /// `None` if those are the steps of [`Geometry::absorb`].
    fn povray_box_after(&self, _steps: &[Step]) -> Option<(Bounds, usize)> {
        None
    }

    /// True if the surface extends beyond POV-Ray's box, so that rays that miss the box do not show all of it.
    fn shows_beyond_its_box(&self) -> bool {
        false
    }

    /// The shape moved by `steps`, with POV-Ray's rounding; `None` where that is not known, or planes and boxes, whose roots
    /// are rounded alike.
    fn rounded(&self, _steps: &Steps<'_>) -> Option<Rounded> {
        None
    }

    /// True if a search finds the hits, whose normals depend on its last digits: all of them are wanted rounded.
    fn is_searched(&self) -> bool {
        false
    }

    /// True if the rounded distances of its hits decide ties.
    fn decides_ties(&self) -> bool {
        false
    }

    /// The root at `t`, where the ray is known to have one; `None` in doubt.
    fn root_at(&self, _ray: &Ray, _t: f64) -> Option<Root> {
        None
    }

    /// True if [`Geometry::is_well_inside`] may hold: rays are transformed for it only then.
    fn tests_well_inside(&self) -> bool {
        false
    }

    /// True if a ray lies well inside from its start to `to`: no rounding can bring the surface there. False in doubt.
    fn is_well_inside(&self, _ray: &Ray, _to: f64) -> bool {
        false
    }

    /// A bounding sphere by centre and radius, where one is tighter than the bounding box.
    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        None
    }

    /// A tight infinite bounding cylinder: a point of its axis, the unit direction of the axis, and the radius.
    fn bounding_cylinder(&self) -> Option<(DVec3, DVec3, f64)> {
        None
    }

    /// The centre, and the extent from it along each axis after a rotation or scaling by `matrix`, where that is tighter
    /// than the transformed bounding box; `None` also if squares overflow or underflow.
    fn tight_extent(&self, _matrix: &DMat3) -> Option<(DVec3, DVec3)> {
        None
    }

    /// The part of a box that may lie inside, or outside where `is_inverse`, of a surface that is unbounded by itself.
    fn limited(&self, _around: &Bounds, _is_inverse: bool) -> Option<Bounds> {
        None
    }

    /// The normal and distance of a half-space.
    fn half_space(&self) -> Option<(DVec3, f64)> {
        None
    }

    /// True if POV-Ray's normal does not flip where the inside is inverted, which `trace` and `interior_texture` show.
    fn keeps_normal(&self) -> bool {
        false
    }

    /// The same of versions before 3.8 alone.
    fn keeps_normal_before_3_8(&self) -> bool {
        false
    }

    /// True if transforms apply to the textures of surface pieces even under `uv_mapping`, as POV-Ray has it for blobs.
    fn moves_face_textures(&self) -> bool {
        false
    }

    /// True if both sides look alike, whatever `interior_texture` says: blobs whose components have textures, but not
    /// meshes (measured with POV-Ray).
    fn has_one_side(&self) -> bool {
        false
    }

    /// True if shadow rays end on either side where the textures outside are opaque, whatever `interior_texture` lets
    /// through (measured with POV-Ray, docs/povray-facts.md, section 4.4).
    fn casts_shadow_of_outside(&self) -> bool {
        false
    }

    /// The flat face with this number, if it lies across an axis and POV-Ray's inside test compares coordinates with it.
    fn flat_face(&self, _face: u32) -> Option<FlatFace> {
        None
    }

    /// The side of points on the surface.
    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Rounded
    }

    /// True if the language has `sturm` for it; elsewhere POV-Ray rejects the word.
    fn takes_sturm(&self) -> bool {
        false
    }

    /// Notes that it has `sturm`, if that changes what POV-Ray shows.
    fn use_sturm(&mut self) {}

    /// True if the language has `hierarchy` for it; elsewhere POV-Ray rejects the word.
    fn takes_hierarchy(&self) -> bool {
        false
    }

    /// True if [`Geometry::contains`] can ever be true: solids and half-spaces can be cut, patches cannot.
    fn is_solid(&self) -> bool {
        true
    }
}
