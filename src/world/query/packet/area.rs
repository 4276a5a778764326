//! Shadow rays from points to an area light: their common blockers, and their occlusion.

use super::bundle::{ItemRays, each_bit, unblocked};
use super::hits::{HitPacket4, ShadowPacket4};
use super::primitive::{ExitedLanes, PrimitivePacket};
use super::rays::{RayPacket4, RayStream};
use crate::base::accel::{MAX_BEAM_ITEMS, MAX_STREAM_RAYS, NewEnds};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use crate::scene::light::{Area, Axes, Light};
use crate::scene::shape::Geometry;
use crate::world::compiled::World;
use crate::world::model::{IndexedItem, Item};
use crate::world::query::QueryScratch;
use crate::world::query::closest::{POV_RAY_SHADOW, POV_RAY_T_MIN};
use crate::world::query::intersect::Search;
use crate::world::ray::{Occlusion, Query, RayKind, SpawnSurface};
use arrayvec::ArrayVec;
use glam::DVec3;
use smallvec::{SmallVec, smallvec};

/// Minimum cosine between the normal of a convex shape and a shadow ray that certainly leaves it.
const MIN_COSINE: f64 = 1e-3;

/// The size of the parallelogram whose corners are tested for all of a light, as a multiple of that of the light.
const UMBRA_MARGIN: f64 = 1.0 + 1.0 / 16.0;
/// Minimum size of such a light, relative to its distance, and distance of its blocker, relative to the coordinates.
const UMBRA_SHARE: f64 = 1e-4;
/// Maximum diameter of its blocker, as a share of the least distance of the light: the rays leave it before they end.
const UMBRA_BLOCKER: f64 = 0.9;
/// The end of its rays, before the light.
const UMBRA_END: f64 = 0.99;
/// Minimum ratio of the least distance of the light to the largest, and maximum share of the limit near the point.
const UMBRA_EVENNESS: f64 = 0.5;
const UMBRA_NEAR: f64 = 0.01;

/// Margins of the distance from the axis of a cylinder that shadow rays pass: a share of its radius,
const MARGIN_OF_RADIUS: f64 = 1e-6;
/// of the distance of its base,
const MARGIN_OF_DISTANCE: f64 = 1e-9;
/// and of coordinates and of products of them.
const MARGIN_OF_ROUNDING: f64 = 1e-14;

/// A parallelogram that holds all lights of an area light.
#[derive(Clone, Copy, Debug)]
pub struct LightArea {
    /// Its centre in world space.
    pub centre: DVec3,
    /// Half its edges.
    pub half_edges: [DVec3; 2],
}

impl LightArea {
    /// The parallelogram of an area light with these axes.
    #[must_use]
    pub fn of(light: &Light, area: &Area, axes: &Axes) -> LightArea {
        LightArea {
            centre: light.centre,
            half_edges: area.half_edges(axes),
        }
    }
}

/// The items that shadow rays from a point to a [`LightArea`] may hit; no others.
#[derive(Clone, Debug)]
pub struct AreaBlockers {
    /// Positions in the list of bounded items.
    bounded: ArrayVec<u32, MAX_BEAM_ITEMS>,
    /// True if unbounded items are among them.
    has_unbounded: bool,
}

impl AreaBlockers {
    /// True if all light arrives.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bounded.is_empty() && !self.has_unbounded
    }
}

/// A point on a surface, lit by an area light.
struct LitPoint {
    point: DVec3,
    /// The surface.
    own: SpawnSurface,
    /// The corners of the light, seen from the point.
    to_corners: [DVec3; 4],
    /// Its index among others.
    number: usize,
}

impl LitPoint {
    /// The point of one lane, the one with this index among others.
    fn new(hits: &HitPacket4, lane: usize, light: &LightArea, number: usize) -> LitPoint {
        let [across, up] = light.half_edges;
        let (point, own) = (hits.point(lane), hits.spawn_surface(lane));
        let to_corner = |offset: DVec3| light.centre + offset - point;
        LitPoint {
            point,
            own,
            to_corners: [across + up, across - up, up - across, -across - up].map(to_corner),
            number,
        }
    }

    /// True if the item is the leaf that the point is on.
    fn is_on(&self, item: Item) -> bool {
        matches!(item, Item::Leaf(leaf) if leaf == self.own.leaf)
    }
}

