//! Questions of rays from a camera or to a lamp that knows what lies around it: eight neighbours at a time, without a walk
//! through the tree. The same answers as one by one, to the bit.

use super::bundle::each_bit;
use super::hits::{HitPacket4, ShadowPacket4};
use super::rays::RayStream;
use crate::base::accel::LightBuffer;
use crate::base::math::Ray;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::query::{ClosestHit, Occlusion, Query, RayKind, Scratch};
use glam::DVec3;

/// How many rays are asked about at a time.
const EIGHT: usize = 8;

impl World {
    /// Notes the nearest visible surface on each of the first `count` of the camera's rays from `origin`, as [`World::closest_hits_bundle`]
    /// does.
    pub(in crate::world) fn closest_hits_grid(
        &self,
        vista: &LightBuffer,
        (origin, count): (DVec3, usize),
        hits: &mut [HitPacket4],
        scratch: &mut Scratch,
    ) {
        let mut lot = std::mem::take(&mut scratch.lot);
        with_widest(
            #[inline(always)]
            |lanes| {
                for (number, hits) in hits.chunks_mut(2).enumerate() {
                    let there = (count - EIGHT * number).min(EIGHT);
                    let there = 0xff >> (EIGHT - there);
                    self.closest_hits_packet8(
                        lanes,
                        (vista, origin),
                        hits,
                        there,
                        (&mut lot, scratch),
                    );
                }
            },
        );
        scratch.lot = lot;
    }

