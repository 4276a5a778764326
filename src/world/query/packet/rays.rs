//! Queries side by side, in the form in which four are answered at once.

use super::hits::{HitPacket4, NO_LEAF, ShadowPacket4};
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::from_arrays;
use crate::scene::shape::RayPacket;
use crate::world::query::Query;
use glam::DVec3;

/// Four queries. Where there are fewer the last stands in for those that are missing.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(in crate::world) struct RayPacket4 {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    /// Nothing up to here counts.
    pub(in crate::world) from: [f64; 4],
    /// Nothing beyond counts.
    pub(in crate::world) far: [f64; 4],
    /// The leaves that the rays have just left; [`NO_LEAF`] for none.
    pub(in crate::world) left: [u32; 4],
    /// Which of them go to the outer side of the leaf that they have left, one bit each.
    pub(in crate::world) goes_out: u32,
}

/// Any number of queries, four by four.
#[derive(Debug, Default)]
pub(in crate::world) struct RayStream {
    fours: Vec<RayPacket4>,
}

impl RayStream {
    /// Takes in the rays of a camera, which start at one point; up to `least` nothing counts.
    #[inline(always)]
    pub(in crate::world) fn load_camera_rays(
        &mut self,
        origin: DVec3,
        least: f64,
        hits: &[HitPacket4],
    ) {
        self.fours.resize(hits.len(), RayPacket4::NONE);
        for (four, hits) in self.fours.iter_mut().zip(hits) {
            four.origin = [[origin.x; 4], [origin.y; 4], [origin.z; 4]];
            four.dir = hits.dir;
            four.from = [least; 4];
            four.far = [f64::INFINITY; 4];
            four.left = [NO_LEAF; 4];
        }
    }

    /// Takes in this many rays, up to eight, that may start anywhere; `least` is the distance up to which nothing counts
    /// for one.
    #[inline(always)]
    pub(in crate::world) fn follow(
        &mut self,
        count: usize,
        query: impl Fn(usize) -> Query,
        least: impl Fn(&Query) -> f64,
    ) {
        self.fours.resize(count.div_ceil(4), RayPacket4::NONE);
        for (number, four) in self.fours.iter_mut().enumerate() {
            four.goes_out = 0;
            for lane in 0..4 {
                let query = query((4 * number + lane).min(count - 1));
                for axis in 0..3 {
                    four.origin[axis][lane] = query.ray.origin[axis];
                    four.dir[axis][lane] = query.ray.dir[axis];
                }
                four.from[lane] = least(&query);
                four.far[lane] = query.t_max;
                four.left[lane] = query.origin_surface.map_or(NO_LEAF, |left| left.leaf);
                let goes_out = query
                    .origin_surface
                    .is_some_and(|left| left.normal.dot(query.ray.dir) > 0.0);
                four.goes_out |= u32::from(goes_out) << lane;
            }
        }
    }

    /// Where the first eight queries end.
    #[inline(always)]
    pub(in crate::world) fn ends(&self) -> [f64; 8] {
        let mut ends = [0.0; 8];
        for (ends, four) in ends.chunks_mut(4).zip(&self.fours) {
            ends.copy_from_slice(&four.far);
        }
        ends
    }

    /// Takes in the rays to a light from all of these hits; `least` is the distance up to which nothing counts for one of
    /// such a blur.
    #[inline(always)]
    pub(in crate::world) fn load_shadow_rays(
        &mut self,
        (hits, ways): (&[HitPacket4], &[ShadowPacket4]),
        least: impl Fn(f64) -> f64,
    ) {
        self.fours.resize(hits.len(), RayPacket4::NONE);
        for (four, (hits, ways)) in self.fours.iter_mut().zip(hits.iter().zip(ways)) {
            four.origin = hits.point;
            four.dir = ways.to_light;
            for lane in 0..4 {
                four.from[lane] = least(hits.blur[lane]);
            }
            four.far = ways.far;
            four.left = hits.leaf;
            four.goes_out = ways.goes_out;
        }
    }

