//! Bounding volume hierarchy (BVH) over anything with bounds.
//!
//! Nodes hold eight boxes in single precision, rounded outward, in a frame of the tree's own: centred, and scaled by a
//! power of two. A scene far from the origin or in odd units costs no more than any other. Where a node would hold
//! nothing but spheres, a leaf stores the spheres themselves, which leaves fewer of them to be tested
//! (`sphere_leaf.rs`).
//!
//! Traversal never loses a hit, and it visits a box that begins exactly where the search ends. So a caller who breaks
//! ties by a rule of its own gets the same answer whatever the order of the visits.

mod beam;
mod bounding_cylinder;
mod bounding_sphere;
mod build;
mod bundle;
mod frustum;
mod light_buffer;
mod node;
mod packet;
mod packet_interval;
mod parallel_bundle;
mod sphere_leaf;
mod stream;
mod treelets;

pub use beam::MAX_BEAM_ITEMS;
pub use bundle::{Bundle, NewEnds};

pub use bounding_cylinder::BoundingCylinder;
pub use light_buffer::LightBuffer;
pub use parallel_bundle::ParallelBundle;
pub(crate) use stream::MAX_STREAM_RAYS;

use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use arrayvec::ArrayVec;
use bounding_sphere::BoundingSphere;
use build::{Entry, GrowingBvh};
use glam::DVec3;
use node::{Aabb32, Child, ChildKind, Frame, Node, WIDTH};
use rayon::prelude::*;
use sphere_leaf::SphereLeaf;

/// A BVH over items, which are identified by their position in the list it was built from.
#[derive(Clone, Debug)]
pub struct Bvh {
    root: Option<Child>,
    nodes: Vec<Node>,
    /// Leaves of up to eight spheres, in place of nodes that would hold nothing else.
    sphere_leaves: Vec<SphereLeaf>,
    /// The first item of each sphere leaf; its other items follow.
    first_items: Vec<u32>,
    frame: Frame,
    /// Bounding spheres of items, for bundles; empty if no item has one, and where sphere leaves hold all items.
    bounding_spheres: Vec<Option<BoundingSphere>>,
}

/// A subtree still to be visited, with the smallest parameter of the ray in its box.
#[derive(Clone, Copy, Default)]
struct Pending<C> {
    enter: f32,
    child: C,
}

/// A traversal stack. Only the deepest trees need the heap, and its memory is not cleared beforehand: that would cost
/// as much as the traversal of a small tree.
struct Stack<T> {
    entries: ArrayVec<T, STACK_CAPACITY>,
    /// Older entries, moved to the heap.
    spilled: Vec<T>,
}

/// The items of a sphere leaf, numbered as before the reordering by the tree.
type LeafItems = [u32; WIDTH];

/// Number of nodes per parallel task when items are counted and renumbered.
const NODES_PER_CHUNK: usize = 1 << 12;

/// Number of pending entries that a tree of eight levels needs at the most.
const STACK_CAPACITY: usize = 64;

impl<T: Copy> Stack<T> {
    #[inline(always)]
    fn new() -> Self {
        Stack {
            entries: ArrayVec::new_const(),
            spilled: Vec::new(),
        }
    }

    /// Makes sure that the children of a node fit; returns the number of entries in use.
    #[inline(always)]
    fn reserve(&mut self) -> usize {
        if self.entries.len() > STACK_CAPACITY - WIDTH {
            self.deepen();
        }
        self.entries.len()
    }

    #[cold]
    fn deepen(&mut self) {
        self.spilled.extend_from_slice(&self.entries);
        self.entries.clear();
    }

    /// Pushes an entry; [`Stack::reserve`] must have been called.
    #[inline(always)]
    fn push(&mut self, entry: T) {
        self.entries.push(entry);
    }

    /// Inserts an entry below those that come before it, but not below index `bottom`; [`Stack::reserve`] must have
    /// been called.
    #[inline(always)]
    fn insert(&mut self, entry: T, bottom: usize, comes_first: impl Fn(&T, &T) -> bool) {
        let mut index = self.entries.len();
        self.entries.push(entry);
        while index > bottom && comes_first(&self.entries[index - 1], &entry) {
            self.entries[index] = self.entries[index - 1];
            index -= 1;
        }
        self.entries[index] = entry;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<T> {
        let top = self.entries.pop();
        top.or_else(|| self.spilled.pop())
    }
}

impl Bvh {
    /// Builds the tree over these boxes. Items with empty bounds are left out. Infinite bounds are visited by every ray
    /// that intersects them, but such items are better handled outside of the tree.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build(bounds: &[Bounds]) -> Self {
        Bvh::build_of(bounds.len(), |item| bounds[item])
    }

