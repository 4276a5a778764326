//! CSG programs for packets of four rays.
//!
//! With few operands sorting does not pay. A surface is shown where the ray is inside all solids to be intersected and
//! outside all those subtracted; each end of a span is tested against the other spans (Roth 1982, inverted: all ends,
//! all spans, no order). Where two ends may coincide, and where a shape is in doubt, the ray takes the scalar path: so the
//! hits are those of [`CsgProgram::nearest`], bit for bit.
//!
//! A program of many operands is reduced to those whose boxes some of the four rays hit, by the BVH over them: the
//! others contain none of the rays. This module handles intersections; nested operations are in [`super::csg_tree`].

use super::bundle::StreamPacket;
use super::csg_packet::{CsgPacket, CsgPacketHits, may_be_self_hit};
use super::csg_tree::CsgTreePacket;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::SimdLevel;
use crate::scene::shape::{Crossing, Root};
use crate::world::compiled::World;
use crate::world::csg::packet_strategy::{Numbers, PacketStrategy};
use crate::world::csg::program::CsgProgram;
use crate::world::csg::sweep::{RawHit, SweepContext, hide_departure};
use crate::world::primitive::Leaf;
use crate::world::query::QueryScratch;
use crate::world::ray::Query;

impl CsgProgram {
    /// Hits of the active lanes by the selected algorithm. Not inlined: it is large with many call sites, and
    /// would take as long to compile as all the rest.
    #[inline(never)]
    fn intersect_packet4(
        &self,
        lanes: SimdLevel,
        strategy: PacketStrategy,
        leaves: &[Leaf],
        rays: &RayPacket4,
        active: u32,
    ) -> CsgPacketHits {
        let mut others = Numbers::new();
        let mut packet = CsgPacket {
            program: self,
            leaves,
            rays,
            active,
            others: &[],
        };
        if strategy == PacketStrategy::Scalar || packet.gather(lanes, &mut others).is_none() {
            return CsgPacketHits {
                unknown: active,
                ..CsgPacketHits::NOTHING
            };
        }
        if packet.active == 0 {
            return CsgPacketHits::NOTHING;
        }
        packet.others = &others;
        match strategy {
            PacketStrategy::Tree => lanes.run(CsgTreePacket(packet)),
            PacketStrategy::Intersection | PacketStrategy::Scalar => lanes.run(packet),
        }
    }
}

impl World {
    /// Intersects four rays, which start at index `start`, with a CSG program up to and including their far limits:
    /// calls `take` with the index of each ray that hits it. Returns the lanes that need the scalar path. Unless
    /// `NEEDS_FACE`, only the distance of a root is set.
    #[inline(always)]
    pub(in crate::world) fn packet4_program<const NEEDS_FACE: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        packet: StreamPacket,
        query: impl Fn(usize) -> Query,
        scratch: &mut QueryScratch,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let StreamPacket {
            stream,
            start,
            active,
        } = packet;
        let rays = stream.packet(start);
        let (from, origin_leaf) = (rays.t_min, rays.origin_leaf);
        let program = &self.model.programs[number as usize];
        let strategy = self.model.packet_strategy(number);
        let mut hits = program.intersect_packet4(lanes, strategy, &self.model.leaves, rays, active);
        let mut hit_mask = hits.hit_mask;
        while hit_mask != 0 {
            let lane = hit_mask.trailing_zeros() as usize % 4;
            hit_mask &= hit_mask - 1;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let operand = hits.operand[lane] as u32;
            let leaf = program.first + operand;
            let ray = query(start + lane).ray;
            let context = SweepContext {
                is_shadow: !NEEDS_FACE,
                ..SweepContext::free(&self.model.leaves, &ray)
            };
            if !program.shows(operand, context, &mut scratch.sweep) {
                hits.unknown |= 1 << lane;
                continue;
            }
            // The scalar path decides about self-intersections, and searches behind them.
            if may_be_self_hit(from[lane], hits.t[lane]) {
                hits.unknown |= 1 << lane;
                continue;
            }
            // The root that the ray starts on does not count; the scalar path searches behind it.
            if origin_leaf[lane] == leaf
                && self.spawn_t(&query(start + lane), scratch) == hits.t[lane]
            {
                hits.unknown |= 1 << lane;
                continue;
            }
            let hit_leaf = &self.model.leaves[leaf as usize];
            let surface = hit_leaf.surface;
            if !NEEDS_FACE {
                let root = Root {
                    t: hits.t[lane],
                    crossing: Crossing::Touch,
                    face: 0,
                    is_visible: true,
                };
                take(
                    stream,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                );
                continue;
            }
            match hit_leaf.root_at(&ray, hits.t[lane], &mut scratch.roots) {
                Some(root) => take(
                    stream,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                ),
                None => hits.unknown |= 1 << lane,
            }
        }
        hits.unknown
    }

    /// Distance of the root that the ray starts on, on a part of a CSG program; NaN if it starts on none.
    #[inline(never)]
    fn spawn_t(&self, query: &Query, scratch: &mut QueryScratch) -> f64 {
        let Some(origin) = &query.origin_surface else {
            return f64::NAN;
        };
        let leaf = &self.model.leaves[origin.leaf as usize];
        let roots = &mut scratch.roots;
        roots.clear();
        leaf.roots(&query.ray, roots);
        hide_departure(roots, origin, leaf, query.ray.dir);
        let hidden = roots.iter().find(|root| !root.is_visible);
        hidden.map_or(f64::NAN, |root| root.t)
    }
}

