//! `julia_fractal { <c> [quaternion | hypercomplex] [function] [max_iteration n] [precision p] [slice <n>, d] }`: a
//! slice of the set of four-dimensional numbers that stay small when a function is applied again and again and `c`
//! added each time.
//!
//! The set has no formula; a ray is followed in steps. Outside, the steps of quaternions are the distance estimate of
//! Hart, Sandin and Kauffman 1989 ("Ray tracing deterministic 3-D fractals", eq. 8), inside they are `1 / precision`;
//! where the state changes it is halved down to [`TOLERANCE`]. POV-Ray does the same, and what its steps miss is to be
//! missed here: a finer search would draw hairs that POV-Ray does not. The normal is the gradient of `|z|²` after the
//! last iteration. Shadows differ in a few pixels of a thousand.
//!
//! Error bound: within [`TOLERANCE`] of a root that is found the state changes (`tests/stability`, item 51); no bound holds
//! for what the steps miss.
//!
//! Hypercomplex numbers are pairs of complex ones, on which every function acts by itself. For functions other than
//! `sqr` and `cube` POV-Ray 3.7 halves its steps with a wrong third coordinate, so that its surfaces are rough; here they
//! are smooth.
//!
//! In a combination that is moved as a whole POV-Ray 3.7 forgets that a `julia_fractal` is inverse or taken away, so that a
//! difference shows what an intersection would; here it stays a difference.

mod complex;
mod four;
mod places;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, Start, first_visible, read};
use complex::{Complex, Function};
use glam::{DVec3, DVec4};
use places::{Ahead, TOGETHER, split};
use smallvec::SmallVec;

/// The last halving of a step, in units of the object; POV-Ray's value.
const TOLERANCE: f64 = 1e-8;
/// Shadows that begin nearer are none; POV-Ray's value, in units of the scene.
const LEAST_WAY: f64 = 1e-3;
/// The radius of the ball that holds a hypercomplex fractal.
const HYPERCOMPLEX_RADIUS: f64 = 4.0;
/// The largest radius of the ball that holds one of quaternions.
const QUATERNION_RADIUS: f64 = 2.0;
/// Steps outside a hypercomplex fractal are at most so many of the least steps.
const MOST_LEAST_STEPS: f64 = 30.0;
/// Steps of one ray through the ball; a precision that needs more is refused.
const MOST_STEPS: f64 = 1e7;
/// The least precision; POV-Ray takes lower ones for this.
const LEAST_PRECISION: f64 = 1.0;
/// Iterations that nothing needs more of: digits are lost long before.
const MOST_ITERATIONS: f64 = 1e5;

/// A fractal. Its space is that in which the ball around it has its centre at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct JuliaFractal(Box<Fractal>);

#[derive(Clone, Debug, PartialEq)]
struct Fractal {
    c: DVec4,
    rule: Rule,
    max_iteration: u32,
    /// The least step.
    least: f64,
    /// How the fourth coordinate depends on the others, and its value at the origin.
    slope: DVec3,
    offset: f64,
    radius: f64,
    /// The length in which `LEAST_WAY` counts.
    unit: f64,
}

/// What is done in each iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rule {
    QuaternionSquare,
    QuaternionCube,
    Hypercomplex(Function),
}

