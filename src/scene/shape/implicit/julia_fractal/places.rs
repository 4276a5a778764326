//! What is known of places on a ray: eight at once where the fractal is made by squares and cubes, whose chain of products
//! and sums takes no longer for eight than for one.

use super::complex::{Complex, Function};
use super::{Fractal, MOST_LEAST_STEPS, Rule, TOLERANCE};
use crate::base::math::Ray;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use glam::DVec4;

/// So many places are looked at together.
pub(super) const TOGETHER: usize = 8;

/// What is known of a place: whether it is inside, and how far a ray may go from it.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) is_inside: bool,
    pub(super) step: f64,
}

/// What is known of some places: how their iterations ended.
pub(super) struct Places {
    /// One bit for each place that stays in the ball.
    staying: u32,
    /// Of those that leave it, the square of the distance from the origin where they do.
    norms: [f64; TOGETHER],
    /// What the orbit tells there.
    told: [f64; TOGETHER],
    /// One over the degree of all that was done until there.
    scales: [f64; TOGETHER],
}

impl Places {
    /// None: all leave the ball, and nothing is told of that.
    const NOTHING: Places = Places {
        staying: 0,
        norms: [0.0; TOGETHER],
        told: [0.0; TOGETHER],
        scales: [0.0; TOGETHER],
    };

    /// Which places are inside, one bit each.
    pub(super) fn inside(&self) -> u32 {
        self.staying
    }

    pub(super) fn is_inside(&self, number: usize) -> bool {
        self.staying >> number & 1 == 1
    }
}

impl Fractal {
    /// How many places [`Self::places`] looks at.
    pub(super) fn together(&self) -> usize {
        match self.rule {
            Rule::QuaternionSquare
            | Rule::QuaternionCube
            | Rule::Hypercomplex(Function::Square) => TOGETHER,
            Rule::Hypercomplex(_) => 1,
        }
    }

    /// What is known of the first places of these on a ray of unit direction.
    pub(super) fn places(&self, ray: &Ray, depths: &[f64; TOGETHER]) -> Places {
        if let Rule::Hypercomplex(function) = self.rule
            && function != Function::Square
        {
            let is_inside = self.stays(self.start(ray.at(depths[0])), function);
            return Places {
                staying: u32::from(is_inside),
                ..Places::NOTHING
            };
        }
        let mut starts = [[0.0; TOGETHER]; 4];
        for (number, &depth) in depths.iter().enumerate() {
            for (axis, x) in self.start(ray.at(depth)).to_array().into_iter().enumerate() {
                starts[axis][number] = x;
            }
        }
        let along = split(ray.dir.extend(0.0));
        with_widest(
            #[inline(always)]
            |lanes| {
                let iterating = Iterating {
                    fractal: self,
                    starts: &starts,
                    along,
                };
                lanes.run(iterating)
            },
        )
    }

    /// Whether a hypercomplex number stays in the ball.
    fn stays(&self, start: DVec4, function: Function) -> bool {
        let exit = self.radius * self.radius;
        let (mut z, c) = (split(start), split(self.c));
        for _ in 0..self.max_iteration {
            let norm = 0.5 * (z[0].norm_sq() + z[1].norm_sq());
            if norm > exit || norm.is_nan() {
                return false;
            }
            z = [0, 1].map(|i| function.value(z[i]) + c[i]);
        }
        true
    }

    /// How far a ray may go from a place.
    pub(super) fn step(&self, places: &Places, number: usize) -> f64 {
        let (norm, told) = (places.norms[number], places.told[number]);
        match self.rule {
            _ if places.is_inside(number) => self.least,
            Rule::Hypercomplex(Function::Square) => {
                // Only where the ray comes nearer.
                let step = norm / told.max(TOLERANCE);
                let is_useful = self.least < step && step < MOST_LEAST_STEPS * self.least;
                if is_useful { step } else { self.least }
            }
            Rule::Hypercomplex(_) => self.least,
            Rule::QuaternionSquare | Rule::QuaternionCube => {
                let distance = places.scales[number] * (norm / told).sqrt() * norm.ln();
                distance.max(self.least)
            }
        }
    }
}

/// A hypercomplex number as two complex ones.
pub(super) fn split(z: DVec4) -> [Complex; 2] {
    [
        Complex::new(z.x - z.w, z.y + z.z),
        Complex::new(z.x + z.w, z.y - z.z),
    ]
}

/// The places on the way of a ray, looked at in advance as if each step were the least.
pub(super) struct Ahead<'f> {
    fractal: &'f Fractal,
    ray: &'f Ray,
    depths: [f64; TOGETHER],
    places: Places,
    next: usize,
}

