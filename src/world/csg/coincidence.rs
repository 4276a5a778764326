//! Coincident surfaces in CSG.
//!
//! Surfaces at the same `t`, up to rounding, are taken together, and each counts as inside or outside the solids of the
//! others by [`SurfaceSide`]: coincident faces leave a skin as in POV-Ray. Faces of boxes without a matrix count as the
//! rounding of their points decides, mostly the same way all over a face. Where POV-Ray leaves speckles, and with clean
//! cuts everywhere, one surface is shown if the ray enters or leaves the node as a whole there: no double surface, no
//! hole. A packet of rays hands every ray with ends near each other to the sweep, see [`Widening::of_packets`].

use super::inside::InsideState;
use super::program::CsgProgram;
use super::sweep::{Event, Sweep, SweepContext};
use crate::base::math::{COINCIDENT, Ray};
use crate::scene::shape::{Crossing, FlatFace, Geometry, Root, Shape, SurfaceSide};
use crate::world::primitive::Leaf;
use glam::DVec3;
use smallvec::SmallVec;

/// For each of several surfaces at one distance, true if it shows.
type Shown = SmallVec<[bool; 4]>;

/// The most surfaces at one point, and the most nodes above them, that [`CsgProgram::may_show_together`] compares.
const MOST_COMPARED: usize = 32;