impl JuliaFractal {
    /// Reads the number and the words of the fractal.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; a slice along the fourth axis; a function that quaternions do not have;
    /// a precision or a number of iterations beyond all use. With one iteration or none everything is inside, and nothing
    /// is seen, as in POV-Ray.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let c = vector4(args)?;
        let mut is_hypercomplex = false;
        let mut function = (Word::Sqr, Function::Square);
        let mut at = args.last_span();
        let (mut max_iteration, mut precision) = (20.0, 20.0);
        let (mut normal, mut distance) = (DVec4::W, 0.0);
        loop {
            if args.accept(Word::Quaternion)? {
                is_hypercomplex = false;
            } else if args.accept(Word::Hypercomplex)? {
                is_hypercomplex = true;
            } else if let Some(found) = read_function(args)? {
                function = found;
                at = args.last_span();
            } else if args.accept(Word::MaxIteration)? {
                max_iteration = at_most(args, "`max_iteration`", MOST_ITERATIONS)?.max(0.0);
            } else if args.accept(Word::Precision)? {
                precision = at_most(args, "`precision`", MOST_STEPS / HYPERCOMPLEX_RADIUS)?
                    .max(LEAST_PRECISION);
            } else if args.accept(Word::Slice)? {
                normal = read_slice(args)?;
                distance = read::number(args, "the distance of the slice")?;
            } else {
                break;
            }
        }
        let rule = match (is_hypercomplex, function) {
            (true, (_, function)) => Rule::Hypercomplex(function),
            (false, (Word::Sqr, _)) => Rule::QuaternionSquare,
            (false, (Word::Cube, _)) => Rule::QuaternionCube,
            (false, (word, _)) => {
                let message = format!("quaternions have only `sqr` and `cube`, not `{word}`");
                return Err(Box::new(
                    Diagnostic::error(at, message).with_hint("write `hypercomplex` before it"),
                ));
            }
        };
        let radius = if is_hypercomplex {
            HYPERCOMPLEX_RADIUS
        } else {
            QUATERNION_RADIUS.min(1.0 + c.length() + TOLERANCE)
        };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked to be a small number, and not negative"
        )]
        let max_iteration = max_iteration as u32;
        Ok(JuliaFractal(Box::new(Fractal {
            c,
            rule,
            max_iteration,
            least: 1.0 / precision,
            slope: -normal.truncate() / normal.w,
            offset: distance / normal.w,
            radius,
            unit: 1.0,
        })))
    }
}

fn vector4(args: &mut dyn Args) -> Parse<DVec4> {
    args.comma()?;
    args.vector4().map(DVec4::from_array)
}

/// A function, if one is next.
fn read_function(args: &mut dyn Args) -> Parse<Option<(Word, Function)>> {
    for (word, function) in Function::NAMED {
        if args.accept(*word)? {
            return Ok(Some((*word, *function)));
        }
    }
    if !args.accept(Word::Pwr)? {
        return Ok(None);
    }
    let open = |args: &mut dyn Args, mark| {
        if args.accept_mark(mark)? {
            return Ok(());
        }
        Err(args.expected("`pwr(real, imaginary)`"))
    };
    open(args, '(')?;
    let re = args.float()?;
    args.comma()?;
    let im = args.float()?;
    open(args, ')')?;
    Ok(Some((Word::Pwr, Function::Power(Complex::new(re, im)))))
}

/// The unit normal of the slice.
fn read_slice(args: &mut dyn Args) -> Parse<DVec4> {
    let at = args.span();
    let normal = vector4(args)?;
    let unit = normal.try_normalize().filter(|unit| unit.w != 0.0);
    unit.ok_or_else(|| {
        let message = "the fourth component of the `slice` must not be zero";
        Box::new(Diagnostic::error(at.to(args.last_span()), message))
    })
}

fn at_most(args: &mut dyn Args, what: &str, most: f64) -> Parse<f64> {
    let at = args.span();
    let value = args.float()?;
    if value <= most {
        return Ok(value);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("{what} must be {most} at most, found {value}"),
    )))
}

fn square(z: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    2.0 * z.x * v + DVec4::X * (z.x * z.x - v.length_squared())
}

fn cube(z: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    let (x_sq, v_sq) = (z.x * z.x, v.length_squared());
    v * (3.0 * x_sq - v_sq) + DVec4::X * (z.x * (x_sq - 3.0 * v_sq))
}

/// The transpose of the derivative of [`square`] at `z`, applied to `g`.
fn square_back(z: DVec4, g: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    2.0 * (z.x * g - g.x * v + DVec4::X * g.with_x(0.0).dot(v))
}

