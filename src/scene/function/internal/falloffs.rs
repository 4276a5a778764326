//! Level sets of densities that fall off with distance.

use super::Internal;

/// The functions of this group.
pub(super) static LIST: &[Internal] = &[
    Internal::new(6, "f_blob", 5, |p| {
        -(blob_density(p, -p[3] / 2.0, p[5]) * p[4] + blob_density(p, p[3] / 2.0, p[7]) * p[6])
    }),
    Internal::new(7, "f_blob2", 4, |p| {
        let bell = |x: f64| (-p[4] * (x * x + p[1] * p[1] + p[2] * p[2])).exp();
        p[6] - p[5] * (bell(p[0]) + bell(p[0] - p[3]))
    }),
    Internal::new(10, "f_cross_ellipsoids", 4, |p| {
        let [a, b, c] = ellipsoids(p);
        p[6] - p[5] * (-p[4] * a.min(b).min(c)).exp()
    }),
    Internal::new(19, "f_flange_cover", 4, |p| {
        let sum: f64 = ellipsoids(p).iter().map(|e| (-p[4] * e).exp()).sum();
        p[6] - p[5] * sum
    }),
    Internal::new(32, "f_isect_ellipsoids", 4, |p| {
        let [a, b, c] = ellipsoids(p);
        p[6] - p[5] * (-p[4] * a.max(b).max(c)).exp()
    }),
    Internal::new(53, "f_quantum", 1, quantum),
    Internal::new(62, "f_spikes", 5, |p| {
        let sum: f64 = ellipsoids(p).iter().map(|e| (-p[4] * e).exp()).sum();
        p[5] * (sum - p[7] * (-p[6] * size_sq(p)).exp())
    }),
    Internal::new(63, "f_spikes_2d", 4, |p| {
        let waves = (p[4] * p[0]).cos() * (p[5] * p[2]).cos();
        p[1] - p[3] * waves * (-p[6] * (p[0] * p[0] + p[2] * p[2])).exp()
    }),
];

fn size_sq(p: &[f64]) -> f64 {
    p[0] * p[0] + p[1] * p[1] + p[2] * p[2]
}

/// The density of a `blob` component of this inverse radius, centred at `x` on the x axis.
fn blob_density(p: &[f64], x: f64, inverse_radius: f64) -> f64 {
    let out = p[0] - x;
    let distance_sq = out * out + p[1] * p[1] + p[2] * p[2];
    let density = (1.0 - distance_sq * inverse_radius * inverse_radius).max(0.0);
    density * density
}

/// The quadratic forms of three ellipsoids along the axes: the coordinate along the axis has weight 1, the others
/// `p[3]`.
fn ellipsoids(p: &[f64]) -> [f64; 3] {
    let [x, y, z] = [p[0] * p[0], p[1] * p[1], p[2] * p[2]];
    let across = p[3];
    [
        x + across * (y + z),
        y + across * (x + z),
        z + across * (x + y),
    ]
}

/// The 3d orbital of hydrogen along the y axis.
fn quantum(p: &[f64]) -> f64 {
    let size_sq = size_sq(p);
    let angular = 3.0 * p[1] * p[1] - size_sq;
    // POV-Ray rounds two thirds to eight digits.
    1.2 - 1.6 * angular * angular * (-2.0 * 0.666_666_66 * size_sq.sqrt()).exp()
}
