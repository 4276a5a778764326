//! `isosurface { function { ... } [contained_by { ... }] [threshold] [accuracy] [max_gradient] [open] ... }`: the
//! surface on which a function of the point has the value `threshold`; inside the function is smaller, or larger with a
//! positive `polarity` (since version 3.8).
//!
//! There is no root between two points of a ray if the values there are too large to fall to zero at `max_gradient`,
//! the greatest change of the function per unit of length; otherwise the interval is halved, down to `accuracy`
//! (Lipschitz bounds; Kalra and Barr 1989). The search visits the same intervals as POV-Ray's, since its roots lie up
//! to `accuracy` beyond the surface: a finer search would change the image, and so would one that finds what a wrong
//! `max_gradient` misses.
//!
//! Error bound: `accuracy` along the ray, as in POV-Ray (`tests/stability`), and nothing else.
//!
//! `evaluate` raises the gradient separately for each ray; in POV-Ray it stays raised for later rays, so that the image
//! depends on their order. Normals are finite differences over `accuracy`.
//!
//! In CSG, visibility and the inside are independent (measured with POV-Ray): the inside is exact, but a ray shows no
//! more than its first `max_trace` roots of the surface. The container is visible where a ray from outside enters the
//! solid through it, and again as the first root, `accuracy` further on; and where a ray that starts within it leaves
//! the solid through it, unless the function is zero there. Neither counts as a root.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::function::{self, Function};
use crate::scene::shape::container::Container;
use crate::scene::shape::{Crossing, Geometry, Root, Start, SurfaceSide, read};
use glam::DVec3;
use std::sync::Arc;

/// Distance in accuracies at which the search resumes after a root, or begins on a ray that leaves a surface.
const RESUME_AFTER_ROOT: f64 = 5.0;
/// A ray starts on the surface if the function there is below this many accuracies times the gradient.
const ON_SURFACE: f64 = 4.0;
/// Depth of bisection: more than the bits of a number.
const MAX_DEPTH: u32 = 64;
/// Intervals that the search may visit on one ray. Only meaningless settings need more (a container of 10³⁰ and a
/// gradient as large), and POV-Ray does not terminate there.
const MAX_INTERVALS: u32 = 1 << 18;
/// Visible roots of one ray with `all_intersections`, and the largest `max_trace`.
const MAX_VISIBLE: u32 = 10;
/// Limit of roots of one ray.
const MAX_ROOTS: usize = 1000;
/// Defaults of `accuracy` and `max_gradient`.
const ACCURACY: f64 = 0.001;
const MAX_GRADIENT: f64 = 1.1;
/// Face number of the surface itself; faces of the container have smaller numbers.
const SURFACE: u32 = Container::FACES;

/// An isosurface of a function. Copies share it.
#[derive(Clone, Debug, PartialEq)]
pub struct Isosurface(Arc<Solid>);

#[derive(Clone, Debug)]
struct Solid {
    function: Arc<Function>,
    container: Container,
    threshold: f64,
    accuracy: f64,
    /// The unit of `accuracy` along a ray; POV-Ray uses 1 whatever the transform of the object.
    unit: f64,
    gradient: f64,
    evaluate: Option<Evaluate>,
    /// Number of visible roots per ray.
    visible_count: u32,
    is_open: bool,
    /// 1 if the function is smaller inside, -1 if it is larger there.
    side: f64,
}

/// Growth of the gradient: `evaluate least, factor, ...`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Evaluate {
    factor: f64,
}

impl PartialEq for Solid {
    /// Functions are equal if they share one value.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function)
            && self.container == other.container
            && [self.threshold, self.accuracy, self.gradient]
                == [other.threshold, other.accuracy, other.gradient]
            && self.evaluate == other.evaluate
            && self.side == other.side
            && (self.is_open, self.visible_count) == (other.is_open, other.visible_count)
    }
}

impl Isosurface {
    /// Reads the function and the keywords of the isosurface.
    ///
    /// # Errors
    /// A missing or malformed function, or malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        if !args.accept(Word::Function)? {
            return Err(args.expected("`function` at the start of `isosurface`"));
        }
        let mut solid = Solid {
            function: function::read_of_point(args)?,
            container: Container::DEFAULT,
            threshold: 0.0,
            accuracy: ACCURACY,
            unit: 1.0,
            gradient: MAX_GRADIENT,
            evaluate: None,
            visible_count: 1,
            is_open: false,
            side: 1.0,
        };
        while read_word(args, &mut solid)? {}
        Ok(Isosurface(Arc::new(solid)))
    }

    /// The function at a point, within the container or not.
    pub(crate) fn function_value(&self, point: DVec3) -> f64 {
        self.0.function.eval(&point.to_array())
    }

    /// The value of the function on the surface.
    pub(crate) fn threshold(&self) -> f64 {
        self.0.threshold
    }
}