/// The transpose of the derivative of [`cube`] at `z`, applied to `g`.
fn cube_back(z: DVec4, g: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    let (x_sq, v_sq) = (z.x * z.x, v.length_squared());
    let inner = g.with_x(0.0);
    let along = inner.dot(v);
    (3.0 * x_sq - v_sq) * inner - 2.0 * along * v - 6.0 * z.x * g.x * v
        + DVec4::X * (3.0 * (x_sq - v_sq) * g.x + 6.0 * z.x * along)
}

impl Fractal {
    fn start(&self, point: DVec3) -> DVec4 {
        point.extend(self.offset + self.slope.dot(point))
    }

    /// The gradient of `|z|²` after all iterations.
    fn gradient(&self, point: DVec3) -> DVec3 {
        let start = self.start(point);
        let gradient = match self.rule {
            Rule::QuaternionSquare => self.quaternion_gradient(start, square, square_back),
            Rule::QuaternionCube => self.quaternion_gradient(start, cube, cube_back),
            Rule::Hypercomplex(function) => {
                let (mut z, c) = (split(start), split(self.c));
                let mut slope = [Complex::ONE; 2];
                for _ in 0..self.max_iteration {
                    for i in [0, 1] {
                        slope[i] = function.slope(z[i]) * slope[i];
                        z[i] = function.value(z[i]) + c[i];
                    }
                }
                let [a, b] = [0, 1].map(|i| z[i].conjugate() * slope[i]);
                DVec4::new(a.re + b.re, -a.im - b.im, b.im - a.im, b.re - a.re)
            }
        };
        // POV-Ray 3.7 forgets that the fourth coordinate changes too where the slice is slanted.
        gradient.truncate()
    }

    fn quaternion_gradient(
        &self,
        mut z: DVec4,
        function: impl Fn(DVec4) -> DVec4,
        back: impl Fn(DVec4, DVec4) -> DVec4,
    ) -> DVec4 {
        let mut passed: SmallVec<[DVec4; 32]> = SmallVec::new();
        for _ in 0..self.max_iteration {
            passed.push(z);
            z = function(z) + self.c;
        }
        passed.iter().rev().fold(z, |g, z| back(*z, g))
    }

    /// Follows a ray of unit direction from `from` on through the ball and gives each place where it changes sides, until
    /// `emit` says to stop. Says whether it is inside at the end.
    fn follow(&self, ray: &Ray, from: f64, emit: &mut dyn FnMut(f64, Crossing) -> bool) -> bool {
        let Some((enter, leave)) = self.chord(ray) else {
            return false;
        };
        let mut depth = enter.max(from);
        if depth >= leave {
            return false;
        }
        let mut ahead = Ahead::new(self, ray);
        let mut here = ahead.place(depth);
        if here.is_inside {
            depth += 2.0 * TOLERANCE;
            here = ahead.place(depth);
        }
        if here.is_inside && from < enter && !emit(enter, Crossing::Enter) {
            return true;
        }
        loop {
            let step = if here.is_inside {
                self.least
            } else {
                here.step
            };
            let next_depth = depth + step;
            if next_depth > leave || next_depth == depth {
                return here.is_inside;
            }
            let next = ahead.place(next_depth);
            if next.is_inside != here.is_inside {
                let crossing = if next.is_inside {
                    Crossing::Enter
                } else {
                    Crossing::Leave
                };
                if !emit(self.halve(ray, depth, step, here.is_inside), crossing) {
                    return next.is_inside;
                }
            }
            (depth, here) = (next_depth, next);
        }
    }

