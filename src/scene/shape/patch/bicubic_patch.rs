//! `bicubic_patch { type n [u_steps n] [v_steps n] [flatness x] [uv_vectors ...] <point>, ... }`: a Bézier surface with
//! 16 control points, tessellated into triangles, with their error bound.
//!
//! As in POV-Ray, the surface is halved along both parameters, `u_steps` and `v_steps` times, or until a part is
//! flatter than `flatness`; each part becomes two triangles, with the normals of the true surface at their corners.
//! Transforms move the control points, so the flatness is measured in the scene. Unlike in POV-Ray 3.7, which forgets
//! it, `clipped_by` clips. The two types, which differ in what POV-Ray stores, are one here.

mod halving;

use self::halving::{SubPatch, Tessellator};
use super::smooth_triangle::weights;
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word, trailing_comma};
use crate::base::math::conditioning::Normalization;
use crate::base::math::watertight::RayFrame;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, Start, Triangle, read};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// More steps would give more than two million triangles.
const MAX_STEPS: u32 = 20;
/// Corners nearer than this, relative to the size of the part, are the same; POV-Ray's tolerance is in scene units.
const MIN_CORNER_DISTANCE: f64 = 1e-10;
/// The flatness of the old syntax without keywords.
const DEFAULT_FLATNESS: f64 = 0.1;

/// Control points: rows along v of four points.
type Points = [[DVec3; 4]; 4];

/// A bicubic Bézier surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BicubicPatch {
    net: Box<Net>,
    /// True if `clipped_by` cuts the patch, as from version 3.8 on.
    is_clipped: bool,
    /// Built by [`Geometry::prepare`].
    tessellation: Option<Arc<Tessellation>>,
}

/// The control net and its settings.
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

/// The surface as triangles, with a BVH over them.
#[derive(Clone, Debug)]
struct Tessellation {
    triangles: Vec<[u32; 3]>,
    vertices: Vec<Vertex>,
    bvh: Bvh,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex {
    point: DVec3,
    normal: DVec3,
    /// Parameters `(u, v)` of the surface.
    params: DVec2,
}

impl PartialEq for Tessellation {
    /// The BVH follows from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.triangles == other.triangles && self.vertices == other.vertices
    }
}

impl BicubicPatch {
    /// Reads the keywords and the control points.
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
        if net.u_steps + net.v_steps > MAX_STEPS {
            return Err(Box::new(
                Diagnostic::error(
                    at.to(args.last_span()),
                    format!("`u_steps` and `v_steps` are {MAX_STEPS} at most together"),
                )
                .with_hint("Each step doubles the pieces of the surface; 3 or 4 look smooth."),
            ));
        }
        for number in 0..16 {
            let what = format!("point {} of 16 of the bicubic patch", number + 1);
            net.points[number / 4][number % 4] = read::vector(args, &what)?;
        }
        trailing_comma(args)?;
        Ok(BicubicPatch {
            net: Box::new(net),
            is_clipped: args.is_for_3_8(),
            tessellation: None,
        })
    }

    fn tessellation(&self) -> &Tessellation {
        self.tessellation
            .as_ref()
            .expect("shapes are prepared before rays meet them")
    }

    fn corners(&self, face: u32) -> [Vertex; 3] {
        let tessellation = self.tessellation();
        tessellation.triangles[face as usize].map(|index| tessellation.vertices[index as usize])
    }

    fn weights(&self, point: DVec3, face: u32) -> [f64; 3] {
        let corners = self.corners(face).map(|corner| corner.point);
        weights(&corners, self.normal(point, face), point)
    }
}

/// Reads the syntax of old scenes: `type, [flatness,] u_steps, v_steps`.
fn read_numbers(args: &mut dyn Args, net: &mut Net) -> Parse<()> {
    let kind = args.float()?.trunc();
    net.flatness = if kind == 2.0 || kind == 3.0 {
        read::number(args, "the flatness of the bicubic patch")?
    } else {
        DEFAULT_FLATNESS
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
    if (0.0..=f64::from(MAX_STEPS)).contains(&steps) {
        return Ok(steps as u32);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("a bicubic patch has 0 to {MAX_STEPS} steps, found {steps}"),
    )))
}

