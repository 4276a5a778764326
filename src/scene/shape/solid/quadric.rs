//! `quadric { <A, B, C>, <D, E, F>, <G, H, I>, J }`: the zero set of
//! `A·x² + B·y² + C·z² + D·xy + E·xz + F·yz + G·x + H·y + I·z + J`; solid where the value is not positive.
//!
//! Transforms stay in the matrix of the object and are never multiplied into the coefficients, which would cost twice
//! the digits of a translation. A ray is first moved to where it comes closest to the centre of the quadric; there its
//! quadratic has coefficients of the quadric's own size, and the discriminant is computed to the last digit (Kahan
//! 2004, "On the cost of floating-point computation without extra-precise arithmetic"). Each root is then refined on
//! the quadric in space, which flat quadrics need: seen from the side, one 10⁶ times as wide as high lost five digits.
//!
//! Error bound: the value of the quadric at a root is within 8 roundings of its terms (the coordinates of the ray times
//! the slopes, and the terms of the quadric), and no pair of roots deeper than 64 such roundings is lost: 22 families
//! of rays in `tests/stability`, from 4 to 10⁸ times the size.

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::{Bounds, Ray, Step};
use crate::scene::shape::{Geometry, Root, Rounded, Start, Steps, alternate_into, read};
use glam::{DMat3, DVec3};

/// An ellipsoid with a larger ratio of diagonal entries than this has no bounds: they would have no digits left.
const MAX_RATIO: f64 = 1e5;

/// Squared lengths of directions that need no rescaling, which would change no digits.
pub(crate) const UNSCALED_SQUARES: std::ops::Range<f64> =
    f64::from_bits((1023 - 60) << 52)..f64::from_bits((1023 + 60) << 52);

/// Roots count as close to each other if the discriminant is less than this share of the square it comes from.
pub(crate) const CLOSE: f64 = 1.0 / 1024.0;

/// Refinement stops where the value is within this many roundings of its terms: it is not known any better.
pub(crate) const NEAR_ENOUGH: f64 = 2.0;

/// Least depth of a close pair of roots, in roundings of the terms of the value. A double plane has no depth: its
/// discriminant is zero but for roundings, which differ with the start of the ray.
const SHALLOW: f64 = 8.0;

/// Coefficients up to this size are zero to POV-Ray's choice of bounds.
const TINY: f64 = 1e-10;

/// A surface of second order. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadric {
    /// Half of the matrix of second derivatives.
    pub(crate) matrix: Box<DMat3>,
    /// Coefficients of x, y and z.
    pub(crate) linear: DVec3,
    pub(crate) constant: f64,
    /// Centre, where the gradient is zero, if it exists; rays are moved near to it.
    pub(crate) centre: DVec3,
}

impl Quadric {
    /// The quadric with the coefficients of `x², y², z²`, of `xy, xz, yz`, of `x, y, z`, and the constant.
    #[must_use]
    pub fn new(squares: DVec3, mixed: DVec3, linear: DVec3, constant: f64) -> Self {
        let DVec3 { x: d, y: e, z: f } = 0.5 * mixed;
        let matrix = DMat3::from_cols(
            DVec3::new(squares.x, d, e),
            DVec3::new(d, squares.y, f),
            DVec3::new(e, f, squares.z),
        );
        let centre = matrix.inverse() * (-0.5 * linear);
        Quadric {
            matrix: Box::new(matrix),
            linear,
            constant,
            centre: if centre.is_finite() {
                centre
            } else {
                DVec3::ZERO
            },
        }
    }

