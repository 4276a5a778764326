//! Streams of up to eight rays with arbitrary origins and directions. Each node is tested against every ray that
//! reaches it, so that an item is visited once with all rays that may hit it. Rays with a common origin and similar
//! directions are better traversed as a [`super::Bundle`].

use super::bundle::NewEnds;
use super::node::{Child, ChildKind, FrameRay, WIDTH, min_f32};
use super::{Bvh, Pending, Stack, nearest_child};
use crate::base::math::Ray;
use crate::base::math::simd::SimdLevel;

/// Maximum number of rays of a stream.
pub(crate) const MAX_STREAM_RAYS: usize = 8;

/// The boxes of a node that some rays may hit.
struct NodeHits {
    /// The smallest parameter at which a ray enters each box.
    enter: [f32; WIDTH],
    /// For each ray a byte, with a bit for each box that it may hit.
    hits: u64,
    /// Mask of the boxes that any ray may hit.
    boxes: u32,
}

impl NodeHits {
    const NONE: NodeHits = NodeHits {
        enter: [f32::INFINITY; WIDTH],
        hits: 0,
        boxes: 0,
    };

    /// Adds the boxes that one ray may hit, and where it enters them.
    #[inline(always)]
    fn add_ray(&mut self, lane: usize, enter: [f32; WIDTH], hits: u32) {
        self.boxes |= hits;
        self.hits |= u64::from(hits) << (8 * lane);
        // Most rays hit few of the boxes.
        let mut left = hits;
        while left != 0 {
            let slot = left.trailing_zeros() as usize % WIDTH;
            left &= left - 1;
            self.enter[slot] = min_f32(enter[slot], self.enter[slot]);
        }
    }

    /// Mask of the rays that may hit a box.
    #[inline(always)]
    fn rays(&self, slot: usize) -> u32 {
        /// The lowest bit of each byte.
        const ONE_OF_EACH: u64 = 0x0101_0101_0101_0101;
        /// Moves the lowest bit of byte `i` to bit `56 + i`; no two products fall on one bit.
        const GATHER: u64 = 0x0102_0408_1020_4080;
        let [.., rays] = (self.hits >> slot & ONE_OF_EACH)
            .wrapping_mul(GATHER)
            .to_le_bytes();
        u32::from(rays)
    }
}

impl Bvh {
    /// Visits, roughly front to back, items with the rays that may hit them from their starts to their ends, both
    /// included. `ray` gives one of up to eight rays and its end, `active` has a bit for each ray to be traversed.
    /// `visit` gets the item and a mask of the rays to be intersected, and sets new ends.
    #[inline(always)]
    pub(crate) fn traverse_stream(
        &self,
        lanes: SimdLevel,
        active: u32,
        ray: impl Fn(usize) -> (Ray, f64),
        mut visit: impl FnMut(u32, u32, &mut NewEnds),
    ) {
        let mut rays = [FrameRay::BLIND; MAX_STREAM_RAYS];
        let (mut from, mut to) = ([0.0; MAX_STREAM_RAYS], [f32::NEG_INFINITY; MAX_STREAM_RAYS]);
        for lane in set_bits(active) {
            let (ray, end) = ray(lane);
            rays[lane] = self.frame.ray(&ray);
            from[lane] = rays[lane].from(0.0);
            to[lane] = rays[lane].to(end);
        }
        let mut alive = active;
        let mut farthest = to.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let mut pending: Stack<Pending<(Child, u32)>> = Stack::new();
        let mut next = self.root.map(|root| (root, active));
        while let Some((child, active)) = next {
            let active = active & alive;
            next = match child.kind() {
                _ if active == 0 => None,
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    let mut node_hits = NodeHits::NONE;
                    for lane in set_bits(active) {
                        let (enter, hits) =
                            node.intersect(lanes, &rays[lane], from[lane], to[lane]);
                        node_hits.add_ray(lane, enter, hits);
                    }
                    let bottom = pending.reserve();
                    let child_at = |slot: usize| Some((node.child(slot)?, node_hits.rays(slot)));
                    nearest_child(
                        &node_hits.enter,
                        node_hits.boxes,
                        &mut pending,
                        bottom,
                        child_at,
                    )
                }
                ChildKind::Leaf(number) => {
                    let leaf = &self.sphere_leaves[number as usize];
                    let mut node_hits = NodeHits::NONE;
                    for lane in set_bits(active) {
                        let (enter, hits) =
                            leaf.intersect(lanes, &rays[lane], from[lane], to[lane]);
                        node_hits.add_ray(lane, enter, hits);
                    }
                    let bottom = pending.reserve();
                    let first = self.first_items[number as usize];
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let child_at = |slot: usize| {
                        Some((Child::of_item(first + slot as u32), node_hits.rays(slot)))
                    };
                    nearest_child(
                        &node_hits.enter,
                        node_hits.boxes,
                        &mut pending,
                        bottom,
                        child_at,
                    )
                }
                ChildKind::Item(item) => {
                    let mut new_ends = NewEnds::default();
                    visit(item, active, &mut new_ends);
                    new_ends.each(|lane, end| {
                        to[lane] = rays[lane].to(end);
                        if end < 0.0 {
                            to[lane] = f32::NEG_INFINITY;
                            alive &= !(1 << lane);
                        }
                        farthest = to.iter().copied().fold(f32::NEG_INFINITY, f32::max);
                    });
                    None
                }
            };
            while next.is_none()
                && let Some(entry) = pending.pop()
            {
                next = (entry.enter <= farthest).then_some(entry.child);
            }
        }
    }
}

/// The indices of the bits that are set.
#[inline(always)]
fn set_bits(bits: u32) -> impl Iterator<Item = usize> {
    (0..MAX_STREAM_RAYS).filter(move |lane| bits >> lane & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::rounding::nearest;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn boxes_get_the_rays_that_hit_them_and_the_first_entry() {
        let mut rng = Random::new(6);
        for _ in 0..2000 {
            let mut node_hits = NodeHits::NONE;
            let mut rays = Vec::new();
            for lane in 0..MAX_STREAM_RAYS {
                let mut bit = |slot: usize| u32::from(rng.uniform() < 0.4) << slot;
                let hits = (0..WIDTH).fold(0, |hits, slot| hits | bit(slot));
                let enter: [f32; WIDTH] = std::array::from_fn(|_| nearest(rng.uniform()));
                node_hits.add_ray(lane, enter, hits);
                rays.push((enter, hits));
            }
            for slot in 0..WIDTH {
                let is_hit = |ray: &&([f32; WIDTH], u32)| ray.1 >> slot & 1 == 1;
                let entries = rays.iter().filter(is_hit).map(|ray| ray.0[slot]);
                let first = entries.fold(f32::INFINITY, f32::min);
                assert_eq!(node_hits.enter[slot], first);
                let lanes = (0..MAX_STREAM_RAYS).filter(|&lane| is_hit(&&rays[lane]));
                let mask = lanes.fold(0, |mask, lane| mask | 1 << lane);
                assert_eq!(node_hits.rays(slot), mask);
                assert_eq!(node_hits.boxes >> slot & 1 == 1, mask != 0);
            }
        }
    }
}
