//! BVH nodes of eight boxes in single precision, and a ray prepared for them.
//!
//! Every rounding goes outward: boxes grow, the origin of the ray becomes an interval, and the interval of `t` in a box
//! is widened by the error of three roundings at either end. Nothing that a box holds in double precision is ever lost.

use crate::base::math::conditioning::power_of_two;
use crate::base::math::rounding::{loose_above, loose_below, nearest};
use crate::base::math::simd::vec3::{Vec3Lanes, scale, splat, sub};
use crate::base::math::simd::{F32x8, F64Lanes, F64x4, SimdKernel, SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Number of children of a node.
pub(super) const WIDTH: usize = 8;

/// Twice the relative error of `(plane - origin) / dir` in single precision, three roundings, and of this correction:
/// errors grow with the values, so an interval that ends that much later contains every exact hit.
const ERROR: f32 = 12.0 / 16_777_216.0;

/// A coordinate far outside of any tree's frame.
const NOWHERE: f32 = 2e38;

/// Directions below this, against a longest component near one, carry no information about an axis in single precision.
const FLAT: f64 = 1e-30;

/// Above the relative error of a point in single precision, summed over its coordinates.
const POINT_ERROR: f32 = 2.0 * f32::EPSILON;

/// A point with an uncertainty beyond this may be anywhere; the square of this is still finite.
const MAX_SLACK: f32 = 1e15;

/// Eight boxes. Unused slots hold a point that no ray reaches.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(super) struct Node {
    /// By axis and end (low, high), the planes of the eight boxes.
    planes: [[[f32; WIDTH]; 2]; 3],
    children: [Child; WIDTH],
}

/// The child in a slot of a node: a node, a sphere leaf, an item, or nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Child(u32);

/// The decoded form of a [`Child`]; an unused slot reads as a meaningless item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ChildKind {
    Node(u32),
    Leaf(u32),
    Item(u32),
}

/// A box in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Aabb32 {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

/// The frame of the tree: centred and scaled by a power of two so that its boxes are near one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    centre: DVec3,
    scale: f64,
}

/// A ray in the frame of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameRay {
    /// The interval of the origin. The distance to low planes of boxes is measured from its high end and to high planes
    /// from its low end, so that the nearer plane comes sooner and the farther one later.
    low: [f32; 3],
    high: [f32; 3],
    inverse: [f32; 3],
    /// For spheres: a point near the origin, and a bound on its distance from the origin.
    pub(super) middle: [f32; 3],
    pub(super) slack: f32,
    pub(super) dir: [f32; 3],
    /// The square of the length of `dir`.
    pub(super) speed_sq: f32,
    /// Frame parameter of a ray parameter: `t · rate - start`.
    rate: f64,
    start: f64,
}

impl Child {
    /// Set where the child is an item.
    const ITEM: u32 = 1 << 31;

    /// Set where the child is a sphere leaf and not an item.
    const BLOCK: u32 = 1 << 30;

    /// Maximum number of items, of nodes and of sphere leaves.
    pub(super) const MAX_COUNT: usize = (1 << 30) - 1;

    /// An unused slot. It must be recognizable: a ray that hits every box hits that of an unused slot as well.
    pub(super) const NONE: Child = Child(u32::MAX);

    pub(super) fn of_node(index: u32) -> Self {
        Child(index)
    }

    pub(super) fn of_leaf(index: u32) -> Self {
        Child(index | Child::BLOCK)
    }

    #[inline(always)]
    pub(super) fn of_item(item: u32) -> Self {
        Child(item | Child::ITEM)
    }

    #[inline(always)]
    pub(super) fn kind(self) -> ChildKind {
        if self.0 & Child::ITEM != 0 {
            ChildKind::Item(self.0 & !Child::ITEM)
        } else if self.0 & Child::BLOCK != 0 {
            ChildKind::Leaf(self.0 & !Child::BLOCK)
        } else {
            ChildKind::Node(self.0)
        }
    }

    /// The item, if it is one.
    #[inline(always)]
    pub(super) fn item(self) -> Option<u32> {
        (self.0 & Child::ITEM != 0 && self != Child::NONE).then_some(self.0 & !Child::ITEM)
    }

    /// The child with node and leaf indices moved by these offsets.
    pub(super) fn shifted(self, nodes: u32, sphere_leaves: u32) -> Self {
        match self.kind() {
            ChildKind::Node(node) => Child::of_node(node + nodes),
            ChildKind::Leaf(leaf) => Child::of_leaf(leaf + sphere_leaves),
            ChildKind::Item(_) => self,
        }
    }
}