/// Reads one of the keywords that may come in any order; false if none is next.
fn read_word(args: &mut dyn Args, solid: &mut Solid) -> Parse<bool> {
    if args.accept(Word::ContainedBy)? {
        solid.container = Container::read(args)?;
    } else if args.accept(Word::Threshold)? {
        solid.threshold = read::number(args, "the threshold of the isosurface")?;
    } else if args.accept(Word::Accuracy)? {
        solid.accuracy = positive(args, "accuracy", ACCURACY)?;
    } else if args.accept(Word::MaxGradient)? {
        solid.gradient = positive(args, "max_gradient", MAX_GRADIENT)?;
    } else if args.accept(Word::Evaluate)? {
        let least = positive(args, "evaluate", MAX_GRADIENT)?;
        let factor = read::number(args, "the factor of `evaluate`")?.max(1.0);
        read::number(args, "the last number of `evaluate`")?;
        solid.gradient = least;
        solid.evaluate = Some(Evaluate { factor });
    } else if args.accept(Word::MaxTrace)? {
        let max_trace = args.float()?;
        let more = (2..=MAX_VISIBLE).take_while(|&count| f64::from(count) <= max_trace);
        solid.visible_count = more.last().unwrap_or(1);
    } else if args.accept(Word::AllIntersections)? {
        if args.float_or(1.0)? != 0.0 {
            solid.visible_count = MAX_VISIBLE;
        }
    } else if args.accept(Word::Polarity)? {
        let is_above = read::number(args, "the polarity of the isosurface")? > 0.0;
        solid.side = if is_above { -1.0 } else { 1.0 };
    } else if args.accept(Word::Open)? {
        solid.is_open = args.float_or(1.0)? != 0.0;
    } else {
        return Ok(false);
    }
    Ok(true)
}

/// Reads a positive number; any other gives a warning and is replaced by `default`, as in POV-Ray.
fn positive(args: &mut dyn Args, word: &str, default: f64) -> Parse<f64> {
    args.comma()?;
    let at = args.span();
    let value = read::number(args, word)?;
    if value > 0.0 {
        return Ok(value);
    }
    args.warn(
        Diagnostic::warning(
            at.to(args.last_span()),
            format!("`{word}` must be positive, found {value}; it is taken as {default}"),
        )
        .with_hint("Write a positive number."),
    );
    Ok(default)
}

impl Solid {
    /// The accuracy along a ray.
    fn ray_accuracy(&self) -> f64 {
        self.unit * self.accuracy
    }

    fn value(&self, point: DVec3) -> f64 {
        self.side * (self.function.eval(&point.to_array()) - self.threshold)
    }

    /// Passes the roots of a ray from its start on, in order, to `emit` until it returns false. Returns the side on
    /// which the ray starts. A ray that starts on the surface has just left it: POV-Ray takes the function's sign a
    /// little further on.
    fn follow(&self, ray: &Ray, emit: &mut dyn FnMut(Root) -> bool) -> Start {
        let Some([enter, leave]) = self.container.chord(ray) else {
            return Start::Outside;
        };
        if leave.t <= 0.0 {
            return Start::Outside;
        }
        let mut search = Search {
            solid: self,
            ray,
            dir_length: ray.dir.length(),
            gradient: self.gradient,
            intervals: 0,
        };
        let mut is_inside = false;
        let mut start_t = enter.t.max(0.0);
        let mut root_count = 0;
        let value = search.value(start_t, 1.0);
        let starts_outside = enter.t > self.ray_accuracy();
        if starts_outside && leave.t - start_t < self.ray_accuracy() {
            return Start::Outside;
        }
        if starts_outside {
            is_inside = value < 0.0;
            if is_inside && !emit(self.container_root(enter.t, enter.face, Crossing::Enter)) {
                return Start::Outside;
            }
            if is_inside && !self.is_open {
                let again = search.root(start_t, leave.t, 1.0);
                if let Some(t) = again {
                    start_t = t + RESUME_AFTER_ROOT * self.ray_accuracy();
                    root_count = 1;
                    if !emit(self.surface_root(t, Crossing::Touch, true)) {
                        return Start::Outside;
                    }
                }
            }
        } else if value < self.gradient * self.accuracy * ON_SURFACE {
            // This may lie beyond the container, whose end is then the root.
            start_t = RESUME_AFTER_ROOT * self.ray_accuracy();
            is_inside = search.value(start_t, 1.0) < 0.0;
        }
        let is_too_short = !self.is_open && leave.t - start_t < self.ray_accuracy();
        let most_roots = if is_too_short { 0 } else { MAX_ROOTS };
        let start_side = if is_inside && !starts_outside {
            Start::Inside
        } else {
            Start::Outside
        };
        for _ in 0..most_roots {
            let Some(t) = search.root(start_t, leave.t, if is_inside { -1.0 } else { 1.0 }) else {
                break;
            };
            let crossing = if is_inside {
                Crossing::Leave
            } else {
                Crossing::Enter
            };
            is_inside = !is_inside;
            start_t = t + RESUME_AFTER_ROOT * self.ray_accuracy();
            root_count += 1;
            if !emit(self.surface_root(t, crossing, root_count <= self.visible_count)) {
                return start_side;
            }
            if start_t >= leave.t {
                break;
            }
        }
        if is_inside {
            let container_root = self.container_root(leave.t, leave.face, Crossing::Leave);
            // Where the surface coincides with the container's, neither is visible from inside (measured with POV-Ray).
            let is_seen = container_root.is_visible
                && !starts_outside
                && !is_too_short
                && search.value(leave.t, 1.0) != 0.0;
            emit(Root {
                is_visible: is_seen,
                ..container_root
            });
        }
        start_side
    }

