//! Ray packets of four lanes: each ray takes its own steps, bit for bit as by itself, while the orbits are iterated
//! together.
//!
//! Rays that start inside, and rays that would have to continue after a root, take the scalar path.

use super::complex::Function;
use super::exact_packet::ExactQuaternion;
use super::inside_test::{Orbit, Pair, PointStates, Quaternion};
use super::{Fractal, JuliaFractal, LEAST_DISTANCE, Rule, TOLERANCE};
use crate::base::math::simd::vec3::{Vec3Lanes, divide, dot};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::packet::{add, scale};
use crate::scene::shape::packet_search::{NearestQuery4, NearestResult4};

/// Bound on the relative rounding error of a length.
const LOSS: f64 = 1e-9;

/// Kernel that finds the nearest roots of a packet.
pub(super) struct PacketSearch<'a> {
    pub(super) fractal: &'a Fractal,
    pub(super) query: &'a NearestQuery4,
}

/// A packet of rays of unit direction.
struct Rays<F> {
    origin: Vec3Lanes<F>,
    dir: Vec3Lanes<F>,
}

impl JuliaFractal {
    /// True if [`JuliaFractal::nearest_packet`] applies to this fractal.
    pub(crate) fn supports_packets(&self) -> bool {
        self.0.batch_size() > 1
    }

    /// Nearest entries of the active rays of a packet.
    pub(crate) fn nearest_packet(&self, query: &NearestQuery4) -> NearestResult4 {
        let fractal = &self.0;
        with_widest(|lanes| lanes.run(PacketSearch { fractal, query }))
    }
}

impl SimdKernel for PacketSearch<'_> {
    type Output = NearestResult4;

    #[inline(always)]
    fn run<F: F64x4>(self) -> NearestResult4 {
        match self.fractal.rule {
            Rule::QuaternionSquare => {
                self.search_both::<F, Quaternion<F, 2>, ExactQuaternion<F, 2>>()
            }
            Rule::QuaternionCube => {
                self.search_both::<F, Quaternion<F, 3>, ExactQuaternion<F, 3>>()
            }
            Rule::Hypercomplex(Function::Square) => self.search::<F, Pair<F>>(),
            Rule::Hypercomplex(_) => NearestResult4 {
                unknown: self.query.active,
                ..NearestResult4::default()
            },
        }
    }
}