impl World {
    /// Finds the items between the point that all lanes of `hits` hold and an area light; `None` if they are many.
    #[must_use]
    pub fn area_blockers(
        &self,
        hits: &HitPacket4,
        light: &LightArea,
        scratch: &mut QueryScratch,
    ) -> Option<AreaBlockers> {
        let point = LitPoint::new(hits, 0, light, 0);
        let leaves_own = with_widest(
            #[inline(always)]
            |lanes| self.leaves_own(lanes, &point),
        );
        let is_left_out = |item: IndexedItem| {
            leaves_own && point.is_on(item.item) || self.is_hidden(item.item, RayKind::Shadow)
        };
        let has_unbounded = self
            .bvh()
            .unbounded
            .iter()
            .any(|&item| !is_left_out(item) && !self.is_beside(item, &point, scratch));
        let bounded = with_widest(
            #[inline(always)]
            |lanes| {
                let around = &Bounds::new(point.point, point.point);
                self.items_before(lanes, around, light, |item| {
                    is_left_out(item) || self.is_past_cylinder(item.item, &point)
                })
            },
        )?;
        Some(AreaBlockers {
            bounded,
            has_unbounded,
        })
    }

    /// Mask of those of up to eight `active` hits that certainly receive all of an area light. One beam serves all hits
    /// on a surface.
    #[must_use]
    #[inline(always)]
    pub(crate) fn lanes_without_blockers(
        &self,
        lanes: SimdLevel,
        hits: &[HitPacket4],
        active: u32,
        light: &LightArea,
        scratch: &mut QueryScratch,
    ) -> u32 {
        let mut points = ArrayVec::<LitPoint, MAX_STREAM_RAYS>::new();
        each_bit(active, |number| {
            let point = LitPoint::new(&hits[number / 4], number % 4, light, number);
            if self.leaves_own(lanes, &point) {
                points.push(point);
            }
        });
        let mut clear = 0;
        for same in points.chunk_by(|a, b| a.own.leaf == b.own.leaf) {
            let around = same.iter().fold(Bounds::EMPTY, |around, point| {
                around.with_point(point.point)
            });
            let is_left_out = |item: IndexedItem| {
                same[0].is_on(item.item) || self.is_hidden(item.item, RayKind::Shadow)
            };
            let Some(before) = self.items_before(lanes, &around, light, is_left_out) else {
                continue;
            };
            for point in same {
                let mut bounded = before.iter().map(|&at| self.bvh().bounded[at as usize]);
                let mut unbounded = self.bvh().unbounded.iter();
                if bounded.all(|item| self.is_past_cylinder(item.item, point))
                    && unbounded
                        .all(|&item| is_left_out(item) || self.is_beside(item, point, scratch))
                {
                    clear |= 1 << point.number;
                }
            }
        }
        clear
    }

    /// True if what blocked the light of this index last certainly blocks all shadow rays from the point that all lanes
    /// of `hits` hold to an area light.
    ///
    /// A convex solid that the segments to the corners of a parallelogram enter is hit by those to all points between.
    /// The parallelogram is larger than the light, by more than roundings could change.
    #[must_use]
    pub fn is_in_umbra(
        &self,
        hits: &HitPacket4,
        light: &LightArea,
        number: u32,
        scratch: &QueryScratch,
    ) -> bool {
        let Some(item) = scratch.last_blocker(number) else {
            return false;
        };
        let Item::Leaf(blocker) = item.item else {
            return false;
        };
        let leaf = &self.model.leaves[blocker as usize];
        if !leaf.is_convex_solid()
            || blocker == hits.leaf[0]
            || self.is_hidden(item.item, RayKind::Shadow)
            || !self.is_all_opaque(item.item)
        {
            return false;
        }
        let half_edges = light.half_edges.map(|edge| UMBRA_MARGIN * edge);
        let point = LitPoint::new(
            hits,
            0,
            &LightArea {
                half_edges,
                ..*light
            },
            0,
        );
        let [across, up] = half_edges.map(DVec3::length);
        let distance = light.centre.distance(point.point);
        let size = light.centre.abs().max(point.point.abs()).max_element();
        let (least, largest) = (distance - across - up, distance + across + up);
        let bounds = leaf.shape.bounds();
        // The least distance of shadow rays, and more than the roundings of coordinates.
        let near = (2.0 * POV_RAY_SHADOW * self.globals.unit).max(UMBRA_SHARE * size);
        let is_fit = across.min(up) > UMBRA_SHARE * largest
            && (bounds.max - bounds.min).length() < UMBRA_BLOCKER * least
            && UMBRA_EVENNESS * largest < least
            && near < UMBRA_NEAR * least;
        if !is_fit {
            return false;
        }
        let mut rays = RayPacket4::from_point(point.point, &point.to_corners);
        rays.t_min = [near / least; 4];
        rays.t_max = [UMBRA_END; 4];
        let nearest = with_widest(
            #[inline(always)]
            |lanes| {
                lanes.run(PrimitivePacket::<false> {
                    leaf,
                    rays: &rays,
                    origin_masks: [0, 0],
                    active: 0b1111,
                })
            },
        );
        nearest.hit_mask & !nearest.exit_mask & !nearest.unknown & 0b1111 == 0b1111
    }