    /// A root of the function.
    fn surface_root(&self, t: f64, crossing: Crossing, is_traced: bool) -> Root {
        Root {
            t,
            crossing,
            face: SURFACE,
            is_visible: is_traced && t > self.ray_accuracy(),
        }
    }

    /// A root on the container.
    fn container_root(&self, t: f64, face: u32, crossing: Crossing) -> Root {
        Root {
            t,
            crossing,
            face,
            is_visible: !self.is_open && t > self.ray_accuracy(),
        }
    }
}

/// The root search on a ray.
struct Search<'a> {
    solid: &'a Solid,
    ray: &'a Ray,
    /// Length of the ray's direction.
    dir_length: f64,
    /// The current gradient, which `evaluate` may raise.
    gradient: f64,
    /// Number of intervals visited.
    intervals: u32,
}

/// The function's value at a point of a ray.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    value: f64,
}

impl Search<'_> {
    fn value(&self, t: f64, sign: f64) -> f64 {
        sign * self.solid.value(self.ray.at(t))
    }

    fn sample(&self, t: f64, sign: f64) -> Sample {
        let value = self.value(t, sign);
        Sample { t, value }
    }

    /// The first point between `from` and `to` at which the search finds a negative value.
    fn root(&mut self, from: f64, to: f64, sign: f64) -> Option<f64> {
        let (before, after) = (self.sample(from, sign), self.sample(to, sign));
        self.bisect([before, after], to - from, sign, MAX_DEPTH)
    }

    /// `step` is the length of the interval: halved, not computed from its ends, so that roots have POV-Ray's last digits.
    fn bisect(&mut self, ends: [Sample; 2], step: f64, sign: f64, depth_left: u32) -> Option<f64> {
        let [from, to] = ends;
        self.intervals += 1;
        if step < self.solid.ray_accuracy() || depth_left == 0 || self.intervals > MAX_INTERVALS {
            return (to.value < 0.0).then_some(to.t);
        }
        if let Some(Evaluate { factor }) = self.solid.evaluate {
            let slope = (to.value - from.value).abs() / (step * self.dir_length);
            if slope * factor > self.gradient {
                self.gradient = slope * factor * factor;
            }
        }
        let may_fall = from.value + to.value < self.gradient * self.dir_length * step;
        if !may_fall {
            return None;
        }
        let half = 0.5 * step;
        let middle = self.sample(from.t + half, sign);
        self.bisect([from, middle], half, sign, depth_left - 1)
            .or_else(|| self.bisect([middle, to], half, sign, depth_left - 1))
    }
}

