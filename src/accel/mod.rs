//! Finding what a ray may meet: a bounding volume hierarchy over anything with bounds.
//!
//! Nodes hold eight boxes in single precision, rounded outward, in a frame of the tree's own: centred, and scaled by a
//! power of two. A scene far from the origin or in odd units costs no more than any other.
//!
//! The tree promises never to lose a hit and to visit a box that begins exactly where the search ends. So a caller who
//! decides ties by a rule of its own gets the same answer whatever the order of the visits.

mod build;
mod node;

use crate::math::{Bounds, Ray};
use build::Entry;
use glam::DVec3;
use node::{Cell, Child, Frame, FrameRay, Node};
use smallvec::SmallVec;

/// A tree over items, which it knows by their position in the list it was built from.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    frame: Frame,
}

/// A place still to be visited, with the earliest parameter of the ray in it.
#[derive(Clone, Copy)]
struct Pending {
    enter: f32,
    child: Child,
}

/// Room for the pending places of a tree of ten levels; deeper ones spill to the heap.
type Stack = SmallVec<[Pending; 80]>;

impl Bvh {
    /// The tree over these boxes. Items with empty bounds are left out. Infinite bounds are met by every ray that meets
    /// them, but a caller does better to keep such items elsewhere.
    ///
    /// # Panics
    /// For 2³¹ − 1 boxes or more.
    #[must_use]
    pub fn build(bounds: &[Bounds]) -> Self {
        assert!(bounds.len() < (1 << 31) - 1, "items are counted in 31 bits");
        let whole = bounds
            .iter()
            .filter(|bounds| !bounds.is_empty() && bounds.is_finite())
            .fold(Bounds::EMPTY, |sum, bounds| sum.union(bounds));
        let frame = Frame::new(&whole);
        let mut entries: Vec<Entry> = (0..)
            .zip(bounds)
            .filter(|(_, bounds)| !bounds.is_empty())
            .map(|(item, bounds)| Entry {
                cell: frame.cell(bounds),
                item,
            })
            .collect();
        Bvh {
            nodes: build::build(&mut entries),
            frame,
        }
    }

    /// Visits, roughly front to back, the items whose boxes the ray may meet from `from` to `to`, both included.
    ///
    /// `visit` gets an item and the end of the search so far, and gives the new end: the same, or the parameter of a hit
    /// before it. Boxes that begin beyond the end are passed over.
    pub fn nearest(&self, ray: &Ray, from: f64, to: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        let ray = self.frame.ray(ray);
        let from = ray.from(from);
        let (mut end, mut frame_end) = (to, ray.to(to));
        let mut pending = self.start();
        while let Some(Pending { enter, child }) = pending.pop() {
            if enter > frame_end {
                continue;
            }
            if let Some(node) = child.node() {
                let node = &self.nodes[node as usize];
                push_met(node, &ray, from, frame_end, &mut pending);
                continue;
            }
            let hit = visit(child.item(), end);
            if hit < end {
                (end, frame_end) = (hit, ray.to(hit));
            }
        }
    }

    /// Visits the items whose boxes the ray may meet from `from` to `to`, in no order, until `visit` says to stop.
    /// Says whether it did.
    pub fn any(&self, ray: &Ray, from: f64, to: f64, visit: impl FnMut(u32) -> bool) -> bool {
        let ray = self.frame.ray(ray);
        let (from, to) = (ray.from(from), ray.to(to));
        self.search(|node| node.meet(&ray, from, to).1, visit)
    }

    /// Visits the items whose boxes hold a point, in no order, until `visit` says to stop. Says whether it did.
    /// Boxes are compared in single precision: some that only nearly hold the point are visited as well.
    pub fn around(&self, point: DVec3, visit: impl FnMut(u32) -> bool) -> bool {
        let cell: Cell = self.frame.point(point);
        self.search(|node| node.overlap(&cell), visit)
    }

    /// The memory the tree takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + self.nodes.capacity() * size_of::<Node>()
    }

    fn start(&self) -> Stack {
        let mut pending = Stack::new();
        if !self.nodes.is_empty() {
            pending.push(Pending {
                enter: f32::NEG_INFINITY,
                child: Child::of_node(0),
            });
        }
        pending
    }

    /// Visits the items in the places that `choose` marks, one bit each.
    fn search(&self, choose: impl Fn(&Node) -> u32, mut visit: impl FnMut(u32) -> bool) -> bool {
        let mut pending: SmallVec<[u32; 80]> = SmallVec::new();
        pending.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(node) = pending.pop() {
            let node = &self.nodes[node as usize];
            let mut chosen = choose(node);
            while chosen != 0 {
                let child = node.child(chosen.trailing_zeros() as usize);
                if let Some(below) = child.node() {
                    pending.push(below);
                } else if child != Child::NOTHING && visit(child.item()) {
                    return true;
                }
                chosen &= chosen - 1;
            }
        }
        false
    }
}

/// Puts the children that the ray meets on the stack, the nearest on top.
#[inline]
fn push_met(node: &Node, ray: &FrameRay, from: f32, to: f32, pending: &mut Stack) {
    let (enter, mut met) = node.meet(ray, from, to);
    let base = pending.len();
    while met != 0 {
        let place = met.trailing_zeros() as usize;
        met &= met - 1;
        let child = node.child(place);
        if child == Child::NOTHING {
            continue;
        }
        let next = Pending {
            enter: enter[place],
            child,
        };
        pending.push(next);
        let mut at = pending.len() - 1;
        while at > base && pending[at - 1].enter < next.enter {
            pending[at] = pending[at - 1];
            at -= 1;
        }
        pending[at] = next;
    }
}

#[cfg(test)]
mod tests;