    /// The bounded items that segments from `points` to an area light may hit, by position; `None` if they are many.
    #[inline(always)]
    fn items_before(
        &self,
        lanes: SimdLevel,
        points: &Bounds,
        light: &LightArea,
        is_left_out: impl Fn(IndexedItem) -> bool,
    ) -> Option<ArrayVec<u32, MAX_BEAM_ITEMS>> {
        let [across, up] = light.half_edges;
        let half_sides = across.abs() + up.abs();
        let tree = &self.bvh().tree;
        tree.items_in_beam(lanes, points, light.centre, half_sides, |position| {
            is_left_out(self.bvh().bounded[position as usize])
        })
    }

    /// True if shadow rays from a point to the light certainly do not hit the leaf that they leave.
    ///
    /// A convex shape lies on the other side of its tangent plane: if the corners of the light do not, nothing between
    /// them does. The leaves of instances are not among these.
    #[inline(always)]
    fn leaves_own(&self, lanes: SimdLevel, point: &LitPoint) -> bool {
        let Some(leaf) = self.model.leaves.get(point.own.leaf as usize) else {
            return false;
        };
        let faces =
            |to_corner: &DVec3| point.own.normal.dot(*to_corner) > MIN_COSINE * to_corner.length();
        if !leaf.shape.exits_in_cones() || !point.to_corners.iter().all(faces) {
            return false;
        }
        match leaf.shape.has_exiting_packet() {
            true => {
                let rays = RayPacket4::from_point(point.point, &point.to_corners);
                lanes.run(ExitedLanes { leaf, rays: &rays }) == 0b1111
            }
            false => {
                let mut corners = point.to_corners.iter();
                corners.all(|&to_corner| leaf.is_exiting(&Ray::new(point.point, to_corner)))
            }
        }
    }

    /// True if an item is in an infinite cylinder that no segment from a point to the light hits: a long thin cylinder
    /// fills little of its box.
    ///
    /// Seen along its axis, the segments to the corners lie on one side of the cylinder, and so do those between them.
    fn is_past_cylinder(&self, item: Item, point: &LitPoint) -> bool {
        let Some((base, axis, radius)) = self.model.bounding_cylinder(item) else {
            return false;
        };
        let (to_base, axis) = (base - point.point, axis.normalize_or_zero());
        let distance = to_base.length();
        let size = base.abs().max(point.point.abs()).max_element();
        let reach = radius * (1.0 + MARGIN_OF_RADIUS)
            + MARGIN_OF_DISTANCE * distance
            + MARGIN_OF_ROUNDING * size;
        let (mut are_above, mut are_below) = (true, true);
        for &to_corner in &point.to_corners {
            let off = axis.dot(to_corner.cross(to_base));
            let error = MARGIN_OF_ROUNDING * to_corner.length() * distance;
            let width = reach * axis.cross(to_corner).length() + error;
            are_above &= off > width;
            are_below &= off < -width;
        }
        are_above || are_below
    }

    /// True if an item is a half-space that does not reach between a point and the light.
    fn is_beside(&self, item: IndexedItem, point: &LitPoint, scratch: &mut QueryScratch) -> bool {
        self.is_half_space(item.item)
            && point.to_corners.iter().all(|&to_corner| {
                let distance = to_corner.length();
                let query = Query {
                    ray: Ray::new(point.point, to_corner / distance),
                    origin_surface: Some(point.own),
                    t_max: 2.0 * distance,
                    kind: RayKind::Shadow,
                };
                let search = Search {
                    t_min: 0.0,
                    ..self.search_for(&query)
                };
                let mut occlusion = Occlusion::Clear;
                !self.occludes(item, &query, &search, &mut occlusion, scratch)
                    && occlusion == Occlusion::Clear
            })
    }

    /// Returns true if [`World::occlusion_from_point`] pays off: rays through large meshes are faster one by one.
    #[must_use]
    pub fn can_bundle_from_point(&self, blockers: Option<&AreaBlockers>) -> bool {
        let is_large = |position: &u32| self.is_large_mesh(self.bvh().bounded[*position as usize]);
        self.meshes.is_empty()
            || blockers.is_some_and(|blockers| !blockers.bounded.iter().any(is_large))
    }

