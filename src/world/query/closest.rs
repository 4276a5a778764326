//! Closest-hit queries: the nearest visible surface on a ray, and error bounds at the ray's origin.

use super::intersect::{HitPolicy, IndexBase, Search};
use super::packet::bundle::ItemRays;
use super::packet::hits::HitPacket4;
use super::packet::rays::RayStream;
use super::ties::{behind, tie_slack};
use super::{ClosestHit, QueryScratch, Tie};
use crate::base::accel::{MAX_STREAM_RAYS, NewEnds};
use crate::base::math::Ray;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::options::TMinRule;
use crate::scene::shape::{Root, Rounded, RoundedHit, Shape};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::{IndexedItem, Model};
use crate::world::ray::{BLUR, Hit, Query, RayKind, SpawnSurface};

/// Distance across such a surface, relative to [`BLUR`], within which a hit counts as one on the surface that the ray
/// starts on: 256 roundings of the coordinates, which covers a chain of transforms.
pub(in crate::world) const SKIN: f64 = 1.0 / 16.0;
/// POV-Ray's minimum hit distances, in scene units: for shadow rays and for all other rays.
pub(in crate::world) const POV_RAY_SHADOW: f64 = 1e-3;
pub(in crate::world) const POV_RAY_T_MIN: f64 = 1e-4;
/// POV-Ray's minimum hit distance of blobs, in scene units.
const POV_RAY_BLOB: f64 = 1e-2;
/// POV-Ray's maximum hit distance, in scene units.
pub(in crate::world) const POV_RAY_T_MAX: f64 = 1e7;

/// Least cosine between the directions of coherent rays.
const COHERENT: f64 = 0.98;
/// POV-Ray's distance of a hit is not taken if it or the normal is farther than this from the exact one: its formulas
/// lose digits where shapes are small for their distance.
struct Loss {
    /// Errors of the point.
    rounding: f64,
    normal: f64,
}

const LOSS: Loss = Loss {
    rounding: 65536.0,
    normal: 1e-9,
};

/// Planes of meshes are stored in single precision.
const LOSS_OF_MESHES: Loss = Loss {
    rounding: 262_144.0,
    normal: 1e-6,
};

/// Photons of far lights hit where few digits are left, and go on from there in POV-Ray.
const LOSS_OF_PHOTONS: Loss = Loss {
    rounding: f64::INFINITY,
    normal: 0.1,
};

/// Accepts the first hit that the query's kind of ray sees.
struct ClosestQuery<'w> {
    world: &'w World,
    query: &'w Query,
}

impl HitPolicy for ClosestQuery<'_> {
    const ANY: bool = false;

    #[inline(always)]
    fn accepts(&mut self, hit: &RawHit) -> bool {
        self.world.is_seen(hit, self.query.kind) && !self.world.is_self_hit(hit, self.query)
    }
}

/// Rays of one kind in a stream.
struct StreamRays<'a, Q> {
    /// The query of each ray, by index.
    query: &'a Q,
    kind: RayKind,
    /// Mask of the active rays.
    active: u32,
}

impl<'a, Q> StreamRays<'a, Q> {
    /// The active ones of these rays, and an item to intersect them with.
    #[inline(always)]
    fn for_item(&self, item: IndexedItem, active: u32) -> ItemRays<'a, Q> {
        ItemRays {
            item,
            kind: self.kind,
            first: 0,
            active,
            query: self.query,
        }
    }
}

impl World {
    /// The nearest visible surface on a ray.
    #[must_use]
    pub fn nearest(&self, query: &Query, scratch: &mut QueryScratch) -> Option<Hit> {
        scratch.rays.count(query);
        let best = with_widest(
            #[inline(always)]
            |lanes| self.closest_hit(lanes, query, scratch),
        );
        scratch.note_leaves(&[best]);
        best.filter(|best| !self.is_too_far(&best.hit))
            .map(|best| self.hit(&query.ray, &best.hit))
    }

