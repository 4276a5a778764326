//! POV-Ray's boxes of objects and its tree of them ("bounding slabs", after Kay and Kajiya 1986, "Ray Tracing Complex
//! Scenes"). povr does not traverse that tree; of surfaces at exactly one distance it shows the one that POV-Ray, which
//! does, would hit first.

use super::index::index;
use crate::base::math::{Bounds, Ray};
use glam::{DVec3, Vec3};
use smallvec::SmallVec;
use std::ops::Range;

/// Ranges of at most this many nodes are not divided.
const LARGEST_CLUSTER: usize = 4;
/// The cost of a node besides its children, in children.
const NODE_COST: f64 = 3.0;
/// Box tests for one tie, at most: of many equal objects each is tied with all others.
const MOST_TESTS: usize = 512;

/// An object with a box of more than this volume is as good as unbounded to POV-Ray (measured).
const LARGEST_VOLUME: f64 = 2e10;

/// A box as POV-Ray keeps it: its lower corner and its size, in single precision, each rounded to the nearest.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct SingleBox {
    lower: Vec3,
    size: Vec3,
}

impl SingleBox {
    pub(in crate::world) fn new(bounds: &Bounds) -> Self {
        SingleBox {
            lower: bounds.min.as_vec3(),
            size: (bounds.max - bounds.min).as_vec3(),
        }
    }

    /// A box around the object in double precision, wider by the roundings.
    pub(super) fn bounds(&self) -> Bounds {
        let exact = self.exact();
        let slack = f64::from(f32::EPSILON) * (exact.min.abs() + (exact.max - exact.min));
        Bounds {
            min: exact.min - slack,
            max: exact.max + slack,
        }
    }

    fn exact(&self) -> Bounds {
        let (lower, size) = (self.lower.as_dvec3(), self.size.as_dvec3());
        Bounds {
            min: lower,
            max: lower + size,
        }
    }

    /// Returns true if POV-Ray puts an object with this box into its tree; `unit` is the length that stands for one of
    /// its units.
    pub(super) fn is_bounded(&self, unit: f64) -> bool {
        let volume = (self.size.as_dvec3() / unit).element_product();
        self.lower.is_finite() && volume <= LARGEST_VOLUME
    }

    /// The distance at which the line of a ray enters the box, with POV-Ray's roundings to single precision; not
    /// clamped at the ray's origin.
    pub(super) fn entry(&self, ray: &Ray) -> f64 {
        (0..3).fold(f64::NEG_INFINITY, |entry, axis| {
            self.slab(ray, axis)
                .map_or(entry, |(near, _)| entry.max(near))
        })
    }

    /// The distance of [`Self::entry`], if the ray hits the box.
    fn hit_at(&self, ray: &Ray) -> Option<f64> {
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            if let Some((near, far)) = self.slab(ray, axis) {
                (enter, leave) = (enter.max(near), leave.min(far));
            } else {
                let offset = ray.origin[axis] - f64::from(self.lower[axis]);
                if offset < 0.0 || f64::from(self.size[axis]) < offset {
                    return None;
                }
            }
        }
        (enter <= leave && 0.0 <= leave).then_some(enter)
    }

    /// The distances at which the line of a ray passes the two planes across an axis, unless it is parallel to them.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "POV-Ray computes in single precision here"
    )]
    fn slab(&self, ray: &Ray, axis: usize) -> Option<(f64, f64)> {
        let d = ray.dir[axis];
        if d == 0.0 {
            return None;
        }
        let per_unit = (1.0 / d) as f32;
        let lower = f64::from((self.lower[axis] - ray.origin[axis] as f32) * per_unit);
        let upper = lower + f64::from(self.size[axis] * per_unit);
        Some(if d > 0.0 {
            (lower, upper)
        } else {
            (upper, lower)
        })
    }
}

/// POV-Ray's tree over the bounded objects.
#[derive(Clone, Debug)]
pub(super) struct SlabTree {
    nodes: Vec<Node>,
    /// The children of all inner nodes.
    children: Vec<u32>,
    root: u32,
    /// The items without a box.
    unbounded: Vec<u32>,
}

/// The node that holds all unbounded items, and the first of these, in the heap.
const UNBOUNDED_ITEMS: u32 = u32::MAX;
const FIRST_UNBOUNDED: u32 = 1 << 31;

#[derive(Clone, Debug)]
struct Node {
    slabs: SingleBox,
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    Item(u32),
    /// A range of [`SlabTree::children`].
    Inner(Range<usize>),
}

