//! Questions of many rays from one point, answered together: the same answers as one by one, to the bit.

use super::csg::Found;
use super::hits::{FourHits, FourWays};
use super::lot::Lot;
use super::model::Item;
use super::order::Numbered;
use super::query::{Best, Query, Scratch, Seen, Way};
use super::world::World;
use crate::accel::{Bundle, Ended, STREAM};
use crate::math::Ray;
use crate::math::lanes::{Lanes, with_widest};
use glam::DVec3;
use smallvec::{SmallVec, smallvec};

/// Calls `visit` with the place of each bit that is set.
#[inline(always)]
pub(super) fn each_bit(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl World {
    /// Notes the nearest visible surface on each of the first `count` of the camera's rays from `origin`, which lie in an
    /// order in which neighbours differ little; behind the last of them some ray stands again.
    pub fn see(&self, origin: DVec3, count: usize, hits: &mut [FourHits], scratch: &mut Scratch) {
        scratch.rays.camera += count as u64;
        if let Some(vista) = &self.vistas.camera {
            self.see_around(vista, (origin, count), hits, scratch);
            return;
        }
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut bests = std::mem::take(&mut scratch.bests);
        let mut lot = std::mem::take(&mut scratch.lot);
        bests.clear();
        bests.resize(count, None);
        with_widest(
            #[inline(always)]
            |lanes| {
                let rays = &*hits;
                let query = |ray: usize| Query {
                    ray: Ray::new(origin, rays[ray / 4].dir(ray % 4)),
                    from: None,
                    far: f64::INFINITY,
                    seen: Seen::Image,
                };
                lot.look(origin, self.least_distance(&query(0)), rays);
                for &item in &self.finder().unbounded {
                    for first in (0..count).step_by(8) {
                        let rays = 0xff >> (8 - (count - first).min(8));
                        let asked = ((item, Seen::Image), (first, rays), &query);
                        let ended = &mut Ended::default();
                        self.see_by(lanes, asked, (&mut lot, &mut bests), ended, scratch);
                    }
                }
                let is_done = bundle.fill(
                    &self.finder().tree,
                    origin,
                    count,
                    #[inline(always)]
                    |four| (rays[four].dir, lot.four(4 * four).far),
                ) && self.see_meshes(
                    lanes,
                    (&mut lot, &mut bests),
                    query,
                    (&mut bundle, origin),
                    scratch,
                ) && self.finder().tree.together(
                    lanes,
                    &mut bundle,
                    #[inline(always)]
                    |number, first, rays, ended| {
                        let item = self.finder().bounded[number as usize];
                        if !self.is_large_mesh(item) {
                            let asked = ((item, Seen::Image), (first, rays), &query);
                            self.see_by(lanes, asked, (&mut lot, &mut bests), ended, scratch);
                        }
                    },
                );
                if !is_done {
                    for (ray, best) in bests.iter_mut().enumerate() {
                        *best = self.nearest_found(lanes, &query(ray), scratch);
                    }
                }
                let origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
                for (bests, hits) in bests.chunks(4).zip(hits) {
                    self.note_hits(lanes, &origin, bests, hits);
                }
            },
        );
        scratch.bundle = bundle;
        scratch.bests = bests;
        scratch.lot = lot;
    }

    /// What lies on the ways from hits at these places to a light at `centre`, in an order in which
    /// neighbours differ little, added to `ways`. Says whether it was of use to ask together.
    pub fn ways_of(
        &self,
        places: &[u16],
        (hits, to_light): (&[FourHits], &[FourWays]),
        centre: DVec3,
        scratch: &mut Scratch,
        ways: &mut Vec<Way>,
    ) -> bool {
        let first = ways.len();
        scratch.rays.shadow += places.len() as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut lot = std::mem::take(&mut scratch.lot);
        let query = |ray: usize| {
            let place = usize::from(places[ray]);
            to_light[place / 4].query(&hits[place / 4], place % 4)
        };
        let was_of_use = with_widest(
            #[inline(always)]
            |lanes| {
                lot.shine(
                    places,
                    (hits, to_light),
                    #[inline(always)]
                    |blur| self.least_from(Some(blur), Seen::Shadow),
                );
                ways.resize(first + places.len(), Way::Free);
                let ways = &mut ways[first..];
                self.block_by_unbounded(lanes, &query, (&mut lot, ways), scratch);
                let is_bundled = bundle.fill(
                    &self.finder().tree,
                    centre,
                    places.len(),
                    #[inline(always)]
                    |four| {
                        let dir = lot.dirs(four);
                        let mut back = [[0.0; 4]; 3];
                        for axis in 0..3 {
                            for lane in 0..4 {
                                back[axis][lane] = -dir[axis][lane];
                            }
                        }
                        let mut end = [f64::NEG_INFINITY; 4];
                        for (lane, way) in ways[4 * four..].iter().take(4).enumerate() {
                            if *way != Way::Blocked {
                                let place = usize::from(places[4 * four + lane]);
                                end[lane] = to_light[place / 4].distance[place % 4];
                            }
                        }
                        (back, end)
                    },
                );
                if !is_bundled {
                    self.block_streams(lanes, &query, (&mut lot, ways), scratch);
                    return false;
                }
                let is_done = self.meshes_block(
                    lanes,
                    (&mut lot, ways),
                    query,
                    (&mut bundle, centre),
                    scratch,
                ) && self.block_by_bounded(
                    lanes,
                    &query,
                    (&mut lot, ways),
                    &mut bundle,
                    scratch,
                );
                if !is_done {
                    self.block_streams(lanes, &query, (&mut lot, ways), scratch);
                }
                is_done
            },
        );
        scratch.bundle = bundle;
        scratch.lot = lot;
        was_of_use
    }

    /// Tells whether [`World::ways_from`] is of use.
    #[must_use]
    pub fn asks_from_points(&self) -> bool {
        self.meshes.is_empty()
    }

    /// Notes what lies on the first `count` of the ways from one hit to places of a light. Each of the four is that hit; behind the last way some way stands again.
    pub fn ways_from(
        &self,
        hits: &FourHits,
        (to_light, count): (&mut [FourWays], usize),
        scratch: &mut Scratch,
    ) {
        scratch.rays.shadow += count as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut lot = std::mem::take(&mut scratch.lot);
        let mut ways: SmallVec<[Way; 16]> = smallvec![Way::Free; count];
        let asked = &*to_light;
        let query = |ray: usize| asked[ray / 4].query(hits, ray % 4);
        with_widest(
            #[inline(always)]
            |lanes| {
                lot.shine_from(
                    hits,
                    asked,
                    #[inline(always)]
                    |blur| self.least_from(Some(blur), Seen::Shadow),
                );
                self.block_by_unbounded(lanes, &query, (&mut lot, &mut ways), scratch);
                let is_bundled = bundle.fill(
                    &self.finder().tree,
                    hits.point(0),
                    count,
                    #[inline(always)]
                    |four| {
                        let mut end = [f64::NEG_INFINITY; 4];
                        for (lane, way) in ways[4 * four..].iter().take(4).enumerate() {
                            if *way != Way::Blocked {
                                end[lane] = asked[four].distance[lane];
                            }
                        }
                        (*lot.dirs(four), end)
                    },
                );
                let is_done = is_bundled
                    && self.block_by_bounded(
                        lanes,
                        &query,
                        (&mut lot, &mut ways),
                        &mut bundle,
                        scratch,
                    );
                if !is_done {
                    self.block_streams(lanes, &query, (&mut lot, &mut ways), scratch);
                }
            },
        );
        for (ray, &way) in ways.iter().enumerate() {
            to_light[ray / 4].note(ray % 4, way);
        }
        scratch.bundle = bundle;
        scratch.lot = lot;
    }

    /// Offers what some of eight rays, those from the first on that are marked, see of an item; notes new ends.
    #[inline(always)]
    pub(super) fn see_by(
        &self,
        lanes: Lanes,
        (item, (first, rays), query): ((Numbered, Seen), (usize, u32), &impl Fn(usize) -> Query),
        (lot, bests): (&mut Lot, &mut [Option<Best>]),
        ended: &mut Ended,
        scratch: &mut Scratch,
    ) {
        let mut offer = |lot: &mut Lot, ray: usize, found, ended: &mut Ended| {
            let old = lot.far(ray);
            let new = self.offer(item.0.number, found, &query(ray), old, &mut bests[ray]);
            if new < old {
                lot.shorten(ray, new);
                ended.note(ray - first, new);
            }
        };
        let left = self.in_fours::<true>(
            lanes,
            item,
            (lot, query),
            (first, rays),
            scratch,
            #[inline(always)]
            |lot, ray, found| offer(lot, ray, found, ended),
        );
        each_bit(left, |lane| {
            let ray = first + lane;
            let query = &query(ray);
            let asked = (query, &self.search_for(query));
            if let Some(found) = self.see_item(item.0, asked, lot.far(ray), scratch) {
                offer(lot, ray, found, ended);
            }
        });
    }

    /// Notes a surface on the way to a light; says whether it ends there.
    #[inline(always)]
    fn note_way(&self, found: &Found, way: &mut Way) -> bool {
        if self.ends_light(found) {
            *way = Way::Blocked;
        } else if *way == Way::Free {
            *way = Way::Filtered;
        }
        *way == Way::Blocked
    }

    /// Notes which rays to a light something unbounded blocks.
    #[inline(always)]
    fn block_by_unbounded(
        &self,
        lanes: Lanes,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut Lot, &mut [Way]),
        scratch: &mut Scratch,
    ) {
        for &item in &self.finder().unbounded {
            for first in (0..ways.len()).step_by(8) {
                let rays = 0xff >> (8 - (ways.len() - first).min(8));
                let left = self.in_fours::<false>(
                    lanes,
                    (item, Seen::Shadow),
                    (&mut *lot, query),
                    (first, rays),
                    scratch,
                    #[inline(always)]
                    |lot, ray, found| {
                        if found.root.t < lot.far(ray) {
                            self.note_way(&found, &mut ways[ray]);
                        }
                    },
                );
                each_bit(left, |lane| {
                    let way = &mut ways[first + lane];
                    if *way == Way::Blocked {
                        return;
                    }
                    let query = query(first + lane);
                    let asked = (&query, &self.search_for(&query));
                    if self.blocks(item, asked, way, scratch) {
                        *way = Way::Blocked;
                    }
                });
            }
        }
    }

    /// The same of what is in the tree and no large mesh. Says whether it came to an end.
    #[inline(always)]
    fn block_by_bounded(
        &self,
        lanes: Lanes,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut Lot, &mut [Way]),
        bundle: &mut Bundle,
        scratch: &mut Scratch,
    ) -> bool {
        self.finder().tree.together(
            lanes,
            bundle,
            #[inline(always)]
            |number, first, rays, ended| {
                let item = self.finder().bounded[number as usize];
                if self.is_large_mesh(item) {
                    return;
                }
                self.block_by(
                    lanes,
                    (item, first, rays),
                    (query, lot, ways),
                    ended,
                    scratch,
                );
            },
        )
    }

    /// Notes which of some of eight rays to a light, those from the first on that are marked, an item blocks.
    #[inline(always)]
    fn block_by(
        &self,
        lanes: Lanes,
        (item, first, rays): (Numbered, usize, u32),
        (query, lot, ways): (&impl Fn(usize) -> Query, &mut Lot, &mut [Way]),
        ended: &mut Ended,
        scratch: &mut Scratch,
    ) {
        let left = self.in_fours::<false>(
            lanes,
            (item, Seen::Shadow),
            (lot, query),
            (first, rays),
            scratch,
            #[inline(always)]
            |lot, ray, found| {
                if found.root.t < lot.far(ray) && self.note_way(&found, &mut ways[ray]) {
                    ended.note(ray - first, f64::NEG_INFINITY);
                }
            },
        );
        each_bit(left, |lane| {
            let way = &mut ways[first + lane];
            let query = query(first + lane);
            let asked = (&query, &self.search_for(&query));
            if self.blocks(item, asked, way, scratch) {
                *way = Way::Blocked;
                ended.note(lane, f64::NEG_INFINITY);
            }
        });
    }

    /// Notes what in the tree lies on each ray that is not known to be blocked, where rays have little in common.
    #[inline(always)]
    fn block_streams(
        &self,
        lanes: Lanes,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut Lot, &mut [Way]),
        scratch: &mut Scratch,
    ) {
        for first in (0..ways.len()).step_by(STREAM) {
            let mut asked = 0;
            for (lane, way) in ways[first..].iter().take(STREAM).enumerate() {
                asked |= u32::from(*way != Way::Blocked) << lane;
            }
            self.finder().tree.stream(
                lanes,
                asked,
                #[inline(always)]
                |lane| {
                    let query = query(first + lane);
                    (query.ray, query.far)
                },
                #[inline(always)]
                |number, rays, ended| {
                    let item = self.finder().bounded[number as usize];
                    let asked = (item, first, rays);
                    self.block_by(lanes, asked, (query, &mut *lot, &mut *ways), ended, scratch);
                },
            );
        }
    }

    /// What lies on the ways from hits at these places to the light of this number, which have little in common, added to
    /// `ways`.
    pub fn ways_of_streams(
        &self,
        places: &[u16],
        (hits, to_light): (&[FourHits], &[FourWays]),
        scratch: &mut Scratch,
        ways: &mut Vec<Way>,
    ) {
        let first = ways.len();
        scratch.rays.shadow += places.len() as u64;
        let mut lot = std::mem::take(&mut scratch.lot);
        let query = |ray: usize| {
            let place = usize::from(places[ray]);
            to_light[place / 4].query(&hits[place / 4], place % 4)
        };
        with_widest(
            #[inline(always)]
            |lanes| {
                lot.shine(
                    places,
                    (hits, to_light),
                    #[inline(always)]
                    |blur| self.least_from(Some(blur), Seen::Shadow),
                );
                ways.resize(first + places.len(), Way::Free);
                let ways = &mut ways[first..];
                self.block_by_unbounded(lanes, &query, (&mut lot, ways), scratch);
                self.block_streams(lanes, &query, (&mut lot, ways), scratch);
            },
        );
        scratch.lot = lot;
    }

    /// Asks about an item by four rays at a time, where that goes, those of `rays` from the first on. Gives the rays
    /// that must still be asked for singly; `take` gets the number of each of the others that meets the item, and what it
    /// meets; unless `ASKS_FACE` perhaps no more than the distance.
    #[inline(always)]
    pub(super) fn in_fours<const ASKS_FACE: bool>(
        &self,
        lanes: Lanes,
        (item, seen): (Numbered, Seen),
        (lot, query): (&mut Lot, impl Fn(usize) -> Query),
        (first, rays): (usize, u32),
        scratch: &mut Scratch,
        mut take: impl FnMut(&mut Lot, usize, Found),
    ) -> u32 {
        if self.is_hidden(item.item, seen) {
            return 0;
        }
        if !self.model.suits_four(item.item) {
            return rays;
        }
        let mut left = 0;
        let mut unsure = 0;
        // What is behind a surface that does not tell all only a single ray finds.
        let mut take = |lot: &mut Lot, ray: usize, found: Found| {
            if self.tells_all(item.item, &found, seen) {
                take(lot, ray, found);
            } else {
                unsure |= 1 << (ray - first);
            }
        };
        for half in [0, 4] {
            let some = rays >> half & 0b1111;
            if some == 0 {
                continue;
            }
            let start = first + half;
            let asked = (&mut *lot, start, some);
            let unknown = match item.item {
                Item::Program(program) => {
                    self.ask_four::<ASKS_FACE>(lanes, program, asked, &query, scratch, &mut take)
                }
                Item::Leaf(leaf) if ASKS_FACE => {
                    let roots = &mut scratch.roots;
                    self.ask_four_of_leaf::<false>(lanes, leaf, asked, &query, roots, &mut take)
                }
                Item::Leaf(leaf) => {
                    let roots = &mut scratch.roots;
                    self.ask_four_of_leaf::<true>(lanes, leaf, asked, &query, roots, &mut take)
                }
                Item::Instance(copy) if ASKS_FACE => {
                    self.ask_four_of_copy::<false>(lanes, copy, asked, &mut take)
                }
                Item::Instance(copy) => {
                    self.ask_four_of_copy::<true>(lanes, copy, asked, &mut take)
                }
            };
            left |= unknown << half;
        }
        left | unsure
    }
}
