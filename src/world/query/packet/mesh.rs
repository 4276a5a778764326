//! Large meshes and ray bundles: the rays traverse the BVH of the mesh together.

use super::bundle::{PointBundle, StreamPacket, each_bit};
use super::csg_packet::may_be_self_hit;
use super::rays::{RayPacket4, RayStream};
use crate::base::accel::Bundle;
use crate::base::math::Ray;
use crate::base::math::simd::vec3::{Vec3Lanes, divide, dot, scale, splat, sub, to_arrays};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel, with_widest};
use crate::base::math::watertight::{RayFrame, RayFrames4};
use crate::scene::shape::{Mesh, Shape};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::model::IndexedItem;
use crate::world::model::Item;
use crate::world::primitive::Leaf;
use crate::world::query::{ClosestHit, QueryScratch};
use crate::world::ray::{Occlusion, Query};
use glam::{DAffine3, DVec3};

/// Smaller meshes are intersected by one ray at a time, like all other shapes.
const MIN_TRIANGLES: usize = 256;
/// With more meshes than this, all rays traverse them one by one.
const MAX_MESHES: usize = 8;

/// Per-thread buffers that are reused between meshes.
#[derive(Debug, Default)]
pub(in crate::world) struct MeshScratch {
    bundle: Bundle,
    /// The rays in object space.
    rays: Vec<MeshPacket>,
    /// Their data for triangle tests, computed once some ray of a packet reaches a triangle.
    frames: Vec<Option<TriangleFrames>>,
}

/// A ray packet prepared for triangle tests.
#[derive(Debug)]
struct TriangleFrames {
    each: [RayFrame; 4],
    /// The rays as a packet, if they share their dominant axis.
    packet: Option<RayFrames4>,
}

/// A ray packet in object space.
#[derive(Clone, Copy, Debug)]
struct MeshPacket {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    /// Unit directions from the common point.
    unit_dir: [[f64; 4]; 3],
    /// Lengths of the directions: distance per unit of the ray parameter.
    speed: [f64; 4],
    /// Distances of the origins from the common point.
    distance: [f64; 4],
}

/// The rays of a packet.
#[inline(always)]
fn rays_of(origin: &[[f64; 4]; 3], dir: &[[f64; 4]; 3]) -> [Ray; 4] {
    let one_of =
        |of: &[[f64; 4]; 3], lane: usize| DVec3::new(of[0][lane], of[1][lane], of[2][lane]);
    let ray = |lane| Ray::new(one_of(origin, lane), one_of(dir, lane));
    [ray(0), ray(1), ray(2), ray(3)]
}

impl TriangleFrames {
    fn new(rays: &[Ray; 4]) -> Self {
        let [a, b, c, d] = rays;
        let each = [
            RayFrame::new(a),
            RayFrame::new(b),
            RayFrame::new(c),
            RayFrame::new(d),
        ];
        TriangleFrames {
            packet: RayFrames4::new(&each),
            each,
        }
    }

    /// Calls `take` with the lane and the parameter of each active ray whose line hits a triangle.
    #[inline(always)]
    fn intersect(
        &self,
        lanes: SimdLevel,
        mesh: &Mesh,
        face: u32,
        active: u32,
        mut take: impl FnMut(usize, f64),
    ) {
        let mut scalar = active;
        if let Some(packet) = &self.packet
            && !active.is_power_of_two()
        {
            let hits = mesh.intersect_triangle_packet(lanes, packet, face);
            scalar &= hits.unknown;
            each_bit(hits.hit_mask & active, |lane| take(lane, hits.t[lane % 4]));
        }
        each_bit(scalar, |lane| {
            if let Some(t) = mesh.intersect_triangle(&self.each[lane % 4], face) {
                take(lane, t);
            }
        });
    }
}

impl MeshScratch {
    /// The triangle-test data of a packet.
    #[inline(always)]
    fn ready(&mut self, number: usize) -> &TriangleFrames {
        let rays = &self.rays[number];
        self.frames[number]
            .get_or_insert_with(|| TriangleFrames::new(&rays_of(&rays.origin, &rays.dir)))
    }
}

