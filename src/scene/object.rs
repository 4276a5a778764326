//! Objects: a shape, a light or a CSG tree, with its transforms and attributes.

use super::extent::ExtentBox;
use crate::base::color::Color;
use crate::base::math::{Bounds, Step};
use crate::scene::interior::Interior;
use crate::scene::light::{Light, ObjectPhotons};
use crate::scene::shape::{FaceTexture, Geometry, Shape};
use crate::scene::texture::Texture;
use std::num::NonZeroU64;
use std::sync::Arc;

/// Unions with fewer leaves are lowered once per copy.
const MIN_SHARED_LEAVES: u32 = 4;

/// Deeper unions are lowered once per copy, so that rays need not recurse that deep.
const MAX_SHARED_HEIGHT: u32 = 64;

/// An object of a scene. Clones share their children.
#[derive(Clone, Debug)]
pub struct Object {
    /// The shape, light or CSG operation.
    pub kind: Kind,
    /// Its transforms, in file order.
    pub steps: Vec<Step>,
    /// Its own texture, if any.
    pub texture: Option<Attached<Arc<Texture>>>,
    /// Its own interior, if any.
    pub interior: Option<Arc<Interior>>,
    /// Its flags.
    pub flags: Flags,
    /// Settings of a `light_group`, whose lights illuminate it alone.
    pub light_group: Option<LightGroup>,
    /// True if inside and outside are swapped.
    pub is_inverse: bool,
    /// Properties that few objects have, boxed because a scene may have a million objects without them.
    rare: Option<Box<Rare>>,
    pub(super) size: Size,
}

/// Properties that few objects have.
#[derive(Clone, Debug, Default)]
struct Rare {
    interior_texture: Option<Attached<Arc<Texture>>>,
    photons: Option<ObjectPhotons>,
    clipped_by: Vec<Attached<Arc<Object>>>,
    bounded_by: Vec<Attached<Arc<Object>>>,
    seen_in: Option<Attached<Bounds>>,
    moves_parts: bool,
    extent_so_far: Option<Attached<ExtentBox>>,
}

/// Size of an object tree. Sharing hides it: forty unions that each contain the one before twice are forty objects, and
/// 2⁴⁰ shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Depth of the tree, with the object itself.
    pub height: u32,
    /// Number of shapes and lights, counted once per rendered copy; saturates at `u32::MAX`.
    pub leaves: u32,
    /// True if some of them are lights.
    pub has_lights: bool,
    /// True if some object in the tree uses texture coordinates.
    pub uses_uv: bool,
    /// True if the object or some object in the tree has `cutaway_textures`.
    pub has_cutaways: bool,
    /// True if some object in the tree may have a box outside which it is invisible.
    pub may_have_visibility_box: bool,
    /// Depth of nested CSG objects, without those that merge into their parents: differences as the first part of a
    /// difference, unions in unions.
    pub csg_depth: u32,
}

/// A property that was attached to an object after its first `after` transforms, so that only later ones apply to it.
#[derive(Clone, Debug)]
pub struct Attached<T> {
    /// The property.
    pub what: T,
    /// Number of transforms of the object before it.
    pub after: usize,
}

/// Kinds of objects.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A primitive.
    Shape(Arc<Shape>),
    /// A light, which has transforms like an object and may be inside a union.
    Light {
        /// The light itself.
        light: Arc<Light>,
        /// The visible object of the light, which casts no shadow.
        looks_like: Option<Arc<Object>>,
        /// The object that its light must pass through. Objects between the two cast no shadow.
        projected_through: Option<Arc<Object>>,
    },
    /// A CSG object.
    Csg {
        /// The operation.
        operation: Operation,
        /// The operands, in file order.
        children: Children,
    },
}

/// The operands of a CSG object. Clones share the list, which lowering uses to detect instances.
pub type Children = Arc<Vec<Arc<Object>>>;

/// Settings of a `light_group` for the lights outside of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightGroup {
    /// True if they illuminate the group, too. The outermost of nested groups decides.
    pub global_lights: bool,
}

/// CSG operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// All surfaces of all children.
    Union,
    /// All surfaces that are not inside another child.
    Merge,
    /// The surfaces that are inside every other child.
    Intersection,
    /// The first child without the others.
    Difference,
}

