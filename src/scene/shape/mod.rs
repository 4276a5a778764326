//! The shapes: one file each, with its mathematics, what it reads, and its hits.
//!
//! A shape reports *all* places where the whole line of a ray crosses it, as the edges of spans inside the solid,
//! so that CSG needs no inside test at a hit point. What must not be seen although it bounds the solid (the missing
//! cap of an open cylinder) is reported as not visible.
//!
//! A shape that can never be hit (radius zero, a degenerate triangle) has empty bounds, so that a caller can drop it.

mod container;
mod face_texture;
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
/// Solids given by a formula.
mod solid {
    pub(super) mod axial;
    pub(super) mod cone;
    pub(super) mod cuboid;
    pub(super) mod cylinder;
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
    pub(super) mod sor;
    pub(super) mod sphere_sweep;
    pub(super) mod spline;
    pub(super) mod text;
}

pub use face_texture::{FaceTexture, TextureWeight, TextureWeights};
pub use implicit::blob::Blob;
pub use implicit::isosurface::Isosurface;
pub use implicit::julia_fractal::JuliaFractal;
pub use implicit::poly::Poly;
pub use mesh::Mesh;
pub use mesh::height_field::HeightField;
pub use mesh::placed::PlacedMesh;
pub(crate) use packet::{RayPacket, SpanPacket};
pub use patch::bicubic_patch::BicubicPatch;
pub use patch::disc::Disc;
pub use patch::parametric::Parametric;
pub use patch::polygon::Polygon;
pub use patch::smooth_triangle::SmoothTriangle;
pub use patch::triangle::Triangle;
pub use solid::cone::Cone;
pub use solid::cuboid::Cuboid;
pub use solid::cylinder::Cylinder;
pub use solid::ovus::Ovus;
pub use solid::plane::Plane;
pub use solid::quadric::Quadric;
pub use solid::sphere::Sphere;
pub use solid::superellipsoid::Superellipsoid;
pub use solid::torus::Torus;
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

/// What a ray does to the inside of a solid at a crossing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// It goes in.
    Enter,
    /// It comes out.
    Leave,
    /// The inside stays as it is: a surface without a volume (triangle), or one within the solid (the inner lemon of a
    /// spindle torus).
    Touch,
}

