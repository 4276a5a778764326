//! Alternative methods for the roots of a ray on a sphere about the origin.

use super::torus::Solve;
use crate::rays::families::Question;

pub(crate) const ALL: &[(&str, Solve)] = &[
    ("textbook", |q, out| {
        let (a, b, c) = parts(q);
        let discriminant = b * b - a * c;
        if discriminant > 0.0 {
            let root = discriminant.sqrt();
            out.extend([(-b - root) / a, (-b + root) / a]);
        }
    }),
    ("larger root first", |q, out| {
        let (a, b, c) = parts(q);
        stable(a, b, c, b * b - a * c, out);
    }),
    ("Kahan's discriminant", |q, out| {
        let (a, b, c) = parts(q);
        let product = a * c;
        let rest = a.mul_add(c, -product);
        stable(a, b, c, b.mul_add(b, -product) - rest, out);
    }),
    ("nearest point (Haines)", |q, out| {
        let (a, b, c) = parts(q);
        let near = q.ray.origin - (b / a) * q.ray.dir;
        stable(
            a,
            b,
            c,
            a * (q.minor * q.minor - near.length_squared()),
            out,
        );
    }),
];

fn parts(q: &Question) -> (f64, f64, f64) {
    let (o, d) = (q.ray.origin, q.ray.dir);
    (d.dot(d), o.dot(d), o.dot(o) - q.minor * q.minor)
}

fn stable(a: f64, b: f64, c: f64, discriminant: f64, out: &mut Vec<f64>) {
    if discriminant > 0.0 {
        let q = -(b + discriminant.sqrt().copysign(b));
        out.extend([q / a, c / q]);
    }
}
