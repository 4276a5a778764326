//! Hits of a surface of revolution as POV-Ray finds them: by the closed forms of the cubic or quadratic along the ray, with
//! their roundings. On nearly level rays the leading coefficient is tiny, and the hits lie beside the surface, or far from
//! it, or are missing (docs/povray-shapes.md, section 5.4).

use super::across;
use crate::base::math::Ray;
use crate::scene::shape::solid::axial::{APEX, BASE, SIDE};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::f64::consts::FRAC_PI_3;

/// Coefficients below this count as zero.
const TINY: f64 = 1e-10;
/// A discriminant below this counts as zero.
const TINY_DISCRIMINANT: f64 = 1e-20;
/// Hits nearer than this are ignored, and caps that have a smaller squared radius.
const LEAST_DISTANCE: f64 = 1e-4;
/// Hits from here on are ignored.
const FARTHEST: f64 = 1e7;

/// The curve between two heights, by falling power of the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    c: [f64; 4],
    low: f64,
    high: f64,
    /// The range of its squared radius; none if that is negative where it turns, and no ray hits it then.
    radii_sq: Option<[f64; 2]>,
}

/// A hit, `k` units of length away.
#[derive(Clone, Copy)]
pub(super) struct NearHit {
    pub(super) k: f64,
    pub(super) face: u32,
    pub(super) is_exit: bool,
}

/// The ends of the solid, whose caps may be open.
pub(super) struct Caps {
    pub(super) heights: [f64; 2],
    pub(super) radii_sq: [f64; 2],
    pub(super) is_open: bool,
}

impl Segment {
    /// The segment between the second and the third of four points.
    pub(super) fn new(p: &[DVec2]) -> Self {
        let (start, end) = (p[1], p[2]);
        let powers = |y: f64| [y * y * y, y * y, y, 1.0];
        let slopes = |y: f64| [3.0 * y * y, 2.0 * y, 1.0, 0.0];
        let inverse = inverse(&[
            powers(start.y),
            powers(end.y),
            slopes(start.y),
            slopes(end.y),
        ]);
        let slope = |before: DVec2, here: DVec2, after: DVec2| {
            (after.x - before.x) / (after.y - before.y) * (2.0 * here.x)
        };
        let values = [
            start.x * start.x,
            end.x * end.x,
            slope(p[0], start, end),
            slope(start, end, p[3]),
        ];
        let c = inverse.map(|[a, b, c, d]| {
            let sum = values[0] * a + values[1] * b + values[2] * c + values[3] * d;
            if sum.abs() < TINY { 0.0 } else { sum }
        });
        let mut segment = Segment {
            c,
            low: start.y,
            high: end.y,
            radii_sq: None,
        };
        let [a, b, c, _] = c;
        let mut turns = real_roots([0.0, 3.0 * a, 2.0 * b, c]);
        turns.retain(|y| (start.y..=end.y).contains(y));
        let [first, last, ..] = values;
        let ends = [first.min(last), first.max(last)];
        segment.radii_sq = turns.iter().try_fold(ends, |[least, most], y| {
            let radius_sq = segment.value(*y);
            (radius_sq >= 0.0).then_some([least.min(radius_sq), most.max(radius_sq)])
        });
        segment
    }

    fn value(&self, y: f64) -> f64 {
        let [a, b, c, d] = self.c;
        y * (y * (a * y + b) + c) + d
    }

    /// Normal of the curve, out of the solid.
    pub(super) fn normal(&self, point: DVec3) -> DVec3 {
        let [a, b, c, _] = self.c;
        let y = point.y;
        let rate = 0.5 * (y * (3.0 * a * y + 2.0 * b) + c);
        DVec3::new(point.x, -rate, point.z)
    }

