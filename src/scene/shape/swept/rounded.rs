//! Roots of prisms and lathes with the rounding of POV-Ray (docs/povray-shapes.md, section 5.4).

use super::lathe::Lathe;
use super::prism::Prism;
use crate::base::math::Ray;
use crate::scene::shape::Geometry;
use crate::scene::shape::solid::axial::SIDE;
use glam::{DVec2, DVec3};

/// Components of a direction below this count as 0.
const TINY: f64 = 1e-10;
/// Tolerance of roots, relative to the distance, and of parameters of an edge.
const NEAR: f64 = 1e-9;

/// Start and direction of a straight part of a curve or an outline.
pub(in crate::scene::shape) type Edge = [DVec2; 2];

/// The parts of a swept shape whose roots are known to the last bit.
#[derive(Clone, Debug)]
pub(in crate::scene::shape) enum RoundedSweep {
    /// The caps of a prism that is swept along y, and its sides over straight edges.
    Prism(Prism),
    /// The level rings of a lathe, and its cones along other straight edges.
    Lathe(Lathe),
}

impl RoundedSweep {
    /// The distance of the hit near `t` along a ray, and the normal. The ray is in the space of the shape, its
    /// direction divided by `length` there.
    pub(in crate::scene::shape) fn hit(
        &self,
        local: &Ray,
        length: f64,
        t: f64,
        face: u32,
    ) -> Option<(f64, DVec3)> {
        let point = local.at(t * length);
        let is_near = |other: f64| (other - t).abs() <= NEAR * t.abs();
        let distance = |root: &(f64, Edge)| (root.0 - t).abs();
        let nearest = |a: &(f64, Edge), b: &(f64, Edge)| distance(a).total_cmp(&distance(b));
        match self {
            RoundedSweep::Prism(prism) => {
                let (root, normal) = if let Some(cap) = prism.flat_face(face) {
                    let root = (cap.coordinate - local.origin.y) / local.dir.y;
                    (root / length, DVec3::Y)
                } else if face == SIDE {
                    let roots = prism.edges().filter_map(|edge| {
                        let root = prism_root(local, &edge)? / length;
                        is_near(root).then_some((root, edge))
                    });
                    let (root, [_, dir]) = roots.min_by(nearest)?;
                    (root, DVec3::new(dir.y, 0.0, -dir.x))
                } else {
                    return None;
                };
                let own = prism.shading_normal(point, face);
                let own = own.unwrap_or_else(|| prism.normal(point, face));
                Some((root, on_side_of(normal, own)))
            }
            RoundedSweep::Lathe(lathe) => {
                let roots = lathe.edges().flat_map(|edge| {
                    let roots = lathe_roots(local, length, &edge).into_iter();
                    let roots = roots.filter(|root| is_near(*root));
                    roots.map(move |root| (root, edge))
                });
                let (root, [_, dir]) = roots.min_by(nearest)?;
                let point = local.at(root * length);
                let radius = (point.x * point.x + point.z * point.z).sqrt();
                let normal = DVec3::new(dir.y * point.x, -radius * dir.x, dir.y * point.z);
                Some((root, on_side_of(normal, lathe.normal(point, face))))
            }
        }
    }
}

/// A normal on the side of another one.
fn on_side_of(normal: DVec3, other: DVec3) -> DVec3 {
    if normal.dot(other) < 0.0 {
        -normal
    } else {
        normal
    }
}

/// Returns true if a parameter is one of an edge.
fn is_on_edge(at: f64) -> bool {
    (-NEAR..=1.0 + NEAR).contains(&at)
}

/// The root of a ray on the side of a prism over an edge.
fn prism_root(ray: &Ray, &[start, dir]: &Edge) -> Option<f64> {
    let [origin, ray_dir] = [ray.origin, ray.dir].map(|v| DVec2::new(v.x, v.z));
    let to_start = start - origin;
    let offset = ray_dir.y * to_start.x - ray_dir.x * to_start.y;
    let at = -offset / (ray_dir.y * dir.x - ray_dir.x * dir.y);
    let axis = usize::from(ray_dir.x.abs() <= TINY);
    is_on_edge(at).then(|| (dir[axis] * at + start[axis] - origin[axis]) / ray_dir[axis])
}

