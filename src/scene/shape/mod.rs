//! Primitives: one file each, with its mathematics, its parser and its intersection code.
//!
//! A shape reports *all* crossings of the whole line of a ray, as ends of spans inside the solid, so that CSG needs no
//! inside test at a hit point, unless the shape [may miss](Geometry::may_miss_roots) some. A surface that bounds the solid but must not be seen (the missing cap of an open
//! cylinder) is reported as not visible.
//!
//! A shape that can never be hit (radius zero, a degenerate triangle) has empty bounds, so that a caller can drop it.

mod container;
mod face_texture;
mod geometry;
mod ray_packet;
/// Surfaces given by a field: blobs, functions, polynomials and fractals.
mod implicit {
    pub(super) mod blob;
    pub(super) mod isosurface;
    pub(super) mod julia_fractal;
    pub(super) mod poly;
}
mod mesh;
mod outside;
mod packet;
mod packet_search;
/// Surfaces without a volume.
mod patch {
    pub(super) mod bicubic_patch;
    pub(super) mod disc;
    pub(super) mod parametric;
    pub(super) mod parametric_patch;
    pub(super) mod polygon;
    pub(super) mod smooth_triangle;
    pub(super) mod triangle;
}
mod read;
mod rounded;
/// Solids given by a formula.
mod solid {
    pub(super) mod axial;
    pub(super) mod cone;
    pub(super) mod cuboid;
    pub(super) mod cylinder;
    pub(super) mod lemon;
    pub(super) mod ovus;
    pub(super) mod plane;
    pub(super) mod quadric;
    pub(super) mod quadric_packet;
    pub(super) mod sphere;
    pub(super) mod superellipsoid;
    pub(super) mod torus;
    pub(super) mod torus_packet;
}
/// Shapes made of a curve or an outline: turned, extruded or swept.
mod swept {
    pub(super) mod lathe;
    pub(super) mod prism;
    pub(super) mod rounded;
    pub(super) mod sor;
    pub(super) mod sphere_sweep;
    pub(super) mod spline;
    pub(super) mod text;
}

pub use face_texture::{FaceTexture, TextureWeight, TextureWeights};
pub use geometry::{Crossing, FlatFace, Geometry, Root, Start, SurfaceSide};
pub use implicit::blob::Blob;
pub use implicit::isosurface::Isosurface;
pub use implicit::julia_fractal::JuliaFractal;
pub use implicit::poly::Poly;
pub use mesh::height_field::HeightField;
pub use mesh::instance::MeshInstance;
pub use mesh::{Mesh, MeshLists};
pub(crate) use packet::SpanPacket;
pub use patch::bicubic_patch::BicubicPatch;
pub use patch::disc::Disc;
pub use patch::parametric::Parametric;
pub use patch::polygon::Polygon;
pub use patch::smooth_triangle::SmoothTriangle;
pub use patch::triangle::Triangle;
pub(crate) use ray_packet::RayPacket;
pub use rounded::{Rounded, RoundedHit, Steps};
pub use solid::cone::Cone;
pub use solid::cuboid::Cuboid;
pub use solid::cylinder::Cylinder;
pub use solid::lemon::Lemon;
pub use solid::ovus::Ovus;
pub use solid::plane::Plane;
pub use solid::quadric::Quadric;
pub use solid::sphere::Sphere;
pub use solid::superellipsoid::Superellipsoid;
pub use solid::torus::{Spindle, Torus};
pub use swept::lathe::Lathe;
pub use swept::prism::Prism;
pub use swept::sor::Sor;
pub use swept::sphere_sweep::SphereSweep;
pub use swept::text::Text;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::RescaledRay;
use crate::base::math::{Bounds, Ray, Step};
use glam::{DAffine3, DMat3, DVec3};
use smallvec::SmallVec;

