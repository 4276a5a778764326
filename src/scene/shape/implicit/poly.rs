//! `poly { order, <coefficients> }`, `polynomial { order, xyz(2, 0, 0): 1, ... }`, `cubic { <20 coefficients> }` and
//! `quartic { <35 coefficients> }`: the zero set of a polynomial in x, y and z; solid where it is not positive.
//!
//! Coefficients are ordered by falling power of x, of y within that, and of z within that. Restriction to a ray gives a
//! polynomial in one variable `u`, by Horner's rule over lines instead of numbers, about the point of the ray nearest
//! to the origin and in units of that distance or of the surface's own size, whichever is larger. All roots with
//! `|u| <= 1` are sign changes of that polynomial, and those beyond are sign changes of its reverse in `1/u`
//! ([`sign_changes`]). Each is refined on the polynomial in space itself. Error bound: roots lie within the rounding of
//! the terms over the slope, for a torus written as a quartic 2 roundings of the problem's size (`shape/roundings.rs`).
//! `sturm` is accepted and ignored. Order 2 is intersected as a [`Quadric`], with its error bound.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::roots::bracket::Roots;
use crate::base::math::roots::polynomial::{sign_changes, sign_changes_between, value};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Crossings, Geometry, Quadric, Root, Start, SurfaceSide, alternate, first_visible, read,
};
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// The orders that POV-Ray allows.
const ORDERS: std::ops::RangeInclusive<usize> = 2..=MAX_ORDER;
const MAX_ORDER: usize = 35;
/// Orders below this use a smaller array, which is cheaper to clear: most polynomials are quartics at most.
const SMALL_COUNT: usize = 5;

/// A refinement step larger than this share of the size of the ray's polynomial is rejected.
const REFINEMENT: f64 = 1e-4;

/// The value up to which POV-Ray takes a point to be inside (measured by bisection for orders 2, 3, 4 and 6).
const INSIDE_TOLERANCE: f64 = 1e-4;

/// A polynomial surface of any order up to 35. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Poly(Arc<Polynomial>);

#[derive(Debug, PartialEq)]
struct Polynomial {
    order: usize,
    /// By falling power of x, y, z.
    c: Vec<f64>,
    /// The number of leading zeros in each run of coefficients with the same powers of x and y.
    leading_zeros: Vec<usize>,
    /// Distance from the origin at which the terms of highest degree become the largest.
    size: f64,
    /// The same surface, of an order of 2.
    quadric: Option<Quadric>,
}

/// A polynomial on a line, by rising power, of degree below `COUNT`.
#[derive(Clone, Copy)]
struct OnLine<const COUNT: usize> {
    c: [f64; COUNT],
    degree: usize,
}

impl Poly {
    /// Reads the order and the coefficients.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, an order out of range, a wrong number of coefficients.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let order = Poly::read_order(args)?;
        args.comma()?;
        Poly::read_coefficients(args, order)
    }

    /// Reads the order and the terms of `polynomial`: `xyz(powers): coefficient`. The last of equal terms counts.
    ///
    /// # Errors
    /// As [`Poly::read`], and a term of a higher degree.
    pub fn read_polynomial(args: &mut dyn Args) -> Parse<Self> {
        let order = Poly::read_order(args)?;
        let mut c = vec![0.0; (order + 1) * (order + 2) * (order + 3) / 6];
        args.comma()?;
        while args.accept(Word::Xyz)? {
            let at = args.last_span();
            expect(args, '(')?;
            let mut powers = [0; 3];
            for power in &mut powers {
                *power = whole(read::number(args, "the power of a coordinate")?);
            }
            expect(args, ')')?;
            expect(args, ':')?;
            let coefficient = read::number(args, "a coefficient of the polynomial")?;
            let Some(index) = index_of(powers, order) else {
                let message = format!(
                    "the powers of a term of order {order} are whole numbers from 0 whose sum is at most {order}"
                );
                let error = Diagnostic::error(at.to(args.last_span()), message);
                return Err(Box::new(
                    error.with_hint("Raise the order, or correct the powers."),
                ));
            };
            c[index] = coefficient;
            args.comma()?;
        }
        Ok(Poly(Arc::new(Polynomial::new(order, c))))
    }

    /// The quadric that it is, of an order of 2.
    pub(in crate::scene::shape) fn as_quadric(&self) -> Option<&Quadric> {
        self.0.quadric.as_ref()
    }

    fn read_order(args: &mut dyn Args) -> Parse<usize> {
        let at = args.span();
        let given = read::number(args, "the order of the poly")?.trunc();
        let order = ORDERS.zip(2_u32..).find(|(_, n)| f64::from(*n) == given);
        order.map(|(order, _)| order).ok_or_else(|| {
            let message = format!("the order of a poly is between 2 and 35, found {given}");
            Box::new(Diagnostic::error(at.to(args.last_span()), message))
        })
    }

    /// Reads the coefficients of `cubic`.
    ///
    /// # Errors
    /// As [`Poly::read`].
    pub fn read_cubic(args: &mut dyn Args) -> Parse<Self> {
        Poly::read_coefficients(args, 3)
    }

    /// Reads the coefficients of `quartic`.
    ///
    /// # Errors
    /// As [`Poly::read`].
    pub fn read_quartic(args: &mut dyn Args) -> Parse<Self> {
        Poly::read_coefficients(args, 4)
    }

    fn read_coefficients(args: &mut dyn Args, order: usize) -> Parse<Self> {
        let count = (order + 1) * (order + 2) * (order + 3) / 6;
        let expected = format!("{count} coefficients between `<` and `>`");
        if !args.accept_mark('<')? {
            return Err(args.expected(&expected));
        }
        let mut c = Vec::with_capacity(count);
        for _ in 0..count {
            args.comma()?;
            if !args.at_expression()? {
                return Err(args.expected(&expected));
            }
            c.push(read::number(args, "a coefficient of the polynomial")?);
        }
        if !args.accept_mark('>')? {
            return Err(args.expected(&format!("`>` after {count} coefficients")));
        }
        Ok(Poly(Arc::new(Polynomial::new(order, c))))
    }
}

