//! `polygon { number of points, <point>, ... }`: a flat patch inside one or more closed outlines.
//!
//! Each outline ends where it returns to its first point; a point is inside if the outlines wind around it an odd
//! number of times. Points that do not lie in one plane make nothing, as in POV-Ray. It has no inside. Error bound: 2
//! roundings of the problem's size from the plane (`shape/roundings.rs`).

use crate::base::args::{Args, Parse, trailing_comma};
use crate::base::math::conditioning::{power_of_two, unit};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::swept::spline;
use crate::scene::shape::{Crossing, Geometry, Root, Start, first_visible, read};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Points farther from a common plane than this, in units of the polygon's size, make no polygon.
const FLAT: f64 = 1e-10;

/// A flat patch. It is one piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon(Arc<Patch>);

#[derive(Debug, PartialEq)]
struct Patch {
    /// A point of the plane.
    centre: DVec3,
    /// Unit normal; zero for a polygon that cannot be seen.
    normal: DVec3,
    /// The dominant axis of the normal: points are compared in projection along it.
    axis: usize,
    /// Edges relative to the centre, projected along that axis.
    edges: Vec<[DVec2; 2]>,
    bounds: Bounds,
}

impl Polygon {
    /// Reads the number of points and the points.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, fewer than three points.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let count = read::number(args, "the number of points of the polygon")?;
        let mut points = Vec::new();
        let mut read = 1.0;
        while read <= count {
            points.push(read::vector(args, "a point of the polygon")?);
            read += 1.0;
        }
        trailing_comma(args)?;
        let at = at.to(args.last_span());
        if points.len() < 3 {
            let error = Diagnostic::error(at, "polygon needs at least three points");
            return Err(Box::new(error));
        }
        let (edges, is_closed) = edges(&points);
        if !is_closed {
            args.warn(Diagnostic::warning(
                at,
                "polygon not closed; it is closed by one more edge",
            ));
        }
        let patch = Patch::new(&points, &edges);
        if patch.normal == DVec3::ZERO {
            args.warn(Diagnostic::warning(
                at,
                "the points of the polygon do not span a plane; it is not drawn",
            ));
        }
        Ok(Polygon(Arc::new(patch)))
    }

    fn intersect(&self, ray: &Ray) -> Option<Root> {
        let patch = &*self.0;
        let origin = ray.origin - patch.centre;
        let t = -patch.normal.dot(origin) / patch.normal.dot(ray.dir);
        if !t.is_finite() || !patch.contains_projected(project(origin + t * ray.dir, patch.axis)) {
            return None;
        }
        Some(Root {
            t,
            crossing: Crossing::Touch,
            face: 0,
            is_visible: true,
        })
    }
}

/// Edges of all outlines, and true if the last one returns to its first point.
fn edges(points: &[DVec3]) -> (Vec<[DVec3; 2]>, bool) {
    let is_same = |a: DVec3, b: DVec3| {
        let [a, b, c, d] = [a.truncate(), b.truncate(), DVec2::X * a.z, DVec2::X * b.z];
        spline::is_same(a, b) && spline::is_same(c, d)
    };
    let mut edges = Vec::new();
    let mut first: Option<DVec3> = None;
    let mut last = DVec3::ZERO;
    for &point in points {
        let Some(begin) = first else {
            (first, last) = (Some(point), point);
            continue;
        };
        if is_same(point, begin) {
            edges.push([last, begin]);
            first = None;
        } else {
            edges.push([last, point]);
            last = point;
        }
    }
    if let Some(begin) = first {
        edges.push([last, begin]);
    }
    (edges, first.is_none())
}

impl Patch {
    fn new(points: &[DVec3], edges: &[[DVec3; 2]]) -> Self {
        let whole = points
            .iter()
            .fold(Bounds::EMPTY, |bounds, point| bounds.with_point(*point));
        let centre = points[0];
        let size = power_of_two((whole.max - whole.min).max_element());
        let normal = plane_normal(points, centre, size);
        let axis = normal.abs().max_position();
        let slack = 8.0 * f64::EPSILON * whole.min.abs().max(whole.max.abs()).max_element();
        let edges = edges
            .iter()
            .map(|edge| edge.map(|point| project(point - centre, axis)))
            .collect();
        Patch {
            centre,
            normal,
            axis,
            edges,
            bounds: if normal == DVec3::ZERO {
                Bounds::EMPTY
            } else {
                Bounds::new(whole.min - slack, whole.max + slack)
            },
        }
    }

    /// True if a point of the plane lies within the outlines.
    fn contains_projected(&self, point: DVec2) -> bool {
        let mut is_within = false;
        for [a, b] in &self.edges {
            if (a.y < point.y) != (b.y < point.y) {
                let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
                let side = (*high - *low).perp_dot(point - *low);
                is_within ^= side > 0.0;
            }
        }
        is_within
    }
}

