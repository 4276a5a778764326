//! Roots against numbers of 77 digits (items 5 to 7, 10 and 48): a ray is wrong if a root lies more than 64 roundings
//! of the problem's size beside the surface, or if the number of roots is one that no change of the surface by so
//! little explains.
//!
//! Nearly all rays are decided with 32 digits and proven bounds (`certain`), and only the rest with 77.

pub(crate) mod families;
pub(crate) mod quadrics;

use crate::certain::{self, Sure, along, of_bernstein, of_quadratic, sure};
use crate::wide::{Polynomial, Vector, Wide, dot, plus, times, vector, wide};
use families::{Family, Question, SPHERES, TORI};
use povr::scene::shape::{Geometry, Root, Sphere, Torus};
use quadrics::{QUADRICS, quadric_of_povr};

/// Roundings of the problem's size.
const TOLERANCE: f64 = 64.0;

/// The range around it that errors of 32 digits cannot leave.
const NEAR_TOLERANCE: std::ops::Range<f64> = TOLERANCE * (1.0 - 1e-9)..TOLERANCE * (1.0 + 1e-9);

/// Largest error of a distance that counts as known, in roundings.
const KNOWN: f64 = 1e-9;

/// Rays of each family in a test.
const RAYS: usize = 300;

/// Rays whose fast answers are compared with the slow ones, in a test; and in the whole run.
const COMPARED: usize = 5;
const ALL_COMPARED: usize = 160;

/// Comparison of the roots of a ray with the exact ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Verdict {
    pub(crate) is_bad: bool,
    /// The distance of the worst root from the surface, in roundings of the problem's size.
    pub(crate) worst: f64,
}

/// Digits to decide with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Digits {
    /// 32 where a bound on their error proves the answer, else 77.
    Enough,
    /// 77 always.
    All,
}

impl Digits {
    /// The certain answer, if that is enough, otherwise the slow one.
    fn decide<T>(self, quickly: impl FnOnce() -> Option<T>, slowly: impl FnOnce() -> T) -> T {
        let quick = if self == Digits::Enough {
            quickly()
        } else {
            None
        };
        quick.unwrap_or_else(slowly)
    }

    /// The largest distance of roots from the surface, in roundings.
    fn worst(
        self,
        computed: &[f64],
        rounding: impl Fn(f64) -> f64,
        quickly: impl Fn(f64) -> Sure,
        slowly: impl Fn(f64) -> f64,
    ) -> f64 {
        computed.iter().fold(0.0, |worst: f64, &t| {
            if !t.is_finite() {
                return f64::INFINITY;
            }
            let rounding = rounding(t);
            let known = || {
                let (size, off) = quickly(t).size();
                let roundings = size / rounding;
                let is_known =
                    off / rounding <= KNOWN * f64::max(1.0, roundings) && roundings.is_finite();
                (is_known && !NEAR_TOLERANCE.contains(&roundings)).then_some(roundings)
            };
            worst.max(self.decide(known, || slowly(t) / rounding))
        })
    }
}

/// A ray whose exact roots are known.
pub(crate) trait ExactRoots {
    /// Number of roots.
    fn roots(&self, digits: Digits) -> usize;

    /// Compares `computed` roots with the `exact` number of roots.
    fn verdict(&self, computed: &[f64], exact: usize, digits: Digits) -> Verdict;
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

    /// A rounding of all the numbers involved in a point.
    fn rounding(&self, t: f64) -> f64 {
        let reach = self.ray.origin.abs() + t.abs() * self.ray.dir.abs();
        f64::EPSILON * (reach.element_sum() + self.major + self.minor)
    }

