//! Algebraic surfaces: polynomials, multiplied by a field strength and clamped to [`LIMIT`](super::LIMIT).
//!
//! Most are named after curves and surfaces in Lawrence, "A Catalog of Special Plane Curves" (1972), and similar books.
//! Where POV-Ray's polynomial differs from the published one, this is POV-Ray's.

use super::{Internal, limited};

/// The functions of this group.
pub(super) static LIST: &[Internal] = &[
    Internal::new(4, "f_bicorn", 2, bicorn),
    Internal::new(5, "f_bifolia", 2, bifolia),
    Internal::new(8, "f_boy_surface", 2, boy_surface),
    Internal::new(11, "f_crossed_trough", 1, |p| {
        limited(p[3] * (p[0] * p[0] * p[2] * p[2] - p[1]))
    }),
    Internal::new(12, "f_cubic_saddle", 1, |p| {
        limited(p[3] * (p[2] + cube(p[1]) - cube(p[0])))
    }),
    Internal::new(13, "f_cushion", 1, cushion),
    Internal::new(14, "f_devils_curve", 1, devils_curve),
    Internal::new(16, "f_dupin_cyclid", 6, dupin_cyclid),
    Internal::new(18, "f_enneper", 1, enneper),
    Internal::new(20, "f_folium_surface", 3, folium_surface),
    Internal::new(22, "f_glob", 1, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * (0.5 * x * x * p[0] + 0.5 * x * x - y - z))
    }),
    Internal::new(23, "f_heart", 1, heart),
    Internal::new(30, "f_hunt_surface", 1, hunt_surface),
    Internal::new(31, "f_hyperbolic_torus", 3, hyperbolic_torus),
    Internal::new(33, "f_kampyle_of_eudoxus", 3, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * (p[5] * p[5] * (x * x - p[4] * p[4] * x) - y - z))
    }),
    Internal::new(35, "f_klein_bottle", 1, klein_bottle),
    Internal::new(36, "f_kummer_surface_v1", 1, |p| {
        let [x, y, z] = squares(p);
        let fourth = x * x + y * y + z * z;
        limited(-p[3] * (fourth - x - y - z - x * y - x * z - y * z + 1.0))
    }),
    Internal::new(37, "f_kummer_surface_v2", 4, |p| {
        let [x, y, z] = squares(p);
        let mixed = p[5] * (x * y + x * z + y * z) + p[6] * (p[0] * p[1] * p[2]);
        let fourth = x * x + y * y + z * z;
        limited(-p[3] * (fourth + p[4] * (x + y + z) + mixed - 1.0))
    }),
    Internal::new(38, "f_lemniscate_of_gerono", 1, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * (x - x * x - y - z))
    }),
    Internal::new(41, "f_mitre", 1, |p| {
        let [x, y, z] = squares(p);
        limited(-p[3] * (4.0 * x * (x + y + z) - y * (1.0 - y - z)))
    }),
    Internal::new(42, "f_nodal_cubic", 1, |p| {
        limited(p[3] * (6.0 * p[1] * p[2] - cube(p[1]) - cube(p[2])))
    }),
    Internal::new(43, "f_odd", 1, cushion),
    Internal::new(44, "f_ovals_of_cassini", 4, ovals_of_cassini),
    Internal::new(45, "f_paraboloid", 1, |p| {
        let [x, _, z] = squares(p);
        limited(p[3] * (p[1] - x - z))
    }),
    Internal::new(46, "f_parabolic_torus", 3, parabolic_torus),
    Internal::new(48, "f_pillow", 1, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * (x * x + y * y + z * z - x - y - z))
    }),
    Internal::new(49, "f_piriform", 1, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * (x * x - x * p[0] + y + z))
    }),
    Internal::new(54, "f_quartic_paraboloid", 1, |p| {
        let [x, _, z] = squares(p);
        limited(p[3] * (p[1] - x * x - z * z))
    }),
    Internal::new(55, "f_quartic_saddle", 1, |p| {
        let [x, _, z] = squares(p);
        limited(p[3] * (p[1] - x * x + z * z))
    }),
    Internal::new(56, "f_quartic_cylinder", 3, |p| {
        let [x, y, z] = squares(p);
        let width = p[5] * p[5];
        limited(p[3] * (p[4] * p[4] * width - (x + z) * (y + width)))
    }),
    Internal::new(65, "f_steiners_roman", 1, |p| {
        let [x, y, z] = squares(p);
        limited(-p[3] * (x * y + x * z + y * z + p[0] * p[1] * p[2]))
    }),
    Internal::new(66, "f_strophoid", 4, |p| {
        let [x, y, z] = squares(p);
        limited(p[3] * ((p[0] - p[5]) * (y + z) + p[6] * p[6] * x * (p[0] + p[4])))
    }),
    Internal::new(71, "f_torus2", 3, |p| {
        let [x, y, z] = squares(p);
        let (major, minor) = (p[4] * p[4], p[5] * p[5]);
        let sum = x + y + z + major - minor;
        limited(-p[3] * (sum * sum - 4.0 * major * (x + z)))
    }),
    Internal::new(72, "f_torus_gumdrop", 1, |p| {
        let [x, y, z] = squares(p);
        let fourth = 4.0 * (x * x + (y + z) * (y + z)) + 17.0 * x * (y + z);
        limited(-p[3] * (fourth - 20.0 * (x + y + z) + 17.0))
    }),
    Internal::new(73, "f_umbrella", 1, |p| {
        limited(p[3] * (p[1] * p[2] * p[2] - p[0] * p[0]))
    }),
    Internal::new(74, "f_witch_of_agnesi", 2, |p| {
        let [x, _, z] = squares(p);
        limited(p[3] * (p[4] * (1.0 - p[1]) - p[1] * (x + z)))
    }),
];

