//! CSG along a ray: the roots of all leaves in order, and a count of the operands that contain the ray.
//!
//! A CSG program is a tree of n-ary nodes over leaves, stored as a flat list. Each leaf gives its roots on the whole
//! line of a ray (see `shape`; leaves that cannot matter are skipped). The roots are sorted by `t`, and a sweep toggles
//! one leaf at a time; each toggle climbs only as far as something changes. No point is ever classified as inside or
//! outside, so rounding cannot put it on the wrong side (Roth 1982, "Ray casting for modeling solids", CGIP 18; here
//! n-ary, with one sort).
//!
//! Visibility follows POV-Ray: a union shows all surfaces of its children, also inner ones; a merge those outside its
//! other children; an intersection those inside all its other children. Surfaces at the same `t`, up to rounding, are
//! taken together, and each counts as inside or outside the solids of the others by [`SurfaceSide`]: coincident faces
//! leave a skin as in POV-Ray. Where POV-Ray leaves speckles, and with clean cuts everywhere, one surface is shown if
//! the ray enters or leaves the node as a whole there: no double surface, no hole.

use super::inside::{InsideInit, InsideState};
use crate::base::accel::Bvh;
use crate::base::math::Ray;
use crate::scene::shape::{Crossing, Geometry, Root, Start, SurfaceSide};
use crate::world::primitive::Leaf;
use crate::world::ray::SpawnSurface;
use glam::DVec3;
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

/// Operation of a node on its children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combine {
    /// Shows all surfaces; inside where any child is.
    Union,
    /// Shows surfaces outside the other children; inside where any child is.
    Merge,
    /// Shows surfaces inside the other children; inside where all children are.
    Intersection,
}

/// Relative difference of the distances of surfaces that coincide: roundings of different transforms.
const COINCIDENT: f64 = 1.0 / (1u64 << 46) as f64;

/// The parent of the root.
pub(crate) const NONE: u32 = u32::MAX;

/// An inner node of a CSG program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    /// Its operation.
    pub(crate) combine: Combine,
    /// True if inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// Number of children.
    pub(crate) children: u32,
    /// Its parent, or [`NONE`].
    pub(crate) parent: u32,
}

impl Node {
    /// Returns true if a ray inside `count` children is inside the node.
    #[inline(always)]
    fn holds(&self, count: u32) -> bool {
        let least = match self.combine {
            // An intersection of nothing contains everything, as in POV-Ray.
            Combine::Intersection => self.children,
            Combine::Union | Combine::Merge => 1,
        };
        (count >= least) != self.is_inverse
    }

    /// Returns true if the other children leave the surface of one child visible, with the ray inside `count` in all.
    #[inline(always)]
    fn lets_through(&self, count: u32, child_in: bool) -> bool {
        let others = count - u32::from(child_in);
        match self.combine {
            Combine::Union => true,
            Combine::Merge => others == 0,
            Combine::Intersection => others + 1 == self.children,
        }
    }
}

/// A leaf as an operand of the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Operand {
    /// The parent node.
    pub(crate) parent: u32,
    /// True if inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// True if its surface is never shown: it only clips.
    pub(crate) is_hidden: bool,
}

/// CSG of the leaves `first .. first + operands.len()` of a model. Scenes may have many small programs, which store
/// their parts inline.
#[derive(Clone, Debug, Default)]
pub(crate) struct CsgProgram {
    /// The nodes, parents before children.
    pub(crate) nodes: SmallVec<[Node; 1]>,
    /// The operands, in the order of the leaves.
    pub(crate) operands: SmallVec<[Operand; 5]>,
    /// Index of the first leaf.
    pub(crate) first: u32,
    /// The `bounded_by` objects.
    pub(crate) gates: Vec<BoundGate>,
    /// Inside state of a ray outside all leaves.
    pub(crate) rest: InsideInit,
    /// Inverse patches, sorted; inversion only flips the side of their normals.
    pub(crate) turned: SmallVec<[u32; 4]>,
    /// The order in which operands are intersected.
    pub(crate) order: OperandOrder,
    /// True if coincident faces are cut cleanly, where POV-Ray leaves a skin.
    pub(crate) has_clean_cuts: bool,
}

/// A ray in a sweep through a program.
#[derive(Clone, Copy)]
struct SweepContext<'a> {
    leaves: &'a [Leaf],
    ray: &'a Ray,
    departure: Option<&'a SpawnSurface>,
}

