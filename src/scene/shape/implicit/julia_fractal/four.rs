//! Four rays and a fractal at once: each goes its own steps, to the bit as by itself, while their orbits are followed
//! together.
//!
//! Rays that start inside, and those that would have to go on behind a root, are left to be asked for singly.

use super::complex::Function;
use super::places::{Orbit, Pair, Places, Quaternion};
use super::{Fractal, JuliaFractal, LEAST_WAY, Rule, TOLERANCE, unit};
use crate::base::math::simd::vec3::{Vec3Lanes, divide, dot};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::packet::{add, scale};
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
        with_widest(|lanes| lanes.run(Following { fractal, asked }))
    }
}

impl SimdKernel for Following<'_> {
    type Output = FourFound;

    #[inline(always)]
    fn run<F: F64x4>(self) -> FourFound {
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
        let length = dot(rays.dir, rays.dir).sqrt();
        let rays = Rays {
            origin: rays.origin,
            dir: divide(rays.dir, length),
        };
        let middle = -dot(rays.origin, rays.dir);
        let nearest = add(rays.origin, scale(rays.dir, middle));
        let half_sq = F::splat(fractal.radius * fractal.radius) - dot(nearest, nearest);
        let half = half_sq.sqrt();
        let (enter, leave) = (middle - half, middle + half);
        let (least, from) = (F::splat(TOLERANCE), F::from_array(&asked.from));
        let start = F::select(
            F::mask_from_bits(asked.left),
            least,
            (from * length).lane_max(least),
        );
        let mut depth = enter.lane_max(start);
        let mut found = FourFound {
            t: [f64::INFINITY; 4],
            met: 0,
            // Those whose start is no number go back to all that is behind them.
            unknown: asked.there & !F::bitmask(F::splat(f64::NEG_INFINITY).lt(from)),
        };
        let is_met = F::splat(0.0).lt(half_sq) & depth.lt(leave);
        let mut going = F::bitmask(is_met) & asked.there & !found.unknown;
        // Behind this no root is wanted.
        let end = F::from_array(&asked.far) * length * F::splat(1.0 + LOSS);
        let mut places = self.places::<F, O>(&rays, depth, going);
        found.unknown |= places.inside();
        going &= !places.inside();
        while going != 0 {
            let step = self.steps(&places, going);
            let next = depth + F::from_array(&step);
            let is_over = leave.lt(next) | next.eq(depth);
            going &= !F::bitmask(is_over | end.lt(depth));
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
                    (depth.to_array()[lane], step[lane]),
                    enter.to_array()[lane],
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
        let [x, y, z] = add(rays.origin, scale(rays.dir, depth));
        let slope = fractal.slope;
        let slope = [F::splat(slope.x), F::splat(slope.y), F::splat(slope.z)];
        let w = F::splat(fractal.offset) + dot(slope, [x, y, z]);
        // As two complex numbers; the fourth coordinate is taken as if it stood still.
        let [i, j, k] = rays.dir;
        let none = F::splat(0.0);
        let along = [[i - none, j + k], [i + none, j - k]];
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
