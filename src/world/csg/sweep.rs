//! CSG along a ray: the roots of all leaves in order, and a count of the operands that contain the ray.
//!
//! Each leaf gives its roots on the whole line of a ray (see `shape`; leaves that cannot matter are skipped). The roots
//! are sorted by `t`, and a sweep toggles one leaf at a time; each toggle climbs only as far as something changes. Leaves
//! in boxes that the ray enters late are left until the sweep comes to them. No hit is tested for being inside, so
//! rounding cannot put it on the wrong side (Roth 1982, "Ray casting for modeling solids", CGIP 18; here n-ary, with one
//! sort), except in shapes whose roots are searched for and may be missed ([`Geometry::may_miss_roots`]). Coincident roots
//! are decided in [`super::coincidence`].
//!
//! Visibility follows POV-Ray: a union shows all surfaces of its children, also inner ones; a merge those outside its
//! other children; an intersection those inside all its other children.

use super::inside::InsideState;
use super::program::{BoundGate, CsgProgram, NONE};
use crate::base::math::Ray;
use crate::scene::shape::{Crossing, Geometry, Root, Start};
use crate::world::primitive::Leaf;
use crate::world::ray::SpawnSurface;
use crate::world::rounding::Rounding;
use glam::DVec3;
use std::ops::{ControlFlow, Range};

/// A ray in a sweep through a program.
#[derive(Clone, Copy)]
pub(crate) struct SweepContext<'a> {
    pub(crate) leaves: &'a [Leaf],
    pub(crate) ray: &'a Ray,
    /// The surface that the ray leaves.
    pub(crate) departure: Option<&'a SpawnSurface>,
    /// True for a shadow ray, see [`BoundGate::spares_shadows`].
    pub(crate) is_shadow: bool,
    /// POV-Ray's rounding of the leaves, which decides about surfaces at almost one distance.
    pub(crate) rounding: Option<&'a Rounding>,
}

impl<'a> SweepContext<'a> {
    /// A ray that leaves no surface.
    pub(crate) fn free(leaves: &'a [Leaf], ray: &'a Ray) -> Self {
        SweepContext {
            leaves,
            ray,
            departure: None,
            is_shadow: false,
            rounding: None,
        }
    }
}

/// An interval of a ray, `from < t <= to`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayInterval {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl RayInterval {
    /// The whole ray.
    pub(crate) const FORWARD: RayInterval = RayInterval {
        from: 0.0,
        to: f64::INFINITY,
    };
}

/// The box of an operand or of a part that a ray may hit.
#[derive(Clone, Copy, Debug)]
struct NearBox {
    /// A parameter up to which the ray is outside it, or outside a part around it.
    entry: f64,
    /// Its position in the BVH.
    position: u32,
}

/// The most boxes whose roots are always gathered together.
const BOXES_AT_ONCE: usize = 8;

/// The length of a ray on which boxes are tried first, relative to the size of the program.
const FIRST_SHARE: f64 = 1.0 / 8.0;

/// A root and the leaf it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) root: Root,
    /// The operand.
    pub(super) leaf: u32,
}

