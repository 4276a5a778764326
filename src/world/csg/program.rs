//! CSG along a ray: all roots of all leaves in order, and a count of what the ray is inside of.
//!
//! A combination is a tree of n-ary nodes over leaves, kept as a flat list. For a ray every leaf gives its roots on
//! the whole line (spans, see `shape`; leaves that cannot matter are left out), they are sorted by `t`, and a sweep
//! toggles one leaf at a time; each toggle climbs only as far as something changes. No point is ever tested for being
//! inside, so there is nothing to be rounded to the wrong side (Roth 1982, "Ray casting for modeling solids", CGIP 18;
//! here n-ary, with one sort).
//!
//! What is shown follows POV-Ray: a union shows all surfaces of its children, inner ones too; a merge those outside
//! of its other children; an intersection those inside of all its other children. Surfaces at exactly the same `t`
//! are taken together, and one is shown if the node as a whole is entered or left there: no skin, no hole.

use super::inside::{InsideInit, InsideState};
use super::simplify::OperandOrder;
use crate::base::math::Ray;
use crate::scene::shape::{Crossing, Geometry, Root, Start};
use crate::world::primitive::Leaf;
use crate::world::query::SpawnSurface;
use glam::DVec3;
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

/// How a node combines its children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combine {
    /// Shows all, is inside where any child is.
    Union,
    /// Shows what is outside of the others, is inside where any child is.
    Merge,
    /// Shows what is inside of the others, is inside where all children are.
    Intersection,
}

/// The parent of the root.
pub(crate) const NONE: u32 = u32::MAX;

/// An inner node of a combination.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    /// How.
    pub(crate) combine: Combine,
    /// Whether inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// How many children it has.
    pub(crate) children: u32,
    /// The node above, or `NONE`.
    pub(crate) parent: u32,
}

impl Node {
    /// Whether a ray is inside that is inside of so many children.
    #[inline(always)]
    fn holds(&self, count: u32) -> bool {
        let least = match self.combine {
            // One of nothing holds all, as in POV-Ray.
            Combine::Intersection => self.children,
            Combine::Union | Combine::Merge => 1,
        };
        (count >= least) != self.is_inverse
    }

    /// Whether the other children let the surface of one be shown, if so many hold the ray in all.
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

/// What the tree knows of a leaf.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Operand {
    /// The node above.
    pub(crate) parent: u32,
    /// Whether inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// Whether its surface is never shown: it only clips.
    pub(crate) is_hidden: bool,
}

/// A combination of the leaves `first .. first + operands.len()` of a model. There may be many of a few parts, which keep
/// them in place.
#[derive(Clone, Debug, Default)]
pub(crate) struct CsgProgram {
    /// The nodes, parents before children.
    pub(crate) nodes: SmallVec<[Node; 1]>,
    /// The leaves in order.
    pub(crate) operands: SmallVec<[Operand; 5]>,
    /// The number of the first leaf.
    pub(crate) first: u32,
    /// What `bounded_by` says.
    pub(crate) gates: Vec<BoundGate>,
    /// What a ray is inside of where it is outside of all leaves.
    pub(crate) rest: InsideInit,
    /// Patches that are inverse, in order, which changes nothing but the side their normals are on.
    pub(crate) turned: SmallVec<[u32; 4]>,
    /// The order in which operands are asked.
    pub(crate) order: OperandOrder,
}

/// A ray on its way through a program.
#[derive(Clone, Copy)]
struct SweepContext<'a> {
    leaves: &'a [Leaf],
    ray: &'a Ray,
    departure: Option<&'a SpawnSurface>,
}

/// A stretch of operands that a ray meets only if it meets a bounding object first.
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
    before: Vec<u32>,
    kept: Vec<bool>,
    /// Operands whose boxes are met.
    near: Vec<u32>,
    /// Which operands are missed, since the boxes around parts that they belong to are; empty if none is.
    missed: Vec<bool>,
    /// Which of them do not show, since the ray misses what bounds them.
    unseen: Vec<bool>,
    /// For bounding objects, which are combinations too.
    inner: Option<Box<Sweep>>,
}

