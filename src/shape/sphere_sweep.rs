//! `sphere_sweep { linear_spline | b_spline | cubic_spline  n, <centre>, radius, ... [tolerance x] }`: the space that a
//! sphere sweeps whose centre and radius follow a curve.
//!
//! At the parameter `x` of the curve a ray is in the sphere from `s₋(x)` to `s₊(x) = −b ± √d`, with `b(x)` the way of the
//! ray to the point nearest to the centre and `d(x)` the square of half the chord. Where `d ≥ 0` without a gap the ray is
//! in the sweep from the least `s₋` to the largest `s₊`, so enter and leave alternate by construction. The extremes lie
//! at the ends of the curve or where `d'² = 4·b'²·d`, of degree ten. POV-Ray solves the same equation.
//!
//! In a difference POV-Ray 3.7 shows walls inside the sweep where two pieces of a curve meet; here there are none.
//!
//! `tolerance`, by which POV-Ray drops hits near the start of a ray, is read and not needed.

use super::{Geometry, Root, Start, first_visible, read, span};
use crate::accel::Bvh;
use crate::args::{Args, Parse, Word};
use crate::math::conditioning::power_of_two;
use crate::math::polynomial::{sign_changes, value};
use crate::math::{Bounds, Ray, Step};
use crate::source::Diagnostic;
use glam::{DVec3, DVec4};
use smallvec::SmallVec;
use std::sync::Arc;

/// Spheres of one sweep.
const MOST_SPHERES: f64 = 1e7;
/// Newton steps towards an extreme of the way to the surface; the places found before are nearly right.
const POLISH: usize = 2;

/// A polynomial by rising power.
type Poly = SmallVec<[f64; 12]>;
/// Enter and leave of parts of the sweep on a ray, each with the number of the part.
type Spans = SmallVec<[[(f64, u32); 2]; 4]>;

/// A sweep. Copies share its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereSweep(Arc<Sweep>);

#[derive(Clone, Debug)]
struct Sweep {
    parts: Vec<Part>,
    /// Over the boxes of the parts.
    tree: Bvh,
    bounds: Bounds,
}

impl PartialEq for Sweep {
    /// The tree follows from the parts.
    fn eq(&self, other: &Self) -> bool {
        self.parts == other.parts && self.bounds == other.bounds
    }
}

/// One polynomial piece of the curve.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    /// Centre and radius by rising power of `-1 <= x <= 1`, about `centre` and in units of `size`.
    curve: [DVec4; 4],
    /// How many of them there are.
    len: usize,
    centre: DVec3,
    /// A power of two.
    size: f64,
    /// The square of the radius of a ball around it, in units of `size`.
    reach_sq: f64,
}

/// How the curve follows the spheres.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Linear,
    /// Near the spheres, smooth in its bends.
    B,
    /// Through all but the first and the last, which only bend it.
    Cubic,
}

/// The rows are the powers of `0 <= t <= 1`, the columns four spheres in a row.
type Basis = [[f64; 4]; 4];

const B_SPLINE: Basis = [
    [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0],
    [-0.5, 0.0, 0.5, 0.0],
    [0.5, -1.0, 0.5, 0.0],
    [-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0],
];
const CATMULL_ROM: Basis = [
    [0.0, 1.0, 0.0, 0.0],
    [-0.5, 0.0, 0.5, 0.0],
    [1.0, -2.5, 2.0, -0.5],
    [-0.5, 1.5, -1.5, 0.5],
];

impl SphereSweep {
    /// Reads the kind of the curve and its spheres.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, an unknown kind, or too few spheres for it.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let kinds = [
            (Word::LinearSpline, Kind::Linear, 2),
            (Word::BSpline, Kind::B, 4),
            (Word::CubicSpline, Kind::Cubic, 4),
        ];
        let mut found = None;
        for (word, kind, least) in kinds {
            if args.accept(word)? {
                found = Some((word, kind, least));
            }
        }
        let Some((word, kind, least)) = found else {
            let what = "`linear_spline`, `b_spline` or `cubic_spline` in `sphere_sweep`";
            return Err(args.expected(what));
        };
        args.comma()?;
        let at = args.span();
        let count = read::number(args, "the number of spheres")?.trunc();
        if count < f64::from(least) || count > MOST_SPHERES {
            let message = format!("a `{word}` needs at least {least} spheres, found {count}");
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                message,
            )));
        }
        let mut spheres = Vec::new();
        while (spheres.len() as f64) < count {
            let number = spheres.len() + 1;
            let centre = read::vector(args, &format!("centre {number} of the sphere sweep"))?;
            let radius = read::number(args, &format!("radius {number} of the sphere sweep"))?;
            spheres.push(centre.extend(radius));
        }
        if args.accept(Word::Tolerance)? {
            read::number(args, "the tolerance of the sphere sweep")?;
        }
        Ok(SphereSweep(Arc::new(Sweep::new(kind, &spheres))))
    }

    /// The parts of a ray that are in the sweep, in order and apart from each other.
    fn spans(&self, ray: &Ray) -> Spans {
        let mut all = Spans::new();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        self.0.tree.any(ray, from, to, |number| {
            self.0.parts[number as usize].spans(ray, number, &mut all);
            false
        });
        all.sort_unstable_by(|a, b| a[0].0.total_cmp(&b[0].0).then(a[0].1.cmp(&b[0].1)));
        let mut apart = Spans::new();
        for [enter, leave] in all {
            match apart.last_mut() {
                Some([_, last]) if enter.0 <= last.0 => {
                    if leave.0 > last.0 {
                        *last = leave;
                    }
                }
                _ => apart.push([enter, leave]),
            }
        }
        apart
    }
}

