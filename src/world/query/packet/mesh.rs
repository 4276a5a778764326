//! Large meshes and many rays from one point: the rays go through the mesh's own tree together.

use super::bundle::each_bit;
use super::rays::{RayPacket4, RayStream};
use crate::base::accel::Bundle;
use crate::base::math::Ray;
use crate::base::math::simd::vec3::{Vec3Lanes, divide, dot, scale, splat, sub, to_arrays};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::base::math::watertight::{RayFrame, RayFrames4};
use crate::scene::shape::{Mesh, Shape};
use crate::world::bvh_items::IndexedItem;
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::model::Item;
use crate::world::primitive::Leaf;
use crate::world::query::{ClosestHit, Occlusion, Query, Scratch};
use glam::{DAffine3, DVec3};

/// Meshes of fewer triangles are asked by one ray at a time, as all other shapes.
const LEAST_TRIANGLES: usize = 256;
/// Among more meshes than this rays find their way one by one.
const MOST_MESHES: usize = 8;

/// Buffers that a thread keeps between meshes.
#[derive(Debug, Default)]
pub(in crate::world) struct MeshScratch {
    bundle: Bundle,
    /// The rays in the space of the mesh.
    rays: Vec<MeshPacket>,
    /// What triangles ask of them, once some of four have come to one.
    frames: Vec<Option<TriangleFrames>>,
}

/// Four rays made ready for triangles.
#[derive(Debug)]
struct TriangleFrames {
    each: [RayFrame; 4],
    /// Them together, where they are longest along the same axis.
    four: Option<RayFrames4>,
}

/// Four rays in the space of a mesh.
#[derive(Clone, Copy, Debug)]
struct MeshPacket {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    /// The unit directions from the common point.
    unit_dir: [[f64; 4]; 3],
    /// How far the rays go in a unit of their parameter.
    speed: [f64; 4],
    /// How far from the common point they start.
    distance: [f64; 4],
}

impl MeshPacket {
    fn frames(&self) -> TriangleFrames {
        let one_of = |of: &[[f64; 4]; 3], lane: usize| of.map(|axis| axis[lane]).into();
        let frame = |lane| {
            RayFrame::new(&Ray::new(
                one_of(&self.origin, lane),
                one_of(&self.dir, lane),
            ))
        };
        let each = [frame(0), frame(1), frame(2), frame(3)];
        TriangleFrames {
            four: RayFrames4::new(&each),
            each,
        }
    }
}

impl MeshScratch {
    /// Four rays made ready.
    #[inline(always)]
    fn ready(&mut self, number: usize) -> &TriangleFrames {
        let rays = &self.rays[number];
        self.frames[number].get_or_insert_with(|| rays.frames())
    }
}

/// Four queries on their way into a mesh. They have the point `origin` in common, and go from there, or come from there
/// (`sign` -1).
struct MeshEntry<'a> {
    queries: &'a RayPacket4,
    matrix: Option<&'a DAffine3>,
    origin: DVec3,
    sign: f64,
}

impl SimdKernel for MeshEntry<'_> {
    type Output = MeshPacket;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> MeshPacket {
        let mut rays = self.queries.load::<F>();
        let mut speed = F::splat(1.0);
        let mut unit_dir = rays.dir;
        if let Some(matrix) = self.matrix {
            rays = rays.to_object(matrix);
            speed = dot(rays.dir, rays.dir).sqrt();
            unit_dir = divide(rays.dir, speed);
        }
        let way: Vec3Lanes<F> = sub(rays.origin, splat(self.origin));
        MeshPacket {
            origin: to_arrays(rays.origin),
            dir: to_arrays(rays.dir),
            unit_dir: to_arrays(scale(unit_dir, F::splat(self.sign))),
            speed: speed.to_array(),
            distance: dot(way, way).sqrt().to_array(),
        }
    }
}

/// A mesh of a world, for rays that go together.
struct MeshQuery<'w> {
    number: u32,
    leaf: &'w Leaf,
    mesh: &'w Mesh,
}

