//! `spline`: curves through points of one to five components over a parameter.
//!
//! With keys t₀ < t₁ < ... and values P₀, P₁, ...:
//! * linear: straight from point to point;
//! * quadratic: in [tᵢ, tᵢ₊₁] the parabola through Pᵢ₋₁, Pᵢ and Pᵢ₊₁; in the first interval that of the second;
//! * natural: piecewise cubic with continuous second derivatives, which are zero at both ends;
//! * cubic: piecewise cubic whose slope at a point is the mean of the slopes of the two chords that meet there. It runs
//!   from the second to the last but one point only.
//!
//! Outside of its range a curve keeps its first or last value. All of this was measured with POV-Ray 3.7.

/// How a spline runs between its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SplineKind {
    /// `linear_spline`.
    #[default]
    Linear,
    /// `quadratic_spline`.
    Quadratic,
    /// `cubic_spline`.
    Cubic,
    /// `natural_spline`.
    Natural,
}

/// Five components; those beyond the spline's length are zero.
type Point = [f64; 5];

/// A curve through points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spline {
    kind: SplineKind,
    keys: Vec<f64>,
    points: Vec<Point>,
    /// The second derivatives of the natural spline.
    bends: Vec<Point>,
    len: u8,
}

impl Spline {
    /// The curve of `base` with further points, as another kind.
    ///
    /// A point at the key of an earlier one replaces it, but for the last: there the earlier one stays, as in
    /// POV-Ray. `len` is the number of components that the scene gives.
    #[must_use]
    pub fn new(base: &Spline, kind: SplineKind, further: &[(f64, Point, u8)]) -> Self {
        let mut spline = base.clone();
        spline.kind = kind;
        for &(key, point, len) in further {
            spline.insert(key, point);
            spline.len = spline.len.max(len);
        }
        spline.bends = spline.bends_of_points();
        spline
    }

    fn insert(&mut self, key: f64, point: Point) {
        let at = self.keys.partition_point(|&known| known < key);
        if self.keys.get(at) == Some(&key) {
            if at == 0 || at + 1 < self.keys.len() {
                self.points[at] = point;
            }
            return;
        }
        self.keys.insert(at, key);
        self.points.insert(at, point);
    }

    /// How the curve runs if nothing else is asked for.
    #[must_use]
    pub fn kind(&self) -> SplineKind {
        self.kind
    }

    /// The number of components of its values, 2 to 5: a spline of floats gives vectors of two equal ones.
    #[must_use]
    pub fn components(&self) -> u8 {
        self.len.max(2)
    }

    /// Whether it has no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The point of the curve at `t`; zero on an empty one.
    #[must_use]
    pub fn at(&self, t: f64) -> Point {
        self.at_as(self.kind, t)
    }

    /// The point at `t` of the curve of another kind through the same points.
    #[must_use]
    pub fn at_as(&self, kind: SplineKind, t: f64) -> Point {
        let (Some(&first), Some(&last)) = (self.points.first(), self.points.last()) else {
            return [0.0; 5];
        };
        let count = self.keys.len();
        match kind {
            SplineKind::Cubic if count == 2 => {
                return std::array::from_fn(|c| (first[c] + last[c]) / 2.0);
            }
            SplineKind::Cubic if count > 2 => return self.cubic(t),
            _ => {}
        }
        // Written so that what is no number is at the end.
        if t <= self.keys[0] {
            return first;
        }
        let is_before_last = t < self.keys[count - 1];
        if !is_before_last {
            return last;
        }
        let i = self.interval(t);
        match kind {
            SplineKind::Quadratic if count > 2 => self.parabola(i.max(1), t),
            SplineKind::Natural => self.natural(i, t),
            _ => self.chord(i, t),
        }
    }

    /// The interval in which `t` lies, which is between the first and the last key.
    fn interval(&self, t: f64) -> usize {
        let above = self.keys.partition_point(|&key| key < t);
        above.clamp(1, self.keys.len() - 1) - 1
    }

    fn chord(&self, i: usize, t: f64) -> Point {
        let (a, b) = (self.keys[i], self.keys[i + 1]);
        let u = (t - a) / (b - a);
        let (p, q) = (self.points[i], self.points[i + 1]);
        std::array::from_fn(|c| p[c] + (q[c] - p[c]) * u)
    }

    /// Through the points beside `i` and itself, by Newton's divided differences.
    fn parabola(&self, i: usize, t: f64) -> Point {
        let [a, b, c] = [i - 1, i, i + 1].map(|at| self.keys[at]);
        let (p, q, r) = (self.points[i - 1], self.points[i], self.points[i + 1]);
        std::array::from_fn(|n| {
            let left = (q[n] - p[n]) / (b - a);
            let right = (r[n] - q[n]) / (c - b);
            let bend = (right - left) / (c - a);
            p[n] + (t - a) * (left + (t - b) * bend)
        })
    }

    fn natural(&self, i: usize, t: f64) -> Point {
        let h = self.keys[i + 1] - self.keys[i];
        let a = (self.keys[i + 1] - t) / h;
        let b = (t - self.keys[i]) / h;
        let (p, q) = (self.points[i], self.points[i + 1]);
        let (from, to) = (self.bends[i], self.bends[i + 1]);
        std::array::from_fn(|c| {
            let bend = (a * a * a - a) * from[c] + (b * b * b - b) * to[c];
            a * p[c] + b * q[c] + bend * (h * h) / 6.0
        })
    }

