//! Coincident surfaces in CSG.
//!
//! Surfaces at the same `t`, up to rounding, are taken together, and each counts as inside or outside the solids of the
//! others by [`SurfaceSide`]: coincident faces leave a skin as in POV-Ray. Where POV-Ray leaves speckles, and with clean
//! cuts everywhere, one surface is shown if the ray enters or leaves the node as a whole there: no double surface, no
//! hole. A packet of rays hands every ray with ends near each other to the sweep, see [`Widening::of_packets`].

use super::program::CsgProgram;
use super::sweep::Sweep;
use crate::base::math::COINCIDENT;
use crate::scene::shape::{Crossing, Geometry, SurfaceSide};
use crate::world::primitive::Leaf;

/// Factors of the distances of surfaces: those at `t` and `u` coincide if `down * t <= u <= up * t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Widening {
    pub(crate) down: f64,
    pub(crate) up: f64,
}

impl Widening {
    /// Equal distances alone: clean cuts keep the thinnest walls.
    pub(crate) const NONE: Widening = Widening { down: 1.0, up: 1.0 };

    /// Distances whose difference the roundings of different transforms may be.
    pub(crate) const ROUNDINGS: Widening = Widening {
        down: 1.0 - COINCIDENT,
        up: 1.0 + COINCIDENT,
    };

    /// The factors for packets, which take the scalar path wherever ends may coincide: twice as far.
    #[inline(always)]
    pub(crate) fn of_packets(self) -> Widening {
        Widening {
            down: self.down - (1.0 - self.down),
            up: self.up + (self.up - 1.0),
        }
    }
}

impl Default for Widening {
    fn default() -> Self {
        Widening::ROUNDINGS
    }
}

impl CsgProgram {
    /// Returns true if coincident faces are cut cleanly, where POV-Ray leaves a skin.
    fn has_clean_cuts(&self) -> bool {
        self.widening == Widening::NONE
    }

    /// Handles several roots at the same `t`: hides those not shown, and puts the last operand first, which wins as in
    /// POV-Ray.
    pub(super) fn step_together(&self, at: usize, end: usize, leaves: &[Leaf], sweep: &mut Sweep) {
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
        if self.has_clean_cuts() || !self.show_on_surfaces(at, end, leaves, sweep) {
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
            ..
        } = sweep;
        let events = &events[at..end];
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
        // Back to the state after them: the last event of each operand decides, as in the first pass.
        for event in events {
            self.toggle(event, state);
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
}
