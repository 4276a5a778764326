//! Assignment of the default texture. As a rule it goes to the whole of an object without a texture. With
//! `cutaway_textures` some parts are left without one, to take the textures of the objects they cut.
//!
//! Measured with POV-Ray 3.7, from the outside in, where no enclosing object has a texture: an object takes the default
//! texture if no part of it has one of its own, unless it is a direct child of an intersection or difference with
//! `cutaway_textures`. The keyword applies to all CSG objects below, but only intersections and differences respond to
//! it, as they are after inversion: a union that is subtracted is an intersection. A CSG object that is inverted after
//! the keyword loses it.

use super::{Kind, Object, Operation};
use crate::scene::shape::Geometry;
use crate::scene::texture::Texture;
use std::sync::Arc;

/// The enclosing objects of a part.
#[derive(Clone, Copy, Default)]
struct Enclosing {
    /// True if they invert the part.
    is_inverted: bool,
    /// True if any of them was inverted, even if a second inversion cancels it.
    was_inverted: bool,
    /// True if any of them has `cutaway_textures`.
    has_cutaway_textures: bool,
    /// True if the parent responds to it.
    is_cutaway_child: bool,
}

impl Object {
    /// The object, with the default texture on the parts that take it.
    #[must_use]
    pub fn with_default_texture(self: Arc<Self>, default: &Arc<Texture>) -> Arc<Object> {
        if self.size().has_cutaways {
            return self.with_cutaway_default(Enclosing::default(), default);
        }
        if self.texture.is_some() || matches!(self.kind, Kind::Light { .. }) {
            return self;
        }
        self.with_texture(default)
    }

    fn with_texture(mut self: Arc<Self>, default: &Arc<Texture>) -> Arc<Object> {
        let texture = self.attach(Arc::clone(default));
        Arc::make_mut(&mut self).texture = Some(texture);
        self
    }

    fn with_cutaway_default(
        mut self: Arc<Self>,
        enclosing: Enclosing,
        default: &Arc<Texture>,
    ) -> Arc<Object> {
        if self.texture.is_some() || matches!(self.kind, Kind::Light { .. }) {
            return self;
        }
        let Kind::Csg {
            operation,
            children,
        } = &self.kind
        else {
            return if enclosing.is_cutaway_child {
                self
            } else {
                self.with_texture(default)
            };
        };
        if !enclosing.is_cutaway_child && !self.has_texture() {
            return self.with_texture(default);
        }
        let is_inverse = self.is_inverse != enclosing.is_inverted;
        let has_cutaway_textures = enclosing.has_cutaway_textures
            || self.flags.cutaway_textures && !enclosing.was_inverted;
        let textured = |(at, child): (usize, &Arc<Object>)| {
            let is_cut = *operation == Operation::Difference && at > 0;
            let inner = Enclosing {
                is_inverted: is_inverse != is_cut,
                was_inverted: enclosing.was_inverted || self.is_inverse || is_cut,
                has_cutaway_textures,
                is_cutaway_child: has_cutaway_textures && operation.is_intersection(is_inverse),
            };
            Arc::clone(child).with_cutaway_default(inner, default)
        };
        let children = children.iter().enumerate().map(textured).collect();
        let kind = Kind::Csg {
            operation: *operation,
            children: Arc::new(children),
        };
        Arc::make_mut(&mut self).kind = kind;
        self
    }

    /// Returns true if the object or any part of it has a texture of its own.
    fn has_texture(&self) -> bool {
        self.texture.is_some()
            || match &self.kind {
                Kind::Shape(shape) => !shape.face_textures().is_empty(),
                Kind::Light { .. } => false,
                Kind::Csg { children, .. } => children.iter().any(|child| child.has_texture()),
            }
    }
}