/// Transforms a ray packet to the object space of a mesh. The rays share the point `origin`, and start there (`sign` 1)
/// or end there (`sign` -1).
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
        let offset: Vec3Lanes<F> = sub(rays.origin, splat(self.origin));
        MeshPacket {
            origin: to_arrays(rays.origin),
            dir: to_arrays(rays.dir),
            unit_dir: to_arrays(scale(unit_dir, F::splat(self.sign))),
            speed: speed.to_array(),
            distance: dot(offset, offset).sqrt().to_array(),
        }
    }
}

/// Transforms a ray packet to the object space of a leaf.
struct ObjectRays<'a> {
    queries: &'a RayPacket4,
    leaf: &'a Leaf,
}

impl SimdKernel for ObjectRays<'_> {
    type Output = [Ray; 4];

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> [Ray; 4] {
        let mut rays = self.queries.load::<F>();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        rays_of(&to_arrays(rays.origin), &to_arrays(rays.dir))
    }
}

/// The common point of a bundle's rays, which start there (`sign` 1) or end there (`sign` -1).
#[derive(Clone, Copy)]
struct CommonPoint {
    point: DVec3,
    sign: f64,
}

/// A triangle and up to eight rays that may hit it.
#[derive(Clone, Copy)]
struct TriangleRays {
    face: u32,
    /// Index of the first ray.
    first: usize,
    /// Mask of the active rays, from the first on.
    active: u32,
}

/// Index of no triangle.
const NO_FACE: u32 = u32::MAX;

/// The first hits of four rays on a mesh.
struct NearestTriangles {
    t: [f64; 4],
    /// The triangles; [`NO_FACE`] for rays that hit none.
    face: [u32; 4],
}

/// A mesh item.
pub(in crate::world) struct MeshQuery<'w> {
    number: u32,
    leaf: &'w Leaf,
    mesh: &'w Mesh,
}

impl World {
    /// The mesh items that bundles traverse; none if there are too many.
    pub(in crate::world) fn large_meshes(&self) -> Vec<IndexedItem> {
        if self.bvh().tree.has_only_spheres() {
            return Vec::new();
        }
        let is_large = |item: &&IndexedItem| {
            let mesh_query = self.mesh_query(**item);
            mesh_query.is_some_and(|mesh_query| mesh_query.mesh.len() >= MIN_TRIANGLES)
        };
        let meshes: Vec<IndexedItem> = self
            .bvh()
            .bounded
            .iter()
            .filter(is_large)
            .copied()
            .collect();
        if meshes.len() <= MAX_MESHES {
            meshes
        } else {
            Vec::new()
        }
    }

    /// Returns true if bundles handle this item as a large mesh.
    #[inline(always)]
    pub(in crate::world) fn is_large_mesh(&self, item: IndexedItem) -> bool {
        self.meshes.iter().any(|mesh| mesh.number == item.number)
    }

