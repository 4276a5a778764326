//! What light passes on its way: found in one search, then met one after the other without searching again.

use super::closest::BLUR;
use super::{ClosestHit, Hit, Query, Scratch};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::base::options::LeastDistance;
use crate::scene::shape::{Geometry, Root};
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::{RawHit, hide_departure};
use crate::world::model::Item;
use smallvec::SmallVec;

/// Some items of a world.
pub(in crate::world) type ItemSet = SmallVec<[IndexedItem; 8]>;

/// A surface on a ray.
#[derive(Clone, Copy, Debug)]
pub struct TransmissiveHit(RawHit);

/// Surfaces on a ray, the nearest first.
pub type TransmissiveHits = SmallVec<[TransmissiveHit; 4]>;

impl TransmissiveHit {
    /// How far along the ray it lies.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.0.root.t
    }

    /// Its number.
    #[must_use]
    pub fn surface(&self) -> u32 {
        self.0.surface
    }
}

impl World {
    /// All surfaces on the ray that was last asked about with what it meets gathered. `None` where something may matter
    /// besides which they are and how they stand there: where on a surface it is passed, or what was met before (surfaces
    /// that coincide, flat pieces).
    #[must_use]
    pub fn transmissive_hits(
        &self,
        query: &Query,
        scratch: &mut Scratch,
    ) -> Option<TransmissiveHits> {
        let among = std::mem::take(&mut scratch.among);
        let mut roots = std::mem::take(&mut scratch.roots);
        let passed = self.passed(query, (&among, &scratch.passed), &mut roots);
        scratch.among = among;
        scratch.roots = roots;
        scratch.rays.filtered += passed.as_ref().map_or(0, |passed| passed.len() as u64);
        passed
    }

    fn passed(
        &self,
        query: &Query,
        (among, of_programs): (&ItemSet, &[RawHit]),
        roots: &mut Vec<Root>,
    ) -> Option<TransmissiveHits> {
        if self.least_distance == LeastDistance::PovRay {
            return None;
        }
        let search = self.search_for(query);
        let mut passed = TransmissiveHits::new();
        for item in among {
            let number = match item.item {
                Item::Leaf(number) => number,
                Item::Program(number) => {
                    let leaves = self.model.programs[number as usize].leaves();
                    if !leaves.clone().all(|leaf| self.has_lasting_roots(leaf)) {
                        return None;
                    }
                    let own = |found: &&RawHit| leaves.contains(&found.leaf);
                    for found in of_programs.iter().filter(own) {
                        self.even_filter(found.surface)?;
                        if found.root.t <= search.origin_error {
                            return None;
                        }
                        passed.push(TransmissiveHit(*found));
                    }
                    continue;
                }
                Item::Instance(_) => return None,
            };
            let leaf = &self.model.leaves[number as usize];
            let surface = &self.surfaces[leaf.surface as usize];
            self.even_filter(leaf.surface)?;
            if !self.has_lasting_roots(number) {
                return None;
            }
            roots.clear();
            leaf.roots(&query.ray, roots);
            if let Some(left) = search.origin_surface
                && left.leaf == number
            {
                hide_departure(roots, left, leaf, query.ray.dir);
            }
            for root in roots.iter().filter(|root| root.is_visible) {
                if root.t > search.t_min && root.t < query.t_max {
                    if root.t <= search.origin_error {
                        return None;
                    }
                    if surface.is_seen(query.kind) {
                        passed.push(TransmissiveHit(RawHit {
                            root: *root,
                            leaf: number,
                            surface: leaf.surface,
                        }));
                    }
                }
            }
        }
        passed.sort_unstable_by(|a, b| a.t().total_cmp(&b.t()));
        let origin = query.ray.origin.abs().max_element();
        let coincide =
            |pair: &[TransmissiveHit]| pair[1].t() - pair[0].t() <= BLUR * (origin + pair[1].t());
        (!passed.windows(2).any(coincide)).then_some(passed)
    }

    /// Whether a ray finds the same roots of a leaf wherever along its line it starts.
    fn has_lasting_roots(&self, leaf: u32) -> bool {
        let shape = &self.model.leaves[leaf as usize].shape;
        !shape.is_faceted() && !shape.knows_departures()
    }

    /// What is known of the place where a ray passes a surface.
    #[must_use]
    pub fn hit_at(&self, ray: &Ray, passing: &TransmissiveHit) -> Hit {
        self.hit(ray, &passing.0)
    }

    /// The nearest visible surface on a part of the ray to a light that was last asked about.
    #[must_use]
    pub fn next_transmissive_hit(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.filtered += 1;
        let among = std::mem::take(&mut scratch.among);
        let mut best: Option<ClosestHit> = None;
        let mut far = query.t_max;
        let search = self.search_for(query);
        with_widest(
            #[inline(always)]
            |_| {
                for &item in &among {
                    far = self.test_item(item, (query, &search), far, &mut best, scratch);
                }
            },
        );
        scratch.among = among;
        best.map(|best| self.hit(&query.ray, &best.found))
    }
}