/// A surface of a combination that a ray meets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RawHit {
    /// The root.
    pub(crate) root: Root,
    /// The number of the leaf.
    pub(crate) leaf: u32,
    /// The number of its surface.
    pub(crate) surface: u32,
}

impl CsgProgram {
    /// Whether inside and outside of an operand are exchanged, by itself or by what it is part of; no operand of that
    /// number is not.
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

    /// Follows its leaves, and those of what bounds it, to their new places.
    pub(crate) fn move_leaves(&mut self, places: &[u32]) {
        if let Some(place) = places.get(self.first as usize) {
            self.first = *place;
        }
        for gate in &mut self.gates {
            gate.bound.move_leaves(places);
        }
    }

    /// The numbers of its leaves.
    pub(crate) fn leaves(&self) -> Range<u32> {
        self.first..self.first + self.len()
    }

    /// How many leaves it has.
    pub(crate) fn len(&self) -> u32 {
        u32::try_from(self.operands.len()).unwrap_or(u32::MAX)
    }

    /// The first surface shown at `from < t <= to` for which `wanted` holds.
    pub(crate) fn nearest(
        &self,
        leaves: &[Leaf],
        ray: &Ray,
        span: (f64, f64),
        departure: Option<&SpawnSurface>,
        sweep: &mut Sweep,
        mut wanted: impl FnMut(&RawHit) -> bool,
    ) -> Option<RawHit> {
        let from = span.0;
        let passing = SweepContext {
            leaves,
            ray,
            departure,
        };
        let to = self.collect(passing, span, sweep)?;
        sort(&mut sweep.events);
        let mut at = 0;
        while at < sweep.events.len() {
            let t = sweep.events[at].root.t;
            if t > to {
                return None;
            }
            let mut end = at + 1;
            while end < sweep.events.len() && sweep.events[end].root.t == t {
                end += 1;
            }
            if end == at + 1 {
                let event = sweep.events[at];
                let is_hidden = self.operands[event.leaf as usize].is_hidden;
                if t > from && event.root.is_visible && !is_hidden {
                    self.step(at, sweep);
                } else {
                    self.toggle(&event, &mut sweep.state);
                    at = end;
                    continue;
                }
            } else {
                self.step_together(at, end, sweep);
            }
            for index in (at..end).rev() {
                let event = sweep.events[index];
                let is_seen = sweep.kept[index - at] && event.root.is_visible && t > from;
                let leaf = self.first + event.leaf;
                let found = RawHit {
                    root: event.root,
                    leaf,
                    surface: leaves[leaf as usize].surface,
                };
                if is_seen && !self.operands[event.leaf as usize].is_hidden && wanted(&found) {
                    return Some(found);
                }
            }
            at = end;
        }
        None
    }

    /// Gathers the roots of the leaves and the state before the first of them. Gives where to stop looking, or `None`
    /// if nothing is shown in the stretch from `from` to `to`. Outside of that stretch neither need be right.
    fn collect(
        &self,
        passing: SweepContext,
        (from, to): (f64, f64),
        sweep: &mut Sweep,
    ) -> Option<f64> {
        sweep.events.clear();
        sweep.state.rest(&self.rest);
        if !self.try_gates(passing.leaves, passing.ray, sweep) {
            return None;
        }
        let (mut from, mut to) = (from, to);
        for &number in &self.order.required {
            let start = self.ask(number, passing, (from, to), sweep);
            let (before, after) = sides(&sweep.roots, start);
            if !before {
                from = from.max(sweep.roots.first()?.t);
            }
            if !after {
                to = to.min(sweep.roots.last()?.t);
            }
            if from > to {
                return None;
            }
        }
        self.try_boxes(passing.ray, (from, to), sweep);
        let near = std::mem::take(&mut sweep.near);
        for &number in self.order.others.iter().chain(&near) {
            // What is missed has no roots, and the ray is as it is at rest.
            if sweep.missed.get(number as usize) != Some(&true) {
                self.ask(number, passing, (from, to), sweep);
            }
        }
        sweep.near = near;
        Some(to)
    }