/// An interval of a ray, `from < t <= to`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayInterval {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// The factors that give the ends of an interval around a distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Widening {
    pub(crate) down: f64,
    pub(crate) up: f64,
}

impl RayInterval {
    /// The whole ray.
    pub(crate) const FORWARD: RayInterval = RayInterval {
        from: 0.0,
        to: f64::INFINITY,
    };
}

/// Operands that a ray can hit only if it hits a bounding object.
#[derive(Clone, Debug)]
pub(crate) struct BoundGate {
    /// The operands.
    pub(crate) operands: Range<u32>,
    /// The bounding object.
    pub(crate) bound: CsgProgram,
}

/// A root and the leaf it belongs to.
#[derive(Clone, Copy, Debug)]
struct Event {
    root: Root,
    /// The operand.
    leaf: u32,
}

/// Buffers of the sweep.
#[derive(Debug, Default)]
pub(crate) struct Sweep {
    roots: Vec<Root>,
    events: Vec<Event>,
    state: InsideState,
    /// Counts of the nodes before several roots at the same `t`.
    before: Vec<u32>,
    /// For each of these roots, true if the ray was inside its operand before them.
    was_in: Vec<bool>,
    /// Same, after them.
    is_in: Vec<bool>,
    /// Same, true if its surface is shown.
    shown: Vec<bool>,
    /// Operands whose boxes are hit.
    near: Vec<u32>,
    /// For each operand, true if the ray misses the box of a part that contains it; empty if no such box is missed.
    missed: Vec<bool>,
    /// For each operand, true if it does not show because the ray misses its bounding object; empty if none is missed.
    unseen: Vec<bool>,
    /// For bounding objects, which are CSG programs too.
    inner: Option<Box<Sweep>>,
}

/// A ray-surface intersection before shading data is computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RawHit {
    /// The root.
    pub(crate) root: Root,
    /// Index of the leaf.
    pub(crate) leaf: u32,
    /// Index of its surface.
    pub(crate) surface: u32,
}

impl CsgProgram {
    /// Returns true if inside and outside of an operand are exchanged, by itself or by its ancestors; false for an
    /// index out of range.
    pub(crate) fn is_inverse(&self, operand: u32) -> bool {
        let is_turned = self.turned.binary_search(&operand).is_ok();
        let Some(operand) = self.operands.get(operand as usize) else {
            return false;
        };
        let (mut is_inverse, mut above) = (operand.is_inverse != is_turned, operand.parent);
        while above != NONE {
            let node = &self.nodes[above as usize];
            is_inverse ^= node.is_inverse;
            above = node.parent;
        }
        is_inverse
    }

    /// Updates the indices of its leaves, and of those of its bounding objects, after reordering.
    pub(crate) fn move_leaves(&mut self, positions: &[u32]) {
        if let Some(position) = positions.get(self.first as usize) {
            self.first = *position;
        }
        for gate in &mut self.gates {
            gate.bound.move_leaves(positions);
        }
    }

    /// The distances within which surfaces coincide. Clean cuts need equal ones: they keep the thinnest walls.
    #[inline(always)]
    pub(crate) fn widening(&self) -> Widening {
        let share = if self.has_clean_cuts { 0.0 } else { COINCIDENT };
        Widening {
            down: 1.0 - share,
            up: 1.0 + share,
        }
    }

    /// Indices of its leaves.
    pub(crate) fn leaves(&self) -> Range<u32> {
        self.first..self.first + self.len()
    }

    /// Number of its leaves.
    pub(crate) fn len(&self) -> u32 {
        u32::try_from(self.operands.len()).unwrap_or(u32::MAX)
    }

