//! Four rays against a triangle at once: to the bit what [`RayFrame::hit`] says of each.

use super::RayFrame;
use crate::base::math::simd::vec3::{Vec3Lanes, from_arrays};
use crate::base::math::simd::{F64Lanes, SimdKernel};
use glam::DVec3;

/// Four rays prepared for many triangles, if all are longest along the same axis.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct RayFrames4 {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    shear: [[f64; 4]; 2],
    along: usize,
}

/// Four rays and the corners of a triangle.
pub(crate) struct RaysAndTriangle<'a> {
    pub(crate) rays: &'a RayFrames4,
    pub(crate) corners: &'a [DVec3; 3],
}

/// Where four rays meet a triangle.
pub(crate) struct TriangleHits4 {
    /// The parameters on the rays.
    pub(crate) t: [f64; 4],
    /// Which rays meet it, one bit each.
    pub(crate) met: u32,
    /// Which rays must be asked for singly.
    pub(crate) unknown: u32,
}

impl RayFrames4 {
    /// One to four rays side by side; behind the last it stands again. `None` if they differ in the axis along which
    /// they are longest.
    #[inline(always)]
    pub(crate) fn new(frames: &[RayFrame]) -> Option<Self> {
        let along = frames.first()?.along;
        let mut four = RayFrames4 {
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
                four.origin[axis][lane] = frame.ray.origin[axis];
                four.dir[axis][lane] = frame.ray.dir[axis];
            }
            four.shear[0][lane] = frame.shear.x;
            four.shear[1][lane] = frame.shear.y;
        }
        Some(four)
    }
}

/// A corner with the rays along an axis: across it, and along it.
struct Sheared<F> {
    x: F,
    y: F,
    depth: F,
}

impl RaysAndTriangle<'_> {
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
        let nothing = F::splat(0.0);
        let below = (edges[0].lt(nothing) | edges[1].lt(nothing)) | edges[2].lt(nothing);
        let above = (nothing.lt(edges[0]) | nothing.lt(edges[1])) | nothing.lt(edges[2]);
        let inside = 0b1111 & !F::bitmask(below & above);
        if inside == 0 {
            return TriangleHits4 {
                t: [0.0; 4],
                met: 0,
                unknown: 0,
            };
        }
        let endless = F::splat(f64::INFINITY);
        let sum = edges[0] + edges[1] + edges[2];
        let size = sum.abs();
        let is_known = F::bitmask(nothing.lt(size) & size.lt(endless));
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
        let is_finite = F::bitmask(t.abs().lt(endless));
        TriangleHits4 {
            t: t.to_array(),
            met: inside & is_known & is_finite,
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
    fn four_rays_meet_what_each_meets() {
        let mut rng = Random::new(77);
        let (mut met, mut unknown) = (0, 0);
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
                let found = lanes.run(RaysAndTriangle {
                    rays: &rays,
                    corners: &corners,
                });
                unknown += found.unknown.count_ones();
                for lane in (0..4).filter(|lane| found.unknown >> lane & 1 == 0) {
                    let alone = frames[lane].hit(&corners).map(|hit| hit.t);
                    let is_met = found.met >> lane & 1 == 1;
                    assert_eq!(is_met.then_some(found.t[lane]), alone);
                    met += u32::from(is_met);
                }
            }
        }
        assert!(met > 1000 && unknown < met / 10, "{met} {unknown}");
    }
}
