//! `parametric { function { x }, function { y }, function { z }, <u, v>, <u, v> [contained_by { ... }] ... }`: a
//! surface whose coordinates are functions of two parameters.
//!
//! The parameter rectangle is subdivided as long as a ray may hit the patch over it. The range of a coordinate over a
//! rectangle follows from its values at the corners and `max_gradient`, as in POV-Ray; with `precompute` that over one
//! of the larger rectangles is the hull of those at a given depth. A patch smaller than `accuracy`
//! is a hit, represented by its lower corner. The hit distance is where the range of the third coordinate begins on the
//! ray. Where a function is not finite, ranges are not numbers, and exclude nothing.
//!
//! Error bound: that of POV-Ray, which searches the same way: `accuracy` bounds the parameters, not the point. The
//! worst of 150 rays on a sphere of radius 1 lies 0.168 off it at an accuracy of 0.001 and the worst of 100 lies 0.086
//! off it at 0.0001, where they graze it; POV-Ray gives the same numbers.
//!
//! It has no inside. The parameters of a hit are its `face`: 16 bits each, as many as subdivision yields for any
//! accuracy at which a ray can be traced.

use super::parametric_patch::{Cells, Grid, Patch, Ranges};
use crate::base::args::{Args, Parse, Word};
use crate::base::derived::Derived;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::function::{self, Function};
use crate::scene::shape::container::Container;
use crate::scene::shape::{Crossing, Geometry, Root, Start, read};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// Minimum distance of a hit from the start of a ray and from the border of the container, in units of `accuracy`.
const MIN_DISTANCE: f64 = 4.0;
/// Hits nearer than this to the start of a ray are ignored, in POV-Ray's units whatever the size of the scene.
const MIN_DEPTH: f64 = 1e-3;
/// Maximum number of patches per search: an extreme accuracy or gradient would never end.
const MAX_PATCHES: u32 = 1 << 18;
/// Maximum number of hits per ray.
const MAX_ROOTS: usize = 100;
/// Bits of each parameter in a face number.
const BITS: u32 = 16;
/// Maximum depth of `precompute`, as in POV-Ray.
const MAX_PRECOMPUTE: f64 = 20.0;
/// Defaults of `accuracy` and `max_gradient`.
const ACCURACY: f64 = 0.001;
const MAX_GRADIENT: f64 = 1.0;

/// A surface of two parameters, shared by its copies.
#[derive(Clone, Debug, PartialEq)]
pub struct Parametric(Arc<Surface>);

#[derive(Clone, Debug)]
struct Surface {
    functions: [Arc<Function>; 3],
    low: DVec2,
    high: DVec2,
    container: Container,
    accuracy: f64,
    /// Unit of lengths along a ray; in POV-Ray 1, whatever the transform of the object.
    unit: f64,
    gradient: f64,
    precomputed: [Option<Precomputed>; 3],
    grid: Derived<Grid>,
}

/// `precompute` of a coordinate, with the `accuracy` and `max_gradient` that stand before it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Precomputed {
    /// Depth of the rectangles of which the larger ones are put together.
    halvings: u32,
    margin: Margin,
}

/// Margin of the range of a function around its values at the corners.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Margin {
    accuracy: f64,
    gradient: f64,
}

/// A search for the nearest hit of a ray.
struct Search<'a> {
    ray: &'a Ray,
    near: f64,
    far: f64,
    /// A face that is not hit.
    skip: Option<u32>,
    /// Number of patches that may still be visited.
    left: u32,
    best: Option<Root>,
}

impl PartialEq for Surface {
    /// Functions are equal if they are the same object.
    fn eq(&self, other: &Self) -> bool {
        let functions = self.functions.iter().zip(&other.functions);
        functions.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
            && (self.low, self.high) == (other.low, other.high)
            && self.container == other.container
            && (self.accuracy, self.gradient) == (other.accuracy, other.gradient)
            && self.precomputed == other.precomputed
    }
}

impl Parametric {
    /// Reads the functions, the parameter ranges and the options.
    ///
    /// # Errors
    /// Missing or malformed functions, or malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let x = read_function(args)?;
        let y = read_function(args)?;
        let z = read_function(args)?;
        args.comma()?;
        let a = args.vector2()?;
        args.comma()?;
        let b = args.vector2()?;
        let mut surface = Surface {
            functions: [x, y, z],
            low: a.min(b),
            high: a.max(b),
            container: Container::DEFAULT,
            accuracy: ACCURACY,
            unit: 1.0,
            gradient: MAX_GRADIENT,
            precomputed: [None; 3],
            grid: Derived::default(),
        };
        loop {
            if args.accept(Word::ContainedBy)? {
                surface.container = Container::read(args)?;
            } else if args.accept(Word::Accuracy)? {
                surface.accuracy = positive(args, Word::Accuracy)?;
            } else if args.accept(Word::MaxGradient)? {
                surface.gradient = positive(args, Word::MaxGradient)?;
            } else if args.accept(Word::Precompute)? {
                surface.read_precompute(args)?;
            } else {
                break;
            }
        }
        Ok(Parametric(Arc::new(surface)))
    }
}