/// A place where the line of a ray meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Where on the ray: `origin + t · dir`; may be negative, is never NaN or infinite.
    pub t: f64,
    /// What happens to the inside there.
    pub crossing: Crossing,
    /// Which smooth piece of the shape: a face of a box, side or cap of a cylinder, a triangle of a mesh.
    pub face: u32,
    /// Whether the surface is there to be seen.
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

    /// Appends, of the roots that [`Geometry::roots`] appends, at least those beyond `from` up to the first beyond `enough`.
    /// Says whether these are all of them for certain.
    fn roots_from(&self, ray: &Ray, _from: f64, _enough: f64, roots: &mut Vec<Root>) -> bool {
        self.roots(ray, roots);
        true
    }

    /// The first visible root with `from < t < to`, both ends excluded: the same root, to the bit, that
    /// [`Geometry::roots`] appends.
    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut roots = Vec::new();
        self.roots(ray, &mut roots);
        first_visible(&roots, from, to)
    }

    /// Whether all that the line enters lies before the start of the ray: the solid is convex, and the ray, where it is
    /// near, goes away from it. For a ray that goes out from the surface it is enough that it starts where that is a part
    /// of the hull. What is not known is false.
    fn is_exiting(&self, _ray: &Ray) -> bool {
        false
    }

    /// The outward normal, not normalised, at a point of the surface piece `face`.
    fn normal(&self, point: DVec3, face: u32) -> DVec3;

    /// Whether a point lies in the solid, by POV-Ray's rule for points on the surface. Never for shapes without volume.
    fn contains(&self, point: DVec3) -> bool;

    /// A box around the surface, infinite for unbounded shapes and empty for one that no ray can meet.
    fn bounds(&self) -> Bounds;

    /// A box around all points for which [`Geometry::contains`] may be true: larger than the bounds of the surface
    /// where the surface is only a part of what bounds the solid (`disc`).
    fn solid_bounds(&self) -> Bounds {
        self.bounds()
    }

    /// Tells whether its inside reaches beyond the box around its surface.
    fn reaches_out(&self) -> bool {
        false
    }

    /// Takes a transform into the shape's own numbers if the shape stays of its kind and POV-Ray does the same
    /// (a sphere under translation; a box under scaling). Says whether it did; if not, nothing has changed.
    /// With [`Geometry::loses_uv`], texture coordinates of the shape before the step are lost.
    fn absorb(&mut self, step: &Step) -> bool;

    /// Works out what rays need, when no further step is to be absorbed.
    fn prepare(&mut self) {}

    /// Makes the lengths larger that POV-Ray counts in units of the scene, whatever the transform of the shape: how fine
    /// a surface is searched for along a ray, how flat its pieces are.
    fn change_unit(&mut self, _factor: f64) {}

    /// Texture coordinates of a point of the surface piece `face` for `uv_mapping`; `None` for the shapes that have none
    /// of their own and take those of the world.
    fn uv(&self, _point: DVec3, _face: u32) -> Option<[f64; 2]> {
        None
    }

    /// Whether [`Geometry::uv`] is another after a step that [`Geometry::absorb`] has taken in.
    fn loses_uv(&self) -> bool {
        false
    }

    /// The textures that pieces of the surface have of their own.
    fn skins(&self) -> &[FaceTexture] {
        &[]
    }

    /// Which of [`Geometry::skins`] a point of the surface piece `face` shows; none if it looks as the object does.
    fn shares(&self, _point: DVec3, _face: u32) -> TextureWeights {
        TextureWeights::new()
    }

    /// The shading normal where it may differ from the geometric one (smooth triangles); not normalised.
    fn shading_normal(&self, _point: DVec3, _face: u32) -> Option<DVec3> {
        None
    }

    /// Whether it is made of flat pieces, each with a `face` of its own, which a line meets at most once.
    fn is_faceted(&self) -> bool {
        false
    }

    /// The same as [`Geometry::nearest`] without the piece `face`, which the ray has just left. Only faceted shapes are
    /// asked.
    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let mut roots = Vec::new();
        self.roots(ray, &mut roots);
        roots.retain(|root| root.face != face);
        first_visible(&roots, from, to)
    }

    /// Whether it tells by itself the surface that a ray has just left, so that none of its roots is to be hidden. Its
    /// roots are then those from the start of the ray on, and [`Geometry::roots`] says whether the ray starts inside.
    fn knows_departures(&self) -> bool {
        false
    }

    /// The box by which POV-Ray knows a shape that it holds in a space of its own, turned along some axis, and what
    /// takes that space to the shape's: for `min_extent` and `max_extent`. `None` where the box is that of the bounds.
    fn held_box(&self) -> Option<(Bounds, DAffine3)> {
        None
    }

    /// Whether [`Geometry::contains`] can ever be true: solids and half-spaces can be cut, patches cannot.
    fn is_solid(&self) -> bool {
        true
    }
}

/// The list of shapes: variant, description, word, and for a shape with more words the others and their readers.
/// A new shape is its file and one line here.
macro_rules! shapes {
    ($($(#[$doc:meta])* $name:ident from $word:ident $(or $also:ident by $reader:ident)*),+ $(,)?) => {
        /// Any shape.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $($(#[$doc])* $name($name)),+
        }

        impl Shape {
            /// The words that begin the shapes, in the order of the list.
            pub const WORDS: &[Word] = &[$(Word::$word $(, Word::$also)*),+];

            /// Reads what stands after `word {`: the shape's numbers and its own words, neither the object's
            /// modifiers nor the closing brace. `None` if the word begins no shape of this list.
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

            /// The word that begins this shape in a scene, the first of several.
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
            fn normal(&self, point: DVec3, face: u32) -> DVec3 {
                match self { $(Shape::$name(shape) => shape.normal(point, face)),+ }
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
            fn reaches_out(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.reaches_out()),+ }
            }
            fn absorb(&mut self, step: &Step) -> bool {
                match self { $(Shape::$name(shape) => shape.absorb(step)),+ }
            }
            fn prepare(&mut self) {
                match self { $(Shape::$name(shape) => shape.prepare()),+ }
            }
            fn change_unit(&mut self, factor: f64) {
                match self { $(Shape::$name(shape) => shape.change_unit(factor)),+ }
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
            fn skins(&self) -> &[FaceTexture] {
                match self { $(Shape::$name(shape) => shape.skins()),+ }
            }
            fn shares(&self, point: DVec3, face: u32) -> TextureWeights {
                match self { $(Shape::$name(shape) => shape.shares(point, face)),+ }
            }
            fn is_faceted(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_faceted()),+ }
            }
            fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.nearest_beside(ray, from, to, face)),+ }
            }
            fn knows_departures(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.knows_departures()),+ }
            }
            fn held_box(&self) -> Option<(Bounds, DAffine3)> {
                match self { $(Shape::$name(shape) => shape.held_box()),+ }
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
    /// `poly`, `cubic` and `quartic`
    Poly from Poly or Cubic by read_cubic or Quartic by read_quartic,
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
}