    /// Adds the roots of a leaf that lie from `from` to `to`, and its state before them. Gives where the line starts. All
    /// roots on the line are left in `sweep.roots`.
    fn ask(
        &self,
        number: u32,
        passing: SweepContext,
        (from, to): (f64, f64),
        sweep: &mut Sweep,
    ) -> Start {
        let leaf = self.first + number;
        let own = &passing.leaves[leaf as usize];
        let Sweep {
            roots,
            events,
            state,
            unseen,
            ..
        } = sweep;
        roots.clear();
        let start = if from >= 0.0 && to < f64::INFINITY && own.holds(passing.ray, to) {
            Start::Inside
        } else {
            own.roots(passing.ray, roots)
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
        if let Some(left) = passing.departure.filter(|departure| departure.leaf == leaf) {
            hide_departure(roots, left, own, passing.ray.dir);
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

    /// Notes which operands do not show because the ray misses what bounds them; the others are cut by them all the same
    /// (measured with POV-Ray). Says whether any are left.
    fn try_gates(&self, leaves: &[Leaf], ray: &Ray, sweep: &mut Sweep) -> bool {
        sweep.unseen.clear();
        if self.gates.is_empty() {
            return true;
        }
        let mut inner = sweep.inner.take().unwrap_or_default();
        for gate in &self.gates {
            if !gate.is_met(leaves, ray, &mut inner) {
                self.mark(&gate.operands, &mut sweep.unseen);
            }
        }
        sweep.inner = Some(inner);
        sweep.unseen.is_empty() || sweep.unseen.contains(&false)
    }

    /// Finds the operands whose boxes the ray meets; where it is in none it is outside. Notes which others it misses since
    /// it misses the boxes around parts: outside of its box nothing of a part shows, and the ray is not inside of it,
    /// whatever it is made of.
    fn try_boxes(&self, ray: &Ray, (from, to): (f64, f64), sweep: &mut Sweep) {
        sweep.near.clear();
        sweep.missed.clear();
        let Some(boxed) = &self.order.boxed else {
            return;
        };
        let mut met = 0u64;
        boxed.tree.any(ray, from, to, |place| {
            match boxed.bounded.get(place as usize) {
                Some(&number) => sweep.near.push(number),
                None => met |= 1 << (place as usize - boxed.bounded.len()),
            }
            false
        });
        for (part, operands) in boxed.parts.iter().enumerate() {
            if met >> part & 1 == 0 {
                self.mark(operands, &mut sweep.missed);
            }
        }
    }

    /// Whether the surface of an operand is shown to a ray that misses none of what bounds it.
    #[inline(always)]
    pub(crate) fn shows(
        &self,
        operand: u32,
        leaves: &[Leaf],
        ray: &Ray,
        sweep: &mut Sweep,
    ) -> bool {
        let mut gates = self.gates.iter();
        gates.all(|gate| !gate.operands.contains(&operand) || gate.is_met(leaves, ray, sweep))
    }

    fn mark(&self, operands: &Range<u32>, marked: &mut Vec<bool>) {
        marked.resize(self.operands.len(), false);
        marked[operands.start as usize..operands.end as usize].fill(true);
    }

    /// Completes the counts of nodes from those of their leaves: each node that holds the ray counts in its parent.
    pub(crate) fn count_from_below(&self, counts: &mut [u32]) {
        for (number, node) in self.nodes.iter().enumerate().rev() {
            if node.parent != NONE && node.holds(counts[number]) {
                counts[node.parent as usize] += 1;
            }
        }
    }

    /// A child of `node` has been entered or left: counts it, and goes on as long as nodes change.
    fn climb(&self, mut node: u32, mut enters: bool, state: &mut InsideState) {
        let nodes = &self.nodes[..];
        // There is none of the number `NONE`.
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
        let is_in = enters != operand.is_inverse;
        if state.leaf_in[event.leaf as usize] != is_in {
            state.set(event.leaf, is_in);
            self.climb(operand.parent, is_in, state);
        }
    }

    /// One root alone at its `t`: it is shown if every node above lets it through.
    fn step(&self, at: usize, sweep: &mut Sweep) {
        let event = sweep.events[at];
        self.toggle(&event, &mut sweep.state);
        let mut child_in = sweep.state.leaf_in[event.leaf as usize];
        let mut node = self.operands[event.leaf as usize].parent;
        let mut is_kept = true;
        let nodes = &self.nodes[..];
        while is_kept && let Some(own) = nodes.get(node as usize) {
            let count = sweep.state.counts[node as usize];
            is_kept = own.lets_through(count, child_in);
            child_in = own.holds(count);
            node = own.parent;
        }
        sweep.kept.clear();
        sweep.kept.push(is_kept);
    }

    /// Several roots at the same `t`. At a node whose other children change there too, a surface is shown if the node
    /// as a whole is entered or left, and then only the last one of them.
    fn step_together(&self, at: usize, end: usize, sweep: &mut Sweep) {
        sweep.before.clear();
        sweep.before.extend_from_slice(&sweep.state.counts);
        let was_in: Vec<bool> = sweep.events[at..end]
            .iter()
            .map(|event| sweep.state.leaf_in[event.leaf as usize])
            .collect();
        for index in at..end {
            let event = sweep.events[index];
            self.toggle(&event, &mut sweep.state);
        }
        sweep.kept.clear();
        for index in at..end {
            let event = sweep.events[index];
            let leaf = event.leaf as usize;
            let mut in_before = was_in[index - at];
            let mut in_after = sweep.state.leaf_in[leaf];
            let mut node = self.operands[leaf].parent;
            let mut is_kept = true;
            while is_kept && let Some(own) = self.nodes.get(node as usize) {
                let count_before = sweep.before[node as usize];
                let count_after = sweep.state.counts[node as usize];
                let before = own.lets_through(count_before, in_before);
                let after = own.lets_through(count_after, in_after);
                in_before = own.holds(count_before);
                in_after = own.holds(count_after);
                is_kept = if before == after {
                    before
                } else {
                    in_before != in_after
                };
                node = own.parent;
            }
            sweep.kept.push(is_kept);
        }
    }

    /// Whether a point lies in the combination, by each leaf's own rule for points on its surface.
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

/// Puts roots in order; those of one leaf at the same place stay as they are. Most rays meet few.
fn sort(events: &mut [Event]) {
    const FEW: usize = 16;
    if events.len() > FEW {
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
    /// Whether a ray meets the bounding object or starts inside of it.
    fn is_met(&self, leaves: &[Leaf], ray: &Ray, sweep: &mut Sweep) -> bool {
        let span = (0.0, f64::INFINITY);
        let hit = self.bound.nearest(leaves, ray, span, None, sweep, |_| true);
        hit.is_some() || self.bound.contains(leaves, ray.origin)
    }
}

/// Whether a leaf holds the ray before the first of its roots and after the last.
fn sides(roots: &[Root], start: Start) -> (bool, bool) {
    let before = start == Start::Inside;
    let after = roots
        .iter()
        .rev()
        .find(|root| root.crossing != Crossing::Touch)
        .map_or(before, |root| root.crossing == Crossing::Enter);
    (before, after)
}

/// Hides the root that a ray has just left: of the piece of surface it stands on, the one nearest to its start that
/// it crosses in the right sense. A flat piece has no other, and its normal need not point out.
/// Gives where that is, if one is hidden.
pub(crate) fn hide_departure(
    roots: &mut [Root],
    left: &SpawnSurface,
    leaf: &Leaf,
    dir: DVec3,
) -> Option<f64> {
    if leaf.shape.knows_departures() {
        return None;
    }
    let is_faceted = leaf.shape.is_faceted();
    let expected = match left.crossing {
        Crossing::Touch => Crossing::Touch,
        _ if left.normal.dot(dir) > 0.0 => Crossing::Leave,
        _ => Crossing::Enter,
    };
    let own = roots
        .iter_mut()
        .filter(|root| root.face == left.face && (is_faceted || root.crossing == expected));
    let root = own.min_by(|a, b| a.t.abs().total_cmp(&b.t.abs()))?;
    root.is_visible = false;
    Some(root.t)
}
