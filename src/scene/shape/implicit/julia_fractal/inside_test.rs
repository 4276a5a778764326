//! Inside test and step length at points of a ray: eight points at once for quaternions and hypercomplex
//! squares, whose chain of products and sums takes no longer for eight than for one.

use super::complex::Function;
use super::{Fractal, MAX_STEP_RATIO, Rule, TOLERANCE};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::base::math::{Complex, Ray};
use glam::{DVec3, DVec4};

/// Points evaluated together.
pub(super) const BATCH: usize = 8;

/// State of a point: inside or not, and the next step of a ray from it.
#[derive(Clone, Copy)]
pub(super) struct PointState {
    pub(super) is_inside: bool,
    pub(super) step: f64,
}

/// States of a batch of points: how their iterations ended.
pub(super) struct PointStates {
    /// Bit mask of the points whose orbit stays in the bounding sphere.
    inside_mask: u32,
    /// For the other points, the squared norm at which the orbit leaves the sphere.
    norms: [f64; BATCH],
    /// The denominator of the distance estimate there, see [`Orbit::denominator`].
    denominators: [f64; BATCH],
    /// One over the degree of all iterations until there.
    scales: [f64; BATCH],
}

impl PointStates {
    /// All orbits leave the sphere, without further data.
    const ESCAPED: PointStates = PointStates {
        inside_mask: 0,
        norms: [0.0; BATCH],
        denominators: [0.0; BATCH],
        scales: [0.0; BATCH],
    };

    /// Bit mask of the points that are inside.
    pub(super) fn inside(&self) -> u32 {
        self.inside_mask
    }

    pub(super) fn is_inside(&self, number: usize) -> bool {
        self.inside_mask >> number & 1 == 1
    }
}

impl Fractal {
    /// Number of points that [`Self::states`] evaluates.
    pub(super) fn batch_size(&self) -> usize {
        if self.scalar_function().is_some() {
            1
        } else {
            BATCH
        }
    }

    /// The function of an iteration, if it has no kernel.
    pub(super) fn scalar_function(&self) -> Option<Function> {
        match self.rule {
            Rule::Hypercomplex(function) if function != Function::Square => Some(function),
            _ => None,
        }
    }

    /// States of the first points of `depths` on a ray of unit direction.
    pub(super) fn states(&self, ray: &Ray, depths: &[f64; BATCH]) -> PointStates {
        if let Some(function) = self.scalar_function() {
            let is_inside = self.is_bounded(function, ray.at(depths[0]));
            return PointStates {
                inside_mask: u32::from(is_inside),
                ..PointStates::ESCAPED
            };
        }
        let mut starts = [[0.0; BATCH]; 4];
        for (number, &depth) in depths.iter().enumerate() {
            for (axis, x) in self.start(ray.at(depth)).to_array().into_iter().enumerate() {
                starts[axis][number] = x;
            }
        }
        self.states_of(&starts, ray.dir)
    }

    /// States of the points of a ray in this direction from which these numbers come, for rules with a kernel.
    pub(super) fn states_of(&self, starts: &[[f64; BATCH]; 4], dir: DVec3) -> PointStates {
        let along = to_complex_pair(dir.extend(0.0));
        with_widest(
            #[inline(always)]
            |lanes| {
                let kernel = OrbitKernel {
                    fractal: self,
                    starts,
                    along,
                };
                lanes.run(kernel)
            },
        )
    }

    /// The inside test of POV-Ray.
    fn is_bounded(&self, function: Function, point: DVec3) -> bool {
        let mut z = self.tested_start(point);
        (1..=self.max_iteration).all(|iteration| {
            let is_bounded = self.is_in_sphere(z);
            if is_bounded && iteration < self.max_iteration {
                z = self.next(function, to_complex_pair(z));
            }
            is_bounded
        })
    }

    /// The number at a point from which the inside test starts.
    pub(super) fn tested_start(&self, point: DVec3) -> DVec4 {
        self.start(if self.tests_y_as_z {
            point.with_z(point.y)
        } else {
            point
        })
    }

    pub(super) fn is_in_sphere(&self, z: DVec4) -> bool {
        z.length_squared() <= self.radius * self.radius
    }

    /// An iteration.
    pub(super) fn next(&self, function: Function, z: [Complex; 2]) -> DVec4 {
        from_complex_pair(z.map(|z| function.value(z))) + self.c
    }

