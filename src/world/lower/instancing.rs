//! Unions that a scene shows again and again: prepared once, and placed by a matrix for each copy.
//!
//! What is placed goes through one matrix more than what stands in the world itself, so that surfaces which coincide by
//! the numbers of the file may come apart by a rounding. That is why small numbers of copies are taken apart as ever.
//!
//! Copies may look different. A model notes which looks its parts have of their own, as *slots*; each copy has a run of
//! surfaces, one for each slot, and the leaves of the model say which of the run is theirs.

use super::flatten::{Lowering, index};
use super::inherit::{CsgRole, Inherited, joined};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::FaceTexture;
use crate::scene::texture::Texture;
use crate::scene::{Children, Object};
use crate::world::instance::Instance;
use crate::world::model::{Model, ModelBuilder, PendingItem};
use crate::world::surface::Surface;
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A union is prepared once if its copies would come to so many primitives.
const SHARED_FROM: u64 = 10_000;

/// Boxes by which the bounds of a copy are found; more would be more exact.
const HULL: usize = 32;

/// Looks that a part of a model has of its own.
#[derive(Clone, Debug)]
pub(crate) enum MaterialSlot {
    /// Those of the copy.
    Whole,
    /// Those of another slot.
    Same(u32),
    /// What an object adds to those of the slot `above`; it stands in objects that are moved by `steps`.
    Object {
        above: u32,
        object: Arc<Object>,
        steps: Arc<[Step]>,
        place: CsgRole,
    },
    /// The textures that a shape moved by `steps` has for its pieces, on that of the slot `above`.
    Skins {
        above: u32,
        skins: Arc<[FaceTexture]>,
        steps: Arc<[Step]>,
    },
}

/// The slots of the model being made.
#[derive(Debug)]
pub(crate) struct SlotTable {
    list: Vec<MaterialSlot>,
    /// Where models of the same looks stand already, by the address of the model and the slot around it.
    placed: FxHashMap<(usize, u32), u32>,
}

/// What the copies of a union share.
#[derive(Debug)]
pub(crate) struct SharedModel {
    /// Keeps the address taken by which this is found.
    _children: Children,
    model: Arc<Model>,
    slots: Vec<MaterialSlot>,
    hull: Vec<Piece>,
    /// Whether copies with the same looks around them look the same.
    looks_alike: bool,
    /// The copy before.
    last: Option<CopyMaterial>,
}

/// How a copy looks.
#[derive(Debug)]
struct CopyMaterial {
    root: Inherited,
    /// The first of its surfaces.
    first: u32,
    /// Whether all of them are opaque: no ray goes in, and no interior matters.
    is_opaque: bool,
}

/// A part of space that holds a part of a model.
#[derive(Clone, Copy, Debug)]
enum Piece {
    Ball { middle: DVec3, radius: f64 },
    Box(Bounds),
}

impl SlotTable {
    fn new() -> Self {
        SlotTable {
            list: vec![MaterialSlot::Whole],
            placed: FxHashMap::default(),
        }
    }

    fn push(&mut self, slot: MaterialSlot) -> u32 {
        self.list.push(slot);
        index(self.list.len() - 1)
    }

    /// The looks of an object in those of `above`.
    pub(crate) fn object(&mut self, object: &Object, above: &Inherited) -> u32 {
        // What it is handed down may count for it alone.
        let is_in_sum = matches!(above.place, CsgRole::Union | CsgRole::Merge);
        let is_hidden_there = is_in_sum && (above.flags.no_image || above.flags.no_reflection);
        if object.says_no_looks() && !is_hidden_there {
            return above.slot;
        }
        self.push(MaterialSlot::Object {
            above: above.slot,
            object: Arc::new(object.clone()),
            steps: Arc::clone(&above.steps),
            place: above.place,
        })
    }

    /// The looks of a shape.
    pub(crate) fn shape(&mut self, looks: &Inherited, skins: &[FaceTexture]) -> u32 {
        if skins.is_empty() {
            return looks.slot;
        }
        self.push(MaterialSlot::Skins {
            above: looks.slot,
            skins: skins.into(),
            steps: Arc::clone(&looks.steps),
        })
    }

