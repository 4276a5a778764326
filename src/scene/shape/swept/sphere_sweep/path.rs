//! Ends of the chord of a ray in the spheres of a curve segment, as functions of the curve parameter.

use crate::base::math::roots::polynomial::{sign_changes, value};
use glam::{DVec3, DVec4};
use smallvec::SmallVec;

/// Newton steps towards an extreme; the starting points are already nearly right.
const POLISH: usize = 2;

/// A polynomial by rising power.
pub(super) type Poly = SmallVec<[f64; 12]>;
/// Chord of a ray of unit direction: polynomials in the curve parameter.
pub(super) struct ChordEnds {
    /// Negative distance along the ray from its origin to the point nearest to the centre of the sphere.
    b: Poly,
    b_slope: Poly,
    b_bend: Poly,
    /// Squared half-length of the chord.
    d: Poly,
    d_slope: Poly,
    d_bend: Poly,
}

/// The chord at one parameter, with the derivatives of its polynomials.
#[derive(Clone, Copy)]
struct ChordPoint {
    half: f64,
    b: f64,
    d_slope: f64,
    b_slope: f64,
    d_bend: f64,
    b_bend: f64,
}

impl ChordEnds {
    pub(super) fn new(curve: &[DVec4], origin: DVec3, dir: DVec3) -> Self {
        let mut b = Poly::new();
        // Perpendicular offset from the ray, and the radius.
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
        ChordEnds {
            b_bend: derivative(&b_slope),
            d_bend: derivative(&d_slope),
            b,
            b_slope,
            d,
            d_slope,
        }
    }

    /// Passes each span of the ray inside the segment to `give`.
    pub(super) fn spans(&self, mut give: impl FnMut(f64, f64)) {
        let mut ends = sign_changes(&self.d);
        ends.insert(0, -1.0);
        ends.push(1.0);
        let mut params: Option<SmallVec<[f64; 24]>> = None;
        for pair in ends.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if value(&self.d, 0.5 * (from + to)) < 0.0 {
                continue;
            }
            let params = params.get_or_insert_with(|| self.extremes());
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let inner = params.iter().copied().filter(|x| from < *x && *x < to);
            for x in inner.chain([from, to, 0.5 * (from + to)]) {
                let at = self.at(x);
                low = low.min(self.polished(x, &at, from, to, -1.0));
                high = high.max(self.polished(x, &at, from, to, 1.0));
            }
            give(low, high);
        }
    }

    /// Parameters at which the entry or the exit distance may be extreme.
    fn extremes(&self) -> SmallVec<[f64; 24]> {
        let mut params: SmallVec<[f64; 24]> = SmallVec::new();
        // Where the two extremes coincide the equation has a double root, at which its sign does not change.
        params.extend(sign_changes(&self.d_slope));
        let squares = product(&self.d_slope, |a, b| a * b);
        let chords = times(&product(&self.b_slope, |a, b| a * b), &self.d);
        let len = squares.len().max(chords.len());
        let term = |poly: &Poly, i: usize| poly.get(i).copied().unwrap_or(0.0);
        let difference: Poly = (0..len)
            .map(|i| term(&squares, i) - 4.0 * term(&chords, i))
            .collect();
        params.extend(sign_changes(&difference));
        params
    }

    fn at(&self, x: f64) -> ChordPoint {
        let (half, b) = self.chord(x);
        self.with_slopes(x, half, b)
    }

    /// Half-length and `b` of the chord at a parameter.
    fn chord(&self, x: f64) -> (f64, f64) {
        (value(&self.d, x).max(0.0).sqrt(), value(&self.b, x))
    }

    fn with_slopes(&self, x: f64, half: f64, b: f64) -> ChordPoint {
        ChordPoint {
            half,
            b,
            d_slope: value(&self.d_slope, x),
            b_slope: value(&self.b_slope, x),
            d_bend: value(&self.d_bend, x),
            b_bend: value(&self.b_bend, x),
        }
    }

    /// The distance to the entry (`side` −1) or the exit (`side` 1) of the sphere at a parameter, or a more extreme one
    /// nearby.
    fn polished(&self, mut x: f64, at: &ChordPoint, from: f64, to: f64, side: f64) -> f64 {
        let mut best = side * at.half - at.b;
        let mut at = *at;
        for left in (0..POLISH).rev() {
            let (half, slope) = (at.half, at.d_slope);
            let rise = side * slope / (2.0 * half) - at.b_slope;
            let bend = side
                * (at.d_bend / (2.0 * half) - slope * slope / (4.0 * half * half * half))
                - at.b_bend;
            let next = x - rise / bend;
            let is_inside = from < next && next < to;
            if !is_inside {
                break;
            }
            let (half, b) = self.chord(next);
            let at_next = side * half - b;
            if side * at_next <= side * best {
                break;
            }
            (x, best) = (next, at_next);
            if left > 0 {
                at = self.with_slopes(x, half, b);
            }
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
