//! Norms in full precision, by the powers of the standard library, and their bounds along a piece of a ray.

use super::Superellipsoid;
use crate::base::math::Ray;
use crate::base::math::roots::interval_roots::{End, Interval, IntervalFunction};
use glam::DVec3;

/// The norm along a piece of a ray on which no coordinate changes sign.
pub(super) struct Along<'s> {
    pub(super) shape: &'s Superellipsoid,
    pub(super) ray: Ray,
}

impl Along<'_> {
    /// Minimum and maximum of each coordinate's magnitude.
    pub(super) fn reach(&self, from: f64, to: f64) -> (DVec3, DVec3) {
        let (a, b) = (self.ray.at(from).abs(), self.ray.at(to).abs());
        (a.min(b), a.max(b))
    }
}

/// The end of a piece at `t`, inside the surface or outside.
pub(super) fn end((t, is_inside): (f64, bool)) -> End<f64> {
    End {
        x: t,
        at: t,
        is_negative: is_inside,
    }
}

impl IntervalFunction for Along<'_> {
    type At = f64;

    fn at(&self, t: f64) -> f64 {
        t
    }

    fn value(&self, t: f64) -> f64 {
        self.shape.size(self.ray.at(t).abs()) - 1.0
    }

    fn slope(&self, t: f64) -> f64 {
        let p = self.ray.at(t);
        self.shape.gradient(p.abs()).dot(p.signum() * self.ray.dir)
    }

    fn values(&self, [from, to]: [f64; 2]) -> Interval {
        let (least, most) = self.reach(from, to);
        Interval {
            low: self.shape.size(least) - 1.0,
            high: self.shape.size(most) - 1.0,
        }
    }

    fn slopes(&self, [from, to]: [f64; 2]) -> Interval {
        let Superellipsoid { across, along } = *self.shape;
        let (least, most) = self.reach(from, to);
        let ring = [least, most].map(|p| norm(p.x, p.y, across));
        let size = [norm(ring[0], least.z, along), norm(ring[1], most.z, along)];
        let by_ring = derivatives(ring, size, along);
        let of_ring = |least: f64, most: f64| {
            let own = derivatives([least, most], ring, across);
            [by_ring[0] * own[0], by_ring[1] * own[1]]
        };
        let rates = [
            of_ring(least.x, most.x),
            of_ring(least.y, most.y),
            derivatives([least.z, most.z], size, along),
        ];
        // The sign of the growth of each coordinate's magnitude is the same on all of the piece.
        let growth = self.ray.at(0.5 * (from + to)).signum() * self.ray.dir;
        let mut sum = Interval::new(0.0, 0.0);
        for axis in 0..3 {
            if growth[axis] != 0.0 {
                let ends = rates[axis].map(|rate| rate * growth[axis]);
                sum.low += ends[0].min(ends[1]);
                sum.high += ends[0].max(ends[1]);
            }
        }
        if sum.low.is_nan() || sum.high.is_nan() {
            return Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        }
        sum
    }
}

/// `(a^p + b^p)^(1/p)` of two numbers that are not negative; their maximum for infinite `p`. Zero if one is and `p` is
/// negative.
pub(super) fn norm(a: f64, b: f64, p: f64) -> f64 {
    let (small, large) = (a.min(b), a.max(b));
    if small == 0.0 {
        return if p < 0.0 { 0.0 } else { large };
    }
    if p < 0.0 {
        let rest = (small / large).powf(-p);
        return small * (rest.ln_1p() / p).exp();
    }
    if p == 2.0 {
        return (a * a + b * b).sqrt();
    }
    let rest = (small / large).powf(p);
    large * (rest.ln_1p() / p).exp()
}

/// [`norm`] and its derivatives by both numbers, for `p >= 1`.
pub(super) fn norm_and_derivatives(a: f64, b: f64, p: f64) -> (f64, [f64; 2]) {
    let (small, large) = (a.min(b), a.max(b));
    let ratio = small / large;
    let (norm, derivatives) = if small == 0.0 || ratio == 0.0 {
        let of_small = if p > 1.0 { 0.0 } else { 1.0 };
        (large, [of_small, 1.0])
    } else if p == 2.0 {
        let norm = (a * a + b * b).sqrt();
        (norm, [small / norm, large / norm])
    } else {
        let rest = ratio.powf(p);
        let growth = (rest.ln_1p() / p).exp();
        let of_large = growth / (1.0 + rest);
        (large * growth, [rest / ratio * of_large, of_large])
    };
    (
        norm,
        if a < b {
            derivatives
        } else {
            [derivatives[1], derivatives[0]]
        },
    )
}

/// The derivative of a norm by one of its two numbers: `(part / whole)^(p − 1)`.
pub(super) fn derivative(part: f64, whole: f64, p: f64) -> f64 {
    if p == 2.0 && whole > 0.0 {
        return part / whole;
    }
    if whole == 0.0 {
        return 1.0;
    }
    ratio(part, whole, p).powf(p - 1.0)
}

/// The ratio of a part to the whole, which rounding does not bring to the wrong side of 1.
fn ratio(part: f64, whole: f64, p: f64) -> f64 {
    if p < 0.0 {
        (part / whole).max(1.0)
    } else {
        (part / whole).min(1.0)
    }
}

/// Minimum and maximum of [`derivative`].
fn derivatives(part: [f64; 2], whole: [f64; 2], p: f64) -> [f64; 2] {
    let ratio = |part: f64, whole: f64| {
        if whole > 0.0 {
            ratio(part, whole, p)
        } else if p < 0.0 && part > 0.0 {
            f64::INFINITY
        } else {
            1.0
        }
    };
    let ends = [ratio(part[0], whole[1]), ratio(part[1], whole[0])].map(|r| r.powf(p - 1.0));
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}