impl Polynomial {
    fn new(order: usize, c: Vec<f64>) -> Self {
        let mut largest = vec![0.0_f64; order + 1];
        for (powers, c) in powers_of(order).zip(&c) {
            let degree = powers.iter().sum::<usize>();
            largest[degree] = largest[degree].max(c.abs());
        }
        let top = largest.iter().rposition(|c| *c != 0.0).unwrap_or(0);
        let size = (0..top)
            .map(|degree| {
                let steps = f64::from(u32::try_from(top - degree).unwrap_or(1));
                (largest[degree] / largest[top]).powf(1.0 / steps)
            })
            .fold(0.0, f64::max);
        let mut leading_zeros = Vec::new();
        let mut rest = &c[..];
        for i in (0..=order).rev() {
            for j in (0..=order - i).rev() {
                let (row, others) = rest.split_at(order - i - j + 1);
                leading_zeros.push(row.iter().take_while(|c| **c == 0.0).count());
                rest = others;
            }
        }
        // Scaled by a power of two, so that the squares of coefficients neither overflow nor vanish.
        let unit = power_of_two(c.iter().fold(0.0, |most, c| c.abs().max(most)));
        let quadric = match *c {
            [xx, xy, xz, x, yy, yz, y, zz, z, constant] => Some(Quadric::new(
                DVec3::new(xx, yy, zz) / unit,
                DVec3::new(xy, xz, yz) / unit,
                DVec3::new(x, y, z) / unit,
                constant / unit,
            )),
            _ => None,
        };
        Polynomial {
            order,
            c,
            leading_zeros,
            quadric,
            size: if size.is_finite() { size } else { 1.0 },
        }
    }

    /// Evaluates by Horner's rule: sums over powers of z within sums over powers of y within one over powers of x.
    /// Leading zeros are left out: most polynomials have few terms.
    fn horner<T: Copy>(
        &self,
        zero: T,
        axes: [impl Fn(T) -> T; 3],
        add: impl Fn(T, f64) -> T,
        sum: impl Fn(T, T) -> T,
    ) -> T {
        let [x, y, z] = axes;
        let mut rest = &self.c[..];
        let mut leading_zeros = self.leading_zeros.iter();
        let mut whole = zero;
        for i in (0..=self.order).rev() {
            let mut sheet = zero;
            for j in (0..=self.order - i).rev() {
                let (terms, others) = rest.split_at(self.order - i - j + 1);
                rest = others;
                let skipped = leading_zeros.next().copied().unwrap_or(0);
                let mut row = zero;
                for &c in &terms[skipped..] {
                    row = add(z(row), c);
                }
                sheet = sum(y(sheet), row);
            }
            whole = sum(x(whole), sheet);
        }
        whole
    }

