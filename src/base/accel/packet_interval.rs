//! Eight rays from one point against the eight boxes of a node at once, by the spans of their directions (Boulos and others
//! 2006, "Interactive distribution ray tracing"), in single precision with every doubt in favour of being met.

use super::frustum::Frustum;
use super::node::{Node, WIDTH, larger, smaller};
use super::packet::{DOUBT, LANES, RayPacket8, ViewBox, load, meet_box};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};

/// Between which bounds the directions of a group of rays lie, made ready for boxes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct DirInterval {
    /// The inverse directions of the rays.
    pub(super) inverse: [[f32; LANES]; 3],
    /// By axis, the inverse of the steepest way up and of the steepest way down: what comes first at a plane above, and
    /// below. Infinite where no ray goes that way.
    up: [f32; 3],
    down: [f32; 3],
    /// By axis, the inverses of the least and the largest of the directions: what comes last at a plane.
    least: [f32; 3],
    most: [f32; 3],
    /// Infinite for an axis that some ray never leaves a box along, and else nothing.
    open: [f32; 3],
}

impl DirInterval {
    pub(super) fn new(group: &RayPacket8) -> Self {
        let mut beam = DirInterval {
            inverse: [[0.0; LANES]; 3],
            up: [f32::INFINITY; 3],
            down: [f32::NEG_INFINITY; 3],
            least: [0.0; 3],
            most: [0.0; 3],
            open: [f32::NEG_INFINITY; 3],
        };
        for (axis, dir) in group.dir.iter().enumerate() {
            let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
            for (inverse, &dir) in beam.inverse[axis].iter_mut().zip(dir) {
                *inverse = 1.0 / dir;
                least = smaller(dir, least);
                most = larger(dir, most);
            }
            (beam.least[axis], beam.most[axis]) = (1.0 / least, 1.0 / most);
            if most > 0.0 {
                beam.up[axis] = beam.most[axis];
            }
            if least < 0.0 {
                beam.down[axis] = beam.least[axis];
            }
            if least <= 0.0 && most >= 0.0 {
                beam.open[axis] = f32::INFINITY;
            }
        }
        beam
    }
}

/// The planes of the eight boxes of a node by axis and end (low, high), as seen from the common origin of some rays.
#[derive(Debug)]
#[repr(align(32))]
pub(super) struct ViewedBoxes([[[f32; WIDTH]; 2]; 3]);

impl ViewedBoxes {
    /// One of the boxes.
    #[inline(always)]
    pub(super) fn slab(&self, place: usize) -> ViewBox {
        let [x, y, z] = &self.0;
        ViewBox {
            low: [x[0][place], y[0][place], z[0][place]],
            high: [x[1][place], y[1][place], z[1][place]],
        }
    }
}

/// The boxes of a node as seen from the origin of a pyramid.
pub(super) struct NodeBoxes<'a> {
    pub(super) pyramid: &'a Frustum,
    pub(super) node: &'a Node,
}

impl SimdKernel for NodeBoxes<'_> {
    type Output = ViewedBoxes;

    #[inline(always)]
    fn run<F: F64x4>(self) -> ViewedBoxes {
        let mut seen = ViewedBoxes([[[0.0; WIDTH]; 2]; 3]);
        for (axis, [low, high]) in self.node.planes().iter().enumerate() {
            let (below, above) = (self.pyramid.low[axis], self.pyramid.high[axis]);
            seen.0[axis][0] = (<F::F32>::from_array(low) - <F::F32>::splat(above)).to_array();
            seen.0[axis][1] = (<F::F32>::from_array(high) - <F::F32>::splat(below)).to_array();
        }
        seen
    }
}

/// Which of eight boxes a ray of a group may meet before `end`, one bit each.
pub(super) struct IntervalAndBoxes<'a> {
    pub(super) beam: &'a DirInterval,
    pub(super) boxes: &'a ViewedBoxes,
    pub(super) end: f32,
}