    /// The distance at which a line enters the space between the least and the largest radius, if it is there ahead of its
    /// start.
    fn entry(&self, ray: &Ray) -> Option<f64> {
        let (p, d) = (ray.origin, ray.dir);
        let [least_sq, most_sq] = self.radii_sq?;
        let (mut enter, mut leave) = if d.y.abs() < TINY {
            let is_level_with = self.low <= p.y && p.y <= self.high;
            is_level_with.then_some((f64::NEG_INFINITY, f64::INFINITY))?
        } else {
            let (low, high) = ((self.low - p.y) / d.y, (self.high - p.y) / d.y);
            (low.min(high), low.max(high))
        };
        let outer = within_circle(ray, most_sq)?;
        (enter, leave) = (enter.max(outer.0), leave.min(outer.1));
        if least_sq < most_sq
            && let Some(hole) = within_circle(ray, least_sq)
            && (hole.0 <= enter || hole.0 <= 0.0)
        {
            enter = enter.max(hole.1);
        }
        (enter <= leave && leave > 0.0).then_some(enter)
    }

    /// Distances to the curve, or rather to where the closed form has it.
    fn distances(&self, ray: &Ray) -> SmallVec<[f64; 3]> {
        let (p, d) = (ray.origin, ray.dir);
        let [a, b, c, rest] = self.c;
        let cubic = [
            a * d.y * d.y * d.y,
            d.y * d.y * (3.0 * a * p.y + b) - (d.x * d.x + d.z * d.z),
            d.y * (p.y * (3.0 * a * p.y + 2.0 * b) + c) - 2.0 * (p.x * d.x + p.z * d.z),
            p.y * (p.y * (a * p.y + b) + c) + rest - p.x * p.x - p.z * p.z,
        ];
        let mut all = real_roots(cubic);
        all.retain(|k| {
            let height = p.y + *k * d.y;
            self.low <= height && height <= self.high
        });
        all
    }
}

/// The nearest hit of a ray of unit direction beyond `from`, where one unit of the scene is `unit` long. Segments are
/// searched in the order in which the ray enters their bounds, up to the nearest hit so far, of those before `from` as well.
pub(super) fn nearest(
    segments: &[Segment],
    caps: &Caps,
    ray: &Ray,
    from: f64,
    unit: f64,
) -> Option<NearHit> {
    let (p, d) = (ray.origin, ray.dir);
    let mut best: Option<NearHit> = None;
    let mut reach = f64::INFINITY;
    let mut note = |k: f64, face: u32, is_exit: bool| {
        if k > LEAST_DISTANCE * unit && k < FARTHEST * unit {
            reach = reach.min(k);
            if k > from && best.is_none_or(|best| k < best.k) {
                best = Some(NearHit { k, face, is_exit });
            }
        }
        reach
    };
    let mut reached = f64::INFINITY;
    if !caps.is_open && d.y.abs() > TINY {
        for (at, face) in [(0, BASE), (1, APEX)] {
            let radius_sq = caps.radii_sq[at];
            let k = (caps.heights[at] - p.y) / d.y;
            let point = across(ray.at(k));
            if radius_sq > LEAST_DISTANCE && point.dot(point) <= radius_sq {
                reached = note(k, face, (face == APEX) == (d.y > 0.0));
            }
        }
    }
    let mut entries: SmallVec<[(f64, &Segment); 8]> = segments
        .iter()
        .filter_map(|segment| Some((segment.entry(ray)?, segment)))
        .collect();
    entries.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (entry, segment) in entries {
        if entry > reached {
            break;
        }
        for k in segment.distances(ray) {
            let is_exit = segment.normal(ray.at(k)).dot(d) > 0.0;
            reached = note(k, SIDE, is_exit);
        }
    }
    best
}

