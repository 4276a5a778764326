//! Where a line enters and leaves a ball: the quadratic of spheres and round cylinders.
//!
//! The discriminant comes from the point of closest approach, `r² − |P*|²` (Haines, Günther and Akenine-Möller 2019,
//! "Precision improvements for ray/sphere intersection"), and both differences of squares are factored. From 10⁸ radii
//! away the textbook `b² − ac` misjudges a fifth of all rays, this form none.
//!
//! Error bound: both places lie within 8 roundings of `|p| + |t·dir| + r` of the surface, and a chord deeper than that is
//! not lost (`shape/oracle.rs` tests it against whole numbers).

use glam::DVec3;

/// Above the relative error of the squared distance from the centre by either way to it (40 roundings).
pub(crate) const MARGIN: f64 = 64.0 * f64::EPSILON;

/// The parameters at which the line `p + t · dir` enters and leaves the ball of this radius about the origin, or `None`
/// if it misses or touches. Sorted. All squares must be representable (see `is_comfortable`).
#[inline(always)]
pub(crate) fn ball_chord(p: DVec3, dir: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = dir.dot(dir);
    let b = p.dot(dir);
    let from_centre_sq = p.dot(p);
    // Most lines that are asked for miss by far, which needs no division.
    let size = from_centre_sq * a;
    if size - size * MARGIN - b * b > radius * radius * a && size.is_finite() {
        return None;
    }
    let nearest = p + (-b / a) * dir;
    let nearest_sq = nearest.dot(nearest);
    // Asked in the positive: NaN is a miss.
    let is_near = nearest_sq < radius * radius;
    if !is_near {
        return None;
    }
    let distance = nearest_sq.sqrt();
    let half_sq = (radius - distance) * (radius + distance);
    if half_sq <= 0.0 {
        return None;
    }
    let from_centre = from_centre_sq.sqrt();
    let c = (from_centre - radius) * (from_centre + radius);
    let root = (a * half_sq).sqrt();
    // The root without cancellation first; the other from the product of both, c / a.
    let q = if b < 0.0 { root - b } else { -(root + b) };
    let (t, other) = (q / a, c / q);
    Some((t.min(other), t.max(other)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    /// The chord without the quick answer for lines far off.
    fn is_met(p: DVec3, dir: DVec3, radius: f64) -> bool {
        let nearest = p + (-p.dot(dir) / dir.dot(dir)) * dir;
        let nearest_sq = nearest.dot(nearest);
        let distance = nearest_sq.sqrt();
        nearest_sq < radius * radius && (radius - distance) * (radius + distance) > 0.0
    }

    #[test]
    fn no_line_near_the_outline_is_lost() {
        let mut rng = Random::new(5);
        let mut met = 0;
        for exponent in 0..20_000 {
            let p = rng.vector(1.0) * 2.0_f64.powi(exponent % 50);
            let dir = rng.vector(1.0);
            let nearest = p - (p.dot(dir) / dir.dot(dir)) * dir;
            let radius = nearest.length() * (1.0 + f64::from(exponent % 7 - 3) * f64::EPSILON);
            let chord = ball_chord(p, dir, radius);
            assert_eq!(chord.is_some(), is_met(p, dir, radius));
            met += usize::from(chord.is_some());
        }
        assert!((4_000..16_000).contains(&met), "{met}");
    }
}
