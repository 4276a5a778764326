//! Combinations of the most frequent form, for four rays at once: what simple solids have in common, less others.
//!
//! With few operands no sorting pays. A surface is shown where the ray is within all solids that are to be shared and
//! outside of all that are taken away; each end of a span is tried against the other spans (Roth 1982, turned about:
//! all ends, all spans, no order). Where two ends fall together, and wherever a shape has doubts, the answer is that the
//! ray must be asked for singly: so what is found is what [`Program::nearest`] finds, to the bit.

use super::csg::{Combine, Found, NONE, Program, hide_departure};
use super::leaf::Leaf;
use super::lot::{FourQueries, Lot};
use super::query::{Query, Scratch};
use super::search::SKIN;
use super::world::World;
use crate::math::lanes::{Four, FourKernel, Lanes, four};
use crate::shape::{Crossing, FourRays, FourSpans, Root};

/// Combinations of up to so many operands are tried end by end; the work grows with the square.
const MOST_OPERANDS: usize = 8;

/// Four rays on their way through a combination.
struct Passing<'a> {
    program: &'a Program,
    leaves: &'a [Leaf],
    rays: &'a FourQueries,
    /// Which rays there are, one bit each.
    there: u32,
}

/// What four rays find.
struct FoundByFour {
    t: [f64; 4],
    /// The operand, a whole number.
    operand: [f64; 4],
    /// Which rays meet something.
    met: u32,
    /// Which rays must be asked for singly.
    unknown: u32,
}

impl Program {
    /// Whether it has the form that four rays can be asked about.
    pub(super) fn suits_four(&self, leaves: &[Leaf]) -> bool {
        let [node] = self.nodes.as_slice() else {
            return false;
        };
        let own = &leaves[self.first as usize..][..self.operands.len()];
        node.combine == Combine::Intersection
            && !node.is_inverse
            && node.parent == NONE
            && self.gates.is_empty()
            && self.operands.len() <= MOST_OPERANDS
            && !self.order.required.is_empty()
            && self.order.tree.is_none()
            && self.operands.iter().all(|operand| !operand.is_hidden)
            && own.iter().all(|leaf| leaf.shape.has_four())
    }
}

impl FourKernel for Passing<'_> {
    type Answer = FoundByFour;

    #[inline(always)]
    fn run<F: Four>(&self) -> FoundByFour {
        let rays = self.rays.load();
        let endless = F::all(f64::INFINITY);
        let (from, far) = (F::load(&self.rays.from), F::load(&self.rays.far));
        let mut ends = [(endless, endless); MOST_OPERANDS];
        let (mut low, mut high) = (from, far);
        let (mut enter, mut leave) = (endless.negated(), endless);
        let mut unknown = 0;
        let mut found = FoundByFour {
            t: [0.0; 4],
            operand: [0.0; 4],
            met: 0,
            unknown: 0,
        };
        let order = &self.program.order;
        let required = order.required.len();
        for (place, &number) in order.required.iter().enumerate() {
            let spans = self.spans(number, &rays);
            unknown |= spans.unknown & self.there;
            ends[place] = (
                F::pick(spans.is_met, spans.enter, endless),
                F::pick(spans.is_met, spans.leave, endless.negated()),
            );
            enter = enter.larger(ends[place].0);
            leave = leave.smaller(ends[place].1);
            low = low.larger(enter);
            high = high.smaller(leave);
            if F::bits(low.not_above(high)) & self.there & !unknown == 0 {
                found.unknown = unknown;
                return found;
            }
        }
        for (place, &number) in (required..).zip(&order.others) {
            let spans = self.spans(number, &rays);
            unknown |= spans.unknown & self.there;
            // Never inside: entered behind everything, left before everything.
            ends[place % MOST_OPERANDS] = (
                F::pick(spans.is_met, spans.enter, endless),
                F::pick(spans.is_met, spans.leave, endless.negated()),
            );
        }
        let count = self.program.operands.len().min(MOST_OPERANDS);
        let cuts = &ends[required.min(count)..count];
        let mut best = endless;
        for candidate in 0..2 * cuts.len() + 2 {
            let t = match (candidate, cuts.get((candidate / 2).wrapping_sub(1))) {
                (0, _) => enter,
                (1, _) => leave,
                (_, Some(cut)) if candidate % 2 == 0 => cut.0,
                (_, Some(cut)) => cut.1,
                (_, None) => continue,
            };
            let mut holds = F::both(F::both(from.below(t), low.not_above(t)), t.not_above(high));
            for (enter, leave) in cuts {
                holds = F::both(holds, F::either(t.not_above(*enter), leave.not_above(t)));
            }
            best = F::pick(F::both(holds, t.below(best)), t, best);
        }
        let met = best.below(endless);
        let mut operand = F::all(0.0);
        let (mut once, mut twice) = (F::mask(0), F::mask(0));
        let numbers = order.required.iter().chain(&order.others);
        for ((enter, leave), &number) in ends[..count].iter().zip(numbers) {
            for end in [*enter, *leave] {
                let is_best = end.equals(best);
                twice = F::either(twice, F::both(once, is_best));
                once = F::either(once, is_best);
                operand = F::pick(is_best, F::all(f64::from(number)), operand);
            }
        }
        let met = F::bits(met) & self.there;
        unknown |= F::bits(twice) & met;
        FoundByFour {
            t: best.store(),
            operand: operand.store(),
            met: met & !unknown,
            unknown,
        }
    }
}