/// The list of shapes: variant, description, keyword, and for a shape with more keywords the others and their readers.
/// A new shape is its file and one line here.
macro_rules! shapes {
    ($($(#[$doc:meta])* $name:ident from $word:ident $(or $also:ident by $reader:ident)*),+ $(,)?) => {
        /// Any shape.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $($(#[$doc])* $name($name)),+
        }

        impl Shape {
            /// The keywords of the shapes, in the order of the list.
            pub const WORDS: &[Word] = &[$(Word::$word $(, Word::$also)*),+];

            /// Reads the contents after `word {`: the shape's numbers and its own keywords, neither the object's
            /// modifiers nor the closing brace. `None` if the keyword begins no shape of this list.
            ///
            /// # Errors
            /// Malformed, non-finite or meaningless parameters.
            pub fn read(word: Word, args: &mut dyn Args) -> Option<Parse<Shape>> {
                match word {
                    $(
                        Word::$word => Some($name::read(args).map(Shape::$name)),
                        $(Word::$also => Some($name::$reader(args).map(Shape::$name)),)*
                    )+
                    _ => None,
                }
            }

            /// The keyword of this shape in a scene, the first of several.
            #[must_use]
            pub fn word(&self) -> Word {
                match self { $(Shape::$name(_) => Word::$word),+ }
            }
        }

        impl Geometry for Shape {
            fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
                match self { $(Shape::$name(shape) => shape.roots(ray, roots)),+ }
            }
            fn roots_from(&self, ray: &Ray, from: f64, enough: f64, roots: &mut Vec<Root>) -> bool {
                match self { $(Shape::$name(shape) => shape.roots_from(ray, from, enough, roots)),+ }
            }
            #[inline(always)]
            fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.nearest(ray, from, to)),+ }
            }
            fn is_exiting(&self, ray: &Ray) -> bool {
                match self { $(Shape::$name(shape) => shape.is_exiting(ray)),+ }
            }

            fn exits_in_cones(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.exits_in_cones()),+ }
            }
            fn normal(&self, point: DVec3, face: u32) -> DVec3 {
                match self { $(Shape::$name(shape) => shape.normal(point, face)),+ }
            }
            fn normal_along(&self, point: DVec3, dir: DVec3, face: u32) -> DVec3 {
                match self { $(Shape::$name(shape) => shape.normal_along(point, dir, face)),+ }
            }
            fn contains(&self, point: DVec3) -> bool {
                match self { $(Shape::$name(shape) => shape.contains(point)),+ }
            }
            fn bounds(&self) -> Bounds {
                match self { $(Shape::$name(shape) => shape.bounds()),+ }
            }
            fn solid_bounds(&self) -> Bounds {
                match self { $(Shape::$name(shape) => shape.solid_bounds()),+ }
            }
            fn extends_beyond_bounds(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.extends_beyond_bounds()),+ }
            }
            fn absorb(&mut self, step: &Step) -> bool {
                match self { $(Shape::$name(shape) => shape.absorb(step)),+ }
            }
            fn note_steps(&mut self, steps: &[Step]) {
                match self { $(Shape::$name(shape) => shape.note_steps(steps)),+ }
            }
            fn prepare(&mut self) {
                match self { $(Shape::$name(shape) => shape.prepare()),+ }
            }
            fn scale_scene_lengths(&mut self, factor: f64) {
                match self { $(Shape::$name(shape) => shape.scale_scene_lengths(factor)),+ }
            }
            fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
                match self { $(Shape::$name(shape) => shape.uv(point, face)),+ }
            }
            fn loses_uv(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.loses_uv()),+ }
            }
            fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
                match self { $(Shape::$name(shape) => shape.shading_normal(point, face)),+ }
            }
            fn face_textures(&self) -> &[FaceTexture] {
                match self { $(Shape::$name(shape) => shape.face_textures()),+ }
            }
            fn texture_weights(&self, point: DVec3, face: u32) -> TextureWeights {
                match self { $(Shape::$name(shape) => shape.texture_weights(point, face)),+ }
            }
            fn is_faceted(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_faceted()),+ }
            }
            fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.nearest_beside(ray, from, to, face)),+ }
            }
            fn excludes_spawn_surface(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.excludes_spawn_surface()),+ }
            }
            fn keeps_its_box(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.keeps_its_box()),+ }
            }
            fn is_never_clipped(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_never_clipped()),+ }
            }
            fn may_miss_roots(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.may_miss_roots()),+ }
            }
            fn shows_beyond_its_box(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.shows_beyond_its_box()),+ }
            }
            fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
                match self { $(Shape::$name(shape) => shape.povray_box()),+ }
            }
            fn povray_box_after(&self, steps: &[Step]) -> Option<(Bounds, usize)> {
                match self { $(Shape::$name(shape) => shape.povray_box_after(steps)),+ }
            }
            fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
                match self { $(Shape::$name(shape) => shape.rounded(steps)),+ }
            }
            fn is_searched(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_searched()),+ }
            }
            fn decides_ties(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.decides_ties()),+ }
            }
            #[inline]
            fn root_at(&self, ray: &Ray, t: f64) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.root_at(ray, t)),+ }
            }
            #[inline(always)]
            fn tests_well_inside(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.tests_well_inside()),+ }
            }
            #[inline]
            fn is_well_inside(&self, ray: &Ray, to: f64) -> bool {
                match self { $(Shape::$name(shape) => shape.is_well_inside(ray, to)),+ }
            }
            fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
                match self { $(Shape::$name(shape) => shape.bounding_sphere()),+ }
            }
            fn bounding_cylinder(&self) -> Option<(DVec3, DVec3, f64)> {
                match self { $(Shape::$name(shape) => shape.bounding_cylinder()),+ }
            }
            fn tight_extent(&self, matrix: &DMat3) -> Option<(DVec3, DVec3)> {
                match self { $(Shape::$name(shape) => shape.tight_extent(matrix)),+ }
            }
            fn limited(&self, around: &Bounds, is_inverse: bool) -> Option<Bounds> {
                match self { $(Shape::$name(shape) => shape.limited(around, is_inverse)),+ }
            }
            fn half_space(&self) -> Option<(DVec3, f64)> {
                match self { $(Shape::$name(shape) => shape.half_space()),+ }
            }
            fn keeps_normal(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.keeps_normal()),+ }
            }
            fn tests_bounds(&self, is_clipped: bool) -> bool {
                match self { $(Shape::$name(shape) => shape.tests_bounds(is_clipped)),+ }
            }
            fn keeps_normal_before_3_8(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.keeps_normal_before_3_8()),+ }
            }
            fn moves_face_textures(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.moves_face_textures()),+ }
            }
            fn has_one_side(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.has_one_side()),+ }
            }
            fn casts_shadow_of_outside(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.casts_shadow_of_outside()),+ }
            }
            fn flat_face(&self, face: u32) -> Option<FlatFace> {
                match self { $(Shape::$name(shape) => shape.flat_face(face)),+ }
            }
            fn surface_side(&self) -> SurfaceSide {
                match self { $(Shape::$name(shape) => shape.surface_side()),+ }
            }
            fn use_sturm(&mut self) {
                match self { $(Shape::$name(shape) => shape.use_sturm()),+ }
            }

            fn takes_sturm(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.takes_sturm()),+ }
            }
            fn takes_hierarchy(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.takes_hierarchy()),+ }
            }
            fn is_solid(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_solid()),+ }
            }
        }
    };
}