impl Operation {
    /// Returns true for an intersection or difference that is not inverse, and for an inverse union or merge.
    #[must_use]
    pub(super) fn is_intersection(self, is_inverse: bool) -> bool {
        let is_sum = matches!(self, Operation::Union | Operation::Merge);
        is_sum == is_inverse
    }
}

/// Flags of an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// Casts no shadow.
    pub no_shadow: bool,
    /// Invisible to camera rays.
    pub no_image: bool,
    /// Invisible to reflection rays.
    pub no_reflection: bool,
    /// Invisible to irradiance rays.
    pub no_radiosity: bool,
    /// Importance for irradiance rays that hit it; `None` inherits the parent's.
    pub importance: Option<Importance>,
    /// Does not displace the atmosphere; `None` inherits the parent's value.
    pub hollow: Option<bool>,
    /// Lit from both sides.
    pub double_illuminate: bool,
    /// `split_union off`: a union that photons aim at as a whole.
    pub keeps_union: bool,
    /// `uv_mapping`: all patterns on it and on its parts are evaluated at texture coordinates.
    pub uv_mapping: bool,
    /// Parts without a texture take the textures of the objects they cut ([`Object::set_cutaway_textures`] sets this).
    pub(super) cutaway_textures: bool,
}

/// Fraction of irradiance rays that count where they hit an object (`radiosity { importance }`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Importance(NonZeroU64);

impl Importance {
    /// An importance above 0 and up to 1.
    #[must_use]
    pub fn new(share: f64) -> Self {
        Importance(NonZeroU64::new(share.to_bits()).unwrap_or(NonZeroU64::MIN))
    }

    /// The importance as a number.
    #[must_use]
    pub fn share(self) -> f64 {
        f64::from_bits(self.0.get())
    }
}

impl Default for Importance {
    /// All rays count.
    fn default() -> Self {
        Importance::new(1.0)
    }
}

impl Object {
    /// An object without attributes.
    #[must_use]
    pub fn new(kind: Kind) -> Self {
        let leaf = Size {
            height: 1,
            leaves: 1,
            has_lights: matches!(kind, Kind::Light { .. }),
            uses_uv: matches!(&kind, Kind::Shape(shape) if shape.face_textures().iter().any(FaceTexture::uses_uv)),
            has_cutaways: false,
            may_have_visibility_box: matches!(&kind, Kind::Shape(shape) if shape.extends_beyond_bounds()),
            csg_depth: 0,
        };
        let size = match &kind {
            Kind::Shape(_) => leaf,
            Kind::Light {
                looks_like,
                projected_through,
                ..
            } => {
                let held = looks_like.iter().chain(projected_through);
                held.fold(leaf, |sum, object| sum.with_nested(object.size))
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let nothing = Size { leaves: 0, ..leaf };
                let parts = children.iter().enumerate();
                parts.fold(nothing, |sum, (at, child)| {
                    let is_cut = *operation == Operation::Difference && at > 0;
                    sum.with_part(child, !child.merges_into(*operation, is_cut))
                })
            }
        };
        Object {
            kind,
            size,
            steps: Vec::new(),
            texture: None,
            interior: None,
            flags: Flags::default(),
            light_group: None,
            is_inverse: false,
            rare: None,
        }
    }

    /// The object with another shape, and with one colour as the pigment of its top layer if there is a colour.
    pub(super) fn with_shape_and_color(&self, shape: Shape, color: Option<Color>) -> Object {
        let kind = Kind::Shape(Arc::new(shape));
        let mut object = self.clone();
        object.size = Object::new(kind.clone()).size;
        object.kind = kind;
        if let (Some(color), Some(texture)) = (color, &mut object.texture) {
            texture.what = Arc::new(texture.what.with_color(color));
        }
        object.update_visibility_box();
        object
    }

    /// The texture of the inside of the surface.
    #[must_use]
    pub fn interior_texture(&self) -> Option<&Attached<Arc<Texture>>> {
        self.rare.as_ref()?.interior_texture.as_ref()
    }

    /// Sets the texture of the inside of the surface. Only later transforms of the object apply to it.
    pub fn set_interior_texture(&mut self, texture: Arc<Texture>) {
        let texture = self.attach(texture);
        self.rare.get_or_insert_default().interior_texture = Some(texture);
    }

