//! Nodes of eight boxes in single precision, and a ray made ready for them.
//!
//! Every rounding goes outward: boxes grow, the ray's origin becomes an interval, and the two ends of the stretch in a
//! box get the error of three roundings. Whatever a box holds in double precision is never lost.

use crate::math::conditioning::power_of_two;
use crate::math::lanes::Slabs;
use crate::math::rounding::{f32_above, f32_below, loose_above, loose_below, nearest};
use crate::math::{Bounds, Ray};
use glam::DVec3;

/// How many children a node has room for.
pub(super) const WIDTH: usize = 8;

/// The relative error of `(plane - origin) / dir` in single precision (three roundings) and of this correction.
const ERROR: f32 = 6.0 / 16_777_216.0;

/// Directions below this, against a longest component near one, say nothing about an axis in single precision.
const FLAT: f64 = 1e-30;

/// Eight boxes. Unused places hold an empty box.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(super) struct Node {
    /// By axis and end (low, high), the planes of the eight boxes.
    planes: [[[f32; WIDTH]; 2]; 3],
    children: [Child; WIDTH],
}

/// What hangs below a place in a node: a node, an item, or nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Child(u32);

/// A box in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
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
    /// By axis, which end of a box comes first.
    first: [usize; 3],
    /// The end of the origin's interval that makes the near planes nearer, and the one that makes the far ones farther.
    near: [f32; 3],
    far: [f32; 3],
    inverse: [f32; 3],
    /// Frame parameter of a ray parameter: `t · rate - start`.
    rate: f64,
    start: f64,
}

impl Child {
    /// Set where the child is an item.
    const ITEM: u32 = 1 << 31;

    /// An unused place. It must be known as such: a ray that meets everything also meets its empty box.
    pub(super) const NOTHING: Child = Child(u32::MAX);

    pub(super) fn of_node(index: u32) -> Self {
        Child(index)
    }

    pub(super) fn of_item(item: u32) -> Self {
        Child(item | Child::ITEM)
    }

    #[inline]
    pub(super) fn node(self) -> Option<u32> {
        (self.0 & Child::ITEM == 0).then_some(self.0)
    }

    /// The item of a child that is not a node.
    #[inline]
    pub(super) fn item(self) -> u32 {
        self.0 & !Child::ITEM
    }
}