impl SimdKernel for IntervalAndBoxes<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let beam = self.beam;
        let mut enter = <F::F32>::splat(0.0);
        let mut leave = <F::F32>::splat(self.end);
        for (axis, [low, high]) in self.boxes.0.iter().enumerate() {
            let (low, high) = (<F::F32>::from_array(low), <F::F32>::from_array(high));
            // The running bound where a plane says nothing (zero times infinity).
            enter = (low * <F::F32>::splat(beam.up[axis])).lane_max(enter);
            enter = (high * <F::F32>::splat(beam.down[axis])).lane_max(enter);
            let last = high * <F::F32>::splat(beam.least[axis]);
            let last = (low * <F::F32>::splat(beam.most[axis])).lane_max(last);
            leave = <F::F32>::splat(beam.open[axis])
                .lane_max(last)
                .lane_min(leave);
        }
        let latest = leave * <F::F32>::splat(1.0 + 4.0 * DOUBT);
        (enter * <F::F32>::splat(1.0 - 4.0 * DOUBT)).le(latest + <F::F32>::splat(f32::MIN_POSITIVE))
    }
}

/// Which rays of a group may meet a box, one bit each.
pub(super) struct IntervalAndBox<'a> {
    pub(super) group: &'a RayPacket8,
    pub(super) beam: &'a DirInterval,
    pub(super) slab: &'a ViewBox,
}

impl SimdKernel for IntervalAndBox<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let inverse: [F::F32; 3] = load(&self.beam.inverse);
        meet_box(inverse, <F::F32>::from_array(&self.group.end), self.slab)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::rounding::nearest;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::SimdLevel;
    use glam::DVec3;

    /// Rays about a direction, some of them along axes, in narrow and in wide beams.
    fn group(rng: &mut Random) -> RayPacket8 {
        let (middle, spread) = (rng.vector(1.0), 0.5 * rng.share().powi(4));
        let flat = rng.bits() % 8;
        let mut group = RayPacket8::EMPTY;
        for lane in 0..LANES {
            let mut dir = middle + rng.vector(spread);
            for axis in 0..3 {
                if flat >> axis & 1 == 1 && (lane % 2 == 0 || flat == 7) {
                    dir[axis] = 0.0;
                }
            }
            let dir = dir.normalize_or(DVec3::Z);
            for axis in 0..3 {
                group.dir[axis][lane] = nearest(dir[axis]);
            }
            group.end[lane] = [1.0, f32::INFINITY, f32::NEG_INFINITY][lane % 3];
        }
        group
    }

    /// Whether a ray meets a box before its end.
    fn is_met(group: &RayPacket8, lane: usize, slab: &ViewBox) -> bool {
        let (mut enter, mut leave) = (0.0_f64, f64::from(group.end[lane]));
        for axis in 0..3 {
            let dir = f64::from(group.dir[axis][lane]);
            let (low, high) = (f64::from(slab.low[axis]), f64::from(slab.high[axis]));
            if dir == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
            } else {
                enter = enter.max((low / dir).min(high / dir));
                leave = leave.min((low / dir).max(high / dir));
            }
        }
        enter <= leave
    }

    #[test]
    fn a_beam_loses_no_box_that_one_of_its_rays_meets() {
        let mut rng = Random::new(5);
        let (mut met, mut passed) = (0, 0);
        for _ in 0..20_000 {
            let group = group(&mut rng);
            let beam = DirInterval::new(&group);
            let mut boxes = ViewedBoxes([[[0.0; WIDTH]; 2]; 3]);
            for place in 0..WIDTH {
                let (at, half) = (rng.vector(1.0), 0.3 * rng.share().powi(3));
                for axis in 0..3 {
                    boxes.0[axis][0][place] = nearest(at[axis] - half);
                    boxes.0[axis][1][place] = nearest(at[axis] + half);
                }
            }
            let some = [SimdLevel::widest(), SimdLevel::NARROW].map(|lanes| {
                let asked = IntervalAndBoxes {
                    beam: &beam,
                    boxes: &boxes,
                    end: group.farthest(),
                };
                lanes.run(asked)
            });
            assert_eq!(some[0], some[1]);
            for place in 0..WIDTH {
                let (group, beam, slab) = (&group, &beam, &boxes.slab(place));
                let rays = SimdLevel::widest().run(IntervalAndBox { group, beam, slab });
                let mut is_any = false;
                for lane in (0..LANES).filter(|&lane| is_met(group, lane, slab)) {
                    assert!(rays >> lane & 1 == 1, "{group:?} {slab:?}");
                    assert!(some[0] >> place & 1 == 1, "{group:?} {slab:?}");
                    is_any = true;
                }
                met += u32::from(is_any);
                passed += some[0] >> place & 1;
            }
        }
        assert!(met > 2000 && passed < 20_000, "{met} of {passed} are met");
    }
}