impl SlabTree {
    /// The tree of the boxes of the items that have one. Levels are built from below: each round divides all
    /// nodes of the last one where that lowers the estimated cost, and makes a node of each part.
    pub(super) fn new<'b>(boxes: impl Iterator<Item = Option<&'b SingleBox>>) -> SlabTree {
        let mut tree = SlabTree {
            nodes: Vec::new(),
            children: Vec::new(),
            root: 0,
            unbounded: Vec::new(),
        };
        for (number, slabs) in (0..).zip(boxes) {
            if let Some(slabs) = slabs {
                tree.nodes.push(Node {
                    slabs: *slabs,
                    content: Content::Item(number),
                });
            } else {
                tree.unbounded.push(number);
            }
        }
        let mut start = 0;
        while tree.nodes.len() - start > 1 {
            let mut level: Vec<u32> = (index(start)..index(tree.nodes.len())).collect();
            start = tree.nodes.len();
            tree.add_level(&mut level);
        }
        tree.root = index(tree.nodes.len().saturating_sub(1));
        tree
    }

    fn add_level(&mut self, level: &mut [u32]) {
        let mut parts: Vec<Range<usize>> = Vec::new();
        parts.push(0..level.len());
        while let Some(range) = parts.pop() {
            let part = &mut level[range.clone()];
            match self.division(part) {
                Some(size) => {
                    let middle = range.start + size;
                    parts.push(middle..range.end);
                    parts.push(range.start..middle);
                }
                None => self.add_node(part),
            }
        }
    }

    fn add_node(&mut self, part: &[u32]) {
        let bounds = part.iter().fold(Bounds::EMPTY, |bounds, node| {
            bounds.union(&self.bounds(*node))
        });
        let first = self.children.len();
        self.children.extend_from_slice(part);
        self.nodes.push(Node {
            slabs: SingleBox::new(&bounds),
            content: Content::Inner(first..self.children.len()),
        });
    }

    fn bounds(&self, node: u32) -> Bounds {
        self.nodes[node as usize].slabs.exact()
    }

    /// Sorts a part of a level along an axis. Returns the size of the first of the two parts into which to divide it,
    /// or none where that does not pay: the cost is the sum of area times number (Goldsmith and Salmon 1987).
    fn division(&self, part: &mut [u32]) -> Option<usize> {
        if part.len() > 1 {
            let axis = self.sorting_axis(part);
            // In single precision, where near centres are equal.
            let centre = |node: &u32| {
                let SingleBox { lower, size } = self.nodes[*node as usize].slabs;
                lower[axis] + 0.5 * size[axis]
            };
            part.sort_by(|a, b| centre(a).total_cmp(&centre(b)));
        }
        if part.len() <= LARGEST_CLUSTER {
            return None;
        }
        let area_up_to = |bounds: &mut Bounds, node: &u32| {
            *bounds = bounds.union(&self.bounds(*node));
            let size = bounds.max - bounds.min;
            Some(size.x * (size.y + size.z) + size.y * size.z)
        };
        let left: Vec<f64> = part.iter().scan(Bounds::EMPTY, area_up_to).collect();
        let right: Vec<f64> = part.iter().rev().scan(Bounds::EMPTY, area_up_to).collect();
        let cost = |size: usize| {
            let rest = part.len() - size;
            count(size) * left[size - 1] + count(rest) * right[rest - 1]
        };
        let undivided = left[part.len() - 1] * (count(part.len()) - NODE_COST);
        let start = (undivided, None);
        (1..part.len())
            .fold(start, |best, size| {
                let cost = cost(size);
                if cost < best.0 {
                    (cost, Some(size))
                } else {
                    best
                }
            })
            .1
    }

    /// The axis along which the boxes spread most, by POV-Ray's measure: of boxes that reach beyond the last maximum
    /// it notes the lower end.
    fn sorting_axis(&self, part: &[u32]) -> usize {
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &node in part {
            let bounds = self.bounds(node);
            least = least.min(bounds.min);
            most = DVec3::select(bounds.max.cmpgt(most), bounds.min, most);
        }
        let spread = most - least;
        (1..3).fold(0, |best, axis| {
            if spread[axis] > spread[best] {
                axis
            } else {
                best
            }
        })
    }

    /// Sorts items, each with its number and the distance at which the ray enters its box, as POV-Ray comes to them,
    /// which takes nodes by that distance. At equal ones its heap decides, and a ray may enter a node a rounding behind
    /// the item in it. Distances far apart, and all behind many boxes, decide alone.
    pub(super) fn sort<T: Copy>(
        &self,
        items: &mut [T],
        number: impl Fn(&T) -> u32,
        entry: impl Fn(&T) -> f64,
        ray: &Ray,
    ) {
        let with_entry = |item: &T| (entry(item), *item);
        let mut entered: SmallVec<[(f64, T); 4]> = items.iter().map(with_entry).collect();
        entered.sort_by(|(entry_a, a), (entry_b, b)| {
            entry_a.total_cmp(entry_b).then(number(a).cmp(&number(b)))
        });
        for (item, (_, sorted)) in items.iter_mut().zip(&entered) {
            *item = *sorted;
        }
        let blur = self.blur(ray);
        let is_far = |pair: &[(f64, T)]| pair[1].0 - pair[0].0 > blur;
        if entered.windows(2).all(is_far) {
            return;
        }
        let mut sorted = 0;
        self.visit_items(ray, |item| {
            let waiting = &mut items[sorted..];
            if let Some(at) = waiting.iter().position(|other| number(other) == item) {
                waiting[..=at].rotate_right(1);
                sorted += 1;
            }
            sorted + 1 < items.len()
        });
    }

    /// Visits items in POV-Ray's order until `visit` returns false, or many boxes are tested.
    fn visit_items(&self, ray: &Ray, mut visit: impl FnMut(u32) -> bool) {
        let mut heap = Heap::default();
        // The node of unbounded items is the first child of the root.
        if !self.unbounded.is_empty() {
            heap.push(f64::NEG_INFINITY, UNBOUNDED_ITEMS);
        }
        let root = self.nodes.get(self.root as usize).map(|node| &node.content);
        let mut tests = 0;
        match root {
            Some(Content::Inner(range)) => tests += self.push_hit(range.clone(), ray, &mut heap),
            Some(Content::Item(_)) => self.push_if_hit(self.root, ray, &mut heap),
            None => {}
        }
        while let Some(node) = heap.pop().filter(|_| tests <= MOST_TESTS) {
            if node == UNBOUNDED_ITEMS {
                tests += self.unbounded.len();
                for position in (FIRST_UNBOUNDED..).take(self.unbounded.len().min(MOST_TESTS)) {
                    heap.push(f64::NEG_INFINITY, position);
                }
                continue;
            }
            let item = match self.nodes.get(node as usize).map(|node| &node.content) {
                Some(Content::Item(item)) => *item,
                Some(Content::Inner(range)) => {
                    tests += self.push_hit(range.clone(), ray, &mut heap);
                    continue;
                }
                None => self.unbounded[(node - FIRST_UNBOUNDED) as usize],
            };
            if !visit(item) {
                return;
            }
        }
    }

    /// Pushes the hit ones of some children. Returns their number with the others.
    fn push_hit(&self, children: Range<usize>, ray: &Ray, heap: &mut Heap) -> usize {
        for &child in &self.children[children.clone()] {
            self.push_if_hit(child, ray, heap);
        }
        children.len()
    }

    fn push_if_hit(&self, node: u32, ray: &Ray, heap: &mut Heap) {
        if let Some(entry) = self.nodes[node as usize].slabs.hit_at(ray) {
            heap.push(entry, node);
        }
    }

    /// Bound on how far behind the entry into an item a ray can enter a node around it: on an axis along which it runs
    /// down, some roundings of the numbers from which the entry is computed.
    fn blur(&self, ray: &Ray) -> f64 {
        let Some(root) = self.nodes.get(self.root as usize) else {
            return 0.0;
        };
        let Bounds { min, max } = root.slabs.exact();
        let reach = min.abs() + (max - min) + ray.origin.abs();
        let along = (0..3).filter(|&axis| ray.dir[axis] < 0.0);
        let blurs = along.map(|axis| reach[axis] / -ray.dir[axis]);
        8.0 * f64::from(f32::EPSILON) * blurs.fold(0.0, f64::max)
    }
}

