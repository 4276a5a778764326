//! Packets of eight rays from one point against the eight boxes of a node at once, by interval arithmetic on their
//! directions (Boulos and others 2006, "Interactive distribution ray tracing"), in single precision and conservatively.

use super::frustum::Frustum;
use super::node::{Node, WIDTH, max_f32, min_f32};
use super::packet::{LANES, REL_ERROR, RayPacket8, ViewBox, intersect_box, load3};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};

/// The interval of the directions of a packet, prepared for tests against boxes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct DirInterval {
    /// The inverse directions of the rays.
    pub(super) inverse: [[f32; LANES]; 3],
    /// By axis, the inverses of the largest positive and the most negative direction: they give the earliest hit of a
    /// plane above, and of one below. Infinite where no ray goes up, or down.
    up: [f32; 3],
    down: [f32; 3],
    /// By axis, the inverses of the smallest and the largest direction: they give the latest hit of a plane.
    least: [f32; 3],
    most: [f32; 3],
    /// Infinite for an axis along which some ray never leaves a box, else minus infinity.
    open: [f32; 3],
}

impl DirInterval {
    pub(super) fn new(packet: &RayPacket8) -> Self {
        let mut interval = DirInterval {
            inverse: [[0.0; LANES]; 3],
            up: [f32::INFINITY; 3],
            down: [f32::NEG_INFINITY; 3],
            least: [0.0; 3],
            most: [0.0; 3],
            open: [f32::NEG_INFINITY; 3],
        };
        for (axis, dir) in packet.dir.iter().enumerate() {
            let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
            for (inverse, &dir) in interval.inverse[axis].iter_mut().zip(dir) {
                *inverse = 1.0 / dir;
                least = min_f32(dir, least);
                most = max_f32(dir, most);
            }
            (interval.least[axis], interval.most[axis]) = (1.0 / least, 1.0 / most);
            if most > 0.0 {
                interval.up[axis] = interval.most[axis];
            }
            if least < 0.0 {
                interval.down[axis] = interval.least[axis];
            }
            if least <= 0.0 && most >= 0.0 {
                interval.open[axis] = f32::INFINITY;
            }
        }
        interval
    }
}

/// The planes of the eight boxes of a node by axis and end (low, high), relative to the common origin of some rays.
#[derive(Debug)]
#[repr(align(32))]
pub(super) struct ViewedBoxes([[[f32; WIDTH]; 2]; 3]);

impl ViewedBoxes {
    /// One of the boxes.
    #[inline(always)]
    pub(super) fn view_box(&self, slot: usize) -> ViewBox {
        let [x, y, z] = &self.0;
        ViewBox {
            low: [x[0][slot], y[0][slot], z[0][slot]],
            high: [x[1][slot], y[1][slot], z[1][slot]],
        }
    }
}

/// Translates the boxes of a node to the origin of a frustum.
pub(super) struct NodeBoxes<'a> {
    pub(super) frustum: &'a Frustum,
    pub(super) node: &'a Node,
}

impl SimdKernel for NodeBoxes<'_> {
    type Output = ViewedBoxes;

    #[inline(always)]
    fn run<F: F64x4>(self) -> ViewedBoxes {
        let mut seen = ViewedBoxes([[[0.0; WIDTH]; 2]; 3]);
        for (axis, [low, high]) in self.node.planes().iter().enumerate() {
            let (below, above) = (self.frustum.low[axis], self.frustum.high[axis]);
            seen.0[axis][0] = (<F::F32>::from_array(low) - <F::F32>::splat(above)).to_array();
            seen.0[axis][1] = (<F::F32>::from_array(high) - <F::F32>::splat(below)).to_array();
        }
        seen
    }
}

/// Mask of the boxes, of eight, that a ray of a packet may hit before `end`.
pub(super) struct IntervalAndBoxes<'a> {
    pub(super) interval: &'a DirInterval,
    pub(super) boxes: &'a ViewedBoxes,
    pub(super) end: f32,
}

