//! `parametric { function { x }, function { y }, function { z }, <u, v>, <u, v> [contained_by { ... }] ... }`: a
//! surface whose coordinates are functions of two parameters.
//!
//! The parameter rectangle is subdivided as long as a ray may hit the patch over it. The range of a coordinate over a
//! rectangle follows from its values at the corners and `max_gradient`, as in POV-Ray; a patch smaller than `accuracy`
//! is a hit, represented by its lower corner. The hit distance is where the range of the third coordinate begins on the
//! ray.
//!
//! Error bound: that of POV-Ray, which searches the same way: `accuracy` bounds the parameters, not the point. The
//! worst of 150 rays on a sphere of radius 1 lies 0.168 off it at an accuracy of 0.001 and the worst of 100 lies 0.086
//! off it at 0.0001, where they graze it; POV-Ray gives the same numbers.
//!
//! It has no inside. The parameters of a hit are its `face`: 16 bits each, as many as subdivision yields for any
//! accuracy at which a ray can be traced.

use super::parametric_patch::{Grid, Patch};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::function::{self, Function};
use crate::scene::shape::container::Container;
use crate::scene::shape::{Crossing, Geometry, Root, Start, read};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::sync::{Arc, OnceLock};

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
    grid: OnceLock<Grid>,
}

impl PartialEq for Surface {
    /// Functions are equal if they are the same object.
    fn eq(&self, other: &Self) -> bool {
        let functions = self.functions.iter().zip(&other.functions);
        functions.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
            && (self.low, self.high) == (other.low, other.high)
            && self.container == other.container
            && (self.accuracy, self.gradient) == (other.accuracy, other.gradient)
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
            grid: OnceLock::new(),
        };
        loop {
            if args.accept(Word::ContainedBy)? {
                surface.container = Container::read(args)?;
            } else if args.accept(Word::Accuracy)? {
                surface.accuracy = positive(args, Word::Accuracy)?;
            } else if args.accept(Word::MaxGradient)? {
                surface.gradient = positive(args, Word::MaxGradient)?;
            } else if args.accept(Word::Precompute)? {
                read_precompute(args)?;
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

/// Reads `precompute depth, x, y, z`, which only makes POV-Ray faster.
fn read_precompute(args: &mut dyn Args) -> Parse<()> {
    args.float()?;
    loop {
        args.comma()?;
        let mut is_word = false;
        for word in [Word::X, Word::Y, Word::Z] {
            is_word |= args.accept(word)?;
        }
        if !is_word {
            return Ok(());
        }
    }
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
    fn grid(&self) -> Grid {
        Grid::new(self.low, self.high, self.accuracy, |at| self.point(at))
    }

    fn point(&self, at: DVec2) -> DVec3 {
        let coordinate = |axis: usize| {
            let function = &self.functions[axis];
            function.eval(&[at.x, at.y, 0.0][..function.parameters()])
        };
        DVec3::from_array([0, 1, 2].map(coordinate))
    }

    /// Distance along the ray, within limits, at which the patch over a rectangle may begin by its third coordinate;
    /// `None` if the ray misses the patch's box. The bounds are lowered by `accuracy`, as in POV-Ray.
    fn span(&self, ray: &Ray, patch: &Patch, mut near: f64, mut far: f64) -> Option<f64> {
        let size = patch.high - patch.low;
        let mut start = near;
        for axis in 0..3 {
            let [a, b, c, d] = patch.corners.map(|corner| corner[axis]);
            let left = self.between(a, b, size.y);
            let right = self.between(c, d, size.y);
            let least = self.between(left.0, right.0, size.x).0 - self.accuracy;
            let most = self.between(left.1, right.1, size.x).1 - self.accuracy;
            let (origin, dir) = (ray.origin[axis], ray.dir[axis]);
            if dir == 0.0 {
                let is_hit = least <= origin && origin <= most;
                if !is_hit {
                    return None;
                }
                continue;
            }
            let (p, q) = ((least - origin) / dir, (most - origin) / dir);
            start = p.min(q);
            near = near.max(start);
            far = far.min(p.max(q));
            if near > far {
                return None;
            }
        }
        Some(start)
    }

    /// Range of a function between two parameters at which it has these values.
    fn between(&self, a: f64, b: f64, distance: f64) -> (f64, f64) {
        let more = (0.5 * (self.gradient * distance - (a - b).abs())).max(0.0);
        (a.min(b) - more, a.max(b) + more)
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
        let least = enter.t.max(start) + MIN_DISTANCE * self.unit * self.accuracy;
        let mut end = leave.t.min(to);
        let mut best: Option<Root> = None;
        let mut stack: SmallVec<[Patch; 32]> = SmallVec::new();
        let grid = self.grid.get_or_init(|| self.grid());
        stack.push(grid.whole());
        let mut visited = 0;
        while let Some(patch) = stack.pop() {
            visited += 1;
            if visited > MAX_PATCHES {
                break;
            }
            let Some(at) = self.span(ray, &patch, least, end) else {
                continue;
            };
            let size = patch.high - patch.low;
            let is_small = size.max_element() < self.accuracy || patch.left == 0;
            if !is_small {
                let [lower, upper] = patch.halves(grid, |at| self.point(at));
                stack.extend([upper, lower]);
                continue;
            }
            let face = self.face(patch.low);
            if least < at && at < end && (skip != Some(face) || is_sphere) {
                end = at;
                best = Some(Root {
                    t: at,
                    crossing: Crossing::Touch,
                    face,
                    is_visible: true,
                });
            }
        }
        best.filter(|root| start == from || root.t > self.unit * MIN_DEPTH)
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
            grid: OnceLock::new(),
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