    /// The polynomial of the ray, and the interval of its roots, for a surface grown by `by`.
    fn polynomial(&self, line: &Line, by: f64) -> (Polynomial, Option<[Wide; 2]>) {
        let square =
            |v: &Vector, w: &Vector| Polynomial(vec![dot(v, v), dot(v, w) * wide(2.0), dot(w, w)]);
        let (major, minor) = (wide(self.major), wide(self.minor) + wide(by));
        let number = |x: Wide| Polynomial(vec![x]);
        let all = square(&line.origin, &line.dir);
        if self.major == 0.0 {
            let sphere_polynomial = all.plus(&number(-(&minor * &minor)));
            return (sphere_polynomial, Some([wide(-1e300), wide(1e300)]));
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

    fn count(&self, by: f64, digits: Digits) -> usize {
        digits.decide(
            || self.sure_count(by),
            || {
                let (polynomial, around) = self.polynomial(&self.line(), by);
                around.map_or(0, |[low, high]| {
                    polynomial.sign_changes_between(&low, &high).len()
                })
            },
        )
    }

    /// A power of two that brings the size of the surface near one.
    fn unit(&self) -> f64 {
        (-(self.major + self.minor).log2().floor()).exp2()
    }

    /// Number of roots on a surface grown by `by`, if 32 digits are enough.
    fn sure_count(&self, by: f64) -> Option<usize> {
        let unit = self.unit();
        let origin = (self.ray.origin * unit).to_array();
        let dir = self.ray.dir.to_array();
        let (major, minor) = (
            sure(self.major * unit),
            sure(self.minor * unit) + sure(by * unit),
        );
        let direction = dir.map(sure);
        let speed_sq = certain::dot(&direction, &direction);
        let nearest = unit * -self.ray.origin.dot(self.ray.dir) / self.ray.dir.length_squared();
        let middle = along(origin, dir, nearest);
        if self.major == 0.0 {
            return of_quadratic(
                speed_sq,
                certain::dot(&middle, &direction),
                certain::dot(&middle, &middle) - minor * minor,
            );
        }
        let reach = major + minor;
        let reach_sq = reach * reach;
        let (middle_sq, slope) = (
            certain::dot(&middle, &middle),
            certain::dot(&middle, &direction),
        );
        let missed = (middle_sq - reach_sq) * speed_sq - slope * slope;
        if missed.is_positive() {
            return Some(0);
        }
        // An interval within the sphere around the torus.
        let (off_sq, _) = middle_sq.size();
        let (reach, _) = reach.size();
        let half = (1.05 * reach * reach - off_sq).max(0.01 * reach * reach);
        let half = (half / self.ray.dir.length_squared()).sqrt();
        let (low, width) = (nearest - half, 2.0 * half);
        let (start, end) = (along(origin, dir, low), along(origin, dir, low + width));
        let is_outside = |p: &certain::Point, side: f64| {
            (certain::dot(p, p) - reach_sq).is_positive()
                && (certain::dot(p, &direction) * side).is_positive()
        };
        if !is_outside(&start, -1.0) || !is_outside(&end, 1.0) {
            return None;
        }
        // From the start to the end, a point is start·(1 − x) + end·x.
        let flat = |p: &certain::Point, q: &certain::Point| p[0] * q[0] + p[2] * q[2];
        let squares = |product: &dyn Fn(&certain::Point, &certain::Point) -> Sure| {
            [
                product(&start, &start),
                product(&start, &end),
                product(&end, &end),
            ]
        };
        let more = major * major - minor * minor;
        let w = squares(&|p, q| certain::dot(p, q)).map(|c| c + more);
        let f = squares(&flat).map(|c| c * (major * major * 4.0));
        // Three times (ρ² + y² + R² − r²)² − 4R²ρ².
        of_bernstein([
            (w[0] * w[0] - f[0]) * 3.0,
            (w[0] * w[1] - (f[0] + f[1]) * 0.5) * 3.0,
            w[0] * w[2] + w[1] * w[1] * 2.0 - (f[0] + f[1] * 4.0 + f[2]) * 0.5,
            (w[1] * w[2] - (f[1] + f[2]) * 0.5) * 3.0,
            (w[2] * w[2] - f[2]) * 3.0,
        ])
    }

    /// Distance of the point at `t` from the surface.
    fn sure_distance(&self, t: f64) -> Sure {
        let unit = self.unit();
        let origin = (self.ray.origin * unit).to_array();
        let p = along(origin, self.ray.dir.to_array(), t * unit);
        let minor = sure(self.minor * unit);
        let back = sure(1.0 / unit);
        if self.major == 0.0 {
            return (certain::dot(&p, &p).sqrt() - minor) * back;
        }
        let major = sure(self.major * unit);
        let axis_distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
        let height_sq = p[1] * p[1];
        let from_ring = |across: Sure| (across * across + height_sq).sqrt() - minor;
        let tube = from_ring(axis_distance - major);
        let lemon = from_ring(axis_distance + major);
        let nearer = if tube.size().0 < lemon.size().0 {
            tube
        } else {
            lemon
        };
        nearer * back
    }

    /// Distance of the point at `t` from the surface.
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

impl ExactRoots for Question {
    fn roots(&self, digits: Digits) -> usize {
        self.count(0.0, digits)
    }

    fn verdict(&self, computed: &[f64], exact: usize, digits: Digits) -> Verdict {
        let worst = digits.worst(
            computed,
            |t| self.rounding(t),
            |t| self.sure_distance(t),
            |t| self.distance(&self.line(), t),
        );
        let mut is_bad = worst > TOLERANCE;
        if !is_bad && computed.len() != exact {
            let nearest = -self.ray.origin.dot(self.ray.dir) / self.ray.dir.length_squared();
            let slack = TOLERANCE * self.rounding(nearest);
            let counts = [-slack, slack].map(|by| self.count(by, digits));
            let least = counts.iter().min().copied().unwrap_or(0).min(exact);
            let most = counts.iter().max().copied().unwrap_or(0).max(exact);
            is_bad = !(least..=most).contains(&computed.len());
        }
        Verdict { is_bad, worst }
    }
}

/// povr's roots on a torus.
pub(crate) fn torus_of_povr(question: &Question, roots: &mut Vec<Root>) {
    let torus = Torus {
        spindle: Default::default(),
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

/// Number of rays of a family, and of those answered wrongly.
fn checked<Q: ExactRoots>(family: &Family<Q>, answer: fn(&Q, &mut Vec<Root>)) -> (usize, usize) {
    let questions = family.rays(RAYS);
    let bad = questions.iter().filter(|question| {
        let mut roots = Vec::new();
        answer(question, &mut roots);
        let computed: Vec<f64> = roots.iter().map(|root| root.t).collect();
        {
            let exact = question.roots(Digits::Enough);
            question.verdict(&computed, exact, Digits::Enough).is_bad
        }
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
        .map(|family| checked(family, answer))
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
        .map(|family| checked(family, quadric_of_povr))
        .fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
}

/// The first rays of every family, decided with 32 digits and with 77, for povr's roots, those without the first, and
/// those moved by about the tolerance.
fn compared(count: usize) -> (usize, usize) {
    fn differing<Q: ExactRoots>(
        family: &Family<Q>,
        answer: fn(&Q, &mut Vec<Root>),
        count: usize,
    ) -> usize {
        let differs = |question: &Q| {
            let exact = question.roots(Digits::All);
            if question.roots(Digits::Enough) != exact {
                return true;
            }
            let mut roots = Vec::new();
            answer(question, &mut roots);
            let computed: Vec<f64> = roots.iter().map(|root| root.t).collect();
            let moved = computed
                .iter()
                .map(|t| t * (1.0 + 60.0 * f64::EPSILON))
                .collect();
            let less = computed.iter().skip(1).copied().collect();
            [computed, moved, less].iter().any(|computed: &Vec<f64>| {
                let quick = question.verdict(computed, exact, Digits::Enough);
                let slow = question.verdict(computed, exact, Digits::All);
                let is_near = (quick.worst - slow.worst).abs() <= 2.0 * KNOWN * slow.worst.max(1.0);
                quick.is_bad != slow.is_bad || !is_near
            })
        };
        let rays = family.rays(count);
        rays.iter().filter(|question| differs(question)).count()
    }
    let tori = TORI.iter().map(|own| differing(own, torus_of_povr, count));
    let spheres = SPHERES
        .iter()
        .map(|own| differing(own, sphere_of_povr, count));
    let quadrics = QUADRICS
        .iter()
        .map(|own| differing(own, quadric_of_povr, count));
    let families = TORI.len() + SPHERES.len() + QUADRICS.len();
    (families * count, tori.chain(spheres).chain(quadrics).sum())
}

/// A few rays of each family with 32 digits and with 77.
pub(crate) fn quick_and_slow() -> (usize, usize) {
    compared(COMPARED)
}

/// Ten thousand rays with 32 digits and with 77.
pub(crate) fn all_quick_and_slow() -> (usize, usize) {
    compared(ALL_COMPARED)
}