/// The roots of a ray on the surface that an edge sweeps around y, divided by the length of the direction.
fn lathe_roots(ray: &Ray, length: f64, &[start, dir]: &Edge) -> [f64; 2] {
    let (o, d) = (ray.origin, ray.dir);
    let speed = d.y * length;
    let height = start.y - o.y;
    if dir.y == 0.0 {
        return [height / speed, f64::NAN];
    }
    let [a, b, c] = [
        d.x * d.x + d.z * d.z,
        o.x * d.x + o.z * d.z,
        o.x * o.x + o.z * o.z,
    ];
    let climb = d.y * d.y;
    let square = a * (dir.y * dir.y) - climb * (dir.x * dir.x);
    let linear = 2.0 * (dir.y * (a * height + d.y * b) - climb * (dir.x * start.x));
    let constant = height * (a * height + 2.0 * b * d.y) + climb * (c - start.x * start.x);
    let (half, product) = (-linear / square, constant / square);
    let root = (half * half - 4.0 * product).sqrt();
    [half + root, half - root].map(|twice| {
        let at = 0.5 * twice;
        if is_on_edge(at) {
            (at * dir.y + start.y - o.y) / speed
        } else {
            f64::NAN
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::conditioning::Normalization;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::{Rounded, Steps};

    /// Compares the rounded roots of random rays with the others. Returns the numbers of roots that are rounded and not.
    fn compare(shape: &impl Geometry) -> [usize; 2] {
        let steps = Steps {
            steps: &[],
            normalization: Normalization::default(),
        };
        let rounded: Rounded = shape.rounded(&steps).expect("it has straight segments");
        let mut rng = Random::new(5);
        let mut counts = [0; 2];
        for _ in 0..4_000 {
            let origin = rng.vector(6.0);
            let ray = Ray::new(origin, (rng.vector(1.0) - origin).normalize());
            let mut roots = Vec::new();
            shape.roots(&ray, &mut roots);
            for root in roots.iter().filter(|root| root.is_visible) {
                let Some(hit) = rounded.hit(&ray, root.t, root.face) else {
                    counts[1] += 1;
                    continue;
                };
                counts[0] += 1;
                assert!((hit.t - root.t).abs() <= 1e-9 * root.t.abs());
                let point = ray.at(root.t);
                let normal = shape.shading_normal(point, root.face);
                let normal = normal.unwrap_or_else(|| shape.normal(point, root.face).normalize());
                assert!(hit.normal.dot(normal) > 1.0 - 1e-6, "{ray:?} {root:?}");
            }
        }
        counts
    }

    #[test]
    fn caps_and_straight_sides_of_prisms_are_known() {
        let read = |text| Prism::read(&mut TextArgs::new(text)).unwrap();
        let straight = read("-1, 1, 6, <-1,-1>, <1,-1>, <1,-1>, <2,1>, <-1,1>, <-1,-1>");
        let [known, unknown] = compare(&straight);
        assert!(known > 1_000 && unknown == 0, "{known}, {unknown}");
        let curved = read(
            "cubic_spline -1, 0.5, 7, <1,-1>, <0,1>, <-1.2,0>, <0,-1>, <1.5,0.1>, <0,1>, <-1,-1>",
        );
        let [known, unknown] = compare(&curved);
        assert!(known > 300 && unknown > 300, "{known}, {unknown}");
    }

    #[test]
    fn rings_and_cones_of_lathes_are_known() {
        let read = |text| Lathe::read(&mut TextArgs::new(text)).unwrap();
        let straight = read("linear_spline 6, <0,-1>, <1,-1>, <1,-1>, <2,0>, <1,1>, <0,1>");
        let [known, unknown] = compare(&straight);
        assert!(known > 1_000 && unknown == 0, "{known}, {unknown}");
    }
}