#[allow(
    clippy::cast_precision_loss,
    reason = "numbers of objects are far below 2^52"
)]
fn count(number: usize) -> f64 {
    number as f64
}

/// A binary heap of nodes by distance. The order of equal ones is that of POV-Ray's, which the standard library's would
/// not give.
#[derive(Default)]
struct Heap(SmallVec<[(f64, u32); 64]>);

impl Heap {
    fn push(&mut self, key: f64, node: u32) {
        let mut at = self.0.len();
        self.0.push((key, node));
        while at > 0 && key < self.0[(at - 1) / 2].0 {
            self.0.swap(at, (at - 1) / 2);
            at = (at - 1) / 2;
        }
    }

    fn pop(&mut self) -> Option<u32> {
        if self.0.is_empty() {
            return None;
        }
        let (_, first) = self.0.swap_remove(0);
        let mut at = 0;
        loop {
            let (left, right) = (2 * at + 1, 2 * at + 2);
            if left >= self.0.len() {
                return Some(first);
            }
            let is_left = right >= self.0.len() || self.0[left].0 < self.0[right].0;
            let child = if is_left { left } else { right };
            if self.0[at].0 <= self.0[child].0 {
                return Some(first);
            }
            self.0.swap(at, child);
            at = child;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn huge_boxes_and_infinite_ones_are_unbounded() {
        let cube = |side: f64| SingleBox::new(&Bounds::new(DVec3::ZERO, DVec3::splat(side)));
        assert!(cube(2714.0).is_bounded(1.0) && !cube(2715.0).is_bounded(1.0));
        assert!(cube(2715.0).is_bounded(2.0) && !cube(1358.0).is_bounded(0.5));
        assert!(!cube(f64::INFINITY).is_bounded(1.0));
        let flat = Bounds::new(DVec3::ZERO, DVec3::new(1e20, 0.0, f64::INFINITY));
        assert!(!SingleBox::new(&flat).is_bounded(1.0));
    }
}