    /// The first surface shown at `from < t <= to` that `wanted` accepts.
    pub(crate) fn nearest(
        &self,
        leaves: &[Leaf],
        ray: &Ray,
        interval: RayInterval,
        departure: Option<&SpawnSurface>,
        sweep: &mut Sweep,
        mut wanted: impl FnMut(&RawHit) -> bool,
    ) -> Option<RawHit> {
        let context = SweepContext {
            leaves,
            ray,
            departure,
        };
        let widening = self.widening();
        let to = self.collect(context, interval, sweep)?;
        sort(&mut sweep.events);
        let mut at = 0;
        while at < sweep.events.len() {
            let mut t = sweep.events[at].root.t;
            if t > to {
                return None;
            }
            let mut end = at + 1;
            while end < sweep.events.len() && sweep.events[end].root.t <= t * widening.up {
                t = sweep.events[end].root.t;
                end += 1;
            }
            if end == at + 1 {
                let event = sweep.events[at];
                let is_hidden = self.operands[event.leaf as usize].is_hidden;
                if t > interval.from && event.root.is_visible && !is_hidden {
                    self.step(at, sweep);
                } else {
                    self.toggle(&event, &mut sweep.state);
                    at = end;
                    continue;
                }
            } else {
                self.step_together(at, end, leaves, sweep);
            }
            for index in at..end {
                let Event { root, leaf } = sweep.events[index];
                let is_within = interval.from < root.t && root.t <= interval.to;
                let number = self.first + leaf;
                let hit = RawHit {
                    root,
                    leaf: number,
                    surface: leaves[number as usize].surface,
                };
                let is_seen = root.is_visible && is_within;
                if is_seen && !self.operands[leaf as usize].is_hidden && wanted(&hit) {
                    return Some(hit);
                }
            }
            at = end;
        }
        None
    }

    /// Gathers the roots of the leaves and the state before the first of them. Returns the end of the interval in which
    /// something may show, or `None` if nothing does between `from` and `to`. Outside the interval neither need be
    /// right.
    fn collect(
        &self,
        context: SweepContext,
        interval: RayInterval,
        sweep: &mut Sweep,
    ) -> Option<f64> {
        sweep.events.clear();
        sweep.state.rest(&self.rest);
        if !self.try_gates(context.leaves, context.ray, sweep) {
            return None;
        }
        let Widening { down, up } = self.widening();
        let (mut from, mut to) = (interval.from * down, interval.to * up);
        for &number in &self.order.required {
            let start = self.add_roots(number, context, RayInterval { from, to }, sweep);
            let (before, after) = sides(&sweep.roots, start);
            if !before {
                from = from.max(sweep.roots.first()?.t * down);
            }
            if !after {
                to = to.min(sweep.roots.last()?.t * up);
            }
            if from > to {
                return None;
            }
        }
        self.try_boxes(context.ray, RayInterval { from, to }, sweep);
        let near = std::mem::take(&mut sweep.near);
        for &number in self.order.others.iter().chain(&near) {
            // A missed operand has no roots, and the ray is in its rest state there.
            if sweep.missed.get(number as usize) != Some(&true) {
                self.add_roots(number, context, RayInterval { from, to }, sweep);
            }
        }
        sweep.near = near;
        Some(to)
    }

    /// Adds the roots of a leaf between `from` and `to`, and its state before them. Returns the side on which the line
    /// starts. All roots on the line are left in `sweep.roots`.
    fn add_roots(
        &self,
        number: u32,
        context: SweepContext,
        interval: RayInterval,
        sweep: &mut Sweep,
    ) -> Start {
        let RayInterval { from, to } = interval;
        let leaf = self.first + number;
        let own = &context.leaves[leaf as usize];
        let Sweep {
            roots,
            events,
            state,
            unseen,
            ..
        } = sweep;
        roots.clear();
        let start = if from >= 0.0 && to < f64::INFINITY && own.holds(context.ray, to) {
            Start::Inside
        } else {
            own.roots(context.ray, roots)
        };
        let mut over = 0;
        while over < roots.len() && roots[over].t < from {
            over += 1;
        }
        let (_, is_in) = sides(&roots[..over], start);
        if is_in {
            let operand = &self.operands[number as usize];
            let is_in = !operand.is_inverse;
            state.set(number, is_in);
            self.climb(operand.parent, is_in, state);
        }
        if roots.get(over).is_none_or(|next| next.t > to) {
            return start;
        }
        if let Some(origin) = context.departure.filter(|departure| departure.leaf == leaf) {
            hide_departure(roots, origin, own, context.ray.dir);
        }
        let is_unseen = unseen.get(number as usize) == Some(&true);
        for &root in &roots[over..] {
            if root.t > to {
                break;
            }
            let is_visible = root.is_visible && !is_unseen;
            let root = Root { is_visible, ..root };
            events.push(Event { root, leaf: number });
        }
        start
    }

