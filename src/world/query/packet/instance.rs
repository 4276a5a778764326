//! Packets of four rays and an instance of a small union of spheres: bit for bit the hits of single rays.

use super::bundle::StreamPacket;
use super::csg_packet::may_be_self_hit;
use super::hits::NO_LEAF;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{RayPacket, Root, Shape};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::Instance;

/// A ray packet and an instance. If `ANY`, any hit ends the search.
struct InstancePacket<'a, const ANY: bool> {
    instance: &'a Instance,
    rays: &'a RayPacket4,
    /// The leaves of the instance that the rays start on; [`NO_LEAF`] for none.
    origin_leaf: [u32; 4],
    /// Mask of the active lanes.
    active: u32,
}

/// The first hits of four rays.
struct NearestInInstance {
    t: [f64; 4],
    /// The leaves, as whole numbers.
    leaf: [f64; 4],
    /// Mask of the hits where the ray leaves the sphere; it enters the others.
    leaves: u32,
    hit_mask: u32,
    /// Mask of the lanes that need the scalar path.
    unknown: u32,
}

impl<const ANY: bool> SimdKernel for InstancePacket<'_, ANY> {
    type Output = NearestInInstance;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> NearestInInstance {
        let rays: RayPacket<F> = self.rays.load();
        let rays = rays.to_object(&self.instance.object_from_world);
        let from = F::from_array(&self.rays.t_min);
        let mut far = F::from_array(&self.rays.t_max);
        let (mut t, mut leaf) = (F::splat(f64::INFINITY), F::splat(0.0));
        let (mut leaves, mut hit_mask, mut unknown) = (0, 0, 0);
        for (number, own) in (0u32..).zip(&self.instance.model.leaves) {
            let mut lanes_tested = self.active & !unknown;
            if ANY {
                lanes_tested &= !hit_mask;
            }
            if lanes_tested == 0 {
                break;
            }
            let Shape::Sphere(sphere) = &own.shape else {
                unknown = self.active;
                break;
            };
            let mut has_left = 0;
            for (lane, origin_leaf) in self.origin_leaf.iter().enumerate() {
                has_left |= u32::from(*origin_leaf == number) << lane;
            }
            has_left &= lanes_tested;
            if has_left != 0 {
                let gone = F::bitmask(sphere.is_exiting_packet(&rays)) & self.rays.goes_out;
                unknown |= has_left & !gone;
                lanes_tested &= !has_left;
            }
            let nearest = sphere.nearest_packet(&rays, from, far);
            unknown |= nearest.unknown & lanes_tested;
            let new = nearest.hit_mask & lanes_tested;
            if new == 0 {
                continue;
            }
            // Ties go to the scalar path.
            unknown |= F::bitmask(nearest.t.eq(t)) & hit_mask & new;
            let is_new = F::mask_from_bits(new);
            t = F::select(is_new, nearest.t, t);
            far = F::select(is_new, nearest.t, far);
            leaf = F::select(is_new, F::splat(f64::from(number)), leaf);
            leaves = leaves & !new | nearest.exit_mask & new;
            hit_mask |= new;
        }
        NearestInInstance {
            t: t.to_array(),
            leaf: leaf.to_array(),
            leaves,
            hit_mask,
            unknown: unknown & self.active,
        }
    }
}

impl World {
    /// Intersects four rays, which start at index `start`, with an instance of a few spheres up to and including their
    /// far limits: calls `take` with the index of each ray that hits it, with any hit if `ANY`. Returns the lanes that
    /// need the scalar path.
    #[inline(always)]
    pub(in crate::world) fn packet4_instance<const ANY: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        packet: StreamPacket,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let StreamPacket {
            stream,
            start,
            active,
        } = packet;
        let instance = &self.model.instances[number as usize];
        let rays = stream.packet(start);
        let from = rays.t_min;
        let mut origin_leaf = [NO_LEAF; 4];
        for (own, origin_leaf) in origin_leaf.iter_mut().zip(rays.origin_leaf) {
            // Leaves before the first wrap around to indices outside the instance.
            *own = origin_leaf.wrapping_sub(instance.first);
        }
        let packet = InstancePacket::<ANY> {
            instance,
            rays,
            origin_leaf,
            active,
        };
        let hits = lanes.run(packet);
        let mut unknown = hits.unknown;
        let mut hit_mask = hits.hit_mask & !unknown;
        while hit_mask != 0 {
            let lane = hit_mask.trailing_zeros() as usize % 4;
            hit_mask &= hit_mask - 1;
            if may_be_self_hit(from[lane], hits.t[lane]) {
                unknown |= 1 << lane;
                continue;
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let leaf = hits.leaf[lane] as u32;
            let root = Root::on_smooth(hits.t[lane], hits.leaves >> lane & 1 == 1);
            let surface = instance.surface + instance.model.leaves[leaf as usize].surface;
            take(
                stream,
                start + lane,
                RawHit {
                    root,
                    leaf: instance.first + leaf,
                    surface,
                },
            );
        }
        unknown
    }
}
