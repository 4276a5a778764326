//! Hits of ray packets and their shadow rays, as structures of arrays for SIMD.

use crate::base::math::Ray;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, dot, from_arrays, max_abs, scale, sub, to_arrays,
};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, SimdLevel};
use crate::base::memory::prefetch;
use crate::scene::shape::Crossing;
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::query::ClosestHit;
use crate::world::ray::{BLUR, Hit, Occlusion, Query, RayKind, SpawnSurface};
use glam::DVec3;

/// Index that stands for no leaf.
pub const NO_LEAF: u32 = u32::MAX;

/// Four rays and their hits. The values of rays without a hit are unspecified.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct HitPacket4 {
    /// The unit directions of the rays.
    pub dir: [[f64; 4]; 3],
    /// The distances along them.
    pub t: [f64; 4],
    /// The hit points in world space.
    pub point: [[f64; 4]; 3],
    /// The outward geometric unit normals.
    pub normal: [[f64; 4]; 3],
    /// The unit normals for shading that face the rays, before any `normal` pattern.
    pub facing: [[f64; 4]; 3],
    /// Error bounds of the coordinates.
    pub blur: [f64; 4],
    /// The leaves; [`NO_LEAF`] where nothing is hit.
    pub leaf: [u32; 4],
    /// The faces of the leaves.
    pub face: [u32; 4],
    /// Indices into [`World::surfaces`].
    pub surface: [u32; 4],
    /// The crossings.
    pub crossing: [Crossing; 4],
    /// Mask of the rays that hit something.
    pub hit_mask: u32,
    /// Mask of the rays whose shading normals are flipped to face them.
    turned: u32,
}

impl HitPacket4 {
    /// Rays without direction and without hits.
    pub const NOTHING: HitPacket4 = HitPacket4 {
        dir: [[0.0; 4]; 3],
        t: [f64::INFINITY; 4],
        point: [[0.0; 4]; 3],
        normal: [[0.0; 4]; 3],
        facing: [[0.0; 4]; 3],
        blur: [0.0; 4],
        leaf: [NO_LEAF; 4],
        face: [0; 4],
        surface: [0; 4],
        crossing: [Crossing::Touch; 4],
        hit_mask: 0,
        turned: 0,
    };

    /// One surface point in all four lanes, as the origin of spawned rays.
    #[must_use]
    pub fn all_at(point: DVec3, departure: &SpawnSurface) -> HitPacket4 {
        let each = |v: DVec3| v.to_array().map(|x| [x; 4]);
        HitPacket4 {
            point: each(point),
            normal: each(departure.normal),
            leaf: [departure.leaf; 4],
            face: [departure.face; 4],
            crossing: [departure.crossing; 4],
            blur: [departure.blur; 4],
            hit_mask: 0b1111,
            ..HitPacket4::NOTHING
        }
    }

    /// The direction of a ray.
    #[must_use]
    #[inline(always)]
    pub fn dir(&self, lane: usize) -> DVec3 {
        one_of(&self.dir, lane)
    }

    /// Sets the direction of a ray.
    #[inline(always)]
    pub fn aim(&mut self, lane: usize, dir: DVec3) {
        put(&mut self.dir, lane, dir);
    }

    /// Clears all hits.
    #[inline(always)]
    pub(in crate::world) fn clear_hits(&mut self) {
        self.hit_mask = 0;
        self.leaf = [NO_LEAF; 4];
    }

    /// The hit point of a ray.
    #[must_use]
    #[inline(always)]
    pub fn point(&self, lane: usize) -> DVec3 {
        one_of(&self.point, lane)
    }

    /// The unit normal for shading that faces the ray.
    #[must_use]
    #[inline(always)]
    pub fn facing(&self, lane: usize) -> DVec3 {
        one_of(&self.facing, lane)
    }

