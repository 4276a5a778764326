//! The shapes: one file each, with its mathematics, what it reads, and its hits.
//!
//! A shape reports *all* places where the whole line of a ray crosses it, as the edges of spans inside the solid,
//! so that CSG needs no inside test at a hit point. What must not be seen although it bounds the solid (the missing
//! cap of an open cylinder) is reported as not visible.
//!
//! A shape that can never be hit (radius zero, a degenerate triangle) has empty bounds, so that a caller can drop it.

mod axial;
mod blob;
#[cfg(test)]
pub(crate) mod check;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod mesh;
mod mesh2;
mod mesh_build;
mod mesh_looks;
#[cfg(test)]
mod oracle;
mod plane;
mod quadric;
mod read;
mod skin;
mod smooth_triangle;
mod sphere;
mod torus;
mod triangle;

pub use blob::Blob;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disc::Disc;
pub use mesh::Mesh;
pub use plane::Plane;
pub use quadric::Quadric;
pub use skin::{Share, Shares, Skin};
pub use smooth_triangle::SmoothTriangle;
pub use sphere::Sphere;
pub use torus::Torus;
pub use triangle::Triangle;

use crate::args::{Args, Parse, Word};
use crate::math::conditioning::Eased;
use crate::math::{Bounds, Ray, Step};
use glam::DVec3;

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

    /// The first visible root with `from < t < to`, both ends excluded: the same root, to the bit, that
    /// [`Geometry::roots`] appends.
    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut roots = Vec::new();
        self.roots(ray, &mut roots);
        first_visible(&roots, from, to)
    }

    /// Whether all that the line enters lies before the start of the ray: the solid is convex, and the ray, where it is
    /// near, goes away from it. What is not known is false.
    fn is_left_behind(&self, _ray: &Ray) -> bool {
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

    /// Takes a transform into the shape's own numbers if the shape stays of its kind and POV-Ray does the same
    /// (a sphere under translation; a box under scaling). Says whether it did; if not, nothing has changed.
    /// Texture coordinates of the shape before the step are lost: whoever needs [`Geometry::uv`] keeps the transform.
    fn absorb(&mut self, step: &Step) -> bool;

    /// Texture coordinates of a surface point for `uv_mapping`.
    fn uv(&self, point: DVec3) -> [f64; 2] {
        [point.x, point.y]
    }

    /// Texture coordinates of a point of the surface piece `face`.
    fn uv_of_face(&self, point: DVec3, _face: u32) -> [f64; 2] {
        self.uv(point)
    }

    /// The textures that pieces of the surface have of their own.
    fn skins(&self) -> &[Skin] {
        &[]
    }

    /// Which of [`Geometry::skins`] a point of the surface piece `face` shows; none if it looks as the object does.
    fn shares(&self, _point: DVec3, _face: u32) -> Shares {
        Shares::new()
    }

    /// The shading normal where it differs from the geometric one (smooth triangles); not normalised.
    fn shading_normal(&self, point: DVec3, face: u32) -> DVec3 {
        self.normal(point, face)
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

    /// Whether [`Geometry::contains`] can ever be true: solids and half-spaces can be cut, patches cannot.
    fn is_solid(&self) -> bool {
        true
    }
}

/// The list of shapes: variant, description, word, and for a shape with two words the other one and its reader.
/// A new shape is its file and one line here.
macro_rules! shapes {
    ($($(#[$doc:meta])* $name:ident from $word:ident $(or $also:ident by $reader:ident)?),+ $(,)?) => {
        /// Any shape.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $($(#[$doc])* $name($name)),+
        }

        impl Shape {
            /// The words that begin the shapes, in the order of the list.
            pub const WORDS: &[Word] = &[$(Word::$word $(, Word::$also)?),+];

            /// Reads what stands after `word {`: the shape's numbers and its own words, neither the object's
            /// modifiers nor the closing brace. `None` if the word begins no shape of this list.
            ///
            /// # Errors
            /// Malformed, non-finite or meaningless parameters.
            pub fn read(word: Word, args: &mut dyn Args) -> Option<Parse<Shape>> {
                match word {
                    $(
                        Word::$word => Some($name::read(args).map(Shape::$name)),
                        $(Word::$also => Some($name::$reader(args).map(Shape::$name)),)?
                    )+
                    _ => None,
                }
            }

            /// The word that begins this shape in a scene, the first of two.
            #[must_use]
            pub fn word(&self) -> Word {
                match self { $(Shape::$name(_) => Word::$word),+ }
            }
        }

        impl Geometry for Shape {
            fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
                match self { $(Shape::$name(shape) => shape.roots(ray, roots)),+ }
            }
            #[inline(always)]
            fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.nearest(ray, from, to)),+ }
            }
            fn is_left_behind(&self, ray: &Ray) -> bool {
                match self { $(Shape::$name(shape) => shape.is_left_behind(ray)),+ }
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
            fn absorb(&mut self, step: &Step) -> bool {
                match self { $(Shape::$name(shape) => shape.absorb(step)),+ }
            }
            fn uv(&self, point: DVec3) -> [f64; 2] {
                match self { $(Shape::$name(shape) => shape.uv(point)),+ }
            }
            fn shading_normal(&self, point: DVec3, face: u32) -> DVec3 {
                match self { $(Shape::$name(shape) => shape.shading_normal(point, face)),+ }
            }
            fn uv_of_face(&self, point: DVec3, face: u32) -> [f64; 2] {
                match self { $(Shape::$name(shape) => shape.uv_of_face(point, face)),+ }
            }
            fn skins(&self) -> &[Skin] {
                match self { $(Shape::$name(shape) => shape.skins()),+ }
            }
            fn shares(&self, point: DVec3, face: u32) -> Shares {
                match self { $(Shape::$name(shape) => shape.shares(point, face)),+ }
            }
            fn is_faceted(&self) -> bool {
                match self { $(Shape::$name(shape) => shape.is_faceted()),+ }
            }
            fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
                match self { $(Shape::$name(shape) => shape.nearest_beside(ray, from, to, face)),+ }
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
    /// `mesh` and `mesh2`
    Mesh from Mesh or Mesh2 by read_mesh2,
}

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
fn unease(eased: &Eased, roots: [Root; 2]) -> Option<[Root; 2]> {
    let roots = roots.map(|root| Root {
        t: eased.t(root.t),
        ..root
    });
    roots.iter().all(|root| root.t.is_finite()).then_some(roots)
}

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
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::syntax::Class;

    fn read(word: Word, text: &str) -> (Shape, TextArgs) {
        let mut args = TextArgs::new(text);
        let shape = Shape::read(word, &mut args).unwrap().unwrap();
        (shape, args)
    }

    #[test]
    fn every_word_of_the_list_is_a_shape_of_the_grammar() {
        for word in Shape::WORDS {
            assert_eq!(word.class(), Class::Shape);
        }
    }

    #[test]
    fn a_shape_reads_its_parameters_and_stops() {
        for (word, text) in [
            (Word::Sphere, "<1,2,3>, 4"),
            (Word::Sphere, "1 4"),
            (Word::Box, "-1, 1"),
            (Word::Cylinder, "<0,0,0>, <0,1,0>, 1"),
            (Word::Cylinder, "<0,0,0> <0,1,0> 1 open"),
            (Word::Cone, "<0,0,0>, 1, <0,1,0>, 0"),
            (Word::Cone, "<0,0,0> 1 <0,1,0> 0 open"),
            (Word::Torus, "1, .3"),
            (Word::Torus, "1 .3 sturm"),
            (Word::Plane, "<0,1,0>, -1"),
            (Word::Disc, "<0,0,0>, <0,1,0>, 1"),
            (Word::Disc, "<0,0,0> <0,1,0> 1 .5"),
            (Word::Triangle, "<0,0,0>, <0,1,0>, <1,0,0>"),
            (
                Word::SmoothTriangle,
                "<0,0,0>, <0,0,1>, <0,1,0>, <0,0,1>, <1,0,0>, <0,0,1>",
            ),
        ] {
            let (shape, args) = read(word, text);
            assert_eq!(shape.word(), word);
            assert!(args.is_done(), "{text}");
            assert!(args.warnings().is_empty());
            assert!(!shape.bounds().is_empty());
            let (_, mut args) = read(word, &format!("{text} rotate"));
            assert!(args.accept(Word::Rotate).unwrap());
        }
    }

    #[test]
    fn a_word_that_begins_no_shape_reads_nothing() {
        assert!(Shape::read(Word::Union, &mut TextArgs::new("")).is_none());
    }

    #[test]
    fn a_missing_parameter_is_an_error() {
        for word in Shape::WORDS {
            let result = Shape::read(*word, &mut TextArgs::new("<0,0,0>, <0,1,0>")).unwrap();
            assert_eq!(result.is_ok(), *word == Word::Box);
        }
    }
}
