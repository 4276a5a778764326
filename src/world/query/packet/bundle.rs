//! Questions of many rays from one point, answered together: the same answers as one by one, to the bit.

use super::hits::{HitPacket4, ShadowPacket4};
use super::rays::RayStream;
use crate::base::accel::{Bundle, NewEnds, STREAM};
use crate::base::math::Ray;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::model::Item;
use crate::world::query::{ClosestHit, Occlusion, Query, RayKind, Scratch};
use glam::DVec3;
use smallvec::{SmallVec, smallvec};

/// Calls `visit` with the place of each bit that is set.
#[inline(always)]
pub(in crate::world) fn each_bit(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl World {
    /// Notes the nearest visible surface on each of the first `count` of the camera's rays from `origin`, which lie in an
    /// order in which neighbours differ little; behind the last of them some ray stands again.
    pub fn closest_hits_bundle(
        &self,
        origin: DVec3,
        count: usize,
        hits: &mut [HitPacket4],
        scratch: &mut Scratch,
    ) {
        scratch.rays.camera += count as u64;
        if let Some(vista) = &self.vistas.camera {
            self.closest_hits_grid(vista, (origin, count), hits, scratch);
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
                    origin_surface: None,
                    t_max: f64::INFINITY,
                    kind: RayKind::Camera,
                };
                lot.load_camera_rays(origin, self.t_min(&query(0)), rays);
                for &item in &self.finder().unbounded {
                    for first in (0..count).step_by(8) {
                        let rays = 0xff >> (8 - (count - first).min(8));
                        let asked = ((item, RayKind::Camera), (first, rays), &query);
                        let ended = &mut NewEnds::default();
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
                            let asked = ((item, RayKind::Camera), (first, rays), &query);
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

    /// Occlusion of the shadow rays from the hits at these places to a light, appended to `ways`: by a bundle if they share
    /// the point `centre` and neighbours differ little, otherwise by streams of eight. Returns true if the bundle paid.
    pub fn occlusion_bundle(
        &self,
        places: &[u16],
        (hits, to_light): (&[HitPacket4], &[ShadowPacket4]),
        centre: Option<DVec3>,
        scratch: &mut Scratch,
        ways: &mut Vec<Occlusion>,
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
                lot.load_shadow_rays_all(
                    places,
                    (hits, to_light),
                    #[inline(always)]
                    |blur| self.least_from(Some(blur), RayKind::Shadow),
                );
                ways.resize(first + places.len(), Occlusion::Clear);
                let ways = &mut ways[first..];
                self.block_by_unbounded(lanes, &query, (&mut lot, ways), scratch);
                let is_bundled = |centre: &DVec3| {
                    bundle.fill(
                        &self.finder().tree,
                        *centre,
                        places.len(),
                        #[inline(always)]
                        |four| {
                            let back = lot.dirs(four).map(|axis| axis.map(|dir| -dir));
                            let mut end = [f64::NEG_INFINITY; 4];
                            for (lane, way) in ways[4 * four..].iter().take(4).enumerate() {
                                if *way != Occlusion::Opaque {
                                    let place = usize::from(places[4 * four + lane]);
                                    end[lane] = to_light[place / 4].distance[place % 4];
                                }
                            }
                            (back, end)
                        },
                    )
                };
                let Some(centre) = centre.filter(is_bundled) else {
                    self.block_streams(lanes, &query, (&mut lot, ways), scratch);
                    return false;
                };
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
        hits: &HitPacket4,
        (to_light, count): (&mut [ShadowPacket4], usize),
        scratch: &mut Scratch,
    ) {
        scratch.rays.shadow += count as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut lot = std::mem::take(&mut scratch.lot);
        let mut ways: SmallVec<[Occlusion; 16]> = smallvec![Occlusion::Clear; count];
        let asked = &*to_light;
        let query = |ray: usize| asked[ray / 4].query(hits, ray % 4);
        with_widest(
            #[inline(always)]
            |lanes| {
                lot.shine_from(
                    hits,
                    asked,
                    #[inline(always)]
                    |blur| self.least_from(Some(blur), RayKind::Shadow),
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
                            if *way != Occlusion::Opaque {
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
    pub(in crate::world) fn see_by(
        &self,
        lanes: SimdLevel,
        (item, (first, rays), query): (
            (IndexedItem, RayKind),
            (usize, u32),
            &impl Fn(usize) -> Query,
        ),
        (lot, bests): (&mut RayStream, &mut [Option<ClosestHit>]),
        ended: &mut NewEnds,
        scratch: &mut Scratch,
    ) {
        let mut offer = |lot: &mut RayStream, ray: usize, found, ended: &mut NewEnds| {
            let old = lot.far(ray);
            let new =
                self.accept_if_closer(item.0.number, found, &query(ray), old, &mut bests[ray]);
            if new < old {
                lot.shorten(ray, new);
                ended.note(ray - first, new);
            }
        };
        let left = self.packet4_item::<true>(
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
            if let Some(found) = self.intersect_item(item.0, asked, lot.far(ray), scratch) {
                offer(lot, ray, found, ended);
            }
        });
    }

    /// Notes a surface on the way to a light; says whether it ends there.
    #[inline(always)]
    fn note_way(&self, found: &RawHit, way: &mut Occlusion) -> bool {
        if self.ends_light(found) {
            *way = Occlusion::Opaque;
        } else if *way == Occlusion::Clear {
            *way = Occlusion::Transmissive;
        }
        *way == Occlusion::Opaque
    }

    /// Notes which rays to a light something unbounded blocks.
    #[inline(always)]
    fn block_by_unbounded(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut RayStream, &mut [Occlusion]),
        scratch: &mut Scratch,
    ) {
        for &item in &self.finder().unbounded {
            for first in (0..ways.len()).step_by(8) {
                let rays = 0xff >> (8 - (ways.len() - first).min(8));
                let left = self.packet4_item::<false>(
                    lanes,
                    (item, RayKind::Shadow),
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
                    if *way == Occlusion::Opaque {
                        return;
                    }
                    let query = query(first + lane);
                    let asked = (&query, &self.search_for(&query));
                    if self.occludes(item, asked, way, scratch) {
                        *way = Occlusion::Opaque;
                    }
                });
            }
        }
    }

    /// The same of what is in the tree and no large mesh. Says whether it came to an end.
    #[inline(always)]
    fn block_by_bounded(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut RayStream, &mut [Occlusion]),
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
        lanes: SimdLevel,
        (item, first, rays): (IndexedItem, usize, u32),
        (query, lot, ways): (&impl Fn(usize) -> Query, &mut RayStream, &mut [Occlusion]),
        ended: &mut NewEnds,
        scratch: &mut Scratch,
    ) {
        let left = self.packet4_item::<false>(
            lanes,
            (item, RayKind::Shadow),
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
            if *way == Occlusion::Opaque {
                return;
            }
            let query = query(first + lane);
            let asked = (&query, &self.search_for(&query));
            if self.occludes(item, asked, way, scratch) {
                *way = Occlusion::Opaque;
                ended.note(lane, f64::NEG_INFINITY);
            }
        });
    }

    /// Notes what in the tree lies on each ray that is not known to be blocked, where rays have little in common.
    #[inline(always)]
    fn block_streams(
        &self,
        lanes: SimdLevel,
        query: &impl Fn(usize) -> Query,
        (lot, ways): (&mut RayStream, &mut [Occlusion]),
        scratch: &mut Scratch,
    ) {
        for first in (0..ways.len()).step_by(STREAM) {
            let mut asked = 0;
            for (lane, way) in ways[first..].iter().take(STREAM).enumerate() {
                asked |= u32::from(*way != Occlusion::Opaque) << lane;
            }
            self.finder().tree.stream(
                lanes,
                asked,
                #[inline(always)]
                |lane| {
                    let query = query(first + lane);
                    (query.ray, query.t_max)
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

    /// Asks about an item by four rays at a time, where that goes, those of `rays` from the first on. Gives the rays
    /// that must still be asked for singly; `take` gets the number of each of the others that meets the item, and what it
    /// meets; unless `ASKS_FACE` perhaps no more than the distance.
    #[inline(always)]
    pub(in crate::world) fn packet4_item<const ASKS_FACE: bool>(
        &self,
        lanes: SimdLevel,
        (item, seen): (IndexedItem, RayKind),
        (lot, query): (&mut RayStream, impl Fn(usize) -> Query),
        (first, rays): (usize, u32),
        scratch: &mut Scratch,
        mut take: impl FnMut(&mut RayStream, usize, RawHit),
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
        let mut take = |lot: &mut RayStream, ray: usize, found: RawHit| {
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
                    self.packet4_primitive::<false>(lanes, leaf, asked, &query, roots, &mut take)
                }
                Item::Leaf(leaf) => {
                    let roots = &mut scratch.roots;
                    self.packet4_primitive::<true>(lanes, leaf, asked, &query, roots, &mut take)
                }
                Item::Instance(copy) if ASKS_FACE => {
                    self.packet4_instance::<false>(lanes, copy, asked, &mut take)
                }
                Item::Instance(copy) => {
                    self.packet4_instance::<true>(lanes, copy, asked, &mut take)
                }
            };
            left |= unknown << half;
        }
        left | unsure
    }
}