    /// Returns true if a ray hits something.
    #[must_use]
    #[inline(always)]
    pub fn is_hit(&self, lane: usize) -> bool {
        self.hit_mask >> lane & 1 == 1
    }

    /// The outward unit normal for shading.
    #[must_use]
    #[inline]
    pub fn shading_normal(&self, lane: usize) -> DVec3 {
        let facing = self.facing(lane);
        if self.turned >> lane & 1 == 1 {
            -facing
        } else {
            facing
        }
    }

    /// Origin surface for the rays spawned at a hit.
    #[must_use]
    #[inline]
    pub fn spawn_surface(&self, lane: usize) -> SpawnSurface {
        SpawnSurface {
            leaf: self.leaf[lane],
            face: self.face[lane],
            normal: one_of(&self.normal, lane),
            crossing: self.crossing[lane],
            blur: self.blur[lane],
        }
    }

    /// The hit of a ray, if it has one.
    #[must_use]
    pub fn hit(&self, lane: usize) -> Option<Hit> {
        self.is_hit(lane).then(|| Hit {
            t: self.t[lane],
            point: self.point(lane),
            shading_normal: self.shading_normal(lane),
            surface: self.surface[lane],
            spawn_surface: self.spawn_surface(lane),
        })
    }
}

/// Shadow rays from four hits to a light.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct ShadowPacket4 {
    /// The unit directions to the light.
    pub to_light: [[f64; 4]; 3],
    /// The distances to the light.
    pub distance: [f64; 4],
    /// The cosines between the directions and the normals that face the viewer.
    pub cosine: [f64; 4],
    /// The shares of the light that arrive if nothing is in between.
    pub share: [f64; 4],
    /// Far limits of the shadow rays.
    pub t_max: [f64; 4],
    /// Mask of the rays that go to the outer side of the surface.
    pub goes_out: u32,
    /// Mask of the rays whose occlusion is known; where the light does not matter it stays unknown.
    pub known: u32,
    /// Mask of the rays that an opaque surface blocks.
    pub blocked: u32,
    /// Mask of the other rays that pass a transmissive surface.
    pub filtered: u32,
}

impl ShadowPacket4 {
    /// No shadow rays, nothing known.
    pub const NOTHING: ShadowPacket4 = ShadowPacket4 {
        to_light: [[0.0; 4]; 3],
        distance: [0.0; 4],
        cosine: [0.0; 4],
        share: [0.0; 4],
        t_max: [0.0; 4],
        goes_out: 0,
        known: 0,
        blocked: 0,
        filtered: 0,
    };

    /// Sets the unit direction, the distance and the far limit of one ray.
    #[inline(always)]
    pub fn aim(&mut self, lane: usize, to_light: DVec3, distance: f64, far: f64) {
        put(&mut self.to_light, lane, to_light);
        self.distance[lane] = distance;
        self.t_max[lane] = far;
    }

    /// Marks the occlusion of all rays as unknown.
    #[inline(always)]
    pub fn reset_occlusion(&mut self) {
        (self.known, self.blocked, self.filtered) = (0, 0, 0);
    }

    /// Records the occlusion of one ray.
    #[inline(always)]
    pub fn note(&mut self, lane: usize, occlusion: Occlusion) {
        let bit = 1 << lane;
        self.known |= bit;
        self.blocked |= if occlusion == Occlusion::Opaque {
            bit
        } else {
            0
        };
        self.filtered |= if occlusion == Occlusion::Transmissive {
            bit
        } else {
            0
        };
    }

    /// The occlusion of one ray, if it is known.
    #[must_use]
    #[inline(always)]
    pub fn occlusion(&self, lane: usize) -> Option<Occlusion> {
        let has = |bits: u32| bits >> lane & 1 == 1;
        has(self.known).then(|| {
            if has(self.blocked) {
                Occlusion::Opaque
            } else if has(self.filtered) {
                Occlusion::Transmissive
            } else {
                Occlusion::Clear
            }
        })
    }

