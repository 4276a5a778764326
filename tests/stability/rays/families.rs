//! Reproducible families of rays for tori and spheres; those for quadrics are in `quadrics`.

use glam::DVec3;
use povr::base::math::Ray;
use std::f64::consts::TAU;

/// A ray and the two radii of a torus; the first is 0 for a sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Question {
    pub(crate) ray: Ray,
    pub(crate) major: f64,
    pub(crate) minor: f64,
}

/// A family: its name and the generator of its rays.
pub(crate) struct Family<Q = Question> {
    pub(crate) name: &'static str,
    pub(crate) make: fn(&mut Numbers) -> Q,
}

impl<Q> Family<Q> {
    /// The first `count` rays.
    pub(crate) fn rays(&self, count: usize) -> Vec<Q> {
        let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
        (0..count).map(|_| (self.make)(&mut numbers)).collect()
    }
}

/// A stream of random numbers (Steele, Lea and Flood 2014, SplitMix64).
pub(crate) struct Numbers(u64);

impl Numbers {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to 1.
    #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub(super) fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn power_of_ten(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(from + (to - from) * self.share())
    }

    pub(super) fn within(&mut self, size: f64) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|_| size * (2.0 * self.share() - 1.0)))
    }

    pub(super) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.within(1.0);
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// A ray from a distance through a point.
pub(super) fn through(n: &mut Numbers, point: DVec3, distance: f64) -> Ray {
    let dir = n.direction();
    Ray::new(point - distance * dir, dir)
}

/// A point of the tube and its normal.
fn on_tube(n: &mut Numbers, major: f64, minor: f64) -> (DVec3, DVec3) {
    let (around, tube) = (TAU * n.share(), TAU * n.share());
    let outward = DVec3::new(around.cos(), 0.0, around.sin());
    let normal = outward * tube.cos() + DVec3::Y * tube.sin();
    (outward * major + normal * minor, normal)
}

/// Rays past a torus, most of them through its tube.
fn past(n: &mut Numbers, major: f64, minor: f64, distance: f64) -> Question {
    let (point, normal) = on_tube(n, major, minor);
    let point = point + normal * minor * (n.share() - 0.8);
    let ray = through(n, point, distance * (major + minor));
    Question { ray, major, minor }
}

/// Rays along the surface, a little below it.
fn grazing(n: &mut Numbers, major: f64, minor: f64) -> Question {
    let (point, normal) = on_tube(n, major, minor);
    let depth = minor * n.power_of_ten(-15.0, -3.0);
    let tangent = normal.cross(n.direction()).normalize();
    let ray = Ray::new(point - depth * normal - 4.0 * tangent, tangent);
    Question { ray, major, minor }
}

fn in_plane(n: &mut Numbers, major: f64, minor: f64) -> Question {
    let aim = n.within(major + minor) * DVec3::new(1.0, 0.0, 1.0);
    let turn = TAU * n.share();
    let dir = DVec3::new(turn.cos(), 0.0, turn.sin());
    let ray = Ray::new(aim - 5.0 * dir, dir);
    Question { ray, major, minor }
}

/// The same ray in the space of a scaled torus, so that its direction has any length.
fn squeezed(question: Question, by: DVec3) -> Question {
    let Ray { origin, dir } = question.ray;
    // Aim at the middle of the torus as it is in its own space.
    Question {
        ray: Ray::new(origin * by, dir * by),
        ..question
    }
}

fn stretched(n: &mut Numbers, powers: f64) -> Question {
    let by = DVec3::from_array([0, 1, 2].map(|_| n.power_of_ten(-powers, powers)));
    let (point, _) = on_tube(n, 1.0, 0.3);
    let from = point / by + 5.0 * n.direction();
    let ray = Ray::new(from, (point / by - from).normalize());
    squeezed(
        Question {
            ray,
            major: 1.0,
            minor: 0.3,
        },
        by,
    )
}

