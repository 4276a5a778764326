//! Sphere and torus against exact integer arithmetic: every double is an integer times a power of two, so the
//! polynomial of a ray has exact coefficients, a Sturm chain counts its roots, and the sign at a reported root is
//! certain.
//!
//! A reported root must lie between the surfaces whose minor radius is shrunk and grown by 8 roundings of the problem's
//! size, and the number of roots must be one that such a change can cause.

use crate::base::math::Ray;
use crate::base::math::exact::{Exact, shift, to_integer};
use crate::base::math::sampling::random::Random;
use crate::scene::shape::{Geometry, Root, Sphere, Spindle, Torus};
use dashu_int::IBig;
use glam::DVec3;
use std::f64::consts::TAU;

/// Allowed error of a root: 8 roundings of the problem's size.
const TOLERANCE: f64 = 8.0 * f64::EPSILON;

/// Rays per family.
const RAYS: u32 = 400;

/// Origin, direction and lengths as integers, and the exponent of the scale of the ray's parameter.
fn parts_of(ray: &Ray, lengths: &[f64]) -> (Vec<IBig>, Vec<IBig>, Vec<IBig>, i32) {
    let mut all = ray.origin.to_array().to_vec();
    all.extend(lengths);
    let (length, dir) = (shift(&all), shift(&ray.dir.to_array()));
    let lengths = lengths.iter().map(|x| to_integer(*x, length)).collect();
    let origin = ray
        .origin
        .to_array()
        .map(|x| to_integer(x, length))
        .to_vec();
    let direction = ray.dir.to_array().map(|x| to_integer(x, dir)).to_vec();
    (origin, direction, lengths, length - dir)
}

fn exact_torus(ray: &Ray, major: f64, minor: f64) -> Exact {
    let (p, d, radii, scale) = parts_of(ray, &[major, minor]);
    let square = |axes: &[usize]| {
        let sum = |f: &dyn Fn(usize) -> IBig| axes.iter().map(|i| f(*i)).sum::<IBig>();
        [
            sum(&|i| &p[i] * &p[i]),
            sum(&|i| &p[i] * &d[i] * 2),
            sum(&|i| &d[i] * &d[i]),
        ]
    };
    let (major_sq, minor_sq) = (&radii[0] * &radii[0], &radii[1] * &radii[1]);
    let [s0, s1, s2] = square(&[0, 1, 2]);
    let s0 = s0 + &major_sq - minor_sq;
    let [f0, f1, f2] = square(&[0, 2]).map(|x| x * &major_sq * 4);
    let c = vec![
        &s0 * &s0 - f0,
        &s0 * &s1 * 2 - f1,
        &s1 * &s1 + &s0 * &s2 * 2 - f2,
        &s1 * &s2 * 2,
        &s2 * &s2,
    ];
    Exact { c, scale }
}

fn exact_sphere(ray: &Ray, radius: f64) -> Exact {
    let (p, d, radii, scale) = parts_of(ray, &[radius]);
    let dot = |a: &[IBig], b: &[IBig]| a.iter().zip(b).map(|(a, b)| a * b).sum::<IBig>();
    let c = vec![
        dot(&p, &p) - &radii[0] * &radii[0],
        dot(&p, &d) * 2,
        dot(&d, &d),
    ];
    Exact { c, scale }
}

/// Checks the roots of one ray; `exact` returns the polynomial for a radius grown by its argument.
fn check(ray: &Ray, radii: f64, roots: &[Root], exact: impl Fn(f64) -> Exact) {
    let size_at = |t: f64| (ray.origin.abs() + t.abs() * ray.dir.abs()).element_sum() + radii;
    let nearest = -ray.origin.dot(ray.dir) / ray.dir.dot(ray.dir);
    let slack = TOLERANCE * size_at(nearest);
    let counts = [0.0, slack, -slack].map(|grown| exact(grown).count());
    let least = counts.into_iter().min().unwrap();
    let most = counts.into_iter().max().unwrap();
    assert!(
        (least..=most).contains(&roots.len()),
        "{ray:?}: exact {counts:?}, found {roots:?}"
    );
    for root in roots {
        let slack = TOLERANCE * size_at(root.t);
        let (grown, shrunk) = (exact(slack).sign_at(root.t), exact(-slack).sign_at(root.t));
        assert!(grown * shrunk <= 0, "{ray:?}: {root:?} is off the surface");
    }
}

/// A ray through a point from a distance.
fn through(rng: &mut Random, point: DVec3, distance: f64) -> Ray {
    let away = loop {
        let v = rng.vector(1.0);
        if v.length() > 0.1 && v.length() < 1.0 {
            break v.normalize();
        }
    };
    Ray::new(point + away * distance, -away)
}

fn on_torus(rng: &mut Random, major: f64, minor: f64) -> (DVec3, DVec3) {
    let (around, tube) = (TAU * rng.uniform(), TAU * rng.uniform());
    let outward = DVec3::new(around.cos(), 0.0, around.sin());
    let normal = outward * tube.cos() + DVec3::Y * tube.sin();
    (outward * major + normal * minor, normal)
}

fn try_torus(major: f64, minor: f64, mut ray: impl FnMut(&mut Random) -> Ray) {
    let mut rng = Random::new(21);
    let torus = Torus {
        centre: DVec3::ZERO,
        major,
        minor,
        spindle: Spindle::default(),
    };
    let mut hits = 0;
    for _ in 0..RAYS {
        let ray = ray(&mut rng);
        let mut roots = Vec::new();
        torus.roots(&ray, &mut roots);
        hits += roots.len();
        check(&ray, major + minor, &roots, |grown| {
            exact_torus(&ray, major, minor + grown)
        });
    }
    assert!(hits > 100, "only {hits} hits");
}

