//! What many rays meet, and how light of a lamp comes to it: four by four, in the form in which lanes work on them.

use crate::base::math::Ray;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, dot, from_arrays, max_abs, scale, sub, to_arrays,
};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, SimdLevel};
use crate::base::memory::prefetch;
use crate::scene::shape::{Crossing, Shape};
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::query::closest::BLUR;
use crate::world::query::{ClosestHit, Hit, Occlusion, Query, RayKind, SpawnSurface};
use glam::DVec3;

/// The number of no leaf.
pub const NO_LEAF: u32 = u32::MAX;

/// Four rays and what they meet. Numbers of rays that meet nothing mean nothing.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct HitPacket4 {
    /// The unit directions of the rays.
    pub dir: [[f64; 4]; 3],
    /// The distances along them.
    pub t: [f64; 4],
    /// The points in the world.
    pub point: [[f64; 4]; 3],
    /// The outward geometric unit normals.
    pub normal: [[f64; 4]; 3],
    /// The unit normals for shading on the side of the rays, before any `normal` pattern.
    pub facing: [[f64; 4]; 3],
    /// Bounds on the errors of the coordinates.
    pub blur: [f64; 4],
    /// The leaves; [`NO_LEAF`] where nothing is met.
    pub leaf: [u32; 4],
    /// The pieces of their surfaces.
    pub face: [u32; 4],
    /// Indices into [`World::surfaces`].
    pub surface: [u32; 4],
    /// What the rays do there.
    pub crossing: [Crossing; 4],
    /// Which rays meet something, one bit each.
    pub met: u32,
    /// Whose normals for shading are turned towards them.
    turned: u32,
}

impl HitPacket4 {
    /// Rays that have met nothing yet, in no direction.
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
        met: 0,
        turned: 0,
    };

    /// Four times the same place, for the rays that leave from there.
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
            met: 0b1111,
            ..HitPacket4::NOTHING
        }
    }

    /// The direction of a ray.
    #[must_use]
    #[inline(always)]
    pub fn dir(&self, lane: usize) -> DVec3 {
        one_of(&self.dir, lane)
    }

    /// Gives a ray its direction.
    #[inline(always)]
    pub fn aim(&mut self, lane: usize, dir: DVec3) {
        put(&mut self.dir, lane, dir);
    }

    /// Notes that no ray meets anything.
    #[inline(always)]
    pub(in crate::world) fn meet_nothing(&mut self) {
        self.met = 0;
        self.leaf = [NO_LEAF; 4];
    }

    /// Where a ray meets something.
    #[must_use]
    #[inline(always)]
    pub fn point(&self, lane: usize) -> DVec3 {
        one_of(&self.point, lane)
    }

    /// The unit normal for shading on the side of the ray.
    #[must_use]
    #[inline(always)]
    pub fn facing(&self, lane: usize) -> DVec3 {
        one_of(&self.facing, lane)
    }

    /// Whether a ray meets something.
    #[must_use]
    #[inline(always)]
    pub fn is_met(&self, lane: usize) -> bool {
        self.met >> lane & 1 == 1
    }

    /// The unit normal for shading, the outward one.
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

    /// For the rays that leave from where a ray meets something.
    #[must_use]
    #[inline]
    pub fn departure(&self, lane: usize) -> SpawnSurface {
        SpawnSurface {
            leaf: self.leaf[lane],
            face: self.face[lane],
            normal: one_of(&self.normal, lane),
            crossing: self.crossing[lane],
            blur: self.blur[lane],
        }
    }

    /// What a ray meets.
    #[must_use]
    pub fn hit(&self, lane: usize) -> Option<Hit> {
        self.is_met(lane).then(|| Hit {
            t: self.t[lane],
            point: self.point(lane),
            shading_normal: self.shading_normal(lane),
            surface: self.surface[lane],
            departure: self.departure(lane),
        })
    }
}

/// The ways from four hits to a lamp.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct ShadowPacket4 {
    /// The unit directions to it.
    pub to_light: [[f64; 4]; 3],
    /// How far it is.
    pub distance: [f64; 4],
    /// The cosines between the directions and the normals on the side of the viewer.
    pub cosine: [f64; 4],
    /// The shares of its light that arrive if nothing is in the way.
    pub share: [f64; 4],
    /// Up to where things cast shadows.
    pub far: [f64; 4],
    /// Which of them go to the outer side of the surface, one bit each.
    pub goes_out: u32,
    /// On which of them it is known what lies there, one bit each; nothing is where the light does not matter.
    pub asked: u32,
    /// Which of those something opaque blocks.
    pub blocked: u32,
    /// Which of the others something filters.
    pub filtered: u32,
}

impl ShadowPacket4 {
    /// Nothing is known.
    pub const NOTHING: ShadowPacket4 = ShadowPacket4 {
        to_light: [[0.0; 4]; 3],
        distance: [0.0; 4],
        cosine: [0.0; 4],
        share: [0.0; 4],
        far: [0.0; 4],
        goes_out: 0,
        asked: 0,
        blocked: 0,
        filtered: 0,
    };

    /// Gives one of them its unit direction, and how far the light is and things cast shadows.
    #[inline(always)]
    pub fn aim(&mut self, lane: usize, to_light: DVec3, distance: f64, far: f64) {
        put(&mut self.to_light, lane, to_light);
        self.distance[lane] = distance;
        self.far[lane] = far;
    }

