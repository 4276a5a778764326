//! Finding what a ray may meet: a bounding volume hierarchy over anything with bounds.
//!
//! Nodes hold eight boxes in single precision, rounded outward, in a frame of the tree's own: centred, and scaled by a
//! power of two. A scene far from the origin or in odd units costs no more than any other. Where all that a node would
//! hold are balls, a leaf holds the balls themselves, by which fewer of them have to be asked (`block.rs`).
//!
//! The tree promises never to lose a hit and to visit a box that begins exactly where the search ends. So a caller who
//! decides ties by a rule of its own gets the same answer whatever the order of the visits.

mod bounding_cylinder;
mod bounding_sphere;
mod build;
mod bundle;
mod frustum;
mod light_buffer;
mod node;
mod packet;
mod packet_interval;
mod sphere_leaf;
mod stream;
mod treelets;

pub use bundle::{Bundle, NewEnds};

pub use bounding_cylinder::BoundingCylinder;
pub use light_buffer::LightBuffer;
pub(crate) use stream::STREAM;

use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use arrayvec::ArrayVec;
use bounding_sphere::BoundingSphere;
use build::{Entry, GrowingBvh};
use glam::DVec3;
use node::{Aabb32, Child, ChildKind, Frame, Node, WIDTH};
use rayon::prelude::*;
use sphere_leaf::SphereLeaf;

/// A tree over items, which it knows by their position in the list it was built from.
#[derive(Clone, Debug)]
pub struct Bvh {
    root: Option<Child>,
    nodes: Vec<Node>,
    /// Leaves of balls, in place of nodes that hold nothing else.
    blocks: Vec<SphereLeaf>,
    /// The first item of each block; the others follow.
    firsts: Vec<u32>,
    frame: Frame,
    /// For bundles, the balls of items that are or nearly fill one; empty if no item does, and where blocks hold all.
    balls: Vec<Option<BoundingSphere>>,
}

/// A place still to be visited, with the earliest parameter of the ray in it.
#[derive(Clone, Copy, Default)]
struct Pending<C> {
    enter: f32,
    child: C,
}

/// A traversal stack. Only the deepest trees need the heap, and its memory is not cleared beforehand: that would cost as
/// much as the traversal of a small tree.
struct Stack<T> {
    places: ArrayVec<T, ROOM>,
    /// What lies below them.
    deeper: Vec<T>,
}

/// The items of a block, as they were called before the order of the tree was known.
type LeafItems = [u32; WIDTH];

/// So many nodes have their items counted at a time.
const PIECE: usize = 1 << 12;

/// Room for the pending places of a tree of eight levels and more.
const ROOM: usize = 64;

impl<T: Copy> Stack<T> {
    #[inline(always)]
    fn new() -> Self {
        Stack {
            places: ArrayVec::new_const(),
            deeper: Vec::new(),
        }
    }

    /// Makes room for the children of a node; gives the number of places in use.
    #[inline(always)]
    fn make_room(&mut self) -> usize {
        if self.places.len() > ROOM - WIDTH {
            self.deepen();
        }
        self.places.len()
    }

    #[cold]
    fn deepen(&mut self) {
        self.deeper.extend_from_slice(&self.places);
        self.places.clear();
    }

    /// Puts a place on top, for which there must be room.
    #[inline(always)]
    fn put(&mut self, place: T) {
        self.places.push(place);
    }

    /// Puts a place, for which there must be room, below those down to `bottom` that are to come before it.
    #[inline(always)]
    fn sink(&mut self, place: T, bottom: usize, comes_first: impl Fn(&T, &T) -> bool) {
        let mut at = self.places.len();
        self.places.push(place);
        while at > bottom && comes_first(&self.places[at - 1], &place) {
            self.places[at] = self.places[at - 1];
            at -= 1;
        }
        self.places[at] = place;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<T> {
        let top = self.places.pop();
        top.or_else(|| self.deeper.pop())
    }
}

impl Bvh {
    /// The tree over these boxes. Items with empty bounds are left out. Infinite bounds are met by every ray that meets
    /// them, but a caller does better to keep such items elsewhere.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build(bounds: &[Bounds]) -> Self {
        Bvh::build_of(bounds.len(), |item| bounds[item])
    }

