//! `spline`: curves over a parameter through points of one to five components.
//!
//! With keys t₀ < t₁ < ... and values P₀, P₁, ...:
//! * linear: straight segments;
//! * quadratic: in [tᵢ, tᵢ₊₁] the parabola through Pᵢ₋₁, Pᵢ and Pᵢ₊₁; the first interval uses that of the second;
//! * natural: piecewise cubic with continuous second derivatives, which are zero at both ends;
//! * cubic: piecewise cubic whose slope at a point is the mean of the slopes of the two adjacent chords. It only runs
//!   from the second to the last but one point.
//!
//! Outside of its range a curve has its first or last value. All of this was measured with POV-Ray 3.7.

/// The interpolation of a spline.
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

/// Five components; those beyond the spline's number of components are zero.
type Point = [f64; 5];

/// A curve through points at ascending keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spline {
    kind: SplineKind,
    keys: Vec<f64>,
    points: Vec<Point>,
    /// The second derivatives of the natural spline at the points.
    second_derivatives: Vec<Point>,
    len: u8,
}

impl Spline {
    /// The spline `base` with `further` points `(key, point, len)`, of another kind.
    ///
    /// A point replaces an earlier one with the same key. Only at the last key does the earlier point stay, as in
    /// POV-Ray. `len` is the number of components given in the scene.
    #[must_use]
    pub fn new(base: &Spline, kind: SplineKind, further: &[(f64, Point, u8)]) -> Self {
        let mut spline = base.clone();
        spline.kind = kind;
        for &(key, point, len) in further {
            spline.insert(key, point);
            spline.len = spline.len.max(len);
        }
        spline.second_derivatives = spline.solve_second_derivatives();
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

    /// The interpolation that [`Spline::at`] uses.
    #[must_use]
    pub fn kind(&self) -> SplineKind {
        self.kind
    }

    /// The number of components of its values, 2 to 5: a spline of floats gives vectors of two equal components.
    #[must_use]
    pub fn components(&self) -> u8 {
        self.len.max(2)
    }

    /// True if the spline has no points.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The point at `t`; zero for an empty spline.
    #[must_use]
    pub fn at(&self, t: f64) -> Point {
        self.at_as(self.kind, t)
    }

    /// The point at `t` with another interpolation of the same points.
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
        // The comparisons are such that NaN gives the last point.
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

    /// The index of the interval that contains `t`, which is between the first and the last key.
    fn interval(&self, t: f64) -> usize {
        let above = self.keys.partition_point(|&key| key < t);
        above.clamp(1, self.keys.len() - 1) - 1
    }

    /// The linear interpolation in interval `i`.
    fn chord(&self, i: usize, t: f64) -> Point {
        let (a, b) = (self.keys[i], self.keys[i + 1]);
        let u = (t - a) / (b - a);
        let (p, q) = (self.points[i], self.points[i + 1]);
        std::array::from_fn(|c| p[c] + (q[c] - p[c]) * u)
    }

    /// The parabola through the points `i - 1`, `i` and `i + 1`, by Newton's divided differences.
    fn parabola(&self, i: usize, t: f64) -> Point {
        let [a, b, c] = [i - 1, i, i + 1].map(|at| self.keys[at]);
        let (p, q, r) = (self.points[i - 1], self.points[i], self.points[i + 1]);
        std::array::from_fn(|n| {
            let left = (q[n] - p[n]) / (b - a);
            let right = (r[n] - q[n]) / (c - b);
            let second = (right - left) / (c - a);
            p[n] + (t - a) * (left + (t - b) * second)
        })
    }

    /// The natural spline in interval `i`.
    fn natural(&self, i: usize, t: f64) -> Point {
        let h = self.keys[i + 1] - self.keys[i];
        let a = (self.keys[i + 1] - t) / h;
        let b = (t - self.keys[i]) / h;
        let (p, q) = (self.points[i], self.points[i + 1]);
        let (from, to) = (self.second_derivatives[i], self.second_derivatives[i + 1]);
        std::array::from_fn(|c| {
            let correction = (a * a * a - a) * from[c] + (b * b * b - b) * to[c];
            a * p[c] + b * q[c] + correction * (h * h) / 6.0
        })
    }

    /// The cubic spline at `t`.
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
    fn solve_second_derivatives(&self) -> Vec<Point> {
        let count = self.keys.len();
        let mut second_derivatives = vec![[0.0; 5]; count];
        if count < 3 {
            return second_derivatives;
        }
        // Forward: Mᵢ = rightᵢ - upperᵢ Mᵢ₊₁.
        let mut upper = vec![0.0; count];
        for i in 1..count - 1 {
            let before = self.keys[i] - self.keys[i - 1];
            let after = self.keys[i + 1] - self.keys[i];
            let pivot = 2.0 * (before + after) - before * upper[i - 1];
            upper[i] = after / pivot;
            let (p, q, r) = (self.points[i - 1], self.points[i], self.points[i + 1]);
            let previous = second_derivatives[i - 1];
            second_derivatives[i] = std::array::from_fn(|c| {
                let jump = (r[c] - q[c]) / after - (q[c] - p[c]) / before;
                (6.0 * jump - before * previous[c]) / pivot
            });
        }
        for i in (1..count - 1).rev() {
            let next = second_derivatives[i + 1];
            let factor = upper[i];
            for (value, next) in second_derivatives[i].iter_mut().zip(next) {
                *value -= factor * next;
            }
        }
        second_derivatives
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
        let value = spline.at(t)[0];
        assert!(
            (value - expected).abs() < 1e-6,
            "at {t}: {value}, not {expected}"
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
    fn one_to_three_points_fall_back_to_simpler_curves() {
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
    fn equal_keys_replace_except_at_the_last() {
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
    fn nan_gives_the_last_point() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, 3.0), (3.0, 4.0)];
        assert_eq!(spline(SplineKind::Natural, &points).at(f64::NAN)[0], 4.0);
        assert_eq!(spline(SplineKind::Cubic, &points).at(f64::NAN)[0], 3.0);
    }
}