    /// Its textures, the outside one first.
    pub fn textures(&self) -> impl Iterator<Item = &Attached<Arc<Texture>>> {
        self.texture.iter().chain(self.interior_texture())
    }

    /// Its own photon settings, if any.
    #[must_use]
    pub fn photons(&self) -> Option<&ObjectPhotons> {
        self.rare.as_ref()?.photons.as_ref()
    }

    /// Mutable access to its photon settings.
    pub fn photons_mut(&mut self) -> &mut ObjectPhotons {
        let rare = self.rare.get_or_insert_default();
        rare.photons.get_or_insert_default()
    }

    /// The `clipped_by` objects: only the surface inside all of them is visible.
    #[must_use]
    pub fn clipped_by(&self) -> &[Attached<Arc<Object>>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.clipped_by)
    }

    /// The `bounded_by` objects: rays that miss any of them miss the object.
    #[must_use]
    pub fn bounded_by(&self) -> &[Attached<Arc<Object>>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.bounded_by)
    }

    /// The box outside which the object is invisible, if more than its content would be visible.
    pub(crate) fn seen_in(&self) -> Option<&Attached<Bounds>> {
        self.rare.as_ref()?.seen_in.as_ref()
    }

    /// Returns true if the object is a union that, when split, transforms parts with such boxes.
    pub(crate) fn moves_parts(&self) -> bool {
        self.rare.as_ref().is_some_and(|rare| rare.moves_parts)
    }

    /// Sets or clears both.
    pub(super) fn set_visibility_box(&mut self, seen_in: Option<Bounds>, moves_parts: bool) {
        if self.rare.is_some() || seen_in.is_some() || moves_parts {
            let seen_in = seen_in.map(|bounds| self.attach(bounds));
            let rare = self.rare.get_or_insert_default();
            (rare.seen_in, rare.moves_parts) = (seen_in, moves_parts);
        }
    }

    /// Number of transforms up to the last property that is attached between them; only later ones can be merged.
    pub(crate) fn fixed_steps(&self) -> usize {
        let textures = self.textures().map(|texture| texture.after);
        let held = self.clips_and_bounds().map(|held| held.after);
        let boxes = self.seen_in().map(|bounds| bounds.after);
        let extent = self.extent_so_far().map(|extent| extent.after);
        let all = textures.chain(held).chain(boxes).chain(extent);
        all.max().unwrap_or(0)
    }

    /// POV-Ray's box of a clipped or bounded CSG object when its last statement ended, from which later transforms
    /// start.
    pub(super) fn extent_so_far(&self) -> Option<&Attached<ExtentBox>> {
        self.rare.as_ref()?.extent_so_far.as_ref()
    }

    /// Sets that box.
    pub(super) fn set_extent_so_far(&mut self, extent: ExtentBox) {
        let extent = self.attach(extent);
        self.rare.get_or_insert_default().extent_so_far = Some(extent);
    }

    /// The `clipped_by` and `bounded_by` objects.
    pub fn clips_and_bounds(&self) -> impl Iterator<Item = &Attached<Arc<Object>>> {
        self.clipped_by().iter().chain(self.bounded_by())
    }

    /// Mutable access to the `clipped_by` and `bounded_by` objects.
    pub(super) fn clips_and_bounds_mut(
        &mut self,
    ) -> impl Iterator<Item = &mut Attached<Arc<Object>>> {
        let rare = self.rare.iter_mut();
        rare.flat_map(|rare| rare.clipped_by.iter_mut().chain(&mut rare.bounded_by))
    }

    /// The texture of an object that has no other properties except transforms.
    pub(super) fn plain_texture(&self) -> Option<&Attached<Arc<Texture>>> {
        let Object {
            kind: _,
            steps: _,
            texture: Some(texture),
            interior: None,
            flags,
            light_group: None,
            is_inverse: false,
            rare: None,
            size: _,
        } = self
        else {
            return None;
        };
        (*flags == Flags::default()).then_some(texture)
    }

    /// Returns true if the object or any part of it uses texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        let mut textures = self.textures();
        self.size.uses_uv || self.flags.uv_mapping || textures.any(|own| own.what.uses_uv())
    }

    /// Returns true if the object has an inside: no part of it is a patch or a light.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        match &self.kind {
            Kind::Shape(shape) => shape.is_solid(),
            Kind::Light { .. } => false,
            Kind::Csg { children, .. } => children.iter().all(|child| child.is_solid()),
        }
    }

    /// Attaches a property that only later transforms of the object apply to.
    #[must_use]
    pub fn attach<T>(&self, what: T) -> Attached<T> {
        Attached {
            what,
            after: self.steps.len(),
        }
    }

    /// Returns true if the object can be merged into the operation of its parent; shapes always can. `is_cut`: the
    /// parent subtracts the object.
    fn merges_into(&self, around: Operation, is_cut: bool) -> bool {
        let Kind::Csg { operation, .. } = &self.kind else {
            return true;
        };
        let is_bare = self.clips_and_bounds().next().is_none();
        let is_intersection = |of| matches!(of, Operation::Intersection | Operation::Difference);
        let is_same = if self.is_inverse == is_cut {
            *operation == around || (is_intersection(*operation) && is_intersection(around))
        } else if is_intersection(around) {
            *operation == Operation::Merge || *operation == Operation::Union
        } else {
            around == Operation::Merge && is_intersection(*operation)
        };
        is_bare && is_same
    }

    /// The parts of a union that is neither inverse nor clipped nor bounded.
    #[must_use]
    pub fn plain_union(&self) -> Option<&Children> {
        let is_plain = !self.is_inverse && self.clips_and_bounds().next().is_none();
        match &self.kind {
            Kind::Csg {
                operation: Operation::Union,
                children,
            } if is_plain => Some(children),
            _ => None,
        }
    }

    /// The parts of a plain union, if other objects share them and they can be lowered once for all of these.
    #[must_use]
    pub fn shared_parts(&self) -> Option<&Children> {
        let is_suited = !self.size.has_lights
            && !self.size.has_cutaways
            && self.size.leaves >= MIN_SHARED_LEAVES
            && self.size.height <= MAX_SHARED_HEIGHT;
        self.plain_union()
            .filter(|children| is_suited && Arc::strong_count(children) > 1)
    }

    /// Returns true if the object has no attributes of its own.
    #[must_use]
    pub fn has_no_attributes(&self) -> bool {
        self.texture.is_none()
            && self.interior_texture().is_none()
            && self.interior.is_none()
            && self.light_group.is_none()
            && self.photons().is_none()
            && self.flags == Flags::default()
    }

    /// Returns true for a shape or CSG object without transforms and attributes.
    #[must_use]
    pub fn is_plain_part(&self) -> bool {
        self.steps.is_empty()
            && self.has_no_attributes()
            && self.rare.is_none()
            && !matches!(self.kind, Kind::Light { .. })
    }

    /// Size of the tree: the children as they were when the object was made, and the objects added with
    /// [`Object::clip`] and [`Object::bound`].
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Sets `cutaway_textures` if the object is an intersection or difference in its current orientation, and returns
    /// true if it is. The keyword has no effect on an inverted union.
    pub fn set_cutaway_textures(&mut self) -> bool {
        let is_suited = matches!(&self.kind, Kind::Csg { operation, .. } if operation.is_intersection(self.is_inverse));
        self.flags.cutaway_textures |= is_suited && !self.is_inverse;
        self.size.has_cutaways |= is_suited;
        is_suited
    }

    /// Swaps inside and outside. This clears `cutaway_textures`, as in POV-Ray.
    pub fn invert(&mut self) {
        self.is_inverse = !self.is_inverse;
        self.flags.cutaway_textures = false;
    }

    /// The object as a solid, inverse or not, with more transforms and without its `clipped_by` objects.
    pub(crate) fn as_solid(&self, is_inverse: bool, steps: &[Step]) -> Object {
        let mut solid = self.clone();
        solid.is_inverse = is_inverse;
        solid.steps.extend(steps.iter().cloned());
        if let Some(rare) = &mut solid.rare {
            rare.clipped_by.clear();
            rare.extent_so_far = None;
        }
        solid
    }

    /// Adds a `clipped_by` object.
    pub fn clip(&mut self, by: Attached<Arc<Object>>) {
        self.size = self.size.with_nested(by.what.size);
        self.rare.get_or_insert_default().clipped_by.push(by);
    }

    /// Adds a `bounded_by` object.
    pub fn bound(&mut self, by: Attached<Arc<Object>>) {
        self.size = self.size.with_nested(by.what.size);
        self.rare.get_or_insert_default().bounded_by.push(by);
    }

    /// Moves all children to `to`; a leaf remains.
    fn move_children_into(&mut self, to: &mut Vec<Arc<Object>>) {
        match &mut self.kind {
            Kind::Shape(_) => {}
            Kind::Light {
                looks_like,
                projected_through,
                ..
            } => to.extend(
                looks_like
                    .take()
                    .into_iter()
                    .chain(projected_through.take()),
            ),
            // A shared list is not dropped here.
            Kind::Csg { children, .. } => {
                if let Some(children) = Arc::get_mut(children) {
                    to.append(children);
                }
            }
        }
        if let Some(rare) = self.rare.take() {
            let around = rare.clipped_by.into_iter().chain(rare.bounded_by);
            to.extend(around.map(|attached| attached.what));
        }
    }
}