/// Unit normal of the plane of all points, zero if there is none. It points as that of the first three points that are not
/// in line, of which two are the first two (docs/povray-shapes.md, section 6).
fn plane_normal(points: &[DVec3], centre: DVec3, size: f64) -> DVec3 {
    let offsets: Vec<DVec3> = points
        .iter()
        .map(|point| (*point - centre) / size)
        .collect();
    let longest = |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
    let Some(offset) = offsets.iter().copied().max_by(longest) else {
        return DVec3::ZERO;
    };
    let crosses = offsets.iter().map(|other| offset.cross(*other));
    let Some(normal) = crosses.max_by(longest).and_then(unit) else {
        return DVec3::ZERO;
    };
    let is_flat = offsets
        .iter()
        .all(|offset| normal.dot(*offset).abs() <= FLAT);
    if !is_flat {
        return DVec3::ZERO;
    }
    let side = offsets.iter().find(|offset| **offset != DVec3::ZERO);
    let mut turns = offsets
        .iter()
        .filter_map(|other| Some(side?.cross(*other).dot(normal)));
    let turn = turns.find(|turn| turn.abs() > FLAT).unwrap_or(1.0);
    // Zeros stay positive, as `trace` shows them.
    DVec3::ZERO + if turn < 0.0 { -normal } else { normal }
}

/// Projects a vector along an axis.
fn project(v: DVec3, axis: usize) -> DVec2 {
    match axis {
        0 => DVec2::new(v.y, v.z),
        1 => DVec2::new(v.x, v.z),
        _ => DVec2::new(v.x, v.y),
    }
}

impl Geometry for Polygon {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend(self.intersect(ray));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(self.intersect(ray).as_slice(), from, to)
    }

    fn normal(&self, _: DVec3, _: u32) -> DVec3 {
        self.0.normal
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn keeps_normal(&self) -> bool {
        true
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn is_faceted(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::shape::tests::check;

    fn polygon(text: &str) -> (Polygon, TextArgs) {
        let mut args = TextArgs::new(text);
        let polygon = Polygon::read(&mut args).unwrap();
        assert!(args.is_done());
        (polygon, args)
    }

    const HOLE: &str = "10, <-2,-2,1>, <2,-2,1>, <2,2,1>, <-2,2,1>, <-2,-2,1>,
        <-1,-1,1>, <1,-1,1>, <1,1,1>, <-1,1,1>, <-1,-1,1>";

    #[test]
    fn outlines_are_patches() {
        let (with_hole, args) = polygon(HOLE);
        assert!(args.warnings().is_empty());
        check::patch(&with_hole);
        let (tilted, _) = polygon("4, <0,0,0>, <1,0,2>, <1,1,3>, <0,0,0>");
        check::patch(&tilted);
        let through = |x: f64| Ray::new(DVec3::new(x, 0.0, -4.0), DVec3::Z);
        assert!(with_hole.intersect(&through(0.5)).is_none());
        assert_eq!(with_hole.intersect(&through(1.5)).unwrap().t, 5.0);
    }

    #[test]
    fn an_outline_that_is_open_is_closed_with_a_warning() {
        for text in [
            "4, <-1,-1,0>, <1,-1,0>, <1,1,0>, <-1,1,0>",
            "5, <-1,-1,0>, <-1,-1,0>, <1,-1,0>, <1,1,0>, <-1,-1,0>",
        ] {
            let (closed, args) = polygon(text);
            assert_eq!(
                args.warnings(),
                ["polygon not closed; it is closed by one more edge"]
            );
            assert!(!closed.bounds().is_empty());
        }
    }

    #[test]
    fn a_polygon_that_is_not_flat_is_empty() {
        for text in [
            "5, <-1,-1,0>, <1,-1,0>, <1,1,0.2>, <-1,1,0>, <-1,-1,0>",
            "4, <-1,-1,0>, <1,-1,0>, <2,-1,0>, <-1,-1,0>",
            "3, <1,1,1>, <1,1,1>, <1,1,1>",
        ] {
            let (nothing, _) = polygon(text);
            assert!(nothing.bounds().is_empty());
            let ray = Ray::new(DVec3::new(0.1, 0.1, -4.0), DVec3::Z);
            assert!(nothing.intersect(&ray).is_none());
        }
        let error = Polygon::read(&mut TextArgs::new("2, <0,0,0>, <1,0,0>")).unwrap_err();
        assert_eq!(error.message, "polygon needs at least three points");
    }

    #[test]
    fn neighbours_share_every_point_of_their_edge() {
        let (left, _) = polygon("4, <0,0,0>, <0.7,1.3,0>, <-1,1,0>, <0,0,0>");
        let (right, _) = polygon("4, <0,0,0>, <1,0,0>, <0.7,1.3,0>, <0,0,0>");
        for i in 1..1000 {
            let share = f64::from(i) / 1000.0;
            let ray = Ray::new(DVec3::new(0.7 * share, 1.3 * share, -1.0), DVec3::Z);
            let hits = [&left, &right].map(|p| u8::from(p.intersect(&ray).is_some()));
            assert_eq!(hits[0] + hits[1], 1);
        }
    }
}
