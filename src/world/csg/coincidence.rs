//! Coincident surfaces in CSG.
//!
//! Surfaces at the same `t`, up to rounding, are taken together, and each counts as inside or outside the solids of the
//! others by [`SurfaceSide`]: coincident faces leave a skin as in POV-Ray. Faces of boxes without a matrix count as the
//! rounding of their points decides, mostly the same way all over a face. Where POV-Ray leaves speckles, and with clean
//! cuts everywhere, one surface is shown if the ray enters or leaves the node as a whole there: no double surface, no
//! hole. A packet of rays hands every ray with ends near each other to the sweep, see [`Widening::of_packets`].

use super::program::CsgProgram;
use super::sweep::{Event, Sweep, SweepContext};
use crate::base::math::COINCIDENT;
use crate::scene::shape::{Crossing, FlatFace, Geometry, Root, SurfaceSide};
use crate::world::primitive::Leaf;
use glam::DVec3;
use smallvec::SmallVec;
use std::cmp::Ordering;

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

    /// Handles several roots at the same `t`: hides those not shown, and puts the operand first that wins in POV-Ray,
    /// which is the last one unless combinations are nested.
    pub(super) fn step_together(
        &self,
        at: usize,
        end: usize,
        context: SweepContext,
        sweep: &mut Sweep,
    ) {
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
        if self.has_clean_cuts() || !self.show_on_surfaces(at, end, context, sweep) {
            self.show_clean_cuts(at, end, sweep);
        }
        let events = &mut sweep.events[at..end];
        for (event, is_shown) in events.iter_mut().zip(&sweep.shown) {
            event.root.is_visible &= is_shown;
        }
        events.reverse();
        let rank = |event: &Event| match &self.tie_ranks {
            Some(ranks) => ranks[event.leaf as usize],
            None => event.leaf,
        };
        let own = |a: &Event, b: &Event| a.root.t.total_cmp(&b.root.t);
        let ranked = |a: &Event, b: &Event| rank(b).cmp(&rank(a)).then(own(a, b));
        match self.rounded_distances(events, context) {
            None => events.sort_by(ranked),
            Some(mut rounded) => {
                rounded.sort_by(|a, b| a.0.total_cmp(&b.0).then(ranked(&a.1, &b.1)));
                for (event, (_, sorted)) in events.iter_mut().zip(rounded) {
                    *event = sorted;
                }
            }
        }
    }

    /// The distances of roots at almost one distance as POV-Ray rounds them, if they are known for all roots that show.
    fn rounded_distances(
        &self,
        events: &[Event],
        context: SweepContext,
    ) -> Option<SmallVec<[(f64, Event); 4]>> {
        let show = events.iter().filter(|event| event.root.is_visible).count();
        let is_tie = show > 1 && !self.has_clean_cuts();
        let rounding = context.rounding.filter(|_| is_tie)?;
        let distance = |event: &Event| {
            let Root { t, face, .. } = event.root;
            if !event.root.is_visible {
                return Some(t);
            }
            let form = rounding.of_ties(self.first + event.leaf, context.leaves)?;
            form.hit(context.ray, t, face).map(|hit| hit.t)
        };
        let rounded = |event: &Event| Some((distance(event)?, *event));
        events.iter().map(rounded).collect()
    }

    /// Selects the surfaces shown among several at the same `t` as POV-Ray does: those whose points every ancestor lets
    /// through. Returns false if there are none and rounding decides it in POV-Ray, which then leaves speckles.
    fn show_on_surfaces(
        &self,
        at: usize,
        end: usize,
        context: SweepContext,
        sweep: &mut Sweep,
    ) -> bool {
        let Sweep {
            events,
            state,
            shown,
            ..
        } = sweep;
        let events = &events[at..end];
        let mut is_certain = true;
        let by_rounding = self.rounded_position(events, context);
        for event in events {
            if event.root.crossing == Crossing::Touch {
                continue;
            }
            let leaf = &context.leaves[(self.first + event.leaf) as usize];
            let face = by_rounding.and_then(|position| Some((position, flat_face(leaf, event)?)));
            let side = match face {
                Some((position, face)) => face.side(position),
                None => leaf.shape.surface_side(),
            };
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

    /// The position of a ray's point after rounding, relative to the coordinate of the world at which faces of boxes
    /// coincide, or those of boxes and prisms; `None` for other shapes and where it may differ from ray to ray.
    ///
    /// In POV-Ray the point has the coordinate `o + t·d` with `t = (c − o)/d`. The product is `c − o` to the last bit for
    /// all directions at which a face is looked at squarely and for most others. Below a power of two, where numbers are
    /// twice as dense, it may be the number before; that must not matter. Rays of the camera start at one point, so that
    /// it is the same all over a face; for others it must not depend on the last bit of where they start. The distance of
    /// a prism has more roundings, so that its own point varies; but that of the box decides whether anything shows.
    fn rounded_position(&self, events: &[Event], context: SweepContext) -> Option<Ordering> {
        let mut common = None;
        let mut has_exact_point = false;
        for event in events {
            let leaf = &context.leaves[(self.first + event.leaf) as usize];
            let face = flat_face(leaf, event)?;
            let plane = (face.axis, face.coordinate);
            if *common.get_or_insert(plane) != plane {
                return None;
            }
            has_exact_point |= face.has_exact_points;
        }
        if !has_exact_point {
            return None;
        }
        let (axis, coordinate) = common?;
        let position = |origin: f64| {
            let offset = coordinate - origin;
            let at = |offset: f64| (origin + offset).partial_cmp(&coordinate);
            let is_certain = !is_power_of_two(offset) || at(toward_zero(offset)) == at(offset);
            at(offset).filter(|_| is_certain)
        };
        let origin = context.ray.origin[axis];
        let own = position(origin);
        let is_from_camera = context.departure.is_none() && !context.is_shadow;
        let is_even = || [origin.next_down(), origin.next_up()].map(position) == [own; 2];
        own.filter(|_| is_from_camera || is_even())
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

/// The face of a leaf that an event is on, in world space, if it lies across an axis and no transform rounds the
/// coordinate there.
fn flat_face(leaf: &Leaf, event: &Event) -> Option<FlatFace> {
    let face = leaf.shape.flat_face(event.root.face)?;
    let Some(matrix) = &leaf.object_from_world else {
        return Some(face);
    };
    let row = matrix.matrix3.row(face.axis);
    let scale = row[face.axis];
    let is_exact = scale > 0.0
        && is_power_of_two(scale)
        && row == scale * DVec3::AXES[face.axis]
        && matrix.translation[face.axis] == 0.0;
    is_exact.then_some(FlatFace {
        coordinate: face.coordinate / scale,
        ..face
    })
}

/// The number next to one in the direction of zero; zero itself for zero.
fn toward_zero(number: f64) -> f64 {
    f64::from_bits(number.abs().to_bits().saturating_sub(1)).copysign(number)
}

/// True for powers of two, their negatives and zero.
fn is_power_of_two(number: f64) -> bool {
    number.to_bits().trailing_zeros() >= f64::MANTISSA_DIGITS - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_one_next_to_them_in_the_direction_of_zero() {
        assert_eq!(
            [1.0, -1.0].map(toward_zero),
            [1.0_f64.next_down(), (-1.0_f64).next_up()]
        );
        assert_eq!(toward_zero(0.0), 0.0);
    }

    #[test]
    fn powers_of_two_are_recognized() {
        for power in [8.0, -1.0, 0.25, 0.0] {
            assert!(is_power_of_two(power), "{power}");
        }
        for other in [3.0, -10.0, 0.3, 8.0_f64.next_down()] {
            assert!(!is_power_of_two(other), "{other}");
        }
    }
}
