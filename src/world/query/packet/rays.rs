//! Streams of ray queries, stored in packets of four that are intersected together.

use super::hits::{HitPacket4, NO_LEAF, ShadowPacket4};
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::from_arrays;
use crate::scene::shape::RayPacket;
use crate::world::ray::Query;
use glam::DVec3;

/// Four ray queries. Unused lanes repeat the last query.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(in crate::world) struct RayPacket4 {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    /// Near limits: hits up to here are ignored.
    pub(in crate::world) t_min: [f64; 4],
    /// Far limits.
    pub(in crate::world) t_max: [f64; 4],
    /// The leaves that the rays start on; [`NO_LEAF`] for none.
    pub(in crate::world) origin_leaf: [u32; 4],
    /// Mask of the lanes whose rays go to the outer side of the leaf they start on.
    pub(in crate::world) goes_out: u32,
}

/// A stream of any number of ray queries, in packets of four.
#[derive(Debug, Default)]
pub(in crate::world) struct RayStream {
    packets: Vec<RayPacket4>,
}

impl RayStream {
    /// Loads camera rays, which share their origin and the near limit `t_min`.
    #[inline(always)]
    pub(in crate::world) fn load_camera_rays(
        &mut self,
        origin: DVec3,
        t_min: f64,
        hits: &[HitPacket4],
    ) {
        self.packets.resize(hits.len(), RayPacket4::NONE);
        for (packet, hits) in self.packets.iter_mut().zip(hits) {
            packet.origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
            packet.dir = hits.dir;
            packet.t_min = [t_min; 4];
            packet.t_max = [f64::INFINITY; 4];
            packet.origin_leaf = [NO_LEAF; 4];
        }
    }

    /// Loads `count` camera rays, which share the near limit `t_min`.
    #[inline(always)]
    pub(in crate::world) fn load_parallel_rays(
        &mut self,
        count: usize,
        t_min: f64,
        ray: impl Fn(usize) -> Ray,
    ) {
        self.packets.resize(count.div_ceil(4), RayPacket4::NONE);
        for (number, packet) in self.packets.iter_mut().enumerate() {
            for lane in 0..4 {
                let Ray { origin, dir } = ray((4 * number + lane).min(count - 1));
                for axis in 0..3 {
                    packet.origin[axis][lane] = origin[axis];
                    packet.dir[axis][lane] = dir[axis];
                }
            }
            packet.t_min = [t_min; 4];
            packet.t_max = [f64::INFINITY; 4];
            packet.origin_leaf = [NO_LEAF; 4];
            packet.goes_out = 0;
        }
    }

    /// Loads up to eight rays with any origins; `t_min_of` gives the near limit of each.
    #[inline(always)]
    pub(in crate::world) fn load_rays(
        &mut self,
        count: usize,
        query: impl Fn(usize) -> Query,
        t_min_of: impl Fn(&Query) -> f64,
    ) {
        self.packets.resize(count.div_ceil(4), RayPacket4::NONE);
        for (number, packet) in self.packets.iter_mut().enumerate() {
            packet.goes_out = 0;
            for lane in 0..4 {
                let query = query((4 * number + lane).min(count - 1));
                for axis in 0..3 {
                    packet.origin[axis][lane] = query.ray.origin[axis];
                    packet.dir[axis][lane] = query.ray.dir[axis];
                }
                packet.t_min[lane] = t_min_of(&query);
                packet.t_max[lane] = query.t_max;
                packet.origin_leaf[lane] =
                    query.origin_surface.map_or(NO_LEAF, |origin| origin.leaf);
                let goes_out = query
                    .origin_surface
                    .is_some_and(|origin| origin.normal.dot(query.ray.dir) > 0.0);
                packet.goes_out |= u32::from(goes_out) << lane;
            }
        }
    }

    /// Far limits of the first eight queries.
    #[inline(always)]
    pub(in crate::world) fn ends(&self) -> [f64; 8] {
        let mut ends = [0.0; 8];
        for (ends, packet) in ends.chunks_mut(4).zip(&self.packets) {
            ends.copy_from_slice(&packet.t_max);
        }
        ends
    }

    /// Loads the shadow rays of all these hits to a light; `t_min_of` gives the near limit for the error of the origin.
    #[inline(always)]
    pub(in crate::world) fn load_shadow_rays(
        &mut self,
        hits: &[HitPacket4],
        shadow_rays: &[ShadowPacket4],
        t_min_of: impl Fn(f64) -> f64,
    ) {
        self.packets.resize(hits.len(), RayPacket4::NONE);
        for (packet, (hits, shadow_rays)) in
            self.packets.iter_mut().zip(hits.iter().zip(shadow_rays))
        {
            packet.origin = hits.point;
            packet.dir = shadow_rays.to_light;
            for lane in 0..4 {
                packet.t_min[lane] = t_min_of(hits.blur[lane]);
            }
            packet.t_max = shadow_rays.t_max;
            packet.origin_leaf = hits.leaf;
            packet.goes_out = shadow_rays.goes_out;
        }
    }