/// 31 families of tori from the report on numerics, and some more.
pub(crate) const TORI: &[Family] = &[
    Family {
        name: "well",
        make: |n| past(n, 1.0, 0.3, 4.0),
    },
    Family {
        name: "far 1e3",
        make: |n| past(n, 1.0, 0.3, 1e3),
    },
    Family {
        name: "far 1e5",
        make: |n| past(n, 1.0, 0.3, 1e5),
    },
    Family {
        name: "far 1e8",
        make: |n| past(n, 1.0, 0.3, 1e8),
    },
    Family {
        name: "thin 1e-1",
        make: |n| past(n, 1.0, 1e-1, 3.0),
    },
    Family {
        name: "thin 1e-2",
        make: |n| past(n, 1.0, 1e-2, 3.0),
    },
    Family {
        name: "thin 1e-4",
        make: |n| past(n, 1.0, 1e-4, 3.0),
    },
    Family {
        name: "thin 1e-6",
        make: |n| past(n, 1.0, 1e-6, 3.0),
    },
    Family {
        name: "thin 1e-8",
        make: |n| past(n, 1.0, 1e-8, 3.0),
    },
    Family {
        name: "thin 1e-10",
        make: |n| past(n, 1.0, 1e-10, 3.0),
    },
    Family {
        name: "thin 1e-3, far 1e4",
        make: |n| past(n, 1.0, 1e-3, 1e4),
    },
    Family {
        name: "horn",
        make: |n| past(n, 1.0, 1.0, 4.0),
    },
    Family {
        name: "horn+",
        make: |n| past(n, 1.0, 1.0 + 1e-7, 4.0),
    },
    Family {
        name: "spindle 2",
        make: |n| past(n, 0.5, 1.0, 4.0),
    },
    Family {
        name: "spindle 50",
        make: |n| past(n, 0.02, 1.0, 4.0),
    },
    Family {
        name: "graze",
        make: |n| grazing(n, 1.0, 0.3),
    },
    Family {
        name: "graze, thin 1e-4",
        make: |n| grazing(n, 1.0, 1e-4),
    },
    Family {
        name: "tangent on top",
        make: |n| {
            let turn = TAU * n.share();
            let dir = DVec3::new(turn.cos(), 0.0, turn.sin());
            let origin = n.within(0.9) * DVec3::new(1.0, 0.0, 1.0) + DVec3::Y * 0.25 - 4.0 * dir;
            Question {
                ray: Ray::new(DVec3::new(origin.x, 0.25, origin.z), dir),
                major: 1.0,
                minor: 0.25,
            }
        },
    },
    Family {
        name: "along an axis",
        make: |n| {
            let axis = usize::try_from(n.bits() % 3).unwrap_or(0);
            let mut dir = DVec3::ZERO;
            dir[axis] = 1.0;
            let mut origin = n.within(1.3) * DVec3::new(1.0, 0.25, 1.0);
            origin[axis] = -4.0;
            Question {
                ray: Ray::new(origin, dir),
                major: 1.0,
                minor: 0.3,
            }
        },
    },
    Family {
        name: "in the plane",
        make: |n| in_plane(n, 1.0, 0.3),
    },
    Family {
        name: "in the plane, thin 1e-4",
        make: |n| in_plane(n, 1.0, 1e-4),
    },
    Family {
        name: "through the centre",
        make: |n| Question {
            ray: through(n, DVec3::ZERO, 4.0),
            major: 1.0,
            minor: 0.3,
        },
    },
    Family {
        name: "scaled 1e-2 to 1e2",
        make: |n| stretched(n, 2.0),
    },
    Family {
        name: "scaled 1e-6 to 1e6",
        make: |n| stretched(n, 6.0),
    },
    Family {
        name: "sheared 1e2 to 1e6",
        make: |n| {
            let shear = n.power_of_ten(2.0, 6.0);
            let Question { ray, major, minor } = past(n, 1.0, 0.3, 5.0);
            let slanted = |v: DVec3| DVec3::new(v.x, v.y - shear * v.x, v.z);
            // Through the same point of the torus as before.
            let aim = ray.at(5.0 * 1.3);
            let dir = slanted(ray.dir);
            Question {
                ray: Ray::new(aim - 5.0 * dir, dir),
                major,
                minor,
            }
        },
    },
    Family {
        name: "mirrored",
        make: |n| squeezed(past(n, 1.0, 0.3, 4.0), DVec3::new(-1.0, 1.0, 1.0)),
    },
    Family {
        name: "uniform 1e-6",
        make: |n| squeezed(past(n, 1.0, 0.3, 4.0), DVec3::splat(1e-6)),
    },
    Family {
        name: "radii 1e-6",
        make: |n| past(n, 1e-6, 3e-7, 4.0),
    },
    Family {
        name: "radii 1e6",
        make: |n| past(n, 1e6, 3e5, 4.0),
    },
    Family {
        name: "from the surface",
        make: |n| {
            let (point, normal) = on_tube(n, 1.0, 0.3);
            let dir = n.direction();
            Question {
                ray: Ray::new(point, if dir.dot(normal) < 0.0 { -dir } else { dir }),
                major: 1.0,
                minor: 0.3,
            }
        },
    },
    Family {
        name: "from the surface, grazing",
        make: |n| {
            let (point, normal) = on_tube(n, 1.0, 0.3);
            let lift = n.power_of_ten(-8.0, -2.0);
            let dir = (normal.cross(n.direction()).normalize() + lift * normal).normalize();
            Question {
                ray: Ray::new(point, dir),
                major: 1.0,
                minor: 0.3,
            }
        },
    },
    // Beyond the report.
    Family {
        name: "far 1e12",
        make: |n| past(n, 1.0, 0.3, 1e12),
    },
    Family {
        name: "radii 1e-150",
        make: |n| past(n, 1e-150, 3e-151, 4.0),
    },
    Family {
        name: "spindle 1e4",
        make: |n| past(n, 1e-4, 1.0, 4.0),
    },
    Family {
        name: "along the tube",
        make: |n| {
            let turn = TAU * n.share();
            let (sin, cos) = turn.sin_cos();
            let middle = DVec3::new(cos, 0.0, sin) + n.within(0.29);
            let dir = (DVec3::new(-sin, 0.0, cos) + n.within(1e-3)).normalize();
            Question {
                ray: Ray::new(middle - 4.0 * dir, dir),
                major: 1.0,
                minor: 0.3,
            }
        },
    },
    Family {
        name: "through the edge of the hole",
        make: |n| {
            let turn = TAU * n.share();
            let edge = DVec3::new(turn.cos(), 0.0, turn.sin()) * 0.7;
            let point = edge + n.within(1e-9);
            Question {
                ray: through(n, point, 4.0),
                major: 1.0,
                minor: 0.3,
            }
        },
    },
];

