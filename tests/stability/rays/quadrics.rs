//! Families of rays for quadrics, and the comparison of their roots with exact ones.

use super::families::{Family, Numbers, through};
use super::{Digits, ExactRoots, TOLERANCE, Verdict};
use crate::certain::{Sure, along, of_quadratic, sure};
use crate::wide::{Polynomial, wide};
use glam::DVec3;
use povr::base::math::Ray;
use povr::scene::shape::{Geometry, Quadric, Root};

/// A ray and the ten numbers of a quadric, in the order of the language.
#[derive(Clone, Debug)]
pub(crate) struct OnQuadric {
    pub(crate) ray: Ray,
    pub(crate) numbers: [f64; 10],
    /// The same quadric, prepared.
    quadric: Quadric,
}

/// The ten terms at a point, without their factors.
fn terms(p: DVec3) -> [f64; 10] {
    let DVec3 { x, y, z } = p;
    [x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, 1.0]
}

impl OnQuadric {
    fn new(ray: Ray, q: [f64; 10]) -> OnQuadric {
        let quadric = Quadric::new(
            DVec3::new(q[0], q[1], q[2]),
            DVec3::new(q[3], q[4], q[5]),
            DVec3::new(q[6], q[7], q[8]),
            q[9],
        );
        OnQuadric {
            ray,
            numbers: q,
            quadric,
        }
    }

    /// Error of the value of the quadric at a point, if every number involved is off by a rounding.
    fn rounding(&self, t: f64) -> f64 {
        let q = self.numbers.map(f64::abs);
        let reach = self.ray.origin.abs() + t.abs() * self.ray.dir.abs();
        let p = self.ray.at(t).abs();
        let slopes = DVec3::new(
            2.0 * q[0] * p.x + q[3] * p.y + q[4] * p.z + q[6],
            2.0 * q[1] * p.y + q[3] * p.x + q[5] * p.z + q[7],
            2.0 * q[2] * p.z + q[4] * p.x + q[5] * p.y + q[8],
        );
        let own: f64 = q.iter().zip(terms(p)).map(|(q, term)| q * term).sum();
        f64::EPSILON * (own + reach.dot(slopes))
    }

    /// The quadric along the ray, with its constant larger by `more`.
    fn polynomial(&self, more: f64) -> Polynomial {
        let (o, d) = (self.ray.origin, self.ray.dir);
        let [x, y, z] = [0, 1, 2].map(|i| Polynomial(vec![wide(o[i]), wide(d[i])]));
        let one = Polynomial(vec![wide(1.0)]);
        let pairs = [
            (&x, &x),
            (&y, &y),
            (&z, &z),
            (&x, &y),
            (&x, &z),
            (&y, &z),
            (&x, &one),
            (&y, &one),
            (&z, &one),
            (&one, &one),
        ];
        let start = Polynomial(vec![wide(more)]);
        pairs
            .iter()
            .zip(self.numbers)
            .fold(start, |sum, ((a, b), factor)| {
                sum.plus(&a.times(b).scaled(&wide(factor)))
            })
    }

    fn count(&self, more: f64, digits: Digits) -> usize {
        digits.decide(
            || self.sure_count(more),
            || self.polynomial(more).sign_changes().len(),
        )
    }

    /// The value of `uᵀQv` for the quadratic terms.
    fn product(&self, u: [Sure; 3], v: [Sure; 3]) -> Sure {
        let q = &self.numbers;
        let mixed = |i: usize, j: usize| u[i] * v[j] + u[j] * v[i];
        let own = u[0] * v[0] * q[0] + u[1] * v[1] * q[1] + u[2] * v[2] * q[2];
        own + (mixed(0, 1) * q[3] + mixed(0, 2) * q[4] + mixed(1, 2) * q[5]) * 0.5
    }

    fn linear(&self, p: [Sure; 3]) -> Sure {
        p[0] * self.numbers[6] + p[1] * self.numbers[7] + p[2] * self.numbers[8]
    }

    /// The value at `t`.
    fn sure_value(&self, t: f64) -> Sure {
        let p = along(self.ray.origin.to_array(), self.ray.dir.to_array(), t);
        self.product(p, p) + self.linear(p) + sure(self.numbers[9])
    }

