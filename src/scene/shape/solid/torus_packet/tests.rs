use super::*;
use crate::base::math::Ray;
use crate::base::math::sampling::random::Random;
use crate::scene::shape::{Geometry, Spindle};
use glam::DVec3;

/// Rays at a torus: mostly through its tube, from near and far.
fn rays(torus: &Torus, rng: &mut Random) -> Vec<Ray> {
    let size = torus.major + torus.minor;
    let ray = |number: usize| {
        let origin = rng.vector(1.0) * size * [2.0, 5.0, 100.0, 1e5][number % 4];
        let (around, across) = (rng.vector(1.0), rng.vector(1.2 * torus.minor));
        let on_circle = DVec3::new(around.x, 0.0, around.z).normalize() * torus.major;
        let aim = if number.is_multiple_of(3) {
            around * size
        } else {
            on_circle + across
        };
        Ray::new(origin, (aim - origin).normalize())
    };
    (0..20_000).map(ray).collect()
}

#[test]
fn the_fast_path_finds_the_roots_of_the_robust_path() {
    let mut rng = Random::new(41);
    for (major, minor) in [(1.0, 0.3), (1.0, 1.0), (2.0, 0.01), (1.0, 1e-5)] {
        let torus = Torus {
            centre: DVec3::ZERO,
            major,
            minor,
            spindle: Spindle::default(),
        };
        let (mut unknown, mut crossed, mut twice) = (0, 0, 0);
        for ray in rays(&torus, &mut rng) {
            let robust = torus.robust_crossings(&ray);
            let Some(fast) = torus.fast_crossings(&ray) else {
                unknown += 1;
                continue;
            };
            assert_eq!(fast.len(), robust.len(), "{torus:?} {ray:?}");
            for (fast, robust) in fast.iter().zip(&robust) {
                assert_eq!(fast.crossing, robust.crossing);
                // Grazing rays: `t` is ill-conditioned where the surface is nearly parallel to the ray.
                let off = (fast.t - robust.t).abs();
                assert!(off < 1e-6 * (1.0 + robust.t.abs()), "{ray:?} {off:e}");
            }
            let nearest = torus.nearest(&ray, 0.0, f64::INFINITY);
            let first = fast.iter().find(|root| root.t > 0.0).copied();
            assert_eq!(nearest, first, "{torus:?} {ray:?}");
            crossed += usize::from(!fast.is_empty());
            twice += usize::from(fast.len() == 4);
        }
        assert!(unknown < 20 && crossed > 4000, "{unknown} {crossed}");
        assert!(twice > 20 || minor < 0.01, "{twice}");
    }
}

#[test]
fn rays_leaving_the_outer_half_hit_nothing() {
    let torus = Torus {
        centre: DVec3::new(0.5, -1.0, 2.0),
        major: 1.0,
        minor: 0.4,
        spindle: Spindle::default(),
    };
    let mut rng = Random::new(42);
    let (mut left, mut hits) = (0, 0);
    for _ in 0..20_000 {
        let outward = rng.vector(1.0).normalize();
        let around = rng.vector(1.0);
        let around = DVec3::new(around.x, 0.0, around.z).normalize();
        let outward = around * outward.x + DVec3::Y * outward.y;
        let outward = outward.normalize();
        let point = torus.centre + torus.major * around + torus.minor * outward;
        let dir = rng.vector(1.0).normalize();
        let dir = if dir.dot(outward) > 0.0 { dir } else { -dir };
        let ray = Ray::new(point, dir);
        let nearest = torus.nearest(&ray, 1e-9, f64::INFINITY);
        if torus.is_exiting(&ray) {
            left += 1;
            assert!(nearest.is_none_or(|root| root.t < 1e-6), "{ray:?}");
        } else {
            hits += usize::from(nearest.is_some());
        }
    }
    assert!(left > 8000 && hits > 1000, "{left} {hits}");
}
