//! Ray/triangle intersection without gaps along shared edges.
//!
//! After Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection": the vertices are sheared so that the ray
//! is parallel to an axis, and each edge gets the sign of `x₁·y₂ − y₁·x₂`. Rounding is monotone, so this sign is
//! correct or zero, and it is exactly opposite for the neighbour across the edge. Zero counts as inside: a ray through
//! an edge hits at least one of the two triangles.
//!
//! Error bound: no gaps; a hit point lies within 2 roundings of the plane of the triangle (`shape/roundings.rs`).

mod packet;

pub(crate) use packet::{RayFrames4, RaysAndTriangle, TriangleHits4};

use super::{Ray, conditioning::power_of_two};
use glam::{DVec2, DVec3};

/// A ray prepared for intersection with many triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayFrame {
    ray: Ray,
    /// The axis of the largest component of the direction.
    along: usize,
    /// The other two components of the direction divided by the largest.
    shear: DVec2,
}

/// A hit of a ray on a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TriangleHit {
    /// The parameter on the ray.
    pub(crate) t: f64,
    /// The barycentric coordinates of the hit point.
    pub(crate) weights: [f64; 3],
}

impl RayFrame {
    /// Prepares a ray. A ray with a zero direction hits nothing.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let length = ray.dir.abs();
        let along = if length.x > length.y && length.x > length.z {
            0
        } else if length.y > length.z {
            1
        } else {
            2
        };
        let across = across(ray.dir, along);
        RayFrame {
            ray: *ray,
            along,
            shear: across / ray.dir[along],
        }
    }

    /// The vertices relative to the sheared ray: their coordinates across it and along it.
    #[inline(always)]
    fn sheared(&self, corners: &[DVec3; 3]) -> ([DVec2; 3], [f64; 3]) {
        let mut flat = [DVec2::ZERO; 3];
        let mut depth = [0.0; 3];
        for i in 0..3 {
            let p = corners[i] - self.ray.origin;
            depth[i] = p[self.along];
            flat[i] = across(p, self.along) - self.shear * depth[i];
        }
        (flat, depth)
    }

    /// The crossing of the whole line with a triangle, for counting crossings. Where the line passes through an edge or
    /// a vertex, the triangles around it count as crossed if the line displaced by `(ε, ε²)` for a vanishing `ε`
    /// crosses them (Edelsbrunner and Mücke 1990, "Simulation of Simplicity"). So every line crosses a closed surface
    /// an even number of times.
    #[inline]
    pub(crate) fn crossing(&self, corners: &[DVec3; 3]) -> Option<TriangleHit> {
        let (mut flat, depth) = self.sheared(corners);
        let mut edges = edge_signs(&flat);
        if !edges.iter().all(|e| e.is_finite()) {
            flat = rescaled(&flat)?;
            edges = edge_signs(&flat);
        }
        let [a, b, c] = flat;
        let first = is_left(edges[0], b, c)?;
        if is_left(edges[1], c, a)? != first || is_left(edges[2], a, b)? != first {
            return None;
        }
        let sum = edges[0] + edges[1] + edges[2];
        let weights = if sum == 0.0 {
            [1.0, 0.0, 0.0]
        } else {
            edges.map(|e| e / sum)
        };
        let t = self.parameter(corners, &depth, &weights);
        t.is_finite().then_some(TriangleHit { t, weights })
    }

    /// The hit of the whole line on a triangle; edges and vertices belong to the triangle.
    #[inline(always)]
    pub(crate) fn hit(&self, corners: &[DVec3; 3]) -> Option<TriangleHit> {
        let (flat, depth) = self.sheared(corners);
        let mut edges = edge_signs(&flat);
        if edges.iter().any(|e| *e < 0.0) && edges.iter().any(|e| *e > 0.0) {
            return None;
        }
        let mut sum = edges[0] + edges[1] + edges[2];
        if sum == 0.0 || !sum.is_finite() {
            edges = edge_signs(&rescaled(&flat)?);
            if edges.iter().any(|e| *e < 0.0) && edges.iter().any(|e| *e > 0.0) {
                return None;
            }
            sum = edges[0] + edges[1] + edges[2];
            if sum == 0.0 || !sum.is_finite() {
                return None;
            }
        }
        // Written out: `map` is not always inlined.
        let weights = [edges[0] / sum, edges[1] / sum, edges[2] / sum];
        let t = self.parameter(corners, &depth, &weights);
        t.is_finite().then_some(TriangleHit { t, weights })
    }

    /// The `t` of a hit. For a triangle perpendicular to an axis it has the same bits as for a box face or a plane
    /// there. For any other it is a weighted mean of the vertex depths, which stays between them however thin the
    /// triangle is.
    #[inline(always)]
    fn parameter(&self, corners: &[DVec3; 3], depth: &[f64; 3], weights: &[f64; 3]) -> f64 {
        let [a, b, c] = *corners;
        let is_level = a.cmpeq(b) & a.cmpeq(c);
        for axis in 0..3 {
            if is_level.test(axis) {
                return (a[axis] - self.ray.origin[axis]) / self.ray.dir[axis];
            }
        }
        let mean = weights[0] * depth[0] + weights[1] * depth[1] + weights[2] * depth[2];
        mean / self.ray.dir[self.along]
    }
}

/// Twice the signed area of the triangle of the ray and each edge; edge `i` is opposite to vertex `i`.
#[inline]
fn edge_signs(flat: &[DVec2; 3]) -> [f64; 3] {
    let [a, b, c] = *flat;
    [
        b.x * c.y - b.y * c.x,
        c.x * a.y - c.y * a.x,
        a.x * b.y - a.y * b.x,
    ]
}

/// The side of the edge from `p` to `q` on which the displaced ray passes; `edge` is the rounded `p.x·q.y − p.y·q.x`.
/// `None` if the edge projects to a point.
#[inline]
fn is_left(edge: f64, p: DVec2, q: DVec2) -> Option<bool> {
    if edge == 0.0 {
        return is_left_close(p, q);
    }
    Some(edge > 0.0)
}

/// [`is_left`] if both products round to the same number: their rounding errors decide, and if these are equal, too,
/// the displacement.
#[cold]
fn is_left_close(p: DVec2, q: DVec2) -> Option<bool> {
    let (one, other) = (p.x * q.y, p.y * q.x);
    let (error_one, error_other) = (p.x.mul_add(q.y, -one), p.y.mul_add(q.x, -other));
    if error_one != error_other {
        return Some(error_one > error_other);
    }
    let along = q - p;
    if along.y != 0.0 {
        Some(along.y < 0.0)
    } else if along.x != 0.0 {
        Some(along.x > 0.0)
    } else {
        None
    }
}

/// The vertices rescaled so that their products are representable; `None` if they all lie on the ray.
#[cold]
fn rescaled(flat: &[DVec2; 3]) -> Option<[DVec2; 3]> {
    let size = flat
        .iter()
        .fold(0.0, |size: f64, p| size.max(p.abs().max_element()));
    (size > 0.0 && size.is_finite()).then(|| flat.map(|p| p / power_of_two(size)))
}

/// The two components other than `along`, in cyclic order.
#[inline]
fn across(v: DVec3, along: usize) -> DVec2 {
    match along {
        0 => DVec2::new(v.y, v.z),
        1 => DVec2::new(v.z, v.x),
        _ => DVec2::new(v.x, v.y),
    }
}
