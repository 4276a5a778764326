//! `bicubic_patch { type n [u_steps n] [v_steps n] [flatness x] [uv_vectors ...] <point>, ... }`: a Bézier surface of
//! 16 points, drawn as triangles.
//!
//! As in POV-Ray the surface is halved along both parameters, `u_steps` and `v_steps` times, or until a piece is flatter
//! than `flatness`; each piece is two triangles, with the normals of the true surface at their corners. Transforms move
//! the points, so the flatness is that in the scene. Unlike in POV-Ray 3.7, which forgets it, `clipped_by` clips. The two types, which differ in what POV-Ray keeps, are one here.

use super::smooth_triangle::weights;
use super::{Crossing, Geometry, Root, Start, Triangle, read};
use crate::accel::Bvh;
use crate::args::{Args, Parse, Word};
use crate::math::watertight::RayFrame;
use crate::math::{Bounds, Ray, Step};
use crate::source::Diagnostic;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// More halvings would make more than two million triangles.
const MOST_STEPS: u32 = 20;
/// A normal shorter than this share of the square of the size is rounding noise. POV-Ray 3.7 takes the noise, so that
/// its poles have rays of light and shade.
const NO_NORMAL: f64 = 1e-12;
/// Corners nearer than this are one to POV-Ray.
const SAME_CORNER: f64 = 1e-10;
/// The flatness of the old form without words.
const OLD_FLATNESS: f64 = 0.1;

/// Rows along v of four points.
type Points = [[DVec3; 4]; 4];

/// A Bézier surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BicubicPatch {
    net: Box<Net>,
    /// Made by [`Geometry::prepare`].
    pieces: Option<Arc<Pieces>>,
}

/// What a scene says of the surface.
#[derive(Clone, Debug, PartialEq)]
struct Net {
    /// The first index runs along u.
    points: Points,
    u_steps: u32,
    v_steps: u32,
    flatness: f64,
    /// Texture coordinates of the corners.
    uv: [DVec2; 4],
}

/// The surface as triangles.
#[derive(Clone, Debug)]
struct Pieces {
    triangles: Vec<[u32; 3]>,
    corners: Vec<Corner>,
    tree: Bvh,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    point: DVec3,
    normal: DVec3,
    /// The parameters of the surface.
    at: DVec2,
}

impl PartialEq for Pieces {
    /// The tree follows from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.triangles == other.triangles && self.corners == other.corners
    }
}

impl BicubicPatch {
    /// Reads the words and the points of the surface.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, a missing type, or too many steps.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let mut net = Net {
            points: [[DVec3::ZERO; 4]; 4],
            u_steps: 0,
            v_steps: 0,
            flatness: 0.0,
            uv: [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
        };
        let at = args.span();
        let mut has_type = false;
        if !args.at_mark('<')? && args.at_expression()? {
            read_numbers(args, &mut net)?;
            has_type = true;
        }
        loop {
            if args.accept(Word::Type)? {
                args.float()?;
                has_type = true;
            } else if args.accept(Word::USteps)? {
                net.u_steps = read_steps(args)?;
            } else if args.accept(Word::VSteps)? {
                net.v_steps = read_steps(args)?;
            } else if args.accept(Word::Flatness)? {
                net.flatness = read::number(args, "the flatness of the bicubic patch")?;
            } else if args.accept(Word::UvVectors)? {
                for corner in &mut net.uv {
                    args.comma()?;
                    *corner = args.vector2()?;
                }
            } else if !args.comma()? {
                break;
            }
        }
        if !has_type {
            return Err(args.expected("`type` 0 or 1 in `bicubic_patch`"));
        }
        if net.u_steps + net.v_steps > MOST_STEPS {
            return Err(Box::new(
                Diagnostic::error(
                    at.to(args.last_span()),
                    format!("`u_steps` and `v_steps` are {MOST_STEPS} at most together"),
                )
                .with_hint("each step doubles the pieces of the surface; 3 or 4 look smooth"),
            ));
        }
        for number in 0..16 {
            let what = format!("point {} of 16 of the bicubic patch", number + 1);
            net.points[number / 4][number % 4] = read::vector(args, &what)?;
        }
        Ok(BicubicPatch {
            net: Box::new(net),
            pieces: None,
        })
    }

    fn pieces(&self) -> &Pieces {
        self.pieces
            .as_ref()
            .expect("shapes are prepared before rays meet them")
    }

    fn corners(&self, face: u32) -> [Corner; 3] {
        let pieces = self.pieces();
        pieces.triangles[face as usize].map(|corner| pieces.corners[corner as usize])
    }

    fn weights(&self, point: DVec3, face: u32) -> [f64; 3] {
        let corners = self.corners(face).map(|corner| corner.point);
        weights(&corners, self.normal(point, face), point)
    }
}