/// Four rays on their way to a primitive.
struct FourOfLeaf<'a, const ANY: bool> {
    leaf: &'a Leaf,
    rays: &'a FourQueries,
    /// Which have just left a root of it that enters, and which one that leaves, one bit each.
    left: [u32; 2],
    /// Which rays there are.
    there: u32,
}

/// The first roots of four rays.
struct NearestOfFour {
    t: [f64; 4],
    leaves: u32,
    met: u32,
    unknown: u32,
}

impl<const ANY: bool> FourKernel for FourOfLeaf<'_, ANY> {
    type Answer = NearestOfFour;

    #[inline(always)]
    fn run<F: Four>(&self) -> NearestOfFour {
        let mut rays: FourRays<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        let (from, far) = (F::load(&self.rays.from), F::load(&self.rays.far));
        let nearest =
            self.leaf
                .shape
                .nearest_of_four::<F, ANY>(&rays, (from, far), self.left, self.there);
        NearestOfFour {
            t: nearest.t.store(),
            leaves: nearest.leaves,
            met: nearest.met,
            unknown: nearest.unknown,
        }
    }
}

/// Asks which of four rays that go out from a leaf have left it for good, one bit each.
struct LeftBehind<'a> {
    leaf: &'a Leaf,
    rays: &'a FourQueries,
}

impl FourKernel for LeftBehind<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<F: Four>(&self) -> u32 {
        let mut rays: FourRays<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        F::bits(self.leaf.shape.four_left_behind(&rays))
    }
}

impl Passing<'_> {
    #[inline(always)]
    fn spans<F: Four>(&self, number: u32, rays: &FourRays<F>) -> FourSpans<F> {
        let leaf = &self.leaves[(self.program.first + number) as usize];
        match &leaf.object_from_world {
            None => leaf.shape.four(rays),
            Some(matrix) => leaf.shape.four(&rays.to_object(matrix)),
        }
    }
}

/// Whether a ray for which nothing counts up to `from` may start on the surface that it meets at `t`.
#[inline(always)]
pub(super) fn may_be_left(from: f64, t: f64) -> bool {
    SKIN * t <= from
}