    fn value(&self, p: DVec3) -> f64 {
        let by = |factor: f64| move |sum: f64| sum * factor;
        self.horner(0.0, [by(p.x), by(p.y), by(p.z)], |a, c| a + c, |a, b| a + b)
    }

    /// Value and directional derivative at a point.
    fn value_and_slope(&self, p: DVec3, dir: DVec3) -> (f64, f64) {
        type Jet = (f64, f64);
        let by = |axis: usize| {
            let (factor, rate) = (p[axis], dir[axis]);
            move |(value, slope): Jet| (value * factor, slope * factor + value * rate)
        };
        let add = |(value, slope): Jet, c: f64| (value + c, slope);
        let sum = |a: Jet, b: Jet| (a.0 + b.0, a.1 + b.1);
        self.horner((0.0, 0.0), [by(0), by(1), by(2)], add, sum)
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        // Value and gradient.
        type Jet = (f64, DVec3);
        let by = |axis: usize| {
            move |(value, slopes): Jet| {
                let mut next = slopes * p[axis];
                next[axis] += value;
                (value * p[axis], next)
            }
        };
        let add = |(value, slopes): Jet, c: f64| (value + c, slopes);
        let sum = |a: Jet, b: Jet| (a.0 + b.0, a.1 + b.1);
        self.horner((0.0, DVec3::ZERO), [by(0), by(1), by(2)], add, sum)
            .1
    }

    /// The polynomial on the line `point + u · dir`.
    fn on_line<const COUNT: usize>(&self, point: DVec3, dir: DVec3) -> OnLine<COUNT> {
        let mut whole = OnLine::ZERO;
        let mut next = 0;
        for i in (0..=self.order).rev() {
            let mut sheet = OnLine::ZERO;
            for j in (0..=self.order - i).rev() {
                let mut row = OnLine::ZERO;
                for _ in 0..=self.order - i - j {
                    row.times(point.z, dir.z);
                    row.c[0] += self.c[next];
                    next += 1;
                }
                sheet.times(point.y, dir.y);
                sheet.plus(&row);
            }
            whole.times(point.x, dir.x);
            whole.plus(&sheet);
        }
        whole
    }

    fn crossings(&self, ray: &Ray) -> (Start, Crossings) {
        let dir_size = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir / dir_size;
        let ahead = -ray.origin.dot(dir) / dir.dot(dir);
        let near = ray.origin + ahead * dir;
        let (ahead, near) = if near.is_finite() {
            (ahead, near)
        } else {
            (0.0, ray.origin)
        };
        let size = self.size.max(near.length());
        let size = if size > 0.0 && size.is_finite() {
            size
        } else {
            1.0
        };
        let unit = size / dir.length();
        let step = dir * unit;
        let (start, params) = if self.order < SMALL_COUNT {
            all_sign_changes(&self.on_line::<SMALL_COUNT>(near, step).c[..=self.order])
        } else {
            all_sign_changes(&self.on_line::<{ MAX_ORDER + 1 }>(near, step).c[..=self.order])
        };
        let params = self.refined(near, step, params);
        alternate(start, params.iter().map(|u| (ahead + u * unit) / dir_size))
    }

    /// The roots after two Newton steps in space; unchanged if that breaks their order.
    fn refined(&self, near: DVec3, dir: DVec3, params: Roots) -> Roots {
        let refine = |u: f64| {
            let (value, slope) = self.value_and_slope(near + u * dir, dir);
            let step = value / slope;
            if step.abs() < REFINEMENT * u.abs().min(1.0) {
                u - step
            } else {
                u
            }
        };
        let moved: Roots = params.iter().map(|u| refine(refine(*u))).collect();
        let is_in_order = moved.windows(2).all(|pair| pair[0] < pair[1]);
        if is_in_order { moved } else { params }
    }
}

impl<const COUNT: usize> OnLine<COUNT> {
    const ZERO: Self = OnLine {
        c: [0.0; COUNT],
        degree: 0,
    };

    /// Multiplies by `constant + u · slope`.
    fn times(&mut self, constant: f64, slope: f64) {
        if self.degree == 0 && self.c[0] == 0.0 {
            return;
        }
        self.degree += 1;
        for power in (1..=self.degree).rev() {
            self.c[power] = self.c[power] * constant + self.c[power - 1] * slope;
        }
        self.c[0] *= constant;
    }

    fn plus(&mut self, other: &Self) {
        for power in 0..=other.degree {
            self.c[power] += other.c[power];
        }
        self.degree = self.degree.max(other.degree);
    }
}