    /// Number of roots with the constant larger by `more`, if 32 digits are enough.
    fn sure_count(&self, more: f64) -> Option<usize> {
        let (o, d) = (
            self.ray.origin.to_array().map(sure),
            self.ray.dir.to_array().map(sure),
        );
        of_quadratic(
            self.product(d, d),
            self.product(o, d) + self.linear(d) * 0.5,
            self.product(o, o) + self.linear(o) + sure(self.numbers[9]) + sure(more),
        )
    }
}

impl ExactRoots for OnQuadric {
    fn roots(&self, digits: Digits) -> usize {
        self.count(0.0, digits)
    }

    fn verdict(&self, computed: &[f64], exact: usize, digits: Digits) -> Verdict {
        let worst = digits.worst(
            computed,
            |t| self.rounding(t),
            |t| self.sure_value(t),
            |t| self.polynomial(0.0).at(&wide(t)).abs().to_f64(),
        );
        let mut is_bad = worst > TOLERANCE;
        if !is_bad && computed.len() != exact {
            // A missing pair of roots would lie at the extreme of the value along the ray.
            let polynomial = self.polynomial(0.0);
            let c: Vec<f64> = polynomial.0.iter().map(|c| c.to_f64()).collect();
            let turn = -0.5 * c[1] / c[2];
            let slack = TOLERANCE * self.rounding(if turn.is_finite() { turn } else { 0.0 });
            let counts = [-slack, slack].map(|more| self.count(more, digits));
            is_bad = !counts.contains(&computed.len());
        }
        Verdict { is_bad, worst }
    }
}

/// povr's roots on a quadric.
pub(crate) fn quadric_of_povr(question: &OnQuadric, roots: &mut Vec<Root>) {
    question.quadric.roots(&question.ray, roots);
}

/// The factors of the squares, and a constant.
fn squares(x: f64, y: f64, z: f64, constant: f64) -> [f64; 10] {
    [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, constant]
}

/// Past the middle of a quadric of size one, from a distance.
fn past(n: &mut Numbers, numbers: [f64; 10], distance: f64) -> OnQuadric {
    let aim = n.within(1.2);
    let ray = through(n, aim, distance);
    OnQuadric::new(ray, numbers)
}

/// The same quadric moved by its coefficients.
fn moved(numbers: [f64; 10], by: DVec3) -> [f64; 10] {
    let [a, b, c, ..] = numbers;
    let linear = -2.0 * DVec3::new(a, b, c) * by;
    let constant = numbers[9] + DVec3::new(a, b, c).dot(by * by);
    [
        a, b, c, 0.0, 0.0, 0.0, linear.x, linear.y, linear.z, constant,
    ]
}

const UNIT_SPHERE: [f64; 10] = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0];