/// The interval of a line within a circle about the axis.
fn within_circle(ray: &Ray, radius_sq: f64) -> Option<(f64, f64)> {
    let (p, d) = (across(ray.origin), across(ray.dir));
    let (a, b, excess) = (d.dot(d), p.dot(d), p.dot(p) - radius_sq);
    if a < TINY {
        return (excess <= 0.0).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let discriminant = b * b - a * excess;
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    Some(((-b - root) / a, (-b + root) / a))
}

/// The inverse of a matrix by its minors.
fn inverse(m: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let others = |of: usize| match of {
        0 => [1, 2, 3],
        1 => [0, 2, 3],
        2 => [0, 1, 3],
        _ => [0, 1, 2],
    };
    let minor = |row: usize, column: usize| {
        let ([a, b, c], [x, y, z]) = (others(row), others(column));
        m[a][x] * m[b][y] * m[c][z] + m[a][y] * m[b][z] * m[c][x] + m[a][z] * m[b][x] * m[c][y]
            - m[c][x] * m[b][y] * m[a][z]
            - m[c][y] * m[b][z] * m[a][x]
            - m[c][z] * m[b][x] * m[a][y]
    };
    let determinant = m[0][0] * minor(0, 0) - m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2)
        - m[0][3] * minor(0, 3);
    let mut inverse = [[0.0; 4]; 4];
    for (row, line) in inverse.iter_mut().enumerate() {
        for (column, value) in line.iter_mut().enumerate() {
            let minor = minor(column, row);
            let signed = if (row + column) % 2 == 0 {
                minor
            } else {
                -minor
            };
            *value = signed / determinant;
        }
    }
    inverse
}

/// The real roots of a cubic, by falling power, in the order of the closed form.
fn real_roots(c: [f64; 4]) -> SmallVec<[f64; 3]> {
    let [a, b, c, d] = c;
    if a.abs() >= TINY {
        return roots_of_cubic([b / a, c / a, d / a]);
    }
    if b.abs() >= TINY {
        return roots_of_quadratic(-c / b, d / b);
    }
    let is_linear = c.abs() >= TINY;
    is_linear.then_some(-d / c).into_iter().collect()
}

/// The roots of `x² − s·x + c`.
fn roots_of_quadratic(s: f64, c: f64) -> SmallVec<[f64; 3]> {
    let discriminant = s * s - 4.0 * c;
    if discriminant.abs() < TINY_DISCRIMINANT {
        return SmallVec::from_slice(&[0.5 * s]);
    }
    if discriminant < 0.0 {
        return SmallVec::new();
    }
    let root = discriminant.sqrt();
    SmallVec::from_slice(&[0.5 * (s + root), 0.5 * (s - root)])
}

/// The roots of `x³ + a·x² + b·x + c`, by Viète's and Cardano's formulas.
fn roots_of_cubic([a, b, c]: [f64; 3]) -> SmallVec<[f64; 3]> {
    let square = a * a;
    let q = (square - 3.0 * b) / 9.0;
    let r = (a * (square - 4.5 * b) + 13.5 * c) / 27.0;
    let (q_cubed, r_squared) = (q * q * q, r * r);
    let third = a / 3.0;
    if q_cubed - r_squared >= 0.0 {
        let angle = (r / q_cubed.sqrt()).acos() / 3.0;
        let size = -2.0 * q.sqrt();
        let at = |turn: f64| size * (angle + turn).cos() - third;
        return SmallVec::from_slice(&[at(0.0), at(2.0 * FRAC_PI_3), at(4.0 * FRAC_PI_3)]);
    }
    let size = ((r_squared - q_cubed).sqrt() + r.abs()).powf(1.0 / 3.0);
    let sum = size + q / size;
    SmallVec::from_slice(&[if r < 0.0 { sum - third } else { -sum - third }])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_those_of_products() {
        for roots in [[-1.0, 0.5, 2.0], [0.25, 0.5, 4.0]] {
            let [a, b, c] = roots;
            let cubic = [1.0, -(a + b + c), a * b + b * c + c * a, -a * b * c];
            let mut all = real_roots(cubic);
            all.sort_by(f64::total_cmp);
            assert!(all.iter().zip(roots).all(|(x, y)| (x - y).abs() < 1e-14));
            assert_eq!(all.len(), 3);
            let mut pair = real_roots([0.0, 2.0, -2.0 * (a + b), 2.0 * a * b]);
            pair.sort_by(f64::total_cmp);
            assert_eq!(pair[..], [a, b]);
        }
        assert_eq!(real_roots([0.0, 0.0, 2.0, -3.0])[..], [1.5]);
        assert_eq!(real_roots([1.0, 0.0, 0.0, 8.0]).len(), 1);
        assert!(real_roots([0.0, 1.0, 0.0, 1.0]).is_empty());
    }
}
