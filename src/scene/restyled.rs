//! The shapes that have other textures in the next reading of a scene.

use super::likeness::Likeness;
use super::{Attached, Entry, Kind, Object, Objects, Operation};
use crate::base::color::Color;
use crate::scene::shape::Sphere;
use crate::scene::texture::Texture;
use std::sync::Arc;

/// With more such shapes than this, giving them their textures takes longer than it saves.
const MOST: usize = 1 << 12;

/// A shape in another texture. It is an object of the scene, or a part of unions.
#[derive(Debug)]
pub(crate) struct Restyled {
    /// The index of the object.
    pub(crate) index: usize,
    /// Number of shapes in the object, and of those before this one.
    pub(crate) shapes: u32,
    pub(crate) before: u32,
    /// The shape in its new texture, within the unions around it, which have no other parts here.
    pub(crate) object: Arc<Object>,
}

/// The shapes that have another texture in the second list; `None` if the lists differ in anything else, or in very much.
pub(crate) fn restyled(old: &Objects, new: &Objects) -> Option<Vec<Restyled>> {
    if old.len() != new.len() {
        return None;
    }
    let mut likeness = Likeness::default();
    let (mut all, mut made) = (Vec::new(), Vec::new());
    let mut compare = |index: usize, old: &Entry, new: &Entry| {
        let is_same = is_same(old, new, &mut likeness);
        if all.len() > MOST {
            return false;
        }
        if is_same {
            return true;
        }
        let [old, new] = [old, new].map(|entry| entry.clone().into_object());
        // Results of comparisons are found by addresses.
        made.extend([Arc::clone(&old), Arc::clone(&new)]);
        let shapes = new.size().leaves;
        let Some(parts) = restyled_parts(&old, &new, 0, &mut likeness) else {
            return false;
        };
        all.extend(parts.into_iter().map(|(before, object)| Restyled {
            index,
            shapes,
            before,
            object,
        }));
        true
    };
    let is_done = old.unshared_pairs(new, &mut compare);
    is_done.then_some(all)
}

/// True if two entries are certainly alike.
fn is_same(old: &Entry, new: &Entry, likeness: &mut Likeness) -> bool {
    match (old, new) {
        (Entry::Whole(old), Entry::Whole(new)) => Arc::ptr_eq(old, new),
        (
            Entry::Sphere {
                sphere: a,
                color,
                finish,
            },
            Entry::Sphere {
                sphere: b,
                color: other,
                finish: other_finish,
            },
        ) => {
            sphere_bits(a) == sphere_bits(b)
                && color_bits(color) == color_bits(other)
                && likeness.same(finish, other_finish)
        }
        (
            Entry::TexturedSphere { sphere: a, texture },
            Entry::TexturedSphere {
                sphere: b,
                texture: other,
            },
        ) => sphere_bits(a) == sphere_bits(b) && likeness.same(texture, other),
        (
            Entry::Colored {
                shape: a,
                color,
                finish,
            },
            Entry::Colored {
                shape: b,
                color: other,
                finish: other_finish,
            },
        ) => {
            color_bits(color) == color_bits(other)
                && likeness.same(finish, other_finish)
                && likeness.same(a, b)
        }
        (
            Entry::Textured { shape: a, texture },
            Entry::Textured {
                shape: b,
                texture: other,
            },
        ) => likeness.same(texture, other) && likeness.same(a, b),
        (
            Entry::Moved {
                shape: a,
                color,
                finish,
                steps,
            },
            Entry::Moved {
                shape: b,
                color: other,
                finish: other_finish,
                steps: other_steps,
            },
        ) => {
            color_bits(color) == color_bits(other)
                && likeness.same(finish, other_finish)
                && likeness.same(a, b)
                && likeness.alike(steps, other_steps)
        }
        _ => false,
    }
}

fn sphere_bits(sphere: &Sphere) -> [u64; 4] {
    let [x, y, z] = sphere.centre.to_array();
    [x, y, z, sphere.radius].map(f64::to_bits)
}

