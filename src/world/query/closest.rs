//! The nearest surface on a ray, and what is known of the place where it is met.

use super::intersect::{HitPolicy, IndexBase, Search};
use super::packet::hits::HitPacket4;
use super::packet::rays::RayStream;
use super::{ClosestHit, Hit, Query, RayKind, Scratch, SpawnSurface};
use crate::base::accel::{NewEnds, STREAM};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use crate::base::options::LeastDistance;
use crate::scene::shape::Root;
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;

/// How far along a ray, as a share of the coordinates' size, a surface may be met on which the ray starts but for
/// rounding: 4096 roundings of a double.
pub(in crate::world) const BLUR: f64 = 1.0 / (1u64 << 40) as f64;
/// How far across itself such a surface may be off the start of the ray, as a share of [`BLUR`]: 256 roundings of the
/// coordinates, which covers a chain of transforms.
pub(in crate::world) const SKIN: f64 = 1.0 / 16.0;
/// POV-Ray's least distances, in units of the scene: for shadows and for all other rays.
pub(in crate::world) const POV_RAY_SHADOW: f64 = 1e-3;
const POV_RAY_LEAST: f64 = 1e-4;

/// Least cosine between the directions of coherent rays.
const COHERENT: f64 = 0.98;

/// Asks for the first surface that can be seen.
struct ClosestQuery<'w> {
    world: &'w World,
    query: &'w Query,
}

impl HitPolicy for ClosestQuery<'_> {
    const ANY: bool = false;

    #[inline(always)]
    fn takes(&mut self, found: &RawHit) -> bool {
        self.world.is_seen(found, self.query.kind) && !self.world.is_left(found, self.query)
    }
}

impl World {
    /// The nearest visible surface on a ray.
    #[must_use]
    pub fn nearest(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.count(query);
        let best = with_widest(
            #[inline(always)]
            |lanes| self.nearest_found(lanes, query, scratch),
        );
        best.map(|best| self.hit(&query.ray, &best.found))
    }