    /// The occlusion query of one ray.
    #[must_use]
    #[inline(always)]
    pub fn query(&self, hits: &HitPacket4, lane: usize) -> Query {
        Query {
            ray: Ray::new(hits.point(lane), self.to_light(lane)),
            origin_surface: Some(hits.spawn_surface(lane)),
            t_max: self.t_max[lane],
            kind: RayKind::Shadow,
        }
    }

    /// The direction to the light.
    #[must_use]
    #[inline(always)]
    pub fn to_light(&self, lane: usize) -> DVec3 {
        one_of(&self.to_light, lane)
    }
}

#[inline(always)]
fn one_of(of: &[[f64; 4]; 3], lane: usize) -> DVec3 {
    DVec3::new(of[0][lane], of[1][lane], of[2][lane])
}

#[inline(always)]
fn put(to: &mut [[f64; 4]; 3], lane: usize, v: DVec3) {
    for axis in 0..3 {
        to[axis][lane] = v[axis];
    }
}

/// Computes points, error bounds and normals of four hits from their distances, as if all were on spheres.
struct HitsOnSpheres<'a> {
    origin: &'a [[f64; 4]; 3],
    hits: &'a mut HitPacket4,
    centre: [[f64; 4]; 3],
}

impl SimdKernel for HitsOnSpheres<'_> {
    /// Masks of the lanes whose values are exact: of the points, then of the normals. The other lanes may have
    /// overflowed.
    type Output = [u32; 2];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [u32; 2] {
        let hits = self.hits;
        let (dir, t) = (from_arrays(&hits.dir), F::from_array(&hits.t));
        let point = add(from_arrays(self.origin), scale(dir, t));
        let size = max_abs(point).lane_max(t);
        let [x, y, z] = [point[0].abs(), point[1].abs(), point[2].abs()];
        let is_finite = (x + y + z).lt(F::splat(f64::INFINITY));
        let normal = sub(point, from_arrays(&self.centre));
        let length_sq = dot(normal, normal);
        let is_normal =
            F::splat(f64::MIN_POSITIVE).le(length_sq) & length_sq.lt(F::splat(f64::INFINITY));
        let normal = scale(normal, F::splat(1.0) / length_sq.sqrt());
        let (facing, turned) = facing(normal, dir);
        hits.point = to_arrays(point);
        hits.blur = (F::splat(BLUR) * size).to_array();
        hits.normal = to_arrays(normal);
        hits.facing = to_arrays(facing);
        hits.turned = turned;
        [F::bitmask(is_finite), F::bitmask(is_normal)]
    }
}

/// Flips the normals of four hits to face the viewer.
struct FaceForward<'a> {
    hits: &'a mut HitPacket4,
}

impl SimdKernel for FaceForward<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: F64x4>(self) {
        let normal: Vec3Lanes<F> = from_arrays(&self.hits.facing);
        let (facing, turned) = facing(normal, from_arrays(&self.hits.dir));
        self.hits.facing = to_arrays(facing);
        self.hits.turned = turned;
    }
}

/// Four normals flipped to face rays of these directions, and the mask of the flipped ones.
#[inline(always)]
fn facing<F: F64Lanes>(normal: Vec3Lanes<F>, dir: Vec3Lanes<F>) -> (Vec3Lanes<F>, u32) {
    let is_turned = F::splat(0.0).lt(dot(normal, dir));
    let turned = [
        F::select(is_turned, -normal[0], normal[0]),
        F::select(is_turned, -normal[1], normal[1]),
        F::select(is_turned, -normal[2], normal[2]),
    ];
    (turned, F::bitmask(is_turned))
}