    /// The looks of a model in a model.
    fn nested(&mut self, shared: &SharedModel, root: &Inherited) -> u32 {
        if shared.slots.len() == 1 {
            return root.slot;
        }
        let key = (Arc::as_ptr(&shared.model).addr(), root.slot);
        if shared.looks_alike
            && let Some(&first) = self.placed.get(&key)
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
                    place,
                } => MaterialSlot::Object {
                    above: first + above,
                    object: Arc::clone(object),
                    steps: joined(steps, &root.steps),
                    place: *place,
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
        self.placed.insert(key, first);
        first
    }
}

impl MaterialSlot {
    /// Whether it is the same for all copies with the same looks.
    fn looks_alike(&self) -> bool {
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
    /// Takes in a copy of a union that others are copies of too, if it is worth while; says whether it did.
    pub(crate) fn add_copy(&mut self, object: &Object, below: &Inherited) -> bool {
        let Some(children) = object.shared_parts() else {
            return false;
        };
        let keeps_uv = self.keeps_uv || object.uses_uv() || below.uses_uv();
        let key = (Arc::as_ptr(children).addr(), keeps_uv);
        let Some(mut shared) = self.shared.remove(&key).or_else(|| {
            // Counted once: when copies that have been taken in are gone is up to another thread.
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
            .map(|piece| piece.placed(&transform.world_from_object))
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

    /// Prepares what copies share, with shapes that know their texture coordinates if they may be asked for.
    fn share(&mut self, children: &Children, keeps_uv: bool) -> SharedModel {
        let keeps_uv_around = std::mem::replace(&mut self.keeps_uv, keeps_uv);
        let around = std::mem::take(&mut self.parts);
        let slots_around = self.slots.replace(SlotTable::new());
        // The copies are in different places.
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
            looks_alike: slots.iter().all(MaterialSlot::looks_alike),
            slots,
            hull,
            last: None,
        }
    }

    /// The first of a run of surfaces, one for each slot, for a copy that looks like `root`.
    fn surfaces_of(&mut self, shared: &mut SharedModel, root: &Inherited) -> u32 {
        if shared.slots.len() == 1 {
            let surface = self.new_surface(root, &[]);
            return self.number_of(surface);
        }
        if let Some(last) = &shared.last
            && shared.looks_alike
            && last.root.looks_as(root, last.is_opaque)
        {
            return last.first;
        }
        let first = index(self.surfaces.len());
        let mut looks: Vec<Inherited> = Vec::with_capacity(shared.slots.len());
        for slot in &shared.slots {
            let moved = |above: u32, steps: &Arc<[Step]>| Inherited {
                steps: joined(steps, &root.steps),
                ..looks[above as usize].clone()
            };
            let (own, skins) = match slot {
                MaterialSlot::Whole => (root.clone(), &[][..]),
                MaterialSlot::Same(of) => (looks[*of as usize].clone(), &[][..]),
                MaterialSlot::Object {
                    above,
                    object,
                    steps,
                    place,
                } => {
                    let around = Inherited {
                        place: *place,
                        ..moved(*above, steps)
                    };
                    (self.heritage(object, &around), &[][..])
                }
                MaterialSlot::Skins {
                    above,
                    skins,
                    steps,
                } => (moved(*above, steps), &**skins),
            };
            let surface = self.new_surface(&own, skins);
            self.surfaces.push(surface);
            looks.push(own);
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

/// What holds the parts of a model: one piece for each, if they are few.
fn hull(parts: &ModelBuilder) -> Vec<Piece> {
    let ball = |item: &PendingItem| match item {
        PendingItem::Leaf(leaf) => parts.leaves[*leaf as usize].ball(),
        PendingItem::Ball(ball) => {
            let ball = parts.balls.ball(*ball);
            Some((ball.centre, ball.radius))
        }
        PendingItem::Program(_) | PendingItem::Instance(_) => None,
    };
    let piece = |(item, bounds): (&PendingItem, &Bounds)| match ball(item) {
        Some((middle, radius)) => Piece::Ball { middle, radius },
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
    /// The bounds of the piece where a matrix puts it.
    fn placed(&self, to_from: &DAffine3) -> Bounds {
        match self {
            Piece::Box(bounds) => bounds.transformed(to_from),
            Piece::Ball { middle, radius } => {
                let middle = to_from.transform_point3(*middle);
                let rows = to_from.matrix3.transpose();
                let reach = |row: DVec3| radius * row.length();
                let reach = DVec3::new(reach(rows.x_axis), reach(rows.y_axis), reach(rows.z_axis));
                Bounds {
                    min: middle - reach,
                    max: middle + reach,
                }
            }
        }
    }
}