    /// Builds the tree over `count` items whose boxes `bounds` gives. It is called more than once for each item, so
    /// that no list of boxes has to be stored.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build_of(count: usize, bounds: impl Fn(usize) -> Bounds + Sync) -> Self {
        Bvh::grow(count, |item| (bounds(item), false)).0
    }

    /// Builds the tree; also returns the items of its sphere leaves. `bounds` also tells whether an item is the sphere
    /// that touches all sides of its box.
    fn grow(
        count: usize,
        bounds: impl Fn(usize) -> (Bounds, bool) + Sync,
    ) -> (Self, Vec<LeafItems>) {
        assert!(count <= Child::MAX_COUNT, "items are counted in 30 bits");
        let finite_bounds = (0..count).into_par_iter().map(|item| {
            let (bounds, _) = bounds(item);
            let is_bounded = bounds.is_finite() && !bounds.is_empty();
            let finite_bounds = if is_bounded { bounds } else { Bounds::EMPTY };
            (finite_bounds, bounds.is_empty())
        });
        let (whole, has_empty) = finite_bounds.reduce(
            || (Bounds::EMPTY, false),
            |all, one| (all.0.union(&one.0), all.1 || one.1),
        );
        let frame = Frame::new(&whole);
        let entry = |item| {
            let (bounds, is_sphere) = bounds(item as usize);
            Entry::new(frame.aabb(&bounds), item, is_sphere)
        };
        let items = 0..u32::try_from(count).expect("no more than that");
        let mut entries: Vec<Entry> = items.into_par_iter().map(entry).collect();
        if has_empty {
            entries.retain(|entry| !bounds(entry.item() as usize).0.is_empty());
        }
        let GrowingBvh {
            root,
            nodes,
            sphere_leaves,
            leaf_items,
        } = treelets::build(entries);
        let tree = Bvh {
            root,
            nodes,
            sphere_leaves,
            first_items: Vec::new(),
            frame,
            bounding_spheres: Vec::new(),
        };
        (tree, leaf_items)
    }

    /// Builds the tree over `count` boxes, and the list of the items in the order of the tree. From then on the tree
    /// identifies items by their position in that list, so that neighbours can be stored together. `bounds` also tells
    /// whether an item is the sphere that touches all sides of its box.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build_in_order(
        count: usize,
        bounds: impl Fn(usize) -> (Bounds, bool) + Sync,
    ) -> (Self, Vec<u32>) {
        let (mut tree, leaf_items) = Bvh::grow(count, &bounds);
        let mut order = vec![0; count];
        let pieces = tree.nodes.par_chunks(NODES_PER_CHUNK);
        let counts: Vec<usize> = pieces
            .map(|nodes| nodes.iter().map(Node::count).sum())
            .collect();
        let (mut first, mut rest) = (0, &mut order[..]);
        let mut lists = Vec::with_capacity(counts.len());
        for &count in &counts {
            let (list, others) = rest.split_at_mut(count);
            lists.push((first, list));
            first += u32::try_from(count).expect("items are counted in 30 bits");
            rest = others;
        }
        let pieces = tree.nodes.par_chunks_mut(NODES_PER_CHUNK).zip(lists);
        pieces.for_each(|(nodes, (mut first, mut list))| {
            for node in nodes {
                let count = node.renumber(first, list);
                first += count;
                list = &mut list[count as usize..];
            }
        });
        tree.first_items.reserve_exact(leaf_items.len());
        for (leaf, leaf_items) in tree.sphere_leaves.iter().zip(&leaf_items) {
            tree.first_items.push(first);
            let count = leaf.count();
            order[first as usize..][..count].copy_from_slice(&leaf_items[..count]);
            first += build::index(count);
        }
        order.truncate(first as usize);
        (tree, order)
    }

    /// Sets the bounding spheres of items, which bundles of rays are tested against. `sphere` gives the centre and the
    /// radius for each of the `count` items of the tree, and whether the item is that sphere itself.
    pub fn set_bounding_spheres(
        &mut self,
        count: usize,
        sphere: impl Fn(usize) -> Option<(DVec3, f64, bool)> + Sync,
    ) {
        if !self.has_only_spheres() && (0..count).any(|item| sphere(item).is_some()) {
            let frame = &self.frame;
            let bounding_sphere = |item| {
                sphere(item).map(|(centre, radius, is_filled)| {
                    BoundingSphere::new(frame, centre, radius, is_filled)
                })
            };
            self.bounding_spheres = (0..count).into_par_iter().map(bounding_sphere).collect();
        }
    }

    /// True if sphere leaves hold all items: those in nodes are numbered first.
    pub fn has_only_spheres(&self) -> bool {
        self.first_items.first() == Some(&0)
    }

    /// Visits, roughly front to back, the items whose boxes the ray may hit from `from` to `to`, both included.
    ///
    /// `visit` gets an item and the current end of the search, and returns the new end: the same, or the parameter of a
    /// hit before it. Boxes that begin beyond the end are skipped.
    #[inline]
    pub fn nearest(&self, ray: &Ray, from: f64, to: f64, visit: impl FnMut(u32, f64) -> f64) {
        with_widest(
            #[inline(always)]
            |lanes| self.nearest_in(lanes, ray, (from, to), visit),
        );
    }

    /// [`Bvh::nearest`] inside a function that is already compiled for a SIMD level.
    #[inline(always)]
    pub(crate) fn nearest_in(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        (from, to): (f64, f64),
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        let ray = self.frame.ray(ray);
        let from = ray.from(from);
        let (mut end, mut frame_end) = (to, ray.to(to));
        let mut pending = Stack::new();
        let mut next = self.root;
        while let Some(child) = next {
            next = match child.kind() {
                ChildKind::Node(node) => {
                    let node = &self.nodes[node as usize];
                    let bottom = pending.reserve();
                    let (enter, hits) = node.intersect(lanes, &ray, from, frame_end);
                    let child_at = |slot: usize| node.child(slot);
                    nearest_child(&enter, hits, &mut pending, bottom, child_at)
                }
                ChildKind::Leaf(number) => {
                    let leaf = &self.sphere_leaves[number as usize];
                    let bottom = pending.reserve();
                    let (enter, hits) = leaf.intersect(lanes, &ray, from, frame_end);
                    let first = self.first_items[number as usize];
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let child_at = |slot: usize| Some(Child::of_item(first + slot as u32));
                    nearest_child(&enter, hits, &mut pending, bottom, child_at)
                }
                ChildKind::Item(item) => {
                    let hit = visit(item, end);
                    if hit < end {
                        (end, frame_end) = (hit, ray.to(hit));
                    }
                    None
                }
            };
            while next.is_none()
                && let Some(entry) = pending.pop()
            {
                next = (entry.enter <= frame_end).then_some(entry.child);
            }
        }
    }

    /// Visits the items whose boxes the ray may hit from `from` to `to`, in no order, until `visit` returns true.
    /// Returns whether it did.
    #[inline]
    pub fn any(&self, ray: &Ray, from: f64, to: f64, visit: impl FnMut(u32) -> bool) -> bool {
        with_widest(
            #[inline(always)]
            |lanes| self.any_in(lanes, ray, (from, to), visit),
        )
    }

    /// [`Bvh::any`] inside a function that is already compiled for a SIMD level.
    #[inline(always)]
    pub(crate) fn any_in(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        (from, to): (f64, f64),
        visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let ray = self.frame.ray(ray);
        let (from, to) = (ray.from(from), ray.to(to));
        self.search(
            #[inline(always)]
            |node| node.intersect(lanes, &ray, from, to).1,
            #[inline(always)]
            |leaf| leaf.intersect(lanes, &ray, from, to).1,
            visit,
        )
    }

    /// Visits the items whose boxes the ray may hit from `from` to `to`, in no order, each with a finite parameter: from `from`
    /// to there the ray is outside the box.
    #[inline]
    pub fn each_entered(&self, ray: &Ray, from: f64, to: f64, mut visit: impl FnMut(u32, f64)) {
        with_widest(
            #[inline(always)]
            |lanes| {
                let ray = self.frame.ray(ray);
                let (from, to) = (ray.from(from), ray.to(to));
                self.search_with_values(
                    #[inline(always)]
                    |node| node.intersect(lanes, &ray, from, to),
                    #[inline(always)]
                    |leaf| leaf.intersect(lanes, &ray, from, to),
                    #[inline(always)]
                    |item, enter| {
                        visit(item, ray.parameter_before(enter));
                        false
                    },
                );
            },
        );
    }

    /// All items, in the order in which [`Bvh::any`] visits any subset of them.
    #[must_use]
    pub fn visit_order(&self) -> Vec<u32> {
        let mut order = Vec::new();
        self.search(
            |_| (1 << WIDTH) - 1,
            |leaf| (1 << leaf.count()) - 1,
            |item| {
                order.push(item);
                false
            },
        );
        order
    }

    /// Visits the items whose boxes contain a point, in no order, until `visit` returns true. Returns whether it did.
    /// Boxes are compared in single precision: some that only nearly contain the point are visited as well.
    pub fn visit_containing(&self, point: DVec3, visit: impl FnMut(u32) -> bool) -> bool {
        let aabb: Aabb32 = self.frame.aabb_around(point);
        self.search(
            |node| node.overlap(&aabb),
            |leaf| leaf.overlap(&aabb),
            visit,
        )
    }

    /// The memory that the tree takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.nodes.capacity() * size_of::<Node>()
            + self.sphere_leaves.capacity() * size_of::<SphereLeaf>()
            + self.first_items.capacity() * size_of::<u32>()
            + self.bounding_spheres.capacity() * size_of::<Option<BoundingSphere>>()
    }

    /// Calls `visit` with each item and its box.
    fn for_each_item(&self, visit: impl FnMut(u32, Aabb32)) {
        self.for_some_items(1, visit);
    }

    /// [`Bvh::for_each_item`] for one in `step` nodes and sphere leaves only.
    fn for_some_items(&self, step: usize, mut visit: impl FnMut(u32, Aabb32)) {
        for node in self.nodes.iter().step_by(step) {
            for slot in 0..WIDTH {
                if let Some(item) = node.child(slot).and_then(Child::item) {
                    visit(item, node.aabb(slot));
                }
            }
        }
        self.for_some_spheres(step, |item, sphere| visit(item, sphere.aabb()));
    }

    /// Calls `visit` with the items of one in `step` sphere leaves, and their spheres.
    fn for_some_spheres(&self, step: usize, mut visit: impl FnMut(u32, BoundingSphere)) {
        let sphere_leaves = self.sphere_leaves.iter().zip(&self.first_items);
        for (leaf, &first) in sphere_leaves.step_by(step) {
            for (item, slot) in (first..).zip(0..leaf.count()) {
                visit(item, leaf.sphere(slot));
            }
        }
    }

    /// Visits the items in the slots that `choose` and `choose_spheres` mark, one bit each.
    #[inline(always)]
    fn search(
        &self,
        choose: impl Fn(&Node) -> u32,
        choose_spheres: impl Fn(&SphereLeaf) -> u32,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        self.search_with_values(
            #[inline(always)]
            |node| ([(); WIDTH], choose(node)),
            #[inline(always)]
            |leaf| ([(); WIDTH], choose_spheres(leaf)),
            #[inline(always)]
            |item, ()| visit(item),
        )
    }

    /// [`Bvh::search`] with a value for each slot, which `visit` receives.
    #[inline(always)]
    fn search_with_values<V: Copy>(
        &self,
        choose: impl Fn(&Node) -> ([V; WIDTH], u32),
        choose_spheres: impl Fn(&SphereLeaf) -> ([V; WIDTH], u32),
        mut visit: impl FnMut(u32, V) -> bool,
    ) -> bool {
        let mut pending = Stack::new();
        let mut next = self.root;
        while let Some(child) = next {
            match child.kind() {
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    pending.reserve();
                    let (values, mut chosen) = choose(node);
                    while chosen != 0 {
                        let slot = chosen.trailing_zeros() as usize % WIDTH;
                        if let Some(child) = node.child(slot) {
                            if let Some(item) = child.item() {
                                if visit(item, values[slot]) {
                                    return true;
                                }
                            } else {
                                pending.push(child);
                            }
                        }
                        chosen &= chosen - 1;
                    }
                }
                ChildKind::Leaf(number) => {
                    let (values, mut chosen) = choose_spheres(&self.sphere_leaves[number as usize]);
                    let first = self.first_items[number as usize];
                    while chosen != 0 {
                        let slot = chosen.trailing_zeros();
                        if visit(first + slot, values[slot as usize % WIDTH]) {
                            return true;
                        }
                        chosen &= chosen - 1;
                    }
                }
                ChildKind::Item(_) => unreachable!("only nodes and blocks are pending"),
            }
            next = pending.pop();
        }
        false
    }
}

/// Returns the nearest of the children marked in `hits`, one bit each, and pushes the others, the next nearest on top
/// and none of them below index `bottom` of the stack; [`Stack::reserve`] must have been called. `child_at` gives the
/// child of a slot; `None` if the slot is not used.
#[inline(always)]
fn nearest_child<C: Copy + Default>(
    enter: &[f32; WIDTH],
    mut hits: u32,
    pending: &mut Stack<Pending<C>>,
    bottom: usize,
    child_at: impl Fn(usize) -> Option<C>,
) -> Option<C> {
    let mut nearest: Option<Pending<C>> = None;
    while hits != 0 {
        let slot = hits.trailing_zeros() as usize % WIDTH;
        hits &= hits - 1;
        let Some(child) = child_at(slot) else {
            continue;
        };
        let next = Pending {
            enter: enter[slot],
            child,
        };
        match &mut nearest {
            None => nearest = Some(next),
            Some(nearest) if next.enter < nearest.enter => {
                pending.push(*nearest);
                *nearest = next;
            }
            Some(_) => pending.insert(next, bottom, |above, this| above.enter < this.enter),
        }
    }
    nearest.map(|nearest| nearest.child)
}

#[cfg(test)]
mod tests;
