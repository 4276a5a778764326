//! Intersection of a packet of four rays with a triangle, bit for bit equal to [`RayFrame::hit`] of each ray.

use super::RayFrame;
use crate::base::math::simd::vec3::{Vec3Lanes, from_arrays};
use crate::base::math::simd::{F64Lanes, SimdKernel};
use glam::DVec3;

/// A packet of four rays prepared for many triangles. All have the largest direction component on the same axis.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct RayFrames4 {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    shear: [[f64; 4]; 2],
    along: usize,
}

/// Kernel that intersects a packet of four rays with a triangle, given by its vertices.
pub(crate) struct RaysAndTriangle<'a> {
    pub(crate) rays: &'a RayFrames4,
    pub(crate) corners: &'a [DVec3; 3],
}

/// The hits of a packet of four rays on a triangle.
pub(crate) struct TriangleHits4 {
    /// The `t` of each hit.
    pub(crate) t: [f64; 4],
    /// Bitmask of the rays that hit the triangle.
    pub(crate) hit_mask: u32,
    /// Bitmask of the rays that need the scalar test [`RayFrame::hit`].
    pub(crate) unknown: u32,
}

impl RayFrames4 {
    /// A packet of one to four rays; the last ray fills the remaining lanes. `None` if the axis of the largest
    /// direction component is not the same for all.
    #[inline(always)]
    pub(crate) fn new(frames: &[RayFrame]) -> Option<Self> {
        let along = frames.first()?.along;
        let mut packet = RayFrames4 {
            origin: [[0.0; 4]; 3],
            dir: [[0.0; 4]; 3],
            shear: [[0.0; 4]; 2],
            along,
        };
        for lane in 0..4 {
            let frame = &frames[lane.min(frames.len() - 1)];
            if frame.along != along {
                return None;
            }
            for axis in 0..3 {
                packet.origin[axis][lane] = frame.ray.origin[axis];
                packet.dir[axis][lane] = frame.ray.dir[axis];
            }
            packet.shear[0][lane] = frame.shear.x;
            packet.shear[1][lane] = frame.shear.y;
        }
        Some(packet)
    }
}

/// A vertex relative to the sheared rays: its coordinates across them and along them.
struct Sheared<F> {
    x: F,
    y: F,
    depth: F,
}

impl RaysAndTriangle<'_> {
    /// A vertex relative to the sheared rays.
    #[inline(always)]
    fn sheared<F: F64Lanes>(&self, corner: DVec3, origin: &Vec3Lanes<F>) -> Sheared<F> {
        let RayFrames4 { shear, along, .. } = self.rays;
        let away = |axis: usize| F::splat(corner[axis % 3]) - origin[axis % 3];
        let depth = away(*along);
        Sheared {
            x: away(along + 1) - F::from_array(&shear[0]) * depth,
            y: away(along + 2) - F::from_array(&shear[1]) * depth,
            depth,
        }
    }
}

/// Twice the signed area of the triangle of each ray and the edge from `p` to `q`.
#[inline(always)]
fn edge<F: F64Lanes>(p: &Sheared<F>, q: &Sheared<F>) -> F {
    p.x * q.y - p.y * q.x
}

impl SimdKernel for RaysAndTriangle<'_> {
    type Output = TriangleHits4;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> TriangleHits4 {
        let [a, b, c] = *self.corners;
        let origin: Vec3Lanes<F> = from_arrays(&self.rays.origin);
        let [p, q, r] = [
            self.sheared(a, &origin),
            self.sheared(b, &origin),
            self.sheared(c, &origin),
        ];
        let edges = [edge(&q, &r), edge(&r, &p), edge(&p, &q)];
        let zero = F::splat(0.0);
        let below = (edges[0].lt(zero) | edges[1].lt(zero)) | edges[2].lt(zero);
        let above = (zero.lt(edges[0]) | zero.lt(edges[1])) | zero.lt(edges[2]);
        let inside = 0b1111 & !F::bitmask(below & above);
        if inside == 0 {
            return TriangleHits4 {
                t: [0.0; 4],
                hit_mask: 0,
                unknown: 0,
            };
        }
        let infinity = F::splat(f64::INFINITY);
        let sum = edges[0] + edges[1] + edges[2];
        let size = sum.abs();
        let is_known = F::bitmask(zero.lt(size) & size.lt(infinity));
        let is_level = a.cmpeq(b) & a.cmpeq(c);
        let t = match (0..3).find(|&axis| is_level.test(axis)) {
            Some(axis) => (F::splat(a[axis]) - origin[axis]) / F::from_array(&self.rays.dir[axis]),
            None => {
                let mean = edges[0] / sum * p.depth;
                let mean = mean + edges[1] / sum * q.depth;
                let mean = mean + edges[2] / sum * r.depth;
                mean / F::from_array(&self.rays.dir[self.rays.along])
            }
        };
        let is_finite = F::bitmask(t.abs().lt(infinity));
        TriangleHits4 {
            t: t.to_array(),
            hit_mask: inside & is_known & is_finite,
            unknown: inside & !is_known,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::Ray;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::SimdLevel;

    #[test]
    fn a_packet_hits_what_each_of_its_rays_hits() {
        let mut rng = Random::new(77);
        let (mut hit_count, mut unknown) = (0, 0);
        for case in 0..20_000 {
            let mut corners = [0; 3].map(|_| rng.vector(1.0));
            if case % 3 == 0 {
                let axis = case / 3 % 3;
                corners[1][axis] = corners[0][axis];
                corners[2][axis] = corners[0][axis];
            }
            let aim = (corners[0] + corners[1]) * 0.5;
            let frames = [0, 1, 2, 3].map(|lane| {
                let origin = rng.vector(3.0);
                let target = if lane == case % 4 {
                    aim
                } else {
                    rng.vector(1.0)
                };
                RayFrame::new(&Ray::new(origin, target - origin))
            });
            let Some(rays) = RayFrames4::new(&frames) else {
                assert!(frames.iter().any(|frame| frame.along != frames[0].along));
                continue;
            };
            for lanes in [SimdLevel::widest(), SimdLevel::NARROW] {
                let hits = lanes.run(RaysAndTriangle {
                    rays: &rays,
                    corners: &corners,
                });
                unknown += hits.unknown.count_ones();
                for lane in (0..4).filter(|lane| hits.unknown >> lane & 1 == 0) {
                    let scalar = frames[lane].hit(&corners).map(|hit| hit.t);
                    let is_hit = hits.hit_mask >> lane & 1 == 1;
                    assert_eq!(is_hit.then_some(hits.t[lane]), scalar);
                    hit_count += u32::from(is_hit);
                }
            }
        }
        assert!(
            hit_count > 1000 && unknown < hit_count / 10,
            "{hit_count} {unknown}"
        );
    }
}