impl World {
    /// The items that are meshes through which rays go together; none if there are too many of them.
    pub(in crate::world) fn large_meshes(&self) -> Vec<IndexedItem> {
        if self.finder().tree.has_only_spheres() {
            return Vec::new();
        }
        let is_large = |item: &&IndexedItem| {
            let asked = self.asked(**item);
            asked.is_some_and(|asked| asked.mesh.is_patch() && asked.mesh.len() >= LEAST_TRIANGLES)
        };
        let meshes: Vec<IndexedItem> = self
            .finder()
            .bounded
            .iter()
            .filter(is_large)
            .copied()
            .collect();
        if meshes.len() <= MOST_MESHES {
            meshes
        } else {
            Vec::new()
        }
    }

    /// Whether rays that go together have been through an item already.
    #[inline(always)]
    pub(in crate::world) fn is_large_mesh(&self, item: IndexedItem) -> bool {
        self.meshes.iter().any(|mesh| mesh.number == item.number)
    }

    fn asked(&self, item: IndexedItem) -> Option<MeshQuery<'_>> {
        let Item::Leaf(number) = item.item else {
            return None;
        };
        let leaf = &self.model.leaves[number as usize];
        match &leaf.shape {
            Shape::Mesh(mesh) => Some(MeshQuery { number, leaf, mesh }),
            _ => None,
        }
    }

    /// Lets the queries of a lot, which start at one point, go through the large meshes that they may meet, and makes
    /// `bests` and `bundle` know what they find. False if some could not go together.
    #[inline(always)]
    pub(in crate::world) fn see_meshes(
        &self,
        lanes: SimdLevel,
        (lot, bests): (&mut RayStream, &mut [Option<ClosestHit>]),
        query: impl Fn(usize) -> Query,
        (bundle, origin): (&mut Bundle, DVec3),
        scratch: &mut Scratch,
    ) -> bool {
        for &item in &self.meshes {
            let Some(asked) = self.asked(item).filter(|_| self.may_meet(bundle, item)) else {
                continue;
            };
            let mut own = std::mem::take(&mut scratch.mesh);
            let count = bests.len();
            let mut bundle_of_mesh = std::mem::take(&mut own.bundle);
            let entering = (lanes, &mut own, &mut bundle_of_mesh);
            let is_done = asked.enter(entering, (origin, 1.0), count, lot)
                && asked.mesh.tree().together(
                    lanes,
                    &mut bundle_of_mesh,
                    #[inline(always)]
                    |face, first, rays, ended| {
                        asked.meet(
                            lanes,
                            (&mut own, lot),
                            (face, first, rays),
                            #[inline(always)]
                            |lot, ray, t, speed| {
                                let found = asked.found(t, face);
                                let far = lot.far(ray);
                                let best = &mut bests[ray];
                                // Of several triangles at the same distance the first in the list is drawn.
                                if let Some(best) = best
                                    && best.item == item.number
                                    && best.found.root.t == t
                                {
                                    if face < best.found.root.face {
                                        best.found = found;
                                    }
                                    return;
                                }
                                let query = query(ray);
                                if !self.is_seen(&found, query.kind) {
                                    return;
                                }
                                let new =
                                    self.accept_if_closer(item.number, found, &query, far, best);
                                if new < far {
                                    lot.shorten(ray, new);
                                    bundle.shorten(ray, new);
                                    ended.note(ray - first, new * speed);
                                }
                            },
                        );
                    },
                );
            own.bundle = bundle_of_mesh;
            scratch.mesh = own;
            if !is_done {
                return false;
            }
        }
        true
    }

    /// The same for rays to a light at `centre`: `ways` learns what is blocked.
    #[inline(always)]
    pub(in crate::world) fn meshes_block(
        &self,
        lanes: SimdLevel,
        (lot, ways): (&mut RayStream, &mut [Occlusion]),
        query: impl Fn(usize) -> Query,
        (bundle, centre): (&mut Bundle, DVec3),
        scratch: &mut Scratch,
    ) -> bool {
        for &item in &self.meshes {
            let Some(asked) = self.asked(item).filter(|_| self.may_meet(bundle, item)) else {
                continue;
            };
            let mut own = std::mem::take(&mut scratch.mesh);
            let count = ways.len();
            let mut bundle_of_mesh = std::mem::take(&mut own.bundle);
            let entering = (lanes, &mut own, &mut bundle_of_mesh);
            let is_done = asked.enter(entering, (centre, -1.0), count, lot)
                && asked.mesh.tree().together(
                    lanes,
                    &mut bundle_of_mesh,
                    #[inline(always)]
                    |face, first, rays, ended| {
                        asked.meet(
                            lanes,
                            (&mut own, lot),
                            (face, first, rays),
                            #[inline(always)]
                            |_, ray, t, _| {
                                if ways[ray] == Occlusion::Opaque {
                                    return;
                                }
                                let query = query(ray);
                                let is_left = query.origin_surface.is_some_and(|left| {
                                    left.leaf == asked.number && left.face == face
                                });
                                if is_left || t >= query.t_max {
                                    return;
                                }
                                let found = asked.found(t, face);
                                if self.blocks_light(&found, &query, &mut ways[ray]) {
                                    ways[ray] = Occlusion::Opaque;
                                    bundle.shorten(ray, f64::NEG_INFINITY);
                                    ended.note(ray - first, f64::NEG_INFINITY);
                                }
                            },
                        );
                    },
                );
            own.bundle = bundle_of_mesh;
            scratch.mesh = own;
            if !is_done {
                return false;
            }
        }
        true
    }

    fn may_meet(&self, bundle: &Bundle, item: IndexedItem) -> bool {
        let bounds = self.boxes[item.number as usize].bounds();
        bundle.may_meet(&self.finder().tree, &bounds)
    }
}

