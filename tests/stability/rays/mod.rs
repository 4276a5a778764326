//! Roots against numbers of 77 digits (items 5 to 7, 10 and 48): a ray is answered wrongly if a root lies more than 64
//! roundings of the problem's size beside the surface, or if the number of roots is one that no change of the surface by
//! so little explains.

pub(crate) mod families;
pub(crate) mod quadrics;

use crate::wide::{Polynomial, Vector, Wide, dot, plus, times, vector, wide};
use families::{Family, Question, SPHERES, TORI};
use povr::shape::{Geometry, Root, Sphere, Torus};
use quadrics::{QUADRICS, quadric_of_povr};

/// Roundings of the problem's size.
const TOLERANCE: f64 = 64.0;

/// Rays of each family in a test.
const RAYS: usize = 300;

/// How the roots of a ray compare with the exact ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Verdict {
    pub(crate) is_bad: bool,
    /// The distance of the worst root from the surface, in roundings of the problem's size.
    pub(crate) worst: f64,
}

/// A ray whose roots are known.
pub(crate) trait Asked {
    /// How many roots there are.
    fn roots(&self) -> usize;

    /// How good the roots `found` are, of `exact` that there are.
    fn verdict(&self, found: &[f64], exact: usize) -> Verdict;
}

/// Origin and direction.
struct Line {
    origin: Vector,
    dir: Vector,
}

impl Question {
    fn line(&self) -> Line {
        Line {
            origin: vector(self.ray.origin.to_array()),
            dir: vector(self.ray.dir.to_array()),
        }
    }

    /// A rounding of all the numbers that meet at a place.
    fn rounding(&self, t: f64) -> f64 {
        let reach = self.ray.origin.abs() + t.abs() * self.ray.dir.abs();
        f64::EPSILON * (reach.element_sum() + self.major + self.minor)
    }

    /// The polynomial of the ray, and the stretch that holds its roots, for a surface grown by `by`.
    fn polynomial(&self, line: &Line, by: f64) -> (Polynomial, Option<[Wide; 2]>) {
        let square =
            |v: &Vector, w: &Vector| Polynomial(vec![dot(v, v), dot(v, w) * wide(2.0), dot(w, w)]);
        let (major, minor) = (wide(self.major), wide(self.minor) + wide(by));
        let number = |x: Wide| Polynomial(vec![x]);
        let all = square(&line.origin, &line.dir);
        if self.major == 0.0 {
            let ball = all.plus(&number(-(&minor * &minor)));
            return (ball, Some([wide(-1e300), wide(1e300)]));
        }
        let reach = (&major + &minor) * wide(1.01);
        let around = all.plus(&number(-(&reach * &reach))).sign_changes();
        let height = Polynomial(vec![line.origin[1].clone(), line.dir[1].clone()]);
        let flat = all.plus(&height.times(&height).scaled(&wide(-1.0)));
        let whole = all.plus(&number(&major * &major - &minor * &minor));
        let ring = whole
            .times(&whole)
            .plus(&flat.scaled(&(&major * &major * wide(-4.0))));
        (ring, <[Wide; 2]>::try_from(around).ok())
    }

    fn count(&self, line: &Line, by: f64) -> usize {
        let (polynomial, around) = self.polynomial(line, by);
        around.map_or(0, |[low, high]| {
            polynomial.sign_changes_between(&low, &high).len()
        })
    }

    /// How far the place at `t` is from the surface.
    fn distance(&self, line: &Line, t: f64) -> f64 {
        let p = plus(&line.origin, &times(&line.dir, &wide(t)));
        let minor = wide(self.minor);
        let off = if self.major == 0.0 {
            dot(&p, &p).sqrt() - minor
        } else {
            let major = wide(self.major);
            let axis_distance = (&p[0] * &p[0] + &p[2] * &p[2]).sqrt();
            let height_sq = &p[1] * &p[1];
            let from_ring = |across: Wide| (&across * &across + &height_sq).sqrt() - &minor;
            let tube = from_ring(&axis_distance - &major);
            let lemon = from_ring(&axis_distance + &major);
            if tube.abs() < lemon.abs() {
                tube
            } else {
                lemon
            }
        };
        off.abs().to_f64()
    }
}

impl Asked for Question {
    fn roots(&self) -> usize {
        self.count(&self.line(), 0.0)
    }

