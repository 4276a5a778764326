//! A few rays of any origins at once: each node is tried against every ray that comes to it, so that an item is visited
//! once with all rays that may meet it. Rays that share an origin and a direction are better walked as a
//! [`super::Bundle`]; these need have nothing in common.

use super::bundle::NewEnds;
use super::node::{Child, ChildKind, FrameRay, WIDTH};
use super::{Bvh, Pending, Stack, nearest_child};
use crate::base::math::Ray;
use crate::base::math::simd::SimdLevel;

/// The most rays of a stream.
pub(crate) const STREAM: usize = 8;

/// The boxes of a node that some rays may meet.
struct NodeHits {
    /// Where the first ray enters each.
    enter: [f32; WIDTH],
    /// The rays that may meet each, one bit each.
    rays: [u32; WIDTH],
    /// Which boxes any ray may meet, one bit each.
    boxes: u32,
}

impl NodeHits {
    const NONE: NodeHits = NodeHits {
        enter: [f32::INFINITY; WIDTH],
        rays: [0; WIDTH],
        boxes: 0,
    };

    /// Takes in where one ray enters the boxes that it may meet.
    #[inline(always)]
    fn by(&mut self, lane: usize, (enter, met): ([f32; WIDTH], u32)) {
        self.boxes |= met;
        let boxes = enter.iter().zip(&mut self.enter).zip(&mut self.rays);
        for (place, ((enter, first), rays)) in boxes.enumerate() {
            let is_met = met >> place & 1;
            *rays |= is_met << lane;
            if is_met == 1 && enter < first {
                *first = *enter;
            }
        }
    }
}

impl Bvh {
    /// Visits, roughly front to back, items with the rays that may meet them from their starts to their ends, both
    /// included. `ray` gives one of up to eight rays and its end, `asked` has a bit for each ray that is to be followed.
    /// `visit` gets the item and the rays to be asked, one bit each, and notes new ends.
    #[inline(always)]
    pub(crate) fn stream(
        &self,
        lanes: SimdLevel,
        asked: u32,
        ray: impl Fn(usize) -> (Ray, f64),
        mut visit: impl FnMut(u32, u32, &mut NewEnds),
    ) {
        let mut rays = [FrameRay::BLIND; STREAM];
        let (mut from, mut to) = ([0.0; STREAM], [f32::NEG_INFINITY; STREAM]);
        for lane in lanes_of(asked) {
            let (ray, end) = ray(lane);
            rays[lane] = self.frame.ray(&ray);
            from[lane] = rays[lane].from(0.0);
            to[lane] = rays[lane].to(end);
        }
        let mut alive = asked;
        let mut farthest = to.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let mut pending: Stack<Pending<(Child, u32)>> = Stack::new();
        let mut next = self.root.map(|root| (root, asked));
        while let Some((child, asked)) = next {
            let asked = asked & alive;
            next = match child.kind() {
                _ if asked == 0 => None,
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    let mut met = NodeHits::NONE;
                    for lane in lanes_of(asked) {
                        met.by(lane, node.meet(lanes, &rays[lane], (from[lane], to[lane])));
                    }
                    let bottom = pending.make_room();
                    let name = |place: usize| Some((node.child(place)?, met.rays[place]));
                    nearest_child((&met.enter, met.boxes), (&mut pending, bottom), name)
                }
                ChildKind::Block(number) => {
                    let block = &self.blocks[number as usize];
                    let mut met = NodeHits::NONE;
                    for lane in lanes_of(asked) {
                        met.by(lane, block.meet(lanes, &rays[lane], (from[lane], to[lane])));
                    }
                    let bottom = pending.make_room();
                    let first = self.firsts[number as usize];
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let name = |place: usize| {
                        Some((Child::of_item(first + place as u32), met.rays[place]))
                    };
                    nearest_child((&met.enter, met.boxes), (&mut pending, bottom), name)
                }
                ChildKind::Item(item) => {
                    let mut ended = NewEnds::default();
                    visit(item, asked, &mut ended);
                    ended.each(|lane, end| {
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
                && let Some(place) = pending.pop()
            {
                next = (place.enter <= farthest).then_some(place.child);
            }
        }
    }
}

/// The numbers of the bits that are set.
#[inline(always)]
fn lanes_of(bits: u32) -> impl Iterator<Item = usize> {
    (0..STREAM).filter(move |lane| bits >> lane & 1 == 1)
}