fn squares(p: &[f64]) -> [f64; 3] {
    [p[0] * p[0], p[1] * p[1], p[2] * p[2]]
}

fn cube(a: f64) -> f64 {
    a * a * a
}

fn bicorn(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let (round, size) = (x + z, p[4] * p[4]);
    let side = round + 2.0 * p[4] * p[1] - size;
    limited(p[3] * (y * (size - round) - side * side))
}

fn bifolia(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let sum = x + y + z;
    limited(-p[3] * (sum * sum - p[4] * p[1] * (x + z)))
}

/// Apéry's polynomial for Boy's surface.
fn boy_surface(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let (root, rest, round, zz) = (2f64.sqrt(), 1.0 - z, x * x + y * y, z * z);
    let third = 27.0 * round * round - 24.0 * zz * round
        + 36.0 * root * y * z * (y * y - 3.0 * x * x)
        + 4.0 * zz * zz;
    let last = -81.0 * round * round - 72.0 * zz * round
        + 108.0 * root * x * z * (x * x - 3.0 * y * y)
        + 4.0 * zz * zz;
    let value = 64.0 * cube(rest * z) - 48.0 * rest * rest * zz * (3.0 * round + 2.0 * zz)
        + 12.0 * rest * z * third
        + (9.0 * round - 2.0 * zz) * last;
    limited(p[3] * p[4] * value)
}

/// Both `f_cushion` and `f_odd`.
fn cushion(p: &[f64]) -> f64 {
    let ([x, y, z], height) = (squares(p), p[2]);
    let value = x + y - 2.0 * z + 2.0 * z * height + 2.0 * y * height - z * z + x * z
        - y * z
        - y * y
        - 2.0 * x * y
        - x * x;
    limited(p[3] * value)
}

fn devils_curve(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    limited(p[3] * (y * y - 0.25 * y - (x + z) * (x + z) + 0.36 * x))
}

/// A torus about the y axis, translated by `p[6]` along x and `p[7]` along y, and inverted in a sphere of radius `p[8]`
/// about the origin. The last term is not part of the inversion; it matches POV-Ray.
fn dupin_cyclid(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let (major, minor, k) = (p[4] * p[4], p[5] * p[5], p[8] * p[8]);
    let sum = x + y + z;
    let moved = p[6] * p[6] + p[7] * p[7] + major - minor;
    let a = k * k - 2.0 * k * (p[0] * p[6] + p[1] * p[7]) + sum * moved;
    let (across, along) = (k * p[0] - p[6] * sum, k * p[2]);
    let torus = a * a - 4.0 * major * (across * across + along * along);
    limited(p[3] * (-torus - 8.0 * k * p[7] * (major - minor) * p[1] * sum))
}

/// `f_enneper` of version 3.8.
pub(super) static ENNEPER_OF_3_8: Internal = Internal::new(18, "f_enneper", 1, enneper_of_3_8);

/// Enneper's surface.
fn enneper_of_3_8(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let saddle = saddle(x, y, p[2]);
    let half = saddle / 2.0 - (x + y + 8.0 * z / 9.0) / 4.0 + 2.0 / 9.0;
    limited(p[3] * (6.0 * half * half - cube(saddle + 2.0 * z / 9.0 + 2.0 / 3.0)))
}

/// `(y - x) / 2z` with a bound that keeps the divisor from zero, as in POV-Ray.
fn saddle(x: f64, y: f64, z: f64) -> f64 {
    /// The least magnitude of the divisor.
    const FLAT: f64 = 0.2;
    (y - x) / (2.0 * if z.abs() < FLAT { FLAT } else { z })
}

/// Enneper's surface without two of its constants, as in POV-Ray 3.7.
fn enneper(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let saddle = saddle(x, y, p[2]);
    let half = saddle / 2.0;
    limited(p[3] * (6.0 * half * half - cube(saddle + 2.0 * z / 9.0)))
}

fn folium_surface(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    limited(p[3] * ((y + z) * (1.0 + (p[5] - 4.0 * p[4]) * p[0]) + x * (1.0 + p[5])))
}

fn heart(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let body = 2.0 * x + y + z - 1.0;
    limited(-p[3] * (cube(body) - (0.1 * x + y) * z * p[2]))
}

fn hunt_surface(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let side = 3.0 * x + y - 4.0 * z - 12.0;
    limited(-p[3] * (4.0 * cube(x + y + z - 13.0) + 27.0 * side * side))
}

fn hyperbolic_torus(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let (major, minor) = (p[4] * p[4], p[5] * p[5]);
    let sum = x + y - z + major - minor;
    limited(-p[3] * (sum * sum - 4.0 * major * (x - z)))
}

fn klein_bottle(p: &[f64]) -> f64 {
    let ([x, y, z], high) = (squares(p), p[1]);
    let sum = x + y + z;
    let below = sum - 2.0 * high - 1.0;
    let value = (sum + 2.0 * high - 1.0) * (below * below - 8.0 * z) + 16.0 * p[0] * p[2] * below;
    limited(-p[3] * value)
}

fn ovals_of_cassini(p: &[f64]) -> f64 {
    let [x, y, z] = squares(p);
    let (major, filling) = (p[4] * p[4], p[5] * p[5]);
    let sum = x + y + z + major;
    limited(-p[3] * (sum * sum - p[6] * major * (x + z) - filling))
}

fn parabolic_torus(p: &[f64]) -> f64 {
    let ([x, y, _], z) = (squares(p), p[2]);
    let (major, minor) = (p[4] * p[4], p[5] * p[5]);
    let (difference, sum) = (major - minor, x + y - z);
    let value = sum * sum + difference * (sum + difference) - 2.0 * major * (x - z);
    limited(-p[3] * value)
}