    /// The same over so many items, of which `bounds` gives the boxes, each more than once: nobody need keep them.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build_of(count: usize, bounds: impl Fn(usize) -> Bounds + Sync) -> Self {
        Bvh::grow(count, |item| (bounds(item), false)).0
    }

    /// The tree, and the items of its blocks. `bounds` also says whether an item is the ball that touches all sides of its
    /// box.
    fn grow(
        count: usize,
        bounds: impl Fn(usize) -> (Bounds, bool) + Sync,
    ) -> (Self, Vec<LeafItems>) {
        assert!(count <= Child::MOST, "items are counted in 30 bits");
        let around = (0..count).into_par_iter().map(|item| {
            let (bounds, _) = bounds(item);
            let counts = bounds.is_finite() && !bounds.is_empty();
            let around = if counts { bounds } else { Bounds::EMPTY };
            (around, bounds.is_empty())
        });
        let (whole, has_empty) = around.reduce(
            || (Bounds::EMPTY, false),
            |all, one| (all.0.union(&one.0), all.1 || one.1),
        );
        let frame = Frame::new(&whole);
        let entry = |item| {
            let (bounds, is_ball) = bounds(item as usize);
            Entry::new(frame.cell(&bounds), item, is_ball)
        };
        let items = 0..u32::try_from(count).expect("no more than that");
        let mut entries: Vec<Entry> = items.into_par_iter().map(entry).collect();
        if has_empty {
            entries.retain(|entry| !bounds(entry.item() as usize).0.is_empty());
        }
        let GrowingBvh {
            root,
            nodes,
            blocks,
            held,
        } = build::build(entries);
        let tree = Bvh {
            root,
            nodes,
            blocks,
            firsts: Vec::new(),
            frame,
            balls: Vec::new(),
        };
        (tree, held)
    }

    /// The tree over so many boxes, and the items in the order of the tree. That order is what it then knows them by, so that
    /// neighbours can be kept together. `bounds` also says whether an item is the ball that touches all sides of its box.
    ///
    /// # Panics
    /// For 2³⁰ boxes or more.
    #[must_use]
    pub fn build_in_order(
        count: usize,
        bounds: impl Fn(usize) -> (Bounds, bool) + Sync,
    ) -> (Self, Vec<u32>) {
        let (mut tree, held) = Bvh::grow(count, &bounds);
        let mut order = vec![0; count];
        let pieces = tree.nodes.par_chunks(PIECE);
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
        let pieces = tree.nodes.par_chunks_mut(PIECE).zip(lists);
        pieces.for_each(|(nodes, (mut first, mut list))| {
            for node in nodes {
                let count = node.renumber(first, list);
                first += count;
                list = &mut list[count as usize..];
            }
        });
        tree.firsts.reserve_exact(held.len());
        for (block, held) in tree.blocks.iter().zip(&held) {
            tree.firsts.push(first);
            let count = block.count();
            order[first as usize..][..count].copy_from_slice(&held[..count]);
            first += build::index(count);
        }
        order.truncate(first as usize);
        (tree, order)
    }

    /// Takes in balls that hold items, by centre and radius, and whether the item is the ball: that helps bundles of rays.
    /// `ball` gives that of each of the tree's items, of which there are `count`.
    pub fn set_bounding_spheres(
        &mut self,
        count: usize,
        ball: impl Fn(usize) -> Option<(DVec3, f64, bool)> + Sync,
    ) {
        if !self.has_only_spheres() && (0..count).any(|item| ball(item).is_some()) {
            let frame = &self.frame;
            let known = |item| ball(item).map(|ball| BoundingSphere::new(frame, ball));
            self.balls = (0..count).into_par_iter().map(known).collect();
        }
    }

    /// Whether blocks hold all items: those that nodes hold come first.
    pub fn has_only_spheres(&self) -> bool {
        self.firsts.first() == Some(&0)
    }

    /// Visits, roughly front to back, the items whose boxes the ray may meet from `from` to `to`, both included.
    ///
    /// `visit` gets an item and the end of the search so far, and gives the new end: the same, or the parameter of a hit
    /// before it. Boxes that begin beyond the end are passed over.
    #[inline]
    pub fn nearest(&self, ray: &Ray, from: f64, to: f64, visit: impl FnMut(u32, f64) -> f64) {
        with_widest(
            #[inline(always)]
            |lanes| self.nearest_in(lanes, ray, (from, to), visit),
        );
    }

    /// [`Bvh::nearest`] for work that is compiled for lanes already.
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
                    let bottom = pending.make_room();
                    let (enter, met) = node.meet(lanes, &ray, (from, frame_end));
                    let name = |place: usize| node.child(place);
                    nearest_child((&enter, met), (&mut pending, bottom), name)
                }
                ChildKind::Block(number) => {
                    let block = &self.blocks[number as usize];
                    let bottom = pending.make_room();
                    let (enter, met) = block.meet(lanes, &ray, (from, frame_end));
                    let first = self.firsts[number as usize];
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let name = |place: usize| Some(Child::of_item(first + place as u32));
                    nearest_child((&enter, met), (&mut pending, bottom), name)
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
                && let Some(place) = pending.pop()
            {
                next = (place.enter <= frame_end).then_some(place.child);
            }
        }
    }

    /// Visits the items whose boxes the ray may meet from `from` to `to`, in no order, until `visit` says to stop.
    /// Says whether it did.
    #[inline]
    pub fn any(&self, ray: &Ray, from: f64, to: f64, visit: impl FnMut(u32) -> bool) -> bool {
        with_widest(
            #[inline(always)]
            |lanes| self.any_in(lanes, ray, (from, to), visit),
        )
    }

    /// [`Bvh::any`] for work that is compiled for lanes already.
    #[inline(always)]
    pub(crate) fn any_in(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        (from, to): (f64, f64),
        visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let ray = self.frame.ray(ray);
        let span = (ray.from(from), ray.to(to));
        self.search(
            #[inline(always)]
            |node| node.meet(lanes, &ray, span).1,
            #[inline(always)]
            |block| block.meet(lanes, &ray, span).1,
            visit,
        )
    }

    /// All items in the order in which [`Bvh::any`] visits those that a ray may meet, whichever these are.
    #[must_use]
    pub fn order(&self) -> Vec<u32> {
        let mut order = Vec::new();
        self.search(
            |_| (1 << WIDTH) - 1,
            |block| (1 << block.count()) - 1,
            |item| {
                order.push(item);
                false
            },
        );
        order
    }

    /// Visits the items whose boxes hold a point, in no order, until `visit` says to stop. Says whether it did.
    /// Boxes are compared in single precision: some that only nearly hold the point are visited as well.
    pub fn around(&self, point: DVec3, visit: impl FnMut(u32) -> bool) -> bool {
        let cell: Aabb32 = self.frame.point(point);
        self.search(
            |node| node.overlap(&cell),
            |block| block.overlap(&cell),
            visit,
        )
    }

    /// The memory the tree takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.nodes.capacity() * size_of::<Node>()
            + self.blocks.capacity() * size_of::<SphereLeaf>()
            + self.firsts.capacity() * size_of::<u32>()
            + self.balls.capacity() * size_of::<Option<BoundingSphere>>()
    }

    /// Calls `visit` with each item and its box.
    fn each_item(&self, visit: impl FnMut(u32, Aabb32)) {
        self.some_items(1, visit);
    }

    /// The same with the items of one in so many nodes and blocks.
    fn some_items(&self, step: usize, mut visit: impl FnMut(u32, Aabb32)) {
        for node in self.nodes.iter().step_by(step) {
            for place in 0..WIDTH {
                if let Some(item) = node.child(place).and_then(Child::item) {
                    visit(item, node.cell(place));
                }
            }
        }
        self.some_balls(step, |item, ball| visit(item, ball.cell()));
    }

    /// Calls `visit` with the items of one in so many blocks, and their balls.
    fn some_balls(&self, step: usize, mut visit: impl FnMut(u32, BoundingSphere)) {
        let blocks = self.blocks.iter().zip(&self.firsts);
        for (block, &first) in blocks.step_by(step) {
            for (item, place) in (first..).zip(0..block.count()) {
                visit(item, block.ball(place));
            }
        }
    }

    /// Visits the items in the places that `choose` and `choose_balls` mark, one bit each.
    #[inline(always)]
    fn search(
        &self,
        choose: impl Fn(&Node) -> u32,
        choose_balls: impl Fn(&SphereLeaf) -> u32,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let mut pending = Stack::new();
        let mut next = self.root;
        while let Some(child) = next {
            match child.kind() {
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    pending.make_room();
                    let mut chosen = choose(node);
                    while chosen != 0 {
                        if let Some(child) = node.child(chosen.trailing_zeros() as usize % WIDTH) {
                            if let Some(item) = child.item() {
                                if visit(item) {
                                    return true;
                                }
                            } else {
                                pending.put(child);
                            }
                        }
                        chosen &= chosen - 1;
                    }
                }
                ChildKind::Block(number) => {
                    let mut chosen = choose_balls(&self.blocks[number as usize]);
                    let first = self.firsts[number as usize];
                    while chosen != 0 {
                        if visit(first + chosen.trailing_zeros()) {
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

/// The nearest of the marked children, one bit each. The others go on the stack, down to the place `bottom` of it, the
/// next nearest on top; there must be room. `name` gives what they are kept as, from the place of the child; nothing if
/// that is not used.
#[inline(always)]
fn nearest_child<C: Copy + Default>(
    (enter, mut met): (&[f32; WIDTH], u32),
    (pending, bottom): (&mut Stack<Pending<C>>, usize),
    name: impl Fn(usize) -> Option<C>,
) -> Option<C> {
    let mut nearest: Option<Pending<C>> = None;
    while met != 0 {
        let place = met.trailing_zeros() as usize % WIDTH;
        met &= met - 1;
        let Some(child) = name(place) else {
            continue;
        };
        let next = Pending {
            enter: enter[place],
            child,
        };
        match &mut nearest {
            None => nearest = Some(next),
            Some(nearest) if next.enter < nearest.enter => {
                pending.put(*nearest);
                *nearest = next;
            }
            Some(_) => pending.sink(next, bottom, |above, this| above.enter < this.enter),
        }
    }
    nearest.map(|nearest| nearest.child)
}

#[cfg(test)]
mod tests;