    /// Marks the operands that do not show because the ray misses their bounding objects; they still cut the others
    /// (measured with POV-Ray). Returns true if any other operands are left.
    fn try_gates(&self, leaves: &[Leaf], ray: &Ray, sweep: &mut Sweep) -> bool {
        sweep.unseen.clear();
        if self.gates.is_empty() {
            return true;
        }
        let mut inner = sweep.inner.take().unwrap_or_default();
        for gate in &self.gates {
            if !gate.is_hit(leaves, ray, &mut inner) {
                self.mark(&gate.operands, &mut sweep.unseen);
            }
        }
        sweep.inner = Some(inner);
        sweep.unseen.is_empty() || sweep.unseen.contains(&false)
    }

    /// Collects the operands whose boxes the ray hits; outside all boxes it is outside. Also marks the operands of
    /// parts whose boxes are missed: outside its box a part shows nothing and contains no point of the ray, whatever it
    /// is made of.
    fn try_boxes(&self, ray: &Ray, interval: RayInterval, sweep: &mut Sweep) {
        sweep.near.clear();
        sweep.missed.clear();
        let Some(boxed) = &self.order.boxed else {
            return;
        };
        let mut hit = 0u64;
        boxed.tree.any(ray, interval.from, interval.to, |position| {
            match boxed.bounded.get(position as usize) {
                Some(&number) => sweep.near.push(number),
                None => hit |= 1 << (position as usize - boxed.bounded.len()),
            }
            false
        });
        for (part, operands) in boxed.parts.iter().enumerate() {
            if hit >> part & 1 == 0 {
                self.mark(operands, &mut sweep.missed);
            }
        }
    }

    /// Returns true if the surface of an operand is shown: the ray hits all its bounding objects.
    #[inline(always)]
    pub(crate) fn shows(
        &self,
        operand: u32,
        leaves: &[Leaf],
        ray: &Ray,
        sweep: &mut Sweep,
    ) -> bool {
        let mut gates = self.gates.iter();
        gates.all(|gate| !gate.operands.contains(&operand) || gate.is_hit(leaves, ray, sweep))
    }

    fn mark(&self, operands: &Range<u32>, marked: &mut Vec<bool>) {
        marked.resize(self.operands.len(), false);
        marked[operands.start as usize..operands.end as usize].fill(true);
    }

    /// Completes the counts of nodes from those of their leaves: each node that contains the ray counts in its parent.
    pub(crate) fn count_from_below(&self, counts: &mut [u32]) {
        for (number, node) in self.nodes.iter().enumerate().rev() {
            if node.parent != NONE && node.holds(counts[number]) {
                counts[node.parent as usize] += 1;
            }
        }
    }

    /// Updates the counts after a child of `node` was entered or left, up to the first node whose state stays the same.
    fn climb(&self, mut node: u32, mut enters: bool, state: &mut InsideState) {
        let nodes = &self.nodes[..];
        // `NONE` is not the index of a node.
        while let Some(own) = nodes.get(node as usize) {
            let was_in = own.holds(state.counts[node as usize]);
            state.count(node, enters);
            enters = own.holds(state.counts[node as usize]);
            if was_in == enters {
                return;
            }
            node = own.parent;
        }
    }

    fn toggle(&self, event: &Event, state: &mut InsideState) {
        let enters = match event.root.crossing {
            Crossing::Touch => return,
            Crossing::Enter => true,
            Crossing::Leave => false,
        };
        let operand = &self.operands[event.leaf as usize];
        self.put(event.leaf, enters != operand.is_inverse, state);
    }

    /// Puts the ray inside an operand or outside.
    #[inline(always)]
    fn put(&self, operand: u32, is_in: bool, state: &mut InsideState) {
        if state.leaf_in[operand as usize] != is_in {
            state.set(operand, is_in);
            self.climb(self.operands[operand as usize].parent, is_in, state);
        }
    }

    /// Handles a single root at its `t`: hides it unless every ancestor lets it through.
    fn step(&self, at: usize, sweep: &mut Sweep) {
        let event = &mut sweep.events[at];
        self.toggle(event, &mut sweep.state);
        event.root.is_visible &= self.lets_through(event.leaf, &sweep.state);
    }

