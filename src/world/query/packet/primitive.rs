//! Packets of four rays and a primitive: bit for bit the hits of single rays.

use super::bundle::StreamPacket;
use super::csg_packet::may_be_self_hit;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{Crossing, RayPacket, Root};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::primitive::Leaf;
use crate::world::ray::Query;

/// A ray packet and a primitive.
pub(super) struct PrimitivePacket<'a, const ANY: bool> {
    pub(super) leaf: &'a Leaf,
    pub(super) rays: &'a RayPacket4,
    /// Masks of the lanes that start on an entering root of the primitive, and on a leaving one.
    pub(super) origin_masks: [u32; 2],
    /// Mask of the active lanes.
    pub(super) active: u32,
}

/// The first roots of four rays.
pub(super) struct NearestRoots {
    t: [f64; 4],
    pub(super) exit_mask: u32,
    pub(super) hit_mask: u32,
    pub(super) unknown: u32,
}

impl<const ANY: bool> SimdKernel for PrimitivePacket<'_, ANY> {
    type Output = NearestRoots;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> NearestRoots {
        let mut rays: RayPacket<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        let (from, far) = (
            F::from_array(&self.rays.t_min),
            F::from_array(&self.rays.t_max),
        );
        let nearest = self.leaf.shape.nearest_packet::<F, ANY>(
            &rays,
            from,
            far,
            self.origin_masks,
            self.active,
        );
        NearestRoots {
            t: nearest.t.to_array(),
            exit_mask: nearest.exit_mask,
            hit_mask: nearest.hit_mask,
            unknown: nearest.unknown,
        }
    }
}

/// Computes the mask of the rays that have exited a convex leaf for good.
pub(super) struct ExitedLanes<'a> {
    pub(super) leaf: &'a Leaf,
    pub(super) rays: &'a RayPacket4,
}

impl SimdKernel for ExitedLanes<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> u32 {
        let mut rays: RayPacket<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        F::bitmask(self.leaf.shape.is_exiting_packet(&rays))
    }
}

impl World {
    /// Intersects four rays, which start at index `start`, with a primitive up to and including their far limits, and
    /// calls `take` for each ray that hits. With `ANY` (occlusion) the distance may be that of any point in the solid, not
    /// the first root. Returns the lanes that need the scalar path.
    #[inline(always)]
    pub(in crate::world) fn packet4_primitive<const ANY: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        packet: StreamPacket,
        query: impl Fn(usize) -> Query,
        roots: &mut Vec<Root>,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let StreamPacket {
            stream,
            start,
            mut active,
        } = packet;
        let rays = stream.packet(start);
        let from = rays.t_min;
        let leaf = &self.model.leaves[number as usize];
        let mut unclear = 0;
        let mut packet = PrimitivePacket::<ANY> {
            leaf,
            rays,
            origin_masks: [0, 0],
            active,
        };
        let mut own = rays.start_on(number) & active;
        let handles_exits = leaf.shape.has_exiting_packet();
        if own & rays.goes_out != 0 && handles_exits {
            let gone = own & rays.goes_out & lanes.run(ExitedLanes { leaf, rays });
            active &= !gone;
            own &= !gone;
        }
        while own != 0 {
            let lane = own.trailing_zeros() as usize % 4;
            own &= own - 1;
            let query = query(start + lane);
            if let Some(origin) = &query.origin_surface {
                let is_plain = origin.face == 0 && origin.crossing != Crossing::Touch;
                let leaves = origin.normal.dot(query.ray.dir) > 0.0;
                if leaves && !handles_exits && leaf.is_exiting(&query.ray) {
                    active &= !(1 << lane);
                    continue;
                }
                packet.origin_masks[usize::from(leaves)] |= 1 << lane;
                unclear |= u32::from(!is_plain) << lane;
            }
        }
        if active == 0 {
            return 0;
        }
        packet.active = active;
        let hits = lanes.run(packet);
        let mut unknown = (hits.unknown | unclear) & active;
        let mut hit_mask = hits.hit_mask & active & !unknown;
        while hit_mask != 0 {
            let lane = hit_mask.trailing_zeros() as usize % 4;
            hit_mask &= hit_mask - 1;
            if may_be_self_hit(from[lane], hits.t[lane]) {
                unknown |= 1 << lane;
                continue;
            }
            let root = if !ANY && leaf.shape.has_faces() {
                let ray = query(start + lane).ray;
                let Some(root) = leaf.root_at(&ray, hits.t[lane], roots) else {
                    unknown |= 1 << lane;
                    continue;
                };
                root
            } else {
                Root::on_smooth(hits.t[lane], hits.exit_mask >> lane & 1 == 1)
            };
            let surface = leaf.surface;
            take(
                stream,
                start + lane,
                RawHit {
                    root,
                    leaf: number,
                    surface,
                },
            );
        }
        unknown
    }
}