impl Sweep {
    fn new(kind: Kind, spheres: &[DVec4]) -> Self {
        let parts: Vec<Part> = match kind {
            Kind::Linear => spheres
                .windows(2)
                .map(|pair| Part::new(&[pair[0], pair[1] - pair[0]]))
                .collect(),
            Kind::B => spheres
                .windows(4)
                .map(|four| Part::of(&B_SPLINE, four))
                .collect(),
            Kind::Cubic => spheres
                .windows(4)
                .map(|four| Part::of(&CATMULL_ROM, four))
                .collect(),
        };
        let boxes: Vec<Bounds> = parts.iter().map(Part::bounds).collect();
        // POV-Ray's box, as far as it goes.
        let factor = if kind == Kind::Cubic { 2.0 } else { 1.0 };
        let of_spheres = spheres.iter().map(|sphere| {
            let radius = DVec3::splat(factor * sphere.w.abs());
            Bounds {
                min: sphere.truncate() - radius,
                max: sphere.truncate() + radius,
            }
        });
        let bounds = of_spheres.chain(boxes.iter().copied());
        let bounds = bounds.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        Sweep {
            tree: Bvh::build(&boxes),
            parts,
            bounds,
        }
    }
}

impl Part {
    fn of(basis: &Basis, four: &[DVec4]) -> Self {
        let power = |row: &[f64; 4]| (0..4).fold(DVec4::ZERO, |sum, i| sum + row[i] * four[i]);
        Part::new(&basis.each_ref().map(power))
    }

    /// A piece by rising power of `0 <= t <= 1`.
    fn new(powers: &[DVec4]) -> Self {
        let mut c = [DVec4::ZERO; 4];
        c[..powers.len()].copy_from_slice(powers);
        // With t = (1 + x) / 2.
        let curve = [
            c[0] + 0.5 * c[1] + 0.25 * c[2] + 0.125 * c[3],
            0.5 * c[1] + 0.5 * c[2] + 0.375 * c[3],
            0.25 * c[2] + 0.375 * c[3],
            0.125 * c[3],
        ];
        let mut part = Part {
            curve,
            len: powers.len(),
            centre: DVec3::ZERO,
            size: 1.0,
            reach_sq: 0.0,
        };
        let bounds = part.bounds();
        part.centre = bounds.centre();
        part.size = power_of_two((bounds.max - bounds.min).max_element());
        part.curve[0] -= part.centre.extend(0.0);
        part.curve = part.curve.map(|c| c / part.size);
        let reach = part.hull().iter().fold(0.0_f64, |reach, control| {
            reach.max(control.truncate().length() + control.w.abs())
        });
        part.reach_sq = reach * reach;
        part
    }

    /// Spheres in the hull of which all spheres of the piece lie (its Bézier points).
    fn hull(&self) -> [DVec4; 4] {
        let [a, b, c, d] = self.curve;
        // With x = 2 t - 1, then from powers of t to Bézier points.
        let t = [
            a - b + c - d,
            2.0 * b - 4.0 * c + 6.0 * d,
            4.0 * c - 12.0 * d,
            8.0 * d,
        ];
        [
            t[0],
            t[0] + t[1] / 3.0,
            t[0] + 2.0 / 3.0 * t[1] + t[2] / 3.0,
            t[0] + t[1] + t[2] + t[3],
        ]
    }

    fn bounds(&self) -> Bounds {
        let hull = self.hull();
        hull.iter().fold(Bounds::EMPTY, |bounds, control| {
            let at = self.centre + self.size * control.truncate();
            let radius = DVec3::splat(self.size * control.w.abs());
            bounds.with_point(at - radius).with_point(at + radius)
        })
    }

    fn at(&self, x: f64) -> DVec4 {
        let curve = self.curve[..self.len].iter().rev();
        curve.fold(DVec4::ZERO, |sum, c| sum * x + *c)
    }