    /// State at a point of a ray of unit direction in the search for a change.
    fn searched_state(&self, function: Function, ray: &Ray, depth: f64) -> PointState {
        let mut z = self.start(ray.at(depth));
        let mut slope = to_complex_pair(z);
        for iteration in 0..self.max_iteration {
            let pair = to_complex_pair(z);
            if !self.is_in_sphere(z) {
                let rise = gradient(pair, slope).dot(ray.dir);
                return PointState {
                    is_inside: false,
                    step: self.useful_step(z.length_squared() / (-2.0 * rise)),
                };
            }
            if iteration > 0 {
                slope = [0, 1].map(|i| slope[i] * function.factor(pair[i]));
            }
            if iteration + 1 < self.max_iteration {
                z = self.next(function, pair);
            }
        }
        PointState {
            is_inside: true,
            step: self.min_step,
        }
    }

    /// The step outside a hypercomplex fractal: `step` where the ray approaches the set, otherwise the minimum step.
    pub(super) fn useful_step(&self, step: f64) -> f64 {
        let is_useful = self.min_step < step && step < MAX_STEP_RATIO * self.min_step;
        if is_useful { step } else { self.min_step }
    }

    /// Step length of a ray from a point.
    pub(super) fn step(&self, states: &PointStates, number: usize) -> f64 {
        let (norm, denominator) = (states.norms[number], states.denominators[number]);
        match self.rule {
            _ if states.is_inside(number) => self.min_step,
            Rule::Hypercomplex(_) => self.useful_step(norm / denominator.max(TOLERANCE)),
            Rule::QuaternionSquare | Rule::QuaternionCube => {
                let distance = states.scales[number] * (norm / denominator).sqrt() * norm.ln();
                distance.max(self.min_step)
            }
        }
    }
}

/// A hypercomplex number as two complex numbers.
pub(super) fn to_complex_pair(z: DVec4) -> [Complex; 2] {
    [
        Complex::new(z.x - z.w, z.y + z.z),
        Complex::new(z.x + z.w, z.y - z.z),
    ]
}

fn from_complex_pair([a, b]: [Complex; 2]) -> DVec4 {
    0.5 * DVec4::new(a.re + b.re, a.im + b.im, a.im - b.im, b.re - a.re)
}

/// The gradient of half the squared norm of `z`, if `slope` is the derivative.
pub(super) fn gradient(z: [Complex; 2], slope: [Complex; 2]) -> DVec3 {
    from_complex_pair([0, 1].map(|i| z[i] * slope[i].conjugate())).truncate()
}

/// States of points ahead on a ray, evaluated in batches as if each step were the minimum step.
pub(super) struct Lookahead<'f> {
    fractal: &'f Fractal,
    ray: &'f Ray,
    depths: [f64; BATCH],
    states: PointStates,
    next: usize,
}

impl<'f> Lookahead<'f> {
    pub(super) fn new(fractal: &'f Fractal, ray: &'f Ray) -> Self {
        Lookahead {
            fractal,
            ray,
            depths: [f64::NAN; BATCH],
            states: PointStates::ESCAPED,
            next: 0,
        }
    }

    /// The state at `depth`.
    pub(super) fn state_at(&mut self, depth: f64) -> PointState {
        if let Some(function) = self.fractal.scalar_function() {
            return self.fractal.searched_state(function, self.ray, depth);
        }
        if self.next == self.fractal.batch_size() || self.depths[self.next] != depth {
            let mut next = depth;
            for depth in &mut self.depths {
                *depth = next;
                next += self.fractal.min_step;
            }
            self.states = self.fractal.states(self.ray, &self.depths);
            self.next = 0;
        }
        let number = self.next;
        self.next += 1;
        PointState {
            is_inside: self.states.is_inside(number),
            step: self.fractal.step(&self.states, number),
        }
    }
}

/// Orbits of four numbers, one per lane.
pub(super) trait Orbit<F: F64Lanes>: Copy {
    const DEGREE: f64;
    /// Added to the squared radius of the bounding sphere for the exit test.
    const EXIT_SLACK: f64;
    /// Starts from the four components; `along` is the derivative along the ray as two complex numbers.
    fn start(fractal: &Fractal, z: [F; 4], along: [[F; 2]; 2]) -> Self;
    fn norm(&self) -> F;
    /// Records the squared norm of the current iterate.
    fn record(&mut self, norm: F);
    fn denominator(&self) -> F;
    fn next(self) -> Self;
}

struct OrbitKernel<'f> {
    fractal: &'f Fractal,
    starts: &'f [[f64; BATCH]; 4],
    along: [Complex; 2],
}

