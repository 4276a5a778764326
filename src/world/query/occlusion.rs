//! Occlusion queries: opaque and transmissive surfaces between a point and a light.

use super::QueryScratch;
use super::closest::POV_RAY_SHADOW;
use super::intersect::{HitPolicy, Search};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::options::TMinRule;
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::IndexedItem;
use crate::world::model::Item;
use crate::world::ray::BLUR;
use crate::world::ray::{Occlusion, Query};
use glam::DVec3;

/// Accepts opaque hits and records transmissive ones.
struct OcclusionQuery<'w> {
    world: &'w World,
    query: &'w Query,
    occlusion: &'w mut Occlusion,
    /// Receives the transmissive hits in the order of the search; for a CSG program these are all of its hits.
    passed: Option<&'w mut Vec<RawHit>>,
}

impl HitPolicy for OcclusionQuery<'_> {
    const ANY: bool = true;

    #[inline(always)]
    fn accepts(&mut self, hit: &RawHit) -> bool {
        let mut occlusion = Occlusion::Clear;
        let blocks = self.world.blocks_light(hit, self.query, &mut occlusion);
        if occlusion == Occlusion::Transmissive {
            *self.occlusion = occlusion;
            if let Some(passed) = &mut self.passed {
                passed.push(*hit);
            }
        }
        blocks
    }
}

impl World {
    /// Returns true if an opaque surface was hit on a shadow ray; records a transmissive one in `occlusion`.
    #[inline(always)]
    pub(in crate::world) fn blocks_light(
        &self,
        hit: &RawHit,
        query: &Query,
        occlusion: &mut Occlusion,
    ) -> bool {
        if !self.is_seen(hit, query.kind)
            || hit.root.t >= query.t_max
            || self.is_self_hit(hit, query)
        {
            return false;
        }
        let is_opaque = self.ends_light(hit);
        if !is_opaque {
            *occlusion = Occlusion::Transmissive;
        }
        is_opaque
    }

    /// Far limit of a shadow ray to a light at `centre`, short of a surface on which the light itself stands.
    ///
    /// Rounding of the coordinates, and of the transforms that brought light and surface there, blurs their contact: a
    /// thousand rotations add up to some 450 roundings. A ray that grazes the surface hits it farther away, by the
    /// inverse of the sine of its angle. So this is a bound, not a sharp decision: a surface closer to the light than
    /// 2^-40 (4096 roundings), relative to the distance or to the light's largest coordinate, casts no shadow.
    #[must_use]
    pub fn shadow_t_max(&self, centre: DVec3, distance: f64) -> f64 {
        match self.least_distance {
            TMinRule::Rounding => distance - BLUR * centre.abs().max_element().max(distance),
            TMinRule::PovRay => distance - POV_RAY_SHADOW * self.globals.unit,
        }
    }

    /// Same for four rays, from their distances and the largest of the coordinates of `centre` and the distance.
    #[must_use]
    #[inline(always)]
    pub(crate) fn shadow_t_max_x4(&self, distance: &[f64; 4], size: &[f64; 4]) -> [f64; 4] {
        let mut reach = *distance;
        for (reach, size) in reach.iter_mut().zip(size) {
            *reach -= match self.least_distance {
                TMinRule::Rounding => BLUR * size,
                TMinRule::PovRay => POV_RAY_SHADOW * self.globals.unit,
            };
        }
        reach
    }

    /// Far limit of a shadow ray, at most `query.t_max`, that ends at the object which the light is projected through;
    /// `None` where the ray misses that object, so that no light arrives.
    #[must_use]
    pub fn shadow_reach(
        &self,
        query: &Query,
        light: u32,
        scratch: &mut QueryScratch,
    ) -> Option<f64> {
        // The projector may be part of the scene, and the ray may start on its surface.
        let least = self.t_min(query);
        let wanted = |hit: &RawHit| !self.is_self_hit(hit, query);
        let leaves = &self.model.leaves;
        self.lights
            .t_max_at_projector(light, leaves, query, least, wanted, scratch)
    }

    /// Occlusion of a shadow ray to the light of this index. Transmissive items on it are gathered for
    /// [`World::next_transmissive_hit`].
    #[must_use]
    pub fn occlusion(&self, query: &Query, light: u32, scratch: &mut QueryScratch) -> Occlusion {
        scratch.rays.shadow += 1;
        self.occlusion_beyond(query, light, None, scratch)
    }

    /// Same for a ray that a bundle or stream counted and saw to pass transmissive surfaces alone.
    pub fn gather_transmissive(
        &self,
        query: &Query,
        light: u32,
        scratch: &mut QueryScratch,
    ) -> Occlusion {
        self.occlusion_beyond(query, light, Some(Occlusion::Transmissive), scratch)
    }