    #[inline(always)]
    fn closest_hits_packet8(
        &self,
        lanes: SimdLevel,
        (vista, origin): (&LightBuffer, DVec3),
        hits: &mut [HitPacket4],
        there: u32,
        (lot, scratch): (&mut RayStream, &mut Scratch),
    ) {
        let mut bests: [Option<ClosestHit>; EIGHT] = [None; EIGHT];
        let asked = &*hits;
        let query = |ray: usize| Query {
            ray: Ray::new(origin, asked[ray / 4].dir(ray % 4)),
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        // Most rays beside everything are not even asked about.
        let mut are_in_lot = !self.finder().unbounded.is_empty();
        let mut ends = [[f64::INFINITY; 4]; 2];
        let last = hits.len() - 1;
        if are_in_lot {
            lot.load_camera_rays(origin, self.t_min(&query(0)), asked);
            for &item in &self.finder().unbounded {
                let asked = ((item, there), &query);
                self.offer_to_eight(lanes, asked, (lot, &mut bests), scratch, |_, _| {});
            }
            ends = [lot.four(0).far, lot.four(4 * last).far];
        }
        let halves = [(&asked[0].dir, &ends[0]), (&asked[last].dir, &ends[1])];
        let mut rays = vista.rays(halves, there);
        let beside = vista.each(
            lanes,
            &mut rays,
            #[inline(always)]
            |place, may_meet, rays| {
                let item = self.finder().bounded[place as usize];
                if !are_in_lot {
                    lot.load_camera_rays(origin, self.t_min(&query(0)), asked);
                    are_in_lot = true;
                }
                self.offer_to_eight(
                    lanes,
                    ((item, may_meet), &query),
                    (lot, &mut bests),
                    scratch,
                    #[inline(always)]
                    |ray, end| rays.end(ray, end),
                );
            },
        );
        if !are_in_lot && beside == 0 {
            hits.iter_mut().for_each(HitPacket4::meet_nothing);
            return;
        }
        each_bit(beside, |ray| {
            bests[ray % EIGHT] = self.nearest_found(lanes, &query(ray), scratch);
        });
        let origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
        for (bests, hits) in bests.chunks(4).zip(hits) {
            self.note_hits(lanes, &origin, bests, hits);
        }
    }

    /// Offers an item to some of eight rays; `shorten` hears of those that then end sooner.
    #[inline(always)]
    fn offer_to_eight(
        &self,
        lanes: SimdLevel,
        ((item, rays), query): ((IndexedItem, u32), &impl Fn(usize) -> Query),
        (lot, bests): (&mut RayStream, &mut [Option<ClosestHit>; EIGHT]),
        scratch: &mut Scratch,
        mut shorten: impl FnMut(usize, f64),
    ) {
        let left = self.packet4_item::<true>(
            lanes,
            (item, RayKind::Camera),
            (lot, query),
            (0, rays),
            scratch,
            #[inline(always)]
            |lot, ray, found| {
                let best = &mut bests[ray % EIGHT];
                self.offer_to_one(lot, (item.number, ray), found, query, best, &mut shorten);
            },
        );
        each_bit(
            left,
            #[inline(always)]
            |ray| {
                let asked = query(ray);
                let search = self.search_for(&asked);
                let found = self.intersect_item(item, (&asked, &search), lot.far(ray), scratch);
                if let Some(found) = found {
                    let best = &mut bests[ray % EIGHT];
                    self.offer_to_one(lot, (item.number, ray), found, query, best, &mut shorten);
                }
            },
        );
    }

    #[inline(always)]
    fn offer_to_one(
        &self,
        lot: &mut RayStream,
        (item, ray): (u32, usize),
        found: RawHit,
        query: &impl Fn(usize) -> Query,
        best: &mut Option<ClosestHit>,
        shorten: &mut impl FnMut(usize, f64),
    ) {
        let old = lot.far(ray);
        let new = self.accept_if_closer(item, found, &query(ray), old, best);
        if new < old {
            lot.shorten(ray, new);
            shorten(ray, new);
        }
    }

    /// Whether it is known what lies around the lamp of this number.
    #[inline]
    pub(crate) fn knows_around(&self, light: u32) -> bool {
        self.vistas.of_light(light).is_some()
    }

    /// Notes what lies on the ways of up to eight neighbouring hits, of those marked in `asked`, to the lamp of this number,
    /// around which that is known.
    #[inline(always)]
    pub(crate) fn occlusion_packet8(
        &self,
        lanes: SimdLevel,
        (hits, ways): (&[HitPacket4], &mut [ShadowPacket4]),
        (asked, light): (u32, u32),
        scratch: &mut Scratch,
    ) {
        let Some(vista) = self.vistas.of_light(light) else {
            return;
        };
        scratch.rays.shadow += u64::from(asked.count_ones());
        let mut lot = std::mem::take(&mut scratch.lot);
        let mut shadows = ShadowMasks::default();
        let to_light = &*ways;
        let query = |ray: usize| to_light[ray / 4].query(&hits[ray / 4], ray % 4);
        let points = (hits, to_light);
        for &item in &self.finder().unbounded {
            let rays = asked & !shadows.blocked;
            let (asked, to) = (((item, rays), &query), (&mut lot, &mut shadows));
            self.block_eight(lanes, asked, points, to, scratch);
        }
        let left = asked & !shadows.blocked;
        if left != 0 {
            let last = hits.len() - 1;
            let half = |four: usize| (&to_light[four].to_light, &to_light[four].distance);
            let mut rays = vista.rays_back([half(0), half(last)], left);
            vista.each(
                lanes,
                &mut rays,
                #[inline(always)]
                |place, may_meet, rays| {
                    let before = shadows.blocked;
                    let item = self.finder().bounded[place as usize];
                    let (asked, to) = (((item, may_meet), &query), (&mut lot, &mut shadows));
                    self.block_eight(lanes, asked, points, to, scratch);
                    each_bit(shadows.blocked & !before, |ray| {
                        rays.end(ray, f64::NEG_INFINITY);
                    });
                },
            );
        }
        scratch.lot = lot;
        for (half, ways) in ways.iter_mut().enumerate() {
            let of_half = |bits: u32| bits >> (4 * half) & 0b1111;
            ways.asked = of_half(asked);
            ways.blocked = of_half(shadows.blocked);
            ways.filtered = of_half(shadows.filtered & !shadows.blocked);
        }
    }

    /// Finds out for some of eight rays whether an item lies on them.
    #[inline(always)]
    fn block_eight(
        &self,
        lanes: SimdLevel,
        ((item, rays), query): ((IndexedItem, u32), &impl Fn(usize) -> Query),
        points: (&[HitPacket4], &[ShadowPacket4]),
        (lot, shadows): (&mut RayStream, &mut ShadowMasks),
        scratch: &mut Scratch,
    ) {
        if !shadows.are_in_lot {
            lot.load_shadow_rays(
                points,
                #[inline(always)]
                |blur| self.least_from(Some(blur), RayKind::Shadow),
            );
            shadows.are_in_lot = true;
        }
        let left = self.packet4_item::<false>(
            lanes,
            (item, RayKind::Shadow),
            (lot, query),
            (0, rays),
            scratch,
            #[inline(always)]
            |lot, ray, found| {
                if found.root.t < lot.far(ray) {
                    if self.ends_light(&found) {
                        shadows.blocked |= 1 << ray;
                    } else {
                        shadows.filtered |= 1 << ray;
                    }
                }
            },
        );
        each_bit(left, |ray| {
            let mut way = Occlusion::Clear;
            let query = query(ray);
            let asked = (&query, &self.search_for(&query));
            if self.occludes(item, asked, &mut way, scratch) {
                shadows.blocked |= 1 << ray;
            } else if way == Occlusion::Transmissive {
                shadows.filtered |= 1 << ray;
            }
        });
    }
}

/// Which of eight ways to a lamp are blocked, and which meet something that may let light through, one bit each.
#[derive(Clone, Copy, Debug, Default)]
struct ShadowMasks {
    blocked: u32,
    filtered: u32,
    /// Whether the rays are in the lot: most meet nothing that they must be asked about.
    are_in_lot: bool,
}
