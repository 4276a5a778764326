//! Instancing: unions that a scene repeats are prepared once, and placed by a matrix for each copy.
//!
//! A copy has one more matrix than an object in the world itself, so surfaces that coincide by the numbers in the file
//! may differ by a rounding. That is why small numbers of copies are split up as usual.
//!
//! Copies may have different materials. A model records the materials of its parts as *slots*; each copy has a run of
//! surfaces, one per slot, and the leaves of the model say which slot they use.

use super::lowering::Lowering;
use super::parts::inherited::{Inherited, joined};
use super::parts::model::PendingItem;
use super::parts::slots::{CopyMaterial, MaterialSlot, SharedModel, SlotTable, hull};
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::{Children, Object};
use crate::world::index::index;
use crate::world::model::{Instance, Model};
use crate::world::surface::Surface;
use std::sync::Arc;

/// Number of primitives in all copies from which a union is shared.
const SHARED_FROM: u64 = 10_000;

impl Lowering {
    /// Adds a copy of a repeated union as an instance, if that pays off; returns true if it did.
    pub(crate) fn add_copy(&mut self, object: &Object, below: &Inherited) -> bool {
        let Some(children) = object.shared_parts() else {
            return false;
        };
        // Parts without attributes, which have no slot, change the interior too.
        if match &self.slots {
            Some(slots) => slots.has_interior_finish(below.slot),
            None => below.has_interior_finish(),
        } {
            return false;
        }
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
        let mut model = Model::new(parts, &mut Vec::new(), std::iter::empty());
        model.rounding.normalization = Normalization::of_version(self.settings.is_3_8);
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
            && last.root.is_same_material(root, last.hides_interiors)
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
            hides_interiors: self.surfaces[first as usize..]
                .iter()
                .all(Surface::hides_interior),
        });
        first
    }
}
