//! Objects: a shape or a combination of objects, with what it carries.

use crate::base::math::{Bounds, Step};
use crate::scene::interior::Interior;
use crate::scene::light::{Light, ObjectPhotons};
use crate::scene::shape::{FaceTexture, Geometry, Shape};
use crate::scene::texture::Texture;
use std::num::NonZeroU64;
use std::sync::Arc;

/// Of smaller unions each copy is prepared by itself.
const SHARED_LEAVES: u32 = 4;

/// Unions with more in each other are prepared by themselves, so that rays need not go that deep.
const SHARED_HEIGHT: u32 = 64;

/// An object of a scene. Copies share their children.
#[derive(Clone, Debug)]
pub struct Object {
    /// What it is.
    pub kind: Kind,
    /// Its transforms in the order of the file.
    pub steps: Vec<Step>,
    /// Its texture, if it has one of its own.
    pub texture: Option<Attached<Arc<Texture>>>,
    /// What fills it, if it says so itself.
    pub interior: Option<Arc<Interior>>,
    /// Its switches.
    pub flags: Flags,
    /// Whether it is a `light_group`, whose own lights shine on it alone.
    pub light_group: Option<LightGroup>,
    /// Whether inside and outside are exchanged.
    pub is_inverse: bool,
    /// What few objects say; there may be a million of the others.
    rare: Option<Box<Rare>>,
    size: Size,
}

/// What few objects say.
#[derive(Clone, Debug, Default)]
struct Rare {
    interior_texture: Option<Attached<Arc<Texture>>>,
    photons: Option<ObjectPhotons>,
    clipped_by: Vec<Attached<Arc<Object>>>,
    bounded_by: Vec<Attached<Arc<Object>>>,
    seen_in: Option<Attached<Bounds>>,
    moves_parts: bool,
}

/// How much an object holds. Sharing hides it: forty unions that each hold the one before twice are forty objects,
/// and 2⁴⁰ shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Objects inside each other, itself included.
    pub height: u32,
    /// Shapes and lights, each counted as often as it is drawn; `u32::MAX` for that many and more.
    pub leaves: u32,
    /// Whether lights are among them.
    pub has_lights: bool,
    /// Whether some of the objects in it ask for texture coordinates.
    pub uses_uv: bool,
    /// Whether it or something in it says `cutaway_textures`.
    pub has_cutaways: bool,
    /// True if there are shapes in it whose insides reach beyond the boxes around their surfaces.
    pub reaches_out: bool,
    /// Combinations inside each other, without those that say no more than the one around them would say of their
    /// parts: differences whose first part is a difference, unions of unions.
    pub turns: u32,
}

/// Something that an object was given after its first `after` transforms, so that only the later ones move it.
#[derive(Clone, Debug)]
pub struct Attached<T> {
    /// The thing.
    pub what: T,
    /// How many steps of the object came before it.
    pub after: usize,
}

/// What an object is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A primitive.
    Shape(Arc<Shape>),
    /// A light, which is moved like an object and may stand inside a union.
    Light {
        /// The light itself.
        light: Arc<Light>,
        /// What stands in its place to be seen, and casts no shadow.
        looks_like: Option<Arc<Object>>,
        /// What its light must meet on its way, and where its shadows end.
        projected_through: Option<Arc<Object>>,
    },
    /// A combination.
    Csg {
        /// How.
        operation: Operation,
        /// Of what, in the order of the file.
        children: Children,
    },
}

/// The parts of a combination. Copies of it hold the same list, so that whoever prepares them for rays can see what
/// they have in common.
pub type Children = Arc<Vec<Arc<Object>>>;

/// What a `light_group` says of the lights outside of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightGroup {
    /// Whether they shine on it too. Of groups in groups the outermost decides.
    pub global_lights: bool,
}

/// How objects are combined.
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
    /// Whether it keeps what its children share, as a difference does with what its later ones leave; `is_inverse`: it is
    /// inverted, which makes a union such a one.
    #[must_use]
    pub(super) fn is_shared(self, is_inverse: bool) -> bool {
        let is_sum = matches!(self, Operation::Union | Operation::Merge);
        is_sum == is_inverse
    }
}