    fn mesh_query(&self, item: IndexedItem) -> Option<MeshQuery<'_>> {
        let Item::Leaf(number) = item.item else {
            return None;
        };
        self.mesh_of_leaf(number)
    }

    /// A leaf, if it is a mesh that packets intersect.
    #[inline(always)]
    pub(in crate::world) fn mesh_of_leaf(&self, number: u32) -> Option<MeshQuery<'_>> {
        let leaf = &self.model.leaves[number as usize];
        match &leaf.shape {
            Shape::Mesh(mesh) if mesh.suits_packets() => Some(MeshQuery { number, leaf, mesh }),
            _ => None,
        }
    }

    /// Intersects a bundle of rays from one point with the large meshes in its frustum, and updates `bests` and
    /// `bundle`. Returns false if some mesh could not be traversed by a bundle.
    #[inline(always)]
    pub(in crate::world) fn intersect_meshes(
        &self,
        lanes: SimdLevel,
        stream: &mut RayStream,
        bests: &mut [Option<ClosestHit>],
        query: impl Fn(usize) -> Query,
        rays: PointBundle,
        scratch: &mut QueryScratch,
    ) -> bool {
        self.traverse_meshes(
            lanes,
            (bests.len(), stream),
            (rays, 1.0),
            scratch,
            #[inline(always)]
            |stream, item, ray, hit| {
                let far = stream.t_max(ray);
                let best = &mut bests[ray];
                // Of several triangles at the same distance, the first in the list wins.
                if let Some(best) = best
                    && best.item == item
                    && best.hit.root.t == hit.root.t
                {
                    if hit.root.face < best.hit.root.face {
                        best.hit = hit;
                    }
                    return None;
                }
                let query = query(ray);
                if !self.is_seen(&hit, query.kind) {
                    return None;
                }
                let new = self.accept_if_closer(item, hit, &query, far, best);
                (new < far).then(|| {
                    stream.shorten(ray, new);
                    new
                })
            },
        )
    }

    /// Same for shadow rays to a light at the point: updates `occlusions`.
    #[inline(always)]
    pub(in crate::world) fn occlude_by_meshes(
        &self,
        lanes: SimdLevel,
        stream: &mut RayStream,
        occlusions: &mut [Occlusion],
        query: impl Fn(usize) -> Query,
        rays: PointBundle,
        scratch: &mut QueryScratch,
    ) -> bool {
        self.traverse_meshes(
            lanes,
            (occlusions.len(), stream),
            (rays, -1.0),
            scratch,
            #[inline(always)]
            |_, _, ray, hit| {
                let occlusion = &mut occlusions[ray];
                if *occlusion == Occlusion::Opaque {
                    return None;
                }
                let query = query(ray);
                let is_self_hit = query
                    .origin_surface
                    .is_some_and(|origin| origin.leaf == hit.leaf && origin.face == hit.root.face);
                if is_self_hit || hit.root.t >= query.t_max {
                    return None;
                }
                self.blocks_light(&hit, &query, occlusion).then(|| {
                    *occlusion = Occlusion::Opaque;
                    f64::NEG_INFINITY
                })
            },
        )
    }

    /// Traverses the large meshes in the frustum of a bundle of `count` rays, which start (`sign` 1) or end (`sign` -1)
    /// at its point. `meet` gets the item, the ray and the hit of each ray within its limits, and returns the new end of
    /// the ray if it is shortened. Returns false if some mesh could not be traversed by a bundle.
    #[inline(always)]
    fn traverse_meshes(
        &self,
        lanes: SimdLevel,
        (count, stream): (usize, &mut RayStream),
        (PointBundle { bundle, point }, sign): (PointBundle, f64),
        scratch: &mut QueryScratch,
        mut meet: impl FnMut(&mut RayStream, u32, usize, RawHit) -> Option<f64>,
    ) -> bool {
        let common = CommonPoint { point, sign };
        for &item in &self.meshes {
            let Some(mesh_query) = self
                .mesh_query(item)
                .filter(|_| self.may_meet(bundle, item))
            else {
                continue;
            };
            let mut buffers = std::mem::take(&mut scratch.mesh);
            let mut bundle_of_mesh = std::mem::take(&mut buffers.bundle);
            let is_done = mesh_query.enter(
                lanes,
                &mut buffers,
                &mut bundle_of_mesh,
                common,
                count,
                stream,
            ) && mesh_query.mesh.tree().traverse_bundle(
                lanes,
                &mut bundle_of_mesh,
                #[inline(always)]
                |face, first, active, ended| {
                    mesh_query.intersect(
                        lanes,
                        &mut buffers,
                        stream,
                        TriangleRays {
                            face,
                            first,
                            active,
                        },
                        #[inline(always)]
                        |stream, ray, t, speed| {
                            let hit = mesh_query.hit(t, face);
                            if let Some(end) = meet(stream, item.number, ray, hit) {
                                bundle.shorten(ray, end);
                                ended.set(ray - first, end * speed);
                            }
                        },
                    );
                },
            );
            buffers.bundle = bundle_of_mesh;
            scratch.mesh = buffers;
            if !is_done {
                return false;
            }
        }
        true
    }

    /// Intersects four rays, which start at index `start`, with a mesh without an inside up to and including their far
    /// limits, and calls `take` for each ray that hits. With `ANY` (occlusion) the hit need not be the first. Returns the
    /// lanes that need the scalar path.
    #[inline(always)]
    pub(in crate::world) fn packet4_mesh<const ANY: bool>(
        &self,
        mesh_query: &MeshQuery,
        packet: StreamPacket,
        query: impl Fn(usize) -> Query,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let StreamPacket {
            stream,
            start,
            active,
        } = packet;
        let rays = stream.packet(start);
        let from = rays.t_min;
        let mut left = [NO_FACE; 4];
        each_bit(rays.start_on(mesh_query.number) & active, |lane| {
            let origin = query(start + lane).origin_surface;
            left[lane % 4] = origin.map_or(NO_FACE, |origin| origin.face);
        });
        let nearest = mesh_query.nearest_packet::<ANY>(rays, left, active);
        let mut unknown = 0;
        for (lane, from) in from.into_iter().enumerate() {
            let (t, face) = (nearest.t[lane], nearest.face[lane]);
            if face == NO_FACE {
                continue;
            }
            if may_be_self_hit(from, t) {
                unknown |= 1 << lane;
            } else {
                take(stream, start + lane, mesh_query.hit(t, face));
            }
        }
        unknown
    }

    fn may_meet(&self, bundle: &Bundle, item: IndexedItem) -> bool {
        let bounds = self.boxes[item.number as usize].bounds();
        bundle.may_hit(&self.bvh().tree, &bounds)
    }
}