/// Buffers of the sweep.
#[derive(Debug, Default)]
pub(crate) struct Sweep {
    roots: Vec<Root>,
    pub(super) events: Vec<Event>,
    pub(super) state: InsideState,
    /// Counts of the nodes before several roots at the same `t`.
    pub(super) before: Vec<u32>,
    /// For each of these roots, true if the ray was inside its operand before them.
    pub(super) was_in: Vec<bool>,
    /// For each of these roots, true if its surface is shown.
    pub(super) shown: Vec<bool>,
    /// The boxes that the ray may hit.
    near: Vec<NearBox>,
    /// The number of them, from the first, whose roots have been gathered.
    gathered: usize,
    /// The parameter up to which all roots are gathered. There the ray has hit none of the rest, and is in their rest state.
    horizon: f64,
    /// For each of `hit_parts` a parameter up to which the ray is outside its box; infinite for others.
    part_entries: Vec<f64>,
    /// The parts with boxes that the ray hits.
    hit_parts: Vec<u32>,
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
    /// The first surface shown at `from < t <= to` that `wanted` accepts.
    pub(crate) fn nearest(
        &self,
        context: SweepContext,
        interval: RayInterval,
        sweep: &mut Sweep,
        mut wanted: impl FnMut(&RawHit) -> bool,
    ) -> Option<RawHit> {
        let RayInterval { mut from, to } = self.collect(context, interval, sweep)?;
        let mut limit = self.first_limit(context.ray, sweep);
        loop {
            self.gather(context, RayInterval { from, to }, limit, sweep);
            let swept = self.advance(context, interval, to, sweep, &mut wanted);
            if let ControlFlow::Break(hit) = swept {
                return hit;
            }
            from = from.max(sweep.horizon * self.widening.down);
            limit = f64::INFINITY;
        }
    }

    /// Goes through the events in order, to the first surface shown in an interval that `wanted` accepts, or to the end of
    /// what may show at `to`: breaks with the hit, if there is one. Otherwise stops where roots are missing.
    #[inline(always)]
    fn advance(
        &self,
        context: SweepContext,
        interval: RayInterval,
        to: f64,
        sweep: &mut Sweep,
        wanted: &mut impl FnMut(&RawHit) -> bool,
    ) -> ControlFlow<Option<RawHit>> {
        let leaves = context.leaves;
        sort(&mut sweep.events);
        let mut at = 0;
        while at < sweep.events.len() {
            let first = sweep.events[at].root.t;
            if first > to {
                return ControlFlow::Break(None);
            }
            let coincident = first * self.widening.up;
            if first.max(coincident) >= sweep.horizon {
                break;
            }
            let mut end = at + 1;
            while end < sweep.events.len() && sweep.events[end].root.t <= coincident {
                end += 1;
            }
            let from = interval.from;
            let mut events = sweep.events[at..end].iter();
            let mut may_show = events.any(|event| self.may_be_hit(event, from));
            if may_show {
                self.test_point(at..end, context, sweep);
                let events = &sweep.events[at..end];
                may_show = events.len() == 1 || self.may_show_together(events, from, &sweep.state);
            }
            if !may_show {
                for event in &sweep.events[at..end] {
                    self.toggle(event, &mut sweep.state);
                }
                at = end;
                continue;
            }
            match end - at {
                1 => self.step(at, sweep),
                _ => self.step_together(at, end, context, sweep),
            }
            for index in at..end {
                let event = sweep.events[index];
                let Event { root, leaf } = event;
                let number = self.first + leaf;
                let hit = RawHit {
                    root,
                    leaf: number,
                    surface: leaves[number as usize].surface,
                };
                if self.may_be_hit(&event, from) && wanted(&hit) {
                    // The surface shown among coincident ones must not depend on earlier hits.
                    return ControlFlow::Break((root.t <= interval.to).then_some(hit));
                }
            }
            at = end;
        }
        if sweep.horizon == f64::INFINITY {
            return ControlFlow::Break(None);
        }
        sweep.events.drain(..at);
        ControlFlow::Continue(())
    }