    /// Reads the three vectors and the constant.
    ///
    /// # Errors
    /// Malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let squares = read::vector(args, "the factors of the squares of the quadric")?;
        let mixed = read::vector(args, "the factors of the mixed terms of the quadric")?;
        let linear = read::vector(args, "the factors of x, y and z of the quadric")?;
        let constant = read::number(args, "the constant of the quadric")?;
        Ok(Quadric::new(squares, mixed, linear, constant))
    }

    /// The part of a box in which POV-Ray searches for the surface (measured): ellipsoids, elliptic cylinders and cones
    /// have their own limits; hyperboloids of one sheet have those of the hyperboloid with a waist 1 wide; a paraboloid
    /// has those of its image with the opposite sign of the constant. Other quadrics have no limits but the box.
    #[must_use]
    pub(crate) fn known_limits(&self, around: &Bounds) -> Bounds {
        let squares = DVec3::from_array([0, 1, 2].map(|axis| self.matrix.col(axis)[axis]));
        let sign = if squares.cmpgt(DVec3::ZERO).bitmask().count_ones() >= 2 {
            1.0
        } else {
            -1.0
        };
        let squares = sign * squares;
        let (own, third): (Vec<usize>, Vec<usize>) = (0..3).partition(|&axis| squares[axis] > 0.0);
        let own_size = |axis: &usize| self.linear[*axis].powi(2) / (4.0 * squares[*axis]);
        let centre: f64 = own.iter().map(own_size).sum();
        let constant = sign * self.constant;
        let constant = match (&own[..], &third[..]) {
            ([_, _, _], []) if constant < centre => constant,
            ([_, _], &[axis]) => match (squares[axis] < 0.0, self.linear[axis] == 0.0) {
                (false, true) if constant < centre => constant,
                (false, false) if centre == 0.0 => -constant,
                (true, true) if constant == centre => constant,
                (true, true) if constant < centre => centre - 1.0,
                _ => return *around,
            },
            _ => return *around,
        };
        let known = Quadric {
            constant: sign * constant,
            ..self.clone()
        };
        known.limited(around, sign < 0.0).unwrap_or(*around)
    }

    /// Returns true if a quadric without mixed terms is a hyperboloid of one sheet or a cone.
    fn is_ruled_around(&self) -> bool {
        let squares = DVec3::new(
            self.matrix.x_axis.x,
            self.matrix.y_axis.y,
            self.matrix.z_axis.z,
        );
        if squares.abs().min_element() <= TINY {
            return false;
        }
        let at_centre = self.constant - (0.25 * self.linear * self.linear / squares).element_sum();
        match squares.cmplt(DVec3::ZERO).bitmask().count_ones() {
            1 => at_centre <= TINY,
            2 => at_centre >= -TINY,
            _ => false,
        }
    }

    fn value(&self, p: DVec3) -> f64 {
        self.at(p).1
    }

    fn half_gradient(&self, p: DVec3) -> DVec3 {
        *self.matrix * p + 0.5 * self.linear
    }

    /// Half of the gradient and the value at a point.
    #[inline]
    fn at(&self, p: DVec3) -> (DVec3, f64) {
        let turned = *self.matrix * p;
        (
            turned + 0.5 * self.linear,
            p.dot(turned) + self.linear.dot(p) + self.constant,
        )
    }

    /// Sum of the magnitudes of the terms of the value at a point.
    fn size_of_terms(&self, p: DVec3) -> f64 {
        let p = p.abs();
        p.dot(self.matrix.abs() * p) + p.dot(self.linear.abs()) + self.constant.abs()
    }

    #[inline]
    fn crossings(&self, ray: &Ray, put: impl FnMut(Root)) -> Start {
        // Scaling by powers of two changes no digits: it only prevents overflow and underflow.
        let dir_size = if UNSCALED_SQUARES.contains(&ray.dir.dot(ray.dir)) {
            1.0
        } else {
            power_of_two(ray.dir.abs().max_element())
        };
        let dir = ray.dir * (1.0 / dir_size);
        let ahead = (self.centre - ray.origin).dot(dir) / dir.dot(dir);
        let near = ray.origin + ahead * dir;
        let (ahead, near) = if near.is_finite() {
            (ahead, near)
        } else {
            (0.0, ray.origin)
        };
        let a = dir.dot(*self.matrix * dir);
        let along = |near: DVec3| {
            let (half_gradient, value) = self.at(near);
            (half_gradient.dot(dir), value)
        };
        let (mut ahead, (mut b, mut c)) = (ahead, along(near));
        let turn = ahead - b / a;
        let is_close = (b * b - a * c).abs() < CLOSE * b * b;
        let mut least = 0.0;
        if is_close && turn.is_finite() {
            // Between the roots the discriminant is most accurate.
            ahead = turn;
            let between = ray.origin + ahead * dir;
            (b, c) = along(between);
            least = SHALLOW * f64::EPSILON * self.size_of_terms(between) * a.abs();
        }
        let (start, mut params, count) = sign_changes(a, b, c, least);
        if count > 0 {
            params = params.map(|t| t + ahead);
            let refined = self.refined(&Ray::new(ray.origin, dir), params);
            if count < 2 || refined[0] <= refined[1] {
                params = refined;
            }
        }
        alternate_into(
            start,
            params.iter().take(count).map(|t| t * (1.0 / dir_size)),
            put,
        )
    }
}