/// The switches of an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// Casts no shadow.
    pub no_shadow: bool,
    /// Not seen by camera rays.
    pub no_image: bool,
    /// Not seen by reflected rays.
    pub no_reflection: bool,
    /// Not seen by rays that gather light from other surfaces.
    pub no_radiosity: bool,
    /// How many of the rays that gather light and meet it count; `None` takes the parent's.
    pub importance: Option<Importance>,
    /// Does not displace the atmosphere; `None` takes the parent's.
    pub hollow: Option<bool>,
    /// Lit from both sides.
    pub double_illuminate: bool,
    /// `uv_mapping`: all patterns on it, and on what it holds, are asked at texture coordinates.
    pub uv_mapping: bool,
    /// Parts without a texture look like what they cut ([`Object::cut_away`] says so).
    pub(super) cutaway_textures: bool,
}

/// The share of the rays that gather light that counts where they meet an object (`radiosity { importance }`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Importance(NonZeroU64);

impl Importance {
    /// A share, above 0 and up to 1.
    #[must_use]
    pub fn new(share: f64) -> Self {
        Importance(NonZeroU64::new(share.to_bits()).unwrap_or(NonZeroU64::MIN))
    }

    /// The share.
    #[must_use]
    pub fn share(self) -> f64 {
        f64::from_bits(self.0.get())
    }
}

impl Default for Importance {
    /// All of them.
    fn default() -> Self {
        Importance::new(1.0)
    }
}

impl Object {
    /// A bare object.
    #[must_use]
    pub fn new(kind: Kind) -> Self {
        let leaf = Size {
            height: 1,
            leaves: 1,
            has_lights: matches!(kind, Kind::Light { .. }),
            uses_uv: matches!(&kind, Kind::Shape(shape) if shape.face_textures().iter().any(FaceTexture::uses_uv)),
            has_cutaways: false,
            reaches_out: matches!(&kind, Kind::Shape(shape) if shape.extends_beyond_bounds()),
            turns: 0,
        };
        let size = match &kind {
            Kind::Shape(_) => leaf,
            Kind::Light {
                looks_like,
                projected_through,
                ..
            } => {
                let held = looks_like.iter().chain(projected_through);
                held.fold(leaf, |sum, object| sum.with_inside(object.size))
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let nothing = Size { leaves: 0, ..leaf };
                let parts = children.iter().enumerate();
                parts.fold(nothing, |sum, (at, child)| {
                    let is_cut = *operation == Operation::Difference && at > 0;
                    sum.with_part(child, !child.is_part_of(*operation, is_cut))
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

    /// The texture that is seen from inside.
    #[must_use]
    pub fn interior_texture(&self) -> Option<&Attached<Arc<Texture>>> {
        self.rare.as_ref()?.interior_texture.as_ref()
    }

    /// Gives it a texture that is seen from inside, and that only its later transforms move.
    pub fn set_interior_texture(&mut self, texture: Arc<Texture>) {
        let texture = self.attach(texture);
        self.rare.get_or_insert_default().interior_texture = Some(texture);
    }

    /// Its textures, that seen from outside first.
    pub fn textures(&self) -> impl Iterator<Item = &Attached<Arc<Texture>>> {
        self.texture.iter().chain(self.interior_texture())
    }

    /// What it does with photons, if it says so itself.
    #[must_use]
    pub fn photons(&self) -> Option<&ObjectPhotons> {
        self.rare.as_ref()?.photons.as_ref()
    }

    /// What it says of photons, to be changed.
    pub fn photons_mut(&mut self) -> &mut ObjectPhotons {
        let rare = self.rare.get_or_insert_default();
        rare.photons.get_or_insert_default()
    }

    /// `clipped_by`: the surface is kept where all of these hold it.
    #[must_use]
    pub fn clipped_by(&self) -> &[Attached<Arc<Object>>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.clipped_by)
    }

    /// `bounded_by`: rays that miss any of these miss the object.
    #[must_use]
    pub fn bounded_by(&self) -> &[Attached<Arc<Object>>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.bounded_by)
    }

    /// The box that rays must meet to see anything of it, where more than that box holds would show.
    pub(crate) fn seen_in(&self) -> Option<&Attached<Bounds>> {
        self.rare.as_ref()?.seen_in.as_ref()
    }

    /// Tells whether it moves parts that are seen within boxes, if it is taken apart.
    pub(crate) fn moves_parts(&self) -> bool {
        self.rare.as_ref().is_some_and(|rare| rare.moves_parts)
    }

    /// Notes both of them; or that there is neither.
    pub(super) fn note_boxes(&mut self, seen_in: Option<Bounds>, moves_parts: bool) {
        if self.rare.is_some() || seen_in.is_some() || moves_parts {
            let seen_in = seen_in.map(|bounds| self.attach(bounds));
            let rare = self.rare.get_or_insert_default();
            (rare.seen_in, rare.moves_parts) = (seen_in, moves_parts);
        }
    }

    /// What it is clipped and bounded by.
    pub fn around(&self) -> impl Iterator<Item = &Attached<Arc<Object>>> {
        self.clipped_by().iter().chain(self.bounded_by())
    }

    /// The same, to be changed.
    pub(super) fn around_mut(&mut self) -> impl Iterator<Item = &mut Attached<Arc<Object>>> {
        let rare = self.rare.iter_mut();
        rare.flat_map(|rare| rare.clipped_by.iter_mut().chain(&mut rare.bounded_by))
    }

    /// The texture of an object that has one and transforms, and nothing else.
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

    /// Whether it or something in it asks for texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        let mut textures = self.textures();
        self.size.uses_uv || self.flags.uv_mapping || textures.any(|own| own.what.uses_uv())
    }

    /// Whether it has an inside: no part of it is a patch or a light.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        match &self.kind {
            Kind::Shape(shape) => shape.is_solid(),
            Kind::Light { .. } => false,
            Kind::Csg { children, .. } => children.iter().all(|child| child.is_solid()),
        }
    }

