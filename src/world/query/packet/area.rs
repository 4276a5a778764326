//! Shadow rays from a point to an area light: their common blockers, and their occlusion.

use super::bundle::{ItemRays, unblocked};
use super::hits::{HitPacket4, ShadowPacket4};
use crate::base::accel::{MAX_BEAM_ITEMS, MAX_STREAM_RAYS, NewEnds};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::scene::shape::Geometry;
use crate::world::compiled::World;
use crate::world::model::{IndexedItem, Item};
use crate::world::query::QueryScratch;
use crate::world::query::intersect::Search;
use crate::world::ray::{Occlusion, Query, RayKind};
use arrayvec::ArrayVec;
use glam::DVec3;
use smallvec::{SmallVec, smallvec};

/// Minimum cosine between the normal of a convex shape and a shadow ray that certainly leaves it.
const MIN_COSINE: f64 = 1e-3;

/// A parallelogram that holds all lights of an area light.
#[derive(Clone, Copy, Debug)]
pub struct LightArea {
    /// Its centre in world space.
    pub centre: DVec3,
    /// Half its edges.
    pub half_edges: [DVec3; 2],
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

impl World {
    /// Finds the items between the point that all lanes of `hits` hold and an area light; `None` if they are many.
    #[must_use]
    pub fn area_blockers(
        &self,
        hits: &HitPacket4,
        light: &LightArea,
        scratch: &mut QueryScratch,
    ) -> Option<AreaBlockers> {
        let (point, own) = (hits.point(0), hits.spawn_surface(0));
        let [across, up] = light.half_edges;
        let corners = [across + up, across - up, up - across, -across - up]
            .map(|offset| light.centre + offset - point);
        // A convex shape lies on the other side of its tangent plane: if the corners do not, nothing between them does.
        // The leaves of instances are not among these.
        let leaves_own = self
            .model
            .leaves
            .get(own.leaf as usize)
            .is_some_and(|leaf| {
                leaf.shape.exits_in_cones()
                    && corners.iter().all(|&to_corner| {
                        own.normal.dot(to_corner) > MIN_COSINE * to_corner.length()
                            && leaf.is_exiting(&Ray::new(point, to_corner))
                    })
            });
        let is_left_out = |item: IndexedItem| {
            let is_own = matches!(item.item, Item::Leaf(leaf) if leaf == own.leaf);
            leaves_own && is_own || self.is_hidden(item.item, RayKind::Shadow)
        };
        let mut is_beside = |item: IndexedItem| {
            self.is_half_space(item.item)
                && corners.iter().all(|&to_corner| {
                    let distance = to_corner.length();
                    let query = Query {
                        ray: Ray::new(point, to_corner / distance),
                        origin_surface: Some(own),
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
        };
        let mut unbounded = self.bvh().unbounded.iter();
        let has_unbounded = unbounded.any(|&item| !is_left_out(item) && !is_beside(item));
        let bounded = with_widest(
            #[inline(always)]
            |lanes| {
                self.bvh().tree.items_in_beam(
                    lanes,
                    point,
                    light.centre,
                    across.abs() + up.abs(),
                    |position| is_left_out(self.bvh().bounded[position as usize]),
                )
            },
        )?;
        Some(AreaBlockers {
            bounded,
            has_unbounded,
        })
    }

    /// Returns true if [`World::occlusion_from_point`] pays off: rays through large meshes are faster one by one.
    #[must_use]
    pub fn can_bundle_from_point(&self, blockers: Option<&AreaBlockers>) -> bool {
        let is_large = |position: &u32| self.is_large_mesh(self.bvh().bounded[*position as usize]);
        self.meshes.is_empty()
            || blockers.is_some_and(|blockers| !blockers.bounded.iter().any(is_large))
    }

    /// Records the occlusion of the first `count` shadow rays from one hit to samples of a light. All lanes of `hits`
    /// hold that hit; lanes past the last ray repeat some ray. Only `blockers` are tested, if they are known.
    pub fn occlusion_from_point(
        &self,
        hits: &HitPacket4,
        to_light: &mut [ShadowPacket4],
        count: usize,
        blockers: Option<&AreaBlockers>,
        scratch: &mut QueryScratch,
    ) {
        scratch.rays.shadow += count as u64;
        let mut bundle = std::mem::take(&mut scratch.bundle);
        let mut stream = std::mem::take(&mut scratch.ray_stream);
        let mut occlusions: SmallVec<[Occlusion; 16]> = smallvec![Occlusion::Clear; count];
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
                    }
                    return;
                }
                self.occlude_by_unbounded(lanes, &query, &mut stream, &mut occlusions, scratch);
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
        for (ray, &occlusion) in occlusions.iter().enumerate() {
            to_light[ray / 4].note(ray % 4, occlusion);
        }
        scratch.bundle = bundle;
        scratch.ray_stream = stream;
    }

    /// True if a plane divides space into the item and the rest.
    fn is_half_space(&self, item: Item) -> bool {
        matches!(item, Item::Leaf(leaf) if self.model.leaves[leaf as usize].shape.half_space().is_some())
    }
}