impl Geometry for Isosurface {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        self.0.follow(ray, &mut |root| {
            roots.push(root);
            true
        })
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut hit = None;
        self.0.follow(ray, &mut |root| {
            if root.is_visible && from < root.t {
                hit = Some(root);
            }
            hit.is_none() && root.t < to
        });
        hit.filter(|root| root.t < to)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, _: u32) -> Option<Root> {
        self.nearest(ray, from, to)
    }

    fn excludes_spawn_surface(&self) -> bool {
        true
    }

    fn may_miss_roots(&self) -> bool {
        true
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let solid = &self.0;
        if face != SURFACE || solid.container.takes_in(point) {
            return solid.container.normal(point, face);
        }
        let here = solid.value(point);
        let along = |axis: DVec3| solid.value(point + solid.accuracy * axis) - here;
        let normal = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
        // Made a unit vector here and once more by the caller, as in POV-Ray: that changes last digits.
        normal.normalize_or(DVec3::X)
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.container.contains(point) && self.0.value(point) <= 0.0
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Inside
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

    /// Makes callers use `nearest_beside` for rays that leave the surface.
    fn is_faceted(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::function::Kind;

    #[derive(Debug)]
    struct SphereField;

    impl function::Field for SphereField {
        fn value(&self, point: DVec3) -> f64 {
            point.length() - 1.2
        }
    }

    fn sphere(is_open: bool) -> Isosurface {
        Isosurface(Arc::new(Solid {
            function: Arc::new(Function::of(Kind::Field(Arc::new(SphereField)))),
            container: Container::DEFAULT,
            threshold: 0.0,
            accuracy: 1e-6,
            unit: 1.0,
            gradient: 1.0,
            evaluate: None,
            visible_count: 1,
            is_open,
            side: 1.0,
        }))
    }

    fn roots(shape: &Isosurface, origin: DVec3, dir: DVec3) -> Vec<(f64, Crossing, bool)> {
        let mut roots = Vec::new();
        shape.roots(&Ray::new(origin, dir), &mut roots);
        let own = roots.iter();
        own.map(|root| {
            (
                (root.t * 1000.0).round() / 1000.0,
                root.crossing,
                root.is_visible,
            )
        })
        .collect()
    }

    #[test]
    fn a_container_caps_the_surface_unless_it_is_open() {
        let (origin, dir) = (DVec3::new(0.0, 0.0, -3.0), DVec3::Z);
        let (enter, leave) = (Crossing::Enter, Crossing::Leave);
        // The container is visible where the ray enters, and again as the first root, but not where it leaves.
        let closed = [
            (2.0, enter, true),
            (2.0, Crossing::Touch, true),
            (4.0, leave, false),
        ];
        assert_eq!(roots(&sphere(false), origin, dir), closed);
        let open = [(2.0, enter, false), (4.0, leave, false)];
        assert_eq!(roots(&sphere(true), origin, dir), open);
    }

    #[derive(Debug)]
    struct PlaneField;

    impl function::Field for PlaneField {
        fn value(&self, point: DVec3) -> f64 {
            point.y
        }
    }

    #[test]
    fn a_surface_in_a_face_of_its_container_is_invisible_from_inside() {
        let sea = |top: f64| {
            let mut sea = sphere(false);
            let solid = Arc::make_mut(&mut sea.0);
            solid.function = Arc::new(Function::of(Kind::Field(Arc::new(PlaneField))));
            solid.container = Container::Box {
                low: DVec3::splat(-1.0),
                high: DVec3::new(1.0, top, 1.0),
            };
            roots(&sea, DVec3::new(0.0, -0.5, 0.0), DVec3::Y)
        };
        assert_eq!(sea(0.0), [(0.5, Crossing::Leave, false)]);
        assert_eq!(sea(-0.25), [(0.25, Crossing::Leave, true)]);
        assert_eq!(sea(0.25), [(0.5, Crossing::Leave, true)]);
    }

    #[test]
    fn hits_are_accurate_to_the_accuracy() {
        let origin = DVec3::new(-3.0, 0.8, 0.8);
        let half = (1.44_f64 - 2.0 * 0.64).sqrt();
        let hits = roots(&sphere(false), origin, DVec3::X);
        let near = |a: f64, b: f64| (a - b).abs() < 2e-3;
        assert!(near(hits[0].0, 3.0 - half) && near(hits[1].0, 3.0 + half));
        assert_eq!(hits.len(), 2);
    }

    #[test]
    fn a_ray_that_leaves_the_surface_does_not_hit_it() {
        let sphere = sphere(true);
        let start = DVec3::new(0.8, 0.8, (1.44_f64 - 1.28).sqrt());
        let out = Ray::new(start, start.normalize());
        assert_eq!(sphere.nearest_beside(&out, 1e-12, 9.0, SURFACE), None);
        let through = Ray::new(start, DVec3::NEG_Z);
        let other = sphere.nearest_beside(&through, 1e-12, 9.0, SURFACE);
        assert!((other.unwrap().t - 0.8).abs() < 1e-3);
    }

    #[test]
    fn inside_the_function_is_smaller() {
        assert!(sphere(false).contains(DVec3::new(0.5, 0.5, 0.5)));
        assert!(!sphere(false).contains(DVec3::new(0.9, 0.9, 0.9)));
        assert!(!sphere(false).contains(DVec3::new(1.1, 0.0, 0.0)));
    }
}