impl SimdKernel for IntervalAndBoxes<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let interval = self.interval;
        let mut enter = <F::F32>::splat(0.0);
        let mut leave = <F::F32>::splat(self.end);
        for (axis, [low, high]) in self.boxes.0.iter().enumerate() {
            let (low, high) = (<F::F32>::from_array(low), <F::F32>::from_array(high));
            // Keeps the running bound where a plane yields NaN (zero times infinity).
            enter = (low * <F::F32>::splat(interval.up[axis])).lane_max(enter);
            enter = (high * <F::F32>::splat(interval.down[axis])).lane_max(enter);
            let last = high * <F::F32>::splat(interval.least[axis]);
            let last = (low * <F::F32>::splat(interval.most[axis])).lane_max(last);
            leave = <F::F32>::splat(interval.open[axis])
                .lane_max(last)
                .lane_min(leave);
        }
        let latest = leave * <F::F32>::splat(1.0 + 4.0 * REL_ERROR);
        (enter * <F::F32>::splat(1.0 - 4.0 * REL_ERROR))
            .le(latest + <F::F32>::splat(f32::MIN_POSITIVE))
    }
}

/// Mask of the rays of a packet that may hit a box.
pub(super) struct IntervalAndBox<'a> {
    pub(super) packet: &'a RayPacket8,
    pub(super) interval: &'a DirInterval,
    pub(super) view_box: &'a ViewBox,
}

impl SimdKernel for IntervalAndBox<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let inverse: [F::F32; 3] = load3(&self.interval.inverse);
        intersect_box(
            inverse,
            <F::F32>::from_array(&self.packet.end),
            self.view_box,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::rounding::nearest;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::SimdLevel;
    use glam::DVec3;

    /// Rays around a direction, some of them along axes, in narrow and in wide packets.
    fn packet(rng: &mut Random) -> RayPacket8 {
        let (middle, spread) = (rng.vector(1.0), 0.5 * rng.uniform().powi(4));
        let flat = rng.bits() % 8;
        let mut packet = RayPacket8::EMPTY;
        for lane in 0..LANES {
            let mut dir = middle + rng.vector(spread);
            for axis in 0..3 {
                if flat >> axis & 1 == 1 && (lane % 2 == 0 || flat == 7) {
                    dir[axis] = 0.0;
                }
            }
            let dir = dir.normalize_or(DVec3::Z);
            for axis in 0..3 {
                packet.dir[axis][lane] = nearest(dir[axis]);
            }
            packet.end[lane] = [1.0, f32::INFINITY, f32::NEG_INFINITY][lane % 3];
        }
        packet
    }

    /// True if a ray hits a box before its end.
    fn is_hit(packet: &RayPacket8, lane: usize, view_box: &ViewBox) -> bool {
        let (mut enter, mut leave) = (0.0_f64, f64::from(packet.end[lane]));
        for axis in 0..3 {
            let dir = f64::from(packet.dir[axis][lane]);
            let (low, high) = (
                f64::from(view_box.low[axis]),
                f64::from(view_box.high[axis]),
            );
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
    fn an_interval_loses_no_box_that_one_of_its_rays_hits() {
        let mut rng = Random::new(5);
        let (mut hits, mut candidates) = (0, 0);
        for _ in 0..20_000 {
            let packet = packet(&mut rng);
            let interval = DirInterval::new(&packet);
            let mut boxes = ViewedBoxes([[[0.0; WIDTH]; 2]; 3]);
            for slot in 0..WIDTH {
                let (centre, half) = (rng.vector(1.0), 0.3 * rng.uniform().powi(3));
                for axis in 0..3 {
                    boxes.0[axis][0][slot] = nearest(centre[axis] - half);
                    boxes.0[axis][1][slot] = nearest(centre[axis] + half);
                }
            }
            let boxes_hit = [SimdLevel::widest(), SimdLevel::NARROW].map(|lanes| {
                let kernel = IntervalAndBoxes {
                    interval: &interval,
                    boxes: &boxes,
                    end: packet.farthest(),
                };
                lanes.run(kernel)
            });
            assert_eq!(boxes_hit[0], boxes_hit[1]);
            for slot in 0..WIDTH {
                let (packet, interval, view_box) = (&packet, &interval, &boxes.view_box(slot));
                let rays = SimdLevel::widest().run(IntervalAndBox {
                    packet,
                    interval,
                    view_box,
                });
                let mut is_any = false;
                for lane in (0..LANES).filter(|&lane| is_hit(packet, lane, view_box)) {
                    assert!(rays >> lane & 1 == 1, "{packet:?} {view_box:?}");
                    assert!(boxes_hit[0] >> slot & 1 == 1, "{packet:?} {view_box:?}");
                    is_any = true;
                }
                hits += u32::from(is_any);
                candidates += boxes_hit[0] >> slot & 1;
            }
        }
        assert!(
            hits > 2000 && candidates < 20_000,
            "{hits} of {candidates} are met"
        );
    }
}