/// The minimum, or `b` if either is NaN. One instruction, unlike `f32::min`, which tests both for NaN.
#[inline(always)]
pub(super) fn min_f32(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The maximum, or `b` if either is NaN; see [`min_f32`].
#[inline(always)]
pub(super) fn max_f32(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Aabb32 {
    /// The corners with the smallest and the largest coordinates.
    pub(super) fn ends(&self) -> (DVec3, DVec3) {
        let corner = |of: [f32; 3]| DVec3::from(of.map(f64::from));
        (corner(self.low), corner(self.high))
    }
}

impl Frame {
    /// The frame for boxes within `bounds`.
    pub(super) fn new(bounds: &Bounds) -> Self {
        let half = 0.5 * bounds.max - 0.5 * bounds.min;
        if bounds.is_empty() || !bounds.is_finite() {
            return Frame {
                centre: DVec3::ZERO,
                scale: 1.0,
            };
        }
        let size = power_of_two(half.max_element());
        Frame {
            centre: 0.5 * bounds.min + 0.5 * bounds.max,
            // The largest power of two has a subnormal inverse, which would cost bits.
            scale: 1.0 / size.min(1.0 / f64::MIN_POSITIVE),
        }
    }

    /// Transforms a point into this frame.
    pub(super) fn in_frame(&self, point: DVec3) -> DVec3 {
        (point - self.centre) * self.scale
    }

    /// Transforms four points into this frame.
    #[inline(always)]
    pub(super) fn in_frame_lanes<F: F64Lanes>(&self, points: Vec3Lanes<F>) -> Vec3Lanes<F> {
        scale(sub(points, splat(self.centre)), F::splat(self.scale))
    }

    /// Length in this frame of a world-space unit.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// Transforms a box into this frame, rounded outward; NaN becomes infinite.
    #[inline]
    pub(super) fn aabb(&self, bounds: &Bounds) -> Aabb32 {
        let low = self.in_frame(bounds.min);
        let high = self.in_frame(bounds.max);
        // Not written with `map`, which is not always inlined.
        let below = |axis: usize| max_f32(loose_below(low[axis]), f32::NEG_INFINITY);
        let above = |axis: usize| min_f32(loose_above(high[axis]), f32::INFINITY);
        Aabb32 {
            low: [below(0), below(1), below(2)],
            high: [above(0), above(1), above(2)],
        }
    }

    /// Transforms a ray into this frame. One that cannot be represented there hits every box.
    #[inline(always)]
    pub(super) fn ray(&self, ray: &Ray) -> FrameRay {
        let length = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir * (1.0 / length);
        let origin = (ray.origin - self.centre) * self.scale;
        let rate = self.scale * length;
        if !(origin.is_finite() && dir.is_finite() && rate.is_normal()) {
            return FrameRay::BLIND;
        }
        // From far away the rounding of the origin would widen every box: start at the point of the ray nearest to the
        // centre.
        let size = origin.abs().max_element();
        if size < 8.0 {
            return FrameRay::new(origin, 0.0, dir, rate, 0.0);
        }
        let start = -origin.dot(dir) / dir.dot(dir);
        let error = 8.0 * f64::EPSILON * (size + start.abs());
        if !error.is_finite() {
            return FrameRay::BLIND;
        }
        FrameRay::new(origin + start * dir, error, dir, rate, start)
    }

    /// The box in this frame that contains a point, rounded outward; NaN becomes infinite.
    pub(super) fn aabb_around(&self, point: DVec3) -> Aabb32 {
        let point_in_frame = self.in_frame(point);
        let known = |end: f32, unknown: f32| if end.is_nan() { unknown } else { end };
        let below = |axis: usize| known(loose_below(point_in_frame[axis]), f32::NEG_INFINITY);
        let above = |axis: usize| known(loose_above(point_in_frame[axis]), f32::INFINITY);
        Aabb32 {
            low: [below(0), below(1), below(2)],
            high: [above(0), above(1), above(2)],
        }
    }
}

impl FrameRay {
    /// The ray that hits every box at every parameter.
    pub(super) const BLIND: FrameRay = FrameRay {
        low: [f32::NEG_INFINITY; 3],
        high: [f32::INFINITY; 3],
        inverse: [1.0; 3],
        middle: [0.0; 3],
        slack: f32::INFINITY,
        dir: [1.0, 0.0, 0.0],
        speed_sq: 1.0,
        rate: f64::NAN,
        start: 0.0,
    };

    #[inline(always)]
    fn new(origin: DVec3, error: f64, dir: DVec3, rate: f64, start: f64) -> Self {
        let mut ray = FrameRay {
            rate,
            start,
            ..FrameRay::BLIND
        };
        for axis in 0..3 {
            let steepness = dir[axis].abs();
            if steepness < FLAT && steepness != 0.0 {
                continue;
            }
            ray.low[axis] = loose_below(origin[axis] - error);
            ray.high[axis] = loose_above(origin[axis] + error);
            ray.inverse[axis] = nearest(1.0 / dir[axis]);
        }
        // Written out: `map` is not always inlined.
        ray.dir = [nearest(dir.x), nearest(dir.y), nearest(dir.z)];
        let [u, v, w] = ray.dir;
        ray.speed_sq = u * u + v * v + w * w;
        let size = origin.abs().max_element();
        let slack = nearest(error) + POINT_ERROR * nearest(size);
        if slack < MAX_SLACK {
            ray.middle = [nearest(origin.x), nearest(origin.y), nearest(origin.z)];
            ray.slack = slack;
        }
        ray
    }

    #[inline]
    fn error(&self, t: f64) -> f64 {
        4.0 * f64::EPSILON * (t.abs() + self.start.abs())
    }

    /// Converts a ray parameter to the frame, rounded down.
    #[inline(always)]
    pub(super) fn from(&self, t: f64) -> f32 {
        let t = t * self.rate;
        let from = loose_below(t - self.start - self.error(t));
        if from.is_nan() {
            f32::NEG_INFINITY
        } else {
            from
        }
    }

    /// Converts a ray parameter to the frame, rounded up.
    #[inline(always)]
    pub(super) fn to(&self, t: f64) -> f32 {
        let t = t * self.rate;
        let to = loose_above(t - self.start + self.error(t));
        let to = to + to.abs() * ERROR;
        if to.is_nan() { f32::INFINITY } else { to }
    }

    /// A finite ray parameter before that at which the ray enters a box, from the entry that is computed for it in the
    /// frame. The roundings of [`FrameRay::to`] are allowed for twice.
    #[inline(always)]
    pub(super) fn parameter_before(&self, enter: f32) -> f64 {
        let enter = f64::from(enter - 2.0 * ERROR * enter.abs());
        let t = enter + self.start - 2.0 * self.error(enter);
        let t = t / self.rate;
        // It is not a number for the ray that hits every box.
        if t.is_nan() {
            f64::MIN
        } else {
            t.clamp(f64::MIN, f64::MAX)
        }
    }
}

impl Node {
    pub(super) fn empty() -> Self {
        Node {
            planes: [
                [[NOWHERE; WIDTH]; 2],
                [[-NOWHERE; WIDTH]; 2],
                [[NOWHERE; WIDTH]; 2],
            ],
            children: [Child::NONE; WIDTH],
        }
    }

    pub(super) fn set(&mut self, slot: usize, aabb: &Aabb32, child: Child) {
        for axis in 0..3 {
            self.planes[axis][0][slot] = aabb.low[axis];
            self.planes[axis][1][slot] = aabb.high[axis];
        }
        self.children[slot] = child;
    }

    /// By axis and end (low, high), the planes of the eight boxes.
    #[inline(always)]
    pub(super) fn planes(&self) -> &[[[f32; WIDTH]; 2]; 3] {
        &self.planes
    }

    /// One of the boxes.
    #[inline(always)]
    pub(super) fn aabb(&self, slot: usize) -> Aabb32 {
        // Not written with `map`, which is not always inlined.
        let [x, y, z] = &self.planes;
        Aabb32 {
            low: [x[0][slot], y[0][slot], z[0][slot]],
            high: [x[1][slot], y[1][slot], z[1][slot]],
        }
    }

    /// The child in a slot, if the slot is used.
    #[inline(always)]
    pub(super) fn child(&self, slot: usize) -> Option<Child> {
        let child = self.children[slot];
        (child != Child::NONE).then_some(child)
    }

    /// Mask of the slots that hold items.
    #[inline(always)]
    pub(super) fn items(&self) -> u32 {
        let mut items = 0;
        for (slot, child) in self.children.iter().enumerate() {
            items |= u32::from(child.item().is_some()) << slot;
        }
        items
    }

    /// The node with the indices of child nodes and sphere leaves moved by these offsets.
    pub(super) fn shifted(&self, nodes: u32, sphere_leaves: u32) -> Self {
        let mut node = self.clone();
        for child in &mut node.children {
            *child = child.shifted(nodes, sphere_leaves);
        }
        node
    }

    /// Replaces each of its items by the child at that position of `list`.
    pub(super) fn replace_items(&mut self, list: &[Child]) {
        for child in &mut self.children {
            if let Some(item) = child.item() {
                *child = list[item as usize];
            }
        }
    }

    /// Number of items.
    pub(super) fn count(&self) -> usize {
        self.children
            .iter()
            .filter_map(|child| child.item())
            .count()
    }

    /// Renumbers its items consecutively from `first`, and writes their old numbers to the front of `order`; returns
    /// their count.
    pub(super) fn renumber(&mut self, first: u32, order: &mut [u32]) -> u32 {
        let mut count = 0;
        for child in &mut self.children {
            if let Some(item) = child.item() {
                order[count as usize] = item;
                *child = Child::of_item(first + count);
                count += 1;
            }
        }
        count
    }

    /// Where the ray enters each box, and a mask of the boxes that it may hit between `from` and `to`. The entry may be
    /// too late only by an error that [`FrameRay::to`] allows for.
    #[inline(always)]
    pub(super) fn intersect(
        &self,
        lanes: SimdLevel,
        ray: &FrameRay,
        from: f32,
        to: f32,
    ) -> ([f32; WIDTH], u32) {
        let node = self;
        lanes.run(RayAndNode {
            ray,
            node,
            from,
            to,
        })
    }

    /// Mask of the boxes that overlap a box.
    #[inline]
    pub(super) fn overlap(&self, aabb: &Aabb32) -> u32 {
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(NodeAndBox { node: self, aabb }),
        )
    }
}

/// Overlap test of the boxes of a node with another box.
struct NodeAndBox<'a> {
    node: &'a Node,
    aabb: &'a Aabb32,
}

