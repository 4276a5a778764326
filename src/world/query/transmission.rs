//! Transmissive hits along a shadow ray: collected in one traversal, then iterated without another one.

use super::closest::SKIN;
use super::{ClosestHit, QueryScratch};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::base::options::TMinRule;
use crate::scene::shape::{Geometry, Root, Shape};
use crate::world::compiled::World;
use crate::world::csg::sweep::{RawHit, hide_departure};
use crate::world::model::IndexedItem;
use crate::world::model::Item;
use crate::world::ray::BLUR;
use crate::world::ray::{Hit, Query};
use smallvec::SmallVec;

/// Greatest distance of hits at one point, relative to [`BLUR`] and the sum of the ray's origin and the distance. That is
/// at most three times the size of the point, of which [`SKIN`] is the distance of hits on the surface that a ray leaves.
const ONE_POINT: f64 = SKIN / 4.0;

/// Some items of a model.
pub(in crate::world) type ItemSet = SmallVec<[IndexedItem; 8]>;

/// A transmissive surface on a shadow ray.
#[derive(Clone, Copy, Debug)]
pub struct TransmissiveHit(RawHit);

/// Transmissive surfaces on a shadow ray, sorted by distance.
pub type TransmissiveHits = SmallVec<[TransmissiveHit; 4]>;

impl TransmissiveHit {
    /// Distance along the ray.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.0.root.t
    }

    /// Index of its surface.
    #[must_use]
    pub fn surface(&self) -> u32 {
        self.0.surface
    }
}

impl World {
    /// All transmissive hits on the last shadow ray tested, whose items were gathered. `None` where their transmittance
    /// depends on more than the sequence of surfaces: on the point of a surface, or on earlier hits (coincident
    /// surfaces, flat faces).
    #[must_use]
    pub fn transmissive_hits(
        &self,
        query: &Query,
        scratch: &mut QueryScratch,
    ) -> Option<TransmissiveHits> {
        let items = std::mem::take(&mut scratch.transmissive_items);
        let mut roots = std::mem::take(&mut scratch.roots);
        let passed = self.passed(query, &items, &scratch.passed, &mut roots);
        scratch.transmissive_items = items;
        scratch.roots = roots;
        scratch.rays.filtered += passed.as_ref().map_or(0, |passed| passed.len() as u64);
        passed
    }

    fn passed(
        &self,
        query: &Query,
        items: &ItemSet,
        program_hits: &[RawHit],
        roots: &mut Vec<Root>,
    ) -> Option<TransmissiveHits> {
        if self.least_distance == TMinRule::PovRay {
            return None;
        }
        let search = self.search_for(query);
        let origin = query.ray.origin.abs().max_element();
        let are_within =
            |share: f64, near: f64, far: f64| far - near <= share * BLUR * (origin + far);
        let mut passed = TransmissiveHits::new();
        for item in items {
            let number = match item.item {
                Item::Leaf(number) => number,
                Item::Program(number) => {
                    let leaves = self.model.programs[number as usize].leaves();
                    if !leaves.clone().all(|leaf| self.has_stable_roots(leaf)) {
                        return None;
                    }
                    let own = |hit: &&RawHit| leaves.contains(&hit.leaf);
                    let mut last = f64::NEG_INFINITY;
                    for hit in program_hits.iter().filter(own) {
                        // The surfaces shown of those that coincide depend on where the ray starts.
                        if are_within(1.0, last, hit.root.t) {
                            return None;
                        }
                        last = hit.root.t;
                        self.uniform_transmittance(hit.surface)?;
                        if hit.root.t <= search.origin_error {
                            return None;
                        }
                        passed.push(TransmissiveHit(*hit));
                    }
                    continue;
                }
                Item::Instance(_) => return None,
            };
            let leaf = &self.model.leaves[number as usize];
            let surface = &self.surfaces[leaf.surface as usize];
            self.uniform_transmittance(leaf.surface)?;
            if !self.has_stable_roots(number) {
                return None;
            }
            roots.clear();
            leaf.roots(&query.ray, roots);
            if let Some(origin) = search.origin_surface
                && origin.leaf == number
            {
                hide_departure(roots, origin, leaf, query.ray.dir);
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
        // Where objects touch, a ray that goes on from one of them is on the other.
        passed.dedup_by(|far, near| {
            are_within(ONE_POINT, near.t(), far.t())
                && near.0.leaf != far.0.leaf
                && self.transmit_alike(near.surface(), far.surface())
        });
        let coincide = |pair: &[TransmissiveHit]| are_within(1.0, pair[0].t(), pair[1].t());
        (!passed.windows(2).any(coincide)).then_some(passed)
    }

    /// Returns true if light passes two surfaces alike. With `caustics` their angles matter, and for photons the object.
    fn transmit_alike(&self, one: u32, other: u32) -> bool {
        let [a, b] = [one, other].map(|surface| &self.surfaces[surface as usize]);
        let [inside_a, inside_b] = [a, b].map(|surface| self.interiors.get(surface.interior));
        let is_target = a.photons().target.is_some() || b.photons().target.is_some();
        let fades = inside_a.fades() || inside_b.fades();
        let has_caustics = inside_a.caustics != 0.0 || inside_b.caustics != 0.0;
        self.uniform_transmittance(one) == self.uniform_transmittance(other)
            && (a.interior == b.interior || !fades)
            && !has_caustics
            && !is_target
    }

    /// Returns true if the roots of a leaf do not depend on the ray's origin along its line.
    fn has_stable_roots(&self, leaf: u32) -> bool {
        let shape = &self.model.leaves[leaf as usize].shape;
        let has_tolerance = matches!(shape, Shape::SphereSweep(sweep) if sweep.tolerance() > 0.0);
        !shape.is_faceted() && !shape.excludes_spawn_surface() && !has_tolerance
    }

    /// Shading data at a transmissive hit.
    #[must_use]
    pub fn hit_at(&self, ray: &Ray, surface_hit: &TransmissiveHit) -> Hit {
        self.hit(ray, &surface_hit.0)
    }

    /// The nearest visible surface on a segment of the last shadow ray tested.
    #[must_use]
    pub fn next_transmissive_hit(&self, query: &Query, scratch: &mut QueryScratch) -> Option<Hit> {
        scratch.rays.filtered += 1;
        let items = std::mem::take(&mut scratch.transmissive_items);
        let mut best: Option<ClosestHit> = None;
        let mut far = query.t_max;
        let search = self.search_for(query);
        with_widest(
            #[inline(always)]
            |_| {
                for &item in &items {
                    far = self.test_item(item, query, &search, far, &mut best, scratch);
                }
            },
        );
        scratch.transmissive_items = items;
        scratch.note_leaves(&[best]);
        best.map(|best| self.hit(&query.ray, &best.hit))
    }
}