    /// Gives the object something that only its later transforms move.
    #[must_use]
    pub fn attach<T>(&self, what: T) -> Attached<T> {
        Attached {
            what,
            after: self.steps.len(),
        }
    }

    /// Whether it says nothing but what the combination around it would say of its parts; `is_cut`: that takes it away.
    /// Shapes do.
    fn is_part_of(&self, around: Operation, is_cut: bool) -> bool {
        let Kind::Csg { operation, .. } = &self.kind else {
            return true;
        };
        let is_bare = self.around().next().is_none();
        let is_shared = |of| matches!(of, Operation::Intersection | Operation::Difference);
        let is_same = if self.is_inverse == is_cut {
            *operation == around || (is_shared(*operation) && is_shared(around))
        } else if is_shared(around) {
            *operation == Operation::Merge || *operation == Operation::Union
        } else {
            around == Operation::Merge && is_shared(*operation)
        };
        is_bare && is_same
    }

    /// The parts of a union that is no more than all of them: neither inverse, nor clipped or bounded.
    #[must_use]
    pub fn plain_union(&self) -> Option<&Children> {
        let is_plain = !self.is_inverse && self.around().next().is_none();
        match &self.kind {
            Kind::Csg {
                operation: Operation::Union,
                children,
            } if is_plain => Some(children),
            _ => None,
        }
    }

    /// The parts of a plain union that other objects hold too, if they can be prepared once for all of them.
    #[must_use]
    pub fn shared_parts(&self) -> Option<&Children> {
        let is_suited = !self.size.has_lights
            && !self.size.has_cutaways
            && self.size.leaves >= SHARED_LEAVES
            && self.size.height <= SHARED_HEIGHT;
        self.plain_union()
            .filter(|children| is_suited && Arc::strong_count(children) > 1)
    }