impl<'f> Ahead<'f> {
    pub(super) fn new(fractal: &'f Fractal, ray: &'f Ray) -> Self {
        Ahead {
            fractal,
            ray,
            depths: [f64::NAN; TOGETHER],
            places: Places::NOTHING,
            next: 0,
        }
    }

    /// What is known of a place.
    pub(super) fn place(&mut self, depth: f64) -> Place {
        if self.next == self.fractal.together() || self.depths[self.next] != depth {
            let mut next = depth;
            for depth in &mut self.depths {
                *depth = next;
                next += self.fractal.least;
            }
            self.places = self.fractal.places(self.ray, &self.depths);
            self.next = 0;
        }
        let number = self.next;
        self.next += 1;
        Place {
            is_inside: self.places.is_inside(number),
            step: self.fractal.step(&self.places, number),
        }
    }
}

/// Four numbers that are iterated.
pub(super) trait Orbit<F: F64Lanes>: Copy {
    const DEGREE: f64;
    /// How much farther than the ball, in squares, an orbit may stay.
    const BEYOND: f64;
    /// From the real and imaginary parts, along rays on which they change by `along` as two complex numbers.
    fn start(fractal: &Fractal, z: [F; 4], along: [[F; 2]; 2]) -> Self;
    fn norm(&self) -> F;
    /// Notes the square of the distance from the origin.
    fn passes(&mut self, norm: F);
    fn told(&self) -> F;
    fn next(self) -> Self;
}

struct Iterating<'f> {
    fractal: &'f Fractal,
    starts: &'f [[f64; TOGETHER]; 4],
    along: [Complex; 2],
}

impl Iterating<'_> {
    #[inline(always)]
    fn four<F: F64Lanes>(&self, axis: usize, first: usize) -> F {
        let row = &self.starts[axis];
        F::from_array(&[row[first], row[first + 1], row[first + 2], row[first + 3]])
    }

    #[inline(always)]
    fn iterate<F: F64Lanes, O: Orbit<F>>(&self) -> Places {
        let orbits = [self.orbit(0), self.orbit(4)];
        self.fractal.iterate::<F, O, 2>(orbits, 0xff)
    }

    // Spelt out: a closure would not take part in the wide lanes.
    #[inline(always)]
    fn orbit<F: F64Lanes, O: Orbit<F>>(&self, first: usize) -> O {
        let [i, k] = self.along;
        let z = [
            self.four(0, first),
            self.four(1, first),
            self.four(2, first),
            self.four(3, first),
        ];
        let along = [
            [F::splat(i.re), F::splat(i.im)],
            [F::splat(k.re), F::splat(k.im)],
        ];
        O::start(self.fractal, z, along)
    }
}

impl Fractal {
    /// Follows the orbits of some of four or eight places, marked by a bit each.
    #[inline(always)]
    pub(super) fn iterate<F: F64Lanes, O: Orbit<F>, const FOURS: usize>(
        &self,
        mut orbits: [O; FOURS],
        marked: u32,
    ) -> Places {
        let ball = self.radius * self.radius;
        let exit = F::splat(ball + O::BEYOND);
        let mut places = Places {
            staying: marked,
            ..Places::NOTHING
        };
        let mut scale = 1.0;
        let mut number = 0;
        while number < self.max_iteration {
            scale /= O::DEGREE;
            let mut part = 0;
            while part < FOURS {
                let orbit = &mut orbits[part];
                let norm = orbit.norm();
                orbit.passes(norm);
                let staying = F::bitmask(norm.le(exit));
                let leaving = places.staying >> (4 * part) & 0b1111 & !staying;
                if leaving != 0 {
                    places.staying &= !(leaving << (4 * part));
                    let (norms, told) = (norm.to_array(), orbit.told().to_array());
                    let mut lane = 0;
                    while lane < 4 {
                        if leaving >> lane & 1 == 1 {
                            places.norms[4 * part + lane] = norms[lane];
                            places.told[4 * part + lane] = told[lane];
                            places.scales[4 * part + lane] = scale;
                        }
                        lane += 1;
                    }
                }
                part += 1;
            }
            if places.staying == 0 {
                break;
            }
            let mut part = 0;
            while part < FOURS {
                orbits[part] = orbits[part].next();
                part += 1;
            }
            number += 1;
        }
        places
    }
}

