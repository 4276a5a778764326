//! Closest-hit and occlusion queries for bundles and streams of rays: bit for bit the results of single rays.

use super::hits::{HitPacket4, ShadowPacket4};
use super::rays::RayStream;
use crate::base::accel::{Bundle, LightBuffer, MAX_STREAM_RAYS, NewEnds};
use crate::base::math::Ray;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::IndexedItem;
use crate::world::model::Item;
use crate::world::query::{ClosestHit, QueryScratch};
use crate::world::ray::{Occlusion, Query, RayKind};
use glam::DVec3;

/// An item, and up to eight rays of a stream to be intersected with it.
pub(in crate::world) struct ItemRays<'a, Q> {
    pub(in crate::world) item: IndexedItem,
    pub(in crate::world) kind: RayKind,
    /// Index of the first ray.
    pub(in crate::world) first: usize,
    /// Mask of the active rays, from the first on.
    pub(in crate::world) active: u32,
    /// The query of each ray, by index.
    pub(in crate::world) query: &'a Q,
}

/// A packet of four rays in a stream.
pub(in crate::world) struct StreamPacket<'a> {
    pub(in crate::world) stream: &'a mut RayStream,
    /// Index of the first ray.
    pub(in crate::world) start: usize,
    /// Mask of the active lanes.
    pub(in crate::world) active: u32,
}

/// A bundle of rays that share a point.
pub(in crate::world) struct PointBundle<'a> {
    pub(in crate::world) bundle: &'a mut Bundle,
    pub(in crate::world) point: DVec3,
}