    /// The same for up to eight rays, which need have nothing in common.
    pub fn nearest_of_stream<'q>(
        &self,
        count: usize,
        query: impl Fn(usize) -> &'q Query,
        hits: &mut [HitPacket4],
        scratch: &mut Scratch,
    ) {
        let count = count.min(STREAM);
        let first = query(0);
        let sees_alike = |ray: usize| !self.overview.hides_some || query(ray).kind == first.kind;
        let is_coherent = |ray: usize| query(ray).ray.dir.dot(first.ray.dir) > COHERENT;
        let walks_together = self.streams || (1..count).all(is_coherent);
        if !(self.asks_in_fours || walks_together) || !(1..count).all(sees_alike) {
            for (four, hits) in hits.iter_mut().enumerate().take(count.div_ceil(4)) {
                let queries = (4 * four..count.min(4 * four + 4)).map(&query);
                self.nearest_of_four(queries, hits, scratch);
            }
            return;
        }
        // Lanes past the last ray repeat it.
        let query = |ray: usize| *query(ray.min(count - 1));
        let asked = (&query, first.kind, 0xff >> (8 - count));
        let mut bests = [None; STREAM];
        let mut lot = std::mem::take(&mut scratch.lot);
        with_widest(
            #[inline(always)]
            |lanes| {
                let mut origins = [[[0.0; 4]; 3]; STREAM / 4];
                for ray in 0..count {
                    let query = query(ray);
                    scratch.rays.count(&query);
                    hits[ray / 4].aim(ray % 4, query.ray.dir);
                    for (axis, origin) in origins[ray / 4].iter_mut().enumerate() {
                        origin[ray % 4] = query.ray.origin[axis];
                    }
                }
                lot.follow(count, query, |query| self.t_min(query));
                self.intersect_unbounded(lanes, asked, (&mut lot, &mut bests), scratch);
                if walks_together {
                    self.closest_hits_stream(lanes, asked, (&mut lot, &mut bests), scratch);
                } else {
                    for (ray, best) in bests.iter_mut().enumerate().take(count) {
                        let query = &query(ray);
                        let asked = (query, &self.search_for(query));
                        self.nearest_in_tree(lanes, asked, best, scratch);
                    }
                }
                for ((origin, bests), hits) in origins.iter().zip(bests.chunks(4)).zip(hits) {
                    self.note_hits(lanes, origin, bests, hits);
                }
            },
        );
        scratch.lot = lot;
    }

    /// The same for up to four rays, one after the other.
    fn nearest_of_four<'q>(
        &self,
        queries: impl Iterator<Item = &'q Query>,
        hits: &mut HitPacket4,
        scratch: &mut Scratch,
    ) {
        let mut bests = [None; 4];
        let mut origin = [[0.0; 4]; 3];
        with_widest(
            #[inline(always)]
            |lanes| {
                for (lane, query) in queries.enumerate().take(4) {
                    scratch.rays.count(query);
                    bests[lane] = self.nearest_found(lanes, query, scratch);
                    hits.aim(lane, query.ray.dir);
                    for (axis, origin) in origin.iter_mut().enumerate() {
                        origin[lane] = query.ray.origin[axis];
                    }
                }
                self.note_hits(lanes, &origin, &bests, hits);
            },
        );
    }

    /// Intersects the marked rays of a stream, all of one kind, with the unbounded items.
    #[inline(always)]
    fn intersect_unbounded(
        &self,
        lanes: SimdLevel,
        (query, seen, rays): (&impl Fn(usize) -> Query, RayKind, u32),
        (lot, bests): (&mut RayStream, &mut [Option<ClosestHit>]),
        scratch: &mut Scratch,
    ) {
        for &item in &self.finder().unbounded {
            let asked = ((item, seen), (0, rays), query);
            self.see_by(lanes, asked, (lot, bests), &mut NewEnds::default(), scratch);
        }
    }

    /// Intersects them with the items of the tree in one traversal.
    #[inline(always)]
    fn closest_hits_stream(
        &self,
        lanes: SimdLevel,
        (query, seen, rays): (&impl Fn(usize) -> Query, RayKind, u32),
        (lot, bests): (&mut RayStream, &mut [Option<ClosestHit>]),
        scratch: &mut Scratch,
    ) {
        let ends = lot.ends();
        self.finder().tree.stream(
            lanes,
            rays,
            #[inline(always)]
            |lane| (query(lane).ray, ends[lane]),
            #[inline(always)]
            |number, rays, ended| {
                let item = self.finder().bounded[number as usize];
                let asked = ((item, seen), (0, rays), query);
                self.see_by(lanes, asked, (&mut *lot, &mut *bests), ended, scratch);
            },
        );
    }

    #[inline(always)]
    pub(in crate::world) fn nearest_found(
        &self,
        lanes: SimdLevel,
        query: &Query,
        scratch: &mut Scratch,
    ) -> Option<ClosestHit> {
        let mut best: Option<ClosestHit> = None;
        let mut far = query.t_max;
        let search = self.search_for(query);
        for &item in &self.finder().unbounded {
            far = self.test_item(item, (query, &search), far, &mut best, scratch);
        }
        self.nearest_in_tree(lanes, (query, &search), &mut best, scratch);
        best
    }

    /// Replaces the closest hit so far by a closer one in the tree, if there is one.
    #[inline(always)]
    fn nearest_in_tree(
        &self,
        lanes: SimdLevel,
        (query, search): (&Query, &Search),
        best: &mut Option<ClosestHit>,
        scratch: &mut Scratch,
    ) {
        let far = best.map_or(query.t_max, |best| best.found.root.t);
        self.finder().tree.nearest_in(
            lanes,
            &query.ray,
            (0.0, far),
            #[inline(always)]
            |number, far| {
                let item = self.finder().bounded[number as usize];
                self.test_item(item, (query, search), far, best, scratch)
            },
        );
    }

    /// Tries one item; gives the new far limit.
    #[inline(always)]
    pub(in crate::world) fn test_item(
        &self,
        item: IndexedItem,
        (query, search): (&Query, &Search),
        far: f64,
        best: &mut Option<ClosestHit>,
        scratch: &mut Scratch,
    ) -> f64 {
        match self.intersect_item(item, (query, search), far, scratch) {
            None => far,
            Some(found) => self.accept_if_closer(item.number, found, query, far, best),
        }
    }

    /// The first visible surface of one item up to and including `far`.
    #[inline(always)]
    pub(in crate::world) fn intersect_item(
        &self,
        item: IndexedItem,
        (query, search): (&Query, &Search),
        far: f64,
        scratch: &mut Scratch,
    ) -> Option<RawHit> {
        if self.is_hidden(item.item, query.kind) {
            return None;
        }
        let mut wants = ClosestQuery { world: self, query };
        self.model.find(item.item, search, far, scratch, &mut wants)
    }

    /// Takes what was found of an item if it is the best so far; gives the new far limit.
    #[inline(always)]
    pub(in crate::world) fn accept_if_closer(
        &self,
        item: u32,
        found: RawHit,
        query: &Query,
        far: f64,
        best: &mut Option<ClosestHit>,
    ) -> f64 {
        if found.root.t >= query.t_max {
            return far;
        }
        let is_better = match best {
            None => true,
            Some(best) => {
                found.root.t < best.found.root.t
                    || (found.root.t == best.found.root.t
                        && self.comes_first(item, best.item, &query.ray))
            }
        };
        if !is_better {
            return far;
        }
        *best = Some(ClosestHit { found, item });
        found.root.t
    }

    /// The distance up to which surfaces are not met: the error of the point that the ray leaves.
    pub(in crate::world) fn t_min(&self, query: &Query) -> f64 {
        self.least_from(query.origin_surface.map(|left| left.blur), query.kind)
    }

    /// The same for a ray that leaves a point of such a blur, if it leaves any.
    #[inline(always)]
    pub(in crate::world) fn least_from(&self, blur: Option<f64>, seen: RayKind) -> f64 {
        match (self.least_distance, seen) {
            // How far samples reach depends on what is nearest to them, and the picture on how far they reach.
            (_, RayKind::Radiosity) => POV_RAY_LEAST,
            (LeastDistance::Rounding, _) => blur.map_or(0.0, |blur| SKIN * blur),
            (LeastDistance::PovRay, RayKind::Shadow) => POV_RAY_SHADOW,
            (LeastDistance::PovRay, _) => POV_RAY_LEAST,
        }
    }

    /// Whether a ray starts on the surface that was found, but for rounding: one that coincides with the surface it left.
    #[inline(always)]
    pub(in crate::world) fn is_left(&self, found: &RawHit, query: &Query) -> bool {
        match query.origin_surface {
            Some(left) if found.root.t <= left.blur => {
                self.is_within_rounding(found, query, left.blur)
            }
            _ => false,
        }
    }

    #[cold]
    fn is_within_rounding(&self, found: &RawHit, query: &Query, blur: f64) -> bool {
        if self.least_distance == LeastDistance::PovRay {
            return false;
        }
        let Root { t, face, .. } = found.root;
        let (normal, _) = self.model.normals(found.leaf, query.ray.at(t), face);
        t * normal.dot(query.ray.dir).abs() <= SKIN * blur
    }

    /// A query as the model sees it.
    #[inline(always)]
    pub(in crate::world) fn search_for<'q>(&self, query: &'q Query) -> Search<'q> {
        Search {
            ray: &query.ray,
            origin_surface: query.origin_surface.as_ref(),
            t_min: self.t_min(query),
            origin_error: query.origin_surface.map_or(0.0, |left| left.blur),
            start: IndexBase::default(),
            exited_leaf: self
                .model
                .exited_convex(query.origin_surface.as_ref(), &query.ray),
        }
    }

    /// Which of two items at exactly the same distance is drawn: unbounded ones come first, then the one whose box
    /// the ray enters first, then the one that stands first in the file (facts 11.2).
    #[cold]
    fn comes_first(&self, a: u32, b: u32, ray: &Ray) -> bool {
        if self.ties_by_box {
            let entry = |item: u32| {
                let bounds = &self.boxes[item as usize].bounds();
                if bounds.is_finite() {
                    slab_entry(bounds, ray)
                } else {
                    f64::NEG_INFINITY
                }
            };
            let (entry_a, entry_b) = (entry(a), entry(b));
            if entry_a != entry_b {
                return entry_a < entry_b;
            }
        }
        a < b
    }

    #[inline]
    pub(in crate::world) fn hit(&self, ray: &Ray, found: &RawHit) -> Hit {
        let Root {
            t, face, crossing, ..
        } = found.root;
        let point = ray.at(t);
        let (normal, shading_normal) = self.model.normals(found.leaf, point, face);
        let blur = BLUR * point.abs().max_element().max(t);
        let departure = SpawnSurface {
            leaf: found.leaf,
            face,
            normal,
            crossing,
            blur,
        };
        Hit {
            t,
            point,
            shading_normal,
            surface: found.surface,
            departure,
        }
    }
}

/// Where the line of a ray enters a box, not clamped at its start.
fn slab_entry(bounds: &Bounds, ray: &Ray) -> f64 {
    (0..3).fold(f64::NEG_INFINITY, |entry, axis| {
        let d = ray.dir[axis];
        if d == 0.0 {
            return entry;
        }
        let near = if d > 0.0 {
            bounds.min[axis]
        } else {
            bounds.max[axis]
        };
        entry.max((near - ray.origin[axis]) / d)
    })
}