impl World {
    /// Records the hits of up to four rays with these origins: bit for bit what [`World::hit`] computes for each.
    #[inline(always)]
    pub(in crate::world) fn note_hits(
        &self,
        lanes: SimdLevel,
        origin: &[[f64; 4]; 3],
        bests: &[Option<ClosestHit>],
        hits: &mut HitPacket4,
    ) {
        hits.clear_hits();
        // Unrolled, so that the packet is not written lane by lane just before it is read as a whole.
        let mut spheres = 0;
        let [a, b, c, d] = [
            self.note_hit_data(bests, 0, hits, &mut spheres),
            self.note_hit_data(bests, 1, hits, &mut spheres),
            self.note_hit_data(bests, 2, hits, &mut spheres),
            self.note_hit_data(bests, 3, hits, &mut spheres),
        ];
        let centre = [
            [a.x, b.x, c.x, d.x],
            [a.y, b.y, c.y, d.y],
            [a.z, b.z, c.z, d.z],
        ];
        let hit_mask = hits.hit_mask;
        if hit_mask == 0 {
            return;
        }
        let on_spheres = HitsOnSpheres {
            origin,
            hits,
            centre,
        };
        let sure = lanes.run(on_spheres);
        let mut remaining = hit_mask & !(spheres & sure[0] & sure[1]);
        if remaining == 0 {
            return;
        }
        // Start over from unflipped normals.
        hits.facing = hits.normal;
        while remaining != 0 {
            let lane = remaining.trailing_zeros() as usize % 4;
            remaining &= remaining - 1;
            if let Some(Some(ClosestHit { hit, .. })) = bests.get(lane) {
                self.note_hit(origin, hit, sure[0] >> lane & 1 == 1, hits, lane);
            }
        }
        lanes.run(FaceForward { hits });
    }

    /// Records the hit of one of four rays. If it is on a sphere, sets its bit in `spheres` and returns the centre.
    #[inline(always)]
    fn note_hit_data(
        &self,
        bests: &[Option<ClosestHit>],
        lane: usize,
        hits: &mut HitPacket4,
        spheres: &mut u32,
    ) -> DVec3 {
        let hit = match bests.get(lane) {
            Some(Some(ClosestHit { hit, .. })) if !self.is_too_far(hit) => hit,
            _ => return DVec3::ZERO,
        };
        hits.hit_mask |= 1 << lane;
        hits.t[lane] = hit.root.t;
        hits.leaf[lane] = hit.leaf;
        hits.face[lane] = hit.root.face;
        hits.surface[lane] = hit.surface;
        hits.crossing[lane] = hit.root.crossing;
        // It is read when the light is known.
        if let Some(surface) = self.surfaces.get(hit.surface as usize) {
            prefetch(surface);
        }
        if !self.model.rounding.is_wanted(hit.leaf)
            && let Some(leaf) = self.model.leaves.get(hit.leaf as usize)
            && let Some(sphere) = leaf.world_sphere()
        {
            *spheres |= 1 << lane;
            return sphere.centre;
        }
        DVec3::ZERO
    }

    /// Completes the record of one hit with the general normals, and with the point unless that is exact already.
    fn note_hit(
        &self,
        origin: &[[f64; 4]; 3],
        raw_hit: &RawHit,
        knows_point: bool,
        hits: &mut HitPacket4,
        lane: usize,
    ) {
        if knows_point && !self.model.rounding.is_wanted(raw_hit.leaf) {
            let face = raw_hit.root.face;
            let (point, dir) = (hits.point(lane), hits.dir(lane));
            let (normal, shading) = self.model.normals(raw_hit.leaf, point, dir, face);
            put(&mut hits.normal, lane, normal);
            put(&mut hits.facing, lane, shading);
            return;
        }
        let hit = self.hit(&Ray::new(one_of(origin, lane), hits.dir(lane)), raw_hit);
        hits.t[lane] = hit.t;
        put(&mut hits.point, lane, hit.point);
        put(&mut hits.normal, lane, hit.spawn_surface.normal);
        put(&mut hits.facing, lane, hit.shading_normal);
        hits.blur[lane] = hit.spawn_surface.blur;
    }
}
