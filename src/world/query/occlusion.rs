//! What lies between a point and a light.

use super::closest::{BLUR, POV_RAY_SHADOW};
use super::intersect::{HitPolicy, Search};
use super::{Occlusion, Query, Scratch};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::options::LeastDistance;
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::model::Item;
use glam::DVec3;

/// Asks for a surface that lets no light through; notes those that may.
struct OcclusionQuery<'w> {
    world: &'w World,
    query: &'w Query,
    way: &'w mut Occlusion,
    /// Takes in the others in the order in which they are found, which of a combination are all of them.
    passed: Option<&'w mut Vec<RawHit>>,
}

impl HitPolicy for OcclusionQuery<'_> {
    const ANY: bool = true;

    #[inline(always)]
    fn takes(&mut self, found: &RawHit) -> bool {
        let mut way = Occlusion::Clear;
        let blocks = self.world.blocks_light(found, self.query, &mut way);
        if way == Occlusion::Transmissive {
            *self.way = way;
            if let Some(passed) = &mut self.passed {
                passed.push(*found);
            }
        }
        blocks
    }
}

impl World {
    /// Whether a surface lies opaque on a ray to a light; notes if it lies there and is not opaque.
    #[inline(always)]
    pub(in crate::world) fn blocks_light(
        &self,
        found: &RawHit,
        query: &Query,
        way: &mut Occlusion,
    ) -> bool {
        if !self.is_seen(found, query.kind)
            || found.root.t >= query.t_max
            || self.is_left(found, query)
        {
            return false;
        }
        let is_opaque = self.ends_light(found);
        if !is_opaque {
            *way = Occlusion::Transmissive;
        }
        is_opaque
    }

    /// How far a ray to a light at `centre` goes so that a surface on which the light itself stands is not met.
    ///
    /// Whether a light stands on a surface is known to the roundings of its numbers and of those of the transforms that
    /// brought both there, a thousand turns of which add up to some 450; a ray that grazes the surface meets it that much
    /// farther away as the sine of its angle is small. So this is a bound and not a sharp decision: what is nearer to the
    /// light than 2^-40, as a share of the distance or of its largest coordinate (4096 roundings), casts no shadow.
    #[must_use]
    pub fn shadow_t_max(&self, centre: DVec3, distance: f64) -> f64 {
        match self.least_distance {
            LeastDistance::Rounding => distance - BLUR * centre.abs().max_element().max(distance),
            LeastDistance::PovRay => distance - POV_RAY_SHADOW,
        }
    }

    /// The same for four rays, by their distances and the largest of the coordinates of `centre` and the distance.
    #[must_use]
    #[inline(always)]
    pub(crate) fn reach_of_four(&self, distance: &[f64; 4], size: &[f64; 4]) -> [f64; 4] {
        let mut reach = *distance;
        for (reach, size) in reach.iter_mut().zip(size) {
            *reach -= match self.least_distance {
                LeastDistance::Rounding => BLUR * size,
                LeastDistance::PovRay => POV_RAY_SHADOW,
            };
        }
        reach
    }

    /// How far things cast shadows on a ray to a light that asks up to `query.far`; `None` where no light comes along
    /// the ray, since it misses what the light is projected through.
    #[must_use]
    pub fn shadow_reach(&self, query: &Query, light: u32, scratch: &mut Scratch) -> Option<f64> {
        // The object may stand in the scene as well, and the ray leave its surface.
        let least = self.t_min(query);
        let wanted = |found: &RawHit| !self.is_left(found, query);
        let leaves = &self.model.leaves;
        self.lights
            .reach(light, leaves, (query, least), wanted, scratch)
    }

    /// What lies on a ray to the light of this number. Where that is transparent it is gathered for
    /// [`World::next_transmissive_hit`].
    #[must_use]
    pub fn way(&self, query: &Query, light: u32, scratch: &mut Scratch) -> Occlusion {
        scratch.rays.shadow += 1;
        self.occlusion_unrecorded(query, light, scratch)
    }

    /// The same of a ray that was asked about before together with others, where only answers are kept.
    pub fn occlusion_unrecorded(
        &self,
        query: &Query,
        light: u32,
        scratch: &mut Scratch,
    ) -> Occlusion {
        with_widest(
            #[inline(always)]
            |lanes| self.way_found(lanes, query, light, scratch),
        )
    }