fn color_bits(color: &Color) -> [u32; 5] {
    let Color {
        rgb,
        filter,
        transmit,
    } = *color;
    [rgb.r, rgb.g, rgb.b, filter, transmit].map(f32::to_bits)
}

/// The shapes in an object that have another texture in its new form, each with the number of shapes before it.
fn restyled_parts(
    old: &Arc<Object>,
    new: &Arc<Object>,
    before: u32,
    likeness: &mut Likeness,
) -> Option<Vec<(u32, Arc<Object>)>> {
    if Arc::ptr_eq(old, new) {
        return Some(Vec::new());
    }
    if let (Some(old_parts), Some(new_parts)) = (old.plain_union(), new.plain_union()) {
        let is_same = old_parts.len() == new_parts.len()
            && likeness.alike(&without_kind(old), &without_kind(new));
        // Its parts share the interior of its finish.
        if !is_same || has_interior(new.texture.as_ref()) {
            return None;
        }
        let (mut all, mut before) = (Vec::new(), before);
        for (old_part, new_part) in old_parts.iter().zip(&**new_parts) {
            let parts = match same_objects(old_part, new_part, likeness) {
                true => Vec::new(),
                false => restyled_parts(old_part, new_part, before, likeness)?,
            };
            for (before, part) in parts {
                let mut around = (**new).clone();
                around.kind = union_of(vec![part]);
                all.push((before, Arc::new(around)));
            }
            before = before.saturating_add(new_part.size().leaves);
            if all.len() > MOST {
                return None;
            }
        }
        return Some(all);
    }
    let (Kind::Shape(old_shape), Kind::Shape(new_shape)) = (&old.kind, &new.kind) else {
        return same_objects(old, new, likeness).then(Vec::new);
    };
    let is_same_shape = likeness.same(old_shape, new_shape);
    let [mut old_rest, mut new_rest] = [old, new].map(without_kind);
    let textures = [&mut old_rest, &mut new_rest].map(|rest| rest.texture.take());
    if !is_same_shape || !likeness.alike(&old_rest, &new_rest) {
        return None;
    }
    if likeness.alike(&textures[0], &textures[1]) {
        return Some(Vec::new());
    }
    let mut textures = textures.iter().map(Option::as_ref);
    (!textures.any(has_interior)).then(|| vec![(before, Arc::clone(new))])
}

/// True if two objects are alike. Parts that several of them share are compared once.
fn same_objects(old: &Arc<Object>, new: &Arc<Object>, likeness: &mut Likeness) -> bool {
    likeness.known_or(old, new, |likeness| {
        let is_same_kind = match (&old.kind, &new.kind) {
            (Kind::Shape(old), Kind::Shape(new)) => likeness.same(old, new),
            (
                Kind::Csg {
                    operation,
                    children,
                },
                Kind::Csg {
                    operation: other,
                    children: others,
                },
            ) => {
                let mut pairs = children.iter().zip(&**others);
                operation == other
                    && children.len() == others.len()
                    && pairs.all(|(old, new)| same_objects(old, new, likeness))
            }
            _ => return likeness.alike(old, new),
        };
        is_same_kind && likeness.alike(&without_kind(old), &without_kind(new))
    })
}

/// True if the finish of a texture makes an interior.
fn has_interior(texture: Option<&Attached<Arc<Texture>>>) -> bool {
    let mut layers = texture.iter().flat_map(|texture| texture.what.layers());
    layers.any(|layer| layer.finish.has_interior())
}

/// An object's attributes.
fn without_kind(object: &Arc<Object>) -> Object {
    let mut rest = (**object).clone();
    rest.kind = union_of(Vec::new());
    rest
}

fn union_of(children: Vec<Arc<Object>>) -> Kind {
    Kind::Csg {
        operation: Operation::Union,
        children: Arc::new(children),
    }
}
