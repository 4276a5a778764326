//! Closest-hit and occlusion queries for 8-ray packets through a light buffer, without traversal of the BVH: bit for
//! bit the results of single rays.

use super::bundle::{ItemRays, each_bit};
use super::hits::{HitPacket4, ShadowPacket4};
use super::rays::RayStream;
use crate::base::accel::LightBuffer;
use crate::base::math::Ray;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::IndexedItem;
use crate::world::query::{ClosestHit, QueryScratch};
use crate::world::ray::{Occlusion, Query, RayKind};
use glam::DVec3;

/// Rays per packet.
const PACKET_SIZE: usize = 8;

impl World {
    /// Finds the closest visible hits of the first `count` camera rays from `origin`, as [`World::closest_hits_bundle`]
    /// does, through the camera's light buffer.
    pub(in crate::world) fn closest_hits_grid(
        &self,
        light_buffer: &LightBuffer,
        origin: DVec3,
        count: usize,
        hits: &mut [HitPacket4],
        scratch: &mut QueryScratch,
    ) {
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        with_widest(
            #[inline(always)]
            |lanes| {
                for (number, hits) in hits.chunks_mut(2).enumerate() {
                    let active = (count - PACKET_SIZE * number).min(PACKET_SIZE);
                    let active = 0xff >> (PACKET_SIZE - active);
                    let view = View {
                        light_buffer,
                        origin,
                    };
                    self.closest_hits_packet8(lanes, view, hits, active, &mut stream, scratch);
                }
            },
        );
        scratch.ray_stream = stream;
    }

