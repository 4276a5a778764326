//! Double-double numbers (32 digits) with a bound on their own error, and certain counts of the roots of polynomials:
//! the fast alternative to `wide`. Where the bound leaves a question open, there is no answer.
//!
//! A number is the sum of two doubles (Dekker 1971); the errors of the operations are those of Joldes, Muller and
//! Popescu 2017 (sum 3u², product 5u², with u = 2⁻⁵³), taken larger here.

use std::ops::{Add, Mul, Neg, Sub};

/// Relative errors of a sum, a product, and a square root; each above the proven bound.
const OF_SUM: f64 = 1.0 / (1u128 << 104) as f64;
const OF_PRODUCT: f64 = 1.0 / (1u128 << 102) as f64;
const OF_ROOT: f64 = 1.0 / (1u128 << 100) as f64;
/// Underflow of products below the smallest doubles.
const OF_LITTLE: f64 = 1e-290;
/// Above the roundings of a bound itself.
const UP: f64 = 1.0 + 1e-12;
/// Bisections of an interval: nested, and in total.
const DEEPEST: u32 = 100;
const MOST: usize = 2000;
/// Where an interval is split; the later values serve for splits at roots.
const DIVIDE_AT: [f64; 3] = [0.5, 0.5625, 0.453125];

/// `high + low`, with an error of `off` at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sure {
    high: f64,
    low: f64,
    off: f64,
}

/// The sum of two numbers and its rounding error.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The same where the first number is the larger one.
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// An exact number.
pub(crate) fn sure(x: f64) -> Sure {
    Sure {
        high: x,
        low: 0.0,
        off: 0.0,
    }
}

impl Add for Sure {
    type Output = Sure;
    fn add(self, other: Sure) -> Sure {
        let (s, e) = two_sum(self.high, other.high);
        let (t, f) = two_sum(self.low, other.low);
        let (s, e) = quick_two_sum(s, e + t);
        let (high, low) = quick_two_sum(s, e + f);
        Sure {
            high,
            low,
            off: (self.off + other.off + OF_SUM * high.abs()) * UP,
        }
    }
}

impl Neg for Sure {
    type Output = Sure;
    fn neg(self) -> Sure {
        Sure {
            high: -self.high,
            low: -self.low,
            off: self.off,
        }
    }
}

impl Sub for Sure {
    type Output = Sure;
    fn sub(self, other: Sure) -> Sure {
        self + -other
    }
}

impl Mul for Sure {
    type Output = Sure;
    fn mul(self, other: Sure) -> Sure {
        if self.is_zero() || other.is_zero() {
            return sure(0.0);
        }
        let (p, e) = two_product(self.high, other.high);
        let (high, low) = quick_two_sum(p, e + (self.high * other.low + self.low * other.high));
        let carried = (self.high.abs() + self.off) * other.off + other.high.abs() * self.off;
        Sure {
            high,
            low,
            off: (carried + OF_PRODUCT * high.abs()) * UP + OF_LITTLE,
        }
    }
}

impl Mul<f64> for Sure {
    type Output = Sure;
    fn mul(self, other: f64) -> Sure {
        self * sure(other)
    }
}

impl Sure {
    fn is_zero(self) -> bool {
        self.high == 0.0 && self.off == 0.0
    }

    /// -1, 0 or 1, if that is certain.
    pub(crate) fn sign(self) -> Option<i32> {
        if self.high.abs() > self.off * UP {
            Some(if self.high < 0.0 { -1 } else { 1 })
        } else {
            self.is_zero().then_some(0)
        }
    }

    pub(crate) fn is_positive(self) -> bool {
        self.sign() == Some(1)
    }

    /// Half of it, exactly.
    fn half(self) -> Sure {
        Sure {
            high: 0.5 * self.high,
            low: 0.5 * self.low,
            off: 0.5 * self.off,
        }
    }

