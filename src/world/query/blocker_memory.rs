//! POV-Ray's memory of the objects that blocked a light.
//!
//! A shadow ray is first tested with the object that last blocked its light. That test takes hits from
//! [`POV_RAY_T_MIN`] on and up to the light itself, where the search behind it leaves out what is within
//! [`POV_RAY_SHADOW`] of either end: so a surface close above another darkens it once it has blocked the light
//! elsewhere (docs/povray-facts.md, section 4.4). Random numbers that run on need the same shadows.

use super::QueryScratch;
use super::closest::{POV_RAY_SHADOW, POV_RAY_T_MIN};
use super::intersect::Search;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::{IndexedItem, ItemBvh};
use crate::world::ray::{Occlusion, Query};
use smallvec::SmallVec;

/// An item for each light.
type Blockers = SmallVec<[Option<IndexedItem>; 8]>;

/// For each light the opaque items that blocked it last.
#[derive(Clone, Debug, Default)]
pub struct BlockerMemory {
    /// Those of camera rays.
    first: Blockers,
    /// Those of rays behind a mirror or a refraction, and of rays that gather indirect light.
    later: Blockers,
    /// True while shadow rays leave surfaces hit by camera rays.
    is_first: bool,
}

impl BlockerMemory {
    /// The item to test first. Camera rays without one of their own take that of the others.
    fn of(&self, light: u32) -> Option<IndexedItem> {
        let later = self.later.get(light as usize).copied().flatten();
        match self.is_first {
            true => self.first.get(light as usize).copied().flatten().or(later),
            false => later,
        }
    }

    fn remember(&mut self, light: u32, item: IndexedItem) {
        let light = light as usize;
        let blockers = match self.is_first {
            true => &mut self.first,
            false => &mut self.later,
        };
        if blockers.len() <= light {
            blockers.resize(light + 1, None);
        }
        blockers[light] = Some(item);
    }
}

impl QueryScratch {
    /// The item that POV-Ray tests first for this light, if there is a memory.
    #[inline]
    pub(super) fn remembered(&self, light: u32) -> Option<IndexedItem> {
        self.memory.as_deref()?.of(light)
    }

    /// The item that blocked this light last: the remembered one, if there is a memory.
    pub(super) fn last_blocker(&self, light: u32) -> Option<IndexedItem> {
        match self.memory {
            Some(_) => self.remembered(light),
            None => self.blockers.get(light as usize).copied().flatten(),
        }
    }

    /// Notes the item that blocked this light last.
    pub(super) fn set_last_blocker(&mut self, light: u32, item: IndexedItem) {
        let light = light as usize;
        if self.blockers.len() <= light {
            self.blockers.resize(light + 1, None);
        }
        self.blockers[light] = Some(item);
    }

    /// Selects the memory of camera rays or that of all others, if there is one. Returns true if it was that of camera
    /// rays before.
    #[inline]
    pub fn set_first(&mut self, is_first: bool) -> bool {
        let memory = self.memory.as_deref_mut();
        memory.is_some_and(|memory| std::mem::replace(&mut memory.is_first, is_first))
    }
}

impl World {
    /// Occlusion of a shadow ray whose search gave `result`, as the memory changes it, if there is one.
    #[must_use]
    pub fn occlusion_after_memory(
        &self,
        result: Occlusion,
        query: &Query,
        light: u32,
        scratch: &mut QueryScratch,
    ) -> Occlusion {
        match scratch.memory.is_some() {
            true => with_widest(
                #[inline(always)]
                |lanes| self.occlusion_by_memory(lanes, query, light, Some(result), scratch),
            ),
            false => result,
        }
    }

    /// Occlusion of a shadow ray that comes after all those before it; `result` is that of the search, if it was made.
    pub(in crate::world) fn occlusion_by_memory(
        &self,
        lanes: SimdLevel,
        query: &Query,
        light: u32,
        result: Option<Occlusion>,
        scratch: &mut QueryScratch,
    ) -> Occlusion {
        if self.is_blocked_by_memory(query, light, scratch) {
            return Occlusion::Opaque;
        }
        let occlusion =
            result.unwrap_or_else(|| self.find_occlusion(lanes, query, light, None, scratch));
        if occlusion == Occlusion::Opaque
            && let Some((item, hit)) = self.first_blocker(lanes, query, scratch)
            && self.ends_light(&hit)
            && self.is_all_opaque(item.item)
            && let Some(memory) = &mut scratch.memory
        {
            memory.remember(light, item);
        }
        occlusion
    }

    /// Returns true if the object that last blocked this light blocks a ray to it.
    #[must_use]
    pub fn is_blocked_by_memory(
        &self,
        query: &Query,
        light: u32,
        scratch: &mut QueryScratch,
    ) -> bool {
        let Some(item) = scratch.remembered(light) else {
            return false;
        };
        let unit = self.globals.unit;
        let query = Query {
            t_max: query.t_max + POV_RAY_SHADOW * unit,
            ..*query
        };
        let search = Search {
            t_min: POV_RAY_T_MIN * unit,
            ..self.search_for(&query)
        };
        let mut occlusion = Occlusion::Clear;
        self.occludes(item, &query, &search, &mut occlusion, scratch)
    }

    /// The nearest item on a shadow ray, and its hit.
    fn first_blocker(
        &self,
        lanes: SimdLevel,
        query: &Query,
        scratch: &mut QueryScratch,
    ) -> Option<(IndexedItem, RawHit)> {
        let search = self.search_for(query);
        let mut first = None;
        let mut visit = |item: IndexedItem, far: f64| match self
            .intersect_item(item, query, &search, far, scratch)
        {
            Some(hit) if hit.root.t < far => {
                first = Some((item, hit));
                hit.root.t
            }
            _ => far,
        };
        let ItemBvh {
            tree,
            bounded,
            unbounded,
        } = self.bvh();
        let far = unbounded
            .iter()
            .fold(query.t_max, |far, &item| visit(item, far));
        tree.nearest_in(lanes, &query.ray, (0.0, far), |position, far| {
            visit(bounded[position as usize], far)
        });
        first
    }
}