impl MeshQuery<'_> {
    /// Prepares the rays for the BVH of the mesh. They share the point `origin`, and start there (`sign` 1) or end
    /// there (`sign` -1).
    #[inline(always)]
    fn enter(
        &self,
        lanes: SimdLevel,
        buffers: &mut MeshScratch,
        bundle: &mut Bundle,
        common: CommonPoint,
        count: usize,
        stream: &RayStream,
    ) -> bool {
        let sign = common.sign;
        let origin = self.leaf.point_to_object(common.point);
        buffers.rays.clear();
        buffers.frames.clear();
        for first in (0..count).step_by(4) {
            let entering = MeshEntry {
                queries: stream.packet(first),
                matrix: self.leaf.object_from_world.as_deref(),
                origin,
                sign,
            };
            buffers.rays.push(lanes.run(entering));
            buffers.frames.push(None);
        }
        let rays = &buffers.rays;
        bundle.fill(
            self.mesh.tree(),
            origin,
            count,
            #[inline(always)]
            |packet| {
                let (far, rays) = (&stream.packet(4 * packet).t_max, &rays[packet]);
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

    /// Intersects a triangle with some rays: calls `take` with the index, the parameter and the speed of each ray that
    /// hits it within its limits.
    #[inline(always)]
    fn intersect(
        &self,
        lanes: SimdLevel,
        buffers: &mut MeshScratch,
        stream: &mut RayStream,
        rays: TriangleRays,
        mut take: impl FnMut(&mut RayStream, usize, f64, f64),
    ) {
        for half in [0, 4] {
            let some = rays.active >> half & 0b1111;
            if some == 0 {
                continue;
            }
            let start = rays.first + half as usize;
            let speed = buffers.rays[start / 4].speed;
            let frames = buffers.ready(start / 4);
            frames.intersect(lanes, self.mesh, rays.face, some, |lane, t| {
                let ray = start + lane;
                if stream.t_min(ray) < t && t <= stream.t_max(ray) {
                    take(stream, ray, t, speed[lane % 4]);
                }
            });
        }
    }

    /// The first hits of the active rays within their limits, except on the triangle that each has left. With `ANY` a
    /// hit before the far limit ends the search.
    #[inline(never)]
    fn nearest_packet<const ANY: bool>(
        &self,
        rays: &RayPacket4,
        left: [u32; 4],
        active: u32,
    ) -> NearestTriangles {
        let RayPacket4 { t_min, t_max, .. } = rays;
        let mut nearest = NearestTriangles {
            t: *t_max,
            face: [NO_FACE; 4],
        };
        with_widest(
            #[inline(always)]
            |lanes| {
                let own = lanes.run(ObjectRays {
                    queries: rays,
                    leaf: self.leaf,
                });
                // Many packets that hit the box of a mesh reach no triangle.
                let mut frames = None;
                self.mesh.tree().traverse_stream(
                    lanes,
                    active,
                    #[inline(always)]
                    |lane| (own[lane % 4], t_max[lane % 4]),
                    #[inline(always)]
                    |face, active, ended| {
                        let frames = frames.get_or_insert_with(
                            #[inline(always)]
                            || TriangleFrames::new(&own),
                        );
                        frames.intersect(lanes, self.mesh, face, active, |lane, t| {
                            let lane = lane % 4;
                            // Of several triangles at the same distance, the first in the list wins.
                            let nearest = (&mut nearest.t[lane], &mut nearest.face[lane]);
                            if face != left[lane]
                                && t_min[lane] < t
                                && (t, face) < (*nearest.0, *nearest.1)
                            {
                                (*nearest.0, *nearest.1) = (t, face);
                                let is_done = ANY && t < t_max[lane];
                                ended.set(lane, if is_done { f64::NEG_INFINITY } else { t });
                            }
                        });
                    },
                );
            },
        );
        nearest
    }

    #[inline(always)]
    fn hit(&self, t: f64, face: u32) -> RawHit {
        RawHit {
            root: Mesh::root(t, face),
            leaf: self.number,
            surface: self.leaf.surface,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::{Bounds, Step};
    use crate::scene::shape::MeshLists;
    use crate::world::primitive::{Absorb, Extent};
    use crate::world::ray::RayKind;

    #[test]
    fn packets_hit_what_single_rays_hit() {
        let mut rng = Random::new(5);
        let vertices: Vec<DVec3> = (0..30).map(|_| rng.vector(1.0)).collect();
        // Each triangle is there twice, so that hits tie.
        let faces: Vec<[u32; 3]> = (0..40u32)
            .map(|i| [i % 20, i % 20 + 3, i % 20 + 7])
            .collect();
        let lists = MeshLists {
            vertices: &vertices,
            faces: &faces,
            ..MeshLists::default()
        };
        let shape = Shape::Mesh(Mesh::from_lists(&lists).unwrap());
        let turned = [
            Step::Rotate(DVec3::new(20.0, 30.0, 40.0)),
            Step::Scale(DVec3::new(1.0, 2.0, 0.5)),
        ];
        let bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);
        let mut stream = RayStream::default();
        let mut hit_count = 0;
        for case in 0..8000 {
            let steps = [&[][..], &turned][case % 2];
            let (leaf, _) = Leaf::new(shape.clone(), steps, Absorb::AllItCan, 0, Extent::Surface);
            let Shape::Mesh(mesh) = &leaf.shape else {
                panic!("a mesh stays one");
            };
            let mesh_query = MeshQuery {
                number: 0,
                leaf: &leaf,
                mesh,
            };
            let rays = [(); 4].map(|()| rng.ray_near(&bounds));
            let [from, far] = [0.2, if case % 3 == 0 { 1.5 } else { f64::INFINITY }];
            let query = |ray: usize| Query {
                ray: rays[ray],
                origin_surface: None,
                t_max: far,
                kind: RayKind::Camera,
            };
            let alone = |lane: usize, left: u32| leaf.nearest_beside(&rays[lane], from, far, left);
            // Half of the rays start on the triangle that they would hit.
            let left = [0, 1, 2, 3].map(|lane| match alone(lane, NO_FACE) {
                Some(root) if lane % 2 == 0 => root.face,
                _ => NO_FACE,
            });
            stream.load_rays(4, query, |_| from);
            let packet = stream.packet(0);
            let nearest = mesh_query.nearest_packet::<false>(packet, left, 0b1110);
            let any = mesh_query.nearest_packet::<true>(packet, left, 0b1110);
            assert_eq!((nearest.face[0], any.face[0]), (NO_FACE, NO_FACE));
            for lane in [1, 2, 3] {
                let hit = (nearest.face[lane] != NO_FACE)
                    .then_some((nearest.t[lane], nearest.face[lane]));
                let expected = alone(lane, left[lane]).map(|root| (root.t, root.face));
                assert_eq!(hit, expected);
                assert_eq!(any.face[lane] != NO_FACE, expected.is_some());
                hit_count += u32::from(hit.is_some());
            }
        }
        assert!(hit_count > 2000, "{hit_count}");
    }
}
