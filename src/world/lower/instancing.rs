//! Instancing: unions that a scene repeats are prepared once, and placed by a matrix for each copy.
//!
//! A copy has one more matrix than an object in the world itself, so surfaces that coincide by the numbers in the file
//! may differ by a rounding. That is why small numbers of copies are split up as usual.
//!
//! Copies may have different materials. A model records the materials of its parts as *slots*; each copy has a run of
//! surfaces, one per slot, and the leaves of the model say which slot they use.

use super::flatten::Lowering;
use super::inherit::{CsgRole, Inherited, joined};
use super::model::{ModelBuilder, PendingItem};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::FaceTexture;
use crate::scene::texture::Texture;
use crate::scene::{Children, Object};
use crate::world::index::index;
use crate::world::instance::Instance;
use crate::world::model::Model;
use crate::world::surface::Surface;
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Number of primitives in all copies from which a union is shared.
const SHARED_FROM: u64 = 10_000;

/// Number of pieces that bound a copy; more would be tighter.
const HULL: usize = 32;

/// Material of a part of a shared model.
#[derive(Clone, Debug)]
pub(crate) enum MaterialSlot {
    /// The attributes of the copy.
    Whole,
    /// Those of another slot.
    Same(u32),
    /// The attributes of an object, on top of those of the slot `above`; `steps` are the transforms of its ancestors.
    Object {
        above: u32,
        object: Arc<Object>,
        steps: Arc<[Step]>,
        role: CsgRole,
    },
    /// The face textures of a shape with the transforms `steps`, on top of the slot `above`.
    Skins {
        above: u32,
        skins: Arc<[FaceTexture]>,
        steps: Arc<[Step]>,
    },
}

/// The material slots of the model that is being built.
#[derive(Debug)]
pub(crate) struct SlotTable {
    list: Vec<MaterialSlot>,
    /// First slot of each nested model, by the address of the model and the slot around it.
    nested_slots: FxHashMap<(usize, u32), u32>,
}

/// A model shared by the copies of a union.
#[derive(Debug)]
pub(crate) struct SharedModel {
    /// Keeps the address in use that serves as the key.
    _children: Children,
    model: Arc<Model>,
    slots: Vec<MaterialSlot>,
    hull: Vec<Piece>,
    /// True if copies with the same inherited attributes have the same surfaces.
    is_reusable: bool,
    /// The surfaces of the last copy.
    last: Option<CopyMaterial>,
}

/// The surfaces of a copy.
#[derive(Debug)]
struct CopyMaterial {
    root: Inherited,
    /// Index of the first surface.
    first: u32,
    /// True if all of them are opaque: then no ray enters, and interiors do not matter.
    is_opaque: bool,
}

/// A bounding volume of some parts of a model.
#[derive(Clone, Copy, Debug)]
enum Piece {
    Sphere { middle: DVec3, radius: f64 },
    Box(Bounds),
}

impl SlotTable {
    fn new() -> Self {
        SlotTable {
            list: vec![MaterialSlot::Whole],
            nested_slots: FxHashMap::default(),
        }
    }

    fn push(&mut self, slot: MaterialSlot) -> u32 {
        self.list.push(slot);
        index(self.list.len() - 1)
    }

    /// The slot of an object below `above`.
    pub(crate) fn object(&mut self, object: &Object, above: &Inherited) -> u32 {
        // Inherited visibility switches may take effect for it alone.
        let is_in_sum = matches!(above.role, CsgRole::Union | CsgRole::Merge);
        let is_hidden_there = is_in_sum && (above.flags.no_image || above.flags.no_reflection);
        if object.says_no_looks() && !is_hidden_there {
            return above.slot;
        }
        self.push(MaterialSlot::Object {
            above: above.slot,
            object: Arc::new(object.clone()),
            steps: Arc::clone(&above.steps),
            role: above.role,
        })
    }

    /// The slot of a shape.
    pub(crate) fn shape(&mut self, attributes: &Inherited, skins: &[FaceTexture]) -> u32 {
        if skins.is_empty() {
            return attributes.slot;
        }
        self.push(MaterialSlot::Skins {
            above: attributes.slot,
            skins: skins.into(),
            steps: Arc::clone(&attributes.steps),
        })
    }