/// Contribution of one coordinate to the value: `square · t² + linear · t`.
struct Part {
    square: f64,
    linear: f64,
}

impl Part {
    /// Minimum over an interval, which may be infinite.
    fn least(&self, low: f64, high: f64) -> f64 {
        let at = |t: f64| {
            let times = |factor: f64| if factor == 0.0 { 0.0 } else { factor * t };
            if self.square == 0.0 {
                times(self.linear)
            } else {
                (times(self.square) + self.linear) * t
            }
        };
        let turn = -0.5 * self.linear / self.square;
        if self.square > 0.0 && low < turn && turn < high {
            at(turn)
        } else {
            at(low).min(at(high))
        }
    }

    /// Interval outside of which the value is above `most`.
    fn not_above(&self, most: f64) -> (f64, f64) {
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        if most.is_nan() {
            return everywhere;
        }
        if self.square > 0.0 {
            let turn = -0.5 * self.linear / self.square;
            let reach = ((most / self.square) + turn * turn).max(0.0).sqrt();
            (turn - reach, turn + reach)
        } else if self.square == 0.0 && self.linear != 0.0 {
            let end = most / self.linear;
            if self.linear > 0.0 {
                (f64::NEG_INFINITY, end)
            } else {
                (end, f64::INFINITY)
            }
        } else {
            everywhere
        }
    }
}

/// The roots of `a·t² + 2b·t + c` in order, their count, and the sign at negative infinity. A root too far for a finite
/// number is infinite. Pairs with a discriminant of up to `least` count as double roots and are left out.
fn sign_changes(a: f64, b: f64, c: f64, least: f64) -> (Start, [f64; 2], usize) {
    let is_inside = if a != 0.0 {
        a < 0.0
    } else if b != 0.0 {
        b > 0.0
    } else {
        c <= 0.0
    };
    let start = if is_inside {
        Start::Inside
    } else {
        Start::Outside
    };
    let discriminant = difference_of_products(b, b, a, c);
    if a == 0.0 {
        (start, [-0.5 * c / b, 0.0], usize::from(b != 0.0))
    } else if discriminant > least {
        let q = -(b + discriminant.sqrt().copysign(b));
        let (t, other) = (q / a, c / q);
        (start, [t.min(other), t.max(other)], 2)
    } else {
        (start, [0.0; 2], 0)
    }
}

/// Computes `a·b − c·d` to within two roundings.
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (left, right) = (a * b, c * d);
    if (left - right).abs() >= 0.5 * left.abs().max(right.abs()) {
        // Little cancellation.
        return left - right;
    }
    let rest = a.mul_add(b, -left) - c.mul_add(d, -right);
    (left - right) + if rest.is_finite() { rest } else { 0.0 }
}