/// The form of old scenes: `type, [flatness,] u_steps, v_steps`.
fn read_numbers(args: &mut dyn Args, net: &mut Net) -> Parse<()> {
    let kind = args.float()?.trunc();
    net.flatness = if kind == 2.0 || kind == 3.0 {
        read::number(args, "the flatness of the bicubic patch")?
    } else {
        OLD_FLATNESS
    };
    args.comma()?;
    net.u_steps = read_steps(args)?;
    args.comma()?;
    net.v_steps = read_steps(args)?;
    Ok(())
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be a small whole number"
)]
fn read_steps(args: &mut dyn Args) -> Parse<u32> {
    let at = args.span();
    let steps = args.float()?.trunc();
    if (0.0..=f64::from(MOST_STEPS)).contains(&steps) {
        return Ok(steps as u32);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("a bicubic patch has 0 to {MOST_STEPS} steps, found {steps}"),
    )))
}

/// A part of the surface while it is halved.
struct Part {
    points: Points,
    /// The parameters of its corners.
    low: DVec2,
    high: DVec2,
}

impl Net {
    fn pieces(&self) -> Pieces {
        let mut maker = Maker {
            net: self,
            triangles: Vec::new(),
            corners: Vec::new(),
            known: FxHashMap::default(),
        };
        let whole = Part {
            points: self.points,
            low: DVec2::ZERO,
            high: DVec2::ONE,
        };
        maker.halve(&whole, 0);
        let Maker {
            triangles, corners, ..
        } = maker;
        let boxes: Vec<Bounds> = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|corner| corners[corner as usize].point);
                Bounds::new(a, b).with_point(c)
            })
            .collect();
        Pieces {
            tree: Bvh::build(&boxes),
            triangles,
            corners,
        }
    }

    /// The unit normal of the true surface, or zero at a pole.
    fn normal(&self, at: DVec2) -> DVec3 {
        let mut along = [DVec3::ZERO; 2];
        let (u, v) = (bernstein(at.x), bernstein(at.y));
        let (du, dv) = (slopes(at.x), slopes(at.y));
        for i in 0..4 {
            for j in 0..4 {
                along[0] += self.points[i][j] * (du[i] * v[j]);
                along[1] += self.points[i][j] * (u[i] * dv[j]);
            }
        }
        let normal = along[0].cross(along[1]);
        let size = self.points.iter().flatten();
        let size = size.fold(0.0_f64, |size, point| {
            size.max((*point - self.points[0][0]).abs().max_element())
        });
        if normal.length() > NO_NORMAL * size * size {
            normal.normalize()
        } else {
            DVec3::ZERO
        }
    }

    /// Whether all points lie near the plane of three corners. Without such a plane it is flat.
    fn is_flat(&self, points: &Points) -> bool {
        let [a, b, c, d] = [points[0][0], points[0][3], points[3][3], points[3][0]];
        let corner = a;
        let second = if (a - b).length() < SAME_CORNER { c } else { b };
        let Some(normal) = (second - a).cross(d - a).try_normalize() else {
            return true;
        };
        let mut all = points.iter().flatten();
        all.all(|point| normal.dot(*point - corner).abs() < self.flatness)
    }
}

/// The Bernstein polynomials of degree three.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t]
}

/// Their derivatives.
fn slopes(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        -3.0 * s * s,
        3.0 * s * (s - 2.0 * t),
        3.0 * t * (2.0 * s - t),
        3.0 * t * t,
    ]
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

struct Maker<'a> {
    net: &'a Net,
    triangles: Vec<[u32; 3]>,
    corners: Vec<Corner>,
    /// By the bits of the parameters.
    known: FxHashMap<[u64; 2], u32>,
}

