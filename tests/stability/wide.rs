//! Numbers of 77 digits and the roots of their polynomials, for the exact answers of the suite.
//!
//! A double converts exactly. A question is only valid where its answer stays the same when it changes by a millionth
//! of a pixel, some sixty digits away from the rounding of these numbers.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Binary digits of a number.
const BITS: usize = 256;

/// Halvings before Newton's method takes over.
const HALVINGS: usize = 4;

/// Accuracy of roots and of extremes, as powers of two of their interval.
const FINE: i32 = 220;
const COARSE: i32 = 130;

/// Newton doubles the digits in each step, so this many are never needed.
const STEPS: usize = 200;

/// A number of 77 digits.
#[derive(Clone, Debug)]
pub(crate) struct Wide(FBig<HalfEven, 2>);

/// An exact conversion.
///
/// # Panics
/// For numbers that are not finite: the suite has none.
pub(crate) fn wide(x: f64) -> Wide {
    let exact = FBig::<HalfEven, 2>::try_from(x).expect("a finite number");
    Wide(exact.with_precision(BITS).value())
}

macro_rules! operator {
    ($name:ident, $method:ident, $sign:tt) => {
        impl $name<&Wide> for &Wide {
            type Output = Wide;
            fn $method(self, other: &Wide) -> Wide {
                Wide(&self.0 $sign &other.0)
            }
        }
        impl $name<Wide> for Wide {
            type Output = Wide;
            fn $method(self, other: Wide) -> Wide {
                Wide(self.0 $sign other.0)
            }
        }
        impl $name<&Wide> for Wide {
            type Output = Wide;
            fn $method(self, other: &Wide) -> Wide {
                Wide(self.0 $sign &other.0)
            }
        }
        impl $name<Wide> for &Wide {
            type Output = Wide;
            fn $method(self, other: Wide) -> Wide {
                Wide(&self.0 $sign other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        Wide(-self.0)
    }
}

impl PartialEq for Wide {
    fn eq(&self, other: &Wide) -> bool {
        self.0 == other.0
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Wide) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Wide {
    /// -1, 0 or 1.
    pub(crate) fn sign(&self) -> i32 {
        if self.0.repr().significand().is_zero() {
            0
        } else if self.0.repr().significand().sign() == dashu_int::Sign::Negative {
            -1
        } else {
            1
        }
    }

    pub(crate) fn sqrt(&self) -> Wide {
        Wide(self.0.sqrt())
    }

    pub(crate) fn abs(&self) -> Wide {
        if self.sign() < 0 {
            -self.clone()
        } else {
            self.clone()
        }
    }

    /// The nearest double.
    pub(crate) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}

/// A point or a direction.
pub(crate) type Vector = [Wide; 3];

pub(crate) fn vector(v: [f64; 3]) -> Vector {
    v.map(wide)
}

pub(crate) fn dot(a: &Vector, b: &Vector) -> Wide {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(crate) fn plus(a: &Vector, b: &Vector) -> Vector {
    [&a[0] + &b[0], &a[1] + &b[1], &a[2] + &b[2]]
}

pub(crate) fn minus(a: &Vector, b: &Vector) -> Vector {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

pub(crate) fn times(a: &Vector, by: &Wide) -> Vector {
    [&a[0] * by, &a[1] * by, &a[2] * by]
}

pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        &a[1] * &b[2] - &a[2] * &b[1],
        &a[2] * &b[0] - &a[0] * &b[2],
        &a[0] * &b[1] - &a[1] * &b[0],
    ]
}

/// A polynomial by rising power.
#[derive(Clone, Debug)]
pub(crate) struct Polynomial(pub(crate) Vec<Wide>);

impl Polynomial {
    pub(crate) fn at(&self, t: &Wide) -> Wide {
        let mut terms = self.0.iter().rev();
        let first = terms.next().cloned().unwrap_or_else(|| wide(0.0));
        terms.fold(first, |sum, c| sum * t + c)
    }

    fn derivative(&self) -> Polynomial {
        let terms = (1..).zip(self.0.iter().skip(1));
        Polynomial(terms.map(|(i, c)| c * wide(f64::from(i))).collect())
    }

    /// The product of two.
    pub(crate) fn times(&self, other: &Polynomial) -> Polynomial {
        let mut c = vec![wide(0.0); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                c[i + j] = &c[i + j] + &(a * b);
            }
        }
        Polynomial(c)
    }

    /// The sum of two.
    pub(crate) fn plus(&self, other: &Polynomial) -> Polynomial {
        let len = self.0.len().max(other.0.len());
        let term = |p: &Polynomial, i: usize| p.0.get(i).cloned().unwrap_or_else(|| wide(0.0));
        Polynomial((0..len).map(|i| term(self, i) + term(other, i)).collect())
    }

    pub(crate) fn scaled(&self, by: &Wide) -> Polynomial {
        Polynomial(self.0.iter().map(|c| c * by).collect())
    }

    fn trimmed(mut self) -> Polynomial {
        while self.0.last().is_some_and(|c| c.sign() == 0) {
            self.0.pop();
        }
        self
    }

    /// The sign changes, in order.
    pub(crate) fn sign_changes(&self) -> Vec<Wide> {
        let own = self.clone().trimmed();
        match own.0.len() {
            0 | 1 => Vec::new(),
            2 => vec![-(&own.0[0] / &own.0[1])],
            3 => own.quadratic(),
            _ => {
                let far = own.farthest();
                own.between(&-far.clone(), &far, FINE)
            }
        }
    }

    /// The sign changes between two points, in order.
    pub(crate) fn sign_changes_between(&self, low: &Wide, high: &Wide) -> Vec<Wide> {
        let own = self.clone().trimmed();
        if own.0.len() < 4 {
            let mut all = own.sign_changes();
            all.retain(|t| low < t && t < high);
            return all;
        }
        own.between(low, high, FINE)
    }

    /// Cauchy's bound: no root lies farther out.
    fn farthest(&self) -> Wide {
        let lead = self.0[self.0.len() - 1].abs();
        let most = self.0.iter().fold(wide(0.0), |most, c| {
            let share = c.abs() / &lead;
            if share > most { share } else { most }
        });
        most + wide(1.0)
    }

    fn quadratic(&self) -> Vec<Wide> {
        let [c, b, a] = [&self.0[0], &self.0[1], &self.0[2]];
        let half = b / wide(2.0);
        let discriminant = &half * &half - a * c;
        if discriminant.sign() <= 0 {
            return Vec::new();
        }
        let root = discriminant.sqrt();
        let q = if half.sign() < 0 {
            root - half
        } else {
            -(root + half)
        };
        let (t, other) = (&q / a, c / &q);
        if t < other {
            vec![t, other]
        } else {
            vec![other, t]
        }
    }

    /// One root between each two neighbouring extremes of different sign, to this fraction of the interval.
    fn between(&self, low: &Wide, high: &Wide, share: i32) -> Vec<Wide> {
        let slope = self.derivative();
        let mut ends = vec![low.clone()];
        if slope.0.len() < 4 {
            ends.extend(slope.sign_changes_between(low, high));
        } else {
            ends.extend(slope.between(low, high, COARSE));
        }
        ends.push(high.clone());
        let tiny = (high - low).abs() * wide(2f64.powi(-share));
        let signs: Vec<i32> = ends.iter().map(|t| self.at(t).sign()).collect();
        let mut roots = Vec::new();
        for (pair, signs) in ends.windows(2).zip(signs.windows(2)) {
            if signs[0] * signs[1] < 0 {
                roots.push(self.root_between(&slope, [&pair[0], &pair[1]], signs[0], &tiny));
            }
        }
        roots
    }

    /// The root of an interval without an extreme, to within `tiny`.
    fn root_between(
        &self,
        slope: &Polynomial,
        [low, high]: [&Wide; 2],
        before: i32,
        tiny: &Wide,
    ) -> Wide {
        let (mut low, mut high) = (low.clone(), high.clone());
        let two = wide(2.0);
        let mut t = (&low + &high) / &two;
        // Where the last digits of the value are noise, Newton's steps no longer become smaller.
        let small = tiny * &wide(2f64.powi(80));
        let mut last = &high - &low;
        for step in 0..STEPS {
            let value = self.at(&t);
            match value.sign() * before {
                0 => return t,
                1 => low = t.clone(),
                _ => high = t.clone(),
            }
            let newton = &t - &value / self.slope_or_one(slope, &t);
            let next = if step >= HALVINGS && low < newton && newton < high {
                newton
            } else {
                (&low + &high) / &two
            };
            let moved = (&next - &t).abs();
            t = next;
            if moved <= *tiny || moved < small && &moved + &moved > last {
                break;
            }
            last = moved;
        }
        t
    }

    fn slope_or_one(&self, slope: &Polynomial, t: &Wide) -> Wide {
        let value = slope.at(t);
        if value.sign() == 0 { wide(1.0) } else { value }
    }
}