/// Takes a punctuation mark of a term.
fn expect(args: &mut dyn Args, mark: char) -> Parse<()> {
    if args.accept_mark(mark)? {
        return Ok(());
    }
    Err(args.expected(&format!("`{mark}` of a term `xyz(0, 0, 0): 1`")))
}

/// The whole part of a power, within limits that no term exceeds.
#[allow(clippy::cast_possible_truncation, reason = "cut to the whole part")]
fn whole(power: f64) -> i32 {
    power.clamp(-99.0, 99.0) as i32
}

/// Index of the coefficient of a term, as POV-Ray computes it: negative powers give the coefficient of another term.
fn index_of([x, y, z]: [i32; 3], order: usize) -> Option<usize> {
    let order = i32::try_from(order).ok()?;
    let [a, b, c] = [order - x, order - x - y, order - x - y - z];
    if a.min(b).min(c) < 0 || a.max(b).max(c) > 2 * order {
        return None;
    }
    let index = (a + 2) * (a + 1) * a / 6 + (b + 1) * b / 2 + c;
    let coefficients = (order + 1) * (order + 2) * (order + 3) / 6;
    usize::try_from(index).ok().filter(|_| index < coefficients)
}

/// Powers of x, y and z of each coefficient, in their order.
fn powers_of(order: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=order).rev().flat_map(move |i| {
        (0..=order - i)
            .rev()
            .flat_map(move |j| (0..=order - i - j).rev().map(move |k| [i, j, k]))
    })
}

/// All sign changes of a polynomial, and the sign at negative infinity. The zero polynomial is inside everywhere.
fn all_sign_changes(c: &[f64]) -> (Start, Roots) {
    let Some(top) = c.iter().rposition(|c| *c != 0.0) else {
        return (Start::Inside, Roots::new());
    };
    let degree_is_odd = top % 2 == 1;
    let is_inside = (c[top] < 0.0) != degree_is_odd;
    let c = &c[..=top];
    let (at_low, at_high) = (value(c, -1.0) < 0.0, value(c, 1.0) < 0.0);
    let reversed: SmallVec<[f64; MAX_ORDER + 1]> = c.iter().rev().copied().collect();
    let beyond = sign_changes(&reversed);
    let mut params = Roots::new();
    // From negative infinity up to -1: 1/u falls from 0 to -1.
    params.extend(beyond.iter().rev().filter(|v| **v < 0.0).map(|v| 1.0 / v));
    fix_parity(&mut params, is_inside != at_low, -1.0);
    params.extend(sign_changes_between(c, at_low, at_high));
    let mut ahead: Roots = beyond
        .iter()
        .filter(|v| **v > 0.0)
        .map(|v| 1.0 / v)
        .collect();
    let ends_inside = c[top] < 0.0;
    fix_parity(&mut ahead, at_high != ends_inside, 1.0);
    ahead.sort_unstable_by(f64::total_cmp);
    params.extend(ahead);
    let start = if is_inside {
        Start::Inside
    } else {
        Start::Outside
    };
    (start, params)
}

/// Makes the number of roots odd or even by adding or removing one at the joint of two intervals.
fn fix_parity(params: &mut Roots, is_odd: bool, joint: f64) {
    /// Distance from the joint within which rounding may hide or create a root.
    const ROUNDED: f64 = 1e-7;
    if (params.len() % 2 == 1) == is_odd {
        return;
    }
    match params.iter().position(|u| (u - joint).abs() < ROUNDED) {
        Some(near) => {
            params.remove(near);
        }
        None => params.push(joint),
    }
}

impl Geometry for Poly {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        if let Some(quadric) = self.as_quadric() {
            return quadric.roots(ray, roots);
        }
        let (start, own) = self.0.crossings(ray);
        roots.extend_from_slice(&own);
        start
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if let Some(quadric) = self.as_quadric() {
            return quadric.nearest(ray, from, to);
        }
        first_visible(&self.0.crossings(ray).1, from, to)
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let normal = self.0.gradient(point);
        // Zero only where sheets of the surface cross.
        if normal == DVec3::ZERO {
            DVec3::X
        } else {
            normal
        }
    }

    fn tests_bounds(&self, _: bool) -> bool {
        true
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.value(point) < INSIDE_TOLERANCE
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Inside
    }

    fn bounds(&self) -> Bounds {
        Bounds::EVERYTHING
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn takes_sturm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