impl Maker<'_> {
    fn halve(&mut self, part: &Part, depth: u32) {
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

impl Geometry for BicubicPatch {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let frame = RayFrame::new(ray);
        let first = roots.len();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        self.pieces().tree.any(ray, from, to, |face| {
            let corners = self.corners(face).map(|corner| corner.point);
            roots.extend(frame.hit(&corners).map(|hit| touch(hit.t, face)));
            false
        });
        roots[first..].sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.nearest_beside(ray, from, to, u32::MAX)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let frame = RayFrame::new(ray);
        let mut best: Option<Root> = None;
        self.pieces().tree.nearest(ray, from, to, |number, end| {
            let corners = self.corners(number).map(|corner| corner.point);
            let Some(hit) = frame.hit(&corners) else {
                return end;
            };
            let is_first =
                best.is_none_or(|best| hit.t < best.t || (hit.t == best.t && number < best.face));
            if number == face || hit.t <= from || hit.t >= to || !is_first {
                return end;
            }
            best = Some(touch(hit.t, number));
            hit.t
        });
        best
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        let corners = self.corners(face).map(|corner| corner.point);
        Triangle { corners }.normal(corners[0], 0)
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> DVec3 {
        let shares = self.weights(point, face);
        let corners = self.corners(face);
        let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + shares[i] * corners[i].normal);
        if mean.is_finite() && mean != DVec3::ZERO {
            mean
        } else {
            self.normal(point, face)
        }
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn bounds(&self) -> Bounds {
        let points = self.net.points.iter().flatten();
        points.fold(Bounds::EMPTY, |bounds, point| bounds.with_point(*point))
    }

    fn absorb(&mut self, step: &Step) -> bool {
        let moved = step.transform().world_from_object;
        for point in self.net.points.iter_mut().flatten() {
            *point = moved.transform_point3(*point);
        }
        self.pieces = None;
        true
    }

    fn prepare(&mut self) {
        if self.pieces.is_none() {
            self.pieces = Some(Arc::new(self.net.pieces()));
        }
    }

    fn uv_of_face(&self, point: DVec3, face: u32) -> [f64; 2] {
        let shares = self.weights(point, face);
        let corners = self.corners(face);
        let at = (0..3).fold(DVec2::ZERO, |sum, i| sum + shares[i] * corners[i].at);
        // The second parameter of the surface is the first of the texture.
        let [a, b, c, d] = self.net.uv;
        let (u, v) = (at.y, at.x);
        ((1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c)).to_array()
    }

    fn is_faceted(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        false
    }
}

fn touch(t: f64, face: u32) -> Root {
    Root {
        t,
        crossing: Crossing::Touch,
        face,
        is_visible: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::shape::check;

    const POINTS: &str = "<0,0,2>, <1,0,0>, <2,0,0>, <3,0,-2>, <0,1,0>, <1,1,0>, <2,1,0>, <3,1,0>,
        <0,2,0>, <1,2,0>, <2,2,0>, <3,2,0>, <0,3,2>, <1,3,0>, <2,3,0>, <3,3,-2>";

    fn patch(words: &str) -> BicubicPatch {
        let mut args = TextArgs::new(&format!("{words} {POINTS}"));
        let mut patch = BicubicPatch::read(&mut args).unwrap();
        assert!(args.is_done());
        patch.prepare();
        patch
    }

    #[test]
    fn it_is_a_patch() {
        check::patch(&patch("type 0 u_steps 3 v_steps 3"));
    }

    #[test]
    fn steps_double_the_pieces_of_each_direction() {
        let pieces = |words| patch(words).pieces().triangles.len();
        assert_eq!(pieces("type 1"), 2);
        assert_eq!(pieces("type 1 u_steps 3 v_steps 2"), 64);
        assert_eq!(pieces("type 1 u_steps 3 v_steps 3 flatness 100"), 2);
        let some = pieces("type 1 u_steps 4 v_steps 4 flatness 0.05");
        assert!(2 < some && some < 512, "{some}");
        assert_eq!(pieces("1, 2, 2"), 32);
    }

    #[test]
    fn the_corners_lie_on_the_surface() {
        let patch = patch("type 1 u_steps 2 v_steps 3");
        for corner in &patch.pieces().corners {
            let (u, v) = (bernstein(corner.at.x), bernstein(corner.at.y));
            let mut point = DVec3::ZERO;
            for (row, u) in patch.net.points.iter().zip(u) {
                for (net, v) in row.iter().zip(v) {
                    point += u * v * *net;
                }
            }
            assert!((point - corner.point).length() < 1e-14);
        }
    }

    #[test]
    fn texture_coordinates_run_along_v_first() {
        let patch = patch("type 1 u_steps 3 v_steps 3");
        let hit = patch.nearest(&Ray::new(DVec3::new(2.0, 1.0, -9.0), DVec3::Z), 0.0, 99.0);
        let hit = hit.unwrap();
        let uv = patch.uv_of_face(DVec3::new(2.0, 1.0, hit.t - 9.0), hit.face);
        assert!((uv[0] - 2.0 / 3.0).abs() < 1e-9 && (uv[1] - 1.0 / 3.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_wrong_is_said() {
        let fault = |text: &str| {
            BicubicPatch::read(&mut TextArgs::new(text))
                .unwrap_err()
                .message
        };
        assert_eq!(
            fault("u_steps 3 <0,0,0>"),
            "expected `type` 0 or 1 in `bicubic_patch`, found `<`"
        );
        assert_eq!(
            fault("type 1 u_steps 12 v_steps 12 <0,0,0>"),
            "`u_steps` and `v_steps` are 20 at most together"
        );
        assert_eq!(
            fault("type 1 u_steps -1"),
            "a bicubic patch has 0 to 20 steps, found -1"
        );
    }
}