impl OrbitKernel<'_> {
    #[inline(always)]
    fn load_packet<F: F64Lanes>(&self, axis: usize, first: usize) -> F {
        let component = &self.starts[axis];
        F::from_array(&[
            component[first],
            component[first + 1],
            component[first + 2],
            component[first + 3],
        ])
    }

    #[inline(always)]
    fn iterate<F: F64Lanes, O: Orbit<F>>(&self) -> PointStates {
        let orbits = [self.orbit(0), self.orbit(4)];
        self.fractal.iterate::<F, O, 2>(orbits, 0xff)
    }

    // Written out: a closure would not be compiled for the wide lanes.
    #[inline(always)]
    fn orbit<F: F64Lanes, O: Orbit<F>>(&self, first: usize) -> O {
        let [i, k] = self.along;
        let z = [
            self.load_packet(0, first),
            self.load_packet(1, first),
            self.load_packet(2, first),
            self.load_packet(3, first),
        ];
        let along = [
            [F::splat(i.re), F::splat(i.im)],
            [F::splat(k.re), F::splat(k.im)],
        ];
        O::start(self.fractal, z, along)
    }
}

impl Fractal {
    /// Iterates the orbits of the `active` points, in one or two packets.
    #[inline(always)]
    pub(super) fn iterate<F: F64Lanes, O: Orbit<F>, const PACKETS: usize>(
        &self,
        mut orbits: [O; PACKETS],
        active: u32,
    ) -> PointStates {
        let radius_sq = self.radius * self.radius;
        let exit_sq = F::splat(radius_sq + O::EXIT_SLACK);
        let mut states = PointStates {
            inside_mask: active,
            ..PointStates::ESCAPED
        };
        let mut scale = 1.0;
        let mut iteration = 0;
        while iteration < self.max_iteration {
            scale /= O::DEGREE;
            let mut packet = 0;
            while packet < PACKETS {
                let orbit = &mut orbits[packet];
                let norm = orbit.norm();
                orbit.record(norm);
                let inside_mask = F::bitmask(norm.le(exit_sq));
                let leaving = states.inside_mask >> (4 * packet) & 0b1111 & !inside_mask;
                if leaving != 0 {
                    states.inside_mask &= !(leaving << (4 * packet));
                    let (norms, denominators) = (norm.to_array(), orbit.denominator().to_array());
                    let mut lane = 0;
                    while lane < 4 {
                        if leaving >> lane & 1 == 1 {
                            states.norms[4 * packet + lane] = norms[lane];
                            states.denominators[4 * packet + lane] = denominators[lane];
                            states.scales[4 * packet + lane] = scale;
                        }
                        lane += 1;
                    }
                }
                packet += 1;
            }
            if states.inside_mask == 0 {
                break;
            }
            let mut packet = 0;
            while packet < PACKETS {
                orbits[packet] = orbits[packet].next();
                packet += 1;
            }
            iteration += 1;
        }
        states
    }
}

impl SimdKernel for OrbitKernel<'_> {
    type Output = PointStates;

    #[inline(always)]
    fn run<F: F64x4>(self) -> PointStates {
        match self.fractal.rule {
            Rule::QuaternionSquare => self.iterate::<F, Quaternion<F, 2>>(),
            Rule::QuaternionCube => self.iterate::<F, Quaternion<F, 3>>(),
            Rule::Hypercomplex(_) => self.iterate::<F, Pair<F>>(),
        }
    }
}

/// Quaternions under squaring or cubing.
#[derive(Clone, Copy)]
pub(super) struct Quaternion<F, const DEGREE: u8> {
    z: [F; 4],
    c: [F; 4],
    /// Product of the squared norms of all iterates.
    norm_product: F,
}

impl<F: F64Lanes, const DEGREE: u8> Quaternion<F, DEGREE> {
    /// The current iterates.
    #[inline(always)]
    pub(super) fn iterate(&self) -> [F; 4] {
        self.z
    }
}

impl<F: F64Lanes, const DEGREE: u8> Orbit<F> for Quaternion<F, DEGREE> {
    const DEGREE: f64 = DEGREE as f64;
    const EXIT_SLACK: f64 = TOLERANCE;

    #[inline(always)]
    fn start(fractal: &Fractal, z: [F; 4], _: [[F; 2]; 2]) -> Self {
        let c = fractal.c;
        Quaternion {
            z,
            c: [F::splat(c.x), F::splat(c.y), F::splat(c.z), F::splat(c.w)],
            norm_product: F::splat(1.0),
        }
    }

    #[inline(always)]
    fn norm(&self) -> F {
        let [x, y, z, w] = self.z;
        x * x + (y * y + z * z + w * w)
    }

    #[inline(always)]
    fn record(&mut self, norm: F) {
        self.norm_product = self.norm_product * norm;
    }

    #[inline(always)]
    fn denominator(&self) -> F {
        self.norm_product
    }