/// Rays through points near the tube.
fn try_near(major: f64, minor: f64, distance: f64) {
    try_torus(major, minor, |rng| {
        let (point, normal) = on_torus(rng, major, minor);
        let point = point + normal * minor * (rng.uniform() - 0.8);
        through(rng, point, distance)
    });
}

#[test]
fn tori_from_near_and_far_lose_no_root() {
    for distance in [5.0, 1e3, 1e5, 1e8] {
        try_near(1.0, 0.3, distance);
    }
}

#[test]
fn thin_tori_lose_no_root() {
    for thin in [1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        try_near(1.0, thin, 3.0);
    }
    try_near(1.0, 1e-3, 1e4);
}

#[test]
fn horns_and_spindles_lose_no_root() {
    for (major, minor) in [
        (1.0, 1.0),
        (1.0, 1.0 + 1e-7),
        (0.5, 1.0),
        (1.0, 50.0),
        (1e-4, 1.0),
    ] {
        try_near(major, minor, 4.0 * minor);
        try_torus(major, minor, |rng| {
            let point = rng.vector(minor);
            through(rng, point, 4.0 * minor)
        });
    }
}

#[test]
fn rays_in_the_plane_of_the_ring_lose_no_root() {
    for minor in [0.3, 1e-2, 1e-4] {
        try_torus(1.0, minor, |rng| {
            let aim = rng.vector(1.0 + minor) * DVec3::new(1.0, 0.0, 1.0);
            let turn = TAU * rng.uniform();
            let dir = DVec3::new(turn.cos(), 0.0, turn.sin());
            Ray::new(aim - 5.0 * dir, dir)
        });
    }
}

#[test]
fn rays_along_an_axis_lose_no_root() {
    try_torus(1.0, 0.3, |rng| {
        let axis = usize::try_from(rng.bits() % 3).unwrap();
        let mut dir = DVec3::ZERO;
        dir[axis] = 1.0;
        let mut origin = rng.vector(1.3) * DVec3::new(1.0, 0.25, 1.0);
        origin[axis] = -4.0;
        Ray::new(origin, dir)
    });
}

#[test]
fn grazing_rays_lose_no_root_deeper_than_rounding() {
    for minor in [0.3, 1e-2, 1e-4] {
        try_torus(1.0, minor, |rng| {
            let (point, normal) = on_torus(rng, 1.0, minor);
            let depth = 10.0_f64.powf(-15.0 + 12.0 * rng.uniform());
            let tangent = normal.cross(rng.vector(1.0)).normalize();
            Ray::new(point - normal * (minor * depth) - 4.0 * tangent, tangent)
        });
    }
}

#[test]
fn rays_from_the_surface_lose_no_root() {
    try_torus(1.0, 0.3, |rng| {
        let (point, normal) = on_torus(rng, 1.0, 0.3);
        let lift = 10.0_f64.powf(-6.0 * rng.uniform());
        let dir = normal.cross(rng.vector(1.0)).normalize() + lift * normal;
        Ray::new(point, dir.normalize())
    });
}

#[test]
fn tangents_of_the_top_circle_leave_pairs_or_nothing() {
    let torus = Torus {
        centre: DVec3::ZERO,
        major: 1.0,
        minor: 0.25,
        spindle: Spindle::default(),
    };
    let mut rng = Random::new(22);
    for _ in 0..RAYS {
        let turn = TAU * rng.uniform();
        let dir = DVec3::new(turn.cos(), 0.0, turn.sin());
        let origin = rng.vector(0.9) * DVec3::new(1.0, 0.0, 1.0) + DVec3::Y * 0.25 - 4.0 * dir;
        let mut roots = Vec::new();
        torus.roots(&Ray::new(origin, dir), &mut roots);
        assert!(roots.len().is_multiple_of(2));
    }
}

fn try_sphere(radius: f64, mut ray: impl FnMut(&mut Random) -> Ray) {
    let mut rng = Random::new(23);
    let sphere = Sphere {
        centre: DVec3::ZERO,
        radius,
    };
    let mut hits = 0;
    for _ in 0..4 * RAYS {
        let ray = ray(&mut rng);
        let mut roots = Vec::new();
        sphere.roots(&ray, &mut roots);
        hits += roots.len();
        check(&ray, radius, &roots, |grown| {
            exact_sphere(&ray, radius + grown)
        });
    }
    assert!(hits > 100, "only {hits} hits");
}

#[test]
fn spheres_from_near_and_far_lose_no_root() {
    for distance in [3.0, 1e3, 1e5, 1e8] {
        try_sphere(1.0, |rng| {
            let aim = rng.vector(1.0);
            through(rng, aim, distance)
        });
    }
    // A floor: the eye just above a sphere of radius ten million.
    try_sphere(1e7, |rng| {
        let down = DVec3::new(rng.uniform() - 0.5, -0.2 * rng.uniform(), 1.0);
        Ray::new(DVec3::new(0.0, 1e7 + 1.6, 0.0), down.normalize())
    });
}

#[test]
fn rays_that_graze_a_sphere_lose_no_root_deeper_than_rounding() {
    try_sphere(1.0, |rng| {
        let normal = rng.vector(1.0).normalize();
        let tangent = normal.cross(rng.vector(1.0)).normalize();
        let depth = 10.0_f64.powf(-15.0 + 12.0 * rng.uniform());
        Ray::new(normal * (1.0 - depth) - tangent * 4.0, tangent)
    });
}