    /// The first slot of a nested model.
    fn nested(&mut self, shared: &SharedModel, root: &Inherited) -> u32 {
        if shared.slots.len() == 1 {
            return root.slot;
        }
        let key = (Arc::as_ptr(&shared.model).addr(), root.slot);
        if shared.is_reusable
            && let Some(&first) = self.nested_slots.get(&key)
        {
            return first;
        }
        let first = index(self.list.len());
        for slot in &shared.slots {
            self.list.push(match slot {
                MaterialSlot::Whole => MaterialSlot::Same(root.slot),
                MaterialSlot::Same(of) => MaterialSlot::Same(first + of),
                MaterialSlot::Object {
                    above,
                    object,
                    steps,
                    role,
                } => MaterialSlot::Object {
                    above: first + above,
                    object: Arc::clone(object),
                    steps: joined(steps, &root.steps),
                    role: *role,
                },
                MaterialSlot::Skins {
                    above,
                    skins,
                    steps,
                } => MaterialSlot::Skins {
                    above: first + above,
                    skins: Arc::clone(skins),
                    steps: joined(steps, &root.steps),
                },
            });
        }
        self.nested_slots.insert(key, first);
        first
    }
}

impl MaterialSlot {
    /// Returns true if it gives the same surface for all copies with the same inherited attributes.
    fn is_reusable(&self) -> bool {
        let is_fixed = |texture: &Texture| {
            let mut layers = texture.layers().iter();
            !texture.depends_on_place()
                && layers.all(|layer| {
                    let finish = &layer.finish;
                    finish.ior.is_none() && finish.refraction.is_none() && finish.caustics.is_none()
                })
        };
        match self {
            MaterialSlot::Whole | MaterialSlot::Same(_) => true,
            MaterialSlot::Skins { .. } => false,
            MaterialSlot::Object { object, .. } => {
                object.interior.is_none()
                    && object.photons().is_none()
                    && object.light_group.is_none()
                    && object.textures().all(|own| is_fixed(&own.what))
            }
        }
    }
}

impl Lowering {
    /// Adds a copy of a repeated union as an instance, if that pays off; returns true if it did.
    pub(crate) fn add_copy(&mut self, object: &Object, below: &Inherited) -> bool {
        let Some(children) = object.shared_parts() else {
            return false;
        };
        let keeps_uv = self.keeps_uv || object.uses_uv() || below.uses_uv();
        let key = (Arc::as_ptr(children).addr(), keeps_uv);
        let Some(mut shared) = self.shared.remove(&key).or_else(|| {
            // Counted once: the number of references depends on how fast another thread drops copies that are already
            // lowered.
            let copies = *self
                .copies
                .entry(key.0)
                .or_insert(Arc::strong_count(children));
            let is_worth = copies as u64 * u64::from(object.size().leaves) >= SHARED_FROM;
            is_worth.then(|| Box::new(self.share(children, keeps_uv)))
        }) else {
            return false;
        };
        let transform = Transform::from_steps(&below.steps);
        let bounds = shared
            .hull
            .iter()
            .map(|piece| piece.transformed_bounds(&transform.world_from_object))
            .fold(Bounds::EMPTY, |sum, bounds| sum.union(&bounds));
        if !bounds.is_empty() {
            let surface = match &mut self.slots {
                Some(slots) => slots.nested(&shared, below),
                None => self.surfaces_of(&mut shared, below),
            };
            let number = index(self.parts.instances.len());
            self.parts.push(PendingItem::Instance(number), bounds);
            self.parts.instances.push(Instance {
                model: Arc::clone(&shared.model),
                object_from_world: transform.object_from_world,
                first: 0,
                surface,
            });
        }
        self.shared.insert(key, shared);
        true
    }

