//! Ray/sphere intersection: the quadratic of spheres and cylinders.
//!
//! The discriminant is `r² − |P*|²` with the point of closest approach `P*` (Haines, Günther and Akenine-Möller 2019,
//! "Precision improvements for ray/sphere intersection"), and both differences of squares are factored. From a distance
//! of 10⁸ radii the textbook `b² − ac` misclassifies a fifth of all rays, this form none.
//!
//! Error bound: both hit points lie within 8 epsilon of `|p| + |t·dir| + r` of the surface, and no span deeper than
//! that is lost (`shape/oracle.rs` tests it against exact integers).

use glam::DVec3;

/// Upper bound of the relative error of either formula for the squared distance from the centre (40 roundings).
pub(crate) const MARGIN: f64 = 64.0 * f64::EPSILON;

/// The sorted `t` at which the line `p + t · dir` enters and leaves the sphere of this radius around the origin. `None`
/// if it misses or is tangent. All squares must be representable (see `is_comfortable`).
#[inline(always)]
pub(crate) fn sphere_span(p: DVec3, dir: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = dir.dot(dir);
    let b = p.dot(dir);
    let from_centre_sq = p.dot(p);
    // Most lines miss by far; no division is needed to reject them.
    let size = from_centre_sq * a;
    if size - size * MARGIN - b * b > radius * radius * a && size.is_finite() {
        return None;
    }
    let nearest = p + (-b / a) * dir;
    let nearest_sq = nearest.dot(nearest);
    // Tests for true, so that NaN is a miss.
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
    // First the root without cancellation, then the other from their product c / a.
    let q = if b < 0.0 { root - b } else { -(root + b) };
    let (t, other) = (q / a, c / q);
    Some((t.min(other), t.max(other)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    /// The hit test without the early rejection of distant lines.
    fn is_hit(p: DVec3, dir: DVec3, radius: f64) -> bool {
        let nearest = p + (-p.dot(dir) / dir.dot(dir)) * dir;
        let nearest_sq = nearest.dot(nearest);
        let distance = nearest_sq.sqrt();
        nearest_sq < radius * radius && (radius - distance) * (radius + distance) > 0.0
    }

    #[test]
    fn no_line_near_the_silhouette_is_lost() {
        let mut rng = Random::new(5);
        let mut hits = 0;
        for exponent in 0..20_000 {
            let p = rng.vector(1.0) * 2.0_f64.powi(exponent % 50);
            let dir = rng.vector(1.0);
            let nearest = p - (p.dot(dir) / dir.dot(dir)) * dir;
            let radius = nearest.length() * (1.0 + f64::from(exponent % 7 - 3) * f64::EPSILON);
            let chord = sphere_span(p, dir, radius);
            assert_eq!(chord.is_some(), is_hit(p, dir, radius));
            hits += usize::from(chord.is_some());
        }
        assert!((4_000..16_000).contains(&hits), "{hits}");
    }
}