impl Geometry for Quadric {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        self.crossings(ray, |root| roots.push(root))
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut first = None;
        self.crossings(ray, |root| {
            if first.is_none() && from < root.t && root.t < to {
                first = Some(root);
            }
        });
        first
    }

    fn limited(&self, around: &Bounds, is_inverse: bool) -> Option<Bounds> {
        let sign = if is_inverse { -1.0 } else { 1.0 };
        let [a, b, c] = self.matrix.to_cols_array_2d();
        let mixed = [a[1], a[2], b[2]];
        if mixed != [0.0; 3] {
            return Some(*around);
        }
        let squares = [sign * a[0], sign * b[1], sign * c[2]];
        let mut limited = *around;
        for axis in 0..3 {
            let part = |axis: usize| Part {
                square: squares[axis],
                linear: sign * self.linear[axis],
            };
            let least = |axis: usize| part(axis).least(limited.min[axis], limited.max[axis]);
            let others = least((axis + 1) % 3) + least((axis + 2) % 3);
            let (low, high) = part(axis).not_above(-sign * self.constant - others);
            limited.min[axis] = limited.min[axis].max(low);
            limited.max[axis] = limited.max[axis].min(high);
        }
        Some(limited)
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let normal = self.half_gradient(point);
        // Zero only where sheets cross, as in the apex of a cone.
        if normal == DVec3::ZERO {
            DVec3::X
        } else {
            normal
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        self.value(point) <= 0.0
    }

    fn keeps_normal_before_3_8(&self) -> bool {
        true
    }

    /// Finite for ellipsoids only.
    fn bounds(&self) -> Bounds {
        let inverse = self.matrix.inverse();
        let [a, b, c] = inverse.to_cols_array_2d();
        let diagonal = DVec3::new(a[0], b[1], c[2]);
        let minor = self.matrix.x_axis.x * self.matrix.y_axis.y - self.matrix.x_axis.y.powi(2);
        let determinant = self.matrix.determinant();
        let is_definite = minor > 0.0 && determinant * self.matrix.x_axis.x > 0.0;
        let depth = -(self.constant + 0.5 * self.linear.dot(self.centre));
        let reach_sq = depth * diagonal;
        let is_well_conditioned =
            diagonal.abs().max_element() < MAX_RATIO * diagonal.abs().min_element();
        if !(is_definite && is_well_conditioned && reach_sq.is_finite()) {
            return Bounds::EVERYTHING;
        }
        if reach_sq.min_element() < 0.0 {
            return if self.constant > 0.0 {
                Bounds::EMPTY
            } else {
                Bounds::EVERYTHING
            };
        }
        // The inverse of a matrix as well conditioned as this has ten digits.
        let slack = 1e-8 * (self.centre.abs().max_element() + reach_sq.max_element().sqrt());
        let reach = reach_sq.map(f64::sqrt) + slack;
        Bounds::new(self.centre - reach, self.centre + reach)
    }

    fn extends_beyond_bounds(&self) -> bool {
        self.matrix.x_axis.x < 0.0
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Some(Rounded::of_quadric(self, steps))
    }

    /// True of quadrics with mixed terms, and of hyperboloids of one sheet and cones that are not clipped (measured).
    fn tests_bounds(&self, is_clipped: bool) -> bool {
        let mixed = [
            self.matrix.x_axis.y,
            self.matrix.x_axis.z,
            self.matrix.y_axis.z,
        ];
        mixed.iter().any(|half| half.abs() > TINY) || (!is_clipped && self.is_ruled_around())
    }

    fn decides_ties(&self) -> bool {
        true
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::tests::check;

    fn quadric(text: &str) -> Quadric {
        Quadric::read(&mut TextArgs::new(text)).unwrap()
    }

    fn all(quadric: &Quadric, ray: &Ray) -> (Start, Vec<Root>) {
        let mut roots = Vec::new();
        (quadric.roots(ray, &mut roots), roots)
    }

    #[test]
    fn an_ellipsoid_is_a_solid_with_bounds() {
        let ellipsoid = quadric("<1, 2, 0.5>, <0.3, -0.2, 0.4>, <-2, 1, 0.5>, -1");
        assert!(ellipsoid.bounds().is_finite());
        check::solid(&ellipsoid);
    }

    #[test]
    fn unbounded_quadrics_and_outsides_have_roots_in_order() {
        for text in [
            "<1, 0, 1>, <0, 0, 0>, <0, 0, 0>, -1",
            "<1, -1, 1>, <0, 0, 0>, <0, 0, 0>, 0.2",
            "<1, -1, 1>, <0, 0, 0>, <0, 0, 0>, -0.2",
            "<1, 0, 1>, <0, 0, 0>, <0, -1, 0>, 0",
            "<0, 0, 0>, <0, 1, 0>, <0, 1, 0>, 0",
            "<-1, -2, -1>, <0, 0, 0>, <0, 0, 0>, 3",
            "<0, 0, 0>, <0, 0, 0>, <1, 2, 3>, -1",
        ] {
            check::half_space(&quadric(text));
        }
    }

    #[test]
    fn a_sphere_far_from_its_ray_keeps_its_roots() {
        let sphere = quadric("<1,1,1>, <0,0,0>, <0,0,0>, -1");
        for far in [1e3, 1e6, 1e9] {
            let ray = Ray::new(DVec3::new(0.6, 0.0, -far), DVec3::Z);
            let (_, roots) = all(&sphere, &ray);
            assert!((roots[0].t - (far - 0.8)).abs() <= f64::EPSILON * far);
            assert!((roots[1].t - (far + 0.8)).abs() <= f64::EPSILON * far);
        }
        let ray = Ray::new(DVec3::new(0.0, 0.0, -3.0), DVec3::Z * 1e-200);
        assert!((all(&sphere, &ray).1[0].t / 2e200 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_ray_along_an_asymptote_has_one_root() {
        let cylinder = quadric("<1, -1, 0>, <0,0,0>, <0,0,0>, -1");
        let ray = Ray::new(DVec3::new(0.0, 1.0, 0.0), DVec3::new(1.0, 1.0, 0.0));
        let (start, roots) = all(&cylinder, &ray);
        assert_eq!(start, Start::Outside);
        assert_eq!(roots.len(), 1);
        assert_eq!(roots[0].t, -1.0);
    }

    #[test]
    fn a_plane_counted_twice_is_crossed_nowhere() {
        let mut rng = Random::new(48);
        let bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);
        for (text, start) in [
            ("<0, 0, 1>, <0, 0, 0>, <0, 0, 0>, 0", Start::Outside),
            ("<0, 0, -1>, <0, 0, 0>, <0, 0, 0>, 0", Start::Inside),
            ("<0, 0, 1>, <0, 0, 0>, <0, 0, -2>, 1", Start::Outside),
            ("<0, 0, -1>, <0, 0, 0>, <0, 0, 2>, -1", Start::Inside),
            ("<1, 1, 0>, <2, 0, 0>, <0, 0, 0>, 0", Start::Outside),
            ("<1, 4, 1>, <4, -2, -4>, <2, 4, -2>, 1", Start::Outside),
        ] {
            let plane = quadric(text);
            for _ in 0..10_000 {
                let ray = rng.ray_near(&bounds);
                // The same line from farther on.
                let later = Ray::new(ray.at(3.0 * rng.uniform()), ray.dir);
                for ray in [ray, later] {
                    assert_eq!(all(&plane, &ray), (start, vec![]), "{text} {ray:?}");
                }
            }
        }
    }

    #[test]
    fn nothing_and_everything() {
        let nothing = quadric("<1,1,1>, <0,0,0>, <0,0,0>, 1");
        assert!(nothing.bounds().is_empty());
        let everything = quadric("<-1,-1,-1>, <0,0,0>, <0,0,0>, -1");
        assert_eq!(everything.solid_bounds(), Bounds::EVERYTHING);
        assert!(everything.contains(DVec3::X));
        let zero = quadric("<0,0,0>, <0,0,0>, <0,0,0>, 0");
        let (start, roots) = all(&zero, &Ray::new(DVec3::ZERO, DVec3::X));
        assert!(start == Start::Inside && roots.is_empty());
    }
}