impl SimdKernel for Iterating<'_> {
    type Output = Places;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Places {
        match self.fractal.rule {
            Rule::QuaternionSquare => self.iterate::<F, Quaternion<F, 2>>(),
            Rule::QuaternionCube => self.iterate::<F, Quaternion<F, 3>>(),
            Rule::Hypercomplex(_) => self.iterate::<F, Pair<F>>(),
        }
    }
}

/// Quaternions whose square or cube is taken.
#[derive(Clone, Copy)]
pub(super) struct Quaternion<F, const DEGREE: u8> {
    z: [F; 4],
    c: [F; 4],
    /// The product of the squares of all distances from the origin.
    passed: F,
}

impl<F: F64Lanes, const DEGREE: u8> Orbit<F> for Quaternion<F, DEGREE> {
    const DEGREE: f64 = DEGREE as f64;
    const BEYOND: f64 = TOLERANCE;

    #[inline(always)]
    fn start(fractal: &Fractal, z: [F; 4], _: [[F; 2]; 2]) -> Self {
        let c = fractal.c;
        Quaternion {
            z,
            c: [F::splat(c.x), F::splat(c.y), F::splat(c.z), F::splat(c.w)],
            passed: F::splat(1.0),
        }
    }

    #[inline(always)]
    fn norm(&self) -> F {
        let [x, y, z, w] = self.z;
        let flat = x * x + y * y;
        flat + z * z + w * w
    }

    #[inline(always)]
    fn passes(&mut self, norm: F) {
        self.passed = self.passed * norm;
    }

    #[inline(always)]
    fn told(&self) -> F {
        self.passed
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

/// Hypercomplex numbers, as two complex ones, whose squares are taken.
#[derive(Clone, Copy)]
pub(super) struct Pair<F> {
    z: [[F; 2]; 2],
    c: [[F; 2]; 2],
    /// How they change along the ray.
    along: [[F; 2]; 2],
}

impl<F: F64Lanes> Orbit<F> for Pair<F> {
    const DEGREE: f64 = 1.0;
    const BEYOND: f64 = 0.0;

    #[inline(always)]
    fn start(fractal: &Fractal, [x, y, z, w]: [F; 4], along: [[F; 2]; 2]) -> Self {
        let [a, b] = split(fractal.c);
        Pair {
            z: [[x - w, y + z], [x + w, y - z]],
            c: [
                [F::splat(a.re), F::splat(a.im)],
                [F::splat(b.re), F::splat(b.im)],
            ],
            along,
        }
    }

    #[inline(always)]
    fn norm(&self) -> F {
        let [[a, b], [c, d]] = self.z;
        let first = a * a + b * b;
        let second = c * c + d * d;
        F::splat(0.5) * (first + second)
    }

    #[inline(always)]
    fn passes(&mut self, _: F) {}

    /// By how much the half square of the distance falls along the ray.
    #[inline(always)]
    fn told(&self) -> F {
        let [[a, b], [c, d]] = self.z;
        let [[e, f], [g, h]] = self.along;
        let first = -(a * e + b * f);
        let second = -(c * g + d * h);
        first + second
    }

    #[inline(always)]
    fn next(self) -> Self {
        Pair {
            z: [squared(self.z[0], self.c[0]), squared(self.z[1], self.c[1])],
            along: [
                carried(self.z[0], self.along[0]),
                carried(self.z[1], self.along[1]),
            ],
            ..self
        }
    }
}

#[inline(always)]
fn squared<F: F64Lanes>([re, im]: [F; 2], [a, b]: [F; 2]) -> [F; 2] {
    let across = re * im;
    [re * re - im * im + a, across + across + b]
}

#[inline(always)]
fn carried<F: F64Lanes>([re, im]: [F; 2], [a, b]: [F; 2]) -> [F; 2] {
    let (re, im) = (re + re, im + im);
    [re * a - im * b, re * b + im * a]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_place_is_judged_as_if_it_were_alone() {
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
                least: 0.05,
                slope: DVec3::new(0.1, 0.0, 0.2),
                offset: 0.1,
                radius: 2.0,
                unit: 1.0,
            };
            let ray = Ray::new(DVec3::new(-1.5, 0.1, 0.2), DVec3::new(0.6, 0.0, 0.8));
            let depths = [0, 1, 2, 3, 4, 5, 6, 7].map(|number| 0.4 * f64::from(number));
            let together = fractal.places(&ray, &depths);
            for (number, &depth) in depths.iter().enumerate() {
                let alone = fractal.places(&ray, &[depth; TOGETHER]);
                assert_eq!(together.is_inside(number), alone.is_inside(0));
                assert_eq!(fractal.step(&together, number), fractal.step(&alone, 0));
            }
        }
    }
}
