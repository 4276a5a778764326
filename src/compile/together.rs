//! Questions of many rays from one point, answered together: the same answers as one by one, to the bit.

use super::csg::Found;
use super::model::Item;
use super::order::Numbered;
use super::query::{Best, Hit, Query, Scratch, Way};
use super::world::World;
use crate::math::lanes::with_widest;
use glam::DVec3;
use smallvec::SmallVec;

/// What some of eight rays meet.
type FoundOfFours = SmallVec<[(usize, Found); 8]>;

/// Calls `visit` with the place of each bit that is set.
#[inline(always)]
fn each_bit(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl World {
    /// The nearest visible surface on each of these rays, which start at the same point and lie in an order in which
    /// neighbours differ little, added to `hits`.
    pub fn nearest_of(
        &self,
        queries: &[Query],
        scratch: &mut Scratch,
        hits: &mut Vec<Option<Hit>>,
    ) {
        let Some(first) = queries.first() else {
            return;
        };
        let origin = first.ray.origin;
        queries.iter().for_each(|query| scratch.rays.count(query));
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut bests = std::mem::take(&mut scratch.bests);
        let mut found = FoundOfFours::new();
        bests.clear();
        with_widest(
            #[inline(always)]
            || {
                for query in queries {
                    let mut best = None;
                    let mut far = query.far;
                    for &item in &self.finder().unbounded {
                        far = self.try_item(item, query, far, &mut best, scratch);
                    }
                    bests.push(best);
                }
                let far = |number: usize, bests: &[Option<Best>]| {
                    bests[number].map_or(queries[number].far, |best| best.found.root.t)
                };
                let rays =
                    (0..queries.len()).map(|number| (queries[number].ray.dir, far(number, &bests)));
                if !bundle.fill(&self.finder().tree, origin, rays) {
                    for (query, best) in queries.iter().zip(&mut bests) {
                        self.nearest_bounded(query, best, scratch);
                    }
                    return;
                }
                let is_done = self.finder().tree.together(
                    &mut bundle,
                    #[inline(always)]
                    |number, first, lanes, ended| {
                        let item = self.finder().bounded[number as usize];
                        let lanes = self.in_fours(
                            item,
                            (queries, first, lanes),
                            |ray| far(ray, &bests),
                            scratch,
                            &mut found,
                        );
                        for &(ray, found) in &found {
                            let old = far(ray, &bests);
                            let new =
                                self.offer(item.number, found, &queries[ray], old, &mut bests[ray]);
                            if new < old {
                                ended.note(ray - first, new);
                            }
                        }
                        each_bit(lanes, |lane| {
                            let ray = first + lane;
                            let old = far(ray, &bests);
                            let best = &mut bests[ray];
                            let new = self.try_item(item, &queries[ray], old, best, scratch);
                            if new < old {
                                ended.note(lane, new);
                            }
                        });
                    },
                );
                if !is_done {
                    for (query, best) in queries.iter().zip(&mut bests) {
                        self.nearest_bounded(query, best, scratch);
                    }
                }
            },
        );
        let found = queries.iter().zip(&bests);
        hits.extend(found.map(|(query, best)| best.map(|best| self.hit(query, &best.found))));
        scratch.bundle = bundle;
        scratch.bests = bests;
    }

    /// What lies on each of these rays to the light of this number at `centre`, in an order in which neighbours differ
    /// little, added to `ways`. Says whether it was of use to ask together.
    pub fn ways_of(
        &self,
        queries: &[Query],
        centre: DVec3,
        light: u32,
        scratch: &mut Scratch,
        ways: &mut Vec<Way>,
    ) -> bool {
        let first = ways.len();
        let mut found = FoundOfFours::new();
        scratch.rays.shadow += queries.len() as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let was_of_use = with_widest(
            #[inline(always)]
            || {
                for query in queries {
                    let mut way = Way::Free;
                    let mut unbounded = self.finder().unbounded.iter();
                    if unbounded.any(|&item| self.blocks(item, query, &mut way, scratch)) {
                        way = Way::Blocked;
                    }
                    ways.push(way);
                }
                let ways = &mut ways[first..];
                let rays = queries.iter().zip(ways.iter()).map(|(query, way)| {
                    let end = if *way == Way::Blocked {
                        f64::NEG_INFINITY
                    } else {
                        (centre - query.ray.origin).length()
                    };
                    (-query.ray.dir, end)
                });
                if !bundle.fill(&self.finder().tree, centre, rays) {
                    self.find_ways(queries, light, scratch, ways);
                    return false;
                }
                let is_done = self.finder().tree.together(
                    &mut bundle,
                    #[inline(always)]
                    |number, first, lanes, ended| {
                        let item = self.finder().bounded[number as usize];
                        let lanes = self.in_fours(
                            item,
                            (queries, first, lanes),
                            |ray| queries[ray].far,
                            scratch,
                            &mut found,
                        );
                        for &(ray, found) in &found {
                            if found.root.t < queries[ray].far {
                                ways[ray] = Way::Blocked;
                                ended.note(ray - first, f64::NEG_INFINITY);
                            }
                        }
                        each_bit(lanes, |lane| {
                            let way = &mut ways[first + lane];
                            if self.blocks(item, &queries[first + lane], way, scratch) {
                                *way = Way::Blocked;
                                ended.note(lane, f64::NEG_INFINITY);
                            }
                        });
                    },
                );
                if !is_done {
                    self.find_ways(queries, light, scratch, ways);
                }
                is_done
            },
        );
        scratch.bundle = bundle;
        was_of_use
    }

    /// Asks about an item by four rays at a time, where that goes, those of `lanes` from the first ray on. Gives the rays
    /// that must still be asked for singly, and in `found` what the others meet.
    #[inline(always)]
    fn in_fours(
        &self,
        item: Numbered,
        (queries, first, lanes): (&[Query], usize, u32),
        far: impl Fn(usize) -> f64,
        scratch: &mut Scratch,
        found: &mut FoundOfFours,
    ) -> u32 {
        found.clear();
        if lanes.is_power_of_two() || !self.suits_four(item.item, queries[first].seen) {
            return lanes;
        }
        let mut left = 0;
        for half in [0, 4] {
            let some = lanes >> half & 0b1111;
            if some == 0 || some.is_power_of_two() {
                left |= some << half;
                continue;
            }
            let start = first + half;
            let end = (start + 4).min(queries.len());
            let asked = (&queries[start..end], some);
            let far = |lane| far(start + lane);
            let take = |lane, of_lane| found.push((start + lane, of_lane));
            let unknown = match item.item {
                Item::Program(program) => self.ask_four(program, asked, far, scratch, take),
                Item::Leaf(leaf) => self.ask_four_of_leaf(leaf, asked, far, take),
                Item::Instance(_) => some,
            };
            left |= unknown << half;
        }
        left
    }

    /// What lies on each ray that is not known to be blocked, one ray at a time.
    #[inline(always)]
    fn find_ways(&self, queries: &[Query], light: u32, scratch: &mut Scratch, ways: &mut [Way]) {
        for (query, way) in queries.iter().zip(ways) {
            if *way != Way::Blocked {
                *way = self.way_found(query, light, scratch);
            }
        }
    }
}