fn read_function(args: &mut dyn Args) -> Parse<Arc<Function>> {
    args.comma()?;
    if !args.accept(Word::Function)? {
        return Err(args.expected("three functions at the start of `parametric`"));
    }
    let function = function::read(args)?;
    if function.is_scalar() && (2..=3).contains(&function.parameters()) {
        return Ok(function);
    }
    Err(Box::new(
        Diagnostic::error(
            args.last_span(),
            "a function of u and v that gives one number is wanted here",
        )
        .with_hint("Write a formula that calls this function: `function { F(u, v, 0) }`."),
    ))
}

fn positive(args: &mut dyn Args, word: Word) -> Parse<f64> {
    let at = args.span();
    let value = read::number(args, &format!("`{word}` of the parametric surface"))?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("`{word}` must be positive, found {value}"),
    )))
}

impl Surface {
    /// Reads `precompute depth, x, y, z`.
    fn read_precompute(&mut self, args: &mut dyn Args) -> Parse<()> {
        let at = args.span();
        let depth = read::number(args, "the depth of `precompute`")?.trunc();
        if !(1.0..=MAX_PRECOMPUTE).contains(&depth) {
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                format!(
                    "the depth of `precompute` must be from 1 to {MAX_PRECOMPUTE}, found {depth}"
                ),
            )));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 1 to 20"
        )]
        let precomputed = Precomputed {
            halvings: depth as u32 - 1,
            margin: self.margin(),
        };
        loop {
            args.comma()?;
            let mut is_word = false;
            for (axis, word) in [Word::X, Word::Y, Word::Z].into_iter().enumerate() {
                if args.accept(word)? {
                    self.precomputed[axis] = Some(precomputed);
                    is_word = true;
                }
            }
            if !is_word {
                return Ok(());
            }
        }
    }

    fn margin(&self) -> Margin {
        Margin {
            accuracy: self.accuracy,
            gradient: self.gradient,
        }
    }

    fn grid(&self) -> Grid {
        let point = |at| self.point(at);
        let mut grid = Grid::new(self.low, self.high, self.accuracy, point);
        let depths = self.precomputed.iter().flatten();
        let halvings = depths.map(|known| known.halvings).max().unwrap_or(0);
        grid.store_ranges(halvings, point, |patch, halves| {
            self.stored_ranges(patch, halves)
        });
        grid
    }

    /// Ranges over a rectangle that are stored, given those over its halves.
    fn stored_ranges(&self, patch: &Patch, halves: Option<[&Ranges; 2]>) -> Ranges {
        let mut ranges = self.ranges(patch);
        for (axis, known) in self.precomputed.iter().enumerate() {
            let Some(known) = known else {
                continue;
            };
            let depth = patch.depth();
            let (least, most) = match halves {
                Some([a, b]) if depth < known.halvings => (
                    // In this order where one is not a number.
                    if a.least[axis] < b.least[axis] { a } else { b }.least[axis],
                    if a.most[axis] > b.most[axis] { a } else { b }.most[axis],
                ),
                _ if depth == known.halvings => known.margin.range(patch, axis),
                _ => continue,
            };
            (ranges.least[axis], ranges.most[axis]) = (least, most);
        }
        ranges
    }

    /// Ranges of the coordinates over a rectangle, by its corners.
    fn ranges(&self, patch: &Patch) -> Ranges {
        let margin = self.margin();
        let [x, y, z] = [0, 1, 2].map(|axis| margin.range(patch, axis));
        Ranges {
            least: [x.0, y.0, z.0],
            most: [x.1, y.1, z.1],
        }
    }

    fn point(&self, at: DVec2) -> DVec3 {
        let coordinate = |axis: usize| {
            let function = &self.functions[axis];
            function.eval(&[at.x, at.y, 0.0][..function.parameters()])
        };
        DVec3::new(coordinate(0), coordinate(1), coordinate(2))
    }

    /// Closest hit strictly between `from` and `to`, on any face except `skip`. Lower halves are searched first: which
    /// of several patches overlapping on the ray is hit depends on the order.
    fn first(&self, ray: &Ray, from: f64, to: f64, skip: Option<u32>) -> Option<Root> {
        let [enter, leave] = self.container.chord(ray)?;
        // In POV-Ray the interval through a spherical container begins behind a ray that starts in it, and a hit there
        // hides the rest.
        let is_sphere = matches!(self.container, Container::Sphere { .. });
        let start = if is_sphere && from < self.unit * MIN_DEPTH {
            f64::NEG_INFINITY
        } else {
            from
        };
        let mut search = Search {
            ray,
            near: enter.t.max(start) + MIN_DISTANCE * self.unit * self.accuracy,
            far: leave.t.min(to),
            skip: skip.filter(|_| !is_sphere),
            left: MAX_PATCHES,
            best: None,
        };
        if search.near > search.far {
            return None;
        }
        let grid = self.grid.get_or_init(|| self.grid());
        let mut stack: SmallVec<[Cells; 32]> = SmallVec::new();
        stack.push(grid.whole());
        while let Some(cells) = stack.pop() {
            let Some(at) = search.visit(grid.ranges(cells)) else {
                continue;
            };
            let [low, high] = grid.limits(cells);
            if (high - low).max_element() < self.accuracy {
                search.take(at, self.face(low));
            } else if let Some([lower, upper]) = grid.halves(cells) {
                stack.extend([upper, lower]);
            } else {
                self.search_below(grid.patch(cells), grid, &mut search);
            }
        }
        let best = search.best;
        best.filter(|root| start == from || root.t > self.unit * MIN_DEPTH)
    }

    /// Searches a patch that a ray may hit and that the grid does not divide.
    fn search_below(&self, patch: Patch, grid: &Grid, search: &mut Search) {
        let mut stack: SmallVec<[Patch; 16]> = SmallVec::new();
        let [lower, upper] = patch.halves(|at| self.point(at));
        stack.extend([upper, lower]);
        while let Some(patch) = stack.pop() {
            let at = match grid.ranges_of(patch.number) {
                Some(ranges) => search.visit(ranges),
                None => search.visit(&self.ranges(&patch)),
            };
            let Some(at) = at else {
                continue;
            };
            let size = patch.high - patch.low;
            if size.max_element() < self.accuracy || patch.is_last() {
                search.take(at, self.face(patch.low));
            } else {
                let [lower, upper] = patch.halves(|at| self.point(at));
                stack.extend([upper, lower]);
            }
        }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cut to sixteen digits"
    )]
    fn face(&self, at: DVec2) -> u32 {
        let share = (at - self.low) / (self.high - self.low);
        // Rounded, since subdivision leaves the corners off by a last digit.
        let bits = |share: f64| {
            let bits = (share * f64::from(1_u32 << BITS)).round();
            bits.clamp(0.0, 65535.0) as u32
        };
        bits(share.x) << BITS | bits(share.y)
    }

    /// Parameters of a face.
    fn parameters(&self, face: u32) -> DVec2 {
        let share = DVec2::new(f64::from(face >> BITS), f64::from(face & 0xFFFF));
        self.low + share / f64::from(1_u32 << BITS) * (self.high - self.low)
    }
}