    /// Records the occlusion of the first `count` shadow rays from one hit to samples of the light of this index. All
    /// lanes of `hits` hold that hit; lanes past the last ray repeat some ray. Only `blockers` are tested, if they are
    /// known. Returns true if POV-Ray's memory of what blocked the light last may change the occlusion.
    #[must_use]
    pub fn occlusion_from_point(
        &self,
        hits: &HitPacket4,
        to_light: &mut [ShadowPacket4],
        count: usize,
        (light, blockers): (u32, Option<&AreaBlockers>),
        scratch: &mut QueryScratch,
    ) -> bool {
        scratch.rays.shadow += count as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        let mut occlusions: SmallVec<[Occlusion; 16]> = smallvec![Occlusion::Clear; count];
        let mut is_blocked = false;
        let shadow_rays = &*to_light;
        let query = |ray: usize| shadow_rays[ray / 4].query(hits, ray % 4);
        with_widest(
            #[inline(always)]
            |lanes| {
                stream.load_shadow_rays_from_point(
                    hits,
                    shadow_rays,
                    #[inline(always)]
                    |blur| self.t_min_from(Some(blur), RayKind::Shadow),
                );
                if blockers.is_none_or(|blockers| blockers.has_unbounded) {
                    self.occlude_by_unbounded(lanes, &query, &mut stream, &mut occlusions, scratch);
                }
                if let Some(blockers) = blockers {
                    let blocked = |occlusions: &[Occlusion]| {
                        occlusions
                            .iter()
                            .filter(|&&one| one == Occlusion::Opaque)
                            .count()
                    };
                    let blocked_before = blocked(&occlusions);
                    for &position in &blockers.bounded {
                        let item = self.bvh().bounded[position as usize];
                        for first in (0..count).step_by(MAX_STREAM_RAYS) {
                            let rays = ItemRays {
                                item,
                                kind: RayKind::Shadow,
                                first,
                                active: unblocked(&occlusions[first..]),
                                query: &query,
                            };
                            let (stream, ended) = (&mut stream, &mut NewEnds::default());
                            self.occlude_packet8(
                                lanes,
                                &rays,
                                stream,
                                &mut occlusions,
                                ended,
                                scratch,
                            );
                        }
                        if !is_blocked && blocked(&occlusions) > blocked_before {
                            is_blocked = true;
                            scratch.set_last_blocker(light, item);
                        }
                    }
                    return;
                }
                let is_bundled = bundle.fill(
                    &self.bvh().tree,
                    hits.point(0),
                    count,
                    #[inline(always)]
                    |packet| {
                        let mut end = [f64::NEG_INFINITY; 4];
                        for (lane, occlusion) in occlusions[4 * packet..].iter().take(4).enumerate()
                        {
                            if *occlusion != Occlusion::Opaque {
                                end[lane] = shadow_rays[packet].distance[lane];
                            }
                        }
                        (*stream.dirs(packet), end)
                    },
                );
                let is_done = is_bundled
                    && self.occlude_by_bounded(
                        lanes,
                        &query,
                        &mut stream,
                        &mut occlusions,
                        &mut bundle,
                        scratch,
                    );
                if !is_done {
                    self.occlude_streams(lanes, &query, &mut stream, &mut occlusions, scratch);
                }
            },
        );
        let depends_on_memory = with_widest(
            #[inline(always)]
            |lanes| self.may_be_remembered(lanes, count, (light, &query), &mut stream, scratch),
        );
        for (ray, &occlusion) in occlusions.iter().enumerate() {
            to_light[ray / 4].note(ray % 4, occlusion);
        }
        scratch.bundle = bundle;
        scratch.ray_stream = stream;
        depends_on_memory
    }

    /// True if what POV-Ray remembers to have blocked a light last may block one of the first `count` rays of a stream,
    /// by the limits of that test. Their own limits are lost.
    #[inline(always)]
    fn may_be_remembered(
        &self,
        lanes: SimdLevel,
        count: usize,
        (light, query): (u32, &impl Fn(usize) -> Query),
        stream: &mut RayStream,
        scratch: &mut QueryScratch,
    ) -> bool {
        let Some(item) = scratch.remembered(light) else {
            return false;
        };
        let unit = self.globals.unit;
        stream.set_limits(POV_RAY_T_MIN * unit, POV_RAY_SHADOW * unit);
        (0..count).step_by(MAX_STREAM_RAYS).any(|first| {
            let rays = ItemRays {
                item,
                kind: RayKind::Shadow,
                first,
                active: 0xff >> (MAX_STREAM_RAYS - (count - first).min(MAX_STREAM_RAYS)),
                query,
            };
            let mut is_hit = false;
            let scalar =
                self.packet4_item::<false>(lanes, &rays, stream, scratch, |_, _, _| is_hit = true);
            is_hit || scalar != 0
        })
    }

    /// True if a plane divides space into the item and the rest.
    fn is_half_space(&self, item: Item) -> bool {
        matches!(item, Item::Leaf(leaf) if self.model.leaves[leaf as usize].shape.half_space().is_some())
    }
}