/// What lies within this share of a solid is far from its surface by any rounding.
const WELL_INSIDE: f64 = 1.0 - 1e-6;

/// The first visible root strictly between `from` and `to` of roots in order.
#[inline]
fn first_visible(roots: &[Root], from: f64, to: f64) -> Option<Root> {
    roots
        .iter()
        .find(|root| root.is_visible && from < root.t && root.t < to)
        .copied()
}

/// A visible span of a bounded solid, `None` if an end is not a finite number.
#[inline]
fn span(enter: (f64, u32), leave: (f64, u32)) -> Option<[Root; 2]> {
    let root = |(t, face), crossing| Root {
        t,
        crossing,
        face,
        is_visible: true,
    };
    (enter.0.is_finite() && leave.0.is_finite())
        .then(|| [root(enter, Crossing::Enter), root(leave, Crossing::Leave)])
}

/// The span on the ray as it was given, of a span on the eased ray.
fn unease(eased: &RescaledRay, roots: [Root; 2]) -> Option<[Root; 2]> {
    let roots = roots.map(|root| Root {
        t: eased.t(root.t),
        ..root
    });
    roots.iter().all(|root| root.t.is_finite()).then_some(roots)
}

/// What turns the z axis to a unit direction by the shortest way, and moves the origin: where POV-Ray holds discs,
/// cylinders and cones.
fn along(dir: DVec3, origin: DVec3) -> DAffine3 {
    let to_z = 1.0 + dir.z;
    let matrix = if to_z < 1e-10 {
        DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0))
    } else {
        let (a, b) = (dir.x, dir.y);
        let mixed = -a * b / to_z;
        DMat3::from_cols(
            DVec3::new(1.0 - a * a / to_z, mixed, -a),
            DVec3::new(mixed, 1.0 - b * b / to_z, -b),
            dir,
        )
    };
    DAffine3::from_mat3_translation(matrix, origin)
}

/// The roots on one ray of a surface that cuts space in two.
type Crossings = SmallVec<[Root; 8]>;

/// The visible roots of one smooth surface, face 0, at places in order, through each of which the line goes in or out.
/// Those that lie beyond all numbers are left out, and the start is then on this side of them.
fn alternate(start: Start, places: impl Iterator<Item = f64>) -> (Start, Crossings) {
    let mut roots = Crossings::new();
    let start = alternate_into(start, places, |root| roots.push(root));
    (start, roots)
}

/// The same; each root is given to `put`.
#[inline(always)]
fn alternate_into(
    mut start: Start,
    places: impl Iterator<Item = f64>,
    mut put: impl FnMut(Root),
) -> Start {
    let mut is_inside = start == Start::Inside;
    for t in places {
        let crossing = if is_inside {
            Crossing::Leave
        } else {
            Crossing::Enter
        };
        is_inside = !is_inside;
        if t.is_finite() {
            put(Root {
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

/// What lies so far aside of something, as a share of the lengths that it is worked out from, does so for all roundings.
const SURELY_ASIDE: f64 = 1.0 / (1u64 << 20) as f64;

/// Appends the span of a convex bounded solid.
fn push_span(span: Option<[Root; 2]>, roots: &mut Vec<Root>) -> Start {
    if let Some(span) = span {
        roots.extend_from_slice(&span);
    }
    Start::Outside
}

/// The factor of a scaling that turns spheres into spheres; mirrors count.
fn even_scale(by: DVec3) -> Option<f64> {
    let size = by.abs();
    (size.x == size.y && size.y == size.z).then_some(size.x)
}

#[cfg(test)]
mod tests;