    /// Whether it says nothing of how it looks.
    #[must_use]
    pub fn says_no_looks(&self) -> bool {
        self.texture.is_none()
            && self.interior_texture().is_none()
            && self.interior.is_none()
            && self.light_group.is_none()
            && self.photons().is_none()
            && self.flags == Flags::default()
    }

    /// Whether it says nothing but what it is, and is no light.
    #[must_use]
    pub fn is_plain_part(&self) -> bool {
        self.steps.is_empty()
            && self.says_no_looks()
            && self.rare.is_none()
            && !matches!(self.kind, Kind::Light { .. })
    }

    /// How much it holds: its children as they were when it was made, and what [`Object::clip`] and [`Object::bound`]
    /// gave it.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Says `cutaway_textures`, if it is an intersection or difference as it stands; whether that is so. To an inverted
    /// union it means nothing.
    pub fn cut_away(&mut self) -> bool {
        let is_suited = matches!(&self.kind, Kind::Csg { operation, .. } if operation.is_shared(self.is_inverse));
        self.flags.cutaway_textures |= is_suited && !self.is_inverse;
        self.size.has_cutaways |= is_suited;
        is_suited
    }

    /// Exchanges inside and outside. Whatever says `cutaway_textures` says so no more, as in POV-Ray.
    pub fn invert(&mut self) {
        self.is_inverse = !self.is_inverse;
        self.flags.cutaway_textures = false;
    }

    /// The object as a solid, inverse or not, moved by more steps, without what clips it.
    pub(crate) fn as_solid(&self, is_inverse: bool, steps: &[Step]) -> Object {
        let mut solid = self.clone();
        solid.is_inverse = is_inverse;
        solid.steps.extend(steps.iter().cloned());
        if let Some(rare) = &mut solid.rare {
            rare.clipped_by.clear();
        }
        solid
    }

    /// Gives the object a `clipped_by`.
    pub fn clip(&mut self, by: Attached<Arc<Object>>) {
        self.size = self.size.with_inside(by.what.size);
        self.rare.get_or_insert_default().clipped_by.push(by);
    }

    /// Gives the object a `bounded_by`.
    pub fn bound(&mut self, by: Attached<Arc<Object>>) {
        self.size = self.size.with_inside(by.what.size);
        self.rare.get_or_insert_default().bounded_by.push(by);
    }

    /// Moves what it holds to `to`; what remains is a leaf.
    fn take_apart(&mut self, to: &mut Vec<Arc<Object>>) {
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
            // Of a list that others hold too, nothing ends here.
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

/// Objects nest as deep as a scene likes, and the stack of the dropping thread may be small.
impl Drop for Object {
    fn drop(&mut self) {
        let mut open = Vec::new();
        self.take_apart(&mut open);
        while let Some(object) = open.pop() {
            if let Ok(mut last) = Arc::try_unwrap(object) {
                last.take_apart(&mut open);
            }
        }
    }
}

impl Size {
    fn with_inside(self, inner: Size) -> Size {
        Size {
            turns: self.turns.max(inner.turns.saturating_add(1)),
            ..self.with(inner)
        }
    }

    fn with_part(self, part: &Object, is_turn: bool) -> Size {
        let turns = part.size.turns + u32::from(is_turn);
        Size {
            turns: self.turns.max(turns),
            uses_uv: self.uses_uv || part.uses_uv(),
            ..self.with(part.size)
        }
    }

    fn with(self, inner: Size) -> Size {
        Size {
            turns: self.turns,
            height: self.height.max(inner.height.saturating_add(1)),
            leaves: self.leaves.saturating_add(inner.leaves),
            has_lights: self.has_lights || inner.has_lights,
            uses_uv: self.uses_uv || inner.uses_uv,
            has_cutaways: self.has_cutaways || inner.has_cutaways,
            reaches_out: self.reaches_out || inner.reaches_out,
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
            reaches_out: false,
            turns: 0,
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
            reaches_out: false,
            turns: 1,
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