shapes! {
    /// `sphere`
    Sphere from Sphere,
    /// `box`
    Cuboid from Box,
    /// `cylinder`
    Cylinder from Cylinder,
    /// `cone`
    Cone from Cone,
    /// `torus`
    Torus from Torus,
    /// `plane`
    Plane from Plane,
    /// `disc`
    Disc from Disc,
    /// `triangle`
    Triangle from Triangle,
    /// `smooth_triangle`
    SmoothTriangle from SmoothTriangle,
    /// `quadric`
    Quadric from Quadric,
    /// `blob`
    Blob from Blob,
    /// `superellipsoid`
    Superellipsoid from Superellipsoid,
    /// `prism`
    Prism from Prism,
    /// `lathe`
    Lathe from Lathe,
    /// `poly`, `polynomial`, `cubic` and `quartic`
    Poly from Poly or Polynomial by read_polynomial or Cubic by read_cubic or Quartic by read_quartic,
    /// `sor`
    Sor from Sor,
    /// `polygon`
    Polygon from Polygon,
    /// `ovus`
    Ovus from Ovus,
    /// `mesh` and `mesh2`
    Mesh from Mesh or Mesh2 by read_mesh2,
    /// `height_field`
    HeightField from HeightField,
    /// `bicubic_patch`
    BicubicPatch from BicubicPatch,
    /// `text`
    Text from Text,
    /// `julia_fractal`
    JuliaFractal from JuliaFractal,
    /// `sphere_sweep`
    SphereSweep from SphereSweep,
    /// `isosurface`
    Isosurface from Isosurface,
    /// `parametric`
    Parametric from Parametric,
    /// `lemon`
    Lemon from Lemon,
}

/// Tolerance of POV-Ray's inside tests of planes, cylinders, cones, superellipsoids and straight sweeps, in the space of
/// the shape (measured by bisection).
const INSIDE_TOLERANCE: f64 = 1e-10;

