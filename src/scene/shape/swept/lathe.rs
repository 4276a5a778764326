//! `lathe { [spline] number of points, <r, y>, ... }`: a surface of revolution, a curve rotated about the y axis.
//!
//! The inside test is POV-Ray's: a point is inside if a line outward crosses the curve an odd number of times, but not
//! if it is nearer to the axis than the curve comes. That closes a curve with open ends by two level rings and an
//! upright wall, which are invisible.

mod climb;
mod profile;

use super::rounded::{Edge, RoundedSweep};
use super::spline::{self, Kind, Segment};
use crate::base::args::{Args, Parse};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, Rounded, Start, Steps, first_visible};
use climb::flat;
use glam::{DAffine3, DVec2, DVec3};
use profile::{Profile, RootQuery};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A surface of revolution. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Lathe(Arc<Profile>);

impl Lathe {
    /// Reads the kind of spline and the points.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, too few points, a point beyond the axis other than the first and the last,
    /// as in POV-Ray.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let mut kind = Kind::Linear;
        while let Some(named) = Kind::accept(args)? {
            kind = named;
        }
        let at = args.span();
        let points = spline::read_points(args, "lathe")?;
        let at = at.to(args.last_span());
        let name = kind.name();
        let least = match kind {
            Kind::Linear => 2,
            Kind::Quadratic => 3,
            Kind::Cubic | Kind::Bezier => 4,
        };
        let message = if kind == Kind::Bezier && !points.len().is_multiple_of(4) {
            "lathe with bezier splines must have four points for each segment".to_owned()
        } else if points.len() < least {
            format!("lathe with {name} splines must have at least {least} points")
        } else if let Some(point) = points[1..points.len() - 1].iter().find(|p| p.x < 0.0) {
            format!(
                "a point of the lathe lies beyond its axis: <{}, {}>",
                point.x, point.y
            )
        } else {
            return Ok(Lathe(Arc::new(Profile::new(kind.segments(&points)))));
        };
        Err(Box::new(Diagnostic::error(at, message)))
    }

    /// The straight segments of the curve.
    pub(super) fn edges(&self) -> impl Iterator<Item = Edge> {
        let straight = |segment: &Segment| segment.level_edge().or_else(|| segment.edge());
        self.curve().iter().filter_map(straight)
    }

    /// The segments of the curve, without those that close it.
    fn curve(&self) -> &[Segment] {
        &self.0.segments[..self.0.visible_count]
    }
}

/// The position of a point in the half-plane of the curve.
fn in_plane(point: DVec3) -> DVec2 {
    DVec2::new(point.x.hypot(point.z), point.y)
}

impl Geometry for Lathe {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend_from_slice(&self.0.crossings(ray, RootQuery::EVERYWHERE));
        Start::Outside
    }

    fn roots_from(&self, ray: &Ray, from: f64, enough: f64, roots: &mut Vec<Root>) -> bool {
        let to = f64::INFINITY;
        roots.extend_from_slice(&self.0.crossings(ray, RootQuery { from, to, enough }));
        false
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let enough = from;
        first_visible(
            &self.0.crossings(ray, RootQuery { from, to, enough }),
            from,
            to,
        )
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let profile = &*self.0;
        let position = in_plane(point);
        let curve = &profile.segments[..profile.visible_count];
        let Some((number, x)) = spline::nearest(curve, position) else {
            return DVec3::Y;
        };
        let on_curve = curve[number].at(x);
        let across = curve[number].tangent(x).perp();
        let normal = profile.segments.outward(on_curve, across);
        let radial = if position.x > 0.0 {
            flat(point) / position.x
        } else {
            DVec2::X
        };
        DVec3::new(normal.x * radial.x, normal.y, normal.x * radial.y)
    }

    fn contains(&self, point: DVec3) -> bool {
        let position = in_plane(point);
        let profile = &*self.0;
        let curve = &profile.segments[..profile.visible_count];
        position.x >= profile.inner && spline::contains_as_povray(curve, position)
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        let is_straight = self.edges().next().is_some();
        is_straight.then(|| Rounded::of_sweep(RoundedSweep::Lathe(self.clone()), steps))
    }

    fn decides_ties(&self) -> bool {
        let mut edges = self.curve().iter().map(Segment::level_edge);
        edges.any(|edge| edge.is_some())
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        Some((self.0.hull, DAffine3::IDENTITY))
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    /// `u` around the axis from +x towards +z, `v` along the curve.
    fn uv(&self, point: DVec3, _face: u32) -> Option<[f64; 2]> {
        let around = point.z.atan2(point.x) / TAU;
        let around = if around < 0.0 { around + 1.0 } else { around };
        let curve = &self.0.segments[..self.0.visible_count];
        let along = spline::nearest(curve, in_plane(point)).map_or(0.0, |(number, x)| {
            let count = |n: usize| f64::from(u32::try_from(n).unwrap_or(u32::MAX));
            (count(number) + 0.5 * (x + 1.0)) / count(curve.len())
        });
        Some([around, along])
    }

    fn takes_sturm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