impl Margin {
    /// Range of a coordinate over a rectangle. It is lowered by `accuracy`, as in POV-Ray.
    #[inline]
    fn range(&self, patch: &Patch, axis: usize) -> (f64, f64) {
        let size = patch.high - patch.low;
        let at = |corner: usize| patch.corners[corner].to_array()[axis] - self.accuracy;
        let left = self.between(at(0), at(1), size.y);
        let right = self.between(at(2), at(3), size.y);
        let least = self.between(left.0, right.0, size.x).0;
        let most = self.between(left.1, right.1, size.x).1;
        (least, most)
    }

    /// Range of a function between two parameters at which it has these values. Comparisons and the margin are such
    /// that values which are not numbers, or infinite at both ends, come out as in POV-Ray.
    #[inline]
    fn between(&self, a: f64, b: f64, distance: f64) -> (f64, f64) {
        let (least, most) = if a < b { (a, b) } else { (b, a) };
        let more = self.gradient * distance - (most - least);
        let more = if more < 0.0 { 0.0 } else { 0.5 * more };
        (least - more, most + more)
    }
}

impl Search<'_> {
    /// Distance along the ray at which a patch may begin by its third coordinate; `None` if the ray misses the box of
    /// its ranges. Ranges that are not numbers exclude nothing.
    #[inline]
    fn visit(&mut self, ranges: &Ranges) -> Option<f64> {
        self.left = self.left.checked_sub(1)?;
        let (mut near, mut far) = (self.near, self.far);
        let mut start = near;
        let origin = self.ray.origin.to_array();
        let dir = self.ray.dir.to_array();
        for axis in 0..3 {
            let (least, most) = (ranges.least[axis], ranges.most[axis]);
            let (origin, dir) = (origin[axis], dir[axis]);
            if dir == 0.0 {
                if most < origin || least > origin {
                    return None;
                }
                continue;
            }
            let (mut begin, mut end) = ((least - origin) / dir, (most - origin) / dir);
            if begin > end {
                (begin, end) = (end, begin);
            }
            if end < near || begin > far {
                return None;
            }
            start = begin;
            near = if begin > near { begin } else { near };
            far = if end < far { end } else { far };
        }
        Some(start)
    }

    /// Takes a patch for hit.
    fn take(&mut self, at: f64, face: u32) {
        if self.near < at && at < self.far && self.skip != Some(face) {
            self.far = at;
            self.best = Some(Root {
                t: at,
                crossing: Crossing::Touch,
                face,
                is_visible: true,
            });
        }
    }
}