/// Rays whose points decide which surfaces show, and the most of them that may be against the others: where more are,
/// POV-Ray leaves speckles.
const VOTES: u32 = 24;
/// The most surfaces at one point that are decided so: each is tested against all for each ray.
const MOST_VOTED: usize = 4;
const MOST_AGAINST: usize = 3;
/// Largest angle between them: much less than a pixel, much more than a rounding.
const BESIDE: f64 = 1.0 / (1_u64 << 18) as f64;
/// Multiples of these spread evenly, modulo 1 (M. Roberts's sequence R2).
const SPREAD: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// A node above coincident surfaces, with the least and the greatest number of its children that may contain the ray.
struct NodeRange {
    number: u32,
    range: [u32; 2],
}

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

    /// Returns true if one of several surfaces at the same `t` shows for some choice of the operands that contain the ray
    /// there. This is exact: what a node lets through depends on its other children, which share no operand with those of
    /// other nodes.
    pub(super) fn may_show_together(
        &self,
        events: &[Event],
        from: f64,
        state: &InsideState,
    ) -> bool {
        let Some(ranges) = self.count_ranges(events, state) else {
            return true;
        };
        let mut candidates = events.iter().filter(|event| self.may_be_hit(event, from));
        candidates.any(|event| {
            // The fewest and the most times, 0 or 1, that the child below may contain the ray.
            let mut child = [false, true];
            let mut number = self.operands[event.leaf as usize].parent;
            while let Some(node) = self.nodes.get(number as usize) {
                let known = ranges.iter().find(|known| known.number == number);
                let [least, most] =
                    known.map_or([state.counts[number as usize]; 2], |known| known.range);
                if !node.lets_through(least, child[0]) && !node.lets_through(most, child[1]) {
                    return false;
                }
                let [a, b] = [node.holds(least), node.holds(most)];
                child = [a && b, a || b];
                number = node.parent;
            }
            true
        })
    }

    /// The ranges of the counts of all nodes that the operands of coincident surfaces may change; `None` if there are too
    /// many.
    fn count_ranges(
        &self,
        events: &[Event],
        state: &InsideState,
    ) -> Option<SmallVec<[NodeRange; 8]>> {
        if events.len() > MOST_COMPARED {
            return None;
        }
        let mut ranges: SmallVec<[NodeRange; 8]> = SmallVec::new();
        for (index, event) in events.iter().enumerate() {
            if events[..index].iter().any(|other| other.leaf == event.leaf) {
                continue;
            }
            let mut is_in = state.leaf_in[event.leaf as usize];
            let mut number = self.operands[event.leaf as usize].parent;
            while let Some(node) = self.nodes.get(number as usize) {
                let count = state.counts[number as usize];
                let at = match ranges.iter().position(|known| known.number == number) {
                    Some(at) => at,
                    None if ranges.len() == MOST_COMPARED => return None,
                    None => {
                        let range = [count; 2];
                        ranges.push(NodeRange { number, range });
                        ranges.len() - 1
                    }
                };
                let [least, most] = &mut ranges[at].range;
                let depended = node.holds(*least) != node.holds(*most);
                if is_in {
                    *least -= 1;
                } else {
                    *most += 1;
                }
                // A node that may contain the ray or not changes the range of its parent, once.
                if depended || node.holds(*least) == node.holds(*most) {
                    break;
                }
                (is_in, number) = (node.holds(count), node.parent);
            }
        }
        Some(ranges)
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
            let leaf = self.first + event.leaf;
            // Roots of boxes are rounded alike.
            let is_box = matches!(context.leaves[leaf as usize].shape, Shape::Cuboid(_));
            if is_box || !event.root.is_visible {
                return Some(event.root.t);
            }
            rounding.tied_distance(leaf, context.leaves, context.ray, &event.root)
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
        let by_rounding = self
            .shown_by_rounding(events, context, state)
            .or_else(|| self.shown_by_points(events, context, state));
        let mut is_certain = true;
        shown.clear();
        match by_rounding {
            Some(by_rounding) => shown.extend_from_slice(&by_rounding),
            None => {
                for event in events {
                    let leaf = &context.leaves[(self.first + event.leaf) as usize];
                    let side = leaf.shape.surface_side();
                    is_certain &= side != SurfaceSide::Rounded;
                    self.put_on_surface(event, side, state);
                }
                for event in events {
                    let is_shown = self.lets_through(event.leaf, state);
                    is_certain |= is_shown && !self.operands[event.leaf as usize].is_hidden;
                    shown.push(is_shown);
                }
            }
        }
        // Back to the state after them: the last event of each operand decides, as in the first pass.
        for event in events {
            self.toggle(event, state);
        }
        is_certain
    }

    /// Puts the ray on the surface of an operand, points of which count as on this side.
    fn put_on_surface(&self, event: &Event, side: SurfaceSide, state: &mut InsideState) {
        if event.root.crossing == Crossing::Touch {
            return;
        }
        let is_inverse = self.operands[event.leaf as usize].is_inverse;
        let is_in = match side {
            SurfaceSide::Inside | SurfaceSide::Rounded => !is_inverse,
            SurfaceSide::Outside => is_inverse,
            SurfaceSide::Both => is_inverse == self.is_inverse(event.leaf),
        };
        self.put(event.leaf, is_in, state);
    }

    /// The surfaces shown where all are faces across one axis, of boxes and prisms: those whose points, after rounding,
    /// every ancestor lets through. `None` for other shapes and where it may differ from ray to ray.
    ///
    /// In POV-Ray the point of a face at `c` has the coordinate `o + t·d` with `t = (c − o)/d`. The product is `c − o` to the
    /// last bit for all directions at which a face is looked at squarely and for most others. Below a power of two, where
    /// numbers are twice as dense, it may be the number before; that must not matter. Rays of the camera start at one point,
    /// so that it is the same all over a face; for others it must not depend on the last bit of where they start.
    fn shown_by_rounding(
        &self,
        events: &[Event],
        context: SweepContext,
        state: &mut InsideState,
    ) -> Option<Shown> {
        let mut faces: SmallVec<[WorldFace; 4]> = SmallVec::new();
        for event in events {
            let leaf = &context.leaves[(self.first + event.leaf) as usize];
            let face = WorldFace::of(leaf, event)?;
            if faces.first().is_some_and(|first| first.axis != face.axis) {
                return None;
            }
            faces.push(face);
        }
        let mut shown = |origin: f64, toward: fn(f64) -> f64| {
            let mut shown = Shown::new();
            let mut last = None;
            for (event, own) in events.iter().zip(&faces) {
                let position = origin + toward(own.offset(origin));
                if last.replace(position) != Some(position) {
                    for (other, face) in events.iter().zip(&faces) {
                        self.put_on_surface(other, face.side(position)?, state);
                    }
                }
                shown.push(self.lets_through(event.leaf, state));
            }
            Some(shown)
        };
        let origin = context.ray.origin[faces.first()?.axis];
        let own = shown(origin, |offset| offset)?;
        let near_power = |offset: f64| match is_power_of_two(offset) {
            true => toward_zero(offset),
            false => offset,
        };
        let mut is_same = |origin: f64| shown(origin, |offset| offset).as_ref() == Some(&own);
        let is_from_camera = context.departure.is_none() && !context.is_shadow;
        let is_even = is_from_camera || is_same(origin.next_down()) && is_same(origin.next_up());
        let is_certain = is_even && shown(origin, near_power).as_ref() == Some(&own);
        is_certain.then_some(own)
    }

    /// The surfaces shown where all are faces of boxes and prisms, and POV-Ray's points show the same ones nearly all over
    /// the face: those that every ancestor lets through by the point of this ray and those of rays beside it.
    fn shown_by_points(
        &self,
        events: &[Event],
        context: SweepContext,
        state: &mut InsideState,
    ) -> Option<Shown> {
        let is_exact = |event: &Event| {
            let leaf = &context.leaves[(self.first + event.leaf) as usize];
            matches!(leaf.shape, Shape::Cuboid(_) | Shape::Prism(_))
        };
        if events.len() > MOST_VOTED || !events.iter().all(is_exact) {
            return None;
        }
        let first = events.first()?;
        let leaf = &context.leaves[(self.first + first.leaf) as usize];
        let Root { t, face, .. } = first.root;
        let ray = *context.ray;
        let middle = ray.at(t);
        let (normal, _) = leaf.normals(middle, ray.dir, face);
        let height = normal.dot(middle - ray.origin);
        let length = ray.dir.length();
        let (right, up) = (ray.dir / length).any_orthonormal_pair();
        let mut votes: [(Shown, usize); 2] = Default::default();
        for turn in 0..VOTES {
            let [x, y] = SPREAD.map(|factor| BESIDE * length * (f64::from(turn) * factor).fract());
            let dir = ray.dir + x * right + y * up;
            let beside = Ray::new(ray.origin, dir * (length / dir.length()));
            // The first one is the ray itself.
            let beside = if turn == 0 { ray } else { beside };
            let near = height / normal.dot(beside.dir);
            let shown = self.shown_at_point(events, &beside, near, context, state)?;
            let is_alike = |(other, count): &&mut (Shown, usize)| {
                *count == 0 || self.look_alike(events, [other, &shown], context)
            };
            let (other, count) = votes.iter_mut().find(is_alike)?;
            if *count == 0 {
                *other = shown;
            }
            *count += 1;
            if votes.iter().all(|vote| vote.1 > MOST_AGAINST) {
                return None;
            }
        }
        let [first, second] = votes;
        Some(if first.1 > second.1 {
            first.0
        } else {
            second.0
        })
    }

    /// Returns true if it does not matter which of two sets of surfaces shows: a ray hits one of several that look alike.
    fn look_alike(&self, events: &[Event], sets: [&[bool]; 2], context: SweepContext) -> bool {
        let shows = |set: &[bool]| set.contains(&true);
        let one_shows = |at: &usize| sets.iter().any(|set| set[*at]);
        let surface = |at: usize| {
            let leaf = self.first + events[at].leaf;
            context.leaves[leaf as usize].surface
        };
        let mut surfaces = (0..events.len()).filter(one_shows).map(surface);
        let first = surfaces.next();
        sets[0] == sets[1]
            || sets.into_iter().all(shows) && surfaces.all(|surface| Some(surface) == first)
    }

    /// The surfaces that show on a ray by POV-Ray's points on them, about at `t`. Points and inside tests of boxes and
    /// prisms are POV-Ray's to the last bit; `None` for other shapes and for curved sides of prisms.
    fn shown_at_point(
        &self,
        events: &[Event],
        ray: &Ray,
        t: f64,
        context: SweepContext,
        state: &mut InsideState,
    ) -> Option<Shown> {
        let leaf = |event: &Event| &context.leaves[(self.first + event.leaf) as usize];
        let mut shown = Shown::new();
        for event in events {
            let leaf_of = leaf(event);
            let face = event.root.face;
            let point = match &leaf_of.shape {
                Shape::Cuboid(cuboid) => {
                    let face = cuboid.flat_face(face)?;
                    let to_object = leaf_of.object_from_world.as_ref();
                    let local = to_object.map_or(*ray, |to_object| ray.to_object(to_object));
                    let offset = face.coordinate - local.origin[face.axis];
                    ray.at(offset / local.dir[face.axis])
                }
                Shape::Prism(_) => {
                    let form = context.rounding?.forms.get(&(self.first + event.leaf))?;
                    form.hit(ray, t, face)?.point
                }
                _ => return None,
            };
            for other in events {
                let is_inverse = self.operands[other.leaf as usize].is_inverse;
                let is_in = leaf(other).contains(point) != is_inverse;
                self.put(other.leaf, is_in, state);
            }
            shown.push(self.lets_through(event.leaf, state));
        }
        Some(shown)
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

/// A flat face of a leaf across an axis, and its coordinate there in the world: `(coordinate − shift) / scale`.
#[derive(Clone, Copy)]
struct WorldFace {
    axis: usize,
    scale: f64,
    shift: f64,
    face: FlatFace,
}

impl WorldFace {
    /// The face that an event is on, if the transform of the leaf keeps it across its axis.
    fn of(leaf: &Leaf, event: &Event) -> Option<WorldFace> {
        let face = leaf.shape.flat_face(event.root.face)?;
        let axis = face.axis;
        let (scale, shift) = match &leaf.object_from_world {
            None => (1.0, 0.0),
            Some(matrix) => {
                let row = matrix.matrix3.row(axis);
                let is_across = row == row[axis] * DVec3::AXES[axis];
                (is_across.then_some(row[axis])?, matrix.translation[axis])
            }
        };
        Some(WorldFace {
            axis,
            scale,
            shift,
            face,
        })
    }

    /// The offset of the face from a coordinate of the world.
    fn offset(&self, origin: f64) -> f64 {
        (self.face.coordinate - (origin * self.scale + self.shift)) / self.scale
    }

    /// The side of the solid on which a point at a coordinate of the world lies.
    fn side(&self, position: f64) -> Option<SurfaceSide> {
        let local = position * self.scale + self.shift;
        Some(self.face.side(local.partial_cmp(&self.face.coordinate)?))
    }
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
    use crate::base::math::sampling::random::Random;
    use crate::world::csg::program::{Combine, NONE, Node, Operand};

    fn below(rng: &mut Random, end: u32) -> u32 {
        u32::try_from(rng.bits() % u64::from(end)).unwrap()
    }

    /// A program of a random tree, and a random state of its operands.
    fn random_program(rng: &mut Random) -> (CsgProgram, InsideState) {
        let mut program = CsgProgram::default();
        let mut state = InsideState::default();
        let nodes = below(rng, 5) + 1;
        for number in 0..nodes {
            let kinds = [Combine::Union, Combine::Merge, Combine::Intersection];
            program.nodes.push(Node {
                combine: kinds[below(rng, 3) as usize],
                is_inverse: below(rng, 3) == 0,
                children: 0,
                parent: match number {
                    0 => NONE,
                    _ => below(rng, number),
                },
            });
        }
        for _ in 0..below(rng, 6) + 2 {
            program.operands.push(Operand {
                parent: below(rng, nodes),
                is_inverse: false,
                is_hidden: below(rng, 8) == 0,
            });
            state.leaf_in.push(below(rng, 2) == 0);
        }
        let parents = program.nodes.iter().map(|node| node.parent);
        let parents: Vec<u32> = parents
            .chain(program.operands.iter().map(|operand| operand.parent))
            .collect();
        for parent in parents.into_iter().filter(|&parent| parent != NONE) {
            program.nodes[parent as usize].children += 1;
        }
        state.counts = counts(&program, &state.leaf_in);
        (program, state)
    }

    fn counts(program: &CsgProgram, leaf_in: &[bool]) -> Vec<u32> {
        let mut counts = vec![0; program.nodes.len()];
        for (operand, &is_in) in program.operands.iter().zip(leaf_in) {
            counts[operand.parent as usize] += u32::from(is_in);
        }
        program.count_from_below(&mut counts);
        counts
    }

    #[test]
    fn surfaces_may_show_if_they_do_for_some_state_of_their_operands() {
        let mut rng = Random::new(11);
        let mut results = [0; 2];
        for _ in 0..20_000 {
            let (program, state) = random_program(&mut rng);
            let leaves = program.len();
            let events: Vec<Event> = (0..below(&mut rng, 3) + 2)
                .map(|_| Event {
                    root: Root {
                        t: 1.0,
                        face: 0,
                        crossing: Crossing::Enter,
                        is_visible: below(&mut rng, 6) != 0,
                    },
                    leaf: below(&mut rng, leaves),
                })
                .collect();
            let may_show = program.may_show_together(&events, 0.0, &state);
            assert!(!program.may_show_together(&events, 1.0, &state));
            let shows = (0..1 << events.len()).any(|choice: u32| {
                let mut other = InsideState::default();
                other.leaf_in = state.leaf_in.clone();
                for (number, event) in events.iter().enumerate() {
                    other.leaf_in[event.leaf as usize] = choice >> number & 1 == 1;
                }
                other.counts = counts(&program, &other.leaf_in);
                let mut wanted = events.iter().filter(|event| {
                    event.root.is_visible && !program.operands[event.leaf as usize].is_hidden
                });
                wanted.any(|event| program.lets_through(event.leaf, &other))
            });
            assert_eq!(may_show, shows, "{program:?} {events:?} {state:?}");
            results[usize::from(may_show)] += 1;
        }
        assert!(results.iter().all(|&count| count > 1000), "{results:?}");
    }

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
