//! The search to the last bit for packets of four rays that leave a quaternion fractal: each ray takes the steps of
//! [`super::exact`], bit for bit, while the orbits are iterated together.

use super::exact::{SearchPoint, cube_product, hit_within_step, square_product};
use super::inside_test::{Orbit, PointStates, Quaternion};
use super::packet::PacketSearch;
use super::{Fractal, LEAST_DISTANCE, Rule, TOLERANCE};
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{Vec3Lanes, add, from_arrays, scale, to_arrays};
use crate::scene::shape::packet_search::NearestResult4;
use glam::DVec3;

/// Orbits of quaternions with the product from which POV-Ray's distance estimate comes.
#[derive(Clone, Copy)]
pub(super) struct ExactQuaternion<F, const DEGREE: u8> {
    orbit: Quaternion<F, DEGREE>,
    product: [F; 4],
    is_start: bool,
}

impl<F: F64Lanes, const DEGREE: u8> Orbit<F> for ExactQuaternion<F, DEGREE> {
    const DEGREE: f64 = Quaternion::<F, DEGREE>::DEGREE;
    const EXIT_SLACK: f64 = Quaternion::<F, DEGREE>::EXIT_SLACK;

    #[inline(always)]
    fn start(fractal: &Fractal, z: [F; 4], along: [[F; 2]; 2]) -> Self {
        ExactQuaternion {
            orbit: Quaternion::start(fractal, z, along),
            product: z,
            is_start: true,
        }
    }

    #[inline(always)]
    fn norm(&self) -> F {
        self.orbit.norm()
    }

    #[inline(always)]
    fn record(&mut self, _: F) {
        if !self.is_start {
            let z = self.orbit.iterate();
            self.product = match DEGREE {
                2 => square_product(z, self.product),
                _ => cube_product(z, self.product),
            };
        }
        self.is_start = false;
    }

    #[inline(always)]
    fn denominator(&self) -> F {
        let [x, y, z, w] = self.product;
        x * x + y * y + z * z + w * w
    }

    #[inline(always)]
    fn next(self) -> Self {
        ExactQuaternion {
            orbit: self.orbit.next(),
            ..self
        }
    }
}

/// Rays of unit direction, and how far along them the search is.
struct March {
    rays: [Ray; 4],
    /// The lengths of their directions before.
    lengths: [f64; 4],
    depth: [f64; 4],
    point: [[f64; 4]; 3],
    leave: [f64; 4],
    /// Mask of the rays that hit the bounding sphere.
    active: u32,
}

impl PacketSearch<'_> {
    /// The rays that leave the surface and are searched here.
    pub(super) fn exact_lanes(&self) -> u32 {
        let Fractal { rule, .. } = self.fractal;
        match rule {
            Rule::QuaternionSquare | Rule::QuaternionCube if self.fractal.is_exact() => {
                self.query.left & self.query.active
            }
            _ => 0,
        }
    }

    /// Adds the hits of these rays, which leave the surface, to the result.
    #[inline(always)]
    pub(super) fn search_exactly<F: F64Lanes, O: Orbit<F>>(
        &self,
        lanes: u32,
        result: &mut NearestResult4,
    ) {
        let March {
            rays,
            lengths,
            depth,
            point,
            leave,
            mut active,
        } = self.begin(lanes);
        let dir: Vec3Lanes<F> = from_arrays(&[0, 1, 2].map(|axis| rays.map(|ray| ray.dir[axis])));
        let (mut depth, leave) = (F::from_array(&depth), F::from_array(&leave));
        let mut point: Vec3Lanes<F> = from_arrays(&point);
        let mut states = self.exact_states::<F, O>(point, active);
        if states.inside() != 0 {
            // The origin of a ray is mostly inside: the search begins a little ahead.
            let ahead = F::mask_from_bits(states.inside());
            let by = F::select(ahead, F::splat(2.0 * TOLERANCE), F::splat(0.0));
            depth = depth + by;
            let moved = add(point, scale(dir, by));
            point = [0, 1, 2].map(
                #[inline(always)]
                |axis| F::select(ahead, moved[axis], point[axis]),
            );
            states = self.exact_states::<F, O>(point, active);
        }
        result.unknown |= states.inside();
        active &= !states.inside();
        loop {
            active &= F::bitmask(depth.lt(leave));
            let steps = self.steps(&states, active);
            let step = F::from_array(&steps);
            let next = depth + step;
            active &= !F::bitmask(leave.lt(next) | next.eq(depth));
            if active == 0 {
                return;
            }
            let next_point = add(point, scale(dir, step));
            states = self.exact_states::<F, O>(next_point, active);
            let mut changing = states.inside();
            active &= !changing;
            while changing != 0 {
                let lane = changing.trailing_zeros() as usize % 4;
                changing &= changing - 1;
                let from = SearchPoint {
                    depth: depth.to_array()[lane],
                    point: DVec3::from(to_arrays(point).map(|axis| axis[lane])),
                };
                let depth = hit_within_step(self.fractal, rays[lane], from, steps[lane]);
                let t = depth / lengths[lane];
                let least = self.query.from[lane].max(self.fractal.unit * LEAST_DISTANCE);
                let is_hit = least < t && t < self.query.far[lane];
                result.t[lane] = t;
                result.hit_mask |= u32::from(is_hit) << lane;
            }
            (depth, point) = (next, next_point);
        }
    }

    /// Where the search of some rays begins.
    fn begin(&self, lanes: u32) -> March {
        let mut march = March {
            rays: [0, 1, 2, 3].map(|lane| self.query.ray(lane)),
            lengths: [1.0; 4],
            depth: [0.0; 4],
            point: [[0.0; 4]; 3],
            leave: [0.0; 4],
            active: 0,
        };
        for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
            let (ray, length) = self.fractal.exact_unit(&march.rays[lane]);
            let Some((enter, leave)) = self.fractal.exact_chord(&ray) else {
                continue;
            };
            let depth = enter.max(TOLERANCE);
            for (axis, x) in ray.at(depth).to_array().into_iter().enumerate() {
                march.point[axis][lane] = x;
            }
            (march.rays[lane], march.lengths[lane]) = (ray, length);
            (march.depth[lane], march.leave[lane]) = (depth, leave);
            march.active |= 1 << lane;
        }
        march
    }

    /// The state of a point on each active ray.
    #[inline(always)]
    fn exact_states<F: F64Lanes, O: Orbit<F>>(
        &self,
        point: Vec3Lanes<F>,
        active: u32,
    ) -> PointStates {
        let [x, y, z] = point;
        let Fractal {
            slice, distance, ..
        } = *self.fractal;
        let splat = F::splat;
        let w = splat(distance) - splat(slice.x) * x - splat(slice.y) * y - splat(slice.z) * z;
        let start = [x, y, z, w / splat(slice.w)];
        let nowhere = [[splat(0.0); 2]; 2];
        self.fractal
            .iterate([O::start(self.fractal, start, nowhere)], active)
    }
}