impl PacketSearch<'_> {
    /// Searches the rays that leave the surface to the last bit where that is needed.
    #[inline(always)]
    fn search_both<F: F64Lanes, O: Orbit<F>, E: Orbit<F>>(&self) -> NearestResult4 {
        let mut result = self.search::<F, O>();
        let exact = self.exact_lanes() & !result.unknown;
        if exact != 0 {
            self.search_exactly::<F, E>(exact, &mut result);
        }
        result
    }

    #[inline(always)]
    fn search<F: F64Lanes, O: Orbit<F>>(&self) -> NearestResult4 {
        let (fractal, query) = (self.fractal, self.query);
        let (rays, length) = if fractal.is_hypercomplex() {
            self.unit_rays()
        } else {
            let rays = query.rays::<F>();
            let length = dot(rays.dir, rays.dir).sqrt();
            let unit = Rays {
                origin: rays.origin,
                dir: divide(rays.dir, length),
            };
            (unit, length)
        };
        let closest = -dot(rays.origin, rays.dir);
        let radius_sq = F::splat(fractal.radius * fractal.radius);
        let half_sq = if fractal.is_hypercomplex() {
            radius_sq - dot(rays.origin, rays.origin) + closest * closest
        } else {
            let closest_point = add(rays.origin, scale(rays.dir, closest));
            radius_sq - dot(closest_point, closest_point)
        };
        let half = half_sq.sqrt();
        let (enter, leave) = (closest - half, closest + half);
        let (tolerance, from) = (F::splat(TOLERANCE), F::from_array(&query.from));
        let start = F::select(
            F::mask_from_bits(query.left),
            tolerance,
            (from * length).lane_max(tolerance),
        );
        let mut depth = enter.lane_max(start);
        let mut result = NearestResult4 {
            t: [f64::INFINITY; 4],
            hit_mask: 0,
            // Lanes without a finite start take the scalar path, since they report all roots behind the origin.
            // So do those that leave the surface of a hypercomplex fractal, if the last bit counts there.
            unknown: query.active
                & (!F::bitmask(F::splat(f64::NEG_INFINITY).lt(from))
                    | if fractal.is_exact() && fractal.is_hypercomplex() {
                        query.left
                    } else {
                        0
                    }),
        };
        let is_hit = F::splat(0.0).lt(half_sq) & depth.lt(leave);
        let mut active = F::bitmask(is_hit) & query.active & !result.unknown & !self.exact_lanes();
        // Roots beyond this are not needed.
        let end = F::from_array(&query.far) * length * F::splat(1.0 + LOSS);
        let mut states = self.states::<F, O>(&rays, depth, active);
        result.unknown |= states.inside();
        active &= !states.inside();
        while active != 0 {
            let step = self.steps(&states, active);
            let next = depth + F::from_array(&step);
            let is_done = leave.lt(next) | next.eq(depth);
            active &= !F::bitmask(is_done | end.lt(depth));
            if active == 0 {
                break;
            }
            states = self.states::<F, O>(&rays, next, active);
            let mut changing = states.inside();
            active &= !changing;
            while changing != 0 {
                let lane = changing.trailing_zeros() as usize % 4;
                changing &= changing - 1;
                self.record_root(
                    lane,
                    depth.to_array()[lane],
                    step[lane],
                    enter.to_array()[lane],
                    &mut result,
                );
            }
            depth = next;
        }
        result
    }

    /// The rays as [`Fractal::unit`] rounds them, and the lengths of their directions.
    #[inline(always)]
    fn unit_rays<F: F64Lanes>(&self) -> (Rays<F>, F) {
        let (mut dir, mut lengths) = ([[0.0; 4]; 3], [0.0; 4]);
        for (lane, lane_length) in lengths.iter_mut().enumerate() {
            let (ray, length) = self.fractal.unit(&self.query.ray(lane));
            *lane_length = length;
            for (to, from) in dir.iter_mut().zip(ray.dir.to_array()) {
                to[lane] = from;
            }
        }
        let unit = Rays {
            origin: self.query.rays::<F>().origin,
            dir: dir.map(|axis| F::from_array(&axis)),
        };
        (unit, F::from_array(&lengths))
    }

    /// The state of a point on each active ray.
    #[inline(always)]
    fn states<F: F64Lanes, O: Orbit<F>>(
        &self,
        rays: &Rays<F>,
        depth: F,
        active: u32,
    ) -> PointStates {
        let fractal = self.fractal;
        let [x, y, z] = add(rays.origin, scale(rays.dir, depth));
        let slope = fractal.slope;
        let slope = [F::splat(slope.x), F::splat(slope.y), F::splat(slope.z)];
        let w = F::splat(fractal.offset) + dot(slope, [x, y, z]);
        // As two complex numbers; the fourth coordinate is treated as constant.
        let [i, j, k] = rays.dir;
        let zero = F::splat(0.0);
        let along = [[i - zero, j + k], [i + zero, j - k]];
        fractal.iterate([O::start(fractal, [x, y, z, w], along)], active)
    }

    #[inline(always)]
    pub(super) fn steps(&self, states: &PointStates, active: u32) -> [f64; 4] {
        let mut steps = [0.0; 4];
        let mut lane = 0;
        while lane < 4 {
            if active >> lane & 1 == 1 {
                steps[lane] = self.fractal.step(states, lane);
            }
            lane += 1;
        }
        steps
    }

    /// Records the root of a ray within a step.
    #[inline(never)]
    fn record_root(
        &self,
        lane: usize,
        depth: f64,
        step: f64,
        enter: f64,
        result: &mut NearestResult4,
    ) {
        let query = self.query;
        let (ray, length) = self.fractal.unit(&query.ray(lane));
        let hit_depth = self.fractal.bisect(&ray, depth, step, false);
        let t = hit_depth / length;
        let is_first = if query.left >> lane & 1 == 1 {
            query.from[lane].max(self.fractal.unit * LEAST_DISTANCE) < t
        } else {
            enter < hit_depth
        };
        result.t[lane] = t;
        result.unknown |= u32::from(!is_first) << lane;
        result.hit_mask |= u32::from(is_first && t <= query.far[lane]) << lane;
    }
}