    #[inline(always)]
    pub(in crate::world) fn way_found(
        &self,
        lanes: SimdLevel,
        query: &Query,
        number: u32,
        scratch: &mut Scratch,
    ) -> Occlusion {
        let search = self.search_for(query);
        let asked = (query, &search);
        let light = number as usize;
        if scratch.blockers.len() <= light {
            scratch.blockers.resize(light + 1, None);
        }
        // Neighbouring points are often in the shadow of the same object. Where it is known what lies around a lamp, to try it
        // first costs more than it saves.
        let last = scratch.blockers[light].filter(|_| !self.knows_around(number));
        // It need not be asked again if it is known not to lie there.
        let mut passed = u32::MAX;
        if let Some(item) = last {
            let mut way = Occlusion::Clear;
            if self.occludes(item, asked, &mut way, scratch) {
                return Occlusion::Opaque;
            }
            // What lets light through is gathered later on.
            if way == Occlusion::Clear {
                passed = item.number;
            }
        }
        let mut way = Occlusion::Clear;
        scratch.among.clear();
        scratch.passed.clear();
        for &item in &self.model.finder.unbounded {
            if self.occludes_and_record(item, asked, &mut way, scratch) {
                scratch.blockers[light] = Some(item);
                return Occlusion::Opaque;
            }
        }
        let is_blocked = self.any_between(
            lanes,
            query,
            number,
            #[inline(always)]
            |place| {
                let item = self.model.finder.bounded[place as usize];
                if passed == item.number {
                    return false;
                }
                let blocks = self.occludes_and_record(item, asked, &mut way, scratch);
                if blocks {
                    scratch.blockers[light] = Some(item);
                }
                blocks
            },
        );
        if is_blocked { Occlusion::Opaque } else { way }
    }

    /// Visits bounded items, by their place, that a ray to the light of this number may meet until `visit` says to stop.
    /// Says whether it did.
    #[inline(always)]
    fn any_between(
        &self,
        lanes: SimdLevel,
        query: &Query,
        light: u32,
        visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let span = (0.0, query.t_max);
        match self.vistas.of_light(light) {
            Some(vista) => vista.between(query.ray.origin, visit),
            None => self.finder().tree.any_in(lanes, &query.ray, span, visit),
        }
    }

    /// As [`World::occludes`]; an item that lies there and is not opaque is gathered.
    #[inline(always)]
    fn occludes_and_record(
        &self,
        item: IndexedItem,
        asked: (&Query, &Search),
        way: &mut Occlusion,
        scratch: &mut Scratch,
    ) -> bool {
        let mut of_item = Occlusion::Clear;
        let is_program = matches!(item.item, Item::Program(_));
        let mut passed = is_program.then(|| std::mem::take(&mut scratch.passed));
        let noted = (&mut of_item, passed.as_mut());
        let blocks = self.blocks_noting(item, asked, noted, scratch);
        if let Some(passed) = passed {
            scratch.passed = passed;
        }
        if blocks {
            return true;
        }
        if of_item == Occlusion::Transmissive {
            *way = Occlusion::Transmissive;
            scratch.among.push(item);
        }
        false
    }

    /// Whether an item lies opaque on a ray to a light; notes if it lies there and is not opaque.
    #[inline(always)]
    pub(in crate::world) fn occludes(
        &self,
        item: IndexedItem,
        asked: (&Query, &Search),
        way: &mut Occlusion,
        scratch: &mut Scratch,
    ) -> bool {
        self.blocks_noting(item, asked, (way, None), scratch)
    }

    /// The same; surfaces that may let light through are noted.
    #[inline(always)]
    fn blocks_noting(
        &self,
        item: IndexedItem,
        (query, search): (&Query, &Search),
        (way, passed): (&mut Occlusion, Option<&mut Vec<RawHit>>),
        scratch: &mut Scratch,
    ) -> bool {
        if self.is_hidden(item.item, query.kind) {
            return false;
        }
        let mut wants = OcclusionQuery {
            world: self,
            query,
            way,
            passed,
        };
        let found = self
            .model
            .find(item.item, search, query.t_max, scratch, &mut wants);
        found.is_some()
    }
}
