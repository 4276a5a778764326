//! Plane curves, extruded along the z axis or revolved about the y axis. With the switch above zero they are revolved:
//! the curve's x is the distance from the axis minus an offset, and the curve is rotated by an angle in degrees.

use super::{Internal, limited};

/// The functions of this group.
pub(super) static LIST: &[Internal] = &[
    Internal::new(0, "f_algbr_cyl1", 5, |p| {
        let (x, y) = plane(p, 5);
        let value = p[3] * (x * x * x.abs() - x * x + y * y);
        // With a negative limit the bounds are swapped, and the order of `min` and `max` decides the value.
        value.min(p[4]).max(-p[4])
    }),
    Internal::new(1, "f_algbr_cyl2", 5, |p| {
        let (x, y) = plane(p, 5);
        let (xx, yy) = (x * x, y * y);
        cut(
            -p[3] * (yy - 2.0 * yy * y + yy * yy - 3.0 * xx * y + 2.0 * xx * xx),
            p[4],
        )
    }),
    Internal::new(2, "f_algbr_cyl3", 5, |p| {
        let (x, y) = plane(p, 5);
        let (xx, yy) = (x * x, y * y);
        cut(
            -p[3] * (yy - x * yy - 2.0 * xx * y + xx * yy + xx * xx),
            p[4],
        )
    }),
    Internal::new(3, "f_algbr_cyl4", 5, |p| {
        let (x, y) = plane(p, 5);
        let (xx, yy) = (x * x, y * y);
        cut(
            p[3] * (yy * y - yy * yy - 3.0 * xx * y - 2.0 * xx * yy - xx * xx),
            p[4],
        )
    }),
    Internal::new(15, "f_devils_curve_2d", 6, |p| {
        let (x, y) = plane(p, 6);
        let (xx, yy) = (x * x, y * y);
        limited(p[3] * (yy * (yy - p[5] * p[5]) - xx * (xx - p[4] * p[4])))
    }),
    Internal::new(21, "f_folium_surface_2d", 6, |p| {
        let (x, y) = plane(p, 6);
        limited(-p[3] * (y * y * (1.0 + (p[5] - 4.0 * p[4]) * x) + x * x * (1.0 + p[5])))
    }),
    Internal::new(34, "f_kampyle_of_eudoxus_2d", 6, |p| {
        let (x, y) = plane(p, 6);
        let xx = x * x;
        limited(p[3] * (p[5] * p[5] * (xx * xx - p[4] * p[5] * xx) - y * y))
    }),
    Internal::new(39, "f_lemniscate_of_gerono_2d", 6, |p| {
        let (x, y) = plane(p, 6);
        let xx = x * x;
        limited(p[3] * (p[5] * p[5] * (p[4] * p[4] * xx - xx * xx) - y * y))
    }),
    Internal::new(50, "f_piriform_2d", 7, |p| {
        let (x, y) = plane(p, 7);
        let cubed = x * x * x;
        limited(p[3] * (p[6] * p[6] * (p[5] * cubed * x + p[4] * cubed) - y * y))
    }),
    Internal::new(67, "f_strophoid_2d", 7, |p| {
        let (x, y) = plane(p, 7);
        limited(p[3] * ((x - p[5]) * y * y + p[6] * p[6] * x * x * (x + p[4])))
    }),
    Internal::new(75, "f_witch_of_agnesi_2d", 6, |p| {
        let (x, y) = plane(p, 6);
        limited(p[3] * (p[5] - y * (p[4] * p[4] + x * x)))
    }),
];

/// The point in the plane of the curve; parameter `at` is the switch, followed by the offset and the angle.
fn plane(p: &[f64], at: usize) -> (f64, f64) {
    let [x, y, z] = [p[0], p[1], p[2]];
    if p[at] <= 0.0 {
        return (x, y);
    }
    let out = (x * x + z * z).sqrt() - p[at + 1];
    let (sin, cos) = p[at + 2].to_radians().sin_cos();
    (out * cos - y * sin, out * sin + y * cos)
}

fn cut(value: f64, limit: f64) -> f64 {
    value.max(-limit).min(limit)
}
