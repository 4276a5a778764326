//! Boxes outside which objects are invisible. POV-Ray tests an object only against rays that hit its box, and that box
//! does not always contain all that would show: the inside of a height field extends below its box without end, that of
//! a disc behind it, and objects that they clip or cut have their boxes. The box of a shape with `bounded_by` is that of
//! its bounds if this is smaller, whether it contains the shape or not; the bounds themselves are not tested. Blobs,
//! height fields and Julia fractals keep their own box. A superellipsoid of a negative exponent extends beyond its own.
//!
//! Measured with POV-Ray 3.7: a ray that hits the box sees everything along it, including what lies outside of the box.
//! Parts of a CSG object have no boxes of their own. Parts of a union that is split have, unless the union as a whole
//! was transformed: then shapes have their own boxes again, whatever clips them, and CSG objects keep theirs.

use super::extent::is_limited;
use super::shape::Geometry;
use super::{Kind, Object};

impl Object {
    /// Stores the box outside which the object is invisible. Called when all its properties are set.
    pub(crate) fn update_visibility_box(&mut self) {
        let is_bounded = !self.bounded_by().is_empty();
        let is_bare = match &self.kind {
            Kind::Shape(shape) => {
                let has_box = is_bounded && !shape.keeps_its_box();
                self.size.may_have_visibility_box |= has_box || shape.is_never_clipped();
                self.clipped_by().is_empty() && !has_box && !shape.shows_beyond_its_box()
            }
            _ => false,
        };
        if !self.size().may_have_visibility_box {
            return;
        }
        let is_union = self.plain_union().is_some();
        let seen_in = (!is_union && !is_bare).then(|| self.single_extent());
        let moves_parts = is_union && !self.steps.is_empty();
        self.set_visibility_box(seen_in.filter(is_limited), moves_parts);
    }
}