/// Fraction of the size of a solid within which a point is inside, whatever is rounded.
const WELL_INSIDE: f64 = 1.0 - 1e-6;

/// The first visible root strictly between `from` and `to`; `roots` are sorted.
#[inline]
fn first_visible(roots: &[Root], from: f64, to: f64) -> Option<Root> {
    roots
        .iter()
        .find(|root| root.is_visible && from < root.t && root.t < to)
        .copied()
}

/// An end of a ray's span inside a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpanEnd {
    /// Ray parameter.
    pub(crate) t: f64,
    /// The face on which the end lies, or the index of a part.
    pub(crate) face: u32,
}

impl SpanEnd {
    #[inline(always)]
    pub(crate) fn new(t: f64, face: u32) -> Self {
        SpanEnd { t, face }
    }
}

/// A visible span of a bounded solid, `None` if an end is not finite.
#[inline]
fn span(enter: SpanEnd, leave: SpanEnd) -> Option<[Root; 2]> {
    let root = |end: SpanEnd, crossing| Root {
        t: end.t,
        crossing,
        face: end.face,
        is_visible: true,
    };
    (enter.t.is_finite() && leave.t.is_finite())
        .then(|| [root(enter, Crossing::Enter), root(leave, Crossing::Leave)])
}

/// Converts a span on the rescaled ray to the original ray.
fn original_span(rescaled: &RescaledRay, roots: [Root; 2]) -> Option<[Root; 2]> {
    let roots = roots.map(|root| Root {
        t: rescaled.t(root.t),
        ..root
    });
    roots.iter().all(|root| root.t.is_finite()).then_some(roots)
}

/// Rotation from the z axis to a unit direction along the shortest arc, followed by a translation: the space in which
/// POV-Ray stores discs, cylinders and cones.
fn along(dir: DVec3, origin: DVec3) -> DAffine3 {
    let to_z = 1.0 + dir.z;
    let matrix = if to_z < 1e-10 {
        DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0))
    } else {
        let (a, b) = (dir.x, dir.y);
        let xy = -a * b / to_z;
        DMat3::from_cols(
            DVec3::new(1.0 - a * a / to_z, xy, -a),
            DVec3::new(xy, 1.0 - b * b / to_z, -b),
            dir,
        )
    };
    DAffine3::from_mat3_translation(matrix, origin)
}

/// Roots on one ray of a surface that separates an inside from an outside.
type Crossings = SmallVec<[Root; 8]>;

/// Visible roots of one smooth surface, face 0, at the sorted parameters of its crossings; entry and exit alternate. A
/// parameter that has overflowed yields no root; below zero it moves the start to the other side instead.
fn alternate(start: Start, params: impl Iterator<Item = f64>) -> (Start, Crossings) {
    let mut roots = Crossings::new();
    let start = alternate_into(start, params, |root| roots.push(root));
    (start, roots)
}

/// Like [`alternate`], but passes each root to `push`.
#[inline(always)]
fn alternate_into(
    mut start: Start,
    params: impl Iterator<Item = f64>,
    mut push: impl FnMut(Root),
) -> Start {
    let mut is_inside = start == Start::Inside;
    for t in params {
        let crossing = if is_inside {
            Crossing::Leave
        } else {
            Crossing::Enter
        };
        is_inside = !is_inside;
        if t.is_finite() {
            push(Root {
                t,
                crossing,
                face: 0,
                is_visible: true,
            });
        } else if t < 0.0 {
            start = match start {
                Start::Inside => Start::Outside,
                Start::Outside => Start::Inside,
            };
        }
    }
    start
}

/// Relative margin beyond all rounding: the distance from an edge, as a fraction of the lengths in the computation, at
/// which a point is certainly to one side of it.
const CLEAR_MARGIN: f64 = 1.0 / (1u64 << 20) as f64;

/// Appends the span of a convex bounded solid.
fn push_span(span: Option<[Root; 2]>, roots: &mut Vec<Root>) -> Start {
    if let Some(span) = span {
        roots.extend_from_slice(&span);
    }
    Start::Outside
}

/// The factor of a scaling that maps spheres to spheres, mirrorings included.
fn uniform_scale(by: DVec3) -> Option<f64> {
    let factors = by.abs();
    (factors.x == factors.y && factors.y == factors.z).then_some(factors.x)
}

#[cfg(test)]
mod tests;