    /// The place between `depth` and `depth + step` where the ray changes sides. Several halvings are done at once: all
    /// middles that they may ask for are looked at together.
    fn halve(&self, ray: &Ray, mut depth: f64, mut step: f64, is_inside: bool) -> f64 {
        let together = self.together();
        while step > TOLERANCE {
            // By their numbers in the tree of halves; the least depth of each, and its middle.
            let (mut lows, mut middles) = ([depth; TOGETHER], [depth; TOGETHER]);
            let mut half = step;
            for number in 1..together.max(2) {
                if number.is_power_of_two() {
                    half *= 0.5;
                }
                if number > 1 {
                    let above = number / 2;
                    lows[number] = [lows[above], middles[above]][number % 2];
                }
                middles[number] = lows[number] + half;
            }
            // With one place only, that is the first.
            middles.rotate_left(1);
            let places = self.places(ray, &middles);
            let mut number = 1;
            while number < together.max(2) && step > TOLERANCE {
                step *= 0.5;
                let is_behind = places.is_inside(number - 1) == is_inside;
                if is_behind {
                    depth = middles[number - 1];
                }
                number = 2 * number + usize::from(is_behind);
            }
        }
        // The end that is inside, on whose iterations the normal stands.
        if is_inside { depth } else { depth + step }
    }

    /// Where a ray of unit direction is in the ball.
    fn chord(&self, ray: &Ray) -> Option<(f64, f64)> {
        let middle = -ray.origin.dot(ray.dir);
        let away_sq = ray.at(middle).length_squared();
        let half_sq = self.radius * self.radius - away_sq;
        (half_sq > 0.0).then(|| (middle - half_sq.sqrt(), middle + half_sq.sqrt()))
    }
}

/// The ray with a direction of length one, and the length it had.
fn unit(ray: &Ray) -> (Ray, f64) {
    let length = ray.dir.length();
    (Ray::new(ray.origin, ray.dir / length), length)
}

fn root(t: f64, crossing: Crossing, is_visible: bool) -> Root {
    Root {
        t,
        crossing,
        face: 0,
        is_visible,
    }
}

impl Geometry for JuliaFractal {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let (ray, length) = unit(ray);
        let Some((enter, leave)) = self.0.chord(&ray) else {
            return Start::Outside;
        };
        let is_inside = self.0.follow(&ray, f64::NEG_INFINITY, &mut |t, crossing| {
            // The ball is not seen where it cuts through the fractal.
            roots.push(root(t / length, crossing, t > enter));
            true
        });
        if is_inside {
            roots.push(root(leave / length, Crossing::Leave, false));
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if from == f64::NEG_INFINITY {
            let mut roots = Vec::new();
            self.roots(ray, &mut roots);
            return first_visible(&roots, from, to);
        }
        let (ray, length) = unit(ray);
        let mut found = None;
        let from = from * length;
        let enter = self.0.chord(&ray)?.0;
        self.0
            .follow(&ray, from.max(TOLERANCE), &mut |t, crossing| {
                // The ball is not seen where it cuts through the fractal.
                if t <= enter {
                    return true;
                }
                let root = root(t / length, crossing, true);
                found = (root.t < to).then_some(root);
                false
            });
        found
    }

    /// The surface is where the steps of another ray found it, and a ray that leaves it may find it anew. POV-Ray looks
    /// for one place only, and forgets it if it is too near.
    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, _: u32) -> Option<Root> {
        let (unit, length) = unit(ray);
        let least = from.max(self.0.unit * LEAST_WAY);
        let mut found = None;
        self.0.follow(&unit, TOLERANCE, &mut |t, crossing| {
            found =
                Some(root(t / length, crossing, true)).filter(|root| least < root.t && root.t < to);
            found.is_none()
        });
        found
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let gradient = self.0.gradient(point);
        if gradient.is_finite() && gradient != DVec3::ZERO {
            gradient.normalize()
        } else {
            DVec3::X
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let fractal = &self.0;
        point.length_squared() <= fractal.radius * fractal.radius
            && fractal
                .places(&Ray::new(point, DVec3::X), &[0.0; TOGETHER])
                .is_inside(0)
    }

    fn bounds(&self) -> Bounds {
        let radius = DVec3::splat(self.0.radius);
        Bounds {
            min: -radius,
            max: radius,
        }
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn change_unit(&mut self, factor: f64) {
        self.0.unit *= factor;
    }

    /// So that rays which leave it are not sent through the whole ball again.
    fn is_faceted(&self) -> bool {
        true
    }
}