    /// Loads shadow rays that all start at one hit, which fills all lanes of `hits`; `t_min_of` as above.
    #[inline(always)]
    pub(in crate::world) fn load_shadow_rays_from_point(
        &mut self,
        hits: &HitPacket4,
        shadow_rays: &[ShadowPacket4],
        t_min_of: impl Fn(f64) -> f64,
    ) {
        self.packets.resize(shadow_rays.len(), RayPacket4::NONE);
        let t_min = t_min_of(hits.blur[0]);
        for (packet, shadow_rays) in self.packets.iter_mut().zip(shadow_rays) {
            packet.origin = hits.point;
            packet.dir = shadow_rays.to_light;
            packet.t_min = [t_min; 4];
            packet.t_max = shadow_rays.t_max;
            packet.origin_leaf = hits.leaf;
            packet.goes_out = shadow_rays.goes_out;
        }
    }

    /// Loads the shadow rays to a light of the hits with these indices; `t_min_of` gives the near limit for the error
    /// of the origin.
    #[inline(always)]
    pub(in crate::world) fn load_shadow_rays_all(
        &mut self,
        indices: &[u16],
        hits: &[HitPacket4],
        shadow_rays: &[ShadowPacket4],
        t_min_of: impl Fn(f64) -> f64,
    ) {
        self.packets
            .resize(indices.len().div_ceil(4), RayPacket4::NONE);
        for (packet, indices) in self.packets.iter_mut().zip(indices.chunks(4)) {
            packet.goes_out = 0;
            for lane in 0..4 {
                let index = usize::from(indices[lane.min(indices.len() - 1)]);
                let (hits, shadow_rays) = (&hits[index / 4], &shadow_rays[index / 4]);
                for axis in 0..3 {
                    packet.origin[axis][lane] = hits.point[axis][index % 4];
                    packet.dir[axis][lane] = shadow_rays.to_light[axis][index % 4];
                }
                packet.t_min[lane] = t_min_of(hits.blur[index % 4]);
                packet.t_max[lane] = shadow_rays.t_max[index % 4];
                packet.origin_leaf[lane] = hits.leaf[index % 4];
                packet.goes_out |= (shadow_rays.goes_out >> (index % 4) & 1) << lane;
            }
        }
    }

    /// Sets the near limit of all rays, and moves their far limits away.
    #[inline(always)]
    pub(super) fn set_limits(&mut self, t_min: f64, farther: f64) {
        for packet in &mut self.packets {
            packet.t_min = [t_min; 4];
            packet.t_max = packet.t_max.map(|t_max| t_max + farther);
        }
    }

    /// Origins of one packet.
    #[inline(always)]
    pub(super) fn origins(&self, packet: usize) -> &[[f64; 4]; 3] {
        &self.packets[packet].origin
    }

    /// Directions of one packet.
    #[inline(always)]
    pub(in crate::world) fn dirs(&self, packet: usize) -> &[[f64; 4]; 3] {
        &self.packets[packet].dir
    }

    /// The ray with this index.
    #[cfg(test)]
    pub(in crate::world) fn ray(&self, number: usize) -> Ray {
        self.packets[number / 4].ray(number % 4)
    }

    /// The packet that contains the ray with this index.
    #[inline(always)]
    pub(in crate::world) fn packet(&self, number: usize) -> &RayPacket4 {
        &self.packets[number / 4]
    }

    /// Near limit of the ray with this index.
    #[inline(always)]
    pub(in crate::world) fn t_min(&self, number: usize) -> f64 {
        self.packets[number / 4].t_min[number % 4]
    }

    /// Far limit of the ray with this index.
    #[inline(always)]
    pub(in crate::world) fn t_max(&self, number: usize) -> f64 {
        self.packets[number / 4].t_max[number % 4]
    }

    /// Moves the far limit of a ray closer.
    #[inline(always)]
    pub(in crate::world) fn shorten(&mut self, number: usize, t_max: f64) {
        self.packets[number / 4].t_max[number % 4] = t_max;
    }
}

impl RayPacket4 {
    const NONE: RayPacket4 = RayPacket4 {
        origin: [[0.0; 4]; 3],
        dir: [[0.0; 4]; 3],
        t_min: [0.0; 4],
        t_max: [0.0; 4],
        origin_leaf: [NO_LEAF; 4],
        goes_out: 0,
    };

    /// Rays from one point in these directions.
    #[inline(always)]
    pub(super) fn from_point(point: DVec3, dirs: &[DVec3; 4]) -> RayPacket4 {
        let mut rays = RayPacket4::NONE;
        for axis in 0..3 {
            rays.origin[axis] = [point[axis]; 4];
            for (lane, dir) in dirs.iter().enumerate() {
                rays.dir[axis][lane] = dir[axis];
            }
        }
        rays
    }

    /// One of the rays.
    #[inline(always)]
    pub(in crate::world) fn ray(&self, lane: usize) -> Ray {
        let one_of = |of: &[[f64; 4]; 3]| DVec3::new(of[0][lane], of[1][lane], of[2][lane]);
        Ray::new(one_of(&self.origin), one_of(&self.dir))
    }

    /// The rays, in lanes.
    #[inline(always)]
    pub(in crate::world) fn load<F: F64Lanes>(&self) -> RayPacket<F> {
        RayPacket {
            origin: from_arrays(&self.origin),
            dir: from_arrays(&self.dir),
        }
    }

    /// Mask of the rays that start on this leaf.
    #[inline(always)]
    pub(in crate::world) fn start_on(&self, leaf: u32) -> u32 {
        let mut bits = 0;
        for (lane, origin_leaf) in self.origin_leaf.iter().enumerate() {
            bits |= u32::from(*origin_leaf == leaf) << lane;
        }
        bits
    }
}
