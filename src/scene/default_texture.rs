//! Who takes the default texture: the whole of an object without a texture, as a rule. With `cutaway_textures` some parts
//! are left without one, to look like what they cut.
//!
//! Measured with POV-Ray 3.7, from the outside in, where nothing around says a texture: an object takes the default one
//! if no part of it has one of its own, unless it stands right in an intersection or difference with
//! `cutaway_textures`. The word holds for all combinations below, but only intersections and differences heed it, and
//! what counts as such is counted after inversion: a union that is cut away is an intersection. A combination that is
//! inverted after the word has lost it.

use super::{Kind, Object, Operation};
use crate::scene::shape::Geometry;
use crate::scene::texture::Texture;
use std::sync::Arc;

/// What lies around a part of an object.
#[derive(Clone, Copy, Default)]
struct Around {
    /// Whether it exchanges inside and outside of the part.
    is_exchanged: bool,
    /// Whether anything around was ever inverted, be it twice.
    was_turned: bool,
    /// Whether something around says `cutaway_textures`.
    cuts_away: bool,
    /// Whether the combination right around it heeds that.
    is_heeded: bool,
}

impl Object {
    /// The object, with the default texture where it takes that.
    #[must_use]
    pub fn with_default_texture(self: Arc<Self>, default: &Arc<Texture>) -> Arc<Object> {
        if self.size().has_cutaways {
            return self.dressed(Around::default(), default);
        }
        if self.texture.is_some() || matches!(self.kind, Kind::Light { .. }) {
            return self;
        }
        self.in_default(default)
    }

    fn in_default(mut self: Arc<Self>, default: &Arc<Texture>) -> Arc<Object> {
        let texture = self.attach(Arc::clone(default));
        Arc::make_mut(&mut self).texture = Some(texture);
        self
    }

    fn dressed(mut self: Arc<Self>, around: Around, default: &Arc<Texture>) -> Arc<Object> {
        if self.texture.is_some() || matches!(self.kind, Kind::Light { .. }) {
            return self;
        }
        let Kind::Csg {
            operation,
            children,
        } = &self.kind
        else {
            return if around.is_heeded {
                self
            } else {
                self.in_default(default)
            };
        };
        if !around.is_heeded && !self.has_texture() {
            return self.in_default(default);
        }
        let is_inverse = self.is_inverse != around.is_exchanged;
        let cuts_away = around.cuts_away || self.flags.cutaway_textures && !around.was_turned;
        let dressed = |(at, child): (usize, &Arc<Object>)| {
            let is_cut = *operation == Operation::Difference && at > 0;
            let inner = Around {
                is_exchanged: is_inverse != is_cut,
                was_turned: around.was_turned || self.is_inverse || is_cut,
                cuts_away,
                is_heeded: cuts_away && operation.is_shared(is_inverse),
            };
            Arc::clone(child).dressed(inner, default)
        };
        let children = children.iter().enumerate().map(dressed).collect();
        let kind = Kind::Csg {
            operation: *operation,
            children: Arc::new(children),
        };
        Arc::make_mut(&mut self).kind = kind;
        self
    }

    /// Whether it or some part of it has a texture of its own.
    fn has_texture(&self) -> bool {
        self.texture.is_some()
            || match &self.kind {
                Kind::Shape(shape) => !shape.face_textures().is_empty(),
                Kind::Light { .. } => false,
                Kind::Csg { children, .. } => children.iter().any(|child| child.has_texture()),
            }
    }
}