impl Net {
    fn tessellation(&self) -> Tessellation {
        let mut tessellator = Tessellator {
            net: self,
            triangles: Vec::new(),
            vertices: Vec::new(),
            vertex_ids: FxHashMap::default(),
        };
        let whole = SubPatch {
            points: self.points,
            low: DVec2::ZERO,
            high: DVec2::ONE,
        };
        tessellator.subdivide(&whole, 0);
        let Tessellator {
            triangles,
            vertices,
            ..
        } = tessellator;
        let boxes: Vec<Bounds> = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|index| vertices[index as usize].point);
                Bounds::new(a, b).with_point(c)
            })
            .collect();
        Tessellation {
            bvh: Bvh::build(&boxes),
            triangles,
            vertices,
        }
    }

    /// The unit normal of the true surface. At a pole it is the direction of the rounding errors, or x if there are none,
    /// as in POV-Ray.
    fn normal(&self, params: DVec2) -> DVec3 {
        let mut tangents = [DVec3::ZERO; 2];
        let (u, v) = (bernstein(params.x), bernstein(params.y));
        let (du, dv) = (
            bernstein_derivatives(params.x),
            bernstein_derivatives(params.y),
        );
        for i in 0..4 {
            for j in 0..4 {
                tangents[0] += self.points[i][j] * (du[i] * v[j]);
                tangents[1] += self.points[i][j] * (u[i] * dv[j]);
            }
        }
        let normal = tangents[0].cross(tangents[1]);
        let unit = Normalization::Reciprocal.unit_at_any_scale(normal);
        unit.unwrap_or(DVec3::X)
    }

    /// True if all points lie near the plane of three corners, or if these have no plane.
    fn is_flat(&self, points: &Points) -> bool {
        let [a, b, c, d] = [points[0][0], points[0][3], points[3][3], points[3][0]];
        let corner = a;
        let all = points.iter().flatten();
        let size = all.fold(0.0_f64, |size, p| size.max((*p - a).abs().max_element()));
        let is_near = |point: DVec3| (a - point).length() < MIN_CORNER_DISTANCE * size;
        let [one, other] = [b, d].map(|point| if is_near(point) { c } else { point });
        let Some(normal) = (one - a).cross(other - a).try_normalize() else {
            return true;
        };
        let mut all = points.iter().flatten();
        all.all(|point| normal.dot(*point - corner).abs() < self.flatness)
    }
}

/// Bernstein polynomials of degree three.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t]
}

/// Derivatives of the Bernstein polynomials of degree three.
fn bernstein_derivatives(t: f64) -> [f64; 4] {
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
        self.tessellation().bvh.any(ray, from, to, |face| {
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
        let mut closest: Option<Root> = None;
        self.tessellation()
            .bvh
            .nearest(ray, from, to, |candidate, end| {
                let corners = self.corners(candidate).map(|corner| corner.point);
                let Some(hit) = frame.hit(&corners) else {
                    return end;
                };
                let is_closer = closest.is_none_or(|closest| {
                    hit.t < closest.t || (hit.t == closest.t && candidate < closest.face)
                });
                if candidate == face || hit.t <= from || hit.t >= to || !is_closer {
                    return end;
                }
                closest = Some(touch(hit.t, candidate));
                hit.t
            });
        closest
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        let corners = self.corners(face).map(|corner| corner.point);
        Triangle { corners }.normal(corners[0], 0)
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let weights = self.weights(point, face);
        let corners = self.corners(face);
        let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + weights[i] * corners[i].normal);
        (mean.is_finite() && mean != DVec3::ZERO).then_some(mean)
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn is_never_clipped(&self) -> bool {
        !self.is_clipped
    }

    fn keeps_normal(&self) -> bool {
        true
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
        self.tessellation = None;
        true
    }

    fn scale_scene_lengths(&mut self, factor: f64) {
        self.net.flatness *= factor;
        self.tessellation = None;
    }

    fn prepare(&mut self) {
        if self.tessellation.is_none() {
            self.tessellation = Some(Arc::new(self.net.tessellation()));
        }
    }

    fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let weights = self.weights(point, face);
        let corners = self.corners(face);
        let params = (0..3).fold(DVec2::ZERO, |sum, i| sum + weights[i] * corners[i].params);
        // The second parameter of the surface is the first texture coordinate.
        let [a, b, c, d] = self.net.uv;
        let (u, v) = (params.y, params.x);
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