    /// Prepares the shared model; with `keeps_uv` its shapes retain their texture coordinates.
    fn share(&mut self, children: &Children, keeps_uv: bool) -> SharedModel {
        let keeps_uv_around = std::mem::replace(&mut self.keeps_uv, keeps_uv);
        let around = std::mem::take(&mut self.parts);
        let slots_around = self.slots.replace(SlotTable::new());
        // The copies have different transforms.
        let nothing = Inherited {
            is_moved: true,
            ..Inherited::default()
        };
        for child in &**children {
            self.add_below(child, &nothing);
        }
        self.keeps_uv = keeps_uv_around;
        let parts = std::mem::replace(&mut self.parts, around);
        let slots = std::mem::replace(&mut self.slots, slots_around);
        let slots = slots.map_or_else(Vec::new, |slots| slots.list);
        let hull = hull(&parts);
        let model = Model::new(parts, &mut Vec::new(), std::iter::empty());
        SharedModel {
            _children: Arc::clone(children),
            model: Arc::new(model),
            is_reusable: slots.iter().all(MaterialSlot::is_reusable),
            slots,
            hull,
            last: None,
        }
    }

    /// The first surface of a run, one surface per slot, for a copy with the attributes `root`.
    fn surfaces_of(&mut self, shared: &mut SharedModel, root: &Inherited) -> u32 {
        if shared.slots.len() == 1 {
            let surface = self.new_surface(root, &[]);
            return self.number_of(surface);
        }
        if let Some(last) = &shared.last
            && shared.is_reusable
            && last.root.is_same_material(root, last.is_opaque)
        {
            return last.first;
        }
        let first = index(self.surfaces.len());
        let mut attributes: Vec<Inherited> = Vec::with_capacity(shared.slots.len());
        for slot in &shared.slots {
            let moved = |above: u32, steps: &Arc<[Step]>| Inherited {
                steps: joined(steps, &root.steps),
                ..attributes[above as usize].clone()
            };
            let (own, skins) = match slot {
                MaterialSlot::Whole => (root.clone(), &[][..]),
                MaterialSlot::Same(of) => (attributes[*of as usize].clone(), &[][..]),
                MaterialSlot::Object {
                    above,
                    object,
                    steps,
                    role,
                } => {
                    let around = Inherited {
                        role: *role,
                        ..moved(*above, steps)
                    };
                    (self.inherit(object, &around), &[][..])
                }
                MaterialSlot::Skins {
                    above,
                    skins,
                    steps,
                } => (moved(*above, steps), &**skins),
            };
            let surface = self.new_surface(&own, skins);
            self.surfaces.push(surface);
            attributes.push(own);
        }
        shared.last = Some(CopyMaterial {
            root: root.clone(),
            first,
            is_opaque: self.surfaces[first as usize..]
                .iter()
                .all(Surface::is_opaque),
        });
        first
    }
}

/// Bounding pieces of a model: one per item if there are only a few.
fn hull(parts: &ModelBuilder) -> Vec<Piece> {
    let sphere = |item: &PendingItem| match item {
        PendingItem::Leaf(leaf) => parts.leaves[*leaf as usize].sphere(),
        PendingItem::Sphere(sphere) => {
            let sphere = parts.spheres.sphere(*sphere);
            Some((sphere.centre, sphere.radius))
        }
        PendingItem::Program(_) | PendingItem::Instance(_) => None,
    };
    let piece = |(item, bounds): (&PendingItem, &Bounds)| match sphere(item) {
        Some((middle, radius)) => Piece::Sphere { middle, radius },
        None => Piece::Box(*bounds),
    };
    if parts.items.len() <= HULL {
        return parts.items.iter().zip(&parts.bounds).map(piece).collect();
    }
    let each = parts.bounds.len().div_ceil(HULL);
    let sum = |bounds: &[Bounds]| {
        let sum = bounds
            .iter()
            .fold(Bounds::EMPTY, |sum, bounds| sum.union(bounds));
        Piece::Box(sum)
    };
    parts.bounds.chunks(each).map(sum).collect()
}

impl Piece {
    /// The bounds of the transformed piece.
    fn transformed_bounds(&self, to_from: &DAffine3) -> Bounds {
        match self {
            Piece::Box(bounds) => bounds.transformed(to_from),
            Piece::Sphere { middle, radius } => {
                let middle = to_from.transform_point3(*middle);
                let rows = to_from.matrix3.transpose();
                let extent = |row: DVec3| radius * row.length();
                let extent = DVec3::new(
                    extent(rows.x_axis),
                    extent(rows.y_axis),
                    extent(rows.z_axis),
                );
                Bounds {
                    min: middle - extent,
                    max: middle + extent,
                }
            }
        }
    }
}