    /// Takes in rays that all leave from one hit, of which each of the four is; `least` as in the others.
    #[inline(always)]
    pub(in crate::world) fn shine_from(
        &mut self,
        hits: &HitPacket4,
        ways: &[ShadowPacket4],
        least: impl Fn(f64) -> f64,
    ) {
        self.fours.resize(ways.len(), RayPacket4::NONE);
        let least = least(hits.blur[0]);
        for (four, ways) in self.fours.iter_mut().zip(ways) {
            four.origin = hits.point;
            four.dir = ways.to_light;
            four.from = [least; 4];
            four.far = ways.far;
            four.left = hits.leaf;
            four.goes_out = ways.goes_out;
        }
    }

    /// Takes in the rays to a light from hits at these places; `least` is the distance up to which nothing counts for
    /// one of such a blur.
    #[inline(always)]
    pub(in crate::world) fn load_shadow_rays_all(
        &mut self,
        places: &[u16],
        (hits, ways): (&[HitPacket4], &[ShadowPacket4]),
        least: impl Fn(f64) -> f64,
    ) {
        self.fours
            .resize(places.len().div_ceil(4), RayPacket4::NONE);
        for (four, places) in self.fours.iter_mut().zip(places.chunks(4)) {
            four.goes_out = 0;
            for lane in 0..4 {
                let place = usize::from(places[lane.min(places.len() - 1)]);
                let (hits, ways) = (&hits[place / 4], &ways[place / 4]);
                for axis in 0..3 {
                    four.origin[axis][lane] = hits.point[axis][place % 4];
                    four.dir[axis][lane] = ways.to_light[axis][place % 4];
                }
                four.from[lane] = least(hits.blur[place % 4]);
                four.far[lane] = ways.far[place % 4];
                four.left[lane] = hits.leaf[place % 4];
                four.goes_out |= (ways.goes_out >> (place % 4) & 1) << lane;
            }
        }
    }

    /// The directions of four of them.
    #[inline(always)]
    pub(in crate::world) fn dirs(&self, four: usize) -> &[[f64; 4]; 3] {
        &self.fours[four].dir
    }

    /// The ray of the query of this number.
    #[cfg(test)]
    pub(in crate::world) fn ray(&self, number: usize) -> Ray {
        self.fours[number / 4].ray(number % 4)
    }

    /// The four among which the query of this number is.
    #[inline(always)]
    pub(in crate::world) fn four(&self, number: usize) -> &RayPacket4 {
        &self.fours[number / 4]
    }

    /// Up to here nothing counts for the query of this number.
    #[inline(always)]
    pub(in crate::world) fn from(&self, number: usize) -> f64 {
        self.fours[number / 4].from[number % 4]
    }

    /// Beyond this nothing counts for the query of this number.
    #[inline(always)]
    pub(in crate::world) fn far(&self, number: usize) -> f64 {
        self.fours[number / 4].far[number % 4]
    }

    /// Lets a query end sooner.
    #[inline(always)]
    pub(in crate::world) fn shorten(&mut self, number: usize, far: f64) {
        self.fours[number / 4].far[number % 4] = far;
    }
}

impl RayPacket4 {
    const NONE: RayPacket4 = RayPacket4 {
        origin: [[0.0; 4]; 3],
        dir: [[0.0; 4]; 3],
        from: [0.0; 4],
        far: [0.0; 4],
        left: [NO_LEAF; 4],
        goes_out: 0,
    };

    /// One of the rays.
    #[inline(always)]
    pub(in crate::world) fn ray(&self, lane: usize) -> Ray {
        let one_of = |of: &[[f64; 4]; 3]| DVec3::new(of[0][lane], of[1][lane], of[2][lane]);
        Ray::new(one_of(&self.origin), one_of(&self.dir))
    }

    /// The rays, in lanes.
    #[inline(always)]
    pub(in crate::world) fn load<F: F64Lanes>(&self) -> RayPacket<F> {
        RayPacket {
            origin: from_arrays(&self.origin),
            dir: from_arrays(&self.dir),
        }
    }

    /// Which rays have just left this leaf, one bit each.
    #[inline(always)]
    pub(in crate::world) fn have_left(&self, leaf: u32) -> u32 {
        let mut bits = 0;
        for (lane, left) in self.left.iter().enumerate() {
            bits |= u32::from(*left == leaf) << lane;
        }
        bits
    }
}