    /// The square root of a number that is not negative.
    pub(crate) fn sqrt(self) -> Sure {
        if self.high <= 4.0 * self.off {
            // Anywhere between zero and this.
            let most = (self.high.max(0.0) + self.off).sqrt();
            return Sure {
                high: 0.0,
                low: 0.0,
                off: most * UP,
            };
        }
        let root = self.high.sqrt();
        let (square, rest) = two_product(root, root);
        let missing = (self.high - square) - rest + self.low;
        let (high, low) = quick_two_sum(root, missing / (2.0 * root));
        Sure {
            high,
            low,
            off: (self.off / root + OF_ROOT * root) * UP,
        }
    }

    /// Its absolute value and the error of that.
    pub(crate) fn size(self) -> (f64, f64) {
        (self.high.abs(), self.off + f64::EPSILON * self.high.abs())
    }
}

/// A point or a direction.
pub(crate) type Point = [Sure; 3];

/// The point at `t` on a ray.
pub(crate) fn along(origin: [f64; 3], dir: [f64; 3], t: f64) -> Point {
    [0, 1, 2].map(|i| sure(origin[i]) + sure(t) * sure(dir[i]))
}

pub(crate) fn dot(a: &Point, b: &Point) -> Sure {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The number of sign changes of `a·t² + 2b·t + c`, if it is certain.
pub(crate) fn of_quadratic(a: Sure, b: Sure, c: Sure) -> Option<usize> {
    if a.sign()? == 0 {
        return Some(usize::from(b.sign()? != 0));
    }
    let discriminant = b * b - a * c;
    Some(if discriminant.sign()? > 0 { 2 } else { 0 })
}

/// The number of sign changes of a polynomial in Bernstein form from 0 to 1, if it is certain: by Descartes' rule there
/// is no root where the coefficients have one sign, and one where their sign changes once. Other intervals are split.
pub(crate) fn of_bernstein<const N: usize>(form: [Sure; N]) -> Option<usize> {
    let mut open = vec![(form, 0)];
    let (mut count, mut done) = (0, 0);
    while let Some((form, depth)) = open.pop() {
        let (first, last) = (form[0].sign()?, form[N - 1].sign()?);
        if first == 0 || last == 0 || depth > DEEPEST || done > MOST {
            return None;
        }
        let changes = most_changes(&form);
        if changes < 2 {
            count += changes;
            continue;
        }
        done += 1;
        let (left, right) = DIVIDE_AT
            .iter()
            .map(|at| divided(&form, *at))
            .find(|(_, right)| matches!(right[0].sign(), Some(-1 | 1)))?;
        open.push((left, depth + 1));
        open.push((right, depth + 1));
    }
    Some(count)
}

/// The most sign changes, over all choices of the uncertain signs.
fn most_changes(form: &[Sure]) -> usize {
    // By the sign of the last one, -1 and 1.
    let mut most: [Option<usize>; 2] = [None, None];
    for (number, c) in form.iter().enumerate() {
        let may_be = |sign: i32| c.sign().is_none_or(|own| own == sign || own == 0);
        let change = |own: usize| match number {
            0 => Some(0),
            _ => most[own].max(most[1 - own].map(|count| count + 1)),
        };
        most = [
            change(0).filter(|_| may_be(-1)),
            change(1).filter(|_| may_be(1)),
        ];
    }
    most[0].max(most[1]).unwrap_or(usize::MAX)
}

/// Splits a Bernstein form into both halves (de Casteljau 1959).
fn divided<const N: usize>(form: &[Sure; N], at: f64) -> ([Sure; N], [Sure; N]) {
    let (mut left, mut right) = (*form, *form);
    for step in 1..N {
        left[step - 1] = right[0];
        for i in 0..N - step {
            right[i] = if at == 0.5 {
                (right[i] + right[i + 1]).half()
            } else {
                right[i] * (1.0 - at) + right[i + 1] * at
            };
        }
    }
    left[N - 1] = right[0];
    (left, right)
}