/// Families of spheres.
pub(crate) const SPHERES: &[Family] = &[
    Family {
        name: "5 radii away",
        make: |n| past_sphere(n, 5.0),
    },
    Family {
        name: "1e5 radii away",
        make: |n| past_sphere(n, 1e5),
    },
    Family {
        name: "1e7 radii away",
        make: |n| past_sphere(n, 1e7),
    },
    Family {
        name: "1e8 radii away",
        make: |n| past_sphere(n, 1e8),
    },
    Family {
        name: "floor of 1e7",
        make: |n| {
            let down = DVec3::new(n.share() - 0.5, -0.2 * n.share(), 1.0);
            let ray = Ray::new(DVec3::new(0.0, 1e7 + 1.6, 0.0), down.normalize());
            Question {
                ray,
                major: 0.0,
                minor: 1e7,
            }
        },
    },
    Family {
        name: "grazing 1e-15 to 1e-3",
        make: |n| {
            let normal = n.direction();
            let tangent = normal.cross(n.direction()).normalize();
            let depth = n.power_of_ten(-15.0, -3.0);
            Question {
                ray: Ray::new(normal * (1.0 - depth) - tangent * 4.0, tangent),
                major: 0.0,
                minor: 1.0,
            }
        },
    },
];

fn past_sphere(n: &mut Numbers, distance: f64) -> Question {
    let aim = n.within(1.05);
    Question {
        ray: through(n, aim, distance),
        major: 0.0,
        minor: 1.0,
    }
}