/// Calls `visit` with the index of each set bit.
#[inline(always)]
pub(in crate::world) fn each_bit(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

/// Mask of the rays, of the first eight, that are not blocked.
#[inline(always)]
pub(super) fn unblocked(occlusions: &[Occlusion]) -> u32 {
    let mut bits = 0;
    for (lane, occlusion) in occlusions.iter().take(MAX_STREAM_RAYS).enumerate() {
        bits |= u32::from(*occlusion != Occlusion::Opaque) << lane;
    }
    bits
}

impl World {
    /// Finds the closest visible hits of the first `count` camera rays from `origin`, ordered so that neighbours differ
    /// little. Lanes past the last ray repeat some ray.
    pub fn closest_hits_bundle(
        &self,
        origin: DVec3,
        count: usize,
        hits: &mut [HitPacket4],
        scratch: &mut QueryScratch,
    ) {
        scratch.rays.camera += count as u64;
        if let Some(light_buffer) = &self.light_buffers.camera {
            self.closest_hits_grid(light_buffer, origin, count, hits, scratch);
            return;
        }
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut bests = std::mem::take(&mut scratch.bests);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        bests.clear();
        bests.resize(count, None);
        with_widest(
            #[inline(always)]
            |lanes| {
                let rays = &*hits;
                let query = |ray: usize| Query {
                    ray: Ray::new(origin, rays[ray / 4].dir(ray % 4)),
                    origin_surface: None,
                    t_max: f64::INFINITY,
                    kind: RayKind::Camera,
                };
                stream.load_camera_rays(origin, self.t_min(&query(0)), rays);
                for &item in &self.bvh().unbounded {
                    for first in (0..count).step_by(8) {
                        let rays = ItemRays {
                            item,
                            kind: RayKind::Camera,
                            first,
                            active: 0xff >> (8 - (count - first).min(8)),
                            query: &query,
                        };
                        let (stream, bests) = (&mut stream, &mut bests);
                        let ended = &mut NewEnds::default();
                        self.intersect_packet8(lanes, &rays, stream, bests, ended, scratch);
                    }
                }
                let is_done = bundle.fill(
                    &self.bvh().tree,
                    origin,
                    count,
                    #[inline(always)]
                    |packet| (rays[packet].dir, stream.packet(4 * packet).t_max),
                ) && self.intersect_meshes(
                    lanes,
                    &mut stream,
                    &mut bests,
                    query,
                    PointBundle {
                        bundle: &mut bundle,
                        point: origin,
                    },
                    scratch,
                ) && self.bvh().tree.traverse_bundle(
                    lanes,
                    &mut bundle,
                    #[inline(always)]
                    |number, first, active, ended| {
                        let item = self.bvh().bounded[number as usize];
                        if !self.is_large_mesh(item) {
                            let rays = ItemRays {
                                item,
                                kind: RayKind::Camera,
                                first,
                                active,
                                query: &query,
                            };
                            let (stream, bests) = (&mut stream, &mut bests);
                            self.intersect_packet8(lanes, &rays, stream, bests, ended, scratch);
                        }
                    },
                );
                if !is_done {
                    for (ray, best) in bests.iter_mut().enumerate() {
                        *best = self.closest_hit(lanes, &query(ray), scratch);
                    }
                }
                scratch.note_leaves(&bests);
                let origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
                for (bests, hits) in bests.chunks(4).zip(hits) {
                    self.note_hits(lanes, &origin, bests, hits);
                }
            },
        );
        scratch.bundle = bundle;
        scratch.bests = bests;
        scratch.ray_stream = stream;
    }

    /// Occlusion of the shadow rays from the hits with these indices to a light, appended to `occlusions`: by a bundle
    /// if they share the point `centre` and neighbours differ little, otherwise by streams of eight. Returns true if
    /// the bundle paid.
    pub fn occlusion_bundle(
        &self,
        indices: &[u16],
        hits: &[HitPacket4],
        to_light: &[ShadowPacket4],
        centre: Option<DVec3>,
        scratch: &mut QueryScratch,
        occlusions: &mut Vec<Occlusion>,
    ) -> bool {
        let first = occlusions.len();
        scratch.rays.shadow += indices.len() as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        let query = |ray: usize| {
            let index = usize::from(indices[ray]);
            to_light[index / 4].query(&hits[index / 4], index % 4)
        };
        let was_of_use = with_widest(
            #[inline(always)]
            |lanes| {
                stream.load_shadow_rays_all(
                    indices,
                    hits,
                    to_light,
                    #[inline(always)]
                    |blur| self.t_min_from(Some(blur), RayKind::Shadow),
                );
                occlusions.resize(first + indices.len(), Occlusion::Clear);
                let occlusions = &mut occlusions[first..];
                self.occlude_by_unbounded(lanes, &query, &mut stream, occlusions, scratch);
                let is_bundled = |centre: &DVec3| {
                    bundle.fill(
                        &self.bvh().tree,
                        *centre,
                        indices.len(),
                        #[inline(always)]
                        |packet| {
                            let back = stream.dirs(packet).map(|axis| axis.map(|dir| -dir));
                            let mut end = [f64::NEG_INFINITY; 4];
                            for (lane, occlusion) in
                                occlusions[4 * packet..].iter().take(4).enumerate()
                            {
                                if *occlusion != Occlusion::Opaque {
                                    let index = usize::from(indices[4 * packet + lane]);
                                    end[lane] = to_light[index / 4].distance[index % 4];
                                }
                            }
                            (back, end)
                        },
                    )
                };
                let Some(centre) = centre.filter(is_bundled) else {
                    self.occlude_streams(lanes, &query, &mut stream, occlusions, scratch);
                    return false;
                };
                let is_done = self.occlude_by_meshes(
                    lanes,
                    &mut stream,
                    occlusions,
                    query,
                    PointBundle {
                        bundle: &mut bundle,
                        point: centre,
                    },
                    scratch,
                ) && self.occlude_by_bounded(
                    lanes,
                    &query,
                    &mut stream,
                    occlusions,
                    &mut bundle,
                    scratch,
                );
                if !is_done {
                    self.occlude_streams(lanes, &query, &mut stream, occlusions, scratch);
                }
                is_done
            },
        );
        scratch.bundle = bundle;
        scratch.ray_stream = stream;
        was_of_use
    }

    /// Occlusion of up to eight shadow rays to the light of this index. Those that pass a transmissive
    /// surface are not counted: they are traced again.
    #[must_use]
    pub fn occlusion_of_stream(
        &self,
        queries: &[Query],
        light: u32,
        scratch: &mut QueryScratch,
    ) -> [Occlusion; MAX_STREAM_RAYS] {
        let count = queries.len().min(MAX_STREAM_RAYS);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        let mut occlusions = [Occlusion::Clear; MAX_STREAM_RAYS];
        let query = |ray: usize| queries[ray.min(count - 1)];
        with_widest(
            #[inline(always)]
            |lanes| {
                stream.load_rays(count, query, |query| self.t_min(query));
                let occlusions = &mut occlusions[..count];
                self.occlude_by_unbounded(lanes, &query, &mut stream, occlusions, scratch);
                let Some(buffer) = self.light_buffers.of_light(light) else {
                    self.occlude_streams(lanes, &query, &mut stream, occlusions, scratch);
                    return;
                };
                let centre = self.lights.get(light).centre;
                let distances = [0, 4].map(|first| {
                    [0, 1, 2, 3].map(|lane| centre.distance(query(first + lane).ray.origin))
                });
                self.occlude_through(
                    lanes,
                    (buffer, &distances),
                    &query,
                    &mut stream,
                    occlusions,
                    scratch,
                );
            },
        );
        scratch.ray_stream = stream;
        let decided = occlusions[..count].iter();
        let decided = decided.filter(|occlusion| **occlusion != Occlusion::Transmissive);
        scratch.rays.shadow += decided.count() as u64;
        occlusions
    }

    /// Intersects an item with up to eight rays; notes new far limits in `ended`.
    #[inline(always)]
    pub(in crate::world) fn intersect_packet8(
        &self,
        lanes: SimdLevel,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        bests: &mut [Option<ClosestHit>],
        ended: &mut NewEnds,
        scratch: &mut QueryScratch,
    ) {
        let ItemRays {
            item, first, query, ..
        } = *rays;
        let mut accept = |stream: &mut RayStream, ray: usize, hit, ended: &mut NewEnds| {
            let old = stream.t_max(ray);
            let new = self.accept_if_closer(item.number, hit, &query(ray), old, &mut bests[ray]);
            if new < old {
                stream.shorten(ray, new);
                ended.set(ray - first, new);
            }
        };
        let scalar = self.packet4_item::<true>(
            lanes,
            rays,
            stream,
            scratch,
            #[inline(always)]
            |stream, ray, hit| accept(stream, ray, hit, ended),
        );
        each_bit(scalar, |lane| {
            let ray = first + lane;
            let query = &query(ray);
            let search = &self.search_for(query);
            if let Some(hit) = self.intersect_item(item, query, search, stream.t_max(ray), scratch)
            {
                accept(stream, ray, hit, ended);
            }
        });
    }

    /// Updates the occlusion of a shadow ray with a hit; returns true if the ray is blocked.
    #[inline(always)]
    fn note_occlusion(&self, hit: &RawHit, occlusion: &mut Occlusion) -> bool {
        if self.ends_light(hit) {
            *occlusion = Occlusion::Opaque;
        } else if *occlusion == Occlusion::Clear {
            *occlusion = Occlusion::Transmissive;
        }
        *occlusion == Occlusion::Opaque
    }

    /// Tests shadow rays against the unbounded items.
    #[inline(always)]
    pub(super) fn occlude_by_unbounded(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        scratch: &mut QueryScratch,
    ) {
        for &item in &self.bvh().unbounded {
            for first in (0..occlusions.len()).step_by(8) {
                let rays = ItemRays {
                    item,
                    kind: RayKind::Shadow,
                    first,
                    active: 0xff >> (8 - (occlusions.len() - first).min(8)),
                    query,
                };
                let scalar = self.packet4_item::<false>(
                    lanes,
                    &rays,
                    &mut *stream,
                    scratch,
                    #[inline(always)]
                    |stream, ray, hit| {
                        if hit.root.t < stream.t_max(ray) {
                            self.note_occlusion(&hit, &mut occlusions[ray]);
                        }
                    },
                );
                each_bit(scalar, |lane| {
                    let occlusion = &mut occlusions[first + lane];
                    if *occlusion == Occlusion::Opaque {
                        return;
                    }
                    let query = query(first + lane);
                    let search = &self.search_for(&query);
                    if self.occludes(item, &query, search, occlusion, scratch) {
                        *occlusion = Occlusion::Opaque;
                    }
                });
            }
        }
    }

    /// Tests shadow rays against the items of the BVH except large meshes. Returns false if the traversal was
    /// abandoned.
    #[inline(always)]
    pub(super) fn occlude_by_bounded(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        bundle: &mut Bundle,
        scratch: &mut QueryScratch,
    ) -> bool {
        self.bvh().tree.traverse_bundle(
            lanes,
            bundle,
            #[inline(always)]
            |number, first, active, ended| {
                let item = self.bvh().bounded[number as usize];
                if self.is_large_mesh(item) {
                    return;
                }
                let rays = ItemRays {
                    item,
                    kind: RayKind::Shadow,
                    first,
                    active,
                    query,
                };
                self.occlude_packet8(lanes, &rays, stream, occlusions, ended, scratch);
            },
        )
    }

    /// Tests an item against up to eight shadow rays.
    #[inline(always)]
    pub(super) fn occlude_packet8(
        &self,
        lanes: SimdLevel,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        ended: &mut NewEnds,
        scratch: &mut QueryScratch,
    ) {
        let ItemRays {
            item, first, query, ..
        } = *rays;
        let scalar = self.packet4_item::<false>(
            lanes,
            rays,
            stream,
            scratch,
            #[inline(always)]
            |stream, ray, hit| {
                if hit.root.t < stream.t_max(ray) && self.note_occlusion(&hit, &mut occlusions[ray])
                {
                    ended.set(ray - first, f64::NEG_INFINITY);
                }
            },
        );
        each_bit(scalar, |lane| {
            let occlusion = &mut occlusions[first + lane];
            if *occlusion == Occlusion::Opaque {
                return;
            }
            let query = query(first + lane);
            let search = &self.search_for(&query);
            if self.occludes(item, &query, search, occlusion, scratch) {
                *occlusion = Occlusion::Opaque;
                ended.set(lane, f64::NEG_INFINITY);
            }
        });
    }

    /// Tests up to eight shadow rays that are not yet blocked through the light buffer of their light, at these distances
    /// from it.
    #[inline(always)]
    fn occlude_through(
        &self,
        lanes: SimdLevel,
        (buffer, distances): (&LightBuffer, &[[f64; 4]; 2]),
        query: &impl Fn(usize) -> Query,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        scratch: &mut QueryScratch,
    ) {
        let active = unblocked(occlusions);
        if active == 0 {
            return;
        }
        let last = (occlusions.len() - 1) / 4;
        let half = |half: usize| (stream.dirs(half.min(last)), &distances[half]);
        let mut rays = buffer.load_to_point([half(0), half(1)], active);
        buffer.visit_packet(
            lanes,
            &mut rays,
            #[inline(always)]
            |position, active, rays| {
                let item_rays = ItemRays {
                    item: self.bvh().bounded[position as usize],
                    kind: RayKind::Shadow,
                    first: 0,
                    active,
                    query,
                };
                let mut ended = NewEnds::default();
                self.occlude_packet8(lanes, &item_rays, stream, occlusions, &mut ended, scratch);
                ended.each(|lane, end| rays.shorten(lane, end));
            },
        );
    }

    /// Tests the shadow rays that are not yet blocked against the items of the BVH, in streams: for incoherent rays.
    #[inline(always)]
    pub(super) fn occlude_streams(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        scratch: &mut QueryScratch,
    ) {
        for first in (0..occlusions.len()).step_by(MAX_STREAM_RAYS) {
            self.bvh().tree.traverse_stream(
                lanes,
                unblocked(&occlusions[first..]),
                #[inline(always)]
                |lane| {
                    let query = query(first + lane);
                    (query.ray, query.t_max)
                },
                #[inline(always)]
                |number, active, ended| {
                    let rays = ItemRays {
                        item: self.bvh().bounded[number as usize],
                        kind: RayKind::Shadow,
                        first,
                        active,
                        query,
                    };
                    self.occlude_packet8(lanes, &rays, stream, occlusions, ended, scratch);
                },
            );
        }
    }

    /// Intersects an item with up to eight rays, in packets of four where it supports them. Returns the
    /// lanes that need the scalar path; calls `take` with the index and the hit of each other ray that hits the item.
    /// Unless `NEEDS_FACE`, only the distance of the hit is certain to be set.
    #[inline(always)]
    pub(in crate::world) fn packet4_item<const NEEDS_FACE: bool>(
        &self,
        lanes: SimdLevel,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        scratch: &mut QueryScratch,
        mut take: impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let ItemRays {
            item,
            kind,
            first,
            active,
            query,
        } = *rays;
        if self.is_hidden(item.item, kind) {
            return 0;
        }
        if !self.model.suits_packets(item.item) {
            return active;
        }
        let mut scalar = 0;
        let mut unsure = 0;
        // Hits behind an indecisive one are found only by the scalar path.
        let mut take = |stream: &mut RayStream, ray: usize, hit: RawHit| {
            if self.is_decisive(item.item, &hit, kind) {
                take(stream, ray, hit);
            } else {
                unsure |= 1 << (ray - first);
            }
        };
        for half in [0, 4] {
            let some = active >> half & 0b1111;
            if some == 0 {
                continue;
            }
            let start = first + half;
            let packet = StreamPacket {
                stream: &mut *stream,
                start,
                active: some,
            };
            let unknown = match item.item {
                Item::Program(program) => self.packet4_program::<NEEDS_FACE>(
                    lanes, program, packet, query, scratch, &mut take,
                ),
                Item::Leaf(leaf) if let Some(mesh) = self.mesh_of_leaf(leaf) => {
                    if NEEDS_FACE {
                        self.packet4_mesh::<false>(&mesh, packet, query, &mut take)
                    } else {
                        self.packet4_mesh::<true>(&mesh, packet, query, &mut take)
                    }
                }
                Item::Leaf(leaf) if NEEDS_FACE => {
                    let roots = &mut scratch.roots;
                    self.packet4_primitive::<false>(lanes, leaf, packet, query, roots, &mut take)
                }
                Item::Leaf(leaf) => {
                    let roots = &mut scratch.roots;
                    self.packet4_primitive::<true>(lanes, leaf, packet, query, roots, &mut take)
                }
                Item::Instance(instance) if NEEDS_FACE => {
                    self.packet4_instance::<false>(lanes, instance, packet, &mut take)
                }
                Item::Instance(instance) => {
                    self.packet4_instance::<true>(lanes, instance, packet, &mut take)
                }
            };
            scalar |= unknown << half;
        }
        scalar | unsure
    }
}