    /// Forgets what lies on them.
    #[inline(always)]
    pub fn forget(&mut self) {
        (self.asked, self.blocked, self.filtered) = (0, 0, 0);
    }

    /// Notes what lies on one of them.
    #[inline(always)]
    pub fn note(&mut self, lane: usize, way: Occlusion) {
        let bit = 1 << lane;
        self.asked |= bit;
        self.blocked |= if way == Occlusion::Opaque { bit } else { 0 };
        self.filtered |= if way == Occlusion::Transmissive {
            bit
        } else {
            0
        };
    }

    /// What lies on one of them, if that is known.
    #[must_use]
    #[inline(always)]
    pub fn way(&self, lane: usize) -> Option<Occlusion> {
        let has = |bits: u32| bits >> lane & 1 == 1;
        has(self.asked).then(|| {
            if has(self.blocked) {
                Occlusion::Opaque
            } else if has(self.filtered) {
                Occlusion::Transmissive
            } else {
                Occlusion::Clear
            }
        })
    }

    /// The question what lies on one of them.
    #[must_use]
    #[inline(always)]
    pub fn query(&self, hits: &HitPacket4, lane: usize) -> Query {
        Query {
            ray: Ray::new(hits.point(lane), self.to_light(lane)),
            origin_surface: Some(hits.departure(lane)),
            t_max: self.far[lane],
            kind: RayKind::Shadow,
        }
    }

    /// The direction to the lamp.
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

/// Finds where four rays are at their distances, and what follows if that lies on balls.
struct HitsOnSpheres<'a> {
    origin: &'a [[f64; 4]; 3],
    hits: &'a mut HitPacket4,
    centre: [[f64; 4]; 3],
}

impl SimdKernel for HitsOnSpheres<'_> {
    /// Whose numbers need no care, one bit each: first of the points, then of the normals.
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

/// Turns the normals of four hits to the side of the viewer.
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

/// Four normals on the side from which rays of these directions come, and which of them are turned for that, one bit each.
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
    /// Notes what up to four rays from these origins have found: to the bit what [`World::hit`] says of each.
    #[inline(always)]
    pub(in crate::world) fn note_hits(
        &self,
        lanes: SimdLevel,
        origin: &[[f64; 4]; 3],
        bests: &[Option<ClosestHit>],
        hits: &mut HitPacket4,
    ) {
        hits.meet_nothing();
        // Spelt out, so that the numbers of four need not be written one by one to be read together.
        let mut balls = 0;
        let [a, b, c, d] = [
            self.note_met(bests, 0, hits, &mut balls),
            self.note_met(bests, 1, hits, &mut balls),
            self.note_met(bests, 2, hits, &mut balls),
            self.note_met(bests, 3, hits, &mut balls),
        ];
        let centre = [
            [a.x, b.x, c.x, d.x],
            [a.y, b.y, c.y, d.y],
            [a.z, b.z, c.z, d.z],
        ];
        let met = hits.met;
        if met == 0 {
            return;
        }
        let on_balls = HitsOnSpheres {
            origin,
            hits,
            centre,
        };
        let sure = lanes.run(on_balls);
        let mut left = met & !(balls & sure[0] & sure[1]);
        if left == 0 {
            return;
        }
        // All anew, from normals that are not turned yet.
        hits.facing = hits.normal;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % 4;
            left &= left - 1;
            if let Some(Some(ClosestHit { found, .. })) = bests.get(lane) {
                self.note_hit(origin, found, sure[0] >> lane & 1 == 1, hits, lane);
            }
        }
        lanes.run(FaceForward { hits });
    }

    /// Notes what one of four rays has met. If that is a ball it is marked, and the centre given.
    #[inline(always)]
    fn note_met(
        &self,
        bests: &[Option<ClosestHit>],
        lane: usize,
        hits: &mut HitPacket4,
        balls: &mut u32,
    ) -> DVec3 {
        let Some(Some(ClosestHit { found, .. })) = bests.get(lane) else {
            return DVec3::ZERO;
        };
        hits.met |= 1 << lane;
        hits.t[lane] = found.root.t;
        hits.leaf[lane] = found.leaf;
        hits.face[lane] = found.root.face;
        hits.surface[lane] = found.surface;
        hits.crossing[lane] = found.root.crossing;
        // It will be looked at when the light is known.
        if let Some(surface) = self.surfaces.get(found.surface as usize) {
            prefetch(surface);
        }
        if let Some(leaf) = self.model.leaves.get(found.leaf as usize)
            && let (Shape::Sphere(sphere), None) = (&leaf.shape, &leaf.object_from_world)
        {
            *balls |= 1 << lane;
            return sphere.centre;
        }
        DVec3::ZERO
    }

    /// The same for one of them, the point of which is known or not.
    fn note_hit(
        &self,
        origin: &[[f64; 4]; 3],
        found: &RawHit,
        knows_point: bool,
        hits: &mut HitPacket4,
        lane: usize,
    ) {
        if knows_point {
            let face = found.root.face;
            let (normal, shading) = self.model.normals(found.leaf, hits.point(lane), face);
            put(&mut hits.normal, lane, normal);
            put(&mut hits.facing, lane, shading);
            return;
        }
        let hit = self.hit(&Ray::new(one_of(origin, lane), hits.dir(lane)), found);
        put(&mut hits.point, lane, hit.point);
        put(&mut hits.normal, lane, hit.departure.normal);
        put(&mut hits.facing, lane, hit.shading_normal);
        hits.blur[lane] = hit.departure.blur;
    }
}
