//! Recursive subdivision of a patch until its parts are flat or its steps are used up, and their triangles.

use super::{Net, Points, Vertex};
use crate::scene::shape::Triangle;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// A part of the surface during subdivision.
pub(super) struct SubPatch {
    pub(super) points: Points,
    /// Parameters of its corners.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

/// Splits a curve in two halves (de Casteljau).
fn split_curve([a, b, c, d]: [DVec3; 4]) -> ([DVec3; 4], [DVec3; 4]) {
    let mean = |a: DVec3, b: DVec3| 0.5 * (a + b);
    let (ab, bc, cd) = (mean(a, b), mean(b, c), mean(c, d));
    let (abc, bcd) = (mean(ab, bc), mean(bc, cd));
    let middle = mean(abc, bcd);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

fn transposed(points: &Points) -> Points {
    std::array::from_fn(|i| std::array::from_fn(|j| points[j][i]))
}

fn split_v(points: &Points) -> (Points, Points) {
    let halved = points.map(split_curve);
    (halved.map(|half| half.0), halved.map(|half| half.1))
}

impl SubPatch {
    fn split_u(&self) -> [SubPatch; 2] {
        let (first, second) = split_v(&transposed(&self.points));
        let middle = 0.5 * (self.low.x + self.high.x);
        [
            SubPatch {
                points: transposed(&first),
                low: self.low,
                high: DVec2::new(middle, self.high.y),
            },
            SubPatch {
                points: transposed(&second),
                low: DVec2::new(middle, self.low.y),
                high: self.high,
            },
        ]
    }

    fn split_v(&self) -> [SubPatch; 2] {
        let (first, second) = split_v(&self.points);
        let middle = 0.5 * (self.low.y + self.high.y);
        [
            SubPatch {
                points: first,
                low: self.low,
                high: DVec2::new(self.high.x, middle),
            },
            SubPatch {
                points: second,
                low: DVec2::new(self.low.x, middle),
                high: self.high,
            },
        ]
    }
}

pub(super) struct Tessellator<'a> {
    pub(super) net: &'a Net,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) vertices: Vec<Vertex>,
    /// Index into `vertices` by the bits of the parameters.
    pub(super) vertex_ids: FxHashMap<[u64; 2], u32>,
}

impl Tessellator<'_> {
    pub(super) fn subdivide(&mut self, part: &SubPatch, depth: u32) {
        let (by_u, by_v) = (depth < self.net.u_steps, depth < self.net.v_steps);
        if !(by_u || by_v) || self.net.is_flat(&part.points) {
            self.push_triangles(part);
            return;
        }
        let parts = if by_u {
            &part.split_u()[..]
        } else {
            std::slice::from_ref(part)
        };
        for part in parts {
            if by_v {
                for part in &part.split_v() {
                    self.subdivide(part, depth + 1);
                }
            } else {
                self.subdivide(part, depth + 1);
            }
        }
    }

    fn push_triangles(&mut self, part: &SubPatch) {
        let SubPatch { points, low, high } = part;
        let a = self.vertex(points[0][0], *low);
        let b = self.vertex(points[0][3], DVec2::new(low.x, high.y));
        let c = self.vertex(points[3][3], *high);
        let d = self.vertex(points[3][0], DVec2::new(high.x, low.y));
        for triangle in [[a, b, c], [a, c, d]] {
            let corners = triangle.map(|index| self.vertices[index as usize].point);
            if !(Triangle { corners }).is_degenerate() {
                self.triangles.push(triangle);
            }
        }
    }

    fn vertex(&mut self, point: DVec3, params: DVec2) -> u32 {
        let vertices = &mut self.vertices;
        let net = self.net;
        let key = params.to_array().map(f64::to_bits);
        *self.vertex_ids.entry(key).or_insert_with(|| {
            let normal = net.normal(params);
            vertices.push(Vertex {
                point,
                normal,
                params,
            });
            u32::try_from(vertices.len() - 1).expect("the steps are limited")
        })
    }
}