    /// Gathers the roots of the leaves without boxes, the state before the first of them, and the boxes that the ray may
    /// hit. Returns the interval in which something may show, or `None` if nothing does between `from` and `to`. Outside
    /// the interval neither need be right.
    fn collect(
        &self,
        context: SweepContext,
        interval: RayInterval,
        sweep: &mut Sweep,
    ) -> Option<RayInterval> {
        sweep.events.clear();
        sweep.state.rest(&self.rest);
        if !self.try_gates(context, sweep) {
            return None;
        }
        let around = self.widening;
        let (mut from, mut to) = (interval.from * around.down, interval.to * around.up);
        for &number in &self.order.required {
            let start = self.add_roots(number, context, RayInterval { from, to }, sweep);
            let (before, after) = sides(&sweep.roots, start);
            if !before {
                from = from.max(sweep.roots.first()?.t * around.down);
            }
            if !after {
                to = to.min(sweep.roots.last()?.t * around.up);
            }
            if from > to {
                return None;
            }
        }
        self.try_boxes(context.ray, RayInterval { from, to }, sweep);
        let boxed = self.order.boxed.as_ref();
        let others = boxed.map_or(&self.order.others[..], |boxed| boxed.free_others());
        for &number in others {
            self.add_roots(number, context, RayInterval { from, to }, sweep);
        }
        Some(RayInterval { from, to })
    }

    /// The parameter up to which boxes are tried first: most rays show a surface soon after they enter the first one.
    fn first_limit(&self, ray: &Ray, sweep: &Sweep) -> f64 {
        match &self.order.boxed {
            Some(boxed) if sweep.near.len() > BOXES_AT_ONCE => {
                let entries = sweep.near.iter().map(|near| near.entry);
                let first = entries.fold(f64::INFINITY, f64::min);
                first + FIRST_SHARE * boxed.size / ray.dir.length()
            }
            _ => f64::INFINITY,
        }
    }