impl Cell {
    pub(super) const EMPTY: Cell = Cell {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    pub(super) fn union(&self, other: &Cell) -> Cell {
        let mut both = *self;
        for axis in 0..3 {
            both.low[axis] = smaller(both.low[axis], other.low[axis]);
            both.high[axis] = larger(both.high[axis], other.high[axis]);
        }
        both
    }

    /// Half the surface, zero for an empty box.
    pub(super) fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| (self.high[axis] - self.low[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

/// The second where one is not a number; one instruction, unlike `f32::min`, which asks whether both are.
#[inline(always)]
pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// As [`smaller`].
#[inline(always)]
pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
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

    /// A point in this frame.
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        (point - self.centre) * self.scale
    }

    /// The length in this frame of a unit of length.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A box rounded outward; unknown ends become infinite.
    pub(super) fn cell(&self, bounds: &Bounds) -> Cell {
        let low = (bounds.min - self.centre) * self.scale;
        let high = (bounds.max - self.centre) * self.scale;
        let known = |end: f64, unknown: f64| if end.is_nan() { unknown } else { end };
        Cell {
            low: [0, 1, 2].map(|i| f32_below(known(low[i].next_down(), f64::NEG_INFINITY))),
            high: [0, 1, 2].map(|i| f32_above(known(high[i].next_up(), f64::INFINITY))),
        }
    }

    /// A ray in this frame. One that cannot be brought into it meets every box.
    #[inline(always)]
    pub(super) fn ray(&self, ray: &Ray) -> FrameRay {
        let length = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir * (1.0 / length);
        let origin = (ray.origin - self.centre) * self.scale;
        let rate = self.scale * length;
        if !(origin.is_finite() && dir.is_finite() && rate.is_normal()) {
            return FrameRay::BLIND;
        }
        // From far away the rounding of the origin would blow up every box: start at the point nearest to the centre.
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

    /// The interval of each coordinate of a point, as a box.
    pub(super) fn point(&self, point: DVec3) -> Cell {
        self.cell(&Bounds {
            min: point,
            max: point,
        })
    }
}

impl FrameRay {
    /// The ray that meets every box at every time.
    const BLIND: FrameRay = FrameRay {
        first: [0; 3],
        near: [f32::INFINITY; 3],
        far: [f32::NEG_INFINITY; 3],
        inverse: [1.0; 3],
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
            let low = loose_below(origin[axis] - error);
            let high = loose_above(origin[axis] + error);
            let is_back = dir[axis] < 0.0;
            let inverse = nearest(1.0 / steepness);
            ray.inverse[axis] = if is_back { -inverse } else { inverse };
            ray.first[axis] = usize::from(is_back);
            ray.near[axis] = if is_back { low } else { high };
            ray.far[axis] = if is_back { high } else { low };
        }
        ray
    }

    #[inline]
    fn error(&self, t: f64) -> f64 {
        4.0 * f64::EPSILON * (t.abs() + self.start.abs())
    }

    /// A bound below a ray parameter in the frame.
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

    /// A bound above a ray parameter in the frame.
    #[inline(always)]
    pub(super) fn to(&self, t: f64) -> f32 {
        let t = t * self.rate;
        let to = loose_above(t - self.start + self.error(t));
        if to.is_nan() { f32::INFINITY } else { to }
    }
}

impl Node {
    pub(super) fn empty() -> Self {
        Node {
            planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
            children: [Child::NOTHING; WIDTH],
        }
    }

    pub(super) fn set(&mut self, place: usize, cell: &Cell, child: Child) {
        for axis in 0..3 {
            self.planes[axis][0][place] = cell.low[axis];
            self.planes[axis][1][place] = cell.high[axis];
        }
        self.children[place] = child;
    }

    /// By axis and end (low, high), the planes of the eight boxes.
    #[inline(always)]
    pub(super) fn planes(&self) -> &[[[f32; WIDTH]; 2]; 3] {
        &self.planes
    }

    /// One of the boxes.
    #[inline(always)]
    pub(super) fn cell(&self, place: usize) -> Cell {
        Cell {
            low: [0, 1, 2].map(|axis| self.planes[axis][0][place]),
            high: [0, 1, 2].map(|axis| self.planes[axis][1][place]),
        }
    }

    #[inline]
    pub(super) fn child(&self, place: usize) -> Child {
        self.children[place]
    }

    /// Moves the indices of child nodes by `by`.
    pub(super) fn shift(&mut self, by: u32) {
        for child in &mut self.children {
            if let Some(node) = child.node() {
                *child = Child::of_node(node + by);
            }
        }
    }

    /// Calls its items by their place at the end of `order`, which they are added to.
    pub(super) fn renumber(&mut self, order: &mut Vec<u32>) {
        for child in &mut self.children {
            if child.node().is_none() && *child != Child::NOTHING {
                let place = u32::try_from(order.len()).expect("items are counted in 31 bits");
                order.push(child.item());
                *child = Child::of_item(place);
            }
        }
    }

    /// Where the ray enters each box at the earliest, and which boxes it may meet between `from` and `to`, one bit each.
    #[inline(always)]
    pub(super) fn meet(&self, ray: &FrameRay, from: f32, to: f32) -> ([f32; WIDTH], u32) {
        let [x, y, z] = &self.planes;
        let [i, j, k] = [ray.first[0] & 1, ray.first[1] & 1, ray.first[2] & 1];
        let slabs = Slabs {
            first: [&x[i], &y[j], &z[k]],
            last: [&x[i ^ 1], &y[j ^ 1], &z[k ^ 1]],
            near: ray.near,
            far: ray.far,
            inverse: ray.inverse,
            from,
            to,
            error: ERROR,
        };
        slabs.meet()
    }

    /// Which boxes share a point with a box, one bit each.
    #[inline]
    pub(super) fn overlap(&self, cell: &Cell) -> u32 {
        let mut shared = 0;
        for i in 0..WIDTH {
            let is_shared = (0..3).all(|axis| {
                self.planes[axis][0][i] <= cell.high[axis]
                    && self.planes[axis][1][i] >= cell.low[axis]
            });
            shared |= u32::from(is_shared) << i;
        }
        shared
    }
}
