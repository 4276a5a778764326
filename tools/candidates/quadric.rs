//! Alternative methods for the roots of a ray on a quadric: the quadratic about the origin of the ray, by the textbook,
//! with the larger root first, and with Kahan's discriminant; and about the point nearest to the origin of the quadric.

use crate::rays::quadrics::OnQuadric;
use glam::DVec3;

type Solve = fn(&OnQuadric, &mut Vec<f64>);

pub(crate) const ALL: &[(&str, Solve)] = &[
    ("textbook", |q, out| {
        let (a, b, c) = parts(q, q.ray.origin);
        let discriminant = b * b - a * c;
        if a == 0.0 {
            out.extend((b != 0.0).then(|| -0.5 * c / b));
        } else if discriminant > 0.0 {
            let root = discriminant.sqrt();
            out.extend([(-b - root) / a, (-b + root) / a]);
        }
    }),
    ("larger root first", |q, out| {
        let (a, b, c) = parts(q, q.ray.origin);
        stable(a, b, c, b * b - a * c, 0.0, out);
    }),
    ("Kahan's discriminant", |q, out| {
        let (a, b, c) = parts(q, q.ray.origin);
        stable(a, b, c, kahan(a, b, c), 0.0, out);
    }),
    ("moved near, textbook discriminant", |q, out| {
        let ahead = nearest(q);
        let (a, b, c) = parts(q, q.ray.at(ahead));
        stable(a, b, c, b * b - a * c, ahead, out);
    }),
];

fn nearest(q: &OnQuadric) -> f64 {
    -q.ray.origin.dot(q.ray.dir) / q.ray.dir.length_squared()
}

/// The coefficients of `a·t² + 2b·t + c` from a point on.
fn parts(question: &OnQuadric, p: DVec3) -> (f64, f64, f64) {
    let q = question.numbers;
    let d = question.ray.dir;
    let mixed = |u: DVec3, v: DVec3| {
        q[0] * u.x * v.x
            + q[1] * u.y * v.y
            + q[2] * u.z * v.z
            + 0.5 * q[3] * (u.x * v.y + u.y * v.x)
            + 0.5 * q[4] * (u.x * v.z + u.z * v.x)
            + 0.5 * q[5] * (u.y * v.z + u.z * v.y)
    };
    let linear = DVec3::new(q[6], q[7], q[8]);
    let b = mixed(p, d) + 0.5 * linear.dot(d);
    (mixed(d, d), b, mixed(p, p) + linear.dot(p) + q[9])
}

fn kahan(a: f64, b: f64, c: f64) -> f64 {
    let product = a * c;
    let rest = a.mul_add(c, -product);
    b.mul_add(b, -product) - rest
}

fn stable(a: f64, b: f64, c: f64, discriminant: f64, ahead: f64, out: &mut Vec<f64>) {
    if a == 0.0 {
        out.extend((b != 0.0).then(|| ahead - 0.5 * c / b));
    } else if discriminant > 0.0 {
        let q = -(b + discriminant.sqrt().copysign(b));
        out.extend([ahead + q / a, ahead + c / q]);
    }
}