impl MeshQuery<'_> {
    /// Makes the queries ready for the tree of the mesh. They have the point `origin` in common and go from there in
    /// their direction, or come from there (`sign` -1).
    #[inline(always)]
    fn enter(
        &self,
        (lanes, own, bundle): (SimdLevel, &mut MeshScratch, &mut Bundle),
        (origin, sign): (DVec3, f64),
        count: usize,
        lot: &RayStream,
    ) -> bool {
        let origin = self.leaf.point_to_object(origin);
        own.rays.clear();
        own.frames.clear();
        for first in (0..count).step_by(4) {
            let entering = MeshEntry {
                queries: lot.four(first),
                matrix: self.leaf.object_from_world.as_deref(),
                origin,
                sign,
            };
            own.rays.push(lanes.run(entering));
            own.frames.push(None);
        }
        let rays = &own.rays;
        bundle.fill(
            self.mesh.tree(),
            origin,
            count,
            #[inline(always)]
            |four| {
                let (far, rays) = (&lot.four(4 * four).far, &rays[four]);
                let mut ends = [f64::NEG_INFINITY; 4];
                for (lane, end) in ends.iter_mut().enumerate() {
                    if far[lane] >= 0.0 {
                        *end = if sign < 0.0 {
                            rays.distance[lane]
                        } else {
                            far[lane] * rays.speed[lane]
                        };
                    }
                }
                (rays.unit_dir, ends)
            },
        )
    }

    /// Calls `take` with the number, the parameter and the speed of each of some rays, those of `rays` from the first on,
    /// that meet a triangle before they end.
    #[inline(always)]
    fn meet(
        &self,
        lanes: SimdLevel,
        (own, lot): (&mut MeshScratch, &mut RayStream),
        (face, first, rays): (u32, usize, u32),
        mut take: impl FnMut(&mut RayStream, usize, f64, f64),
    ) {
        for half in [0, 4] {
            let some = rays >> half & 0b1111;
            if some == 0 {
                continue;
            }
            let start = first + half as usize;
            let speed = own.rays[start / 4].speed;
            let frames = own.ready(start / 4);
            let mut singly = some;
            if let Some(four) = &frames.four
                && !some.is_power_of_two()
            {
                let found = self.mesh.meet_four(lanes, four, face);
                singly &= found.unknown;
                each_bit(found.met & some, |lane| {
                    let (ray, t) = (start + lane, found.t[lane % 4]);
                    if lot.from(ray) < t && t <= lot.far(ray) {
                        take(lot, ray, t, speed[lane % 4]);
                    }
                });
            }
            each_bit(singly, |lane| {
                let ray = start + lane;
                if let Some(t) = self.mesh.meet(&frames.each[lane % 4], face)
                    && lot.from(ray) < t
                    && t <= lot.far(ray)
                {
                    take(lot, ray, t, speed[lane % 4]);
                }
            });
        }
    }

    #[inline(always)]
    fn found(&self, t: f64, face: u32) -> RawHit {
        RawHit {
            root: Mesh::root(t, face),
            leaf: self.number,
            surface: self.leaf.surface,
        }
    }
}
