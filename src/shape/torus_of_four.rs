//! Four rays and a torus at once: by the steps of [`Torus`] for single rays, to the bit. Rays that take one of the rarer
//! turns there are left to it.

use super::four::{
    FourRays, FourRoots, Three, chords, dot, is_comfortable, minus, plus, same, scaled,
};
use super::torus::{CLIP, REFINEMENT, SPHERE, Torus};
use crate::math::conditioning::is_comfortable_size;
use crate::math::lanes::Four;
use crate::math::lanes::three::over;
use crate::math::quartic::{LAST_STEP, MAX_STEPS};

/// The quartics of four stretches by rising power.
type Quartics<F> = [F; 5];

/// Stretches of four rays about the origin, in units of the minor radius: `middle + x · half` for `-1 <= x <= 1`.
#[derive(Clone, Copy)]
struct Stretches<F> {
    middle: Three<F>,
    half: Three<F>,
    /// The major radius in units of the minor one.
    major: F,
}

/// What is known of the roots on four stretches: two each, or none.
struct TwoRoots<F: Four> {
    enter: F,
    leave: F,
    met: u32,
    unknown: u32,
}

/// Where Newton's iterations from one end lead.
struct FromEnd<F> {
    place: F,
    /// Those that found a root.
    found: u32,
    /// Those that take too long to say.
    unknown: u32,
}

impl Torus {
    /// Whether [`Torus::roots_of_four`] knows anything.
    pub(super) fn has_four(&self) -> bool {
        self.minor > 0.0
            && self.major >= SPHERE * self.minor
            && is_comfortable_size(self.major + self.minor)
    }

    /// The roots of four rays.
    #[inline(always)]
    pub(super) fn roots_of_four<F: Four>(&self, rays: &FourRays<F>) -> FourRoots<F> {
        let origin = minus(rays.origin, same(self.centre));
        let rays = FourRays {
            origin,
            dir: rays.dir,
        };
        let none = F::all(0.0);
        let mut is_known = is_comfortable(dot(rays.dir, rays.dir), dot(origin, origin));
        let (flat_origin, flat_dir) = (flat(origin), flat(rays.dir));
        is_known = F::both(is_known, none.below(rays.dir[1].size()));
        is_known = F::both(is_known, none.below(dot(flat_dir, flat_dir)));
        let mut unknown = 0b1111 & !F::bits(is_known);
        // The slab and the cylinder around the tube.
        let height = self.minor * CLIP;
        let down = F::all(-height).minus(origin[1]).over(rays.dir[1]);
        let up = F::all(height).minus(origin[1]).over(rays.dir[1]);
        let (rim_enter, rim_leave, in_rim) = chords(flat_origin, flat_dir, self.major + height);
        let first = down.smaller(up).larger(rim_enter);
        let last = down.larger(up).smaller(rim_leave);
        let is_finite = last.minus(first).below(F::all(f64::INFINITY));
        let is_near = F::both(in_rim, F::both(first.below(last), is_finite));
        let mut found = FourRoots::none(unknown);
        if F::bits(is_near) == 0 {
            return found;
        }
        // The hole parts the stretch in two.
        let (mut part_end, mut part_start) = (last, last);
        let hole = self.major - height;
        if hole > 0.0 {
            let (enter, leave, in_hole) = chords(flat_origin, flat_dir, hole);
            part_end = F::pick(in_hole, enter.smaller(last), last);
            part_start = F::pick(in_hole, leave.larger(first), last);
        }
        for place in 0..2 {
            let (start, end) = [(first, part_end), (part_start, last)][place];
            let asked = F::both(is_near, start.below(end));
            if F::bits(asked) == 0 {
                continue;
            }
            let roots = self.solve_four(&rays, start, end);
            let asked = F::bits(asked);
            unknown |= roots.unknown & asked;
            (found.t[2 * place], found.t[2 * place + 1]) = (roots.enter, roots.leave);
            found.met[2 * place] = roots.met & asked;
            found.met[2 * place + 1] = roots.met & asked;
        }
        found.unknown = unknown;
        found
    }

    #[inline(always)]
    fn solve_four<F: Four>(&self, rays: &FourRays<F>, from: F, to: F) -> TwoRoots<F> {
        let (middle, half) = (
            F::all(0.5).times(from.plus(to)),
            F::all(0.5).times(to.minus(from)),
        );
        let minor = F::all(self.minor);
        let stretches = Stretches {
            middle: over(plus(rays.origin, scaled(rays.dir, middle)), minor),
            half: over(scaled(rays.dir, half), minor),
            major: F::all(self.major / self.minor),
        };
        let quartics = stretches.quartics();
        let positive = F::bits(are_positive(&quartics));
        let mut roots = TwoRoots {
            enter: from,
            leave: to,
            met: 0,
            unknown: 0,
        };
        if positive == 0b1111 {
            return roots;
        }
        let bending = F::bits(bend_up(&quartics)) & !positive;
        roots.unknown = 0b1111 & !positive & !bending;
        let low = from_end(&quartics, -1.0, bending);
        let high = from_end(&quartics, 1.0, low.found);
        roots.unknown |= low.unknown | high.unknown;
        roots.met = high.found;
        let in_order = F::bits(low.place.below(high.place));
        roots.unknown |= roots.met & !in_order;
        roots.met &= in_order;
        if roots.met == 0 {
            return roots;
        }
        let refined = [
            stretches.refine(stretches.refine(low.place)),
            stretches.refine(stretches.refine(high.place)),
        ];
        let in_order = refined[0].below(refined[1]);
        let enter = F::pick(in_order, refined[0], low.place);
        let leave = F::pick(in_order, refined[1], high.place);
        roots.enter = middle.plus(half.times(enter));
        roots.leave = middle.plus(half.times(leave));
        roots
    }
}

