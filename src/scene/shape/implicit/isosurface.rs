//! `isosurface { function { ... } [contained_by { ... }] [threshold] [accuracy] [max_gradient] [open] ... }`: where a
//! function of the point has the value `threshold`; inside it is smaller.
//!
//! Between two places of a ray there is no root if the values there are too large to fall to zero at `max_gradient`, the
//! most that the function changes in a unit of length; otherwise the stretch is halved, down to `accuracy` (Lipschitz
//! bounds; Kalra and Barr 1989). This is POV-Ray's search, to the ends of its stretches, since its roots lie up to
//! `accuracy` beyond the surface: a finer one would show another picture, and so would one that found what a wrong
//! `max_gradient` loses.
//!
//! Error bound: `accuracy` along the ray, as POV-Ray's (`tests/stability`, item 51), and that alone.
//!
//! `evaluate` raises the gradient along each ray anew; in POV-Ray it stays raised for the rays that come later, so that
//! the picture depends on their order. Normals are differences over `accuracy`.
//!
//! What can be seen, and what lies inside, are two things in a combination (measured with POV-Ray): the inside is exact,
//! but of the surface a ray shows no more than its first `max_trace` roots. The container is seen where a ray that
//! comes from outside enters the solid through it, and there again as the first of the roots, `accuracy` behind; and
//! where a ray that starts within it leaves the solid through it, unless the function is zero there. Neither counts as a
//! root.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::function::{self, Function};
use crate::scene::shape::container::{Container, End};
use crate::scene::shape::{Crossing, Geometry, Root, Start, read};
use glam::DVec3;
use std::sync::Arc;

/// A search goes on so many accuracies behind a root, and begins so far from a surface that a ray leaves.
const AFTER_ROOT: f64 = 5.0;
/// A ray that begins where the function is so many accuracies times the gradient begins at the surface.
const AT_SURFACE: f64 = 4.0;
/// Halvings of a stretch: more than the digits of a number.
const MOST_HALVINGS: u32 = 64;
/// Pieces into which the stretch of one ray is cut. Only numbers that mean nothing need more (a container of 10³⁰ and a
/// gradient as large), and POV-Ray does not end there.
const MOST_PIECES: u32 = 1 << 18;
/// Roots of one ray that `all_intersections` shows, and the largest `max_trace`.
const MOST_TRACED: u32 = 10;
/// Roots of one ray.
const MOST_ROOTS: usize = 1000;
/// What `accuracy` and `max_gradient` are where the scene says nothing.
const ACCURACY: f64 = 0.001;
const MAX_GRADIENT: f64 = 1.1;
/// The face of the surface itself; those of the container have smaller numbers.
const SURFACE: u32 = Container::FACES;

/// A surface of a function. Copies share it.
#[derive(Clone, Debug, PartialEq)]
pub struct Isosurface(Arc<Solid>);

#[derive(Clone, Debug)]
struct Solid {
    function: Arc<Function>,
    container: Container,
    threshold: f64,
    accuracy: f64,
    /// The length in which `accuracy` counts along a ray; POV-Ray has it 1 whatever the transform of the object.
    unit: f64,
    gradient: f64,
    evaluate: Option<Evaluate>,
    /// How many roots of a ray can be seen.
    traced: u32,
    is_open: bool,
}

/// How the gradient grows: `evaluate least, factor, ...`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Evaluate {
    factor: f64,
}

impl PartialEq for Solid {
    /// Functions are the same if they are one.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function)
            && self.container == other.container
            && [self.threshold, self.accuracy, self.gradient]
                == [other.threshold, other.accuracy, other.gradient]
            && self.evaluate == other.evaluate
            && (self.is_open, self.traced) == (other.is_open, other.traced)
    }
}

impl Isosurface {
    /// Reads the function and the words of the surface.
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
            traced: 1,
            is_open: false,
        };
        while read_word(args, &mut solid)? {}
        Ok(Isosurface(Arc::new(solid)))
    }
}

/// Reads one of the words that may stand in any order; false if none is next.
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
        let traced = args.float()?;
        let more = (2..=MOST_TRACED).take_while(|&count| f64::from(count) <= traced);
        solid.traced = more.last().unwrap_or(1);
    } else if args.accept(Word::AllIntersections)? {
        if args.float_or(1.0)? != 0.0 {
            solid.traced = MOST_TRACED;
        }
    } else if args.accept(Word::Open)? {
        solid.is_open = args.float_or(1.0)? != 0.0;
    } else {
        return Ok(false);
    }
    Ok(true)
}