    #[inline(always)]
    fn next(self) -> Self {
        let [x, y, z, w] = self.z;
        let x_sq = x * x;
        let v_sq = y * y + z * z + w * w;
        let (real, factor) = if DEGREE == 2 {
            (x_sq - v_sq, F::splat(2.0) * x)
        } else {
            let three = F::splat(3.0);
            let real = x * (x_sq - three * v_sq);
            (real, three * x_sq - v_sq)
        };
        Quaternion {
            z: [
                real + self.c[0],
                factor * y + self.c[1],
                factor * z + self.c[2],
                factor * w + self.c[3],
            ],
            ..self
        }
    }
}

/// Hypercomplex numbers under squaring, as two complex numbers.
#[derive(Clone, Copy)]
pub(super) struct Pair<F> {
    z: [[F; 2]; 2],
    c: [[F; 2]; 2],
    /// Derivative along the ray.
    along: [[F; 2]; 2],
    /// True for the start, whose derivative is that of the next iterate.
    is_start: bool,
    norm: F,
}

impl<F: F64Lanes> Orbit<F> for Pair<F> {
    const DEGREE: f64 = 1.0;
    const EXIT_SLACK: f64 = 0.0;

    #[inline(always)]
    fn start(fractal: &Fractal, [x, y, z, w]: [F; 4], along: [[F; 2]; 2]) -> Self {
        let [a, b] = to_complex_pair(fractal.c);
        Pair {
            z: [[x - w, y + z], [x + w, y - z]],
            c: [
                [F::splat(a.re), F::splat(a.im)],
                [F::splat(b.re), F::splat(b.im)],
            ],
            along: [
                derivative_step([x - w, y + z], along[0]),
                derivative_step([x + w, y - z], along[1]),
            ],
            is_start: true,
            // As POV-Ray rounds it: a search begins on the sphere.
            norm: (x * x + w * w) + (y * y + z * z),
        }
    }

    #[inline(always)]
    fn norm(&self) -> F {
        self.norm
    }

    #[inline(always)]
    fn record(&mut self, _: F) {}

    /// The rate at which half the squared norm falls along the ray.
    #[inline(always)]
    fn denominator(&self) -> F {
        let [[a, b], [c, d]] = self.z;
        let [[e, f], [g, h]] = self.along;
        let first = -(a * e + b * f);
        let second = -(c * g + d * h);
        first + second
    }

    #[inline(always)]
    fn next(self) -> Self {
        let z = [
            square_step(self.z[0], self.c[0]),
            square_step(self.z[1], self.c[1]),
        ];
        let [[a, b], [c, d]] = z;
        let first = a * a + b * b;
        let second = c * c + d * d;
        Pair {
            z,
            norm: F::splat(0.5) * (first + second),
            along: if self.is_start {
                self.along
            } else {
                [
                    derivative_step(self.z[0], self.along[0]),
                    derivative_step(self.z[1], self.along[1]),
                ]
            },
            is_start: false,
            ..self
        }
    }
}

#[inline(always)]
fn square_step<F: F64Lanes>([re, im]: [F; 2], [a, b]: [F; 2]) -> [F; 2] {
    let across = re * im;
    [re * re - im * im + a, across + across + b]
}

#[inline(always)]
fn derivative_step<F: F64Lanes>([re, im]: [F; 2], [a, b]: [F; 2]) -> [F; 2] {
    let (re, im) = (re + re, im + im);
    [re * a - im * b, re * b + im * a]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_agree_with_single_points() {
        let rules = [
            Rule::QuaternionSquare,
            Rule::QuaternionCube,
            Rule::Hypercomplex(Function::Square),
        ];
        for rule in rules {
            let fractal = Fractal {
                c: DVec4::new(-0.1, 0.6, 0.2, -0.2),
                rule,
                max_iteration: 9,
                min_step: 0.05,
                slice: DVec4::W,
                distance: 0.1,
                slope: DVec3::new(0.1, 0.0, 0.2),
                offset: 0.1,
                radius: 2.0,
                tests_y_as_z: false,
                unit: 1.0,
                is_moved: false,
                normalization: crate::base::math::Normalization::default(),
            };
            let ray = Ray::new(DVec3::new(-1.5, 0.1, 0.2), DVec3::new(0.6, 0.0, 0.8));
            let depths = [0, 1, 2, 3, 4, 5, 6, 7].map(|number| 0.4 * f64::from(number));
            let batch = fractal.states(&ray, &depths);
            for (number, &depth) in depths.iter().enumerate() {
                let alone = fractal.states(&ray, &[depth; BATCH]);
                assert_eq!(batch.is_inside(number), alone.is_inside(0));
                assert_eq!(fractal.step(&batch, number), fractal.step(&alone, 0));
            }
        }
    }
}