    #[inline(always)]
    fn closest_hits_packet8(
        &self,
        lanes: SimdLevel,
        view: View,
        hits: &mut [HitPacket4],
        active: u32,
        stream: &mut RayStream,
        scratch: &mut QueryScratch,
    ) {
        let View {
            light_buffer,
            origin,
        } = view;
        let mut bests: [Option<ClosestHit>; PACKET_SIZE] = [None; PACKET_SIZE];
        let packets = &*hits;
        let query = |ray: usize| Query {
            ray: Ray::new(origin, packets[ray / 4].dir(ray % 4)),
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        // Most rays that miss everything need no intersection at all.
        let mut are_loaded = !self.bvh().unbounded.is_empty();
        let mut ends = [[f64::INFINITY; 4]; 2];
        let last = hits.len() - 1;
        if are_loaded {
            stream.load_camera_rays(origin, self.t_min(&query(0)), packets);
            for &item in &self.bvh().unbounded {
                let rays = item_rays(item, RayKind::Camera, active, &query);
                self.intersect_packet8_item(lanes, &rays, stream, &mut bests, scratch, |_, _| {});
            }
            ends = [stream.packet(0).t_max, stream.packet(4 * last).t_max];
        }
        let halves = [(&packets[0].dir, &ends[0]), (&packets[last].dir, &ends[1])];
        let mut rays = light_buffer.load_from_point(halves, active);
        let uncovered = light_buffer.visit_packet(
            lanes,
            &mut rays,
            #[inline(always)]
            |position, candidates, rays| {
                let item = self.bvh().bounded[position as usize];
                if !are_loaded {
                    stream.load_camera_rays(origin, self.t_min(&query(0)), packets);
                    are_loaded = true;
                }
                self.intersect_packet8_item(
                    lanes,
                    &item_rays(item, RayKind::Camera, candidates, &query),
                    stream,
                    &mut bests,
                    scratch,
                    #[inline(always)]
                    |ray, end| rays.shorten(ray, end),
                );
            },
        );
        if !are_loaded && uncovered == 0 {
            hits.iter_mut().for_each(HitPacket4::clear_hits);
            return;
        }
        each_bit(uncovered, |ray| {
            bests[ray % PACKET_SIZE] = self.closest_hit(lanes, &query(ray), scratch);
        });
        scratch.note_leaves(&bests);
        let origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
        for (bests, hits) in bests.chunks(4).zip(hits) {
            self.note_hits(lanes, &origin, bests, hits);
        }
    }

    /// Intersects an item with some of eight rays; calls `shorten` for the rays whose far limit moves closer.
    #[inline(always)]
    fn intersect_packet8_item(
        &self,
        lanes: SimdLevel,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        stream: &mut RayStream,
        bests: &mut [Option<ClosestHit>; PACKET_SIZE],
        scratch: &mut QueryScratch,
        mut shorten: impl FnMut(usize, f64),
    ) {
        let scalar = self.packet4_item::<true>(
            lanes,
            rays,
            stream,
            scratch,
            #[inline(always)]
            |stream, ray, hit| {
                let best = &mut bests[ray % PACKET_SIZE];
                self.accept_hit(stream, rays, ray, hit, best, &mut shorten);
            },
        );
        each_bit(
            scalar,
            #[inline(always)]
            |ray| {
                let query = (rays.query)(ray);
                let search = self.search_for(&query);
                let far = stream.t_max(ray);
                let hit = self.intersect_item(rays.item, &query, &search, far, scratch);
                if let Some(hit) = hit {
                    let best = &mut bests[ray % PACKET_SIZE];
                    self.accept_hit(stream, rays, ray, hit, best, &mut shorten);
                }
            },
        );
    }

    #[inline(always)]
    fn accept_hit(
        &self,
        stream: &mut RayStream,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        ray: usize,
        hit: RawHit,
        best: &mut Option<ClosestHit>,
        shorten: &mut impl FnMut(usize, f64),
    ) {
        let old = stream.t_max(ray);
        let new = self.accept_if_closer(rays.item.number, hit, &(rays.query)(ray), old, best);
        if new < old {
            stream.shorten(ray, new);
            shorten(ray, new);
        }
    }

    /// Returns true if the light of this index has a light buffer.
    #[inline]
    pub(crate) fn has_light_buffer(&self, light: u32) -> bool {
        self.light_buffers.of_light(light).is_some()
    }

    /// Records the occlusion of the shadow rays from up to eight neighbouring hits, those marked in `active`, to a
    /// light that has a light buffer.
    #[inline(always)]
    pub(crate) fn occlusion_packet8(
        &self,
        lanes: SimdLevel,
        light: u32,
        hits: &[HitPacket4],
        shadow_rays: &mut [ShadowPacket4],
        active: u32,
        scratch: &mut QueryScratch,
    ) {
        let Some(light_buffer) = self.light_buffers.of_light(light) else {
            return;
        };
        scratch.rays.shadow += u64::from(active.count_ones());
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        let mut shadows = ShadowMasks::default();
        let to_light = &*shadow_rays;
        let query = |ray: usize| to_light[ray / 4].query(&hits[ray / 4], ray % 4);
        let origins = ShadowOrigins {
            hits,
            shadow_rays: to_light,
        };
        for &item in &self.bvh().unbounded {
            let rays = &item_rays(item, RayKind::Shadow, active & !shadows.blocked, &query);
            let (stream, shadows) = (&mut stream, &mut shadows);
            self.occlude_packet8_item(lanes, rays, origins, stream, shadows, scratch);
        }
        let remaining = active & !shadows.blocked;
        if remaining != 0 {
            let last = hits.len() - 1;
            let half = |packet: usize| (&to_light[packet].to_light, &to_light[packet].distance);
            let mut rays = light_buffer.load_to_point([half(0), half(last)], remaining);
            light_buffer.visit_packet(
                lanes,
                &mut rays,
                #[inline(always)]
                |position, candidates, rays| {
                    let before = shadows.blocked;
                    let item = self.bvh().bounded[position as usize];
                    self.occlude_packet8_item(
                        lanes,
                        &item_rays(item, RayKind::Shadow, candidates, &query),
                        origins,
                        &mut stream,
                        &mut shadows,
                        scratch,
                    );
                    each_bit(shadows.blocked & !before, |ray| {
                        rays.shorten(ray, f64::NEG_INFINITY);
                    });
                },
            );
        }
        scratch.ray_stream = stream;
        for (half, shadow_rays) in shadow_rays.iter_mut().enumerate() {
            let of_half = |bits: u32| bits >> (4 * half) & 0b1111;
            shadow_rays.known = of_half(active);
            shadow_rays.blocked = of_half(shadows.blocked);
            shadow_rays.filtered = of_half(shadows.filtered & !shadows.blocked);
        }
    }

    /// Tests an item against some of eight shadow rays.
    #[inline(always)]
    fn occlude_packet8_item(
        &self,
        lanes: SimdLevel,
        rays: &ItemRays<'_, impl Fn(usize) -> Query>,
        origins: ShadowOrigins,
        stream: &mut RayStream,
        shadows: &mut ShadowMasks,
        scratch: &mut QueryScratch,
    ) {
        if !shadows.are_loaded {
            stream.load_shadow_rays(
                origins.hits,
                origins.shadow_rays,
                #[inline(always)]
                |blur| self.t_min_from(Some(blur), RayKind::Shadow),
            );
            shadows.are_loaded = true;
        }
        let scalar = self.packet4_item::<false>(
            lanes,
            rays,
            stream,
            scratch,
            #[inline(always)]
            |stream, ray, hit| {
                if hit.root.t < stream.t_max(ray) {
                    if self.ends_light(&hit) {
                        shadows.blocked |= 1 << ray;
                    } else {
                        shadows.filtered |= 1 << ray;
                    }
                }
            },
        );
        each_bit(scalar, |ray| {
            let mut occlusion = Occlusion::Clear;
            let query = (rays.query)(ray);
            let search = &self.search_for(&query);
            if self.occludes(rays.item, &query, search, &mut occlusion, scratch) {
                shadows.blocked |= 1 << ray;
            } else if occlusion == Occlusion::Transmissive {
                shadows.filtered |= 1 << ray;
            }
        });
    }
}

/// A light buffer and its centre.
#[derive(Clone, Copy)]
struct View<'a> {
    light_buffer: &'a LightBuffer,
    origin: DVec3,
}

/// Shadow rays and the hits where they start.
#[derive(Clone, Copy)]
struct ShadowOrigins<'a> {
    hits: &'a [HitPacket4],
    shadow_rays: &'a [ShadowPacket4],
}

/// The rays of a packet in the mask `active`, and an item to intersect them with.
#[inline(always)]
fn item_rays<Q>(item: IndexedItem, kind: RayKind, active: u32, query: &Q) -> ItemRays<'_, Q> {
    ItemRays {
        item,
        kind,
        first: 0,
        active,
        query,
    }
}

/// Occlusion masks of eight shadow rays: those that are blocked, and those that pass a transmissive surface.
#[derive(Clone, Copy, Debug, Default)]
struct ShadowMasks {
    blocked: u32,
    filtered: u32,
    /// True once the rays are loaded into the stream: most rays never need it.
    are_loaded: bool,
}