    /// The occlusion, as the memory of blockers changes it, if there is one.
    fn occlusion_beyond(
        &self,
        query: &Query,
        light: u32,
        known: Option<Occlusion>,
        scratch: &mut QueryScratch,
    ) -> Occlusion {
        with_widest(
            #[inline(always)]
            |lanes| match scratch.memory.is_some() {
                true => self.occlusion_by_memory(lanes, query, light, None, scratch),
                false => self.find_occlusion(lanes, query, light, known, scratch),
            },
        )
    }

    /// Searches for the occlusion. If it is known to be transmissive, only items that may be so are tested.
    #[inline(always)]
    pub(in crate::world) fn find_occlusion(
        &self,
        lanes: SimdLevel,
        query: &Query,
        number: u32,
        known: Option<Occlusion>,
        scratch: &mut QueryScratch,
    ) -> Occlusion {
        let is_free = known == Some(Occlusion::Transmissive);
        let search = self.search_for(query);
        let light = number as usize;
        // Neighbouring points are often in the shadow of the same object. With a light buffer, testing that object
        // first costs more than it saves.
        let last = scratch.blockers.get(light).copied().flatten();
        let last = last.filter(|_| !is_free && !self.has_light_buffer(number));
        // Not tested again in the traversal if it is clear of the ray.
        let mut passed = u32::MAX;
        if let Some(item) = last {
            let mut occlusion = Occlusion::Clear;
            if self.occludes(item, query, &search, &mut occlusion, scratch) {
                return Occlusion::Opaque;
            }
            // Transmissive items are gathered in the traversal.
            if occlusion == Occlusion::Clear {
                passed = item.number;
            }
        }
        let mut occlusion = Occlusion::Clear;
        scratch.transmissive_items.clear();
        scratch.passed.clear();
        for &item in &self.model.bvh.unbounded {
            if is_free && self.is_all_opaque(item.item) {
                continue;
            }
            if self.occludes_and_record(item, query, &search, &mut occlusion, scratch) {
                scratch.set_last_blocker(number, item);
                return Occlusion::Opaque;
            }
        }
        let is_blocked = self.any_between(
            lanes,
            query,
            number,
            #[inline(always)]
            |position| {
                let item = self.model.bvh.bounded[position as usize];
                if passed == item.number || is_free && self.is_all_opaque(item.item) {
                    return false;
                }
                let blocks =
                    self.occludes_and_record(item, query, &search, &mut occlusion, scratch);
                if blocks {
                    scratch.set_last_blocker(number, item);
                }
                blocks
            },
        );
        if is_blocked {
            Occlusion::Opaque
        } else {
            occlusion
        }
    }

    /// Visits the bounded items, by position, that a ray to the light of this index may hit, until `visit` returns
    /// true. Returns true if it did.
    #[inline(always)]
    fn any_between(
        &self,
        lanes: SimdLevel,
        query: &Query,
        light: u32,
        visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let span = (0.0, query.t_max);
        match self.light_buffers.of_light(light) {
            Some(buffer) => buffer.any_between(query.ray.origin, visit),
            None => self.bvh().tree.any_in(lanes, &query.ray, span, visit),
        }
    }

    /// Same as [`World::occludes`]; also gathers an item that is transmissive.
    #[inline(always)]
    fn occludes_and_record(
        &self,
        item: IndexedItem,
        query: &Query,
        search: &Search,
        occlusion: &mut Occlusion,
        scratch: &mut QueryScratch,
    ) -> bool {
        let mut of_item = Occlusion::Clear;
        let is_program = matches!(item.item, Item::Program(_));
        let mut passed = is_program.then(|| std::mem::take(&mut scratch.passed));
        let blocks =
            self.occludes_with(item, query, search, &mut of_item, passed.as_mut(), scratch);
        if let Some(passed) = passed {
            scratch.passed = passed;
        }
        if blocks {
            return true;
        }
        if of_item == Occlusion::Transmissive {
            *occlusion = Occlusion::Transmissive;
            scratch.transmissive_items.push(item);
        }
        false
    }

    /// Returns true if an item is opaque to a shadow ray; records a transmissive item in `occlusion`.
    #[inline(always)]
    pub(in crate::world) fn occludes(
        &self,
        item: IndexedItem,
        query: &Query,
        search: &Search,
        occlusion: &mut Occlusion,
        scratch: &mut QueryScratch,
    ) -> bool {
        self.occludes_with(item, query, search, occlusion, None, scratch)
    }

    /// Same; appends the transmissive hits to `passed`.
    #[inline(always)]
    fn occludes_with(
        &self,
        item: IndexedItem,
        query: &Query,
        search: &Search,
        occlusion: &mut Occlusion,
        passed: Option<&mut Vec<RawHit>>,
        scratch: &mut QueryScratch,
    ) -> bool {
        if self.is_hidden(item.item, query.kind) {
            return false;
        }
        let mut policy = OcclusionQuery {
            world: self,
            query,
            occlusion,
            passed,
        };
        let hit = self
            .model
            .first_hit(item.item, search, query.t_max, scratch, &mut policy);
        hit.is_some()
    }
}
