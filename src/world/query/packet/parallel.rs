//! Closest-hit queries for bundles of parallel rays: bit for bit the results of single rays.

use super::bundle::ItemRays;
use super::hits::HitPacket4;
use crate::base::accel::NewEnds;
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::world::compiled::World;
use crate::world::query::QueryScratch;
use crate::world::ray::{Query, RayKind};

/// Fewer rays than this are better traversed in streams.
const MIN_RAYS: usize = 16;

impl World {
    /// Finds the closest visible hits of `count` camera rays, ordered so that neighbours lie close to each other. Returns
    /// false, and finds none, if they are not parallel or have little in common.
    pub fn closest_hits_parallel(
        &self,
        count: usize,
        ray: impl Fn(usize) -> Ray,
        hits: &mut [HitPacket4],
        scratch: &mut QueryScratch,
    ) -> bool {
        let dir = ray(0).dir;
        if count < MIN_RAYS || (1..count).any(|number| ray(number).dir != dir) {
            return false;
        }
        let query = |number: usize| Query {
            ray: ray(number),
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        let mut bundle = std::mem::take(&mut scratch.parallel_bundle);
        let mut bests = std::mem::take(&mut scratch.bests);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        bests.clear();
        bests.resize(count, None);
        let is_done = with_widest(
            #[inline(always)]
            |lanes| {
                stream.load_parallel_rays(count, self.t_min(&query(0)), &ray);
                let tree = &self.bvh().tree;
                if !bundle.fill(lanes, tree, (count, dir), |packet| stream.origins(packet)) {
                    return false;
                }
                let rays = |item, first, active| ItemRays {
                    item,
                    kind: RayKind::Camera,
                    first,
                    active,
                    query: &query,
                };
                for &item in &self.bvh().unbounded {
                    for first in (0..count).step_by(8) {
                        let rays = rays(item, first, 0xff >> (8 - (count - first).min(8)));
                        let (stream, bests) = (&mut stream, &mut bests);
                        let ended = &mut NewEnds::default();
                        self.intersect_packet8(lanes, &rays, stream, bests, ended, scratch);
                    }
                }
                if !self.bvh().unbounded.is_empty() {
                    bundle.end_all(|packet| stream.packet(4 * packet).t_max);
                }
                let is_done = tree.traverse_parallel_bundle(
                    lanes,
                    &mut bundle,
                    #[inline(always)]
                    |position, first, active, ended| {
                        let item = self.bvh().bounded[position as usize];
                        let rays = rays(item, first, active);
                        let (stream, bests) = (&mut stream, &mut bests);
                        self.intersect_packet8(lanes, &rays, stream, bests, ended, scratch);
                    },
                );
                if is_done {
                    scratch.rays.camera += count as u64;
                    scratch.note_leaves(&bests);
                    for (packet, (bests, hits)) in bests.chunks(4).zip(hits).enumerate() {
                        hits.dir = *stream.dirs(packet);
                        self.note_hits(lanes, stream.origins(packet), bests, hits);
                    }
                }
                is_done
            },
        );
        scratch.parallel_bundle = bundle;
        scratch.bests = bests;
        scratch.ray_stream = stream;
        is_done
    }
}
