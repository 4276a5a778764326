//! `bicubic_patch { type n [u_steps n] [v_steps n] [flatness x] [uv_vectors ...] <point>, ... }`: a Bézier surface of
//! 16 points, drawn as triangles, with the error bound of those.
//!
//! As in POV-Ray the surface is halved along both parameters, `u_steps` and `v_steps` times, or until a piece is flatter
//! than `flatness`; each piece is two triangles, with the normals of the true surface at their corners. Transforms move
//! the points, so the flatness is that in the scene. Unlike in POV-Ray 3.7, which forgets it, `clipped_by` clips. The two types, which differ in what POV-Ray keeps, are one here.

mod halving;

use self::halving::{Maker, Part};
use super::smooth_triangle::weights;
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::watertight::RayFrame;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, Start, Triangle, read};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// More halvings would make more than two million triangles.
const MOST_STEPS: u32 = 20;
/// A normal shorter than this share of the square of the size is rounding noise. POV-Ray 3.7 takes the noise, so that
/// its poles have rays of light and shade.
const NO_NORMAL: f64 = 1e-12;
/// Corners nearer than this share of the piece are one; POV-Ray has it in units of the scene.
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
        let all = points.iter().flatten();
        let size = all.fold(0.0_f64, |size, p| size.max((*p - a).abs().max_element()));
        let second = if (a - b).length() < SAME_CORNER * size {
            c
        } else {
            b
        };
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

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let shares = self.weights(point, face);
        let corners = self.corners(face);
        let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + shares[i] * corners[i].normal);
        (mean.is_finite() && mean != DVec3::ZERO).then_some(mean)
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

    fn change_unit(&mut self, factor: f64) {
        self.net.flatness *= factor;
        self.pieces = None;
    }

    fn prepare(&mut self) {
        if self.pieces.is_none() {
            self.pieces = Some(Arc::new(self.net.pieces()));
        }
    }

    fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let shares = self.weights(point, face);
        let corners = self.corners(face);
        let at = (0..3).fold(DVec2::ZERO, |sum, i| sum + shares[i] * corners[i].at);
        // The second parameter of the surface is the first of the texture.
        let [a, b, c, d] = self.net.uv;
        let (u, v) = (at.y, at.x);
        let uv = (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c);
        Some(uv.to_array())
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
mod tests;
