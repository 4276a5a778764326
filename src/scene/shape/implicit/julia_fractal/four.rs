//! Four rays and a fractal at once: each goes its own steps, to the bit as by itself, while their orbits are followed
//! together.
//!
//! Rays that start inside, and those that would have to go on behind a root, are left to be asked for singly.

use super::complex::Function;
use super::places::{Orbit, Pair, Places, Quaternion};
use super::{Fractal, JuliaFractal, LEAST_WAY, Rule, TOLERANCE, unit};
use crate::base::math::simd::three::{Vec3Lanes, dot, over};
use crate::base::math::simd::{F64Lanes, F64x4, FourKernel, four, with_widest};
use crate::scene::shape::packet::{plus, scaled};
use crate::scene::shape::packet_search::{FourAsked, FourFound};

/// What a length may lose by rounding.
const LOSS: f64 = 1e-9;

struct Following<'a> {
    fractal: &'a Fractal,
    asked: &'a FourAsked,
}

/// Four rays of unit direction.
struct Rays<F> {
    origin: Vec3Lanes<F>,
    dir: Vec3Lanes<F>,
}

impl JuliaFractal {
    /// Whether it can be asked for four rays at once.
    pub(crate) fn has_four(&self) -> bool {
        self.0.together() > 1
    }

    /// Where those of four rays that are asked for enter it.
    pub(crate) fn nearest_of_four(&self, asked: &FourAsked) -> FourFound {
        let fractal = &self.0;
        with_widest(|lanes| four(lanes, &Following { fractal, asked }))
    }
}

impl FourKernel for Following<'_> {
    type Answer = FourFound;

    #[inline(always)]
    fn run<F: F64x4>(&self) -> FourFound {
        match self.fractal.rule {
            Rule::QuaternionSquare => self.follow::<F, Quaternion<F, 2>>(),
            Rule::QuaternionCube => self.follow::<F, Quaternion<F, 3>>(),
            Rule::Hypercomplex(Function::Square) => self.follow::<F, Pair<F>>(),
            Rule::Hypercomplex(_) => FourFound {
                unknown: self.asked.there,
                ..FourFound::default()
            },
        }
    }
}

impl Following<'_> {
    #[inline(always)]
    fn follow<F: F64Lanes, O: Orbit<F>>(&self) -> FourFound {
        let (fractal, asked) = (self.fractal, self.asked);
        let rays = asked.rays::<F>();
        let length = dot(rays.dir, rays.dir).root();
        let rays = Rays {
            origin: rays.origin,
            dir: over(rays.dir, length),
        };
        let middle = dot(rays.origin, rays.dir).negated();
        let nearest = plus(rays.origin, scaled(rays.dir, middle));
        let half_sq = F::all(fractal.radius * fractal.radius).minus(dot(nearest, nearest));
        let half = half_sq.root();
        let (enter, leave) = (middle.minus(half), middle.plus(half));
        let (least, from) = (F::all(TOLERANCE), F::load(&asked.from));
        let start = F::pick(F::mask(asked.left), least, from.times(length).larger(least));
        let mut depth = enter.larger(start);
        let mut found = FourFound {
            t: [f64::INFINITY; 4],
            met: 0,
            // Those whose start is no number go back to all that is behind them.
            unknown: asked.there & !F::bits(F::all(f64::NEG_INFINITY).below(from)),
        };
        let is_met = F::both(F::all(0.0).below(half_sq), depth.below(leave));
        let mut going = F::bits(is_met) & asked.there & !found.unknown;
        // Behind this no root is wanted.
        let end = F::load(&asked.far).times(length).times(F::all(1.0 + LOSS));
        let mut places = self.places::<F, O>(&rays, depth, going);
        found.unknown |= places.inside();
        going &= !places.inside();
        while going != 0 {
            let step = self.steps(&places, going);
            let next = depth.plus(F::load(&step));
            let is_over = F::either(leave.below(next), next.equals(depth));
            going &= !F::bits(F::either(is_over, end.below(depth)));
            if going == 0 {
                break;
            }
            places = self.places::<F, O>(&rays, next, going);
            let mut changing = places.inside();
            going &= !changing;
            while changing != 0 {
                let lane = changing.trailing_zeros() as usize % 4;
                changing &= changing - 1;
                self.meet(
                    lane,
                    (depth.store()[lane], step[lane]),
                    enter.store()[lane],
                    &mut found,
                );
            }
            depth = next;
        }
        found
    }

    /// What is known of a place on each ray that is going.
    #[inline(always)]
    fn places<F: F64Lanes, O: Orbit<F>>(&self, rays: &Rays<F>, depth: F, going: u32) -> Places {
        let fractal = self.fractal;
        let [x, y, z] = plus(rays.origin, scaled(rays.dir, depth));
        let slope = fractal.slope;
        let slope = [F::all(slope.x), F::all(slope.y), F::all(slope.z)];
        let w = F::all(fractal.offset).plus(dot(slope, [x, y, z]));
        // As two complex numbers; the fourth coordinate is taken as if it stood still.
        let [i, j, k] = rays.dir;
        let none = F::all(0.0);
        let along = [[i.minus(none), j.plus(k)], [i.plus(none), j.minus(k)]];
        fractal.iterate([O::start(fractal, [x, y, z, w], along)], going)
    }

    #[inline(always)]
    fn steps(&self, places: &Places, going: u32) -> [f64; 4] {
        let mut steps = [0.0; 4];
        let mut lane = 0;
        while lane < 4 {
            if going >> lane & 1 == 1 {
                steps[lane] = self.fractal.step(places, lane);
            }
            lane += 1;
        }
        steps
    }

    /// Notes the root of a ray within a step.
    #[inline(never)]
    fn meet(&self, lane: usize, (depth, step): (f64, f64), enter: f64, found: &mut FourFound) {
        let asked = self.asked;
        let (ray, length) = unit(&asked.ray(lane));
        let place = self.fractal.halve(&ray, depth, step, false);
        let t = place / length;
        let is_first = if asked.left >> lane & 1 == 1 {
            asked.from[lane].max(self.fractal.unit * LEAST_WAY) < t
        } else {
            enter < place
        };
        found.t[lane] = t;
        found.unknown |= u32::from(!is_first) << lane;
        found.met |= u32::from(is_first && t <= asked.far[lane]) << lane;
    }
}