    /// Returns true if every ancestor of an operand lets its surface through.
    #[inline(always)]
    fn lets_through(&self, operand: u32, state: &InsideState) -> bool {
        let mut child_in = state.leaf_in[operand as usize];
        let mut node = self.operands[operand as usize].parent;
        let mut is_shown = true;
        let nodes = &self.nodes[..];
        while is_shown && let Some(own) = nodes.get(node as usize) {
            let count = state.counts[node as usize];
            is_shown = own.lets_through(count, child_in);
            child_in = own.holds(count);
            node = own.parent;
        }
        is_shown
    }

    /// Handles several roots at the same `t`: hides those not shown, and puts the last operand first, which wins as in
    /// POV-Ray.
    fn step_together(&self, at: usize, end: usize, leaves: &[Leaf], sweep: &mut Sweep) {
        sweep.before.clear();
        sweep.before.extend_from_slice(&sweep.state.counts);
        sweep.was_in.clear();
        for event in &sweep.events[at..end] {
            let was_in = sweep.state.leaf_in[event.leaf as usize];
            sweep.was_in.push(was_in);
        }
        for event in &sweep.events[at..end] {
            self.toggle(event, &mut sweep.state);
        }
        if self.has_clean_cuts || !self.show_on_surfaces(at, end, leaves, sweep) {
            self.show_clean_cuts(at, end, sweep);
        }
        let events = &mut sweep.events[at..end];
        for (event, is_shown) in events.iter_mut().zip(&sweep.shown) {
            event.root.is_visible &= is_shown;
        }
        events.reverse();
        events.sort_by(|a, b| b.leaf.cmp(&a.leaf).then(a.root.t.total_cmp(&b.root.t)));
    }

    /// Selects the surfaces shown among several at the same `t` as POV-Ray does: those whose points every ancestor lets
    /// through. Returns false if there are none and rounding decides it in POV-Ray, which then leaves speckles.
    fn show_on_surfaces(&self, at: usize, end: usize, leaves: &[Leaf], sweep: &mut Sweep) -> bool {
        let Sweep {
            events,
            state,
            shown,
            is_in,
            ..
        } = sweep;
        let events = &events[at..end];
        is_in.clear();
        is_in.extend(
            events
                .iter()
                .map(|event| state.leaf_in[event.leaf as usize]),
        );
        let mut is_certain = true;
        for event in events {
            if event.root.crossing == Crossing::Touch {
                continue;
            }
            let side = leaves[(self.first + event.leaf) as usize]
                .shape
                .surface_side();
            is_certain &= side != SurfaceSide::Rounded;
            let is_inverse = self.operands[event.leaf as usize].is_inverse;
            let on_surface = match side {
                SurfaceSide::Inside | SurfaceSide::Rounded => !is_inverse,
                SurfaceSide::Outside => is_inverse,
                SurfaceSide::Both => is_inverse == self.is_inverse(event.leaf),
            };
            self.put(event.leaf, on_surface, state);
        }
        shown.clear();
        for event in events {
            let is_shown = self.lets_through(event.leaf, state);
            is_certain |= is_shown && !self.operands[event.leaf as usize].is_hidden;
            shown.push(is_shown);
        }
        for (event, is_in) in events.iter().zip(is_in) {
            self.put(event.leaf, *is_in, state);
        }
        is_certain
    }

    /// Selects the surfaces shown among several at the same `t` so that they bound the solid: at a node whose other
    /// children change there too, a surface is shown if the ray enters or leaves the node as a whole.
    fn show_clean_cuts(&self, at: usize, end: usize, sweep: &mut Sweep) {
        sweep.shown.clear();
        for index in at..end {
            let leaf = sweep.events[index].leaf as usize;
            let mut in_before = sweep.was_in[index - at];
            let mut in_after = sweep.state.leaf_in[leaf];
            let mut node = self.operands[leaf].parent;
            let mut is_shown = true;
            while is_shown && let Some(own) = self.nodes.get(node as usize) {
                let count_before = sweep.before[node as usize];
                let count_after = sweep.state.counts[node as usize];
                let before = own.lets_through(count_before, in_before);
                let after = own.lets_through(count_after, in_after);
                in_before = own.holds(count_before);
                in_after = own.holds(count_after);
                is_shown = if before == after {
                    before
                } else {
                    in_before != in_after
                };
                node = own.parent;
            }
            sweep.shown.push(is_shown);
        }
    }