    fn verdict(&self, found: &[f64], exact: usize) -> Verdict {
        let line = self.line();
        let worst = found.iter().fold(0.0, |worst: f64, &t| {
            let off = if t.is_finite() {
                self.distance(&line, t) / self.rounding(t)
            } else {
                f64::INFINITY
            };
            worst.max(off)
        });
        let mut is_bad = worst > TOLERANCE;
        if !is_bad && found.len() != exact {
            let nearest = -self.ray.origin.dot(self.ray.dir) / self.ray.dir.length_squared();
            let slack = TOLERANCE * self.rounding(nearest);
            let counts = [-slack, 0.0, slack].map(|by| self.count(&line, by));
            let least = counts.iter().min().copied().unwrap_or(0);
            let most = counts.iter().max().copied().unwrap_or(0);
            is_bad = !(least..=most).contains(&found.len());
        }
        Verdict { is_bad, worst }
    }
}

/// povr's roots on a torus.
pub(crate) fn torus_of_povr(question: &Question, roots: &mut Vec<Root>) {
    let torus = Torus {
        centre: glam::DVec3::ZERO,
        major: question.major,
        minor: question.minor,
    };
    torus.roots(&question.ray, roots);
}

/// povr's roots on a sphere.
pub(crate) fn sphere_of_povr(question: &Question, roots: &mut Vec<Root>) {
    let sphere = Sphere {
        centre: glam::DVec3::ZERO,
        radius: question.minor,
    };
    sphere.roots(&question.ray, roots);
}

/// Rays of a family, and those that are answered wrongly.
fn asked<Q: Asked>(family: &Family<Q>, answer: fn(&Q, &mut Vec<Root>)) -> (usize, usize) {
    let questions = family.rays(RAYS);
    let bad = questions.iter().filter(|question| {
        let mut roots = Vec::new();
        answer(question, &mut roots);
        let found: Vec<f64> = roots.iter().map(|root| root.t).collect();
        question.verdict(&found, question.roots()).is_bad
    });
    (RAYS, bad.count())
}

fn of_some(
    families: &[Family],
    names: &[&str],
    answer: fn(&Question, &mut Vec<Root>),
) -> (usize, usize) {
    families
        .iter()
        .filter(|family| names.contains(&family.name))
        .map(|family| asked(family, answer))
        .fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
}

/// Rays that touch the top circle: roots come in pairs and are numbers.
pub(crate) fn tangents() -> (usize, usize) {
    let family = TORI.iter().find(|family| family.name == "tangent on top");
    let questions = family.map_or_else(Vec::new, |family| family.rays(RAYS));
    let bad = questions.iter().filter(|question| {
        let mut roots = Vec::new();
        torus_of_povr(question, &mut roots);
        !roots.len().is_multiple_of(2) || roots.iter().any(|root| !root.t.is_finite())
    });
    (questions.len(), bad.count())
}

pub(crate) fn along_axes() -> (usize, usize) {
    of_some(
        TORI,
        &["along an axis", "in the plane", "in the plane, thin 1e-4"],
        torus_of_povr,
    )
}

pub(crate) fn through_the_axis() -> (usize, usize) {
    of_some(
        TORI,
        &["through the centre", "through the edge of the hole"],
        torus_of_povr,
    )
}

/// All families of tori.
pub(crate) fn all_tori() -> (usize, usize) {
    let names: Vec<&str> = TORI.iter().map(|family| family.name).collect();
    of_some(TORI, &names, torus_of_povr)
}

pub(crate) fn grazing_spheres() -> (usize, usize) {
    of_some(SPHERES, &["grazing 1e-15 to 1e-3"], sphere_of_povr)
}

pub(crate) fn far_spheres() -> (usize, usize) {
    let names = [
        "5 radii away",
        "1e5 radii away",
        "1e7 radii away",
        "1e8 radii away",
    ];
    of_some(SPHERES, &names, sphere_of_povr)
}

pub(crate) fn floors() -> (usize, usize) {
    of_some(SPHERES, &["floor of 1e7"], sphere_of_povr)
}

/// All families of quadrics.
pub(crate) fn all_quadrics() -> (usize, usize) {
    QUADRICS
        .iter()
        .map(|family| asked(family, quadric_of_povr))
        .fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
}