impl Geometry for Parametric {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let mut from = f64::NEG_INFINITY;
        for _ in 0..MAX_ROOTS {
            let Some(root) = self.0.first(ray, from, f64::INFINITY, None) else {
                break;
            };
            from = root.t;
            roots.push(root);
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.0.first(ray, from, to, None)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        self.0.first(ray, from, to, Some(face))
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        let surface = &self.0;
        let at = surface.parameters(face);
        let here = surface.point(at);
        let along_u = surface.point(at + surface.accuracy * DVec2::X) - here;
        let along_v = surface.point(at + surface.accuracy * DVec2::Y) - here;
        let normal = along_u.cross(along_v);
        if normal.is_finite() && normal != DVec3::ZERO {
            normal
        } else {
            DVec3::X
        }
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn bounds(&self) -> Bounds {
        self.0.container.bounds()
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn scale_scene_lengths(&mut self, factor: f64) {
        Arc::make_mut(&mut self.0).unit *= factor;
    }

    fn uv(&self, _: DVec3, face: u32) -> Option<[f64; 2]> {
        Some(self.0.parameters(face).to_array())
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
    use crate::scene::function::{Field, Kind};

    #[derive(Debug)]
    struct Coordinate(fn(f64, f64) -> f64);

    impl Field for Coordinate {
        fn value(&self, point: DVec3) -> f64 {
            (self.0)(point.x, point.y)
        }
    }

    /// A sphere of radius one.
    fn unit_sphere() -> Parametric {
        let functions: [fn(f64, f64) -> f64; 3] = [
            |u, v| u.sin() * v.cos(),
            |u, _| u.cos(),
            |u, v| u.sin() * v.sin(),
        ];
        let field = |f| Arc::new(Function::of(Kind::Field(Arc::new(Coordinate(f)))));
        Parametric(Arc::new(Surface {
            functions: functions.map(field),
            low: DVec2::ZERO,
            high: DVec2::new(std::f64::consts::PI, std::f64::consts::TAU),
            container: Container::Box {
                low: DVec3::splat(-1.1),
                high: DVec3::splat(1.1),
            },
            accuracy: 1e-4,
            unit: 1.0,
            gradient: 1.0,
            precomputed: [None; 3],
            grid: Derived::default(),
        }))
    }

    #[test]
    fn hits_lie_on_the_surface_and_normals_across_it() {
        let sphere = unit_sphere();
        let ray = Ray::new(DVec3::new(0.3, 0.2, -3.0), DVec3::Z);
        let hit = sphere.nearest(&ray, 0.0, 9.0).unwrap();
        let point = ray.at(hit.t);
        assert!((point.length() - 1.0).abs() < 1e-3);
        let normal = sphere.normal(point, hit.face).normalize();
        assert!(normal.dot(point.normalize()).abs() > 0.999);
        assert!(
            sphere
                .nearest(&Ray::new(DVec3::new(0.9, 0.9, -3.0), DVec3::Z), 0.0, 9.0)
                .is_none()
        );
    }

    #[test]
    fn a_ray_goes_on_to_the_far_side() {
        let sphere = unit_sphere();
        let ray = Ray::new(DVec3::new(0.3, 0.2, -3.0), DVec3::Z);
        let hit = sphere.nearest(&ray, 0.0, 9.0).unwrap();
        let on = Ray::new(ray.at(hit.t), ray.dir);
        let far = sphere.nearest_beside(&on, 0.0, 9.0, hit.face).unwrap();
        let expected = 2.0 * (1.0_f64 - 0.13).sqrt();
        assert!((far.t - expected).abs() < 2e-3, "{far:?}");
    }

    #[test]
    fn a_face_encodes_the_parameters() {
        let sphere = unit_sphere();
        let at = DVec2::new(0.625 * std::f64::consts::PI, 0.5 * std::f64::consts::TAU);
        assert_eq!(sphere.0.parameters(sphere.0.face(at)), at);
    }
}