    fn cubic(&self, t: f64) -> Point {
        let count = self.keys.len();
        if t <= self.keys[1] {
            return self.points[1];
        }
        let is_before_last = t < self.keys[count - 2];
        if !is_before_last {
            return self.points[count - 2];
        }
        let i = self.interval(t);
        let h = self.keys[i + 1] - self.keys[i];
        let u = (t - self.keys[i]) / h;
        let slope = |i: usize, c: usize| {
            (self.points[i + 1][c] - self.points[i][c]) / (self.keys[i + 1] - self.keys[i])
        };
        std::array::from_fn(|c| {
            let (p, q) = (self.points[i][c], self.points[i + 1][c]);
            let from = (slope(i - 1, c) + slope(i, c)) / 2.0 * h;
            let to = (slope(i, c) + slope(i + 1, c)) / 2.0 * h;
            let d = q - p;
            p + u * (from + u * ((3.0 * d - 2.0 * from - to) + u * (from + to - 2.0 * d)))
        })
    }

    /// Solves the tridiagonal system of the natural spline: hᵢ₋₁ Mᵢ₋₁ + 2(hᵢ₋₁ + hᵢ) Mᵢ + hᵢ Mᵢ₊₁ = 6(sᵢ - sᵢ₋₁).
    fn bends_of_points(&self) -> Vec<Point> {
        let count = self.keys.len();
        let mut bends = vec![[0.0; 5]; count];
        if count < 3 {
            return bends;
        }
        // Forward: Mᵢ = rightᵢ - upperᵢ Mᵢ₊₁.
        let mut upper = vec![0.0; count];
        for i in 1..count - 1 {
            let before = self.keys[i] - self.keys[i - 1];
            let behind = self.keys[i + 1] - self.keys[i];
            let pivot = 2.0 * (before + behind) - before * upper[i - 1];
            upper[i] = behind / pivot;
            let (p, q, r) = (self.points[i - 1], self.points[i], self.points[i + 1]);
            let previous = bends[i - 1];
            bends[i] = std::array::from_fn(|c| {
                let jump = (r[c] - q[c]) / behind - (q[c] - p[c]) / before;
                (6.0 * jump - before * previous[c]) / pivot
            });
        }
        for i in (1..count - 1).rev() {
            let next = bends[i + 1];
            let factor = upper[i];
            for (bend, next) in bends[i].iter_mut().zip(next) {
                *bend -= factor * next;
            }
        }
        bends
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(kind: SplineKind, points: &[(f64, f64)]) -> Spline {
        let further: Vec<_> = points
            .iter()
            .map(|&(t, x)| (t, [x, 0.0, 0.0, 0.0, 0.0], 1))
            .collect();
        Spline::new(&Spline::default(), kind, &further)
    }

    fn close(spline: &Spline, t: f64, expected: f64) {
        let found = spline.at(t)[0];
        assert!(
            (found - expected).abs() < 1e-6,
            "at {t}: {found}, not {expected}"
        );
    }

    /// Printed by POV-Ray 3.7.
    #[test]
    fn curves_are_those_of_pov_ray() {
        let points = [(0.0, 0.0), (1.0, 3.0), (2.0, 1.0), (3.5, 2.0), (5.0, 3.0)];
        let known = [
            (SplineKind::Linear, [0.75, 2.4, 1.466_667, 2.333_333]),
            (
                SplineKind::Quadratic,
                [1.218_75, 2.925, 0.869_333, 2.333_333],
            ),
            (SplineKind::Cubic, [3.0, 2.6835, 1.201_185, 2.0]),
            (
                SplineKind::Natural,
                [1.095_424, 2.681_75, 0.881_778, 2.519_841],
            ),
        ];
        for (kind, values) in known {
            for (t, value) in [0.25, 1.3, 2.7, 4.0].into_iter().zip(values) {
                close(&spline(kind, &points), t, value);
            }
        }
    }

    #[test]
    fn few_points_give_the_curve_that_they_can() {
        use SplineKind::{Cubic, Linear, Natural, Quadratic};
        for kind in [Linear, Quadratic, Cubic, Natural] {
            close(&spline(kind, &[(1.0, 4.0)]), 7.0, 4.0);
            assert!(spline(kind, &[]).is_empty());
            assert_eq!(spline(kind, &[]).at(1.0), [0.0; 5]);
        }
        let two = [(1.0, 0.0), (3.0, 3.0)];
        close(&spline(Linear, &two), 1.3, 0.45);
        close(&spline(Quadratic, &two), 1.3, 0.45);
        close(&spline(Natural, &two), 1.3, 0.45);
        close(&spline(Cubic, &two), 9.0, 1.5);
        close(
            &spline(Cubic, &[(0.0, 0.0), (1.0, 3.0), (2.0, 1.0)]),
            0.2,
            3.0,
        );
    }

    /// Printed by POV-Ray 3.7.
    #[test]
    fn equal_keys_replace_but_for_the_last() {
        use SplineKind::Linear;
        close(
            &spline(Linear, &[(0.0, 0.0), (1.0, 10.0), (1.0, 20.0)]),
            1.0,
            10.0,
        );
        let earlier = [(0.0, 0.0), (2.0, 50.0), (1.0, 10.0), (1.0, 20.0)];
        close(&spline(Linear, &earlier), 1.0, 20.0);
        close(
            &spline(Linear, &[(0.0, 0.0), (0.0, 5.0), (2.0, 50.0)]),
            0.0,
            5.0,
        );
    }

    #[test]
    fn what_is_no_number_gives_the_last_point() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, 3.0), (3.0, 4.0)];
        assert_eq!(spline(SplineKind::Natural, &points).at(f64::NAN)[0], 4.0);
        assert_eq!(spline(SplineKind::Cubic, &points).at(f64::NAN)[0], 3.0);
    }
}