    /// Returns true if a point lies in the solid, by each leaf's own rule for points on its surface.
    pub(crate) fn contains(&self, leaves: &[Leaf], point: DVec3) -> bool {
        let mut counts: SmallVec<[u32; 8]> = smallvec![0; self.nodes.len()];
        for (index, operand) in self.operands.iter().enumerate() {
            let holds = leaves[self.first as usize + index].contains(point);
            if holds != operand.is_inverse && operand.parent != NONE {
                counts[operand.parent as usize] += 1;
            }
        }
        self.count_from_below(&mut counts);
        self.nodes[0].holds(counts[0])
    }
}

/// Sorts roots by `t`; those of one leaf at the same `t` keep their order. Most rays have only a few.
fn sort(events: &mut [Event]) {
    const SMALL: usize = 16;
    if events.len() > SMALL {
        events.sort_by(|a, b| a.root.t.total_cmp(&b.root.t).then(a.leaf.cmp(&b.leaf)));
        return;
    }
    let comes_before =
        |a: &Event, b: &Event| a.root.t < b.root.t || a.root.t == b.root.t && a.leaf < b.leaf;
    for end in 1..events.len() {
        let event = events[end];
        let mut at = end;
        while at > 0 && comes_before(&event, &events[at - 1]) {
            events[at] = events[at - 1];
            at -= 1;
        }
        events[at] = event;
    }
}

impl BoundGate {
    /// Returns true if a ray hits the bounding object or starts inside it.
    fn is_hit(&self, leaves: &[Leaf], ray: &Ray, sweep: &mut Sweep) -> bool {
        let all = RayInterval::FORWARD;
        let hit = self.bound.nearest(leaves, ray, all, None, sweep, |_| true);
        hit.is_some() || self.bound.contains(leaves, ray.origin)
    }
}

/// Returns whether a leaf contains the ray before its first root and after its last.
fn sides(roots: &[Root], start: Start) -> (bool, bool) {
    let before = start == Start::Inside;
    let after = roots
        .iter()
        .rev()
        .find(|root| root.crossing != Crossing::Touch)
        .map_or(before, |root| root.crossing == Crossing::Enter);
    (before, after)
}

/// Hides the root that a ray has just left: on the face it starts on, the root nearest to its origin that crosses in
/// the expected sense. A flat face has no other root, and its normal need not point outward. Returns the root's `t`, if
/// one is hidden.
pub(crate) fn hide_departure(
    roots: &mut [Root],
    origin: &SpawnSurface,
    leaf: &Leaf,
    dir: DVec3,
) -> Option<f64> {
    if leaf.shape.excludes_spawn_surface() {
        return None;
    }
    let is_faceted = leaf.shape.is_faceted();
    let expected = match origin.crossing {
        Crossing::Touch => Crossing::Touch,
        _ if origin.normal.dot(dir) > 0.0 => Crossing::Leave,
        _ => Crossing::Enter,
    };
    let own = roots
        .iter_mut()
        .filter(|root| root.face == origin.face && (is_faceted || root.crossing == expected));
    let root = own.min_by(|a, b| a.t.abs().total_cmp(&b.t.abs()))?;
    root.is_visible = false;
    Some(root.t)
}

/// Most parts whose boxes are tested.
pub(crate) const MAX_PARTS: usize = 64;

/// The order in which a program intersects its operands.
#[derive(Clone, Debug, Default)]
pub(crate) struct OperandOrder {
    /// Required operands: nothing shows outside them, so they clip the interval of the ray.
    pub(crate) required: SmallVec<[u32; 4]>,
    /// All others, except those in the BVH.
    pub(crate) others: SmallVec<[u32; 4]>,
    /// BVH over operands and parts, if there are enough.
    pub(crate) boxed: Option<Box<OperandBvh>>,
}

/// BVH over operands and parts of a program.
#[derive(Clone, Debug)]
pub(crate) struct OperandBvh {
    /// Over `bounded`, followed by `parts`.
    pub(crate) tree: Bvh,
    /// The bounded operands of a large program.
    pub(crate) bounded: Vec<u32>,
    /// The operands of each part with a box of its own, which are skipped if the box is missed; at most [`MAX_PARTS`].
    pub(crate) parts: Vec<Range<u32>>,
    /// For each node, the numbers of its operands that are not required, plain and inverse.
    pub(crate) resting: Vec<[u32; 2]>,
}