impl SimdKernel for NodeAndBox<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let mut shared = (1 << WIDTH) - 1;
        for axis in 0..3 {
            let [low, high] = &self.node.planes[axis];
            shared &= <F::F32>::from_array(low).le(<F::F32>::splat(self.aabb.high[axis]));
            shared &= <F::F32>::splat(self.aabb.low[axis]).le(<F::F32>::from_array(high));
        }
        shared
    }
}

/// Intersection test of a ray, between two of its parameters, with the boxes of a node.
struct RayAndNode<'a> {
    ray: &'a FrameRay,
    node: &'a Node,
    from: f32,
    to: f32,
}

impl SimdKernel for RayAndNode<'_> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; WIDTH], u32) {
        let (ray, planes) = (self.ray, &self.node.planes);
        let mut enter = <F::F32>::splat(self.from);
        let mut leave = <F::F32>::splat(self.to);
        for (axis, [low, high]) in planes.iter().enumerate() {
            let inverse = <F::F32>::splat(ray.inverse[axis]);
            let to_low = (<F::F32>::from_array(low) - <F::F32>::splat(ray.high[axis])) * inverse;
            let to_high = (<F::F32>::from_array(high) - <F::F32>::splat(ray.low[axis])) * inverse;
            // Zero times infinity is NaN. It occurs for a plane parallel to the ray that does not contain it: the box
            // is missed.
            enter = to_low.lane_min(to_high).lane_max(enter);
            leave = to_low.lane_max(to_high).lane_min(leave);
        }
        let slack = leave.abs() * <F::F32>::splat(ERROR) + <F::F32>::splat(f32::MIN_POSITIVE);
        (enter.to_array(), enter.le(leave + slack))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn wide_and_narrow_lanes_give_the_same_bits() {
        let mut rng = Random::new(9);
        let special = [0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40];
        let mut any = 0;
        for round in 0..20_000_usize {
            let mut number = || {
                let bits = usize::try_from(rng.bits() % 64).expect("small");
                special
                    .get(bits)
                    .copied()
                    .unwrap_or_else(|| nearest(rng.uniform() - 0.5))
            };
            let mut three = || [number(), number(), number()];
            let ray = FrameRay {
                low: three(),
                high: three(),
                inverse: three(),
                ..FrameRay::BLIND
            };
            let mut node = Node::empty();
            node.planes = [(); 3].map(|()| [(); 2].map(|()| [(); 8].map(|()| number())));
            let from = [f32::NEG_INFINITY, 0.0][usize::from(round % 3 > 0)];
            let to = [1.0, f32::INFINITY][round % 2];
            let wide = node.intersect(SimdLevel::widest(), &ray, from, to);
            let narrow = node.intersect(SimdLevel::NARROW, &ray, from, to);
            assert_eq!(wide.1, narrow.1);
            assert!((0..8).all(|i| wide.0[i].to_bits() == narrow.0[i].to_bits()
                || wide.0[i].is_nan() && narrow.0[i].is_nan()));
            any += wide.1.count_ones();
        }
        assert!(any > 1000);
    }
}
