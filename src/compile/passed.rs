//! What light passes on its way: found in one search, then met one after the other without searching again.

use super::csg::hide_departure;
use super::model::Item;
use super::order::Numbered;
use super::query::{Best, Hit, Query, Scratch};
use super::search::BLUR;
use super::world::World;
use crate::math::lanes::with_widest;
use crate::options::LeastDistance;
use crate::shape::{Geometry, Root};
use smallvec::SmallVec;

/// Some items of a world.
pub(super) type Items = SmallVec<[Numbered; 8]>;

/// Surfaces on a ray: how far along it, and their numbers.
pub type Passed = SmallVec<[(f64, u32); 8]>;

impl World {
    /// All surfaces on the ray that was last asked about with what it meets gathered: their numbers, the nearest first.
    /// `None` where something may matter besides which they are: where on a surface it is passed, or what was met before
    /// (surfaces that coincide, combinations, flat pieces).
    #[must_use]
    pub fn all_among(&self, query: &Query, scratch: &mut Scratch) -> Option<Passed> {
        let among = std::mem::take(&mut scratch.among);
        let mut roots = std::mem::take(&mut scratch.roots);
        let passed = self.passed(query, &among, &mut roots);
        scratch.among = among;
        scratch.roots = roots;
        scratch.rays.filtered += passed.as_ref().map_or(0, |passed| passed.len() as u64);
        passed
    }

    fn passed(&self, query: &Query, among: &Items, roots: &mut Vec<Root>) -> Option<Passed> {
        if self.least_distance == LeastDistance::PovRay {
            return None;
        }
        let search = self.search_for(query);
        let mut passed = Passed::new();
        for item in among {
            let Item::Leaf(number) = item.item else {
                return None;
            };
            let leaf = &self.model.leaves[number as usize];
            let surface = &self.surfaces[leaf.surface as usize];
            if leaf.shape.is_faceted()
                || leaf.shape.knows_departures()
                || self.even_filter(leaf.surface).is_none()
                || self.interiors.get(surface.interior).caustics != 0.0
            {
                return None;
            }
            roots.clear();
            leaf.roots(&query.ray, roots);
            if let Some(left) = search.from
                && left.leaf == number
            {
                hide_departure(roots, left, leaf, query.ray.dir);
            }
            for root in roots.iter().filter(|root| root.is_visible) {
                if root.t > search.least && root.t < query.far {
                    if root.t <= search.blur {
                        return None;
                    }
                    if surface.is_seen(query.seen) {
                        passed.push((root.t, leaf.surface));
                    }
                }
            }
        }
        passed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let origin = query.ray.origin.abs().max_element();
        let coincide = |pair: &[(f64, u32)]| pair[1].0 - pair[0].0 <= BLUR * (origin + pair[1].0);
        (!passed.windows(2).any(coincide)).then_some(passed)
    }

    /// The nearest visible surface on a part of the ray to a light that was last asked about.
    #[must_use]
    pub fn nearest_among(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.filtered += 1;
        let among = std::mem::take(&mut scratch.among);
        let mut best: Option<Best> = None;
        let mut far = query.far;
        let search = self.search_for(query);
        with_widest(
            #[inline(always)]
            |_| {
                for &item in &among {
                    far = self.try_item(item, (query, &search), far, &mut best, scratch);
                }
            },
        );
        scratch.among = among;
        best.map(|best| self.hit(&query.ray, &best.found))
    }
}