/// Iterative, because objects nest arbitrarily deep and the dropping thread may have a small stack.
impl Drop for Object {
    fn drop(&mut self) {
        let mut open = Vec::new();
        self.move_children_into(&mut open);
        while let Some(object) = open.pop() {
            if let Ok(mut last) = Arc::try_unwrap(object) {
                last.move_children_into(&mut open);
            }
        }
    }
}

impl Size {
    fn with_nested(self, inner: Size) -> Size {
        Size {
            csg_depth: self.csg_depth.max(inner.csg_depth.saturating_add(1)),
            ..self.with(inner)
        }
    }

    fn with_part(self, part: &Object, adds_depth: bool) -> Size {
        let depth = part.size.csg_depth + u32::from(adds_depth);
        Size {
            csg_depth: self.csg_depth.max(depth),
            uses_uv: self.uses_uv || part.uses_uv(),
            ..self.with(part.size)
        }
    }

    fn with(self, inner: Size) -> Size {
        Size {
            csg_depth: self.csg_depth,
            height: self.height.max(inner.height.saturating_add(1)),
            leaves: self.leaves.saturating_add(inner.leaves),
            has_lights: self.has_lights || inner.has_lights,
            uses_uv: self.uses_uv || inner.uses_uv,
            has_cutaways: self.has_cutaways || inner.has_cutaways,
            may_have_visibility_box: self.may_have_visibility_box || inner.may_have_visibility_box,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn light() -> Arc<Object> {
        Arc::new(Object::new(Kind::Light {
            light: Arc::new(Light::point(DVec3::ZERO, crate::base::color::Rgb::WHITE)),
            looks_like: None,
            projected_through: None,
        }))
    }

    fn union(children: Vec<Arc<Object>>) -> Arc<Object> {
        Arc::new(Object::new(Kind::Csg {
            operation: Operation::Union,
            children: Arc::new(children),
        }))
    }

    #[test]
    fn shared_children_count_as_often_as_they_are_drawn() {
        let mut doubled = light();
        for _ in 0..20 {
            doubled = union(vec![Arc::clone(&doubled), doubled]);
        }
        let size = Size {
            height: 21,
            leaves: 1 << 20,
            has_lights: true,
            uses_uv: false,
            has_cutaways: false,
            may_have_visibility_box: false,
            csg_depth: 0,
        };
        assert_eq!(doubled.size(), size);
        for _ in 0..20 {
            doubled = union(vec![Arc::clone(&doubled), doubled]);
        }
        assert_eq!(doubled.size().leaves, u32::MAX);
    }

    #[test]
    fn clips_count() {
        let mut object = (*union(vec![light()])).clone();
        let clip = object.attach(union(vec![union(vec![light()])]));
        object.clip(clip);
        let size = Size {
            height: 4,
            leaves: 2,
            has_lights: true,
            uses_uv: false,
            has_cutaways: false,
            may_have_visibility_box: false,
            csg_depth: 1,
        };
        assert_eq!(object.size(), size);
    }

    #[test]
    fn a_deep_tree_is_dropped_on_a_small_stack() {
        let drop_it = || {
            let mut deep = light();
            for _ in 0..200_000 {
                deep = union(vec![deep]);
            }
            drop(deep);
        };
        let small = std::thread::Builder::new().stack_size(1 << 17);
        assert!(small.spawn(drop_it).unwrap().join().is_ok());
    }
}