/// A positive number; of another the scene's author is warned, and it is `default`, as in POV-Ray.
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
    fn way(&self) -> f64 {
        self.unit * self.accuracy
    }

    fn value(&self, point: DVec3) -> f64 {
        self.function.eval(&point.to_array()) - self.threshold
    }

    /// Gives the roots of a ray from its start on, in order, until `emit` says to stop. Says whether it starts inside.
    /// A ray that starts on the surface has left it: POV-Ray takes the function's sign a little further on.
    fn follow(&self, ray: &Ray, emit: &mut dyn FnMut(Root) -> bool) -> Start {
        let Some([enter, leave]) = self.container.chord(ray) else {
            return Start::Outside;
        };
        if leave.0 <= 0.0 {
            return Start::Outside;
        }
        let mut search = Search {
            solid: self,
            ray,
            speed: ray.dir.length(),
            gradient: self.gradient,
            pieces: 0,
        };
        let mut is_inside = false;
        let mut at = enter.0.max(0.0);
        let mut traced = 0;
        let value = search.value(at, 1.0);
        let starts_outside = enter.0 > self.way();
        if starts_outside {
            is_inside = value < 0.0;
            if is_inside && !emit(self.face(enter, Crossing::Enter)) {
                return Start::Outside;
            }
            if is_inside && !self.is_open {
                let again = search.root(at, leave.0, 1.0);
                if let Some(t) = again {
                    at = t + AFTER_ROOT * self.way();
                    traced = 1;
                    if !emit(self.surface(t, Crossing::Touch, true)) {
                        return Start::Outside;
                    }
                }
            }
        } else if value < self.gradient * self.accuracy * AT_SURFACE {
            // This may lie beyond the container, whose end is then the root.
            at = AFTER_ROOT * self.way();
            is_inside = search.value(at, 1.0) < 0.0;
        }
        let start = if is_inside && !starts_outside {
            Start::Inside
        } else {
            Start::Outside
        };
        for _ in 0..MOST_ROOTS {
            let Some(t) = search.root(at, leave.0, if is_inside { -1.0 } else { 1.0 }) else {
                break;
            };
            let crossing = if is_inside {
                Crossing::Leave
            } else {
                Crossing::Enter
            };
            is_inside = !is_inside;
            at = t + AFTER_ROOT * self.way();
            traced += 1;
            if !emit(self.surface(t, crossing, traced <= self.traced)) {
                return start;
            }
            if at >= leave.0 {
                break;
            }
        }
        if is_inside {
            let face = self.face(leave, Crossing::Leave);
            // Where the surface itself lies in the container's, neither is seen from inside (measured with POV-Ray).
            let is_seen = face.is_visible && !starts_outside && search.value(leave.0, 1.0) != 0.0;
            emit(Root {
                is_visible: is_seen,
                ..face
            });
        }
        start
    }

    /// A root of the function.
    fn surface(&self, t: f64, crossing: Crossing, is_traced: bool) -> Root {
        Root {
            t,
            crossing,
            face: SURFACE,
            is_visible: is_traced && t > self.way(),
        }
    }

    /// A root on the container.
    fn face(&self, (t, face): End, crossing: Crossing) -> Root {
        Root {
            t,
            crossing,
            face,
            is_visible: !self.is_open && t > self.way(),
        }
    }
}

/// The search for a root on a ray.
struct Search<'a> {
    solid: &'a Solid,
    ray: &'a Ray,
    /// The length of the ray's direction.
    speed: f64,
    /// The gradient, which may grow.
    gradient: f64,
    /// How many pieces of the ray were looked at.
    pieces: u32,
}