    /// Adds the parts of a ray that are in this piece.
    fn spans(&self, ray: &Ray, number: u32, spans: &mut Spans) {
        let length = ray.dir.length();
        let dir = ray.dir / length;
        let origin = (ray.origin - self.centre) / self.size;
        // From the place nearest to the middle of the piece.
        let start = -origin.dot(dir);
        let origin = origin + start * dir;
        let is_near = origin.length_squared() <= self.reach_sq;
        if !is_near {
            return;
        }
        let way = Way::new(&self.curve[..self.len], origin, dir);
        let to_ray = |s: f64| (start + s) * self.size / length;
        way.parts(|low, high| {
            let (enter, leave) = (to_ray(low), to_ray(high));
            if enter < leave {
                spans.push([(enter, number), (leave, number)]);
            }
        });
    }

    /// The parameter of the sphere in which a point lies deepest, and the square of its distance from that sphere's
    /// centre less the square of the radius.
    fn deepest(&self, point: DVec3) -> (f64, f64) {
        let local = ((point - self.centre) / self.size).extend(0.0);
        let mut about = self.curve;
        about[0] -= local;
        let depth = product(&about[..self.len], |a, b| {
            a.truncate().dot(b.truncate()) - a.w * b.w
        });
        let turns = sign_changes(&derivative(&depth));
        let all = turns.into_iter().chain([-1.0, 1.0]);
        all.map(|x| (x, value(&depth, x)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0.0, f64::INFINITY))
    }
}

/// A ray of unit direction along a piece: polynomials in the parameter of the curve.
struct Way {
    /// From the origin of the ray to the point nearest to the centre of the sphere, reversed.
    b: Poly,
    b_slope: Poly,
    /// The square of half the chord.
    d: Poly,
    d_slope: Poly,
}

impl Way {
    fn new(curve: &[DVec4], origin: DVec3, dir: DVec3) -> Self {
        let mut b = Poly::new();
        // Beside the ray, and the radius.
        let mut beside: SmallVec<[DVec4; 4]> = SmallVec::new();
        for (power, c) in curve.iter().enumerate() {
            let centre = c.truncate();
            let from_centre = if power == 0 { origin - centre } else { -centre };
            let along = from_centre.dot(dir);
            b.push(along);
            beside.push((from_centre - along * dir).extend(c.w));
        }
        let d = product(&beside, |p, q| p.w * q.w - p.truncate().dot(q.truncate()));
        Way {
            b_slope: derivative(&b),
            d_slope: derivative(&d),
            b,
            d,
        }
    }

    /// Gives the parts of the ray that are in the piece.
    fn parts(&self, mut give: impl FnMut(f64, f64)) {
        let mut ends = sign_changes(&self.d);
        ends.insert(0, -1.0);
        ends.push(1.0);
        let mut places: Option<SmallVec<[f64; 24]>> = None;
        for pair in ends.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if value(&self.d, 0.5 * (from + to)) < 0.0 {
                continue;
            }
            let places = places.get_or_insert_with(|| self.extremes());
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let inner = places.iter().copied().filter(|x| from < *x && *x < to);
            for x in inner.chain([from, to, 0.5 * (from + to)]) {
                low = low.min(self.polished(x, (from, to), -1.0));
                high = high.max(self.polished(x, (from, to), 1.0));
            }
            give(low, high);
        }
    }

    /// Where the way into a sphere or out of it may be least or largest.
    fn extremes(&self) -> SmallVec<[f64; 24]> {
        let mut places: SmallVec<[f64; 24]> = SmallVec::new();
        // Where the two extremes fall together the equation has a double root, at which its sign does not change.
        places.extend(sign_changes(&self.d_slope));
        let squares = product(&self.d_slope, |a, b| a * b);
        let chords = times(&product(&self.b_slope, |a, b| a * b), &self.d);
        let len = squares.len().max(chords.len());
        let term = |poly: &Poly, i: usize| poly.get(i).copied().unwrap_or(0.0);
        let difference: Poly = (0..len)
            .map(|i| term(&squares, i) - 4.0 * term(&chords, i))
            .collect();
        places.extend(sign_changes(&difference));
        places
    }

    /// The way into the sphere at a place (`side` −1) or out of it (`side` 1), or a better one nearby.
    fn polished(&self, x: f64, (from, to): (f64, f64), side: f64) -> f64 {
        let way = |x: f64| side * value(&self.d, x).max(0.0).sqrt() - value(&self.b, x);
        let mut best = way(x);
        let mut x = x;
        for _ in 0..POLISH {
            let half = value(&self.d, x).max(0.0).sqrt();
            let slope = value(&self.d_slope, x);
            let rise = side * slope / (2.0 * half) - value(&self.b_slope, x);
            let bend = side
                * (value(&derivative(&self.d_slope), x) / (2.0 * half)
                    - slope * slope / (4.0 * half * half * half))
                - value(&derivative(&self.b_slope), x);
            let next = x - rise / bend;
            let is_inside = from < next && next < to;
            if !is_inside || side * way(next) <= side * best {
                break;
            }
            (x, best) = (next, way(next));
        }
        best
    }
}