impl<F: Four> Stretches<F> {
    #[inline(always)]
    fn quartics(&self) -> Quartics<F> {
        let (p, v) = (self.middle, self.half);
        let (one, two) = (F::all(1.0), F::all(2.0));
        let flat_p = flat(p);
        let axis_distance = dot(flat_p, flat_p).root();
        let b = [
            p[1].minus(one).times(p[1].plus(one)),
            two.times(p[1]).times(v[1]),
            v[1].times(v[1]),
        ];
        let a = [
            axis_distance
                .minus(self.major)
                .times(axis_distance.plus(self.major)),
            two.times(dot(flat_p, flat(v))),
            dot(flat(v), flat(v)),
        ];
        let whole = two.times(self.major);
        let s = [
            a[0].plus(b[0]).over(whole),
            a[1].plus(b[1]).over(whole),
            a[2].plus(b[2]).over(whole),
        ];
        [
            s[0].times(s[0]).plus(b[0]),
            two.times(s[0]).times(s[1]).plus(b[1]),
            s[1].times(s[1])
                .plus(two.times(s[0]).times(s[2]))
                .plus(b[2]),
            two.times(s[1]).times(s[2]),
            s[2].times(s[2]),
        ]
    }

    /// One Newton step on the distance from the nearer of tube and lemon.
    #[inline(always)]
    fn refine(&self, x: F) -> F {
        let p = plus(self.middle, scaled(self.half, x));
        let flat_p = flat(p);
        let axis_distance = dot(flat_p, flat_p).root();
        let outward = dot(flat_p, flat(self.half)).over(axis_distance);
        let rise = p[1].times(self.half[1]);
        let height_sq = p[1].times(p[1]);
        let tube = off_axis(axis_distance.minus(self.major), outward, height_sq, rise);
        let lemon_across = axis_distance.minus(self.major.negated());
        let lemon = off_axis(lemon_across, outward, height_sq, rise);
        let is_lemon = lemon.0.size().below(tube.0.size());
        let distance = F::pick(is_lemon, lemon.0, tube.0);
        let slope = F::pick(is_lemon, lemon.1, tube.1);
        let step = distance.over(slope);
        let is_small = step.size().below(F::all(REFINEMENT));
        F::pick(is_small, x.minus(step), x)
    }
}

/// The distance from a circle's tube of radius one, and how it changes along the stretch.
#[inline(always)]
fn off_axis<F: Four>(across: F, outward: F, height_sq: F, rise: F) -> (F, F) {
    let from_middle = across.times(across).plus(height_sq).root();
    let slope = across.times(outward).plus(rise).over(from_middle);
    (from_middle.minus(F::all(1.0)), slope)
}

#[inline(always)]
fn flat<F: Four>(v: Three<F>) -> Three<F> {
    [v[0], F::all(0.0), v[2]]
}

/// As [`crate::math::polynomial::is_quartic_positive`].
#[inline(always)]
fn are_positive<F: Four>(c: &Quartics<F>) -> F::Mask {
    let (even, odd) = (c[0].plus(c[2]).plus(c[4]), c[1].plus(c[3]));
    let inner_even = c[0].minus(c[4]);
    let inner_odd = F::all(0.5).times(c[1].minus(c[3]));
    let middle = c[0].minus(c[2].over(F::all(3.0))).plus(c[4]);
    F::both(
        F::both(odd.size().below(even), inner_odd.size().below(inner_even)),
        F::all(0.0).below(middle),
    )
}

/// Where the quick way of [`crate::math::quartic`] may be tried.
#[inline(always)]
fn bend_up<F: Four>(c: &Quartics<F>) -> F::Mask {
    let (two, twelve) = (F::all(2.0), F::all(12.0));
    let even = two.times(c[2]).plus(twelve.times(c[4]));
    let odd = F::all(6.0).times(c[3]);
    F::both(
        odd.size().below(even),
        twelve.times(c[4]).below(two.times(c[2])),
    )
}

/// Newton's iterations from one end, as in [`crate::math::quartic`].
#[inline(always)]
fn from_end<F: Four>(c: &Quartics<F>, end: f64, asked: u32) -> FromEnd<F> {
    let mut x = F::all(end);
    let (none, one) = (F::all(0.0), F::all(1.0));
    let mut walking = asked;
    let mut found = 0;
    let mut unknown = 0;
    for steps in 0..MAX_STEPS {
        if walking == 0 {
            break;
        }
        let (a, da) = (c[4].times(x).plus(c[3]), c[4]);
        let (b, db) = (a.times(x).plus(c[2]), da.times(x).plus(a));
        let (d, dd) = (b.times(x).plus(c[1]), db.times(x).plus(b));
        let (value, slope) = (d.times(x).plus(c[0]), dd.times(x).plus(d));
        if steps > 0 {
            let arrived = F::bits(value.not_above(none)) & walking;
            found |= arrived;
            walking &= !arrived;
        }
        let astray = walking & !F::bits(none.below(value));
        unknown |= astray;
        walking &= !astray;
        // At the lowest point, or past it, without having met zero.
        walking &= !F::bits(slope.times(F::all(end)).not_above(none));
        let next = x.minus(value.over(slope));
        walking &= !F::bits(one.below(next.size()));
        if steps + 1 == MAX_STEPS {
            unknown |= walking;
            break;
        }
        let is_last = next.minus(x).size().below(F::all(LAST_STEP));
        x = F::pick(F::mask(walking), next, x);
        let last = F::bits(is_last) & walking;
        found |= last;
        walking &= !last;
    }
    FromEnd {
        place: x,
        found,
        unknown,
    }
}