#[cfg(test)]
mod tests {
    use super::super::hits::HitPacket4;
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::world::csg::packet_strategy::MAX_NODES;
    use crate::world::csg::program::Combine;
    use crate::world::csg::simplify::tests::{coarse, random_parts, random_program};
    use crate::world::csg::sweep::{RayInterval, Sweep};
    use glam::DVec3;

    #[test]
    fn packets_hit_what_single_rays_hit() {
        let mut rng = Random::new(77);
        let (mut sweep, mut stream) = (Sweep::default(), RayStream::default());
        let mut known = [[0; 2]; 2];
        let mut of_many = 0;
        for number in 0..25_000_u64 {
            let (mut program, leaves, bounds, parts) = match number.is_multiple_of(8) {
                true => random_parts(&mut rng, 1 + number / 8 % 12),
                false => {
                    let (program, leaves, bounds) = random_program(&mut rng);
                    (program, leaves, bounds, Vec::new())
                }
            };
            if let [node] = &mut program.nodes[..] {
                // One solid minus all others, or hardly anything would be shown.
                node.combine = Combine::Intersection;
                let others = program.operands.iter_mut().skip(1);
                others.for_each(|operand| operand.is_inverse = true);
            }
            program.prepare(&leaves, &bounds, parts);
            let strategy = program.packet_strategy(&leaves);
            if strategy == PacketStrategy::Scalar {
                continue;
            }
            let origin = 2.0 * coarse(&mut rng) + 0.25 * rng.vector(1.0);
            let mut hits = HitPacket4::NOTHING;
            for lane in 0..4 {
                let aim = 2.0 * rng.vector(1.0) + coarse(&mut rng);
                hits.aim(lane, (aim - origin).normalize_or(DVec3::X));
            }
            stream.load_camera_rays(origin, 0.0, &[hits]);
            let intersect = |lanes: SimdLevel| {
                program.intersect_packet4(lanes, strategy, &leaves, stream.packet(0), 0b1111)
            };
            let (wide, narrow) = (intersect(SimdLevel::widest()), intersect(SimdLevel::NARROW));
            assert_eq!(
                (wide.hit_mask, wide.unknown),
                (narrow.hit_mask, narrow.unknown)
            );
            for lane in (0..4).filter(|lane| wide.unknown >> lane & 1 == 0) {
                let interval = RayInterval::FORWARD;
                let alone = program
                    .nearest(
                        SweepContext::free(&leaves, &stream.ray(lane)),
                        interval,
                        &mut sweep,
                        |_| true,
                    )
                    .map(|raw_hit| (raw_hit.root.t, f64::from(raw_hit.leaf)));
                let together = |hits: &CsgPacketHits| {
                    let is_hit = hits.hit_mask >> lane & 1 == 1;
                    is_hit.then(|| (hits.t[lane], hits.operand[lane]))
                };
                assert_eq!(together(&wide), alone, "{program:?}");
                assert_eq!(together(&narrow), alone, "{program:?}");
                let is_cut = usize::from(program.order.boxed.is_some());
                known[usize::from(strategy == PacketStrategy::Tree)][is_cut] +=
                    usize::from(alone.is_some());
                of_many += usize::from(program.nodes.len() > MAX_NODES && alone.is_some());
            }
        }
        assert!(
            known.as_flattened().iter().all(|&known| known > 100) && of_many > 100,
            "{known:?} {of_many}"
        );
    }
}