    /// Closest hits of a stream of up to eight rays, which need not be coherent.
    pub fn nearest_of_stream<'q>(
        &self,
        count: usize,
        query: impl Fn(usize) -> &'q Query,
        hits: &mut [HitPacket4],
        scratch: &mut QueryScratch,
    ) {
        let count = count.min(MAX_STREAM_RAYS);
        let first = query(0);
        let sees_same = |ray: usize| !self.summary.hides_some || query(ray).kind == first.kind;
        let is_coherent = |ray: usize| query(ray).ray.dir.dot(first.ray.dir) > COHERENT;
        let uses_stream = self.streams || (1..count).all(is_coherent);
        let is_alone = count < 2;
        if is_alone || !(self.uses_packets || uses_stream) || !(1..count).all(sees_same) {
            for (packet, hits) in hits.iter_mut().enumerate().take(count.div_ceil(4)) {
                let queries = (4 * packet..count.min(4 * packet + 4)).map(&query);
                self.nearest_of_packet4(queries, hits, scratch);
            }
            return;
        }
        // Lanes past the last ray repeat it.
        let query = |ray: usize| *query(ray.min(count - 1));
        let rays = StreamRays {
            query: &query,
            kind: first.kind,
            active: 0xff >> (8 - count),
        };
        let mut bests = [None; MAX_STREAM_RAYS];
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        with_widest(
            #[inline(always)]
            |lanes| {
                let mut origins = [[[0.0; 4]; 3]; MAX_STREAM_RAYS / 4];
                for ray in 0..count {
                    let query = query(ray);
                    scratch.rays.count(&query);
                    hits[ray / 4].aim(ray % 4, query.ray.dir);
                    for (axis, origin) in origins[ray / 4].iter_mut().enumerate() {
                        origin[ray % 4] = query.ray.origin[axis];
                    }
                }
                stream.load_rays(count, query, |query| self.t_min(query));
                self.intersect_unbounded(lanes, &rays, &mut stream, &mut bests, scratch);
                if uses_stream {
                    self.closest_hits_stream(lanes, &rays, &mut stream, &mut bests, scratch);
                } else {
                    for (ray, best) in bests.iter_mut().enumerate().take(count) {
                        let query = &query(ray);
                        let search = &self.search_for(query);
                        self.nearest_in_tree(lanes, query, search, best, scratch);
                    }
                }
                scratch.note_leaves(&bests);
                for ((origin, bests), hits) in origins.iter().zip(bests.chunks(4)).zip(hits) {
                    self.note_hits(lanes, origin, bests, hits);
                }
            },
        );
        scratch.ray_stream = stream;
    }

    /// Closest hits of up to four rays, one after the other.
    fn nearest_of_packet4<'q>(
        &self,
        queries: impl Iterator<Item = &'q Query>,
        hits: &mut HitPacket4,
        scratch: &mut QueryScratch,
    ) {
        let mut bests = [None; 4];
        let mut origin = [[0.0; 4]; 3];
        with_widest(
            #[inline(always)]
            |lanes| {
                for (lane, query) in queries.enumerate().take(4) {
                    scratch.rays.count(query);
                    bests[lane] = self.closest_hit(lanes, query, scratch);
                    hits.aim(lane, query.ray.dir);
                    for (axis, origin) in origin.iter_mut().enumerate() {
                        origin[lane] = query.ray.origin[axis];
                    }
                }
                scratch.note_leaves(&bests);
                self.note_hits(lanes, &origin, &bests, hits);
            },
        );
    }

    /// Intersects the marked rays of a stream, all of one kind, with the unbounded items.
    #[inline(always)]
    fn intersect_unbounded(
        &self,
        lanes: SimdLevel,
        rays: &StreamRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        bests: &mut [Option<ClosestHit>],
        scratch: &mut QueryScratch,
    ) {
        for &item in &self.bvh().unbounded {
            let rays = &rays.for_item(item, rays.active);
            let ended = &mut NewEnds::default();
            self.intersect_packet8(lanes, rays, stream, bests, ended, scratch);
        }
    }

    /// Intersects the marked rays of a stream with the bounded items in one traversal.
    #[inline(always)]
    fn closest_hits_stream(
        &self,
        lanes: SimdLevel,
        rays: &StreamRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        bests: &mut [Option<ClosestHit>],
        scratch: &mut QueryScratch,
    ) {
        let ends = stream.ends();
        self.bvh().tree.traverse_stream(
            lanes,
            rays.active,
            #[inline(always)]
            |lane| ((rays.query)(lane).ray, ends[lane]),
            #[inline(always)]
            |number, active, ended| {
                let item = self.bvh().bounded[number as usize];
                let rays = &rays.for_item(item, active);
                self.intersect_packet8(lanes, rays, stream, bests, ended, scratch);
            },
        );
    }

    #[inline(always)]
    pub(in crate::world) fn closest_hit(
        &self,
        lanes: SimdLevel,
        query: &Query,
        scratch: &mut QueryScratch,
    ) -> Option<ClosestHit> {
        let mut best: Option<ClosestHit> = None;
        let mut far = query.t_max;
        let search = self.search_for(query);
        for &item in &self.bvh().unbounded {
            far = self.test_item(item, query, &search, far, &mut best, scratch);
        }
        self.nearest_in_tree(lanes, query, &search, &mut best, scratch);
        best
    }

    /// Replaces the closest hit so far by a closer one in the tree, if there is one.
    #[inline(always)]
    fn nearest_in_tree(
        &self,
        lanes: SimdLevel,
        query: &Query,
        search: &Search,
        best: &mut Option<ClosestHit>,
        scratch: &mut QueryScratch,
    ) {
        let far = best.map_or(query.t_max, |best| behind(best.hit.root.t, query));
        self.bvh().tree.nearest_in(
            lanes,
            &query.ray,
            (0.0, far),
            #[inline(always)]
            |number, far| {
                let item = self.bvh().bounded[number as usize];
                self.test_item(item, query, search, far, best, scratch)
            },
        );
    }

    /// Intersects one item and returns the new far limit.
    #[inline(always)]
    pub(in crate::world) fn test_item(
        &self,
        item: IndexedItem,
        query: &Query,
        search: &Search,
        far: f64,
        best: &mut Option<ClosestHit>,
        scratch: &mut QueryScratch,
    ) -> f64 {
        match self.intersect_item(item, query, search, far, scratch) {
            None => far,
            Some(hit) => self.accept_if_closer(item.number, hit, query, far, best),
        }
    }

    /// The first visible hit on one item up to and including `far`.
    #[inline(always)]
    pub(in crate::world) fn intersect_item(
        &self,
        item: IndexedItem,
        query: &Query,
        search: &Search,
        far: f64,
        scratch: &mut QueryScratch,
    ) -> Option<RawHit> {
        if self.is_hidden(item.item, query.kind) {
            return None;
        }
        let mut policy = ClosestQuery { world: self, query };
        self.model
            .first_hit(item.item, search, far, scratch, &mut policy)
    }

    /// Replaces the closest hit so far by `hit` if that is closer, and returns the new far limit, a little behind the
    /// closest hit: of two hits at almost one distance POV-Ray's roundings decide.
    #[inline(always)]
    pub(in crate::world) fn accept_if_closer(
        &self,
        item: u32,
        hit: RawHit,
        query: &Query,
        far: f64,
        best: &mut Option<ClosestHit>,
    ) -> f64 {
        if hit.root.t >= query.t_max {
            return far;
        }
        let mut nearest = ClosestHit {
            hit,
            item,
            tie: Tie::Pairs(0),
        };
        if let Some(known) = best {
            let slack = tie_slack(hit.root.t, query);
            let ahead = known.hit.root.t - hit.root.t;
            if ahead < -slack {
                return far;
            }
            if ahead <= slack {
                if known.tie == Tie::Settled && ahead <= 0.0 {
                    return far;
                }
                nearest = self.shown_of_tied(&nearest, known, query);
            }
        }
        let end = behind(nearest.hit.root.t, query);
        *best = Some(nearest);
        if end < far { end } else { far }
    }

    /// Distance up to which hits are ignored: the error of the ray's origin.
    pub(in crate::world) fn t_min(&self, query: &Query) -> f64 {
        self.t_min_from(query.origin_surface.map(|origin| origin.blur), query.kind)
    }

    /// Same, from the error `blur` of the ray's origin; `None` if the ray leaves no surface.
    #[inline(always)]
    pub(in crate::world) fn t_min_from(&self, blur: Option<f64>, kind: RayKind) -> f64 {
        match (self.least_distance, kind) {
            // POV-Ray's in any case: nearest hits decide how far a radiosity sample reaches, and the reach shows in the
            // picture.
            (_, RayKind::Radiosity) => POV_RAY_T_MIN,
            // So do those of photons: what is stored decides the radius of every search.
            (_, RayKind::Photon | RayKind::PhotonReflection) => POV_RAY_T_MIN * self.globals.unit,
            (TMinRule::Rounding, _) => blur.map_or(0.0, |blur| SKIN * blur),
            (TMinRule::PovRay, RayKind::Shadow) => POV_RAY_SHADOW * self.globals.unit,
            (TMinRule::PovRay, _) => POV_RAY_T_MIN * self.globals.unit,
        }
    }

    /// Distance up to which hits on blobs are ignored: POV-Ray's where its distances are followed.
    #[inline(always)]
    fn blob_t_min(&self, kind: RayKind) -> f64 {
        let follows = self.least_distance == TMinRule::PovRay
            || matches!(
                kind,
                RayKind::Radiosity | RayKind::Photon | RayKind::PhotonReflection
            );
        match follows {
            true => POV_RAY_BLOB * self.globals.unit,
            false => 0.0,
        }
    }

    /// Returns true if POV-Ray ignores a hit for its distance, and its distances are followed. It is tested for the closest
    /// hit alone: shapes without that limit do not show behind one.
    #[inline(always)]
    pub(in crate::world) fn is_too_far(&self, hit: &RawHit) -> bool {
        hit.root.t >= self.t_max && self.has_maximum_distance(hit.leaf)
    }

    /// Returns false for the shapes that POV-Ray shows beyond [`POV_RAY_T_MAX`]: its limit for them is 1e9, is in object
    /// space, or does not exist.
    #[cold]
    fn has_maximum_distance(&self, leaf: u32) -> bool {
        !matches!(
            self.model.leaves.get(leaf as usize).map(|leaf| &leaf.shape),
            Some(
                Shape::Cuboid(_)
                    | Shape::Cylinder(_)
                    | Shape::Cone(_)
                    | Shape::Mesh(_)
                    | Shape::Polygon(_)
                    | Shape::HeightField(_)
                    | Shape::BicubicPatch(_)
                    | Shape::SphereSweep(_)
                    | Shape::Isosurface(_)
            )
        )
    }

    /// Returns true for a self-intersection: the hit lies, within rounding, on the surface that the ray starts on.
    #[inline(always)]
    pub(in crate::world) fn is_self_hit(&self, hit: &RawHit, query: &Query) -> bool {
        match query.origin_surface {
            Some(origin) if hit.root.t <= origin.blur => {
                self.is_within_rounding(hit, query, origin.blur)
            }
            _ => false,
        }
    }

    #[cold]
    fn is_within_rounding(&self, hit: &RawHit, query: &Query, blur: f64) -> bool {
        if self.least_distance == TMinRule::PovRay {
            return false;
        }
        let Root { t, face, .. } = hit.root;
        let (normal, _) = self
            .model
            .normals(hit.leaf, query.ray.at(t), query.ray.dir, face);
        t * normal.dot(query.ray.dir).abs() <= SKIN * blur
    }

    /// The query in the form that the model takes.
    #[inline(always)]
    pub(in crate::world) fn search_for<'q>(&self, query: &'q Query) -> Search<'q> {
        Search {
            ray: &query.ray,
            origin_surface: query.origin_surface.as_ref(),
            t_min: self.t_min(query),
            blob_t_min: self.blob_t_min(query.kind),
            unit: self.globals.unit,
            origin_error: query.origin_surface.map_or(0.0, |origin| origin.blur),
            start: IndexBase::default(),
            exited_leaf: self
                .model
                .exited_convex(query.origin_surface.as_ref(), &query.ray),
        }
    }

    /// A hit with the rounding of POV-Ray, if that is known of its leaf.
    pub(in crate::world) fn rounded_hit(&self, ray: &Ray, hit: &Hit) -> Option<RoundedHit> {
        let SpawnSurface { leaf, face, .. } = hit.spawn_surface;
        let Model {
            rounding, leaves, ..
        } = &self.model;
        rounding.hit(leaf, leaves, ray, hit.t, face)
    }

    /// The hit of a photon with the rounding of POV-Ray, by which its photon maps are ordered.
    #[must_use]
    pub fn rounded_for_photon(&self, ray: &Ray, hit: Hit) -> Hit {
        self.rounded(ray, hit, &LOSS_OF_PHOTONS)
    }

    /// The hit with the rounding of POV-Ray, unless that loses too much.
    #[inline(never)]
    fn rounded(&self, ray: &Ray, hit: Hit, most: &Loss) -> Hit {
        let Model {
            rounding, leaves, ..
        } = &self.model;
        let leaf = hit.spawn_surface.leaf;
        let is_search = rounding.forms.get(&leaf).is_some_and(Rounded::is_search);
        let of = leaves.get(leaf as usize).map(|leaf| &leaf.shape);
        let is_single = matches!(of, Some(Shape::Mesh(_))) && most.rounding.is_finite();
        let most = if is_single { &LOSS_OF_MESHES } else { most };
        let error = hit.spawn_surface.blur;
        match self.rounded_hit(ray, &hit) {
            Some(RoundedHit { t, point, normal }) if is_search => Hit {
                t,
                point,
                shading_normal: normal,
                spawn_surface: SpawnSurface {
                    normal,
                    ..hit.spawn_surface
                },
                ..hit
            },
            Some(RoundedHit { t, point, normal })
                if (t - hit.t).abs() <= most.rounding * error
                    && (normal.length_squared() - 1.0).abs() < most.normal
                    && normal.dot(hit.shading_normal).abs() > 1.0 - most.normal =>
            {
                Hit {
                    t,
                    point,
                    shading_normal: normal,
                    ..hit
                }
            }
            _ => hit,
        }
    }

    #[inline]
    pub(in crate::world) fn hit(&self, ray: &Ray, hit: &RawHit) -> Hit {
        let Root {
            t, face, crossing, ..
        } = hit.root;
        let point = ray.at(t);
        let (normal, shading_normal) = self.model.normals(hit.leaf, point, ray.dir, face);
        let blur = BLUR * point.abs().max_element().max(t);
        let departure = SpawnSurface {
            leaf: hit.leaf,
            face,
            normal,
            crossing,
            blur,
        };
        let exact = Hit {
            t,
            point,
            shading_normal,
            surface: hit.surface,
            spawn_surface: departure,
        };
        if self.model.rounding.is_wanted(hit.leaf) {
            self.rounded(ray, exact, &LOSS)
        } else {
            exact
        }
    }
}
