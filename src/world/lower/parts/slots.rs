//! Models that instances share, and the slots of their materials.

use super::inherited::{CsgRole, Inherited, joined};
use super::model::{ModelBuilder, PendingItem};
use crate::base::math::{Bounds, Step};
use crate::scene::shape::FaceTexture;
use crate::scene::texture::Texture;
use crate::scene::{Children, Object};
use crate::world::index::index;
use crate::world::model::Model;
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

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
    pub(crate) list: Vec<MaterialSlot>,
    /// First slot of each nested model, by the address of the model and the slot around it.
    pub(crate) nested_slots: FxHashMap<(usize, u32), u32>,
}

/// A model shared by the copies of a union.
#[derive(Debug)]
pub(crate) struct SharedModel {
    /// Keeps the address in use that serves as the key.
    pub(crate) _children: Children,
    pub(crate) model: Arc<Model>,
    pub(crate) slots: Vec<MaterialSlot>,
    pub(crate) hull: Vec<Piece>,
    /// True if copies with the same inherited attributes have the same surfaces.
    pub(crate) is_reusable: bool,
    /// The surfaces of the last copy.
    pub(crate) last: Option<CopyMaterial>,
}

/// The surfaces of a copy.
#[derive(Debug)]
pub(crate) struct CopyMaterial {
    pub(crate) root: Inherited,
    /// Index of the first surface.
    pub(crate) first: u32,
    /// True if the interiors of all of them are hidden.
    pub(crate) hides_interiors: bool,
}

/// A bounding volume of some parts of a model.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Piece {
    Sphere { middle: DVec3, radius: f64 },
    Box(Bounds),
}

impl SlotTable {
    pub(crate) fn new() -> Self {
        SlotTable {
            list: vec![MaterialSlot::Whole],
            nested_slots: FxHashMap::default(),
        }
    }

    pub(crate) fn push(&mut self, slot: MaterialSlot) -> u32 {
        self.list.push(slot);
        index(self.list.len() - 1)
    }

    /// The slot of an object below `above`.
    pub(crate) fn object(&mut self, object: &Object, above: &Inherited) -> u32 {
        // Inherited visibility switches may take effect for it alone.
        let is_in_sum = matches!(above.role, CsgRole::Union | CsgRole::Merge);
        let is_hidden_there = is_in_sum && (above.flags.no_image || above.flags.no_reflection);
        if object.has_no_attributes() && !is_hidden_there && !self.has_interior_finish(above.slot) {
            return above.slot;
        }
        self.push(MaterialSlot::Object {
            above: above.slot,
            object: Arc::new(object.clone()),
            steps: Arc::clone(&above.steps),
            role: above.role,
        })
    }

    /// Returns true if the texture of a slot is known to have a finish that changes the interior.
    pub(crate) fn has_interior_finish(&self, slot: u32) -> bool {
        match &self.list[slot as usize] {
            MaterialSlot::Whole => false,
            MaterialSlot::Same(of) => self.has_interior_finish(*of),
            MaterialSlot::Skins { above, .. } => self.has_interior_finish(*above),
            MaterialSlot::Object { above, object, .. } => match &object.texture {
                Some(own) => own.what.has_interior_finish(),
                None => self.has_interior_finish(*above),
            },
        }
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
    pub(crate) fn nested(&mut self, shared: &SharedModel, root: &Inherited) -> u32 {
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
    pub(crate) fn is_reusable(&self) -> bool {
        let is_fixed =
            |texture: &Texture| !texture.depends_on_position() && !texture.has_interior_finish();
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

/// Bounding pieces of a model: one per item if there are only a few.
pub(crate) fn hull(parts: &ModelBuilder) -> Vec<Piece> {
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
    pub(crate) fn transformed_bounds(&self, to_from: &DAffine3) -> Bounds {
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

/// Number of pieces that bound a copy; more would be tighter.
pub(crate) const HULL: usize = 32;