/// Ellipsoids, cylinders, cones, hyperboloids, paraboloids, saddles: near, far, grazing, flat, along an axis.
pub(crate) const QUADRICS: &[Family<OnQuadric>] = &[
    Family {
        name: "ellipsoid",
        make: |n| past(n, squares(1.0, 2.0, 3.0, -1.0), 4.0),
    },
    Family {
        name: "ellipsoid, far 1e3",
        make: |n| past(n, squares(1.0, 2.0, 3.0, -1.0), 1e3),
    },
    Family {
        name: "ellipsoid, far 1e5",
        make: |n| past(n, squares(1.0, 2.0, 3.0, -1.0), 1e5),
    },
    Family {
        name: "ellipsoid, far 1e8",
        make: |n| past(n, squares(1.0, 2.0, 3.0, -1.0), 1e8),
    },
    Family {
        name: "flat 1e-6",
        make: |n| {
            let OnQuadric {
                mut ray, numbers, ..
            } = past(n, squares(1.0, 1e12, 1.0, -1.0), 4.0);
            // Half of them from the side.
            if n.share() < 0.5 {
                ray.origin.y *= 1e-6;
                ray.dir.y *= 1e-6;
            }
            OnQuadric::new(ray, numbers)
        },
    },
    Family {
        name: "needle 1e6",
        make: |n| {
            let aim = n.within(1.2) * DVec3::new(1e-6, 1.0, 1e-6);
            let ray = through(n, aim, 4.0);
            OnQuadric::new(ray, squares(1e12, 1.0, 1e12, -1.0))
        },
    },
    Family {
        name: "ball moved by 1e3",
        make: |n| {
            let by = n.within(1e3);
            let OnQuadric { ray, .. } = past(n, UNIT_SPHERE, 4.0);
            OnQuadric::new(Ray::new(ray.origin + by, ray.dir), moved(UNIT_SPHERE, by))
        },
    },
    Family {
        name: "grazing 1e-15 to 1e-3",
        make: |n| {
            let normal = n.direction();
            let tangent = normal.cross(n.direction()).normalize();
            let depth = n.power_of_ten(-15.0, -3.0);
            OnQuadric::new(
                Ray::new(normal * (1.0 - depth) - tangent * 4.0, tangent),
                UNIT_SPHERE,
            )
        },
    },
    Family {
        name: "from the surface",
        make: |n| OnQuadric::new(Ray::new(n.direction(), n.direction()), UNIT_SPHERE),
    },
    Family {
        name: "from the surface, grazing",
        make: |n| {
            let normal = n.direction();
            let lift = n.power_of_ten(-8.0, -2.0);
            let dir = normal.cross(n.direction()).normalize() + lift * normal;
            OnQuadric::new(Ray::new(normal, dir.normalize()), UNIT_SPHERE)
        },
    },
    Family {
        name: "cylinder",
        make: |n| past(n, squares(1.0, 0.0, 1.0, -1.0), 4.0),
    },
    Family {
        name: "cylinder, far 1e5",
        make: |n| past(n, squares(1.0, 0.0, 1.0, -1.0), 1e5),
    },
    Family {
        name: "cylinder, along its axis to 1e-6",
        make: |n| {
            let lean = n.power_of_ten(-6.0, -1.0);
            let dir = (DVec3::Y + lean * n.direction()).normalize();
            OnQuadric::new(
                Ray::new(n.within(0.9) - 4.0 * dir, dir),
                squares(1.0, 0.0, 1.0, -1.0),
            )
        },
    },
    Family {
        name: "cone",
        make: |n| past(n, squares(1.0, -1.0, 1.0, 0.0), 4.0),
    },
    Family {
        name: "cone, near its apex",
        make: |n| {
            let aim = n.within(1e-6);
            let ray = through(n, aim, 4.0);
            OnQuadric::new(ray, squares(1.0, -1.0, 1.0, 0.0))
        },
    },
    Family {
        name: "hyperboloid of one sheet",
        make: |n| past(n, squares(1.0, -0.7, 1.0, -0.5), 4.0),
    },
    Family {
        name: "hyperboloid of two sheets",
        make: |n| past(n, squares(1.0, -1.3, 1.0, 0.2), 4.0),
    },
    Family {
        name: "hyperboloid, far 1e5",
        make: |n| past(n, squares(1.0, -0.7, 1.0, -0.5), 1e5),
    },
    Family {
        name: "paraboloid",
        make: |n| {
            let mut numbers = squares(1.0, 0.0, 1.0, -0.5);
            numbers[7] = -1.0;
            past(n, numbers, 4.0)
        },
    },
    Family {
        name: "paraboloid, along its axis",
        make: |n| {
            let mut numbers = squares(1.0, 0.0, 1.0, -0.5);
            numbers[7] = -1.0;
            OnQuadric::new(Ray::new(n.within(1.0) - 4.0 * DVec3::Y, DVec3::Y), numbers)
        },
    },
    Family {
        name: "saddle",
        make: |n| {
            let mut numbers = squares(1.0, 0.0, -1.0, 0.0);
            numbers[7] = -1.0;
            past(n, numbers, 4.0)
        },
    },
    Family {
        name: "all ten numbers",
        make: |n| {
            let numbers = [(); 10].map(|()| 2.0 * n.share() - 1.0);
            past(n, numbers, 4.0)
        },
    },
];
