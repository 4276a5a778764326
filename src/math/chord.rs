//! Where a line enters and leaves a ball: the quadratic of spheres and round cylinders.
//!
//! The discriminant comes from the point of closest approach, `r² − |P*|²` (Haines, Günther and Akenine-Möller 2019,
//! "Precision improvements for ray/sphere intersection"), and both differences of squares are factored. From 10⁸ radii
//! away the textbook `b² − ac` misjudges a fifth of all rays, this form none.

use glam::DVec3;

/// The parameters at which the line `p + t · dir` enters and leaves the ball of this radius about the origin, or `None`
/// if it misses or touches. Sorted. All squares must be representable (see `is_comfortable`).
#[inline]
pub(crate) fn ball_chord(p: DVec3, dir: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = dir.dot(dir);
    let b = p.dot(dir);
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
    let from_centre = p.dot(p).sqrt();
    let c = (from_centre - radius) * (from_centre + radius);
    let root = (a * half_sq).sqrt();
    // The root without cancellation first; the other from the product of both, c / a.
    let q = if b < 0.0 { root - b } else { -(root + b) };
    let (t, other) = (q / a, c / q);
    Some((t.min(other), t.max(other)))
}