impl World {
    /// What some of four rays from `start` on find of a combination up to and including where they end: calls `take` with the number of
    /// each ray that meets it. Gives those that must be asked for singly, one bit each. Unless `ASKS_FACE`, no more is
    /// told of a root than its distance.
    #[inline(always)]
    pub(super) fn ask_four<const ASKS_FACE: bool>(
        &self,
        lanes: Lanes,
        number: u32,
        (lot, start, there): (&mut Lot, usize, u32),
        query: impl Fn(usize) -> Query,
        scratch: &mut Scratch,
        mut take: impl FnMut(&mut Lot, usize, Found),
    ) -> u32 {
        let rays = lot.four(start);
        let (from, left) = (rays.from, rays.left);
        let program = &self.model.programs[number as usize];
        let passing = Passing {
            program,
            leaves: &self.model.leaves,
            rays,
            there,
        };
        let mut found = four(lanes, &passing);
        let mut met = found.met;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % 4;
            met &= met - 1;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let leaf = program.first + found.operand[lane] as u32;
            // A surface on which the ray may start is for the search that looks behind it.
            if may_be_left(from[lane], found.t[lane]) {
                found.unknown |= 1 << lane;
                continue;
            }
            // The root that the ray has just left is none; what lies behind it only a single ray finds.
            if left[lane] == leaf && self.left_at(&query(start + lane), scratch) == found.t[lane] {
                found.unknown |= 1 << lane;
                continue;
            }
            let found_leaf = &self.model.leaves[leaf as usize];
            let surface = found_leaf.surface;
            if !ASKS_FACE {
                let root = Root {
                    t: found.t[lane],
                    crossing: Crossing::Touch,
                    face: 0,
                    is_visible: true,
                };
                take(
                    lot,
                    start + lane,
                    Found {
                        root,
                        leaf,
                        surface,
                    },
                );
                continue;
            }
            let roots = &mut scratch.roots;
            roots.clear();
            found_leaf.roots(&query(start + lane).ray, roots);
            match roots.iter().find(|root| root.t == found.t[lane]) {
                Some(&root) => take(
                    lot,
                    start + lane,
                    Found {
                        root,
                        leaf,
                        surface,
                    },
                ),
                None => found.unknown |= 1 << lane,
            }
        }
        found.unknown
    }

    /// What some of four rays from `start` on find of a primitive up to and including where they end: calls `take` with the number of
    /// each ray that meets it; if `ANY` will do perhaps with some place in it. Gives those that must be asked for singly,
    /// one bit each.
    #[inline(always)]
    pub(super) fn ask_four_of_leaf<const ANY: bool>(
        &self,
        lanes: Lanes,
        number: u32,
        (lot, start, mut there): (&mut Lot, usize, u32),
        query: impl Fn(usize) -> Query,
        mut take: impl FnMut(&mut Lot, usize, Found),
    ) -> u32 {
        let rays = lot.four(start);
        let from = rays.from;
        let leaf = &self.model.leaves[number as usize];
        let mut unclear = 0;
        let mut asked = FourOfLeaf::<ANY> {
            leaf,
            rays,
            left: [0, 0],
            there,
        };
        let mut own = rays.have_left(number) & there;
        let is_told = leaf.shape.tells_left_behind();
        if own & rays.goes_out != 0 && is_told {
            let gone = own & rays.goes_out & four(lanes, &LeftBehind { leaf, rays });
            there &= !gone;
            own &= !gone;
        }
        while own != 0 {
            let lane = own.trailing_zeros() as usize % 4;
            own &= own - 1;
            let query = query(start + lane);
            if let Some(left) = &query.from {
                let is_plain = left.face == 0 && left.crossing != Crossing::Touch;
                let leaves = left.normal.dot(query.ray.dir) > 0.0;
                if leaves && !is_told && leaf.is_left_behind(&query.ray) {
                    there &= !(1 << lane);
                    continue;
                }
                asked.left[usize::from(leaves)] |= 1 << lane;
                unclear |= u32::from(!is_plain) << lane;
            }
        }
        if there == 0 {
            return 0;
        }
        asked.there = there;
        let found = four(lanes, &asked);
        let mut unknown = (found.unknown | unclear) & there;
        let mut met = found.met & there & !unknown;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % 4;
            met &= met - 1;
            if may_be_left(from[lane], found.t[lane]) {
                unknown |= 1 << lane;
                continue;
            }
            let root = Root {
                t: found.t[lane],
                crossing: if found.leaves >> lane & 1 == 1 {
                    Crossing::Leave
                } else {
                    Crossing::Enter
                },
                face: 0,
                is_visible: true,
            };
            let surface = leaf.surface;
            take(
                lot,
                start + lane,
                Found {
                    root,
                    leaf: number,
                    surface,
                },
            );
        }
        unknown
    }

    /// Where a ray has just left a part of a combination; not a number if it has not.
    #[inline(never)]
    fn left_at(&self, query: &Query, scratch: &mut Scratch) -> f64 {
        let Some(left) = &query.from else {
            return f64::NAN;
        };
        let leaf = &self.model.leaves[left.leaf as usize];
        let roots = &mut scratch.roots;
        roots.clear();
        leaf.roots(&query.ray, roots);
        hide_departure(roots, left, leaf, query.ray.dir);
        let hidden = roots.iter().find(|root| !root.is_visible);
        hidden.map_or(f64::NAN, |root| root.t)
    }
}
