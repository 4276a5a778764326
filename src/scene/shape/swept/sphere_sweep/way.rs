//! A ray along a piece of a sweep: the way into its spheres and out of them as a function of the curve's parameter.

use crate::base::math::roots::polynomial::{sign_changes, value};
use glam::{DVec3, DVec4};
use smallvec::SmallVec;

/// Newton steps towards an extreme of the way to the surface; the places found before are nearly right.
const POLISH: usize = 2;

/// A polynomial by rising power.
type Poly = SmallVec<[f64; 12]>;
/// A ray of unit direction along a piece: polynomials in the parameter of the curve.
pub(super) struct Way {
    /// From the origin of the ray to the point nearest to the centre of the sphere, reversed.
    b: Poly,
    b_slope: Poly,
    b_bend: Poly,
    /// The square of half the chord.
    d: Poly,
    d_slope: Poly,
    d_bend: Poly,
}

impl Way {
    pub(super) fn new(curve: &[DVec4], origin: DVec3, dir: DVec3) -> Self {
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
        let (b_slope, d_slope) = (derivative(&b), derivative(&d));
        Way {
            b_bend: derivative(&b_slope),
            d_bend: derivative(&d_slope),
            b,
            b_slope,
            d,
            d_slope,
        }
    }

    /// Gives the parts of the ray that are in the piece.
    pub(super) fn parts(&self, mut give: impl FnMut(f64, f64)) {
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
                * (value(&self.d_bend, x) / (2.0 * half)
                    - slope * slope / (4.0 * half * half * half))
                - value(&self.b_bend, x);
            let next = x - rise / bend;
            let is_inside = from < next && next < to;
            if !is_inside {
                break;
            }
            let there = way(next);
            if side * there <= side * best {
                break;
            }
            (x, best) = (next, there);
        }
        best
    }
}

/// The square of a polynomial under a symmetric product of its coefficients.
pub(super) fn product<T: Copy>(c: &[T], times: impl Fn(T, T) -> f64) -> Poly {
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

pub(super) fn derivative(c: &[f64]) -> Poly {
    let powers = c.iter().enumerate().skip(1);
    #[allow(clippy::cast_precision_loss, reason = "powers are small")]
    powers.map(|(power, c)| power as f64 * c).collect()
}
