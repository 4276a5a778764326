//! Exact polynomials with integer coefficients, for tests: every double is an integer times a power of two, so signs
//! and numbers of roots are certain.

use dashu_int::IBig;
use dashu_int::ops::Gcd;

/// The `mantissa` and `exponent` of a double `mantissa · 2^exponent`.
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let exponent = i32::try_from((bits >> 52) & 0x7ff).unwrap();
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).unwrap();
    let mantissa = if exponent == 0 {
        fraction
    } else {
        fraction | 1 << 52
    };
    let sign = if x < 0.0 { -1 } else { 1 };
    (sign * mantissa, exponent.max(1) - 1075)
}

/// The smallest `shift >= 0` for which `x · 2^shift` is an integer for all of these numbers.
pub(crate) fn shift(all: &[f64]) -> i32 {
    let needed = all.iter().filter(|x| **x != 0.0).map(|x| -parts(*x).1);
    needed.max().unwrap_or(0)
}

/// `x · 2^shift` as an integer.
pub(crate) fn to_integer(x: f64, shift: i32) -> IBig {
    let (mantissa, exponent) = parts(x);
    if mantissa == 0 {
        return IBig::ZERO;
    }
    IBig::from(mantissa) << usize::try_from(exponent + shift).unwrap()
}

/// An exact polynomial with its coefficients by ascending power; its argument is in units of `2^-scale`.
pub(crate) struct Exact {
    pub(crate) c: Vec<IBig>,
    pub(crate) scale: i32,
}

impl Exact {
    /// The polynomial with these coefficients, by ascending power.
    pub(crate) fn new(c: &[f64]) -> Exact {
        let shift = shift(c);
        let mut c: Vec<IBig> = c.iter().map(|c| to_integer(*c, shift)).collect();
        while c.last().is_some_and(|c| *c == IBig::ZERO) {
            c.pop();
        }
        Exact { c, scale: 0 }
    }

    /// The sign of the value at `t`: -1, 0 or 1.
    pub(crate) fn sign_at(&self, t: f64) -> i32 {
        sign_of(&self.c, self.scale, t)
    }

    /// The number of distinct real roots.
    pub(crate) fn count(&self) -> usize {
        let chain = self.chain();
        let at_infinity = |c: &Vec<IBig>| sign(c.last().unwrap());
        let at_minus_infinity =
            |c: &Vec<IBig>| at_infinity(c) * if c.len().is_multiple_of(2) { -1 } else { 1 };
        changes(&chain, at_minus_infinity) - changes(&chain, at_infinity)
    }

    /// The number of distinct roots in `(low, high]`.
    pub(crate) fn count_between(&self, low: f64, high: f64) -> usize {
        let chain = self.chain();
        let at = |t: f64| changes(&chain, |c| sign_of(c, self.scale, t));
        at(low) - at(high)
    }

    /// The Sturm chain.
    fn chain(&self) -> Vec<Vec<IBig>> {
        let derivative = (1..).zip(&self.c[1..]).map(|(i, c)| c * i).collect();
        let mut chain = vec![self.c.clone(), derivative];
        loop {
            let next = negative_remainder(&chain[chain.len() - 2], &chain[chain.len() - 1]);
            if next.is_empty() {
                return chain;
            }
            chain.push(next);
        }
    }
}

/// The number of sign changes along a Sturm chain, zeros skipped.
fn changes(chain: &[Vec<IBig>], sign_of: impl Fn(&Vec<IBig>) -> i32) -> usize {
    let signs = chain.iter().map(sign_of).filter(|sign| *sign != 0);
    let signs: Vec<i32> = signs.collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn sign_of(c: &[IBig], scale: i32, t: f64) -> i32 {
    let (mantissa, exponent) = parts(t);
    let exponent = exponent + scale;
    let up = usize::try_from(exponent.max(0)).unwrap();
    let down = usize::try_from((-exponent).max(0)).unwrap();
    let t = IBig::from(mantissa) << up;
    let degree = c.len() - 1;
    let terms = c.iter().enumerate();
    let value: IBig = terms
        .map(|(i, c)| (c * t.pow(i)) << (down * (degree - i)))
        .sum();
    sign(&value)
}

pub(crate) fn sign(x: &IBig) -> i32 {
    i32::from(*x > IBig::ZERO) - i32::from(*x < IBig::ZERO)
}

/// The negated remainder of a polynomial division, up to a positive factor; empty for zero.
fn negative_remainder(dividend: &[IBig], divisor: &[IBig]) -> Vec<IBig> {
    let lead = divisor.last().unwrap();
    let mut rest = dividend.to_vec();
    while rest.len() >= divisor.len() {
        let top = rest.last().unwrap().clone();
        let offset = rest.len() - divisor.len();
        for c in &mut rest {
            *c *= lead;
        }
        for (i, c) in divisor.iter().enumerate() {
            rest[offset + i] -= &top * c;
        }
        if sign(lead) < 0 {
            rest.iter_mut().for_each(|c| *c = -c.clone());
        }
        while rest.last().is_some_and(|c| *c == IBig::ZERO) {
            rest.pop();
        }
    }
    let common = rest.iter().fold(IBig::ZERO, |common, c| {
        if common == IBig::ZERO {
            c.clone()
        } else {
            common.gcd(c).into()
        }
    });
    let common = if sign(&common) < 0 { -common } else { common };
    rest.iter().map(|c| -(c / &common)).collect()
}
