//! How a patch is halved until its parts are flat or its steps are used up, and made of triangles.

use super::{Corner, Net, Points};
use crate::scene::shape::Triangle;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// A part of the surface while it is halved.
pub(super) struct Part {
    pub(super) points: Points,
    /// The parameters of its corners.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

/// The two halves of a curve (de Casteljau).
fn halves([a, b, c, d]: [DVec3; 4]) -> ([DVec3; 4], [DVec3; 4]) {
    let mean = |a: DVec3, b: DVec3| 0.5 * (a + b);
    let (ab, bc, cd) = (mean(a, b), mean(b, c), mean(c, d));
    let (abc, bcd) = (mean(ab, bc), mean(bc, cd));
    let middle = mean(abc, bcd);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

fn turned(points: &Points) -> Points {
    std::array::from_fn(|i| std::array::from_fn(|j| points[j][i]))
}

fn halves_along_v(points: &Points) -> (Points, Points) {
    let halved = points.map(halves);
    (halved.map(|half| half.0), halved.map(|half| half.1))
}

impl Part {
    fn halves_along_u(&self) -> [Part; 2] {
        let (near, far) = halves_along_v(&turned(&self.points));
        let middle = 0.5 * (self.low.x + self.high.x);
        [
            Part {
                points: turned(&near),
                low: self.low,
                high: DVec2::new(middle, self.high.y),
            },
            Part {
                points: turned(&far),
                low: DVec2::new(middle, self.low.y),
                high: self.high,
            },
        ]
    }

    fn halves_along_v(&self) -> [Part; 2] {
        let (near, far) = halves_along_v(&self.points);
        let middle = 0.5 * (self.low.y + self.high.y);
        [
            Part {
                points: near,
                low: self.low,
                high: DVec2::new(self.high.x, middle),
            },
            Part {
                points: far,
                low: DVec2::new(self.low.x, middle),
                high: self.high,
            },
        ]
    }
}

pub(super) struct Maker<'a> {
    pub(super) net: &'a Net,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) corners: Vec<Corner>,
    /// By the bits of the parameters.
    pub(super) known: FxHashMap<[u64; 2], u32>,
}

impl Maker<'_> {
    pub(super) fn halve(&mut self, part: &Part, depth: u32) {
        let (by_u, by_v) = (depth < self.net.u_steps, depth < self.net.v_steps);
        if !(by_u || by_v) || self.net.is_flat(&part.points) {
            self.leaf(part);
            return;
        }
        let parts = if by_u {
            &part.halves_along_u()[..]
        } else {
            std::slice::from_ref(part)
        };
        for part in parts {
            if by_v {
                for part in &part.halves_along_v() {
                    self.halve(part, depth + 1);
                }
            } else {
                self.halve(part, depth + 1);
            }
        }
    }

    fn leaf(&mut self, part: &Part) {
        let Part { points, low, high } = part;
        let a = self.corner(points[0][0], *low);
        let b = self.corner(points[0][3], DVec2::new(low.x, high.y));
        let c = self.corner(points[3][3], *high);
        let d = self.corner(points[3][0], DVec2::new(high.x, low.y));
        for triangle in [[a, b, c], [a, c, d]] {
            let corners = triangle.map(|corner| self.corners[corner as usize].point);
            if !(Triangle { corners }).is_flat_line() {
                self.triangles.push(triangle);
            }
        }
    }

    fn corner(&mut self, point: DVec3, at: DVec2) -> u32 {
        let corners = &mut self.corners;
        let net = self.net;
        let key = at.to_array().map(f64::to_bits);
        *self.known.entry(key).or_insert_with(|| {
            let normal = net.normal(at);
            corners.push(Corner { point, normal, at });
            u32::try_from(corners.len() - 1).expect("the steps are limited")
        })
    }
}
