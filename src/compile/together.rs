//! Questions of many rays from one point, answered together: the same answers as one by one, to the bit.

use super::csg::Found;
use super::lot::Lot;
use super::model::Item;
use super::order::Numbered;
use super::query::{Hit, Query, Scratch, Seen, Way};
use super::world::World;
use crate::accel::Ended;
use crate::math::Ray;
use crate::math::lanes::{Lanes, with_widest};
use glam::DVec3;

/// Calls `visit` with the place of each bit that is set.
#[inline(always)]
pub(super) fn each_bit(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl World {
    /// The nearest visible surface on each of the camera's rays from `origin` in these unit directions, which lie in an
    /// order in which neighbours differ little, added to `hits`.
    pub fn nearest_of(
        &self,
        origin: DVec3,
        dirs: &[DVec3],
        scratch: &mut Scratch,
        hits: &mut Vec<Option<Hit>>,
    ) {
        let query = |ray: usize| Query {
            ray: Ray::new(origin, dirs[ray]),
            from: None,
            far: f64::INFINITY,
            seen: Seen::Image,
        };
        scratch.rays.camera += dirs.len() as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut bests = std::mem::take(&mut scratch.bests);
        let mut lot = std::mem::take(&mut scratch.lot);
        bests.clear();
        bests.resize(dirs.len(), None);
        with_widest(
            #[inline(always)]
            |lanes| {
                lot.fill(
                    dirs.len(),
                    query,
                    #[inline(always)]
                    |query| self.least_distance(query),
                );
                for &item in &self.finder().unbounded {
                    for (ray, best) in bests.iter_mut().enumerate() {
                        let query = &query(ray);
                        let asked = (query, &self.search_for(query));
                        let far = self.try_item(item, asked, lot.far(ray), best, scratch);
                        lot.shorten(ray, far);
                    }
                }
                let rays = dirs.iter().enumerate();
                let rays = rays.map(|(ray, dir)| (*dir, lot.far(ray)));
                let is_done = bundle.fill(&self.finder().tree, origin, rays)
                    && self.see_meshes(
                        lanes,
                        (&mut lot, &mut bests),
                        query,
                        (&mut bundle, origin),
                        scratch,
                    )
                    && self.finder().tree.together(
                        lanes,
                        &mut bundle,
                        #[inline(always)]
                        |number, first, rays, ended| {
                            let item = self.finder().bounded[number as usize];
                            if self.is_large_mesh(item) {
                                return;
                            }
                            let mut offer =
                                |lot: &mut Lot, ray: usize, found, ended: &mut Ended| {
                                    let old = lot.far(ray);
                                    let best = &mut bests[ray];
                                    let new =
                                        self.offer(item.number, found, &query(ray), old, best);
                                    if new < old {
                                        lot.shorten(ray, new);
                                        ended.note(ray - first, new);
                                    }
                                };
                            let left = self.in_fours::<true>(
                                lanes,
                                (item, Seen::Image),
                                (&mut lot, query),
                                (first, rays),
                                scratch,
                                #[inline(always)]
                                |lot, ray, found| offer(lot, ray, found, ended),
                            );
                            each_bit(left, |lane| {
                                let ray = first + lane;
                                let query = &query(ray);
                                let asked = (query, &self.search_for(query));
                                let found = self.see_item(item, asked, lot.far(ray), scratch);
                                if let Some(found) = found {
                                    offer(&mut lot, ray, found, ended);
                                }
                            });
                        },
                    );
                if !is_done {
                    for (ray, best) in bests.iter_mut().enumerate() {
                        *best = self.nearest_found(lanes, &query(ray), scratch);
                    }
                }
            },
        );
        let found = bests.iter().enumerate();
        hits.extend(
            found.map(|(ray, best)| best.map(|best| self.hit(&query(ray).ray, &best.found))),
        );
        scratch.bundle = bundle;
        scratch.bests = bests;
        scratch.lot = lot;
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
        scratch.rays.shadow += queries.len() as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut lot = std::mem::take(&mut scratch.lot);
        let was_of_use = with_widest(
            #[inline(always)]
            |lanes| {
                lot.fill(
                    queries.len(),
                    #[inline(always)]
                    |ray| queries[ray],
                    #[inline(always)]
                    |query| self.least_distance(query),
                );
                for query in queries {
                    let mut way = Way::Free;
                    let mut unbounded = self.finder().unbounded.iter();
                    let asked = (query, &self.search_for(query));
                    if unbounded.any(|&item| self.blocks(item, asked, &mut way, scratch)) {
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
                    self.find_ways(lanes, (queries, light), scratch, ways);
                    return false;
                }
                let is_done = self.meshes_block(
                    lanes,
                    (&mut lot, ways),
                    queries,
                    (&mut bundle, centre),
                    scratch,
                ) && self.finder().tree.together(
                    lanes,
                    &mut bundle,
                    #[inline(always)]
                    |number, first, rays, ended| {
                        let item = self.finder().bounded[number as usize];
                        if self.is_large_mesh(item) {
                            return;
                        }
                        let left = self.in_fours::<false>(
                            lanes,
                            (item, Seen::Shadow),
                            (&mut lot, |ray| queries[ray]),
                            (first, rays),
                            scratch,
                            #[inline(always)]
                            |lot, ray, found| {
                                if found.root.t < lot.far(ray) {
                                    ways[ray] = Way::Blocked;
                                    ended.note(ray - first, f64::NEG_INFINITY);
                                }
                            },
                        );
                        each_bit(left, |lane| {
                            let way = &mut ways[first + lane];
                            let query = &queries[first + lane];
                            let asked = (query, &self.search_for(query));
                            if self.blocks(item, asked, way, scratch) {
                                *way = Way::Blocked;
                                ended.note(lane, f64::NEG_INFINITY);
                            }
                        });
                    },
                );
                if !is_done {
                    self.find_ways(lanes, (queries, light), scratch, ways);
                }
                is_done
            },
        );
        scratch.bundle = bundle;
        scratch.lot = lot;
        was_of_use
    }

    /// Asks about an item by four rays at a time, where that goes, those of `rays` from the first on. Gives the rays
    /// that must still be asked for singly; `take` gets the number of each of the others that meets the item, and what it
    /// meets; unless `ASKS_FACE` perhaps no more than the distance.
    #[inline(always)]
    fn in_fours<const ASKS_FACE: bool>(
        &self,
        lanes: Lanes,
        (item, seen): (Numbered, Seen),
        (lot, query): (&mut Lot, impl Fn(usize) -> Query),
        (first, rays): (usize, u32),
        scratch: &mut Scratch,
        mut take: impl FnMut(&mut Lot, usize, Found),
    ) -> u32 {
        if !self.suits_four(item.item, seen) {
            return rays;
        }
        let is_for_one = |rays: u32| rays.is_power_of_two() && !self.model.suits_one(item.item);
        if is_for_one(rays) {
            return rays;
        }
        let mut left = 0;
        for half in [0, 4] {
            let some = rays >> half & 0b1111;
            if some == 0 || is_for_one(some) {
                left |= some << half;
                continue;
            }
            let start = first + half;
            let four = *lot.four(start);
            let asked = (&four, some);
            let query = |lane| query(start + lane);
            let take = |lane, found| take(lot, start + lane, found);
            let unknown = match item.item {
                Item::Program(program) => {
                    self.ask_four::<ASKS_FACE>(lanes, program, asked, query, scratch, take)
                }
                Item::Leaf(leaf) => self.ask_four_of_leaf(lanes, leaf, asked, query, take),
                Item::Instance(_) => some,
            };
            left |= unknown << half;
        }
        left
    }

    /// What lies on each ray that is not known to be blocked, one ray at a time.
    #[inline(always)]
    fn find_ways(
        &self,
        lanes: Lanes,
        (queries, light): (&[Query], u32),
        scratch: &mut Scratch,
        ways: &mut [Way],
    ) {
        for (query, way) in queries.iter().zip(ways) {
            if *way != Way::Blocked {
                *way = self.way_found(lanes, query, light, scratch);
            }
        }
    }
}