/// The square of a polynomial under a symmetric product of its coefficients.
fn product<T: Copy>(c: &[T], times: impl Fn(T, T) -> f64) -> Poly {
    let mut sum = Poly::from_elem(0.0, (2 * c.len()).saturating_sub(1));
    for (i, a) in c.iter().enumerate() {
        for (j, b) in c.iter().enumerate() {
            sum[i + j] += times(*a, *b);
        }
    }
    sum
}

fn times(a: &[f64], b: &[f64]) -> Poly {
    let mut sum = Poly::from_elem(0.0, (a.len() + b.len()).saturating_sub(1));
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            sum[i + j] += a * b;
        }
    }
    sum
}

fn derivative(c: &[f64]) -> Poly {
    let powers = c.iter().enumerate().skip(1);
    #[allow(clippy::cast_precision_loss, reason = "powers are small")]
    powers.map(|(power, c)| power as f64 * c).collect()
}

impl Geometry for SphereSweep {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        for [enter, leave] in self.spans(ray) {
            roots.extend(span(enter, leave).into_iter().flatten());
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let spans = self.spans(ray);
        let found = spans
            .iter()
            .filter_map(|[enter, leave]| span(*enter, *leave));
        found
            .into_iter()
            .find_map(|span| first_visible(&span, from, to))
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let part = &self.0.parts[face as usize];
        let (x, _) = part.deepest(point);
        (point - part.centre) / part.size - part.at(x).truncate()
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.tree.around(point, |number| {
            self.0.parts[number as usize].deepest(point).1 < 0.0
        })
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::shape::check;

    fn sweep(text: &str) -> SphereSweep {
        let mut args = TextArgs::new(text);
        let sweep = SphereSweep::read(&mut args).unwrap();
        assert!(args.is_done());
        sweep
    }

    const BENT: &str = "6, <-2,0,0>, 0.5, <-1,1,0>, 0.4, <0,-1,0.5>, 0.6, <1,1,-0.5>, 0.2, <2,0,0>, 0.5, <2,1,2>, 0.3";

    #[test]
    fn sweeps_are_solids() {
        for kind in ["linear_spline", "b_spline", "cubic_spline"] {
            check::solid(&sweep(&format!("{kind} {BENT}")));
        }
    }

    #[test]
    fn a_linear_sweep_of_equal_radii_is_a_capsule() {
        let capsule = sweep("linear_spline 2, <-1,0,0>, 0.5, <1,0,0>, 0.5");
        let mut rng = check::Random::new(3);
        for _ in 0..2000 {
            let ray = rng.ray_near(&capsule.bounds());
            let mut roots = Vec::new();
            capsule.roots(&ray, &mut roots);
            for root in &roots {
                let p = ray.at(root.t);
                let axis = DVec3::new(p.x.clamp(-1.0, 1.0), 0.0, 0.0);
                assert!(
                    ((p - axis).length() - 0.5).abs() < 1e-12,
                    "{ray:?} {root:?}"
                );
            }
        }
    }

    #[test]
    fn a_sweep_in_a_plane_is_met_straight_on() {
        // The ways in and out have their extremes at the same places.
        let flat =
            sweep("cubic_spline 4, <-2,0,0>, 0.5, <-1,0,0>, 0.5, <1,0,0>, 0.5, <2,0,0>, 0.5");
        for y in [0.0, 0.3, 0.49] {
            let ray = Ray::new(DVec3::new(0.2, y, -5.0), DVec3::Z);
            let mut roots = Vec::new();
            flat.roots(&ray, &mut roots);
            let half = (0.25 - y * y).sqrt();
            assert_eq!(roots.len(), 2);
            assert!((roots[0].t - (5.0 - half)).abs() < 1e-12);
            assert!((roots[1].t - (5.0 + half)).abs() < 1e-12);
        }
    }

    #[test]
    fn too_few_spheres_are_an_error() {
        let fault = |text: &str| {
            SphereSweep::read(&mut TextArgs::new(text))
                .unwrap_err()
                .message
        };
        assert_eq!(
            fault("b_spline 3, <0,0,0>, 1"),
            "a `b_spline` needs at least 4 spheres, found 3"
        );
        assert_eq!(
            fault("natural_spline 3"),
            "expected `linear_spline`, `b_spline` or `cubic_spline` in `sphere_sweep`, found `natural_spline`"
        );
    }
}