impl Search<'_> {
    fn value(&self, t: f64, sign: f64) -> f64 {
        sign * self.solid.value(self.ray.at(t))
    }

    /// The first place between these two found to be below zero.
    fn root(&mut self, from: f64, to: f64, sign: f64) -> Option<f64> {
        let (before, after) = (self.value(from, sign), self.value(to, sign));
        self.halve((from, before), (to, after), sign, MOST_HALVINGS)
    }

    fn halve(&mut self, from: (f64, f64), to: (f64, f64), sign: f64, left: u32) -> Option<f64> {
        let step = to.0 - from.0;
        self.pieces += 1;
        if step < self.solid.way() || left == 0 || self.pieces > MOST_PIECES {
            return (to.1 < 0.0).then_some(to.0);
        }
        if let Some(Evaluate { factor }) = self.solid.evaluate {
            let slope = (to.1 - from.1).abs() / (step * self.speed);
            if slope * factor > self.gradient {
                self.gradient = slope * factor * factor;
            }
        }
        let may_fall = from.1 + to.1 < self.gradient * self.speed * step;
        if !may_fall {
            return None;
        }
        let t = 0.5 * (from.0 + to.0);
        let middle = (t, self.value(t, sign));
        self.halve(from, middle, sign, left - 1)
            .or_else(|| self.halve(middle, to, sign, left - 1))
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
        let mut found = None;
        self.0.follow(ray, &mut |root| {
            if root.is_visible && from < root.t {
                found = Some(root);
            }
            found.is_none() && root.t < to
        });
        found.filter(|root| root.t < to)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, _: u32) -> Option<Root> {
        self.nearest(ray, from, to)
    }

    fn knows_departures(&self) -> bool {
        true
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let solid = &self.0;
        let wall = if face == SURFACE {
            solid.container.face_at(point)
        } else {
            Some(face)
        };
        if let Some(wall) = wall {
            return solid.container.normal(point, wall);
        }
        let here = solid.value(point);
        let along = |axis: DVec3| solid.value(point + solid.accuracy * axis) - here;
        let normal = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
        if normal.is_finite() && normal != DVec3::ZERO {
            normal
        } else {
            DVec3::X
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.container.contains(point) && self.0.value(point) <= 0.0
    }

    fn bounds(&self) -> Bounds {
        self.0.container.bounds()
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn change_unit(&mut self, factor: f64) {
        Arc::make_mut(&mut self.0).unit *= factor;
    }

    /// So that rays which leave it are told from others.
    fn is_faceted(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::function::Kind;

    #[derive(Debug)]
    struct Ball;

    impl function::Field for Ball {
        fn value(&self, point: DVec3) -> f64 {
            point.length() - 1.2
        }
    }

    fn ball(is_open: bool) -> Isosurface {
        Isosurface(Arc::new(Solid {
            function: Arc::new(Function::of(Kind::Field(Arc::new(Ball)))),
            container: Container::DEFAULT,
            threshold: 0.0,
            accuracy: 1e-6,
            unit: 1.0,
            gradient: 1.0,
            evaluate: None,
            traced: 1,
            is_open,
        }))
    }

    fn roots(shape: &Isosurface, origin: DVec3, dir: DVec3) -> Vec<(f64, Crossing, bool)> {
        let mut roots = Vec::new();
        shape.roots(&Ray::new(origin, dir), &mut roots);
        let found = roots.iter();
        found
            .map(|root| {
                (
                    (root.t * 1000.0).round() / 1000.0,
                    root.crossing,
                    root.is_visible,
                )
            })
            .collect()
    }

    #[test]
    fn a_container_closes_what_it_cuts_unless_it_is_open() {
        let (origin, dir) = (DVec3::new(0.0, 0.0, -3.0), DVec3::Z);
        let (enter, leave) = (Crossing::Enter, Crossing::Leave);
        // The container is seen where the ray comes in, and there again as the first root, but not where it goes out.
        let closed = [
            (2.0, enter, true),
            (2.0, Crossing::Touch, true),
            (4.0, leave, false),
        ];
        assert_eq!(roots(&ball(false), origin, dir), closed);
        let open = [(2.0, enter, false), (4.0, leave, false)];
        assert_eq!(roots(&ball(true), origin, dir), open);
    }

    #[derive(Debug)]
    struct Height;

    impl function::Field for Height {
        fn value(&self, point: DVec3) -> f64 {
            point.y
        }
    }

    #[test]
    fn a_surface_in_a_face_of_its_container_is_not_seen_from_inside() {
        let sea = |top: f64| {
            let mut sea = ball(false);
            let solid = Arc::make_mut(&mut sea.0);
            solid.function = Arc::new(Function::of(Kind::Field(Arc::new(Height))));
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
    fn the_surface_is_found_to_the_accuracy() {
        let origin = DVec3::new(-3.0, 0.8, 0.8);
        let half = (1.44_f64 - 2.0 * 0.64).sqrt();
        let found = roots(&ball(false), origin, DVec3::X);
        let near = |a: f64, b: f64| (a - b).abs() < 2e-3;
        assert!(near(found[0].0, 3.0 - half) && near(found[1].0, 3.0 + half));
        assert_eq!(found.len(), 2);
    }

    #[test]
    fn a_ray_that_leaves_the_surface_does_not_meet_it() {
        let ball = ball(true);
        let start = DVec3::new(0.8, 0.8, (1.44_f64 - 1.28).sqrt());
        let out = Ray::new(start, start.normalize());
        assert_eq!(ball.nearest_beside(&out, 1e-12, 9.0, SURFACE), None);
        let through = Ray::new(start, DVec3::NEG_Z);
        let other = ball.nearest_beside(&through, 1e-12, 9.0, SURFACE);
        assert!((other.unwrap().t - 0.8).abs() < 1e-3);
    }

    #[test]
    fn inside_the_function_is_smaller() {
        assert!(ball(false).contains(DVec3::new(0.5, 0.5, 0.5)));
        assert!(!ball(false).contains(DVec3::new(0.9, 0.9, 0.9)));
        assert!(!ball(false).contains(DVec3::new(1.1, 0.0, 0.0)));
    }
}