    /// Gathers the roots in the next boxes, those that the ray enters up to a limit, and the state at `interval.from`, before
    /// which no roots are needed.
    fn gather(&self, context: SweepContext, interval: RayInterval, limit: f64, sweep: &mut Sweep) {
        sweep.horizon = f64::INFINITY;
        let Some(boxed) = &self.order.boxed else {
            return;
        };
        let rest = &mut sweep.near[sweep.gathered..];
        let mut count = 0;
        for at in 0..rest.len() {
            if rest[at].entry > limit {
                sweep.horizon = limit;
            } else {
                rest.swap(at, count);
                count += 1;
            }
        }
        for _ in 0..count {
            let position = sweep.near[sweep.gathered].position;
            sweep.gathered += 1;
            let numbers = match position.checked_sub(boxed.first_part) {
                None => &boxed.bounded[position as usize..=position as usize],
                Some(part) => boxed.others_of(part),
            };
            for &number in numbers {
                self.add_roots(number, context, interval, sweep);
            }
        }
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
            self.put(number, !self.operands[number as usize].is_inverse, state);
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
    fn try_gates(&self, context: SweepContext, sweep: &mut Sweep) -> bool {
        sweep.unseen.clear();
        if self.gates.is_empty() {
            return true;
        }
        let mut inner = sweep.inner.take().unwrap_or_default();
        for gate in &self.gates {
            if !gate.lets_through(context, &mut inner) {
                self.mark(&gate.operands, &mut sweep.unseen);
            }
        }
        sweep.inner = Some(inner);
        sweep.unseen.is_empty() || sweep.unseen.contains(&false)
    }

    /// Collects the boxes of operands and of parts that the ray may hit, but none in parts that it misses: outside its box a
    /// part shows nothing and contains no point of the ray, as no part with a box contains a ray that is outside all its
    /// leaves.
    fn try_boxes(&self, ray: &Ray, interval: RayInterval, sweep: &mut Sweep) {
        let Sweep {
            near,
            gathered,
            part_entries,
            hit_parts,
            ..
        } = sweep;
        near.clear();
        *gathered = 0;
        for part in hit_parts.drain(..) {
            part_entries[part as usize] = f64::INFINITY;
        }
        let Some(boxed) = &self.order.boxed else {
            return;
        };
        if part_entries.len() < boxed.parts.len() {
            part_entries.resize(boxed.parts.len(), f64::INFINITY);
        }
        let RayInterval { from, to } = interval;
        boxed.tree.each_entered(ray, from, to, |position, entry| {
            match position.checked_sub(boxed.first_part) {
                None => near.push(NearBox { entry, position }),
                Some(part) => {
                    part_entries[part as usize] = entry;
                    hit_parts.push(part);
                }
            }
        });
        // Parts come before those within them, which are out of reach if the ray misses the box around them.
        hit_parts.sort_unstable();
        let entry_of = |part: u32, part_entries: &[f64]| match part {
            NONE => f64::NEG_INFINITY,
            _ => part_entries[part as usize],
        };
        for &part in &*hit_parts {
            let around = entry_of(boxed.parts[part as usize].around, part_entries);
            let entry = &mut part_entries[part as usize];
            *entry = entry.max(around);
        }
        near.retain_mut(|near| {
            let part = boxed.part_of_bounded[near.position as usize];
            near.entry = near.entry.max(entry_of(part, part_entries));
            near.entry < f64::INFINITY
        });
        for &part in &*hit_parts {
            let entry = part_entries[part as usize];
            if entry < f64::INFINITY {
                let position = boxed.first_part + part;
                near.push(NearBox { entry, position });
            }
        }
    }

    /// Returns true if the surface of an operand is shown: the ray hits all its bounding objects.
    #[inline(always)]
    pub(crate) fn shows(&self, operand: u32, context: SweepContext, sweep: &mut Sweep) -> bool {
        let mut gates = self.gates.iter();
        gates.all(|gate| !gate.operands.contains(&operand) || gate.lets_through(context, sweep))
    }

    fn mark(&self, operands: &Range<u32>, marked: &mut Vec<bool>) {
        marked.resize(self.operands.len(), false);
        marked[operands.start as usize..operands.end as usize].fill(true);
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

    pub(super) fn toggle(&self, event: &Event, state: &mut InsideState) {
        let enters = match event.root.crossing {
            Crossing::Touch => return,
            Crossing::Enter => true,
            Crossing::Leave => false,
        };
        let operand = &self.operands[event.leaf as usize];
        self.put(event.leaf, enters != operand.is_inverse, state);
    }

    /// Returns true if a root beyond `from` is a hit wherever the operands let its surface show.
    #[inline(always)]
    pub(super) fn may_be_hit(&self, event: &Event, from: f64) -> bool {
        let is_hidden = self.operands[event.leaf as usize].is_hidden;
        event.root.is_visible && event.root.t > from && !is_hidden
    }

    /// Puts the ray inside an operand or outside.
    #[inline(always)]
    pub(super) fn put(&self, operand: u32, is_in: bool, state: &mut InsideState) {
        if state.leaf_in[operand as usize] != is_in {
            state.set(operand, is_in);
            self.climb(self.operands[operand as usize].parent, is_in, state);
        }
    }

    /// Puts the ray inside or outside the operands whose roots may miss a part, by the point of roots of others.
    fn test_point(&self, roots: Range<usize>, context: SweepContext, sweep: &mut Sweep) {
        let events = &sweep.events[roots];
        for &number in &self.order.point_tested {
            if events.iter().all(|event| event.leaf != number) {
                let leaf = &context.leaves[(self.first + number) as usize];
                let holds = leaf.contains(context.ray.at(events[0].root.t));
                let is_inverse = self.operands[number as usize].is_inverse;
                self.put(number, holds != is_inverse, &mut sweep.state);
            }
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
    pub(super) fn lets_through(&self, operand: u32, state: &InsideState) -> bool {
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
    /// Returns true if a ray hits the bounding object or starts inside it, or is a shadow ray that is spared.
    fn lets_through(&self, context: SweepContext, sweep: &mut Sweep) -> bool {
        let SweepContext { leaves, ray, .. } = context;
        if self.spares_shadows && context.is_shadow {
            return true;
        }
        let all = RayInterval::FORWARD;
        let free = SweepContext::free(leaves, ray);
        let hit = self.bound.nearest(free, all, sweep, |_| true);
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
