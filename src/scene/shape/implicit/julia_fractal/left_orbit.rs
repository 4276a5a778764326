//! The orbit that POV-Ray's search for a hypercomplex fractal leaves behind at a hit, from which it takes the normal.
//!
//! Each evaluation writes its iterates until one is outside of the bounding sphere; those after it stay as an earlier
//! evaluation has left them (measured). The last evaluation is the inside test at the hit, those before it were at the
//! middles of the step that crossed the surface. Where the one at the hit leaves the sphere, so did all of these: the step
//! has its inner end at the hit.

use super::complex::Function;
use super::inside_test::{gradient, to_complex_pair};
use super::{Fractal, TOLERANCE};
use crate::base::math::Complex;
use crate::scene::shape::Crossing;
use glam::{DVec3, DVec4};

/// The search's step across a surface.
#[derive(Clone, Copy)]
pub(super) struct SearchStep {
    /// The unit direction of the ray; zero if it is unknown.
    dir: DVec3,
    /// The length from the inner end to the outer one: negative where the ray enters.
    length: f64,
}

/// Iterates `z0` to `zn` from several evaluations.
pub(super) struct LeftOrbit {
    /// The number of iterates so far, and that of all.
    len: usize,
    wanted: usize,
    /// The last of them.
    z: DVec4,
    /// The product that POV-Ray takes for the derivative.
    slope: [Complex; 2],
}

impl SearchStep {
    /// A step as the number of a face; 0 where the normal does not depend on it.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the place of a middle hardly changes the iterates that it leaves"
    )]
    pub(super) fn face(fractal: &Fractal, length: f64, crossing: Crossing) -> u32 {
        if !fractal.tests_y_as_z {
            return 0;
        }
        let is_entry = crossing == Crossing::Enter;
        let length = length as f32;
        (if is_entry { -length } else { length }).to_bits()
    }

    /// The step of a face that a ray in this direction hit.
    pub(super) fn of_face(face: u32, dir: DVec3) -> Self {
        SearchStep {
            dir: dir.normalize_or_zero(),
            length: f64::from(f32::from_bits(face)),
        }
    }
}

impl LeftOrbit {
    /// The orbit at a hit.
    pub(super) fn of_hit(
        fractal: &Fractal,
        function: Function,
        point: DVec3,
        step: SearchStep,
    ) -> Self {
        let start = fractal.tested_start(point);
        let mut orbit = LeftOrbit {
            len: 1,
            wanted: fractal.max_iteration as usize + 1,
            z: start,
            slope: to_complex_pair(start),
        };
        if fractal.tests_y_as_z {
            orbit.take(fractal, function, start);
            orbit.take_earlier(fractal, function, point, step);
        }
        while orbit.len < orbit.wanted {
            let next = fractal.next(function, to_complex_pair(orbit.z));
            orbit.push(function, next);
        }
        orbit
    }

    /// The gradient of half the squared norm of the last iterate.
    pub(super) fn gradient(&self) -> DVec3 {
        gradient(to_complex_pair(self.z), self.slope)
    }

    /// Takes what earlier evaluations left, the latest first.
    fn take_earlier(
        &mut self,
        fractal: &Fractal,
        function: Function,
        point: DVec3,
        step: SearchStep,
    ) {
        let outer = step.length * step.dir;
        if outer != DVec3::ZERO {
            let length = step.length.abs();
            let mut part = 0.5;
            while part * length > TOLERANCE {
                part *= 0.5;
            }
            while part < 1.0 && self.len < self.wanted {
                let middle = fractal.tested_start(point + part * outer);
                self.take(fractal, function, middle);
                part *= 2.0;
            }
            if step.length > 0.0 {
                self.take(fractal, function, fractal.start(point + outer));
            }
        }
        self.take(fractal, function, fractal.start(point));
    }

    /// Takes the iterates of `z` that are beyond those so far.
    fn take(&mut self, fractal: &Fractal, function: Function, mut z: DVec4) {
        let mut iteration = 0;
        while self.len < self.wanted && fractal.is_in_sphere(z) {
            z = fractal.next(function, to_complex_pair(z));
            iteration += 1;
            if iteration == self.len {
                self.push(function, z);
            }
        }
    }

    fn push(&mut self, function: Function, z: DVec4) {
        if self.len > 1 {
            let before = to_complex_pair(self.z);
            self.slope = [0, 1].map(|i| self.slope[i] * function.factor(before[i]));
        }
        self.z = z;
        self.len += 1;
    }
}
